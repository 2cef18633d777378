//! Robots from the files of simulators and planners: URDF and MJCF.

use std::path::{Path, PathBuf};

use super::robot::Robot;
use super::xml::{Document, ROOT, read_included, read_text};
use super::{mjcf, urdf};
use crate::diagnostic::{Diagnostic, Place, Rejected};

/// Which of the two a file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DescriptionFormat {
    /// URDF, `<robot>`.
    Urdf,
    /// MJCF, `<mujoco>`.
    Mjcf,
}

/// A robot and what it was read from.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedRobot {
    /// The chain.
    pub robot: Robot,
    /// The file, and those that it includes.
    pub files: Vec<PathBuf>,
}

/// The chain from `base` to `tip` (links; bodies or sites in MJCF) of the file at `path`. Without a `format` the
/// file's outermost element determines it.
///
/// # Errors
/// A file that cannot be read, and all of [`robot_from_urdf`](super::robot_from_urdf) and
/// [`robot_from_mjcf`](super::robot_from_mjcf).
pub fn robot_from_file(
    path: &Path,
    format: Option<DescriptionFormat>,
    base: &str,
    tip: &str,
) -> Result<DescribedRobot, Rejected> {
    let text = read_text(path).map_err(|(found, expected)| {
        Rejected::because(Diagnostic::error(Place::file(path), found, expected))
    })?;
    let mut document = Document::parse(&text, path)?;
    let is_mjcf = document.name(ROOT) == "mujoco";
    let format = format.unwrap_or(if is_mjcf {
        DescriptionFormat::Mjcf
    } else {
        DescriptionFormat::Urdf
    });
    let tree = match format {
        DescriptionFormat::Urdf => urdf::tree(&document, path)?,
        DescriptionFormat::Mjcf => {
            let parent = path
                .parent()
                .filter(|folder| !folder.as_os_str().is_empty());
            let folder = parent.unwrap_or(Path::new("."));
            mjcf::tree(&mut document, path, &|name| read_included(folder, name))?
        }
    };
    Ok(DescribedRobot {
        robot: tree.robot(base, tip)?,
        files: document.files(),
    })
}
