//! What an imported session declares beside its samples: anchors, sockets, planes and stations.
//!
//! Columns of the measured file or of the commands name them; where all samples belong to one socket
//! or touch one plane, an option names it. Their places come from the reference points of the same
//! name, and are unknown, so that they are fitted, where there are none.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::Point3;

use super::options::{PLANE, SOCKET, SOCKET_DISTANCES};
use crate::diagnostic::Rejected;
use crate::document::number::quoted;
use crate::importers::columns::{Column, Columns};
use crate::importers::distances::with_unknown;
use crate::importers::job::Job;
use crate::importers::role::Role;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::{Azimuth, Plane, Pointing, References, Socket, SocketDistance, Station};
use crate::tables::{Cells, Names};

impl Job<'_> {
    /// Declares what the samples name, and completes the columns that name it.
    pub(crate) fn references(&mut self, columns: &mut Columns) -> Result<References, Rejected> {
        self.one_for_all(columns, SOCKET, Quantity::Socket);
        self.one_for_all(columns, PLANE, Quantity::Plane);
        for (name, quantity) in [
            ("socket", Quantity::Socket),
            ("plane", Quantity::Plane),
            ("station", Quantity::Station),
        ] {
            taken_from_commands(columns, name, quantity);
        }
        let named = [Quantity::Distance, Quantity::Socket, Quantity::Azimuth];
        let asks = named
            .into_iter()
            .any(|quantity| columns.find(quantity).is_some());
        let known = match &self.settings.reference {
            Some(companion) if asks => self.named_points(companion, "reference")?,
            _ => BTreeMap::new(),
        };
        let anchors = self.anchors(columns, &known)?;
        let position_mm = |name: &String| known.get(name).copied();
        let sockets: Vec<Socket> = self
            .declared(columns, Quantity::Socket, &known)
            .into_iter()
            .map(|name| Socket {
                position_mm: position_mm(&name),
                name,
            })
            .collect();
        let planes = self
            .declared(columns, Quantity::Plane, &BTreeMap::new())
            .into_iter()
            .map(|name| Plane { name, stated: None })
            .collect();
        let stations = self.stations(columns, &known);
        let socket_distances = self.socket_distances(&sockets)?;
        Ok(References {
            anchors,
            sockets,
            planes,
            stations,
            socket_distances,
            pointing: columns.directions.map(|directions| Pointing {
                axis: directions.axis,
                stations: None,
            }),
        })
    }

    /// The column that an option makes: the same name in all rows.
    fn one_for_all(&mut self, columns: &mut Columns, option: &str, quantity: Quantity) {
        let said = self
            .reading
            .options
            .get(option)
            .map(|name| name.trim().to_owned());
        let Some(name) = said.filter(|name| !name.is_empty()) else {
            return;
        };
        if columns.find(quantity).is_some() {
            self.note(text!("--{option} is not used: a column states it", option));
            return;
        }
        let mut names = Names::default();
        for _ in 0..columns.rows() {
            names.push(&name);
        }
        columns.list.push(Column {
            name: option.to_owned(),
            number: 0,
            role: Role::Known(quantity, Some(Unit::Fixed)),
            cells: Cells::Names(names),
        });
    }

    /// The names in a column, in order, and says which of them are not known.
    fn declared(
        &mut self,
        columns: &Columns,
        quantity: Quantity,
        points: &BTreeMap<String, Point3<f64>>,
    ) -> BTreeSet<String> {
        let names = names_in(columns, quantity);
        if names.is_empty() {
            return names;
        }
        let unknown = names.iter().filter(|name| !points.contains_key(*name));
        let unknown: Vec<String> = unknown.map(|name| quoted(name)).collect();
        let count = names.len();
        let said = match quantity {
            Quantity::Socket => {
                text!(one "{count} socket is named", "{count} sockets are named", count)
            }
            Quantity::Plane => {
                text!(one "{count} plane is named", "{count} planes are named", count)
            }
            _ => {
                text!(one "{count} station is named", "{count} stations are named", count)
            }
        };
        let said = with_unknown(said, &unknown);
        self.note(said.clone());
        self.sentences.push(said);
        names
    }

    /// Stations of directions; without a column there is one.
    fn stations(
        &mut self,
        columns: &mut Columns,
        points: &BTreeMap<String, Point3<f64>>,
    ) -> Vec<Station> {
        if columns.find(Quantity::Azimuth).is_none() {
            return Vec::new();
        }
        if columns.find(Quantity::Station).is_none() {
            let mut names = Names::default();
            for _ in 0..columns.rows() {
                names.push("S");
            }
            columns.list.push(Column {
                name: "station".to_owned(),
                number: 0,
                role: Role::Known(Quantity::Station, Some(Unit::Fixed)),
                cells: Cells::Names(names),
            });
        }
        let azimuth = columns
            .directions
            .map_or(Azimuth::Counterclockwise, |directions| directions.azimuth);
        let names = self.declared(columns, Quantity::Station, points);
        let stations = names.into_iter().map(|name| Station {
            position_mm: points.get(&name).copied(),
            name,
            attitude: None,
            azimuth,
        });
        stations.collect()
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
                let found = text!(
                    "--{option}: {found}",
                    option = SOCKET_DISTANCES,
                    found = quoted(one)
                );
                let expected = text!(
                    "two of the sockets ({names}) and a length in mm, such as S1-S2=400",
                    names = names.join(", ")
                );
                return self.refuse(self.place.clone(), found, expected);
            };
            all.push(read);
        }
        Ok(all)
    }
}

/// The names in a column; none where there is no such column.
fn names_in(columns: &Columns, quantity: Quantity) -> BTreeSet<String> {
    let names = columns
        .texts(Role::Known(quantity, Some(Unit::Fixed)))
        .unwrap_or_default();
    let named = names.into_iter().filter(|name| !name.is_empty());
    named.map(str::to_owned).collect()
}

/// Commands are a table of any columns: a column `socket` of theirs is no more than text, unless the
/// samples need it.
fn taken_from_commands(columns: &mut Columns, name: &str, quantity: Quantity) {
    let measured = [Quantity::X, Quantity::Y, Quantity::Z];
    let has_points = measured
        .into_iter()
        .any(|quantity| columns.find(quantity).is_some());
    if has_points || columns.find(quantity).is_some() {
        return;
    }
    let is_named = |column: &&mut Column| {
        column.role == Role::Kept && column.name.trim().eq_ignore_ascii_case(name)
    };
    if let Some(column) = columns.list.iter_mut().find(is_named)
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
