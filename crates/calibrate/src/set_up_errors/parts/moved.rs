//! The parts that may move while a robot is measured, with their corrections and messages.

use crate::answers::diagnosis::DataProblem;
use crate::kinematics::JointKind;
use crate::sessions::{Session, SessionCorrection};
use crate::text::{angle, length};

use super::gross::corrected_in_numbers;
use crate::set_up_errors::residuals::MOST;
use crate::set_up_errors::rows::RowsInOrder;

/// What moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum What {
    /// The home of a joint.
    Home(usize),
    /// The instrument's support, or the robot: moved and turned.
    Frame,
}

impl What {
    /// The number of parameters of the motion.
    pub(super) fn numbers(self) -> usize {
        match self {
            Self::Home(_) => 1,
            Self::Frame => MOST,
        }
    }
}

/// What moved, a home by so much (rad, mm), from the k-th row that counts on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub(super) what: What,
    pub(super) from: usize,
    pub(super) by: f64,
}

impl Step {
    /// Turns these rows, which were measured before it, or gives them a frame of their own.
    pub(super) fn correction(&self, rows: Vec<(usize, usize)>) -> SessionCorrection {
        let by = Box::new(match self.what {
            What::Home(joint) => SessionCorrection::TurnHome {
                joint,
                by_rad: -self.by,
            },
            What::Frame => SessionCorrection::FreeFrame,
        });
        SessionCorrection::InRows { rows, by }
    }

    pub(super) fn problem(
        &self,
        session: &Session,
        rows: &RowsInOrder,
        before: Vec<(usize, usize)>,
        [before_mm, residual_mm]: [f64; 2],
    ) -> DataProblem {
        let sample = rows.row(self.from) + 1;
        let (what, proposal) = match self.what {
            What::Home(joint) => {
                let by = match session.robot.joints[joint].kind {
                    JointKind::Revolute => angle(self.by, 4),
                    JointKind::Prismatic => length(self.by, 3),
                };
                let joint = joint + 1;
                let what = text!(
                    "the home position of joint {joint} moved by {by} at sample {sample}",
                    joint,
                    by,
                    sample
                );
                let proposal = text!(
                    "the samples before are turned by it, to the home as it is now; look at the encoder's coupling, or at how joint {joint} is homed",
                    joint
                );
                (what, proposal)
            }
            What::Frame => (
                text!(
                    "the robot's base or the instrument moved and turned at sample {sample}",
                    sample
                ),
                text!(
                    "the samples before have a measuring frame of their own; look at the bolts of the base and at the instrument's stand"
                ),
            ),
        };
        let correction = self.correction(before);
        DataProblem {
            samples: (0..self.from).map(|k| rows.row(k)).collect(),
            ..DataProblem::of_all(
                what,
                corrected_in_numbers(before_mm, residual_mm),
                proposal,
                correction,
            )
        }
    }
}
