//! Robot, reflectors and instrument edited in the Session step, by a person: typed, wrong, mended,
//! undone, saved.

use crate::window::{Window, copy_of, gaps, keys, press, says, there, type_into, window};
use egui::{Key, Modifiers};
use truepose::sessions::{Sigma, load};

fn opened() -> (tempfile::TempDir, std::path::PathBuf, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let window = window(Some(session.clone()));
    (folder, session, window)
}

#[test]
fn a_number_that_is_typed_moves_the_simulation_and_is_saved() {
    let (_folder, session, mut window) = opened();
    let (before, _) = gaps(&window);
    press(&mut window, "Tool and gravity");
    type_into(&mut window, "Tool x", "245");
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
fn what_makes_no_robot_is_said_at_the_field_and_changes_nothing() {
    let (_folder, _, mut window) = opened();
    let before = gaps(&window);
    press(&mut window, "Tool and gravity");
    type_into(&mut window, "Orientation w", "0");
    assert!(says(&window, "zero length"));
    assert!(says(&window, "Not taken over while something is wrong"));
    assert_eq!(gaps(&window), before);
    // One more number, and it is an orientation.
    type_into(&mut window, "Orientation z", "1");
    assert!(!says(&window, "zero length"));
    // Turned about itself: the one reflector, at its origin, stays where it is.
    let undo = "Undo edit robot and instrument";
    assert!(there(&window, undo));
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(!there(&window, undo));
    type_into(&mut window, "Orientation w", "0");
    press(&mut window, "Back to what was there");
    assert!(!says(&window, "zero length"));
}

#[test]
fn noise_is_unknown_one_number_or_three_and_a_comma_is_as_good_as_a_point() {
    let (_folder, session, mut window) = opened();
    press(&mut window, "Instrument");
    press(&mut window, "x, y, z");
    type_into(&mut window, "Noise y", "0,07");
    type_into(&mut window, "Noise x", "0");
    assert!(says(&window, "the noise is a number above 0"));
    type_into(&mut window, "Noise x", "0.02");
    keys(&mut window, Modifiers::COMMAND, Key::S);
    let sigma = load(&session)
        .expect("it can be read")
        .session
        .instrument
        .sigma_mm;
    let Some(Sigma::PerAxis([x, y, _])) = sigma else {
        panic!("{sigma:?}");
    };
    assert!((x - 0.02).abs() < 1e-12 && (y - 0.07).abs() < 1e-12);
}

#[test]
fn a_joint_has_a_name_limits_and_a_mass() {
    let (_folder, session, mut window) = opened();
    let name = load(&session).expect("a session").session.robot.joints[0]
        .name
        .clone();
    press(&mut window, &format!("Joint 1, {name}"));
    type_into(&mut window, "Limit 1 to", "60");
    type_into(&mut window, "Limit 1 from", "75");
    assert!(says(&window, "from the smaller to the larger"));
    type_into(&mut window, "Limit 1 from", "-60");
    press(&mut window, "mass of link 1, kg");
    type_into(&mut window, "Mass 1", "4.5");
    type_into(&mut window, "Name of joint 1", "lamp");
    assert!(says(&window, "Joint 1, lamp"));
    keys(&mut window, Modifiers::COMMAND, Key::S);
    let saved = load(&session).expect("it can be read").session;
    let joint = &saved.robot.joints[0];
    assert_eq!(joint.name, "lamp");
    let limits = joint.limits.expect("limits");
    assert!((limits.from.to_degrees() + 60.0).abs() < 1e-9);
    assert!((joint.link.expect("a mass").mass_kg - 4.5).abs() < 1e-12);
}

#[test]
fn a_reflector_is_added_and_taken_away_again() {
    let (_folder, _, mut window) = opened();
    press(&mut window, "Reflectors");
    press(&mut window, "Add a reflector");
    assert!(says(&window, "Name of reflector 2"));
    press(&mut window, "Remove this reflector");
    assert!(!says(&window, "Name of reflector 2"));
}

#[test]
fn every_control_of_the_form_has_a_name() {
    let mut window = window(None);
    let folds = ["Tool and gravity", "Reflectors", "Instrument"];
    for fold in folds {
        press(&mut window, fold);
        let unnamed = window.unnamed_widgets();
        assert!(unnamed.is_empty(), "{fold}: {unnamed:?}");
    }
}
