//! Mistakes of setting up, as changes of the session that take them back.
//!
//! Each is mechanical: applied to the samples it makes them read as if the mistake had not been
//! made. The diagnosis tries them as hypotheses, and the window offers the one that it believed.

use super::Group;
use crate::text::Template;

/// A day, s.
#[doc(hidden)]
pub const DAY_S: f64 = 86_400.0;

/// A gradian, degrees: a full turn has 400.
pub const GRADIAN_DEG: f64 = 0.9;

/// An axis whose scale is off by less than this share has an error of its own, which an effect names …
#[doc(hidden)]
pub const SCALE_FAR_FROM_ONE: f64 = 0.1;

/// … and one that moves more than so many times what it is told, or less than such a part of it, was told something
/// else: units of angles and lengths begin at ten, gradians apart.
#[doc(hidden)]
pub const LARGEST_SCALE: f64 = 5.0;

/// A full turn, degrees.
pub const TURN_DEG: f64 = 360.0;

/// Units in which the values of a joint that slides may be written, mm.
pub const TRAVEL_UNITS_MM: [(f64, Template); 4] = [
    (10.0, phrase!("centimetres")),
    (1000.0, phrase!("metres")),
    (25.4, phrase!("inches")),
    (0.001, phrase!("micrometres")),
];

/// What was done to samples in memory since they were read.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrected {
    /// The corrections, in the order in which they were made.
    pub by: Vec<SessionCorrection>,
    /// Hash of the samples as they are in the file.
    pub raw_hash: String,
}

/// A change that takes a mistake back.
#[derive(Debug, Clone, PartialEq)]
pub enum SessionCorrection {
    /// The values of a joint (counted from 0) times this: −1 for a sign, π/180 for a unit.
    ScaleJoint {
        /// The joint, counted from 0.
        joint: usize,
        /// What its values are multiplied by.
        factor: f64,
    },
    /// The values of every joint that turns times this: π/180 for a unit.
    ScaleJoints {
        /// What their values are multiplied by.
        factor: f64,
    },
    /// Two joints (counted from 0) change places.
    ExchangeJoints {
        /// One.
        first: usize,
        /// The other.
        second: usize,
    },
    /// The value of a joint (counted from 0) and so many times that of another: a parallelogram.
    CoupleJoint {
        /// The joint, counted from 0.
        joint: usize,
        /// The other one, counted from 0.
        from: usize,
        /// How much of it is added.
        factor: f64,
    },
    /// The values read back become the commanded ones.
    TakeReadBack,
    /// The commanded and read-back values of a joint and this.
    TurnHome {
        /// The joint, counted from 0.
        joint: usize,
        /// What is added, rad.
        by_rad: f64,
    },
    /// The measured coordinates times this.
    ScaleLengths(f64),
    /// One of the measured coordinates times this: 1000 for metres.
    ScaleCoordinate {
        /// Which of x, y, z, counted from 0.
        axis: usize,
        /// What it is multiplied by.
        factor: f64,
    },
    /// The measured column that now stands at place `order[k]` becomes the k-th of x, y, z.
    Reorder([usize; 3]),
    /// The measuring frame is free: all samples in one setup.
    FreeFrame,
    /// The instrument's distances were too long by so much at a time, and less and less so.
    Settle {
        /// At that time, mm.
        by_mm: f64,
        /// That time, s.
        from_s: f64,
        /// The time in which it falls to 1/e, s.
        tau_s: f64,
    },
    /// A line of sight was bent by this times its length squared, measuring frame, 1/mm.
    StraightenSight([f64; 3]),
    /// Gravity is this, base frame, m/s².
    TurnGravity([f64; 3]),
    /// Without these samples, counted from 0 in ascending order.
    Remove(Vec<usize>),
    /// Rows are paired again with the points that belong to them. From each row (counted from 0, in
    /// ascending order) on the point of a row is that of so many rows below it (negative: above), up to
    /// the next; rows without a point of their own lose it. What the controller and the clock say
    /// stays where it is.
    PairRows(Vec<(usize, isize)>),
    /// The recorded speeds of a joint (counted from 0) times this: −1 for a sign, π/180 for a unit.
    ScaleSpeed {
        /// The joint, counted from 0.
        joint: usize,
        /// What its speeds are multiplied by.
        factor: f64,
    },
    /// The loads times this: 0.001 for grams.
    ScaleLoad(f64),
    /// The temperatures times `factor`, and `offset`: kelvin, or degrees Fahrenheit.
    ConvertTemperature {
        /// °C per unit.
        factor: f64,
        /// What is added then, °C.
        offset: f64,
    },
    /// From each of these samples (counted from 0, in ascending order) on the clock is a day later: it shows the
    /// time of day.
    ContinueClock(Vec<usize>),
    /// The instrument's noise has this besides along x, y and z, mm: what was rounded away.
    WidenNoise([f64; 3]),
    /// A target sits elsewhere in the tool than the session says: its place and this, tool frame, mm.
    MoveTarget {
        /// The target, counted from 0.
        target: usize,
        /// What is added to its place, mm.
        by_mm: [f64; 3],
    },
    /// Where the targets sit in the tool is not known: their places are fitted.
    FreeTargets,
    /// The orientations are of no use: only positions are.
    LeaveOutOrientations,
    /// The targets' places are those at home in the base frame: they are turned into the tool's.
    TargetsFromBase,
    /// The directions of approach of two joints (counted from 0) change places.
    ExchangeDirections {
        /// One.
        first: usize,
        /// The other.
        second: usize,
    },
    /// The directions of approach of every joint are reversed.
    TurnDirections,
    /// How well the targets' own places are known at most, mm.
    TargetsWithin(f64),
    /// The samples of these rows, in ascending order, are those of these targets; all counted from 0.
    RenameTargets(Vec<(usize, u32)>),
    /// From this row on the samples of a socket, a target, a setup… are those of another one, whose place is not
    /// known: it was moved.
    Split {
        /// What was moved.
        group: Group,
        /// Which of them, counted from 0.
        index: usize,
        /// The first row of the new one, counted from 0.
        from: usize,
    },
    /// A correction of some rows alone: from each first one up to and without each second (counted from 0, in ascending
    /// order). A free measuring frame is one of their own.
    InRows {
        /// Which rows.
        rows: Vec<(usize, usize)>,
        /// What is done to them.
        by: Box<SessionCorrection>,
    },
    /// A target, a socket, a station, a plane or an anchor is not where the session says: its place is fitted.
    Free {
        /// What it is.
        group: Group,
        /// Which of them, counted from 0.
        index: usize,
    },
}
