//! What candidate poses of a robot with several joints show of its geometry beside what is known, and the
//! best of them.

use nalgebra::{DMatrix, DVector};

use super::arm::Arm;
use super::candidates::Candidate;
use super::exchange::{Criterion, Information, choose, exchange};
use super::expected_rows::{ExpectedRows, shown};
use super::forecast::{ExpectedError, Forecast, Workspace};
use crate::effects::JointValues;
use crate::fit::gauge;
use crate::fit::problem::Problem;
use crate::model::Model;

/// Candidates of the first round.
const CANDIDATES: usize = 900;
/// How far around, as shares of the joint ranges, round by round.
const NEAR: [f64; 2] = [0.12, 0.04];
/// Passes of the exchange.
const PASSES: usize = 8;
/// Nothing is known of what has no prior, within this: mm, or rad.
const ANYTHING: [f64; 2] = [1e3, 1.0];

/// Candidates and what they show.
pub(crate) struct CandidateSet {
    pub(crate) candidates: Vec<Candidate>,
    /// What is not measured of it yet.
    pub(crate) information: Information,
    /// The base model without what no candidate shows.
    pub(crate) model: Model,
    columns: Vec<usize>,
    /// Rows of candidates and of what was measured before.
    pub(crate) shown: ExpectedRows,
    /// Samples that were measured before.
    pub(crate) before: usize,
    pub(crate) workspace: Workspace,
}

impl Arm {
    /// Candidates beside what was measured. Without a model it is found what they can show.
    fn bench(&self, candidates: Vec<Candidate>, model: Option<Model>) -> CandidateSet {
        let whole = self.with(&candidates, &self.writing(None));
        let before = self.session.samples.len();
        let mut problem = Problem::observing(&whole, JointValues::Commanded);
        problem.priors = self.priors.clone();
        let model = model.unwrap_or_else(|| gauge::gauged(&problem, &self.base));
        let (columns, known) = self.measured_information(&model);
        let mut shown = shown(&whole, &model, &columns);
        let information = shown.information(before, known);
        shown.information_of_priors += self.stated(&model, &columns);
        let mut workspace = Workspace::new(&problem, &model, &columns);
        workspace.can_show(&(shown.rows.tr_mul(&shown.rows) + &shown.information_of_priors));
        CandidateSet {
            candidates,
            information,
            model,
            columns,
            shown,
            before,
            workspace,
        }
    }

    /// The information about the targets' places that the session states.
    fn stated(&self, model: &Model, columns: &[usize]) -> DMatrix<f64> {
        let mut without = self.priors.clone();
        without.weak = false;
        let each = model.columns().map(|(term, k)| {
            let sigma = without.sigma(model, term, k);
            sigma.map_or(0.0, |s| s.powi(-2))
        });
        let each: Vec<f64> = each.collect();
        let of = columns.iter().map(|k| each[*k]);
        DMatrix::from_diagonal(&DVector::from_iterator(columns.len(), of))
    }

    /// The coefficients that are not held, and what is known of them beforehand.
    pub(crate) fn measured_information(&self, model: &Model) -> (Vec<usize>, DMatrix<f64>) {
        let free = model.columns().enumerate();
        let free = free.filter(|(_, (term, k))| !term.held.contains(*k));
        let (columns, precision) = free
            .map(|(column, (term, k))| {
                let kind = model.robot.joints[term.joint].kind;
                let anything = ANYTHING[usize::from(term.effect.about().form.turns(k, kind))];
                let sigma = self.priors.sigma(model, term, k);
                (column, sigma.unwrap_or(anything).powi(-2))
            })
            .unzip();
        let precision = DVector::from_vec(precision);
        (columns, DMatrix::from_diagonal(&precision))
    }

    /// Candidates over the joint ranges beside what was measured; `None` where there are none.
    pub(crate) fn spread(&self) -> Option<CandidateSet> {
        let candidates = self.candidates(CANDIDATES, true, &mut self.random(1));
        (!candidates.is_empty()).then(|| self.bench(candidates, None))
    }

    /// Poses at random, that show what the candidates of a bench do.
    pub(crate) fn at_random(&self, bench: &CandidateSet, count: usize) -> CandidateSet {
        let candidates = self.candidates(count, false, &mut self.random(9));
        self.bench(candidates, Some(bench.model.clone()))
    }

    /// So many poses, chosen of a bench and improved around what was chosen: all of the bench that comes
    /// out.
    pub(crate) fn designed(&self, bench: &CandidateSet, count: usize) -> CandidateSet {
        let chosen = bench.chosen(count);
        let mut own: Vec<Candidate> = chosen
            .iter()
            .map(|k| bench.candidates[*k].clone())
            .collect();
        for (round, near) in NEAR.into_iter().enumerate() {
            let next = self.refined(&own, near, round, bench);
            let mut order: Vec<usize> = (0..own.len()).collect();
            let mut information = next.information.clone();
            for k in &order {
                information.take(*k);
            }
            exchange(&mut information, &mut order, PASSES);
            own = order.iter().map(|k| next.candidates[*k].clone()).collect();
        }
        self.bench(own, Some(bench.model.clone()))
    }

    /// What was chosen, and poses around it.
    fn refined(
        &self,
        own: &[Candidate],
        near: f64,
        round: usize,
        bench: &CandidateSet,
    ) -> CandidateSet {
        let around = self.around(own, near, &mut self.random(2 + round as u64));
        let all = own.iter().cloned().chain(around).collect();
        self.bench(all, Some(bench.model.clone()))
    }
}

impl CandidateSet {
    /// So many candidates, greedily and then exchanged.
    pub(crate) fn chosen(&self, count: usize) -> Vec<usize> {
        let mut information = self.information.clone();
        let mut order = choose(&mut information, count);
        exchange(&mut information, &mut order, PASSES);
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
        let count = self.before + of.len();
        let measured = self.shown.rows.rows(0, self.shown.first[self.before]);
        let mut gram = measured.tr_mul(&measured) + &self.shown.information_of_priors;
        for k in of {
            let (from, to) = (
                self.shown.first[self.before + k],
                self.shown.first[self.before + k + 1],
            );
            let own = self.shown.rows.rows(from, to - from);
            gram.gemm_tr(1.0, &own, &own, 1.0);
        }
        self.workspace
            .forecast(&information.covariance, &gram, count)
    }

    /// Number of coefficients that candidates show.
    pub(crate) fn parameters(&self) -> usize {
        self.columns.len()
    }
}
