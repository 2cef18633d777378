//! The window.
//!
//! Data goes one way: panels and plots read the [`Workbench`](commands::Workbench) and send
//! [`Command`](commands::Command)s; the workbench is the one place that changes anything.
//!
//! - [`app`]: the shell: takes what the tasks brought, lays out the panels, executes commands.
//! - [`document`]: what can be undone, as one value ([`edit`] changes it, [`undo`] keeps it);
//!   [`view`]: how it is looked at.
//! - [`subject`]: a session with what follows from it alone; [`outcome`]: an identification made
//!   ready for drawing.
//! - [`preview`]: an export as it would be written.
//! - [`tasks`]: work in the background; [`files`]: what it reads and writes.
//! - [`tokens`]: colour, spacing and type; [`widgets`]: the few controls that egui does not have.
//! - [`panels`]: what stands around the plots; [`plots`]: each in model, layout and paint.

mod app;
mod boundaries;
mod commands;
mod document;
mod edit;
mod files;
mod outcome;
mod panels;
mod plots;
mod preview;
mod simulate;
mod subject;
mod tasks;
#[cfg(test)]
mod testing;
mod tokens;
mod undo;
mod units;
mod view;
mod widgets;

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::anyhow;

pub use app::App;
pub use tasks::Runner;

const TITLE: &str = "truepose";

/// Opens the window, on a session or a model if a path is given.
///
/// # Errors
/// There is no display, or nothing to draw with; the message names the terminal command that does
/// the main job.
pub fn run(path: Option<PathBuf>) -> anyhow::Result<()> {
    let session = path
        .as_ref()
        .map_or_else(|| "SESSION".to_owned(), |p| p.display().to_string());
    let viewport = egui::ViewportBuilder::default()
        .with_title(TITLE)
        .with_app_id("truepose")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([960.0, 600.0])
        .with_icon(icon())
        .with_drag_and_drop(true);
    let options = eframe::NativeOptions {
        viewport,
        ..eframe::NativeOptions::default()
    };
    eframe::run_native(
        TITLE,
        options,
        Box::new(move |cc| Ok(Box::new(App::new(&cc.egui_ctx, path, Runner::Threads)))),
    )
    .map_err(|error| {
        anyhow!(
            "the window cannot be opened: {error}\nwithout a display, use the terminal: \
             truepose identify {session} --json"
        )
    })
}

/// The window's icon; none where it cannot be read, which is not worth a message.
fn icon() -> Arc<egui::IconData> {
    let png = include_bytes!("../../assets/icon.png");
    Arc::new(eframe::icon_data::from_png_bytes(png).unwrap_or_default())
}
