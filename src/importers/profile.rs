//! What was said about one file, remembered for the next of its kind: `truepose-import-profile/1`.
//!
//! ```json
//! { "format": "truepose-import-profile/1", "as": "csv", "unit": "mm", "angle_unit": "rad",
//!   "columns": [ { "heading": "polaris_position_x", "is": "x_mm" }, … ],
//!   "commands": [ { "heading": "shoulder", "is": "q1_rad" }, … ],
//!   "options": { "euler": "zyx-moving" } }
//! ```
//!
//! Columns are found again by their headings, wherever they are; columns without headings by their
//! place. What is said on the command line comes before what the profile says.

use crate::text::Text;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::by_heading::ByHeading;
use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::document::number::quoted;
use crate::importers::formats::{IMPORTERS, find};
use crate::importers::role::Role;
use crate::importers::settings::{ColumnGuess, Reading};
use crate::importers::units::{AngleUnit, LengthUnit};
use crate::importers::{Imported, Matching};
use crate::tables::Separator;
use crate::tables::decimals::Decimal;

const FORMAT: &str = "truepose-import-profile/1";

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ColumnJson {
    #[serde(default)]
    heading: String,
    is: String,
}

/// See the module. Everything but the format may be missing.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    format: String,
    #[serde(rename = "as", default, skip_serializing_if = "Option::is_none")]
    kind: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unit: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    angle_unit: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    decimal: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    separator: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    header: Option<u64>,
    #[serde(rename = "match", default, skip_serializing_if = "Option::is_none")]
    matching: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    z_up: bool,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    in_measuring_order: bool,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    names: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    columns: Vec<ColumnJson>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    commands: Vec<ColumnJson>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    options: BTreeMap<String, String>,
}

const SEPARATORS: [(&str, Separator); 4] = [
    ("tab", Separator::Tab),
    ("semicolon", Separator::Semicolon),
    ("comma", Separator::Comma),
    ("spaces", Separator::Spaces),
];

impl Profile {
    /// Reads a profile.
    ///
    /// # Errors
    /// What is no profile, with its place.
    pub fn parse(bytes: &[u8], place: &Place) -> Result<Self, Rejected> {
        let read: Result<Self, serde_json::Error> = serde_json::from_slice(bytes);
        let profile = read.map_err(|error| {
            let place = match error.line() {
                0 => place.clone(),
                line => place
                    .clone()
                    .at_line(line as u64)
                    .at_column(error.column() as u64),
            };
            let text = error.to_string();
            let found = text.split(" at line ").next().unwrap_or_default();
            let found = Text::verbatim(found);
            Rejected::because(Diagnostic::error(
                place,
                found,
                text!("an import profile ({format})", format = FORMAT),
            ))
        })?;
        profile.checked(place)
    }

    fn checked(self, place: &Place) -> Result<Self, Rejected> {
        let refuse = |field: &str, found: &str, expected: Text| {
            let place = place.clone().in_field(field);
            Err(Rejected::because(Diagnostic::error(
                place,
                Text::verbatim(quoted(found)),
                expected,
            )))
        };
        if self.format != FORMAT {
            return refuse("format", &self.format, Text::verbatim(FORMAT));
        }
        let is_known = |value: &Option<String>, known: &[&str]| {
            value
                .as_ref()
                .is_none_or(|value| known.contains(&value.as_str()))
        };
        let kinds: Vec<&str> = IMPORTERS.iter().map(|importer| importer.id).collect();
        let separators = SEPARATORS.map(|(name, _)| name);
        let fields: [(&str, &Option<String>, &[&str]); 6] = [
            ("as", &self.kind, &kinds),
            ("unit", &self.unit, &["mm", "m", "in"]),
            ("angle_unit", &self.angle_unit, &["deg", "rad"]),
            ("decimal", &self.decimal, &[".", ","]),
            ("separator", &self.separator, &separators),
            ("match", &self.matching, &["order", "time", "name"]),
        ];
        for (field, value, known) in fields {
            if !is_known(value, known) {
                let value = value.as_deref().unwrap_or_default();
                return refuse(field, value, Text::verbatim(known.join(", ")));
            }
        }
        if self.joint == Some(0) {
            return refuse("joint", "0", text!("a joint, counted from 1"));
        }
        for column in self.columns.iter().chain(&self.commands) {
            let word = column.is.trim();
            // A format may have words of its own for its columns; these are judged with the file.
            let own = self.kind.as_deref().and_then(find).is_some_and(|kind| {
                matches!(kind.asks.columns, crate::importers::Meanings::Own(_))
            });
            if word != "auto" && !own && Role::from_word(word).is_none() {
                return refuse(
                    "columns",
                    word,
                    text!(
                        "name, group, -, auto, or a session's columns such as x, x_mm, q1_deg, time_s"
                    ),
                );
            }
        }
        Ok(self)
    }

    /// Puts into a reading what the profile says and the reading leaves open.
    pub fn complete(&self, reading: &mut Reading) {
        let unit = self.unit.as_deref().and_then(|unit| {
            LengthUnit::ALL
                .into_iter()
                .find(|known| known.symbol() == unit)
        });
        reading.unit = reading.unit.or(unit);
        reading.angle_unit = reading.angle_unit.or(match self.angle_unit.as_deref() {
            Some("rad") => Some(AngleUnit::Radians),
            Some(_) => Some(AngleUnit::Degrees),
            None => None,
        });
        reading.decimal = reading.decimal.or(match self.decimal.as_deref() {
            Some(",") => Some(Decimal::Comma),
            Some(_) => Some(Decimal::Point),
            None => None,
        });
        let separator = self.separator.as_deref().and_then(|separator| {
            let known = SEPARATORS.into_iter().find(|(name, _)| *name == separator);
            known.map(|(_, separator)| separator)
        });
        reading.separator = reading.separator.or(separator);
        reading.header = reading.header.or(self.header);
        reading.kind = reading.kind.or_else(|| self.kind.as_deref().and_then(find));
        if reading.names.is_empty() {
            reading.names.clone_from(&self.names);
        }
        reading.z_up |= self.z_up;
        if reading.joint == 0 {
            reading.joint = self.joint.unwrap_or(1) - 1;
        }
        reading.by_heading = of_twins(&self.columns);
        let known = reading.kind.map_or(&[][..], |kind| kind.options);
        for option in known {
            if let Some(said) = self.options.get(option.name) {
                reading
                    .options
                    .entry(option.name)
                    .or_insert_with(|| said.clone());
            }
        }
    }

    /// The format, as `--as` takes it.
    pub fn kind(&self) -> Option<&str> {
        self.kind.as_deref()
    }

    /// How commands find their measurements.
    pub fn matching(&self) -> Option<Matching> {
        let named = |matching: &Matching| Some(matching.id()) == self.matching.as_deref();
        [Matching::Order, Matching::Time, Matching::Name]
            .into_iter()
            .find(named)
    }

    /// Whether rows are in measuring order.
    pub fn in_measuring_order(&self) -> bool {
        self.in_measuring_order
    }

    /// What the columns of commands are.
    pub fn commands(&self) -> ByHeading {
        of_twins(&self.commands)
    }

    /// What was said for an import, and found out in it: the next file of this kind needs no more.
    pub fn of(
        imported: &Imported,
        reading: &Reading,
        matching: Option<Matching>,
        in_measuring_order: bool,
    ) -> Self {
        let found = &imported.inspection;
        let table = found.kind.is_some_and(|kind| kind.asks.table);
        let fixed = found
            .kind
            .is_some_and(|kind| kind.asks.columns == crate::importers::Meanings::Fixed);
        Self {
            format: FORMAT.to_owned(),
            kind: found.kind.map(|kind| kind.id.to_owned()),
            unit: reading.unit.map(|unit| unit.symbol().to_owned()),
            angle_unit: reading.angle_unit.map(|unit| unit.symbol().to_owned()),
            decimal: reading.decimal.map(|decimal| match decimal {
                Decimal::Comma => ",".to_owned(),
                Decimal::Point => ".".to_owned(),
            }),
            separator: reading.separator.and_then(|separator| {
                let known = SEPARATORS
                    .into_iter()
                    .find(|(_, known)| *known == separator);
                known.map(|(name, _)| name.to_owned())
            }),
            header: reading.header,
            matching: matching.map(|matching| matching.id().to_owned()),
            joint: (reading.joint > 0).then(|| reading.joint + 1),
            z_up: reading.z_up,
            in_measuring_order,
            names: reading.names.clone(),
            columns: if table && !fixed {
                column_json(&found.columns)
            } else {
                Vec::new()
            },
            commands: column_json(&imported.commands_columns),
            options: reading
                .options
                .iter()
                .map(|(name, said)| ((*name).to_owned(), said.clone()))
                .collect(),
        }
    }

    /// The profile as JSON.
    pub fn written(&self) -> String {
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        text + "\n"
    }
}

fn of_twins(columns: &[ColumnJson]) -> ByHeading {
    ByHeading {
        columns: columns
            .iter()
            .map(|column| (column.heading.clone(), column.is.clone()))
            .collect(),
    }
}

fn column_json(columns: &[ColumnGuess]) -> Vec<ColumnJson> {
    let twin = |column: &ColumnGuess| ColumnJson {
        heading: column.heading.clone(),
        is: column.meaning.clone(),
    };
    columns.iter().map(twin).collect()
}
