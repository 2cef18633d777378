//! Noise with a part that is slow in time: a tripod, the air, a tracker that warms up. No part of
//! the machine is to be blamed for it, and effects are to be found beside it all the same.

use truepose::diagnosis::{Diagnosis, Options};

use crate::absorbed::left_by_neighbours;
use crate::asked::{as_json, diagnosed_with, in_short, in_the_set};
use crate::cells::{Column, count, details, in_parallel, row, rows_of};
use crate::ideal_noise::takes_it_for_an_offset;
use crate::rig::noise::{Noise, Path, Slow, WHITE};
use crate::rig::{Design, Hidden, Random, Rig};
use crate::{design, names, single_names};

const PATHS: [(Path, &str); 3] = [
    (Path::Rough, "Ornstein–Uhlenbeck"),
    (Path::Smooth, "Matérn 3/2"),
    (Path::Walk, "random walk"),
];
const PAUSE_S: f64 = 3600.0;
/// Strength of what is hidden beside it, in units of the whole σ.
const LAMBDA: f64 = 200.0;
/// As in the rows of single effects.
const NOT_ALIASED: f64 = 0.1;

/// Names of the measuring frame, which are no part of the machine.
fn of_the_frame(id: &str) -> bool {
    id == "frame-drift" || id == "frame-shift"
}

/// Whether the answer says that the measuring frame wanders.
pub fn wander_reported(rig: &Rig, answer: &Diagnosis) -> bool {
    let slow = &as_json(rig, answer)["noise"]["slow"];
    !slow.is_null()
}

/// What one session showed.
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a column of the table"
)]
struct Seen {
    shuffled: bool,
    aliased: bool,
    machine: bool,
    /// Nothing of the machine but what the mean of the wander looks like.
    mean_alone: bool,
    /// A test that knows the noise takes it for a base offset.
    ideal_offset: bool,
    frame: bool,
    flagged: bool,
    reported: bool,
    exact: bool,
    in_the_set: bool,
}

pub fn wandering(n: usize) {
    let mut all = Vec::new();
    for (path, name) in PATHS {
        let seen = in_parallel(n, |k| nothing_hidden(Some(path), k));
        row(
            &format!("slow noise, {name}: a part of the machine named"),
            count(&seen, |s| s.machine),
            n,
            "≤ 1 %",
        );
        all.extend(seen);
    }
    let white = in_parallel(n, |k| nothing_hidden(None, k));
    row(
        "white noise: said that the frame wanders",
        count(&white, |s| s.reported),
        n,
        "≤ 1 %",
    );
    for (name, shuffled) in [("shuffled", true), ("sweeps", false)] {
        row(
            &format!("slow noise, {name}: a part of the machine named"),
            count(&all, |s| s.machine && s.shuffled == shuffled),
            count(&all, |s| s.shuffled == shuffled),
            "≤ 1 %",
        );
    }
    let columns: [Column<Seen>; 6] = [
        ("a part of the machine named", |s| s.machine, "≤ 1 %"),
        (
            "of the machine a base offset or an instrument scale alone, the mean of the wander",
            |s| s.mean_alone,
            "",
        ),
        (
            "an ideal test that knows the noise takes it for a base offset",
            |s| s.ideal_offset,
            "",
        ),
        ("a frame effect named", |s| s.frame, ""),
        ("flagged as unexplained", |s| s.flagged, "≤ 1 %"),
        ("said that the frame wanders", |s| s.reported, ""),
    ];
    rows_of("slow noise, all", &all, &columns);
    beside(n);
}

/// A design with this noise; an hour's pause in a quarter of the sessions.
fn designed(id: &str, k: usize, random: &mut Random) -> Rig {
    let design = Design {
        samples: [120, 200, 60][k / 4 % 3],
        shuffled: k.is_multiple_of(2),
        ..design(random, id)
    };
    let mut rig = Rig::new(&design, random);
    if k / 2 % 4 == 3 {
        rig.pause(PAUSE_S);
    }
    rig
}

fn nothing_hidden(path: Option<Path>, k: usize) -> Seen {
    let mut random = Random(211 + 122_949_823 * k as u64);
    let mut rig = designed("", k, &mut random);
    let slow = path.map(|path| Slow::random(path, &mut random));
    rig.measure_with(&Noise { slow, ..WHITE }, &mut random);
    let answer = diagnosed_with(&rig, &Options::default());
    let mut seen = seen(&rig, &answer, &[]);
    seen.ideal_offset = slow.is_some_and(|slow| takes_it_for_an_offset(&rig, &slow));
    if seen.machine || seen.frame || seen.flagged {
        told(&rig, &answer, slow, k);
    }
    seen
}

/// One effect beside the slow noise; not one that a wandering frame is or imitates.
fn beside(n: usize) {
    let ids: Vec<&str> = single_names()
        .filter(|id| !of_the_frame(id) && *id != "base-offset")
        .collect();
    // Every effect in turn, in as many sessions as the rest of this row has.
    let all = in_parallel(3 * n, |k| {
        let (path, _) = PATHS[k % PATHS.len()];
        let id = ids[k / 3 % ids.len()];
        let mut random = Random(223 + 122_949_829 * k as u64);
        let mut rig = designed(id, k, &mut random);
        let hidden = Hidden::random(id, &mut random, &rig.design);
        rig.hidden = vec![rig.sized(&hidden, LAMBDA)];
        let slow = Some(Slow::random(path, &mut random));
        rig.measure_with(&Noise { slow, ..WHITE }, &mut random);
        let answer = diagnosed_with(&rig, &Options::default());
        let mut seen = seen(&rig, &answer, &[id]);
        seen.aliased = left_by_neighbours(&rig, &rig.hidden[0], 2).0 < NOT_ALIASED * LAMBDA;
        if !seen.exact {
            told(&rig, &answer, slow, k);
        }
        seen
    });
    for (name, shuffled, bar) in [("shuffled", true, "≥ 95 %"), ("sweeps", false, "")] {
        let own = |s: &Seen| s.shuffled == shuffled;
        row(
            &format!("one effect beside slow noise, {name}, λ = 200, not aliased: exact"),
            count(&all, |s| own(s) && !s.aliased && s.exact),
            count(&all, |s| own(s) && !s.aliased),
            bar,
        );
        row(
            "  all: found, or in the set",
            count(&all, |s| own(s) && s.in_the_set),
            count(&all, own),
            bar,
        );
        row(
            "  a part of the machine named that is not there, and the truth not in the set",
            count(&all, |s| own(s) && s.machine && !s.in_the_set),
            count(&all, own),
            "≤ 1 %",
        );
    }
    row(
        "  flagged as unexplained, all",
        count(&all, |s| s.flagged),
        all.len(),
        "≤ 1 %",
    );
    row(
        "  said that the frame wanders, all",
        count(&all, |s| s.reported),
        all.len(),
        "",
    );
}

fn seen(rig: &Rig, answer: &Diagnosis, truth: &[&str]) -> Seen {
    let found = names(answer);
    let wrong = |frame: bool| {
        let mut found = found.iter().filter(|id| !truth.contains(id));
        found.any(|id| of_the_frame(id) == frame)
    };
    let mean = |id: &str| id == "base-offset" || id == "instrument-scale";
    let of_the_machine = |id: &&&str| !truth.contains(*id) && !of_the_frame(id);
    Seen {
        ideal_offset: false,
        mean_alone: wrong(false) && found.iter().filter(of_the_machine).all(|id| mean(id)),
        shuffled: rig.design.shuffled,
        aliased: false,
        machine: wrong(false),
        frame: wrong(true),
        flagged: answer.unexplained.present,
        reported: wander_reported(rig, answer),
        exact: found == truth && !answer.unexplained.present,
        in_the_set: in_the_set(answer, truth),
    }
}

fn told(rig: &Rig, answer: &Diagnosis, slow: Option<Slow>, k: usize) {
    let Some(slow) = slow else { return };
    details(|| {
        format!(
            "slow {k}: {:?} {:.0} % of the variance, {:.0} s, {}",
            slow.path,
            100.0 * slow.share,
            slow.time_constant_s,
            in_short(rig, answer)
        )
    });
}
