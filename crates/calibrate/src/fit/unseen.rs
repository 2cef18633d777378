//! Combinations that the measured poses do not determine, at their values expected by the priors.
//!
//! The gauge holds at zero what is linearly dependent on what comes before it, and so attributes all of it to the
//! frame and the tool. Where every pose of the joint ranges has the same dependency that is a choice of names. Where
//! only the *measured* poses have it (two of them, one joint that was swept) it is a claim about all others: a tool 3
//! mm to the side that was a zero offset leads off wherever the wrist is turned. Such a combination d moves along its
//! line to where it is expected, by the priors of this robot's own width (`prior_scale`), and is as uncertain as they
//! are:
//!
//! ```text
//! J d = 0 at the measured poses and not over the joint ranges,   D = (d₁ d₂ …)
//! x += D a,   a = −(Dᵀ P D)⁻¹ Dᵀ P x,   C += D (Dᵀ P D)⁻¹ Dᵀ,   P = diag(1/σ²)
//! ```
//!
//! averaged over the widths that are possible, each by its likelihood.
//! That is the mean of the posterior, and no model is expected to be nearer to the real robot under the same prior,
//! the nominal one included.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::effects::{FixedMask, Inputs, LINK_GEOMETRY, Role, Term};
use crate::linear::Kept;
use crate::model::Model;
use crate::thresholds::NOTHING_MM;

use super::base_model;
use super::gap::{Spread, lengths_mm};
use super::gauge::{COPY, MOST_SEEN, columns};
use super::prior_scale;
use super::priors::{Priors, of_one_target};
use super::problem::Problem;
use super::ranges::over_the_ranges;
use super::solver::{Solution, equations_at, solution_at, solve};

/// How far an instrument may be from where it is assumed to be, where nothing is known: any turn alike, of which the
/// standard deviation is π/√3, and a room of some metres, rad and mm.
pub(crate) const ANYWHERE: [f64; 2] = [1.8, 1000.0];
/// The nonlinearity over so long a line may raise the RMS error by at most this (a tenth of its last printed digit) …
const MOST_WORSE: f64 = 1.002;

/// Combinations of coefficients that no sample shows, of a model with every link in it.
pub(super) struct Unseen {
    /// The model with every link, and nothing held but places.
    pub(super) model: Model,
    /// The coefficients that were held in it.
    held: Vec<bool>,
    /// One combination a column, over all coefficients.
    pub(super) combinations: Vec<DVector<f64>>,
}

impl Unseen {
    pub(super) fn of(problem: &Problem, model: &Model) -> Self {
        let model = with_every_link(model);
        let held: Vec<bool> = model
            .columns()
            .map(|(term, k)| term.held.contains(k))
            .collect();
        let model = nothing_held(&model);
        let rows = columns(problem, &model);
        let mut basis = Kept::new(rows.nrows());
        for k in (0..held.len()).filter(|k| !held[*k]) {
            let column = rows.column(k).into_owned();
            let free = basis.reject(&column);
            if free.norm() > COPY * column.norm() {
                basis.push(k, &column, &free);
            }
        }
        let mut combinations = Vec::new();
        for k in (0..held.len()).filter(|k| held[*k]) {
            let column = rows.column(k).into_owned();
            if basis.reject(&column).norm() > MOST_SEEN * column.norm() {
                continue;
            }
            let mut own = DVector::zeros(held.len());
            for (of, part) in basis.parts(&column) {
                own[of] = -part;
            }
            own[k] = 1.0;
            combinations.push(own);
        }
        Self {
            model,
            held,
            combinations,
        }
    }

    /// How far each combination moves every pose, mm: one column a combination.
    pub(super) fn moved_mm(&self, inputs: &Inputs) -> Vec<Vec<f64>> {
        let mut all = vec![Vec::with_capacity(inputs.len()); self.combinations.len()];
        self.model.visit(inputs, true, |_, block| {
            for (own, moved) in self.combinations.iter().zip(&mut all) {
                for i in 0..block.len {
                    let along = |axis: usize| -> f64 {
                        let along = own.iter().zip(&block.columns);
                        along.map(|(d, column)| d * column[axis][i]).sum()
                    };
                    moved.push((0..3).map(|axis| along(axis).powi(2)).sum::<f64>().sqrt());
                }
            }
        });
        all
    }

    /// Keeps those of the robot, or of the instrument alone, that do anything over the joint ranges: where one does not it
    /// is another name for the same. How an instrument is turned about the line through two places is no matter of the
    /// robot's commands.
    pub(super) fn retain_what_matters(&mut self, inputs: &Inputs, of_robot: bool) {
        let of_frame: Vec<bool> = self
            .model
            .columns()
            .map(|(term, _)| term.effect.about().role == Role::FreeFrame)
            .collect();
        let mut largest = vec![[0.0_f64; 3]; self.combinations.len()];
        self.model.visit(inputs, true, |_, block| {
            for (own, [all, robots, part]) in self.combinations.iter().zip(&mut largest) {
                for i in 0..block.len {
                    let (mut frame, mut robot) = (Vector3::zeros(), Vector3::zeros());
                    for (k, (d, column)) in own.iter().zip(&block.columns).enumerate() {
                        let by = Vector3::from_fn(|axis, _| d * column[axis][i]);
                        *part = part.max(by.norm());
                        *(if of_frame[k] { &mut frame } else { &mut robot }) += by;
                    }
                    *all = all.max((frame + robot).norm());
                    *robots = robots.max(robot.norm());
                }
            }
        });
        let mut largest = largest.into_iter();
        self.combinations.retain(|_| {
            let is_kept = |[all, robots, part]: [f64; 3]| {
                let least = MOST_SEEN * part;
                all > least && (robots > least) == of_robot
            };
            largest.next().is_some_and(is_kept)
        });
    }
}

/// The prior of every coefficient, whether or not priors hold in the fit.
pub(super) fn beforehand(priors: &Priors, model: &Model) -> Vec<f64> {
    let known = |(term, k): (&Term, usize)| {
        let about = term.effect.about();
        let [turn, move_mm] = ANYWHERE;
        let turns = about.form.turns(k, model.robot.joints[term.joint].kind);
        let of_base = about.role.is_of_every_calibration();
        let anywhere = if turns { turn } else { move_mm };
        let unknown = if of_base { anywhere } else { f64::INFINITY };
        priors.sigma(model, term, k).unwrap_or(unknown)
    };
    model.columns().map(known).collect()
}

/// A solution with what no sample shows where it is likeliest.
pub(crate) struct Completed {
    /// It, with links that the gauge had left out.
    pub(crate) solution: Solution,
    /// Of its coefficients.
    pub(crate) covariance: Option<DMatrix<f64>>,
}

/// `None` where the samples determine everything that matters, or there is no prior.
pub(crate) fn completed(
    problem: &Problem,
    solution: &Solution,
    covariance: Option<&DMatrix<f64>>,
) -> Option<Completed> {
    let several = solution.model.robot.joints.len() > 1;
    // Of targets whose own places are fitted nothing determines the tool: there is no likeliest place between them.
    let is_open = |term: &Term| {
        of_one_target(term) && (0..term.coefficients.len()).any(|k| !term.held.contains(k))
    };
    if !several
        || !problem.priors.weak
        || !problem.priors.size.is_empty()
        || solution.model.terms().iter().any(is_open)
    {
        return None;
    }
    let mut unseen = Unseen::of(problem, &solution.model);
    unseen.retain_what_matters(&over_the_ranges(problem), true);
    if unseen.combinations.is_empty() {
        return None;
    }
    let free = Solution {
        model: unseen.model.clone(),
        ..solution.clone()
    };
    let normal = equations_at(problem, &free);
    let possible = prior_scale::possible(&problem.priors, &free.model, &normal, problem.rows());
    let possible = possible.unwrap_or_else(|| vec![(problem.priors.ln_scale, 1.0)]);
    let before = DVector::from_vec(free.model.coefficients());
    let all = DMatrix::from_columns(&unseen.combinations);
    let mut along = Vec::new();
    for (ln_scale, share) in possible {
        let priors = Priors {
            ln_scale,
            ..problem.priors.clone()
        };
        let sigma = beforehand(&priors, &free.model);
        let weighted = DMatrix::from_fn(all.nrows(), all.ncols(), |i, j| {
            all[(i, j)] / (sigma[i] * sigma[i])
        });
        let spread = all.tr_mul(&weighted).cholesky()?;
        along.push((
            share,
            -spread.solve(&weighted.tr_mul(&before)),
            spread.inverse(),
        ));
    }
    let shares: f64 = along.iter().map(|own| own.0).sum();
    let mut mean = DVector::zeros(all.ncols());
    for (share, by, _) in &along {
        mean += by * (share / shares);
    }
    let mut open = DMatrix::zeros(all.ncols(), all.ncols());
    for (share, by, spread) in &along {
        let off = by - &mean;
        open += (spread + &off * off.transpose()) * (share / shares);
    }
    let likeliest = &before + &all * mean;
    let completed = followed(problem, solution, &unseen, &likeliest)?;
    let of_seen = covariance.map(|seen| {
        let mut own = &all * open * all.transpose();
        let at = places(&solution.model, &unseen.model);
        for (i, a) in at.iter().enumerate() {
            for (j, b) in at.iter().enumerate() {
                own[(*a, *b)] += seen[(i, j)];
            }
        }
        own
    });
    Some(Completed {
        solution: completed,
        covariance: of_seen,
    })
}

/// The geometry that follows the samples with the undetermined combinations at these values; nonlinearity would lead
/// off otherwise. `None` where it does not.
fn followed(
    problem: &Problem,
    solution: &Solution,
    unseen: &Unseen,
    coefficients: &DVector<f64>,
) -> Option<Solution> {
    let model = unseen.model.with_coefficients(coefficients.as_slice());
    let mut held = unseen.held.iter();
    let gauged = model.with_each(|_, _| {});
    let terms = gauged.terms().iter().map(|term| {
        let mut term = term.clone();
        for k in 0..term.coefficients.len() {
            if *held.next().unwrap_or(&true) {
                term.held = term.held.with(k);
            }
        }
        term
    });
    let gauged = Model::new(model.robot.clone(), terms.collect());
    let start = gauged.with_each(|_, term| {
        if !base_model::belongs(term.effect.about().id) {
            term.held = (0..term.coefficients.len()).fold(term.held, FixedMask::with);
        }
    });
    let fitted = solve(problem, &start);
    let there = Solution {
        model: gauged.with_coefficients(&fitted.model.coefficients()),
        ..solution.clone()
    };
    let there = solution_at(problem, &there);
    let residual_mm = |model: &Model| {
        let lengths_mm = lengths_mm(problem, model);
        Spread::of(&lengths_mm, |i| problem.used[i], |_| false).map_or(0.0, |spread| spread.rms_mm)
    };
    let follows =
        residual_mm(&there.model) <= MOST_WORSE * residual_mm(&solution.model) + NOTHING_MM;
    let most = MOST_WORSE * MOST_WORSE * solution.cost;
    (follows && there.cost <= most).then_some(there)
}

/// The indices of the coefficients of a model among those of the same with more terms.
fn places(model: &Model, wider: &Model) -> Vec<usize> {
    let mut first = 0;
    let wide: Vec<(usize, &Term)> = wider
        .terms()
        .iter()
        .map(|term| {
            let at = first;
            first += term.coefficients.len();
            (at, term)
        })
        .collect();
    let of = |term: &Term| wide.iter().find(|(_, own)| own.same_column(term));
    let at = |term: &Term| of(term).map_or(0, |own| own.0);
    let all = model.terms().iter();
    all.flat_map(|term| (0..term.coefficients.len()).map(move |k| at(term) + k))
        .collect()
}

/// The model with a column for every coefficient: what is held has none.
#[doc(hidden)]
pub fn nothing_held(model: &Model) -> Model {
    model.with_each(|_, term| {
        if term.effect.about().role != Role::Place {
            term.held = FixedMask::default();
        }
    })
}

/// The model with the links that the gauge has left out, as nothing of them is determined.
fn with_every_link(model: &Model) -> Model {
    let id = LINK_GEOMETRY.about().id;
    let is_there = |joint: usize| {
        model
            .terms()
            .iter()
            .any(|t| t.effect.about().id == id && t.joint == joint)
    };
    let joints = 0..model.robot.joints.len();
    let left_out: Vec<usize> = joints.filter(|joint| !is_there(*joint)).collect();
    left_out.into_iter().fold(model.clone(), |model, joint| {
        let mut term = Term::absent(&LINK_GEOMETRY, joint, 0.0);
        for k in 0..term.coefficients.len() {
            term.held = term.held.with(k);
        }
        model.with_term(term)
    })
}
