//! Poses on which two named effects differ most, whichever of them is there: each in turn is put
//! into the model in the shape that the other imitates best, at the size at which it would just
//! be seen, and the other is refitted to it.
//!
//! ```text
//! minimise aᵀ R a over aᵀ T a = λ,   T beside the model, R beside the model and the other effect
//! ```

use nalgebra::{DMatrix, DVector};

use crate::effects::{Effect, Setting, Term, find};
use crate::model::Model;
use crate::sessions::Target;

use super::comparison::{Comparison, Parting, Prediction, enough_for, inverse, predictions};
use super::exchange::choose;
use super::next_poses::{CandidatePoses, axes_of, conditions, gram, poses_of, reflector_sets};
use crate::diagnosis::NextPose;
use crate::diagnosis::prepare::Prepared;
use crate::diagnosis::regression::Fit;

/// λ of an effect that is just seen.
const JUST_SEEN: f64 = 40.0;
/// What is left of an effect beside the other, in the best of all places, below which no pose
/// tells them apart.
const NOTHING_LEFT: f64 = 1e-4;
/// Weight of all candidates together where a session cannot show an effect at all: as so many poses.
const AS_MANY_POSES: f64 = 40.0;

/// One of the two: a name and a joint counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Named {
    /// The effect's name.
    pub id: &'static str,
    /// Its joint.
    pub joint: usize,
}

impl Named {
    /// Whether the joint matters.
    pub fn per_joint(&self) -> bool {
        find(self.id).is_some_and(|e| e.about().per_joint)
    }
}

/// Poses that tell two effects apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Separation {
    /// The two.
    pub between: [Named; 2],
    /// Share of each that the other cannot imitate in the samples so far, 0 to 1 (squared).
    pub left_before: [f64; 2],
    /// The same with the poses measured too.
    pub left_after: [f64; 2],
    /// Whether both are told apart at the size at which they would just be seen.
    pub decided: bool,
    /// Why no pose does it; `None` where poses do.
    pub impossible: Option<String>,
    /// The poses.
    pub poses: Vec<NextPose>,
}

/// See the module. At most `most` poses.
pub(crate) fn separate_two(
    prepared: &Prepared,
    fit: &Fit,
    between: [Named; 2],
    most: usize,
) -> Separation {
    let base = fit.model.without(|t| between.iter().any(|b| is(t, *b)));
    let mut best: Option<Attempt> = None;
    let sets = reflector_sets(prepared);
    // The plain set comes first: nothing has to be mounted.
    for (index, targets) in sets.iter().enumerate() {
        let attempt = attempt(prepared, &base, fit, between, targets, most);
        let better = best.as_ref().is_none_or(|b| attempt.better_than(b));
        let done = attempt.decided && index == 0;
        if better {
            best = Some(attempt);
        }
        if done {
            break;
        }
    }
    let Some(best) = best else {
        return nothing(between, "there is no pose to measure");
    };
    if best.possible < NOTHING_LEFT {
        let because = "wherever they are measured, with a second reflector too, each looks like \
                       the other";
        return Separation {
            left_before: best.left[0],
            ..nothing(between, because)
        };
    }
    let session = prepared.problem.session;
    let why = format!("tells {} from {}", between[0].id, between[1].id);
    let poses = best
        .order
        .iter()
        .flat_map(|k| poses_of(&best.candidates.poses[*k], session, &best.candidates, &why))
        .take(most)
        .collect();
    Separation {
        between,
        left_before: best.left[0],
        left_after: best.left[1],
        decided: best.decided,
        impossible: None,
        poses,
    }
}

pub(crate) fn nothing(between: [Named; 2], because: &str) -> Separation {
    Separation {
        between,
        left_before: [0.0; 2],
        left_after: [0.0; 2],
        decided: false,
        impossible: Some(because.to_owned()),
        poses: Vec::new(),
    }
}

fn is(term: &Term, named: Named) -> bool {
    let about = term.effect.about();
    about.id == named.id && (!about.per_joint || term.joint == named.joint)
}

struct Attempt {
    candidates: CandidatePoses,
    order: Vec<usize>,
    decided: bool,
    worst: f64,
    /// Share left of the worse of the two over everything that is offered.
    possible: f64,
    /// Shares left before and after.
    left: [[f64; 2]; 2],
}

impl Attempt {
    fn better_than(&self, other: &Self) -> bool {
        if self.decided != other.decided {
            return self.decided;
        }
        if self.decided {
            self.order.len() < other.order.len()
        } else {
            self.worst > other.worst * 1.05
        }
    }
}

fn attempt(
    prepared: &Prepared,
    base: &Model,
    fit: &Fit,
    between: [Named; 2],
    targets: &[Target],
    most: usize,
) -> Attempt {
    let terms: Vec<Vec<Term>> = between
        .iter()
        .map(|n| terms_of(prepared, fit, *n))
        .collect();
    let shown: Vec<&Term> = terms.iter().flatten().collect();
    let candidates = CandidatePoses::new(
        prepared,
        targets.to_vec(),
        &conditions(prepared, &shown, targets.len()),
    );
    let inputs = candidates.inputs(prepared);
    let axes = axes_of(&prepared.regression);
    let (mut comparisons, mut possible, mut left) = (Vec::new(), 1.0_f64, [[1.0; 2]; 2]);
    let mut directions = Vec::new();
    for (k, (own, others)) in [(&terms[0], &terms[1]), (&terms[1], &terms[0])]
        .into_iter()
        .enumerate()
    {
        // Of all settings the pair that is hardest to part.
        let mut hardest: Option<(f64, Pair, Comparison)> = None;
        for one in own {
            for other in others {
                let pair = Pair::new(base, one, other);
                let seen = predictions(base, &pair.both, &inputs, &axes);
                let known = gram(&prepared.regression, &pair.both);
                let everywhere = over(&seen, 1.0);
                let (share, _) = pair.worst(&(&known + &everywhere));
                if hardest.as_ref().is_some_and(|h| h.0 <= share) {
                    continue;
                }
                let weak = everywhere * (AS_MANY_POSES / seen.len().max(1) as f64);
                let (before, mut direction) = pair.worst(&known);
                let mut strength = pair.strength(&known, &direction);
                if strength < 1e-3 * pair.strength(&weak, &pair.worst(&weak).1) {
                    direction = pair.worst(&(&known + &weak)).1;
                    strength = pair.strength(&weak, &direction);
                }
                direction *= (JUST_SEEN / strength.max(1e-300)).sqrt();
                left[0][k] = before;
                let comparison = pair.comparison(&seen, &known, &direction);
                hardest = Some((share, pair, comparison));
            }
        }
        if let Some((share, pair, comparison)) = hardest {
            possible = possible.min(share);
            comparisons.push(comparison);
            directions.push((k, pair));
        }
    }
    let mut parting = Parting::new(comparisons, candidates.poses.len(), 2);
    let order = choose(&mut parting, most);
    let comparisons = parting.comparisons;
    for (k, pair) in &directions {
        let seen = predictions(base, &pair.both, &inputs, &axes);
        let mut all = gram(&prepared.regression, &pair.both);
        for taken in &order {
            all += over(std::slice::from_ref(&seen[*taken]), 1.0);
        }
        left[1][*k] = pair.worst(&all).0;
    }
    Attempt {
        decided: !comparisons.is_empty() && comparisons.iter().all(Comparison::decided),
        worst: comparisons
            .iter()
            .map(|c| c.delta)
            .fold(f64::INFINITY, f64::min),
        candidates,
        order,
        possible,
        left,
    }
}

/// Gram matrix of all columns over some predictions.
fn over(seen: &[Prediction], weight: f64) -> DMatrix<f64> {
    let p = seen.first().map_or(0, |s| s.columns.ncols());
    let mut sum = DMatrix::zeros(p, p);
    for one in seen {
        sum += one.columns.tr_mul(&one.columns) * weight;
    }
    sum
}

/// Settings that stand for an effect: its own where the model has it.
fn terms_of(prepared: &Prepared, fit: &Fit, named: Named) -> Vec<Term> {
    let Some(effect) = find(named.id) else {
        return Vec::new();
    };
    let there: Vec<Term> = fit
        .model
        .terms()
        .iter()
        .filter(|t| is(t, named))
        .map(|t| Term::absent(effect, t.joint, t.setting))
        .collect();
    if there.is_empty() {
        settings_of(prepared, effect, named.joint)
    } else {
        there
    }
}

fn settings_of(prepared: &Prepared, effect: &'static dyn Effect, joint: usize) -> Vec<Term> {
    let robot = &prepared.problem.session.robot;
    let range = &super::candidate_poses::ranges(robot, Some(&prepared.problem.inputs))[joint];
    let settings: Vec<f64> = match effect.about().setting {
        Setting::None | Setting::Setup | Setting::Target | Setting::Place => vec![0.0],
        Setting::Order { from, to } => (from..=to.min(6)).map(f64::from).collect(),
        Setting::Fade => vec![0.03 * (range.to - range.from)],
        Setting::Time => {
            let times = prepared.problem.inputs.time_s.as_deref().unwrap_or(&[]);
            let last = times.iter().copied().fold(0.0, f64::max);
            vec![0.5 * last]
        }
        Setting::Listed(listed) => vec![listed.stands_for_all(joint)],
    };
    settings
        .into_iter()
        .map(|s| Term::absent(effect, joint, s))
        .collect()
}

/// A base model with both effects, absent, and where their columns are.
struct Pair {
    both: Model,
    own: Vec<usize>,
    other: Vec<usize>,
    rest: Vec<usize>,
}

impl Pair {
    fn new(base: &Model, one: &Term, other: &Term) -> Self {
        let both = base.with_term(one.clone()).with_term(other.clone());
        let (mut own, mut theirs, mut rest) = (Vec::new(), Vec::new(), Vec::new());
        let mut first = 0;
        for term in both.terms() {
            let columns = first..first + term.coefficients.len();
            first = columns.end;
            if term.same_column(one) {
                own.extend(columns);
            } else if term.same_column(other) {
                theirs.extend(columns);
            } else {
                rest.extend(columns);
            }
        }
        Self {
            both,
            own,
            other: theirs,
            rest,
        }
    }

    /// What is left of one's information beside some of the other columns.
    fn beside(&self, gram: &DMatrix<f64>, columns: &[usize]) -> DMatrix<f64> {
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
        let alone = self.beside(gram, &self.rest);
        let all: Vec<usize> = self.rest.iter().chain(&self.other).copied().collect();
        let left = self.beside(gram, &all);
        let k = self.own.len();
        let mean = (0..k).map(|i| alone[(i, i)]).sum::<f64>() / k as f64;
        if mean <= 0.0 || !mean.is_finite() {
            return (0.0, DVector::from_element(k, 1.0));
        }
        // Directions of which nothing is left beside the base do not count against the other.
        let spectrum = alone.symmetric_eigen();
        let mut best = (1.0_f64, spectrum.eigenvectors.column(0).into_owned());
        let kept: Vec<usize> = (0..k)
            .filter(|i| spectrum.eigenvalues[*i] > 1e-9 * mean)
            .collect();
        let basis = DMatrix::from_fn(k, kept.len(), |i, j| {
            spectrum.eigenvectors[(i, kept[j])] / spectrum.eigenvalues[kept[j]].sqrt()
        });
        let shares = (basis.tr_mul(&(left * &basis))).symmetric_eigen();
        for (i, share) in shares.eigenvalues.iter().enumerate() {
            if i == 0 || *share < best.0 {
                let direction = &basis * shares.eigenvectors.column(i);
                best = (share.clamp(0.0, 1.0), direction);
            }
        }
        best
    }

    fn strength(&self, gram: &DMatrix<f64>, direction: &DVector<f64>) -> f64 {
        let alone = self.beside(gram, &self.rest);
        direction.dot(&(alone * direction)).max(0.0)
    }

    /// One is there with these coefficients; the base and the other are refitted.
    fn comparison(
        &self,
        seen: &[Prediction],
        known: &DMatrix<f64>,
        direction: &DVector<f64>,
    ) -> Comparison {
        let columns: Vec<usize> = self.rest.iter().chain(&self.other).copied().collect();
        let own = seen.iter().map(|s| Prediction {
            difference: s.columns.select_columns(&self.own) * direction,
            columns: s.columns.select_columns(&columns),
        });
        let gram = known.select_rows(&columns).select_columns(&columns);
        // The effect is in the samples so far as well, and so is what the other made of it.
        let pull = known.select_rows(&columns).select_columns(&self.own) * direction;
        let there = known.select_rows(&self.own).select_columns(&self.own);
        let square = direction.dot(&(there * direction));
        let enough = enough_for(crate::diagnosis::aliases::UNDECIDED, 0.0);
        Comparison::new(own.collect(), &gram, enough).starting(&pull, square)
    }
}
