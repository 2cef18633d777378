//! One point through a chain, as fast as it goes: constants computed once, sines together, no
//! matrices.
//!
//! Each axis gets a frame `F_i` whose z is the axis. Between neighbouring axes any rotation is
//! Rz(φ) Rx(α) Rz(·), and the last factor is swallowed by the free choice of x about the next axis,
//! so
//!
//! ```text
//! p_base = F_1 · Z_1(q1) X_1 · … · Z_n(qn) X_n · p,
//! X_i p = Rx(α_i) p + t_i,   Z_i(q) p = Rz(q + φ_i) p   or   Rz(φ_i) p + q ẑ  (prismatic)
//! ```
//!
//! with p the target in the frame of the last axis. Eight multiplications and seven additions per
//! joint beside the sine and cosine. Unlike Denavit–Hartenberg parameters, `t_i` is a free vector,
//! so nearly parallel axes do no harm.
//!
//! A pose has the same answer, to the last bit, alone and among others.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Vector3};

use super::robot::{JointKind, Robot};
use crate::sincos::{sin_cos, sin_cos_all, sin_cos_lanes};

/// Joints whose sines are computed together.
const BATCH: usize = 8;

/// Poses that go through the chain side by side.
const LANES: usize = 8;

/// The step through one joint.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Step {
    /// φ, rad.
    offset_rad: f64,
    /// 1 for a revolute joint, else 0.
    turns: f64,
    /// 1 for a prismatic joint, else 0.
    slides: f64,
    cos_alpha: f64,
    sin_alpha: f64,
    /// t, mm.
    shift_mm: Vector3<f64>,
}

/// A robot prepared to say where points of its tool are, for many poses.
#[derive(Debug, Clone, PartialEq)]
pub struct PointMap {
    rotation_of_first_axis: Matrix3<f64>,
    point_of_first_axis_mm: Vector3<f64>,
    steps: Vec<Step>,
    /// Tool coordinates to those of the last axis, at home.
    last_axis_from_tool: Isometry3<f64>,
    /// The tool's origin in the frame of the last axis, mm.
    origin_mm: Vector3<f64>,
}

impl PointMap {
    /// Prepares `robot`.
    pub fn new(robot: &Robot) -> Self {
        let mut frame = robot.joints.first().map_or_else(Isometry3::identity, |j| {
            let rotation = rotation_taking_z_to(&j.axis.direction);
            Isometry3::from_parts(j.axis.point_mm.into(), rotation.into())
        });
        let rotation_of_first_axis = frame.rotation.to_rotation_matrix().into_inner();
        let point_of_first_axis_mm = frame.translation.vector;

        let mut steps = Vec::with_capacity(robot.joints.len());
        for (index, joint) in robot.joints.iter().enumerate() {
            let next = robot.joints.get(index + 1).map(|j| &j.axis);
            // The next axis as this one sees it: direction (sin α sin φ, −sin α cos φ, cos α).
            let (phi, alpha, shift_in_frame) = next.map_or((0.0, 0.0, Vector3::zeros()), |axis| {
                let z = frame.rotation.inverse() * axis.direction.into_inner();
                let sine = z.x.hypot(z.y);
                let phi = if sine > 0.0 { z.x.atan2(-z.y) } else { 0.0 };
                let between = frame.inverse() * axis.point_mm;
                (phi, sine.atan2(z.z), between.coords)
            });
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), phi);
            steps.push(Step {
                offset_rad: phi,
                turns: f64::from(u8::from(joint.kind == JointKind::Revolute)),
                slides: f64::from(u8::from(joint.kind == JointKind::Prismatic)),
                cos_alpha: alpha.cos(),
                sin_alpha: alpha.sin(),
                shift_mm: turn.inverse() * shift_in_frame,
            });
            if let Some(axis) = next {
                let tilt = Rotation3::from_axis_angle(&Vector3::x_axis(), alpha);
                frame = Isometry3::from_parts(
                    axis.point_mm.into(),
                    frame.rotation * nalgebra::UnitQuaternion::from(turn * tilt),
                );
            }
        }
        let last_axis_from_tool = frame.inverse() * robot.base_from_tool;
        Self {
            rotation_of_first_axis,
            point_of_first_axis_mm,
            steps,
            last_axis_from_tool,
            origin_mm: last_axis_from_tool.translation.vector,
        }
    }

    /// Where a point fixed in the tool frame stands in the base frame at `q` (rad, mm), mm.
    ///
    /// # Panics
    /// If `q` does not have one value per joint.
    #[inline]
    pub fn point_in_base(&self, q: &[f64], point_in_tool: &Point3<f64>) -> Point3<f64> {
        self.moved(q, (self.last_axis_from_tool * point_in_tool).coords)
    }

    /// Where the tool's origin stands in the base frame at `q` (rad, mm), mm.
    ///
    /// # Panics
    /// If `q` does not have one value per joint.
    #[inline]
    pub fn origin_in_base(&self, q: &[f64]) -> Point3<f64> {
        self.moved(q, self.origin_mm)
    }

    /// Where a point fixed in the tool frame stands at many poses, mm; `q` holds them one after
    /// another, one value per joint, and `positions` takes one position per pose.
    ///
    /// Several poses go through the chain side by side, which is where most of the speed is.
    ///
    /// # Panics
    /// If there is not one position for each pose.
    pub fn points_in_base(
        &self,
        q: &[f64],
        point_in_tool: &Point3<f64>,
        positions: &mut [Point3<f64>],
    ) {
        let joints = self.steps.len();
        assert!(
            q.len() == joints * positions.len(),
            "{} joint values for {} poses of a robot with {joints} joints",
            q.len(),
            positions.len()
        );
        let start = (self.last_axis_from_tool * point_in_tool).coords;
        let mut poses = q.chunks_exact(joints * LANES);
        let mut groups = positions.chunks_exact_mut(LANES);
        for (q, positions) in poses.by_ref().zip(groups.by_ref()) {
            self.move_lanes(q, start, positions);
        }
        let rest = poses.remainder().chunks_exact(joints);
        for (q, position) in rest.zip(groups.into_remainder()) {
            *position = self.moved(q, start);
        }
    }

    /// [`LANES`] poses at once, coordinate by coordinate.
    #[inline]
    fn move_lanes(&self, q: &[f64], start: Vector3<f64>, positions: &mut [Point3<f64>]) {
        let joints = self.steps.len();
        let mut x = [start.x; LANES];
        let mut y = [start.y; LANES];
        let mut z = [start.z; LANES];
        for (index, step) in self.steps.iter().enumerate().rev() {
            let values: [f64; LANES] = std::array::from_fn(|lane| q[lane * joints + index]);
            // A slide turns nothing: its sine and cosine are those of φ alone.
            let (sines, cosines) = if step.turns == 0.0 {
                let (sine, cosine) = sin_cos(step.offset_rad);
                ([sine; LANES], [cosine; LANES])
            } else {
                sin_cos_lanes(&values.map(|value| step.offset_rad + value))
            };
            for lane in 0..LANES {
                let p = Vector3::new(x[lane], y[lane], z[lane]);
                let p = step.move_point(p, values[lane], sines[lane], cosines[lane]);
                (x[lane], y[lane], z[lane]) = (p.x, p.y, p.z);
            }
        }
        for (lane, position) in positions.iter_mut().enumerate() {
            *position = self.in_base(Vector3::new(x[lane], y[lane], z[lane]));
        }
    }

    #[inline]
    fn in_base(&self, p: Vector3<f64>) -> Point3<f64> {
        Point3::from(self.rotation_of_first_axis * p + self.point_of_first_axis_mm)
    }

    #[inline]
    fn moved(&self, q: &[f64], mut p: Vector3<f64>) -> Point3<f64> {
        assert!(
            q.len() == self.steps.len(),
            "{} joint values for a robot with {} joints",
            q.len(),
            self.steps.len()
        );
        let mut end = q.len();
        while end > 0 {
            let start = end.saturating_sub(BATCH);
            p = moved_through(&self.steps[start..end], &q[start..end], p);
            end = start;
        }
        self.in_base(p)
    }
}

/// The point after at most [`BATCH`] steps, the last first.
#[inline]
fn moved_through(steps: &[Step], q: &[f64], p: Vector3<f64>) -> Vector3<f64> {
    let count = steps.len();
    let mut angles = [0.0; BATCH];
    let mut sines = [0.0; BATCH];
    let mut cosines = [0.0; BATCH];
    for ((angle, step), value) in angles.iter_mut().zip(steps).zip(q) {
        *angle = step.offset_rad + step.turns * value;
    }
    sin_cos_all(&angles[..count], &mut sines[..count], &mut cosines[..count]);
    let trigonometry = sines.iter().zip(&cosines);
    steps
        .iter()
        .zip(q)
        .zip(trigonometry)
        .rev()
        .fold(p, |p, ((step, value), (sine, cosine))| {
            step.move_point(p, *value, *sine, *cosine)
        })
}

impl Step {
    /// Rz(q + φ) (Rx(α) p + t) + q ẑ for a prismatic joint.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "the loop over lanes is vectorised with it"
    )]
    fn move_point(&self, p: Vector3<f64>, value: f64, sine: f64, cosine: f64) -> Vector3<f64> {
        let x = p.x + self.shift_mm.x;
        let y = (self.cos_alpha * p.y + self.shift_mm.y) - self.sin_alpha * p.z;
        let z = (self.sin_alpha * p.y + self.shift_mm.z) + self.cos_alpha * p.z;
        Vector3::new(
            cosine * x - sine * y,
            sine * x + cosine * y,
            z + self.slides * value,
        )
    }
}

/// Some rotation that takes z to `direction`; none where it already is.
fn rotation_taking_z_to(direction: &Vector3<f64>) -> Rotation3<f64> {
    let half_turn = Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    Rotation3::rotation_between(&Vector3::z(), direction).unwrap_or(half_turn)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{robot_and_pose, target};
    use super::super::{Axis, Joint};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_prepared_map_is_the_product_of_exponentials((robot, q) in robot_and_pose(), p in target()) {
            let map = PointMap::new(&robot);
            let pose = robot.base_from_tool(&q);
            prop_assert!((map.point_in_base(&q, &p) - pose * p).norm() < 1e-10);
            let origin = Point3::from(pose.translation.vector);
            prop_assert!((map.origin_in_base(&q) - origin).norm() < 1e-10);
        }

        #[test]
        fn many_poses_at_once_are_each_pose_alone(
            (robot, q) in robot_and_pose(), p in target(), count in 1usize..11,
        ) {
            let map = PointMap::new(&robot);
            let poses: Vec<f64> =
                (0..count).flat_map(|pose| q.iter().map(move |v| v + 0.3 * pose as f64)).collect();
            let mut positions = vec![Point3::origin(); count];
            map.points_in_base(&poses, &p, &mut positions);
            for (pose, position) in poses.chunks(q.len()).zip(&positions) {
                // To the last bit: an answer must not depend on what it was computed beside.
                prop_assert_eq!(map.point_in_base(pose, &p), *position);
            }
        }

        #[test]
        fn nearly_parallel_and_opposite_axes_do_no_harm(
            tilt in -16.0..-1.0_f64, opposite: bool, q in prop::array::uniform3(-3.0..3.0_f64),
        ) {
            let sign = if opposite { -1.0 } else { 1.0 };
            let tilted = Vector3::new(0.0, 10.0_f64.powf(tilt), sign);
            let joint = |d, x| {
                Joint::new("j", JointKind::Revolute, Axis::through(d, Point3::new(x, 0.0, 0.0)).unwrap())
            };
            let robot = Robot {
                name: "nearly planar".to_owned(),
                joints: vec![joint(-Vector3::z(), 0.0), joint(tilted, 400.0), joint(Vector3::z(), 800.0)],
                base_from_tool: super::super::Pose::translation(1000.0, 0.0, 100.0),
                gravity_m_s2: None,
            };
            let by_pose = robot.point_in_base(&q, &Point3::origin());
            prop_assert!((PointMap::new(&robot).origin_in_base(&q) - by_pose).norm() < 5e-12);
        }
    }

    #[test]
    fn more_joints_than_one_batch_are_no_trouble() {
        let joint = |i: u8| {
            let direction = Vector3::new(f64::from(i % 3), 1.0, f64::from(i % 2));
            let point = Point3::new(0.0, f64::from(i), 50.0 * f64::from(i));
            Joint::new(
                "j",
                JointKind::Revolute,
                Axis::through(direction, point).unwrap(),
            )
        };
        let robot = Robot {
            name: "snake".to_owned(),
            joints: (0..19).map(joint).collect(),
            base_from_tool: super::super::Pose::translation(0.0, 0.0, 1000.0),
            gravity_m_s2: None,
        };
        let q: Vec<f64> = (0..19).map(|i| f64::from(i) * 0.37 - 2.0).collect();
        let expected = robot.point_in_base(&q, &Point3::origin());
        assert!((PointMap::new(&robot).origin_in_base(&q) - expected).norm() < 1e-10);
    }
}
