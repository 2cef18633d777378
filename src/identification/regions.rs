//! Regions of the joint angle: where they come from, and which sample belongs to which.
//!
//! A region owns its inner samples. A sample on a boundary belongs to the region on zero's side,
//! and 0 itself to the first region listed that touches it.

use crate::kinematics::Range;
use crate::sessions::{Region, Session};
use crate::units::{deg_from_rad, rad_from_deg};

/// How the joint's range is divided.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum RegionChoice {
    /// As the session says; six uniform ones where it says nothing.
    #[default]
    FromSession,
    /// So many equal ones over the joint's limits, else over the data's range.
    Uniform(usize),
    /// Between neighbouring boundaries, rad, ascending.
    Boundaries(Vec<f64>),
    /// Exactly these.
    Given(Vec<Region>),
}

/// Why a division makes no sense.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RegionError {
    /// Uniform regions, but none.
    #[error("{0} regions; expected a number from 1 to {MOST_REGIONS}")]
    Number(usize),
    /// Boundaries that do not ascend.
    #[error("region boundaries {0}° and {1}°; expected ascending numbers")]
    NotAscending(String, String),
    /// Boundaries that enclose nothing.
    #[error("{0} region boundary; expected at least two")]
    TooFewBoundaries(usize),
    /// No range to divide.
    #[error(
        "all samples are at the same angle and the joint has no limits: there is no range to divide"
    )]
    NoRange,
}

/// More regions than this are a slip of the keyboard.
pub const MOST_REGIONS: usize = 100_000;
/// Regions where neither session nor operator says otherwise: the paper's number.
const DEFAULT_REGIONS: usize = 6;
/// An angle this close to a boundary is on it, rad.
const ON_BOUNDARY: f64 = 1e-9;

impl RegionChoice {
    /// The regions for a session with one joint.
    pub fn resolve(&self, session: &Session) -> Result<Vec<Region>, RegionError> {
        match self {
            Self::FromSession if session.regions.is_empty() => uniform(session, DEFAULT_REGIONS),
            Self::FromSession => Ok(session.regions.clone()),
            Self::Uniform(number) => uniform(session, *number),
            Self::Boundaries(boundaries) => between(boundaries),
            Self::Given(regions) => Ok(regions.clone()),
        }
    }
}

/// Equal regions over the joint's limits, else over the data's range, named 1…N upwards.
fn uniform(session: &Session, number: usize) -> Result<Vec<Region>, RegionError> {
    if !(1..=MOST_REGIONS).contains(&number) {
        return Err(RegionError::Number(number));
    }
    let range = range_to_divide(session).ok_or(RegionError::NoRange)?;
    // Divided in degrees, so that boundaries at whole degrees come out whole.
    let (from, to) = (deg_from_rad(range.from), deg_from_rad(range.to));
    let boundary = |k: usize| rad_from_deg(from + (to - from) * k as f64 / number as f64);
    between(&(0..=number).map(boundary).collect::<Vec<_>>())
}

/// Limits of the first joint, else the range of its commands.
pub fn range_to_divide(session: &Session) -> Option<Range> {
    if let Some(limits) = session.robot.joints.first()?.limits {
        return Some(limits);
    }
    let q = session.samples.q.first()?.iter().filter(|q| !q.is_nan());
    let (from, to) = q.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
        (a.min(*v), b.max(*v))
    });
    (from < to).then_some(Range { from, to })
}

fn between(boundaries: &[f64]) -> Result<Vec<Region>, RegionError> {
    if boundaries.len() < 2 {
        return Err(RegionError::TooFewBoundaries(boundaries.len()));
    }
    let degrees = |rad: f64| format!("{:.6}", deg_from_rad(rad));
    let pairs = boundaries.windows(2).enumerate();
    pairs
        .map(|(k, pair)| {
            if pair[0] < pair[1] {
                Ok(Region {
                    name: (k + 1).to_string(),
                    from_rad: pair[0],
                    to_rad: pair[1],
                })
            } else {
                Err(RegionError::NotAscending(
                    degrees(pair[0]),
                    degrees(pair[1]),
                ))
            }
        })
        .collect()
}

/// Finds the region of an angle. Regions that follow each other are searched by halving.
#[derive(Debug, Clone)]
pub struct Assignment<'a> {
    regions: &'a [Region],
    /// Regions in ascending order with their place in the list; `None` where they overlap and
    /// have to be tried one by one.
    sorted: Option<Vec<(f64, f64, usize)>>,
}

impl<'a> Assignment<'a> {
    /// Prepares the search.
    pub fn new(regions: &'a [Region]) -> Self {
        let mut sorted: Vec<(f64, f64, usize)> = regions
            .iter()
            .enumerate()
            .map(|(k, r)| (r.from_rad, r.to_rad, k))
            .collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let apart = sorted
            .windows(2)
            .all(|pair| pair[0].1 <= pair[1].0 + ON_BOUNDARY);
        Self {
            regions,
            sorted: apart.then_some(sorted),
        }
    }

    /// Place in the list of the region that owns an angle in rad; `None` outside all regions.
    pub fn region_of(&self, q: f64) -> Option<usize> {
        let Some(sorted) = &self.sorted else {
            return self.one_by_one(q);
        };
        // The first region that ends at or after q, and the one after it: q may be on the
        // boundary between the two.
        let first = sorted.partition_point(|(_, to, _)| *to < q - ON_BOUNDARY);
        let here = |k: usize| {
            let (from, _, place) = sorted.get(k)?;
            (*from <= q + ON_BOUNDARY).then_some(*place)
        };
        match (here(first), here(first + 1)) {
            (Some(below), Some(above)) => Some(self.on_zeros_side(q, below, above)),
            (only, None) | (None, only) => only,
        }
    }

    fn on_zeros_side(&self, q: f64, below: usize, above: usize) -> usize {
        if q.abs() <= ON_BOUNDARY {
            below.min(above)
        } else if q > 0.0 {
            below
        } else {
            above
        }
    }

    /// Inner samples belong to the first region listed that contains them; a boundary counts for
    /// the region on zero's side first.
    fn one_by_one(&self, q: f64) -> Option<usize> {
        let inner = |r: &Region| r.from_rad + ON_BOUNDARY < q && q < r.to_rad - ON_BOUNDARY;
        let touches = |r: &Region| r.from_rad - ON_BOUNDARY <= q && q <= r.to_rad + ON_BOUNDARY;
        let at_zero = q.abs() <= ON_BOUNDARY;
        let towards_zero = |r: &Region| {
            touches(r)
                && (at_zero
                    || if q > 0.0 {
                        r.from_rad < q - ON_BOUNDARY
                    } else {
                        r.to_rad > q + ON_BOUNDARY
                    })
        };
        let find = |test: &dyn Fn(&Region) -> bool| self.regions.iter().position(test);
        find(&inner)
            .or_else(|| find(&towards_zero))
            .or_else(|| find(&touches))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn regions(degrees: &[(f64, f64)]) -> Vec<Region> {
        let make = |(k, (from, to)): (usize, &(f64, f64))| Region {
            name: (k + 1).to_string(),
            from_rad: rad_from_deg(*from),
            to_rad: rad_from_deg(*to),
        };
        degrees.iter().enumerate().map(make).collect()
    }

    fn owner(regions: &[Region], deg: f64) -> Option<usize> {
        Assignment::new(regions).region_of(rad_from_deg(deg))
    }

    #[test]
    fn a_boundary_belongs_to_zeros_side_on_both_sides_of_zero() {
        let r = regions(&[(0.0, 30.0), (30.0, 60.0), (-30.0, 0.0), (-60.0, -30.0)]);
        assert_eq!(owner(&r, 30.0), Some(0));
        assert_eq!(owner(&r, -30.0), Some(2));
        assert_eq!(owner(&r, 60.0), Some(1));
        assert_eq!(owner(&r, -60.0), Some(3));
        assert_eq!(owner(&r, 60.1), None);
    }

    #[test]
    fn zero_belongs_to_the_first_region_listed_that_touches_it() {
        assert_eq!(owner(&regions(&[(0.0, 30.0), (-30.0, 0.0)]), 0.0), Some(0));
        assert_eq!(owner(&regions(&[(-30.0, 0.0), (0.0, 30.0)]), 0.0), Some(0));
    }

    #[test]
    fn a_boundary_without_a_neighbour_belongs_to_the_region_that_touches_it() {
        let r = regions(&[(6.0, 30.0), (36.0, 60.0)]);
        assert_eq!(owner(&r, 6.0), Some(0));
        assert_eq!(owner(&r, 36.0), Some(1));
        assert_eq!(owner(&r, 33.0), None);
    }

    #[test]
    fn overlapping_regions_give_an_angle_to_the_first_listed() {
        let r = regions(&[(0.0, 40.0), (20.0, 60.0)]);
        assert_eq!(owner(&r, 30.0), Some(0));
        assert_eq!(owner(&r, 50.0), Some(1));
        assert_eq!(owner(&r, 40.0), Some(1));
    }
}
