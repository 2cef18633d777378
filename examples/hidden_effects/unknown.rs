//! What no name explains: shapes that no catalogue has, and effects whose name was taken out. Of
//! the latter the rig tells by itself how much the other names leave.

use truepose::diagnosis::Diagnosis;

use crate::absorbed::left_by_neighbours;
use crate::cells::{count, details, in_parallel, row};
use crate::rig::{Design, Random, Rig};
use crate::{design, diagnosed, hidden, names, single_names};

pub fn unknown(n: usize) {
    for id in ["bump", "sawtooth", "plateau"] {
        let all = in_parallel(n, |k| {
            let mut random = Random(9 + 32_452_843 * k as u64);
            let design = Design {
                samples: 240,
                ..design(&mut random, "")
            };
            let rig = hidden(&design, &[id], 400.0, &mut random);
            let answer = diagnosed(&rig, &[]);
            let gear = |name: &&str| *name == "gear-transmission-error";
            let allowed = id == "sawtooth" && names(&answer).iter().all(gear);
            let named = !(answer.found.is_empty() || allowed);
            let flagged = answer.unexplained.present;
            if named || !flagged {
                told(&rig, &answer, &format!("{id} {k}"));
            }
            (flagged, named)
        });
        row(
            &format!("unknown {id}, λ = 400: flagged"),
            count(&all, |a| a.0),
            n,
            "≥ 95 %",
        );
        row("  named", count(&all, |a| a.1), n, "≤ 5 %");
    }
}

/// What is left is demanded where it is at least this strong.
const DETECTABLE: f64 = 50.0;

pub fn one_name_left_out(n: usize) {
    let ids: Vec<&str> = single_names().collect();
    let all = in_parallel(ids.len() * n, |cell| {
        let (id, k) = (ids[cell / n], cell % n);
        let mut random = Random(77 + id.len() as u64 + 104_729 * k as u64);
        let design = design(&mut random, id);
        let rig = hidden(&design, &[id], 400.0, &mut random);
        // The rig's neighbours have no compliance of the foundation, which is that of a single joint.
        let answer = diagnosed(&rig, &[id, "foundation-compliance"]);
        let flagged = answer.unexplained.present;
        let (left, by) = left_by_neighbours(&rig, &rig.hidden[0], 4);
        if !flagged {
            told(
                &rig,
                &answer,
                &format!("without {id} {k}: {left:.0} left by {by:?}"),
            );
        }
        (left >= DETECTABLE, flagged)
    });
    for (id, own) in ids.iter().zip(all.chunks(n)) {
        let detectable = count(own, |a| a.0);
        row(
            &format!("without {id}, λ = 400: flagged where at least {DETECTABLE} is left"),
            count(own, |a| a.0 && a.1),
            detectable,
            "≥ 90 %",
        );
        if detectable < n {
            row(
                "  neighbours leave less: flagged",
                count(own, |a| !a.0 && a.1),
                n - detectable,
                "",
            );
        }
    }
    row(
        "without its name, all: flagged where at least 50 is left",
        count(&all, |a| a.0 && a.1),
        count(&all, |a| a.0),
        "≥ 90 %",
    );
    row(
        "  a neighbour's name alone with nothing flagged, though",
        count(&all, |a| a.0 && !a.1),
        count(&all, |a| a.0),
        "0",
    );
    row(
        "without its name, all: flagged",
        count(&all, |a| a.1),
        all.len(),
        "",
    );
}

fn told(rig: &Rig, answer: &Diagnosis, what: &str) {
    details(|| {
        format!(
            "{what}: span {} shuffled {} {:?}\n    found {:?} {}; p {} {:?}",
            rig.design.span_deg,
            rig.design.shuffled,
            rig.hidden,
            names(answer),
            answer.unexplained.description,
            answer.unexplained.p,
            answer.unexplained.resembles
        )
    });
}
