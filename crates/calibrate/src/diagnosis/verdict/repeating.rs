//! The repeating curve over the only joint that has no name, in the model that is handed out: every table, program and
//! report includes it. The verdict is about names and does not depend on it.

use crate::effects::curve::Curve;
use crate::fit::gap::{lengths_mm, rms_mm, set_aside};
use crate::fit::problem::Problem;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::model::shapes::{Profile, Variable};
use crate::numeric::median;
use crate::text::Text;
use crate::text::{length, lengths};
use crate::units::deg_from_rad;

use super::named::Figures;
use super::unseen;
use super::values::Values;
use crate::answers::diagnosis::{Correction, Unexplained, Unnamed};
use crate::answers::noise::Noise;
use crate::diagnosis::rest::joint::{Repeating, repeating};
use crate::diagnosis::search::prepare::PreparedSearch;

/// The repeating curve in addition to the values of the names.
pub(super) struct WithRepeating {
    pub(super) unnamed: Unnamed,
    /// The figures with it.
    pub(super) figures: Figures,
    /// The noise given it, where that is known better with it.
    pub(super) noise: Option<Noise>,
    /// Samples that are outliers of the names alone, and come back.
    pub(super) come_back: Vec<usize>,
}

/// The repeating curve, where it predicts.
pub(super) fn with_repeating(
    prepared: &PreparedSearch,
    values: &Values,
    unexplained: &Unexplained,
    figures: &Figures,
) -> Option<WithRepeating> {
    let mut now = figures.clone();
    let Figures { gap, held_out } = &mut now;
    let model = values.model.settled();
    let joint = 0;
    let stopped = prepared.regression.work.was_stopped();
    if stopped || prepared.options().without_unnamed || model.robot.joints.len() != 1 {
        return None;
    }
    let base = &prepared.regression.base;
    let period = unexplained
        .shapes
        .iter()
        .find_map(|(shape, _)| match shape.profile {
            Profile::Periodic { cycles, .. } if shape.variable == Variable::Joint(joint) => {
                Some(std::f64::consts::TAU / cycles)
            }
            _ => None,
        });
    let found = repeating(&values.problem, &model, base, joint, period)?;
    // In a single run the axis and time cannot be distinguished: what the noise explains as a drift remains one.
    if values.noise_is_slow() && found.runs_held_out_mm.is_none() && !unexplained.present {
        return None;
    }
    let with = model.with_term(found.term.clone());
    let aside = [&values.problem, &found.problem].map(set_aside);
    let come_back = |i: &usize| aside[0][*i] && !aside[1][*i];
    let come_back: Vec<usize> = (0..aside[0].len()).filter(come_back).collect();
    // All figures are over one set of samples.
    let over = if come_back.is_empty() {
        &values.problem
    } else {
        gap.start_mm = rms_mm(&found.problem, &prepared.nominal);
        gap.identified_mm = rms_mm(&found.problem, base);
        &found.problem
    };
    let [before, after] = [&model, &with].map(|model| rms_mm(over, model));
    let gaps = held_out.gaps.as_mut()?;
    let mut identified_mm = gaps.identified_mm;
    let held_out_mm = if unseen::held_out_samples(prepared).contains(&true) {
        let own = of_held_out_samples(prepared, values, &model, &found, period)?;
        (own[1] < own[0] && own[1] <= gaps.identified_mm).then_some(own)?
    } else {
        let [identified, before, after] = found.held_out_mm;
        identified_mm = identified.max(after);
        [before, after]
    };
    if sets_many_aside(&found.problem) {
        return None;
    }
    // Rows that do not belong to the robot have the largest deviations, and dominate the sum of squares.
    let medians = [&model, &with].map(|model| median_mm(&values.problem, model));
    if after >= before || after > gap.identified_mm || medians[1] > medians[0] {
        return None;
    }
    gap.end_mm = after;
    gaps.identified_mm = identified_mm;
    gaps.end_mm = held_out_mm[1];
    if !unseen::held_out_samples(prepared).contains(&true) {
        held_out.how = found.how.clone();
        held_out.samples = found.samples;
    }
    let kind = model.robot.joints[joint].kind;
    let curve = Correction {
        description: describe(found.term.curve()?, joint, kind, held_out_mm),
        gap_mm: [before, after],
        held_out_mm,
        runs_held_out_mm: found.runs_held_out_mm,
        values_held_out_mm: found.values_held_out_mm,
        how: held_out.how.clone(),
        term: found.term,
    };
    let unnamed = Unnamed {
        rms_mm: (before * before - after * after).sqrt(),
        held_out_mm,
        over: vec![Text::verbatim(format!("q{}_{}", joint + 1, kind.unit()))],
        curve: Some(curve),
    };
    Some(WithRepeating {
        unnamed,
        figures: now,
        noise: found.noise,
        come_back,
    })
}

/// Whether a tenth of the samples or more are set aside: the others may follow one another by how they were chosen, and
/// no curve is judged by them.
pub(super) fn sets_many_aside(problem: &Problem) -> bool {
    let count = |all: &[bool]| all.iter().filter(|own| **own).count();
    10 * count(&set_aside(problem)) > count(&problem.fit)
}

/// The median deviation of all samples that may be fitted, mm.
fn median_mm(problem: &Problem, model: &Model) -> f64 {
    let residual_mm = lengths_mm(problem, model);
    let fitted = residual_mm.iter().zip(&problem.fit).filter(|own| *own.1);
    median(fitted.map(|own| *own.0).filter(|mm| mm.is_finite())).unwrap_or(0.0)
}

/// The RMS error of samples that the session or an option holds out, without and with the curve, which has not
/// seen them.
fn of_held_out_samples(
    prepared: &PreparedSearch,
    values: &Values,
    model: &Model,
    found: &Repeating<'_>,
    period: Option<f64>,
) -> Option<[f64; 2]> {
    let term = if prepared.locked.contains(&true) {
        let seen = values.on(&prepared.problem);
        repeating(
            &seen.problem,
            model,
            &prepared.regression.base,
            found.term.joint,
            period,
        )?
        .term
    } else {
        found.term.clone()
    };
    let with = model.with_term(term);
    Some([model, &with].map(|model| {
        let residual_mm = lengths_mm(&prepared.problem, model);
        unseen::rms_apart_mm(prepared, &residual_mm)
    }))
}

/// The curve in words.
fn describe(curve: &Curve, joint: usize, kind: JointKind, held_out: [f64; 2]) -> Text {
    let (unit, outer): (&str, fn(f64) -> f64) = if kind == JointKind::Prismatic {
        (" mm", |v| v)
    } else {
        ("°", deg_from_rad)
    };
    let knots = curve.knots();
    let [motion, radial, axial] = curve.largest();
    let mut parts = Vec::new();
    if motion > 0.0 {
        parts.push(text!(
            "up to {size} along its motion",
            size = format!("{:.4}{unit}", outer(motion))
        ));
    }
    if radial > 0.0 {
        parts.push(text!(
            "up to {size} across it, which no table over the joint can correct",
            size = length(radial, 4)
        ));
    }
    if axial > 0.0 {
        parts.push(text!(
            "up to {size} along its axis, which no table over the joint can correct",
            size = length(axial, 4)
        ));
    }
    let (from, to) = (
        format!("{:.2}", outer(knots.from)),
        format!("{:.2}{unit}", outer(knots.to)),
    );
    let curve = match knots.period {
        Some(period) => text!(
            "a smooth correction over joint {joint} from {from} to {to} with {knots} knots, repeating every {period}",
            joint = joint + 1,
            from,
            to,
            knots = knots.count,
            period = format!("{:.4}{unit}", outer(period))
        ),
        None => text!(
            "a smooth correction over joint {joint} from {from} to {to} with {knots} knots",
            joint = joint + 1,
            from,
            to,
            knots = knots.count
        ),
    };
    text!(
        "{curve}: {sizes}; cross-validated RMS error {change}; outside that range its end values are held and nothing is known; it has no name and no cause",
        curve,
        sizes = Text::listed(parts, ", "),
        change = lengths([held_out[0], held_out[1]], 4)
    )
}
