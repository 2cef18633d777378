//! The prediction for an observation, and its residual.

use crate::effects::place::MOST;

/// The prediction for one sample.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    /// Where the target is, measuring frame, mm.
    pub point: [f64; 3],
    /// How the tool is turned: by rows, from the tool's axes to the measuring frame's.
    pub attitude: [[f64; 3]; 3],
    /// The coefficients of the place that the observation refers to, inner units.
    pub place: &'a [f64],
}

/// One observation compared with its prediction.
#[derive(Debug, Clone, Copy)]
pub struct Residual {
    /// Number of rows, 1 to 3.
    pub rows: usize,
    /// Measured − predicted, inner units; as many as there are rows.
    pub left: [f64; 3],
    /// Derivative of the prediction with respect to the point, row by row, per mm.
    pub by_point: [[f64; 3]; 3],
    /// The same with respect to a small turn of the tool about the measuring frame's axes, rad.
    pub by_turn: [[f64; 3]; 3],
    /// The same with respect to the coefficients of the place.
    pub by_place: [[f64; MOST]; 3],
}

impl Residual {
    /// So many rows, everything zero.
    pub(crate) fn new(rows: usize) -> Self {
        Self {
            rows,
            left: [0.0; 3],
            by_point: [[0.0; 3]; 3],
            by_turn: [[0.0; 3]; 3],
            by_place: [[0.0; MOST]; 3],
        }
    }

    /// The length of the residual, inner units.
    pub fn length(&self) -> f64 {
        self.left.iter().map(|v| v * v).sum::<f64>().sqrt()
    }

    /// The rows mixed: each new row is the sum of the old ones times these factors.
    #[must_use]
    pub(crate) fn mixed(&self, by: &[[f64; 3]; 3], rows: usize) -> Self {
        let mut mixed = Self::new(rows);
        for (to, factors) in by.iter().enumerate().take(rows) {
            for (from, factor) in factors.iter().enumerate().take(self.rows) {
                mixed.left[to] += factor * self.left[from];
                for k in 0..3 {
                    mixed.by_point[to][k] += factor * self.by_point[from][k];
                    mixed.by_turn[to][k] += factor * self.by_turn[from][k];
                }
                for k in 0..MOST {
                    mixed.by_place[to][k] += factor * self.by_place[from][k];
                }
            }
        }
        mixed
    }
}
