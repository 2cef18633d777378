//! What stands in a legend.

use super::items::{Item, Mark, Place};
use super::tint::{Stroke, Tint};

/// A name in a legend, with its sign: points to the right and up of its middle.
#[derive(Debug, Clone)]
pub(crate) struct LegendEntry {
    pub(crate) name: String,
    pub(crate) sign: Vec<Item>,
    /// Points.
    pub(crate) wide: f32,
}

/// Width of the sign of a mark or a line, points.
pub(crate) const SIGN: f32 = 14.0;

impl LegendEntry {
    fn new(name: impl Into<String>, sign: Item) -> Self {
        Self {
            name: name.into(),
            sign: vec![sign],
            wide: SIGN,
        }
    }

    /// A piece of a line.
    pub(crate) fn line(name: impl Into<String>, stroke: Stroke) -> Self {
        Self::new(name, Item::Line(across(), stroke))
    }

    pub(crate) fn mark(name: impl Into<String>, mark: Mark) -> Self {
        Self::new(name, Item::Mark(mark))
    }

    /// A part of a band.
    pub(crate) fn band(name: impl Into<String>, ink: Tint) -> Self {
        let corners = [[-7.0, -4.0], [7.0, -4.0], [7.0, 4.0], [-7.0, 4.0]];
        let corners = corners.map(|[x, y]| Place::from([x, y, 0.0]));
        Self::new(name, Item::Area(corners.to_vec(), Some(ink), None))
    }
}

/// The ends of a line in a legend.
fn across() -> Vec<Place> {
    [-7.0, 7.0].map(|x| Place::from([x, 0.0, 0.0])).to_vec()
}
