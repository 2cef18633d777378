//! Robots of the library: found by typing, drawn, simulated, saved; and what was hidden is shown at the end.

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::window::{Window, go_to, keys, press, says, status, there, window};

fn typed(window: &mut Window, text: &str) {
    window.get_by_label("Find a robot").click();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(1);
    window.get_by_label("Find a robot").type_text(text);
    window.run_steps(4);
}

#[test]
fn a_robot_is_found_by_typing_and_moved_to_with_the_arrows() {
    let mut window = window(None);
    press(&mut window, "Robots…");
    typed(&mut window, "ur 5e");
    assert!(there(&window, "Universal Robots UR5e at its zero"));
    assert!(says(&window, "850 mm, 5 kg"));
    typed(&mut window, "kuka sixx");
    assert!(there(&window, "KUKA KR 6 R700 sixx at its zero"));
    keys(&mut window, Modifiers::NONE, Key::ArrowDown);
    assert!(there(&window, "KUKA KR 6 R900 sixx at its zero"));
    press(&mut window, "KUKA KR 10 R1100 sixx");
    assert!(there(&window, "KUKA KR 10 R1100 sixx at its zero"));
    typed(&mut window, "no such robot");
    assert!(says(&window, "No robot has this name"));
    keys(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!there(&window, "Find a robot"));
}

#[test]
fn a_robot_of_the_library_is_simulated_diagnosed_and_what_was_hidden_is_shown() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::N);
    typed(&mut window, "ur5e");
    keys(&mut window, Modifiers::NONE, Key::Enter);
    assert!(says(&window, "Universal Robots UR5e"));
    assert!(says(&window, "three reflectors at the tool"));
    // Something is hidden in it from the beginning: a robot without errors would show nothing.
    assert!(there(&window, "Remove Joint zero offset"));
    assert!(there(&window, "Remove Backlash"));
    press(&mut window, "Simulate");
    assert!(
        status(&window).starts_with("360 samples"),
        "{}",
        status(&window)
    );
    go_to(&mut window, "Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(says(
        &window,
        "Explained: the remaining error is at the noise floor"
    ));
    assert!(!says(&window, "0.0500° → "), "only where it is asked for");
    press(&mut window, "Show what was hidden");
    window.run_steps(12);
    assert!(there(&window, "found") && there(&window, "identified"));
    assert!(says(&window, "0.0500° → "), "beside what was found");
    press(&mut window, "Show what was hidden");
    window.run_steps(12);
    assert!(!says(&window, "0.0500° → "));
}

/// Opened once more it is ready to be typed into, what was searched for before is replaced, and a list that was
/// open before is above the sheet again.
#[test]
fn the_library_is_opened_again_as_it_was_the_first_time() {
    let mut window = window(None);
    for (name, title) in [
        ("ur5e", "Universal Robots UR5e"),
        ("iiwa 14", "KUKA LBR iiwa 14 R820"),
    ] {
        keys(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::N);
        window.event(egui::Event::Text(name.to_owned()));
        window.run_steps(4);
        assert!(there(&window, &format!("{title} at its zero")), "{name}");
        keys(&mut window, Modifiers::NONE, Key::Enter);
        for joint in [1, 2] {
            window.get_by_label("Add an effect").click();
            window.run_steps(4);
            // What the list has: the effect that is there already is called the same.
            let row = window.get_by_role_and_label(Role::Button, "Encoder eccentricity");
            row.click();
            window.run_steps(4);
            let fields = window.query_all_by_label("Remove Encoder eccentricity");
            assert_eq!(fields.count(), joint, "one of each joint");
        }
        // Back to where it was opened from, and from there to the window.
        keys(&mut window, Modifiers::NONE, Key::Escape);
        press(&mut window, "Discard");
        assert!(!there(&window, "Add an effect") && there(&window, "Find a robot"));
        assert!(there(&window, &format!("{title} at its zero")), "{name}");
        keys(&mut window, Modifiers::NONE, Key::Escape);
        assert!(!there(&window, "Find a robot"));
    }
}

/// Numbers of the forms without the zeros of their finest step.
#[test]
fn numbers_in_a_form_are_as_short_as_they_are() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::N);
    let values = |window: &Window| -> Vec<String> {
        // Beside the form stands the tolerance of the session.
        let fields = window.query_all_by_role(Role::SpinButton);
        let fields = fields.filter(|field| field.rect().left() > 304.0);
        fields
            .filter_map(|field| field.accesskit_node().value())
            .collect()
    };
    window.get_by_label("Add an effect").click();
    window.run_steps(4);
    window.get_by_label("Encoder eccentricity").click();
    window.run_steps(4);
    let all = values(&window);
    for value in ["120", "0.03 mm", "0.05°", "30°"] {
        assert!(all.iter().any(|one| one == value), "{value}: {all:?}");
    }
    let long = |value: &&String| {
        value
            .split(['°', ' '])
            .next()
            .is_some_and(|n| n.contains('.') && n.ends_with('0'))
    };
    let long: Vec<&String> = all.iter().filter(long).collect();
    assert!(long.is_empty(), "{long:?}");
}

#[test]
fn a_session_that_was_not_simulated_here_hides_nothing() {
    let mut window = window(None);
    go_to(&mut window, "Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(!there(&window, "Show what was hidden"));
}

#[test]
fn a_robot_is_typed_as_a_table_and_stays_among_ones_own() {
    let mut window = window(None);
    press(&mut window, "Robots…");
    typed(&mut window, "ur5e");
    press(&mut window, "Robot as a table…");
    press(&mut window, "DH rows");
    assert!(there(&window, "Universal Robots UR5e at its zero"));
    window.get_by_label("Name of the robot").click();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(1);
    window
        .get_by_label("Name of the robot")
        .type_text("our own");
    window.run_steps(4);
    press(&mut window, "Remove joint 6");
    assert!(!there(&window, "Remove joint 6"));
    assert!(there(&window, "our own at its zero"));
    press(&mut window, "Simulate…");
    assert!(says(&window, "three reflectors at the tool"));
    press(&mut window, "Cancel");
    typed(&mut window, "own");
    assert!(there(&window, "our own at its zero"));
    assert!(says(&window, "5 joints"));
    press(&mut window, "Forget it");
    typed(&mut window, "our own");
    assert!(says(&window, "No robot has this name"));
}
