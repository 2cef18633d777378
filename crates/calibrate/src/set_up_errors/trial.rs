//! A robot with several joints as its session says, fitted with few coefficients.

use crate::effects::{JointValues, LINK_GEOMETRY, Setting, TOOL_ORIENTATION, Term, joint_zero};
use crate::fit::base_model;
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::fit::solver::solve;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::numeric::whole;
use crate::sessions::Session;
use crate::units::rad_from_deg;

use super::thresholds::{HALF, LARGEST_OFFSET_DEG};

/// What a trial ends with.
pub(super) struct Trial {
    /// Lengths of the deviations, the smallest first, mm; at least one.
    lengths_mm: Vec<f64>,
    pub(super) model: Model,
}

impl Trial {
    pub(super) fn median_mm(&self) -> f64 {
        self.within_mm(HALF)
    }

    /// The length that so large a share of the deviations is within, mm.
    pub(super) fn within_mm(&self, share: f64) -> f64 {
        within(&self.lengths_mm, share)
    }
}

/// Lengths that are known, the smallest first.
pub(super) fn in_order(mut lengths_mm: Vec<f64>) -> Vec<f64> {
    lengths_mm.retain(|v| v.is_finite());
    lengths_mm.sort_by(f64::total_cmp);
    lengths_mm
}

/// Of lengths in order the one that so large a share of them is within; infinite where there is none.
pub(super) fn within(lengths_mm: &[f64], share: f64) -> f64 {
    let at = whole(share * lengths_mm.len() as f64);
    let last = lengths_mm.len().saturating_sub(1);
    lengths_mm
        .get(at.min(last))
        .copied()
        .unwrap_or(f64::INFINITY)
}

/// Fits frame, tool and zero offsets; `None` where the end makes sense for no robot.
pub(super) fn trial(session: &Session, values: JointValues, free_frame: bool) -> Option<Trial> {
    let problem = Problem::new(session, values);
    let zero = joint_zero();
    let left_out = [LINK_GEOMETRY.about().id, TOOL_ORIENTATION.about().id];
    let mut terms = base_model::terms(session, &problem, |id| !left_out.contains(&id));
    // Targets sit on the tool as the drawing has them.
    terms.retain(|t| t.effect.about().setting != Setting::Target || t.setting == 0.0);
    if !free_frame {
        terms.retain(|t| t.effect.about().setting != Setting::Setup);
    }
    // The first zero offset is the frame's.
    terms.extend((1..session.robot.joints.len()).map(|j| Term::absent(zero, j, 0.0)));
    let fitted = solve(&problem, &Model::new(session.robot.clone(), terms)).model;
    let turned = |t: &Term| {
        t.effect.about().id == zero.about().id
            && session.robot.joints[t.joint].kind == JointKind::Revolute
            && t.coefficients[0].sin().atan2(t.coefficients[0].cos()).abs()
                > rad_from_deg(LARGEST_OFFSET_DEG)
    };
    if fitted.terms().iter().any(turned) {
        return None;
    }
    let lengths = in_order(lengths_mm(&problem, &fitted));
    (!lengths.is_empty()).then_some(Trial {
        lengths_mm: lengths,
        model: fitted,
    })
}
