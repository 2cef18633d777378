//! Robots from Denavit–Hartenberg rows.
//!
//! ```text
//! standard:  T_i(q) = Rz(θ_i + q) Tz(d_i) Tx(a_i) Rx(α_i)       the joint turns about z of frame i−1
//! modified:  T_i(q) = Rx(α_i) Tx(a_i) Rz(θ_i + q) Tz(d_i)       the joint turns about z of frame i
//! ```
//!
//! The modified rows are Craig's: a and α of a row are those he writes a_{i−1} and α_{i−1}. A row
//! whose joint slides has d + q in place of θ + q; θ and d are those at home. The tool is the
//! frame behind the last row. Each row is a complete rigid motion with its own joint in it, so the
//! conventions may be mixed in one chain: each row is read by its own.
//!
//! Sources: Denavit & Hartenberg 1955 (in Paul's form, 1981); Craig, *Introduction to Robotics*, 1986.

use nalgebra::{Point3, Vector3};

use super::dh_row::{DhRow, frames};
use super::pose::Pose;
use super::robot::{Axis, Joint, KinematicsError, MOST_JOINTS, Robot, RobotSource};

/// The robot of a Denavit–Hartenberg table, joints named `joint 1` and so on, gravity unknown.
///
/// # Errors
/// No rows, more than 100 of them, or a number that is not finite.
pub fn robot_from_dh(name: impl Into<String>, rows: &[DhRow]) -> Result<Robot, KinematicsError> {
    if rows.is_empty() {
        return Err(KinematicsError::NoJoints);
    }
    if rows.len() > MOST_JOINTS {
        return Err(KinematicsError::TooManyJoints { found: rows.len() });
    }
    let mut joints = Vec::with_capacity(rows.len());
    for (index, row) in rows.iter().enumerate() {
        let numbers = [row.a_mm, row.alpha_rad, row.d_mm, row.theta_rad];
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(KinematicsError::NotFinite {
                what: format!("a number in Denavit–Hartenberg row {}", index + 1),
            });
        }
    }
    let (frames, base_from_tool) = frames(rows);
    for (index, (row, [base_from_axis, _])) in rows.iter().zip(frames).enumerate() {
        let axis = Axis::through(
            base_from_axis.rotation * Vector3::z(),
            Point3::from(base_from_axis.translation.vector),
        )?;
        let name = format!("joint {}", index + 1);
        joints.push(Joint::new(name, row.kind, axis));
    }
    Ok(Robot {
        name: name.into(),
        joints,
        base_from_tool,
        gravity_m_s2: None,
        source: RobotSource::Dh {
            base_from_first: Pose::identity(),
            rows: rows.to_vec(),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::{DhConvention, JointKind};
    use nalgebra::Matrix4;
    use proptest::prelude::*;

    /// The row as its convention prints it, entry by entry.
    #[rustfmt::skip]
    fn printed_matrix(row: &DhRow, q: f64) -> Matrix4<f64> {
        let (turned, slid) = match row.kind {
            JointKind::Revolute => (q, 0.0),
            JointKind::Prismatic => (0.0, q),
        };
        let (st, ct) = (row.theta_rad + turned).sin_cos();
        let (sa, ca) = row.alpha_rad.sin_cos();
        let (a, d) = (row.a_mm, row.d_mm + slid);
        match row.convention {
            DhConvention::Standard => Matrix4::new(
                ct, -st * ca,  st * sa, a * ct,
                st,  ct * ca, -ct * sa, a * st,
                0.0, sa,       ca,      d,
                0.0, 0.0,      0.0,     1.0,
            ),
            DhConvention::Modified => Matrix4::new(
                ct,      -st,      0.0, a,
                st * ca,  ct * ca, -sa, -sa * d,
                st * sa,  ct * sa,  ca,  ca * d,
                0.0,      0.0,      0.0, 1.0,
            ),
        }
    }

    fn row() -> impl Strategy<Value = (DhRow, f64)> {
        let angle = prop_oneof![
            Just(0.0),
            Just(std::f64::consts::FRAC_PI_2),
            Just(-std::f64::consts::FRAC_PI_2),
            Just(std::f64::consts::PI),
            -3.0..3.0_f64,
        ];
        (
            -700.0..700.0,
            angle,
            -400.0..400.0,
            -3.0..3.0,
            any::<bool>(),
            (prop::bool::weighted(0.75), -4.0..4.0),
        )
            .prop_map(|(a_mm, alpha_rad, d_mm, theta_rad, standard, (turns, q))| {
                let convention = if standard {
                    DhConvention::Standard
                } else {
                    DhConvention::Modified
                };
                (
                    DhRow {
                        a_mm,
                        alpha_rad,
                        d_mm,
                        theta_rad,
                        convention,
                        kind: if turns {
                            JointKind::Revolute
                        } else {
                            JointKind::Prismatic
                        },
                    },
                    q,
                )
            })
    }

    proptest! {
        #[test]
        fn the_product_of_the_printed_matrices_is_the_product_of_exponentials(
            table in prop::collection::vec(row(), 1..8),
        ) {
            let rows: Vec<DhRow> = table.iter().map(|(row, _)| *row).collect();
            let q: Vec<f64> = table.iter().map(|(_, q)| *q).collect();
            let robot = robot_from_dh("table", &rows).unwrap();
            let printed = table
                .iter()
                .fold(Matrix4::identity(), |t, (row, q)| t * printed_matrix(row, *q));
            let difference = robot.base_from_tool(&q).to_homogeneous() - printed;
            prop_assert!(difference.amax() < 1e-10, "{difference}");
        }
    }

    #[test]
    fn an_empty_table_and_a_nan_are_refused_by_row() {
        assert_eq!(
            robot_from_dh("x", &[]).unwrap_err(),
            KinematicsError::NoJoints
        );
        let good = DhRow {
            a_mm: 1.0,
            alpha_rad: 0.0,
            d_mm: 0.0,
            theta_rad: 0.0,
            convention: DhConvention::Standard,
            kind: JointKind::Revolute,
        };
        let bad = DhRow {
            d_mm: f64::NAN,
            ..good
        };
        let refused = robot_from_dh("x", &[good, bad]).unwrap_err();
        assert!(refused.to_string().contains("row 2"), "{refused}");
    }
}
