//! Values of a joint that are those of its motor, before the gear, or the counts of an encoder: too large by an unknown
//! ratio.
//!
//! Where a joint's values are far beyond its limits, ratios that bring them within are tried on the nominal robot with
//! the best rigid motion. The best is refined on fits; it is a whole number, or that of an encoder with a power of two
//! of counts a turn, where one of these is near. The scale of a single joint that moves only a part of its commands (a
//! hobby servo whose pulses were taken for degrees) is searched for on fits from the beginning.

use std::borrow::Cow;

use crate::effects::{JointValues, Term, joint_scale};
use crate::fit::problem::Problem;
use crate::kinematics::JointKind;
use crate::numeric::extent;
use crate::sessions::correction::{GRADIAN_DEG, LARGEST_SCALE, SCALE_FAR_FROM_ONE};
use crate::sessions::{Session, SessionCorrection};

use super::fits::thinned;
use super::nearest::Nominal;
use super::thresholds::FEW_SAMPLES;
use crate::fit::base_model;

/// Values within so many times the limits are out of them for another reason.
const BEYOND: f64 = 2.0;
/// Of a joint without limits, the turns that none makes.
const MOST_TURNS: f64 = 2.0;
/// A gear of motors and joints has no more, nor has an encoder more counts a degree.
const LARGEST_RATIO: f64 = 1000.0;
/// From one ratio to the next: a joint at its limit is then off by less than 4°.
const STEP: f64 = 1.02;
/// Steps of the refinement, each to a third of the one before.
const REFINED: usize = 8;
/// The best ratio of the nominal robot is off by no more than this share.
const COARSE: f64 = 0.02;
/// A plain ratio is taken within this share: a scale error of a joint is smaller.
const PLAIN: f64 = 0.002;
/// Counts that an encoder may have in a turn, as powers of two.
const BITS: std::ops::RangeInclusive<u32> = 8..=24;

/// Joints (counted from 0) whose values are likely those of a motor or an encoder, each with the ratio. `residual_mm`
/// is that of a fit to samples.
pub(super) fn likely_ratios(
    session: &Session,
    values: JointValues,
    residual_mm: impl Fn(&Session) -> Option<f64>,
) -> Vec<(usize, f64)> {
    let few = thinned(session, FEW_SAMPLES);
    let nominal = Nominal::of(&few, values);
    let of_joint = |joint: usize| {
        let least = least_ratio(&nominal, &few, joint)?;
        // A motor may turn the other way, and a circle that turns over is the same circle.
        let both = [1.0, -1.0].map(|sign| {
            let ratio = likeliest(&nominal, joint, sign * least)?;
            let residual_mm =
                |ratio| residual_mm(&by_ratio(session, joint, ratio)).unwrap_or(f64::INFINITY);
            let ratio = refined(ratio, residual_mm);
            Some((joint, plain(with_base_model(session, values, joint, ratio))))
        });
        Some(both.into_iter().flatten())
    };
    let joints = 0..few.robot.joints.len();
    joints.filter_map(of_joint).flatten().collect()
}

/// What the only joint likely moves for each unit of its values, forwards and backwards; nothing where they are those
/// of a motor. `residual_mm` is that of a fit to samples.
pub(super) fn likely_scales(
    session: &Session,
    values: JointValues,
    residual_mm: impl Fn(&Session) -> Option<f64>,
) -> Vec<f64> {
    let few = thinned(session, FEW_SAMPLES);
    let is_of_a_motor = least_ratio(&Nominal::of(&few, values), &few, 0).is_some();
    if few.robot.joints.len() != 1 || is_of_a_motor {
        return Vec::new();
    }
    let residual_mm = |ratio| residual_mm(&by_ratio(&few, 0, ratio)).unwrap_or(f64::INFINITY);
    let of_sign = |sign: f64| {
        let all = std::iter::successors(Some(1.0 / LARGEST_SCALE), |ratio| Some(ratio * STEP));
        let all = all.take_while(|ratio| *ratio < LARGEST_SCALE);
        let best = all
            .map(|ratio| (residual_mm(sign * ratio), sign * ratio))
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        let ratio = refined(best.1, residual_mm);
        Some(1.0 / with_base_model(session, values, 0, ratio))
    };
    let both = [1.0, -1.0].into_iter().filter_map(of_sign);
    // Gradians are a unit, with a name of their own.
    let is_far = |scale: f64, from: f64| (scale.abs() / from - 1.0).abs() > SCALE_FAR_FROM_ONE;
    both.filter(|scale| is_far(*scale, 1.0) && is_far(*scale, GRADIAN_DEG))
        .collect()
}

/// The least ratio that brings the values of a joint within its limits; `None` where they are not far beyond them.
fn least_ratio(nominal: &Nominal, session: &Session, joint: usize) -> Option<f64> {
    let own = &session.robot.joints[joint];
    if own.kind != JointKind::Revolute {
        return None;
    }
    let [low, high] = extent(nominal.inputs.q[joint].iter());
    let span = own
        .limits
        .map_or(MOST_TURNS * std::f64::consts::TAU, |limits| {
            limits.to - limits.from
        });
    let times = (high - low) / span;
    (times.is_finite() && span > 0.0 && times > BEYOND).then_some(times)
}

/// The ratio of the sign of `least` with which the nominal robot is nearest to the points.
fn likeliest(nominal: &Nominal, joint: usize, least: f64) -> Option<f64> {
    let residual_mm = |ratio: f64| {
        let mut inputs = nominal.inputs.clone();
        let own = inputs.q[joint].iter().map(|q| q / ratio).collect();
        inputs.q[joint] = Cow::Owned(own);
        nominal.residual_mm(&inputs, false)
    };
    let most = LARGEST_RATIO * least.abs().max(1.0);
    let ratios = std::iter::successors(Some(least), |ratio| Some(ratio * STEP));
    let tried = ratios
        .take_while(|ratio| ratio.abs() <= most)
        .map(|ratio| (residual_mm(ratio), ratio))
        .filter(|tried| tried.0.is_finite());
    tried.min_by(|a, b| a.0.total_cmp(&b.0)).map(|best| best.1)
}

/// The ratio near another with the smallest residual.
fn refined(ratio: f64, residual_mm: impl Fn(f64) -> f64) -> f64 {
    let mut best = (residual_mm(ratio), ratio);
    let mut step = COARSE;
    for _ in 0..REFINED {
        step /= 3.0;
        for by in [1.0 - 2.0 * step, 1.0 - step, 1.0 + step, 1.0 + 2.0 * step] {
            let trial = best.1 * by;
            let value = residual_mm(trial);
            if value < best.0 {
                best = (value, trial);
            }
        }
    }
    best.1
}

/// The ratio fitted with the whole base model: links and homes that are off pass for a part of it in a trial.
fn with_base_model(session: &Session, values: JointValues, joint: usize, ratio: f64) -> f64 {
    let scaled = by_ratio(session, joint, ratio);
    let mut problem = Problem::new(&scaled, values);
    let effect = joint_scale();
    let start =
        base_model::start(&scaled, &problem, |_| true).with_term(Term::absent(effect, joint, 0.0));
    let fitted = base_model::fit(&mut problem, &start, true).solution.model;
    let mut terms = fitted.terms().iter();
    let own = terms.find(|term| term.effect.about().id == effect.about().id);
    let scale = own.and_then(|term| term.coefficients.first().copied());
    ratio / (1.0 + scale.filter(|k| k.abs() < COARSE).unwrap_or(0.0))
}

/// A whole number, or the counts of an encoder in a degree, where one of them is near.
fn plain(ratio: f64) -> f64 {
    let counts = BITS.map(|bits| f64::from(1 << bits) / 360.0 * ratio.signum());
    let off = |plain: f64| (plain / ratio - 1.0).abs();
    let nearest = counts
        .chain([ratio.round()])
        .min_by(|a, b| off(*a).total_cmp(&off(*b)));
    nearest.filter(|plain| off(*plain) < PLAIN).unwrap_or(ratio)
}

/// A session with the values of a joint divided.
fn by_ratio(session: &Session, joint: usize, ratio: f64) -> Session {
    let mut scaled = session.clone();
    let factor = 1.0 / ratio;
    SessionCorrection::ScaleJoint { joint, factor }.apply(&mut scaled);
    scaled
}
