//! Vector effects of which one component alone is there: an axis that stands too high, a drift
//! along x. The columns of the other components are no reason to take another name.

use truepose::diagnosis::Options;

use crate::asked::{diagnosed_with, in_short, in_the_set};
use crate::cells::{count, details, in_parallel, row};
use crate::rig::{Design, Hidden, Random, Rig};
use crate::{design, names};

/// Name of the cell, and the effect at some size, positive.
type Case = (&'static str, fn(f64) -> Hidden);

const CASES: [Case; 7] = [
    ("base offset along z", |_| {
        Hidden::BaseOffset([0.0, 0.0, 0.02])
    }),
    ("base offset along x", |_| {
        Hidden::BaseOffset([0.02, 0.0, 0.0])
    }),
    ("axis tilt about x", |_| Hidden::Tilt(1e-4, 0.0)),
    ("frame shift along z", |at| {
        Hidden::Shift(at, [0.0, 0.0, 0.02])
    }),
    ("frame shift along x", |at| {
        Hidden::Shift(at, [0.02, 0.0, 0.0])
    }),
    ("frame drift along x", |_| Hidden::Drift([1e-5, 0.0, 0.0])),
    ("frame drift along z", |_| Hidden::Drift([0.0, 0.0, 1e-5])),
];

pub fn one_component(n: usize) {
    for lambda in [200.0, 100.0] {
        let all = in_parallel(CASES.len() * n, |cell| {
            let (case, k) = (cell / n, cell % n);
            session(case, lambda, k)
        });
        for ((name, _), own) in CASES.iter().zip(all.chunks(n)) {
            row(
                &format!("one component, {name}, λ = {lambda}: exact"),
                count(own, |s| s.0),
                n,
                "",
            );
            row("  named, or in the set", count(own, |s| s.1), n, "≥ 99 %");
        }
        row(
            &format!("one component, all, λ = {lambda}: exact"),
            count(&all, |s| s.0),
            all.len(),
            "",
        );
        row(
            "  named, or in the set",
            count(&all, |s| s.1),
            all.len(),
            "≥ 99 %",
        );
    }
}

/// Exact; in the set.
fn session(case: usize, lambda: f64, k: usize) -> (bool, bool) {
    let (name, effect) = CASES[case];
    let mut random = Random(307 + 141_650_939 * k as u64 + 7 * case as u64);
    let design = Design {
        samples: [120, 200][k % 2],
        // Only a turn tells an axis elsewhere from a zero offset and a length.
        ..design(&mut random, "base-offset")
    };
    let mut rig = Rig::new(&design, &mut random);
    let end = 6.0 * design.samples as f64;
    let sign = if random.unit() < 0.5 { -1.0 } else { 1.0 };
    let effect = effect(random.between(0.2, 0.8) * end).times(sign);
    rig.hidden = vec![rig.sized(&effect, lambda)];
    rig.measure(&mut random);
    let answer = diagnosed_with(&rig, &Options::default());
    let truth = [effect.id()];
    let inside = in_the_set(&answer, &truth);
    let exact = names(&answer) == truth && !answer.unexplained.present;
    if !inside {
        details(|| format!("{name} λ {lambda} {k}: {}", in_short(&rig, &answer)));
    }
    (exact, inside)
}
