//! What is looked at of an arm's session for what no session states.

use nalgebra::DVector;

use super::fits::fitted;
use super::residuals::Residuals;
use super::rows::RowsInOrder;
use super::thresholds::MOST_SAMPLES;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::base_model;
use crate::sessions::Session;

/// What is found, and the logarithm by which it is likelier than it has to be.
pub(super) type Unstated = (f64, DataProblem);

/// Rows of an arm's session that are looked at, and what the base model leaves of them.
pub(super) struct Examined {
    pub(super) rows: RowsInOrder,
    pub(super) few: Session,
    pub(super) residuals: Residuals,
    /// Root mean square of what is left, mm.
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

    /// Waves of one and two cycles a turn over each joint.
    pub(super) fn waves(&self) -> Vec<DVector<f64>> {
        let orders = [1.0, 2.0].into_iter();
        orders
            .flat_map(|order| self.residuals.waves(&self.few, order))
            .collect()
    }
}
