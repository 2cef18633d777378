//! The window.
//!
//! Panels and plots are drawn from a `workbench::Workbench`; what the user does there is a change of its plain
//! state, made once the frame is drawn.
//!
//! Each folder uses only what stands beneath it (`scripts/arrows` counts, a test in
//! `tests/core/house.rs` holds it), from the top:
//!
//! - `app`: the shell: takes what was done in the background, lays out the views, makes the changes.
//! - `dialogs`: sheets over the window; `views`: what stands around the plots; `workspace`: the plot of
//!   the robot and its samples.
//! - `plots`, `widgets`: what views are made of; `layers`: what is drawn for each sample.
//! - `actions`: one table of what can be done: keys, menus, help.
//! - `workbench`: what there is, and what is done with it.
//! - `charts`: what is charted below the workspace, one file and one line of a register each.
//! - `files`, `file_state`: reading and writing; what outlives the window and what changes under it.
//! - `cache`: what is worked out once, in the background, so that no frame looks at all samples.
//! - `view`: how the document is looked at; `import_draft`: a file that an instrument wrote, before it is a
//!   session.
//! - `core`: the session and what follows from it, the document, its changes, undo: no view, nothing
//!   that is drawn.
//! - `preferences`, `help`, `style`: numbers, words, colours and type.
//! - `jobs`: work in the background, whatever it is about.

/// What is compared by what it is, not by what it holds: the same made twice is not the same.
macro_rules! only_itself {
    ($what:ty) => {
        impl PartialEq for $what {
            fn eq(&self, other: &Self) -> bool {
                std::ptr::eq(self, other)
            }
        }
    };
}

mod actions;
mod app;
mod cache;
mod charts;
/// What the window works on, without a view and without anything that is drawn.
mod core {
    pub(crate) mod answer;
    pub(crate) mod compensated;
    pub(crate) mod disk;
    pub(crate) mod document;
    pub(crate) mod history;
    pub(crate) mod loaded_session;
    pub(crate) mod overview;
    pub(crate) mod quantity;
    pub(crate) mod regions;
    pub(crate) mod robot_table;
    pub(crate) mod search;
    pub(crate) mod setup;
    pub(crate) mod simulate;
    pub(crate) mod skeleton;
}
mod dialogs;
mod file_state;
mod files;
mod help;
mod import_draft;
mod jobs;
mod layers;
mod plots;
mod style;
mod view;
/// What stands around the plots. Panels read the workbench and leave changes in it.
mod views {
    pub(crate) mod blocks;
    pub(super) mod chart;
    mod copies;
    mod export;
    mod gap;
    pub(super) mod menu;
    mod regions;
    pub(super) mod results;
    mod samples;
    pub(super) mod session;
    pub(super) mod status;
    pub(super) mod steps;
}
mod widgets;
mod workbench;
mod workspace;

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::anyhow;

use crate::sessions::files::bundled;

pub use crate::text::Language;
pub use app::App;
pub use jobs::Runner;
#[cfg(debug_assertions)]
pub use workbench::walk;

const TITLE: &str = "truepose";
/// What helps where the driver that was chosen does not draw.
const OTHERWISE: &str =
    "where the graphics driver is at fault, set WGPU_BACKEND to gl or vulkan, by which it may open";

/// Opens the window, on a session or a model if a path is given.
///
/// # Errors
/// There is no display, or nothing to draw with; the message names the terminal command that does
/// the main job.
pub fn run(path: Option<PathBuf>) -> anyhow::Result<()> {
    let job = match &path {
        None => bundled::job_in_the_terminal(),
        Some(model) if files::is_model(model) => {
            let model = model.display();
            format!(
                "what a model does on a session: truepose verify {model} SESSION; what a session says: truepose identify SESSION --json"
            )
        }
        Some(session) => bundled::identify(session),
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
            let app = app.speaking(Language::of_system());
            let app = app.on_day(file_state::today());
            Ok(Box::new(app.at_home(file_state::home())))
        }),
    )
    .map_err(|error| {
        let error = error.to_string();
        let because = without_source_place(&error);
        anyhow!("the window cannot be opened: {because}\n{OTHERWISE}\n{instead}")
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

/// An error without the place in a library's source code at which it came up.
fn without_source_place(error: &str) -> &str {
    let after_place = error.rsplit_once(".rs:").map(|(_, rest)| rest);
    let reason = after_place.and_then(|rest| rest.split_once(": "));
    reason.map_or(error, |(_, reason)| reason.trim_end_matches('.'))
}

#[cfg(test)]
#[test]
fn a_reason_comes_without_its_place_in_the_source() {
    let error = "winit EventLoopError: os error at src/linux/mod.rs:765: DISPLAY is not set.";
    assert_eq!(without_source_place(error), "DISPLAY is not set");
    assert_eq!(without_source_place("no adapter"), "no adapter");
}

/// The window's icon; none where it cannot be read, which is not worth a message.
fn icon() -> Arc<egui::IconData> {
    let png = include_bytes!("../../assets/icon.png");
    Arc::new(eframe::icon_data::from_png_bytes(png).unwrap_or_default())
}

/// What the window's own tests start from.
#[cfg(any(test, debug_assertions))]
#[path = "../../tests/support/lamp.rs"]
mod testing;
