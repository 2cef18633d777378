//! Robots that are given as Denavit–Hartenberg rows, as a URDF or as an MJCF file.
//!
//! All become the one description that the program computes with: screws at the home pose. How they
//! were given stays with them ([`RobotSource`]), so that an export can answer in the same terms; a
//! robot that the program wrote says it under `source`.

use std::path::Path as FilePath;

use serde::{Deserialize, Serialize};

use super::degrees::degrees;
use super::robot::{Chain, elements, pose};
use crate::kinematics::{
    DescriptionFormat, DhConvention, DhRow, JointKind, Pose, RobotSource, robot_from_dh,
    robot_from_file,
};
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::sessions::number::quoted;
use crate::units::rad_from_deg;

/// The chain of Denavit–Hartenberg rows.
pub(super) fn from_dh(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Chain> {
    let rows = dh_rows(fields, node, path)?;
    match robot_from_dh("", &rows) {
        Ok(robot) => Some(Chain::of(robot)),
        Err(error) => {
            fields.error(
                node.at,
                path,
                error.to_string(),
                "rows that a robot can be built from",
            );
            None
        }
    }
}

fn dh_rows(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Vec<DhRow>> {
    let list = elements(fields, node, path, "an array with an object for each joint")?;
    let rows: Vec<Option<DhRow>> = list
        .iter()
        .enumerate()
        .map(|(index, node)| dh_row(fields, node, &path.index(index)))
        .collect();
    rows.into_iter().collect()
}

fn dh_row(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<DhRow> {
    const KNOWN: [&str; 6] = [
        "a_mm",
        "alpha_deg",
        "d_mm",
        "theta_deg",
        "convention",
        "kind",
    ];
    const CONVENTIONS: &str = "\"standard\" or \"modified\"";
    const KINDS: &str = "\"revolute\" or \"prismatic\"";
    let members = fields.object(
        node,
        path,
        "an object with a_mm, alpha_deg, d_mm, theta_deg",
    )?;
    fields.unknown_keys(members, path, &KNOWN);
    let [a_mm, alpha, d_mm, theta] = [KNOWN[0], KNOWN[1], KNOWN[2], KNOWN[3]]
        .map(|key| fields.required_number(members, node.at, path, key));
    let convention = fields.required(members, node.at, path, "convention", CONVENTIONS)?;
    let convention = match &convention.value {
        Value::Text(text) if text == "standard" => DhConvention::Standard,
        Value::Text(text) if text == "modified" => DhConvention::Modified,
        _ => {
            fields.mismatch(convention, &path.key("convention"), CONVENTIONS);
            return None;
        }
    };
    let kind = match optional(members, "kind") {
        None => JointKind::Revolute,
        Some(node) => match &node.value {
            Value::Text(text) if text == JointKind::Revolute.name() => JointKind::Revolute,
            Value::Text(text) if text == JointKind::Prismatic.name() => JointKind::Prismatic,
            _ => {
                fields.mismatch(node, &path.key("kind"), KINDS);
                return None;
            }
        },
    };
    Some(DhRow {
        a_mm: a_mm?,
        alpha_rad: rad_from_deg(alpha?),
        d_mm: d_mm?,
        theta_rad: rad_from_deg(theta?),
        convention,
        kind,
    })
}

/// The chain between two links of a file, which is named relative to `folder`.
pub(super) fn from_file(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    folder: Option<&FilePath>,
    format: DescriptionFormat,
) -> Option<Chain> {
    let members = fields.object(node, path, "an object with file, base and tip")?;
    fields.unknown_keys(members, path, &["file", "base", "tip"]);
    let [file, base, tip] =
        ["file", "base", "tip"].map(|key| fields.required_text(members, node.at, path, key));
    let (file, base, tip) = (file?, base?, tip?);
    let Some(folder) = folder else {
        let found = format!("the file {}", quoted(&file));
        fields.error(node.at, path, found, "a robot that needs no other file");
        return None;
    };
    let described = folder.join(&file);
    match robot_from_file(&described, Some(format), &base, &tip) {
        Ok(read) => {
            fields.also_read.extend(read.files);
            Some(Chain::of(read.robot))
        }
        Err(rejected) => {
            fields.also_read.push(described);
            let found = format!("the file {} cannot be used", quoted(&file));
            let expected = match format {
                DescriptionFormat::Urdf => "a URDF file with a chain from base to tip",
                DescriptionFormat::Mjcf => "an MJCF file with a chain from base to tip",
            };
            fields.error(node.at, path, found, expected);
            fields.findings.extend(rejected.diagnostics);
            None
        }
    }
}

/// How a robot that is given as joints was described before the program wrote it.
pub(super) fn source(
    fields: &mut Fields<'_>,
    members: &[Member],
    path: &Path<'_>,
    joints: usize,
) -> Option<RobotSource> {
    let Some(node) = optional(members, "source") else {
        return Some(RobotSource::Axes);
    };
    let path = &path.key("source");
    let members = fields.object(node, path, "an object with dh or links")?;
    fields.unknown_keys(members, path, &["dh", "base", "links"]);
    let read = if let Some(dh) = optional(members, "dh") {
        let base = optional(members, "base").map(|node| pose(fields, node, &path.key("base")));
        RobotSource::Dh {
            base_from_first: base.unwrap_or_else(|| Some(Pose::identity()))?,
            rows: dh_rows(fields, dh, &path.key("dh"))?,
        }
    } else {
        let expected = "an array with a frame for each joint";
        let links = fields.required(members, node.at, path, "links", expected)?;
        let path = &path.key("links");
        let list = elements(fields, links, path, expected)?;
        let frames = list.iter().enumerate();
        let frames: Vec<Option<Pose>> = frames
            .map(|(index, node)| pose(fields, node, &path.index(index)))
            .collect();
        RobotSource::Links(frames.into_iter().collect::<Option<_>>()?)
    };
    let count = match &read {
        RobotSource::Axes => joints,
        RobotSource::Dh { rows, .. } => rows.len(),
        RobotSource::Links(frames) => frames.len(),
    };
    if count != joints {
        let found = format!("a source of {count} joints");
        fields.error(node.at, path, found, format!("one of {joints} joints"));
        return None;
    }
    Some(read)
}

/// [`RobotSource`] as the program writes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum SourceTwin {
    Dh {
        dh: Vec<RowTwin>,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        base: Option<FrameTwin>,
    },
    Links {
        links: Vec<FrameTwin>,
    },
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct RowTwin {
    a_mm: f64,
    alpha_deg: f64,
    d_mm: f64,
    theta_deg: f64,
    convention: String,
    kind: String,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct FrameTwin {
    position_mm: [f64; 3],
    quaternion_wxyz: [f64; 4],
}

impl SourceTwin {
    pub(crate) fn of(source: &RobotSource) -> Option<Self> {
        match source {
            RobotSource::Axes => None,
            RobotSource::Dh {
                base_from_first,
                rows,
            } => Some(Self::Dh {
                dh: rows.iter().map(RowTwin::of).collect(),
                base: (*base_from_first != Pose::identity())
                    .then(|| FrameTwin::of(base_from_first)),
            }),
            RobotSource::Links(frames) => Some(Self::Links {
                links: frames.iter().map(FrameTwin::of).collect(),
            }),
        }
    }
}

impl RowTwin {
    /// A row in the terms of the session's file.
    pub(crate) fn of(row: &DhRow) -> Self {
        Self {
            a_mm: row.a_mm,
            alpha_deg: degrees(row.alpha_rad),
            d_mm: row.d_mm,
            theta_deg: degrees(row.theta_rad),
            convention: match row.convention {
                DhConvention::Standard => "standard".to_owned(),
                DhConvention::Modified => "modified".to_owned(),
            },
            kind: row.kind.name().to_owned(),
        }
    }
}

impl FrameTwin {
    /// A pose as the session's file writes the tool.
    pub(crate) fn of(frame: &Pose) -> Self {
        let turn = frame.rotation.quaternion();
        Self {
            position_mm: frame.translation.vector.into(),
            quaternion_wxyz: [turn.w, turn.i, turn.j, turn.k],
        }
    }
}
