//! An arm from the library to a corrected program and a report, by the keyboard alone; and wherever the focus goes it
//! is seen.

use std::path::Path;

use crate::cases::cases;
use crate::window::{Window, keys, says, status, there, window_of};
use egui::epaint::{RectShape, Shape};
use egui::{Color32, Key, Modifiers, Rect};
use egui_kittest::kittest::NodeT;
use truepose::gui::Runner;

const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);
/// The small one first: there panels scroll.
const SIZES: [[f32; 2]; 2] = [[1024.0, 700.0], [1280.0, 800.0]];

/// Presses what comes next.
fn next(window: &mut Window) {
    keys(window, Modifiers::COMMAND, Key::Enter);
}

fn type_text(window: &mut Window, text: &str) {
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(4);
}

/// The dialog of the system cannot be driven: the path is typed, with keys.
fn save(window: &mut Window, what: &str, path: &Path) {
    window.state_mut().type_path(what, Path::new("proposed"));
    window.run_steps(4);
    type_text(window, path.to_str().expect("a path in UTF-8"));
    keys(window, Modifiers::NONE, Key::Enter);
    window.run_steps(8);
    assert!(path.exists(), "{what} is written: {}", path.display());
    assert!(!there(window, "Path to save to"));
}

#[test]
fn an_arm_of_the_library_is_calibrated_with_keys_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("targets.csv");
    std::fs::write(
        &program,
        "name;q1_deg;q2_deg;q3_deg;q4_deg;q5_deg;q6_deg\nP0;10;-60;40;5;30;0\nP1;-20;-80;60;0;45;10\n",
    )
    .expect("written");
    for size in SIZES {
        let at = |name: &str| folder.path().join(format!("{} {name}", size[0]));
        let mut window = window_of(size, None, Runner::AtOnce);
        keys(&mut window, SHIFTED, Key::N);
        type_text(&mut window, "ur5e");
        keys(&mut window, Modifiers::NONE, Key::Enter);
        assert!(says(&window, "three reflectors at the tool"), "{size:?}");
        // A number that is being typed is taken over before the session is made of it.
        keys(&mut window, Modifiers::NONE, Key::Tab);
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        type_text(&mut window, "100");
        next(&mut window);
        assert!(status(&window).starts_with("300 samples"), "{size:?}");

        next(&mut window);
        assert!(says(&window, "Effects to fit"), "{size:?}");
        keys(&mut window, Modifiers::COMMAND, Key::I);
        assert!(says(&window, "RMS error, full model"), "{size:?}");
        keys(&mut window, Modifiers::COMMAND, Key::G);
        assert!(says(&window, "Explained"), "it is seen: {size:?}");
        next(&mut window);
        assert!(!there(&window, "Add the effect to the model"), "{size:?}");
        next(&mut window);
        assert!(there(&window, "Save as .csv…"), "{size:?}");
        save(&mut window, "table", &at("robot.csv"));

        window.state_mut().compensate(&program);
        window.run_steps(4);
        assert!(says(&window, "Compensate targets.csv"), "{size:?}");
        save(&mut window, "targets", &at("corrected.csv"));
        save(&mut window, "report", &at("report.html"));
    }
}

/// The ring of what has the keyboard, and the part of the screen that it is painted into.
fn ring(window: &Window) -> Option<(Rect, Rect)> {
    fn last(shape: &Shape) -> Option<&RectShape> {
        match shape {
            Shape::Rect(rect) => Some(rect),
            Shape::Vec(all) => all.iter().rev().find_map(last),
            _ => None,
        }
    }
    let is_ring = |rect: &&RectShape| {
        rect.fill == Color32::TRANSPARENT && (rect.stroke.width - 2.0).abs() < 1e-3
    };
    let mut shapes = window.output().shapes.iter().rev();
    shapes.find_map(|shape| {
        let ring = last(&shape.shape).filter(is_ring)?;
        Some((ring.rect, shape.clip_rect))
    })
}

#[test]
fn wherever_the_focus_goes_it_is_seen_whole() {
    let arm = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms/six-60.json");
    for size in cases(&SIZES, 1).iter().copied() {
        let mut window = window_of(size, Some(arm.into()), Runner::AtOnce);
        keys(&mut window, Modifiers::COMMAND, Key::I);
        keys(&mut window, Modifiers::COMMAND, Key::G);
        let whole = window.ctx.content_rect();
        for step in [Key::Num1, Key::Num2, Key::Num3, Key::Num4] {
            keys(&mut window, Modifiers::COMMAND, step);
            let mut unseen = Vec::new();
            let mut seen = 0;
            for press in 0..90 {
                window.key_press(Key::Tab);
                window.run_steps(6);
                let focused = window.root().children_recursive();
                let focused = focused
                    .filter(egui_kittest::Node::is_focused)
                    .find_map(|node| {
                        let inner = node.accesskit_node();
                        Some((inner.label().or(inner.value())?, node.rect()))
                    });
                let Some((name, rect)) = focused else {
                    continue;
                };
                match ring(&window) {
                    Some((ring, clip)) if whole.contains_rect(ring.shrink(1.0)) => {
                        // A plot's or panel's edge may cut a point of it.
                        if !clip.expand(3.0).contains_rect(ring) {
                            unseen.push(format!("{press}: {name} at {ring} in {clip}"));
                        }
                        seen += 1;
                    }
                    found => unseen.push(format!("{press}: {name} at {rect}: {found:?}")),
                }
            }
            assert!(seen > 20, "{size:?}, {step:?}: {seen}");
            assert!(unseen.is_empty(), "{size:?}, {step:?}: {unseen:#?}");
        }
    }
}
