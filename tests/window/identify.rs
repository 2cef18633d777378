//! The step that identifies, as a person works in it: by region or exactly, with more effects or
//! fewer, and what the numbers say then.

use crate::window::{Window, gaps, keys, press, says, window};
use egui::{Key, Modifiers};

/// The bundled session, identified exactly.
fn identified() -> Window {
    let mut window = window(None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    window
}

fn after(window: &Window) -> f64 {
    gaps(window).1.expect("it is identified")
}

#[test]
fn the_methods_are_switched_and_each_leaves_its_own_gap() {
    let mut window = identified();
    let exact = after(&window);
    press(&mut window, "By region");
    let regional = after(&window);
    assert!(says(&window, "The source paper's method"));
    assert!(
        regional > 1.2 * exact,
        "{regional} by region, {exact} exactly"
    );
    press(&mut window, "Full model");
    assert!((after(&window) - exact).abs() < 1e-9);
}

#[test]
fn an_effect_more_makes_the_gap_smaller_and_one_step_back_takes_it_out() {
    let mut window = identified();
    let before = after(&window);
    press(&mut window, "Backlash");
    let with_backlash = after(&window);
    assert!(with_backlash < before, "{with_backlash} after {before}");
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!((after(&window) - before).abs() < 1e-9);
}

#[test]
fn what_the_session_cannot_show_is_said_with_the_reason() {
    let mut window = identified();
    press(&mut window, "1 that this session cannot show");
    assert!(says(&window, "gravity is along the axis"));
}
