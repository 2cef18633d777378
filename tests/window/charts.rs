//! The charts below the workspace, without a display: chosen by name, pointed at, clicked, copied
//! and saved; of sessions with every column, with few, of one sample, of equal samples and of
//! several joints.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::window::{Window, copied, middle_of, press, says, there, wheel, window};
use egui::pos2;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::{App, Runner};

/// A chart and what it is called once it is shown.
const SAMPLES: [(&str, &str); 4] = [
    ("Deviation over angle", "deviation chart, "),
    ("Deviation over time", "deviation over time chart, "),
    ("Deviation over load", "deviation over load chart, "),
    (
        "Deviation over temperature",
        "deviation over temperature chart, ",
    ),
];

/// Chooses one of several in a list.
fn choose(window: &mut Window, list: &str, name: &str) {
    press(window, list);
    // The list that is open comes last.
    window.query_all_by_label(name).last().expect(name).click();
    window.run_steps(6);
}

fn chart(window: &mut Window, name: &str) {
    choose(window, "Choose chart", name);
}

/// What a chart says about itself to those who do not see it.
fn described(window: &Window, name: &str) -> String {
    let node = window.get_by_label_contains(name);
    let said = node.accesskit_node().description();
    said.expect("it says what is seen")
}

/// The first sample that is named when the pointer goes through a chart, and where.
fn find_sample(window: &mut Window, name: &str) -> Option<(egui::Pos2, String)> {
    let rect = window.get_by_label_contains(name).rect();
    for part in [0.5, 0.35, 0.65, 0.52, 0.2, 0.8] {
        for k in 0_u8..60 {
            let down = f32::from(k) / 60.0;
            let at = pos2(
                rect.left() + part * rect.width(),
                rect.top() + down * rect.height(),
            );
            window.hover_at(at);
            window.run_steps(2);
            let mut cards = window.query_all_by_label_contains("card of sample ");
            let sample = cards.find_map(|node| {
                let said = node.accesskit_node().label()?;
                let (title, _) = said.strip_prefix("card of ")?.split_once(':')?;
                Some(title.to_owned())
            });
            if let Some(sample) = sample {
                return Some((at, sample));
            }
        }
    }
    None
}

fn click(window: &mut Window, at: egui::Pos2) {
    window.hover_at(at);
    window.run_steps(1);
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(6);
}

const ONE_JOINT: &str = r#""robot": { "name": "axis",
 "joints": [ { "name": "pan", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0] } ],
 "tool": { "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] } }"#;

const THREE_JOINTS: &str = r#""robot": { "name": "arm",
 "joints": [ { "name": "pan", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0] },
  { "name": "lift", "kind": "prismatic", "axis": [0,0,1], "point_mm": [0,0,0] },
  { "name": "wrist", "kind": "revolute", "axis": [0,0,1], "point_mm": [200,0,0] } ],
 "tool": { "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] } }"#;

fn session(folder: &Path, robot: &str, csv: &str) -> PathBuf {
    let head = format!(
        r#"{{ "format": "truepose-session/1", "name": "made", {robot}, "tolerance_mm": 0.3,
 "instrument": {{ "name": "tracker", "sigma_mm": 0.03 }}, "samples": {{ "file": "made.csv" }} }}"#
    );
    std::fs::write(folder.join("made.csv"), csv).expect("written");
    let path = folder.join("made.json");
    std::fs::write(&path, head).expect("written");
    path
}

/// A pointer on a sample in one chart is on it in all, and a click brings its row into sight.
#[test]
fn every_chart_is_chosen_by_name_and_its_samples_are_named_and_chosen() {
    let mut window = window(None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    press(&mut window, "Samples");
    let rows = copied(&mut window, "Copy table of samples");
    assert_eq!(rows.len(), 1 + 208, "a heading and every sample");
    assert_eq!((&*rows[0][1], &*rows[0][7]), ("q1, deg", "after, mm"));
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
    assert!(rows[1..].iter().all(|row| row[7].parse::<f64>().is_ok()));
    for (name, label) in SAMPLES {
        chart(&mut window, name);
        let found = find_sample(&mut window, label);
        let (at, sample) = found.unwrap_or_else(|| panic!("no sample was named in {name}"));
        click(&mut window, at);
        let row = sample.trim_start_matches("sample ").to_owned();
        window.hover_at(pos2(5.0, 300.0));
        window.run_steps(4);
        let shown = window.query_all_by_label(&row).count();
        assert!(shown > 0, "{name}: the row of {sample} is in sight");
        let words = described(&window, label);
        assert!(
            words.contains("tangential deviation over ") && words.contains("before"),
            "{words}"
        );
        assert!(
            words.contains("after") && words.contains("tolerance"),
            "{words}"
        );
    }

    chart(&mut window, "Order spectrum");
    let words = described(&window, "order spectrum, tangential");
    assert!(
        words.contains("before") && words.contains("99 of 100"),
        "{words}"
    );
    let orders = copied(&mut window, "Copy numbers: order spectrum");
    assert_eq!(orders[0][0], "order");
    assert!(orders.len() > 5 && orders.iter().all(|row| row.len() == 6));

    chart(&mut window, "Histogram");
    let words = described(&window, "histogram, tangential");
    assert!(
        words.contains("within ±0.2") && words.contains("of 208"),
        "{words}"
    );
    let bins = copied(&mut window, "Copy numbers: histogram");
    for column in [2, 3] {
        let counts = bins[1..].iter().map(|row| row[column].parse::<usize>());
        let all: usize = counts.map(|c| c.expect("a count")).sum();
        assert_eq!(all, 208, "every sample is counted once");
    }
    // Gaps of the search come with the answer.
    chart(&mut window, "Gap by step");
    window.get_by_label_contains("gap by step: nominal robot");
    let steps = copied(&mut window, "Copy numbers: gap by step");
    assert_eq!(steps.len(), 3, "{steps:?}");
    assert!(window.unnamed_widgets().is_empty());
}

#[test]
fn a_click_on_a_bar_of_the_histogram_marks_its_samples() {
    let mut window = window(None);
    chart(&mut window, "Histogram");
    let rect = window.get_by_label_contains("histogram, ").rect();
    let found = (0_u8..40).find_map(|k| {
        let x = rect.left() + rect.width() * (0.1 + 0.88 * f32::from(k) / 40.0);
        let at = pos2(x, rect.bottom() - 40.0);
        window.hover_at(at);
        window.run_steps(2);
        let ends = window.query_all_by_label_contains(" … ");
        let mut ends = ends.filter_map(|node| node.accesskit_node().value());
        let bar = ends.any(|says| says.ends_with(" mm"));
        bar.then_some(at)
    });
    let at = found.expect("there is a bar");
    click(&mut window, at);
    assert!(says(&window, "angle, °"), "the table of samples is shown");
}

/// Before can be left out, and the chart shows what is left.
#[test]
fn what_is_left_can_be_looked_at_alone() {
    let mut window = window(None);
    assert!(!there(&window, "show before"), "there is nothing else yet");
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    chart(&mut window, "Histogram");
    let reach = |window: &mut Window| {
        let bins = copied(window, "Copy numbers: histogram");
        let number = |cell: &str| cell.parse::<f64>().expect("a number");
        number(&bins[bins.len() - 1][1]) - number(&bins[1][0])
    };
    let both = reach(&mut window);
    press(&mut window, "show before");
    assert!(
        reach(&mut window) < 0.6 * both,
        "the bins suit what is left"
    );
    press(&mut window, "show before");
    assert!((reach(&mut window) - both).abs() < 1e-12);
}

#[test]
fn a_column_that_was_not_logged_is_named_with_what_it_would_show() {
    let mut window = window(Some(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/paper-30.json"),
    ));
    for (name, column) in [
        ("Deviation over time", "time_s"),
        ("Deviation over load", "load_kg"),
        ("Deviation over temperature", "temperature_c"),
    ] {
        chart(&mut window, name);
        assert!(
            says(&window, &format!("A column {column} would show")),
            "{name}"
        );
    }
    chart(&mut window, "Order spectrum");
    assert!(says(&window, "order spectrum, tangential"));
    chart(&mut window, "Histogram");
    assert!(says(&window, "histogram, tangential"));
    chart(&mut window, "Deviation over angle");
    assert!(says(&window, "deviation chart, tangential"));
}

#[test]
fn one_sample_and_samples_that_are_all_equal_have_every_chart() {
    let head = "q1_deg,x_mm,y_mm,z_mm,dir1,load_kg,temperature_c,time_s\n";
    let row = "30,216.6,125.1,300.05,1,2.5,21.5,7\n";
    for count in [1, 40] {
        let folder = tempfile::tempdir().expect("a folder");
        let csv = format!("{head}{}", row.repeat(count));
        let path = session(folder.path(), ONE_JOINT, &csv);
        let mut window = window(Some(path));
        for (name, label) in SAMPLES {
            chart(&mut window, name);
            let words = described(&window, label);
            assert!(words.contains("before"), "{count} {name}: {words}");
        }
        assert!(says(&window, "the temperature never changes"));
        chart(&mut window, "Order spectrum");
        assert!(says(&window, "Too few different angles"), "{count}");
        chart(&mut window, "Histogram");
        let bins = copied(&mut window, "Copy numbers: histogram");
        let full: Vec<&str> = bins[1..]
            .iter()
            .map(|row| &*row[2])
            .filter(|c| *c != "0")
            .collect();
        assert_eq!(full, [count.to_string()]);
    }
}

#[test]
fn of_several_joints_the_charts_are_about_the_chosen_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut csv = "q1_deg,q2_mm,q3_deg,x_mm,y_mm,z_mm,dir1,dir3\n".to_owned();
    for i in 0..90_u32 {
        let [pan, wrist] = [i * 7 % 180, i * 11 % 120].map(f64::from);
        let lift = f64::from(i % 10) * 10.0;
        let (a, b) = (pan.to_radians(), (pan + wrist).to_radians());
        let (x, y) = (
            200.0 * a.cos() + 50.0 * b.cos(),
            200.0 * a.sin() + 50.0 * b.sin(),
        );
        writeln!(
            csv,
            "{pan},{lift},{wrist},{:.4},{y:.4},{:.4},1,-1",
            x + 0.1,
            300.0 + lift
        )
        .expect("memory suffices");
    }
    let path = session(folder.path(), THREE_JOINTS, &csv);
    let mut window = window(Some(path));
    let over = |window: &Window| described(window, "deviation chart, tangential");
    let ends = |window: &mut Window| {
        let rows = copied(window, "Copy numbers: deviation over angle");
        let along = rows[1..].iter().map(|row| row[1].parse::<f64>());
        let along: Vec<f64> = along.map(|value| value.expect("a number")).collect();
        let high = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = along.iter().copied().fold(f64::INFINITY, f64::min);
        [low.round(), high.round()]
    };
    assert!(over(&window).contains("over pan"), "{}", over(&window));
    assert_eq!(ends(&mut window), [0.0, 179.0]);
    choose(&mut window, "Joint of the chart", "wrist");
    assert!(over(&window).contains("over wrist"), "{}", over(&window));
    assert_eq!(ends(&mut window), [0.0, 117.0]);
    let rows = copied(&mut window, "Copy numbers: deviation over angle");
    assert_eq!(
        (&*rows[0][1], &*rows[1][2]),
        ("q3, deg", "-1"),
        "its own side"
    );
    chart(&mut window, "Order spectrum");
    assert!(says(&window, "order spectrum, tangential"));
    choose(&mut window, "Joint of the chart", "lift");
    assert!(says(&window, "lift slides"), "it has no turns");
    chart(&mut window, "Deviation over angle");
    assert!(over(&window).contains("over lift"), "{}", over(&window));
    assert_eq!(ends(&mut window), [0.0, 90.0]);
}

#[test]
fn a_found_effect_shows_its_own_curve_and_every_chart_is_saved_as_a_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(None);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    let first = window.get_all_by_label("Show its curve").next();
    first.expect("something was found").scroll_to_me();
    window.run_steps(6);
    let first = window.get_all_by_label("Show its curve").next();
    first.expect("something was found").click();
    window.run_steps(6);
    let words = described(&window, "curve of ");
    assert!(words.contains("residual without"), "{words}");
    let rows = copied(&mut window, "Copy numbers: effect's own curve");
    assert_eq!(rows.len(), 209);
    assert!(find_sample(&mut window, "curve of ").is_some());

    for (plot, says) in [
        ("deviation", "As measured"),
        ("deviation over time", "time, "),
        ("deviation over load", "load, kg"),
        ("deviation over temperature", "temperature, °C"),
        ("effect's curve", "residual without"),
    ] {
        saved(&mut window, plot, says, folder.path());
    }
    chart(&mut window, "Order spectrum");
    saved(
        &mut window,
        "order spectrum",
        "cycles per turn",
        folder.path(),
    );
    chart(&mut window, "Histogram");
    saved(&mut window, "histogram", "within ±", folder.path());
    press(&mut window, "5 Export");
    chart(&mut window, "Correction table");
    saved(&mut window, "correction table", "correction", folder.path());
}

fn saved(window: &mut Window, plot: &str, says: &str, folder: &Path) {
    let path = folder.join(format!("{plot}.svg"));
    window.state_mut().type_path(plot, &path);
    window.run_steps(4);
    press(window, "Save");
    let svg = std::fs::read_to_string(&path).expect("the picture is there");
    assert!(
        svg.starts_with("<svg ") && svg.ends_with("</svg>\n"),
        "{plot}"
    );
    assert!(svg.contains(says), "{plot}: {svg}");
    assert!(
        !svg.contains("NaN") && !svg.contains("inf"),
        "{plot}: {svg}"
    );
}

/// Triangles of the frame that was drawn last.
fn triangles(window: &Window) -> usize {
    let output = window.output();
    let shapes = output.shapes.clone();
    let primitives = window.ctx.tessellate(shapes, output.pixels_per_point);
    let of = |p: &egui::ClippedPrimitive| match &p.primitive {
        egui::epaint::Primitive::Mesh(mesh) => mesh.indices.len() / 3,
        egui::epaint::Primitive::Callback(_) => 1,
    };
    primitives.iter().map(of).sum()
}

/// What a frame draws does not grow with the samples, whatever is charted.
#[test]
fn a_chart_of_many_samples_is_no_larger_than_one_of_some() {
    let mut sizes = Vec::new();
    for count in [4_000_u32, 40_000] {
        let folder = tempfile::tempdir().expect("a folder");
        let mut csv = "q1_deg,x_mm,y_mm,z_mm,dir1,load_kg,temperature_c,time_s\n".to_owned();
        for i in 0..count {
            let q = f64::from(i) / f64::from(count) * 300.0 - 150.0;
            let (sin, cos) = q.to_radians().sin_cos();
            let side = if i % 2 == 0 { 1 } else { -1 };
            let (load, warm) = (i % 7, 20.0 + f64::from(i % 501) * 0.01);
            let radius = 250.2 + 0.1 * f64::from(i * 31 % 17) / 17.0;
            let (x, y) = (radius * cos, radius * sin);
            writeln!(csv, "{q:.5},{x:.4},{y:.4},300,{side},{load},{warm},{i}")
                .expect("memory suffices");
        }
        let path = session(folder.path(), ONE_JOINT, &csv);
        let mut window = window(Some(path));
        let names = SAMPLES.iter().map(|(name, _)| *name);
        let of_each = names.chain(["Order spectrum", "Histogram"]).map(|name| {
            chart(&mut window, name);
            (name, triangles(&window))
        });
        sizes.push(of_each.collect::<Vec<_>>());
    }
    for ((name, some), (_, many)) in sizes[0].iter().zip(&sizes[1]) {
        assert!(
            *many < some + some / 5,
            "{name}: {some} and {many} triangles"
        );
    }
}

/// Nothing hangs over where there is little room, down to the smallest window.
#[test]
fn the_bar_of_the_charts_fits_from_a_small_window_to_a_large_one() {
    for width in [1024.0, 1120.0, 1280.0, 1920.0, 3840.0] {
        let mut window: Window = Harness::builder()
            .with_size([width, 800.0])
            .build_eframe(|cc| App::new(&cc.egui_ctx, None, Runner::AtOnce));
        window.run_steps(6);
        let chart = window.get_by_label("deviation chart, tangential").rect();
        let save = window
            .get_by_label("Save picture: deviation over angle…")
            .rect();
        assert!(
            save.right() <= chart.right() + 12.0,
            "{width}: {save:?} {chart:?}"
        );
        let mut left = save.left();
        for name in [
            "what deviation means",
            "Copy numbers: deviation over angle",
            "Component",
            "Choose chart",
        ] {
            for node in window.query_all_by_label(name) {
                let rect = node.rect();
                assert!(
                    rect.right() <= save.left() + 1.0,
                    "{width}: {name} at {rect:?}"
                );
                assert!(
                    rect.left() >= chart.left() - 60.0,
                    "{width}: {name} at {rect:?}"
                );
                left = left.min(rect.left());
            }
        }
        assert!(left < save.left());
        assert!(
            there(&window, "Choose chart"),
            "{width}: one form at any width"
        );
    }
}

#[test]
fn a_chart_that_was_dragged_away_comes_back() {
    let mut window = window(None);
    let (at, sample) = find_sample(&mut window, "deviation chart, ").expect("there are samples");
    let card = |window: &Window| {
        let mut cards = window.query_all_by_label_contains("card of sample");
        cards.find_map(|node| node.accesskit_node().label())
    };
    let at = middle_of(&mut window, at, card);
    let here = |window: &mut Window| {
        window.hover_at(at);
        window.run_steps(3);
        card(window).is_some()
    };
    assert!(here(&mut window), "{sample}");
    for way in ["Fit chart to view", "Home"] {
        window.drag_at(at);
        window.run_steps(1);
        window.hover_at(at + egui::vec2(160.0, 60.0));
        window.run_steps(1);
        window.drop_at(at + egui::vec2(160.0, 60.0));
        window.run_steps(3);
        assert!(!here(&mut window), "{way}: it was dragged");
        if way == "Home" {
            window.key_press(egui::Key::Home);
            window.run_steps(3);
        } else {
            press(&mut window, "Fit chart to view");
        }
        assert!(here(&mut window), "{way}");
    }
    // What is under the pointer stays there while the wheel goes closer.
    let named = card(&window);
    wheel(&mut window, at, 2.0);
    assert_eq!(card(&window), named);
}
