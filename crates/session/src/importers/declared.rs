//! What an imported session declares beside its samples: anchors, sockets, planes and stations.
//!
//! Columns of the measured file or of the commands name them; where all samples belong to one, an option names it.
//! Their places come from the reference points of the same name, and are unknown, so that they are fitted, where there
//! are none; so is the constant offset of an instrument for distances, unless a person says it.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Point3;

use super::options::{PLANE, SOCKET, SOCKET_DISTANCES};
use crate::diagnostic::Rejected;
use crate::document::number::quoted;
use crate::importers::columns::{COORDINATES, Column, Columns};
use crate::importers::job::Job;
use crate::importers::matching::{BEARABLE, listed, listed_names};
use crate::importers::role::Role;
use crate::importers::settings::wrong_value;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::{Anchor, Azimuth, Group, Plane, References, Socket, SocketDistance, Station};
use crate::tables::{Cells, Names};
use crate::text::Text;

/// Option: the anchor of all distances.
pub(crate) const ANCHOR: &str = "anchor";
/// Option: what the instrument shows beyond the distance, mm.
pub(crate) const ANCHOR_OFFSET: &str = "anchor-offset";

type Points = BTreeMap<String, Point3<f64>>;

impl Job<'_> {
    /// Declares what the samples name, and completes the columns that name it.
    pub(crate) fn references(&mut self, columns: &mut Columns) -> Result<References, Rejected> {
        self.one_for_all(columns, SOCKET, Quantity::Socket);
        self.one_for_all(columns, PLANE, Quantity::Plane);
        let has = |columns: &Columns, quantity| columns.find(quantity).is_some();
        // Beside points a column of the commands that is called `socket` is no more than text.
        if !COORDINATES.into_iter().any(|axis| has(columns, axis)) {
            for quantity in [Quantity::Socket, Quantity::Plane, Quantity::Station] {
                taken_from_commands(columns, quantity);
            }
        }
        if has(columns, Quantity::Distance) {
            taken_from_commands(columns, Quantity::Anchor);
            columns.name_all(Quantity::Anchor, self.stated(ANCHOR).unwrap_or("A"));
        }
        if has(columns, Quantity::Azimuth) {
            columns.name_all(Quantity::Station, "S");
        }
        let named = [Quantity::Distance, Quantity::Socket, Quantity::Azimuth];
        let asks = named.into_iter().any(|quantity| has(columns, quantity));
        let known = match &self.settings.reference {
            Some(companion) if asks => self.named_points(companion)?,
            _ => Points::new(),
        };
        let position_mm = |name: &String| known.get(name).copied();
        let anchors = self.anchors(columns, &known)?;
        let sockets = self.declared(columns, Quantity::Socket, &known);
        let sockets: Vec<Socket> = sockets
            .map(|name| Socket {
                position_mm: position_mm(&name),
                name,
            })
            .collect();
        let planes = self.declared(columns, Quantity::Plane, &Points::new());
        let planes = planes.map(|name| Plane { name, stated: None }).collect();
        let stations = if has(columns, Quantity::Azimuth) {
            let stations = self.declared(columns, Quantity::Station, &known);
            let station = |name: String| Station {
                position_mm: position_mm(&name),
                name,
                attitude: None,
                azimuth: Azimuth::Counterclockwise,
            };
            stations.map(station).collect()
        } else {
            Vec::new()
        };
        let socket_distances = self.socket_distances(&sockets)?;
        Ok(References {
            anchors,
            sockets,
            planes,
            stations,
            socket_distances,
            pointing: None,
        })
    }

    /// The name that an option states.
    fn stated(&self, option: &str) -> Option<&str> {
        let said = self.reading.options.get(option)?.trim();
        (!said.is_empty()).then_some(said)
    }

    /// The column that an option makes: the same name in all rows.
    fn one_for_all(&mut self, columns: &mut Columns, option: &str, quantity: Quantity) {
        let Some(name) = self.stated(option) else {
            return;
        };
        if columns.find(quantity).is_some() {
            self.note(text!("--{option} is not used: a column states it", option));
        } else {
            columns.name_all(quantity, name);
        }
    }

    /// The names in a column, in order; says which they are, and which of the places are not known.
    fn declared(
        &mut self,
        columns: &Columns,
        quantity: Quantity,
        points: &Points,
    ) -> impl Iterator<Item = String> + use<> {
        let names = names_in(columns, quantity);
        if let Some(said) = said(&names, quantity, points) {
            self.say(said);
        }
        names.into_iter()
    }

    fn anchors(&mut self, columns: &Columns, points: &Points) -> Result<Vec<Anchor>, Rejected> {
        if columns.find(Quantity::Distance).is_none() {
            return Ok(Vec::new());
        }
        let stated = self.reading.length_mm(ANCHOR_OFFSET);
        let offset_mm = stated.or_else(|(found, expected)| self.refuse(found, expected))?;
        let names = names_in(columns, Quantity::Anchor);
        let mut said = said(&names, Quantity::Anchor, points).unwrap_or_default();
        if offset_mm.is_none() {
            said = text!(
                "{said}; a constant offset of the distances is to be fitted",
                said
            );
        }
        self.say(said);
        let anchor = |name: String| Anchor {
            position_mm: points.get(&name).copied(),
            name,
            offset_mm,
        };
        Ok(names.into_iter().map(anchor).collect())
    }

    fn socket_distances(&mut self, sockets: &[Socket]) -> Result<Vec<SocketDistance>, Rejected> {
        let Some(said) = self.reading.options.get(SOCKET_DISTANCES) else {
            return Ok(Vec::new());
        };
        let mut all = Vec::new();
        for one in said.split(',').map(str::trim).filter(|one| !one.is_empty()) {
            let place = |name: &str| sockets.iter().position(|socket| socket.name == name.trim());
            let read = one.rsplit_once('=').and_then(|(pair, mm)| {
                let distance_mm: f64 = mm.trim().parse().ok()?;
                // A name may hold the sign itself.
                let between = pair
                    .match_indices('-')
                    .find_map(|(at, _)| Some([place(&pair[..at])?, place(&pair[at + 1..])?]))?;
                let sound =
                    distance_mm.is_finite() && distance_mm > 0.0 && between[0] != between[1];
                sound.then_some(SocketDistance {
                    between,
                    distance_mm,
                })
            });
            let Some(read) = read else {
                let names: Vec<&str> = sockets.iter().map(|socket| socket.name.as_str()).collect();
                let found = wrong_value(SOCKET_DISTANCES, one);
                let expected = text!(
                    "two of the sockets ({names}) and a length in mm, such as S1-S2=400",
                    names = names.join(", ")
                );
                return self.refuse(found, expected);
            };
            all.push(read);
        }
        Ok(all)
    }
}

/// What is named, and which of the places are not known; `None` where nothing is named.
fn said(names: &BTreeSet<String>, quantity: Quantity, points: &Points) -> Option<Text> {
    let group = Group::of_name(&quantity.heading(None))?;
    if names.is_empty() {
        return None;
    }
    let said = listed(names.iter().map(|name| group.called(name)), BEARABLE);
    let unknown = names.iter().filter(|name| !points.contains_key(*name));
    let unknown: Vec<String> = unknown.map(|name| quoted(name)).collect();
    Some(if unknown.is_empty() {
        said
    } else {
        text!(
            "{said}; not known where, and to be fitted: {unknown}",
            said,
            unknown = listed_names(unknown, BEARABLE)
        )
    })
}

/// The names in a column; none where there is no such column.
fn names_in(columns: &Columns, quantity: Quantity) -> BTreeSet<String> {
    let names = columns
        .texts(Role::Known(quantity, Some(Unit::Fixed)))
        .unwrap_or_default();
    let named = names.into_iter().filter(|name| !name.is_empty());
    named.map(str::to_owned).collect()
}

/// Commands are a table of any columns: what they name is taken where the samples need it.
fn taken_from_commands(columns: &mut Columns, quantity: Quantity) {
    let name = quantity.heading(None);
    let is_named = |column: &&mut Column| {
        column.role == Role::Kept && column.name.trim().eq_ignore_ascii_case(&name)
    };
    if columns.find(quantity).is_none()
        && let Some(column) = columns.list.iter_mut().find(is_named)
        && let Cells::Text(cells) = &column.cells
    {
        let mut names = Names::default();
        for cell in cells {
            names.push(cell.trim());
        }
        column.cells = Cells::Names(names);
        column.role = Role::Known(quantity, Some(Unit::Fixed));
    }
}
