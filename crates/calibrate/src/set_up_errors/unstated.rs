//! What instruments, stations and mountings do that no session states: the likeliest of a list of hypotheses, each a few
//! columns beside the fitted robot and beside what else may look like it.

use nalgebra::DVector;

use super::fits::fitted;
use super::left::Left;
use super::parts::RowsInOrder;
use super::thresholds::MOST_SAMPLES;
use super::{gravity, refraction, settling, station_scale};
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::base_model;
use crate::sessions::Session;

/// What is found, and the logarithm by which it is likelier than it has to be.
pub(super) type Unstated = (f64, DataProblem);

/// Every hypothesis.
const HYPOTHESES: [fn(&Session, JointValues, &Looked) -> Option<Unstated>; 4] = [
    settling::settles,
    refraction::bends,
    station_scale::differs,
    gravity::runs_otherwise,
];

/// Rows of an arm's session that are looked at, and what the base model leaves of them.
pub(super) struct Looked {
    pub(super) rows: RowsInOrder,
    pub(super) few: Session,
    pub(super) left: Left,
    /// Root mean square of what is left, mm.
    pub(super) rms_mm: f64,
}

impl Looked {
    /// `None` of a single joint, and where points are measured in parts.
    fn at(session: &Session, values: JointValues) -> Option<Self> {
        if !base_model::is_arm(session) || !session.has_plain_points() {
            return None;
        }
        let rows = RowsInOrder::of(session, MOST_SAMPLES);
        let few = rows.select(session);
        let (model, rms_mm) = fitted(&few, values)?;
        let left = Left::of(&few, values, &model)?.beside_poses(&few, values, &model, &[]);
        Some(Self {
            rows,
            few,
            left,
            rms_mm,
        })
    }

    /// Waves of one and two cycles a turn over each joint.
    pub(super) fn waves(&self) -> Vec<DVector<f64>> {
        let orders = [1.0, 2.0].into_iter();
        orders
            .flat_map(|order| self.left.waves(&self.few, order))
            .collect()
    }
}

/// The likeliest of them.
pub(super) fn likeliest(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let Some(looked) = Looked::at(session, values) else {
        return Vec::new();
    };
    let found = HYPOTHESES
        .iter()
        .filter_map(|of| of(session, values, &looked));
    let best = found.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, problem)| problem).into_iter().collect()
}
