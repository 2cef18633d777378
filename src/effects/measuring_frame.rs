//! A free measuring frame: `p = R(ω) p + t` for the samples of one setup.
//!
//! Not an effect of the robot, so it is not in the catalogue: it says where the instrument stood
//! in each setup. The coefficients are the rotation vector ω (rad) and the translation t (mm).
//! Derivatives are those of a rotation that is multiplied from the left, exact at any ω, so a
//! frame that is turned by 120° is fitted as well as one that is not; a rotation vector beyond half
//! a turn is exchanged for the shorter one of the same rotation ([`unwind`]), which keeps clear of
//! the full turn, the one place where a rotation vector is singular. Turns are about the base's
//! origin: a small one does not move the robot by the distance of the instrument.

use super::about::{About, Form, Owner, Prior, Quantity, Role, Setting, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::units::Unit;
use super::{Effect, Placed};
use crate::lanes::{add_scaled, cross, scaled, times};

const ABOUT: About = About {
    id: "measuring-frame",
    title: phrase!("Measuring frame"),
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[
        Quantity::new("about_x_mrad", Unit::MILLIRADIAN),
        Quantity::new("about_y_mrad", Unit::MILLIRADIAN),
        Quantity::new("about_z_mrad", Unit::MILLIRADIAN),
        Quantity::new("x_mm", Unit::MM),
        Quantity::new("y_mm", Unit::MM),
        Quantity::new("z_mm", Unit::MM),
    ]),
    setting: Setting::Setup,
    equation: "p = R(ω) p + t",
    source: "a rigid motion of the instrument",
    cause: phrase!("the instrument stands where it was put"),
    usual_size: phrase!("any"),
    confused_with: phrase!("the base frame: only reference points on the base tell"),
    check: phrase!("measure reference points on the base in every setup"),
    role: Role::FreeFrame,
    owner: Owner::Session,
    priors: &[
        Prior::of_aligned(0.02),
        Prior::of_aligned(0.02),
        Prior::of_aligned(0.02),
        Prior::of_aligned(20.0),
        Prior::of_aligned(20.0),
        Prior::of_aligned(20.0),
    ],
    ..About::PLAIN
};

/// The effect `measuring-frame`: the instrument's frame of one setup, free in six parameters.
pub static MEASURING_FRAME: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let omega = [me.coefficients[0], me.coefficients[1], me.coefficients[2]];
    let shift = [me.coefficients[3], me.coefficients[4], me.coefficients[5]];
    let rotation = rotation(omega);
    let left = left_jacobian(omega);
    // ∂(R x)/∂ω_k = (J_l e_k) × (R x), J_l the left Jacobian of SO(3).
    let spins: [[f64; 3]; 3] = std::array::from_fn(|k| times(left, AXES[k]));
    block.transform(me, |x, at| {
        if at.setup == me.setting {
            let turned = times(rotation, x);
            let columns = [
                cross(spins[0], turned),
                cross(spins[1], turned),
                cross(spins[2], turned),
                AXES[0],
                AXES[1],
                AXES[2],
            ];
            (add_scaled(turned, shift, 1.0), rotation, columns)
        } else {
            (x, AXES, [[0.0; 3]; 6])
        }
    });
}

/// Exchanges a rotation vector of more than half a turn for the shorter one of the same rotation.
pub(crate) fn unwind(coefficients: &mut [f64]) {
    use std::f64::consts::{PI, TAU};
    let omega = [coefficients[0], coefficients[1], coefficients[2]];
    let angle = crate::lanes::dot(omega, omega).sqrt();
    // A little beyond half a turn is left alone, lest a fit hop to and fro there.
    if angle > 1.25 * PI {
        let shorter = angle - TAU * (angle / TAU).round();
        for (coefficient, omega) in coefficients.iter_mut().zip(omega) {
            *coefficient = omega / angle * shorter;
        }
    }
}

/// Rotation matrix of a rotation vector, by rows (Rodrigues).
pub(crate) fn rotation(omega: [f64; 3]) -> [[f64; 3]; 3] {
    let (a, b, _) = rodrigues_factors(omega);
    from_factors(omega, 1.0, a, b)
}

/// Left Jacobian of SO(3), by rows: `1 + b [ω] + c [ω]²`.
pub(crate) fn left_jacobian(omega: [f64; 3]) -> [[f64; 3]; 3] {
    let (_, b, c) = rodrigues_factors(omega);
    from_factors(omega, 1.0, b, c)
}

/// sin θ/θ, (1 − cos θ)/θ², (θ − sin θ)/θ³, by their series near zero.
fn rodrigues_factors(omega: [f64; 3]) -> (f64, f64, f64) {
    let t2 = crate::lanes::dot(omega, omega);
    if t2 < 1e-6 {
        let a = 1.0 - t2 / 6.0 + t2 * t2 / 120.0;
        let b = 0.5 - t2 / 24.0 + t2 * t2 / 720.0;
        let c = 1.0 / 6.0 - t2 / 120.0 + t2 * t2 / 5040.0;
        (a, b, c)
    } else {
        let t = t2.sqrt();
        (t.sin() / t, (1.0 - t.cos()) / t2, (t - t.sin()) / (t2 * t))
    }
}

/// `one·1 + a [ω] + b [ω]²` by rows.
fn from_factors(omega: [f64; 3], one: f64, a: f64, b: f64) -> [[f64; 3]; 3] {
    let columns = AXES.map(|e| {
        let once = cross(omega, e);
        let twice = cross(omega, once);
        add_scaled(add_scaled(scaled(e, one), once, a), twice, b)
    });
    std::array::from_fn(|row| std::array::from_fn(|column| columns[column][row]))
}
