//! No name while the error is gross: a residual of more than a hundredth of the robot's size is no effect, but rows, a
//! set-up or a description that is wrong in a way that was not recognised.

use super::base_misfit::residual_mm;
use super::found::SearchResult;
use super::prepare::PreparedSearch;
use crate::thresholds::GROSS_SHARE;

/// Withdraws every name where the error with them is gross.
pub(crate) fn withdraw(prepared: &PreparedSearch, found: &mut SearchResult) {
    let regression = &prepared.regression;
    let several = !regression.added(&found.fit).is_empty() || !found.fit.shapes.is_empty();
    if several && is_gross(residual_mm(prepared, &found.fit), size_mm(prepared)) {
        let base = regression.fit(&regression.base, &[]);
        found.named_effects_only = std::mem::replace(&mut found.fit, base);
        found.base_misfit = true;
        found.other_ends.clear();
    }
}

pub(crate) fn is_gross(residual_mm: f64, size_mm: f64) -> bool {
    size_mm > 0.0 && residual_mm > GROSS_SHARE * size_mm
}

/// How far the tool is from the axes of the robot, the farthest, mm.
pub(crate) fn size_mm(prepared: &PreparedSearch) -> f64 {
    let robot = &prepared.regression.base.robot;
    let tool = robot.base_from_tool.translation.vector;
    let far = robot.joints.iter().map(|joint| {
        let to_tool = tool - joint.axis.point_mm.coords;
        let along = to_tool.dot(&joint.axis.direction);
        (to_tool - along * joint.axis.direction.into_inner()).norm()
    });
    let spread = prepared.problem.session.samples.spread_mm();
    far.fold(spread, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundredth_of_the_size_is_gross() {
        assert!(is_gross(3.3, 320.0));
        assert!(!is_gross(3.1, 320.0));
        assert!(!is_gross(0.0, 0.0) && !is_gross(f64::NAN, 320.0));
    }
}
