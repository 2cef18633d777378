//! Writing the picture of a plot, whole or not at all.

use std::path::{Path, PathBuf};

use crate::gui::jobs::Watch;
use crate::gui::view::Message;
use crate::present::drawing::Drawing;
use crate::report::svg::svg_file;

use super::{can_be_written, ending, not_written, saved, write_one};

/// Draws it, and writes it where none of `inputs` stands.
pub(crate) fn write_picture(
    draw: impl FnOnce() -> Result<(Drawing, String), String>,
    path: &Path,
    replace: bool,
    inputs: &[PathBuf],
    watch: &Watch,
) -> Message {
    let make = || {
        if ending(path).as_deref() != Some("svg") {
            return Err(say!("file-expected-a-file-name").to_owned());
        }
        can_be_written(path, replace, inputs)?;
        let (drawing, title) = draw()?;
        write_one(path, replace, svg_file(&drawing, &title).as_bytes(), watch)
    };
    match make() {
        Ok(()) => saved(path, Vec::new()),
        Err(problem) => not_written(path, problem),
    }
}
