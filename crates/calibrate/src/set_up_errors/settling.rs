//! An instrument that warms up while it measures: its distances settle.
//!
//! ```text
//! p_i = p_i⁰ + a · s_i · exp(−(t_i − t_0) / τ),   s_i the line of sight
//! ```
//!
//! The residuals of the fitted robot are regressed on that column for some τ, together with the base model and waves
//! over the joints, and on what else settles in the same time: the frame (moved, or moved and turned), the home of a
//! joint. Lines of sight have to spread for it to be distinguished from a frame that moves.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::numeric::extent;
use crate::sessions::{Session, SessionCorrection};
use crate::text::{Text, length};
use nalgebra::{DVector, Vector3};

use super::examined::{Examined, Unstated};
use super::residuals::{MOST, Projected, Residuals};
use super::thresholds::LIKELIER;

/// Times that are tried, as parts of the time that was measured: what settles faster is a few rows, what settles slower a
/// straight line.
const PARTS: [f64; 5] = [0.05, 0.1, 0.2, 0.35, 0.6];

/// No instrument that measures robots settles by more, mm: trackers by a tenth of a millimetre.
const LARGEST_MM: f64 = 5.0;
/// How often the size is fitted again after its correction.
const ROUNDS: usize = 2;

/// Distances that settle.
pub(super) fn settles(_: &Session, values: JointValues, examined: &Examined) -> Option<Unstated> {
    let few = &examined.few;
    let times_s = few.samples.time_s.as_ref()?;
    let one_station = few.samples.setups.as_ref()?.names.len() == 1;
    let [from_s, to_s] = extent(times_s);
    if !one_station || from_s >= to_s || times_s.iter().any(|t| !t.is_finite()) {
        return None;
    }
    let (more, mut by_mm, tau_s) = settled(examined, [from_s, to_s])?;
    let correction = |by_mm: f64| SessionCorrection::Settle {
        by_mm,
        from_s,
        tau_s,
    };
    let mut residual_mm = examined.rms_mm;
    // What was far off counted as little: sizes are fitted again with what they corrected.
    for _ in 0..ROUNDS {
        let mut corrected = few.clone();
        correction(by_mm).apply(&mut corrected);
        let (residuals, after_mm) = Residuals::after_a_fit(&corrected, values)?;
        residual_mm = after_mm;
        let projected = Projected::of(&residuals, &residuals.waves(&corrected, &[1.0]))?;
        let column = along_sight(&corrected, &residuals, from_s, tau_s)?;
        by_mm += projected.with(&[column]).0[0];
    }
    // Rows that are wrong in themselves are no distances that settle.
    if residual_mm >= examined.rms_mm || by_mm.abs() > LARGEST_MM {
        return None;
    }
    let problem = DataProblem::of_all(
        text!(
            "the instrument's distances settle: {by} at the beginning, within {minutes} min",
            by = length(by_mm, 3),
            minutes = Text::verbatim(format!("{:.1}", tau_s / 60.0))
        ),
        text!(
            "more than 1000 times likelier than a frame that moves or turns, or a joint whose home does"
        ),
        text!("the samples are taken without it; let the instrument warm up before measuring"),
        correction(by_mm),
    );
    Some((more, problem))
}

/// By how much likelier the instrument settles than it has to be, by what, mm, and its time, s.
fn settled(
    Examined { few, residuals, .. }: &Examined,
    [first_s, last_s]: [f64; 2],
) -> Option<(f64, f64, f64)> {
    let projected = Projected::of(residuals, &residuals.waves(few, &[1.0]))?;
    let at_s = few.samples.time_s.as_ref()?;
    let (mut best, mut rivals) = ((0.0, 0.0, 0.0), 0.0_f64);
    for part in PARTS {
        let tau_s = part * (last_s - first_s);
        let settles = |i: usize| (-(at_s[i] - first_s) / tau_s).exp();
        let (by_mm, nats) = projected.with(&[along_sight(few, residuals, first_s, tau_s)?]);
        if nats > best.0 {
            best = (nats, by_mm[0], tau_s);
        }
        let frame = residuals.moved(&residuals.frame, MOST);
        let frame: Vec<_> = frame
            .iter()
            .map(|own| residuals.times(own, settles))
            .collect();
        let homes = residuals.joints.iter();
        let homes = homes.map(|own| projected.with(&[residuals.times(own, settles)]).1);
        rivals = homes.fold(rivals, f64::max);
        rivals = rivals
            .max(projected.with(&frame[..3]).1)
            .max(projected.with(&frame).1);
    }
    let (nats, by_mm, tau_s) = best;
    let more = nats - LIKELIER.max(rivals + 1000.0_f64.ln());
    (more >= 0.0).then_some((more, by_mm, tau_s))
}

/// The column of distances that settle in this time.
fn along_sight(
    few: &Session,
    residuals: &Residuals,
    first_s: f64,
    tau_s: f64,
) -> Option<DVector<f64>> {
    let at_s = few.samples.time_s.as_ref()?;
    let sight = |i: usize| {
        let point = Vector3::from(residuals.expected[i]);
        point.try_normalize(0.0).unwrap_or_default()
    };
    Some(residuals.column(|i| sight(i) * (-(at_s[i] - first_s) / tau_s).exp()))
}
