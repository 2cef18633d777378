//! Exponential and logarithm of unit quaternions, exact at every angle.
//!
//! ```text
//! exp(r) = (cos θ/2, n sin θ/2),   r = θ n a rotation vector in rad
//! log(q) = 2 atan2(|v|, w) · v/|v|,   q = (w, v)
//! ```
//!
//! The quotient sin(θ/2)/θ and its inverse are 0/0 at θ = 0 and are computed by their series there.
//! The arc tangent of two arguments keeps all digits at π, where an arc cosine of w loses half of
//! them. q and −q are the same rotation: both have the same logarithm.
//!
//! Source: Grassia, *Practical parameterization of rotations using the exponential map*, 1998.

use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};

/// Below this angle (rad) the quotients are computed by their series; the terms left out are
/// smaller than θ⁶/322560 < 1e-19.
pub const SMALL_RAD: f64 = 1e-2;

/// The rotation by |`rotation_rad`| about `rotation_rad`.
pub fn exp(rotation_rad: &Vector3<f64>) -> UnitQuaternion<f64> {
    let angle = rotation_rad.norm();
    let half = 0.5 * angle;
    let sine_over_angle = if angle < SMALL_RAD {
        let squared = angle * angle;
        0.5 - squared / 48.0 * (1.0 - squared / 80.0)
    } else {
        half.sin() / angle
    };
    let vector = rotation_rad * sine_over_angle;
    UnitQuaternion::new_unchecked(Quaternion::from_parts(half.cos(), vector))
}

/// The rotation vector of `rotation`, rad, of length 0…π.
///
/// At a half turn the vector and its opposite are the same rotation; the one whose first component
/// that is not zero is positive is returned.
pub fn log(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let vector = rotation.imag();
    let (w, vector) = if rotation.w < 0.0 || (rotation.w == 0.0 && is_negative(&vector)) {
        (-rotation.w, -vector)
    } else {
        (rotation.w, vector)
    };
    let sine = vector.norm();
    // θ / sin(θ/2) → 2 (1 + s²/6 + 3s⁴/40), the series of 2 asin(s)/s.
    let angle_over_sine = if 2.0 * sine < SMALL_RAD {
        let squared = sine * sine;
        2.0 + squared / 3.0 * (1.0 + squared * 9.0 / 20.0)
    } else {
        2.0 * sine.atan2(w) / sine
    };
    vector * angle_over_sine
}

/// The same of a rotation matrix. nalgebra's own takes the arc cosine of the trace: it loses half of the digits near no
/// rotation, and where rounding takes the trace beyond 3 it is no number.
pub fn log_of_matrix(rotation: &Rotation3<f64>) -> Vector3<f64> {
    log(&UnitQuaternion::from_rotation_matrix(rotation))
}

fn is_negative(vector: &Vector3<f64>) -> bool {
    vector
        .iter()
        .find(|part| **part != 0.0)
        .is_some_and(|part| *part < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn direction() -> impl Strategy<Value = Vector3<f64>> {
        prop::array::uniform3(-1.0..1.0)
            .prop_map(Vector3::from)
            .prop_filter("long enough to have a direction", |v| v.norm() > 0.1)
            .prop_map(|v| v.normalize())
    }

    /// Angles everywhere, and crowded at the ends where formulas break.
    fn angle() -> impl Strategy<Value = f64> {
        prop_oneof![
            0.0..PI,
            (-18.0..0.0).prop_map(|e: f64| 10.0_f64.powf(e)),
            (-15.0..0.0).prop_map(|e: f64| PI - 10.0_f64.powf(e)),
        ]
    }

    proptest! {
        #[test]
        fn log_undoes_exp_from_zero_to_a_half_turn(n in direction(), angle in angle()) {
            let rotation = n * angle;
            let back = log(&exp(&rotation));
            prop_assert!((back - rotation).norm() <= 4e-16 * (1.0 + angle), "{back} {rotation}");
            // Relative, too: a tiny rotation keeps all its digits.
            prop_assert!((back - rotation).norm() <= 1e-15 * angle.max(f64::MIN_POSITIVE));
        }

        #[test]
        fn both_covers_have_one_logarithm(n in direction(), angle in angle()) {
            let rotation = exp(&(n * angle));
            let other = UnitQuaternion::new_unchecked(-rotation.into_inner());
            prop_assert_eq!(log(&rotation), log(&other));
        }

        #[test]
        fn a_matrix_and_its_own_inverse_leave_a_number_and_small_turns_keep_their_digits(
            n in direction(), angle in angle(), small in -1e-9..1e-9,
        ) {
            let axis = nalgebra::Unit::new_unchecked(n);
            let matrix = Rotation3::from_axis_angle(&axis, angle);
            prop_assert!(log_of_matrix(&(matrix.inverse() * matrix)).norm() < 1e-15);
            let turn = Rotation3::from_axis_angle(&axis, small);
            prop_assert!((log_of_matrix(&turn) - n * small).norm() < 1e-15);
        }

        #[test]
        fn exp_is_a_unit_quaternion_and_agrees_with_the_rotation_matrix(
            n in direction(), angle in angle(),
        ) {
            let rotation = exp(&(n * angle));
            prop_assert!((rotation.norm() - 1.0).abs() < 4e-16);
            let axis = nalgebra::Unit::new_unchecked(n);
            let matrix = nalgebra::Rotation3::from_axis_angle(&axis, angle);
            let difference = rotation.to_rotation_matrix().matrix() - matrix.matrix();
            prop_assert!(difference.norm() < 2e-15);
        }
    }

    #[test]
    fn at_exactly_a_half_turn_the_sign_is_settled() {
        let quaternion = Quaternion::new(0.0, 0.0, -1.0, 0.0);
        let turned = log(&UnitQuaternion::new_unchecked(quaternion));
        assert_eq!(turned, Vector3::new(0.0, PI, 0.0));
    }

    #[test]
    fn no_rotation_has_the_zero_vector_even_as_minus_one() {
        let minus_one = UnitQuaternion::new_unchecked(Quaternion::new(-1.0, 0.0, 0.0, 0.0));
        assert_eq!(log(&minus_one), Vector3::zeros());
        assert_eq!(exp(&Vector3::zeros()), UnitQuaternion::identity());
    }
}
