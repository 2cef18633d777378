//! Sizes of errors: over samples, levels of correction, and the range of a robot.

pub use super::rms_error::Spread;
use super::rms_error::rms_error;
use crate::text::Template;

/// One level of correction and its errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// What the controller would have to take.
    pub what: Template,
    /// Combinations of coefficients that the samples determine.
    pub parameters: usize,
    /// Root mean square error in the fit, mm.
    pub rms_mm: f64,
    /// On samples that the fit has not seen; `None` with too few samples.
    pub cross_validated: Option<Errors>,
}

/// Lengths of deviations, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Mean.
    pub mean_mm: f64,
    /// Root mean square.
    pub rms_mm: f64,
    /// 95 of 100 are no longer.
    pub p95_mm: f64,
    /// Longest.
    pub max_mm: f64,
}

impl Errors {
    /// Of some lengths; `None` of none.
    pub fn of(mut lengths_mm: Vec<f64>) -> Option<Self> {
        lengths_mm.retain(|l| l.is_finite());
        lengths_mm.sort_by(f64::total_cmp);
        let n = lengths_mm.len();
        let max_mm = *lengths_mm.last()?;
        let count = n as f64;
        Some(Self {
            mean_mm: lengths_mm.iter().sum::<f64>() / count,
            rms_mm: rms_error(lengths_mm.iter().copied())?,
            p95_mm: lengths_mm[(n * 95).div_ceil(100).clamp(1, n) - 1],
            max_mm,
        })
    }
}

/// The error that a model is expected to make, from the uncertainty of its parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Expected {
    /// Root mean square over the joint ranges, mm.
    pub rms_mm: f64,
    /// The largest there, mm.
    pub max_mm: f64,
    /// Where it is largest, rad or mm.
    pub worst_q: Vec<f64>,
    /// Root mean square at the poses that were measured, mm.
    pub measured_rms_mm: f64,
}

impl Expected {
    /// Whether the samples show the measured poses much better than the joint ranges.
    pub fn extrapolates(&self) -> bool {
        self.rms_mm > POORLY * self.measured_rms_mm
    }
}

/// So many times the uncertainty at the measured poses is poor.
const POORLY: f64 = 3.0;

named! {
    /// Why a sample cannot take part at all.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum UnusableReason {
        /// A joint value or a coordinate is missing.
        MissingCell = phrase!("a joint value or a coordinate is missing"),
        /// The instrument lost the reflector: it wrote (0, 0, 0).
        LostReflector = phrase!("the instrument lost the reflector: it wrote 0, 0, 0"),
        /// It is held out, and refers to a place or a setup that no fitted sample determines.
        Unplaced = phrase!("nothing that is fitted was measured at its place or in its setup"),
        /// A person took it out.
        Excluded = phrase!("by hand"),
    }
    /// In words.
    pub fn describe -> Template;
}
