//! The bar for finding and naming hidden effects, measured on sessions that an independent rig
//! makes (`tests/support/rig.rs`, which shares no code with the model).
//!
//! `cargo run --release --no-default-features --example hidden_effects [SESSIONS PER CELL] [ROW]`
//!
//! With `DETAILS` in the environment every session that went wrong is told on the error stream, and with
//! `SESSIONS=FOLDER` written there as well.
//!
//! Measured in November 2026 (builds of one day). Inside the assumptions (white, heavy-tailed, correlated, unequal or polluted noise,
//! effects of the catalogue):
//!
//! | what | measured | wanted |
//! | --- | --- | --- |
//! | false alarms on noise alone, eight kinds | 7 of 640 | ≤ 1 % |
//! | of these correlated in time, ρ = 0.5 / 0.8, and tails, correlation, unequal axes and outliers at once | 5 / 4 / 11 of 400 each | |
//! | one effect, not aliased, named exactly, λ = 200 / 100 / 40 | 99.6 / 97.9 / 90.1 % of some 475 each | ≥ 99 / 97 / 75 % |
//! | the same where two other names leave less than a tenth of it | 100 / 93 / 84 % of some 165 each | |
//! | 95 % intervals after the search: zero offset and length / what was found, λ = 200, 100, 40 | 94.0, 94.9, 94.1 % / 94.9, 94.7, 95.3 % of 950 to 1280 each | 93–97 % |
//! | a step of the frame lies between the times that are said with 95 % | 90 of 94 | 93–97 % |
//! | RMS error on unseen samples made worse by the names, λ = 200 / 100 / 40 | 0 / 0 / 0.8 % of some 630 each | ≤ 0.5 % |
//! | RMS error on as many unseen samples over the noise, at worst of these rows | 1.028 | ≤ 1.03 |
//! | three effects at once, two reflectors, each with λ ≥ 100 beside the other two: exact | 134 of 137 | ≥ 95 % |
//! | the same where the other two leave less of one | 10 of 23 | |
//! | ambiguity resolved by the proposed poses in the first round: one radius (7.8 poses) / one speed (2.8) | 27 of 27 / 59 of 60 | ≥ 95 % |
//! | a bump, a sawtooth, a plateau: flagged / named | 119 of 120 / 0 | ≥ 95 % / ≤ 5 % |
//!
//! Outside of them, before and after the noise had a slow part, names had rivals and the verdict had a floor (rows `verdict` … `runaway`;
//! "before" is what the same rows gave until then, often with more sessions):
//!
//! | what | before | now | wanted |
//! | --- | --- | --- | --- |
//! | more is left than noise: said to be explained or noise | 75 of 80 | 0 of 157 | 0 |
//! | a frame that wanders, nothing hidden: a part of the machine named; of these a base offset or a scale of the instrument alone | 49 of 120; 36 | 6 of 180; 6 (an ideal test: 4 of these, 11 of 900) | ≤ 1 % |
//! | the same: said that the frame wanders | 0 of 120 | 152 of 180 | |
//! | one effect beside a frame that wanders, λ = 200, poses shuffled / in sweeps: exact | 40 of 107 | 66 of 76 / 68 of 79 | ≥ 95 % |
//! | one component of a vector effect, λ = 200: named or in the set | 72 of 84 | 279 of 280 | ≥ 99 % |
//! | the same, λ = 100 | 72 of 84 | 277 of 280 | ≥ 99 % |
//! | intervals of `identify`, ρ = 0.5 / 0.8 / slow noise | 82 / 65 / 70 % | 95.1 / 94.7 % of 1380 each / 93.1 % of 6400 | 93–97 % |
//! | intervals of `diagnose` beside a bump / a plateau | 50 / 50 % | 94 / 94 % of 120 each | 93–97 % |
//! | sizes near the detection limit, λ = 16: intervals / mean size over true size | 91 % / 1.25 | 94.5 % of 274 / 1.03 | 93–97 % / 0.95–1.05 |
//! | outliers of 7 to 20 σ caught / good samples accused | 84–91 % / 0 | 98–100 % of 3388 / 0.1 % | ≥ 95 % / ≤ 0.5 % |
//! | a name with p above 0.002, with odds under 1, or beyond the cap | 23 of 160 | 0 of 120 | 0 |
//! | a kink, levels by sector, a chirp, λ = 400: flagged / named | 63 / 57 % | 89 / 11 % of 120 (a perfect test: 74 % flagged); 75 / 0 of 75 where two names leave λ ≥ 50 | ≥ 95 % / ≤ 5 % |
//! | a gear order that is not whole: named alone with its number | 0 of 80 | 36 of 40, and alone with a nearby number 4 of 40 | |
//! | names with which the cross-validated error does not fall | 4 of 320 | 0 of 480 | 0 |
//! | poor designs: zero offset beyond 180°, negative width, interval beside "not determined" | 1 / 62 / 43 of 3000 | 0 / 0 / 0 of 2400 | 0 |
//!
//! Where "now" misses "wanted", two rows have a bound that no test passes. The mean of a wander is a base offset while it lasts: a test that knows
//! path, size and time constant of the wander, and only asks whether it wanders or the base stands elsewhere, takes 1.2 %
//! of the sessions for an offset (`examples/hidden_effects/ideal_noise.rs`). And of the strange shapes a perfect
//! test flags 74 %. A kink that eccentricity alone imitates within the noise stays its name. Of the 19 false alarms in correlated noise 12 are
//! sessions of 30 samples, too few to show that the noise is correlated. In a single sweep the angle is slow
//! in time too, and an effect beside a wander is named less often than with shuffled poses. For slow noise the intervals are
//! at the lower end of what is wanted, and lower in sweeps than with shuffled poses.

#![allow(clippy::print_stdout, reason = "the table is what this program is for")]
#![allow(
    unreachable_pub,
    reason = "the parts of this program are modules of one example"
)]

#[path = "hidden_effects/absorbed.rs"]
mod absorbed;
#[path = "hidden_effects/alias.rs"]
mod alias;
#[path = "hidden_effects/asked.rs"]
mod asked;
#[path = "hidden_effects/cells.rs"]
mod cells;
#[path = "hidden_effects/component.rs"]
mod component;
#[path = "hidden_effects/final_set.rs"]
mod final_set;
#[path = "hidden_effects/form.rs"]
mod form;
#[path = "hidden_effects/ideal_noise.rs"]
mod ideal_noise;
#[path = "hidden_effects/intervals.rs"]
mod intervals;
#[path = "hidden_effects/known.rs"]
mod known;
#[path = "hidden_effects/noise.rs"]
mod noise;
#[path = "hidden_effects/outliers.rs"]
mod outliers;
#[path = "../tests/support/rig.rs"]
mod rig;
#[path = "hidden_effects/runaway.rs"]
mod runaway;
#[path = "hidden_effects/slow.rs"]
mod slow;
#[path = "hidden_effects/small.rs"]
mod small;
#[path = "hidden_effects/strange.rs"]
mod strange;
#[path = "hidden_effects/unknown.rs"]
mod unknown;
#[path = "hidden_effects/verdict.rs"]
mod verdict;

use rig::{Design, Hidden, NAMES, Random, Rig};
use truepose::diagnosis::{Allowed, Diagnosis, Options};

fn diagnosed(rig: &Rig, without: &[&str]) -> Diagnosis {
    let options = Options {
        allowed: Allowed {
            without: without.iter().map(|id| (*id).to_owned()).collect(),
            only: None,
        },
        ..Options::default()
    };
    asked::diagnosed_with(rig, &options)
}

fn names(answer: &Diagnosis) -> Vec<&'static str> {
    let mut names: Vec<_> = answer.found.iter().map(|f| f.effect).collect();
    names.sort_unstable();
    names
}

/// A design as they come; some effects need a full turn or gravity across the axis to be told.
fn design(random: &mut Random, id: &str) -> Design {
    let needs_a_turn = [
        "joint-scale",
        "encoder-eccentricity",
        "base-offset",
        "bearing-runout",
    ];
    let half = random.unit() < 0.5 && !needs_a_turn.contains(&id);
    Design {
        span_deg: if half { 90.0 } else { 170.0 },
        shuffled: random.unit() < 0.5,
        gravity_across: id == "joint-compliance",
        ..Design::default()
    }
}

fn hidden(design: &Design, ids: &[&str], lambda: f64, random: &mut Random) -> Rig {
    let mut rig = Rig::new(design, random);
    for id in ids {
        let effect = Hidden::random(id, random, design);
        let effect = rig.sized(&effect, lambda);
        rig.hidden.push(effect);
    }
    rig.measure(random);
    rig
}

fn single_names() -> impl Iterator<Item = &'static str> {
    let aliased = ["lost-motion", "instrument-scale"];
    NAMES.into_iter().filter(move |id| !aliased.contains(id))
}

/// Whether the exchange leads from what was found to the truth.
fn reaches(answer: &Diagnosis, rival: &truepose::diagnosis::Equivalent, truth: &[&str]) -> bool {
    let mut set: Vec<&str> = names(answer);
    for gone in &rival.explanation {
        if let Some(at) = set.iter().position(|id| *id == gone.as_str()) {
            set.remove(at);
        }
    }
    set.extend(rival.instead.iter().map(String::as_str));
    set.sort_unstable();
    set == truth
}

/// Name and measurement of a row of the table.
type Row = (&'static str, fn(usize));

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let n = arguments.first().and_then(|n| n.parse().ok()).unwrap_or(25);
    let only = arguments.get(1).map(String::as_str);
    println!("| what | measured | bar |\n| --- | --- | --- |");
    let rows: [Row; 16] = [
        ("noise", noise::false_alarms),
        ("one", known::one_effect),
        ("three", known::three_effects),
        ("alias", alias::aliases),
        ("unknown", unknown::unknown),
        ("without", unknown::one_name_left_out),
        ("verdict", verdict::more_than_noise),
        ("slow", slow::wandering),
        ("component", component::one_component),
        ("intervals", intervals::intervals),
        ("small", small::near_the_limit),
        ("outliers", outliers::outliers),
        ("final", final_set::final_set),
        ("strange", strange::strange),
        ("heldout", form::target_form),
        ("runaway", runaway::poor_designs),
    ];
    for (name, measure) in rows {
        if only.is_none_or(|only| only == name) {
            measure(n);
        }
    }
}
