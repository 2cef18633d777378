//! What is shown of an answer, without computing any of it, once for terminal, window and report: JSON
//! documents, charts and drawings, names, numbers, and the words for a place.

#[doc(hidden)]
pub mod bins;
pub mod chart;
pub mod compensation_v1;
pub mod decision;
pub mod diagnosis_v1;
pub mod drawing;
pub mod effects_v1;
pub mod history;
pub mod history_v1;
pub mod identification_v1;
pub mod import_v1;
pub mod json;
pub(crate) mod kinds;
#[doc(hidden)]
pub mod limits;
#[doc(hidden)]
pub mod names;
#[doc(hidden)]
pub mod numbers;
mod parts;
pub mod plan_v1;
#[doc(hidden)]
pub mod poses;
pub mod robots_v1;
#[doc(hidden)]
pub mod spectrum;
#[doc(hidden)]
pub mod standards;
pub mod standards_v1;
pub mod table;
pub mod test_cube_v1;
#[doc(hidden)]
pub mod units;
pub mod verification_v1;

pub(crate) mod place;

use crate::kinematics::Robot;

/// Values of joints in degrees or mm.
pub(crate) fn displayed(robot: &Robot, values: &[f64]) -> Vec<f64> {
    let values = robot.joints.iter().zip(values);
    values
        .map(|(joint, value)| joint.kind.to_display(*value))
        .collect()
}
