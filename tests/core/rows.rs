//! Mistakes in the rows of a session that was measured on a rig which shares no code with the model
//! (`support/rig.rs`): each is said in the words of the contract, taken back, and fakes no effect.

use crate::rig::{Design, Rig};
use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::pipeline::diagnose;
use truepose::sessions::{Samples, Session, parse};

fn document() -> String {
    let rig = Rig::measured(&Design::default(), &["backlash"], 400.0, 9).0;
    rig.json("rows")
}

fn with_backlash() -> Session {
    let loaded = parse(document().as_bytes());
    loaded.expect("the rig writes a good session").session
}

fn diagnosed(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).expect("a diagnosis")
}

/// What is said, and that the backlash is found all the same.
fn said(session: &Session, word: &str) {
    let answer = diagnosed(session);
    let what: Vec<String> = answer
        .data_problems
        .iter()
        .map(|p| p.what.to_string())
        .collect();
    assert!(what.iter().any(|w| w.contains(word)), "{word}: {what:?}");
    let found: Vec<&str> = answer.found.iter().map(|f| f.effect).collect();
    assert_eq!(found, ["backlash"], "{word}: {what:?}");
}

fn points(samples: &mut Samples) -> Vec<&mut Vec<f64>> {
    let columns = [&mut samples.x_mm, &mut samples.y_mm];
    columns.into_iter().chain(samples.z_mm.as_mut()).collect()
}

#[test]
fn a_session_with_good_rows_has_nothing_to_say() {
    let answer = diagnosed(&with_backlash());
    assert!(
        answer.data_problems.is_empty(),
        "{:?}",
        answer.data_problems
    );
}

#[test]
fn a_point_that_is_missing_shifts_the_rows_below() {
    let n = with_backlash().samples.len();
    let mut seen = 0;
    for row in [n / 4, n / 3, n / 2, 2 * n / 3, 3 * n / 4] {
        let mut session = with_backlash();
        for column in points(&mut session.samples) {
            column.remove(row);
            column.push(f64::NAN);
        }
        let answer = diagnosed(&session);
        let shifted = "rows shifted by one";
        seen += usize::from(
            answer
                .data_problems
                .iter()
                .any(|p| p.what.contains(shifted)),
        );
        let gap = answer.gap.end_mm;
        assert!(
            gap < 0.1,
            "row {row}: {gap} mm with the rows as they are said to be"
        );
    }
    assert!(seen >= 4, "{seen} of 5 said");
}

#[test]
fn a_file_pasted_below_itself_is_copies() {
    let alone = diagnosed(&with_backlash());
    let mut twice: serde_json::Value = serde_json::from_str(&document()).expect("a document");
    let columns = twice["samples"]["columns"].as_object_mut();
    for column in columns.expect("inline samples").values_mut() {
        let cells = column.as_array_mut().expect("a column");
        cells.extend(cells.clone());
    }
    let loaded = parse(twice.to_string().as_bytes());
    let session = loaded.expect("a good session").session;
    said(&session, "copied rows");
    let twice = diagnosed(&session);
    // They tell nothing: the same floor and the same values.
    assert!((twice.floor.mm - alone.floor.mm).abs() < 1e-9 * alone.floor.mm);
    assert_ne!(twice.verdict, Verdict::Noise);
}

#[test]
fn speeds_and_loads_in_another_sign_and_unit_are_said() {
    let mut session = with_backlash();
    if let Some(speed) = &mut session.samples.speed[0] {
        for v in speed.iter_mut() {
            *v = -*v;
        }
        said(&session, "speed");
    }
    let mut session = with_backlash();
    if let Some(load) = &mut session.samples.load_kg {
        for v in load.iter_mut() {
            *v *= 1000.0;
        }
        said(&session, "load");
    }
}

#[test]
fn a_time_of_day_that_passes_midnight_goes_on() {
    let mut session = with_backlash();
    let n = session.samples.len();
    let of_day = |k: usize| (86_400.0 - 8.0 * (n / 3) as f64 + 8.0 * k as f64) % 86_400.0;
    session.samples.time_s = Some((0..n).map(of_day).collect());
    said(&session, "time of day");
}

/// A point that is nowhere is no point too few beside one too many.
#[test]
fn rows_that_are_wrong_by_themselves_are_not_shifted() {
    let mut session = with_backlash();
    for row in [5, 11, 40] {
        for column in points(&mut session.samples) {
            column[row] = -9999.0;
        }
    }
    let answer = diagnosed(&session);
    let mut what = answer.data_problems.iter().map(|p| p.what.to_string());
    assert!(
        !what.any(|w| w.contains("shifted")),
        "{:?}",
        answer.data_problems
    );
}

#[test]
fn commands_that_stood_still_are_said_and_are_no_noise() {
    let mut session = with_backlash();
    session.samples.q[0].fill(0.4);
    if let Some(dir) = &mut session.samples.dir[0] {
        dir.fill(1.0);
    }
    let answer = diagnosed(&session);
    let what: Vec<String> = answer
        .data_problems
        .iter()
        .map(|p| p.what.to_string())
        .collect();
    assert!(what.iter().any(|w| w.contains("returns")), "{what:?}");
    assert_ne!(answer.verdict, Verdict::Noise);
}

#[test]
fn a_code_for_a_missing_joint_value_is_no_value() {
    let mut session = with_backlash();
    for row in [3, 12, 27] {
        session.samples.q[0][row] = -999.0_f64.to_radians();
    }
    said(&session, "missing values: q1_deg is -999 in 3 samples");
}

/// A third of the points is from a reflector that was knocked aside, here one way and there another.
#[test]
fn samples_that_are_set_aside_are_said_where_they_are_many() {
    let mut session = with_backlash();
    for (k, row) in (0..session.samples.len()).step_by(4).enumerate() {
        for column in points(&mut session.samples) {
            column[row] += if k.is_multiple_of(2) { 3.0 } else { -4.0 };
        }
    }
    said(&session, "samples do not follow the model");
}
