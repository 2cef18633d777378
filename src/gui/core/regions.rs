//! Region boundaries as the hand moves them, on the plot or in the table, and how many samples each region has.
//!
//! A boundary is an angle at which a region begins or ends; where one region ends and the next
//! begins at the same angle it is one boundary, and both move together. Regions keep their order
//! and their names; they never overlap, and none gets narrower than [`NARROWEST_RAD`]. A boundary
//! stops at its neighbours.

use crate::effects::JointValues;
use crate::fit::regions_of;
use crate::language::spoken;
use crate::pipeline::{self, identify};
use crate::present::units::Units;
use crate::sessions::division::RegionChoice;
use crate::sessions::{Region, Session};
use crate::units::{deg_from_rad, rad_from_deg};

/// Angles closer than this are the same, and one boundary, rad.
const SAME_RAD: f64 = 1e-9;
/// No region gets narrower than 0.5°.
const NARROWEST_RAD: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// Dragged boundaries stop at multiples of this.
pub(crate) const SNAP_DEG: f64 = 0.5;

/// Where a boundary is, and the regions that it belongs to, counted in the document's order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Boundary {
    pub(crate) at_rad: f64,
    /// The region that ends here.
    pub(crate) below: Option<usize>,
    /// The region that begins here.
    pub(crate) above: Option<usize>,
}

/// All boundaries, in ascending order.
pub(crate) fn boundaries(regions: &[Region]) -> Vec<Boundary> {
    let mut all: Vec<Boundary> = Vec::with_capacity(2 * regions.len());
    let mut end = |at_rad, below, above| {
        all.push(Boundary {
            at_rad,
            below,
            above,
        });
    };
    for (k, region) in regions.iter().enumerate() {
        end(region.from_rad, None, Some(k));
        end(region.to_rad, Some(k), None);
    }
    all.sort_by(|a, b| a.at_rad.total_cmp(&b.at_rad));
    let mut merged: Vec<Boundary> = Vec::with_capacity(all.len());
    for next in all {
        match merged.last_mut() {
            Some(last)
                if (next.at_rad - last.at_rad).abs() < SAME_RAD
                    && (last.below.is_none() || next.below.is_none())
                    && (last.above.is_none() || next.above.is_none()) =>
            {
                last.below = last.below.or(next.below);
                last.above = last.above.or(next.above);
            }
            _ => merged.push(next),
        }
    }
    merged
}

/// How far a boundary may be moved, rad: to its neighbours, and `within` at the ends.
pub(crate) fn allowed_range(
    regions: &[Region],
    boundary: usize,
    within: (f64, f64),
) -> Option<(f64, f64)> {
    let all = boundaries(regions);
    let here = all.get(boundary)?;
    // Beside a gap the neighbour belongs to no region of ours: it may be touched.
    let low = match boundary.checked_sub(1).map(|k| &all[k]) {
        None => within.0.min(here.at_rad),
        Some(last) if here.below.is_some() => last.at_rad + NARROWEST_RAD,
        Some(last) => last.at_rad,
    };
    let high = match all.get(boundary + 1) {
        None => within.1.max(here.at_rad),
        Some(next) if here.above.is_some() => next.at_rad - NARROWEST_RAD,
        Some(next) => next.at_rad,
    };
    Some((low.min(here.at_rad), high.max(here.at_rad)))
}

/// The regions with one boundary moved as far towards `to_rad` as its neighbours allow.
pub(crate) fn moved(
    regions: &[Region],
    boundary: usize,
    to_rad: f64,
    within: (f64, f64),
) -> Option<Vec<Region>> {
    let (low, high) = allowed_range(regions, boundary, within)?;
    if !to_rad.is_finite() {
        return None;
    }
    let at = to_rad.clamp(low, high);
    let here = &boundaries(regions)[boundary];
    let mut regions = regions.to_vec();
    if let Some(k) = here.below {
        regions[k].to_rad = at;
    }
    if let Some(k) = here.above {
        regions[k].from_rad = at;
    }
    Some(regions)
}

/// The regions with one cut in half.
pub(crate) fn split(regions: &[Region], region: usize) -> Option<Vec<Region>> {
    let whole = regions.get(region)?;
    if whole.to_rad - whole.from_rad < 2.0 * NARROWEST_RAD {
        return None;
    }
    let middle = 0.5 * (whole.from_rad + whole.to_rad);
    let mut upper = whole.clone();
    upper.from_rad = middle;
    upper.name = free_name(regions);
    let mut regions = regions.to_vec();
    regions[region].to_rad = middle;
    regions.insert(region + 1, upper);
    Some(regions)
}

/// The smallest whole number that no region is called.
fn free_name(regions: &[Region]) -> String {
    // One of the first n + 1 numbers is free.
    (1..=regions.len() + 1)
        .map(|k| k.to_string())
        .find(|name| regions.iter().all(|r| r.name != *name))
        .unwrap_or_default()
}

/// An angle brought to the next half degree.
pub(crate) fn snapped_rad(rad: f64) -> f64 {
    rad_from_deg((deg_from_rad(rad) / SNAP_DEG).round() * SNAP_DEG)
}

/// An end of a region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    /// Where it begins.
    From,
    /// Where it ends.
    To,
}

/// The boundary at an end of a region, counted as in [`boundaries`]: where another region touches it, it is that one's
/// as well.
pub(crate) fn at_end(regions: &[Region], region: usize, end: End) -> Option<usize> {
    boundaries(regions).iter().position(|b| match end {
        End::From => b.above == Some(region),
        End::To => b.below == Some(region),
    })
}

/// The regions without one; where it was nothing is corrected. The last one stays.
pub(crate) fn without(regions: &[Region], region: usize) -> Option<Vec<Region>> {
    if region >= regions.len() || regions.len() < 2 {
        return None;
    }
    let mut rest = regions.to_vec();
    rest.remove(region);
    Some(rest)
}

/// The region that ends where another begins.
pub(crate) fn before(regions: &[Region], region: usize) -> Option<usize> {
    let from_rad = regions.get(region)?.from_rad;
    let ends = |r: &Region| (r.to_rad - from_rad).abs() < SAME_RAD;
    regions.iter().position(ends)
}

/// The region that begins where another ends.
pub(crate) fn next_to(regions: &[Region], region: usize) -> Option<usize> {
    let to_rad = regions.get(region)?.to_rad;
    let begins = |r: &Region| (r.from_rad - to_rad).abs() < SAME_RAD;
    regions.iter().position(begins)
}

/// The regions with one and the region after it made into one, under the first one's name.
pub(crate) fn joined(regions: &[Region], region: usize) -> Option<Vec<Region>> {
    let next = next_to(regions, region)?;
    let mut rest = regions.to_vec();
    rest[region].to_rad = rest[next].to_rad;
    rest.remove(next);
    Some(rest)
}

/// Angles between the regions, and between them and the ends of the range, that belong to none.
pub(crate) fn gaps(regions: &[Region], within: (f64, f64)) -> Vec<(f64, f64)> {
    let mut spans: Vec<(f64, f64)> = regions.iter().map(|r| (r.from_rad, r.to_rad)).collect();
    spans.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut gaps = Vec::new();
    let mut covered_to = within.0;
    for (from, to) in spans {
        if from.min(within.1) - covered_to > SAME_RAD {
            gaps.push((covered_to, from.min(within.1)));
        }
        covered_to = covered_to.max(to);
    }
    if within.1 - covered_to > SAME_RAD {
        gaps.push((covered_to, within.1));
    }
    gaps
}

/// Numbers of samples.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Count {
    /// All of them, whether they can be used or not.
    pub(crate) all: usize,
    /// Those that a fit uses.
    pub(crate) fitted: usize,
}

/// Those of each region, and how many samples are in none.
pub(crate) type Counts = (Vec<Count>, usize);

// How the regions came about, and what the adaptive division decided and why.

/// How the regions came about.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) enum Division {
    /// All of the same width.
    Even,
    /// The session's own, or changed by hand since.
    #[default]
    Given,
    /// Where the samples ask for them.
    Adaptive(Decision),
}

/// What the adaptive division decided.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Decision {
    /// How many regions.
    pub(crate) regions: usize,
    /// The gap that they leave, mm; `None` where nothing can be identified by region.
    pub(crate) left_mm: Option<f64>,
    /// The gap that as many even ones leave, mm.
    pub(crate) even_mm: Option<f64>,
}

impl Decision {
    /// What was decided and why, in one line.
    pub(crate) fn describe(&self, units: Units) -> String {
        if self.regions == 1 {
            return say!("One region: nowhere does the deviation change by more than the noise")
                .to_owned();
        }
        let length = |mm: Option<f64>| mm.map_or("–".to_owned(), |mm| units.length(mm));
        say!(
            "{n} regions: a boundary where the deviation changes by more than the noise. They leave {left}, {n} even ones {even}",
            n = self.regions,
            left = length(self.left_mm),
            even = length(self.even_mm)
        )
    }
}

/// Divides where the samples ask for it. Takes its time with many samples.
pub(crate) fn adapt(session: &Session) -> Result<(Vec<Region>, Decision), String> {
    let regions = regions_of(&RegionChoice::Adaptive, session).map_err(|e| spoken(e.describe()))?;
    let left = |choice| {
        let method = pipeline::Method::Regional(choice);
        let (found, _) = identify(session, &method, JointValues::Commanded).ok()?;
        Some(found.gap.after.rms_mm)
    };
    let decision = Decision {
        regions: regions.len(),
        left_mm: left(RegionChoice::Given(regions.clone())),
        even_mm: left(RegionChoice::Uniform(regions.len())),
    };
    Ok((regions, decision))
}

#[cfg(test)]
mod tests {
    use crate::units::rad_from_deg;

    use super::*;

    /// Regions from and to these degrees, named 1, 2, … in this order.
    fn regions(degrees: &[(f64, f64)]) -> Vec<Region> {
        let make = |(k, (from, to)): (usize, &(f64, f64))| Region {
            name: (k + 1).to_string(),
            from_rad: rad_from_deg(*from),
            to_rad: rad_from_deg(*to),
        };
        degrees.iter().enumerate().map(make).collect()
    }

    const WITHIN: (f64, f64) = (-1.6, 1.6);

    #[test]
    fn two_regions_that_touch_share_their_boundary() {
        let all = boundaries(&regions(&[(0.0, 30.0), (30.0, 60.0), (-30.0, 0.0)]));
        let at: Vec<f64> = all.iter().map(|b| deg_from_rad(b.at_rad).round()).collect();
        assert_eq!(at, [-30.0, 0.0, 30.0, 60.0]);
        assert_eq!((all[1].below, all[1].above), (Some(2), Some(0)));
    }

    #[test]
    fn moving_a_shared_boundary_moves_both_regions_and_stops_before_the_next() {
        let start = regions(&[(0.0, 30.0), (30.0, 60.0)]);
        let after = moved(&start, 1, rad_from_deg(40.0), WITHIN).expect("boundary 1 exists");
        assert_eq!(after[0].to_rad, after[1].from_rad);
        assert!((deg_from_rad(after[0].to_rad) - 40.0).abs() < 1e-9);
        let far = moved(&start, 1, rad_from_deg(80.0), WITHIN).expect("boundary 1 exists");
        assert!((deg_from_rad(far[0].to_rad) - 59.5).abs() < 1e-9);
    }

    #[test]
    fn regions_with_a_gap_between_them_move_apart_from_each_other() {
        let start = regions(&[(6.0, 30.0), (36.0, 60.0)]);
        let after = moved(&start, 1, rad_from_deg(34.0), WITHIN).expect("boundary 1 exists");
        assert!((deg_from_rad(after[0].to_rad) - 34.0).abs() < 1e-9);
        assert!((deg_from_rad(after[1].from_rad) - 36.0).abs() < 1e-9);
    }

    #[test]
    fn a_split_region_keeps_its_name_below_and_has_a_free_one_above() {
        let start = regions(&[(0.0, 30.0), (30.0, 60.0)]);
        let split = split(&start, 0).expect("wide enough");
        assert_eq!(split.len(), 3);
        assert_eq!((&*split[0].name, &*split[1].name), ("1", "3"));
        assert_eq!(split[0].to_rad, split[1].from_rad);
    }

    const THREE: [(f64, f64); 3] = [(0.0, 30.0), (30.0, 60.0), (70.0, 90.0)];

    #[test]
    fn an_end_is_the_boundary_that_two_regions_share_or_its_own_beside_a_gap() {
        let all = regions(&THREE);
        assert_eq!(at_end(&all, 0, End::To), Some(1));
        assert_eq!(at_end(&all, 1, End::From), Some(1));
        assert_eq!(at_end(&all, 1, End::To), Some(2));
        assert_eq!(at_end(&all, 2, End::From), Some(3));
        assert_eq!(at_end(&all, 7, End::From), None);
    }

    #[test]
    fn joining_and_leaving_out_keep_what_is_beside() {
        let all = regions(&THREE);
        let joined = joined(&all, 0).expect("region 2 begins where it ends");
        assert_eq!((joined.len(), joined[0].to_rad), (2, all[1].to_rad));
        assert!(next_to(&all, 1).is_none(), "a gap is between them");
        let rest = without(&all, 1).expect("two are left");
        assert_eq!((&rest[0], &rest[1]), (&all[0], &all[2]));
        assert!(without(&rest[..1], 0).is_none(), "the last one stays");
    }

    #[test]
    fn gaps_are_what_no_region_covers() {
        let within = (rad_from_deg(-10.0), rad_from_deg(95.0));
        let found = gaps(&regions(&THREE), within);
        let degrees: Vec<(f64, f64)> = found
            .iter()
            .map(|(a, b)| (deg_from_rad(*a).round(), deg_from_rad(*b).round()))
            .collect();
        assert_eq!(degrees, [(-10.0, 0.0), (60.0, 70.0), (90.0, 95.0)]);
    }
}
