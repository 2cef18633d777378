//! Region boundaries as the hand moves them.
//!
//! A boundary is an angle at which a region begins or ends; where one region ends and the next
//! begins at the same angle it is one boundary, and both move together. Regions keep their order
//! and their names; they never overlap, and none gets narrower than [`NARROWEST_RAD`].

use crate::sessions::Region;
use crate::units::deg_from_rad;

/// Angles closer than this are one boundary, rad.
const SAME_RAD: f64 = 1e-9;
/// No region gets narrower than 0.5°.
pub(crate) const NARROWEST_RAD: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// Dragged boundaries stop at multiples of this.
pub(crate) const SNAP_DEG: f64 = 0.5;

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
    for (k, region) in regions.iter().enumerate() {
        all.push(Boundary {
            at_rad: region.from_rad,
            below: None,
            above: Some(k),
        });
        all.push(Boundary {
            at_rad: region.to_rad,
            below: Some(k),
            above: None,
        });
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
    let Boundary { below, above, .. } = boundaries(regions).swap_remove(boundary);
    let mut regions = regions.to_vec();
    if let Some(k) = below {
        regions[k].to_rad = at;
    }
    if let Some(k) = above {
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
    crate::units::rad_from_deg((deg_from_rad(rad) / SNAP_DEG).round() * SNAP_DEG)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sessions::regions::testing::regions;
    use crate::units::rad_from_deg;

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
}
