//! The information of candidate poses about the geometry of a robot with several joints, added to what is known, and
//! the best of them (D-optimality): chosen greedily and exchanged, then exchanged for poses around them.
//!
//! ```text
//! C⁻¹ = diag(σ⁻²) + J₀ᵀJ₀ + Σ JᵢᵀJᵢ
//! ```
//!
//! with σ the weak priors and the stated places of targets, and J₀ the rows of what was measured before.

use super::arm::CANDIDATES;
use nalgebra::{DMatrix, DVector};

use super::arm::Arm;
use super::candidate::Candidate;
use super::covariance::inverse;
use super::exchange::{Criterion, choose, exchange};
use super::forecast::Workspace;
use super::imagined::shown;
use super::information::Information;
use super::plan::{ExpectedError, Forecast};
use super::rows::free;
use crate::budget;
use crate::effects::{JointValues, Term};
use crate::fit::gauge;
use crate::fit::priors::Priors;
use crate::fit::problem::Problem;
use crate::fit::unseen::ANYWHERE;
use crate::model::Model;

/// How far around, as shares of the joint ranges, round by round.
const NEAR: [f64; 2] = [0.12, 0.04];

/// Candidates and what they show.
pub(crate) struct CandidateSet {
    pub(crate) candidates: Vec<Candidate>,
    pub(crate) information: Information,
    /// The base model without what no candidate shows.
    model: Model,
    /// Samples that were measured before.
    pub(crate) before: usize,
    /// The information of what was measured and of the stated places of targets: all but the weak priors.
    measured: DMatrix<f64>,
    workspace: Workspace,
}

impl Arm {
    /// Candidates in addition to what was measured. Without a model their coefficients are determined here.
    fn set(&self, candidates: Vec<Candidate>, model: Option<&Model>) -> CandidateSet {
        let whole = self.with(&candidates, false);
        let before = self.session.samples.len();
        let mut problem = Problem::observing(&whole, JointValues::Commanded);
        problem.priors = self.priors.clone();
        let gauged = || gauge::gauged(&problem, &self.base);
        let model = model.map_or_else(gauged, Model::clone);
        let (rows, mut measured) = shown(&whole, &model);
        rows.add_to(&mut measured, 0..before);
        let known = self.prior_information(&model) + &measured;
        let mut stated = self.priors.clone();
        stated.weak = false;
        measured += precision(&stated, &model, |_, _| 0.0);
        let rows = rows.from(before);
        let everything = &measured + rows.information();
        CandidateSet {
            workspace: Workspace::new(&problem, &model, &everything),
            information: Information::new(rows, inverse(&known)),
            candidates,
            model,
            before,
            measured,
        }
    }

    /// The prior information on the free coefficients of a model.
    pub(crate) fn prior_information(&self, model: &Model) -> DMatrix<f64> {
        precision(&self.priors, model, |term, k| {
            let kind = model.robot.joints[term.joint].kind;
            ANYWHERE[usize::from(!term.effect.about().form.turns(k, kind))].powi(-2)
        })
    }

    /// Candidates over the joint ranges in addition to what was measured; `None` where there are none.
    pub(crate) fn spread(&self) -> Option<CandidateSet> {
        let candidates = self.candidates(CANDIDATES, true, &mut self.random(1));
        (!candidates.is_empty()).then(|| self.set(candidates, None))
    }

    /// Poses at random, that show what the candidates of a set do.
    pub(crate) fn at_random(&self, set: &CandidateSet, count: usize) -> CandidateSet {
        let candidates = self.candidates(count, false, &mut self.random(9));
        self.set(candidates, Some(&set.model))
    }

    /// So many poses, chosen of a set and improved around what was chosen.
    pub(crate) fn designed(&self, set: &CandidateSet, count: usize) -> CandidateSet {
        let mut own = set.at(&set.chosen(count));
        for (round, near) in NEAR.into_iter().enumerate() {
            let around = self.around(&own, near, &mut self.random(2 + round as u64));
            let mut order: Vec<usize> = (0..own.len()).collect();
            own.extend(around);
            let mut next = self.set(own, Some(&set.model));
            for k in &order {
                next.information.take(*k);
            }
            exchange(&mut next.information, &mut order, budget::ROUNDS);
            own = next.at(&order);
        }
        self.set(own, Some(&set.model))
    }
}

/// The inverse variances of the free coefficients beforehand, on a diagonal.
fn precision(
    priors: &Priors,
    model: &Model,
    unknown: impl Fn(&Term, usize) -> f64,
) -> DMatrix<f64> {
    let each = free(model).map(|(_, term, k)| {
        let sigma = priors.sigma(model, term, k);
        sigma.map_or_else(|| unknown(term, k), |sigma| sigma.powi(-2))
    });
    DMatrix::from_diagonal(&DVector::from_vec(each.collect()))
}

impl CandidateSet {
    fn at(&self, places: &[usize]) -> Vec<Candidate> {
        let own = places.iter().map(|k| self.candidates[*k].clone());
        own.collect()
    }

    /// So many candidates, greedily and then exchanged.
    pub(crate) fn chosen(&self, count: usize) -> Vec<usize> {
        let mut information = self.information.clone();
        let mut order = choose(&mut information, count);
        exchange(&mut information, &mut order, budget::ROUNDS);
        order
    }

    /// The expected error after each of so many candidates, greedily.
    pub(crate) fn trace(&self, count: usize) -> Vec<ExpectedError> {
        let mut information = self.information.clone();
        let order = choose(&mut self.information.clone(), count);
        let after = |k: &usize| {
            information.take(*k);
            self.workspace.error(&information.covariance)
        };
        order.iter().map(after).collect()
    }

    /// What is to be expected once these candidates are measured too.
    pub(crate) fn forecast(&self, of: &[usize]) -> Forecast {
        let mut information = self.information.clone();
        for k in of {
            information.take(*k);
        }
        let mut gram = self.measured.clone();
        information.rows.add_to(&mut gram, of.iter().copied());
        let count = self.before + of.len();
        self.workspace
            .forecast(&information.covariance, &gram, count)
    }
}
