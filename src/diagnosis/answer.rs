//! What a diagnosis answers, with the evidence of every step.

use nalgebra::DMatrix;

use crate::effects::{Setting, Term};
use crate::identification::gap::{Deviations, Spread, deviations};
use crate::identification::robust::suspects;
use crate::identification::uncertainty::{estimates, half_width_factor};
use crate::identification::{DEFAULT_EFFECTS, Estimate, Outlier};
use crate::kinematics::{JointKind, Range};
use crate::model::{Calibration, GapStep, Model};
use crate::sessions::{Session, Sigma};

use super::aliases;
use super::anonymous::{Shape, Where};
use super::arena::{Arena, Fit};
use super::blunders::{DataProblem, Mended};
use super::candidates::NotTestable;
use super::evidence::Noise;
use super::familywise::FamilyP;
use super::limits::{self, Limit};
use super::next_poses::{self, NextPose};
use super::prepare::Prepared;
use super::search::{Found as SearchEnd, mean_sigma_mm};
use super::{DiagnoseError, Progress, Watch, unlock};

/// The short answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing is missing.
    Noise,
    /// Names explain what was missing.
    Explained,
    /// Names explain a part of it.
    PartlyExplained,
    /// Something is missing that no name explains.
    Unexplained,
}

/// Where the noise floor comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FloorFrom {
    /// Returns to the same pose.
    Repeats,
    /// What the instrument's maker says.
    Instrument,
    /// The residuals of the final model.
    Estimated,
}

/// The smallest gap that noise allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// Root mean square length, mm.
    pub mm: f64,
    /// Where it comes from.
    pub from: FloorFrom,
}

/// Gaps in mm: of the nominal robot, after the identification, with everything that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaps {
    /// Nominal robot.
    pub start_mm: f64,
    /// After zero offset and link length.
    pub identified_mm: f64,
    /// With everything that was found.
    pub end_mm: f64,
}

/// Gaps on samples that the fit has not seen.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// How they were held out.
    pub how: String,
    /// How many.
    pub samples: usize,
    /// The gaps; `None` where there are too few samples.
    pub gaps: Option<Gaps>,
}

/// An effect that was missing.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 1; `None` where it belongs to none.
    pub joint: Option<usize>,
    /// Its parameters.
    pub parameters: Vec<Estimate>,
    /// The chance that noise alone would surprise the search as much.
    pub p_family: FamilyP,
    /// Its share of what was explained.
    pub share: f64,
    /// Gaps without and with it, in the order found, mm.
    pub gap_mm: [f64; 2],
    /// The same on samples that the fit has not seen; `None` where there are too few.
    pub held_out_mm: Option<[f64; 2]>,
    /// How much likelier than the next name in its place.
    pub odds_over_next: f64,
    /// The next name, if any.
    pub next: Option<String>,
    /// The evidence in words.
    pub says: String,
    /// What to look at on the machine.
    pub check: &'static str,
}

/// Another set of names that the samples cannot rule out.
#[derive(Debug, Clone, PartialEq)]
pub struct Equivalent {
    /// Names of the model that it replaces.
    pub explanation: Vec<&'static str>,
    /// By these.
    pub instead: Vec<&'static str>,
    /// How much likelier the model is.
    pub odds: f64,
    /// What would tell.
    pub separate_by: String,
    /// The other model.
    pub model: Model,
}

/// What is left that no name explains.
#[derive(Debug, Clone, PartialEq)]
pub struct Unexplained {
    /// Whether something is.
    pub present: bool,
    /// Chance that noise alone would look as much like it.
    pub p: f64,
    /// Root mean square of what is left, mm.
    pub rms_mm: f64,
    /// Where.
    pub place: Option<Where>,
    /// Names that only imitate a part of it.
    pub resembles: Vec<&'static str>,
    /// In words; empty where nothing is left.
    pub says: String,
    /// The shapes themselves with their coefficients.
    pub shapes: Vec<(Shape, Vec<f64>)>,
}

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Name of the session.
    pub session: String,
    /// Number of samples.
    pub samples: usize,
    /// The short answer.
    pub verdict: Verdict,
    /// Blunders and losses.
    pub data_problems: Vec<DataProblem>,
    /// The noise floor.
    pub floor: Floor,
    /// Gaps over the samples that were fitted.
    pub gap: Gaps,
    /// Gaps over samples that were not.
    pub held_out: HeldOut,
    /// What belongs to every calibration.
    pub identified: Vec<Estimate>,
    /// What was missing, in the order found.
    pub found: Vec<Found>,
    /// What cannot be ruled out, likeliest first.
    pub equivalent: Vec<Equivalent>,
    /// What no name explains.
    pub unexplained: Unexplained,
    /// What the session cannot show.
    pub not_testable: Vec<NotTestable>,
    /// What would have been seen.
    pub not_found: Vec<Limit>,
    /// Suspected samples, counted from 0.
    pub outliers: Vec<Outlier>,
    /// What to measure next.
    pub next_poses: Vec<NextPose>,
    /// The noise as the search saw it.
    pub noise: Noise,
    /// The model with everything that was found.
    pub model: Model,
    /// Covariance of its coefficients, inner units.
    pub covariance: Option<DMatrix<f64>>,
    /// The gap step by step.
    pub history: Vec<GapStep>,
    /// Range of every joint in the samples.
    pub measured: Vec<Range>,
}

impl Diagnosis {
    /// The calibration that goes with this answer, to be saved and exported.
    pub fn calibration(&self, session: &Session) -> Calibration {
        Calibration {
            session: self.session.clone(),
            model: self.model.clone(),
            covariance: self.covariance.clone(),
            regions: Vec::new(),
            targets: session.targets.clone(),
            measured: self.measured.clone(),
            tolerance_mm: session.tolerance_mm,
            compensated_by: session.compensated_by.clone(),
            history: self.history.clone(),
            samples_hash: crate::sessions::hash_of_samples(session),
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }
}

/// At most so many rivals are listed.
const MOST_EQUIVALENT: usize = 6;

pub(super) fn answer(
    mended: &Mended,
    prepared: &Prepared,
    end: &SearchEnd,
    watch: Watch,
) -> Result<Diagnosis, DiagnoseError> {
    let arena = &prepared.arena;
    let fit = &end.fit;
    let go_on = |progress: Progress| {
        if watch(&progress) {
            Ok(())
        } else {
            Err(DiagnoseError::Cancelled)
        }
    };
    go_on(Progress::Comparing)?;
    let session = &mended.session;
    let problem = &prepared.problem;
    let base = arena.fit(&arena.base, Vec::new());
    // The model carries names only, as near to the samples as names can come; what no name
    // explains is told apart.
    let with_shapes = fit;
    let names = arena.fit(&fit.model, Vec::new());
    let fit = if with_shapes.shapes.is_empty() {
        with_shapes
    } else {
        &names
    };
    let final_model = on_all_samples(prepared, fit);
    let nominal = deviations(problem, &Model::nominal(session.robot.clone()));
    let identified = deviations(problem, &on_all_samples(prepared, &base));
    let after = deviations(problem, &final_model);
    let suspected: Vec<bool> = suspects(problem, &after)
        .into_iter()
        .zip(&problem.used)
        .map(|(s, used)| s || !used)
        .collect();
    let counts = |i: usize| problem.fit[i];
    let rms = |d: &Deviations| {
        let spread = Spread::of(&d.length_mm, counts, |i| !problem.used[i]);
        spread.map_or(0.0, |s| s.rms_mm)
    };
    let gap = Gaps {
        start_mm: rms(&nominal),
        identified_mm: rms(&identified),
        end_mm: rms(&after),
    };
    let floor = floor(prepared, fit);
    let steps = steps(prepared, &base, fit);
    let rivals = next_poses::open_rivals(arena, with_shapes);
    let equivalent: Vec<_> = rivals.iter().collect();
    go_on(Progress::Planning)?;
    let not_testable = not_testable(arena, &base);
    let next_poses = if equivalent.is_empty() {
        unlock::worth_unlocking(prepared, with_shapes, &not_testable)
    } else {
        next_poses::separate(prepared, with_shapes, &equivalent, next_poses::MOST)
    };
    let covariance = covariance(arena, fit);
    let found = found(prepared, fit, with_shapes, &steps, &floor, &covariance);
    let unexplained = unexplained(prepared, end, session);
    let verdict = match (found.is_empty(), unexplained.present) {
        (true, false) => Verdict::Noise,
        (false, false) => Verdict::Explained,
        (false, true) => Verdict::PartlyExplained,
        (true, true) => Verdict::Unexplained,
    };
    let held_out = held_out(prepared, &base, fit, &steps, &nominal);
    let mut history = vec![GapStep {
        what: "nominal robot".to_owned(),
        gap_mm: gap.start_mm,
        held_out_mm: held_out.gaps.map(|g| g.start_mm),
    }];
    history.push(GapStep {
        what: "zero offset and link length".to_owned(),
        gap_mm: gap.identified_mm,
        held_out_mm: held_out.gaps.map(|g| g.identified_mm),
    });
    history.extend(steps.iter().map(|step| GapStep {
        what: format!("with {}", step.term.effect.about().id),
        gap_mm: step.gap_mm[1],
        held_out_mm: step.held_out_mm.map(|h| h[1]),
    }));
    let outliers = outliers(problem, &after, &suspected);
    Ok(Diagnosis {
        session: session.name.clone(),
        samples: session.samples.len(),
        verdict,
        data_problems: mended.problems.clone(),
        floor,
        gap,
        held_out,
        identified: identified_parameters(arena, fit, &covariance),
        found,
        equivalent: equivalents(&equivalent, with_shapes, &next_poses),
        unexplained,
        not_testable,
        not_found: limits::limits(arena, with_shapes),
        outliers,
        next_poses,
        noise: arena.noise.clone(),
        covariance: covariance_of_model(&covariance, &final_model),
        model: final_model,
        history,
        measured: measured(problem.inputs.q.iter().map(|q| &**q)),
    })
}

/// The model's values from all samples that count; a short session's fit already has them.
fn on_all_samples(prepared: &Prepared, fit: &Fit) -> Model {
    let used = prepared.problem.used.iter().filter(|u| **u).count();
    if used == prepared.arena.rows.samples.len() || !fit.shapes.is_empty() {
        return fit.model.clone();
    }
    crate::identification::solver::solve(&prepared.problem, &fit.model).model
}

fn measured<'q>(columns: impl Iterator<Item = &'q [f64]>) -> Vec<Range> {
    let range = |q: &[f64]| {
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        let (from, to) = q.iter().fold(start, |(a, b), v| (a.min(*v), b.max(*v)));
        Range { from, to }
    };
    columns.map(range).collect()
}

/// From returns to the same pose, else the instrument, else the residuals of the final fit.
fn floor(prepared: &Prepared, fit: &Fit) -> Floor {
    let arena = &prepared.arena;
    if let Some(mm) = pure_error_mm(prepared) {
        return Floor {
            mm,
            from: FloorFrom::Repeats,
        };
    }
    let axes = arena.rows.axes.len() as f64;
    match prepared.problem.session.instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => Floor {
            mm: sigma * axes.sqrt(),
            from: FloorFrom::Instrument,
        },
        Some(Sigma::PerAxis(sigma)) => Floor {
            mm: arena
                .rows
                .axes
                .iter()
                .map(|a| sigma[*a].powi(2))
                .sum::<f64>()
                .sqrt(),
            from: FloorFrom::Instrument,
        },
        None => Floor {
            mm: mean_sigma_mm(arena) * axes.sqrt() * arena.scale(fit),
            from: FloorFrom::Estimated,
        },
    }
}

/// Fewest degrees of freedom from which repeats tell the noise.
const FEWEST_REPEATS: usize = 8;

/// Spread between samples of the same pose, side, target, speed and load, reached again after
/// another pose.
fn pure_error_mm(prepared: &Prepared) -> Option<f64> {
    let rows = &prepared.arena.rows;
    let inputs = &rows.inputs;
    let key = |i: usize| {
        let mut key: Vec<u64> = inputs.q.iter().map(|q| q[i].to_bits()).collect();
        for columns in [&inputs.dir, &inputs.speed] {
            key.extend(columns.iter().flatten().map(|c| (c[i] + 0.0).to_bits()));
        }
        key.extend(inputs.load_kg.iter().map(|c| c[i].to_bits()));
        key.extend(inputs.target.iter().map(|t| u64::from(t[i])));
        key.extend(inputs.setup.iter().map(|s| s[i].to_bits()));
        key
    };
    let keys: Vec<Vec<u64>> = (0..rows.samples.len()).map(key).collect();
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by(|a, b| keys[*a].cmp(&keys[*b]).then(a.cmp(b)));
    let (raw, _) = rows.extract(&prepared.arena.base);
    let n = rows.samples.len();
    let (mut sum, mut freedom) = (0.0, 0_usize);
    let mut start = 0;
    while start < n {
        let end = (start..n)
            .find(|k| keys[order[*k]] != keys[order[start]])
            .unwrap_or(n);
        // Reached again: something else was measured in between.
        let group: Vec<usize> = order[start..end]
            .iter()
            .enumerate()
            .filter(|(k, i)| *k == 0 || **i > order[start + k - 1] + 1)
            .map(|(_, i)| *i)
            .collect();
        if group.len() > 1 {
            freedom += group.len() - 1;
            for axis in 0..rows.axes.len() {
                let values = group.iter().map(|i| raw[axis * n + i]);
                let mean = values.clone().sum::<f64>() / group.len() as f64;
                sum += values.map(|v| (v - mean).powi(2)).sum::<f64>();
            }
        }
        start = end;
    }
    (freedom >= FEWEST_REPEATS).then(|| (sum / freedom as f64).sqrt())
}

/// One effect more, in the order of what each adds.
struct Step {
    term: Term,
    gap_mm: [f64; 2],
    held_out_mm: Option<[f64; 2]>,
}

fn steps(prepared: &Prepared, base: &Fit, fit: &Fit) -> Vec<Step> {
    let arena = &prepared.arena;
    let mut left: Vec<Term> = arena.added(fit).into_iter().cloned().collect();
    let mut now = arena.fit(&base.model, fit.shapes.clone());
    let mut unseen = prepared.folds.rms(arena, &now);
    let gap = |fit: &Fit| {
        let (raw, _) = arena.rows.extract(&fit.model);
        let mut e = raw;
        for shape in &fit.shapes {
            e -= &shape.raw * &shape.coefficients;
        }
        (e.norm_squared() / arena.rows.samples.len().max(1) as f64).sqrt()
    };
    let mut steps = Vec::new();
    while !left.is_empty() {
        let fits = left.iter().map(|term| {
            let absent = Term::absent(term.effect, term.joint, term.setting);
            arena.fit(&now.model.with_term(absent), now.shapes.clone())
        });
        let best = fits
            .enumerate()
            .max_by(|a, b| a.1.ln_evidence.total_cmp(&b.1.ln_evidence));
        let Some((index, next)) = best else { break };
        let seen = prepared.folds.rms(arena, &next);
        steps.push(Step {
            term: left.remove(index),
            gap_mm: [gap(&now), gap(&next)],
            held_out_mm: prepared.folds.say_something().then_some([unseen, seen]),
        });
        (now, unseen) = (next, seen);
    }
    steps
}

fn held_out(
    prepared: &Prepared,
    base: &Fit,
    fit: &Fit,
    _: &[Step],
    nominal: &Deviations,
) -> HeldOut {
    let arena = &prepared.arena;
    let problem = &prepared.problem;
    let by_file = problem.session.samples.held_out.as_deref();
    let apart =
        |i: usize| problem.usable[i] && (prepared.locked[i] || by_file.is_some_and(|h| h[i]));
    let count = (0..problem.usable.len()).filter(|i| apart(*i)).count();
    if count > 0 {
        let how = if prepared.locked.contains(&true) {
            "sectors of joint 1 that were locked away from everything"
        } else {
            "the samples that the session marks as held out; no fit touched them"
        };
        let rms = |d: &Deviations| {
            // Samples far off are suspected here as they are elsewhere.
            let mut lengths: Vec<f64> = (0..d.length_mm.len())
                .filter(|i| apart(*i))
                .map(|i| d.length_mm[i])
                .collect();
            lengths.sort_by(f64::total_cmp);
            let limit = 5.0 * lengths[lengths.len() / 2];
            let spread = Spread::of(&d.length_mm, apart, |i| {
                count >= 8 && d.length_mm[i] > limit
            });
            spread.map_or(0.0, |s| s.rms_mm)
        };
        return HeldOut {
            how: how.to_owned(),
            samples: count,
            gaps: Some(Gaps {
                start_mm: rms(nominal),
                identified_mm: rms(&deviations(problem, &base.model)),
                end_mm: rms(&deviations(problem, &fit.model)),
            }),
        };
    }
    if !prepared.folds.say_something() {
        return HeldOut {
            how: "too few samples to hold any out".to_owned(),
            samples: 0,
            gaps: None,
        };
    }
    let rows = &arena.rows;
    let start = Model::nominal(base.model.robot.clone());
    let (raw, _) = rows.extract(&start);
    // What a fit of names alone predicts; a shape beside them is not part of the model.
    HeldOut {
        how: prepared.folds.how.clone(),
        samples: rows.samples.len(),
        gaps: Some(Gaps {
            start_mm: (raw.norm_squared() / rows.samples.len() as f64).sqrt(),
            identified_mm: prepared.folds.rms(arena, base),
            end_mm: prepared.folds.rms(arena, fit),
        }),
    }
}

/// `s² (Aᵀ A)⁻¹` of the final fit, its model's coefficients first.
fn covariance(arena: &Arena, fit: &Fit) -> DMatrix<f64> {
    let scale = arena.scale(fit);
    fit.basis.inverse_gram() * (scale * scale)
}

fn covariance_of_model(all: &DMatrix<f64>, model: &Model) -> Option<DMatrix<f64>> {
    let own = model.coefficient_count();
    (own > 0 && all.nrows() >= own).then(|| all.view((0, 0), (own, own)).into_owned())
}

fn parameters_of(
    arena: &Arena,
    fit: &Fit,
    covariance: &DMatrix<f64>,
    term: &Term,
) -> Vec<Estimate> {
    let mut first = 0;
    for other in fit.model.terms() {
        if other.same_column(term) {
            break;
        }
        first += other.coefficients.len();
    }
    let size = term.coefficients.len();
    let freedom = (arena.m() - fit.basis.rank() as f64).max(0.0) as usize;
    let undetermined: Vec<bool> = (first..first + size)
        .map(|k| !fit.basis.kept.contains(&k))
        .collect();
    let own = covariance.view((first, first), (size, size)).into_owned();
    let thinning = thinning(arena);
    let factor = half_width_factor(freedom) * thinning;
    let kind = fit.model.robot.joints[term.joint].kind;
    let mut all = estimates(
        term,
        (freedom > 0).then_some(&own),
        factor,
        &undetermined,
        kind,
    );
    if term.effect.about().setting == Setting::Time
        && let Some(time) = all.first_mut()
    {
        time.ci95 = Some(around(arena, term.setting));
    }
    all
}

/// Values come from all samples, the covariance from the part that was searched.
fn thinning(arena: &Arena) -> f64 {
    let all = arena.all_samples.max(1) as f64;
    (arena.rows.samples.len() as f64 / all).sqrt().min(1.0)
}

/// Times of the samples around a step.
fn around(arena: &Arena, time: f64) -> [f64; 2] {
    let times = arena.problem.inputs.time_s.as_deref().unwrap_or(&[]);
    let before = times.iter().copied().filter(|t| *t < time);
    let after = times.iter().copied().filter(|t| *t >= time);
    [
        before.fold(f64::NEG_INFINITY, f64::max).max(-1e300),
        after.fold(f64::INFINITY, f64::min).min(1e300),
    ]
}

fn identified_parameters(arena: &Arena, fit: &Fit, covariance: &DMatrix<f64>) -> Vec<Estimate> {
    let base = |t: &&Term| DEFAULT_EFFECTS.contains(&t.effect.about().id);
    let terms = fit.model.terms().iter().filter(base);
    terms
        .flat_map(|term| parameters_of(arena, fit, covariance, term))
        .collect()
}

fn found(
    prepared: &Prepared,
    fit: &Fit,
    with_shapes: &Fit,
    steps: &[Step],
    floor: &Floor,
    covariance: &DMatrix<f64>,
) -> Vec<Found> {
    let arena = &prepared.arena;
    let explained: f64 = steps
        .iter()
        .map(|s| s.gap_mm[0].powi(2) - s.gap_mm[1].powi(2))
        .sum();
    let one = |step: &Step| {
        let about = step.term.effect.about();
        let fitted = fit.model.terms().iter().find(|t| t.same_column(&step.term));
        let term = fitted.unwrap_or(&step.term);
        let rest = arena.without_term(with_shapes, term);
        let scores = arena.scan(&rest);
        let own_odds = with_shapes.ln_evidence - rest.ln_evidence;
        let mut own_surprise = 0.0_f64;
        let mut next: Option<(f64, String)> = None;
        for score in &scores {
            let Some(other) = arena.table.candidates[score.candidate].what.term() else {
                continue;
            };
            if other.same_column(term) {
                own_surprise = score.surprise;
            }
            let same_name = other.effect.about().id == about.id
                && (!about.per_joint || other.joint == term.joint);
            if !same_name && next.as_ref().is_none_or(|n| score.ln_odds > n.0) {
                next = Some((score.ln_odds, other.effect.about().id.to_owned()));
            }
        }
        let over = own_odds - next.as_ref().map_or(0.0, |n| n.0.max(0.0));
        let p_family = arena.family_p(own_surprise, with_shapes);
        let share = step.gap_mm[0].powi(2) - step.gap_mm[1].powi(2);
        let odds = over.clamp(-30.0, 30.0).exp();
        let says = says(
            step,
            &p_family,
            odds,
            next.as_ref().map(|n| n.1.as_str()),
            floor,
        );
        Found {
            effect: about.id,
            joint: about.per_joint.then_some(term.joint + 1),
            parameters: parameters_of(arena, fit, covariance, term),
            p_family,
            share: if explained > 0.0 {
                (share / explained).clamp(0.0, 1.0)
            } else {
                0.0
            },
            gap_mm: step.gap_mm,
            held_out_mm: step.held_out_mm,
            odds_over_next: odds,
            next: next.map(|n| n.1),
            says,
            check: about.check,
        }
    };
    steps.iter().map(one).collect()
}

fn says(step: &Step, p: &FamilyP, odds: f64, next: Option<&str>, floor: &Floor) -> String {
    let chance = if p.bound {
        format!(
            "noise alone would look like this in fewer than 1 of {:.0} sessions",
            1.0 / p.p
        )
    } else {
        format!(
            "noise alone would look like this in 1 of {:.0} sessions",
            1.0 / p.p
        )
    };
    let over = match next {
        Some(next) if odds > 1000.0 => format!("more than 1000 : 1 over the next name ({next})"),
        Some(next) => format!("{odds:.1} : 1 over the next name ({next})"),
        None => "no other name was tried".to_owned(),
    };
    let unseen = step.held_out_mm.map_or_else(String::new, |h| {
        format!(
            "; held-out gap {:.4} → {:.4} mm, floor {:.4}",
            h[0], h[1], floor.mm
        )
    });
    format!("{chance}; {over}{unseen}")
}

fn equivalents(rivals: &[&aliases::Rival], fit: &Fit, poses: &[NextPose]) -> Vec<Equivalent> {
    let ids = |terms: &[Term]| -> Vec<&'static str> {
        terms.iter().map(|t| t.effect.about().id).collect()
    };
    let mut all: Vec<Equivalent> = Vec::new();
    for rival in rivals {
        let (explanation, instead) = (ids(&rival.removed), ids(&rival.instead));
        let known = all
            .iter()
            .any(|e| e.explanation == explanation && e.instead == instead);
        if known || all.len() == MOST_EQUIVALENT {
            continue;
        }
        all.push(Equivalent {
            explanation,
            instead,
            odds: (fit.ln_evidence - rival.fit.ln_evidence).exp(),
            separate_by: next_poses::separate_by(rival, poses),
            model: rival.fit.model.clone(),
        });
    }
    all
}

fn unexplained(prepared: &Prepared, end: &SearchEnd, session: &Session) -> Unexplained {
    let arena = &prepared.arena;
    let fit = &end.fit;
    if fit.shapes.is_empty() {
        let scores = arena.scan(fit);
        let largest = scores.iter().map(|s| s.surprise).fold(0.0, f64::max);
        return Unexplained {
            present: false,
            p: arena.family_p(largest, fit).p,
            rms_mm: 0.0,
            place: None,
            resembles: Vec::new(),
            says: String::new(),
            shapes: Vec::new(),
        };
    }
    let prismatic = |j: usize| session.robot.joints[j].kind == JointKind::Prismatic;
    let names = |fit: &Fit| -> Vec<(&'static str, usize)> {
        let added = arena.added(fit);
        added
            .iter()
            .map(|t| (t.effect.about().id, t.joint))
            .collect()
    };
    let kept = names(fit);
    let mut resembles: Vec<&'static str> = names(&end.names_only)
        .into_iter()
        .filter(|n| !kept.contains(n))
        .map(|n| n.0)
        .collect();
    resembles.dedup();
    // The largest shape comes first.
    let gain = |index: usize| arena.without_shape(fit, index).rss - fit.rss;
    let mut order: Vec<(usize, f64)> = (0..fit.shapes.len()).map(|i| (i, gain(i))).collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    let total: f64 = {
        let names = arena.fit(&fit.model, Vec::new());
        names.rss - fit.rss
    };
    let n = arena.rows.samples.len() as f64;
    let (main, main_gain) = order[0];
    let shape = fit.shapes[main].shape;
    let range = arena.table.ground.range(shape.variable);
    let rest = arena.without_shape(fit, main);
    let freedom = (arena.m() - fit.basis.rank() as f64).max(1.0);
    let k = fit.shapes[main].white.ncols();
    let test = super::significance::Significance::new(k, freedom);
    let surprise =
        test.of(main_gain / rest.rss.max(1e-300)) - 0.5 * shape.tried.max(1.0).ln() - 3.0_f64.ln();
    Unexplained {
        present: true,
        p: arena.family_p(surprise, fit).p,
        rms_mm: (total.max(0.0) / n).sqrt() * mean_sigma_mm(arena),
        place: Some(shape.place(range, prismatic)),
        resembles,
        says: format!("{}; no effect of the catalogue explains it", shape.says()),
        shapes: order
            .iter()
            .map(|(i, _)| {
                let placed = &fit.shapes[*i];
                (placed.shape, placed.coefficients.iter().copied().collect())
            })
            .collect(),
    }
}

/// What the conditions forbid, and names of which nothing is left beside the base.
pub(super) fn not_testable(arena: &Arena, base: &Fit) -> Vec<NotTestable> {
    let mut all = arena.table.not_testable.clone();
    let projected = arena.projected(&base.basis);
    let mut seen: Vec<(&'static str, usize, bool, bool)> = Vec::new();
    for candidate in &arena.table.candidates {
        let Some(term) = candidate.what.term() else {
            continue;
        };
        let about = term.effect.about();
        let visible = arena.factor(&projected, candidate).1 > 0;
        match seen
            .iter_mut()
            .find(|s| s.0 == about.id && s.1 == term.joint)
        {
            Some(one) => one.2 |= visible,
            None => seen.push((about.id, term.joint, visible, about.per_joint)),
        }
    }
    for (effect, joint, visible, per_joint) in seen {
        if !visible {
            all.push(NotTestable {
                effect,
                joint: per_joint.then_some(joint),
                because:
                    "in these samples it cannot be told from joint-zero-offset and link-length"
                        .to_owned(),
            });
        }
    }
    all
}

fn outliers(
    problem: &crate::identification::problem::Problem,
    after: &Deviations,
    suspected: &[bool],
) -> Vec<Outlier> {
    let mut outliers: Vec<Outlier> = (0..suspected.len())
        .filter(|i| problem.fit[*i] && suspected[*i])
        .map(|sample| Outlier {
            sample,
            deviation_mm: after.length_mm[sample],
        })
        .collect();
    outliers.sort_by(|a, b| b.deviation_mm.total_cmp(&a.deviation_mm));
    outliers
}
