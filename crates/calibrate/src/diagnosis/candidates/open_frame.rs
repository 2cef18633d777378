//! Whether a free frame of the instrument is determined well enough for the direction of an error to mean anything.
//!
//! Points on one line (two poses in turn, for hours) leave the rotation of the instrument about that line
//! undetermined. The fit takes some rotation, and with a wrong one the drift of one joint looks like that of another,
//! so that three names explain what one did. Displacements along the line do not depend on it.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use crate::decompose::eigen;
use crate::effects::Role;
use crate::fit::base_model;
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::model::Model;
use crate::numeric::median;
use crate::sessions::Group;
use crate::thresholds::{GROSS_SHARE, size_mm};

/// Whether the points of every setup lie as near to a line as the nominal robot is to them in the median: its error
/// turns them by a radian about the line, or more. A gross error is one of the set-up (a home that is off), not of the
/// geometry.
pub(super) fn is_open(problem: &Problem, base: &Model) -> bool {
    let session = problem.session;
    let mut terms = base.terms().iter();
    let is_free = terms.any(|term| term.effect.about().role == Role::FreeFrame);
    if !is_free || problem.observed.is_some() || session.samples.z_mm.is_none() {
        return false;
    }
    let nominal = base_model::nominal(&session.robot, session, problem);
    let lengths = lengths_mm(problem, &nominal);
    let mut setups = BTreeMap::<Option<usize>, Vec<usize>>::new();
    for i in (0..lengths.len()).filter(|i| problem.used[*i]) {
        setups
            .entry(Group::Setup.of(session, i))
            .or_default()
            .push(i);
    }
    let gross_mm = GROSS_SHARE * size_mm(session);
    setups.values().all(|rows| {
        let points = rows.iter().map(|i| session.samples.coordinates(*i).into());
        let off_mm = median(rows.iter().map(|i| lengths[*i]));
        let error_mm = off_mm.unwrap_or(0.0).min(gross_mm);
        from_a_line_mm(&points.collect::<Vec<_>>()) <= error_mm
    })
}

/// Root mean square distance of points from the line that is nearest to them.
fn from_a_line_mm(points: &[Vector3<f64>]) -> f64 {
    let count = points.len() as f64;
    let middle = points.iter().sum::<Vector3<f64>>() / count;
    let spread =
        |sum: Matrix3<f64>, p: &Vector3<f64>| sum + (p - middle) * (p - middle).transpose();
    let spread = points.iter().fold(Matrix3::zeros(), spread) / count;
    let along = eigen(spread).eigenvalues;
    (along.sum() - along.max()).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_no_width_and_a_square_half_of_its_side() {
        let line: Vec<Vector3<f64>> = (0..9)
            .map(|k| Vector3::new(2.0, -1.0, 0.5) * f64::from(k))
            .collect();
        assert!(from_a_line_mm(&line) < 1e-6);
        let corners = [[0.0, 0.0], [0.0, 2.0], [2.0, 0.0], [2.0, 2.0]];
        let square = corners.map(|[x, y]| Vector3::new(x, y, 7.0));
        assert!((from_a_line_mm(&square) - 1.0).abs() < 1e-9);
    }
}
