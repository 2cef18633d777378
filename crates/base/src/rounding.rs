//! What is rounding and no difference, by where a number comes from. Guards against a division by nothing are
//! `f64::EPSILON` and `f64::MIN_POSITIVE`: no quantity that means anything comes near them.

/// What was written is off by less, in mm, in rad and as a share: files carry a tenth of a micrometre or better, and
/// six digits of a direction.
pub const WRITTEN: f64 = 1e-6;
/// What was computed in double precision is off by less, as a share, in mm and in rad: what a million operations leave of
/// its 16 digits (10⁶ ε ≈ 2·10⁻¹⁰).
pub const COMPUTED: f64 = 1e-9;
/// A step below this, in rad or as a share, changes nothing but the last bits of what is added up.
pub const LAST_BITS: f64 = 1e-13;
/// The step of a central difference: ∛ε, where its error (the square of the step) and rounding over the step are equal.
pub const DIFFERENCE: f64 = 1e-5;
