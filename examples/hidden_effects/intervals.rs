//! Whether 95 % intervals hold where they are hardest: in `identify` under correlated and slow
//! noise, and beside something unexplained.

use truepose::diagnosis::Options;

use crate::asked::{base_of, diagnosed_with, identified};
use crate::cells::{details, in_parallel, row};
use crate::known::covered;
use crate::rig::noise::{Noise, Path, Slow, WHITE};
use crate::rig::{Design, Hidden, Kind, Random, Rig};
use crate::{design, hidden, single_names};

pub const HOLD: &str = "93–97 %";

/// Intervals that cover, of how many.
type Covered = (usize, usize);

fn sum<'a>(all: impl Iterator<Item = &'a Covered>) -> Covered {
    all.fold((0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
}

pub fn intervals(n: usize) {
    for (name, noise) in [
        ("white noise", Wander::White),
        (
            "correlated in time, ρ = 0.5",
            Wander::Kind(Kind::Correlated),
        ),
        ("correlated in time, ρ = 0.8", Wander::Kind(Kind::Sluggish)),
        ("slow noise", Wander::Slow),
    ] {
        if std::env::var("CASE").is_ok_and(|case| !name.contains(&case)) {
            continue;
        }
        // Every effect in turn; identification costs little, so there are many sessions.
        let all = in_parallel(8 * n, |k| in_identify(noise, k));
        let says = [
            format!("identify, {name}: 95 % intervals of zero offset and link length cover"),
            "  the same with the hidden effect (λ = 200) fitted beside them".to_owned(),
            "  those of the hidden effect".to_owned(),
        ];
        for (which, says) in says.iter().enumerate() {
            let (good, of) = sum(all.iter().map(|a| &a[which]));
            row(says, good, of, HOLD);
        }
    }
    for id in ["bump", "plateau"] {
        if std::env::var("CASE").is_ok_and(|case| case != id) {
            continue;
        }
        let all = in_parallel(2 * n, |k| beside_unexplained(id, k));
        let (good, of) = sum(all.iter());
        row(
            &format!(
                "diagnose beside an unexplained {id}, λ = 400: intervals of zero offset and link length cover"
            ),
            good,
            of,
            HOLD,
        );
    }
}

#[derive(Clone, Copy)]
enum Wander {
    White,
    Kind(Kind),
    Slow,
}

/// Of the base alone, of the base with a hidden effect beside it, and of that effect.
fn in_identify(wander: Wander, k: usize) -> [Covered; 3] {
    let ids: Vec<&str> = single_names().collect();
    let id = ids[k % ids.len()];
    let mut random = Random(401 + 160_481_183 * k as u64);
    let mut design = Design {
        samples: [120, 200][k / 2 % 2],
        ..design(&mut random, id)
    };
    if let Wander::Kind(kind) = wander {
        design.kind = kind;
    }
    let mut rig = Rig::new(&design, &mut random);
    measure(&mut rig, wander, &mut random);
    let base = covered(&identified(&rig, &[]).parameters, &base_of(&rig));
    let effect = Hidden::random(id, &mut random, &design);
    rig.hidden = vec![rig.sized(&effect, 200.0)];
    measure(&mut rig, wander, &mut random);
    let answer = identified(&rig, &[id]);
    let (own, others): (Vec<_>, Vec<_>) = answer
        .parameters
        .into_iter()
        // Its setting is scanned; a step's time has an interval in `diagnose`.
        .filter(|p| p.name != "time_s")
        .partition(|p| p.effect == id);
    let truth = rig.hidden[0].parameters();
    let (beside, own) = (covered(&others, &base_of(&rig)), covered(&own, &truth));
    if own.0 == 0 {
        details(|| format!("identify {k}: none of {} covers, {:?}", own.1, rig.hidden));
    }
    [base, beside, own]
}

fn measure(rig: &mut Rig, wander: Wander, random: &mut Random) {
    match wander {
        Wander::White | Wander::Kind(_) => rig.measure(random),
        Wander::Slow => {
            let path = [Path::Rough, Path::Smooth][random.below(2)];
            let noise = Noise {
                slow: Some(Slow::random(path, random)),
                ..WHITE
            };
            rig.measure_with(&noise, random);
        }
    }
}

fn beside_unexplained(id: &str, k: usize) -> Covered {
    let mut random = Random(409 + 160_481_219 * k as u64);
    let design = Design {
        samples: 240,
        ..design(&mut random, "")
    };
    let rig = hidden(&design, &[id], 400.0, &mut random);
    let answer = diagnosed_with(&rig, &Options::default());
    let covered = covered(&answer.identified, &base_of(&rig));
    if covered.0 < covered.1 {
        details(|| {
            let told: Vec<_> = answer.identified.iter().map(|e| (e.name, e.ci95)).collect();
            let says = &answer.unexplained.description;
            format!(
                "{:?} {k}: {told:?}, true {:?}; '{says}'",
                rig.hidden,
                base_of(&rig)
            )
        });
    }
    covered
}
