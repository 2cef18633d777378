//! Which entries a table gets.
//!
//! A step that the user gives is taken, or refused where the reader's limit does not allow it.
//! Without one, entries are where the joint was measured, if it was in equal steps that divide the travel; else, or where the
//! table then adds more than is allowed, the widest round step is taken (10, 5, 2, 1, 0.5, … degrees or mm) with which the
//! table adds less than is allowed ([`Allowance`]); where the limit does not let the steps get that
//! small, a format that may have its entries anywhere gets them where they are needed
//! ([`knots`](super::knots)), and another one as many as it takes. What is added then is said.

use super::residual_error::{Allowance, Exact};
use super::rules::{Directions, Rules, Spacing};
use super::sheet::Sheet;
use super::{ExportError, Job, knots};
use crate::compensation::JointTable;
use crate::text::Text;
use crate::text::length;

/// Round steps, degrees or mm.
const ROUND: [f64; 13] = [
    10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001,
];
/// Most entries of a table whose number was not asked for.
const MOST_UNASKED: usize = 20_001;

/// The sheet for a format, and what it may add.
pub(super) fn choose(
    job: &Job,
    rules: &Rules,
    exact: &Exact,
    allowance: Allowance,
) -> Result<(Sheet, Allowance), ExportError> {
    let (sheet, allowance) = match job.step {
        Some(step) => (asked(job, rules, step)?, allowance),
        None => fitting(job, rules, exact, allowance)?,
    };
    let ascends = sheet.places.windows(2).all(|pair| pair[0] < pair[1]);
    if !ascends {
        return Err(ExportError::Refused(text!(
            "a step of {step} is finer than the positions of {format}, which are whole multiples of {finest}",
            step = format!("{}{}", sheet.step.unwrap_or(0.0), sheet.kind.sign()),
            format = rules.title(),
            finest = format!("{}{}", rules.resolution.unwrap_or(0.0), sheet.kind.sign())
        )));
    }
    if let Some(wrong) = sheet
        .forward
        .iter()
        .chain(&sheet.reverse)
        .find(|v| !v.is_finite())
    {
        return Err(ExportError::Refused(text!(
            "the model gives a correction of {wrong}: it cannot be inverted over this travel",
            wrong
        )));
    }
    Ok((sheet, allowance))
}

fn asked(job: &Job, rules: &Rules, step: f64) -> Result<Sheet, ExportError> {
    let table = job.table(step)?;
    let entries = table.commanded_outer.len();
    if entries > rules.most_entries {
        let [from, to] = [table.commanded_outer[0], table.commanded_outer[entries - 1]];
        let wide = (to - from) / (rules.most_entries - 1) as f64;
        let unit = table.kind.sign();
        return Err(ExportError::Refused(text!(
            "a step of {step} makes {entries} entries, and {format} takes at most {most} ({because}); a step of {wide} or more fits, or none: then the entries are chosen",
            step = format!("{step}{unit}"),
            entries,
            format = rules.title(),
            most = rules.most_entries,
            because = rules.limit_because,
            // Rounded up, so that it does fit.
            wide = format!("{}{unit}", (wide * 1e3).ceil() / 1e3)
        )));
    }
    Ok(Sheet::new(&table, rules))
}

fn fitting(
    job: &Job,
    rules: &Rules,
    exact: &Exact,
    allowance: Allowance,
) -> Result<(Sheet, Allowance), ExportError> {
    let between_sides_mm = exact.between_sides_mm(rules);
    let most = rules.most_entries.min(MOST_UNASKED);
    let span = exact.span();
    // A step that divides the travel.
    let dividing = |step: f64| span / (span / step - 1e-9).ceil().max(1.0);
    let fits = |step: &f64| span / step < (most - 1) as f64 + 1e-6;
    if let Some(step) = measured_step(job, exact).filter(fits) {
        let sheet = Sheet::new(&job.table(step)?, rules);
        let at_the_targets = allowance.clone().at_the_targets(job.calibration);
        if exact.added_by(&sheet, rules) <= at_the_targets.without_independent(between_sides_mm) {
            return Ok((sheet, at_the_targets));
        }
    }
    let allowed_mm = allowance.without_independent(between_sides_mm);
    let narrow = |step: &f64| *step <= rules.widest_step;
    for step in ROUND.into_iter().filter(narrow).filter(fits) {
        let sheet = Sheet::new(&job.table(dividing(step))?, rules);
        if exact.added_by(&sheet, rules) <= allowed_mm {
            return Ok((sheet, allowance));
        }
    }
    if rules.spacing == Spacing::Free {
        let dense = Sheet::new(&exact.table, rules);
        let columns = [&dense.forward[..], &dense.reverse[..]];
        let enough = allowed_mm / exact.lever_outer_mm.max(f64::MIN_POSITIVE);
        let entries = knots::at_most(&dense.places, &columns, enough, most);
        return Ok((dense.at(&entries), allowance));
    }
    let table: JointTable = job.table(span / (most - 1) as f64)?;
    Ok((Sheet::new(&table, rules), allowance))
}

/// The step in which the joint was measured, degrees or mm, where entries in it are at the measured targets.
fn measured_step(job: &Job, exact: &Exact) -> Option<f64> {
    let table = &exact.table;
    let steps = job.calibration.measured_steps.as_ref()?;
    let step = table.to_display(*steps.get(job.joint)?);
    let whole = |distance: f64| {
        let steps = distance / step;
        (steps - steps.round()).abs() < 1e-6
    };
    let from = table.to_display(table.measured.from) - table.commanded_outer[0];
    (step > 0.0 && whole(exact.span()) && whole(from)).then_some(step)
}

/// Refuses a table for one direction where the directions differ noticeably; `None` where they do
/// not differ at all.
pub(super) fn directions(
    rules: &Rules,
    exact: &Exact,
    allowance: &Allowance,
) -> Result<Option<Text>, ExportError> {
    let Directions::One { instead } = rules.directions else {
        return Ok(None);
    };
    let apart = exact.apart_outer();
    let leaves = exact.between_sides_mm(rules);
    if apart < rules.resolution.unwrap_or(0.0) {
        return Ok(None);
    }
    let unit = exact.table.kind.sign();
    let says = text!(
        "the corrections of the two directions differ by up to {apart} (backlash), and {format} holds one for both: their mean leaves {leaves}",
        apart = format!("{apart:.5}{unit}"),
        format = rules.title(),
        leaves = length(leaves, 4)
    );
    if leaves <= allowance.mm {
        return Ok(Some(says));
    }
    Err(ExportError::Refused(text!(
        "{says}, more than {allowed} ({limit}); {instead}",
        says,
        allowed = &allowance.is,
        limit = length(allowance.mm, 4),
        instead
    )))
}
