//! Poses that decide.

use super::aliases::Rival;
use super::arena::Fit;
use super::prepare::Prepared;

/// A pose to measure and its conditions.
#[derive(Debug, Clone, PartialEq)]
pub struct NextPose {
    /// Joint values, rad or mm.
    pub q: Vec<f64>,
    /// Side from which each joint comes.
    pub dir: Vec<f64>,
    /// Name of a reflector of the session, or of a new one.
    pub target: Option<String>,
    /// Where a new reflector goes, tool frame, mm.
    pub target_mm: Option<[f64; 3]>,
    /// Signed speeds, rad/s or mm/s.
    pub speed: Option<Vec<f64>>,
    /// Load, kg.
    pub load_kg: Option<f64>,
    /// Temperature, °C.
    pub temperature_c: Option<f64>,
    /// Why.
    pub why: String,
}

pub(super) fn separate(_: &Prepared, _: &Fit, _: &[&Rival]) -> Vec<NextPose> {
    Vec::new()
}

pub(super) fn separate_by(_: &Rival, _: &[NextPose]) -> String {
    String::new()
}
