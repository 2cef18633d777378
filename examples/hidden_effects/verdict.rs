//! Verdicts: "noise" and "explained" are wrong where more is left than noise, whatever the reason,
//! and "unexplained" is wrong where nothing is.

use truepose::diagnosis::{Diagnosis, Options};

use crate::asked::{diagnosed_with, in_short, says_nothing_is_left};
use crate::cells::{count, details, in_parallel, row};
use crate::rig::noise::{Noise, UNEQUAL, WHITE};
use crate::rig::{Design, Hidden, Random, Rig, Stated};
use crate::{design, hidden, names, single_names};

/// From here on the remaining error is more than noise.
const MORE_THAN_NOISE: f64 = 1.15;

/// Effects that the cells hide: every design of theirs shows them.
const HIDDEN: [&str; 8] = [
    "joint-scale",
    "encoder-eccentricity",
    "encoder-two-cycle",
    "gear-transmission-error",
    "backlash",
    "tracking-lag",
    "axis-wobble",
    "axis-tilt",
];

/// Remaining error over the noise, and whether the answer says that it is noise.
struct Said {
    over: f64,
    nothing_left: bool,
}

pub fn more_than_noise(n: usize) {
    type Cell = (&'static str, fn(usize) -> Said);
    let cells: [Cell; 4] = [
        ("two or three effects with a cap of one", capped),
        ("the same with repeats", capped_with_repeats),
        ("σ stated 1.2 to 2 times too small", stated_too_small),
        (
            "errors of their own at each pose, with repeats",
            above_repeats,
        ),
    ];
    let mut all = Vec::new();
    for (name, of) in cells {
        let said = in_parallel(n, of);
        rows(&format!("more left than noise, {name}"), &said);
        all.extend(said);
    }
    rows("more left than noise, all", &all);
    right(n);
}

fn rows(name: &str, said: &[Said]) {
    let more = |s: &Said| s.over > MORE_THAN_NOISE;
    row(
        &format!("{name}: said to be noise or explained"),
        count(said, |s| more(s) && s.nothing_left),
        count(said, more),
        "0",
    );
}

/// Sessions in which nothing is left: flagged all the same.
fn right(n: usize) {
    type Cell = (&'static str, fn(usize) -> bool);
    let cells: [Cell; 4] = [
        ("σ stated right", |k| flagged(k, &WHITE, 1, false)),
        ("axes differ, σ stated over all", |k| {
            let noise = Noise {
                axes: UNEQUAL,
                ..WHITE
            };
            flagged(k, &noise, 1, false)
        }),
        ("with repeats", |k| flagged(k, &WHITE, 4, false)),
        ("one effect, λ = 200", |k| flagged(k, &WHITE, 1, true)),
    ];
    let mut all = Vec::new();
    for (name, of) in cells {
        let wrong = in_parallel(n, of);
        row(
            &format!("nothing left, {name}: flagged"),
            count(&wrong, |w| *w),
            n,
            "≤ 1 %",
        );
        all.extend(wrong);
    }
    row(
        "nothing left, all: flagged",
        count(&all, |w| *w),
        all.len(),
        "≤ 1 %",
    );
}

fn flagged(k: usize, noise: &Noise, times: usize, with_effect: bool) -> bool {
    let mut random = Random(101 + 86_028_121 * k as u64);
    let mut rig = designed([120, 60, 200][k % 3], times, &mut random);
    if with_effect {
        let ids: Vec<&str> = single_names().filter(|id| HIDDEN.contains(id)).collect();
        hide(&mut rig, &[ids[k % ids.len()]], (200.0, 200.0), &mut random);
    }
    rig.measure_with(noise, &mut random);
    let answer = diagnosed_with(&rig, &Options::default());
    let truth: Vec<&str> = rig.hidden.iter().map(Hidden::id).collect();
    // A wrong name is the matter of other rows.
    let flagged = !says_nothing_is_left(&answer) && (truth.is_empty() || names(&answer) == truth);
    if flagged {
        details(|| format!("flagged {k}: {}", in_short(&rig, &answer)));
    }
    flagged
}

/// A full turn; each pose so many times over.
fn designed(samples: usize, times: usize, random: &mut Random) -> Rig {
    let design = Design {
        samples: samples / times,
        span_deg: 170.0,
        ..design(random, "")
    };
    let mut rig = Rig::new(&design, random);
    if times > 1 {
        rig.repeated(times, random);
    }
    rig
}

fn hide(rig: &mut Rig, ids: &[&str], (from, to): (f64, f64), random: &mut Random) {
    for id in ids {
        let lambda = random.between(from, to);
        let effect = Hidden::random(id, random, &rig.design);
        let effect = rig.sized(&effect, lambda);
        rig.hidden.push(effect);
    }
}

fn said(rig: &Rig, answer: &Diagnosis, noise_mm: f64, what: &str) -> Said {
    let said = Said {
        over: answer.gap.end_mm / noise_mm,
        nothing_left: says_nothing_is_left(answer),
    };
    if said.over > MORE_THAN_NOISE && said.nothing_left {
        details(|| {
            format!(
                "{what}: {:.2} × noise, {}",
                said.over,
                in_short(rig, answer)
            )
        });
    }
    said
}

fn capped(k: usize) -> Said {
    under_a_cap(k, 1)
}

fn capped_with_repeats(k: usize) -> Said {
    under_a_cap(k, 4)
}

fn under_a_cap(k: usize, times: usize) -> Said {
    let mut random = Random(103 + 86_028_157 * k as u64);
    let mut rig = designed([120, 160, 200][k % 3], times, &mut random);
    let mut ids: Vec<&str> = Vec::new();
    while ids.len() < 2 + k % 2 {
        let id = HIDDEN[random.below(HIDDEN.len())];
        if !ids.contains(&id) {
            ids.push(id);
        }
    }
    hide(&mut rig, &ids, (150.0, 900.0), &mut random);
    if k.is_multiple_of(4) {
        rig.stated = Stated::Nothing;
    }
    let drawn = rig.measure_with(&WHITE, &mut random);
    let options = Options {
        max_effects: Some(1),
        ..Options::default()
    };
    let answer = diagnosed_with(&rig, &options);
    said(
        &rig,
        &answer,
        drawn.noise_mm,
        &format!("cap, {times} times, {k}"),
    )
}

/// White noise above what the instrument is said to have; nothing is hidden.
fn stated_too_small(k: usize) -> Said {
    let mut random = Random(107 + 86_028_173 * k as u64);
    let design = Design {
        samples: [120, 60, 200, 90][k % 4],
        reflectors: 1 + k % 2,
        ..design(&mut random, "")
    };
    let mut rig = hidden(&design, &[], 0.0, &mut random);
    let stated = design.sigma_mm / random.between(1.2, 2.0);
    rig.stated = Stated::Other(stated);
    let answer = diagnosed_with(&rig, &Options::default());
    said(
        &rig,
        &answer,
        stated * 3.0_f64.sqrt(),
        &format!("stated {k}"),
    )
}

/// Each pose has a random error of its own, which its repeats share: no curve follows it, and the
/// repeats say that it is no noise. In half of the sessions no σ is stated, in half the whole.
fn above_repeats(k: usize) -> Said {
    let mut random = Random(109 + 86_028_179 * k as u64);
    let times = 3 + k % 3;
    let mut rig = designed([120, 90, 200][k / 2 % 3], times, &mut random);
    let drawn = rig.measure_with(&WHITE, &mut random);
    let over = random.between(0.6, 2.0);
    let mut own: Vec<(u64, [f64; 3])> = Vec::new();
    for (shot, p) in rig.shots.iter().zip(&mut rig.measured) {
        let key = shot.q.to_bits();
        if !own.iter().any(|o| o.0 == key) {
            let e = [random.normal(), random.normal(), random.normal()];
            own.push((key, e.map(|e| e * over * rig.design.sigma_mm)));
        }
        let error = own.iter().find(|o| o.0 == key).map_or([0.0; 3], |o| o.1);
        (0..3).for_each(|axis| p[axis] += error[axis]);
    }
    rig.stated = if k.is_multiple_of(2) {
        Stated::Nothing
    } else {
        Stated::Other(rig.design.sigma_mm * 1.0_f64.hypot(over))
    };
    let answer = diagnosed_with(&rig, &Options::default());
    said(&rig, &answer, drawn.noise_mm, &format!("repeats {k}"))
}
