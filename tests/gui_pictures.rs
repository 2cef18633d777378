//! Three small pictures of the window, so that nobody changes its look without seeing it. They need
//! something to draw with; without an adapter they say so and pass, and the rest of the window's
//! tests does without.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test gui_pictures` renews them.
#![cfg(feature = "gui")]

use egui::Theme;
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, SnapshotOptions};
use truepose::gui::{App, Runner};

/// Whether there is an adapter; `.wgpu()` panics where there is none.
fn can_draw() -> bool {
    let instance = egui_wgpu::wgpu::Instance::default();
    let adapters = instance.enumerate_adapters(egui_wgpu::wgpu::Backends::all());
    let found = !pollster::block_on(adapters).is_empty();
    let in_ci = std::env::var("CI").is_ok_and(|ci| ci == "true");
    assert!(found || !in_ci, "CI has to have an adapter to draw with");
    found
}

/// Software renderers round a few pixels in ten thousand differently.
fn alike() -> SnapshotOptions {
    SnapshotOptions::new().max_failed_pixels(250)
}

fn window(theme: Theme) -> Option<Harness<'static, App>> {
    if !can_draw() {
        eprintln!("skipped: no adapter to draw with");
        return None;
    }
    let window = Harness::builder()
        .with_size([1120.0, 700.0])
        .with_theme(theme)
        .wgpu()
        .build_eframe(|cc| {
            let app = App::new(&cc.egui_ctx, None, Runner::AtOnce);
            app.drawn_by(cc.wgpu_render_state.as_ref())
        });
    Some(window)
}

#[test]
fn the_identified_session_in_light() {
    let Some(mut window) = window(Theme::Light) else {
        return;
    };
    window.run_steps(3);
    window.get_by_label("3 Identify").click();
    window.run_steps(3);
    window.get_by_label("Identify").click();
    window.run_steps(3);
    window.remove_cursor();
    window.run_steps(3);
    window.snapshot_options("identified-light", &alike());
}

#[test]
fn the_regions_in_dark() {
    let Some(mut window) = window(Theme::Dark) else {
        return;
    };
    window.run_steps(3);
    window.get_by_label("2 Regions").click();
    window.run_steps(3);
    window.remove_cursor();
    window.run_steps(3);
    window.snapshot_options("regions-dark", &alike());
}

#[test]
fn the_heat_map_and_the_load_in_light() {
    let Some(mut window) = window(Theme::Light) else {
        return;
    };
    window.run_steps(3);
    window.get_by_label("heat map").click();
    window.run_steps(3);
    window.get_by_label("Colour of vectors").click();
    window.run_steps(3);
    window.get_by_label("load").click();
    window.run_steps(3);
    window.remove_cursor();
    window.run_steps(3);
    window.snapshot_options("layers-light", &alike());
}
