//! A calibration beside a session whose values are taken as they were read.

use crate::effects::JointValues;
use crate::fit::base_model;
use crate::fit::gap::{Deviations, Spread, suspects};
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
    Compensated, Trimmed, Verification, VerifyError, WithinTolerance, applied_corrections, counted,
    held_out, held_out_of, measured_minus, model_for, moved, where_the_model_is,
};

/// The same of a session whose raw values are the model's.
pub(super) fn verify_as_read(
    calibration: &Calibration,
    session: &Session,
    mut notes: Vec<Text>,
) -> Result<Verification, VerifyError> {
    let samples = &session.samples;
    let own = hash_of_samples(session) == calibration.samples_hash;
    // Single coordinates were fitted with the rest; of another session whole points are enough to judge by.
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
    let spread = |d: &Deviations| Spread::of(&d.length_mm, |i| problem.fit[i], |_| false);
    let tolerance = session.tolerance_mm.or(calibration.tolerance_mm);
    let within = |d: &Deviations, mm: f64| {
        let lengths = d.length_mm.iter().zip(&problem.fit);
        lengths.filter(|(l, counts)| **counts && **l <= mm).count()
    };
    let compensated = session.compensated_by.is_none().then(|| {
        // measured − model + reached − nominal, as if `nominal` were shifted by the model's error
        let moved = moved(&compensation, inputs, &model);
        let drawn = compensation.nominal.predict(inputs);
        let expected = |i: usize| minus(drawn.get(i), moved.get(i));
        let with_table = measured_minus(session, &problem, &compensation, expected);
        let left: Vec<f64> = left_over(&compensation, inputs)
            .iter()
            .map(|v| crate::lanes::dot(*v, *v).sqrt())
            .collect();
        let stays = Spread::of(&left, |i| problem.fit[i], |_| false);
        let compensated = spread(&with_table).map(|gap| Compensated {
            gap,
            cannot_be_removed_by_joints_mm: stays.map_or(0.0, |s| s.rms_mm),
        });
        (compensated, tolerance.map(|mm| within(&with_table, mm)))
    });
    let (compensated, corrected) = compensated.unwrap_or_default();
    let samples = problem.usable.iter().filter(|u| **u).count();
    let counts = |i: usize| problem.fit[i];
    Ok(Verification {
        session: session.name.clone(),
        samples,
        nominal: spread(&before).ok_or(VerifyError::NothingToVerify)?,
        model: spread(&after).ok_or(VerifyError::NothingToVerify)?,
        within_tolerance: tolerance.map(|mm| WithinTolerance {
            before: within(&before, mm),
            after: within(&after, mm),
            corrected,
            of: problem.fit.iter().filter(|f| **f).count(),
        }),
        compensated,
        held_out: held_out(&apart, &before, &after),
        trimmed: Trimmed::of(&before.length_mm, &after.length_mm, counts, &outlier),
        data_problems: set_aside::findings(session, &after.length_mm, counts, &outlier),
        before,
        after,
        outliers: (0..outlier.len())
            .filter(|i| counts(*i) && outlier[*i])
            .collect(),
        notes,
    })
}
