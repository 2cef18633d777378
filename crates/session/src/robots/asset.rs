//! `assets/robots.json`, `truepose-robots/1`: sources by key, and the robots.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::entry::Library;
use super::{LibraryRobot, Reference, RobotKind, Source};
use crate::sessions::parse_robot;

const ASSET: &str = include_str!("../../assets/robots.json");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    format: String,
    sources: BTreeMap<String, SourceEntry>,
    robots: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SourceEntry {
    what: String,
    at: String,
    commit: Option<String>,
    licence: String,
}

/// A source's key, and the place in it.
#[derive(Deserialize)]
struct SourceLocation(String, String);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sources {
    geometry: SourceLocation,
    figures: Option<SourceLocation>,
    gears: Option<SourceLocation>,
    checked_positions: Option<SourceLocation>,
    checked_reach: Option<SourceLocation>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    id: String,
    maker: String,
    model: String,
    kind: String,
    #[serde(default)]
    also: Vec<String>,
    reach_mm: Option<f64>,
    payload_kg: Option<f64>,
    mass_kg: Option<f64>,
    repeatability_mm: Option<f64>,
    #[serde(default)]
    gear_ratios: Vec<f64>,
    note: Option<String>,
    robot: Value,
    sources: Sources,
    not_checked: Vec<String>,
}

pub(super) fn read() -> Library {
    let document: Document =
        serde_json::from_str(ASSET).expect("the bundled robots are a document");
    debug_assert_eq!(document.format, "truepose-robots/1");
    let source = |(key, of): (String, SourceEntry)| {
        let source = Source {
            what: of.what,
            at: of.at,
            commit: of.commit,
            licence: of.licence,
        };
        (key, source)
    };
    Library {
        sources: document.sources.into_iter().map(source).collect(),
        robots: document.robots.into_iter().map(robot).collect(),
    }
}

fn robot(entry: Entry) -> LibraryRobot {
    let loaded = parse_robot(entry.robot.to_string().as_bytes()).expect("a bundled robot is sound");
    let mut robot = loaded.robot;
    for (joint, ratio) in robot.joints.iter_mut().zip(&entry.gear_ratios) {
        joint.gear_ratio = Some(*ratio);
    }
    let kind = RobotKind::ALL
        .into_iter()
        .find(|kind| kind.name() == entry.kind);
    let reference = |SourceLocation(source, place): SourceLocation| Reference { source, place };
    LibraryRobot {
        id: entry.id,
        maker: entry.maker,
        model: entry.model,
        also: entry.also,
        kind: kind.expect("a bundled robot is of a kind"),
        robot,
        reach_mm: entry.reach_mm,
        payload_kg: entry.payload_kg,
        mass_kg: entry.mass_kg,
        repeatability_mm: entry.repeatability_mm,
        gear_ratios: entry.gear_ratios,
        note: entry.note,
        geometry: reference(entry.sources.geometry),
        figures: entry.sources.figures.map(reference),
        gears: entry.sources.gears.map(reference),
        checked_positions: entry.sources.checked_positions.map(reference),
        checked_reach: entry.sources.checked_reach.map(reference),
        not_checked: entry.not_checked,
    }
}
