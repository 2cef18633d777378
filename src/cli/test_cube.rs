//! `truepose plan --iso9283`: the test cube of ISO 9283 with its poses and paths.

use std::fmt::Write as _;
use std::path::Path;

use crate::kinematics::Robot;
use crate::pipeline::measuring_list;
use crate::present::test_cube_v1::document;
use crate::standards::test_cube::TestCube;

use super::failure::Failure;
use super::output;
use super::words::line;

/// Runs the command for a session or a robot; `out`: where the poses go, and whether a file that exists is
/// replaced.
pub(super) fn run(
    input: &Path,
    session: bool,
    out: Option<(&Path, bool)>,
    json: bool,
) -> Result<(), Failure> {
    let (robot, files) = if session {
        let loaded = output::session(input)?;
        (loaded.session.robot, loaded.files)
    } else {
        (output::robot(input)?, vec![input.to_owned()])
    };
    let cube = TestCube::of(&robot)
        .map_err(|error| Failure::WrongAt(input.display().to_string(), error.describe()))?;
    if let Some((out, force)) = out {
        let list = measuring_list(&cube.measuring_order(), &robot);
        output::document(out, list.as_bytes(), force, &files)?;
    }
    if json {
        output::json(&document(&cube, &robot))
    } else if output::is_standard_output(out.map(|(out, _)| out)) {
        Ok(())
    } else {
        output::text(&in_words(&cube, &robot))
    }
}

fn in_words(cube: &TestCube, robot: &Robot) -> String {
    let centre = cube.poses[0].pose.translation.vector;
    let mut text = String::new();
    let head = say!(
        "{robot}: test cube of ISO 9283 with edges of {edge} mm, centre ({centre}) mm, plane C1-C2-C7-C8",
        robot = robot.name,
        edge = format!("{:.0}", cube.side_mm),
        centre = format!("{:.0}, {:.0}, {:.0}", centre.x, centre.y, centre.z)
    );
    line(&mut text, head);
    let cycles = if cube.orientation_kept {
        say!(
            "30 cycles P5 → P4 → P3 → P2 → P1, beginning at P1, in one configuration, with one orientation"
        )
    } else {
        say!(
            "30 cycles P5 → P4 → P3 → P2 → P1, beginning at P1, in one configuration, the orientation as the joints allow"
        )
    };
    line(&mut text, cycles);
    for pose in &cube.poses {
        let at = pose.pose.translation.vector;
        let _ = write!(
            text,
            "  {}  ({:>8.1}, {:>8.1}, {:>8.1}) mm ",
            pose.name, at.x, at.y, at.z
        );
        for (joint, q) in robot.joints.iter().zip(&pose.q) {
            let _ = write!(
                text,
                " {:>9.3}{}",
                joint.kind.to_display(*q),
                joint.kind.sign()
            );
        }
        text.push('\n');
    }
    let paths = say!(
        "paths: straight from P2 to P4, and a circle of {diameter} mm about P1, 10 cycles each (points in --json)",
        diameter = format!("{:.0}", 0.8 * cube.side_mm)
    );
    line(&mut text, paths);
    text
}
