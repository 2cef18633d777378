//! Pitch error of a ball screw: `q' = q + A sin(2π q/p + φ)`, p the lead of the screw.
//!
//! A thread that is not cut evenly, a nut or a bearing that runs out comes round with every turn of
//! the screw. The coefficients are A cos φ and A sin φ; the lead p is scanned: whole and half
//! millimetres and parts of an inch, as screws are made.

use super::about::{About, Form, Listed, Quantity, Setting};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};
use crate::kinematics::JointKind;
use crate::sincos::sin_cos_small as sin_cos;

const ABOUT: About = About {
    id: "screw-pitch",
    title: phrase!("Screw pitch error"),
    form: Form::Harmonic(Quantity::new("amplitude_mm", Unit::MM.with_example(0.02))),
    setting: Setting::Listed(&LEAD),
    equation: "q' = q + A sin(2π q/lead + φ)",
    source: "ISO 3408-3: travel variation within one revolution, v2πp",
    cause: phrase!(
        "the thread of the screw is uneven, or the screw's bearing or the encoder on it runs out"
    ),
    needs: &[
        Need::PRISMATIC,
        Need::values::<6>(phrase!("six values of the joint")),
        TURNS,
    ],
    implausible_above: Some(0.2),
    usual_size: phrase!("1 to 20 µm"),
    confused_with: phrase!(
        "another lead, where the poses are equal steps of the travel: unequal steps part them"
    ),
    check: phrase!(
        "the screw's runout and its thrust bearing; the coupling and the encoder on the screw"
    ),
    ..About::PLAIN
};

/// The travel of one turn of the screw.
const LEAD: Listed = Listed {
    quantity: Quantity::new("lead_mm", Unit::MM.with_example(10.0)),
    tried: |survey, joint| {
        let most = survey.joints[joint].span / LEAST_TURNS;
        leads().filter(|lead| *lead <= most).collect()
    },
    expected: phrase!("a lead from 0.5 to 200 mm"),
    takes: |lead, _, _| (0.5..=200.0).contains(&lead),
    usual: |_| None,
};

/// A wave over less than so many turns passes for a scale and a bend.
const LEAST_TURNS: f64 = 1.5;

/// Leads of screws, mm: by halves to 5, whole to 50, and parts of an inch.
fn leads() -> impl Iterator<Item = f64> {
    let halves = (2..10).map(|k| 0.5 * f64::from(k));
    let whole = (5..=50).map(f64::from);
    let inches = [0.1, 0.2, 0.25, 0.5].map(|inch| 25.4 * inch);
    halves.chain(whole).chain(inches)
}

/// Some turns of the screw.
const TURNS: Need = Need::of_samples(
    phrase!("a travel of several turns of the screw"),
    |survey, joint| {
        let none = (LEAD.tried)(survey, joint).is_empty();
        none.then(|| text!("the joint moved by less than one and a half turns of any screw"))
    },
);

pub(super) static SCREW_PITCH: Effect = Effect {
    exists_on,
    ..Effect::new(ABOUT, act)
};

fn exists_on(_: usize, kind: JointKind) -> bool {
    kind == JointKind::Prismatic
}

fn act(me: &Placed, block: &mut Block) {
    let (a, b) = (me.coefficients[0], me.coefficients[1]);
    let per_mm = std::f64::consts::TAU / me.setting.max(f64::MIN_POSITIVE);
    block.turn(me, |q, at| {
        let (s, c) = sin_cos(per_mm * at.q);
        Turned {
            value: q + a * s + b * c,
            by_input: 1.0,
            by_coefficient: [s, c],
        }
    });
    block.turn_by_command(me, me.joint, |at| {
        let (s, c) = sin_cos(per_mm * at.q);
        per_mm * (a * c - b * s)
    });
}
