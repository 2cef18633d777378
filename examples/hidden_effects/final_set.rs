//! The final set of sessions with three to five effects on bad noise: every name in it is worth
//! something beside the others, and there are no more than the cap.

use truepose::diagnosis::Options;

use crate::asked::{diagnosed_with, in_short, in_the_set};
use crate::cells::{Column, details, in_parallel, rows_of};
use crate::rig::{Design, Hidden, Kind, Random, Rig};
use crate::{design, names, single_names};

/// No name stands above this chance, or below even odds.
const LARGEST_P: f64 = 0.002;

#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a column of the table"
)]
struct Seen {
    improbable: bool,
    unlikely: bool,
    beyond_the_cap: bool,
    in_the_set: bool,
    wrong: bool,
}

pub fn final_set(n: usize) {
    let all = in_parallel(4 * n, session);
    let name = "three to five effects, λ 40 to 400, mixed noise";
    let columns: [Column<Seen>; 5] = [
        ("a name with p above 0.002", |s| s.improbable, "0"),
        ("a name with odds under 1", |s| s.unlikely, "0"),
        ("more names than the cap", |s| s.beyond_the_cap, "0"),
        ("a name that is not there", |s| s.wrong, ""),
        ("the truth found, or in the set", |s| s.in_the_set, ""),
    ];
    rows_of(name, &all, &columns);
}

fn session(k: usize) -> Seen {
    let pool: Vec<&str> = single_names()
        .filter(|id| *id != "joint-compliance")
        .collect();
    let mut random = Random(701 + 217_645_199 * k as u64);
    let design = Design {
        samples: [120, 200, 60][k % 3],
        reflectors: 1 + k / 3 % 2,
        span_deg: 170.0,
        kind: Kind::Mixed,
        ..design(&mut random, "")
    };
    let mut rig = Rig::new(&design, &mut random);
    let mut ids: Vec<&str> = Vec::new();
    while ids.len() < 3 + k % 3 {
        let id = pool[random.below(pool.len())];
        if !ids.contains(&id) {
            ids.push(id);
        }
    }
    for id in &ids {
        let lambda = 40.0 * 10.0_f64.powf(random.unit());
        let effect = Hidden::random(id, &mut random, &design);
        let effect = rig.sized(&effect, lambda);
        rig.hidden.push(effect);
    }
    rig.measure(&mut random);
    // A cap below the number of effects in a quarter of the sessions.
    let max_effects = (k % 4 == 3).then_some(2);
    let options = Options {
        max_effects,
        ..Options::default()
    };
    let answer = diagnosed_with(&rig, &options);
    ids.sort_unstable();
    let cap = max_effects.unwrap_or(design.samples.div_ceil(10).min(12));
    let seen = Seen {
        improbable: answer.found.iter().any(|f| f.p_familywise.p > LARGEST_P),
        unlikely: answer.found.iter().any(|f| f.odds_over_next < 1.0),
        beyond_the_cap: answer.found.len() > cap,
        in_the_set: in_the_set(&answer, &ids),
        wrong: names(&answer).iter().any(|id| !ids.contains(id)),
    };
    if seen.improbable || seen.unlikely || seen.beyond_the_cap {
        details(|| {
            let worth = answer.found.iter().map(|f| {
                let next = f.next.as_deref().unwrap_or("none");
                let (p, odds) = (f.p_familywise.p, f.odds_over_next);
                format!("{} p {p:.4} odds {odds:.1e} over {next}", f.effect)
            });
            let worth: Vec<String> = worth.collect();
            let found = answer.found.len();
            format!(
                "final {k}: {found} of at most {cap}, {}\n    {}",
                in_short(&rig, &answer),
                worth.join("; ")
            )
        });
    }
    seen
}
