//! The exact identification: nonlinear least squares in the measuring frame, for any effects.
//!
//! Suspected outliers are found by fitting, looking at what is far off, and fitting again without
//! it until nothing changes. Where the instrument's noise is given as one number the ratio
//! between the axes is taken from the residuals.

use nalgebra::DMatrix;

use crate::effects::{
    CATALOGUE, Effect, Inputs, JointValues, MeasuringFrame, Setting, Survey, Term, find,
};
use crate::model::Model;
use crate::sessions::{Session, Sigma};

use super::IdentifyError;
use super::gap::{Deviations, Spread, deviations};
use super::outcome::{Estimate, Gap, Identification, LeftOut, NotIdentifiable, Outlier, Quality};
use super::problem::{Problem, unusable};
use super::robust::suspects;
use super::solver::{Solution, Stopped, solve};
use super::uncertainty::{estimates, half_width_factor};
use super::{alignment, scan};

/// The effects that every calibration identifies.
pub const DEFAULT_EFFECTS: [&str; 2] = ["joint-zero-offset", "link-length"];

/// How often samples are looked through for outliers.
const MOST_ROUNDS: usize = 10;

/// Fits the named effects, each on every joint where it can be tested.
pub fn identify_exact(
    session: &Session,
    effects: &[String],
    values: JointValues,
) -> Result<Identification, IdentifyError> {
    let mut problem = Problem::new(session, values);
    if problem.samples() == 0 {
        return Err(IdentifyError::NothingToFit);
    }
    let survey = Survey::new(session, &problem.inputs);
    let mut not_identifiable = Vec::new();
    let mut terms = Vec::new();
    for id in effects {
        let effect = find(id).ok_or_else(|| IdentifyError::UnknownEffect(id.clone()))?;
        for (joint, obstacle) in places(effect, &survey) {
            match obstacle {
                Some(because) => not_identifiable.push(NotIdentifiable {
                    combination: name_on_joint(effect, joint, session),
                    because,
                }),
                None => terms.push(Term::absent(effect, joint, 0.0)),
            }
        }
    }
    terms.extend(free_frames(session, &problem));
    let nominal = Model::nominal(session.robot.clone());
    let start = scan::with_best_settings(&problem, &nominal, terms);
    let fitted = fit_without_outliers(&mut problem, &start);
    Ok(report(
        session,
        &problem,
        fitted,
        &nominal,
        not_identifiable,
    ))
}

/// The answer for a model that was fitted elsewhere (the diagnosis does), on a problem whose
/// suspected outliers are already left out.
pub fn report(
    session: &Session,
    problem: &Problem,
    solution: Solution,
    nominal: &Model,
    mut not_identifiable: Vec<NotIdentifiable>,
) -> Identification {
    let before = deviations(problem, nominal);
    let after = deviations(problem, &solution.model);
    let suspected = suspects(problem, &after);
    let held_out = session.samples.held_out.as_deref();
    let gap_over = |counts: &dyn Fn(usize) -> bool| gap(&before, &after, counts, &suspected);
    let m = problem.samples() * problem.axes();
    let rank = solution.spectrum.rank();
    let freedom = m.saturating_sub(rank);
    let covariance = covariance(session, &solution, freedom);
    let factor = if freedom > 0 {
        half_width_factor(freedom)
    } else {
        1.96
    };
    let names = coefficient_names(&solution.model, session);
    not_identifiable.extend(null_combinations(&solution, &names));
    Identification {
        session: session.name.clone(),
        method: "exact",
        samples: session.samples.len(),
        parameters: parameters(&solution, covariance.as_ref(), factor),
        regions: Vec::new(),
        not_identifiable,
        gap: gap_over(&|i| problem.fit[i]).unwrap_or(Gap {
            before: Spread {
                rms_mm: 0.0,
                max_mm: 0.0,
            },
            after: Spread {
                rms_mm: 0.0,
                max_mm: 0.0,
            },
            samples: 0,
        }),
        held_out: held_out.and_then(|h| gap_over(&|i| problem.usable[i] && h[i])),
        outliers: outliers(&after, &suspected),
        left_out: left_out(session),
        noise_mm: noise_by_axis(problem, &after, rank),
        quality: Quality {
            stopped: solution.stopped.says(),
            converged: matches!(solution.stopped, Stopped::Converged | Stopped::NothingToDo),
            passes: solution.passes,
            coefficients: solution.model.coefficient_count(),
            rank,
            condition: solution.spectrum.condition(),
        },
        notes: Vec::new(),
        model: solution.model,
        covariance,
    }
}

/// Fits, leaves out what is far off, and fits again until the same samples stay out.
pub fn fit_without_outliers(problem: &mut Problem, start: &Model) -> Solution {
    let mut solution = solve(problem, start);
    for round in 0..MOST_ROUNDS {
        let after = deviations(problem, &solution.model);
        let suspected = suspects(problem, &after);
        let used: Vec<bool> = problem
            .fit
            .iter()
            .zip(&suspected)
            .map(|(f, s)| *f && !*s)
            .collect();
        let weights = balanced_weights(problem, &after, solution.spectrum.rank());
        let settled = used == problem.used && (weights == problem.axis_weights || round >= 2);
        if settled {
            break;
        }
        problem.used = used;
        if round < 2 {
            problem.axis_weights = weights;
        }
        solution = solve(problem, &solution.model);
    }
    solution
}

fn places(effect: &dyn Effect, survey: &Survey) -> Vec<(usize, Option<String>)> {
    let joints = if effect.about().per_joint {
        survey.joints.len()
    } else {
        1
    };
    (0..joints)
        .map(|joint| (joint, effect.obstacle(survey, joint)))
        .collect()
}

fn name_on_joint(effect: &dyn Effect, joint: usize, session: &Session) -> String {
    let id = effect.about().id;
    if effect.about().per_joint && session.robot.joints.len() > 1 {
        format!("{id} of joint {}", joint + 1)
    } else {
        id.to_owned()
    }
}

/// One free measuring frame per setup, started from the best rigid fit.
pub(crate) fn free_frames(session: &Session, problem: &Problem) -> Vec<Term> {
    let Some(setups) = &session.samples.setups else {
        return Vec::new();
    };
    let nominal = Model::nominal(session.robot.clone());
    let predicted = nominal.predict(&problem.inputs);
    (0..setups.names.len())
        .map(|setup| {
            let in_setup = |i: usize| problem.used[i] && setups.index[i] as usize == setup;
            let mut term = Term::absent(&MeasuringFrame, 0, setup as f64);
            if let Some(frame) = alignment::best_rigid_motion(session, &predicted, in_setup) {
                let rotation = frame.rotation.scaled_axis();
                let shift = frame.translation.vector;
                term.coefficients = [rotation.as_slice(), shift.as_slice()].concat();
            }
            term
        })
        .collect()
}

/// Weights 1/σ² of the axes, up to a common factor: those of the instrument where it gives one
/// for each axis, else those that the residuals show. A ratio beyond [`MOST_UNEQUAL`] is not
/// noise but something that the model lacks.
fn balanced_weights(problem: &Problem, after: &Deviations, rank: usize) -> [f64; 3] {
    let given = matches!(problem.session.instrument.sigma_mm, Some(Sigma::PerAxis(_)));
    let noise = noise_by_axis(problem, after, rank);
    let (false, Some(noise)) = (given, noise) else {
        return problem.axis_weights;
    };
    let measured: Vec<f64> = (0..3)
        .filter(|axis| problem.axis_weights[*axis] > 0.0)
        .map(|axis| noise[axis])
        .collect();
    let largest = measured.iter().copied().fold(0.0, f64::max);
    // Without noise there is nothing to balance.
    if largest < 1e-9 || problem.samples() < FEWEST_TO_BALANCE {
        return problem.axis_weights;
    }
    std::array::from_fn(|axis| {
        if problem.axis_weights[axis] == 0.0 {
            return 0.0;
        }
        let relative = (noise[axis] / largest).max(1.0 / MOST_UNEQUAL);
        1.0 / (relative * relative)
    })
}

const MOST_UNEQUAL: f64 = 10.0;
const FEWEST_TO_BALANCE: usize = 30;

fn noise_by_axis(problem: &Problem, after: &Deviations, rank: usize) -> Option<[f64; 3]> {
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

fn covariance(session: &Session, solution: &Solution, freedom: usize) -> Option<DMatrix<f64>> {
    let variance = if freedom > 0 {
        solution.cost.max(0.0) / freedom as f64
    } else {
        match session.instrument.sigma_mm? {
            Sigma::Overall(sigma) => sigma * sigma,
            Sigma::PerAxis(_) => 1.0,
        }
    };
    Some(solution.spectrum.inverse() * variance)
}

fn parameters(
    solution: &Solution,
    covariance: Option<&DMatrix<f64>>,
    factor: f64,
) -> Vec<Estimate> {
    let mut first = 0;
    let mut all = Vec::new();
    for term in solution.model.terms() {
        let size = term.coefficients.len();
        let own = covariance.map(|c| c.view((first, first), (size, size)).into_owned());
        let undetermined: Vec<bool> = (first..first + size)
            .map(|k| solution.spectrum.undetermined_share(k) > 1e-6)
            .collect();
        all.extend(estimates(term, own.as_ref(), factor, &undetermined));
        first += size;
    }
    all
}

/// `effect.parameter` for every coefficient; an amplitude and its phase stand as their two parts.
fn coefficient_names(model: &Model, session: &Session) -> Vec<String> {
    let names = model.terms().iter().flat_map(|term| {
        let about = term.effect.about();
        let place = match about.setting {
            Setting::Setup => {
                let setups = session.samples.setups.as_ref();
                let name = setups.and_then(|s| s.names.get(term.setting as usize));
                format!("{} of setup {}", about.id, name.map_or("?", String::as_str))
            }
            _ => name_on_joint(term.effect, term.joint, session),
        };
        let names = crate::effects::term::parameter_names(term.effect);
        let skip = names.len().saturating_sub(term.coefficients.len());
        names
            .into_iter()
            .skip(skip)
            .map(move |name| format!("{place}: {name}"))
            .collect::<Vec<_>>()
    });
    names.collect()
}

fn null_combinations(solution: &Solution, names: &[String]) -> Vec<NotIdentifiable> {
    let directions = solution.spectrum.null_directions();
    let directions = directions.iter().map(|direction| {
        let size = |k: usize| direction.components[k].abs();
        let scaled = |k: usize| solution.spectrum.scaled_component(&direction.components, k);
        let largest = (0..names.len()).map(scaled).fold(0.0, f64::max);
        let mut involved: Vec<usize> = (0..names.len())
            .filter(|k| size(*k) > 0.0 && scaled(*k) > 0.02 * largest)
            .collect();
        involved.sort_by(|a, b| scaled(*b).total_cmp(&scaled(*a)));
        let listed: Vec<&str> = involved.iter().map(|k| names[*k].as_str()).collect();
        let because = if listed.len() == 1 {
            "the samples do not depend on it"
        } else {
            "the samples show only their sum: a change of one can be undone by the others"
        };
        NotIdentifiable {
            combination: listed.join(" with "),
            because: because.to_owned(),
        }
    });
    directions.collect()
}

fn gap(
    before: &Deviations,
    after: &Deviations,
    counts: &dyn Fn(usize) -> bool,
    suspected: &[bool],
) -> Option<Gap> {
    let outlier = |i: usize| suspected[i];
    Some(Gap {
        before: Spread::of(&before.length_mm, counts, outlier)?,
        after: Spread::of(&after.length_mm, counts, outlier)?,
        samples: (0..suspected.len()).filter(|i| counts(*i)).count(),
    })
}

pub(super) fn outliers(after: &Deviations, suspected: &[bool]) -> Vec<Outlier> {
    let mut outliers: Vec<Outlier> = (0..suspected.len())
        .filter(|i| suspected[*i])
        .map(|sample| Outlier {
            sample,
            deviation_mm: after.length_mm[sample],
        })
        .collect();
    outliers.sort_by(|a, b| b.deviation_mm.total_cmp(&a.deviation_mm));
    outliers
}

pub(super) fn left_out(session: &Session) -> Vec<LeftOut> {
    let samples = 0..session.samples.len();
    let left_out = samples
        .filter_map(|sample| unusable(session, sample).map(|because| LeftOut { sample, because }));
    left_out.collect()
}

/// Every effect of the catalogue that some joint of the session can show.
pub fn testable_effects(session: &Session, inputs: &Inputs) -> Vec<&'static str> {
    let survey = Survey::new(session, inputs);
    let all = CATALOGUE.iter().filter(|effect| {
        places(**effect, &survey)
            .iter()
            .any(|(_, obstacle)| obstacle.is_none())
    });
    all.map(|effect| effect.about().id).collect()
}
