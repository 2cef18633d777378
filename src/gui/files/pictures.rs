//! Writing the picture of a plot, whole or not at all.

use std::path::{Path, PathBuf};

use crate::fonts::Library;
use crate::gui::jobs::Watch;
use crate::gui::view::Message;
use crate::present::drawing::Drawing;
use crate::report::raster::png_file;
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
        let ending = ending(path);
        let as_pixels = match ending.as_deref() {
            Some("svg") => false,
            Some("png") => true,
            _ => return Err(say!("expected a file name that ends in .svg or .png").to_owned()),
        };
        can_be_written(path, replace, inputs)?;
        let (drawing, title) = draw()?;
        let bytes = if as_pixels {
            png_file(&drawing, &Library::system()).map_err(|e| e.to_string())?
        } else {
            svg_file(&drawing, &title).into_bytes()
        };
        write_one(path, replace, &bytes, watch)
    };
    match make() {
        Ok(()) => saved(path, Vec::new()),
        Err(problem) => not_written(path, problem),
    }
}
