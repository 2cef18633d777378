//! Distances: the log of a telescoping ballbar, a draw-wire or an interferometer.
//!
//! One column is the distance, from the anchor on the table to the target on the tool; time, anchor,
//! load and the like may stand beside it. A log that shows deviations from a nominal length needs
//! that length (`--nominal-length`). Where the anchors are, and whether the instrument shows true
//! distances, the session declares: [`crate::importers::declared`].

use crate::importers::columns::{Column, Columns};
use crate::importers::declared::{ANCHOR, ANCHOR_OFFSET};
use crate::importers::formats::{Importer, KnownBy, OwnOption, Questions};
use crate::importers::headings::{Words, is_among, understand, words_and_unit};
use crate::importers::reader::fixed;
use crate::importers::role::Role;
use crate::importers::settings::{About, ReadContext};
use crate::importers::units::Word;
use crate::sessions::columns::{Quantity, Unit};

const NOMINAL_LENGTH: &str = "nominal-length";

pub(crate) static IMPORTER: Importer = Importer {
    id: "ballbar",
    title: phrase!("a ballbar, a draw-wire or an interferometer: distances"),
    asks: Questions::TABLE,
    options: &[
        OwnOption {
            name: ANCHOR,
            title: phrase!("Anchor"),
            value: "NAME",
            help: phrase!("the anchor of all distances, where no column names it [default: A]"),
            values: &[],
        },
        OwnOption {
            name: ANCHOR_OFFSET,
            title: phrase!("Constant offset"),
            value: "MM",
            help: phrase!(
                "what the instrument shows beyond the true distance, mm: 0 for a calibrated ballbar [default: unknown, and fitted]"
            ),
            values: &[],
        },
        OwnOption {
            name: NOMINAL_LENGTH,
            title: phrase!("Nominal length"),
            value: "MM",
            help: phrase!(
                "the length, mm, that is to be added to every reading of a log of deviations"
            ),
            values: &[],
        },
    ],
    known_by: KnownBy::headed(4),
    read,
};

/// Words for a distance in a heading, and for what is one only together with a nominal length.
const DISTANCE: Words = "distance dist abstand distanz länge laenge length radius range seillänge seilweg ballbar \
                        reading messwert weg";
const DEVIATION: Words = "deviation abweichung extension";

/// Reads the distances.
fn read(context: &mut ReadContext<'_>) -> Option<Columns> {
    let grid = context.grid()?;
    let names = grid.headings();
    let mut found: Vec<(Role, bool)> = names.iter().map(|name| role(name)).collect();
    found.resize(grid.width, (Role::Kept, false));
    let mut roles: Vec<Role> = found.iter().map(|(role, _)| *role).collect();
    if let Some(given) = context.given_roles(&grid, Some(&roles)) {
        roles = given;
    } else if !context.reading.columns.is_empty() {
        return None;
    }
    let is_distance = |role: &Role| role.quantity() == Some(Quantity::Distance);
    let Some(at) = roles.iter().position(is_distance) else {
        context.ask_for(&grid, "distance");
        return None;
    };
    let is_deviation = found[at].1;
    let length_mm = nominal_length(context, is_deviation)?;
    let mut columns = context.columns(&grid, roles)?;
    if length_mm != 0.0
        && let Some(mut values) = columns.numbers(Quantity::Distance)
    {
        for value in &mut values {
            *value += length_mm;
        }
        columns.put(Column::made(Quantity::Distance, Unit::Length(1.0), values));
        context.note(text!(
            "{length_mm} mm were added to every reading, as stated",
            length_mm
        ));
    }
    Some(columns)
}

/// The length to add to every reading, mm. `None`: it is asked, or wrong.
fn nominal_length(context: &mut ReadContext<'_>, is_deviation: bool) -> Option<f64> {
    match context.reading.length_mm(NOMINAL_LENGTH) {
        Ok(None) if is_deviation => {
            let says = text!("the readings are deviations from a length that is not stated");
            context.ask(About::Own(NOMINAL_LENGTH), says, &[]);
            None
        }
        Ok(said) => said.or(Some(0.0)),
        Err((found, expected)) => {
            context.refuse(found, expected);
            None
        }
    }
}

/// What a heading says, and whether that is a deviation from a nominal length.
fn role(heading: &str) -> (Role, bool) {
    let plain = heading.trim().trim_matches('"').to_lowercase();
    let (words, unit) = words_and_unit(&plain);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let one_of = |list| matches!(words[..], [word] | [word, _] if is_among(word, list));
    let is_deviation = one_of(DEVIATION);
    let unit = match unit {
        None => Some(None),
        Some(Word::Unit(unit @ Unit::Length(_))) => Some(Some(unit)),
        Some(_) => None,
    };
    if let (Some(unit), true) = (unit, is_deviation || one_of(DISTANCE)) {
        return (Role::Known(Quantity::Distance, unit), is_deviation);
    }
    let role = match words[..] {
        ["anchor" | "ball" | "mount" | "centre" | "center" | "anker" | "kugel"] => {
            fixed(Quantity::Anchor, Unit::Fixed)
        }
        _ => understand(heading),
    };
    (role, false)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_understood_as_people_write_them() {
        for (heading, meant, is_deviation) in [
            ("distance_mm", "distance_mm", false),
            ("Distance [m]", "distance_m", false),
            ("Länge [mm]", "distance_mm", false),
            ("Radius", "distance", false),
            ("Deviation [um]", "distance_um", true),
            ("Deviation [arcsec]", "-", false),
            ("Time [ms]", "time_ms", false),
            ("anchor", "anchor", false),
            ("remark", "-", false),
        ] {
            let (role, deviation) = role(heading);
            assert_eq!(
                (role.to_string().as_str(), deviation),
                (meant, is_deviation),
                "{heading}"
            );
        }
    }
}
