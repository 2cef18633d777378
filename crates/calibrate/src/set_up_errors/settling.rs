//! An instrument that warms up while it measures: its distances settle.
//!
//! ```text
//! p_i = p_i⁰ + a · s_i · exp(−(t_i − t_0) / τ),   s_i the line of sight
//! ```
//!
//! What the fitted robot leaves is regressed on that column for some τ, beside the base model and waves over the joints,
//! and on what else settles in the same time: the frame (moved, or moved and turned), the home of a joint. Lines of sight
//! have to spread for it to be told from a frame that moves.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::numeric::extent;
use crate::sessions::{Session, SessionCorrection};
use crate::text::{Text, length};
use nalgebra::{DVector, Vector3};

use super::left::{Beside, Left, MOST};
use super::looked::{Looked, Unstated};
use super::thresholds::LIKELIER;

/// Times that are tried, as parts of the time that was measured: what settles faster is a few rows, what settles slower a
/// straight line.
const PARTS: [f64; 5] = [0.05, 0.1, 0.2, 0.35, 0.6];

/// No instrument that measures robots settles by more, mm: trackers by a tenth of a millimetre.
const LARGEST_MM: f64 = 5.0;
/// How often the size is fitted again with what it corrected.
const ROUNDS: usize = 2;

/// Distances that settle.
pub(super) fn settles(_: &Session, values: JointValues, looked: &Looked) -> Option<Unstated> {
    let few = &looked.few;
    let times_s = few.samples.time_s.as_ref()?;
    let one_station = few.samples.setups.as_ref()?.names.len() == 1;
    let [from_s, to_s] = extent(times_s);
    if !one_station || from_s >= to_s || times_s.iter().any(|t| !t.is_finite()) {
        return None;
    }
    let (more, mut by_mm, tau_s) = settled(looked, [from_s, to_s])?;
    let mend = |by_mm: f64| SessionCorrection::Settle {
        by_mm,
        from_s,
        tau_s,
    };
    let mut left_mm = looked.rms_mm;
    // What was far off counted as little: sizes are fitted again with what they corrected.
    for _ in 0..ROUNDS {
        let mut corrected = few.clone();
        mend(by_mm).apply(&mut corrected);
        let (left, after_mm) = Left::after_a_fit(&corrected, values)?;
        left_mm = after_mm;
        let beside = Beside::of(&left, &left.waves(&corrected, 1.0))?;
        let column = along_sight(&corrected, &left, from_s, tau_s)?;
        by_mm += beside.with(&[column]).0[0];
    }
    // Rows that are wrong in themselves are no distances that settle.
    if left_mm >= looked.rms_mm || by_mm.abs() > LARGEST_MM {
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
        mend(by_mm),
    );
    Some((more, problem))
}

/// By how much likelier the instrument settles than it has to be, by what, mm, and its time, s.
fn settled(
    Looked { few, left, .. }: &Looked,
    [first_s, last_s]: [f64; 2],
) -> Option<(f64, f64, f64)> {
    let beside = Beside::of(left, &left.waves(few, 1.0))?;
    let at_s = few.samples.time_s.as_ref()?;
    let (mut best, mut rivals) = ((0.0, 0.0, 0.0), 0.0_f64);
    for part in PARTS {
        let tau_s = part * (last_s - first_s);
        let settles = |i: usize| (-(at_s[i] - first_s) / tau_s).exp();
        let (by_mm, nats) = beside.with(&[along_sight(few, left, first_s, tau_s)?]);
        if nats > best.0 {
            best = (nats, by_mm[0], tau_s);
        }
        let frame = left.moved(&left.frame, MOST);
        let frame: Vec<_> = frame.iter().map(|own| left.times(own, settles)).collect();
        let homes = left.joints.iter();
        let homes = homes.map(|own| beside.with(&[left.times(own, settles)]).1);
        rivals = homes.fold(rivals, f64::max);
        rivals = rivals
            .max(beside.with(&frame[..3]).1)
            .max(beside.with(&frame).1);
    }
    let (nats, by_mm, tau_s) = best;
    let more = nats - LIKELIER.max(rivals + 1000.0_f64.ln());
    (more >= 0.0).then_some((more, by_mm, tau_s))
}

/// The column of distances that settle in this time.
fn along_sight(few: &Session, left: &Left, first_s: f64, tau_s: f64) -> Option<DVector<f64>> {
    let at_s = few.samples.time_s.as_ref()?;
    let sight = |i: usize| {
        let point = Vector3::from(left.expected[i]);
        point.try_normalize(0.0).unwrap_or_default()
    };
    Some(left.column(|i| sight(i) * (-(at_s[i] - first_s) / tau_s).exp()))
}
