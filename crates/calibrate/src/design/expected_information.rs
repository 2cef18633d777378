//! The expected information of a measurement, before anybody has measured: the session is imagined with the nominal
//! robot and the instrument's noise, and analysed.
//!
//! Detection limits are those of a diagnosis (`limits`). Two effects look alike where their columns, projected
//! orthogonal to the base model, have a canonical correlation r near one: only the part √(1 − r²) of an effect
//! distinguishes it from the other.

use nalgebra::DMatrix;

use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::table::NotTestable;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::verdict::limits;
use crate::diagnosis::verdict::limits::Limit;
use crate::diagnosis::verdict::not_testable;
use crate::effects::{Setting, Term};
use crate::fit::noise::Noise;
use crate::linear::Basis;

/// Pairs that are named at most.
const MOST_ALIKE: usize = 12;

/// Two effects that are more alike than this are worth a word.
const ALIKE: f64 = 0.95;
/// Orders that are compared, and times of a step.
const HIGHEST_ORDER: f64 = 12.0;
const MOST_STEPS: usize = 8;

/// Two effects that look alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Alike {
    /// One, and its joint counted from 0.
    pub one: (&'static str, Option<usize>),
    /// The other.
    pub other: (&'static str, Option<usize>),
    /// Largest canonical correlation given the base model.
    pub correlation: f64,
}

/// What planned poses are expected to determine, computed on an imagined measurement of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExpectedInformation {
    /// What will be seen above which size, with a chance of 95 %.
    pub limits: Vec<Limit>,
    /// What will not be seen.
    pub not_testable: Vec<NotTestable>,
    /// Effects that will be hard to distinguish, the most alike first.
    pub alike: Vec<Alike>,
}

/// The information of an imagined session with this noise.
pub(crate) fn expected(prepared: &PreparedSearch, sigma_mm: f64) -> ExpectedInformation {
    let regression = prepared.regression.with_noise(Noise::white(sigma_mm));
    let mut fit = regression.fit(&regression.base, &[]);
    // The residual is that of noise of exactly the stated size.
    let freedom = regression.m() - fit.basis.rank() as f64;
    if freedom > 0.0 && fit.rss > 0.0 {
        fit.residual *= (freedom / fit.rss).sqrt();
        fit.rss = freedom;
    }
    let mut not_testable = not_testable(&regression, &fit);
    // Names that belong to every calibration are in the base, not among the candidates.
    not_testable.retain(|n| !crate::fit::DEFAULT_EFFECTS.contains(&n.effect));
    ExpectedInformation {
        limits: limits::limits(&regression, &fit),
        alike: alike(&regression, &fit),
        not_testable,
    }
}

/// Pairs of names that look alike at some of their settings.
fn alike(regression: &Regression, fit: &Fit) -> Vec<Alike> {
    let around = regression.projections(fit, CandidateSubset::Names);
    // Columns of each name at each setting, orthonormal, projected orthogonal to the base.
    let spans = regression.table.candidates.iter().filter_map(|candidate| {
        let term = candidate.what.term()?;
        let setting = term.effect.about().setting;
        let high_order = setting.takes_fractions() && term.setting > HIGHEST_ORDER;
        let whole = around.factor(candidate).1 == candidate.size;
        let columns = || regression.projected_columns(&around, candidate);
        (whole && !high_order).then(|| (term, Basis::new(&columns()).q))
    });
    let mut spans: Vec<(&Term, DMatrix<f64>)> = spans.collect();
    // Of the many times of a step a few are representative.
    let times = |own: &(&Term, _)| own.0.effect.about().setting == Setting::Time;
    let steps = spans.iter().filter(|own| times(own)).count();
    let (mut count, stride) = (0, steps.div_ceil(MOST_STEPS).max(1));
    spans.retain(|own| {
        count += usize::from(times(own));
        !times(own) || count % stride == 0
    });
    let name = |term: &Term| {
        let about = term.effect.about();
        (about.id, about.per_joint.then_some(term.joint))
    };
    let mut pairs: Vec<Alike> = Vec::new();
    for (i, (a, of_a)) in spans.iter().enumerate() {
        for (b, of_b) in &spans[i + 1..] {
            let (one, other) = (name(a), name(b));
            let correlation = || largest_singular_value(&of_a.tr_mul(of_b));
            let Some(correlation) = (one != other).then(correlation).filter(|r| *r >= ALIKE) else {
                continue;
            };
            let same = |p: &&mut Alike| (p.one, p.other) == (one, other);
            match pairs.iter_mut().find(same) {
                Some(known) => known.correlation = known.correlation.max(correlation),
                None => pairs.push(Alike {
                    one,
                    other,
                    correlation,
                }),
            }
        }
    }
    pairs.sort_by(|a, b| b.correlation.total_cmp(&a.correlation));
    pairs.truncate(MOST_ALIKE);
    pairs
}

fn largest_singular_value(cross: &DMatrix<f64>) -> f64 {
    // Where there are none, nothing distinguishes the two.
    let svd = crate::decompose::svd(cross.clone());
    let largest = svd.map(|svd| svd.singular_values.iter().copied().fold(0.0, f64::max));
    largest.map_or(1.0, |largest| largest.min(1.0))
}
