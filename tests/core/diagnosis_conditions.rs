//! Cells that are missing among the conditions: what a sample does not say must not be taken for
//! something that the robot does.

use crate::rig::{Design, Hidden, Random, Rig};
use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::pipeline::diagnose;
use truepose::sessions::{Session, parse};

/// A session in which one effect is hidden.
fn session(id: &str, lambda: f64) -> Session {
    let mut random = Random(11);
    let design = Design {
        samples: 160,
        span_deg: 170.0,
        reflectors: 2,
        shuffled: true,
        conditions: true,
        ..Design::default()
    };
    let mut rig = Rig::new(&design, &mut random);
    let effect = Hidden::random(id, &mut random, &design);
    let effect = rig.sized(&effect, lambda);
    rig.hidden.push(effect);
    rig.measure(&mut random);
    parse(rig.json("conditions").as_bytes())
        .expect("the rig writes a good session")
        .session
}

fn answer(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).expect("a diagnosis")
}

/// Empties every so many-th cell of a column.
fn emptied(column: &mut Option<Vec<f64>>, every: usize) -> usize {
    let cells = column.iter_mut().flatten().step_by(every);
    cells.map(|cell| *cell = f64::NAN).count()
}

fn column<'s>(session: &'s mut Session, id: &str) -> &'s mut Option<Vec<f64>> {
    let samples = &mut session.samples;
    match id {
        "backlash" => &mut samples.dir[0],
        "tracking-lag" => &mut samples.speed[0],
        "link-droop" => &mut samples.load_kg,
        _ => &mut samples.temperature_c,
    }
}

const CASES: [&str; 4] = ["backlash", "tracking-lag", "link-droop", "thermal-growth"];

#[test]
fn samples_without_a_side_speed_load_or_temperature_are_left_out_aloud() {
    for id in CASES {
        let mut session = session(id, 3000.0);
        let count = emptied(column(&mut session, id), 16);
        let answer = answer(&session);
        let names: Vec<_> = answer.found.iter().map(|f| f.effect).collect();
        assert_eq!(names, [id]);
        assert_eq!(answer.verdict, Verdict::Explained, "{id}");
        let said = answer.data_problems.iter().map(|p| p.what.to_string());
        let said: Vec<_> = said.collect();
        assert!(
            said.iter()
                .any(|what| what.starts_with(&format!("{count} of"))),
            "{id}: {said:?}"
        );
    }
}

#[test]
fn a_column_that_is_mostly_empty_leaves_nothing_out() {
    for id in CASES {
        let mut session = session(id, 200.0);
        emptied(column(&mut session, id), 2);
        assert!(answer(&session).data_problems.is_empty(), "{id}");
    }
}
