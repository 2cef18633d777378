//! A robot's accuracy as the standards state it, as measured and with corrected commands.
//!
//! - `positioning`: one axis after ISO 230-2, from approaches of the same positions from both
//!   sides; `axis` finds them in a session and takes the axis' deviation from the measured points.
//!   `sweep`: the samples of one series; `table_curve`: what a table corrects along the axis, with its band.
//! - `pose`: pose accuracy and repeatability after ISO 9283.
//! - `test_cube`: the cube, poses and paths that ISO 9283 has a robot measured at.
//! - `path`: path accuracy and repeatability after ISO 9283.
//! - [`crate::present::standards_v1`] is `truepose-standards/1`.
//!
//! Every usable sample counts, suspected outliers too: the standards leave nothing out. Readings
//! without another pose between them are one approach; the first counts. What the session cannot
//! give is named, never guessed.

pub(crate) mod axis;
pub(crate) mod path;
pub(crate) mod pose;
pub(crate) mod positioning;
#[doc(hidden)]
pub mod test_cube;

mod attained;
pub(crate) mod grouping;
mod points;
mod sweep;
mod table_curve;

pub use attained::{Attained, Turned};
pub use axis::{AxisTest, Fixed, Series};
pub use path::{PathAttained, PathFigures};
pub use pose::{Largest, PoseFigures, PoseTest, Variation};
pub use positioning::{AtPosition, Position, Positioning};
pub use table_curve::{CurvePoint, TableCurve};
pub use test_cube::{TestCube, TestPose};

use crate::compensation::verification::VerifyError;
use crate::model::Calibration;
use crate::sessions::Session;
use crate::text::Text;

use points::Points;

/// Figures of ISO 230-2 and ISO 9283, before and after correction, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Standards {
    /// Name of the session.
    pub session: String,
    /// Samples that could be used.
    pub samples: usize,
    /// Samples that could not: a cell is missing, or the reflector was lost.
    pub left_out: usize,
    /// ISO 230-2, axis by axis.
    pub axes: Vec<AxisTest>,
    /// ISO 9283.
    pub poses: PoseTest,
    /// Whether the figures with corrected commands are there.
    pub compensated: bool,
    /// What else there is to say.
    pub notes: Vec<Text>,
}

/// The standards' figures of a session; with a calibration also those with corrected commands.
///
/// # Errors
/// If there is no sample, or the calibration is another robot's.
pub fn standards(
    session: &Session,
    calibration: Option<&Calibration>,
) -> Result<Standards, VerifyError> {
    let session = &*session.whole()?;
    calibration.map_or(Ok(()), Calibration::sound)?;
    let points = Points::new(session, calibration)?;
    let mut usable = points.usable.clone();
    let mut axes = Vec::new();
    for joint in 0..points.robot.joints.len() {
        let (tested, of_axis) = axis(&points, joint, calibration)?;
        axes.push(tested);
        // Along a slide one coordinate is enough.
        for (usable, of_axis) in usable.iter_mut().zip(of_axis) {
            *usable |= of_axis;
        }
    }
    let samples = usable.iter().filter(|u| **u).count();
    let left_out = usable.len() - samples;
    let mut notes = Vec::new();
    if left_out > 0 {
        notes.push(text!(
            one "{count} sample is excluded: a cell is missing, the reflector was lost, or it is excluded by hand",
            "{count} samples are excluded: a cell is missing, the reflector was lost, or they are excluded by hand",
            count = left_out
        ));
    }
    if samples == 0 && axes.iter().all(|axis| axis.series.is_empty()) {
        notes.push(text!(
            "no point was measured (x_mm, y_mm): the figures of both standards are of positions that were measured at commanded ones; distances, directions, sockets and touches alone give none"
        ));
    }
    if session.compensated_by.is_some() {
        notes.push(text!(
            "the session was measured with a table active: the figures are those with compensation, and nothing is compensated a second time"
        ));
    }
    if moving(session) {
        notes.push(text!(
            "samples were taken in motion; the standards measure at standstill, so that lag is in these figures"
        ));
    }
    Ok(Standards {
        session: session.name.clone(),
        samples,
        left_out,
        axes,
        poses: PoseTest::new(&points),
        compensated: points.compensated(),
        notes,
    })
}

/// The tests of one joint, counted from 0, as in [`standards`]: without the others and the poses.
///
/// # Errors
/// As [`standards`].
pub fn axis_test(
    session: &Session,
    calibration: Option<&Calibration>,
    joint: usize,
) -> Result<AxisTest, VerifyError> {
    let session = &*session.whole()?;
    calibration.map_or(Ok(()), Calibration::sound)?;
    let points = Points::new(session, calibration)?;
    axis(&points, joint, calibration).map(|(tested, _)| tested)
}

/// The test of a joint, and the samples that it could use.
fn axis(
    points: &Points<'_>,
    joint: usize,
    calibration: Option<&Calibration>,
) -> Result<(AxisTest, Vec<bool>), VerifyError> {
    let tested = |points: &Points<'_>| (AxisTest::new(points, joint), points.usable.clone());
    match points.along(joint) {
        Some(whole) => Ok(tested(&Points::new(&whole, calibration)?)),
        None => Ok(tested(points)),
    }
}

/// At least so many times, in words.
pub fn at_least(times: usize) -> Text {
    match times {
        0 => text!("never"),
        1 => text!("once or more"),
        2 => text!("twice or more"),
        many => text!("{many} times or more", many),
    }
}

fn moving(session: &Session) -> bool {
    let speeds = session.samples.speed.iter().flatten().flatten();
    speeds.into_iter().any(|v| *v != 0.0 && !v.is_nan())
}
