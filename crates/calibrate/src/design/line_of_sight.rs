//! Whether an instrument sees a target in a pose.
//!
//! The rule is simple on purpose, as the robot's shape is not known: the robot is taken for straight rods between
//! points of its joint axes. A target is in the shadow where the line of sight passes one of the rods nearer than
//! [`THICK_MM`]; the last [`AT_TARGET_MM`] before the target do not count, nor does the rod to which the tool is
//! mounted. With a cone the line of sight has to come from within that angle about the direction in which the target
//! faces: away from the tool's origin, and along the tool's z where the target is at the origin.

use nalgebra::{Point3, Vector3};

use super::arm::Arm;
use super::candidate::Candidate;
use super::measuring_methods::last_setup;
use crate::effects::Inputs;

/// A rod takes the sight within this distance, mm.
pub(crate) const THICK_MM: f64 = 80.0;
/// So near to the target nothing hides it, mm.
pub(crate) const AT_TARGET_MM: f64 = 150.0;

/// A pose as the rule takes it, everything in the measuring frame, mm.
struct SightPose {
    joints: Vec<Point3<f64>>,
    target: Point3<f64>,
    faces: Vector3<f64>,
}

impl Arm {
    /// Whether the instrument that measures a candidate sees its target.
    pub(super) fn sees(&self, candidate: &Candidate) -> bool {
        self.ways[candidate.way].from.is_none_or(|from| {
            let pose = posed(self, candidate);
            pose.lit(&from) && self.cone_rad.is_none_or(|cone| pose.faces(&from, cone))
        })
    }
}

/// Where joints and targets are, as the model has them: a point of a joint's axis moves with the joints
/// before it alone.
fn posed(Arm { session, base, .. }: &Arm, Candidate { q, target, .. }: &Candidate) -> SightPose {
    let robot = &session.robot;
    let n = robot.joints.len();
    let home = |p: &Point3<f64>| <[f64; 3]>::from((robot.base_from_tool * p).coords);
    let axes = robot.joints.iter().map(|j| j.axis.point_mm.coords.into());
    let mut at_home: Vec<[f64; 3]> = axes.collect();
    at_home.extend([home(&Point3::origin()), home(&Point3::new(0.0, 0.0, 1.0))]);
    at_home.extend(session.targets.iter().map(|t| home(&t.position_mm)));
    // Its joints one by one, the tool's origin, a point along its z, and the target.
    let column = |j: usize| {
        (0..n + 3)
            .map(|row| if row > j { q[j] } else { 0.0 })
            .collect()
    };
    let mut inputs = Inputs::at_poses((0..n).map(column).collect(), at_home);
    let last = n as u32 + 2;
    inputs.target = Some((0..last).chain([last + target]).collect());
    inputs.setup = last_setup(session).map(|last| vec![last; n + 3]);
    let all = base.predict(&inputs);
    let at = |row: usize| Point3::from(all.get(row));
    let (origin, target) = (at(n), at(n + 2));
    let out = target - origin;
    SightPose {
        joints: (0..n).map(at).collect(),
        target,
        faces: if out.norm() > 1.0 {
            out
        } else {
            at(n + 1) - origin
        },
    }
}

impl SightPose {
    /// Whether no rod is in the line of sight.
    fn lit(&self, from: &Point3<f64>) -> bool {
        let sight = self.target - from;
        let far = sight.norm();
        if far <= AT_TARGET_MM {
            return true;
        }
        let end = from + sight * ((far - AT_TARGET_MM) / far);
        let mut rods = self.joints.windows(2);
        rods.all(|rod| smallest_distance([from, &end], [&rod[0], &rod[1]]) > THICK_MM)
    }

    fn faces(&self, from: &Point3<f64>, cone_rad: f64) -> bool {
        self.faces.angle(&(from - self.target)) <= cone_rad
    }
}

/// The smallest distance between two segments, mm (Ericson, *Real-Time Collision Detection*, 2005,
/// section 5.1.9).
fn smallest_distance(one: [&Point3<f64>; 2], other: [&Point3<f64>; 2]) -> f64 {
    let (u, v, w) = (one[1] - one[0], other[1] - other[0], one[0] - other[0]);
    let (a, e, b) = (u.norm_squared(), v.norm_squared(), u.dot(&v));
    let (c, f) = (u.dot(&w), v.dot(&w));
    let within = |x: f64| x.clamp(0.0, 1.0);
    let tiny = 1e-12;
    let across = a * e - b * b;
    let mut s = if a > tiny && across > tiny * a * e {
        within((b * f - c * e) / across)
    } else {
        0.0
    };
    let mut t = if e > tiny { (b * s + f) / e } else { 0.0 };
    if !(0.0..=1.0).contains(&t) {
        t = within(t);
        s = if a > tiny {
            within((b * t - c) / a)
        } else {
            0.0
        };
    }
    ((one[0] + u * s) - (other[0] + v * t)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_are_as_far_apart_as_a_search_says() {
        let p = |x, y, z| Point3::new(x, y, z);
        let pairs = [
            (
                [p(0.0, 0.0, 0.0), p(10.0, 0.0, 0.0)],
                [p(3.0, 4.0, -5.0), p(3.0, 4.0, 5.0)],
            ),
            (
                [p(0.0, 0.0, 0.0), p(10.0, 1.0, 0.0)],
                [p(12.0, 4.0, 2.0), p(20.0, 4.0, 5.0)],
            ),
            (
                [p(0.0, 0.0, 0.0), p(10.0, 0.0, 0.0)],
                [p(2.0, 3.0, 0.0), p(7.0, 3.0, 0.0)],
            ),
            (
                [p(1.0, 1.0, 1.0), p(1.0, 1.0, 1.0)],
                [p(2.0, 3.0, 0.0), p(7.0, 3.0, 0.0)],
            ),
        ];
        for (a, b) in pairs {
            let mut least = f64::INFINITY;
            for i in 0..=1000 {
                for j in 0..=1000 {
                    let along = |s: &[Point3<f64>; 2], k: i32| {
                        s[0] + (s[1] - s[0]) * (f64::from(k) / 1000.0)
                    };
                    least = least.min((along(&a, i) - along(&b, j)).norm());
                }
            }
            let found = smallest_distance([&a[0], &a[1]], [&b[0], &b[1]]);
            assert!((found - least).abs() < 1e-2, "{found} {least}");
        }
    }
}
