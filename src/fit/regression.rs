//! Rows of a regression: one for each measured coordinate of the samples that count, axis by axis,
//! within an axis in measuring order.

use nalgebra::{DMatrix, DVector};

use crate::effects::Inputs;
use crate::model::Model;

use super::problem::Problem;

/// Which samples and axes have rows.
#[derive(Debug, Clone)]
pub struct Rows {
    /// Samples, in measuring order, as indices into the problem.
    pub samples: Vec<usize>,
    /// Measured axes.
    pub axes: Vec<usize>,
    /// When each was measured, s; where the session has no clock, its place in the file.
    pub times: Vec<f64>,
    /// Those samples as the effects take them.
    pub inputs: Inputs<'static>,
    measured_mm: Vec<Vec<f64>>,
}

impl Rows {
    /// The samples of a problem that count.
    pub fn of(problem: &Problem) -> Self {
        let samples: Vec<usize> = (0..problem.used.len())
            .filter(|i| problem.used[*i])
            .collect();
        let axes: Vec<usize> = (0..3).filter(|a| problem.axis_weights[*a] > 0.0).collect();
        let all = &problem.session.samples;
        let measured = |axis: &usize| {
            let column = match axis {
                0 => &all.x_mm[..],
                1 => &all.y_mm[..],
                _ => all.z_mm.as_deref().unwrap_or(&[]),
            };
            samples.iter().map(|i| column[*i]).collect()
        };
        Self {
            measured_mm: axes.iter().map(measured).collect(),
            times: problem.times(&samples),
            inputs: problem.inputs.select(&samples),
            samples,
            axes,
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.samples.len() * self.axes.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Residuals (measured − predicted) and the columns of every coefficient, mm.
    pub fn extract(&self, model: &Model) -> (DVector<f64>, DMatrix<f64>) {
        let n = self.samples.len();
        let mut residual = DVector::zeros(self.len());
        let mut columns = DMatrix::zeros(self.len(), model.coefficient_count());
        model.visit(&self.inputs, true, |start, block| {
            for (a, axis) in self.axes.iter().enumerate() {
                let row = a * n + start;
                for i in 0..block.len {
                    residual[row + i] = self.measured_mm[a][start + i] - block.point[*axis][i];
                }
                for (k, column) in block.columns.iter().enumerate() {
                    let mut own = columns.column_mut(k);
                    own.as_mut_slice()[row..row + block.len]
                        .copy_from_slice(&column[*axis][..block.len]);
                }
            }
        });
        (residual, columns)
    }

    /// Points that the model predicts, in the order of the samples.
    pub fn points(&self, model: &Model) -> Vec<[f64; 3]> {
        let predicted = model.predict(&self.inputs);
        (0..self.samples.len()).map(|i| predicted.get(i)).collect()
    }

    /// A column of one value for each sample along one axis.
    pub fn column(&self, value: impl Fn(usize, usize) -> f64) -> DVector<f64> {
        let n = self.samples.len();
        DVector::from_fn(self.len(), |row, _| value(row % n, self.axes[row / n]))
    }
}
