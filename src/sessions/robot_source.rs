//! Robots that are given as Denavit–Hartenberg rows or as a URDF file.
//!
//! Both become the one description that the program computes with: screws at the home pose.

use std::path::Path;

use crate::kinematics::{Joint, Pose};

/// A chain from somewhere else: its joints, and the tool at home.
pub(crate) type Chain = (Vec<Joint>, Pose);

/// One row of Denavit–Hartenberg parameters in inner units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DhRow {
    pub(crate) a_mm: f64,
    pub(crate) alpha_rad: f64,
    pub(crate) d_mm: f64,
    pub(crate) theta_rad: f64,
    pub(crate) modified: bool,
}

/// The chain of a list of rows, all joints revolute.
pub(crate) fn from_dh(rows: &[DhRow]) -> Result<Chain, String> {
    let _ = rows;
    Err("Denavit–Hartenberg rows are not understood yet".to_owned())
}

/// The chain between two links of a URDF file.
pub(crate) fn from_urdf(path: &Path, text: &str, base: &str, tip: &str) -> Result<Chain, String> {
    let _ = (path, text, base, tip);
    Err("URDF files are not understood yet".to_owned())
}
