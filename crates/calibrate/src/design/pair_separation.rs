//! Poses on which two named effects differ most, whichever of them is there: each in turn is put
//! into the model in the shape that the other imitates best, at the size at which it would just
//! be seen, and the other is refitted to it.
//!
//! ```text
//! minimise aᵀ R a over aᵀ T a = λ,   T beside the model, R beside the model and the other effect
//! ```

use nalgebra::{DMatrix, DVector};

use crate::diagnosis::NextPose;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::rival::UNDECIDED;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::{Term, called, find};
use crate::model::Model;
use crate::text::Text;

use super::candidates::{CandidatePoses, ranges};
use super::comparison::{Comparison, Field, ModelDistance, Prediction, enough_for};
use super::exchange::choose;
use super::information::standing;
use super::inverse::inverse;
use super::model_separation::{Attempt, ModelSeparation, over_reflectors};
use super::named::Named;
use super::next_poses::conditions;

/// λ of an effect that is just seen.
const JUST_SEEN: f64 = 40.0;
/// What is left of an effect beside the other, in the best of all places, below which no pose
/// tells them apart.
const NOTHING_LEFT: f64 = 1e-4;
/// Weight of all candidates together where a session cannot show an effect at all: as so many poses.
const AS_MANY_POSES: f64 = 40.0;

/// Poses that tell two effects apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Separation {
    /// The two.
    pub between: [Named; 2],
    /// Share of each that the other cannot imitate in the samples so far, 0 to 1 (squared).
    pub left_before: [f64; 2],
    /// The same with the poses measured too, 0 to 1.
    pub left_after: [f64; 2],
    /// Whether both are told apart at the size at which they would just be seen.
    pub decided: bool,
    /// Why no pose does it; `None` where poses do.
    pub impossible: Option<Text>,
    /// The poses.
    pub poses: Vec<NextPose>,
}

/// See the module. At most `most` poses.
pub(crate) fn separate_two(
    prepared: &PreparedSearch,
    fit: &Fit,
    between: [Named; 2],
    most: usize,
) -> Separation {
    let base = fit.model.without(|t| between.iter().any(|b| is(t, *b)));
    let terms = between.map(|named| terms_of(prepared, fit, named));
    let shown: Vec<&Term> = terms.iter().flatten().collect();
    let conditions = conditions(prepared, &shown);
    let (best, shares) = over_reflectors(prepared, |targets| {
        let offer = CandidatePoses::new(prepared, targets, &conditions);
        attempt(prepared, offer, &base, &terms, most)
    });
    let left_before = shares.left[0];
    if shares.possible < NOTHING_LEFT {
        let because = text!(
            "wherever they are measured, with a second reflector too, each looks like the other"
        );
        return Separation {
            left_before,
            ..nothing(between, because)
        };
    }
    let why = text!(
        "distinguishes {one} from {other}",
        one = called(between[0].id),
        other = called(between[1].id)
    );
    Separation {
        between,
        left_before,
        left_after: shares.left[1],
        decided: best.decides,
        impossible: None,
        poses: best.poses(prepared, &why, most),
    }
}

pub(crate) fn nothing(between: [Named; 2], because: Text) -> Separation {
    Separation {
        between,
        left_before: [0.0; 2],
        left_after: [0.0; 2],
        decided: false,
        impossible: Some(because),
        poses: Vec::new(),
    }
}

fn is(term: &Term, named: Named) -> bool {
    let about = term.effect.about();
    about.id == named.id && (!about.per_joint || term.joint == named.joint)
}

/// Shares of the two that the other cannot imitate.
struct Shares {
    /// Of the worse of the two over everything that is offered.
    possible: f64,
    /// Before and after.
    left: [[f64; 2]; 2],
}

fn attempt(
    prepared: &PreparedSearch,
    candidates: CandidatePoses,
    base: &Model,
    terms: &[Vec<Term>; 2],
    most: usize,
) -> (Attempt, Shares) {
    let field = Field::new(prepared, &candidates);
    let mut shares = Shares {
        possible: 1.0,
        left: [[1.0; 2]; 2],
    };
    let (mut comparisons, mut pairs) = (Vec::new(), Vec::new());
    for k in 0..2 {
        // Of all settings the pair that is hardest to part.
        let settings = terms[k].iter().flat_map(|one| {
            let others = terms[1 - k].iter();
            others.map(move |other| Pair::new(base, one, other))
        });
        let hardest = settings
            .map(|pair| PosedPair::new(&field, base, pair))
            .min_by(|a, b| a.possible.total_cmp(&b.possible));
        if let Some(posed) = hardest {
            shares.possible = shares.possible.min(posed.possible);
            let (before, comparison) = posed.comparison(&field, base);
            shares.left[0][k] = before;
            comparisons.push(comparison);
            pairs.push((k, posed));
        }
    }
    let mut parting = ModelSeparation::new(comparisons, candidates.candidates.len(), 2);
    let order = choose(&mut parting, most);
    for (k, posed) in &pairs {
        let mut all = posed.prior_information.clone();
        for taken in &order {
            all += over(std::slice::from_ref(&posed.seen[*taken]));
        }
        shares.left[1][*k] = posed.pair.worst(&all).0;
    }
    let attempt = Attempt {
        decides: !parting.comparisons.is_empty() && parting.parted(),
        score: parting
            .distances()
            .map(ModelDistance::share)
            .fold(1.0, f64::min),
        unparted: 0,
        order,
        candidates,
    };
    (attempt, shares)
}

/// Gram matrix of all columns over some predictions.
fn over(seen: &[Prediction]) -> DMatrix<f64> {
    let p = seen.first().map_or(0, |s| s.columns.ncols());
    let mut sum = DMatrix::zeros(p, p);
    for one in seen {
        sum.gemm_tr(1.0, &one.columns, &one.columns, 1.0);
    }
    sum
}

/// Settings that stand for an effect: its own where the model has it.
fn terms_of(prepared: &PreparedSearch, fit: &Fit, named: Named) -> Vec<Term> {
    let Some(effect) = find(named.id) else {
        return Vec::new();
    };
    let there = fit.model.terms().iter().filter(|t| is(t, named));
    let there: Vec<Term> = there
        .map(|t| Term::absent(effect, t.joint, t.setting))
        .collect();
    if !there.is_empty() {
        return there;
    }
    let inputs = &prepared.problem.inputs;
    let range = ranges(&prepared.problem.session.robot, Some(inputs))[named.joint];
    let times = inputs.time_s.as_deref().unwrap_or(&[]);
    let middle_s = 0.5 * times.iter().copied().fold(0.0, f64::max);
    let fades = [0.03 * (range.to - range.from)];
    standing(effect, named.joint, 6, &fades, middle_s)
}

/// A pair on the samples and on all candidates.
struct PosedPair {
    pair: Pair,
    seen: Vec<Prediction>,
    prior_information: DMatrix<f64>,
    everywhere: DMatrix<f64>,
    /// Share of the one that is left beside the other with all candidates.
    possible: f64,
}

impl PosedPair {
    fn new(field: &Field, base: &Model, pair: Pair) -> Self {
        let seen = field.predictions(base, &pair.both);
        let (known, everywhere) = (field.gram(&pair.both), over(&seen));
        Self {
            possible: pair.worst(&(&known + &everywhere)).0,
            pair,
            seen,
            prior_information: known,
            everywhere,
        }
    }

    /// The share that is left in the samples, and the one there in the shape that the other imitates
    /// best, at the size at which it is just seen, against the other.
    fn comparison(&self, field: &Field, base: &Model) -> (f64, Comparison) {
        let (pair, known) = (&self.pair, &self.prior_information);
        let weak = &self.everywhere * (AS_MANY_POSES / self.seen.len().max(1) as f64);
        let (before, mut direction) = pair.worst(known);
        let mut strength = pair.strength(known, &direction);
        if strength < 1e-3 * pair.strength(&weak, &pair.worst(&weak).1) {
            direction = pair.worst(&(known + &weak)).1;
            strength = pair.strength(&weak, &direction);
        }
        direction *= (JUST_SEEN / strength.max(1e-300)).sqrt();
        let [one, other] = pair.terms.clone();
        let truth = base.with_term(Term {
            coefficients: direction.as_slice().to_vec(),
            ..one
        });
        let (rival, enough) = (base.with_term(other), enough_for(UNDECIDED, 0.0));
        let comparison = field.comparison_from_the_start(&truth, &rival, enough, 1.0);
        (before, comparison)
    }
}

/// A base model with both effects, absent, and where their columns are.
struct Pair {
    both: Model,
    terms: [Term; 2],
    own: Vec<usize>,
    other: Vec<usize>,
    rest: Vec<usize>,
}

impl Pair {
    fn new(base: &Model, one: &Term, other: &Term) -> Self {
        let both = base.with_term(one.clone()).with_term(other.clone());
        let (mut own, mut theirs, mut rest) = (Vec::new(), Vec::new(), Vec::new());
        for (column, (term, _)) in both.columns().enumerate() {
            let to = if term.same_column(one) {
                &mut own
            } else if term.same_column(other) {
                &mut theirs
            } else {
                &mut rest
            };
            to.push(column);
        }
        Self {
            both,
            terms: [one.clone(), other.clone()],
            own,
            other: theirs,
            rest,
        }
    }

    /// What is left of one's information beside some of the other columns.
    fn reduced_information(&self, gram: &DMatrix<f64>, columns: &[usize]) -> DMatrix<f64> {
        let pick = |a: &[usize], b: &[usize]| gram.select_rows(a).select_columns(b);
        let mut left = pick(&self.own, &self.own);
        if !columns.is_empty() {
            let mut inner = pick(columns, columns);
            for k in 0..columns.len() {
                inner[(k, k)] += 1e-12 * inner[(k, k)] + 1e-300;
            }
            let cross = pick(columns, &self.own);
            left -= cross.tr_mul(&(inverse(&inner) * &cross));
        }
        left
    }

    /// Smallest share that is left of one's information beside the other, and its direction.
    fn worst(&self, gram: &DMatrix<f64>) -> (f64, DVector<f64>) {
        let alone = self.reduced_information(gram, &self.rest);
        let all: Vec<usize> = self.rest.iter().chain(&self.other).copied().collect();
        let left = self.reduced_information(gram, &all);
        let k = self.own.len();
        let mean = (0..k).map(|i| alone[(i, i)]).sum::<f64>() / k as f64;
        if mean <= 0.0 || !mean.is_finite() {
            return (0.0, DVector::from_element(k, 1.0));
        }
        // Directions of which nothing is left beside the base do not count against the other.
        let spectrum = crate::decompose::eigen(alone);
        let mut best = (1.0_f64, spectrum.eigenvectors.column(0).into_owned());
        let kept: Vec<usize> = (0..k)
            .filter(|i| spectrum.eigenvalues[*i] > 1e-9 * mean)
            .collect();
        let basis = DMatrix::from_fn(k, kept.len(), |i, j| {
            spectrum.eigenvectors[(i, kept[j])] / spectrum.eigenvalues[kept[j]].sqrt()
        });
        let shares = crate::decompose::eigen(basis.tr_mul(&(left * &basis)));
        for (i, share) in shares.eigenvalues.iter().enumerate() {
            if i == 0 || *share < best.0 {
                let direction = &basis * shares.eigenvectors.column(i);
                best = (share.clamp(0.0, 1.0), direction);
            }
        }
        best
    }

    fn strength(&self, gram: &DMatrix<f64>, direction: &DVector<f64>) -> f64 {
        let alone = self.reduced_information(gram, &self.rest);
        direction.dot(&(alone * direction)).max(0.0)
    }
}
