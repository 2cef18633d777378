//! Values of the parameters with their intervals: one fit to all samples that count, by the same estimator that
//! `identify` uses, together with the shapes that no name explains.
//!
//! A search uses a part of a long session, and none of the samples that an option locks away; the names that it found
//! are fitted once more to all of them.

use nalgebra::DMatrix;

use crate::effects::Term;
use crate::fit::gap::{Spread, deviations, lengths_mm, over_fitted, rms_mm, set_aside};
use crate::fit::problem::Problem;
use crate::fit::solver::{Solution, solution_at, solve};
use crate::fit::unseen::{Completed, completed};
use crate::fit::{
    DEFAULT_EFFECTS, Estimate, Identification, NotIdentifiable, base_model, covariance_of,
    noise_given, outliers, parameters_of, report,
};
use crate::model::Model;
use crate::observations::figures::{coordinate_mm, whitened};
use crate::odds;
use crate::sessions::poses::ByPose;
use crate::thresholds::EQUAL;

use super::limits::gain_of;
use super::selection::Selection;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Significance;
use crate::diagnosis::search::OrderSpread;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::search::worth;

/// The largest number of values of shapes in a fit to all samples.
const MOST_SHAPE_VALUES: usize = 20_000_000;

/// A model fitted to all samples that count, and the covariance of its coefficients.
#[derive(Clone)]
pub(crate) struct Values<'a> {
    pub(crate) problem: Problem<'a>,
    pub(crate) solution: Solution,
    pub(crate) model: Model,
    /// Of the coefficients, inner units.
    pub(crate) covariance: Option<DMatrix<f64>>,
    /// One list for each term of the model.
    estimates: Vec<Vec<Estimate>>,
    /// Kurtosis of the residuals, and the size of their bulk in units of the noise.
    tails: (f64, f64),
    /// Whether a size was corrected for the selection.
    corrected: bool,
    /// Whether it holds what no sample shows.
    is_completed: bool,
}

impl<'a> Values<'a> {
    /// The names of a fit, fitted to the samples of a problem that count. Where the search was stopped the noise is
    /// that estimated with many candidates.
    pub(crate) fn of(
        prepared: &PreparedSearch,
        problem: &Problem<'a>,
        fit: &Fit,
        stopped: bool,
    ) -> Self {
        let mut problem = problem.clone();
        let width: usize = fit.shapes.iter().map(|s| s.raw.ncols()).sum();
        if width * problem.used.len() * 3 <= MOST_SHAPE_VALUES {
            problem.extra_columns = prepared
                .regression
                .table
                .space
                .on_all(&problem, &fit.shapes);
        }
        let of_kinds = problem.observed.is_some();
        if !of_kinds {
            problem.set_noise(&prepared.regression.noise, &fit.model);
        }
        let mut solution = solve(&problem, &fit.model);
        let rounds = if stopped || of_kinds { 0 } else { 2 };
        for _ in 0..rounds {
            let noise = noise_given(&problem, &solution.model, &solution.extra_coefficients);
            let known = problem.noise.as_ref();
            if known.is_some_and(|known| noise.whitens_like(known)) {
                break;
            }
            problem.set_noise(&noise, &solution.model);
            solution = solve(&problem, &solution.model);
        }
        let solution = base_model::with_own_widths(&mut problem, solution);
        let mut covariance = covariance_of(&problem, &solution);
        let spread = OrderSpread::of(&problem, &solution.model);
        if let (Some(spread), Some(covariance)) = (&spread, &mut covariance) {
            spread.add_to(covariance);
        }
        let mut estimates = parameters_of(&problem, &solution, covariance.as_ref());
        for (term, own) in solution.model.terms().iter().zip(&mut estimates) {
            if let Some(order) = own.iter_mut().find(|e| e.name == "order") {
                order.ci95 = spread.as_ref().and_then(|s| s.interval(term));
            }
        }
        let own = solution.model.coefficient_count();
        Self {
            model: solution.model.clone(),
            covariance: covariance
                .filter(|_| own > 0)
                .map(|c| c.view((0, 0), (own, own)).into_owned()),
            tails: tails(&problem, &solution),
            estimates,
            solution,
            problem,
            corrected: false,
            is_completed: false,
        }
    }

    /// White noise along each axis, mm.
    pub(crate) fn sigma_mm(&self) -> [f64; 3] {
        if let Some(layer) = &self.problem.observed
            && let Some(mm) = coordinate_mm(layer, &self.model, self.rank())
        {
            return [mm; 3];
        }
        let scale = self.white().0.sqrt();
        let noise = self.problem.noise.as_ref();
        noise.map_or([scale; 3], |n| n.sigma_mm.map(|s| s * scale))
    }

    /// Mean square of a whitened residual coordinate, its degrees of freedom, and the kurtosis of the residuals.
    pub(crate) fn white(&self) -> (f64, f64, f64) {
        let m = self.problem.rows() as f64;
        let freedom = (m - self.rank()).max(1.0);
        let unit = self.problem.observed.as_ref().map_or(1.0, |l| l.unit_mm);
        let cost = self.solution.cost / (unit * unit);
        (cost / freedom, freedom, self.tails.0)
    }

    /// The expected spread of returns to the same poses: mean square of a coordinate in units of its axis's white
    /// noise, including repeatability, and its degrees of freedom, then of poses.
    pub(crate) fn expected_of_returns(&self) -> (f64, f64) {
        let (white, freedom, _) = self.white();
        let noise = self.problem.noise.as_ref();
        if noise.is_none_or(|noise| noise.joints_rad == 0.0) {
            return (white, freedom);
        }
        let residuals = deviations(&self.problem, &self.model).axes_mm;
        let used = (0..self.problem.used.len()).filter(|i| self.problem.used[*i]);
        let used: Vec<usize> = used.collect();
        let axes = self.problem.axis_weights.iter().zip(&residuals);
        let square: f64 = axes
            .filter(|(weight, _)| **weight > 0.0)
            .map(|(weight, e)| used.iter().map(|i| weight * e[*i] * e[*i]).sum::<f64>())
            .sum();
        let pose = self.problem.inputs.select(&used).pose;
        let poses = ByPose::of(pose.as_deref(), used.len()).first.len();
        let of_poses = (poses * self.problem.axes()) as f64 - self.rank();
        (square / freedom, of_poses.max(1.0))
    }

    /// Size of the bulk of the residuals, from the median, in units of the noise.
    pub(crate) fn bulk(&self) -> f64 {
        self.tails.1
    }

    /// Number of combinations of coefficients that the samples determine.
    pub(crate) fn rank(&self) -> f64 {
        self.solution.spectrum.rank() as f64
    }

    pub(crate) fn noise_is_slow(&self) -> bool {
        let noise = self.problem.noise.as_ref();
        noise.is_some_and(|n| n.slow.is_some())
    }

    /// RMS residual of the samples that count, mm.
    pub(crate) fn rms_mm(&self) -> f64 {
        rms_mm(&self.problem, &self.model)
    }

    /// RMS residual of the model with the columns that were fitted with it, of the samples that count, mm.
    pub(crate) fn rms_with_shapes_mm(&self) -> f64 {
        let mut residuals = deviations(&self.problem, &self.model).axes_mm;
        for (column, coefficient) in self
            .problem
            .extra_columns
            .iter()
            .zip(&self.solution.extra_coefficients)
        {
            for (residuals, values) in residuals.iter_mut().zip(column) {
                for (e, value) in residuals.iter_mut().zip(values) {
                    *e -= coefficient * value;
                }
            }
        }
        let length = |i: usize| residuals.iter().map(|e| e[i] * e[i]).sum::<f64>().sqrt();
        let lengths: Vec<f64> = (0..self.problem.used.len()).map(length).collect();
        let spread = Spread::of(&lengths, |i| self.problem.used[i], |_| false);
        spread.map_or(0.0, |s| s.rms_mm)
    }

    /// Whether shapes were fitted with the model.
    pub(crate) fn has_shapes(&self) -> bool {
        !self.problem.extra_columns.is_empty()
    }

    /// Whether a size was corrected for the selection.
    pub(crate) fn is_corrected(&self) -> bool {
        self.corrected
    }

    /// The same values with the intervals of another fit, where it has them, extended to hold the value.
    #[must_use]
    pub(crate) fn with_intervals_of(mut self, other: &Self) -> Self {
        for (term, own) in self.model.terms().iter().zip(&mut self.estimates) {
            let theirs = other.parameters_of(term);
            for estimate in own {
                let same = theirs.iter().find(|t| t.name == estimate.name);
                let interval = same.and_then(|same| same.ci95).or(estimate.ci95);
                estimate.ci95 = interval.map(|interval| holding(estimate, interval));
            }
        }
        let same_terms = self.model.coefficient_count() == other.model.coefficient_count();
        if same_terms && other.covariance.is_some() {
            self.covariance.clone_from(&other.covariance);
        }
        self
    }

    /// This fit with the coefficients of a model of the same terms, and its intervals extended to hold them;
    /// `None` where the terms are others.
    pub(crate) fn at(&self, model: &Model) -> Option<Self> {
        let pairs = || self.model.terms().iter().zip(model.terms());
        let count = |model: &Model| model.terms().len();
        if count(&self.model) != count(model) || !pairs().all(|(a, b)| a.same_column(b)) {
            return None;
        }
        let mut there = self.clone();
        for (term, own) in model.terms().iter().zip(&mut there.estimates) {
            let kind = model.robot.joints[term.joint].kind;
            let parameters = term.parameters_on(kind);
            for estimate in own {
                let Some(value) = parameters.iter().find(|p| p.name == estimate.name) else {
                    continue;
                };
                estimate.value = value.value;
                let interval = estimate.ci95;
                estimate.ci95 = interval.map(|interval| holding(estimate, interval));
            }
        }
        there.model = model.clone();
        there.solution.model = model.clone();
        Some(there)
    }

    /// Subtracts the selection bias from the size of a term.
    pub(crate) fn correct(&mut self, term: &Term, selection: &Selection) {
        self.corrected = true;
        let mut terms = self.model.terms().iter();
        let Some(at) = terms.position(|t| t.same_column(term)) else {
            return;
        };
        let kind = self.model.robot.joints[term.joint].kind;
        let sizes = self.model.terms()[at].parameters_on(kind).len();
        let settings = sizes - selection.sized(term);
        for estimate in self.estimates[at].iter_mut().skip(settings) {
            selection.correct(estimate);
        }
        let mut first = 0;
        let mut coefficients = self.model.coefficients();
        for (k, own) in self.model.terms().iter().enumerate() {
            let size = own.coefficients.len();
            if k == at {
                let scaled = own.effect.about().form.coefficients_at_zero();
                for c in &mut coefficients[first..first + scaled] {
                    *c *= selection.factor;
                }
            }
            first += size;
        }
        self.model = self.model.with_coefficients(&coefficients);
        self.solution.model = self.model.clone();
    }

    /// Fits the geometry of several joints again with corrected sizes: it absorbs what an effect has in common with
    /// it. Where the residuals are larger nevertheless, as the sizes of several effects are correlated, the fit before
    /// is kept.
    pub(crate) fn refit_geometry(&mut self, before: &Self) {
        let is_base = |t: &Term| base_model::belongs(t.effect.about().id);
        let terms = self.model.terms();
        if self.model.robot.joints.len() < 2 || terms.iter().all(is_base) {
            return;
        }
        let start = Model::new(self.model.robot.clone(), self.with_names_held());
        let fitted = solve(&self.problem, &start).model;
        self.model = self.model.with_coefficients(&fitted.coefficients());
        if self.rms_mm() > EQUAL * before.rms_mm() {
            self.model = before.model.clone();
            self.estimates.clone_from(&before.estimates);
        }
        self.solution.model = self.model.clone();
    }

    /// The terms of the model, of which a fit changes the geometry alone.
    fn with_names_held(&self) -> Vec<Term> {
        let held = self.model.terms().iter().map(|term| {
            let mut term = term.clone();
            if !base_model::belongs(term.effect.about().id) {
                term.held =
                    (0..term.coefficients.len()).fold(term.held, crate::effects::FixedMask::with);
            }
            term
        });
        held.collect()
    }

    /// With undetermined combinations at their likeliest values ([`crate::fit::unseen`]). The model of `identify` is
    /// completed as `identify` does it, with the weights of the samples there.
    #[must_use]
    pub(crate) fn completed(mut self, prepared: &PreparedSearch) -> Self {
        let known = self.covariance.as_ref();
        let is_identified = self.model.coefficients() == prepared.base.coefficients();
        let own = if is_identified {
            let problem = &prepared.as_identified;
            let there = solution_at(problem, &self.solution);
            completed(problem, &there, known).map(|own| {
                let extra = self.solution.extra_coefficients.clone();
                let here = Solution {
                    extra_coefficients: extra,
                    ..own.solution
                };
                let solution = solution_at(&self.problem, &here);
                Completed { solution, ..own }
            })
        } else {
            completed(&self.problem, &self.solution, known)
        };
        let Some(own) = own else {
            return self;
        };
        let refitted = parameters_of(&self.problem, &own.solution, own.covariance.as_ref());
        self.estimates
            .resize(own.solution.model.terms().len(), Vec::new());
        for ((term, refitted), estimates) in
            (own.solution.model.terms().iter().zip(refitted)).zip(&mut self.estimates)
        {
            if base_model::belongs(term.effect.about().id) {
                *estimates = refitted;
            }
        }
        self.model = own.solution.model.clone();
        self.solution = own.solution;
        self.covariance = own.covariance;
        self.is_completed = true;
        self
    }

    /// Whether it holds what no sample shows.
    pub(crate) fn is_completed(&self) -> bool {
        self.is_completed
    }

    /// The same values on other samples of the session.
    pub(crate) fn on(&self, problem: &Problem<'a>) -> Self {
        let mut now = self.clone();
        now.problem = problem.clone();
        now.problem.priors = self.problem.priors.clone();
        if let (Some(noise), None) = (&self.problem.noise, &problem.observed) {
            now.problem.set_noise(noise, &self.model);
        }
        now
    }

    /// With what predicts without a name in the model, and the geometry fitted again with it and with a `curve`; the
    /// names keep their values. The change of the geometry shifts its intervals.
    pub(crate) fn with_unnamed(&self, unnamed: &[Term], curve: Option<&Term>) -> Self {
        let mut now = self.clone();
        now.problem.extra_columns.clear();
        let is_base = |t: &Term| base_model::belongs(t.effect.about().id);
        let alone = self.model.coefficients();
        let unnamed = unnamed
            .iter()
            .map(|term| term.with_geometry_alone_as(&alone));
        let unnamed: Vec<Term> = unnamed.collect();
        let curve = curve.cloned().into_iter();
        let all = [self.with_names_held(), curve.collect(), unnamed.clone()].concat();
        let fitted = solve(&now.problem, &Model::new(self.model.robot.clone(), all)).model;
        // They have no coefficients and are the last of all.
        let with = unnamed
            .iter()
            .fold(self.model.clone(), |m, t| m.with_term(t.clone()));
        now.model = with.with_coefficients(&fitted.coefficients());
        for (term, own) in self.model.terms().iter().zip(&mut now.estimates) {
            let kind = self.model.robot.joints[term.joint].kind;
            let moved = now.model.terms().iter().find(|t| t.same_column(term));
            let Some(moved) = moved.filter(|t| is_base(t)) else {
                continue;
            };
            let (before, after) = (term.parameters_on(kind), moved.parameters_on(kind));
            for ((estimate, before), after) in own.iter_mut().zip(before).zip(after) {
                let by = after.value - before.value;
                estimate.value += by;
                estimate.ci95 = estimate.ci95.map(|interval| interval.map(|v| v + by));
            }
        }
        now.estimates.resize(now.model.terms().len(), Vec::new());
        now.solution.model = now.model.clone();
        if self.has_shapes() {
            now.solution = solution_at(&now.problem, &now.solution);
        }
        now
    }

    /// This fit in the form of `identify`'s answer. The suspected samples are those that it left out: what no name
    /// explains is in the residuals again, and could make others suspect.
    pub(crate) fn identification(
        &self,
        nominal: &Model,
        not_identifiable: Vec<NotIdentifiable>,
    ) -> Identification {
        let session = self.problem.session;
        let mut answer = report(
            session,
            &self.problem,
            self.solution.clone(),
            nominal,
            not_identifiable,
        );
        answer.parameters = self.estimates.concat();
        answer.covariance.clone_from(&self.covariance);
        answer.model = self.model.settled();
        let problem = &self.problem;
        if problem.observed.is_some() {
            // Observations were judged one by one: of a sample one may be far off.
            return answer;
        }
        let [before, residuals] = [nominal, &self.model].map(|model| lengths_mm(problem, model));
        answer.gap.before = over_fitted(problem, &before).unwrap_or(answer.gap.before);
        answer.gap.after = over_fitted(problem, &residuals).unwrap_or(answer.gap.after);
        answer.outliers = outliers(&residuals, set_aside(problem).into_iter());
        answer
    }

    /// Estimates of one of its terms.
    pub(crate) fn parameters_of(&self, term: &Term) -> Vec<Estimate> {
        let mut terms = self.model.terms().iter();
        let at = terms.position(|t| t.same_column(term));
        at.map_or_else(Vec::new, |at| self.estimates[at].clone())
    }

    /// Estimates of the parameters of every calibration.
    pub(crate) fn identified(&self) -> Vec<Estimate> {
        let several = self.model.robot.joints.len() > 1 || self.problem.observed.is_some();
        let terms = self.model.terms().iter().zip(&self.estimates);
        let base = terms.filter(|(t, _)| {
            let id = t.effect.about().id;
            DEFAULT_EFFECTS.contains(&id) || several && base_model::belongs(id)
        });
        base.flat_map(|(_, own)| own.clone()).collect()
    }
}

/// An interval extended to contain the value of an estimate; a phase comes round after 360°.
fn holding(estimate: &Estimate, [low, high]: [f64; 2]) -> [f64; 2] {
    let value = estimate.value;
    let turns = if estimate.name.starts_with("phase") {
        360.0 * ((value - 0.5 * (low + high)) / 360.0).round()
    } else {
        0.0
    };
    [(low + turns).min(value), (high + turns).max(value)]
}

/// Takes out of every size what its selection adds; see [`super::selection`]. `fit` is that which the names
/// were selected in.
pub(crate) fn corrected_for_selection<'a>(
    prepared: &PreparedSearch,
    fit: &Fit,
    mut values: Values<'a>,
) -> Values<'a> {
    let regression = &prepared.regression;
    let threshold = regression.minus_ln_p_for(odds::TAKEN.chance(), fit);
    let before = (regression.base.robot.joints.len() > 1).then(|| values.clone());
    for term in regression.added(fit) {
        let reduced = worth(prepared, fit, term).reduced;
        let columns = fit.basis.rank().saturating_sub(reduced.basis.rank()).max(1);
        let freedom = (regression.m() - fit.basis.rank() as f64).max(2.0);
        let tried = 0.5 * regression.price_of_term(term);
        let share = Significance::new(columns, freedom).share_for(threshold + tried);
        let least = gain_of(share, freedom);
        let gain = freedom * (reduced.rss - fit.rss) / fit.rss.max(1e-300);
        if let Some(selection) = Selection::of(gain, least, columns) {
            values.correct(term, &selection);
        }
    }
    if let Some(before) = before {
        values.refit_geometry(&before);
    }
    values
}

/// Kurtosis and bulk of the residual coordinates, each axis in units of its own noise.
fn tails(problem: &Problem, solution: &Solution) -> (f64, f64) {
    let mut all = Vec::with_capacity(problem.rows());
    if let Some(layer) = &problem.observed {
        all.extend(whitened(layer, &solution.model).iter().map(|e| e.abs()));
    }
    let residuals = deviations(problem, &solution.model);
    let points = problem.observed.is_none();
    for (axis, values) in residuals.axes_mm.iter().enumerate() {
        let unit = problem.axis_weights[axis].sqrt();
        let used = values.iter().zip(&problem.used);
        let counts = used.filter(|(_, used)| points && unit > 0.0 && **used);
        all.extend(counts.map(|(e, _)| (e * unit).abs()));
    }
    tails_of(all)
}

/// Kurtosis of absolute values, that of a Gaussian at least, and the size of their bulk.
pub(super) fn tails_of(mut all: Vec<f64>) -> (f64, f64) {
    const OF_A_GAUSSIAN: f64 = 3.0;
    if all.is_empty() {
        return (OF_A_GAUSSIAN, 1.0);
    }
    let moment = |power: i32| all.iter().map(|e| e.powi(power)).sum::<f64>() / all.len() as f64;
    let (second, fourth) = (moment(2), moment(4));
    let middle = all.len() / 2;
    let (_, median, _) = all.select_nth_unstable_by(middle, f64::total_cmp);
    let kurtosis = if second > 0.0 {
        f64::max(fourth / (second * second), OF_A_GAUSSIAN)
    } else {
        OF_A_GAUSSIAN
    };
    (kurtosis, *median / 0.674_5)
}
