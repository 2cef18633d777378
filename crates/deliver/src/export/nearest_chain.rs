//! The chain of joints that is nearest to a model that is none.
//!
//! What no chain can carry (a joint that sags, an eccentricity) has a part that one can
//! follow: the sag of an arm over the poses in which it was measured is mostly a zero offset and an axis that leans. The
//! geometry of such a model alone is that of a robot without its sag, and leads farther off than what was identified
//! before the sag was found. So the geometry x that a file carries is the one that follows the model over the measured
//! range, near what was identified:
//!
//! ```text
//! Σ |model(q) − chain(q, x)|² + s² Σ ((x_k − x₀_k)/σ_k)²,    s² the mean square that is left, σ the weak priors of a robot
//! ```

use nalgebra::{DMatrix, DVector};

use super::Job;
use super::poses::poses;
use crate::compensation::{Compensation, Side};
use crate::effects::{FixedMask, LINK_GEOMETRY, TOOL_POSITION, Term, joint_zero};
use crate::kinematics::JointKind;
use crate::lanes::{dot, minus};
use crate::model::Model;
use crate::{budget, rounding};

/// Terms of a chain that leads as near to where the model leads as any does; `carried` are those of the model that a chain
/// can carry.
pub(super) fn nearest(job: &Job, carried: &[Term]) -> Vec<Term> {
    let all = Compensation::new(job.calibration).robot;
    let sides = [Side::Forward, Side::Reverse].map(|side| poses(job, side));
    let wanted = sides.each_ref().map(|inputs| all.predict(inputs));
    let mut chain = with_all_geometry(Model::new(all.robot.clone(), carried.to_vec()));
    let first = chain.coefficients();
    let sigma: Vec<f64> = chain
        .columns()
        .map(|(term, k)| {
            let prior = term.effect.about().priors.get(k);
            prior.map_or(0.0, |prior| match all.robot.joints[term.joint].kind {
                JointKind::Revolute => prior.sigma,
                JointKind::Prismatic => prior.sigma_on_slide,
            })
        })
        .collect();
    let p = first.len();
    for _ in 0..budget::ROUNDS {
        let mut gram = DMatrix::<f64>::zeros(p, p);
        let mut downhill = DVector::<f64>::zeros(p);
        let (mut square, mut rows) = (0.0, 0.0_f64);
        for (inputs, wanted) in sides.iter().zip(&wanted) {
            chain.visit(inputs, true, |start, block| {
                for i in 0..block.len {
                    let at = block.point.each_ref().map(|axis| axis[i]);
                    let off = minus(wanted.get(start + i), at);
                    square += dot(off, off);
                    rows += 3.0;
                    for (axis, off) in off.into_iter().enumerate() {
                        let own = |k: usize| block.columns[k][axis][i] * sigma[k];
                        let row = DVector::from_fn(p, |k, _| own(k));
                        gram.ger(1.0, &row, &row, 1.0);
                        downhill.axpy(off, &row, 1.0);
                    }
                }
            });
        }
        let left = square / rows.max(1.0);
        let now = chain.coefficients();
        for k in 0..p {
            gram[(k, k)] += left.max(f64::MIN_POSITIVE);
            if sigma[k] > 0.0 {
                downhill[k] -= left * (now[k] - first[k]) / sigma[k];
            }
        }
        let Some(step) = gram.cholesky().map(|factor| factor.solve(&downhill)) else {
            break;
        };
        let step: Vec<f64> = step
            .iter()
            .zip(&sigma)
            .map(|(by, sigma)| by * sigma)
            .collect();
        if !step.iter().all(|by| by.is_finite()) {
            break;
        }
        chain = chain.stepped(&step);
        if step.iter().all(|by| by.abs() <= rounding::COMPUTED) {
            break;
        }
    }
    chain.terms().to_vec()
}

/// The model with the geometry of every joint and of the tool, none of it held.
fn with_all_geometry(model: Model) -> Model {
    let joints = 0..model.robot.joints.len();
    let of_joints = joints.flat_map(|joint| [joint_zero(), &LINK_GEOMETRY].map(|e| (e, joint)));
    let of_all = of_joints.chain([(&TOOL_POSITION, 0)]);
    let absent = of_all.map(|(effect, joint)| Term::absent(effect, joint, 0.0));
    let all = absent.fold(model, |model, term| {
        let is_there = model.terms().iter().any(|own| own.same_column(&term));
        if is_there {
            model
        } else {
            model.with_term(term)
        }
    });
    all.with_each(|_, term| term.held = FixedMask::default())
}
