//! Poses on which two named effects differ most, whichever of them is present: each in turn is put into the model in
//! the shape that the other imitates best, at the size at which it would just be detected, and the other is refitted
//! to it.
//!
//! ```text
//! minimise aᵀ R a over aᵀ T a = λ,   T given the model, R given the model and the other effect
//! ```

use super::plan::Separation;
use super::plan_options::{OnJoint, POSES_OF_AN_ARM};
use crate::fit::gauge::{COPY, MOST_SEEN};
use crate::{odds, rounding};
use nalgebra::{DMatrix, DVector};

use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::{Term, called};
use crate::model::Model;

use super::candidate::ranges;
use super::candidate_poses::CandidatePoses;
use super::comparison::{Comparison, ModelDistance, enough_for};
use super::covariance::inverse;
use super::every_effect::at_representative_settings;
use super::exchange::choose;
use super::model_separation::{Attempt, ModelSeparation, over_reflectors};
use super::needs::all_met;
use super::next_poses::conditions;
use super::rows::Rows;

/// λ of an effect that is just seen.
const JUST_SEEN: f64 = 40.0;

/// See the module. At most `most` poses; none where one of the effects cannot be seen by any measurement.
pub(crate) fn separate_two(
    prepared: &PreparedSearch,
    fit: &Fit,
    between: [OnJoint; 2],
    most: usize,
) -> Separation {
    let mut separation = Separation {
        between: between.map(|(effect, joint)| {
            let about = effect.about();
            (about.id, about.per_joint.then_some(joint))
        }),
        left_before: vec![0.0; 2],
        left_after: vec![0.0; 2],
        decided: false,
        impossible: None,
        poses: Vec::new(),
    };
    let [one, other] = separation.between.map(|(id, _)| called(id));
    let met = all_met(&prepared.survey);
    for ((effect, joint), words) in between.into_iter().zip([&one, &other]) {
        if let Some(because) = effect.obstacle(&met, joint) {
            separation.impossible = Some(text!(
                "{effect} cannot be seen: {because}",
                effect = words,
                because
            ));
            return separation;
        }
    }
    let base = fit.model.without(|t| between.iter().any(|b| is(t, *b)));
    let terms = between.map(|named| terms_of(prepared, fit, named));
    let shown: Vec<&Term> = terms.iter().flatten().collect();
    let conditions = conditions(prepared, &shown);
    let (best, shares) = over_reflectors(prepared, |targets| {
        let offer = CandidatePoses::new(prepared, targets, &conditions);
        attempt(offer, &base, &terms, most)
    });
    separation.left_before = shares.left_before;
    if shares.possible < COPY {
        separation.impossible = Some(text!(
            "wherever they are measured, with a second reflector too, each looks like the other"
        ));
        return separation;
    }
    let why = text!("distinguishes {one} from {other}", one, other);
    separation.left_after = shares.left_after;
    separation.decided = best.decides;
    separation.poses = best.poses(&why, most);
    separation
}

fn is(term: &Term, (effect, joint): OnJoint) -> bool {
    let about = term.effect.about();
    about.id == effect.about().id && (!about.per_joint || term.joint == joint)
}

/// Shares of the two that the other cannot imitate.
struct Shares {
    /// Of the worse of the two over everything that is offered.
    possible: f64,
    left_before: Vec<f64>,
    left_after: Vec<f64>,
}

fn attempt<'p>(
    candidates: CandidatePoses<'p>,
    base: &Model,
    terms: &[Vec<Term>; 2],
    most: usize,
) -> (Attempt<'p>, Shares) {
    // Of all settings the pair that is hardest to part.
    let hardest = |k: usize| {
        let settings = terms[k].iter().flat_map(|one| {
            let others = terms[1 - k].iter();
            others.map(move |other| [one, other])
        });
        settings
            .map(|two| Pair::new(&candidates, base, two))
            .min_by(|a, b| a.possible.total_cmp(&b.possible))
    };
    let pairs: Vec<Pair> = (0..2).filter_map(hardest).collect();
    let compared = pairs.iter().map(|pair| pair.comparison(&candidates, base));
    let (left_before, comparisons) = compared.unzip();
    let mut parting = ModelSeparation::new(comparisons, candidates.candidates.len(), 2);
    let order = choose(&mut parting, most);
    let after = |pair: &Pair| {
        let mut all = pair.known.clone();
        pair.rows.add_to(&mut all, order.iter().copied());
        pair.worst(&all).0
    };
    let shares = Shares {
        possible: pairs.iter().map(|p| p.possible).fold(1.0, f64::min),
        left_before,
        left_after: pairs.iter().map(after).collect(),
    };
    let least = parting.distances().map(ModelDistance::share);
    let attempt = Attempt {
        decides: parting.parted(),
        score: least.fold(1.0, f64::min),
        unparted: 0,
        order,
        candidates,
    };
    (attempt, shares)
}

/// Representative settings of an effect: its own where the model has it.
fn terms_of(prepared: &PreparedSearch, fit: &Fit, named: OnJoint) -> Vec<Term> {
    let (effect, joint) = named;
    let there = fit.model.terms().iter().filter(|t| is(t, named));
    let there: Vec<Term> = there
        .map(|t| Term::absent(effect, t.joint, t.setting))
        .collect();
    if !there.is_empty() {
        return there;
    }
    let inputs = &prepared.problem.inputs;
    let range = ranges(&prepared.problem.session.robot, Some(inputs))[joint];
    let times = inputs.time_s.as_deref().unwrap_or(&[]);
    let middle_s = 0.5 * times.iter().copied().fold(0.0, f64::max);
    let fades = [0.03 * (range.to - range.from)];
    at_representative_settings(effect, joint, 6, &fades, middle_s)
}

/// A base model with both effects, absent, where their columns are, and what samples and candidates show of them.
struct Pair {
    terms: [Term; 2],
    own: Vec<usize>,
    rest: Vec<usize>,
    /// The other terms and the other effect.
    given: Vec<usize>,
    rows: Rows,
    /// The information of the samples, and of all candidates.
    known: DMatrix<f64>,
    everywhere: DMatrix<f64>,
    /// Share of the one's information that remains given the other with all candidates.
    possible: f64,
}

impl Pair {
    fn new(offer: &CandidatePoses, base: &Model, [one, other]: [&Term; 2]) -> Self {
        let both = base.with_term(one.clone()).with_term(other.clone());
        let of = |wanted: &dyn Fn(&Term) -> bool| -> Vec<usize> {
            let columns = both.columns().enumerate();
            let own = columns.filter(|(_, (term, _))| wanted(term));
            own.map(|(column, _)| column).collect()
        };
        let rest = of(&|t| !t.same_column(one) && !t.same_column(other));
        let theirs = of(&|t| t.same_column(other) && !t.same_column(one));
        let rows = offer.rows(base, &both);
        let mut pair = Self {
            own: of(&|t| t.same_column(one)),
            given: rest.iter().chain(&theirs).copied().collect(),
            rest,
            terms: [one.clone(), other.clone()],
            known: offer.gram(&both),
            everywhere: rows.information(),
            rows,
            possible: 0.0,
        };
        pair.possible = pair.worst(&(&pair.known + &pair.everywhere)).0;
        pair
    }

    /// The remaining share in the samples, and the one in the shape that the other imitates best, at the size at which
    /// it is just detected, against the other.
    fn comparison(&self, offer: &CandidatePoses, base: &Model) -> (f64, Comparison) {
        let weak = &self.everywhere * (POSES_OF_AN_ARM as f64 / self.rows.len().max(1) as f64);
        let (before, mut direction) = self.worst(&self.known);
        let mut strength = self.strength(&self.known, &direction);
        if strength < MOST_SEEN * self.strength(&weak, &self.worst(&weak).1) {
            direction = self.worst(&(&self.known + &weak)).1;
            strength = self.strength(&weak, &direction);
        }
        direction *= (JUST_SEEN / strength.max(1e-300)).sqrt();
        let [one, other] = self.terms.clone();
        let truth = base.with_term(Term {
            coefficients: direction.as_slice().to_vec(),
            ..one
        });
        let (rival, enough) = (base.with_term(other), enough_for(odds::OPEN.nats(), 0.0));
        let comparison = Comparison::from_the_start(offer, [&truth, &rival], enough, 1.0);
        (before, comparison)
    }

    /// One's information given some of the other columns (Schur complement).
    fn reduced_information(&self, gram: &DMatrix<f64>, columns: &[usize]) -> DMatrix<f64> {
        let pick = |a: &[usize], b: &[usize]| gram.select_rows(a).select_columns(b);
        let mut remaining = pick(&self.own, &self.own);
        if !columns.is_empty() {
            let mut inner = pick(columns, columns);
            for k in 0..columns.len() {
                inner[(k, k)] += 1e-12 * inner[(k, k)] + 1e-300;
            }
            let cross = pick(columns, &self.own);
            remaining -= cross.tr_mul(&(inverse(&inner) * &cross));
        }
        remaining
    }

    /// Smallest share of one's information that remains given the other, and its direction.
    fn worst(&self, gram: &DMatrix<f64>) -> (f64, DVector<f64>) {
        let alone = self.reduced_information(gram, &self.rest);
        let remaining = self.reduced_information(gram, &self.given);
        let k = self.own.len();
        let mean = alone.trace() / k as f64;
        if mean <= 0.0 || !mean.is_finite() {
            return (0.0, DVector::from_element(k, 1.0));
        }
        // Directions that are dependent on the base do not count against the other.
        let spectrum = crate::decompose::eigen(alone);
        let values = &spectrum.eigenvalues;
        let kept: Vec<usize> = (0..k)
            .filter(|i| values[*i] > rounding::COMPUTED * mean)
            .collect();
        let mut basis = spectrum.eigenvectors.select_columns(&kept);
        for (mut column, i) in basis.column_iter_mut().zip(&kept) {
            column /= values[*i].sqrt();
        }
        let shares = crate::decompose::eigen(basis.tr_mul(&(remaining * &basis)));
        let smallest = (0..kept.len()).min_by(|a, b| {
            let [a, b] = [*a, *b].map(|k| shares.eigenvalues[k]);
            a.total_cmp(&b)
        });
        smallest.map_or((1.0, spectrum.eigenvectors.column(0).into_owned()), |i| {
            let direction = &basis * shares.eigenvectors.column(i);
            (shares.eigenvalues[i].clamp(0.0, 1.0), direction)
        })
    }

    fn strength(&self, gram: &DMatrix<f64>, direction: &DVector<f64>) -> f64 {
        let alone = self.reduced_information(gram, &self.rest);
        direction.dot(&(alone * direction)).max(0.0)
    }
}
