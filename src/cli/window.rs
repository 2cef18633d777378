//! `truepose [FILE]`: the window.

use std::path::PathBuf;

use super::failure::Failure;

/// Opens the window, on a file or on the bundled session.
#[cfg(feature = "gui")]
pub(crate) fn open(file: Option<PathBuf>) -> Result<(), Failure> {
    Ok(crate::gui::run(file)?)
}

/// Says what there is instead.
#[cfg(not(feature = "gui"))]
pub(crate) fn open(_: Option<PathBuf>) -> Result<(), Failure> {
    let job = crate::sessions::files::bundled::job_in_the_terminal();
    let text = text!(
        "this build has no window; the main job in the terminal is: {job}",
        job
    );
    Err(Failure::Failed(anyhow::Error::msg(text)))
}
