//! Small pictures of the window, so that nobody changes its look without seeing it: every step with
//! its work done, light and dark, and the sheets. They need something to draw with; without an
//! adapter they say so and pass, and the rest of the window's tests does without.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test window pictures::` renews them.
use std::path::PathBuf;

use egui::Theme;
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, SnapshotOptions};
use truepose::gui::{App, Runner};

type Window = Harness<'static, App>;

/// The smallest window, 640 pixels wide: small files, and everything that there is in sight.
const SIZE: [f32; 2] = [1024.0, 700.0];
const PIXELS_PER_POINT: f32 = 0.625;

/// Whether there is an adapter; `.wgpu()` panics where there is none.
fn can_draw() -> bool {
    let instance = wgpu::Instance::default();
    let adapters = instance.enumerate_adapters(wgpu::Backends::all());
    let found = !pollster::block_on(adapters).is_empty();
    let in_ci = std::env::var("CI").is_ok_and(|ci| ci == "true");
    assert!(found || !in_ci, "CI has to have an adapter to draw with");
    found
}

fn window(theme: Theme, path: Option<PathBuf>) -> Option<Window> {
    if !can_draw() {
        eprintln!("skipped: no adapter to draw with");
        return None;
    }
    let mut window = Harness::builder()
        .with_size(SIZE)
        .with_pixels_per_point(PIXELS_PER_POINT)
        .with_theme(theme)
        .wgpu()
        .build_eframe(|cc| {
            let app = App::new(&cc.egui_ctx, path, Runner::AtOnce);
            app.drawn_by(cc.wgpu_render_state.as_ref())
        });
    window.run_steps(4);
    Some(window)
}

fn press(window: &mut Window, label: &str) {
    window.get_by_label(label).scroll_to_me();
    window.run_steps(6);
    window.get_by_label(label).click();
    window.run_steps(4);
}

/// Holds the window against its picture. Software renderers round a few pixels in ten thousand
/// differently.
fn looks_like(window: &mut Window, name: &str) {
    window.remove_cursor();
    window.run_steps(4);
    let alike = SnapshotOptions::new().max_failed_pixels(250);
    window.snapshot_options(name, &alike);
}

/// The whole job, with a picture of every step.
fn the_job(theme: Theme, name: &str) {
    let Some(mut window) = window(theme, None) else {
        return;
    };
    looks_like(&mut window, &format!("1-session-{name}"));
    press(&mut window, "2 Regions");
    looks_like(&mut window, &format!("2-regions-{name}"));
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    looks_like(&mut window, &format!("3-identify-{name}"));
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    press(&mut window, "Add all 5 effects to the model");
    looks_like(&mut window, &format!("4-gap-{name}"));
    press(&mut window, "5 Export");
    looks_like(&mut window, &format!("5-export-{name}"));
}

#[test]
fn the_job_in_light() {
    the_job(Theme::Light, "light");
}

#[test]
fn the_job_in_dark() {
    the_job(Theme::Dark, "dark");
}

#[test]
fn the_search_before_it_begins_in_light() {
    let Some(mut window) = window(Theme::Light, None) else {
        return;
    };
    press(&mut window, "4 Diagnose");
    looks_like(&mut window, "4-gap-before-light");
}

#[test]
fn the_heat_map_in_light() {
    let Some(mut window) = window(Theme::Light, None) else {
        return;
    };
    press(&mut window, "display …");
    press(&mut window, "heat map");
    looks_like(&mut window, "layers-light");
}

fn sheet(theme: Theme, menu: &str, item: &str, picture: &str) {
    let Some(mut window) = window(theme, None) else {
        return;
    };
    press(&mut window, menu);
    window.get_by_label(item).click();
    window.run_steps(6);
    looks_like(&mut window, picture);
}

#[test]
fn the_preferences_in_dark() {
    sheet(Theme::Dark, "Edit", "Preferences…", "preferences-dark");
}

#[test]
fn the_words_in_light() {
    sheet(Theme::Light, "Help", "Glossary", "words-light");
}

#[test]
fn the_import_in_light() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/sessions/paper-run.csv");
    let Some(mut window) = window(Theme::Light, Some(file.into())) else {
        return;
    };
    looks_like(&mut window, "import-light");
}

#[test]
fn the_compensation_of_a_program_in_light() {
    let data = |name: &str| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/programs/");
        PathBuf::from(format!("{folder}{name}"))
    };
    let Some(mut window) = window(Theme::Light, Some(data("arm.json"))) else {
        return;
    };
    press(&mut window, "2 Identify");
    press(&mut window, "Identify");
    window.state_mut().compensate(&data("cell.mod"));
    window.run_steps(4);
    looks_like(&mut window, "compensation-light");
}

/// Another chart below the workspace.
fn other_chart(theme: Theme, chart: &str, name: &str) {
    let Some(mut window) = window(theme, None) else {
        return;
    };
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    press(&mut window, "Hide results");
    press(&mut window, "Choose chart");
    for _ in 0..2 {
        let all = window.get_all_by_label(chart);
        all.last().expect("an entry of the list").scroll_to_me();
        window.run_steps(6);
    }
    let all = window.get_all_by_label(chart);
    all.last().expect("an entry of the list").click();
    window.run_steps(6);
    looks_like(&mut window, name);
}

#[test]
fn the_histogram_in_light() {
    other_chart(Theme::Light, "Histogram", "charts-light");
}

#[test]
fn the_order_spectrum_in_dark() {
    other_chart(Theme::Dark, "Order spectrum", "charts-dark");
}

/// An arm in three dimensions, identified.
fn an_arm_in_space(theme: Theme, name: &str) {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms/six-60.json");
    let Some(mut window) = window(theme, Some(file.into())) else {
        return;
    };
    press(&mut window, "2 Identify");
    press(&mut window, "Identify");
    looks_like(&mut window, name);
}

#[test]
fn an_arm_in_space_in_light() {
    an_arm_in_space(Theme::Light, "space-light");
}

#[test]
fn an_arm_in_space_in_dark() {
    an_arm_in_space(Theme::Dark, "space-dark");
}

#[test]
fn the_polar_view_in_light() {
    let Some(mut window) = window(Theme::Light, None) else {
        return;
    };
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    press(&mut window, "View");
    press(&mut window, "Polar view");
    looks_like(&mut window, "polar-light");
}

#[test]
fn the_workspace_is_saved_as_it_is_seen_without_the_sheet_that_asked_where() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms/six-60.json");
    for path in [None, Some(file.into())] {
        let Some(mut window) = window(Theme::Light, path) else {
            return;
        };
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("workspace.png");
        window.get_by_label("Save picture: workspace…");
        window.state_mut().type_path("workspace", &path);
        window.run_steps(4);
        press(&mut window, "Save");
        let written = std::fs::read(&path).expect("it was written");
        let reader = png::Decoder::new(std::io::Cursor::new(written)).read_info();
        let mut reader = reader.expect("it is a picture");
        let mut pixels = vec![0; reader.output_buffer_size().expect("its size")];
        let shown = reader.next_frame(&mut pixels).expect("its pixels");
        let plot = window.query_by_label_contains("workspace plot,");
        let plot = plot.unwrap_or_else(|| window.get_by_label_contains("3-D view,"));
        let wide = plot.rect().width() * PIXELS_PER_POINT;
        assert!(
            (wide..wide + 120.0).contains(&(shown.width as f32)),
            "{wide} {}",
            shown.width
        );
        // On a bright surface, as the window is, and not behind the veil of a sheet: vectors are seen in their colour.
        let white = pixels.chunks(4).filter(|p| p[..3].iter().all(|c| *c > 250));
        let share = white.count() as f32 / (pixels.len() / 4) as f32;
        assert!(share > 0.4, "{share}");
        let before = pixels.chunks(4).filter(|p| p[0] > 150 && p[2] < 100);
        assert!(before.count() > 50, "vectors");
    }
}
