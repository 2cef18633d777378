//! A free measuring frame: `p = R(ω) p + t` for the samples of one setup.
//!
//! Not an effect of the robot, so it is not in the catalogue: it is the place of the instrument in each setup. The
//! coefficients are the rotation vector ω (rad) and the translation t (mm).
//! Derivatives are those of a rotation that is multiplied from the left, exact at any ω, so a
//! frame that is turned by 120° is fitted as well as one that is not; a rotation vector beyond half
//! a turn is exchanged for the shorter one of the same rotation ([`unwind`]), which keeps clear of
//! the full turn, the one place where a rotation vector is singular. Turns are about the base's
//! origin: a small one does not move the robot by the distance of the instrument.

use super::about::{About, Form, Owner, Prior, Quantity, Role, Setting, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::rotation::{left_jacobian, rotation};
use super::units::Unit;
use super::{Effect, Placed};
use crate::lanes::{add_scaled, cross, times};

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
    cause: phrase!("the instrument's position differs from setup to setup"),
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
    if !block.is_of_setup(me.setting) {
        return;
    }
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
