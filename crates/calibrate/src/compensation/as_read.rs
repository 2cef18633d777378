//! A calibration compared with a session whose values are taken as they were read.

use crate::effects::JointValues;
use crate::fit::base_model;
use crate::fit::gap::{Spread, suspects};
use crate::fit::problem::Problem;
use crate::lanes::minus;
use crate::model::Calibration;
use crate::model::format_v1::model_hash;
use crate::sessions::{Session, hash_of_samples};
use crate::text::Text;

use super::carried_over::carried_over;
use super::plan::Compensation;
use super::remainder::left_over;
use super::set_aside;
use super::verification::{
    Compared, Verification, VerifyError, applied_corrections, counted, held_out_of, measured_minus,
    model_for, where_the_model_is,
};
use super::with_table::moved;

/// The same of a session whose raw values are the model's.
pub(super) fn verify_as_read(
    calibration: &Calibration,
    session: &Session,
    mut notes: Vec<Text>,
) -> Result<Verification, VerifyError> {
    let samples = &session.samples;
    let own = hash_of_samples(session) == calibration.samples_hash;
    // Single coordinates were fitted with the rest; of another session whole points are enough to compare.
    let none_is_whole = || Problem::new(session, JointValues::Commanded).samples() == 0;
    let in_parts = !samples.partly_measured().is_empty() && (own || none_is_whole());
    if !samples.observed.is_empty() || in_parts {
        return super::observed::verify(calibration, session, notes);
    }
    let mut problem = Problem::new(session, JointValues::Commanded);
    let apart = held_out_of(&problem, own);
    problem.fit = counted(&problem, &apart);
    let by = model_hash(calibration);
    let carried = carried_over(calibration, session, &problem, |carried| {
        model_for(carried, session, &problem, &mut Vec::new())
    });
    let calibration = carried.as_ref().map_or(calibration, |(carried, note)| {
        notes.push(note.clone());
        carried
    });
    let inputs = &problem.inputs;
    let compensation = Compensation::new(calibration);
    let nominal = base_model::nominal(&calibration.model.robot, session, &problem);
    let nominal = nominal.predict(inputs);

    let applied = applied_corrections(&by, session, &compensation, inputs, &mut notes);
    let full = model_for(calibration, session, &problem, &mut notes);
    let model = where_the_model_is(&compensation, &full, inputs, applied.as_deref());
    let before = measured_minus(session, &problem, &compensation, |i| nominal.get(i));
    let after = measured_minus(session, &problem, &compensation, |i| model.get(i));
    let outlier = set_aside::of_its_own(calibration, own, problem.usable.len())
        .unwrap_or_else(|| suspects(&problem, &after));
    let with_table = session.compensated_by.is_none().then(|| {
        // measured − model + reached − nominal, as if `nominal` were shifted by the model's error
        let moved = moved(&compensation, inputs, &model);
        let drawn = compensation.nominal.predict(inputs);
        let expected = |i: usize| minus(drawn.get(i), moved.get(i));
        let with_table = measured_minus(session, &problem, &compensation, expected);
        let residuals: Vec<f64> = left_over(&compensation, inputs)
            .iter()
            .map(|v| crate::lanes::dot(*v, *v).sqrt())
            .collect();
        let stays = Spread::of(&residuals, |i| problem.fit[i], |_| false);
        (with_table, stays.map_or(0.0, |s| s.rms_mm))
    });
    let compared = Compared {
        problem: &problem,
        apart: &apart,
        suspected: &outlier,
        tolerance_mm: session.tolerance_mm.or(calibration.tolerance_mm),
        with_table,
    };
    compared.verified(before, after, notes)
}
