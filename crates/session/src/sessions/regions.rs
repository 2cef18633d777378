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
    /// Their places in the list by their lower ends.
    sorted: Vec<usize>,
    /// Whether none overlaps another: then two at most touch an angle.
    apart: bool,
}

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
            sorted,
            apart,
        }
    }

    /// Place in the list of the region that owns an angle in rad; `None` outside all regions: of those that it is
    /// inside of, else of those on whose boundary it is on zero's side, else of those that it touches, the first.
    pub fn region_of(&self, q: f64) -> Option<usize> {
        let begins = |k: &usize| self.regions[*k].from_rad - ON_BOUNDARY <= q;
        let near = &self.sorted[..self.sorted.partition_point(begins)];
        let near = &near[near
            .len()
            .saturating_sub(if self.apart { 2 } else { near.len() })..];
        let owned = near.iter().filter_map(|&k| {
            let [from, to] = [self.regions[k].from_rad, self.regions[k].to_rad];
            let inner = from + ON_BOUNDARY < q && q < to - ON_BOUNDARY;
            let inwards = if q > 0.0 {
                from < q - ON_BOUNDARY
            } else {
                to > q + ON_BOUNDARY
            };
            let rank = match (inner, inwards || q.abs() <= ON_BOUNDARY) {
                (true, _) => 0,
                (_, true) => 1,
                _ => 2,
            };
            (q <= to + ON_BOUNDARY).then_some((rank, k))
        });
        owned.min().map(|(_, k)| k)
    }

    /// The regions of a block of angles; the number of regions stands for none.
    pub fn regions_of(&self, q: &Lanes, to: &mut [usize; LANES]) {
        *to = q.map(|q| self.region_of(q).unwrap_or(self.regions.len()));
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
