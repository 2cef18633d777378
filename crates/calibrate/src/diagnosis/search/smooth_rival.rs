//! A smooth curve over a joint as the rival of three and more names over it: a pull of cables at both ends
//! of the range is scale, eccentricity and two-cycle together, within any noise, and is none of them.
//!
//! The curve is a Gaussian process along the joint's motion, as smooth as sums of a few slow names are: with
//! C its covariance over the range, of length ℓ and size t in units of the noise, B its columns beside the
//! rest of the fit and r what that leaves,
//!
//! ```text
//! ln E = −½ Σ ln(1 + t² e_k) − (m/2) ln(1 − Σ t² z_k²/(1 + t² e_k) / rss),   e, U: eigen of √C Bᵀ B √C,
//! z = Uᵀ √C Bᵀ r
//! ```
//!
//! or two pulls of independent sizes that grow exponentially towards the ends of the range, as cables have them.
//!
//! Where the curve is clearly likelier it takes the place of the names; where the samples cannot rule out
//! either, the names stay and the curve is said beside them.

use std::sync::Arc;

use nalgebra::DMatrix;

use crate::decompose::eigen;
use crate::effects::{Setting, Term};
use crate::fit::regression::Rows;
use crate::linear::{along, own_products, reject_all};

use super::found::SearchResult;
use super::free_curve::{follows_only, with_curve};
use super::prepare::PreparedSearch;
use crate::diagnosis::evidence::EFFECT_PRIOR_PENALTY;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::evidence::rival::UNDECIDED;
use crate::model::shapes::{Direction, Profile, Shape, Variable};

/// What the curve pays: as a name for being there, and a factor of e for each of its numbers.
const PRICE: f64 = EFFECT_PRIOR_PENALTY + 3.0;
/// Names of a catalogue are preferred: a curve takes their place from these odds on, as a logarithm. Three true
/// names near the limit of detection reach 7 (`small` of `tests/reference/wild_confidence.py`).
const CLEARLY: f64 = 8.0;
/// So many names are as much as a curve.
const FEWEST_NAMES: usize = 3;
/// Fewer are simpler than a curve, and give way only to what is clearly likelier.
const FEWEST_TO_GIVE_WAY: usize = 2;
/// Pieces of the polygon that stands for the curve.
const PIECES: usize = 60;
/// Pieces of the polygon that takes the names' place in the fit.
const PIECES_OF_THE_FIT: usize = 24;
/// Waves over the range from which on a name is not smooth.
const FEW_WAVES: f64 = 3.0;
/// Functions of the process that are kept: of one so smooth the others are nothing.
const KEPT: usize = 24;
/// Less of a process than this share (of its variance) is rounding.
const LEAST: f64 = 1e-10;
/// A column that is off the joint's motion by more than this share does something else.
const ALONG: f64 = 1e-3;

/// Lengths in shares of the range: infinitely smooth …
const GAUSSIAN: [f64; 6] = [0.3, 0.5, 0.7, 1.0, 1.5, 2.0];
/// … and twice differentiable.
const MATERN: [f64; 4] = [0.3, 0.5, 1.0, 2.0];

/// Shares of the range within which a pull at its ends falls to 1/e: cables and hoses are bent there, and the farther
/// the stiffer.
const PULLS: [f64; 6] = [0.05, 0.07, 0.1, 0.14, 0.2, 0.28];

/// Names over a joint and how much likelier a smooth curve is in their place, as a logarithm.
pub(crate) struct SmoothComparison {
    pub(crate) joint: usize,
    pub(crate) names: Vec<Term>,
    pub(crate) ln_odds: f64,
    rest: Fit,
}

impl SmoothComparison {
    fn may_be_said(&self) -> bool {
        self.names.len() >= FEWEST_NAMES && self.ln_odds > -UNDECIDED
    }
}

/// Holds a smooth curve over each joint against the names; where it is clearly likelier it takes their place.
pub(crate) fn rival(prepared: &PreparedSearch, found: &mut SearchResult) {
    for joint in 0..prepared.survey.joints.len() {
        let Some(curve) = against(prepared, &found.fit, joint) else {
            continue;
        };
        if curve.ln_odds > CLEARLY {
            let ln_evidence = found.fit.ln_evidence + curve.ln_odds;
            let regression = &prepared.regression;
            found.fit = with_curve(
                regression,
                &curve.rest,
                joint,
                PIECES_OF_THE_FIT,
                ln_evidence,
            );
        }
    }
}

/// The names of a fit that the samples cannot tell from a smooth curve.
pub(crate) fn as_likely(prepared: &PreparedSearch, fit: &Fit) -> Option<SmoothComparison> {
    let joints = 0..prepared.survey.joints.len();
    let all = joints.filter_map(|joint| against(prepared, fit, joint));
    all.filter(SmoothComparison::may_be_said)
        .max_by(|a, b| a.ln_odds.total_cmp(&b.ln_odds))
}

/// A smooth curve over a joint against the smooth names over it; `None` where they are fewer than a curve.
fn against(prepared: &PreparedSearch, fit: &Fit, joint: usize) -> Option<SmoothComparison> {
    let regression = &prepared.regression;
    let over_joint = |shape: &Shape| shape.variable == Variable::Joint(joint);
    if fit.shapes.iter().any(|s| over_joint(&s.shape)) {
        return None;
    }
    let (low, high) = regression.table.space.range(Variable::Joint(joint));
    let is_slow = |term: &Term| match term.effect.about().setting {
        Setting::Order { .. } => term.setting * (high - low) < FEW_WAVES * std::f64::consts::TAU,
        Setting::None => true,
        _ => false,
    };
    let motion = &regression.table.space.tangential;
    let names: Vec<Term> = regression
        .added(fit)
        .into_iter()
        .filter(|t| follows_only(t, joint) && is_slow(t))
        .filter(|t| is_along(&regression.rows, fit, t, motion.get(joint)))
        .cloned()
        .collect();
    if names.len() < FEWEST_TO_GIVE_WAY {
        return None;
    }
    let model = fit
        .model
        .without(|t| names.iter().any(|n| n.same_column(t)));
    let rest = regression.fit(&model, &fit.shapes);
    let likelier = likeliest(regression, &rest, joint)?;
    Some(SmoothComparison {
        joint,
        ln_odds: rest.ln_evidence + likelier - PRICE - fit.ln_evidence,
        names,
        rest,
    })
}

/// Whether a term moves every sample as the joint does.
fn is_along(rows: &Rows, fit: &Fit, term: &Term, motion: Option<&nalgebra::DVector<f64>>) -> bool {
    let Some(motion) = motion else { return false };
    let before = fit
        .model
        .terms()
        .iter()
        .take_while(|t| !t.same_column(term));
    let first: usize = before.map(|t| t.coefficients.len()).sum();
    let (_, all) = rows.extract(&fit.model);
    let own = all.columns(first, term.coefficients.len());
    let n = rows.samples.len();
    own.column_iter().all(|column| {
        let (mut off, mut whole) = (0.0, 0.0);
        for sample in 0..n {
            let at = || (sample..column.len()).step_by(n);
            let along: f64 = at().map(|row| column[row] * motion[row]).sum();
            let length: f64 = at().map(|row| motion[row] * motion[row]).sum();
            let share = along / length.max(f64::MIN_POSITIVE);
            off += at()
                .map(|row| (column[row] - share * motion[row]).powi(2))
                .sum::<f64>();
            whole += at().map(|row| column[row] * column[row]).sum::<f64>();
        }
        off <= ALONG * ALONG * whole
    })
}

/// By how much the likeliest smooth curve beside a fit is likelier than none, as a logarithm.
fn likeliest(regression: &Regression, rest: &Fit, joint: usize) -> Option<f64> {
    let placed = regression.placed(Shape {
        variable: Variable::Joint(joint),
        direction: Direction::Tangential(joint),
        profile: Profile::Curve { pieces: PIECES },
        tried: 1.0,
    });
    let mut free = Arc::unwrap_or_clone(placed.white);
    // One unit of the curve moves a sample by one unit of its noise, in the mean.
    let samples = regression.rows.samples.len().max(1) as f64;
    let unit = free.column_sum().norm_squared().max(free.norm_squared()) / samples;
    if unit <= 0.0 {
        return None;
    }
    reject_all(&rest.basis.q, &mut free);
    let gram = own_products(&free);
    let pulls = along(&free, &rest.residual);
    let gaussian = GAUSSIAN.map(|length| covariance(length, |d| (-0.5 * d * d).exp()));
    let matern = MATERN.map(|length| {
        covariance(length, |d| {
            let r = 5.0_f64.sqrt() * d;
            (1.0 + r + r * r / 3.0) * (-r).exp()
        })
    });
    let total = regression.rounded(rest.rss);
    let m = regression.m();
    let mut best: Option<f64> = None;
    let pulls_at_ends = PULLS.map(pull);
    for root in gaussian.iter().chain(&matern).chain(&pulls_at_ends) {
        let own = root.tr_mul(&gram) * root / unit;
        let own = eigen(own);
        let pulled = own.eigenvectors.tr_mul(&root.tr_mul(&pulls)) / unit.sqrt();
        for size in (0..15).map(|k| 0.2 * 2.0_f64.powi(k)) {
            let t2 = size * size;
            let (mut determinant, mut gain) = (0.0, 0.0);
            for (e, z) in own.eigenvalues.iter().zip(&pulled) {
                let wider = 1.0 + t2 * e.max(0.0);
                determinant += wider.ln();
                gain += t2 * z * z / wider;
            }
            let share = (gain / total.max(1e-300)).clamp(0.0, 1.0 - 1e-15);
            let value = -0.5 * determinant - 0.5 * m * (-share).ln_1p();
            best = Some(best.map_or(value, |b: f64| b.max(value)));
        }
    }
    best
}

/// √C over the corners of the polygon, of its largest functions: `C = R Rᵀ`; distances in lengths.
fn covariance(length: f64, of: impl Fn(f64) -> f64) -> DMatrix<f64> {
    let at = |k: usize| k as f64 / PIECES as f64 / length;
    let all = DMatrix::from_fn(PIECES + 1, PIECES + 1, |i, j| of((at(i) - at(j)).abs()));
    let own = eigen(all);
    let mut order: Vec<usize> = (0..=PIECES).collect();
    order.sort_by(|a, b| own.eigenvalues[*b].total_cmp(&own.eigenvalues[*a]));
    let largest = own.eigenvalues[order[0]];
    order.retain(|k| own.eigenvalues[*k] > LEAST * largest);
    order.truncate(KEPT);
    DMatrix::from_fn(PIECES + 1, order.len(), |row, k| {
        own.eigenvectors[(row, order[k])] * own.eigenvalues[order[k]].sqrt()
    })
}

/// The root of the covariance of two pulls, one at each end of the range, of independent sizes.
fn pull(share: f64) -> DMatrix<f64> {
    DMatrix::from_fn(PIECES + 1, 2, |row, end| {
        let from_low = row as f64 / PIECES as f64;
        let away = if end == 0 { from_low } else { 1.0 - from_low };
        (-away / share).exp()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::sessions::Session;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    const NAMES: [&str; 3] = ["joint-scale", "encoder-eccentricity", "encoder-two-cycle"];

    /// One axis whose angle is off by this many degrees at each of its values, in degrees, beside effects.
    fn axis(effects: &str, off: impl Fn(f64) -> f64) -> Session {
        let stops = (0..140).map(|k| {
            let turn = 340.0 * (f64::from(k) * 0.754_877_666).fract() - 170.0;
            format!(r#"{{"q_deg":[{turn}]}}"#)
        });
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"pull","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-180,180]}}],
            "tool":{{"position_mm":[320,0,210],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.02}},"poses":{{"list":[{}]}},
            "effects":[{effects}],"noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":5}}"#,
            stops.collect::<Vec<_>>().join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let mut session = simulate(&scenario, 1, unwatched).unwrap().0;
        let samples = &mut session.samples;
        for k in 0..samples.len() {
            let by = off(samples.q[0][k].to_degrees()).to_radians();
            let (x, y) = (samples.x_mm[k], samples.y_mm[k]);
            samples.x_mm[k] = x * by.cos() - y * by.sin();
            samples.y_mm[k] = x * by.sin() + y * by.cos();
        }
        session
    }

    /// The odds of a smooth curve over the three names of such a session.
    fn odds(session: &Session) -> f64 {
        let prepared = PreparedSearch::new(session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let mut fit = regression.fit(&regression.base, &[]);
        for name in NAMES {
            let mut candidates = regression.table.candidates.iter();
            let is = |t: &Term| t.effect.about().id == name;
            let there = candidates.find(|c| c.what.term().is_some_and(is));
            fit = regression.with(&fit, &there.unwrap().what);
        }
        let curve = against(&prepared, &fit, 0).unwrap();
        assert_eq!(curve.names.len(), 3);
        curve.ln_odds
    }

    #[test]
    fn a_pull_of_cables_is_more_of_a_curve_than_three_names() {
        let pull = |q: f64| 0.06 * ((q - 170.0) / 30.0).exp() - 0.05 * ((-170.0 - q) / 45.0).exp();
        let session = axis("", pull);
        assert!(odds(&session) > -UNDECIDED, "{}", odds(&session));
    }

    #[test]
    fn three_names_that_are_there_stay() {
        let of = |id: &str, parameters: &str| {
            format!(r#"{{"effect":"{id}","joint":1,"parameters":{{{parameters}}}}}"#)
        };
        let effects = [
            of(NAMES[0], r#""scale_ppm":250"#),
            of(NAMES[1], r#""amplitude_deg":0.03,"phase_deg":40"#),
            of(NAMES[2], r#""amplitude_deg":0.02,"phase_deg":110"#),
        ];
        let session = axis(&effects.join(","), |_| 0.0);
        assert!(odds(&session) < -UNDECIDED, "{}", odds(&session));
    }
}
