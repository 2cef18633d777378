//! The workspace in three dimensions as a person uses it: mouse, keys, sliders.

use crate::window::{Window, choose, keys, middle_of, press, says, wheel, window, window_of};
use egui::{Key, Modifiers, PointerButton, Pos2, Rect, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::Runner;

const ARM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms/six-60.json");

fn in_space() -> Window {
    let mut window = window(None);
    press(&mut window, "3-D");
    window
}

/// What the view says of itself.
fn name(window: &Window) -> String {
    let node = window.get_by_label_contains("3-D view, ").accesskit_node();
    node.label().expect("a name")
}

fn rect(window: &Window) -> Rect {
    window.get_by_label_contains("3-D view, ").rect()
}

fn drag(window: &mut Window, button: PointerButton, modifiers: Modifiers, by: egui::Vec2) {
    let from = rect(window).center() + vec2(-60.0, 90.0);
    let press = |pos: Pos2, pressed| egui::Event::PointerButton {
        pos,
        button,
        pressed,
        modifiers,
    };
    window.hover_at(from);
    window.run_steps(1);
    window.event_modifiers(press(from, true), modifiers);
    window.run_steps(1);
    for k in 1..=4_u8 {
        let at = from + by * (f32::from(k) / 4.0);
        window.event_modifiers(egui::Event::PointerMoved(at), modifiers);
        window.run_steps(1);
    }
    window.event_modifiers(press(from + by, false), modifiers);
    window.run_steps(2);
}

/// The card of the sample under the pointer.
fn card(window: &Window) -> Option<String> {
    let card = window
        .query_all_by_label_contains("card of sample")
        .next()?;
    card.accesskit_node().label()
}

/// The sample under the pointer, and the middle of where it is: found by going over the view.
fn find(window: &mut Window) -> Option<(Pos2, String)> {
    let all = rect(window);
    for row in 1..24_u8 {
        for column in 1..24_u8 {
            let part = vec2(f32::from(column), f32::from(row)) / 24.0;
            let at = all.min + part * all.size();
            window.hover_at(at);
            window.run_steps(2);
            if let Some(says) = card(window) {
                let at = middle_of(window, at, card);
                let says = card(window).unwrap_or(says);
                let sample = says["card of ".len()..].split(':').next()?.to_owned();
                return Some((at, sample));
            }
        }
    }
    None
}

/// From where it is looked at first.
const HOME: &str = "seen from azimuth \u{2212}45°, elevation 35°";

#[test]
fn switch_keys_and_menu_lead_to_the_view_and_it_says_what_it_shows() {
    let mut window = in_space();
    assert_eq!(name(&window), format!("3-D view, 208 samples, {HOME}"));
    assert!(!says(&window, "workspace plot"));
    press(&mut window, "x z");
    assert!(says(&window, "workspace plot, 208 samples"));
    keys(
        &mut window,
        Modifiers::COMMAND.plus(Modifiers::SHIFT),
        Key::Num5,
    );
    assert!(name(&window).ends_with(HOME));
    press(&mut window, "x z");
    choose(&mut window, "View", "Workspace in 3-D");
    assert!(name(&window).ends_with(HOME));
    assert!(window.unnamed_widgets().is_empty());
    // Robots with several joints begin with it.
    let window = window_of([1280.0, 800.0], Some(ARM.into()), Runner::AtOnce);
    assert!(name(&window).ends_with(HOME));
}

#[test]
fn dragging_orbits_and_with_shift_or_the_middle_button_moves() {
    let mut window = in_space();
    drag(
        &mut window,
        PointerButton::Primary,
        Modifiers::NONE,
        vec2(80.0, 30.0),
    );
    let turned = name(&window);
    assert!(!turned.ends_with(HOME), "{turned}");
    keys(
        &mut window,
        Modifiers::COMMAND.plus(Modifiers::SHIFT),
        Key::Num5,
    );
    assert!(name(&window).ends_with(HOME), "where it was first");
    let (before, sample) = find(&mut window).expect("samples");
    for (button, modifiers) in [
        (PointerButton::Middle, Modifiers::NONE),
        (PointerButton::Primary, Modifiers::SHIFT),
    ] {
        drag(&mut window, button, modifiers, vec2(60.0, 40.0));
        assert!(name(&window).ends_with(HOME), "the direction stays");
        window.hover_at(before + vec2(60.0, 40.0));
        window.run_steps(2);
        assert!(
            says(&window, &format!("card of {sample}:")),
            "it went along"
        );
        drag(&mut window, button, modifiers, vec2(-60.0, -40.0));
    }
}

#[test]
fn the_wheel_zooms_about_the_pointer_and_a_double_click_or_home_fits() {
    let mut window = in_space();
    let (at, sample) = find(&mut window).expect("samples");
    let here = format!("card of {sample}:");
    wheel(&mut window, at, 1.0);
    window.hover_at(at);
    window.run_steps(2);
    assert!(
        says(&window, &here),
        "what is under the pointer stays there"
    );
    let away = at + vec2(40.0, 30.0);
    wheel(&mut window, away, 6.0);
    window.hover_at(at);
    window.run_steps(2);
    assert!(
        !says(&window, &here),
        "about the pointer, not about the middle"
    );
    keys(&mut window, Modifiers::NONE, Key::Home);
    window.hover_at(at);
    window.run_steps(2);
    assert!(says(&window, &here), "Home shows everything again");
    wheel(&mut window, away, 6.0);
    // Frames are a quarter of a second apart.
    window
        .ctx
        .options_mut(|o| o.input_options.max_double_click_delay = 2.0);
    for _ in 0..2 {
        window.drag_at(away);
        window.drop_at(away);
    }
    window.run_steps(4);
    window.hover_at(at);
    window.run_steps(2);
    assert!(says(&window, &here), "so does a double click");
}

#[test]
fn a_click_chooses_the_sample_everywhere() {
    let mut window = in_space();
    let (at, sample) = find(&mut window).expect("samples");
    window.drag_at(at);
    window.run_steps(1);
    window.drop_at(at);
    window.run_steps(3);
    assert!(
        name(&window).ends_with(&format!("{sample} selected")),
        "{}",
        name(&window)
    );
    window.hover_at(egui::pos2(5.0, 5.0));
    window.run_steps(4);
    assert!(says(&window, &format!("robot at {sample}:")));
}

#[test]
fn the_keyboard_turns_the_view_that_has_the_focus() {
    let mut window = in_space();
    window.get_by_label_contains("3-D view, ").focus();
    window.run_steps(3);
    keys(&mut window, Modifiers::NONE, Key::ArrowRight);
    let turned = name(&window);
    assert!(!turned.ends_with(HOME), "{turned}");
    keys(&mut window, Modifiers::NONE, Key::ArrowUp);
    assert_ne!(name(&window), turned, "the arrows stay with the view");
    for key in [Key::ArrowDown, Key::ArrowLeft] {
        keys(&mut window, Modifiers::NONE, key);
    }
    let back = name(&window);
    assert!(back.ends_with(HOME), "{back}");
}
