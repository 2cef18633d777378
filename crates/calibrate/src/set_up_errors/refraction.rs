//! Refraction that bends the lines of sight: warm air rises along a robot, under a roof it is warmer than above a
//! floor.
//!
//! In a gradient of the refractive index a line of sight is part of a parabola,
//!
//! ```text
//! p_i = p_i⁰ + b |p_i|²,   2 b the gradient
//! ```
//!
//! in the instrument's own frame. The residuals of the fitted robot are regressed on the three columns of b together
//! with the base model, waves over the joints and the torques of masses behind them: an arm that sags moves downwards
//! with its reach squared, too. An error that the model lacks may be any quadratic function of the place: were that
//! likelier, with its 27 numbers, it would not be the sight.

use nalgebra::Vector3;

use super::examined::{Examined, Unstated};
use super::gravity::torques_of_a_kilogram;
use super::residuals::Projected;
use super::thresholds::LIKELIER;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::kinematics::JointKind;
use crate::sessions::{Session, SessionCorrection};
use crate::text::{Text, length};

/// No line of sight is bent by more than this part of its length: near a furnace, at 100 K a metre, one of 10 m by half
/// of it (10⁻⁶ a kelvin).
const MOST: f64 = 1e-3;
/// Which of x, y, z and 1 are multiplied in a quadratic function.
const PRODUCTS: [[usize; 2]; 9] = [
    [0, 0],
    [0, 1],
    [0, 2],
    [1, 1],
    [1, 2],
    [2, 2],
    [0, 3],
    [1, 3],
    [2, 3],
];

/// Lines of sight that are bent.
pub(super) fn bends(_: &Session, _: JointValues, examined: &Examined) -> Option<Unstated> {
    let Examined { few, residuals, .. } = examined;
    if few.samples.setups.as_ref()?.names.len() != 1 {
        return None;
    }
    let point = |i: usize| Vector3::from(residuals.expected[i]);
    let farthest_mm = (0..residuals.n)
        .map(|i| point(i).norm())
        .fold(0.0, f64::max);
    let mut others = examined.waves();
    for (joint, motion) in residuals.joints.iter().enumerate() {
        if few.robot.joints[joint].kind == JointKind::Revolute {
            for along in 0..3 {
                let torques = torques_of_a_kilogram(few, joint, along);
                others.push(residuals.times(motion, |i| torques[i]));
            }
        }
    }
    let columns = [0, 1, 2].map(|axis| {
        residuals.column(|i| Vector3::ith(axis, (point(i).norm() / farthest_mm).powi(2)))
    });
    let projected = Projected::of(residuals, &others)?;
    let (by, nats) = projected.with(&columns);
    let by_mm = Vector3::new(by[0], by[1], by[2]);
    if nats < LIKELIER || by_mm.norm() > MOST * farthest_mm {
        return None;
    }
    let quadratic = (0..3 * PRODUCTS.len()).map(|k| {
        let [first, second] = PRODUCTS[k / 3];
        let of = |i: usize, factor: usize| point(i).push(farthest_mm)[factor] / farthest_mm;
        residuals.column(|i| Vector3::ith(k % 3, of(i, first) * of(i, second)))
    });
    if projected.with(&quadratic.collect::<Vec<_>>()).1 > nats {
        return None;
    }
    let correction = SessionCorrection::StraightenSight((by_mm / farthest_mm.powi(2)).into());
    let along = by_mm.normalize();
    let problem = DataProblem::of_all(
        text!(
            "the lines of sight are bent: at {distance} by {size} along {along} of the measuring frame",
            distance = length(farthest_mm, 0),
            size = length(by_mm.norm(), 3),
            along = Text::verbatim(format!("({:.2}, {:.2}, {:.2})", along.x, along.y, along.z))
        ),
        text!(
            "more than 1000 times likelier than straight ones beside joints that turn unevenly or give"
        ),
        text!(
            "the samples are taken without it; keep sights away from warm machines and short, or mix the air"
        ),
        correction,
    );
    Some((nats - LIKELIER, problem))
}
