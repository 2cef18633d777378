//! One kind of measurement.

use crate::effects::{Place, PlaceKind};
use crate::sessions::{Instrument, Session};
use crate::text::{Template, Text};

use super::residual::{Residual, Seen};

/// An angle without a distance counts as many mm as at one metre.
pub const ANGLES_AT_MM: f64 = 1000.0;

/// What of the prediction a kind looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Observable {
    /// Where the target is.
    AtPoint,
    /// How the tool is turned.
    AtAttitude,
}

/// The unit of a kind's residuals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Millimetres.
    Millimetre,
    /// Radians; people read milliradians.
    Radian,
}

impl Unit {
    /// The unit that people read, and how many of it one inner unit is.
    pub fn read(self) -> (&'static str, f64) {
        match self {
            Self::Millimetre => ("mm", 1.0),
            Self::Radian => ("mrad", 1e3),
        }
    }
}

/// The description of a kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AboutKind {
    /// Its name in answers.
    pub name: &'static str,
    /// Its name for people.
    pub title: Template,
    /// What it looks at.
    pub looks: Observable,
    /// The unit of its residuals.
    pub unit: Unit,
    /// Noise that is assumed at first where the session states none, inner units.
    pub usual_sigma: f64,
    /// Whether its residual shows how large things are: a length in mm that is not one between two
    /// unknown places.
    pub shows_length: bool,
    /// Whether what is measured is that the target is at the place: a pose has to bring it there.
    pub holds: bool,
}

impl AboutKind {
    /// Its name in answers where English names by ids, and its name for people elsewhere.
    #[doc(hidden)]
    pub fn in_words(&self) -> Text {
        Text::named(self.name, self.title)
    }
}

/// One kind of measurement.
pub trait Kind: Sync {
    /// Its name, unit and noise.
    fn about(&self) -> &'static AboutKind;

    /// Whether a sample has such a measurement; by default, whether it names its place.
    fn measured(&self, session: &Session, sample: usize) -> bool {
        self.place(session, sample).is_some()
    }

    /// The place that the measurement of a sample refers to, where it refers to one.
    fn place(&self, session: &Session, sample: usize) -> Option<Place> {
        let _ = (session, sample);
        None
    }

    /// Its noise as the session states it, one standard deviation, inner units.
    fn sigma(&self, instrument: &Instrument) -> Option<f64>;

    /// What one inner unit of a residual moves, mm: 1 for a length, for an angle the distance across
    /// which it is seen.
    fn lever_mm(&self, seen: &Seen) -> f64 {
        let _ = seen;
        match self.about().unit {
            Unit::Millimetre => 1.0,
            Unit::Radian => ANGLES_AT_MM,
        }
    }

    /// The residual of the measurement of a sample, and its derivatives.
    fn residual(&self, session: &Session, sample: usize, seen: &Seen) -> Residual;

    /// Writes down what an instrument would show of a sample at this place, when `noise` (inner units,
    /// one for each row) is added. Kinds that measure nothing but that the target is there write only
    /// its name.
    fn show(
        &self,
        session: &mut Session,
        sample: usize,
        place: Option<usize>,
        seen: &Seen,
        noise: [f64; 3],
    );

    /// The same in units of the noise, whose size is `sigma`.
    fn weighed(
        &self,
        session: &Session,
        sample: usize,
        sigma: f64,
        residual: &Residual,
    ) -> Residual {
        let _ = (session, sample);
        let mut by = [[0.0; 3]; 3];
        for (k, row) in by.iter_mut().enumerate() {
            row[k] = 1.0 / sigma;
        }
        residual.mixed(&by, residual.rows)
    }
}

/// The place of a kind that a column of indices names for a sample.
pub(crate) fn named(
    column: Option<&Vec<Option<u32>>>,
    sample: usize,
    kind: PlaceKind,
) -> Option<Place> {
    let index = column?[sample]? as usize;
    Some(Place { kind, index })
}

/// Puts the index of a place into a column of them, which is made where it is missing.
pub(crate) fn put_name(
    column: &mut Option<Vec<Option<u32>>>,
    count: usize,
    sample: usize,
    place: Option<usize>,
) {
    let index = place.and_then(|index| u32::try_from(index).ok());
    column.get_or_insert_with(|| vec![None; count])[sample] = index;
}
