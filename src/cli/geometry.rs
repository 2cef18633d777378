//! The geometry of a robot with several joints as a person reads it: a row for each joint, then the
//! frames of the instrument and the tool with its targets.

use std::fmt::Write as _;

use crate::effects::{Role, role};
use crate::fit::Estimate;
use crate::present::names::word;
use crate::present::numbers::decimals_of;
use crate::present::table::Table;

/// The parameters of a joint's row. A joint that slides has its zero in mm.
const COLUMNS: [&[&str]; 5] = [
    &["offset_deg", "offset_mm"],
    &["x_mm"],
    &["y_mm"],
    &["about_x_mrad"],
    &["about_y_mrad"],
];

/// Whether these are the estimates of a robot with several joints.
pub(crate) fn is_of_an_arm(estimates: &[Estimate]) -> bool {
    estimates.iter().any(|e| role(e.effect) == Role::JointAxis)
}

/// Whether an estimate stands in the table of an arm.
pub(crate) fn is_in_table(estimate: &Estimate) -> bool {
    let role = role(estimate.effect);
    role.is_of_every_calibration() && role != Role::ToolRadius
}

/// Whether an estimate stands in the row of its joint.
fn is_of_a_joint(estimate: &Estimate) -> bool {
    matches!(role(estimate.effect), Role::JointZero | Role::JointAxis)
}

/// The table; what the samples do not determine is a dash, or a value without an interval where a
/// prior says what they do not.
pub(crate) fn table(estimates: &[Estimate]) -> String {
    let mut table = Table::headed(say!(
        "joint | >zero offset | >x mm | >y mm | >about x mrad | >about y mrad"
    ));
    let last = estimates.iter().filter_map(|e| e.joint).max().unwrap_or(0);
    for joint in 1..=last {
        let own = |names: &[&str]| {
            let mut own = estimates
                .iter()
                .filter(|e| e.joint == Some(joint) && is_of_a_joint(e));
            own.find(|e| names.contains(&e.name))
        };
        let mut cells = vec![joint.to_string()];
        cells.extend(COLUMNS.map(|names| {
            own(names).map_or("–".to_owned(), |e| {
                let unit = match e.name {
                    "offset_deg" => "°",
                    "offset_mm" => " mm",
                    _ => "",
                };
                cell(e, unit)
            })
        }));
        table.row(cells);
    }
    let mut text = format!(
        "{}\n{}",
        say!("geometry, ± half of the 95 % interval"),
        table.aligned(0)
    );
    let mut before: Option<String> = None;
    for estimate in estimates {
        let place = match (role(estimate.effect), &estimate.setup, &estimate.target) {
            (Role::FreeFrame, Some(setup), _) => {
                say!("measuring frame, setup {setup}", setup = setup)
            }
            (Role::FreeFrame, None, _) => say!("measuring frame").to_owned(),
            (Role::ToolPlace, _, Some(target)) => say!("target {target}", target = target),
            (Role::ToolPlace, _, None) => say!("tool position").to_owned(),
            (Role::ToolTurn, ..) => say!("tool orientation").to_owned(),
            (Role::Place, ..) => format!(
                "{} {}",
                word(estimate.effect.trim_start_matches("unknown-")),
                estimate.place.as_deref().unwrap_or_default()
            ),
            _ => continue,
        };
        if before.as_ref() != Some(&place) {
            let _ = write!(text, "{}{place}:", if before.is_some() { "\n" } else { "" });
            before = Some(place);
        }
        let (name, unit) = estimate
            .name
            .rsplit_once('_')
            .unwrap_or((estimate.name, ""));
        let unit = format!(" {unit}");
        let _ = write!(
            text,
            "  {} {}",
            word(&name.replace('_', " ")),
            cell(estimate, &unit)
        );
    }
    if before.is_some() {
        text.push('\n');
    }
    text
}

/// A value with half its interval, as many decimals as that carries.
fn cell(estimate: &Estimate, unit: &str) -> String {
    match estimate.ci95 {
        None if estimate.value == 0.0 => "–".to_owned(),
        // Held where its prior puts it.
        None => format!("{:.3}{unit}", estimate.value),
        Some([low, high]) => {
            let half = 0.5 * (high - low);
            let decimals = if half > 0.0 {
                decimals_of(half, 2).min(6)
            } else {
                6
            };
            format!("{:.decimals$} ± {half:.decimals$}{unit}", estimate.value)
        }
    }
}
