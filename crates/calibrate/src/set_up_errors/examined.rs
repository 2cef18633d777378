//! The samples of an arm's session in which effects that no session states are searched for, with their residuals.

use nalgebra::DVector;

use super::fits::fitted;
use super::residuals::Residuals;
use super::rows::RowsInOrder;
use super::thresholds::MOST_SAMPLES;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::base_model;
use crate::sessions::Session;

/// What is found, and the logarithm by which its odds exceed the threshold.
pub(super) type Unstated = (f64, DataProblem);

/// Rows of an arm's session that are examined, and their residuals in the base model.
pub(super) struct Examined {
    pub(super) rows: RowsInOrder,
    pub(super) few: Session,
    pub(super) residuals: Residuals,
    /// RMS residual, mm.
    pub(super) rms_mm: f64,
}

impl Examined {
    /// `None` of a single joint, and where points are measured in parts.
    pub(super) fn at(session: &Session, values: JointValues) -> Option<Self> {
        if !base_model::is_arm(session) || !session.has_plain_points() {
            return None;
        }
        let rows = RowsInOrder::of(session, MOST_SAMPLES);
        let few = rows.select(session);
        let (model, rms_mm) = fitted(&few, values)?;
        let residuals =
            Residuals::of(&few, values, &model)?.with_pose_noise(&few, values, &model, &[]);
        Some(Self {
            rows,
            few,
            residuals,
            rms_mm,
        })
    }

    /// Waves of one and two cycles a turn over each joint, and what guides do.
    pub(super) fn waves(&self) -> Vec<DVector<f64>> {
        self.residuals.waves(&self.few, &[1.0, 2.0])
    }
}
