//! The workspace plot as a person uses it: from every side, on robots of every kind, at every size.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::window::{Window, choose, keys, middle_of, press, says, there, wheel, window};
use egui::{Key, Modifiers, Pos2, Rect, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::{App, Runner};

const COLUMN: &str =
    r#"{ "name": "pan", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0] }"#;
const RAIL: &str =
    r#"{ "name": "rail", "kind": "prismatic", "axis": [1,0,0], "point_mm": [0,0,0] }"#;

/// An arm: base, shoulder, elbow, and a wrist whose axes meet.
const ARM: [(&str, [i32; 3], [i32; 3]); 6] = [
    ("base", [0, 0, 1], [0, 0, 0]),
    ("shoulder", [0, 1, 0], [150, 0, 450]),
    ("elbow", [0, 1, 0], [150, 0, 1050]),
    ("roll", [1, 0, 0], [150, 0, 1150]),
    ("pitch", [0, 1, 0], [800, 0, 1150]),
    ("flange", [1, 0, 0], [800, 0, 1150]),
];

/// Writes a session of these joints with these rows.
fn write(folder: &Path, joints: &str, head: &str, rows: &str) -> PathBuf {
    let session = format!(
        r#"{{ "format": "truepose-session/1", "name": "test", "robot": {{ "name": "robot",
 "joints": [ {joints} ],
 "tool": {{ "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] }} }}, "tolerance_mm": 0.5,
 "instrument": {{ "name": "tracker", "sigma_mm": 0.03 }}, "samples": {{ "file": "test.csv" }} }}"#
    );
    std::fs::write(folder.join("test.csv"), format!("{head}\n{rows}")).expect("a folder");
    let path = folder.join("test.json");
    std::fs::write(&path, session).expect("a folder");
    path
}

fn column(folder: &Path, rows: &str) -> PathBuf {
    write(folder, COLUMN, "q1_deg,x_mm,y_mm,z_mm,dir1", rows)
}

fn arm(folder: &Path) -> PathBuf {
    let joint = |(name, axis, point): (&str, [i32; 3], [i32; 3])| {
        let (axis, point) = (format!("{axis:?}"), format!("{point:?}"));
        format!(
            r#"{{ "name": "{name}", "kind": "revolute", "axis": {axis}, "point_mm": {point} }}"#
        )
    };
    let joints = ARM.map(joint).join(",");
    let mut rows = String::new();
    for k in 0..40 {
        let angle = |j: i32| (37 * k + 53 * j) % 80 - 40;
        let q: Vec<String> = (0..6).map(|j| angle(j).to_string()).collect();
        let place = 600.0 + f64::from(k);
        writeln!(rows, "{},{place},{},{}", q.join(","), 10 * k, 900 - 5 * k).expect("memory");
    }
    let head = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm";
    write(folder, &joints, head, &rows)
}

fn sized(path: Option<PathBuf>, width: f32, height: f32) -> Window {
    let mut window = Harness::builder()
        .with_size([width, height])
        .build_eframe(|cc| App::new(&cc.egui_ctx, path, Runner::AtOnce));
    window.run_steps(4);
    window
}

/// The plot of a plane.
fn plot(window: &Window) -> Rect {
    window.get_by_label_contains("workspace plot,").rect()
}

fn polar(window: &mut Window) {
    let keys_of_it = Modifiers::COMMAND.plus(Modifiers::SHIFT);
    keys(window, keys_of_it, Key::Num4);
}

fn text_of(window: &Window, part: &str) -> Option<String> {
    let node = window.query_all_by_label_contains(part).next()?;
    let node = node.accesskit_node();
    node.label().or(node.value())
}

/// Moves the pointer over the plot until it is on a sample; where that is.
fn find_sample(window: &mut Window, plot: Rect) -> Option<Pos2> {
    for k in 0..60 {
        let part = k as f32 / 60.0;
        let at = pos2(
            plot.center().x + 0.05 * plot.width(),
            plot.top() + part * plot.height(),
        );
        window.hover_at(at);
        window.run_steps(2);
        if text_of(window, "card of sample").is_some() {
            return Some(at);
        }
    }
    None
}

fn click_at(window: &mut Window, at: Pos2) {
    window.hover_at(at);
    window.run_steps(1);
    window.drag_at(at);
    window.run_steps(1);
    window.drop_at(at);
    window.run_steps(2);
    // The pointer is still there.
    window.hover_at(at);
    window.run_steps(4);
}

#[test]
fn the_workspace_is_looked_at_from_every_side_by_name() {
    let mut window = window(None);
    for plane in ["x z", "y z", "x y"] {
        press(&mut window, plane);
        assert!(says(&window, "workspace plot, 208 samples"), "{plane}");
        assert!(says(&window, "robot at sample"), "{plane}");
    }
    polar(&mut window);
    assert!(says(
        &window,
        "polar view, tangential, 208 samples, 1 division = "
    ));
    choose(&mut window, "Choose chart", "Deviation over angle");
    assert!(!says(&window, "polar view"));
    assert!(window.unnamed_widgets().is_empty());
}

#[test]
fn the_keyboard_and_the_menu_know_the_polar_view() {
    let mut window = window(None);
    let shifted = Modifiers::COMMAND.plus(Modifiers::SHIFT);
    keys(&mut window, shifted, Key::Num4);
    assert!(says(&window, "polar view"));
    choose(&mut window, "Choose chart", "Deviation over angle");
    assert!(!says(&window, "polar view"));
    choose(&mut window, "View", "Polar view");
    assert!(says(&window, "polar view"));
}

#[test]
fn the_polar_view_shows_the_component_that_is_chosen_and_what_is_left() {
    let mut window = window(None);
    polar(&mut window);
    choose(&mut window, "Component", "radial");
    let scale = |window: &Window| {
        let says = text_of(window, "polar view, radial").expect("it is shown");
        let (_, number) = says.split_once("1 division = ").expect("a scale");
        let number = number.split(' ').next().expect("a number");
        number.parse::<f64>().expect("a number")
    };
    let before = scale(&window);
    keys(&mut window, Modifiers::COMMAND, Key::I);
    polar(&mut window);
    press(&mut window, "show before");
    assert!(scale(&window) < before);
}

#[test]
fn a_sample_is_chosen_by_a_click_and_the_robot_stands_there() {
    let mut window = window(None);
    let frame = plot(&window);
    let at = find_sample(&mut window, frame).expect("there are samples");
    let card = text_of(&window, "card of sample").expect("a card");
    let sample = card["card of ".len()..]
        .split(':')
        .next()
        .expect("a title")
        .to_owned();
    let brief = card.len();
    click_at(&mut window, at);
    let robot = text_of(&window, "robot at sample").expect("a robot");
    assert!(
        robot.starts_with(&format!("robot at {sample}: column ")),
        "{robot}"
    );
    let card = text_of(&window, "card of sample").expect("a card");
    assert!(
        card.len() > brief,
        "once it is chosen the card says everything: {card}"
    );
    // The pointer goes away, the robot stays.
    window.hover_at(pos2(5.0, 5.0));
    window.run_steps(4);
    assert_eq!(
        text_of(&window, "robot at sample").as_deref(),
        Some(robot.as_str())
    );
    assert!(text_of(&window, "card of sample").is_none());
}

#[test]
fn the_card_never_covers_what_it_is_about() {
    for (width, height) in [(1280.0, 800.0), (1024.0, 700.0)] {
        let mut window = sized(None, width, height);
        let frame = plot(&window);
        let at = find_sample(&mut window, frame).expect("there are samples");
        for chosen in [false, true] {
            if chosen {
                click_at(&mut window, at);
            }
            let card = window.get_by_label_contains("card of sample").rect();
            let inside = Rect::from_min_size(Pos2::ZERO, vec2(width, height));
            assert!(inside.contains_rect(card), "{card:?}");
            assert!(!card.expand(20.0).contains(at), "{at:?} {card:?}");
        }
    }
}

#[test]
fn the_legend_never_covers_the_plot() {
    for (width, height) in [(1600.0, 900.0), (1440.0, 900.0)] {
        let mut window = sized(None, width, height);
        keys(&mut window, Modifiers::COMMAND, Key::I);
        press(&mut window, "display …");
        press(&mut window, "heat map");
        window.run_steps(4);
        let frame = plot(&window);
        assert!(frame.width() > 200.0 && frame.height() > 120.0, "{frame:?}");
        let entries = window.get_all_by_label_contains("legend: ");
        let rects: Vec<Rect> = entries.map(|entry| entry.rect()).collect();
        assert!(rects.len() > 3, "{rects:?}");
        for (k, rect) in rects.iter().enumerate() {
            assert!(!rect.intersects(frame.shrink(1.0)), "{rect:?} {frame:?}");
            assert!(rect.right() <= frame.right() + 1.0, "{rect:?} {frame:?}");
            let others = rects[..k].iter();
            assert!(others.into_iter().all(|o| !o.intersects(rect.shrink(1.0))));
        }
        assert!(there(&window, "legend: heat map, mm"));
    }
}

#[test]
fn it_is_zoomed_moved_and_fitted_again() {
    let mut window = window(None);
    let frame = plot(&window);
    let at = find_sample(&mut window, frame).expect("there are samples");
    let here = |window: &mut Window| {
        window.hover_at(at);
        window.run_steps(2);
        text_of(window, "card of sample")
    };
    let before = here(&mut window);
    assert!(before.is_some());
    let away = |window: &mut Window| {
        window.hover_at(frame.center());
        window.run_steps(1);
        window.event(egui::Event::Zoom(4.0));
        window.run_steps(6);
    };
    for way in 0..3 {
        away(&mut window);
        assert_ne!(here(&mut window), before, "zoomed");
        match way {
            0 => press(&mut window, "Fit to view"),
            1 => keys(&mut window, Modifiers::NONE, Key::Home),
            _ => keys(&mut window, Modifiers::COMMAND, Key::F),
        }
        assert_eq!(here(&mut window), before, "fitted");
    }
}

/// Whether the card of a sample is shown within a few points of a place.
fn near(window: &mut Window, at: Pos2, card: Option<&String>) -> bool {
    let around = (-3_i8..=3).flat_map(|x| (-3_i8..=3).map(move |y| vec2(x.into(), y.into())));
    let mut around = around.map(|off| at + 5.0 * off);
    around.any(|place| {
        window.hover_at(place);
        window.run_steps(2);
        text_of(window, "card of sample").as_ref() == card
    })
}

#[test]
fn the_wheel_goes_closer_about_the_pointer_and_does_not_push_the_robot_away() {
    let mut window = window(None);
    for look in ["x y", "polar"] {
        let named = if look == "polar" {
            polar(&mut window);
            "polar view,"
        } else {
            "workspace plot,"
        };
        let frame = window.get_by_label_contains(named).rect();
        let at = find_sample(&mut window, frame).expect("there are samples");
        let at = middle_of(&mut window, at, |window| text_of(window, "card of sample"));
        let card = text_of(&window, "card of sample");
        assert!(card.is_some(), "{look}");
        // What is under the pointer stays under it, however close.
        wheel(&mut window, at, 2.0);
        assert!(near(&mut window, at, card.as_ref()), "{look}, closer");
        wheel(&mut window, at, -4.0);
        assert!(near(&mut window, at, card.as_ref()), "{look}, farther");
        // Closer about another place: it goes away from there.
        keys(&mut window, Modifiers::NONE, Key::Home);
        wheel(&mut window, frame.center() + vec2(30.0, 0.0), 6.0);
        window.hover_at(at);
        window.run_steps(2);
        assert_ne!(text_of(&window, "card of sample"), card, "{look}");
        let fit = if look == "polar" {
            "Fit chart to view"
        } else {
            "Fit to view"
        };
        press(&mut window, fit);
        window.hover_at(at);
        window.run_steps(2);
        assert_eq!(text_of(&window, "card of sample"), card, "{look}");
    }
}

#[test]
fn an_arm_is_drawn_in_every_plane_and_has_no_polar_view() {
    let folder = tempfile::tempdir().expect("a folder");
    for (width, height) in [(1280.0, 800.0), (1024.0, 700.0)] {
        let mut window = sized(Some(arm(folder.path())), width, height);
        for plane in ["x y", "x z", "y z"] {
            press(&mut window, plane);
            let robot = text_of(&window, "robot at sample").expect("a robot");
            for (name, ..) in ARM {
                assert!(robot.contains(&format!("{name} ")), "{plane}: {robot}");
            }
        }
        keys(&mut window, Modifiers::COMMAND, Key::I);
        press(&mut window, "Samples");
        press(&mut window, "x z");
        let frame = plot(&window);
        if let Some(at) = find_sample(&mut window, frame) {
            click_at(&mut window, at);
            let card = text_of(&window, "card of sample").expect("a card");
            assert!(card.contains("flange"), "{card}");
        }
        polar(&mut window);
        assert!(!says(&window, "polar view"), "it has several joints");
        assert!(window.unnamed_widgets().is_empty());
    }
}

#[test]
fn a_joint_that_slides_has_no_polar_view() {
    let folder = tempfile::tempdir().expect("a folder");
    let rows = "0,250,0,300\n100,350.1,0,300\n200,450.2,0.1,300\n300,550.2,0,300\n";
    let path = write(folder.path(), RAIL, "q1_mm,x_mm,y_mm,z_mm", rows);
    let mut window = sized(Some(path), 1280.0, 800.0);
    assert!(says(&window, "workspace plot, 4 samples"));
    polar(&mut window);
    assert!(!says(&window, "polar view"));
}

#[test]
fn one_sample_and_samples_that_are_all_the_same_are_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let row = "30,216.5,125.1,300.1,1\n";
    for (rows, count) in [(row.to_owned(), 1), (row.repeat(50), 50)] {
        let path = column(folder.path(), &rows);
        let mut window = sized(Some(path), 1024.0, 700.0);
        for view in ["x y", "x z", "y z"] {
            press(&mut window, view);
            window.run_steps(4);
        }
        polar(&mut window);
        assert!(says(&window, &format!("{count} samples")));
        press(&mut window, "x y");
        press(&mut window, "display …");
        press(&mut window, "heat map");
        keys(&mut window, Modifiers::NONE, Key::Escape);
        keys(&mut window, Modifiers::COMMAND, Key::I);
        assert!(says(&window, &format!("workspace plot, {count} samples")));
        assert!(window.unnamed_widgets().is_empty());
    }
}

#[test]
fn the_slider_goes_from_after_to_before_by_keys() {
    let mut window = window(None);
    let name = "From before to after";
    assert!(!there(&window, name), "nothing is identified");
    keys(&mut window, Modifiers::COMMAND, Key::I);
    let value = |window: &Window| {
        let slider = window.get_by_label(name);
        slider.accesskit_node().numeric_value()
    };
    assert_eq!(value(&window), Some(1.0));
    window.get_by_label(name).focus();
    window.run_steps(2);
    for _ in 0..80 {
        window.key_press(Key::ArrowLeft);
        window.run_steps(1);
    }
    assert_eq!(value(&window), Some(0.0));
}

#[test]
fn the_polar_view_is_saved_as_a_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::I);
    polar(&mut window);
    assert!(there(&window, "Save picture: polar view…"));
    let path = folder.path().join("polar.svg");
    window.state_mut().type_path("polar", &path);
    window.run_steps(3);
    press(&mut window, "Save");
    window.run_steps(4);
    let svg = std::fs::read_to_string(&path).expect("it was written");
    assert!(svg.contains("1 division = "), "{}", &svg[..200]);
}
