//! From when on a difference counts, as a share of the robot's size or as a ratio: what a robot leaves, a fit, or a mistake
//! of setting up.

/// An error above this share of the robot's size is gross: effects leave less, so that it is of the rows, the set-up or the
/// description. (Derived: a set-up error moves the tool by more than a hundredth of the robot's size; no robot that can be
/// calibrated repeats worse.)
pub(crate) const GROSS_SHARE: f64 = 0.01;
/// The same of an angle: a hundredth of a turn.
pub(crate) const GROSS_TURN_RAD: f64 = GROSS_SHARE * std::f64::consts::TAU;
/// What a robot may leave that was never calibrated, as a share of its size or of the spread of the points. (Measured: of
/// 119 sessions, real, of practice and bundled, no model leaves more than 0.0019.)
pub(crate) const PLAUSIBLE_SHARE: f64 = 0.03;
/// What is corrected falls to less than this share of what it was.
pub(crate) const MENDED_SHARE: f64 = 0.2;
/// RMS errors within this ratio are equal, and the simpler is taken: noise alone moves the RMS of a hundred coordinates by
/// 7 % (1/√(2n)).
pub(crate) const EQUAL: f64 = 1.02;
/// Noise that is so many times what it was said to be is not what it was said to be, if samples enough show it.
/// Calibrated (`hidden_effects verdict`): no false flag in 160 sessions.
pub(crate) const NOTICEABLE: f64 = 1.15;
/// What leaves so many times as much as the best says the same in these samples: noise alone makes the RMS errors of two
/// sets of twenty differ by 13 % (1/√60), and twice that is no difference yet.
pub(crate) const ALIKE: f64 = 1.25;
/// Two figures of the same agree within this ratio: what a fit says of samples and what others show, the spread of the
/// points and that of the robot, values and their limits.
pub(crate) const WITHIN: f64 = 2.0;
/// So many times as large is of another kind.
pub(crate) const FAR: f64 = 5.0;
/// Less than any instrument shows, mm.
pub(crate) const NOTHING_MM: f64 = 1e-3;
/// Samples that are farther off than the others are no accidents beyond this share.
pub(crate) const MOST_WRONG: f64 = 0.1;
/// A half: of an error that is worth a correction, of rows that are more than columns. Of the samples whose error is
/// compared the median …
pub(crate) const HALF: f64 = 0.5;
/// … and, where that shows nothing, all but a tenth: no more than those are ever set aside. Poses of one joint at a time
/// show a mistake of one joint in a sixth of the rows. What so large a share says is said by all.
pub(crate) const NEARLY_ALL: f64 = 1.0 - MOST_WRONG;
/// No joint without limits is calibrated so many turns from its home.
pub(crate) const MOST_TURNS: f64 = 2.0;
/// No joint is calibrated with a zero offset larger than this; its home is a quarter turn off.
pub(crate) const LARGEST_OFFSET_DEG: f64 = 45.0;
/// No link is longer or shorter than it should be by more than this share of the robot's reach; one that is turned inside
/// out stands for half a turn.
pub(crate) const LARGEST_STRETCH: f64 = 0.2;
