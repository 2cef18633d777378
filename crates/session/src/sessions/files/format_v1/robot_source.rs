//! Robots that are given as Denavit–Hartenberg rows, as a URDF or as an MJCF file.
//!
//! All become the one description that the program computes with: screws at the home pose. How they
//! were given stays with them ([`RobotSource`]), so that an export can answer in the same terms; a
//! robot that the program wrote says it under `source`.

use super::robot_parts::{JOINT_KIND, POSE};
use crate::document::kinds::{DEGREES, NUMBER, TEXT};
use crate::document::number::quoted;
use crate::document::object::{Cursor, Kind, Object, written};
use crate::kinematics::{
    DescriptionFormat, DhConvention, DhRow, JointKind, Pose, Robot, RobotSource, robot_from_dh,
    robot_from_file,
};
use crate::text::{Template, Text};

/// The robot of Denavit–Hartenberg rows.
pub(super) fn from_dh(at: &mut Cursor<'_, '_>) -> Option<Robot> {
    let rows = DH_ROWS.read(at.fields, at.node, at.path)?;
    let robot = robot_from_dh("", &rows);
    robot.map_or_else(
        |error| {
            at.error(
                Text::verbatim(error.to_string()),
                text!("rows that a robot can be built from"),
            )
        },
        Some,
    )
}

/// Denavit–Hartenberg rows, as sessions and models say them.
pub const DH_ROWS: Kind<Vec<DhRow>> = Kind {
    expected: phrase!("an array with an object for each joint"),
    read: |at| at.some(&DH_ROW),
    write: |rows| rows.iter().map(DH_ROW.write).collect(),
};

const DH_ROW: Kind<DhRow> = Kind {
    expected: phrase!("an object"),
    read: |at| {
        let blank = DhRow {
            a_mm: 0.0,
            alpha_rad: 0.0,
            d_mm: 0.0,
            theta_rad: 0.0,
            convention: DhConvention::Standard,
            kind: JointKind::Revolute,
        };
        at.object(blank, dh_row)
    },
    write: |row| written(*row, dh_row),
};

fn dh_row(o: &mut Object<'_, '_>, row: &mut DhRow) {
    o.required("a_mm", &mut row.a_mm, &NUMBER);
    o.required("alpha_deg", &mut row.alpha_rad, &DEGREES);
    o.required("d_mm", &mut row.d_mm, &NUMBER);
    o.required("theta_deg", &mut row.theta_rad, &DEGREES);
    o.required("convention", &mut row.convention, &CONVENTION);
    o.usual("kind", &mut row.kind, &JOINT_KIND);
}

const CONVENTION: Kind<DhConvention> = Kind {
    expected: TEXT.expected,
    read: |at| {
        at.one_of(
            &[DhConvention::Standard, DhConvention::Modified],
            convention,
        )
    },
    write: |own| convention(*own).into(),
};

fn convention(own: DhConvention) -> &'static str {
    match own {
        DhConvention::Standard => "standard",
        DhConvention::Modified => "modified",
    }
}

/// What a robot of a file is given as.
pub(super) const FILE: Template = phrase!("an object");

/// The robot between two links of a file, which stands beside the document.
pub(super) fn from_file(at: &mut Cursor<'_, '_>, format: DescriptionFormat) -> Option<Robot> {
    let [file, base, tip] = at.object([const { String::new() }; 3], |o, [file, base, tip]| {
        o.required("file", file, &TEXT);
        o.required("base", base, &TEXT);
        o.required("tip", tip, &TEXT);
    })?;
    let Some(folder) = at.fields.folder() else {
        let found = text!("the file {file}", file = quoted(&file));
        return at.error(found, text!("a robot that needs no other file"));
    };
    let described = folder.join(&file);
    match robot_from_file(&described, Some(format), &base, &tip) {
        Ok(read) => {
            at.fields.also_read.extend(read.files);
            Some(read.robot)
        }
        Err(rejected) => {
            at.fields.also_read.push(described);
            let expected = match format {
                DescriptionFormat::Urdf => text!(
                    "a file ({format}) with a chain from base to tip",
                    format = "URDF"
                ),
                DescriptionFormat::Mjcf => text!(
                    "a file ({format}) with a chain from base to tip",
                    format = "MJCF"
                ),
            };
            at.error::<()>(
                text!("the file {file} cannot be used", file = quoted(&file)),
                expected,
            );
            at.fields.findings.extend(rejected.diagnostics);
            None
        }
    }
}

/// How a robot that is given as joints was described before the program wrote it.
pub(super) fn source(o: &mut Object<'_, '_>, robot: &mut Robot) {
    if !o.given("source") {
        return;
    }
    let joints = robot.joints.len();
    let read = |at: &mut Cursor<'_, '_>| {
        let source = at.object(RobotSource::Axes, described)?;
        let count = match &source {
            RobotSource::Axes => joints,
            RobotSource::Dh { rows, .. } => rows.len(),
            RobotSource::Links(frames) => frames.len(),
        };
        if count != joints && joints > 0 {
            let joints_of = |joints: usize| text!("{joints} joints", joints);
            return at.error(joints_of(count), joints_of(joints));
        }
        Some(source)
    };
    let write =
        |own: &RobotSource| (*own != RobotSource::Axes).then(|| written(own.clone(), described));
    let expected = text!("an object");
    o.with("source", &mut robot.source, expected, read, write);
}

fn described(o: &mut Object<'_, '_>, own: &mut RobotSource) {
    for key in ["dh", "base", "links"] {
        o.know(key);
    }
    if o.is_read() {
        *own = if o.is_given("dh") {
            RobotSource::Dh {
                base_from_first: Pose::identity(),
                rows: Vec::new(),
            }
        } else {
            RobotSource::Links(Vec::new())
        };
    }
    match own {
        RobotSource::Axes => {}
        RobotSource::Dh {
            base_from_first,
            rows,
        } => {
            o.field("dh", rows, &DH_ROWS);
            let says = *base_from_first != Pose::identity();
            o.usual_if(says, "base", base_from_first, &POSE);
        }
        RobotSource::Links(frames) => o.required("links", frames, &FRAMES),
    }
}

const FRAMES: Kind<Vec<Pose>> = Kind {
    expected: phrase!("an array with an object for each joint"),
    read: |at| at.some(&POSE),
    write: |frames| frames.iter().map(POSE.write).collect(),
};
