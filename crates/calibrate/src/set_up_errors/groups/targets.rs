//! Targets that are not at their stated places in the tool.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::effects::{JointValues, Setting, TOOL_ORIENTATION, Term};
use crate::fit::base_model;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::fit::target_places::own_parts;
use crate::model::Model;
use crate::sessions::{Session, SessionCorrection};
use crate::text::{Text, components, length};

use super::evidence::MOST_PLACES;
use super::evidence::{RESIDUAL_SHARE, evidence, in_numbers, is_believed};
use crate::set_up_errors::fits::{fitted, fitted_from, some_samples};
use crate::set_up_errors::thresholds::{CORRECTED_SHARE, GROSS_SHARE, size_mm};

/// A place is off beyond so many standard deviations of what is stated.
const OFF: f64 = 4.0;
/// Iterations of the reweighting that keeps as many targets as possible at their stated places.
const ROUNDS: usize = 12;
/// Below this distance a target counts as at its stated place, for those weights, mm.
const STILL_MM: f64 = 0.02;
/// How much more the first target is held than the others.
const FIRST: f64 = 3.0;
/// A turned tool explains the samples as well if its residual is at most so many times that of free targets.
pub(super) const AS_WELL: f64 = 1.15;

/// A session of an arm with its targets free, where they contradict what it states of them.
pub(super) struct Contradicted {
    pub(super) session: Session,
    /// The fitted model, its residual and that of the session as stated, mm.
    pub(super) model: Model,
    pub(super) before_mm: f64,
    pub(super) residual_mm: f64,
}

/// The targets of a single axis that are elsewhere.
pub(super) fn elsewhere(session: &Session, values: JointValues) -> Vec<DataProblem> {
    if base_model::is_arm(session) || !session.has_plain_points() {
        return Vec::new();
    }
    let known = stated_sigma(session);
    let found = known.and_then(|sigma| of_one_axis(session, &some_samples(session), values, sigma));
    found.unwrap_or_default()
}

/// How well the places of several targets are stated that a session has.
fn stated_sigma(session: &Session) -> Option<f64> {
    let sigma = session.instrument.targets_sigma_mm?;
    let targets = session.samples.target.as_deref()?;
    let first = *targets.first()?;
    let several = (2..=MOST_PLACES).contains(&session.targets.len());
    (several && targets.iter().any(|target| *target != first)).then_some(sigma)
}

/// Whether the samples of an arm are much likelier with its targets free, and their residuals clearly smaller.
pub(super) fn contradicted(session: &Session, values: JointValues) -> Option<Contradicted> {
    stated_sigma(session)?;
    if !base_model::is_arm(session) {
        return None;
    }
    let mut part = some_samples(session);
    let before = as_stated_mm(&part, values)?;
    let stated = part.clone();
    SessionCorrection::FreeTargets.apply(&mut part);
    let (model, after) = fitted(&part, values)?;
    let axes = part.samples.axes();
    let places = own_parts(&model).len();
    let evidence = evidence(part.samples.len(), axes, before, after, axes * places);
    // A robot that is this far off is one with a wrong unit that free places would only hide, unless the residual
    // nearly vanishes with them.
    let gross = GROSS_SHARE * size_mm(&part);
    let share = if before > gross {
        CORRECTED_SHARE
    } else {
        RESIDUAL_SHARE
    };
    if !is_believed(evidence, before, after, share) || after > gross {
        return None;
    }
    if turned_mm(&stated, values).is_some_and(|turned| turned < AS_WELL * after) {
        return None;
    }
    let mut free = session.clone();
    SessionCorrection::FreeTargets.apply(&mut free);
    Some(Contradicted {
        session: free,
        model,
        before_mm: before,
        residual_mm: after,
    })
}

/// The residual of the base model with every target where the session states it, mm.
fn as_stated_mm(part: &Session, values: JointValues) -> Option<f64> {
    residual_mm(part, values, |start| {
        start.without(|t| t.effect.about().setting == Setting::Target && t.setting > 0.0)
    })
}

/// Its residual where the tool is mounted turned, mm.
fn turned_mm(part: &Session, values: JointValues) -> Option<f64> {
    residual_mm(part, values, |start| {
        let start =
            start.without(|t| t.effect.about().setting == Setting::Target && t.setting > 0.0);
        let id = TOOL_ORIENTATION.about().id;
        let is_turned = start.terms().iter().any(|t| t.effect.about().id == id);
        if is_turned {
            return start;
        }
        start.with_term(Term::absent(&TOOL_ORIENTATION, 0, 0.0))
    })
}

fn residual_mm(
    part: &Session,
    values: JointValues,
    change: impl Fn(Model) -> Model,
) -> Option<f64> {
    Some(fitted_from(part, values, change)?.1)
}

fn of_one_axis(
    session: &Session,
    part: &Session,
    values: JointValues,
    sigma: f64,
) -> Option<Vec<DataProblem>> {
    let (model, before) = fitted(part, values)?;
    let by = offsets(part, values, &model)?;
    let off: Vec<(usize, Vector3<f64>)> = by
        .into_iter()
        .enumerate()
        .filter(|(_, by)| by.norm() > OFF * sigma)
        .collect();
    if off.is_empty() {
        return None;
    }
    let correction = |(target, by): &(usize, Vector3<f64>)| SessionCorrection::MoveTarget {
        target: *target,
        by_mm: (*by).into(),
    };
    let mut moved = part.clone();
    for one in &off {
        correction(one).apply(&mut moved);
    }
    let (_, after) = fitted(&moved, values)?;
    let axes = part.samples.axes();
    let evidence = evidence(part.samples.len(), axes, before, after, axes * off.len());
    let of_target = |one: &(usize, Vector3<f64>)| {
        let numbers = in_numbers(before, after);
        problem(session, one.0, one.1, numbers, correction(one))
    };
    is_believed(evidence, before, after, RESIDUAL_SHARE)
        .then(|| off.iter().map(of_target).collect())
}

/// How far each target is from its place, tool frame, mm, given the base model: as few as possible are off
/// (iteratively reweighted least squares for the sum of the lengths, Daubechies et al. 2010).
fn offsets(part: &Session, values: JointValues, model: &Model) -> Option<Vec<Vector3<f64>>> {
    let problem = Problem::new(part, values);
    let rows = Rows::of(&problem);
    let (residual, base) = rows.extract(model);
    let targets = part.targets.len();
    let own = base.ncols();
    let mut columns = base.resize_horizontally(own + 3 * targets, 0.0);
    let (here, _) = rows.extract(model);
    for along in 0..3 {
        let mut moved = part.clone();
        for target in 0..targets {
            let mut by_mm = [0.0; 3];
            by_mm[along] = 1.0;
            SessionCorrection::MoveTarget { target, by_mm }.apply(&mut moved);
        }
        let problem = Problem::new(&moved, values);
        let (there, _) = Rows::of(&problem).extract(model);
        let column = here.clone() - there;
        let n = rows.samples.len();
        for (row, value) in column.iter().enumerate() {
            let target = part.samples.target.as_ref()?[rows.samples[row % n]] as usize;
            columns[(row, own + 3 * target + along)] = *value;
        }
    }
    let scale = DVector::from_iterator(
        columns.ncols(),
        columns.column_iter().map(|c| c.norm().max(1e-12)),
    );
    for (k, mut column) in columns.column_iter_mut().enumerate() {
        column /= scale[k];
    }
    let gram: DMatrix<f64> = columns.tr_mul(&columns);
    let pull = columns.tr_mul(&residual);
    let mut weight = vec![1.0; targets];
    weight[0] = FIRST;
    let mut by = vec![Vector3::zeros(); targets];
    for _ in 0..ROUNDS {
        let mut now = gram.clone();
        for k in 0..now.nrows() {
            now[(k, k)] += 1e-12;
        }
        for (target, weight) in weight.iter().enumerate() {
            for along in 0..3 {
                let at = own + 3 * target + along;
                now[(at, at)] += 1e-7 * weight / (scale[at] * scale[at]) * rows.len() as f64;
            }
        }
        let step = nalgebra::Cholesky::new(now)?.solve(&pull);
        for target in 0..targets {
            by[target] = Vector3::from_fn(|along, _| {
                let at = own + 3 * target + along;
                step[at] / scale[at]
            });
            // Of two that moved against each other the one that is named first is kept.
            let first = if target == 0 { FIRST } else { 1.0 };
            weight[target] = first / by[target].norm().max(STILL_MM);
        }
    }
    Some(by)
}

pub(in crate::set_up_errors) fn problem(
    session: &Session,
    target: usize,
    by: Vector3<f64>,
    evidence: Text,
    correction: SessionCorrection,
) -> DataProblem {
    let name = session.targets.get(target).map_or("", |t| t.name.as_str());
    let size = by.norm();
    let samples = session.samples.target.iter().flatten().enumerate();
    DataProblem {
        what: text!(
            "target {name} is elsewhere: {size} from its stated place in the tool",
            name,
            size = length(size, 3)
        ),
        evidence,
        proposal: text!(
            "its place is fitted (moved by {by}); measure it, or state in the session how certain it is",
            by = components(by.into(), 3)
        ),
        mend: Some(correction),
        samples: samples
            .filter(|(_, own)| **own as usize == target)
            .map(|(row, _)| row)
            .collect(),
    }
}
