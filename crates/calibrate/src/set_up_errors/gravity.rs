//! Gravity in another direction than the session states: a robot on a wall, under a ceiling, on a slope.
//!
//! Where the load changes, the deflection of joint j is linear in gravity,
//!
//! ```text
//! δ_j = C_j m Σ_g d_g τ_jg(q),   τ_jg = e_g · ∂x_tool/∂q_j
//! gain(d) = b_dᵀ G_d⁻¹ b_d
//! ```
//!
//! with the joints' compliances C and the direction d of gravity in the base frame; G is the Gram matrix of the 3 ·
//! joints columns, b their products with the residuals, both projected orthogonal to every column of the base model,
//! waves over the joints, and the same torques of a constant load (the weight of the links, an eccentricity). A
//! direction is reported where it is much likelier than the one that the session states, and than a compliant
//! foundation.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::kinematics::{JointKind, Robot};
use crate::numeric::extent;
use crate::sessions::{Session, SessionCorrection};
use crate::text::Text;

use super::examined::{Examined, Unstated};
use super::residuals::Projected;
use super::thresholds::LIKELIER;

/// Directions that are tried first, evenly over the sphere: 5° apart.
const DIRECTIONS: usize = 2000;
/// Halvings of the step around the best of them: to a hundredth of a degree.
const HALVINGS: usize = 10;
/// A robot that is level within this (the chord of 10°) sags as a level one, within the uncertainty of its compliance.
const LEVEL: f64 = 0.17;

/// The direction of gravity by the joints' deflections, where it is another than the session states.
pub(super) fn runs_otherwise(
    session: &Session,
    _: JointValues,
    examined: &Examined,
) -> Option<Unstated> {
    let stated = session.robot.gravity_m_s2.filter(|g| g.norm() > 0.0)?;
    let sag = Sag::of(examined)?;
    let direction = sag.likeliest()?;
    let as_stated = stated.normalize();
    let needed = LIKELIER + sag.nats(&as_stated, 0).max(sag.foundation).max(0.0);
    let more = sag.nats(&direction, 2) - needed;
    if more < 0.0 || (direction - as_stated).norm() < LEVEL {
        return None;
    }
    let correction = SessionCorrection::TurnGravity((direction * stated.norm()).into());
    let along = |d: &Vector3<f64>| Text::verbatim(format!("({:.2}, {:.2}, {:.2})", d.x, d.y, d.z));
    let problem = DataProblem::of_all(
        text!(
            "gravity runs along {found} of the base, not along {stated}",
            found = along(&direction),
            stated = along(&as_stated)
        ),
        text!("what the joints give under the changing load is more than 1000 times likelier so"),
        text!("it is taken so; say in the session how the robot is mounted"),
        correction,
    );
    Some((more, problem))
}

/// What the load turns the joints by, apart from everything else.
struct Sag<'a> {
    /// Columns of joint j and gravity along g at 3 j + g: their products.
    gram: DMatrix<f64>,
    /// With the residuals.
    pull: DVector<f64>,
    projected: Projected<'a>,
    /// The factor by which correlated rows have less information than as many independent ones.
    dilution: f64,
    joints: usize,
    /// The logarithm by which a compliant foundation is likelier than none.
    foundation: f64,
}

impl<'a> Sag<'a> {
    fn of(Examined { few, residuals, .. }: &'a Examined) -> Option<Self> {
        let load = few.samples.load_kg.as_ref()?;
        let [least, most] = extent(load);
        if least >= most || load.iter().any(|kg| !kg.is_finite()) {
            return None;
        }
        let turning = |j: &usize| few.robot.joints[*j].kind == JointKind::Revolute;
        let joints: Vec<usize> = (0..few.robot.joints.len()).filter(turning).collect();
        let (mut own, mut rivals) = (Vec::new(), residuals.waves(few, &[1.0]));
        for &joint in &joints {
            let motion = &residuals.joints[joint];
            for along in 0..3 {
                let torques = torques_of_a_kilogram(few, joint, along);
                rivals.push(residuals.times(motion, |i| torques[i]));
                own.push(residuals.times(motion, |i| torques[i] * load[i]));
            }
        }
        let projected = Projected::of(residuals, &rivals)?;
        // A foundation that tilts and shifts under the load's moment, whatever its springs.
        let at = |i: usize, axis: usize| few.samples.coordinates(i)[axis] * load[i];
        let gives = (0..18).map(|k| residuals.column(|i| residuals.frame[i][k / 3] * at(i, k % 3)));
        let foundation = projected.with(&gives.collect::<Vec<_>>()).1;
        let dilution = projected.dilution(&projected.own(&own));
        let own: Vec<_> = own.iter().map(|c| projected.basis.reject(c)).collect();
        let own = DMatrix::from_columns(&own);
        Some(Self {
            gram: own.tr_mul(&own),
            pull: own.tr_mul(&projected.free),
            projected,
            dilution,
            joints: joints.len(),
            foundation,
        })
    }

    /// The logarithm by which the joints' compliances under gravity along a direction are likelier than none, less the
    /// penalty of their number and that of the direction's angles; zero where a compliance would be negative.
    fn nats(&self, direction: &Vector3<f64>, angles: usize) -> f64 {
        let part = |j: usize, k: usize| {
            direction.dot(&(self.gram.fixed_view::<3, 3>(3 * j, 3 * k) * direction))
        };
        let mut gram = DMatrix::from_fn(self.joints, self.joints, part);
        let pull = DVector::from_fn(self.joints, |j, _| {
            self.pull.fixed_rows::<3>(3 * j).dot(direction)
        });
        // A joint that the load does not turn shows nothing.
        let usual = gram.diagonal().max();
        for j in 0..self.joints {
            gram[(j, j)] += 1e-9 * usual;
        }
        let Some(compliances) = gram.cholesky().map(|factor| factor.solve(&pull)) else {
            return 0.0;
        };
        let gains = compliances.component_mul(&pull);
        let given_way: f64 = (0..self.joints)
            .map(|j| compliances[j].signum() * gains[j])
            .sum();
        if given_way <= 0.0 {
            return 0.0;
        }
        self.projected.nats(gains.sum(), self.joints + angles) / self.dilution
    }

    /// The likeliest direction; `None` where none is likelier than no compliance.
    fn likeliest(&self) -> Option<Vector3<f64>> {
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let on_the_sphere = (0..DIRECTIONS).map(|k| {
            let z = 1.0 - 2.0 * (k as f64 + 0.5) / DIRECTIONS as f64;
            let (sin, cos) = (golden * k as f64).sin_cos();
            Vector3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + Vector3::z() * z
        });
        let valued = on_the_sphere.map(|d| (self.nats(&d, 2), d));
        let (mut nats, mut best) = valued.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let mut step = 0.1;
        for _ in 0..HALVINGS {
            for axis in 0..3 {
                for sign in [-step, step] {
                    let there: Vector3<f64> = best + Vector3::ith(axis, 1.0) * sign;
                    let there = there.normalize();
                    let other = self.nats(&there, 2);
                    if other > nats {
                        (nats, best) = (other, there);
                    }
                }
            }
            step *= 0.5;
        }
        (nats > 0.0).then_some(best)
    }
}

/// The torque about a joint of a kilogram at the tool for gravity of 1 m/s² along an axis, N·m.
pub(super) fn torques_of_a_kilogram(few: &Session, joint: usize, along: usize) -> Vec<f64> {
    let mut robot: Robot = few.robot.clone();
    robot.gravity_m_s2 = Some(Vector3::ith(along, 1.0));
    for own in &mut robot.joints {
        own.link = None;
    }
    let mut q = vec![0.0; robot.joints.len()];
    (0..few.samples.len())
        .map(|i| {
            for (q, column) in q.iter_mut().zip(&few.samples.q) {
                *q = column[i];
            }
            robot.gravity_torque_nm(&q, 1.0, joint).unwrap_or(0.0)
        })
        .collect()
}
