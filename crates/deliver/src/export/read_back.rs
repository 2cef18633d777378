//! What a written table says when it is read again, and the RMS error that it leaves.

use std::borrow::Cow;

use super::sheet::{Sheet, TURN};
use crate::compensation::SortedTable;
use crate::compensation::with_table::{gap_to_robot, gap_with_table, gap_without_table};
use crate::diagnostic::Place;
use crate::fit::gap::Spread;
use crate::kinematics::{JointKind, Robot};
use crate::model::Calibration;
use crate::sessions::Session;
use crate::units::{deg_from_rad, rad_from_deg};

/// A table as its reader has it: in the user's unit (degrees or mm), one column for each side,
/// linear between the entries, the end values held outside or the whole repeated after a turn.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadBack {
    /// Joint, counted from 0.
    pub joint: usize,
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// Correction while moving to larger values.
    pub forward: SortedTable,
    /// Correction while moving to smaller values.
    pub reverse: SortedTable,
    /// Where it begins anew: first place and length of a period, in the user's unit.
    pub period: Option<[f64; 2]>,
}

impl ReadBack {
    /// From columns; `None` where they are no table.
    pub fn new(
        joint: usize,
        kind: JointKind,
        commanded: &[f64],
        forward: Vec<f64>,
        reverse: Vec<f64>,
    ) -> Option<Self> {
        Some(Self {
            joint,
            kind,
            forward: SortedTable::new(commanded.to_vec(), forward)?,
            reverse: SortedTable::new(commanded.to_vec(), reverse)?,
            period: None,
        })
    }

    /// The sheet as a reader without rounding would have it.
    pub(super) fn of_sheet(sheet: &Sheet) -> Option<Self> {
        let (forward, reverse) = (sheet.forward.clone(), sheet.reverse.clone());
        let read = Self::new(sheet.joint, sheet.kind, &sheet.places, forward, reverse)?;
        Some(read.repeating(sheet.repeats))
    }

    /// The same, beginning anew after a turn.
    pub(super) fn repeating(mut self, repeats: bool) -> Self {
        let first = self.forward.places().first();
        self.period = first.filter(|_| repeats).map(|from| [*from, TURN]);
        self
    }

    /// What is added to a command in the user's unit; the mean of both columns where the side (+1,
    /// −1) is unknown (0).
    pub fn correction_outer(&self, commanded: f64, side: f64) -> f64 {
        let commanded = match self.period {
            Some([from, length]) => from + (commanded - from).rem_euclid(length),
            None => commanded,
        };
        if side > 0.0 {
            self.forward.at(commanded)
        } else if side < 0.0 {
            self.reverse.at(commanded)
        } else {
            0.5 * (self.forward.at(commanded) + self.reverse.at(commanded))
        }
    }

    /// The same in inner units.
    pub fn correction(&self, commanded: f64, side: f64) -> f64 {
        match self.kind {
            JointKind::Revolute => {
                rad_from_deg(self.correction_outer(deg_from_rad(commanded), side))
            }
            JointKind::Prismatic => self.correction_outer(commanded, side),
        }
    }
}

/// A session that an export can be held against: of a robot with as many joints, measured without a table, and
/// such that it and the model can be computed with.
fn measured<'s>(calibration: &Calibration, session: &'s Session) -> Option<Cow<'s, Session>> {
    let same = session.robot.joints.len() == calibration.model.robot.joints.len();
    let without = session.compensated_by.is_none();
    let session = (same && without).then(|| session.whole())?.ok()?;
    calibration.sound().is_ok().then_some(session)
}

/// The gap that the table leaves on a session that was measured without it, mm; `None` where no
/// sample can be used, the session is of another robot, or either cannot be computed with.
pub fn gap_left(calibration: &Calibration, session: &Session, table: &ReadBack) -> Option<Spread> {
    let session = measured(calibration, session)?;
    let correction = |q: f64, side: f64| table.correction(q, side);
    gap_with_table(calibration, &session, table.joint, correction)
}

/// The RMS error of a session without any table, mm; `None` as for [`gap_left`].
pub fn gap_without(calibration: &Calibration, session: &Session) -> Option<Spread> {
    gap_without_table(calibration, &*measured(calibration, session)?)
}

/// The gap between a session and another description of the robot, mm: what a simulation or a
/// controller with this geometry would leave. `None` as for [`gap_left`].
pub fn gap_to(calibration: &Calibration, session: &Session, robot: &Robot) -> Option<Spread> {
    let session = measured(calibration, session)?;
    let same = calibration.model.robot.joints.len() == robot.joints.len();
    let usable = same && robot.out_of_range(&Place::default()).is_empty();
    usable.then(|| gap_to_robot(calibration, &session, robot))?
}
