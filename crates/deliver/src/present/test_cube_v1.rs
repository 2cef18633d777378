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

use super::displayed;
use super::json::{Json, keyed, list, object};
use super::parts::pose;
use crate::kinematics::Robot;
use crate::standards::path::PATH_CYCLES;
use crate::standards::pose::STANDARD_CYCLES;
use crate::standards::test_cube::{TestCube, TestPose};

/// The document of a robot's test cube.
pub fn document(cube: &TestCube, robot: &Robot) -> Json {
    let centre_mm: [f64; 3] = cube.poses[0].pose.translation.vector.into();
    let corners = cube.corners_mm.iter().enumerate().map(|(k, c)| {
        let place: [f64; 3] = c.coords.into();
        (format!("C{}", k + 1), place.into())
    });
    let path = |name: &str, points| {
        object! { "name": name, "cycles": PATH_CYCLES, "points": poses(points, robot) }
    };
    object! {
        "format": "truepose-test-cube/1",
        "robot": &robot.name,
        "side_mm": cube.side_mm,
        "centre_mm": centre_mm,
        "corners_mm": keyed(corners),
        "plane": ["C1", "C2", "C7", "C8"],
        "orientation_kept": cube.orientation_kept,
        "cycles": STANDARD_CYCLES,
        "order": ["P5", "P4", "P3", "P2", "P1"],
        "poses": poses(&cube.poses, robot),
        "paths": [path("line", &cube.line), path("circle", &cube.circle)],
    }
}

fn poses(all: &[TestPose], robot: &Robot) -> Json {
    list(all, |one| {
        object! { "name": &one.name }
            .with(pose(&one.pose))
            .with(object! { "q_deg": displayed(robot, &one.q) })
    })
}
