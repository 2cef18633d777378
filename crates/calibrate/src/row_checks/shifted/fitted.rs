//! The base model fitted to rows that are paired again.

use crate::effects::{Inputs, JointValues, Term, joint_zero, tool_radius};
use crate::fit::problem::Problem;
use crate::fit::spread::places;
use crate::fit::{base_model, fit_without_outliers, free_frames};
use crate::kinematics::JointKind;
use crate::model::{Model, Positions};
use crate::numeric::median;
use crate::sessions::{Session, SessionCorrection};

use super::path::{Path, Points, cost};

/// Rows that a fit looks at; of a long session they are spread evenly.
const MOST_ROWS: usize = 400;
/// Below this a deviation is rounding, mm.
pub(super) const LEAST_SIGMA_MM: f64 = 1e-4;
/// The median length of three coordinates with σ = 1.
pub(super) const MEDIAN_LENGTH: f64 = 1.538;

/// Where the robot is at every command, and what its points leave.
pub(super) struct Fitted {
    pub(super) predicted: Positions,
    /// Scale of a coordinate of the deviations, mm.
    pub(super) sigma_mm: f64,
}

impl Fitted {
    /// What the deviations along a path cost, without the price of its changes.
    pub(super) fn cost_at(&self, points: &Points, path: &Path, sigma_mm: f64) -> f64 {
        let n = points.len();
        let of = |row: usize| {
            let point = path.point_of(row, n);
            let deviation = point.and_then(|p| points.deviation_mm(&self.predicted, row, p));
            cost(deviation, sigma_mm)
        };
        (0..n).map(of).sum()
    }
}

/// `None` where nothing is left to fit.
pub(super) fn fitted(
    session: &Session,
    values: JointValues,
    inputs: &Inputs,
    points: &Points<'_>,
    path: &Path,
) -> Option<Fitted> {
    let n = points.len();
    let some = places(n, MOST_ROWS).map(Some);
    let some: Vec<Option<usize>> = some.collect();
    let part = if path.is_none() && n > MOST_ROWS {
        session.of_rows(&some)
    } else {
        let mut part = session.clone();
        SessionCorrection::PairRows(path.changes.clone()).apply(&mut part);
        if n > MOST_ROWS {
            part.samples.select(&some);
        }
        part
    };
    let model = base(&part, values)?;
    let predicted = model.predict(inputs);
    let left = (0..n).filter_map(|row| {
        let point = path.point_of(row, n)?;
        points.deviation_mm(&predicted, row, point)
    });
    let sigma_mm = median(left)? / MEDIAN_LENGTH;
    Some(Fitted {
        predicted,
        sigma_mm: sigma_mm.max(LEAST_SIGMA_MM),
    })
}

fn base(part: &Session, values: JointValues) -> Option<Model> {
    let mut problem = Problem::new(part, values);
    if problem.samples() == 0 {
        return None;
    }
    if base_model::is_arm(part) {
        let start = base_model::start(part, &problem, |_| true);
        return Some(base_model::fit(&mut problem, &start, true).solution.model);
    }
    let mut terms = vec![Term::absent(joint_zero(), 0, 0.0)];
    let joints = part.robot.joints.as_slice();
    if matches!(joints, [joint] if joint.kind == JointKind::Revolute) {
        terms.push(Term::absent(tool_radius(), 0, 0.0));
    }
    terms.extend(free_frames(part, &problem));
    let start = Model::new(part.robot.clone(), terms);
    Some(fit_without_outliers(&mut problem, &start).model)
}
