//! What no name explains, as a smooth correction: the technician gets the accuracy without a
//! false name.
//!
//! The residuals of the named model are smoothed over the joint's value (`likelihood`), in
//! directions that turn with the joint: along its motion, which a table can correct, along its
//! radius and along its axis. Where a correction is asked for the names are fitted alone, and the
//! curve is orthogonal to them on the samples, so that their values stay what they are.
//!
//! It is added only if it helps on samples that it has not seen (`columns`: every so-many-th
//! value of the joint is left out and predicted from its neighbours; where the noise is correlated
//! in time whole stretches of time as well), and only for what depends on a joint's value: what
//! follows time, speed, load or temperature is refused.

mod columns;
mod likelihood;

use crate::effects::Term;
use crate::effects::curve::{Curve, DIRECTIONS, Knots};
use crate::fit::gap::suspects;
use crate::fit::gap::{Spread, deviations};
use crate::fit::problem::Problem;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::text::Text;
use crate::text::{length, lengths};
use crate::units::deg_from_rad;

use super::prepare::PreparedSearch;
use crate::answers::diagnosis::{Correction, Unexplained};
use crate::model::shapes::{Profile, Shape, Variable};
use columns::{Columns, Folds};
use likelihood::{Kernel, NamesAlone, Sizes, Sums};

/// Most knots over a range …
const MOST_KNOTS: usize = 61;
/// … and over a period.
const MOST_IN_A_PERIOD: usize = 24;
/// With fewer different values of the joint there is nothing to leave out and predict.
const FEWEST_VALUES: usize = 10;
/// How often samples that were suspected are looked at again.
const MOST_ROUNDS: usize = 3;
/// Lengths of the prior that are tried, in shares of the range.
const LENGTHS: [f64; 4] = [1.0, 0.25, 0.0625, 0.02];

/// What is left of a model as a smooth correction, or why there is none, if the options ask for
/// one.
pub(crate) fn asked(
    prepared: &PreparedSearch,
    left: &Unexplained,
    model: &Model,
) -> Option<Result<Correction, Text>> {
    let shapes: Vec<Shape> = left.shapes.iter().map(|s| s.0).collect();
    let wanted = prepared.options().correct_unexplained;
    wanted.then(|| correct(prepared, &shapes, model))
}

/// `shapes` are those of the search, largest first.
fn correct(prepared: &PreparedSearch, shapes: &[Shape], model: &Model) -> Result<Correction, Text> {
    let Some(main) = shapes.first() else {
        return Err(text!("nothing unexplained is left"));
    };
    let robot = &model.robot;
    let slides = |j: usize| robot.joints[j].kind == JointKind::Prismatic;
    let of_joint = |shape: &&Shape| matches!(shape.variable, Variable::Joint(_));
    let Some(over) = shapes.iter().find(of_joint) else {
        return Err(text!(
            "what is left follows {column}, not the value of a joint: no table over a joint can correct it",
            column = main.variable.column(slides)
        ));
    };
    let Variable::Joint(joint) = over.variable else {
        return Err(text!("what is left follows no joint"));
    };
    let mut problem = (*prepared.problem).clone();
    let mut fitted = fitted(&problem, prepared, model, joint, over)?;
    // Beside the names alone the peak of a bump looks like an outlier.
    for _ in 0..MOST_ROUNDS {
        let with = model.with_term(Term::unexplained(joint, fitted.curve.clone()));
        let suspected = suspects(&problem, &deviations(&problem, &with));
        let back = |i: usize| problem.fit[i] && !problem.used[i] && !suspected[i];
        let back: Vec<usize> = (0..suspected.len()).filter(|i| back(*i)).collect();
        if back.is_empty() {
            break;
        }
        for sample in back {
            problem.used[sample] = true;
        }
        fitted = self::fitted(&problem, prepared, model, joint, over)?;
    }
    let LikeliestCurve {
        columns,
        best,
        curve,
    } = fitted;
    let mut held_out: Option<([f64; 2], Text)> = None;
    for folds in columns.folds(joint) {
        let gap = best.held_out(&columns, &folds);
        if gap[1] >= gap[0] {
            return Err(text!(
                "a smooth curve would not help in the cross-validation ({change}; {how})",
                change = lengths([gap[0], gap[1]], 4),
                how = folds.how
            ));
        }
        held_out.get_or_insert((gap, folds.how));
    }
    let none = || text!("there are too few samples to hold any out");
    let (held_out_mm, how) = held_out.ok_or_else(none)?;
    let others: Vec<String> = shapes
        .iter()
        .filter(|shape| !of_joint(shape))
        .map(|shape| shape.variable.column(slides))
        .collect();
    let says = describe(&curve, joint, slides(joint), held_out_mm, &others);
    let term = Term::unexplained(joint, curve);
    let gap = |model: &Model| {
        let left = deviations(&problem, model);
        let spread = Spread::of(&left.length_mm, |i| problem.fit[i], |i| !problem.used[i]);
        spread.map_or(0.0, |s| s.rms_mm)
    };
    Ok(Correction {
        gap_mm: [gap(model), gap(&model.with_term(term.clone()))],
        term,
        held_out_mm,
        how,
        description: says,
    })
}

/// A free curve over a joint beside a model.
pub(crate) struct FreeCurve {
    /// Logarithm of how much likelier the samples are with it.
    pub(crate) ln_odds: f64,
    /// Columns that it is worth.
    pub(crate) freedom: usize,
}

/// The likeliest free curve over a joint beside a model, on the samples that a search looks at.
pub(crate) fn free_curve(
    prepared: &PreparedSearch,
    model: &Model,
    joint: usize,
) -> Option<FreeCurve> {
    let regression = &prepared.regression;
    let columns = Columns::new(&regression.problem, &regression.noise, model, joint);
    if columns.values.len() < FEWEST_VALUES {
        return None;
    }
    let knots = Knots {
        from: columns.from(),
        to: columns.to(),
        period: None,
        count: columns.values.len().clamp(4, MOST_KNOTS),
    };
    let best = tried(&columns, knots)?;
    let names = NamesAlone::new(&columns.sums(&knots)?);
    let length = best.kernel.pieces().ceil();
    Some(FreeCurve {
        ln_odds: best.ln_evidence - names.ln_evidence,
        freedom: length as usize,
    })
}

/// The likeliest curve on some samples, with what it was fitted to.
struct LikeliestCurve<'a> {
    columns: Columns<'a>,
    best: Choice,
    curve: Curve,
}

fn fitted<'a>(
    problem: &Problem<'a>,
    prepared: &PreparedSearch,
    model: &Model,
    joint: usize,
    over: &Shape,
) -> Result<LikeliestCurve<'a>, Text> {
    let columns = Columns::new(problem, &prepared.regression.noise, model, joint);
    let values = columns.values.len();
    if values < FEWEST_VALUES {
        return Err(text!(
            one "joint {joint} was measured at {count} value; a curve needs at least {needed}", "joint {joint} was measured at {count} different values; a curve needs at least {needed}",
            joint = joint + 1,
            count = values,
            needed = FEWEST_VALUES
        ));
    }
    let none = || {
        text!(
            "no smooth curve over the value of joint {joint} makes what is left likelier",
            joint = joint + 1
        )
    };
    let best = likeliest(&columns, over).ok_or_else(none)?;
    let curve = best.curve(&columns).ok_or_else(none)?;
    Ok(LikeliestCurve {
        columns,
        best,
        curve,
    })
}

/// A choice of knots, prior and sizes.
#[derive(Debug, Clone)]
struct Choice {
    knots: Knots,
    kernel: Kernel,
    sizes: Sizes,
    ln_evidence: f64,
}

/// The likeliest of the curves that are tried; `None` where no curve is likelier.
fn likeliest(columns: &Columns, over: &Shape) -> Option<Choice> {
    let over_range = Knots {
        from: columns.from(),
        to: columns.to(),
        period: None,
        count: columns.values.len().clamp(4, MOST_KNOTS),
    };
    let mut best = tried(columns, over_range);
    let span = over_range.to - over_range.from;
    // What does not come round twice is not known to repeat.
    if let Profile::Periodic { cycles, .. } = over.profile
        && cycles * span >= 2.0 * std::f64::consts::TAU
    {
        let start = std::f64::consts::TAU / cycles;
        // A period is as sure as its phase is at the far end of the range.
        let mut by = 0.1 * start * start / span;
        let with = |period: f64| {
            let knots = Knots {
                period: Some(period),
                count: columns.values.len().clamp(4, MOST_IN_A_PERIOD),
                ..over_range
            };
            tried(columns, knots)
        };
        let evidence = |c: &Option<Choice>| c.as_ref().map_or(f64::NEG_INFINITY, |c| c.ln_evidence);
        let mut periodic = (start, with(start));
        for _ in 0..4 {
            for period in [periodic.0 - by, periodic.0 + by] {
                let next = if period > 0.0 { with(period) } else { None };
                if evidence(&next) > evidence(&periodic.1) {
                    periodic = (period, next);
                }
            }
            by *= 0.5;
        }
        if evidence(&periodic.1) > evidence(&best) {
            best = periodic.1;
        }
    }
    best
}

/// The likeliest prior and sizes for these knots.
fn tried(columns: &Columns, knots: Knots) -> Option<Choice> {
    let sums = columns.sums(&knots)?;
    let names = NamesAlone::new(&sums);
    let mut best: Option<(Kernel, (Sizes, f64))> = None;
    for length in LENGTHS {
        for order in [1, 2] {
            let kernel = Kernel::new(knots.count, knots.period.is_some(), length, order)?;
            let Some(first) = likelihood::first_direction(&sums, &names, &kernel) else {
                continue;
            };
            if best.as_ref().is_none_or(|b| first.1 > b.1.1) {
                best = Some((kernel, first));
            }
        }
    }
    let (kernel, first) = best?;
    let sizes = likelihood::all_directions(&sums, &names, &kernel, first);
    let fitted = likelihood::fit(&sums, &names, &kernel, &sizes, false)?;
    Some(Choice {
        knots,
        kernel,
        sizes,
        ln_evidence: fitted.ln_evidence,
    })
}

impl Choice {
    fn curve(&self, columns: &Columns) -> Option<Curve> {
        let sums = columns.sums(&self.knots)?;
        let names = NamesAlone::new(&sums);
        let fitted = likelihood::fit(&sums, &names, &self.kernel, &self.sizes, true)?;
        let n = self.knots.count;
        let part = |all: &nalgebra::DVector<f64>| -> [Vec<f64>; DIRECTIONS] {
            std::array::from_fn(|d| {
                if self.sizes[d].is_none() {
                    return Vec::new();
                }
                let own = all.rows(d * n, n);
                own.iter().map(|v| v * columns.unit[d]).collect()
            })
        };
        Curve::new(self.knots, part(&fitted.values), part(&fitted.sigma)).ok()
    }

    /// Root mean square deviations of unseen samples without and with the curve, mm. Names,
    /// sizes and curve are fitted without them.
    fn held_out(&self, columns: &Columns, folds: &Folds) -> [f64; 2] {
        let (raw, white) = columns.curve(&self.knots);
        let parts: Vec<Sums> = (0..folds.count)
            .map(|fold| {
                let rows: Vec<usize> = columns.rows(|sample| folds.of[sample] == fold);
                Sums::of(&white, &columns.white_names, &columns.white_residual, &rows)
            })
            .collect();
        let (mut before, mut after) = (0.0, 0.0);
        for fold in 0..folds.count {
            let seen = parts.iter().enumerate().filter(|(k, _)| *k != fold);
            let Some(seen) = Sums::total(seen.map(|(_, s)| s), columns.floor) else {
                continue;
            };
            let names = NamesAlone::new(&seen);
            let sizes = likelihood::finely(&seen, &names, &self.kernel, self.sizes);
            let fitted = likelihood::fit(&seen, &names, &self.kernel, &sizes, false);
            for row in columns.rows(|sample| folds.of[sample] == fold) {
                let left = columns.residual[row] - columns.names.row(row).tr_dot(&names.step);
                let curve = fitted
                    .as_ref()
                    .map_or(0.0, |f| raw.row(row).tr_dot(&f.values));
                before += left * left;
                after += (left - curve).powi(2);
            }
        }
        let samples = columns.samples().max(1) as f64;
        [(before / samples).sqrt(), (after / samples).sqrt()]
    }
}

fn describe(
    curve: &Curve,
    joint: usize,
    slides: bool,
    held_out: [f64; 2],
    others: &[String],
) -> Text {
    let (unit, outer): (&str, fn(f64) -> f64) = if slides {
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
    let says = text!(
        "{curve}: {sizes}; cross-validated RMS error {change}; outside that range its end values are held and nothing is known; it has no name and no cause",
        curve,
        sizes = Text::listed(parts, ", "),
        change = lengths([held_out[0], held_out[1]], 4)
    );
    if others.is_empty() {
        says
    } else {
        text!(
            "{says}; what follows {others} stays",
            says,
            others = others.join(", ")
        )
    }
}
