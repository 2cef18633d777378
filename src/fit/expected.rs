//! How sure a model is where the robot works: the error that the uncertainty of its parameters makes
//! over the joint ranges, not only at the poses that were measured.
//!
//! ```text
//! var p(q) = J(q) Σ J(q)ᵀ,   expected error = √ tr var p(q)
//! ```
//!
//! What the measured poses cannot tell apart is held by the gauge, and tells poses apart that are elsewhere (of a joint
//! that was never moved all of it): beside the covariance each such combination d counts with what is known of it
//! beforehand,
//!
//! ```text
//! J d = 0 at the measured poses,   var p(q) += σ_d² |J(q) d|²,   1/σ_d² = Σ_k (d_k/σ_k)²
//! ```
//!
//! Poses are spread evenly over the joint limits (an additive recurrence, Roberts 2018), where there
//! are none over the values that were measured.

use nalgebra::{DMatrix, DVector};

pub(crate) use crate::answers::errors::Expected;
use crate::effects::{FixedMask, Inputs, LINK_GEOMETRY, Role, Term};
use crate::linear::Kept;
use crate::model::Model;

use super::gauge::{COPY, columns};
use super::priors::Priors;
use super::problem::Problem;
use super::spread::spread;

/// Poses over the joint ranges.
const POSES: usize = 400;
/// Of a combination that is not seen at most this share of its held coefficient's own column is left.
const MOST_SEEN: f64 = 10.0 * COPY;
/// How far an instrument may stand from where it is thought to stand, where nothing is known: any turn alike, of which
/// the standard deviation is π/√3, and a room of some metres, rad and mm.
const ANYWHERE: [f64; 2] = [1.8, 1000.0];

/// The expected error of a model with the covariance of its coefficients.
pub(crate) fn expected_error(
    problem: &Problem,
    model: &Model,
    covariance: &DMatrix<f64>,
) -> Option<Expected> {
    let inputs = over_the_ranges(problem);
    let mut over = uncertainties_mm(model, &inputs, covariance)?;
    for (own, unseen) in over.iter_mut().zip(unseen_mm(problem, model, &inputs)) {
        *own = own.hypot(unseen);
    }
    let some = spread(&problem.used, POSES);
    let measured = uncertainties_mm(model, &problem.inputs.select(&some), covariance)?;
    let rms = |all: &[f64]| {
        let square: f64 = all.iter().map(|e| e * e).sum();
        (square / all.len().max(1) as f64).sqrt()
    };
    let worst = (0..over.len()).max_by(|a, b| over[*a].total_cmp(&over[*b]))?;
    Some(Expected {
        rms_mm: rms(&over),
        max_mm: over[worst],
        worst_q: inputs.q.iter().map(|q| q[worst]).collect(),
        measured_rms_mm: rms(&measured),
    })
}

/// √ tr J Σ Jᵀ of every pose, mm: one standard uncertainty of the predicted point; `None` where the
/// sizes do not fit.
pub(crate) fn uncertainties_mm(
    model: &Model,
    inputs: &Inputs,
    covariance: &DMatrix<f64>,
) -> Option<Vec<f64>> {
    let count = model.coefficient_count();
    if covariance.nrows() < count || inputs.is_empty() {
        return None;
    }
    let mut all = Vec::new();
    model.visit(inputs, true, |_, block| {
        for i in 0..block.len {
            let mut trace = 0.0;
            for axis in 0..3 {
                for a in 0..count {
                    let ja = block.columns[a][axis][i];
                    if ja != 0.0 {
                        let along: f64 = (0..count)
                            .map(|b| covariance[(a, b)] * block.columns[b][axis][i])
                            .sum();
                        trace += ja * along;
                    }
                }
            }
            all.push(trace.max(0.0).sqrt());
        }
    });
    Some(all)
}

/// What the combinations that the samples do not show may move every pose by, mm; of a robot with several joints.
pub(crate) fn unseen_mm(problem: &Problem, model: &Model, inputs: &Inputs) -> Vec<f64> {
    let model = with_every_link(model);
    let sigma = beforehand(problem, &model);
    let held: Vec<bool> = model
        .columns()
        .map(|(term, k)| term.held.contains(k))
        .collect();
    // What is held has no column.
    let model = model.with_each(|_, term| {
        if term.effect.about().role != Role::Place {
            term.held = FixedMask::default();
        }
    });
    let rows = columns(problem, &model);
    let mut basis = Kept::new(rows.nrows());
    for k in (0..held.len()).filter(|k| !held[*k]) {
        let column = rows.column(k).into_owned();
        let free = basis.reject(&column);
        if free.norm() > COPY * column.norm() {
            basis.push(k, &column, &free);
        }
    }
    let mut unseen = Vec::new();
    for k in (0..held.len()).filter(|k| held[*k]) {
        let column = rows.column(k).into_owned();
        if basis.reject(&column).norm() > MOST_SEEN * column.norm() {
            continue;
        }
        let mut own = DVector::zeros(held.len());
        for (of, part) in basis.parts(&column) {
            own[of] = -part;
        }
        own[k] = 1.0;
        let known = own.iter().zip(&sigma).map(|(d, sigma)| (d / sigma).powi(2));
        let known: f64 = known.sum();
        unseen.push(own / known.sqrt());
    }
    let mut all = Vec::with_capacity(inputs.len());
    model.visit(inputs, true, |_, block| {
        for i in 0..block.len {
            let mut square = 0.0;
            for (own, axis) in unseen.iter().flat_map(|own| [(own, 0), (own, 1), (own, 2)]) {
                let along = own.iter().zip(&block.columns);
                let moved: f64 = along.map(|(d, column)| d * column[axis][i]).sum();
                square += moved * moved;
            }
            all.push(square.sqrt());
        }
    });
    all
}

/// The model with the links that the gauge has left out, as nothing of them is seen.
fn with_every_link(model: &Model) -> Model {
    let id = LINK_GEOMETRY.about().id;
    let is_there = |joint: usize| {
        model
            .terms()
            .iter()
            .any(|t| t.effect.about().id == id && t.joint == joint)
    };
    let joints = 0..model.robot.joints.len();
    let left_out: Vec<usize> = joints.filter(|joint| !is_there(*joint)).collect();
    left_out.into_iter().fold(model.clone(), |model, joint| {
        let mut term = Term::absent(&LINK_GEOMETRY, joint, 0.0);
        for k in 0..term.coefficients.len() {
            term.held = term.held.with(k);
        }
        model.with_term(term)
    })
}

/// What is known of every coefficient beforehand, whether or not priors hold in the fit.
fn beforehand(problem: &Problem, model: &Model) -> Vec<f64> {
    let priors = Priors {
        aligned: problem.priors.aligned,
        ..Priors::unmeasured(None)
    };
    let known = |(term, k): (&Term, usize)| {
        let about = term.effect.about();
        let [turn, move_mm] = ANYWHERE;
        let turns = about.form.turns(k, model.robot.joints[term.joint].kind);
        let of_base = about.role.is_of_every_calibration();
        let anywhere = if turns { turn } else { move_mm };
        let unknown = if of_base { anywhere } else { f64::INFINITY };
        priors.sigma(model, term, k).unwrap_or(unknown)
    };
    model.columns().map(known).collect()
}

/// Poses over the limits of the joints, on the targets in turn.
pub(crate) fn over_the_ranges(problem: &Problem) -> Inputs<'static> {
    let joints = &problem.session.robot.joints;
    let n = joints.len();
    // The positive root of x^(n+1) = x + 1.
    let mut root = 1.5_f64;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / (n as f64 + 1.0));
    }
    let mut step = 1.0;
    let columns = joints.iter().enumerate().map(|(j, joint)| {
        step /= root;
        let values = problem.inputs.q[j].iter().zip(&problem.used);
        let seen = values.filter(|(_, used)| **used).map(|(q, _)| *q);
        let measured = seen.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), q| {
            (a.min(q), b.max(q))
        });
        let (low, high) = joint
            .limits
            .map_or(measured, |range| (range.from, range.to));
        let at = |k: usize| (0.5 + step * (k as f64 + 1.0)).fract();
        (0..POSES).map(|k| low + (high - low) * at(k)).collect()
    });
    let targets = problem.inputs.reflectors_at_home.len();
    at_poses(problem, columns.collect(), |k| k % targets)
}

/// Every reflector at each of these values of joint 1, rad or mm, reflector after reflector; the other
/// joints at 0.
pub(crate) fn along_joint(problem: &Problem, values: &[f64]) -> Inputs<'static> {
    let joints = problem.session.robot.joints.len();
    let count = values.len() * problem.inputs.reflectors_at_home.len().max(1);
    let mut columns = vec![vec![0.0; count]; joints];
    if let Some(first) = columns.first_mut() {
        *first = values.iter().copied().cycle().take(count).collect();
    }
    at_poses(problem, columns, |k| k / values.len())
}

/// These poses of the joints, rad or mm, in one setup, with the reflector of each.
fn at_poses(
    problem: &Problem,
    columns: Vec<Vec<f64>>,
    target: impl Fn(usize) -> usize,
) -> Inputs<'static> {
    let count = columns.first().map_or(0, Vec::len);
    let mut inputs = Inputs::at_poses(columns, problem.inputs.reflectors_at_home.clone());
    if let Some(setup) = problem.inputs.setup.as_deref() {
        // The frame that most samples were measured in, or the first.
        let first = (0..setup.len()).find(|i| problem.used[*i]);
        inputs.setup = Some(vec![first.map_or(0.0, |i| setup[i]); count]);
    }
    if problem.inputs.target.is_some() && !inputs.reflectors_at_home.is_empty() {
        let of = |k: usize| u32::try_from(target(k)).unwrap_or(0);
        inputs.target = Some((0..count).map(of).collect());
    }
    inputs
}
