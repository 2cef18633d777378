//! Thresholds of set-up errors.

pub(super) use crate::budget::{OF_A_CHOICE as FEW_SAMPLES, OF_A_TRIAL as MOST_SAMPLES};
pub(super) use crate::thresholds::{EQUAL, GROSS_SHARE, GROSS_TURN_RAD, PLAUSIBLE_SHARE, size_mm};

/// With fewer samples a set-up error cannot be distinguished from an effect.
pub(super) const FEWEST_SAMPLES: usize = 6;
/// The logarithm by which a place or a part of the rows that differs has to make the samples likelier, its own place
/// paid for.
pub(super) const EVIDENCE: f64 = 30.0;
/// The error has to fall to less than this share.
pub(super) const CORRECTED_SHARE: f64 = 0.2;
/// No joint is calibrated with a zero offset larger than this; its home is a quarter turn off.
pub(super) const LARGEST_OFFSET_DEG: f64 = 45.0;
/// No link is longer or shorter than it should be by more than this share of the robot's reach; one that is turned
/// inside out is equivalent to half a turn.
pub(super) const LARGEST_STRETCH: f64 = 0.2;
/// The share of the samples whose error is compared: the median …
pub(super) const HALF: f64 = 0.5;
/// … and, where that shows nothing, all but a tenth: no more than those are ever set aside. Poses of one joint at a time
/// show a mistake of one joint in a sixth of the rows.
pub(super) const NEARLY_ALL: f64 = 0.9;
/// The logarithm by which an unusual set-up has to be likelier than the one that a session states: a thousand times,
/// where one session in a hundred has it (a robot on a wall that the session states on the floor, a station in other
/// air).
pub(super) const LIKELIER: f64 = 11.5;
/// Points within this are the same, mm.
pub(super) const SAME_MM: f64 = 0.5;
/// A robot that goes farther has moved, and a point that is nearer to a reflector is its, mm.
pub(super) const MOVED_MM: f64 = 3.0;
