//! A value of a joint as a person types it.

use crate::kinematics::JointKind;

/// Rounded to what a technician types: a tenth of a degree or of a millimetre.
pub(crate) fn typed(value: f64, kind: JointKind) -> f64 {
    let step = kind.to_base_units(0.1);
    (value / step).round() * step
}
