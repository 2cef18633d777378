//! Region boundaries as the hand moves them and as they are typed.
//!
//! A boundary is an angle at which a region begins or ends; where one region ends and the next
//! begins at the same angle it is one boundary, and both move together. Regions keep their order
//! and their names; they never overlap, and none gets narrower than [`NARROWEST_RAD`]. A dragged
//! boundary stops at its neighbours; a typed one is taken as it is or not at all, and every refusal
//! names the region, says what is wrong and what to type instead.

use crate::present::units::{AngleUnit, Units, typed_in};
use crate::sessions::Region;
use crate::units::{deg_from_rad, rad_from_deg};

/// Angles closer than this are the same, and one boundary, rad.
const SAME_RAD: f64 = 1e-9;
/// No region gets narrower than 0.5°.
const NARROWEST_RAD: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// Dragged boundaries stop at multiples of this.
pub(crate) const SNAP_DEG: f64 = 0.5;

/// A boundary by the regions that it belongs to, counted in the document's order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Joint {
    /// The region that ends here.
    pub(crate) below: Option<usize>,
    /// The region that begins here.
    pub(crate) above: Option<usize>,
}

/// A boundary and where it is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Boundary {
    pub(crate) at_rad: f64,
    pub(crate) joint: Joint,
}

/// All boundaries, in ascending order.
pub(crate) fn boundaries(regions: &[Region]) -> Vec<Boundary> {
    let mut all: Vec<Boundary> = Vec::with_capacity(2 * regions.len());
    let mut end = |at_rad, below, above| {
        let joint = Joint { below, above };
        all.push(Boundary { at_rad, joint });
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
                    && (last.joint.below.is_none() || next.joint.below.is_none())
                    && (last.joint.above.is_none() || next.joint.above.is_none()) =>
            {
                last.joint.below = last.joint.below.or(next.joint.below);
                last.joint.above = last.joint.above.or(next.joint.above);
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
        Some(last) if here.joint.below.is_some() => last.at_rad + NARROWEST_RAD,
        Some(last) => last.at_rad,
    };
    let high = match all.get(boundary + 1) {
        None => within.1.max(here.at_rad),
        Some(next) if here.joint.above.is_some() => next.at_rad - NARROWEST_RAD,
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
    let Joint { below, above } = boundaries(regions)[boundary].joint;
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
    rad_from_deg((deg_from_rad(rad) / SNAP_DEG).round() * SNAP_DEG)
}

const TURN_RAD: f64 = std::f64::consts::TAU;

/// An end of a region.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum End {
    /// Where it begins.
    From,
    /// Where it ends.
    To,
}

impl End {
    /// Where this end of a region is, rad.
    pub(crate) fn of(self, region: &Region) -> f64 {
        match self {
            Self::From => region.from_rad,
            Self::To => region.to_rad,
        }
    }
}

/// What is being typed for an end of a region and could not be taken over, or not yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Typed {
    pub(crate) region: String,
    pub(crate) end: End,
    pub(crate) text: String,
}

/// The boundary at an end of a region: where another region touches it, it is that one's as well.
pub(crate) fn joint_at(regions: &[Region], region: usize, end: End) -> Joint {
    let mut all = boundaries(regions).into_iter().map(|b| b.joint);
    let this = |joint: &Joint| match end {
        End::From => joint.above == Some(region),
        End::To => joint.below == Some(region),
    };
    all.find(this).unwrap_or_default()
}

/// The angle that was typed, rad; the unit is the chosen one unless another stands behind the
/// number. What is wrong with it otherwise.
pub(crate) fn angle(text: &str, units: Units) -> Result<f64, String> {
    let text = text.trim();
    let (name, example) = match units.angle {
        AngleUnit::Degree => (say!("degrees"), "−30"),
        AngleUnit::Radian => (say!("radians"), "−0.5"),
        AngleUnit::Milliradian => (say!("milliradians"), "−500"),
        AngleUnit::ArcSecond => (say!("seconds of arc"), "−108000"),
    };
    if text.is_empty() {
        return Err(say!(
            "the angle is missing; type it in {name}, such as {example}",
            name,
            example
        ));
    }
    typed_in(text, units.angle_name().trim(), "rad").map_err(|_| {
        say!(
            "'{text}' is not an angle; type a number of {name}, such as {example}",
            text,
            name,
            example
        )
    })
}

/// The regions with one boundary exactly there, or why it cannot be there and what could.
pub(crate) fn placed(
    regions: &[Region],
    joint: Joint,
    at_rad: f64,
    within: (f64, f64),
    units: Units,
) -> Result<Vec<Region>, String> {
    let say = |rad: f64| units.angle(rad);
    if !at_rad.is_finite() {
        return Err(say!("a boundary is an angle; type a number").to_owned());
    }
    if within.0 < within.1 && (at_rad < within.0 - SAME_RAD || at_rad > within.1 + SAME_RAD) {
        let range = format!("{} … {}", say(within.0), say(within.1));
        let turned = [at_rad - TURN_RAD, at_rad + TURN_RAD];
        let same = turned
            .into_iter()
            .find(|turned| (within.0..=within.1).contains(turned));
        return Err(match same {
            Some(same) => say!(
                "{at} is outside of the joint's range {range}; {same} is the same direction: type that",
                at = say(at_rad),
                range,
                same = say(same)
            ),
            None => say!(
                "{at} is outside of the joint's range {range}; type an angle in it",
                at = say(at_rad),
                range
            ),
        });
    }
    let mut next = regions.to_vec();
    let missing = say!("there is no such region");
    if let Some(k) = joint.below {
        next.get_mut(k).ok_or(missing)?.to_rad = at_rad;
    }
    if let Some(k) = joint.above {
        next.get_mut(k).ok_or(missing)?.from_rad = at_rad;
    }
    for k in [joint.below, joint.above].into_iter().flatten() {
        wide_enough(&next[k], joint.below == Some(k), units)?;
    }
    for k in [joint.below, joint.above].into_iter().flatten() {
        let overlaps = |other: &Region| {
            next[k].to_rad.min(other.to_rad) - next[k].from_rad.max(other.from_rad) > SAME_RAD
        };
        let other = next
            .iter()
            .enumerate()
            .find(|(o, r)| *o != k && overlaps(r));
        if let Some((_, other)) = other {
            let free = if joint.below == Some(k) {
                say!("at most {from}", from = say(other.from_rad))
            } else {
                say!("at least {to}", to = say(other.to_rad))
            };
            return Err(say!(
                "region {next} would overlap region {other}, {from} … {to}; type {free}, or merge the two",
                next = next[k].name,
                other = other.name,
                from = say(other.from_rad),
                to = say(other.to_rad),
                free
            ));
        }
    }
    Ok(next)
}

/// A region begins before it ends, and is wide enough to be told from its neighbours.
fn wide_enough(region: &Region, at_its_end: bool, units: Units) -> Result<(), String> {
    let say = |rad: f64| units.angle(rad);
    let Region {
        name,
        from_rad,
        to_rad,
    } = region;
    let width = to_rad - from_rad;
    // As narrow as it may be, but for rounding.
    if width >= NARROWEST_RAD * (1.0 - 1e-9) {
        return Ok(());
    }
    let instead = if at_its_end {
        say!(
            "type {least} or more",
            least = say(from_rad + NARROWEST_RAD)
        )
    } else {
        say!("type {most} or less", most = say(to_rad - NARROWEST_RAD))
    };
    let quarter = rad_from_deg(90.0);
    if width.abs() < SAME_RAD {
        return Err(say!(
            "region {name} would begin and end at {from}; {instead}",
            name,
            from = say(*from_rad),
            instead
        ));
    }
    if width > 0.0 {
        return Err(say!(
            "region {name} would be {width} wide, less than {least}; {instead}",
            name,
            width = say(width),
            least = say(NARROWEST_RAD),
            instead
        ));
    }
    if *from_rad > quarter && *to_rad < -quarter {
        return Err(say!(
            "region {name} would run from {from} over {limit} to {to}; no region does: make two, one to {first} and one from {second}",
            name,
            from = say(*from_rad),
            limit = say(rad_from_deg(180.0)),
            to = say(*to_rad),
            first = say(rad_from_deg(180.0)),
            second = say(rad_from_deg(-180.0))
        ));
    }
    Err(say!(
        "region {name} would begin at {from}, after its end at {to}; {instead}",
        name,
        from = say(*from_rad),
        to = say(*to_rad),
        instead
    ))
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

/// How an angle stands in a field: in the chosen unit, without it.
pub(crate) fn shown(rad: f64, units: Units) -> String {
    match units.angle {
        AngleUnit::Degree => crate::present::numbers::trimmed(deg_from_rad(rad), 2),
        AngleUnit::Radian => crate::present::numbers::trimmed(rad, 4),
        AngleUnit::Milliradian => crate::present::numbers::trimmed(1000.0 * rad, 2),
        AngleUnit::ArcSecond => crate::present::numbers::trimmed(3600.0 * deg_from_rad(rad), 1),
    }
}

#[cfg(test)]
mod tests {
    use crate::sessions::regions::testing::regions;
    use crate::units::rad_from_deg;

    use super::*;

    const WITHIN: (f64, f64) = (-1.6, 1.6);

    #[test]
    fn two_regions_that_touch_share_their_boundary() {
        let all = boundaries(&regions(&[(0.0, 30.0), (30.0, 60.0), (-30.0, 0.0)]));
        let at: Vec<f64> = all.iter().map(|b| deg_from_rad(b.at_rad).round()).collect();
        assert_eq!(at, [-30.0, 0.0, 30.0, 60.0]);
        assert_eq!((all[1].joint.below, all[1].joint.above), (Some(2), Some(0)));
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

    /// Types the end of a region, in degrees, on a joint that reaches from −180° to 180°.
    fn typed_at(
        all: &[(f64, f64)],
        region: usize,
        end: End,
        text: &str,
    ) -> Result<Vec<(f64, f64)>, String> {
        let all = regions(all);
        let units = Units::default();
        let at = angle(text, units)?;
        let within = (rad_from_deg(-180.0), rad_from_deg(180.0));
        let next = placed(&all, joint_at(&all, region, end), at, within, units)?;
        let degrees = |rad: f64| (deg_from_rad(rad) * 1e6).round() / 1e6;
        let pair = |r: &Region| (degrees(r.from_rad), degrees(r.to_rad));
        Ok(next.iter().map(pair).collect())
    }

    const THREE: [(f64, f64); 3] = [(0.0, 30.0), (30.0, 60.0), (70.0, 90.0)];

    #[test]
    fn a_boundary_of_two_regions_moves_both_and_one_beside_a_gap_moves_one() {
        let both = typed_at(&THREE, 0, End::To, "40").expect("there is room");
        assert_eq!(both, [(0.0, 40.0), (40.0, 60.0), (70.0, 90.0)]);
        let one = typed_at(&THREE, 1, End::To, "65,5°").expect("there is room");
        assert_eq!(one, [(0.0, 30.0), (30.0, 65.5), (70.0, 90.0)]);
        let closed = typed_at(&THREE, 1, End::To, "70").expect("there is room");
        assert_eq!(closed[1], (30.0, 70.0));
    }

    #[test]
    fn every_refusal_names_the_region_and_says_what_to_type() {
        let says = |region, end, text| {
            let refused = typed_at(&THREE, region, end, text);
            refused.expect_err("it makes no sense")
        };
        for (region, end, text, parts) in [
            (
                1,
                End::To,
                "75",
                ["region 2 would overlap region 3, 70° … 90°", "at most 70°"],
            ),
            (
                2,
                End::From,
                "50",
                ["region 3 would overlap region 2, 30° … 60°", "at least 60°"],
            ),
            (
                0,
                End::To,
                "65",
                [
                    "region 2 would begin at 65°, after its end at 60°",
                    "59.5° or less",
                ],
            ),
            (
                2,
                End::To,
                "60",
                [
                    "region 3 would begin at 70°, after its end at 60°",
                    "70.5° or more",
                ],
            ),
            (
                0,
                End::To,
                "0",
                ["region 1 would begin and end at 0°", "0.5° or more"],
            ),
            (
                2,
                End::To,
                "70.2",
                ["region 3 would be 0.2° wide", "70.5° or more"],
            ),
            (
                2,
                End::To,
                "200",
                [
                    "200° is outside of the joint's range −180° … 180°",
                    "−160° is the same direction",
                ],
            ),
            (
                2,
                End::To,
                "1e9",
                ["outside of the joint's range", "type an angle in it"],
            ),
            (2, End::To, "-170", ["over 180° to −170°", "make two"]),
            (
                0,
                End::From,
                "NaN",
                ["'NaN' is not an angle", "such as −30"],
            ),
            (
                0,
                End::From,
                "thirty",
                ["'thirty' is not an angle", "a number of degrees"],
            ),
            (0, End::From, " ", ["the angle is missing", "in degrees"]),
            (
                0,
                End::From,
                "inf",
                ["'inf' is not an angle", "a number of degrees"],
            ),
        ] {
            let found = if text == "-170" {
                let far = [(0.0, 100.0), (100.0, 150.0)];
                typed_at(&far, 1, End::To, text).expect_err("it makes no sense")
            } else {
                says(region, end, text)
            };
            for part in parts {
                assert!(found.contains(part), "{text}: {found}");
            }
        }
    }

    #[test]
    fn an_angle_may_be_typed_in_either_unit() {
        let radians = Units {
            angle: AngleUnit::Radian,
            ..Units::default()
        };
        assert_eq!(angle("0.5", radians), Ok(0.5));
        assert_eq!(angle("−0,5 rad", Units::default()), Ok(-0.5));
        assert!(
            (angle("90°", radians).expect("degrees") - 0.5 * std::f64::consts::PI).abs() < 1e-15
        );
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
