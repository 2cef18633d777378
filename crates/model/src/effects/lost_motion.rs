//! Lost motion: `θ = q − s·(w/2)(1 − 2 e^(−Δ/f))`, Δ the travel since the joint reversed.
//!
//! Friction and wind-up let the backlash build up over some travel f instead of at once; as
//! f → 0 it becomes plain backlash.

use super::about::{About, Condition, Form, Over, Quantity, Setting};
use super::block::{Block, Turned};
use super::needs::Need;
use super::term::fade;
use super::units::Unit;
use super::{Effect, Placed};

const ABOUT: About = About {
    id: "lost-motion",
    title: phrase!("Lost motion"),
    form: Form::Fading(Quantity::new("width_deg", Unit::DEGREE).sliding("width_mm", Unit::MM)),
    setting: Setting::Fade,
    equation: "θ = q − s·(width/2)(1 − 2 e^(−Δ/fade)), Δ travel since the reversal",
    source: "hysteresis loop of a reducer with friction, exponential build-up",
    cause: phrase!("friction in the reducer winds the drive up after each reversal"),
    over: Over::Travel,
    non_negative: true,
    implausible_above: Some(0.33),
    usual_size: phrase!("0.5′ to 2′"),
    confused_with: phrase!("backlash: approaches of three different lengths part them"),
    check: phrase!("lubrication and preload of the reducer"),
    needs: &[Need::BOTH_SIDES],
    distinguished_by: &[Condition::Speed, Condition::Approach],
    becomes: Some("backlash"),
    ..About::PLAIN
};

pub(super) static LOST_MOTION: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let width = me.coefficients[0];
    // A fade of zero is the limit, backlash; 0/0 at a travel of zero must not arise.
    let per_fade = 1.0 / fade(me.setting, me.coefficients[1]).max(f64::MIN_POSITIVE);
    block.turn(me, |theta, at| {
        let fades = at.travel * per_fade;
        let left = (-fades).exp();
        let lag = -0.5 * at.dir * (1.0 - 2.0 * left);
        // ∂lag/∂u with fade = f₀ eᵘ; zero after a long way (∞·0 must not arise).
        let by_u = if left > 0.0 {
            at.dir * left * fades
        } else {
            0.0
        };
        Turned {
            value: theta + lag * width,
            by_input: 1.0,
            by_coefficient: [lag, by_u * width],
        }
    });
}
