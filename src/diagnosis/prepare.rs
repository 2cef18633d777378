//! From a session to the arena: samples that count, robust base fit, candidates, noise.
//!
//! A long session is searched on an evenly spread part of its samples. Nothing that matters in
//! practice (0.3 of the noise, root mean square, λ = 45 in 500 samples) can well hide from them; values and
//! gaps then come from all of them.

use crate::effects::{Survey, Term, find};
use crate::identification::gap::deviations;
use crate::identification::problem::Problem;
use crate::identification::robust::suspects;
use crate::identification::{
    DEFAULT_EFFECTS, NotIdentifiable, base_model, fit_without_outliers, free_frames,
};
use crate::model::Model;
use crate::sessions::Session;

use super::arena::{Arena, Fit};
use super::blunders::DataProblem;
use super::candidates::Table;
use super::evidence::{Noise, Rows};
use super::held_out::Folds;
use super::incomplete;
use super::search::{Found, Search};
use super::{DiagnoseError, Options, Watch};

/// A session of more samples than this is long …
const LONG: usize = 600;
/// … and the search looks at so many of them.
const MOST_SAMPLES: usize = 500;

/// See the module.
pub(super) struct Prepared<'a> {
    /// All samples.
    pub(super) problem: Problem<'a>,
    pub(super) survey: Survey,
    pub(super) arena: Arena<'a>,
    pub(super) folds: Folds,
    /// Samples that `--held-out` locks away.
    pub(super) locked: Vec<bool>,
    /// What was said of samples that lack a condition.
    pub(super) incomplete: Option<DataProblem>,
    /// What of the base the samples cannot tell from the rest.
    pub(super) not_identifiable: Vec<NotIdentifiable>,
    options: Options,
}

impl<'a> Prepared<'a> {
    pub(super) fn new(session: &'a Session, options: &Options) -> Result<Self, DiagnoseError> {
        let mut problem = Problem::new(session, options.joint_values);
        if problem.samples() == 0 {
            return Err(DiagnoseError::NothingToFit);
        }
        let incomplete = incomplete::leave_out(&mut problem);
        let locked = locked(&problem, options.held_out);
        for (fit, locked) in problem.fit.iter_mut().zip(&locked) {
            *fit &= !locked;
        }
        problem.used.clone_from(&problem.fit);
        if problem.samples() == 0 {
            return Err(DiagnoseError::NothingToFit);
        }
        let survey = Survey::new(session, &problem.inputs);
        let (base, not_identifiable) = if base_model::is_arm(session) {
            arm(session, &mut problem, options)
        } else {
            let start = single_joint(session, &problem, &survey, options);
            (fit_without_outliers(&mut problem, &start).model, Vec::new())
        };
        keep_clusters(&mut problem);
        let arena = arena(&problem, &base, &survey, options);
        let folds = Folds::new(&arena);
        Ok(Self {
            problem,
            survey,
            arena,
            folds,
            locked,
            incomplete,
            not_identifiable,
            options: options.clone(),
        })
    }

    pub(super) fn search(&self, options: &Options, watch: Watch) -> Result<Found, DiagnoseError> {
        let samples = self.arena.rows.samples.len();
        let cap = samples.div_ceil(10).min(12);
        let most = options.max_effects.map_or(cap, |most| most.min(cap));
        let search = Search {
            arena: &self.arena,
            folds: &self.folds,
            most,
            watch,
        };
        Ok(search.run()?)
    }

    pub(super) fn options(&self) -> &Options {
        &self.options
    }

    /// Looks again at outliers and noise with what was found; whether the search has to be done
    /// again.
    pub(super) fn reconsider(&mut self, found: &Found) -> bool {
        let before = self.problem.used.clone();
        let after = deviations(&self.problem, &found.fit.model);
        let suspected = suspects(&self.problem, &after);
        for i in 0..before.len() {
            self.problem.used[i] = self.problem.fit[i] && !suspected[i];
        }
        keep_clusters(&mut self.problem);
        let noise = noise_beside(&self.arena, Some(&found.fit));
        let same_noise = (noise.rho - self.arena.noise.rho).abs() < 0.1
            && noise.unequal == self.arena.noise.unequal;
        if self.problem.used == before && same_noise {
            return false;
        }
        let base = crate::identification::solver::solve(&self.problem, &self.arena.base).model;
        let mut arena = arena(&self.problem, &base, &self.survey, &self.options);
        if !same_noise {
            arena = Arena::new(
                arena.problem,
                arena.rows,
                Noise::clone(&noise),
                arena.table,
                arena.base,
                self.options.seed,
            );
        }
        self.folds = Folds::new(&arena);
        self.arena = arena;
        true
    }
}

/// The base of several joints, fitted; what only its priors keep in place stays there, as the search
/// has no rows for them.
fn arm(
    session: &Session,
    problem: &mut Problem,
    options: &Options,
) -> (Model, Vec<NotIdentifiable>) {
    let start = base_model::start(session, problem, |id| options.allowed.exists(id));
    let fitted = base_model::fit(problem, &start, true);
    let model = base_model::with_weak_held(problem, &fitted.solution.model);
    (model, fitted.held)
}

/// Terms that belong to every calibration: zero offset and link length, and free frames.
fn single_joint(session: &Session, problem: &Problem, survey: &Survey, options: &Options) -> Model {
    let mut terms = Vec::new();
    for id in DEFAULT_EFFECTS {
        let Some(effect) = find(id) else { continue };
        if !options.allowed.exists(id) {
            continue;
        }
        let joints = if effect.about().per_joint {
            survey.joints.len()
        } else {
            1
        };
        for joint in 0..joints {
            if effect.obstacle(survey, joint).is_none() {
                terms.push(Term::absent(effect, joint, 0.0));
            }
        }
    }
    terms.extend(free_frames(session, problem));
    Model::new(session.robot.clone(), terms)
}

fn arena<'a>(problem: &Problem<'a>, base: &Model, survey: &Survey, options: &Options) -> Arena<'a> {
    let problem = thinned(problem);
    let rows = Rows::of(&problem);
    let table = Table::new(&problem, &rows, base, survey, &options.allowed);
    let unit = Noise {
        sigma_mm: [1.0; 3],
        rho: 0.0,
        unequal: false,
        rho_evidence: 0.0,
    };
    let arena = Arena::new(problem, rows, unit, table, base.clone(), options.seed);
    let noise = noise_beside(&arena, None);
    Arena::new(
        arena.problem,
        arena.rows,
        noise,
        arena.table,
        arena.base,
        options.seed,
    )
}

/// Noise from a rich fit: the base (and what was found) with many candidates at once.
fn noise_beside(arena: &Arena, found: Option<&Fit>) -> Noise {
    let model = found.map_or(&arena.base, |f| &f.model);
    let (residual, columns) = arena.rows.extract(model);
    let rich = arena.table.raw.select_columns(&arena.table.rich);
    let shapes: usize = found.map_or(0, |f| f.shapes.iter().map(|s| s.raw.ncols()).sum());
    let width = columns.ncols() + shapes + rich.ncols();
    let mut all = nalgebra::DMatrix::zeros(arena.rows.len(), width);
    all.columns_mut(0, columns.ncols()).copy_from(&columns);
    let mut at = columns.ncols();
    for shape in found.iter().flat_map(|f| &f.shapes) {
        all.columns_mut(at, shape.raw.ncols()).copy_from(&shape.raw);
        at += shape.raw.ncols();
    }
    all.columns_mut(at, rich.ncols()).copy_from(&rich);
    Noise::estimate(&arena.problem, &arena.rows, &residual, &all)
}

/// The same problem with at most [`MOST_SAMPLES`] samples that count, spread evenly.
fn thinned<'a>(problem: &Problem<'a>) -> Problem<'a> {
    let mut thinned = problem.clone();
    let used: Vec<usize> = (0..problem.used.len())
        .filter(|i| problem.used[*i])
        .collect();
    if used.len() <= LONG {
        return thinned;
    }
    thinned.used.fill(false);
    // A step of the golden ratio inside each stretch, so that no rhythm of the poses is hit.
    for k in 0..MOST_SAMPLES {
        let (from, to) = (
            k * used.len() / MOST_SAMPLES,
            (k + 1) * used.len() / MOST_SAMPLES,
        );
        let inside = (k as f64 * 0.618_033_988_749_894_9).fract();
        let at = from + ((to - from) as f64 * inside) as usize;
        thinned.used[used[at.min(to - 1)]] = true;
    }
    thinned
}

/// Samples that `--held-out` locks away: every so many-th of 24 sectors of the first joint.
fn locked(problem: &Problem, share: Option<f64>) -> Vec<bool> {
    let n = problem.fit.len();
    let mut locked = vec![false; n];
    let Some(share) = share else { return locked };
    let q = &problem.inputs.q[0];
    let mut order: Vec<usize> = (0..n).filter(|i| problem.fit[*i]).collect();
    order.sort_by(|a, b| q[*a].total_cmp(&q[*b]).then(a.cmp(b)));
    let count = order.len();
    let sectors = 24.min(count.max(1));
    for (rank, sample) in order.into_iter().enumerate() {
        let sector = rank * sectors / count.max(1);
        // Sectors are taken whenever their share is due.
        let due = |k: usize| (k as f64 * share + 0.5).floor();
        locked[sample] = due(sector + 1) > due(sector);
    }
    locked
}

/// Suspects that stand together over a joint's angle are evidence of something local, not
/// accidents: they are put back.
fn keep_clusters(problem: &mut Problem) {
    let suspected: Vec<bool> = (0..problem.fit.len())
        .map(|i| problem.fit[i] && !problem.used[i])
        .collect();
    let count = suspected.iter().filter(|s| **s).count();
    let fitted = problem.fit.iter().filter(|f| **f).count();
    if count < RUN {
        return;
    }
    super::classes::keep(problem, &suspected);
    let share = count as f64 / fitted.max(1) as f64;
    for joint in 0..problem.inputs.q.len() {
        let q = &problem.inputs.q[joint];
        let mut order: Vec<usize> = (0..q.len()).filter(|i| problem.fit[*i]).collect();
        order.sort_by(|a, b| q[*a].total_cmp(&q[*b]).then(a.cmp(b)));
        let mut run: Vec<usize> = Vec::new();
        for k in 0..=order.len() {
            if let Some(sample) = order.get(k).filter(|s| suspected[**s]) {
                run.push(*sample);
                continue;
            }
            // So many in a row by accident: n·share^run.
            let accident = fitted as f64 * share.powi(i32::try_from(run.len()).unwrap_or(64));
            if run.len() >= RUN && accident < 0.01 {
                for sample in &run {
                    problem.used[*sample] = true;
                }
            }
            run.clear();
        }
    }
}

const RUN: usize = 3;
