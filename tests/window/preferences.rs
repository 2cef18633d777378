//! Units, digits, colours, size of text, keys and help, as a person finds them.

use crate::window::{Window, keys, press, says, status, there, window, window_at, window_of};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use truepose::gui::Runner;

/// What the status bar says of the gap, without the floor behind it.
fn gap_said(window: &Window) -> String {
    let line = status(window);
    line.split(" · floor").next().unwrap_or_default().to_owned()
}

#[test]
fn units_and_digits_change_every_number_and_are_there_tomorrow() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    let mut window = window_at(None, Some(&home));
    assert!(gap_said(&window).ends_with(" mm"));
    keys(&mut window, Modifiers::COMMAND, Key::Comma);
    press(&mut window, "inch");
    press(&mut window, "4");
    press(&mut window, "1,5");
    press(&mut window, "dark");
    let line = gap_said(&window);
    let (_, gap) = line.split_once("RMS error ").expect("the gap");
    let number = gap.trim_end_matches(" in");
    assert!(
        gap.ends_with(" in") && number.split(',').nth(1).is_some_and(|d| d.len() == 4),
        "{line}"
    );
    press(&mut window, "Done");
    assert!(window.ctx.global_style().visuals.dark_mode);
    drop(window);

    let mut window = window_at(None, Some(&home));
    window.run_steps(2);
    assert_eq!(gap_said(&window), line);
    assert!(window.ctx.global_style().visuals.dark_mode);
    keys(&mut window, Modifiers::COMMAND, Key::Comma);
    press(&mut window, "mm");
    assert!(gap_said(&window).ends_with(" mm"));
    drop(window);
    let window = window_at(None, Some(&home));
    assert!(gap_said(&window).ends_with(" mm"));
}

#[test]
fn text_grows_with_the_keys_and_stays_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    let mut window = window_at(None, Some(&home));
    keys(&mut window, Modifiers::COMMAND, Key::Plus);
    keys(&mut window, Modifiers::COMMAND, Key::Plus);
    let zoom = window.ctx.zoom_factor();
    assert!(zoom > 1.1, "{zoom}");
    drop(window);
    let mut window = window_at(None, Some(&home));
    window.run_steps(4);
    assert!((window.ctx.zoom_factor() - zoom).abs() < 1e-3);
}

/// Larger text than a window has room for would lie over itself.
#[test]
fn text_is_no_larger_than_the_window_has_room_for() {
    let mut small = window_of([1024.0, 700.0], None, Runner::AtOnce);
    for _ in 0..20 {
        keys(&mut small, Modifiers::COMMAND, Key::Plus);
    }
    let zoom = small.ctx.zoom_factor();
    assert!(zoom > 1.55 && zoom < 1.65, "{zoom}");
    keys(&mut small, Modifiers::COMMAND, Key::Minus);
    assert!(small.ctx.zoom_factor() < zoom - 0.05, "not stuck there");
    let mut large = window_of([1920.0, 1080.0], None, Runner::AtOnce);
    for _ in 0..20 {
        keys(&mut large, Modifiers::COMMAND, Key::Plus);
    }
    assert!(large.ctx.zoom_factor() > 2.6);
}

#[test]
fn the_keys_do_what_the_menus_say() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::Num3);
    assert!(there(&window, "Identify"));
    keys(&mut window, Modifiers::COMMAND, Key::I);
    assert!(status(&window).contains('→'));
    keys(&mut window, Modifiers::NONE, Key::F1);
    assert!(says(&window, "Glossary"));
    assert!(says(&window, "The true value lies within it in 19 of 20"));
    window.key_press(Key::Escape);
    window.run_steps(4);
    assert!(!says(&window, "19 of 20"));
}

#[test]
fn a_word_is_explained_where_it_stands() {
    let mut window = window(None);
    window.get_by_label("noise, one σ").hover();
    window.run_steps(8);
    assert!(says(&window, "instrument's own reading scatters"));
}

#[test]
fn every_sheet_has_names_for_its_controls() {
    let mut window = window(None);
    for (modifiers, key) in [
        (Modifiers::COMMAND, Key::Comma),
        (Modifiers::COMMAND, Key::K),
        (Modifiers::NONE, Key::F1),
        (Modifiers::SHIFT, Key::F1),
        (Modifiers::COMMAND, Key::N),
    ] {
        keys(&mut window, modifiers, key);
        let unnamed = window.unnamed_widgets();
        assert!(unnamed.is_empty(), "{key:?}: {unnamed:?}");
        window.key_press(Key::Escape);
        window.run_steps(4);
    }
}
