//! How things look and agree: one figure wherever it is said, what is read first, what can be dragged.

use std::path::{Path, PathBuf};

use crate::window::{
    Window, export_to, go_to, into_sight, keys, press, says, status, there, window, window_of,
};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::{App, Language, Runner};

const TALL: [f32; 2] = [1280.0, 1600.0];

fn arm(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("tests/data/arms").join(name)
}

fn middle(window: &Window, label: &str) -> Pos2 {
    window.get_by_label(label).rect().center()
}

/// Presses, and is this far away before the next frame; lets go in the one after it.
fn flicked(window: &mut Window, from: Pos2, by: Vec2) {
    let press = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    window.hover_at(from);
    window.run_steps(2);
    let events = &mut window.input_mut().events;
    events.extend([press(from, true), Event::PointerMoved(from + by)]);
    window.step();
    let events = &mut window.input_mut().events;
    events.push(press(from + by, false));
    window.run_steps(4);
}

#[test]
fn a_boundary_that_is_dragged_quickly_moves_and_the_plot_stays() {
    let mut window = window(None);
    press(&mut window, "2 Regions");
    let (from, other) = (
        middle(&window, "boundary at 0°"),
        middle(&window, "boundary at 100°"),
    );
    flicked(&mut window, from, vec2(-12.0, -48.0));
    assert!(!there(&window, "boundary at 0°"), "it was taken along");
    let stays = middle(&window, "boundary at 100°");
    // The answer that follows takes a row above the plot; a pan would be as far as the hand went.
    assert!(stays.distance(other) < 4.0, "{other} {stays}");
    assert!(there(&window, "Undo change regions"));
    press(&mut window, "Undo change regions");
    assert!(there(&window, "boundary at 0°"), "in one step");
}

#[test]
fn boundaries_are_dragged_in_the_chart_as_well() {
    let mut window = window(None);
    press(&mut window, "2 Regions");
    let from = middle(&window, "in the chart, boundary at 50°");
    for quick in [true, false] {
        if quick {
            flicked(&mut window, from, vec2(40.0, 0.0));
        } else {
            window.drag_at(from);
            window.step();
            window.hover_at(from + vec2(20.0, 0.0));
            window.step();
            window.drop_at(from + vec2(40.0, 0.0));
            window.run_steps(4);
        }
        assert!(!there(&window, "boundary at 50°"), "in the plot too");
        press(&mut window, "Undo change regions");
        assert!(there(&window, "in the chart, boundary at 50°"));
    }
    go_to(&mut window, "Identify");
    assert!(
        !says(&window, "in the chart, boundary"),
        "only where regions are edited"
    );
}

#[test]
fn the_decimal_sign_is_that_of_the_language_until_it_is_chosen() {
    let home = tempfile::tempdir().expect("a folder");
    let german = || {
        let mut window = Harness::builder()
            .with_size([1280.0, 800.0])
            .build_eframe(|cc| {
                let app = App::new(&cc.egui_ctx, None, Runner::AtOnce);
                app.at_home(Some(home.path().into()))
                    .speaking(Language::German)
            });
        window.run_steps(6);
        window
    };
    let mut window = german();
    assert!(says(&window, "2,48") && !says(&window, "2.48"));
    let fields = window.get_all_by_role(egui::accesskit::Role::SpinButton);
    let values: Vec<_> = fields.map(|field| field.accesskit_node().value()).collect();
    let written = |value: &Option<String>| value.as_ref().is_some_and(|v| v.starts_with("0,2"));
    assert!(values.iter().any(written), "in fields as well: {values:?}");
    keys(&mut window, Modifiers::COMMAND, Key::Comma);
    press(&mut window, "1.5");
    assert!(says(&window, "2.48") && !says(&window, "2,48"));
    press(&mut window, "English");
    drop(window);
    let mut window = german();
    keys(&mut window, Modifiers::COMMAND, Key::Comma);
    press(&mut window, "of the language");
    press(&mut window, "Deutsch");
    assert!(says(&window, "2,48"));
}

#[test]
fn marks_say_that_it_is_the_model_that_is_within_the_tolerance() {
    let mut window = window_of(TALL, None, Runner::AtOnce);
    assert!(!says(&window, "model within"));
    keys(&mut window, Modifiers::COMMAND, Key::G);
    press(&mut window, "Add all 5 effects to the model");
    assert!(!says(&window, "model within"), "nothing else is known yet");
    // The export step works out what corrected commands do.
    go_to(&mut window, "Export");
    assert!(says(&window, "model within") && says(&window, "model outside"));
    go_to(&mut window, "Identify");
    if there(&window, "Summary") {
        press(&mut window, "Summary");
    }
    for (name, count) in [
        ("within tolerance, with the model", "0 → 208 of 208"),
        ("within tolerance, commands corrected", "0 → 0 of 208"),
    ] {
        assert!(says(&window, name) && says(&window, count), "{name}");
    }
}

#[test]
fn what_the_table_leaves_is_one_figure_wherever_it_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_of(TALL, None, Runner::AtOnce);
    keys(&mut window, Modifiers::COMMAND, Key::G);
    press(&mut window, "Add all 5 effects to the model");
    assert!(!status(&window).contains("with the table"), "not made yet");
    go_to(&mut window, "Export");
    assert!(there(&window, "1.40 mm") && says(&window, "not correctable by joint commands"));
    assert!(status(&window).contains("→ 0.0533 mm · with the table 1.40 mm"));
    go_to(&mut window, "Diagnose");
    assert!(status(&window).contains("with the table 1.40 mm"));
    // Another model has another table.
    press(&mut window, "Undo choose effects");
    assert!(!status(&window).contains("with the table"));
    keys(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);

    go_to(&mut window, "Export");
    let path = folder.path().join("table.csv");
    export_to(&mut window, &path);
    let beside = std::fs::read_to_string(folder.path().join("table.csv.meta.json"));
    let beside = beside.expect("what it means");
    assert!(
        says(&window, "Link droop leaves "),
        "what only its loads show"
    );
    let line = window.get_by_label_contains("Base offset leaves ");
    let line = line
        .accesskit_node()
        .value()
        .or(line.accesskit_node().label());
    let line = line.expect("it is said").replace('−', "-");
    let size = line
        .split(" leaves ")
        .nth(1)
        .and_then(|rest| rest.split(':').next());
    let size = format!("leaves {}", size.expect("a size"));
    assert!(beside.contains(&size), "{size}: {beside}");
}

#[test]
fn the_card_of_an_effect_has_the_size_that_the_model_has_and_the_rest_on_demand() {
    let mut window = window_of(TALL, None, Runner::AtOnce);
    keys(&mut window, Modifiers::COMMAND, Key::G);
    assert!(says(&window, "0.4168 ± 0.0065 mm") && says(&window, "survey the base again"));
    assert!(!says(&window, "chance that noise alone looks like this"));
    let more = window.get_all_by_label("More").next();
    more.expect("a card").click();
    window.run_steps(12);
    assert!(says(&window, "chance that noise alone looks like this"));
    // Without one of the others it is another fit, and the card says what that has.
    press(&mut window, "Add all 5 effects to the model");
    press(&mut window, "use encoder eccentricity");
    assert!(!says(&window, "0.4168 ± 0.0065 mm"));
}

#[test]
fn of_an_arm_with_many_samples_the_telling_vectors_are_drawn_and_that_is_said() {
    let which = "vectors: largest, others evenly";
    for (file, says_which) in [
        (Some(arm("six-60.json")), Some("64 of 140")),
        (Some(arm("six-200.json")), Some("64 of ")),
        // Those of one joint stand in a row.
        (None, None),
    ] {
        let window = window_of([1280.0, 800.0], file, Runner::AtOnce);
        assert_eq!(says(&window, which), says_which.is_some());
        assert!(says_which.is_none_or(|says_which| says(&window, says_which)));
    }
}

#[test]
fn the_frames_of_an_arm_are_tables_below_that_of_its_joints() {
    let mut window = window_of(TALL, Some(arm("six-60.json")), Runner::AtOnce);
    press(&mut window, "2 Identify");
    press(&mut window, "Identify");
    let right = |label: &str| {
        let all = window.get_all_by_label(label);
        all.map(|node| node.rect().right()).fold(0.0, f32::max)
    };
    let (joints, places) = (right("about\ny, mrad"), right("z,\nmm"));
    assert!((joints - places).abs() < 4.0, "as wide: {joints} {places}");
    assert!(there(&window, "tool position") && !says(&window, "; y "));
}

#[test]
fn the_heads_of_samples_have_their_units() {
    let mut window = window(None);
    press(&mut window, "Samples");
    for head in ["angle\n°", "before\nmm", "after\nmm"] {
        window.get_by_label(head);
    }
}

#[test]
fn the_details_of_a_report_stand_in_one_column_and_their_sheet_stays_where_it_is() {
    let mut window = window(None);
    keys(&mut window, Modifiers::COMMAND, Key::I);
    press(&mut window, "5 Export");
    press(&mut window, "Report details…");
    let left = |window: &Window, label: &str| {
        let all = window.get_all_by_label(label);
        all.map(|node| node.rect().left()).fold(0.0, f32::max)
    };
    let [number, tolerance, rule] =
        ["Report number", "tolerance", "Not decided"].map(|label| left(&window, label));
    assert!((number - tolerance).abs() < 1.0, "{number} {tolerance}");
    assert!((number - rule).abs() < 4.0, "{number} {rule}");
    let top = |window: &Window| {
        let all = window.get_all_by_label("Stated at the head of the report and remembered for this machine; an empty field becomes a line to fill in by hand");
        all.map(|node| node.rect().top()).fold(0.0, f32::max)
    };
    let before = top(&window);
    press(&mut window, "ISO 14253-1");
    assert!(
        (top(&window) - before).abs() < 0.5,
        "its text is longer now"
    );
}

#[test]
fn a_report_says_sizes_with_the_effects_and_one_reason_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let page = |file: Option<PathBuf>, name: &str| {
        let mut window = window(file);
        keys(&mut window, Modifiers::COMMAND, Key::G);
        let path = folder.path().join(name);
        window.state_mut().type_path("report", &path);
        window.run_steps(4);
        press(&mut window, "Save");
        std::fs::read_to_string(&path).expect("the report")
    };
    let of_an_arm = page(Some(arm("six-200.json")), "arm.html");
    let reason = "the first of each is held at zero, the others carry it";
    assert_eq!(of_an_arm.matches(reason).count(), 1);
    assert!(!of_an_arm.contains(": offset is held at zero"));
    let page = page(None, "axis.html");
    assert!(page.contains("table, figure, .facts div { break-inside: avoid; }"));
    let found = page.split("Effects found").nth(1).expect("it found some");
    let first = found.split("<dl class=\"facts\">").nth(1).expect("facts");
    let first = first.split("</dl>").next().unwrap_or_default();
    assert!(
        first.contains(" ± ") && first.contains("Check on the machine"),
        "{first}"
    );
}

#[test]
fn the_preview_of_an_export_shows_lines_and_what_they_mean_on_demand() {
    let mut window = window_of([1280.0, 1000.0], None, Runner::AtOnce);
    keys(&mut window, Modifiers::COMMAND, Key::I);
    go_to(&mut window, "Export");
    assert!(
        says(&window, "corrections: add them to the command"),
        "the sign"
    );
    assert!(!says(&window, "robot reached"), "the example");
    let lines = (-150..=150).filter(|degree| says(&window, &format!("{degree},0.3")));
    assert!(lines.count() >= 15, "lines of the table");
    into_sight(&mut window, "What the numbers mean");
    press(&mut window, "What the numbers mean");
    window.run_steps(12);
    assert!(says(&window, "robot reached"));
}
