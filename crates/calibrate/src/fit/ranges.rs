//! Poses all over the joint ranges, where a model has to be valid: spread evenly over the joint limits (an additive
//! recurrence, Roberts 2018), where there are none over the values that were measured.

use crate::budget;
use crate::effects::Inputs;

use super::problem::Problem;

/// Poses over the limits of the joints, on the targets in turn.
pub fn over_the_ranges(problem: &Problem) -> Inputs<'static> {
    let joints = &problem.session.robot.joints;
    let n = joints.len();
    // The positive root of x^(n+1) = x + 1.
    let mut root = 1.5_f64;
    for _ in 0..60 {
        root = (1.0 + root).powf(1.0 / (n as f64 + 1.0));
    }
    let mut step = 1.0;
    let columns = joints.iter().enumerate().map(|(j, joint)| {
        step /= root;
        let values = problem.inputs.q[j].iter().zip(&problem.used);
        let seen = values.filter(|(_, used)| **used).map(|(q, _)| *q);
        let measured = seen.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), q| {
            (a.min(q), b.max(q))
        });
        let (low, high) = joint
            .limits
            .map_or(measured, |range| (range.from, range.to));
        let at = |k: usize| (0.5 + step * (k as f64 + 1.0)).fract();
        (0..budget::OF_A_TRIAL)
            .map(|k| low + (high - low) * at(k))
            .collect()
    });
    let targets = problem.inputs.reflectors_at_home.len();
    at_poses(problem, columns.collect(), |k| k % targets)
}

/// Every reflector at each of these values of joint 1, rad or mm, reflector after reflector; the other
/// joints at 0.
pub fn along_joint(problem: &Problem, values: &[f64]) -> Inputs<'static> {
    let joints = problem.session.robot.joints.len();
    let count = values.len() * problem.inputs.reflectors_at_home.len().max(1);
    let mut columns = vec![vec![0.0; count]; joints];
    if let Some(first) = columns.first_mut() {
        *first = values.iter().copied().cycle().take(count).collect();
    }
    at_poses(problem, columns, |k| k / values.len())
}

/// These poses of the joints, rad or mm, in one setup, with the reflector of each.
fn at_poses(
    problem: &Problem,
    columns: Vec<Vec<f64>>,
    target: impl Fn(usize) -> usize,
) -> Inputs<'static> {
    let count = columns.first().map_or(0, Vec::len);
    let mut inputs = Inputs::at_poses(columns, problem.inputs.reflectors_at_home.clone());
    if let Some(setup) = problem.inputs.setup.as_deref() {
        // The frame that most samples were measured in, or the first.
        let first = (0..setup.len()).find(|i| problem.used[*i]);
        inputs.setup = Some(vec![first.map_or(0.0, |i| setup[i]); count]);
    }
    if problem.inputs.target.is_some() && !inputs.reflectors_at_home.is_empty() {
        let of = |k: usize| u32::try_from(target(k)).unwrap_or(0);
        inputs.target = Some((0..count).map(of).collect());
    }
    inputs
}
