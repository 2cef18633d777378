//! Closed-form inverse kinematics: all joint values of two shapes of six-joint arms, with a spherical wrist, and with
//! three parallel axes.
//!
//! ```text
//! g = e₁ e₂ e₃ e₄ e₅ e₆,   g = goal · home⁻¹,   eᵢ the turn about axis i at home
//! spherical wrist (4, 5, 6 meet in w; 2 ∥ 3):  g w = e₁ e₂ e₃ w,  then the rotations of the wrist
//! three parallel (2 ∥ 3 ∥ 4; 5, 6 meet in w):  g w = e₁ e₂ e₃ e₄ w,  then q₅, q₆, then a plane arm
//! ```
//!
//! A turn about parallel axes does not change the height along them, which gives q₁; the remaining problems are
//! triangles and turns about one axis (Paden–Kahan subproblems: Paden 1986, Kahan 1983; Murray, Li and Sastry 1994,
//! section 3.3). Where one of them is undetermined (a stretched wrist, a wrist over axis 1) there is no answer, and
//! the iteration of [`super::inverse`] is used.

use nalgebra::{Rotation3, Unit, Vector3};

use crate::rounding;

use super::joint_kind::JointKind;
use super::pose::Pose;
use super::robot::Robot;

/// Axes cross from this sine on (6°).
const CROSSING: f64 = 0.1;
/// On a circle that is smaller than this (a part of the reach, or a sine) an angle is undetermined.
const NO_CIRCLE: f64 = 1e-5;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    SphericalWrist,
    ThreeParallel,
}

/// A six-joint arm of one of the two shapes.
#[derive(Debug, Clone)]
pub(super) struct ClosedForm {
    shape: Shape,
    axes: [Unit<Vector3<f64>>; 6],
    points: [Vector3<f64>; 6],
    /// Where the last axes meet.
    wrist: Vector3<f64>,
    home: Pose,
    reach_mm: f64,
}

impl ClosedForm {
    /// Of a robot, if it has such a shape.
    pub(super) fn of(robot: &Robot) -> Option<Self> {
        let turning = |joint: &super::robot::Joint| joint.kind == JointKind::Revolute;
        if robot.joints.len() != 6 || !robot.joints.iter().all(turning) {
            return None;
        }
        let reach_mm = robot.reach_mm();
        let axes = std::array::from_fn(|k| robot.joints[k].axis.direction);
        let points = std::array::from_fn(|k| robot.joints[k].axis.point_mm.coords);
        let parallel = |a: usize, b: usize| axes_cross(&axes, a, b) < rounding::WRITTEN;
        let meet = |a: usize, b: usize| meeting(&axes, &points, a, b, reach_mm);
        if !parallel(1, 2) || axes_cross(&axes, 0, 1) < CROSSING {
            return None;
        }
        let on = |k: usize, at: &Vector3<f64>| {
            (at - points[k]).cross(&axes[k]).norm() < rounding::WRITTEN * reach_mm
        };
        let last = meet(4, 5)?;
        let shape = if parallel(1, 3) {
            Shape::ThreeParallel
        } else if on(3, &last) {
            Shape::SphericalWrist
        } else {
            return None;
        };
        Some(Self {
            shape,
            axes,
            points,
            wrist: last,
            home: robot.base_from_tool,
            reach_mm,
        })
    }

    /// Every solution, joints within half a turn; `None` where there is a line of them.
    pub(super) fn solutions(&self, goal: &Pose) -> Option<Vec<[f64; 6]>> {
        let g = goal * self.home.inverse();
        let wrist = g.rotation * self.wrist + g.translation.vector;
        let along = self.axes[1].into_inner();
        // The height of the wrist along the parallel axes, turned back about axis 1, gives q1.
        let height = along.dot(&(self.wrist - self.points[0]));
        let firsts = self.to_height(0, &(wrist - self.points[0]), &along, height, self.reach_mm)?;
        let mut all = Vec::with_capacity(8);
        for q1 in firsts.into_iter().map(|back| -back) {
            let back = self.turned(0, -q1);
            let rotation = back * g.rotation.to_rotation_matrix();
            let here = self.moved(0, -q1, &wrist);
            match self.shape {
                Shape::SphericalWrist => self.with_wrist(q1, &here, &rotation, &mut all)?,
                Shape::ThreeParallel => {
                    let home = self.moved(0, -q1, &g.translation.vector);
                    self.with_plane(q1, &home, &rotation, &mut all)?;
                }
            }
        }
        Some(all)
    }

    /// `here`: the wrist's centre, `rotation`: that of e₂ … e₆.
    fn with_wrist(
        &self,
        q1: f64,
        here: &Vector3<f64>,
        rotation: &Rotation3<f64>,
        all: &mut Vec<[f64; 6]>,
    ) -> Option<()> {
        let (w4, w6) = (self.axes[3].into_inner(), self.axes[5].into_inner());
        for [q2, q3] in self.plane_arm(&self.wrist, here)? {
            let own = self.turned(2, -q3) * self.turned(1, -q2) * rotation;
            let last = own * w6;
            for q5 in self.to_height(4, &w6, &w4, w4.dot(&last), 1.0)? {
                let q4 = self.angle(3, &(self.turned(4, q5) * w6), &last, 1.0)?;
                let rest = self.turned(4, -q5) * self.turned(3, -q4) * own;
                all.push([q1, q2, q3, q4, q5, self.own_angle(5, &rest)]);
            }
        }
        Some(())
    }

    /// `home`: where the origin goes by e₂ … e₆, `rotation`: theirs.
    fn with_plane(
        &self,
        q1: f64,
        home: &Vector3<f64>,
        rotation: &Rotation3<f64>,
        all: &mut Vec<[f64; 6]>,
    ) -> Option<()> {
        let (along, w6) = (self.axes[1].into_inner(), self.axes[5].into_inner());
        let back = rotation.inverse() * along;
        for q5 in self.to_height(4, &w6, &along, along.dot(&(rotation * w6)), 1.0)? {
            // e₆ turns the parallel direction after e₅ has turned it.
            let q6 = -self.angle(5, &(self.turned(4, -q5) * along), &back, 1.0)?;
            let plane = rotation * self.turned(5, -q6) * self.turned(4, -q5);
            let total = self.own_angle(1, &plane);
            // e₂ e₃ e₄ of a point on axis 4 is e₂ e₃ of it.
            let before = self.moved(5, -q6, &self.moved(4, -q5, &self.points[3]));
            let elbow = rotation * before + home;
            for [q2, q3] in self.plane_arm(&self.points[3], &elbow)? {
                let sign = |k: usize| self.axes[k].dot(&self.axes[1]).signum();
                let q4 = (total - q2 - sign(2) * q3) * sign(3);
                all.push([q1, q2, q3, q4, q5, q6]);
            }
        }
        Some(())
    }

    /// q2 and q3 that bring a point (home) to a place: a triangle across the parallel axes.
    fn plane_arm(&self, point: &Vector3<f64>, to: &Vector3<f64>) -> Option<Vec<[f64; 2]>> {
        let across = |v: Vector3<f64>| v - self.axes[1].into_inner() * self.axes[1].dot(&v);
        let upper = across(self.points[2] - self.points[1]);
        let lower = across(point - self.points[2]);
        let far = across(to - self.points[1]);
        // |upper + R₃ lower|² = |far|²
        let wanted = 0.5 * (far.norm_squared() - upper.norm_squared() - lower.norm_squared());
        let scale = upper.norm() * lower.norm();
        if scale < NO_CIRCLE * self.reach_mm * self.reach_mm {
            return None;
        }
        let thirds = self.to_height(2, &lower, &(upper / scale), wanted / scale, 1.0)?;
        let pairs = thirds.into_iter().map(|q3| {
            let whole = upper + self.turned(2, q3) * lower;
            Some([self.angle(1, &whole, &far, self.reach_mm)?, q3])
        });
        pairs.collect()
    }

    /// Angles of joint k that bring a vector to a height along a direction: none, or two.
    fn to_height(
        &self,
        k: usize,
        vector: &Vector3<f64>,
        along: &Vector3<f64>,
        height: f64,
        scale: f64,
    ) -> Option<Vec<f64>> {
        let axis = self.axes[k].into_inner();
        let still = axis * axis.dot(vector);
        let circle = vector - still;
        let (c, s) = (along.dot(&circle), along.dot(&axis.cross(&circle)));
        let radius = c.hypot(s);
        if radius < NO_CIRCLE * scale {
            return None;
        }
        let share = (height - along.dot(&still)) / radius;
        if share.abs() > 1.0 + rounding::WRITTEN * scale / radius {
            return Some(Vec::new());
        }
        let middle = s.atan2(c);
        let by = share.clamp(-1.0, 1.0).acos();
        Some(vec![middle + by, middle - by])
    }

    /// The angle of joint k that turns one vector towards another.
    fn angle(&self, k: usize, from: &Vector3<f64>, to: &Vector3<f64>, scale: f64) -> Option<f64> {
        let axis = self.axes[k].into_inner();
        let across = |v: &Vector3<f64>| v - axis * axis.dot(v);
        let (from, to) = (across(from), across(to));
        if from.norm() < NO_CIRCLE * scale || to.norm() < NO_CIRCLE * scale {
            return None;
        }
        Some(axis.dot(&from.cross(&to)).atan2(from.dot(&to)))
    }

    /// The angle of a rotation about the axis of joint k.
    fn own_angle(&self, k: usize, rotation: &Rotation3<f64>) -> f64 {
        let axis = self.axes[k].into_inner();
        let from = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
        let to = rotation * from;
        axis.dot(&from.cross(&to)).atan2(from.dot(&to))
    }

    fn turned(&self, k: usize, angle: f64) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&self.axes[k], angle)
    }

    /// A point turned about axis k at home.
    fn moved(&self, k: usize, angle: f64, point: &Vector3<f64>) -> Vector3<f64> {
        self.turned(k, angle) * (point - self.points[k]) + self.points[k]
    }
}

/// The sine of the angle of two axes.
fn axes_cross(axes: &[Unit<Vector3<f64>>; 6], a: usize, b: usize) -> f64 {
    axes[a].cross(&axes[b]).norm()
}

/// Where two axes meet.
fn meeting(
    axes: &[Unit<Vector3<f64>>; 6],
    points: &[Vector3<f64>; 6],
    a: usize,
    b: usize,
    reach_mm: f64,
) -> Option<Vector3<f64>> {
    let normal = axes[a].cross(&axes[b]);
    let squared = normal.norm_squared();
    if squared < CROSSING * CROSSING {
        return None;
    }
    let between = points[b] - points[a];
    if (between.dot(&normal) / squared.sqrt()).abs() > rounding::WRITTEN * reach_mm {
        return None;
    }
    let along = between.cross(&axes[b]).dot(&normal) / squared;
    Some(points[a] + axes[a].into_inner() * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::{Axis, Joint, RobotSource};

    fn arm(rows: &[([f64; 3], [f64; 3]); 6]) -> Robot {
        let joint = |(direction, point): &([f64; 3], [f64; 3])| {
            let axis = Axis::through((*direction).into(), (*point).into()).unwrap();
            Joint::new("j", JointKind::Revolute, axis)
        };
        Robot {
            name: "arm".to_owned(),
            joints: rows.iter().map(joint).collect(),
            base_from_tool: Pose::from_parts(
                Vector3::new(420.0, 15.0, 730.0).into(),
                nalgebra::UnitQuaternion::from_euler_angles(0.3, -0.4, 0.5),
            ),
            gravity_m_s2: None,
            source: RobotSource::Axes,
        }
    }

    /// A shoulder off the axis, a wrist off the plane, and one axis the other way round.
    fn wristed() -> Robot {
        arm(&[
            ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
            ([0.0, 1.0, 0.0], [30.0, 0.0, 330.0]),
            ([0.0, -1.0, 0.0], [30.0, 0.0, 640.0]),
            ([1.0, 0.0, 0.0], [30.0, 20.0, 710.0]),
            ([0.0, 1.0, 0.0], [340.0, 20.0, 710.0]),
            ([1.0, 0.0, 0.0], [340.0, 20.0, 710.0]),
        ])
    }

    /// Like a Universal Robots arm.
    fn parallel() -> Robot {
        arm(&[
            ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
            ([0.0, 1.0, 0.0], [0.0, 138.0, 89.0]),
            ([0.0, 1.0, 0.0], [425.0, 18.0, 89.0]),
            ([0.0, -1.0, 0.0], [817.0, 18.0, 89.0]),
            ([0.0, 0.0, -1.0], [817.0, 111.0, 89.0]),
            ([0.0, 1.0, 0.0], [817.0, 111.0, -5.0]),
        ])
    }

    #[test]
    fn every_solution_reaches_the_pose_and_the_one_it_came_from_is_among_them() {
        for robot in [wristed(), parallel()] {
            let closed = ClosedForm::of(&robot).expect("it has such a shape");
            for k in 0..200 {
                let q: Vec<f64> = (0..6)
                    .map(|j| 2.9 * (f64::from(k) * 1.7 + f64::from(j) * 2.3).sin())
                    .collect();
                let goal = robot.base_from_tool(&q);
                let all = closed.solutions(&goal).expect("not singular");
                assert!(all.len() >= 2 && all.len() <= 8, "{}", all.len());
                for found in &all {
                    let here = robot.base_from_tool(found);
                    let way = here.translation.vector - goal.translation.vector;
                    assert!(way.norm() < 1e-6, "{k}: {way:?} of {:?}", closed.shape);
                    assert!(here.rotation.angle_to(&goal.rotation) < 1e-8, "{k}");
                }
                let same = |found: &&[f64; 6]| {
                    let turns = found
                        .iter()
                        .zip(&q)
                        .map(|(a, b)| (0.5 * (a - b)).sin().abs());
                    turns.fold(0.0, f64::max) < 1e-6
                };
                assert!(all.iter().any(|f| same(&f)), "{k}");
            }
        }
    }

    #[test]
    fn a_stretched_wrist_has_no_closed_form() {
        let robot = wristed();
        let closed = ClosedForm::of(&robot).unwrap();
        let goal = robot.base_from_tool(&[0.2, 0.3, -0.4, 0.5, 0.0, 0.7]);
        assert!(closed.solutions(&goal).is_none());
    }
}
