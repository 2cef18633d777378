//! Which samples a group has, and how it is called.

use super::columns::Quantity;
use super::group::Group;
use super::references::{Anchor, Plane, Socket, Station};
use super::{Samples, Session, Target};

impl Session {
    /// Whether it is known where a target sits in the tool.
    pub fn has_placed(&self, target: usize) -> bool {
        let free = &self.instrument.free_targets;
        self.instrument.targets_sigma_mm.is_some()
            && self
                .targets
                .get(target)
                .is_some_and(|own| !free.contains(&own.name))
    }
}

impl Group {
    /// The kind of this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|group| group.name() == name)
    }

    /// Which of the groups of this kind a sample is in.
    pub fn of(self, session: &Session, sample: usize) -> Option<usize> {
        let samples: &Samples = &session.samples;
        let index = match self {
            Self::Target => samples.target.as_ref()?.get(sample).copied(),
            Self::Setup => samples.setups.as_ref()?.index.get(sample).copied(),
            _ => {
                let mut columns = samples.observed.names().into_iter();
                let own = columns.find(|column| column.label == self.name())?;
                *own.values.as_ref()?.get(sample)?
            }
        };
        index.map(|index| index as usize)
    }

    /// The names of all of this kind that a session has.
    fn names(self, session: &Session) -> Vec<&str> {
        let references = &session.instrument.references;
        match self {
            Self::Target => session.targets.iter().map(|t| &*t.name).collect(),
            Self::Setup => {
                let setups = session.samples.setups.iter();
                setups.flat_map(|s| &s.names).map(String::as_str).collect()
            }
            Self::Socket => references.named(Quantity::Socket),
            Self::Station => references.named(Quantity::Station),
            Self::Plane => references.named(Quantity::Plane),
            Self::Anchor => references.named(Quantity::Anchor),
        }
    }

    /// How many of this kind a session has.
    pub fn count(self, session: &Session) -> usize {
        self.names(session).len()
    }

    /// The name of one of them, as the session has it.
    pub fn name_of(self, session: &Session, index: usize) -> &str {
        self.names(session).get(index).copied().unwrap_or_default()
    }

    /// From this row on the samples of one of them are those of another one, whose place is not known. Where a
    /// target moved, the others keep theirs; an anchor keeps what its instrument adds.
    pub(super) fn split(self, session: &mut Session, index: usize, from: usize) {
        let count = self.count(session);
        let Ok(new) = u32::try_from(count) else {
            return;
        };
        if index >= count {
            return;
        }
        let name = format!("{} moved", self.name_of(session, index));
        let references = &mut session.instrument.references;
        match self {
            Self::Target => {
                let position_mm = session.targets[index].position_mm;
                session.instrument.free_targets.push(name.clone());
                session.targets.push(Target { name, position_mm });
            }
            Self::Setup => session
                .samples
                .setups
                .iter_mut()
                .for_each(|s| s.names.push(name.clone())),
            Self::Socket => references.sockets.push(Socket {
                name,
                position_mm: None,
            }),
            Self::Station => {
                let azimuth = references.stations[index].azimuth;
                references.stations.push(Station {
                    name,
                    position_mm: None,
                    attitude: None,
                    azimuth,
                });
            }
            Self::Plane => references.planes.push(Plane { name, stated: None }),
            Self::Anchor => {
                let offset_mm = references.anchors[index].offset_mm;
                references.anchors.push(Anchor {
                    name,
                    position_mm: None,
                    offset_mm,
                });
            }
        }
        let samples = &mut session.samples;
        let rows: Vec<&mut u32> = match self {
            Self::Target => samples.target.iter_mut().flatten().skip(from).collect(),
            Self::Setup => {
                let setups = samples.setups.iter_mut();
                setups.flat_map(|s| &mut s.index).skip(from).collect()
            }
            _ => {
                let columns = samples.observed.names_mut().into_iter();
                let own = columns.filter(|column| column.label == self.name());
                let cells = own.flat_map(|column| column.values).flatten();
                cells.skip(from).flatten().collect()
            }
        };
        for row in rows.into_iter().filter(|row| **row as usize == index) {
            *row = new;
        }
    }

    /// Where one of them is is not known, whatever the session states. Setups are free by other means.
    pub(super) fn free(self, session: &mut Session, index: usize) {
        let references = &mut session.instrument.references;
        match self {
            Self::Setup => {}
            Self::Target => {
                if session.has_placed(index) {
                    let name = session.targets[index].name.clone();
                    session.instrument.free_targets.push(name);
                }
            }
            Self::Socket => {
                let one = references.sockets.get_mut(index).into_iter();
                one.for_each(|s| s.position_mm = None);
            }
            Self::Station => {
                let one = references.stations.get_mut(index).into_iter();
                one.for_each(|s| (s.position_mm, s.attitude) = (None, None));
            }
            Self::Plane => {
                let one = references.planes.get_mut(index).into_iter();
                one.for_each(|p| p.stated = None);
            }
            Self::Anchor => {
                let one = references.anchors.get_mut(index).into_iter();
                one.for_each(|a| a.position_mm = None);
            }
        }
    }

    /// Whether a session says where one of them is.
    pub fn is_stated(self, session: &Session, index: usize) -> bool {
        let references = &session.instrument.references;
        let is_known = match self {
            Self::Target => Some(session.has_placed(index)),
            Self::Setup => None,
            Self::Socket => (references.sockets.get(index)).map(|s| s.position_mm.is_some()),
            Self::Station => (references.stations.get(index))
                .map(|s| s.position_mm.is_some() || s.attitude.is_some()),
            Self::Plane => (references.planes.get(index)).map(|p| p.stated.is_some()),
            Self::Anchor => (references.anchors.get(index)).map(|a| a.position_mm.is_some()),
        };
        is_known.unwrap_or(false)
    }
}
