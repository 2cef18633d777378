//! Foundation compliance: the robot as a whole tilts in proportion to its overturning moment.
//!
//! ```text
//! M = Σ m r × g,   ω = C_x (M·x) x + C_y (M·y) y,   p = exp([ω]) p
//! ```
//!
//! The weights are the load, at the tool's origin, and the links whose masses are given; all are where the commands
//! put them (the effect of errors on the moment is of second order). r counts from the origin of the base frame, where
//! the robot is bolted down. x and y are perpendicular to gravity: x is the base frame's x (y, where gravity is along
//! x) projected, y = down × x reversed, so that with gravity along −z they are the base frame's own.

use super::about::{About, Form, Over, Quantity, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::gravity::{overturning_nm, overturning_slope};
use super::needs::Need;
use super::rotation::{left_jacobian, rotation};
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::lanes::{LANES, add_scaled, cross, dot, scaled, times};
use crate::rounding;
use crate::text::Text;

const ABOUT: About = About {
    id: "foundation-compliance",
    title: phrase!("Foundation compliance"),
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[
        Quantity::new(
            "about_x_urad_per_nm",
            Unit::MICRORADIAN_PER_NM.with_example(2.0),
        ),
        Quantity::new(
            "about_y_urad_per_nm",
            Unit::MICRORADIAN_PER_NM.with_example(2.0),
        ),
    ]),
    equation: "p = exp([ω]) p, ω = C M, M the overturning moment about the base's origin",
    source: "a foundation as two torsion springs; ISO 10218-2: moments that a base has to carry",
    cause: phrase!(
        "the pedestal, the floor or the base's bolts give way under the moment of load and arm"
    ),
    over: Over::Load,
    of_other_joints: true,
    needs: &[Need::GRAVITY, MOMENT],
    no_component_negative: true,
    implausible_above: Some(100.0),
    usual_size: phrase!("0.1 to 10 µrad/(N·m)"),
    confused_with: phrase!(
        "link droop where all reflectors are at one height and one radius: another height parts them"
    ),
    check: phrase!(
        "the bolts and the pedestal; a dial gauge at the base while the loaded arm swings round"
    ),
    ..About::PLAIN
};

/// An overturning moment that changes in other ways than the frame of a single axis.
const MOMENT: Need = Need {
    what: phrase!("different loads, or several joints that carry a load or link masses around"),
    unmet: |survey, _| {
        let weight = survey.largest_load_kg > 0.0 || survey.link_masses;
        let carried =
            survey.joints.len() > 1 && weight && survey.joints.iter().any(|j| j.values > 2);
        (survey.loads < 2 && !carried).then(|| {
            if weight {
                text!("the load never changed, and a single axis only carries it round")
            } else {
                text!(
                    "neither a load nor a link mass is given: there is no known overturning moment"
                )
            }
        })
    },
    idle: |offered| {
        (!offered.load && !offered.link_masses)
            .then_some(phrase!("the scenario has no load, and no link a mass"))
    },
};

pub(super) static FOUNDATION_COMPLIANCE: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(_: &Robot, _: &Term) -> Text {
    text!("stiffen the foundation, or give the controller a payload model")
}

fn act(me: &Placed, block: &mut Block) {
    let Some(down) = me.down else {
        block.transform(me, |p, _| (p, AXES, [[0.0; 3]; 2]));
        return;
    };
    let (x, y) = across(down);
    let moments: [[f64; 3]; LANES] = std::array::from_fn(|lane| overturning_nm(block, lane));
    block.transform(me, |p, at| {
        let moment = moments[at.lane];
        let by = [scaled(x, dot(moment, x)), scaled(y, dot(moment, y))];
        let omega = add_scaled(scaled(by[0], me.coefficients[0]), by[1], me.coefficients[1]);
        let turn = rotation(omega);
        let to = times(turn, p);
        let left = left_jacobian(omega);
        (to, turn, by.map(|by| cross(times(left, by), to)))
    });
    if !block.by_command() {
        return;
    }
    let turned_by = |moment: [f64; 3]| {
        let by = [scaled(x, dot(moment, x)), scaled(y, dot(moment, y))];
        add_scaled(scaled(by[0], me.coefficients[0]), by[1], me.coefficients[1])
    };
    for joint in 0..block.robot.joints.len() {
        let slopes: [[f64; 3]; LANES] =
            std::array::from_fn(|lane| overturning_slope(block, joint, lane));
        block.shift_by_command_of(me, joint, |p, at| {
            let left = left_jacobian(turned_by(moments[at.lane]));
            cross(times(left, turned_by(slopes[at.lane])), p)
        });
    }
}

/// Two directions across gravity.
fn across(down: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let projected = |v: [f64; 3]| add_scaled(v, down, -dot(v, down));
    let unit = |v: [f64; 3]| scaled(v, 1.0 / dot(v, v).sqrt());
    let first = projected(AXES[0]);
    let x = if dot(first, first) > rounding::WRITTEN {
        unit(first)
    } else {
        unit(projected(AXES[1]))
    };
    (x, cross(x, down))
}
