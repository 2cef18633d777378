//! The answer of a fit: parameters with their intervals, RMS errors, outliers, what is not identifiable.

use nalgebra::DMatrix;

use crate::answers::errors::UnusableReason;
use crate::answers::identification::{
    Estimate, Gap, Identification, LeftOut, NotIdentifiable, Outlier, Quality,
};
use crate::effects::{PlaceKind, Setting};
use crate::model::Model;
use crate::sessions::{Session, Sigma};

use super::gap::{Deviations, Spread, deviations, lengths_mm, suspects};
use super::noise::Noise;
use super::observed;
use super::problem::{Problem, unusable};
use super::regression::Rows;
use super::solver::{Solution, Stopped, spectrum_at};
use super::uncertainty::{estimates, half_width_factor};
use super::unidentifiable::undetermined_combinations;

/// The answer for a model that was fitted elsewhere (the diagnosis does), on a problem whose
/// suspected outliers are already left out.
pub(crate) fn report(
    session: &Session,
    problem: &Problem,
    solution: Solution,
    nominal: &Model,
    mut not_identifiable: Vec<NotIdentifiable>,
) -> Identification {
    let before_mm = lengths_mm(problem, nominal);
    let after = deviations(problem, &solution.model);
    let suspected = suspects(problem, &after);
    let held_out = session.samples.held_out.as_deref();
    let gap_over =
        |counts: &dyn Fn(usize) -> bool| gap(&before_mm, &after.length_mm, counts, &suspected);
    let rank = solution.spectrum.rank();
    let covariance = covariance_of(problem, &solution);
    let own = solution.model.coefficient_count();
    not_identifiable.extend(undetermined_combinations(&solution));
    Identification {
        session: session.name.clone(),
        method: "exact",
        samples: session.samples.len(),
        parameters: parameters_of(problem, &solution, covariance.as_ref()).concat(),
        regions: Vec::new(),
        not_identifiable,
        gap: gap_over(&|i| problem.fit[i]).unwrap_or_default(),
        held_out: held_out.and_then(|h| gap_over(&|i| problem.usable[i] && h[i])),
        levels: Vec::new(),
        expected: None,
        outliers: outliers(&after.length_mm, suspected.iter().copied()),
        left_out: left_out(problem),
        noise_mm: noise_by_axis(problem, &after, rank),
        kinds: observed::figures(problem, nominal, &solution.model),
        noise: noise_with_robot(problem, &solution.model),
        quality: Quality {
            stopped: solution.stopped.describe(),
            converged: matches!(solution.stopped, Stopped::Converged | Stopped::NothingToDo),
            passes: solution.passes,
            coefficients: solution.model.coefficient_count(),
            rank,
            condition: solution.spectrum.condition(),
        },
        notes: Vec::new(),
        model: solution.model,
        covariance: covariance.map(|c| c.view((0, 0), (own, own)).into_owned()),
    }
}

/// The noise of a problem, with the repeatability of the robot.
fn noise_with_robot(problem: &Problem, model: &Model) -> Option<Noise> {
    let noise = problem.noise.clone()?;
    // Of a pose that was measured once its own error cannot be distinguished from what the geometry lacks.
    let shows_robot = noise.joints_rad > 0.0 && problem.inputs.pose.is_some();
    let robot_mm = shows_robot.then(|| Rows::of(problem).seen_by(model).unrepeated_mm(&noise));
    Some(Noise {
        robot_mm: robot_mm.flatten(),
        ..noise
    })
}

fn noise_by_axis(problem: &Problem, after: &Deviations, rank: usize) -> Option<[f64; 3]> {
    if problem.observed.is_some() {
        return None;
    }
    let n = problem.samples();
    let lost = rank as f64 / problem.axes().max(1) as f64;
    let freedom = n as f64 - lost;
    (freedom >= 1.0).then(|| {
        std::array::from_fn(|axis| {
            let used = (0..problem.used.len()).filter(|i| problem.used[*i]);
            let sum: f64 = used.map(|i| after.axes_mm[axis][i].powi(2)).sum();
            (sum / freedom).sqrt()
        })
    })
}

/// Covariance of all coefficients of a solution, those of extra columns last; `None` where as many coordinates as
/// coefficients were measured and the noise is not stated.
pub(crate) fn covariance_of(problem: &Problem, solution: &Solution) -> Option<DMatrix<f64>> {
    let freedom = freedom(problem, solution);
    let variance = if freedom > 0 {
        solution.cost.max(0.0) / freedom as f64
    } else if let Some(layer) = &problem.observed {
        layer.unit_mm * layer.unit_mm
    } else {
        // The weights are those of the noise as it was estimated, or of none.
        let unit = match problem.session.instrument.sigma_mm? {
            Sigma::Overall(sigma) => sigma * sigma,
            Sigma::PerAxis(sigma) => sigma[0] * sigma[0],
        };
        unit * problem.axis_weights[0]
    };
    let own = solution.spectrum.inverse() * variance;
    Some(averaged(problem, solution, freedom).unwrap_or(own))
}

/// With more samples the noise is known well enough to take it as known.
const MOST_TO_AVERAGE: usize = 5000;

/// The covariance averaged over the noises that the residuals allow, each with its size and the solution under it
/// (Bayesian model averaging, Draper 1995): an interval that takes an estimated noise for the true one is too narrow.
///
/// ```text
/// C = Σ_j w_j (C_j + δ_j δ_jᵀ),   δ_j the step from the solution to that under noise j
/// ```
fn averaged(problem: &Problem, solution: &Solution, freedom: usize) -> Option<DMatrix<f64>> {
    let known = problem.noise.as_ref()?;
    let possible = known.possible();
    let alone = possible.len() < 2 && known.slow.is_none();
    if alone || possible.is_empty() || problem.samples() > MOST_TO_AVERAGE || freedom == 0 {
        return None;
    }
    let mut sum: Option<DMatrix<f64>> = None;
    for (share, noise) in possible {
        let mut other = problem.clone();
        other.set_noise(&noise, &solution.model);
        let (spectrum, cost, step) = spectrum_at(&other, solution);
        let variance = cost.max(0.0) / freedom as f64;
        let own = (spectrum.inverse() * variance + &step * step.transpose()) * share;
        sum = Some(sum.map_or(own.clone(), |sum| sum + own));
    }
    sum
}

/// Degrees of freedom, with the priors that are as wide as the robot's own coefficients are large: each of those
/// contributes to the cost as a coordinate does.
fn freedom(problem: &Problem, solution: &Solution) -> usize {
    let rows = problem.rows() + problem.priors.of_its_own(&solution.model);
    rows.saturating_sub(solution.spectrum.rank())
}

/// The parameters of every term of a solution, term by term.
pub(crate) fn parameters_of(
    problem: &Problem,
    solution: &Solution,
    covariance: Option<&DMatrix<f64>>,
) -> Vec<Vec<Estimate>> {
    let factor = match freedom(problem, solution) {
        0 => 1.96,
        freedom => half_width_factor(freedom),
    };
    let mut first = 0;
    let mut all = Vec::new();
    for term in solution.model.terms() {
        let size = term.coefficients.len();
        let own = covariance.map(|c| c.view((first, first), (size, size)).into_owned());
        let deviation = |k: usize| own.as_ref().map_or(0.0, |c| c[(k, k)].sqrt());
        let undetermined: Vec<bool> = (0..size)
            .map(|k| {
                let open = solution.spectrum.is_open(first + k, deviation(k));
                open || term.held.contains(k)
            })
            .collect();
        let kind = solution.model.robot.joints[term.joint].kind;
        let mut own = estimates(term, own.as_ref(), factor, &undetermined, kind);
        if PlaceKind::of(term).is_some_and(|kind| kind != PlaceKind::Plane) {
            // What the session states of a place is no answer.
            let mut k = 0..size;
            own.retain(|_| !k.next().is_some_and(|k| term.held.contains(k)));
        }
        for estimate in &mut own {
            if term.effect.about().setting == Setting::Time && estimate.name == "time_s" {
                estimate.ci95 = times_around(problem, term.setting);
            }
        }
        all.push(own);
        first += size;
    }
    all
}

/// The times of the samples around a step: it can have been anywhere between them.
fn times_around(problem: &Problem, step_s: f64) -> Option<[f64; 2]> {
    let time_s = problem.inputs.time_s.as_deref()?;
    let before = time_s.iter().copied().filter(|t| *t < step_s);
    let after = time_s.iter().copied().filter(|t| *t >= step_s);
    Some([
        before.max_by(f64::total_cmp)?,
        after.min_by(f64::total_cmp)?,
    ])
}

fn gap(
    before_mm: &[f64],
    after_mm: &[f64],
    counts: &dyn Fn(usize) -> bool,
    suspected: &[bool],
) -> Option<Gap> {
    let outlier = |i: usize| suspected[i];
    Some(Gap {
        before: Spread::of(before_mm, counts, outlier)?,
        after: Spread::of(after_mm, counts, outlier)?,
        samples: (0..suspected.len()).filter(|i| counts(*i)).count(),
    })
}

/// The outliers, the farthest first.
pub(crate) fn outliers(after_mm: &[f64], stands_out: impl Iterator<Item = bool>) -> Vec<Outlier> {
    let mut outliers: Vec<Outlier> = stands_out
        .enumerate()
        .filter_map(|(sample, stands_out)| stands_out.then_some(sample))
        .map(|sample| Outlier {
            sample,
            deviation_mm: after_mm[sample],
        })
        .collect();
    outliers.sort_by(|a, b| b.deviation_mm.total_cmp(&a.deviation_mm));
    outliers
}

pub(super) fn left_out(problem: &Problem) -> Vec<LeftOut> {
    let samples = (0..problem.session.samples.len()).filter(|sample| {
        // Of other measurements than points a sample may have no coordinate at all.
        problem.observed.is_none() || !problem.usable[*sample]
    });
    let left_out = samples.filter_map(|sample| {
        let layer = problem.observed.as_ref();
        let unplaced = layer.is_some_and(|layer| layer.unplaced.binary_search(&sample).is_ok());
        let because = match unusable(problem.session, sample) {
            Some(because) if !unplaced => because,
            None if problem.usable[sample] => return None,
            _ => UnusableReason::Unplaced,
        };
        Some(LeftOut { sample, because })
    });
    left_out.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::example::sweep;

    #[test]
    fn the_noise_of_the_axes_is_what_is_left_over_what_the_coefficients_leave_free() {
        let session = sweep([0.0, 0.0, 1.0]);
        let problem = Problem::new(&session, JointValues::Commanded);
        let n = session.samples.len();
        let after = Deviations {
            axes_mm: std::array::from_fn(|axis| vec![0.1 * (axis + 1) as f64; n]),
            length_mm: vec![1.0; n],
        };
        // Nine coefficients take three of each axis.
        let noise = noise_by_axis(&problem, &after, 9).unwrap();
        let share = (n as f64 / (n as f64 - 3.0)).sqrt();
        for (axis, sigma) in noise.into_iter().enumerate() {
            assert!((sigma / (0.1 * (axis + 1) as f64 * share) - 1.0).abs() < 1e-12);
        }
        assert_eq!(noise_by_axis(&problem, &after, 3 * n), None);
    }
}
