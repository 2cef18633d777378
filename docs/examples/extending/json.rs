//! A table as JSON: `{"commanded_deg": […], "correction_forward_deg": […], "correction_reverse_deg": […]}`, numbers
//! with the fewest digits that read back as the same; mm in place of degrees where the joint slides.

use crate::document::{Member, Value, text_of};
use crate::text::Text;

use super::rules::{Directions, EntryMeaning, Rules, Spacing};
use super::sheet::Sheet;
use super::table_file::{Columns, TableFile};
use super::{ExportError, Format, Job};

pub(super) const RULES: Rules = Rules {
    format: "json",
    meaning: EntryMeaning::Correction,
    resolution: None,
    units: ["deg", "mm"],
    per_outer: 1.0,
    spacing: Spacing::Equal,
    widest_step: 1.0,
    most_entries: usize::MAX,
    limit_because: phrase!("it has no limit"),
    directions: Directions::Both,
    repeats: false,
    interpolation: "linear between two places",
    outside: "the first or the last value is held",
    direction: "the forward values while the joint moves to larger ones, the reverse values while it moves to \
                smaller ones; at rest those of the last move",
    full_turn: "the table does not repeat: what is beyond its ends gets the end's value",
    label: None,
};

pub(super) const FORMAT: Format = TableFile::format(
    phrase!("JSON table"),
    "json",
    &TableFile {
        rules: &RULES,
        write,
        read,
        enter: |_, _| Vec::new(),
    },
);

fn keys(sheet: &Sheet) -> [String; 3] {
    let unit = sheet.unit();
    ["commanded", "correction_forward", "correction_reverse"].map(|key| format!("{key}_{unit}"))
}

fn write(_: &Job, sheet: &Sheet, _: &[Text]) -> String {
    let columns = [&sheet.places, &sheet.forward, &sheet.reverse];
    let members = keys(sheet).into_iter().zip(columns);
    let members = members.map(|(key, values)| Member::new(key, values.as_slice()));
    text_of(&Value::Object(members.collect()))
}

fn read(sheet: &Sheet, text: &str) -> Result<Columns, ExportError> {
    let wrong = |what: String| ExportError::ReadBack(what);
    let read: serde_json::Value = serde_json::from_str(text).map_err(|e| wrong(e.to_string()))?;
    let column = |key: &str| -> Option<Vec<f64>> {
        let list = read[key].as_array()?;
        list.iter().map(serde_json::Value::as_f64).collect()
    };
    let columns = keys(sheet).map(|key| column(&key).ok_or_else(|| wrong(format!("no {key}"))));
    let [places, forward, reverse] = columns;
    Ok(Columns {
        places: places?,
        forward: forward?,
        reverse: reverse?,
        repeats: false,
    })
}
