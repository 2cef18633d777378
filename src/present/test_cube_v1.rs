//! `truepose-test-cube/1`: the test cube of ISO 9283 as JSON.
//!
//! ```json
//! { "format": "truepose-test-cube/1", "robot": "…", "side_mm": 630, "centre_mm": [0, 0, 0],
//!   "corners_mm": { "C1": [0, 0, 0], … }, "plane": ["C1", "C2", "C7", "C8"],
//!   "orientation_kept": true, "cycles": 30, "order": ["P5", "P4", "P3", "P2", "P1"],
//!   "poses": [ { "name": "P1", "position_mm": [0, 0, 0], "quaternion_wxyz": [1, 0, 0, 0], "q_deg": [0] } ],
//!   "paths": [ { "name": "line", "cycles": 10, "points": [ … as poses … ] }, { "name": "circle", … } ] }
//! ```
//!
//! Poses are those of the tool in the base frame; the values of a sliding joint are in mm.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::kinematics::Robot;
use crate::standards::pose::STANDARD_CYCLES;
use crate::standards::test_cube::{PATH_CYCLES, TestCube, TestPose};

/// The document.
#[derive(Debug, Serialize)]
pub struct Document<'a> {
    format: &'static str,
    robot: &'a str,
    side_mm: f64,
    centre_mm: [f64; 3],
    corners_mm: BTreeMap<String, [f64; 3]>,
    plane: [&'static str; 4],
    orientation_kept: bool,
    cycles: usize,
    order: [&'static str; 5],
    poses: Vec<Pose<'a>>,
    paths: [Path<'a>; 2],
}

#[derive(Debug, Serialize)]
struct Path<'a> {
    name: &'static str,
    cycles: usize,
    points: Vec<Pose<'a>>,
}

#[derive(Debug, Serialize)]
struct Pose<'a> {
    name: &'a str,
    position_mm: [f64; 3],
    quaternion_wxyz: [f64; 4],
    q_deg: Vec<f64>,
}

impl<'a> Document<'a> {
    /// The document of a robot's test cube.
    pub fn new(cube: &'a TestCube, robot: &'a Robot) -> Self {
        let path = |name, points| Path {
            name,
            cycles: PATH_CYCLES,
            points: poses(points, robot),
        };
        let corners = cube.corners_mm.iter().enumerate();
        Self {
            format: "truepose-test-cube/1",
            robot: &robot.name,
            side_mm: cube.side_mm,
            centre_mm: cube.poses[0].pose.translation.vector.into(),
            corners_mm: corners
                .map(|(k, c)| (format!("C{}", k + 1), c.coords.into()))
                .collect(),
            plane: ["C1", "C2", "C7", "C8"],
            orientation_kept: cube.orientation_kept,
            cycles: STANDARD_CYCLES,
            order: ["P5", "P4", "P3", "P2", "P1"],
            poses: poses(&cube.poses, robot),
            paths: [path("line", &cube.line), path("circle", &cube.circle)],
        }
    }
}

fn poses<'a>(all: &'a [TestPose], robot: &Robot) -> Vec<Pose<'a>> {
    let one = |pose: &'a TestPose| {
        let q = pose.pose.rotation.quaternion();
        let values = robot.joints.iter().zip(&pose.q);
        Pose {
            name: &pose.name,
            position_mm: pose.pose.translation.vector.into(),
            quaternion_wxyz: [q.w, q.i, q.j, q.k],
            q_deg: values.map(|(joint, q)| joint.kind.outer(*q)).collect(),
        }
    };
    all.iter().map(one).collect()
}
