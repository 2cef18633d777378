//! What an imported session declares of its distances: the anchors.
//!
//! A column of the measured file or of the commands names the anchor of each distance; without one
//! there is a single anchor. Its place comes from the reference points, if one is called like it, and
//! is unknown otherwise; so is the constant offset of the instrument, unless a person says it.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Point3;

use crate::diagnostic::Rejected;
use crate::document::number::quoted;
use crate::importers::columns::{Column, Columns};
use crate::importers::job::Job;
use crate::importers::matching::listed_names;
use crate::importers::role::Role;
use crate::sessions::Anchor;
use crate::sessions::columns::{Quantity, Unit};
use crate::tables::{Cells, Names};
use crate::text::Text;

/// Option: the anchor of all distances.
pub(crate) const ANCHOR: &str = "anchor";
/// Option: what the instrument shows beyond the distance, mm.
pub(crate) const ANCHOR_OFFSET: &str = "anchor-offset";
/// Default name of an anchor.
const UNNAMED: &str = "A";

/// What is named, and which of the places are not known.
pub(super) fn with_unknown(said: Text, unknown: &[String]) -> Text {
    if unknown.is_empty() {
        return said;
    }
    text!(
        "{said}; not known where, and to be fitted: {unknown}",
        said,
        unknown = listed_names(unknown)
    )
}

impl Job<'_> {
    /// Declares the anchors of a session with distances, and completes the column that names them.
    pub(crate) fn anchors(
        &mut self,
        columns: &mut Columns,
        points: &BTreeMap<String, Point3<f64>>,
    ) -> Result<Vec<Anchor>, Rejected> {
        if columns.find(Quantity::Distance).is_none() {
            return Ok(Vec::new());
        }
        let names = self.anchor_names(columns);
        let offset_mm = self.anchor_offset()?;
        let anchors: Vec<Anchor> = names
            .into_iter()
            .map(|name| Anchor {
                position_mm: points.get(&name).copied(),
                name,
                offset_mm,
            })
            .collect();
        let unknown: Vec<String> = anchors
            .iter()
            .filter(|anchor| anchor.position_mm.is_none())
            .map(|anchor| quoted(&anchor.name))
            .collect();
        let sentence = text!(
            one "distances from {count} anchor",
            "distances from {count} anchors",
            count = anchors.len()
        );
        let mut said = with_unknown(sentence, &unknown);
        if offset_mm.is_none() {
            said = text!(
                "{said}; a constant offset of the distances is to be fitted",
                said
            );
        }
        self.note(said.clone());
        self.sentences.push(said);
        Ok(anchors)
    }

    /// The anchors that the samples name; the column is there afterwards.
    fn anchor_names(&self, columns: &mut Columns) -> BTreeSet<String> {
        let rows = columns.rows();
        let is_named = |column: &&mut Column| {
            column.role == Role::Kept && column.name.trim().eq_ignore_ascii_case("anchor")
        };
        if columns.find(Quantity::Anchor).is_none() {
            // Commands are a table of any columns: there it is no more than text.
            if let Some(column) = columns.list.iter_mut().find(is_named) {
                if let Cells::Text(cells) = &column.cells {
                    let mut names = Names::default();
                    for cell in cells {
                        names.push(cell.trim());
                    }
                    column.cells = Cells::Names(names);
                }
                column.role = Role::Known(Quantity::Anchor, Some(Unit::Fixed));
            } else {
                let said = self.reading.options.get(ANCHOR).map(|name| name.trim());
                let name = said.filter(|name| !name.is_empty()).unwrap_or(UNNAMED);
                let mut names = Names::default();
                for _ in 0..rows {
                    names.push(name);
                }
                columns.list.push(Column {
                    name: "anchor".to_owned(),
                    number: 0,
                    role: Role::Known(Quantity::Anchor, Some(Unit::Fixed)),
                    cells: Cells::Names(names),
                });
            }
        }
        let role = Role::Known(Quantity::Anchor, Some(Unit::Fixed));
        let names = columns.texts(role).unwrap_or_default();
        let named = names.into_iter().filter(|name| !name.is_empty());
        named.map(str::to_owned).collect()
    }

    fn anchor_offset(&self) -> Result<Option<f64>, Rejected> {
        let Some(said) = self.reading.options.get(ANCHOR_OFFSET) else {
            return Ok(None);
        };
        match said.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Some(value)),
            _ => {
                let found = text!(
                    "--{option}: {found}",
                    option = ANCHOR_OFFSET,
                    found = quoted(said)
                );
                self.refuse(self.place.clone(), found, text!("a length in mm"))
            }
        }
    }
}
