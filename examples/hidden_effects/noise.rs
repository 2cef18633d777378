//! False alarms: sessions with nothing but noise, of every kind, in which any name and anything
//! "unexplained" is one too many.

use truepose::diagnosis::Verdict;

use crate::asked::written;
use crate::cells::{count, details, in_parallel, row};
use crate::rig::{Design, Kind, Random};
use crate::{design, diagnosed, hidden, names};

pub fn false_alarms(n: usize) {
    let kinds = [
        (Kind::Gauss, "Gaussian"),
        (Kind::Tails, "heavy-tailed (t with 4 degrees of freedom)"),
        (Kind::Correlated, "correlated in time, ρ = 0.5"),
        (Kind::Sluggish, "correlated in time, ρ = 0.8"),
        (Kind::Unequal, "unequal axes"),
        (Kind::Outliers, "2 % outliers"),
        (Kind::Quantised, "quantised"),
        (
            Kind::Mixed,
            "tails, correlation, unequal axes, outliers at once",
        ),
    ];
    let (mut all, mut of) = (0, 0);
    for (kind, name) in kinds {
        if std::env::var("CASE").is_ok_and(|case| !name.contains(&case)) {
            continue;
        }
        let alarms = in_parallel(n, |k| {
            let mut random = Random(1 + 7919 * k as u64);
            let design = Design {
                kind,
                reflectors: 1 + k % 2,
                samples: [120, 60, 200, 30][k / 2 % 4],
                ..design(&mut random, "")
            };
            let rig = hidden(&design, &[], 0.0, &mut random);
            let answer = diagnosed(&rig, &[]);
            let alarm = answer.verdict != Verdict::Noise;
            if alarm {
                details(|| {
                    format!(
                        "{name} {k}: {} samples, {:?} {}{}",
                        design.samples,
                        names(&answer),
                        answer.unexplained.description,
                        written(&rig),
                    )
                });
            }
            alarm
        });
        let alarms = count(&alarms, |a| *a);
        row(&format!("false alarms, {name}"), alarms, n, "≤ 1 %");
        (all, of) = (all + alarms, of + n);
    }
    row("false alarms, all kinds", all, of, "≤ 1 %");
}
