//! Short and poor sessions: a few samples over a few degrees, from one side, one reflector. What
//! they do not determine has no interval, and nothing runs away.

use std::collections::BTreeSet;

use truepose::diagnosis::Options;
use truepose::effects::Term;
use truepose::fit::Estimate;

use crate::asked::{as_json, diagnosed_with, identified_with};
use crate::cells::{details, in_parallel, row};
use crate::rig::{Design, Hidden, Random, Rig};
use crate::{hidden, single_names};

/// What is fitted beside zero offset and link length, in turn.
const ASKED: [&[&str]; 12] = [
    &[],
    &["base-offset"],
    &["encoder-eccentricity", "encoder-two-cycle"],
    &["gear-transmission-error"],
    &["bearing-runout", "axis-wobble"],
    &["backlash", "lost-motion"],
    &["tool-lateral-offset", "joint-scale"],
    &["frame-shift", "axis-tilt", "instrument-scale"],
    &["encoder-eccentricity", "base-offset"],
    &["joint-scale", "encoder-eccentricity", "base-offset"],
    &["encoder-two-cycle", "bearing-runout", "base-offset"],
    &[
        "joint-scale",
        "encoder-eccentricity",
        "encoder-two-cycle",
        "backlash",
        "axis-tilt",
        "base-offset",
        "instrument-scale",
    ],
];

/// What can go wrong in an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Wrong {
    FarAway,
    NoRobot,
    IntervalOfNothing,
    Negative,
    NotFinite,
}

pub fn poor_designs(n: usize) {
    let all = in_parallel(40 * n, session);
    let rows = [
        (Wrong::FarAway, "a zero offset beyond 180°", "0"),
        (
            Wrong::NoRobot,
            "a length, a place or a scale that no robot has",
            "",
        ),
        (
            Wrong::IntervalOfNothing,
            "an interval beside \"not determined\"",
            "0",
        ),
        (Wrong::Negative, "a negative amplitude or width", "0"),
        (Wrong::NotFinite, "a number that is not finite", "0"),
    ];
    for (place, command) in ["identify", "identify with orders given", "diagnose"]
        .into_iter()
        .enumerate()
    {
        for (wrong, name, bar) in rows {
            let own = all.iter().filter(|a| a[place].contains(&wrong));
            row(
                &format!("poor design, {command}: {name}"),
                own.count(),
                all.len(),
                bar,
            );
        }
    }
}

/// What went wrong in `identify`, in `identify` with orders given, and in `diagnose`.
fn session(k: usize) -> [BTreeSet<Wrong>; 3] {
    let mut random = Random(1009 + 275_604_541 * k as u64);
    let design = Design {
        samples: 3 + random.below(13),
        // Half of a range of 1 to 20 degrees.
        span_deg: 0.5 * 20.0_f64.powf(random.unit()),
        shuffled: random.unit() < 0.5,
        one_way: random.unit() < 0.7,
        one_speed: random.unit() < 0.5,
        conditions: random.unit() < 0.5,
        ..Design::default()
    };
    // Nothing in half of the sessions, else what may well not show: so it is large.
    let ids: Vec<&str> = single_names().filter(|id| visible(id, &design)).collect();
    let id = ids[random.below(ids.len())];
    let rig = if k.is_multiple_of(2) {
        hidden(&design, &[], 0.0, &mut random)
    } else {
        let mut rig = Rig::new(&design, &mut random);
        let size = random.between(1.0, 10.0);
        rig.hidden = vec![Hidden::random(id, &mut random, &design).times(size)];
        rig.measure(&mut random);
        rig
    };
    let told = |what: &str, found: &BTreeSet<Wrong>, all: &[Estimate], open: &[String]| {
        if !found.is_empty() {
            details(|| {
                let all: Vec<_> = all.iter().map(|e| (e.name, e.value, e.ci95)).collect();
                format!(
                    "{what} {k}: {found:?}; {} samples in ±{:.1}°, {:?}\n    {all:.3?} open {open:?}",
                    design.samples, design.span_deg, rig.hidden
                )
            });
        }
    };
    let asked = ASKED[k / 2 % ASKED.len()];
    let mut of_identify = [BTreeSet::new(), BTreeSet::new()];
    for (place, orders) in [(0, &[][..]), (1, &orders_given(&mut random))] {
        let answer = identified_with(&rig, asked, orders);
        let open: Vec<String> = answer
            .not_identifiable
            .iter()
            .map(|n| n.combination.to_string())
            .collect();
        let wrong = wrongs(&answer.parameters, &open);
        told("identify", &wrong, &answer.parameters, &open);
        of_identify[place] = wrong;
    }
    let answer = diagnosed_with(&rig, &Options::default());
    let mut all = answer.identified.clone();
    all.extend(answer.found.iter().flat_map(|f| f.parameters.clone()));
    let open = open_in(&as_json(&rig, &answer));
    let wrong = wrongs(&all, &open);
    told("diagnose", &wrong, &all, &open);
    let [plain, with_orders] = of_identify;
    [plain, with_orders, wrong]
}

/// Whether the design has the columns that the rig's effect takes.
fn visible(id: &str, design: &Design) -> bool {
    let conditioned = [
        "tracking-lag",
        "thermal-zero-drift",
        "joint-compliance",
        "thermal-growth",
        "link-droop",
    ];
    design.conditions || !conditioned.contains(&id)
}

/// Terms of known order, as a diagnosis hands them on.
fn orders_given(random: &mut Random) -> Vec<Term> {
    let order = 3.0 + random.below(40) as f64;
    let few = 2.0 + random.below(5) as f64;
    let term = |id: &str, order: f64| {
        Term::from_parameters(id, 1, &[("order", order)], 1).expect("a name and its order")
    };
    vec![
        term("gear-transmission-error", order),
        term("bearing-runout", few),
    ]
}

/// Combinations that `diagnose --json` calls not identifiable.
fn open_in(document: &serde_json::Value) -> Vec<String> {
    let all = document["not_identifiable"].as_array();
    let combination = |one: &serde_json::Value| one["combination"].as_str().map(str::to_owned);
    all.into_iter().flatten().filter_map(combination).collect()
}

fn wrongs(all: &[Estimate], open: &[String]) -> BTreeSet<Wrong> {
    let mut wrong = BTreeSet::new();
    for estimate in all {
        let sized = ["amplitude", "width"];
        if estimate.name == "offset_deg" && estimate.value.abs() > 180.0 {
            wrong.insert(Wrong::FarAway);
        }
        if beyond_any_robot(estimate) {
            wrong.insert(Wrong::NoRobot);
        }
        if sized.iter().any(|s| estimate.name.starts_with(s)) && estimate.value < 0.0 {
            wrong.insert(Wrong::Negative);
        }
        if estimate.ci95.is_some() && open.iter().any(|o| concerns(o, estimate)) {
            wrong.insert(Wrong::IntervalOfNothing);
        }
        let ends = estimate.ci95.into_iter().flatten();
        if ends.chain([estimate.value]).any(|v| !v.is_finite()) {
            wrong.insert(Wrong::NotFinite);
        }
    }
    wrong
}

/// Half of the rig's arm, a metre, half of every angle: no calibration begins so far away.
fn beyond_any_robot(estimate: &Estimate) -> bool {
    let most = match estimate.name {
        "delta_mm" => 125.0,
        "x_mm" | "y_mm" | "z_mm" => 1000.0,
        "scale_ppm" => 5e5,
        _ => return false,
    };
    estimate.value.abs() > most
}

/// Whether a combination that is said to be open, "effect: parameter with effect: parameter", or an
/// effect as a whole, speaks of this parameter. A setting that was given is known all the same.
fn concerns(combination: &str, estimate: &Estimate) -> bool {
    let setting = matches!(estimate.name, "order" | "time_s" | "fade_deg");
    combination.split(" with ").any(|part| {
        let (effect, name) = part.split_once(": ").unwrap_or((part, estimate.name));
        // Both numbers of a wave hang on both of its coefficients.
        let wave = ["amplitude", "phase"];
        let of_a_wave = |n: &str| wave.iter().any(|w| n.starts_with(w));
        let same = name == estimate.name || of_a_wave(name) && of_a_wave(estimate.name);
        effect == estimate.effect && same && !setting
    })
}
