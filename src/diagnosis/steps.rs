//! What each effect adds, in the order of what it adds, with its evidence in numbers and words.

use nalgebra::DMatrix;

use crate::effects::{Term, called, stated};
use crate::text::Text;

use super::columns::Among;
use super::familywise::FamilyP;
use super::final_set::{Worth, worth};
use super::prepare::Prepared;
use super::regression::{Fit, Regression};
use super::search::compatible;
use super::step_time;
use super::values::Values;
use crate::answers::diagnosis::{Floor, Found};
use crate::linear::{Basis, along, reject_all};

/// Within so much, as a logarithm, of the next name that one is refitted before they are compared.
const CLOSE: f64 = 6.0;

/// One effect more, in the order of what each adds.
pub(crate) struct Step {
    pub(crate) term: Term,
    pub(crate) gap_mm: [f64; 2],
    pub(crate) held_out_mm: Option<[f64; 2]>,
    /// The same over everything that was measured, each kind in units of its noise.
    pub(crate) held_out: Option<[f64; 2]>,
}

pub(crate) fn steps(prepared: &Prepared, base: &Fit, fit: &Fit) -> Vec<Step> {
    let regression = &prepared.regression;
    let mut left: Vec<Term> = regression.added(fit).into_iter().cloned().collect();
    let mut now = regression.fit(&base.model, &fit.shapes);
    let unseen_of = |fit: &Fit| {
        let unseen = prepared.folds.unseen(regression, fit);
        (unseen.rms_mm, unseen.rms)
    };
    let mut unseen = unseen_of(&now);
    let gap = |fit: &Fit| {
        let (raw, _) = regression.rows.extract(&fit.model);
        let mut e = raw;
        for shape in &fit.shapes {
            e -= &shape.raw * &shape.coefficients;
        }
        regression.rows.rms_mm(&e)
    };
    let mut steps = Vec::new();
    let (raw, columns) = regression.raw(&fit.model);
    let (_, white) = regression.whitened(&fit.model, &raw, &columns);
    while !left.is_empty() {
        let with = |index: usize| {
            let term = &left[index];
            let absent = Term::absent(term.effect, term.joint, term.setting);
            regression.fit(&now.model.with_term(absent), &now.shapes)
        };
        let fits = likeliest(regression, (fit, &white), &now, &left);
        let fits = fits.into_iter().map(|index| (index, with(index)));
        let best = fits.max_by(|a, b| a.1.ln_evidence.total_cmp(&b.1.ln_evidence));
        let Some((index, next)) = best else { break };
        let seen = unseen_of(&next);
        let says = prepared.folds.say_something();
        steps.push(Step {
            term: left.remove(index),
            gap_mm: [gap(&now), gap(&next)],
            held_out_mm: says.then_some([unseen.0, seen.0]),
            held_out: says.then_some([unseen.1, seen.1]),
        });
        (now, unseen) = (next, seen);
    }
    steps
}

/// Of many terms only so many are fitted before one is chosen.
const FITTED: usize = 3;

/// Places of the terms that may be the likeliest beside a fit with the fewer of them, by their columns in the fit
/// with all.
fn likeliest(
    regression: &Regression,
    (all, white): (&Fit, &DMatrix<f64>),
    now: &Fit,
    left: &[Term],
) -> Vec<usize> {
    let mut places: Vec<usize> = (0..left.len()).collect();
    if left.len() <= FITTED {
        return places;
    }
    let worth = |term: &Term| {
        let mut first = 0;
        for own in all.model.terms() {
            let size = own.coefficients.len();
            if own.same_column(term) {
                let mut free = white.columns(first, size).into_owned();
                reject_all(&now.basis.q, &mut free);
                let basis = Basis::new(&free);
                let gain = along(&basis.q, &now.residual).norm_squared();
                let share = (gain / now.rss.max(1e-300)).min(1.0 - 1e-12);
                // Of a vector the components that are not there are spared.
                let rank = basis.rank().min(2) as f64;
                return -0.5 * regression.m() * (-share).ln_1p()
                    - 0.5 * rank * regression.m().ln()
                    - regression.price_of_term(term);
            }
            first += size;
        }
        f64::NEG_INFINITY
    };
    let worths: Vec<f64> = left.iter().map(worth).collect();
    places.sort_by(|a, b| worths[*b].total_cmp(&worths[*a]).then(a.cmp(b)));
    places.truncate(FITTED);
    places.sort_unstable();
    places
}

/// The likeliest other name in the place of one.
pub(crate) struct Next {
    pub(crate) term: Term,
    /// Logarithm of how much likelier the rest is with it.
    pub(crate) ln_odds: f64,
    /// The rest with it, where it is close.
    pub(crate) fit: Option<Fit>,
}

impl Next {
    /// The likeliest that is compatible with the rest.
    pub(crate) fn than(prepared: &Prepared, fit: &Fit, term: &Term, worth: &Worth) -> Option<Self> {
        let regression = &prepared.regression;
        let about = term.effect.about();
        let there = regression.added(&worth.rest);
        // By the table beside the whole fit; what comes close is refitted.
        let scores = match regression.without(fit, term) {
            Some(rest) => {
                let around = regression.surroundings(fit, Among::Names);
                regression.scan_without(&around, &rest)
            }
            None => regression.scan(&worth.rest, Among::Names),
        };
        let others = scores.iter().filter_map(|score| {
            let other = regression.table.candidates[score.candidate].what.term()?;
            let same_name = other.effect.about().id == about.id
                && (!about.per_joint || other.joint == term.joint);
            (!same_name && compatible(&there, other)).then_some((score.ln_odds, other))
        });
        let (ln_odds, other) = others.max_by(|a, b| a.0.total_cmp(&b.0))?;
        // Where it is close it is refitted, as the name itself was.
        let fit = (worth.ln_odds - ln_odds < CLOSE).then(|| {
            let model = worth.rest.model.with_term(other.clone());
            regression.fit(&model, &worth.rest.shapes)
        });
        Some(Self {
            term: other.clone(),
            ln_odds: fit
                .as_ref()
                .map_or(ln_odds, |f| f.ln_evidence - worth.rest.ln_evidence),
            fit,
        })
    }
}

pub(crate) fn found(
    prepared: &Prepared,
    with_shapes: &Fit,
    steps: &[Step],
    floor: &Floor,
    values: &Values,
) -> Vec<Found> {
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
        let p_family = regression.family_p(worth.minus_ln_p, with_shapes);
        let share = step.gap_mm[0].powi(2) - step.gap_mm[1].powi(2);
        let odds = over.clamp(-30.0, 30.0).exp();
        let within_s = step_time::within_s(prepared, term, &worth);
        let mut says = says(step, &p_family, odds, next.as_deref(), floor);
        if let Some(of) = stated(&regression.base.robot, term) {
            says = text!(
                "{evidence}; {cycles} for a turn of the motor, by the stated gear ratio of {ratio}",
                evidence = says,
                cycles = of.per_motor_turn,
                ratio = of.ratio
            );
        }
        if let Some([from, to]) = within_s {
            says = text!(
                "{evidence}; the step lies between {from} and {to} s (95 %)",
                evidence = says,
                from = format!("{from:.0}"),
                to = format!("{to:.0}")
            );
        }
        Found {
            effect: about.id,
            joint: about.per_joint.then_some(term.joint + 1),
            parameters: values.parameters_of(term),
            figures: values.model.figures_of(term, &prepared.problem.inputs),
            p_family,
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
            says,
            check: about.check,
        }
    };
    steps.iter().map(one).collect()
}

fn says(step: &Step, p: &FamilyP, odds: f64, next: Option<&str>, floor: &Floor) -> Text {
    let sign = if p.bound { '<' } else { '=' };
    let p = format!("{sign} {}", p.p);
    let evidence = match next {
        Some(next) if odds > 1000.0 => text!(
            "p {p} (chance that noise alone looks like this); more than 1000 times likelier than the next candidate ({next})",
            p = p,
            next = called(next)
        ),
        Some(next) => text!(
            "p {p} (chance that noise alone looks like this); {times} times likelier than the next candidate ({next})",
            p = p,
            times = format!("{odds:.1}"),
            next = called(next)
        ),
        None => text!(
            "p {p} (chance that noise alone looks like this); no other effect was a candidate",
            p = p
        ),
    };
    match step.held_out_mm {
        Some([without, with]) => text!(
            "{evidence}; cross-validated RMS error {without} → {with} mm, floor {floor}",
            evidence = evidence,
            without = format!("{without:.4}"),
            with = format!("{with:.4}"),
            floor = format!("{:.4}", floor.mm)
        ),
        None => evidence,
    }
}
