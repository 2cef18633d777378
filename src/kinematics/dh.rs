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

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::robot::{
    Axis, Joint, JointKind, KinematicsError, MOST_JOINTS, Pose, Robot, RobotSource,
};

/// Which of the two customs a row follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DhConvention {
    /// Paul: the joint first, then the link.
    Standard,
    /// Craig: the link first, then the joint.
    Modified,
}

/// One row of a Denavit–Hartenberg table, one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DhRow {
    /// Length of the common normal, mm.
    pub a_mm: f64,
    /// Twist of the axes about it, rad.
    pub alpha_rad: f64,
    /// Offset along the joint's axis, at home, mm.
    pub d_mm: f64,
    /// Angle about the joint's axis, at home, rad.
    pub theta_rad: f64,
    /// Which custom the row follows.
    pub convention: DhConvention,
    /// Whether the joint turns or slides.
    pub kind: JointKind,
}

impl DhRow {
    /// The part across the joint, `Tx(a) Rx(α)`.
    fn link(&self) -> Pose {
        about(Vector3::x_axis(), self.alpha_rad) * Pose::translation(self.a_mm, 0.0, 0.0)
    }

    /// The part along the joint at home, `Rz(θ) Tz(d)`.
    fn joint(&self) -> Pose {
        about(Vector3::z_axis(), self.theta_rad) * Pose::translation(0.0, 0.0, self.d_mm)
    }
}

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

/// At home in the base frame: for each row the frame before its joint and the one behind it, both
/// with z along the joint; and the frame behind the last row.
fn frames(rows: &[DhRow]) -> (Vec<[Pose; 2]>, Pose) {
    let mut base_from_frame = Pose::identity();
    let mut frames = Vec::with_capacity(rows.len());
    for row in rows {
        let (link, joint) = (row.link(), row.joint());
        match row.convention {
            DhConvention::Standard => {
                frames.push([base_from_frame, base_from_frame * joint]);
                base_from_frame *= joint * link;
            }
            DhConvention::Modified => {
                let before = base_from_frame * link;
                frames.push([before, before * joint]);
                base_from_frame = before * joint;
            }
        }
    }
    (frames, base_from_frame)
}

/// The frame behind each joint of a table at home, in the base frame, z along the joint.
pub(super) fn link_frames(rows: &[DhRow]) -> Vec<Pose> {
    frames(rows)
        .0
        .into_iter()
        .map(|[_, behind]| behind)
        .collect()
}

fn about(axis: nalgebra::Unit<Vector3<f64>>, angle_rad: f64) -> Pose {
    let rotation = UnitQuaternion::from_axis_angle(&axis, angle_rad);
    Pose::from_parts(Vector3::zeros().into(), rotation)
}

#[cfg(test)]
mod tests {
    use super::*;
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
