//! Orientations as the makers of controllers write them.
//!
//! ```text
//! ABB       quaternion q1 q2 q3 q4 = w x y z
//! KUKA      A B C     R = Rz(A) Ry(B) Rx(C)          degrees
//! FANUC     W P R     R = Rz(R) Ry(P) Rx(W)          degrees
//! Stäubli   Rx Ry Rz  R = Rx(Rx) Ry(Ry) Rz(Rz)       degrees
//! UR        rotation vector: axis times angle        radians
//! ```
//!
//! Where an angle is at its pole (±90° in the middle) only the sum or difference of the outer two is
//! fixed; either way the orientation is the same to the last digits.

use nalgebra::{Matrix3, Vector3};

use crate::document::{Value, object};
use crate::kinematics::{Pose, quaternion};

/// Decimals that are written: 10⁻¹⁵ m or rad. What stands behind them is rounding.
const PER_UNIT: f64 = 1e15;
/// The same of mm.
const PER_MM: f64 = 1e12;

/// A number without the digits that are rounding; never −0.
pub(super) fn tidy(value: f64) -> f64 {
    (value * PER_UNIT).round() / PER_UNIT + 0.0
}

/// Three numbers with spaces between, without the digits that are rounding.
pub(super) fn three(v: &Vector3<f64>) -> String {
    let [x, y, z] = [v.x, v.y, v.z].map(tidy);
    // Rust writes a number with the fewest digits that read back as the same one.
    format!("{x} {y} {z}")
}

/// Roll, pitch and yaw of R = Rz(y) Ry(p) Rx(r). Roll is taken from what is left when yaw is undone,
/// so that near a pitch of ±90°, where either alone is uncertain, both together are not.
pub(super) fn rpy(r: &Matrix3<f64>) -> Vector3<f64> {
    let pitch = (-r[(2, 0)]).atan2(r[(0, 0)].hypot(r[(1, 0)]));
    let yaw = r[(1, 0)].atan2(r[(0, 0)]);
    let (sin, cos) = yaw.sin_cos();
    let roll = (sin * r[(0, 2)] - cos * r[(1, 2)]).atan2(cos * r[(1, 1)] - sin * r[(0, 1)]);
    Vector3::new(roll, pitch, yaw)
}

/// A frame in every maker's terms.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Frame {
    pub(super) position_mm: [f64; 3],
    pub(super) quaternion_wxyz: [f64; 4],
    pub(super) kuka_abc_deg: [f64; 3],
    pub(super) fanuc_wpr_deg: [f64; 3],
    pub(super) staubli_rx_ry_rz_deg: [f64; 3],
    pub(super) ur_rotation_vector_rad: [f64; 3],
}

impl Frame {
    pub(super) fn of(pose: &Pose) -> Self {
        let matrix = pose.rotation.to_rotation_matrix();
        let turns = rpy(matrix.matrix()).map(f64::to_degrees);
        // Rx Ry Rz of R are −roll, −pitch, −yaw of its inverse.
        let inverse = rpy(&matrix.matrix().transpose()).map(|turn| -turn.to_degrees());
        let (q, p) = (pose.rotation.quaternion(), pose.translation.vector);
        Self {
            position_mm: [p.x, p.y, p.z].map(|mm| (mm * PER_MM).round() / PER_MM + 0.0),
            quaternion_wxyz: [q.w, q.i, q.j, q.k].map(tidy),
            kuka_abc_deg: [turns.z, turns.y, turns.x].map(tidy),
            fanuc_wpr_deg: [turns.x, turns.y, turns.z].map(tidy),
            staubli_rx_ry_rz_deg: [inverse.x, inverse.y, inverse.z].map(tidy),
            ur_rotation_vector_rad: <[f64; 3]>::from(quaternion::log(&pose.rotation)).map(tidy),
        }
    }

    /// As JSON.
    pub(super) fn document(&self) -> Value {
        object! {
            "position_mm": self.position_mm,
            "quaternion_wxyz": self.quaternion_wxyz,
            "kuka_abc_deg": self.kuka_abc_deg,
            "fanuc_wpr_deg": self.fanuc_wpr_deg,
            "staubli_rx_ry_rz_deg": self.staubli_rx_ry_rz_deg,
            "ur_rotation_vector_rad": self.ur_rotation_vector_rad,
        }
    }

    /// Each convention with its numbers and their unit.
    pub(super) fn rows(&self) -> [(&'static str, Vec<f64>, &'static str); 5] {
        [
            (
                "ABB quaternion q1 q2 q3 q4",
                self.quaternion_wxyz.to_vec(),
                "",
            ),
            ("KUKA A B C", self.kuka_abc_deg.to_vec(), "deg"),
            ("FANUC W P R", self.fanuc_wpr_deg.to_vec(), "deg"),
            (
                "Stäubli Rx Ry Rz",
                self.staubli_rx_ry_rz_deg.to_vec(),
                "deg",
            ),
            (
                "UR rotation vector",
                self.ur_rotation_vector_rad.to_vec(),
                "rad",
            ),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, UnitQuaternion};
    use proptest::prelude::*;

    fn near_the_pole() -> impl Strategy<Value = UnitQuaternion<f64>> {
        let axis = prop::array::uniform3(-1.0..1.0f64);
        (axis, -3.0..3.0f64, -18.0..0.0f64, prop::bool::ANY).prop_map(
            |(axis, angle, exponent, pole)| {
                let half_pi = std::f64::consts::FRAC_PI_2;
                let near = UnitQuaternion::from_euler_angles(0.3, half_pi, -1.1);
                let by = if pole { 10f64.powf(exponent) } else { 1.0 };
                let axis = Vector3::from(axis) + Vector3::new(1e-6, 0.0, 0.0);
                UnitQuaternion::from_scaled_axis(axis.normalize() * angle * by) * near
            },
        )
    }

    proptest! {
        #[test]
        fn roll_pitch_yaw_give_the_rotation_back_even_at_the_pole(turn in near_the_pole()) {
            let matrix = turn.to_rotation_matrix();
            let v = rpy(matrix.matrix());
            let back = Rotation3::from_euler_angles(v.x, v.y, v.z);
            let off = (back.matrix() - matrix.matrix()).amax();
            prop_assert!(off < 1e-14, "{off}");
        }

        #[test]
        fn every_makers_numbers_give_the_rotation_back(turn in near_the_pole()) {
            let about = |axis: usize, deg: f64| {
                let axis = nalgebra::Unit::new_unchecked(Vector3::ith(axis, 1.0));
                UnitQuaternion::from_axis_angle(&axis, deg.to_radians())
            };
            let frame = Frame::of(&Pose::from_parts(Vector3::zeros().into(), turn));
            let [a, b, c] = frame.kuka_abc_deg;
            let [w, p, r] = frame.fanuc_wpr_deg;
            let [x, y, z] = frame.staubli_rx_ry_rz_deg;
            let vector = Vector3::from(frame.ur_rotation_vector_rad);
            for back in [
                about(2, a) * about(1, b) * about(0, c),
                about(2, r) * about(1, p) * about(0, w),
                about(0, x) * about(1, y) * about(2, z),
                UnitQuaternion::from_scaled_axis(vector),
            ] {
                prop_assert!(back.angle_to(&turn) < 1e-7);
            }
        }
    }
}
