//! Joint values that bring a target to where it is held: into a socket, onto a plane.

use nalgebra::{DMatrix, DVector};

use crate::effects::{Inputs, Term, joint_zero};
use crate::kinematics::JointKind;
use crate::lanes::dot;
use crate::model::Model;
use crate::numeric::LONGEST_TURN;
use crate::{budget, rounding};

/// The error of each condition, mm, and its derivatives with respect to the point.
pub(crate) type Missing = (Vec<f64>, Vec<[f64; 3]>);

/// Moves the one pose of these inputs by the shortest way of the joints (Newton's method) until nothing
/// is missing; whether that was reached. Joint limits are not looked at.
pub fn bring(model: &Model, own: &mut Inputs, missing: impl Fn([f64; 3]) -> Missing) -> bool {
    let joints = model.robot.joints.len();
    let zero = joint_zero();
    // A joint moves the target as its zero offset does; the nominal robot's slopes are near enough.
    let probed = (0..joints).fold(Model::nominal(model.robot.clone()), |m, joint| {
        m.with_term(Term::absent(zero, joint, 0.0))
    });
    for _ in 0..budget::STEPS {
        let (left, rows) = missing(model.predict(own).get(0));
        if left.iter().all(|v| v.abs() < rounding::COMPUTED) {
            return true;
        }
        let mut slopes = DMatrix::zeros(rows.len(), joints);
        probed.visit(own, true, |_, block| {
            for (joint, column) in block.columns.iter().enumerate() {
                let moved = [column[0][0], column[1][0], column[2][0]];
                for (row, by) in rows.iter().enumerate() {
                    slopes[(row, joint)] = dot(*by, moved);
                }
            }
        });
        let step = crate::decompose::svd(slopes)
            .and_then(|svd| svd.solve(&DVector::from_vec(left), 1e-9).ok());
        let Some(step) = step else {
            return false;
        };
        let longest = (0..joints).map(|j| {
            let slides = model.robot.joints[j].kind == JointKind::Prismatic;
            step[j].abs() / if slides { 1000.0 } else { 1.0 }
        });
        let shorten = (LONGEST_TURN / longest.fold(LONGEST_TURN, f64::max)).min(1.0);
        for joint in 0..joints {
            own.q[joint].to_mut()[0] += shorten * step[joint];
        }
    }
    false
}
