//! What is looked at of an arm's session for what no session states.

use super::left::Left;
use super::parts::RowsInOrder;
use super::thresholds::MOST_SAMPLES;
use crate::effects::JointValues;
use crate::fit::base_model;
use crate::sessions::Session;

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
    pub(super) fn at(session: &Session, values: JointValues) -> Option<Self> {
        if !base_model::is_arm(session) || !session.has_plain_points() {
            return None;
        }
        let rows = RowsInOrder::of(session, MOST_SAMPLES);
        let few = rows.select(session);
        let (left, rms_mm) = Left::after_a_fit(&few, values)?;
        Some(Self {
            rows,
            few,
            left,
            rms_mm,
        })
    }
}
