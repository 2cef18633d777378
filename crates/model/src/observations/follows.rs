//! The chain rule from targets to rows: with the derivatives of the targets known for all lanes, a column of rows is
//! made at once.
//!
//! Of what turns a joint alone, the rows of the joint's value are made once; each coefficient does that times how
//! much it turns the joint in every sample:
//!
//! ```text
//! ∂row/∂c = (∂row/∂x ∂x/∂θ_j) ∂θ_j/∂c
//! ```

use std::borrow::Cow;

use crate::effects::FixedMask;
use crate::effects::block::Block;
use crate::lanes::{LANES, Lanes, Lanes3, dot};
use crate::wide::{Loop, wide};

use super::Residual;
use super::block::RowBlock;

pub(super) struct Follows {
    /// Of each row by x, y and z.
    pub(super) by: [Lanes3; 3],
    /// What belongs to places: lane, first coefficient, which of them are held.
    pub(super) places: Vec<(usize, usize, FixedMask, Residual)>,
    /// How the rows follow each joint's value.
    by_value: Vec<Lanes3>,
    unit: f64,
}

impl Follows {
    /// For a robot of so many joints, in this unit.
    pub(super) fn new(joints: usize, unit: f64) -> Self {
        Self {
            by: [[[0.0; LANES]; 3]; 3],
            places: Vec::with_capacity(LANES),
            by_value: vec![[[0.0; LANES]; 3]; joints],
            unit,
        }
    }

    pub(super) fn clear(&mut self) {
        self.places.clear();
    }

    /// All columns of the rows, from those of a block of which so many lanes are one observation; `looks` makes of
    /// how its points move what the rows look at.
    pub(super) fn put_all<'b>(
        &mut self,
        rows: &mut RowBlock,
        block: &'b Block,
        of_one: usize,
        looks: impl Fn(&'b Lanes3) -> Cow<'b, Lanes3>,
    ) {
        for place in 0..rows.live.len() {
            let column = rows.live[place];
            if block.is_live(column) {
                self.put(rows, column, &looks(&block.columns[column]), of_one);
            }
        }
        self.put_turning(rows, block, of_one, &looks);
        for (lane, first, held, residual) in &self.places {
            rows.add_place(*lane, *first, *held, residual, self.unit);
        }
    }

    /// A column of the rows where one coefficient moves, or turns, what they look at by so much.
    fn put(&self, rows: &mut RowBlock, column: usize, moved: &Lanes3, of_one: usize) {
        wide(Following {
            by: &self.by,
            moved,
            there: &rows.rows,
            unit: self.unit,
            lanes: LANES / of_one,
            to: &mut rows.columns[column],
        });
    }

    /// Adds what turns joints alone.
    fn put_turning<'b>(
        &mut self,
        rows: &mut RowBlock,
        block: &'b Block,
        of_one: usize,
        looks: &impl Fn(&'b Lanes3) -> Cow<'b, Lanes3>,
    ) {
        let lanes = LANES / of_one;
        for (joint, to) in self.by_value.iter_mut().enumerate() {
            if let Some(moved) = block.by_value(joint) {
                wide(Following {
                    by: &self.by,
                    moved: &looks(moved),
                    there: &rows.rows,
                    unit: self.unit,
                    lanes,
                    to,
                });
            }
        }
        for (column, joint, turned) in block.turning() {
            let mut of_items = [0.0; LANES];
            for (to, turned) in of_items.iter_mut().zip(turned.iter().step_by(of_one)) {
                *to = *turned;
            }
            wide(Turning {
                by_value: &self.by_value[joint],
                turned: &of_items,
                there: &rows.rows,
                lanes,
                to: &mut rows.columns[column],
            });
        }
    }
}

struct Following<'r> {
    by: &'r [Lanes3; 3],
    moved: &'r Lanes3,
    there: &'r [[bool; LANES]; 3],
    unit: f64,
    /// So many are made.
    lanes: usize,
    to: &'r mut Lanes3,
}

impl Loop for Following<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let n = self.lanes.min(LANES);
        let [x, y, z] = self.moved;
        let (x, y, z) = (&x[..n], &y[..n], &z[..n]);
        for ((to, [by_x, by_y, by_z]), there) in self.to.iter_mut().zip(self.by).zip(self.there) {
            let (by_x, by_y, by_z) = (&by_x[..n], &by_y[..n], &by_z[..n]);
            let (to, there) = (&mut to[..n], &there[..n]);
            for lane in 0..n {
                let by = [by_x[lane], by_y[lane], by_z[lane]];
                let value = dot(by, [x[lane], y[lane], z[lane]]) * self.unit;
                to[lane] = if there[lane] { value } else { 0.0 };
            }
        }
    }
}

struct Turning<'r> {
    by_value: &'r Lanes3,
    turned: &'r Lanes,
    there: &'r [[bool; LANES]; 3],
    /// So many are made.
    lanes: usize,
    to: &'r mut Lanes3,
}

impl Loop for Turning<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let n = self.lanes.min(LANES);
        let turned = &self.turned[..n];
        for ((to, by), there) in self.to.iter_mut().zip(self.by_value).zip(self.there) {
            let (to, by, there) = (&mut to[..n], &by[..n], &there[..n]);
            for lane in 0..n {
                let more = by[lane] * turned[lane];
                to[lane] += if there[lane] { more } else { 0.0 };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_has_the_bits_of_its_lanes_one_by_one() {
        let wild = |k: usize| -> Lanes3 {
            std::array::from_fn(|axis| {
                std::array::from_fn(|lane| ((lane * 7 + (3 * k + axis) * 13) as f64 * 0.37).sin())
            })
        };
        let unit = 1.7;
        let mut follows = Follows::new(1, unit);
        follows.by = [wild(0), wild(1), wild(2)];
        let moved = wild(3);
        let mut rows = RowBlock::new(1);
        rows.rows[0] = [true; LANES];
        rows.rows[1] = std::array::from_fn(|lane| lane % 3 == 0);
        // What was there is forgotten.
        rows.columns[0] = wild(4);
        follows.put(&mut rows, 0, &moved, 1);
        for row in 0..3 {
            for lane in 0..LANES {
                let of = |v: &Lanes3| v.map(|axis| axis[lane]);
                let value = dot(of(&follows.by[row]), of(&moved)) * unit;
                let expected = if rows.rows[row][lane] { value } else { 0.0 };
                assert_eq!(rows.columns[0][row][lane], expected);
            }
        }
    }
}
