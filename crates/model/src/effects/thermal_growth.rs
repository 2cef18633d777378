//! Thermal growth: `R (1 + α (T − 20 °C))`, R from the joint's axis to the measured reflector.

use super::about::{About, Condition, Form, Over, Quantity, Stage};
use super::block::Block;
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::lanes::{add_scaled, dot, minus, scaled};
use crate::text::Text;

const ABOUT: About = About {
    id: "thermal-growth",
    title: phrase!("Thermal growth"),
    stage: Stage::Link,
    form: Form::Plain(&[Quantity::new("ppm_per_degc", Unit::PPM_PER_KELVIN)]),
    equation: "R (1 + α (T − 20 °C))",
    source: "linear thermal expansion; ISO 230-3",
    cause: phrase!("the arm grows as it warms up: steel by some 12 ppm/K, aluminium by 23"),
    over: Over::Temperature,
    implausible_above: Some(230.0),
    usual_size: phrase!("0.12 to 0.23 mm per metre and 10 K"),
    confused_with: phrase!(
        "a drift in time while the machine warms up: a cool-down run parts them"
    ),
    check: phrase!(
        "let the machine warm up before measuring, or enter the arm's expansion in the controller"
    ),
    needs: &[Need::REVOLUTE, Need::TEMPERATURE],
    distinguished_by: &[Condition::Temperature],
    ..About::PLAIN
};

pub(super) static THERMAL_GROWTH: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(_: &Robot, _: &Term) -> Text {
    text!("let the machine warm up, or enter the arm's expansion in the controller")
}

fn act(me: &Placed, block: &mut Block) {
    let alpha = me.coefficients[0];
    let (origin, along) = (me.frame.origin_mm, me.frame.along);
    block.transform(me, |x, at| {
        let arm = minus(x, origin);
        let radius = add_scaled(arm, along, -dot(arm, along));
        let growth = alpha * at.above_20_c;
        let jacobian = identity_plus_across(along, growth);
        (
            add_scaled(x, radius, growth),
            jacobian,
            [scaled(radius, at.above_20_c)],
        )
    });
}

/// `1 + k (1 − u uᵀ)`: stretches by k across the direction u.
fn identity_plus_across(u: [f64; 3], k: f64) -> [[f64; 3]; 3] {
    std::array::from_fn(|row| {
        std::array::from_fn(|column| {
            let same = f64::from(u8::from(row == column));
            same + k * (same - u[row] * u[column])
        })
    })
}
