//! A smooth correction of what no name explains, as JSON.

use serde::Serialize;

use crate::diagnosis::Unexplained;
use crate::kinematics::JointKind;
use crate::sessions::Session;
use crate::units::deg_from_rad;

/// Null where none was made.
#[derive(Debug, Serialize)]
#[serde(transparent)]
pub(super) struct Answer(Option<Correction>);

impl Answer {
    /// `None` where nobody asked for a correction.
    pub(super) fn of(left: &Unexplained, session: &Session) -> Option<Self> {
        let asked = left.correction.as_ref()?;
        let made = asked.as_ref().ok();
        Some(Self(made.and_then(|c| Correction::of(c, session))))
    }
}

#[derive(Debug, Serialize)]
struct Correction {
    joint: usize,
    gap_before_mm: f64,
    gap_after_mm: f64,
    held_out_before_mm: f64,
    held_out_after_mm: f64,
    held_out: String,
    knots: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    range_deg: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    range_mm: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    period_deg: Option<f64>,
    says: String,
}

impl Correction {
    fn of(c: &crate::diagnosis::Correction, session: &Session) -> Option<Self> {
        let knots = c.curve()?.knots();
        let joint = c.term.joint;
        let turns = session.robot.joints[joint].kind == JointKind::Revolute;
        let range = [knots.from, knots.to];
        Some(Self {
            joint: joint + 1,
            gap_before_mm: c.gap_mm[0],
            gap_after_mm: c.gap_mm[1],
            held_out_before_mm: c.held_out_mm[0],
            held_out_after_mm: c.held_out_mm[1],
            held_out: c.how.clone(),
            knots: knots.count,
            range_deg: turns.then(|| range.map(deg_from_rad)),
            range_mm: (!turns).then_some(range),
            period_deg: knots.period.filter(|_| turns).map(deg_from_rad),
            says: c.says.clone(),
        })
    }
}
