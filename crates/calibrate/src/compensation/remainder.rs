//! The residual that no joint can remove: how large it is, what causes it, and what would remove it.
//!
//! The commands are corrected for the very conditions of each pose, so that the residual is the model's statement
//! about the machine and not about a table. For one revolute joint it is split into the parts along the radius and
//! along the axis; around the axis it is zero.
//!
//! The share of an effect is the residual if it were the only one. Shares do not add up (a base offset may cancel a
//! part of a short link), so they are ranked and not summed.

use crate::effects::{Inputs, JointFrame, called};
use crate::lanes::{dot, minus};
use crate::model::{Calibration, Model};
use crate::text::Text;
use crate::text::length;
use crate::thresholds::NOTHING_MM;

use super::plan::Compensation;

/// The residual of one effect.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    /// The effect.
    pub effect: &'static str,
    /// Joint, counted from 1; `None` where the effect belongs to none.
    pub joint: Option<usize>,
    /// Root mean square of what would stay if it were the only one, mm.
    pub rms_mm: f64,
    /// What would remove it, for a technician.
    pub remedy: Text,
}

/// What corrected joint commands cannot remove, mm, with its causes and the change of the controller that would.
#[derive(Debug, Clone, PartialEq)]
pub struct Remainder {
    /// Root mean square over the poses, mm.
    pub rms_mm: f64,
    /// Largest, mm.
    pub max_mm: f64,
    /// Root mean square along the radius and along the axis, mm; for one turning joint.
    pub radial_axial_mm: Option<[f64; 2]>,
    /// The effects with a residual, largest first.
    pub shares: Vec<Share>,
}

impl Remainder {
    /// Over these poses.
    pub fn new(calibration: &Calibration, inputs: &Inputs) -> Self {
        let compensation = Compensation::new(calibration);
        let inputs = &*inputs.fitted_to(calibration.model.robot.joints.len());
        let residuals = left_over(&compensation, inputs);
        let lengths = residuals.iter().map(|v| dot(*v, *v).sqrt());
        Self {
            rms_mm: rms(&residuals),
            max_mm: lengths.fold(0.0, f64::max),
            radial_axial_mm: radial_and_axial(&compensation, inputs, &residuals),
            shares: shares(calibration, &compensation, inputs),
        }
    }

    /// The whole in one sentence per effect, largest first.
    pub fn describe(&self) -> Vec<Text> {
        let share = |s: &Share| {
            let (effect, left) = (called(s.effect), length(s.rms_mm, 4));
            match s.joint {
                Some(joint) => text!(
                    "{effect} of joint {joint} leaves {left}: {remedy}",
                    effect,
                    joint,
                    left,
                    remedy = &s.remedy
                ),
                None => text!(
                    "{effect} leaves {left}: {remedy}",
                    effect,
                    left,
                    remedy = &s.remedy
                ),
            }
        };
        self.shares.iter().map(share).collect()
    }
}

/// What stays of each pose, mm.
pub fn left_over(compensation: &Compensation, inputs: &Inputs) -> Vec<[f64; 3]> {
    let corrections = compensation.joint_corrections(inputs);
    let reached = compensation.reached(inputs, &corrections);
    let nominal = compensation.nominal.predict(inputs);
    (0..inputs.len())
        .map(|i| compensation.deviation(reached.get(i), nominal.get(i)))
        .collect()
}

fn rms(vectors: &[[f64; 3]]) -> f64 {
    let sum: f64 = vectors.iter().map(|v| dot(*v, *v)).sum();
    (sum / vectors.len().max(1) as f64).sqrt()
}

fn radial_and_axial(
    compensation: &Compensation,
    inputs: &Inputs,
    residuals: &[[f64; 3]],
) -> Option<[f64; 2]> {
    let robot = &compensation.robot.robot;
    if robot.joints.len() != 1 || robot.joints[0].kind != crate::kinematics::JointKind::Revolute {
        return None;
    }
    let frame = JointFrame::new(robot, 0);
    let nominal = compensation.nominal.predict(inputs);
    let (mut radial, mut axial) = (0.0, 0.0);
    for (i, residual) in residuals.iter().enumerate() {
        let arm = minus(nominal.get(i), frame.origin_mm);
        let height = dot(arm, frame.along);
        let across = minus(arm, frame.along.map(|v| v * height));
        let radius = dot(across, across).sqrt();
        if radius > 0.0 {
            radial += (dot(*residual, across) / radius).powi(2);
        }
        axial += dot(*residual, frame.along).powi(2);
    }
    let n = residuals.len().max(1) as f64;
    Some([(radial / n).sqrt(), (axial / n).sqrt()])
}

fn shares(calibration: &Calibration, all: &Compensation, inputs: &Inputs) -> Vec<Share> {
    if all.regional.is_some() {
        let residual_mm = rms(&left_over(all, inputs));
        let share = Share {
            effect: "regional correction",
            joint: Some(1),
            rms_mm: residual_mm,
            remedy: text!(
                "its part along the radius belongs into the tool data (l1) or the base data \
                     of the controller; the exact method says into which"
            ),
        };
        return if residual_mm > NOTHING_MM {
            vec![share]
        } else {
            Vec::new()
        };
    }
    let mut shares: Vec<Share> = Vec::new();
    for term in all.robot.terms() {
        let alone = Compensation {
            robot: Model::new(calibration.model.robot.clone(), vec![term.clone()]),
            ..all.clone()
        };
        let rms_mm = rms(&left_over(&alone, inputs));
        if rms_mm > NOTHING_MM {
            let about = term.effect.about();
            shares.push(Share {
                effect: about.id,
                joint: about.per_joint.then_some(term.joint + 1),
                rms_mm,
                remedy: remedy(calibration, term),
            });
        }
    }
    shares.sort_by(|a, b| b.rms_mm.total_cmp(&a.rms_mm));
    shares
}

/// What removes an effect that the joints cannot.
fn remedy(calibration: &Calibration, term: &crate::effects::Term) -> Text {
    let robot = &calibration.model.robot;
    let own = term.effect.remedy.map(|say| say(robot, term));
    own.unwrap_or_else(|| {
        text!(
            "needs a mechanical repair: {check}",
            check = term.effect.about().check
        )
    })
}
