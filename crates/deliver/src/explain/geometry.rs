//! The geometry of a robot with several joints: a row for each joint, then the frames of the instrument and of the
//! tool with its targets.

use super::{Block, Detail, Fact};
use crate::effects::{Role, role};
use crate::fit::Estimate;
use crate::present::names::{parameter, word};
use crate::present::numbers::{decimals_of, rounded, with_minus_signs};
use crate::present::table::{Column, Table};
use crate::text::within;
use crate::units::rad_from_deg;

/// The parameters of a joint's row. A joint that slides has its zero in mm.
const COLUMNS: [&[&str]; 5] = [
    &["offset_deg", "offset_mm"],
    &["x_mm"],
    &["y_mm"],
    &["about_x_mrad"],
    &["about_y_mrad"],
];

/// A nanometre: nothing is measured better.
const MOST_DECIMALS: usize = 6;

/// Whether these are the estimates of a robot with several joints.
pub(super) fn is_of_an_arm(estimates: &[Estimate]) -> bool {
    estimates.iter().any(|e| role(e.effect) == Role::JointAxis)
}

/// Whether an estimate is in the table of an arm.
pub(super) fn is_in_table(estimate: &Estimate) -> bool {
    let role = role(estimate.effect);
    role.is_of_every_calibration() && role != Role::ToolRadius
}

/// Whether an estimate is in the row of its joint.
fn is_of_a_joint(estimate: &Estimate) -> bool {
    matches!(role(estimate.effect), Role::JointZero | Role::JointAxis)
}

/// The geometry of an arm. What the samples do not determine is a dash, or a value without an interval where a prior
/// says what they do not.
pub(super) fn geometry(estimates: &[Estimate], detail: Detail) -> Vec<Block> {
    let title = say!("Geometry, ± half of the 95 % interval").to_owned();
    let mut blocks = vec![
        Block::Heading(title),
        Block::Table(joints(estimates, detail)),
    ];
    let places = estimates.iter().filter_map(|one| Some((place(one)?, one)));
    let places: Vec<(String, &Estimate)> = places.collect();
    let tables = [POSITION, TURN].map(|names| frames(&places, names, detail));
    blocks.extend(if detail.brief {
        in_sentences(&places, detail)
    } else {
        tables.into_iter().flatten().collect()
    });
    blocks
}

/// The window's panel is narrow: there intervals are below their values, and units below names.
fn heading(text: &str, detail: Detail) -> Column {
    let below = if detail.units.is_some() { "\n" } else { " " };
    Column::numbers(text.replacen(' ', below, 1))
}

fn joints(estimates: &[Estimate], detail: Detail) -> Table {
    let (_, length) = scaled("mm", detail);
    let in_unit = |name: &str, unit: &str| heading(&format!("{name}, {unit}"), detail);
    let mut table = Table::of([
        Column::words(say!("joint")),
        heading(say!("zero offset"), detail),
        in_unit("x", length),
        in_unit("y", length),
        in_unit(say!("about x"), "mrad"),
        in_unit(say!("about y"), "mrad"),
    ]);
    let last = estimates.iter().filter_map(|e| e.joint).max().unwrap_or(0);
    for joint in 1..=last {
        let own = |names: &[&str]| {
            let mut own = estimates
                .iter()
                .filter(|e| e.joint == Some(joint) && is_of_a_joint(e));
            own.find(|e| names.contains(&e.name))
        };
        let values = COLUMNS.map(|names| {
            own(names).map_or_else(
                || "–".to_owned(),
                |one| {
                    let (value, unit) = cell(one, detail);
                    // The zeros of joints that turn and of joints that slide are in one column.
                    let zero = one.name.starts_with("offset_");
                    let unit = if zero { unit } else { String::new() };
                    match value.split_once(" ± ") {
                        Some((value, half)) if detail.units.is_some() => {
                            format!("{value}{unit}\n±{half}")
                        }
                        _ => value + &unit,
                    }
                },
            )
        });
        table.row([joint.to_string()].into_iter().chain(values));
    }
    table
}

/// What an estimate places: a measuring frame, the tool, one of its targets, a freed place.
fn place(estimate: &Estimate) -> Option<String> {
    Some(
        match (role(estimate.effect), &estimate.setup, &estimate.target) {
            (Role::FreeFrame, Some(setup), _) => say!("measuring frame, setup {setup}", setup),
            (Role::FreeFrame, None, _) => within(say!("Measuring frame")).into_owned(),
            (Role::ToolPlace, _, Some(target)) => say!("target {target}", target),
            (Role::ToolPlace, _, None) => within(say!("Tool position")).into_owned(),
            (Role::ToolTurn, ..) => within(say!("Tool orientation")).into_owned(),
            (Role::Place, ..) => format!(
                "{} {}",
                word(estimate.effect.trim_start_matches("unknown-")),
                estimate.place.as_deref().unwrap_or_default()
            ),
            _ => return None,
        },
    )
}

/// Where a frame is, and how it is turned.
const POSITION: [&str; 3] = ["x_mm", "y_mm", "z_mm"];
const TURN: [&str; 3] = ["about_x_mrad", "about_y_mrad", "about_z_mrad"];

/// The places that have these parameters, a row each.
fn frames(places: &[(String, &Estimate)], names: [&str; 3], detail: Detail) -> Option<Block> {
    let (_, unit) = scaled(parameter(names[0]).1, detail);
    let headings = names.map(|name| format!("{}, {unit}", parameter(name).0));
    let headings = headings.map(|text| heading(&text, detail));
    let mut table = Table::of([Column::words("")].into_iter().chain(headings));
    // As in the table above.
    let narrow = |text: String, from: &str, to: &str| match detail.units {
        Some(_) => text.replacen(from, to, 1),
        None => text,
    };
    for (place, _) in places.iter().filter(|(_, one)| names.contains(&one.name)) {
        let of = |name: &&str| narrow(own_cell(places, place, name, detail), " ± ", "\n±");
        let shown = narrow(place.clone(), ", ", ",\n");
        if table.rows.iter().all(|row| row[0].shown != shown) {
            table.row([shown].into_iter().chain(names.iter().map(of)));
        }
    }
    (!table.rows.is_empty()).then_some(Block::Table(table))
}

fn own_cell(places: &[(String, &Estimate)], place: &str, name: &str, detail: Detail) -> String {
    let mut own = places
        .iter()
        .filter(|(at, one)| at == place && one.name == name);
    own.next()
        .map_or_else(|| "–".to_owned(), |(_, one)| cell(one, detail).0)
}

/// The same for the terminal, each place with its parameters in a line.
fn in_sentences(places: &[(String, &Estimate)], detail: Detail) -> Vec<Block> {
    let mut facts: Vec<Fact> = Vec::new();
    for (place, estimate) in places {
        let (value, unit) = cell(estimate, detail);
        let says = format!("{} {value}{unit}", parameter(estimate.name).0);
        match facts.last_mut().filter(|(name, _)| name == place) {
            Some((_, before)) => *before += &format!("; {says}"),
            None => facts.push((place.clone(), says)),
        }
    }
    let facts = (!facts.is_empty()).then_some(Block::Facts(facts));
    facts.into_iter().collect()
}

/// What a value is multiplied by for the chosen unit, and the unit as it is written behind a number.
fn scaled(unit: &str, detail: Detail) -> (f64, &str) {
    match (unit, detail.units) {
        ("mm", Some(units)) => (units.length_value(1.0), units.length_name()),
        ("°", Some(units)) => (units.angle_value(rad_from_deg(1.0)), units.angle_name()),
        (unit, _) => (1.0, unit),
    }
}

/// A value with half its interval, as many decimals as that carries, and the unit with the blank before it.
fn cell(estimate: &Estimate, detail: Detail) -> (String, String) {
    let (factor, unit) = scaled(parameter(estimate.name).1, detail);
    let unit = match unit {
        "" => String::new(),
        "°" => unit.to_owned(),
        other => format!(" {}", other.trim()),
    };
    let value = factor * estimate.value;
    // Other programs read the terminal's minus signs.
    let shown = |number: String| {
        if detail.brief {
            number
        } else {
            with_minus_signs(&number)
        }
    };
    match estimate.ci95 {
        None if estimate.value == 0.0 => ("–".to_owned(), String::new()),
        // Held where its prior puts it.
        None => (shown(format!("{value:.3}")), unit),
        Some([low, high]) => {
            let half = 0.5 * factor * (high - low);
            // Five of them are beside each other in the window's panel; what is copied has all digits.
            let digits = if detail.units.is_some() { 1 } else { 2 };
            let decimals = if half > 0.0 {
                decimals_of(half, digits).min(MOST_DECIMALS)
            } else {
                MOST_DECIMALS
            };
            let value = rounded(value, decimals);
            (
                shown(format!("{value:.decimals$} ± {half:.decimals$}")),
                unit,
            )
        }
    }
}
