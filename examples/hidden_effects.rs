//! The bar for finding and naming hidden effects, measured on sessions that an independent rig
//! makes (`tests/support/rig.rs`, which shares no code with the model).
//!
//! `cargo run --release --no-default-features --example hidden_effects [SESSIONS PER CELL] [ROW]`
//!
//! With `DETAILS` in the environment every session that went wrong is told on the error stream, and with
//! `SESSIONS=FOLDER` written there as well.

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
