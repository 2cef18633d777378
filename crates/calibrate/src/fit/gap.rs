//! The residuals of a model: the deviations e = measured − predicted, in mm, over three coordinates (two in a planar
//! session), and which of them are suspected outliers. Their RMS error is defined in `answers::rms_error`.

use nalgebra::{DMatrix, DVector};

pub use crate::answers::errors::Spread;
use crate::lanes::LANES;
use crate::model::Model;
use crate::observations::figures;
pub use crate::observations::figures::Deviations;
use crate::observations::outliers::{as_if_seen, suspected};

use super::problem::Problem;

/// With fewer samples the axes are taken as stated.
const FEWEST_TO_BALANCE: usize = 30;

/// Deviations of a session's samples from a model.
pub fn deviations(problem: &Problem, model: &Model) -> Deviations {
    if let Some(layer) = &problem.observed {
        return figures::deviations(layer, model);
    }
    let mut residuals = Deviations::default();
    deviations_again(problem, model, &mut residuals);
    residuals
}

/// The same in the memory of earlier ones: of a long session that is most of the work.
pub(crate) fn deviations_again(problem: &Problem, model: &Model, residuals: &mut Deviations) {
    if problem.observed.is_some() {
        *residuals = deviations(problem, model);
        return;
    }
    for column in residuals
        .axes_mm
        .iter_mut()
        .chain([&mut residuals.length_mm])
    {
        column.clear();
        column.reserve_exact(problem.inputs.len());
    }
    each_block(problem, model, |axes, length| {
        for (all, own) in residuals.axes_mm.iter_mut().zip(axes) {
            all.extend_from_slice(own);
        }
        residuals.length_mm.extend_from_slice(length);
    });
}

/// The lengths of the deviations alone: of a long session the axes are three times as much.
pub(crate) fn lengths_mm(problem: &Problem, model: &Model) -> Vec<f64> {
    if let Some(layer) = &problem.observed {
        return figures::deviations(layer, model).length_mm;
    }
    let mut lengths = Vec::with_capacity(problem.inputs.len());
    each_block(problem, model, |_, length| {
        lengths.extend_from_slice(length);
    });
    lengths
}

/// Gives the deviations of plain points along the axes and their lengths, block by block.
fn each_block(problem: &Problem, model: &Model, mut take: impl FnMut([&[f64]; 3], &[f64])) {
    let samples = &problem.session.samples;
    let measured = [
        Some(&samples.x_mm),
        Some(&samples.y_mm),
        samples.z_mm.as_ref(),
    ];
    model.visit(&problem.inputs, false, |start, block| {
        let rows = start..start + block.len;
        let usable = &problem.usable[rows.clone()];
        let mut axes = [[0.0; LANES]; 3];
        for ((own, measured), point) in axes.iter_mut().zip(measured).zip(&block.point) {
            match measured {
                Some(measured) => {
                    for ((e, measured), point) in
                        own.iter_mut().zip(&measured[rows.clone()]).zip(point)
                    {
                        *e = measured - point;
                    }
                }
                None => own.fill(0.0),
            }
            for (e, usable) in own.iter_mut().zip(usable) {
                *e = if *usable { *e } else { f64::NAN };
            }
        }
        // In a plane the third is zero, or missing like the others.
        let mut length = [0.0; LANES];
        for (i, length) in length.iter_mut().enumerate() {
            let [x, y, z] = [axes[0][i], axes[1][i], axes[2][i]];
            *length = (x * x + y * y + z * z).sqrt();
        }
        let len = block.len;
        take(
            [&axes[0][..len], &axes[1][..len], &axes[2][..len]],
            &length[..len],
        );
    });
}

/// Which samples there were to fit and are set aside: of one that was measured in several ways any of them.
pub(crate) fn set_aside(problem: &Problem) -> Vec<bool> {
    let samples = problem.fit.iter().zip(&problem.used);
    let plain = || samples.map(|(fit, used)| *fit && !used).collect();
    let layer = problem.observed.as_ref();
    layer.map_or_else(plain, |layer| layer.samples_with(&layer.suspected))
}

/// RMS error and largest of some lengths over the samples that are fitted.
pub(crate) fn over_fitted(problem: &Problem, lengths_mm: &[f64]) -> Option<Spread> {
    let apart = set_aside(problem);
    Spread::of(lengths_mm, |i| problem.fit[i], |i| apart[i])
}

/// RMS error of a model over the samples that are fitted, without suspected outliers, mm.
pub(crate) fn rms_mm(problem: &Problem, model: &Model) -> f64 {
    over_fitted(problem, &lengths_mm(problem, model)).map_or(0.0, |s| s.rms_mm)
}

/// Like [`suspects`] for the samples that a fit of so many coefficients left out: their deviations are corrected for
/// not being fitted. `covariance` is that of the model's coefficients.
pub(crate) fn suspects_given(
    problem: &Problem,
    deviations: &mut Deviations,
    model: &Model,
    rank: usize,
    covariance: impl FnOnce() -> DMatrix<f64>,
) -> Vec<bool> {
    let used = problem.used.iter().filter(|used| **used).count();
    if problem.session.robot.joints.len() > 1 && used < problem.used.len() {
        let axes = problem.axis_weights.iter().filter(|w| **w > 0.0).count();
        for (sample, leverage) in leverages_of_unseen(problem, model, &covariance()) {
            let factor = as_if_seen(rank, axes * used, leverage / axes as f64);
            for axis in &mut deviations.axes_mm {
                axis[sample] *= factor;
            }
        }
    }
    suspects(problem, deviations)
}

/// Of every usable sample that does not count how much the fit's own error adds to the square of its deviation, in
/// units of the noise: `tr(J C Jᵀ)`. Block by block: of a long session many are held out.
fn leverages_of_unseen(
    problem: &Problem,
    model: &Model,
    covariance: &DMatrix<f64>,
) -> Vec<(usize, f64)> {
    let is_unseen = |i: &usize| problem.usable[*i] && !problem.used[*i];
    let unseen: Vec<usize> = (0..problem.used.len()).filter(is_unseen).collect();
    let mut leverages = Vec::with_capacity(unseen.len());
    let mut row = DVector::zeros(model.coefficient_count());
    model.visit(&problem.inputs.select(&unseen), true, |start, block| {
        for lane in 0..block.len {
            let mut sum = 0.0;
            for (axis, weight) in problem.axis_weights.iter().enumerate() {
                for (value, column) in row.iter_mut().zip(&block.columns) {
                    *value = column[axis][lane];
                }
                sum += weight * row.dot(&(covariance * &row));
            }
            leverages.push((unseen[start + lane], sum));
        }
    });
    leverages
}

/// Marks the samples of the problem that are suspected; held-out ones are judged as well, and do
/// not count in the bulk.
pub(crate) fn suspects(problem: &Problem, deviations: &Deviations) -> Vec<bool> {
    if let Some(layer) = &problem.observed {
        // Every kind was compared with its own bulk while it was fitted.
        return layer.samples_with(&layer.suspected);
    }
    let axes: Vec<usize> = (0..3).filter(|a| problem.axis_weights[*a] > 0.0).collect();
    let all: Vec<&[f64]> = axes.iter().map(|a| &deviations.axes_mm[*a][..]).collect();
    let balanced = problem.samples() >= FEWEST_TO_BALANCE;
    let stated = problem.axis_weights;
    let sigma: Vec<f64> = axes.iter().map(|a| 1.0 / stated[*a].sqrt()).collect();
    suspected(&all, &problem.fit, &sigma, balanced)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::base_model;
    use crate::fit::example::unrepeated;
    use crate::fit::regression::Rows;
    use crate::fit::solver::covariance_at;

    /// By dense least squares: J (J₁ᵀ W J₁)⁻¹ Jᵀ W of the rows that it left out.
    #[test]
    fn leverages_of_unseen_samples_are_those_of_the_dense_rows() {
        let session = unrepeated(0.0, 2);
        let mut problem = Problem::observing(&session, JointValues::Commanded);
        problem.axis_weights = [1.0, 4.0, 9.0];
        problem.used[7] = false;
        problem.used[100] = false;
        let start = base_model::start(&session, &problem, |_| true);
        // Coefficients that the rows determine.
        let model = start.without(|term| term.effect.about().id != "joint-zero-offset");
        let of = |samples: Vec<usize>| {
            let rows = Rows::of_samples(&problem, samples);
            let columns = rows.extract(&model).1;
            let n = rows.samples.len();
            DMatrix::from_fn(columns.nrows(), columns.ncols(), |i, k| {
                columns[(i, k)] * problem.axis_weights[i / n].sqrt()
            })
        };
        let seen = of((0..180).filter(|i| problem.used[*i]).collect());
        let inverse = (seen.transpose() * &seen).try_inverse().unwrap();
        let found = leverages_of_unseen(&problem, &model, &covariance_at(&problem, &model));
        assert_eq!(found.len(), 2);
        for (sample, leverage) in found {
            let own = of(vec![sample]);
            let dense = (&own * &inverse * own.transpose()).trace();
            assert!(
                dense > 1e-3 && (leverage - dense).abs() < 1e-9,
                "{leverage} {dense}"
            );
        }
    }
}
