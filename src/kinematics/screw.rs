//! Twists and screw motions: exponential, logarithm and adjoint of SE(3).
//!
//! ```text
//! exp(ω, v) = (exp ω,  V(ω) v),   V = I + (1−cos θ)/θ² [ω] + (θ−sin θ)/θ³ [ω]²,   θ = |ω|
//! V⁻¹ = I − ½[ω] + (1 − (θ/2) cot(θ/2))/θ² [ω]²
//! Ad(R, p)(ω, v) = (R ω,  R v + p × R ω)
//! ```
//!
//! A twist is written angular part first. In the base frame its linear part is the velocity of the
//! body's point that passes the base origin: a revolute axis along n through a has v = a × n.
//!
//! Source: Lynch & Park, *Modern Robotics*, 2017, sections 3.3.2 and 3.3.3.

use nalgebra::{Point3, Translation3, Vector3, Vector6};

use super::quaternion;
use super::robot::{Axis, JointKind, Pose};

/// Below this angle (rad) the coefficients are computed by their series; the terms left out are
/// smaller than θ⁶/1e6 of the leading one, which is below rounding.
const SMALL_RAD: f64 = 1e-2;

/// A small or finite motion of a body, or its rate: (ω, v) in rad and mm, per unit of what causes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Rotation, rad.
    pub angular: Vector3<f64>,
    /// Translation of the body's point at the origin of the frame, mm.
    pub linear: Vector3<f64>,
}

impl Twist {
    /// A twist from its two parts.
    pub fn new(angular: Vector3<f64>, linear: Vector3<f64>) -> Self {
        Self { angular, linear }
    }

    /// No motion.
    pub fn zero() -> Self {
        Self::new(Vector3::zeros(), Vector3::zeros())
    }

    /// The six components (ω, v).
    pub fn to_vector(&self) -> Vector6<f64> {
        let (w, v) = (&self.angular, &self.linear);
        Vector6::new(w.x, w.y, w.z, v.x, v.y, v.z)
    }

    /// The twist of a joint per unit of its value.
    pub fn of_axis(axis: &Axis, kind: JointKind) -> Self {
        let direction = axis.direction.into_inner();
        match kind {
            JointKind::Revolute => Self::new(direction, axis.point_mm.coords.cross(&direction)),
            JointKind::Prismatic => Self::new(Vector3::zeros(), direction),
        }
    }

    /// The velocity of the body's point that is now at `point_mm`.
    pub fn velocity_at(&self, point_mm: &Point3<f64>) -> Vector3<f64> {
        self.linear + self.angular.cross(&point_mm.coords)
    }

    /// The same twist seen from the frame that `motion` leads to: Ad(motion) ξ.
    #[must_use]
    pub fn transformed_by(&self, motion: &Pose) -> Self {
        let angular = motion.rotation * self.angular;
        let linear = motion.rotation * self.linear + motion.translation.vector.cross(&angular);
        Self::new(angular, linear)
    }
}

/// The finite motion that `twist` makes in unit time.
pub fn exp(twist: &Twist) -> Pose {
    let w = &twist.angular;
    let v = &twist.linear;
    let squared = w.norm_squared();
    let angle = squared.sqrt();
    let (a, b) = if angle < SMALL_RAD {
        (
            0.5 - squared / 24.0 * (1.0 - squared / 30.0),
            (1.0 - squared / 20.0 * (1.0 - squared / 42.0)) / 6.0,
        )
    } else {
        let half_sine = (0.5 * angle).sin();
        (
            2.0 * half_sine * half_sine / squared,
            (angle - angle.sin()) / (squared * angle),
        )
    };
    let turned = w.cross(v);
    let translation = v + turned * a + w.cross(&turned) * b;
    Pose::from_parts(Translation3::from(translation), quaternion::exp(w))
}

/// The twist whose exponential is `motion`, with a rotation of at most a half turn.
pub fn log(motion: &Pose) -> Twist {
    let angular = quaternion::log(&motion.rotation);
    let p = &motion.translation.vector;
    let squared = angular.norm_squared();
    let angle = squared.sqrt();
    let c = if angle < SMALL_RAD {
        (1.0 + squared / 60.0 * (1.0 + squared / 42.0)) / 12.0
    } else {
        // tan(π/2) is large but finite in f64, so the quotient goes to zero as it should.
        (1.0 - 0.5 * angle / (0.5 * angle).tan()) / squared
    };
    let turned = angular.cross(p);
    Twist::new(angular, p - turned * 0.5 + angular.cross(&turned) * c)
}

/// The motion of a joint from home to `value` (rad or mm): `exp([ξ] value)`, without the detour over ξ.
pub fn joint_motion(axis: &Axis, kind: JointKind, value: f64) -> Pose {
    match kind {
        JointKind::Revolute => {
            let rotation = quaternion::exp(&(axis.direction.into_inner() * value));
            let point = axis.point_mm.coords;
            Pose::from_parts(Translation3::from(point - rotation * point), rotation)
        }
        JointKind::Prismatic => Pose::from(axis.direction.into_inner() * value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
        prop::array::uniform3(-size..size).prop_map(Vector3::from)
    }

    /// Rotations of all sizes up to just below a half turn, and none.
    fn angular() -> impl Strategy<Value = Vector3<f64>> {
        let length = prop_oneof![
            Just(0.0),
            0.0..PI,
            (-18.0..0.0).prop_map(|e: f64| 10.0_f64.powf(e)),
            (-14.0..0.0).prop_map(|e: f64| PI - 10.0_f64.powf(e)),
        ];
        let direction = vector(1.0).prop_filter("a direction", |v| v.norm() > 0.1);
        (direction, length).prop_map(|(d, l)| d.normalize() * l)
    }

    fn twist() -> impl Strategy<Value = Twist> {
        (angular(), vector(1000.0)).prop_map(|(w, v)| Twist::new(w, v))
    }

    fn distance(a: &Pose, b: &Pose) -> f64 {
        (a.to_homogeneous() - b.to_homogeneous()).norm()
    }

    proptest! {
        #[test]
        fn log_undoes_exp(twist in twist()) {
            let back = log(&exp(&twist));
            prop_assert!((back.angular - twist.angular).norm() < 2e-15);
            prop_assert!((back.linear - twist.linear).norm() < 5e-12, "{back:?} {twist:?}");
        }

        #[test]
        fn exp_undoes_log(twist in twist()) {
            let motion = exp(&twist);
            prop_assert!(distance(&exp(&log(&motion)), &motion) < 5e-12);
        }

        #[test]
        fn motions_about_one_screw_add_up(twist in twist(), s in -2.0..2.0_f64, t in -2.0..2.0_f64) {
            let scaled = |by: f64| exp(&Twist::new(twist.angular * by, twist.linear * by));
            prop_assert!(distance(&(scaled(s) * scaled(t)), &scaled(s + t)) < 2e-11);
        }

        #[test]
        fn composition_is_associative_and_has_inverses(a in twist(), b in twist(), c in twist()) {
            let (a, b, c) = (exp(&a), exp(&b), exp(&c));
            prop_assert!(distance(&((a * b) * c), &(a * (b * c))) < 1e-11);
            prop_assert!(distance(&(a * a.inverse()), &Pose::identity()) < 1e-11);
        }

        #[test]
        fn the_adjoint_is_a_homomorphism_and_moves_twists(a in twist(), b in twist(), x in twist()) {
            let (a, b) = (exp(&a), exp(&b));
            let product = x.transformed_by(&(a * b)).to_vector();
            let one_by_one = x.transformed_by(&b).transformed_by(&a).to_vector();
            prop_assert!((product - one_by_one).norm() < 1e-8);
            // exp(Ad(a) x) = a exp(x) a⁻¹
            let conjugated = a * exp(&x) * a.inverse();
            prop_assert!(distance(&exp(&x.transformed_by(&a)), &conjugated) < 2e-9);
        }

        #[test]
        fn a_joint_moves_as_the_exponential_of_its_screw(
            direction in vector(1.0).prop_filter("a direction", |v| v.norm() > 0.1),
            point in vector(1000.0), value in -7.0..7.0_f64,
        ) {
            let axis = Axis::through(direction, Point3::from(point)).unwrap();
            for kind in [JointKind::Revolute, JointKind::Prismatic] {
                let twist = Twist::of_axis(&axis, kind);
                let scaled = Twist::new(twist.angular * value, twist.linear * value);
                let motion = joint_motion(&axis, kind, value);
                prop_assert!(distance(&exp(&scaled), &motion) < 1e-11);
            }
        }
    }

    #[test]
    fn the_series_meet_the_closed_forms_at_the_border() {
        let v = Vector3::new(100.0, -20.0, 7.0);
        let n = Vector3::new(0.36, 0.48, 0.8);
        let below = exp(&Twist::new(n * (SMALL_RAD * (1.0 - 1e-13)), v));
        let above = exp(&Twist::new(n * (SMALL_RAD * (1.0 + 1e-13)), v));
        assert!(distance(&below, &above) < 1e-12);
        assert!((log(&below).linear - log(&above).linear).norm() < 1e-12);
    }

    #[test]
    fn a_point_on_a_revolute_axis_stands_still() {
        let point = Point3::new(120.0, -40.0, 9.0);
        let axis = Axis::through(Vector3::new(1.0, 2.0, -2.0), point).unwrap();
        let twist = Twist::of_axis(&axis, JointKind::Revolute);
        assert!(twist.velocity_at(&point).norm() < 1e-13);
        assert!((joint_motion(&axis, JointKind::Revolute, 2.0) * point - point).norm() < 1e-12);
    }
}
