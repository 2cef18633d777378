//! Rows of a regression: one for each measured coordinate of the samples that count, axis by axis, within an axis in
//! measuring order. Where other things than plain points were measured, rows of observations
//! ([`crate::observations::rows`]) replace the coordinates of samples.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::effects::{EACH_DIRECTION, Inputs, Term};
use crate::model::Model;
use crate::observations::rows::ObservedRows;

use super::levers::{Moves, levers, moving_joints};
use super::noise::Noise;
use super::priors::Priors;
use super::problem::Problem;

/// The standard deviation of a size that no measurement shows, as a ratio: far smaller than the samples show it, and
/// no smaller than a basis can represent.
pub(super) const SIZE: f64 = 1e-4;

/// Which samples and axes have rows.
#[derive(Debug, Clone)]
pub struct Rows<'a> {
    /// Samples, or observations, in measuring order, as indices into what the problem counts.
    pub samples: Vec<usize>,
    /// Measured axes; of observations the rows of the one that has most.
    pub axes: Vec<usize>,
    /// When each was measured, s; where the session has no clock, its place in the file.
    pub times: Vec<f64>,
    /// Those samples as the effects take them.
    pub inputs: Inputs<'static>,
    /// Standard deviation of what rounding to the digit of each coordinate adds, mm.
    pub digits_mm: [f64; 3],
    measured_mm: Vec<Vec<f64>>,
    /// The derivatives of rows with respect to the joints, where a model has been evaluated.
    moves: Option<Arc<Moves>>,
    observed: Option<ObservedRows<'a>>,
}

impl<'a> Rows<'a> {
    /// The rows of a problem that count.
    pub fn of(problem: &Problem<'a>) -> Self {
        if let Some(layer) = &problem.observed {
            let samples: Vec<usize> = (0..layer.used.len()).filter(|i| layer.used[*i]).collect();
            let of_session: Vec<usize> = samples.iter().map(|i| layer.items[*i].sample).collect();
            let rows = ObservedRows::new(layer, &layer.used);
            return Self {
                axes: (0..rows.width).collect(),
                times: problem.times(&of_session),
                inputs: problem.inputs.select(&of_session),
                digits_mm: [0.0; 3],
                measured_mm: Vec::new(),
                moves: None,
                samples,
                observed: Some(rows),
            };
        }
        let samples = (0..problem.used.len()).filter(|i| problem.used[*i]);
        Self::of_samples(problem, samples.collect())
    }

    /// Some samples of a problem of plain points.
    pub(crate) fn of_samples(problem: &Problem<'a>, mut samples: Vec<usize>) -> Self {
        problem.in_measuring_order(&mut samples);
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
            digits_mm: problem.digits_mm,
            samples,
            axes,
            moves: None,
            observed: None,
        }
    }

    /// Rows of some samples, one for each; what they are of is up to the caller.
    pub(crate) fn of_one_axis(&self, samples: &[usize]) -> Rows<'static> {
        Rows {
            moves: None,
            samples: samples.to_vec(),
            axes: vec![0],
            times: samples.iter().map(|k| self.times[*k]).collect(),
            inputs: self.inputs.select(samples),
            digits_mm: [0.0; 3],
            measured_mm: Vec::new(),
            observed: None,
        }
    }

    /// The same with the lengths of angles, and of what the joints move, as a model has them.
    #[must_use]
    pub fn seen_by(mut self, model: &Model) -> Self {
        if let Some(rows) = &mut self.observed {
            rows.see_by(model);
        }
        if self.inputs.pose.is_some() || model.robot.joints.len() > 1 {
            let columns = self.extract(&moving_joints(model)).1;
            let each = || (0..).take(self.samples.len()).collect();
            self.moves = Some(Arc::new(Moves {
                poses: self.inputs.pose.clone().unwrap_or_else(each),
                levers: levers(&columns, model),
            }));
        }
        self
    }

    /// The pose of each sample, and the derivatives of the rows with respect to the joints; `None` where no model has
    /// been evaluated, or of a single joint that was at every sample elsewhere: there that is noise along one axis.
    pub(super) fn moves(&self) -> Option<&Moves> {
        self.moves.as_deref()
    }

    /// RMS length of the error of repeatability by a noise, mm; `None` where it has none.
    pub(crate) fn unrepeated_mm(&self, noise: &Noise) -> Option<f64> {
        let levers = &self.moves().filter(|_| noise.joints_rad > 0.0)?.levers;
        let each = levers.row_iter().enumerate();
        let square: f64 = each
            .map(|(row, lever)| self.mm(row).powi(2) * lever.norm_squared())
            .sum();
        Some(noise.joints_rad * (square / self.lengths().max(1) as f64).sqrt())
    }

    /// The observations, where more than plain points was measured.
    pub fn observed(&self) -> Option<&ObservedRows<'a>> {
        self.observed.as_ref()
    }

    /// Number of rows that were measured: an observation may have fewer than others.
    pub fn count(&self) -> usize {
        let observed = self.observed.as_ref();
        observed.map_or_else(|| self.len(), ObservedRows::count)
    }

    /// Whether this row was measured.
    pub fn has(&self, row: usize) -> bool {
        self.observed.as_ref().is_none_or(|rows| rows.has(row))
    }

    /// mm of one unit of a row; zero where another row gives the length of its sample.
    pub fn mm(&self, row: usize) -> f64 {
        self.observed.as_ref().map_or(1.0, |rows| rows.mm(row))
    }

    /// Number of samples that have a length.
    pub fn lengths(&self) -> usize {
        let observed = self.observed.as_ref();
        observed.map_or(self.samples.len(), ObservedRows::samples)
    }

    /// Root mean square length of deviations, mm.
    pub fn rms_mm(&self, e: &DVector<f64>) -> f64 {
        let square = match &self.observed {
            None => e.norm_squared(),
            Some(rows) => {
                let own = e.iter().enumerate();
                own.map(|(row, e)| (rows.mm(row) * e).powi(2)).sum()
            }
        };
        (square / self.lengths().max(1) as f64).sqrt()
    }

    /// RMS length of the residuals by noise alone where other things than plain points were measured, mm.
    pub fn noise_mm(&self, noise: &Noise) -> Option<f64> {
        let rows = self.observed.as_ref()?;
        Some(rows.noise_mm(noise.sigma_mm[0]))
    }

    /// Priors of the places and sizes of a model, in units of σ: distances between sockets, and an overall size that
    /// no measurement shows.
    pub fn prior_rows(&self, model: &Model, priors: &Priors) -> (DVector<f64>, DMatrix<f64>) {
        let Some(rows) = &self.observed else {
            return (DVector::zeros(0), DMatrix::zeros(0, 0));
        };
        let (mut residual, mut columns) = rows.known_distances(model);
        if !priors.size.is_empty() {
            let last = residual.len();
            let size = DVector::from_vec(priors.size_row(model)) / SIZE;
            let prior_residual = -size.dot(&DVector::from_vec(model.coefficients()));
            residual = residual.insert_row(last, prior_residual);
            columns = columns.insert_row(last, 0.0);
            columns.row_mut(last).copy_from(&size.transpose());
        }
        (residual, columns)
    }

    /// The same as [`extract`](Self::extract), with the rows of those priors behind: of sockets and touches a robot
    /// that shrinks would always fit better.
    pub fn extract_with_known(
        &self,
        model: &Model,
        priors: &Priors,
    ) -> (DVector<f64>, DMatrix<f64>) {
        let (residual, columns) = self.extract(model);
        let Some(rows) = &self.observed else {
            return (residual, columns);
        };
        let unit = rows.layer().unit_mm;
        let (prior_residual, known) = self.prior_rows(model, priors);
        let (m, more) = (self.len(), prior_residual.len());
        let mut residual = residual.resize_vertically(m + more, 0.0);
        let mut columns = columns.resize_vertically(m + more, 0.0);
        residual
            .rows_mut(m, more)
            .copy_from(&(prior_residual * unit));
        columns.rows_mut(m, more).copy_from(&(known * unit));
        (residual, columns)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.samples.len() * self.axes.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Residuals (measured − predicted) and the columns of every coefficient, mm, or in the unit of
    /// the observations.
    pub fn extract(&self, model: &Model) -> (DVector<f64>, DMatrix<f64>) {
        if let Some(rows) = &self.observed {
            return rows.extract(model);
        }
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

    /// The residuals of [`extract`](Self::extract) alone.
    pub fn residual(&self, model: &Model) -> DVector<f64> {
        if let Some(rows) = &self.observed {
            return rows.residual(model);
        }
        let n = self.samples.len();
        let mut residual = DVector::zeros(self.len());
        model.visit(&self.inputs, false, |start, block| {
            for (a, axis) in self.axes.iter().enumerate() {
                let row = a * n + start;
                for i in 0..block.len {
                    residual[row + i] = self.measured_mm[a][start + i] - block.point[*axis][i];
                }
            }
        });
        residual
    }

    /// Points that the model predicts, in the order of the samples.
    pub fn points(&self, model: &Model) -> Vec<[f64; 3]> {
        let predicted = model.predict(&self.inputs);
        (0..self.samples.len()).map(|i| predicted.get(i)).collect()
    }

    /// The derivatives of the rows with respect to each of the [moves](crate::effects::rest::MOVES) of a joint's link.
    pub fn moves_of(&self, model: &Model, joint: usize) -> Vec<DVector<f64>> {
        let probe = Term::absent(&EACH_DIRECTION, joint, 0.0);
        let with = model.with_term(probe.clone());
        let (_, all) = self.extract(&with);
        let columns = with.columns().enumerate();
        let own = columns.filter(|(_, (term, _))| term.same_column(&probe));
        own.map(|(k, _)| all.column(k).into_owned()).collect()
    }

    /// The change of the rows by displaced targets, each by so many mm along x, y, z.
    pub fn displaced(&self, model: &Model, by: impl Fn(usize) -> [f64; 3]) -> DVector<f64> {
        match &self.observed {
            Some(rows) => rows.displaced(model, by),
            None => self.column(|sample, axis| by(sample)[axis]),
        }
    }

    /// A column of one value for each sample along one axis.
    pub fn column(&self, value: impl Fn(usize, usize) -> f64) -> DVector<f64> {
        let n = self.samples.len();
        DVector::from_fn(self.len(), |row, _| value(row % n, self.axes[row / n]))
    }
}
