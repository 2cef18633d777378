//! The first step, as a person works in it: what was measured, what it covers before anything is
//! identified, the tolerance, and from one session to the next.

use crate::window::{
    bundled, gaps, keys, open, press, says, status, there, type_tolerance, window,
};
use egui::{Key, Modifiers};

#[test]
fn it_says_what_was_measured_and_what_that_covers() {
    let window = window(None);
    for fact in ["rotating column", "208", "laser tracker", "0.0300 mm"] {
        assert!(says(&window, fact), "{fact}");
    }
    assert!(says(&window, "21 effects can be tested"));
    assert!(there(&window, "Continue to regions"), "what to do next");
}

#[test]
fn a_tolerance_is_typed_changes_what_is_within_and_is_taken_back() {
    let mut window = window(None);
    assert!(says(&window, "0 of 208"));
    type_tolerance(&mut window, "3");
    assert!(!says(&window, "0 of 208"), "some are within 3 mm");
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(says(&window, "0 of 208"));
}

#[test]
fn one_session_follows_another_and_undo_leads_back() {
    let mut window = window(None);
    let first = gaps(&window).0;
    open(&mut window, &bundled("paper-30.json"));
    assert!(
        status(&window).starts_with("30 samples"),
        "{}",
        status(&window)
    );
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(status(&window).starts_with("208 samples"));
    assert!((gaps(&window).0 - first).abs() < 1e-12);
    press(&mut window, "Continue to regions");
    assert!(there(&window, "Identify by region"));
}
