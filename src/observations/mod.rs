//! What was measured: one layer between the model and the normal equations.
//!
//! The model predicts where the target is and how the tool is turned, with the derivatives of every
//! coefficient. An observation turns that into residuals (measured − predicted) and their
//! derivatives, in units of their own noise. Effects know nothing of it, and what is measured knows
//! nothing of effects. A session may mix kinds row by row: which columns are filled says what was
//! measured.
//!
//! # To add a kind
//! Write one file like its neighbours in `kinds` and add one line to the register there; the columns it
//! reads are in [`crate::sessions`]. `docs/extending.md` goes through an example.
//!
//! # How it works
//! - [`kinds`](Kind): residual and derivatives of one observation.
//! - `crate::effects::places`: anchors, stations, planes and sockets that are not known are fitted beside the
//!   robot, and reported like everything that is fitted.
//! - `layer`: the observations of a session, `block` by block, as rows for the normal equations;
//!   `streams`: how they flow through the model.
//! - `rows`: the same as rows of a regression, for the search of names.
//! - `gauge`: what no kind at hand can show: where the base stands, how large everything is.
//! - `start`: from where the fit begins.
//! - `figures`: σ of each kind, outliers, errors by kind.
//! - `held`: joint values that bring a target to where it is held.
//!
//! The orientation of the tool is found from four points of it that go through the same model as the
//! target does (its origin and one along each axis), so that every effect turns the tool as it moves
//! it, with exact derivatives, and none has to say how.

pub(crate) mod beside;
pub(crate) mod block;
pub(crate) mod figures;
pub(crate) mod gauge;
pub(crate) mod held;
pub(crate) mod layer;
pub(crate) mod outliers;
pub(crate) mod rows;
pub(crate) mod start;
pub(crate) mod streams;

pub(crate) mod kinds;

use crate::effects::place::MOST;
use crate::effects::{Place, PlaceKind};
use crate::sessions::{Instrument, Session};

pub use block::RowBlock;
pub use figures::{Deviations, Errors, KindFigures};
pub use kinds::KINDS;
pub use layer::Layer;
pub use rows::ObservedRows;
pub use streams::Item;

/// Where an angle has no distance of its own it is as many mm as at one metre.
pub const ANGLES_AT_MM: f64 = 1000.0;

/// What of the prediction a kind looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Looks {
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

/// What is written about a kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AboutKind {
    /// Its name in answers.
    pub name: &'static str,
    /// What it looks at.
    pub looks: Looks,
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

/// What the model says of one sample.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    /// Where the target is, measuring frame, mm.
    pub point: [f64; 3],
    /// How the tool is turned: by rows, from the tool's axes to the measuring frame's.
    pub attitude: [[f64; 3]; 3],
    /// The coefficients of the place that the observation refers to, inner units.
    pub place: &'a [f64],
}

/// One observation beside what the model says.
#[derive(Debug, Clone, Copy)]
pub struct Residual {
    /// Number of rows, 1 to 3.
    pub rows: usize,
    /// Measured − predicted, inner units; as many as there are rows.
    pub left: [f64; 3],
    /// Derivative of what is predicted with respect to the point, row by row, per mm.
    pub by_point: [[f64; 3]; 3],
    /// The same with respect to a small turn of the tool about the measuring frame's axes, rad.
    pub by_turn: [[f64; 3]; 3],
    /// The same with respect to the coefficients of the place.
    pub by_place: [[f64; MOST]; 3],
}

impl Residual {
    /// So many rows, everything zero.
    pub(crate) fn new(rows: usize) -> Self {
        Self {
            rows,
            left: [0.0; 3],
            by_point: [[0.0; 3]; 3],
            by_turn: [[0.0; 3]; 3],
            by_place: [[0.0; MOST]; 3],
        }
    }

    /// The length of what is left, inner units.
    pub fn length(&self) -> f64 {
        self.left.iter().map(|v| v * v).sum::<f64>().sqrt()
    }

    /// The rows mixed: each new row is the sum of the old ones times these factors.
    #[must_use]
    pub(crate) fn mixed(&self, by: &[[f64; 3]; 3], rows: usize) -> Self {
        let mut mixed = Self::new(rows);
        for (to, factors) in by.iter().enumerate().take(rows) {
            for (from, factor) in factors.iter().enumerate().take(self.rows) {
                mixed.left[to] += factor * self.left[from];
                for k in 0..3 {
                    mixed.by_point[to][k] += factor * self.by_point[from][k];
                    mixed.by_turn[to][k] += factor * self.by_turn[from][k];
                }
                for k in 0..MOST {
                    mixed.by_place[to][k] += factor * self.by_place[from][k];
                }
            }
        }
        mixed
    }
}

/// One kind of measurement.
pub trait Kind: Sync {
    /// Its name, unit and noise.
    fn about(&self) -> &'static AboutKind;

    /// Whether a sample has such a measurement; where nothing else says so, if it names its place.
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

    /// What is left of the measurement of a sample, and how that depends on what was seen.
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
