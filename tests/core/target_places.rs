//! Targets that moved, that were exchanged, or of which nothing tells where they are: the tool of an arm is no surer
//! than the targets that are where the session says. Exact geometry of `tests/reference/arms.py`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::PathBuf;

use crate::cases::cases;
use nalgebra::Vector3;
use truepose::effects::{Inputs, JointValues};
use truepose::fit::{DEFAULT_EFFECTS, Identification, identify_exact};
use truepose::sessions::{Session, SessionCorrection, load};
use truepose::set_up_errors::corrected_session;

const KINDS: [&str; 2] = ["six-200", "seven-200"];

fn session(name: &str) -> Session {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/arms");
    load(folder.join(format!("{name}.json"))).unwrap().session
}

fn identified(session: &Session) -> Identification {
    let effects = DEFAULT_EFFECTS.map(str::to_owned);
    identify_exact(session, &effects, JointValues::Commanded).unwrap()
}

/// What all targets share: value and half of the interval along x, y, z, mm.
fn tool(answer: &Identification) -> Vec<(f64, f64)> {
    let all = answer.parameters.iter();
    all.filter(|p| p.effect == "tool-position" && p.target.is_none())
        .map(|p| (p.value, p.ci95.map_or(0.0, |ci| 0.5 * (ci[1] - ci[0]))))
        .collect()
}

fn identified_when_mended(session: &Session) -> (Identification, Vec<String>) {
    let mended = corrected_session(session, JointValues::Commanded);
    let said = mended.problems.iter().map(|p| p.what.to_string());
    (identified(&mended.session), said.collect())
}

/// The session with this target by so much elsewhere in the tool, in the rows from this one on.
fn moved(session: &Session, target: usize, by_mm: [f64; 3], from: usize) -> Session {
    let model = identified(session).model;
    let here = model.predict(&Inputs::new(session, JointValues::Commanded));
    let mut other = session.clone();
    other.targets[target].position_mm += Vector3::from(by_mm);
    let there = model.predict(&Inputs::new(&other, JointValues::Commanded));
    let mut moved = session.clone();
    let samples = &mut moved.samples;
    let own = samples.target.clone().unwrap();
    for row in (from..own.len()).filter(|row| own[*row] as usize == target) {
        samples.x_mm[row] += there.x_mm[row] - here.x_mm[row];
        samples.y_mm[row] += there.y_mm[row] - here.y_mm[row];
        samples.z_mm.as_mut().unwrap()[row] += there.z_mm[row] - here.z_mm[row];
    }
    moved
}

/// The session with two names exchanged in these rows.
fn exchanged(session: &Session, rows: std::ops::Range<usize>) -> Session {
    let mut wrong = session.clone();
    for target in &mut wrong.samples.target.as_mut().unwrap()[rows] {
        *target = [1, 0, 2][*target as usize];
    }
    wrong
}

fn same_tool(name: &str, right: &Identification, answer: &Identification) {
    let [right, found] = [tool(right), tool(answer)];
    assert_eq!(right.len(), 3, "{name}");
    for ((a, own), (b, half)) in right.iter().zip(&found) {
        assert!(
            (a - b).abs() <= own.hypot(*half),
            "{name}: {right:?} {found:?}"
        );
        assert!(*half < 3.0 * own, "{name}: {right:?} {found:?}");
    }
}

#[test]
fn a_target_that_moved_leaves_the_tool_where_the_others_say() {
    for kind in cases(&KINDS, 1) {
        let session = session(kind);
        let right = identified(&session);
        let n = session.samples.len();
        for (by_mm, from) in [([3.0, -2.0, 1.0], n / 2), ([-0.6, 0.5, 0.7], n / 3)] {
            let (answer, said) = identified_when_mended(&moved(&session, 1, by_mm, from));
            let name = format!("{kind} {by_mm:?}: {said:?}");
            assert_eq!(said.len(), 1, "{name}");
            assert!(
                said[0].starts_with("target T2 is elsewhere from sample"),
                "{name}"
            );
            same_tool(&name, &right, &answer);
        }
        // Throughout, also by so much that it could be taken for a wrong unit.
        for by_mm in [[-1.5, 2.0, -1.0], [-150.0, 0.0, 0.0]] {
            let (answer, said) = identified_when_mended(&moved(&session, 1, by_mm, 0));
            let name = format!("{kind} {by_mm:?}: {said:?}");
            assert_eq!(said.len(), 1, "{name}");
            assert!(said[0].starts_with("target T2 is elsewhere: "), "{name}");
            same_tool(&name, &right, &answer);
        }
    }
}

#[test]
fn exchanged_names_are_put_right() {
    for kind in cases(&KINDS, 1) {
        let session = session(kind);
        let right = identified(&session);
        let n = session.samples.len();
        for (rows, end) in [(2 * n / 3..n, "on"), (0..n, "exchanged")] {
            let wrong = exchanged(&session, rows.clone());
            let (answer, said) = identified_when_mended(&wrong);
            let name = format!("{kind} {rows:?}: {said:?}");
            assert_eq!(said.len(), 1, "{name}");
            let start = "target T1 and target T2 are exchanged";
            assert!(
                said[0].starts_with(start) && said[0].contains(end),
                "{name}"
            );
            same_tool(&name, &right, &answer);
            let mended = corrected_session(&wrong, JointValues::Commanded);
            assert_eq!(
                mended.session.samples.target, session.samples.target,
                "{name}"
            );
        }
    }
}

#[test]
fn of_two_targets_that_disagree_none_says_where_the_tool_is() {
    for kind in cases(&KINDS, 1) {
        let mut session = session(kind);
        let own = session.samples.target.clone().unwrap();
        let third = (0..own.len()).filter(|row| own[*row] == 2).collect();
        SessionCorrection::Remove(third).apply(&mut session);
        session.targets.truncate(2);
        let right = tool(&identified(&session));
        for by_mm in [[3.0, 0.0, 0.0], [0.0, -20.0, 10.0]] {
            let (answer, said) = identified_when_mended(&moved(&session, 1, by_mm, 0));
            let name = format!("{kind} {by_mm:?}: {said:?}");
            assert_eq!(said.len(), 1, "{name}");
            assert!(
                said[0].starts_with("target T1, target T2: nothing tells"),
                "{name}"
            );
            let found = tool(&answer);
            for along in 0..3 {
                let (value, half) = found[along];
                for truth in [right[along].0, right[along].0 + by_mm[along]] {
                    let slack = half + right[along].1;
                    assert!(
                        (value - truth).abs() <= slack,
                        "{name}: {found:?} {right:?}"
                    );
                }
            }
        }
    }
}
