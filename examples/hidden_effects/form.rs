//! A wheel whose own surface is read, several turns long: the waves of its form belong to the
//! target and not to the bearing. They come back with every turn, so that what a name follows of
//! them by chance looks certain, and only angles that the fit has not seen tell. No name stands
//! with which the cross-validated error does not fall.

use truepose::diagnosis::Options;

use crate::asked::{diagnosed_with, in_short};
use crate::cells::{Column, details, in_parallel, rows_of};
use crate::rig::shapes::Shape;
use crate::rig::{Design, Hidden, Random, Rig};
use crate::{design, names};

#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a column of the table"
)]
struct Seen {
    /// A name with which the cross-validated error does not fall.
    useless: bool,
    /// The names together make it no smaller.
    worse: bool,
    runout: bool,
    named: bool,
    flagged: bool,
}

pub fn target_form(n: usize) {
    let designs = [
        ("equal steps from one side", true),
        ("jittered, from both sides", false),
    ];
    for (name, equal) in designs {
        let all = in_parallel(4 * n, |k| session(k, equal));
        let columns: [Column<Seen>; 5] = [
            (
                "a name with which the cross-validated error does not fall",
                |s| s.useless,
                "0",
            ),
            ("the names together do not lower it", |s| s.worse, "0"),
            ("bearing runout named", |s| s.runout, ""),
            ("anything named", |s| s.named, ""),
            ("flagged as unexplained", |s| s.flagged, ""),
        ];
        rows_of(&format!("form of the target, {name}"), &all, &columns);
    }
}

fn session(k: usize, equal: bool) -> Seen {
    let mut random = Random(907 + 256_203_161 * k as u64);
    let design = Design {
        samples: [36, 48, 60, 90][k % 4],
        span_deg: 180.0,
        one_way: equal,
        one_speed: equal,
        ..design(&mut random, "base-offset")
    };
    let mut rig = Rig::new(&design, &mut random);
    if equal {
        rig.equal_steps();
    }
    rig.turns([1, 3, 5][k / 4 % 3]);
    let form = Hidden::Shape(Shape::random("form", &mut random, 0.0));
    // Up to several times the noise.
    let over = 0.5 * 16.0_f64.powf(random.unit());
    let lambda = rig.shots.len() as f64 * over * over;
    rig.hidden = vec![rig.sized(&form, lambda)];
    rig.measure(&mut random);
    let answer = diagnosed_with(&rig, &Options::default());
    let useless =
        |f: &truepose::diagnosis::FoundEffect| f.held_out_mm.is_some_and(|h| h[1] >= h[0]);
    let worse = |g: truepose::diagnosis::Gaps| g.end_mm > g.identified_mm;
    let seen = Seen {
        useless: answer.found.iter().any(useless),
        worse: !answer.found.is_empty() && answer.held_out.gaps.is_some_and(worse),
        named: !answer.found.is_empty(),
        runout: names(&answer).contains(&"bearing-runout"),
        flagged: answer.unexplained.present,
    };
    if seen.useless || seen.worse {
        details(|| {
            let steps: Vec<_> = answer
                .found
                .iter()
                .map(|f| (f.effect, f.held_out_mm))
                .collect();
            format!(
                "form {k}, {over:.1} × noise: {steps:.4?} {}",
                in_short(&rig, &answer)
            )
        });
    }
    seen
}
