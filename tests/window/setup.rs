//! Robot, reflectors and instrument edited in the Session step, by a person: typed, wrong,
//! corrected, undone, saved.

use crate::window::{Window, copy_of, gaps, keys, press, says, there, type_into, window};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use truepose::sessions::{Sigma, load};

fn opened() -> (tempfile::TempDir, std::path::PathBuf, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let window = window(Some(session.clone()));
    (folder, session, window)
}

/// Opens the form; one of its folded parts with it.
fn form(window: &mut Window, fold: Option<&str>) {
    press(window, "Robot and instrument…");
    if let Some(fold) = fold {
        window.get_by_label(fold).scroll_to_me();
        window.run_steps(4);
        press(window, fold);
    }
}

fn saved(window: &mut Window, session: &std::path::Path) -> truepose::sessions::Session {
    press(window, "Use it here");
    keys(window, Modifiers::COMMAND, Key::S);
    assert!(says(window, "Saved"));
    load(session).expect("it can be read").session
}

#[test]
fn a_number_that_is_typed_moves_the_simulation_and_is_saved() {
    let (_folder, session, mut window) = opened();
    let (before, _) = gaps(&window);
    form(&mut window, None);
    type_into(&mut window, "Tool x", "245");
    press(&mut window, "Use it here");
    let (after, _) = gaps(&window);
    assert!(after < before, "{before} → {after}: the link is 5 mm short");
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(gaps(&window).0, before);
    keys(
        &mut window,
        Modifiers::COMMAND.plus(Modifiers::SHIFT),
        Key::Z,
    );
    keys(&mut window, Modifiers::COMMAND, Key::S);
    assert!(says(&window, "Saved"));
    let saved = load(&session).expect("it can be read").session;
    assert!((saved.robot.base_from_tool.translation.x - 245.0).abs() < 1e-12);
}

#[test]
fn what_makes_no_robot_is_said_and_changes_nothing() {
    let (_folder, _, mut window) = opened();
    let before = gaps(&window);
    form(&mut window, None);
    type_into(&mut window, "joint 1: axis z", "0");
    assert!(says(&window, "no direction"));
    press(&mut window, "Use it here");
    assert!(there(&window, "Use it here"), "it cannot be used");
    type_into(&mut window, "joint 1: axis z", "1");
    assert!(!says(&window, "no direction"));
    // As it was: nothing is to be undone.
    press(&mut window, "Use it here");
    assert_eq!(gaps(&window), before);
    assert!(!there(&window, "Undo edit robot and instrument"));
    // A session has a value of each joint: none is added.
    form(&mut window, None);
    press(&mut window, "Add a joint");
    assert!(!there(&window, "joint 2: name"));
    type_into(&mut window, "Tool x", "1");
    keys(&mut window, Modifiers::NONE, Key::Escape);
    assert!(says(&window, "Discard what was typed?"));
}

#[test]
fn noise_is_unknown_one_number_or_three_and_a_comma_is_as_good_as_a_point() {
    let (_folder, session, mut window) = opened();
    form(&mut window, Some("Instrument"));
    press(&mut window, "x, y, z");
    type_into(&mut window, "Noise y", "0,07");
    type_into(&mut window, "Noise x", "0");
    assert!(says(&window, "the noise is a number above 0"));
    type_into(&mut window, "Noise x", "0.02");
    let sigma = saved(&mut window, &session).instrument.sigma_mm;
    let Some(Sigma::PerAxis([x, y, _])) = sigma else {
        panic!("{sigma:?}");
    };
    assert!((x - 0.02).abs() < 1e-12 && (y - 0.07).abs() < 1e-12);
}

#[test]
fn a_joint_has_a_name_limits_and_a_mass() {
    let (_folder, session, mut window) = opened();
    form(&mut window, Some("Masses of links"));
    type_into(&mut window, "joint 1: to", "60");
    type_into(&mut window, "joint 1: from", "75");
    assert!(says(&window, "from the smaller to the larger"));
    type_into(&mut window, "joint 1: from", "-60");
    let mass = "Mass 1";
    if !there(&window, mass) {
        press(&mut window, "The mass of link 1 is known");
    }
    type_into(&mut window, mass, "4.5");
    type_into(&mut window, "joint 1: name", "lamp");
    let saved = saved(&mut window, &session);
    let joint = &saved.robot.joints[0];
    assert_eq!(joint.name, "lamp");
    let limits = joint.limits.expect("limits");
    assert!((limits.from.to_degrees() + 60.0).abs() < 1e-9);
    assert!((joint.link.expect("a mass").mass_kg - 4.5).abs() < 1e-12);
}

#[test]
fn a_reflector_is_added_and_taken_away_again() {
    let (_folder, session, mut window) = opened();
    form(&mut window, Some("Reflectors"));
    press(&mut window, "Add a reflector");
    assert!(there(&window, "Reflector 2"));
    press(&mut window, "Remove the last reflector");
    assert!(!there(&window, "Reflector 2"));
    press(&mut window, "Add a reflector");
    type_into(&mut window, "Reflector 2 z", "12");
    let targets = saved(&mut window, &session).targets;
    assert!((targets[1].position_mm.z - 12.0).abs() < 1e-12);
}

#[test]
fn every_control_of_the_form_has_a_name() {
    let mut window = window(None);
    form(&mut window, None);
    for fold in ["Masses of links", "Reflectors", "Instrument"] {
        press(&mut window, fold);
        let unnamed = window.unnamed_widgets();
        assert!(unnamed.is_empty(), "{fold}: {unnamed:?}");
    }
}
