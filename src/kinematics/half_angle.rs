//! The source paper's half-angle form of a column that turns about z.
//!
//! With Λ = (λ0, 0, 0, λ3), λ0 = cos(θ/2), λ3 = sin(θ/2):
//!
//! ```text
//! e^[V]Λ = [[2λ0²−1, −2λ0λ3, 0, 0], [2λ0λ3, 2λ0²−1, 0, 0], [0,0,1,0], [0,0,0,1]]      (1)
//! T_BR(0) = Trans(0, 0, l3),   T_RP = Trans(l1, 0, l2)                                (2)
//! T_BP(Λ) = e^[V]Λ · T_BR(0) · T_RP,   p = ((2λ0²−1) l1, 2λ0λ3 l1, l2+l3)             (3)
//! ```
//!
//! Frames: base {B}, rotation {R}, lamp {P}. It is the product of exponentials for one revolute
//! joint about z; the tests prove that over the whole circle. Lengths in mm, θ in rad.

use nalgebra::{Matrix4, Point3, Vector3};

use super::robot::{Axis, Joint, JointKind, Pose, Robot};

/// A lamp on a rotating column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotatingColumn {
    /// Radius of the lamp about the column, mm.
    pub l1_mm: f64,
    /// Height of the lamp above the rotation frame, mm.
    pub l2_mm: f64,
    /// Height of the rotation frame above the base, mm.
    pub l3_mm: f64,
}

/// The two components of Λ that are not zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfAngle {
    /// cos(θ/2).
    pub lambda0: f64,
    /// sin(θ/2).
    pub lambda3: f64,
}

impl HalfAngle {
    /// Λ of the angle θ.
    pub fn of(theta_rad: f64) -> Self {
        let (lambda3, lambda0) = (0.5 * theta_rad).sin_cos();
        Self { lambda0, lambda3 }
    }

    /// Equation (1).
    #[rustfmt::skip]
    pub fn exponential(&self) -> Matrix4<f64> {
        let cosine = 2.0 * self.lambda0 * self.lambda0 - 1.0;
        let sine = 2.0 * self.lambda0 * self.lambda3;
        Matrix4::new(
            cosine, -sine, 0.0, 0.0,
            sine, cosine, 0.0, 0.0,
            0.0, 0.0, 1.0, 0.0,
            0.0, 0.0, 0.0, 1.0,
        )
    }
}

impl RotatingColumn {
    /// Equation (3): the lamp's pose in the base frame as a homogeneous matrix.
    pub fn base_from_lamp(&self, lambda: HalfAngle) -> Matrix4<f64> {
        let base_from_rotation = Matrix4::new_translation(&Vector3::new(0.0, 0.0, self.l3_mm)); // (2)
        let rotation_from_lamp =
            Matrix4::new_translation(&Vector3::new(self.l1_mm, 0.0, self.l2_mm)); // (2)
        lambda.exponential() * base_from_rotation * rotation_from_lamp
    }

    /// Equation (3): the lamp's position in the base frame, mm.
    pub fn position_mm(&self, lambda: HalfAngle) -> Point3<f64> {
        let HalfAngle { lambda0, lambda3 } = lambda;
        Point3::new(
            (2.0 * lambda0 * lambda0 - 1.0) * self.l1_mm,
            2.0 * lambda0 * lambda3 * self.l1_mm,
            self.l2_mm + self.l3_mm,
        )
    }

    /// The same column as a robot of one joint.
    pub fn robot(&self) -> Robot {
        let axis = Axis {
            direction: Vector3::z_axis(),
            point_mm: Point3::origin(),
        };
        Robot {
            name: "rotating column".to_owned(),
            joints: vec![Joint::new("column", JointKind::Revolute, axis)],
            base_from_tool: Pose::translation(self.l1_mm, 0.0, self.l2_mm + self.l3_mm),
            gravity_m_s2: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_half_angle_form_is_the_product_of_exponentials_over_the_whole_circle() {
        let column = RotatingColumn {
            l1_mm: 250.0,
            l2_mm: 180.0,
            l3_mm: 420.0,
        };
        let robot = column.robot();
        for tenth_deg in -7200..=7200 {
            let theta = f64::from(tenth_deg).to_radians() / 10.0;
            let lambda = HalfAngle::of(theta);
            let by_exponentials = robot.base_from_tool(&[theta]);
            let difference = column.base_from_lamp(lambda) - by_exponentials.to_homogeneous();
            assert!(difference.amax() < 5e-13, "{tenth_deg}: {difference}");
            let position = by_exponentials * Point3::origin();
            assert!((column.position_mm(lambda) - position).norm() < 5e-13);
        }
    }

    #[test]
    fn the_papers_first_sample_stands_where_the_paper_prints_it() {
        let column = RotatingColumn {
            l1_mm: 250.0,
            l2_mm: 0.0,
            l3_mm: 0.0,
        };
        let position = column.position_mm(HalfAngle::of(6.0_f64.to_radians()));
        assert!((position.x - 248.631).abs() < 1e-3);
        assert!((position.y - 26.132).abs() < 1e-3);
    }
}
