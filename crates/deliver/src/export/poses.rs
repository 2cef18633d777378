//! The poses over which a table or a description is compared with the model.

use crate::compensation::Compensation;
use crate::compensation::conditions::Side;
use crate::effects::Inputs;
use crate::kinematics::Range;

use super::Job;

/// Poses over which what stays is stated, per joint.
pub(super) const POSES: usize = 181;

/// Poses that fill the measured range, once for each reflector: evenly for one joint; for several, points of a lattice that
/// fills the box evenly (Korobov; the golden ratio's powers, Roberts 2018).
pub fn measured_poses(job: &Job) -> Inputs<'static> {
    poses(job, Side::Forward)
}

/// The same poses, every joint coming from this side.
pub(super) fn poses(job: &Job, side: Side) -> Inputs<'static> {
    let compensation = Compensation::new(job.calibration);
    let measured = &job.calibration.measured;
    let joints = measured.len();
    let share = |joint: usize, k: usize| {
        if joints == 1 {
            k as f64 / (POSES - 1) as f64
        } else {
            let stride = ratio(joints).powf(-(joint as f64 + 1.0));
            (0.5 + (k as f64 + 1.0) * stride).fract()
        }
    };
    let column = |(joint, range): (usize, &Range)| -> Vec<f64> {
        let at = |k: usize| range.from + (range.to - range.from) * share(joint, k);
        (0..POSES).map(at).collect()
    };
    let homes = compensation.reflectors_at_home;
    let columns = measured.iter().enumerate().map(column);
    let q = columns.map(|column| column.repeat(homes.len())).collect();
    let targets = (0..homes.len()).flat_map(|target| {
        let target = u32::try_from(target).expect("a session has few reflectors");
        std::iter::repeat_n(target, POSES)
    });
    let targets: Vec<u32> = targets.collect();
    let mut inputs = job.conditions.inputs(q, side, homes);
    inputs.target = Some(targets.into());
    inputs
}

/// The positive root of x^(d+1) = x + 1.
pub(super) fn ratio(dimensions: usize) -> f64 {
    let mut x = 1.5_f64;
    for _ in 0..60 {
        x = (1.0 + x).powf(1.0 / (dimensions as f64 + 1.0));
    }
    x
}
