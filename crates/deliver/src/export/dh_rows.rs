//! The Denavit–Hartenberg rows of a nominal robot: those that it came with, else those of its axes.
//!
//! ```text
//! between axis i and axis i+1:   Rz(θ) Tz(d) Tx(a) Rx(α),   x along the common normal
//! ```
//!
//! Where the common normal may point either way, it is the way that turns θ least. Parallel axes
//! have as many common normals as there are places; the one at the frame before is taken. A joint
//! that slides has a direction and no place: the point that the description gives is its place.

use nalgebra::{UnitQuaternion, Vector3};

use crate::kinematics::{Axis, DhConvention, DhRow, Pose, Robot, RobotSource, robot_from_dh};

/// Sine of the angle below which neighbouring axes count as parallel: their common normal would lie
/// metres away, and jump with every tenth of a milliradian.
pub(super) const PARALLEL: f64 = 0.01;

/// What turns axis i's frame into axis i+1's.
struct Between {
    theta_rad: f64,
    d_mm: f64,
    a_mm: f64,
    alpha_rad: f64,
}

/// The frame before the first row, in the base frame, and the rows.
#[doc(hidden)]
pub fn nominal_rows(robot: &Robot, convention: DhConvention) -> (Pose, Vec<DhRow>) {
    if let RobotSource::Dh {
        base_from_first,
        rows,
    } = &robot.source
        && rows.iter().all(|row| row.convention == convention)
        && still_describe(robot, base_from_first, rows)
    {
        return (*base_from_first, rows.clone());
    }
    of_axes(robot, convention)
}

/// Whether the rows still are the robot's: its joints may have been changed since.
fn still_describe(robot: &Robot, base: &Pose, rows: &[DhRow]) -> bool {
    let Ok(described) = robot_from_dh("", rows) else {
        return false;
    };
    let same = |(a, b): (&crate::kinematics::Joint, &crate::kinematics::Joint)| {
        let (a, b) = (a.axis.moved_by(base), &b.axis);
        (a.point_mm - b.point_mm).norm() < 1e-6
            && (a.direction.into_inner() - b.direction.into_inner()).norm() < 1e-9
    };
    described.joints.len() == robot.joints.len()
        && described.joints.iter().zip(&robot.joints).all(same)
}

fn of_axes(robot: &Robot, convention: DhConvention) -> (Pose, Vec<DhRow>) {
    let Some(first) = robot.joints.first() else {
        return (Pose::identity(), Vec::new());
    };
    let base = first_frame(&first.axis);
    let mut frame = base;
    let mut all = Vec::new();
    for pair in robot.joints.windows(2) {
        let between = between(&frame, &pair[1].axis);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), between.theta_rad);
        let twist = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), between.alpha_rad);
        frame *= Pose::from_parts(Vector3::new(0.0, 0.0, between.d_mm).into(), turn)
            * Pose::from_parts(Vector3::new(between.a_mm, 0.0, 0.0).into(), twist);
        all.push(between);
    }
    let rows = robot.joints.iter().enumerate().map(|(k, joint)| {
        // A standard row has the link behind its joint, a modified one the link before it.
        let joint_part = all.get(k);
        let link_part = match convention {
            DhConvention::Standard => joint_part,
            DhConvention::Modified => k.checked_sub(1).and_then(|before| all.get(before)),
        };
        DhRow {
            a_mm: link_part.map_or(0.0, |b| b.a_mm),
            alpha_rad: link_part.map_or(0.0, |b| b.alpha_rad),
            d_mm: joint_part.map_or(0.0, |b| b.d_mm),
            theta_rad: joint_part.map_or(0.0, |b| b.theta_rad),
            convention,
            kind: joint.kind,
        }
    });
    (base, rows.collect())
}

/// A frame with z along the axis, turned like the base as far as that goes, at the point of the axis
/// that is nearest the base's origin; where the axis is upright, level with it.
fn first_frame(axis: &Axis) -> Pose {
    let z = axis.direction.into_inner();
    let rotation = UnitQuaternion::rotation_between(&Vector3::z(), &z).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    let point = axis.point_mm.coords;
    Pose::from_parts((point - z * z.dot(&point)).into(), rotation)
}

/// From a frame with z along its own axis to the next axis.
fn between(frame: &Pose, next: &Axis) -> Between {
    let z = next.direction.into_inner();
    let z = frame.rotation.inverse() * z;
    let p = frame.inverse_transform_point(&next.point_mm).coords;
    let normal = Vector3::z().cross(&z);
    let sine = normal.norm();
    let (d_mm, across) = if sine < PARALLEL {
        // The nearest point of the next axis.
        let foot = p - z * (p.z / z.z);
        (0.0, foot)
    } else {
        // Feet of the common normal: o + d·e_z and p + t·z.
        let cosine = z.z;
        let t = (cosine * p.z - z.dot(&p)) / (sine * sine);
        let d = p.z + t * cosine;
        (d, p + z * t - Vector3::new(0.0, 0.0, d))
    };
    let mut x = if sine < PARALLEL {
        let level = Vector3::new(across.x, across.y, 0.0);
        if level.norm() < 1e-9 {
            Vector3::x()
        } else {
            level.normalize()
        }
    } else {
        let level = Vector3::new(normal.x, normal.y, 0.0);
        level.normalize()
    };
    // Either way along the normal: the one that turns least.
    if x.x < -1e-9 || (x.x.abs() <= 1e-9 && x.y < 0.0) {
        x = -x;
    }
    Between {
        theta_rad: x.y.atan2(x.x),
        d_mm: d_mm + 0.0,
        a_mm: across.dot(&x) + 0.0,
        alpha_rad: normal.dot(&x).atan2(z.z) + 0.0,
    }
}

/// Whether two axes count as parallel.
pub(super) fn parallel(one: &Axis, other: &Axis) -> bool {
    one.direction.cross(&other.direction).norm() < PARALLEL
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::robot_and_pose;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_rows_of_any_axes_lead_where_the_axes_lead((robot, q) in robot_and_pose()) {
            for convention in [DhConvention::Standard, DhConvention::Modified] {
                let near = |pair: &[crate::kinematics::Joint]| {
                    let sine = pair[0].axis.direction.cross(&pair[1].axis.direction).norm();
                    sine > 1e-12 && sine < PARALLEL
                };
                prop_assume!(!robot.joints.windows(2).any(near));
                let (base, rows) = nominal_rows(&robot, convention);
                let described = robot_from_dh("", &rows).unwrap();
                let home = vec![0.0; q.len()];
                let tool = (base * described.base_from_tool(&home)).inverse() * robot.base_from_tool;
                let there = base * described.base_from_tool(&q) * tool;
                let off = there.to_homogeneous() - robot.base_from_tool(&q).to_homogeneous();
                prop_assert!(off.amax() < 1e-6, "{off}");
            }
        }
    }

    #[test]
    fn rows_that_came_in_go_out_and_axes_give_the_rows_of_a_textbook() {
        let row = |a_mm, alpha_rad, d_mm| DhRow {
            a_mm,
            alpha_rad,
            d_mm,
            theta_rad: 0.0,
            convention: DhConvention::Standard,
            kind: crate::kinematics::JointKind::Revolute,
        };
        let half_pi = std::f64::consts::FRAC_PI_2;
        let rows = vec![
            row(0.0, half_pi, 89.2),
            row(-425.0, 0.0, 0.0),
            row(0.0, half_pi, 0.0),
        ];
        let mut robot = robot_from_dh("arm", &rows).unwrap();
        assert_eq!(
            nominal_rows(&robot, DhConvention::Standard),
            (Pose::identity(), rows.clone())
        );
        robot.source = RobotSource::Axes;
        let (base, found) = nominal_rows(&robot, DhConvention::Standard);
        assert!((base.to_homogeneous() - Pose::identity().to_homogeneous()).norm() < 1e-12);
        for (found, row) in found.iter().zip(&rows[..2]) {
            assert!((found.a_mm - row.a_mm).abs() < 1e-9 && (found.d_mm - row.d_mm).abs() < 1e-9);
            assert!((found.alpha_rad - row.alpha_rad).abs() < 1e-12, "{found:?}");
            assert!((found.theta_rad).abs() < 1e-12, "{found:?}");
        }
    }
}
