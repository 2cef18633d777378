//! What a measurement will be able to tell, before anybody has measured: the session is imagined
//! with the nominal robot and the instrument's noise, and asked what could be seen in it.
//!
//! Detection limits are those of a diagnosis (`limits`). Two effects look alike
//! where their columns, without what the base model explains, have a canonical correlation r near
//! one: the part √(1 − r²) of an effect is all that tells it from the other.

use nalgebra::DMatrix;

use crate::effects::Term;
use crate::sessions::Session;

use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::table::NotTestable;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::verdict::limits;
use crate::diagnosis::verdict::limits::Limit;
use crate::diagnosis::verdict::not_testable;
use crate::diagnosis::{DiagnoseError, Options};
use crate::fit::noise::Noise;
use crate::linear::Basis;

/// Two effects that are more alike than this are worth a word.
const ALIKE: f64 = 0.95;
/// Pairs that are named at most.
const MOST_ALIKE: usize = 12;

/// Two effects that look alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Alike {
    /// One, and its joint counted from 0.
    pub one: (&'static str, Option<usize>),
    /// The other.
    pub other: (&'static str, Option<usize>),
    /// Largest canonical correlation beside the base model.
    pub correlation: f64,
}

/// What planned poses are expected to tell apart, computed on an imagined measurement of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExpectedInformation {
    /// What will be seen above which size, with a chance of 95 %.
    pub limits: Vec<Limit>,
    /// What will not be seen.
    pub not_testable: Vec<NotTestable>,
    /// What will be hard to tell apart, the most alike first.
    pub alike: Vec<Alike>,
}

/// What an imagined session with this noise could tell.
pub(crate) fn expected(
    session: &Session,
    sigma_mm: f64,
    options: &Options,
) -> Result<ExpectedInformation, DiagnoseError> {
    let prepared = PreparedSearch::new(session, options)?;
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
    Ok(ExpectedInformation {
        limits: limits::limits(&regression, &fit),
        alike: alike(&regression, &fit),
        not_testable,
    })
}

/// Columns of one name at one setting, orthonormal, beside the base.
struct Span<'t> {
    term: &'t Term,
    unit: DMatrix<f64>,
}

/// Pairs of names that look alike at some of their settings.
fn alike(regression: &Regression, fit: &Fit) -> Vec<Alike> {
    let around = regression.surroundings(fit, CandidateSubset::Names);
    let mut spans: Vec<Span> = Vec::new();
    for candidate in &regression.table.candidates {
        let Some(term) = candidate.what.term() else {
            continue;
        };
        let (_, rank) = around.factor(candidate);
        let setting = term.effect.about().setting;
        let high_order = setting.takes_fractions() && term.setting > 12.0;
        if rank == candidate.size && !high_order {
            spans.push(Span {
                term,
                unit: Basis::new(&regression.columns_beside(&around, candidate)).q,
            });
        }
    }
    // Of the many times of a step a few stand for all.
    let times = |s: &Span| s.term.effect.about().setting == crate::effects::Setting::Time;
    let steps = spans.iter().filter(|s| times(s)).count();
    let (mut count, stride) = (0, steps.div_ceil(8).max(1));
    spans.retain(|s| {
        count += usize::from(times(s));
        !times(s) || count % stride == 0
    });
    let name = |s: &Span| {
        let about = s.term.effect.about();
        (about.id, about.per_joint.then_some(s.term.joint))
    };
    let mut pairs: Vec<Alike> = Vec::new();
    for (i, a) in spans.iter().enumerate() {
        for b in &spans[i + 1..] {
            let (one, other) = (name(a), name(b));
            if one == other {
                continue;
            }
            let correlation = largest_singular_value(&a.unit.tr_mul(&b.unit));
            if correlation < ALIKE {
                continue;
            }
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
    // Where there are none, nothing tells the two apart.
    let svd = crate::decompose::svd(cross.clone());
    let largest = svd.map(|svd| svd.singular_values.iter().copied().fold(0.0, f64::max));
    largest.map_or(1.0, |largest| largest.min(1.0))
}
