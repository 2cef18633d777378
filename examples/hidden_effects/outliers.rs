//! Outliers of 7 to 20 σ in 2 to 15 % of the samples, σ unlike along the axes in half of the
//! sessions; half of them along one axis alone. They are caught, and no good sample is accused.

use truepose::diagnosis::Options;
use truepose::fit::Outlier;

use crate::asked::{diagnosed_with, identified, in_short};
use crate::cells::{details, in_parallel, row};
use crate::rig::noise::{Noise, Outliers, WHITE, any_axes};
use crate::rig::{Design, Hidden, Random, Rig};
use crate::{design, names, single_names};

/// Outliers caught and good samples accused, each of how many.
#[derive(Clone, Copy, Default)]
struct Seen {
    caught: (usize, usize),
    accused: (usize, usize),
}

impl Seen {
    fn of(said: &[Outlier], truth: &[bool]) -> Self {
        let suspected = |i: usize| said.iter().any(|o| o.sample == i);
        let all = |bad: bool| {
            let own = (0..truth.len()).filter(|i| truth[*i] == bad);
            let (mut hit, mut of) = (0, 0);
            for i in own {
                of += 1;
                hit += usize::from(suspected(i));
            }
            (hit, of)
        };
        Self {
            caught: all(true),
            accused: all(false),
        }
    }
}

fn rows(name: &str, all: &[Seen]) {
    let sum = |of: fn(&Seen) -> (usize, usize)| {
        let all = all.iter().map(of);
        all.fold((0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
    };
    let (caught, of) = sum(|s| s.caught);
    row(
        &format!("outliers of 7 to 20 σ, {name}: caught"),
        caught,
        of,
        "≥ 95 %",
    );
    let (accused, of) = sum(|s| s.accused);
    row("  good samples accused", accused, of, "≤ 0.5 %");
}

pub fn outliers(n: usize) {
    for (axes, differ) in [("axes alike", false), ("axes differ", true)] {
        for (what, with_effect) in [("nothing hidden", false), ("one effect, λ = 400", true)] {
            let all = in_parallel(2 * n, |k| session(k, differ, with_effect));
            let by = |which: fn(&([Seen; 2], bool)) -> Seen| -> Vec<Seen> {
                all.iter().map(which).collect()
            };
            rows(&format!("diagnose, {axes}, {what}"), &by(|a| a.0[0]));
            row(
                if with_effect {
                    "  named exactly"
                } else {
                    "  anything named or flagged"
                },
                all.iter().filter(|a| a.1).count(),
                all.len(),
                if with_effect { "≥ 95 %" } else { "≤ 1 %" },
            );
            rows(&format!("identify, {axes}, {what}"), &by(|a| a.0[1]));
        }
    }
}

/// In `diagnose` and in `identify`; whether the effect was named, or anything where there is none.
fn session(k: usize, differ: bool, with_effect: bool) -> ([Seen; 2], bool) {
    let ids: Vec<&str> = single_names().collect();
    let id = if with_effect { ids[k % ids.len()] } else { "" };
    let mut random = Random(601 + 198_491_317 * k as u64);
    let design = Design {
        samples: [120, 200, 60][k % 3],
        reflectors: 1 + k / 3 % 2,
        ..design(&mut random, id)
    };
    let mut rig = Rig::new(&design, &mut random);
    if with_effect {
        let effect = Hidden::random(id, &mut random, &design);
        rig.hidden = vec![rig.sized(&effect, 400.0)];
    }
    let noise = Noise {
        axes: if differ {
            any_axes(&mut random)
        } else {
            [1.0; 3]
        },
        outliers: Some(Outliers {
            share: random.between(0.02, 0.15),
            sigmas: [7.0, 20.0],
            along_one: 0.5,
        }),
        ..WHITE
    };
    let truth = rig.measure_with(&noise, &mut random).outlier;
    let answer = diagnosed_with(&rig, &Options::default());
    let beside: Vec<&str> = rig.hidden.iter().map(Hidden::id).collect();
    let fitted = identified(&rig, &beside);
    let seen = [&answer.outliers, &fitted.outliers].map(|said| Seen::of(said, &truth));
    let exact = names(&answer) == beside && !answer.unexplained.present;
    let [own, of_identify] = seen.map(|s| s.caught.0);
    if own < seen[0].caught.1 || seen[0].accused.0 > 0 || exact != with_effect {
        details(|| {
            format!(
                "outliers {k}, axes differ {differ}: {own} (identify {of_identify}) of {} caught, {} of {} accused, {}",
                seen[0].caught.1,
                seen[0].accused.0,
                seen[0].accused.1,
                in_short(&rig, &answer)
            )
        });
    }
    (seen, exact == with_effect)
}
