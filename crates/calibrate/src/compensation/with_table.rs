//! The residuals of a session with corrected commands and tables: positions that are reached with them, compared with
//! the model without.

use crate::effects::{Inputs, JointValues};
use crate::fit::gap::Spread;
use crate::fit::problem::Problem;
use crate::lanes::{add_scaled, minus};
use crate::model::{Calibration, Model, Positions};
use crate::sessions::Session;

use super::conditions::Conditions;
use super::plan::Compensation;
use super::verification::{
    VerifyError, is_own, measured_minus, model_for, same_robot, where_the_model_is,
};

/// How far corrected commands would move each of a session's points from where they were measured,
/// mm: reached − model. `None` for a session that was compensated already.
///
/// # Errors
/// If the session's robot is another one.
pub fn moved_by_correction(
    calibration: &Calibration,
    session: &Session,
) -> Result<Option<Positions>, VerifyError> {
    let mut notes = same_robot(calibration, session)?;
    if session.compensated_by.is_some() {
        return Ok(None);
    }
    let problem = Problem::new(session, JointValues::Commanded);
    let compensation = Compensation::new(calibration);
    let full = model_for(calibration, session, &problem, &mut notes);
    let model = where_the_model_is(&compensation, &full, &problem.inputs, None);
    Ok(Some(moved(&compensation, &problem.inputs, &model)))
}

/// Reached with the table for the reference conditions − where the model is, mm.
pub(super) fn moved(compensation: &Compensation, inputs: &Inputs, model: &Positions) -> Positions {
    let table = Conditions::default().impose_on(inputs);
    let corrections = compensation.joint_corrections(&table);
    let mut reached = compensation.reached(inputs, &corrections);
    for i in 0..inputs.len() {
        let [x, y, z] = minus(reached.get(i), model.get(i));
        (reached.x_mm[i], reached.y_mm[i], reached.z_mm[i]) = (x, y, z);
    }
    reached
}

/// How far the table moves poses of a calibration's own session, mm: reached − model, as of its samples.
pub fn moved_at(calibration: &Calibration, inputs: &Inputs) -> Positions {
    let compensation = Compensation::new(calibration);
    let model = where_the_model_is(&compensation, &calibration.model, inputs, None);
    moved(&compensation, inputs, &model)
}

/// The RMS error of a session, without excluded samples, to where `expected` has them, as the model's set-up
/// corrections read it; it is given the model as it applies to this session.
fn gap(
    calibration: &Calibration,
    session: &Session,
    expected: impl FnOnce(&Compensation, &Inputs, &Model) -> Vec<[f64; 3]>,
) -> Option<Spread> {
    let own = is_own(calibration, session);
    let session = &*calibration.set_up.applied(session, own);
    let problem = Problem::new(session, JointValues::Commanded);
    let compensation = Compensation::new(calibration);
    let full = model_for(calibration, session, &problem, &mut Vec::new());
    let expected = expected(&compensation, &problem.inputs, &full);
    let residuals = measured_minus(session, &problem, &compensation, |i| expected[i]);
    Spread::of(&residuals.length_mm, |i| problem.usable[i], |_| false)
}

/// The RMS error on a session with a table, `correction` being what the controller adds for a sample of this command
/// and side of one joint, all as the controller counts them (rad or mm). The other joints are not corrected.
pub fn gap_with_table(
    calibration: &Calibration,
    session: &Session,
    joint: usize,
    correction: impl Fn(f64, f64) -> f64,
) -> Option<Spread> {
    if joint >= session.robot.joints.len() {
        return None;
    }
    let (set_up, robot) = (&calibration.set_up, &calibration.model.robot);
    gap(calibration, session, |compensation, inputs, full| {
        let mut corrections = vec![vec![0.0; inputs.len()]; inputs.q.len()];
        let mut sides = vec![0.0; inputs.q.len()];
        for i in 0..inputs.len() {
            let of_model: Vec<f64> = inputs.q.iter().map(|q| q[i]).collect();
            let mut commanded = of_model.clone();
            set_up.to_raw(robot, &mut commanded);
            for (side, dir) in sides.iter_mut().zip(&inputs.dir) {
                *side = dir.as_ref().map_or(0.0, |dir| dir[i]);
            }
            set_up.signs_to_raw(&mut sides);
            commanded[joint] += correction(commanded[joint], sides[joint]);
            set_up.to_model(robot, &mut commanded);
            for ((all, commanded), was) in corrections.iter_mut().zip(commanded).zip(of_model) {
                all[i] = commanded - was;
            }
        }
        let nominal = compensation.nominal.predict(inputs);
        let model = where_the_model_is(compensation, full, inputs, None);
        let reached = compensation.reached(inputs, &corrections);
        shifted(&nominal, &model, &reached)
    })
}

/// The RMS error of the same session without a table.
pub fn gap_without_table(calibration: &Calibration, session: &Session) -> Option<Spread> {
    gap_with_table(calibration, session, 0, |_, _| 0.0)
}

/// The error of another description of the robot, the instrument's own effects being left to it.
pub fn gap_to_robot(
    calibration: &Calibration,
    session: &Session,
    robot: &crate::kinematics::Robot,
) -> Option<Spread> {
    gap(calibration, session, |compensation, inputs, full| {
        let mut inputs_there = inputs.clone();
        let nominal = &calibration.model.robot.base_from_tool;
        for home in &mut inputs_there.reflectors_at_home {
            let in_tool = nominal.inverse_transform_point(&(*home).into());
            *home = (robot.base_from_tool * in_tool).coords.into();
        }
        let there = Model::nominal(robot.clone()).predict(&inputs_there);
        // What the instrument adds to the model it adds to any robot in the same place.
        let own = compensation.robot.predict(inputs);
        shifted(&there, &full.predict(inputs), &own)
    })
}

/// Positions, each by so much elsewhere as `to` is from `from`.
fn shifted(positions: &Positions, to: &Positions, from: &Positions) -> Vec<[f64; 3]> {
    let by = |i: usize| add_scaled(positions.get(i), minus(to.get(i), from.get(i)), 1.0);
    (0..positions.x_mm.len()).map(by).collect()
}
