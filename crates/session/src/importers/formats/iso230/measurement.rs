//! One measurement of an axis at a target.

/// One measurement, in the order of the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measurement {
    pub(super) run: u64,
    /// Side from which the target was approached: +1, −1, 0 unknown.
    pub(super) dir: f64,
    pub(super) target: f64,
    /// Position, or deviation from the target.
    pub(super) measured: f64,
    pub(super) line: u64,
}
