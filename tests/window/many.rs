//! The window on many samples, and the layers of the workspace as a person switches them.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::window::{Window, keys, press, says, seconds, there, until, window, window_of};
use egui_kittest::kittest::Queryable;
use truepose::export::EXPORTERS;
use truepose::gui::{App, Runner};

const HEAD: &str = r#"{ "format": "truepose-session/1", "name": "many", "robot": { "name": "axis",
 "joints": [ { "name": "pan", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0] } ],
 "tool": { "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] } }, "tolerance_mm": 0.5,
 "instrument": { "name": "tracker", "sigma_mm": 0.03 }, "samples": { "file": "many.csv" } }"#;

/// A full turn of one reflector, a fifth of a millimetre too far out and a fifth of a degree ahead.
fn write_session(folder: &Path, samples: u32) -> PathBuf {
    let mut csv = "q1_deg,x_mm,y_mm,z_mm,dir1,load_kg\n".to_owned();
    for i in 0..samples {
        let q = f64::from(i) / f64::from(samples) * 360.0 - 180.0;
        let (sin, cos) = (q + 0.2).to_radians().sin_cos();
        let direction = if i % 2 == 0 { 1 } else { -1 };
        let (x, y) = (250.2 * cos, 250.2 * sin);
        writeln!(csv, "{q:.6},{x:.5},{y:.5},300,{direction},{}", i % 3).expect("memory suffices");
    }
    std::fs::write(folder.join("many.csv"), csv).expect("the folder can be written to");
    let path = folder.join("many.json");
    std::fs::write(&path, HEAD).expect("the folder can be written to");
    path
}

/// Triangles and callbacks of one frame with layers.
fn triangles(samples: u32) -> usize {
    let folder = tempfile::tempdir().expect("a folder");
    let path = write_session(folder.path(), samples);
    let ctx = egui::Context::default();
    let mut app = App::new(&ctx, Some(path), Runner::AtOnce);
    let mut count = 0;
    for _ in 0..6 {
        let screen = egui::vec2(1280.0, 800.0);
        let input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, screen)),
            ..egui::RawInput::default()
        };
        let mut output = ctx.run_ui(input, |ui| app.show(ui));
        output.textures_delta.clear();
        let primitives = ctx.tessellate(output.shapes, output.pixels_per_point);
        let of = |p: &egui::ClippedPrimitive| match &p.primitive {
            egui::epaint::Primitive::Mesh(mesh) => mesh.indices.len() / 3,
            egui::epaint::Primitive::Callback(_) => 1,
        };
        count = primitives.iter().map(of).sum();
    }
    count
}

#[test]
fn a_frame_of_many_samples_is_no_larger_than_one_of_some() {
    let (some, many) = (triangles(5_000), triangles(100_000));
    assert!(many < some + some / 10, "{some} and {many} triangles");
}

#[test]
fn the_pointer_finds_a_sample_among_many_in_both_plots() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(Some(write_session(folder.path(), 30_000)));
    let plot = window.get_by_label("workspace plot, 30000 samples").rect();
    let chart = window.get_by_label("deviation chart, tangential").rect();
    for (name, rect) in [("workspace", plot), ("chart", chart)] {
        let named = (0_u8..80).any(|k| {
            let part = f32::from(k) / 80.0;
            let x = rect.center().x + 0.05 * rect.width();
            let y = rect.top() + part * rect.height();
            window.hover_at(egui::pos2(x, y));
            window.run_steps(3);
            window.query_by_label_contains("card of sample").is_some()
        });
        assert!(named, "no sample was named in the {name}");
        window.hover_at(egui::pos2(5.0, 5.0));
        window.run_steps(3);
    }
}

#[test]
fn a_preparation_that_is_cancelled_is_begun_again_when_that_is_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = write_session(folder.path(), 40_000);
    let mut window = window_of([1280.0, 1000.0], Some(path), Runner::Threads);
    until(&mut window, "40\u{202f}000 samples");
    keys(&mut window, egui::Modifiers::COMMAND, egui::Key::I);
    until(&mut window, " → ");
    window.get_by_label("5 Export").click();
    until(&mut window, "The table is being prepared");
    window.get_by_label("Cancel").click();
    until(&mut window, "It was cancelled");
    seconds(&mut window, 3);
    assert!(
        !says(&window, "The table is being prepared"),
        "not by itself"
    );
    press(&mut window, "Prepare the table");
    until(&mut window, "RMS error left by the table");
    // The figures of one format do not stand under the name of another.
    let other = EXPORTERS.iter().filter(|one| one.rules.is_some()).nth(1);
    let other = other.expect("it is a format").title.english();
    window.get_by_label(other).click();
    window.run_steps(3);
    assert!(says(&window, "The table is being prepared"));
    assert!(!there(&window, "RMS error left by the table"));
    until(&mut window, "RMS error left by the table");
}

#[test]
fn the_heat_map_is_switched_in_the_bar() {
    let mut window = window(None);

    let choose = |window: &mut Window, name: &str| {
        if !there(window, "vectors") {
            press(window, "display …");
        }
        let named = window.get_all_by_label(name).last();
        named.expect("offered").click();
        window.run_steps(4);
    };
    choose(&mut window, "heat map");
    assert!(there(&window, "legend: heat map, mm"));

    keys(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    keys(&mut window, egui::Modifiers::COMMAND, egui::Key::I);

    keys(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    window.get_by_label("x z").click();
    window.run_steps(4);
    window.get_by_label("workspace plot, 208 samples");
    assert!(window.unnamed_widgets().is_empty());
}
