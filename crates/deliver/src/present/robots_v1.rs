//! `truepose-robot-list/1`: robots of the library, as JSON.

use super::json::{Json, keyed, list, object, optional};
use crate::robots::{LibraryRobot, Reference, Source, source};

/// The document of these robots, with the sources that they name.
pub fn document(robots: &[&LibraryRobot]) -> Json {
    let mut keys: Vec<&str> = robots.iter().flat_map(|robot| references(robot)).collect();
    keys.sort_unstable();
    keys.dedup();
    let sources = keys
        .into_iter()
        .filter_map(|key| Some((key, of_source(source(key)?))));
    object! {
        "format": "truepose-robot-list/1",
        "robots": list(robots, |robot| entry(robot)),
        "sources": keyed(sources),
    }
}

fn references(robot: &LibraryRobot) -> Vec<&str> {
    let optional = [
        &robot.sources.figures,
        &robot.sources.gears,
        &robot.sources.checked_positions,
        &robot.sources.checked_reach,
    ];
    let optional = optional.into_iter().flatten();
    let all = std::iter::once(&robot.sources.geometry).chain(optional);
    all.map(|reference| reference.source.as_str()).collect()
}

fn of_source(source: &Source) -> Json {
    object! {
        "what": source.what.as_str(),
        "at": source.at.as_str(),
        "commit": optional(source.commit.as_deref()),
        "licence": source.licence.as_str(),
    }
}

fn entry(robot: &LibraryRobot) -> Json {
    let at = |reference: &Reference| -> Json {
        object! { "source": reference.source.as_str(), "place": reference.place.as_str() }
    };
    let at_some = |reference: &Option<Reference>| reference.as_ref().map_or(Json::Absent, at);
    object! {
        "name": robot.id.as_str(),
        "maker": robot.maker.as_str(),
        "model": robot.model.as_str(),
        "kind": robot.kind.name(),
        "joints": robot.robot.joint_count(),
        "reach_mm": robot.reach_mm,
        "payload_kg": robot.payload_kg,
        "mass_kg": robot.mass_kg,
        "repeatability_mm": robot.repeatability_mm,
        "gear_ratios": optional(robot.gear_ratios.as_slice()),
        "note": optional(robot.note.as_deref()),
        "geometry": at(&robot.sources.geometry),
        "figures": at_some(&robot.sources.figures),
        "gears": at_some(&robot.sources.gears),
        "checked_positions": at_some(&robot.sources.checked_positions),
        "checked_reach": at_some(&robot.sources.checked_reach),
        "not_checked": list(&robot.not_checked, |what| what.as_str().into()),
    }
}

/// A figure as it is published, without needless zeros; a dash where there is none.
pub fn figure(value: Option<f64>) -> String {
    let shortest = |value: f64| {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    value.map_or("–".to_owned(), shortest)
}
