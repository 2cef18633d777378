//! Robots that are given as Denavit–Hartenberg rows or as a URDF file.
//!
//! Both become the one description that the program computes with: screws at the home pose.

use std::path::Path as FilePath;

use super::robot::{Chain, elements};
use crate::kinematics::{DhConvention, DhRow, robot_from_dh, robot_from_urdf_file};
use crate::sessions::json::{Fields, Node, Path, Value};
use crate::sessions::number::quoted;
use crate::units::rad_from_deg;

/// The chain of Denavit–Hartenberg rows.
pub(super) fn from_dh(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Chain> {
    let list = elements(fields, node, path, "an array with an object for each joint")?;
    let rows: Vec<Option<DhRow>> = list
        .iter()
        .enumerate()
        .map(|(index, node)| dh_row(fields, node, &path.index(index)))
        .collect();
    let rows: Vec<DhRow> = rows.into_iter().collect::<Option<_>>()?;
    match robot_from_dh("", &rows) {
        Ok(robot) => Some((robot.joints, robot.base_from_tool)),
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

fn dh_row(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<DhRow> {
    const KNOWN: [&str; 5] = ["a_mm", "alpha_deg", "d_mm", "theta_deg", "convention"];
    const CONVENTIONS: &str = "\"standard\" or \"modified\"";
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
    Some(DhRow {
        a_mm: a_mm?,
        alpha_rad: rad_from_deg(alpha?),
        d_mm: d_mm?,
        theta_rad: rad_from_deg(theta?),
        convention,
    })
}

/// The chain between two links of a URDF file, which is named relative to `folder`.
pub(super) fn from_urdf(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    folder: Option<&FilePath>,
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
    let urdf = folder.join(&file);
    fields.also_read.push(urdf.clone());
    match robot_from_urdf_file(&urdf, &base, &tip) {
        Ok(robot) => Some((robot.joints, robot.base_from_tool)),
        Err(rejected) => {
            let found = format!("the file {} cannot be used", quoted(&file));
            fields.error(
                node.at,
                path,
                found,
                "a URDF file with a chain from base to tip",
            );
            fields.findings.extend(rejected.diagnostics);
            None
        }
    }
}
