//! Poses of a calibration board that a camera saw: a row for each image.
//!
//! `rvec_x, rvec_y, rvec_z` (rad) and `tvec_x, tvec_y, tvec_z`, as `OpenCV`'s `solvePnP` and the
//! detectors of chessboards, `ChArUco` boards and `AprilTag` grids give them; or the quaternion
//! `qw, qx, qy, qz` in place of the first three. Both turn the board's coordinates into those of the
//! camera:
//!
//! ```text
//! p_camera = R(rvec) p_board + tvec,   R(rvec) = a turn by |rvec| about rvec
//! ```
//!
//! The camera looks along +z, x points to the right and y downwards in the image. With a camera that
//! stands still and the board on the tool this is the pose of the tool frame in the camera frame.
//! With the camera on the tool and the board standing still the inverse is: the pose of the camera in
//! the frame of the board. The numbers do not show which of the two it is: `--camera` says it.

use crate::text::Text;
use nalgebra::{Isometry3, Point3, Quaternion, UnitQuaternion};

use crate::importers::columns::{COORDINATES, Column, Columns};
use crate::importers::formats::{Importer, KnownBy, OwnOption, Questions};
use crate::importers::headings::{understand, words_and_unit};
use crate::importers::reader::fixed;
use crate::importers::role::Role;
use crate::importers::settings::{About, Known, ReadContext};
use crate::importers::units::Word;
use crate::sessions::columns::{Quantity, Unit};

const CAMERA: &str = "camera";

pub(crate) static IMPORTER: Importer = Importer {
    id: "board",
    title: phrase!("a camera that sees a calibration board: rvec and tvec of each image"),
    asks: Questions::TABLE,
    options: &[OwnOption {
        name: CAMERA,
        title: phrase!("Camera"),
        value: "WHERE",
        help: phrase!(
            "the camera stands still and sees the board on the tool, or sits on the tool and sees a board that stands still"
        ),
        values: &["fixed", "on-tool"],
    }],
    known_by: KnownBy::headed(1),
    read,
};

/// The components of the rotation vector: they become a quaternion once they are read.
const TURN: [Quantity; 3] = [
    Quantity::Orientation(1),
    Quantity::Orientation(2),
    Quantity::Orientation(3),
];

/// Reads the poses.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let grid = context.grid()?;
    let names = grid.headings();
    let mut parts: Vec<(Role, bool)> = names.iter().map(|name| part(name)).collect();
    parts.resize(grid.width, (Role::Kept, false));
    let of_board = |wanted: Quantity| {
        let is = |(role, own): &&(Role, bool)| *own && role.quantity() == Some(wanted);
        parts.iter().filter(is).count()
    };
    let is_turned = TURN.map(of_board).iter().sum::<usize>() == 3;
    let is_shifted = COORDINATES.map(of_board).iter().sum::<usize>() == 3;
    let by_quaternion = (0..4).all(|at| {
        let quantity = Some(Quantity::Orientation(at));
        let mut parts = parts.iter();
        parts.any(|(role, own)| !own && role.quantity() == quantity)
    });
    if !is_shifted || is_turned == by_quaternion {
        context.ask_for(&grid, "tvec_x, tvec_y, tvec_z, rvec_x, rvec_y, rvec_z");
        return None;
    }
    let columns = context.columns(&grid, parts.iter().map(|part| part.0).collect());
    let own = context.found.columns.iter_mut().zip(&parts);
    for (guess, (role, _)) in own.filter(|(_, (_, own))| *own) {
        if let Some(Quantity::Orientation(part)) = role.quantity() {
            guess.meaning = format!("rvec_{}", ["x", "y", "z"][part - 1]);
        }
        guess.confidence = Known::Certain;
    }
    let Some(camera) = context.reading.options.get(CAMERA).cloned() else {
        let says = text!(
            "the poses turn the board's coordinates into the camera's, and it is not stated which of the two moves"
        );
        context.ask(About::Own(CAMERA), says, &["fixed", "on-tool"]);
        return None;
    };
    let mut columns = columns?;
    into_tool_poses(context, &mut columns, is_turned, camera == "on-tool")?;
    Some(columns)
}

/// What a heading says, and whether that is a component of the board's rotation vector or translation.
fn part(heading: &str) -> (Role, bool) {
    let plain = heading.trim().trim_matches('"').to_lowercase();
    let (words, unit) = words_and_unit(&plain);
    let joined = words.concat();
    let axis = |prefixes: [&str; 3]| {
        let rest = prefixes
            .iter()
            .find_map(|prefix| joined.strip_prefix(prefix))?;
        [["x", "0"], ["y", "1"], ["z", "2"]]
            .iter()
            .position(|names| names.contains(&rest))
    };
    if let Some(at) = axis(["rvec", "rotationvector", "r"]) {
        return match unit {
            None | Some(Word::Unit(Unit::Angle(1.0))) => (fixed(TURN[at], Unit::Fixed), true),
            // OpenCV writes radians: anything else is not understood.
            Some(_) => (Role::Kept, false),
        };
    }
    if let Some(at) = axis(["tvec", "translation", "t"]) {
        return match unit {
            None => (Role::Known(COORDINATES[at], None), true),
            Some(Word::Unit(unit @ Unit::Length(_))) => (fixed(COORDINATES[at], unit), true),
            Some(_) => (Role::Kept, false),
        };
    }
    let is_image = matches!(
        joined.as_str(),
        "image" | "filename" | "file" | "frame" | "view"
    );
    let role = if is_image && words.len() == 1 {
        Role::Point
    } else {
        understand(heading)
    };
    (role, false)
}

/// Makes poses of the tool of what was seen.
fn into_tool_poses(
    context: &mut ReadContext<'_>,
    columns: &mut Columns,
    is_turned: bool,
    is_on_tool: bool,
) -> Option<()> {
    let places = columns.places()?;
    if is_turned {
        // The rotation vector stands in the last three parts.
        columns.put(Column::made(
            Quantity::Orientation(0),
            Unit::Fixed,
            vec![0.0; places.len()],
        ));
    }
    let turns = columns.orientations()?;
    let mut unseen = 0;
    let seen = places.into_iter().zip(turns).map(|(place, turn)| {
        let rotation = if is_turned {
            let vector = turn.imag();
            let is_sound = vector.norm().is_finite();
            is_sound.then(|| UnitQuaternion::from_scaled_axis(vector))
        } else {
            let is_sound = turn.norm().is_finite() && turn.norm() > 0.0;
            is_sound.then(|| UnitQuaternion::from_quaternion(turn))
        };
        let is_there = place.coords.norm().is_finite();
        let seen = rotation.filter(|_| is_there);
        unseen += usize::from(seen.is_none());
        let camera_from_board = Isometry3::from_parts(place.into(), seen?);
        Some(if is_on_tool {
            camera_from_board.inverse()
        } else {
            camera_from_board
        })
    });
    let poses: Vec<Option<Isometry3<f64>>> = seen.collect();
    if unseen > 0 {
        let found = text!(
            "the board was not seen in {unseen} of {poses} images",
            unseen,
            poses = poses.len()
        );
        context.warn(found, Text::default());
    }
    let missing = || (Point3::from([f64::NAN; 3]), Quaternion::from([f64::NAN; 4]));
    let parts =
        |pose: &Isometry3<f64>| (pose.translation.vector.into(), pose.rotation.into_inner());
    let parts = poses
        .iter()
        .map(|pose| pose.as_ref().map_or_else(missing, parts));
    let (places, turns): (Vec<Point3<f64>>, Vec<Quaternion<f64>>) = parts.unzip();
    columns.put_places(&places);
    columns.put_orientations(&turns);
    say_frame(context, columns, is_on_tool);
    Some(())
}

/// The frame is that of the camera or of the board: one that was not aligned with the base.
fn say_frame(context: &mut ReadContext<'_>, columns: &mut Columns, is_on_tool: bool) {
    let (note, frame) = if is_on_tool {
        (
            text!(
                "poses are those of the camera on the tool, in the frame of the board, taken from p_camera = R p_board + t"
            ),
            "board",
        )
    } else {
        (
            text!(
                "poses are those of the board on the tool, in the frame of the camera, taken from p_camera = R p_board + t"
            ),
            "camera",
        )
    };
    context.note(note);
    columns.name_all(Quantity::Setup, frame);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_understood_as_people_write_them() {
        let turn = |at: usize| (fixed(TURN[at], Unit::Fixed), true);
        for (heading, meant) in [
            ("rvec_x", turn(0)),
            ("rvec[2]", turn(2)),
            ("rvec1", turn(1)),
            ("rx", turn(0)),
            ("rvec_y [rad]", turn(1)),
            ("tvec_z_m", (fixed(Quantity::Z, Unit::Length(1000.0)), true)),
            ("tvec_x [mm]", (fixed(Quantity::X, Unit::Length(1.0)), true)),
            ("tz", (Role::Known(Quantity::Z, None), true)),
            ("image", (Role::Point, false)),
            ("rvec_x [deg]", (Role::Kept, false)),
            ("rms", (Role::Kept, false)),
            ("qw", (fixed(Quantity::Orientation(0), Unit::Fixed), false)),
        ] {
            assert_eq!(part(heading), meant, "{heading}");
        }
    }
}
