//! From when on a difference is an error of setting up.

/// With fewer samples a set-up error cannot be told from an effect.
pub(super) const FEWEST_SAMPLES: usize = 6;

/// A gap below this share of the robot's size is no set-up error.
/// Derived: a set-up error moves the tool by more than a hundredth of the robot's size; effects
/// do not.
pub(super) const GROSS_SHARE: f64 = 0.01;

/// The gap has to fall to less than this.
pub(super) const MENDED_SHARE: f64 = 0.2;

/// No joint is calibrated with a zero offset larger than this; its home is a quarter turn off.
pub(super) const LARGEST_OFFSET_DEG: f64 = 45.0;
