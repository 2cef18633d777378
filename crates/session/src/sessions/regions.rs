//! Which region an angle belongs to.
//!
//! A region owns its inner samples. A sample on a boundary belongs to the region on zero's side,
//! and 0 itself to the first region listed that touches it.

use crate::lanes::{LANES, Lanes};

use super::Region;

/// An angle this close to a boundary is on it, rad.
const ON_BOUNDARY: f64 = 1e-9;

/// Finds the region of an angle.
#[derive(Debug, Clone)]
pub struct Assignment<'a> {
    regions: &'a [Region],
    /// Where regions do not overlap: the angle's place between the thresholds tells its region.
    slots: Option<Slots>,
}

/// The line of angles cut at thresholds; slot k lies above k of them. Who owns a boundary has
/// gone into the thresholds, so that finding a slot is nothing but counting.
#[derive(Debug, Clone)]
struct Slots {
    thresholds: Vec<f64>,
    /// Place in the list of the region of each slot, or [`NO_REGION`].
    owners: Vec<usize>,
}

/// Stands for angles outside all regions.
const NO_REGION: usize = usize::MAX;
/// Counting beats halving up to about so many thresholds.
const FEW_THRESHOLDS: usize = 24;

impl<'a> Assignment<'a> {
    /// Prepares the search.
    pub fn new(regions: &'a [Region]) -> Self {
        let mut sorted: Vec<usize> = (0..regions.len()).collect();
        sorted.sort_by(|a, b| regions[*a].from_rad.total_cmp(&regions[*b].from_rad));
        let apart = sorted
            .windows(2)
            .all(|pair| regions[pair[0]].to_rad <= regions[pair[1]].from_rad + ON_BOUNDARY);
        Self {
            regions,
            slots: apart.then(|| Slots::new(regions, &sorted)),
        }
    }

    /// Place in the list of the region that owns an angle in rad; `None` outside all regions.
    pub fn region_of(&self, q: f64) -> Option<usize> {
        let Some(slots) = &self.slots else {
            return self.one_by_one(q);
        };
        let owner = slots.owners[slots.thresholds.partition_point(|t| q > *t)];
        (owner != NO_REGION).then_some(owner)
    }

    /// The regions of a block of angles; the number of regions stands for none.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a part of a wide loop")]
    pub fn regions_of(&self, q: &Lanes, to: &mut [usize; LANES]) {
        match &self.slots {
            Some(slots) if slots.thresholds.len() <= FEW_THRESHOLDS => {
                let mut above = [0_usize; LANES];
                for threshold in &slots.thresholds {
                    for (count, q) in above.iter_mut().zip(q) {
                        *count += usize::from(*q > *threshold);
                    }
                }
                for (to, count) in to.iter_mut().zip(above) {
                    *to = slots.owners[count].min(self.regions.len());
                }
            }
            _ => {
                for (to, q) in to.iter_mut().zip(q) {
                    *to = self.region_of(*q).unwrap_or(self.regions.len());
                }
            }
        }
    }

    /// Inner samples belong to the first region listed that contains them; a boundary counts for
    /// the region on zero's side first.
    fn one_by_one(&self, q: f64) -> Option<usize> {
        let inner = |r: &Region| r.from_rad + ON_BOUNDARY < q && q < r.to_rad - ON_BOUNDARY;
        let touches = |r: &Region| r.from_rad - ON_BOUNDARY <= q && q <= r.to_rad + ON_BOUNDARY;
        let at_zero = q.abs() <= ON_BOUNDARY;
        let reaches_to_zero = |r: &Region| {
            let inwards = if q > 0.0 {
                r.from_rad < q - ON_BOUNDARY
            } else {
                r.to_rad > q + ON_BOUNDARY
            };
            touches(r) && (at_zero || inwards)
        };
        let find = |test: &dyn Fn(&Region) -> bool| self.regions.iter().position(test);
        find(&inner)
            .or_else(|| find(&reaches_to_zero))
            .or_else(|| find(&touches))
    }
}

impl Slots {
    fn new(regions: &[Region], sorted: &[usize]) -> Self {
        let mut thresholds = Vec::new();
        let mut owners = vec![NO_REGION];
        let mut cut = |threshold: f64, owner: usize| {
            thresholds.push(threshold);
            owners.push(owner);
        };
        for (k, &place) in sorted.iter().enumerate() {
            let region = &regions[place];
            let next = sorted.get(k + 1).copied();
            let joined = next.filter(|n| regions[*n].from_rad <= region.to_rad + ON_BOUNDARY);
            let follows = k > 0 && regions[sorted[k - 1]].to_rad + ON_BOUNDARY >= region.from_rad;
            if !follows {
                cut(region.from_rad - ON_BOUNDARY, place);
            }
            match joined {
                None => cut(region.to_rad + ON_BOUNDARY, NO_REGION),
                Some(next) => {
                    let boundary = region.to_rad;
                    let below_owns = if boundary.abs() <= ON_BOUNDARY {
                        place < next
                    } else {
                        boundary > 0.0
                    };
                    let side = if below_owns {
                        ON_BOUNDARY
                    } else {
                        -ON_BOUNDARY
                    };
                    cut(boundary + side, next);
                }
            }
        }
        Self { thresholds, owners }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::rad_from_deg;

    /// Regions from and to these degrees, named 1, 2, … in this order.
    fn regions(degrees: &[(f64, f64)]) -> Vec<Region> {
        let make = |(k, (from, to)): (usize, &(f64, f64))| Region {
            name: (k + 1).to_string(),
            from_rad: rad_from_deg(*from),
            to_rad: rad_from_deg(*to),
        };
        degrees.iter().enumerate().map(make).collect()
    }

    /// Asked one by one and by the block, which have to agree.
    fn owner(regions: &[Region], deg: f64) -> Option<usize> {
        let assignment = Assignment::new(regions);
        let alone = assignment.region_of(rad_from_deg(deg));
        let mut of_block = [0; LANES];
        assignment.regions_of(&[rad_from_deg(deg); LANES], &mut of_block);
        assert_eq!(of_block[7], alone.unwrap_or(regions.len()));
        alone
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
