//! Parameters that do not enter linearly (an order, a time, a fade) are scanned: each candidate
//! is scored by how much it would lower the cost in one step from the current model,
//!
//! ```text
//! Δc = hᵀ (G_cc − G_cb G_bb⁻¹ G_bc)⁻¹ h,   h = g_c − G_cb G_bb⁻¹ g_b
//! ```
//!
//! with b the model's coefficients and c the candidate's. The best is taken.

use super::solver::COARSE_BLOCKS;
use nalgebra::DVector;

use crate::effects::{Setting, Survey, Term, stated_orders};
use crate::lanes::LANES;
use crate::model::Model;
use crate::numeric::extent;

use super::normal::{Normal, Sums};
use super::problem::Problem;
use super::solver::solve;
use super::spectrum::Spectrum;

/// Candidates that are scored in one pass over the samples.
const AT_ONCE: usize = 16;
/// Whole orders are parted into no more.
const MOST_PARTS: u16 = 4;

/// The nominal model with all the terms, those with a setting at their best one.
pub(crate) fn with_best_settings(problem: &Problem, nominal: &Model, terms: Vec<Term>) -> Model {
    let is_scanned = |t: &Term| t.effect.about().setting.is_scanned();
    let (scanned, plain): (Vec<Term>, Vec<Term>) = terms.into_iter().partition(is_scanned);
    let mut model = plain
        .into_iter()
        .fold(nominal.clone(), |m, t| m.with_term(t));
    for term in scanned {
        let base = solve(problem, &model).model;
        let settings = settings(problem, &term);
        let best = best_setting(problem, &base, &term, &settings);
        let setting = best.unwrap_or(term.setting);
        model = base.with_term(Term { setting, ..term });
    }
    model
}

/// The settings that a scan tries.
pub(crate) fn settings(problem: &Problem, term: &Term) -> Vec<f64> {
    match term.effect.about().setting {
        Setting::None | Setting::Setup | Setting::Target | Setting::Place => vec![term.setting],
        Setting::Order { from, to } => {
            let fractions = term.effect.about().setting.takes_fractions();
            let parts = if fractions {
                parts_of_an_order(problem, term.joint)
            } else {
                1
            };
            let mut all: Vec<f64> = (from * parts..=to * parts)
                .map(|k| f64::from(k) / f64::from(parts))
                .collect();
            if fractions {
                all.extend(stated_orders(&problem.session.robot, term.joint).map(|s| s.order));
                all.sort_by(f64::total_cmp);
                all.dedup();
            }
            all
        }
        Setting::Fade => fades(problem, term.joint),
        Setting::Time => times(problem),
        Setting::Listed(listed) => {
            let survey = Survey::new(problem.session, &problem.inputs);
            (listed.tried)(&survey, term.joint)
        }
    }
}

/// Orders between whole ones have to be tried over more than a turn: waves of half a step more or less are then out of
/// step at the ends by no more than six tenths of a cycle, and keep a quarter of what they explain.
fn parts_of_an_order(problem: &Problem, joint: usize) -> u16 {
    let [low, high] = extent(problem.inputs.q[joint].iter());
    let turns = (high - low) / std::f64::consts::TAU;
    (1..MOST_PARTS)
        .find(|parts| turns <= f64::from(*parts) + 0.2)
        .unwrap_or(MOST_PARTS)
}

/// Fades from a fiftieth of the joint's range to all of it, by factors of about 1.6.
fn fades(problem: &Problem, joint: usize) -> Vec<f64> {
    let q = &problem.inputs.q[joint];
    let (low, high) = q
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(*v), b.max(*v))
        });
    let span = (high - low).max(f64::MIN_POSITIVE);
    (0..=8)
        .map(|k| span * 0.02 * 50.0_f64.powf(f64::from(k) / 8.0))
        .collect()
}

/// Times between samples, at least a tenth of the samples on either side, at most 200 of them.
fn times(problem: &Problem) -> Vec<f64> {
    let Some(time_s) = &problem.inputs.time_s else {
        return Vec::new();
    };
    let mut sorted: Vec<f64> = time_s.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    let (from, to) = (n.div_ceil(10).max(1), n - n / 10);
    let stride = (to.saturating_sub(from) / 200).max(1);
    (from..to)
        .step_by(stride)
        .map(|i| 0.5 * (sorted[i - 1] + sorted[i]))
        .collect()
}

/// The setting that would lower the cost most.
pub(crate) fn best_setting(
    problem: &Problem,
    base: &Model,
    term: &Term,
    settings: &[f64],
) -> Option<f64> {
    let scored = settings
        .chunks(AT_ONCE)
        .flat_map(|chunk| score(problem, base, term, chunk));
    let best = scored.max_by(|a, b| a.1.total_cmp(&b.1));
    best.map(|(setting, _)| setting)
}

fn score(problem: &Problem, base: &Model, term: &Term, settings: &[f64]) -> Vec<(f64, f64)> {
    let absent = |setting: f64| Term::absent(term.effect, term.joint, setting);
    let all = settings
        .iter()
        .fold(base.clone(), |m, s| m.with_term(absent(*s)));
    let mut normal = Normal::new(all.coefficient_count());
    let blocks: Vec<usize> = (0..problem.inputs.len()).step_by(LANES).collect();
    let stride = blocks.len().div_ceil(COARSE_BLOCKS);
    let starts = blocks.into_iter().step_by(stride);
    all.visit_blocks(&problem.inputs, true, starts, |start, block| {
        normal.add(problem, start, block, Sums::All);
    });
    normal.complete();
    let mut columns = Vec::new();
    let mut base_columns = Vec::new();
    let mut first = 0;
    for candidate in all.terms() {
        let own = first..first + candidate.coefficients.len();
        first = own.end;
        let is_candidate = candidate.effect.about().id == term.effect.about().id
            && candidate.joint == term.joint
            && settings.contains(&candidate.setting)
            && candidate.coefficients.iter().all(|c| *c == 0.0);
        if is_candidate {
            columns.push((candidate.setting, own.collect::<Vec<_>>()));
        } else {
            base_columns.extend(own);
        }
    }
    columns
        .into_iter()
        .map(|(setting, own)| (setting, gain(&normal, &base_columns, &own)))
        .collect()
}

/// How much the cost would fall with the candidate's columns added to the base's.
fn gain(normal: &Normal, base: &[usize], own: &[usize]) -> f64 {
    let lowered = |columns: &[usize]| {
        let gram = normal.gram.select_rows(columns).select_columns(columns);
        let gradient =
            DVector::from_iterator(columns.len(), columns.iter().map(|k| normal.gradient[*k]));
        Spectrum::new(&gram).step(&gradient, 0.0).dot(&gradient)
    };
    let both: Vec<usize> = base.iter().chain(own).copied().collect();
    lowered(&both) - lowered(base)
}
