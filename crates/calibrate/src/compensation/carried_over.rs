//! A calibration carried over to a session that was measured with another tool or other targets: the
//! joints and links are the same, the tool is not.
//!
//! The terms of the old tool (its position, its orientation, the own errors of its targets) are dropped, and a common
//! shift of the new one is fitted to the samples. Frames that the model does not know are fitted with it, in turns.

use nalgebra::{Matrix3, Vector3};

use crate::effects::{Inputs, Role, TOOL_POSITION, Term};
use crate::fit::problem::Problem;
use crate::model::{Calibration, Model};
use crate::sessions::{Session, hash_of_samples};
use crate::text::{Text, components};
use crate::{budget, rounding};

/// Whether a term is the place of a tool or a target.
fn is_place_of_the_tool(term: &Term) -> bool {
    term.effect.about().role == Role::ToolPlace
}

/// The calibration for this session, and what was done; `None` where the tool is the same.
/// `applied` makes the model for the session of a calibration: with its frames.
pub(super) fn carried_over(
    calibration: &Calibration,
    session: &Session,
    problem: &Problem,
    applied: impl Fn(&Calibration) -> Model,
) -> Option<(Calibration, Text)> {
    let robot = &calibration.model.robot;
    let same_tool = session.robot.base_from_tool == robot.base_from_tool;
    let same_targets = session.targets == calibration.targets;
    let same_samples = hash_of_samples(session) == calibration.samples_hash;
    if robot.joints.len() < 2 || same_samples || (same_tool && same_targets) {
        return None;
    }
    let mut there = robot.clone();
    there.base_from_tool = session.robot.base_from_tool;
    let of_the_tool = |t: &&Term| matches!(t.effect.about().role, Role::ToolPlace | Role::ToolTurn);
    let terms = calibration.model.terms().iter();
    let terms = terms.filter(|t| !of_the_tool(t)).cloned().collect();
    let mut carried = Calibration {
        model: Model::new(there, terms).with_term(Term::absent(&TOOL_POSITION, 0, 0.0)),
        targets: session.targets.clone(),
        covariance: None,
        ..calibration.clone()
    };
    for _ in 0..budget::STEPS {
        let model = applied(&carried);
        let Some(step) = step(&model, session, problem) else {
            break;
        };
        let terms = carried.model.terms().iter().cloned().map(|mut term| {
            if is_place_of_the_tool(&term) {
                let pairs = term.coefficients.iter_mut().zip(step.iter());
                pairs.for_each(|(coefficient, by)| *coefficient += by);
            }
            term
        });
        carried.model = Model::new(carried.model.robot.clone(), terms.collect());
        if step.norm() < rounding::COMPUTED {
            break;
        }
    }
    let shift = carried.model.terms().iter().find(|t| of_the_tool(t));
    let shift = shift.map_or([0.0; 3], |t| {
        [t.coefficients[0], t.coefficients[1], t.coefficients[2]]
    });
    let shift = components(shift, 4);
    let note = match (same_tool, same_targets) {
        (false, false) => text!(
            "the session has another tool and other targets than the model: its joints and links carry over, and the tool's position is fitted to these samples: {shift} in the tool frame",
            shift
        ),
        (false, true) => text!(
            "the session has another tool than the model: its joints and links carry over, and the tool's position is fitted to these samples: {shift} in the tool frame",
            shift
        ),
        (true, _) => text!(
            "the session has other targets than the model: its joints and links carry over, and the tool's position is fitted to these samples: {shift} in the tool frame",
            shift
        ),
    };
    Some((carried, note))
}

/// The least-squares step of the common shift of the tool.
fn step(model: &Model, session: &Session, problem: &Problem) -> Option<Vector3<f64>> {
    let mut first = 0;
    let mut of_the_tool = None;
    for term in model.terms() {
        if is_place_of_the_tool(term) && term.setting == 0.0 {
            of_the_tool = Some(first);
        }
        first += term.coefficients.len();
    }
    let column = of_the_tool?;
    let samples = &session.samples;
    let inputs: &Inputs = &problem.inputs;
    let mut normal = Matrix3::zeros();
    let mut downhill = Vector3::zeros();
    model.visit(inputs, true, |start, block| {
        for i in 0..block.len {
            let k = start + i;
            if !problem.usable[k] {
                continue;
            }
            let measured = [
                Some(samples.x_mm[k]),
                Some(samples.y_mm[k]),
                samples.z_mm.as_ref().map(|z| z[k]),
            ];
            for (axis, measured) in measured.into_iter().enumerate() {
                let Some(measured) = measured else { continue };
                let residual = measured - block.point[axis][i];
                let by = Vector3::from_fn(|c, _| block.columns[column + c][axis][i]);
                if residual.is_finite() {
                    normal += by * by.transpose();
                    downhill += by * residual;
                }
            }
        }
    });
    let eigen = crate::decompose::eigen(normal);
    let most = eigen.eigenvalues.max();
    let mut step = Vector3::zeros();
    for k in 0..3 {
        let vector = eigen.eigenvectors.column(k).into_owned();
        if most > 0.0 && eigen.eigenvalues[k] > rounding::COMPUTED * most {
            step += vector * (vector.dot(&downhill) / eigen.eigenvalues[k]);
        }
    }
    step.iter().all(|v| v.is_finite()).then_some(step)
}
