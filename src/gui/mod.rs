//! The window.
//!
//! Data goes one way: panels and plots read the `commands::Workbench` and send
//! `commands::Command`s; the workbench is the one place that changes anything.
//!
//! - `app`: the shell: takes what the tasks brought, lays out the panels, executes commands.
//! - `document`: what can be undone, as one value (`edit` changes it, `undo` keeps it);
//!   `view`: how it is looked at.
//! - `subject`: a session with what follows from it alone; `outcome`: an identification made
//!   ready for drawing; `given`: a model that was read from a file instead.
//! - `boundaries`: regions as they are dragged, `placing` as they are typed, `angles`: how many samples
//!   each has; `division`: how they came about.
//! - `known`: what its samples cover, before anything is identified.
//! - `overview`: what every frame needs of a session, so that no frame looks at all samples;
//!   `backdrop`: what plots of many samples stand on; `layers`: what is drawn for each sample.
//! - `tally`: what regions hold, for any boundaries; `thinning`: which samples are drawn where not
//!   all can be.
//! - `search`: what a diagnosis found, ready to be added.
//! - `setup`: robot and instrument as they are filled in.
//! - `preferences`: units, digits, colours; `help`: what the words mean.
//! - `keeping`: what outlives the window (recent files, what is not saved), and what changes under it.
//! - `preview`: an export as it would be written; `reporting`, `pictures`: a report, a plot as a file;
//!   `figures`: the standards' figures.
//! - `foreign`: a file that an instrument wrote, before it is a session.
//! - `tasks`: work in the background; `files`: what it reads and writes.
//! - `letters`: fonts of the machine for what the bundled ones lack.
//! - `room`: how the window is divided at its size.
//! - `tokens`: colour, spacing and type; `widgets`: the few controls that egui does not have;
//!   `vision` (tests): how people see the colours.
//! - `panels`: what stands around the plots; `plots`: each in model, layout and paint.

mod actions;
mod app;
mod cache;
mod core;
mod dialogs;
mod files;
mod foreign;
mod help;
mod jobs;
mod keeping;
mod layers;
mod plots;
mod preferences;
mod style;
#[cfg(test)]
mod testing;
mod units;
mod view;
mod views;
mod widgets;
mod workbench;
mod workspace;

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::anyhow;

pub use app::App;
pub use jobs::Runner;

const TITLE: &str = "truepose";

/// Opens the window, on a session or a model if a path is given.
///
/// # Errors
/// There is no display, or nothing to draw with; the message names the terminal command that does
/// the main job.
pub fn run(path: Option<PathBuf>) -> anyhow::Result<()> {
    let session = path.as_ref().map_or_else(
        || "sessions/lamp-commissioning.json".to_owned(),
        |p| p.display().to_string(),
    );
    let job = if path.as_ref().is_some_and(|p| files::is_model(p)) {
        format!(
            "what a model does on a session: truepose verify {session} SESSION; what a session says: truepose identify SESSION --json"
        )
    } else {
        format!("truepose identify {session} --json")
    };
    let instead = format!("in the terminal the same job is done by: {job}");
    if !has_display() {
        return Err(anyhow!("there is no display for the window\n{instead}"));
    }
    let viewport = egui::ViewportBuilder::default()
        .with_title(TITLE)
        .with_app_id("truepose")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([1024.0, 700.0])
        .with_icon(icon())
        .with_drag_and_drop(true);
    let options = eframe::NativeOptions {
        viewport,
        ..eframe::NativeOptions::default()
    };
    eframe::run_native(
        TITLE,
        options,
        Box::new(move |cc| {
            let app = App::new(&cc.egui_ctx, path, Runner::Threads);
            let app = app.drawn_by(cc.wgpu_render_state.as_ref());
            Ok(Box::new(app.at_home(keeping::home())))
        }),
    )
    .map_err(|error| {
        let error = error.to_string();
        let because = plainly(&error);
        anyhow!("the window cannot be opened: {because}\n{instead}")
    })
}

/// Whether there may be something to open a window on. Only Linux tells beforehand.
fn has_display() -> bool {
    let named = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux")
        || ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"]
            .map(named)
            .contains(&true)
}

/// An error without the place in somebody's source code at which it came up.
fn plainly(error: &str) -> &str {
    let after_place = error.rsplit_once(".rs:").map(|(_, rest)| rest);
    let reason = after_place.and_then(|rest| rest.split_once(": "));
    reason.map_or(error, |(_, reason)| reason.trim_end_matches('.'))
}

#[cfg(test)]
#[test]
fn a_reason_comes_without_its_place_in_the_source() {
    let error = "winit EventLoopError: os error at src/linux/mod.rs:765: DISPLAY is not set.";
    assert_eq!(plainly(error), "DISPLAY is not set");
    assert_eq!(plainly("no adapter"), "no adapter");
}

/// The window's icon; none where it cannot be read, which is not worth a message.
fn icon() -> Arc<egui::IconData> {
    let png = include_bytes!("../../assets/icon.png");
    Arc::new(eframe::icon_data::from_png_bytes(png).unwrap_or_default())
}
