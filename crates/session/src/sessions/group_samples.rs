//! Which samples a group has, and how it is called.

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
        let observed = &samples.observed;
        let named = |column: &Option<Vec<Option<u32>>>| *column.as_ref()?.get(sample)?;
        let index = match self {
            Self::Target => samples.target.as_ref()?.get(sample).copied(),
            Self::Setup => samples.setups.as_ref()?.index.get(sample).copied(),
            Self::Socket => named(&observed.socket),
            Self::Station => named(&observed.station),
            Self::Plane => named(&observed.plane),
            Self::Anchor => named(&observed.anchor),
        };
        index.map(|index| index as usize)
    }

    /// How many of this kind a session has.
    pub fn count(self, session: &Session) -> usize {
        let references = &session.instrument.references;
        match self {
            Self::Target => session.targets.len(),
            Self::Setup => session.samples.setups.as_ref().map_or(0, |s| s.names.len()),
            Self::Socket => references.sockets.len(),
            Self::Station => references.stations.len(),
            Self::Plane => references.planes.len(),
            Self::Anchor => references.anchors.len(),
        }
    }

    /// The name of one of them, as the session has it.
    pub fn name_of(self, session: &Session, index: usize) -> &str {
        let references = &session.instrument.references;
        let name = match self {
            Self::Target => session.targets.get(index).map(|t| &t.name),
            Self::Setup => session
                .samples
                .setups
                .as_ref()
                .and_then(|s| s.names.get(index)),
            Self::Socket => references.sockets.get(index).map(|s| &s.name),
            Self::Station => references.stations.get(index).map(|s| &s.name),
            Self::Plane => references.planes.get(index).map(|p| &p.name),
            Self::Anchor => references.anchors.get(index).map(|a| &a.name),
        };
        name.map_or("", String::as_str)
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
        let own = |index_of: &u32| *index_of as usize == index;
        let in_names = |column: &mut Option<Vec<Option<u32>>>| {
            let rows = column
                .iter_mut()
                .flat_map(|column| column.iter_mut().skip(from));
            rows.flatten().filter(|i| own(i)).for_each(|i| *i = new);
        };
        match self {
            Self::Target => {
                let rows = samples
                    .target
                    .iter_mut()
                    .flat_map(|column| column.iter_mut().skip(from));
                rows.filter(|i| own(i)).for_each(|i| *i = new);
            }
            Self::Setup => {
                let rows = samples
                    .setups
                    .iter_mut()
                    .flat_map(|s| s.index.iter_mut().skip(from));
                rows.filter(|i| own(i)).for_each(|i| *i = new);
            }
            Self::Socket => in_names(&mut samples.observed.socket),
            Self::Station => in_names(&mut samples.observed.station),
            Self::Plane => in_names(&mut samples.observed.plane),
            Self::Anchor => in_names(&mut samples.observed.anchor),
        }
    }

    /// Where one of them is is not known, whatever the session states. Setups are free by other means.
    pub(super) fn free(self, session: &mut Session, index: usize) {
        let references = &mut session.instrument.references;
        match self {
            Self::Setup => {}
            Self::Target => {
                if session.has_placed(index)
                    && let Some(target) = session.targets.get(index)
                {
                    session.instrument.free_targets.push(target.name.clone());
                }
            }
            Self::Socket => {
                if let Some(socket) = references.sockets.get_mut(index) {
                    socket.position_mm = None;
                }
            }
            Self::Station => {
                if let Some(station) = references.stations.get_mut(index) {
                    (station.position_mm, station.attitude) = (None, None);
                }
            }
            Self::Plane => {
                if let Some(plane) = references.planes.get_mut(index) {
                    plane.stated = None;
                }
            }
            Self::Anchor => {
                if let Some(anchor) = references.anchors.get_mut(index) {
                    anchor.position_mm = None;
                }
            }
        }
    }

    /// Whether a session says where one of them is.
    pub fn is_stated(self, session: &Session, index: usize) -> bool {
        let references = &session.instrument.references;
        match self {
            Self::Target => session.has_placed(index),
            Self::Setup => false,
            Self::Socket => references
                .sockets
                .get(index)
                .is_some_and(|s| s.position_mm.is_some()),
            Self::Station => {
                let own = references.stations.get(index);
                own.is_some_and(|s| s.position_mm.is_some() || s.attitude.is_some())
            }
            Self::Plane => references
                .planes
                .get(index)
                .is_some_and(|p| p.stated.is_some()),
            Self::Anchor => references
                .anchors
                .get(index)
                .is_some_and(|a| a.position_mm.is_some()),
        }
    }
}
