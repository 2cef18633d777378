//! A block of observations as rows: their residuals, and their derivatives with respect to every coefficient.

use crate::effects::FixedMask;
use crate::effects::place::MOST;
use crate::lanes::{LANES, Lanes, Lanes3};

use super::Residual;

/// Rows of up to `LANES` observations.
pub struct RowBlock {
    /// For each lane its item; `None` for what is no measurement of a sample.
    pub items: Vec<Option<usize>>,
    /// Measured − predicted, in units of the noise times the layer's.
    pub left: Lanes3,
    /// Derivatives of what is predicted, one for each coefficient of the model.
    pub columns: Vec<Lanes3>,
    /// Which of them a fit may move; the others are zero.
    pub(super) live: Vec<usize>,
    /// Which rows there are.
    pub rows: [[bool; LANES]; 3],
    /// The length of the residual in inner units of the kind: mm or rad.
    pub length: Lanes,
    /// The same as mm: an angle times the distance across which it is seen.
    pub length_mm: Lanes,
    /// The residual along x, y, z, mm, for points with all of their coordinates; else NaN.
    pub along: Lanes3,
}

impl RowBlock {
    pub(super) fn new(coefficients: usize) -> Self {
        Self {
            items: Vec::with_capacity(LANES),
            left: [[0.0; LANES]; 3],
            columns: vec![[[0.0; LANES]; 3]; coefficients],
            live: (0..coefficients).collect(),
            rows: [[false; LANES]; 3],
            length: [0.0; LANES],
            length_mm: [0.0; LANES],
            along: [[f64::NAN; LANES]; 3],
        }
    }

    pub(super) fn clear(&mut self) {
        self.items.clear();
        self.left = [[0.0; LANES]; 3];
        self.rows = [[false; LANES]; 3];
        self.columns.fill([[0.0; LANES]; 3]);
    }

    /// Adds what a place's own coefficients do to the rows of a lane.
    pub(super) fn add_place(
        &mut self,
        lane: usize,
        first: usize,
        held: FixedMask,
        residual: &Residual,
        unit: f64,
    ) {
        if self.columns.is_empty() {
            return;
        }
        for k in (0..MOST).filter(|k| !held.contains(*k)) {
            let Some(column) = self.columns.get_mut(first + k) else {
                break;
            };
            for row in 0..residual.rows {
                let by = residual.by_place[row][k];
                if by != 0.0 {
                    column[row][lane] += by * unit;
                }
            }
        }
    }

    /// Takes away the lanes that do not count; a known distance always does.
    pub fn keep(&mut self, used: &[bool]) {
        for (lane, item) in self.items.iter().enumerate() {
            if item.is_none_or(|item| used[item]) {
                continue;
            }
            for axis in 0..3 {
                self.rows[axis][lane] = false;
                self.left[axis][lane] = 0.0;
                for column in &mut self.columns {
                    column[axis][lane] = 0.0;
                }
            }
        }
    }
}
