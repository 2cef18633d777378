//! Selection bias: an effect near the limit of detection is named only where the noise happens to enlarge it, so that
//! the size of what is named is too large.
//!
//! With a the root of the gain in units of the noise, less the expected gain of k − 1 further columns by chance, b the
//! least that is named, and δ the true one,
//!
//! ```text
//! P(A > a | A > b) = Φ(δ − a)/Φ(δ − b)
//! ```
//!
//! the 95 % interval of the length goes from where this is 0.025 to where it is 0.975 (conditional inference
//! after selection: Zhong & Prentice 2008; Lee et al. 2016). Of the variance of a component c of a vector, in
//! units of its own standard deviation, (c/a)² is along the length; the rest stays as it was.

use statrs::distribution::{Continuous, ContinuousCDF, Normal};

use crate::diagnosis::evidence::bisected;
use crate::effects::{Form, Term};
use crate::fit::Estimate;
use crate::units::HALF_TURN_DEG;

/// Beyond so many standard deviations over the limit the selection has no effect.
const FAR: f64 = 5.0;
/// Steps of the correction of the value: further ones correct too much, in the mean (`hidden_effects small`).
/// Calibrated: the mean size of what is found at λ = 16 is right within 5 %; after 4 steps it is 7 %
/// too large.
const STEPS: usize = 5;

/// Factors from the estimated size to the corrected one and to the ends of its interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Selection {
    pub(crate) factor: f64,
    low: f64,
    high: f64,
    /// The estimated size in units of its standard deviation.
    length: f64,
}

impl Selection {
    /// `gain` and `least` in units of the noise squared, of `columns` columns. `None` where
    /// there is nothing to correct.
    pub(crate) fn of(gain: f64, least: f64, columns: usize) -> Option<Self> {
        let beyond_chance = |gain: f64| (gain - (columns as f64 - 1.0)).max(f64::EPSILON).sqrt();
        let (a, b) = (beyond_chance(gain), beyond_chance(least));
        if a - b > FAR || a <= b {
            return None;
        }
        let normal = Normal::new(0.0, 1.0).ok()?;
        // For δ far below b both are tails whose ratio tends to exp((δ − …)): solved by halving.
        let chance = |delta: f64| normal.cdf(delta - a) / normal.cdf(delta - b).max(1e-300);
        let solve =
            |wanted: f64| bisected([-30.0, a + 10.0], |delta| chance(delta) < wanted).max(0.0);
        // The mean of A is δ + φ(b − δ)/Φ(δ − b): the excess is subtracted, estimated from the value of the step
        // before (iterated correction of a bias, Hall & Martin 1988).
        let excess = |delta: f64| normal.pdf(b - delta) / normal.cdf(delta - b).max(1e-300);
        let value = (0..STEPS).fold(a, |delta, _| a - excess(delta));
        Some(Self {
            factor: value.max(0.0) / a,
            low: solve(0.025) / a,
            high: solve(0.975) / a,
            length: a,
        })
    }

    /// How many of a term's parameters, the last ones, follow its size or its phase.
    #[allow(clippy::unused_self, reason = "reads as a question to the selection")]
    pub(crate) fn sized(&self, term: &Term) -> usize {
        match term.effect.about().form {
            Form::Plain(quantities) => quantities.len(),
            Form::Harmonic(_) => 2,
            Form::Fading(_) => 1,
        }
    }

    /// Corrects one parameter; a phase stays as it is.
    pub(crate) fn correct(&self, estimate: &mut Estimate) {
        let Some([low, high]) = estimate.ci95 else {
            return;
        };
        let value = estimate.value;
        let half = 0.5 * (high - low);
        if estimate.name.starts_with("phase") {
            // It is as certain as the amplitude is large, which is less than before the correction.
            let half = half / self.factor.max(0.05);
            estimate.ci95 = (half < HALF_TURN_DEG).then_some([value - half, value + half]);
            return;
        }
        let along = [self.low * value, self.high * value];
        let (from, to) = (along[0].min(along[1]), along[0].max(along[1]));
        estimate.value = self.factor * value;
        // The selection acts on the length of a vector; the uncertainty of a component perpendicular to it is
        // unchanged.
        let of_length = 1.96 * value.abs() / (half.max(1e-300) * self.length);
        let across = (1.0 - of_length.powi(2)).max(0.0) * half.powi(2);
        estimate.ci95 = Some([
            estimate.value - (estimate.value - from).hypot(across.sqrt()),
            estimate.value + (to - estimate.value).hypot(across.sqrt()),
        ]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_from_the_limit_nothing_is_corrected_and_near_it_the_size_falls() {
        assert_eq!(Selection::of(400.0, 20.0, 1), None);
        let near = Selection::of(21.0, 20.0, 1).unwrap();
        assert!(
            near.factor < 0.85 && near.low == 0.0 && near.high < 1.5,
            "{near:?}"
        );
        let further = Selection::of(49.0, 20.0, 1).unwrap();
        assert!(further.factor > 0.97, "{further:?}");
    }

    /// A component of 2.5 σ of a vector of 8 σ near the limit is as unsure as any: the corrected length moves it,
    /// and hardly narrows it.
    #[test]
    fn a_small_component_of_a_vector_keeps_its_own_interval() {
        let near = Selection::of(66.0, 30.0, 3).unwrap();
        let estimate = |value: f64| Estimate {
            effect: "base-offset",
            name: "y_mm",
            joint: None,
            setup: None,
            target: None,
            place: None,
            value,
            ci95: Some([value - 1.96, value + 1.96]),
        };
        let mut small = estimate(2.5);
        near.correct(&mut small);
        let [low, high] = small.ci95.unwrap();
        let width = high - low;
        assert!((3.6..4.1).contains(&width), "{small:?}");
        assert!(small.value < 2.5 && low < small.value, "{small:?}");
        // The whole length along one axis is the vector itself.
        let mut all = estimate(8.0);
        near.correct(&mut all);
        let [low, high] = all.ci95.unwrap();
        assert!((low - near.low * 8.0).abs() < 1e-9 && (high - near.high * 8.0).abs() < 1e-9);
    }
}
