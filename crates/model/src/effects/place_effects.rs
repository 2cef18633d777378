//! The terms of places, by the kind of place.

use super::place::PlaceKind;
use super::{Effect, Term, UNKNOWN_ANCHOR, UNKNOWN_PLANE, UNKNOWN_SOCKET, UNKNOWN_STATION};

impl PlaceKind {
    pub(super) const ALL: [Self; 4] = [Self::Anchor, Self::Station, Self::Plane, Self::Socket];

    /// As a term of a model.
    pub fn effect(self) -> &'static Effect {
        match self {
            Self::Anchor => &UNKNOWN_ANCHOR,
            Self::Station => &UNKNOWN_STATION,
            Self::Plane => &UNKNOWN_PLANE,
            Self::Socket => &UNKNOWN_SOCKET,
        }
    }

    /// The kind of place that a term is; `None` for an effect of the robot.
    pub fn of(term: &Term) -> Option<Self> {
        let id = term.effect.about().id;
        let mut all = Self::ALL.into_iter();
        all.find(|kind| kind.effect().about().id == id)
    }
}
