//! Rounding errors by the origin of a number. Guards against a division by zero are `f64::EPSILON` and
//! `f64::MIN_POSITIVE`: no meaningful quantity comes near them.

/// The rounding of what was written is less, in mm, in rad and as a share: files have a tenth of a micrometre or
/// better, and six digits of a direction.
pub const WRITTEN: f64 = 1e-6;
/// The rounding of what was computed in double precision is less, as a share, in mm and in rad: after a million
/// operations with 16 digits (10⁶ ε ≈ 2·10⁻¹⁰).
pub const COMPUTED: f64 = 1e-9;
/// A step below this, in rad or as a share, changes nothing but the last bits of what is added up.
pub const LAST_BITS: f64 = 1e-13;
/// The step of a central difference: ∛ε, where its error (the square of the step) and rounding over the step are equal.
pub const DIFFERENCE: f64 = 1e-5;
