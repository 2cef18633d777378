//! What outlives the window, and what changes under it.
//!
//! - `settings`: preferences, recent files and whose meshes are drawn, in one small file of the data folder;
//! - `machines`: what the reports of machines state;
//! - `recording`: writes what an instrument sends;
//! - `recovery`: what is not saved, kept against a crash;
//! - `watcher`: looks at open files from time to time, and reads a file that grows.

pub(crate) mod machines;
pub(crate) mod recording;
pub(crate) mod recovery;
pub(crate) mod settings;
pub(crate) mod watcher;

use std::path::PathBuf;

/// The folder where this user's programs keep their data, and this program's in it; `None` where
/// the system names none.
pub(crate) fn home() -> Option<PathBuf> {
    eframe::storage_dir("truepose")
}
