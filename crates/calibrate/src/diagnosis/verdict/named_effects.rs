//! The names that were found, each with its evidence in numbers and words.

use crate::answers::diagnosis::{Floor, FoundEffect};
use crate::effects::{Term, called, stated};
use crate::odds;
use crate::text::Text;
use crate::text::{angle, lengths};

use super::equal_steps::orders_that_look_alike;
use super::step_time;
use super::values::Values;
use crate::diagnosis::evidence::FamilyP;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::{EQUALLY_LIKELY, Next, Step, worth};

pub(crate) fn found(
    prepared: &PreparedSearch,
    with_shapes: &Fit,
    steps: &[Step],
    floor: &Floor,
    values: &Values,
) -> Vec<FoundEffect> {
    let regression = &prepared.regression;
    let explained: f64 = steps
        .iter()
        .map(|s| s.gap_mm[0].powi(2) - s.gap_mm[1].powi(2))
        .sum();
    let one = |step: &Step| {
        let about = step.term.effect.about();
        let term = &step.term;
        let worth = worth(prepared, with_shapes, term);
        let next = Next::than(prepared, with_shapes, term, &worth);
        let over = worth.ln_odds - next.as_ref().map_or(0.0, |n| n.ln_odds.max(0.0));
        let next = next.map(|n| n.term.name_on(&regression.base.robot));
        let p_familywise = regression.family_p(worth.minus_ln_p, with_shapes);
        let share = step.gap_mm[0].powi(2) - step.gap_mm[1].powi(2);
        let equal = over.abs() <= EQUALLY_LIKELY;
        let odds = if equal {
            1.0
        } else {
            over.clamp(-odds::BEYOND_DOUBT.nats(), odds::BEYOND_DOUBT.nats())
                .exp()
        };
        let within_s = step_time::within_s(prepared, term, &worth);
        let notes = notes(prepared, term, within_s);
        let evidence = describe(step, &p_familywise, odds, next.as_deref(), floor);
        FoundEffect {
            effect: about.id,
            joint: about.per_joint.then_some(term.joint + 1),
            parameters: values.parameters_of(term),
            figures: values.model.figures_of(term, &prepared.problem.inputs),
            p_familywise,
            share: if explained > 0.0 {
                (share / explained).clamp(0.0, 1.0)
            } else {
                0.0
            },
            gap_mm: step.gap_mm,
            held_out_mm: step.held_out_mm,
            odds_over_next: odds,
            within_s,
            next,
            explanation: Text::listed(std::iter::once(&evidence).chain(&notes), "; "),
            notes,
            check: about.check,
        }
    };
    steps.iter().map(one).collect()
}

/// The description of an effect apart from its evidence.
fn notes(prepared: &PreparedSearch, term: &Term, within_s: Option<[f64; 2]>) -> Vec<Text> {
    let mut notes = Vec::new();
    if let Some(of) = stated(&prepared.regression.base.robot, term) {
        notes.push(text!(
            "{cycles} for a turn of the motor, by the stated gear ratio of {ratio}",
            cycles = of.per_motor_turn,
            ratio = of.ratio
        ));
    }
    if let Some((step, orders)) = orders_that_look_alike(prepared, term) {
        let orders: Vec<String> = orders.iter().map(u32::to_string).collect();
        notes.push(text!(
            "at equal steps of {step} a gear error of {orders} … cycles per turn would look the same: poses at unequal steps tell them apart",
            step = angle(step, 2),
            orders = orders.join(", ")
        ));
    }
    if let Some([from, to]) = within_s {
        notes.push(text!(
            "the step lies between {from} and {to} s (95 %)",
            from = format!("{from:.0}"),
            to = format!("{to:.0}")
        ));
    }
    notes
}

pub(crate) fn describe(
    step: &Step,
    p: &FamilyP,
    odds: f64,
    next: Option<&str>,
    floor: &Floor,
) -> Text {
    let sign = if p.bound { '<' } else { '=' };
    let p = format!("{sign} {}", p.p);
    let evidence = match next {
        Some(next) if odds > odds::CLEAR.0 => text!(
            "p {p} (chance that noise alone looks like this); more than 1000 times likelier than the next candidate ({next})",
            p,
            next = called(next)
        ),
        Some(next) => text!(
            "p {p} (chance that noise alone looks like this); {times} times likelier than the next candidate ({next})",
            p,
            times = format!("{odds:.1}"),
            next = called(next)
        ),
        None => text!(
            "p {p} (chance that noise alone looks like this); no other effect was a candidate",
            p
        ),
    };
    match step.held_out_mm {
        Some([without, with]) => text!(
            "{evidence}; cross-validated RMS error {change}, floor {floor}",
            evidence,
            change = lengths([without, with], 4),
            floor = format!("{:.4}", floor.mm)
        ),
        None => evidence,
    }
}
