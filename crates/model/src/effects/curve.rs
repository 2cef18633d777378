//! A smooth function of a joint's value and of the side from which it came in three directions, given by its
//! values at equal steps.
//!
//! ```text
//! s(q, dir) = Σ_k w_k(u) (v_k + dir h_k),   u = (q − from)/step,   w the cubic weights of Catmull & Rom (1974)
//! ```
//!
//! v is common to both sides, h half of the reversal: dir is +1 moving positive, −1 moving negative, 0 unknown.
//! It runs through the values at the knots and has no kink between them. Outside the range the
//! value at its end is held: nothing was measured there. With a period the knots cover one period
//! and repeat.

/// Directions of a curve, in order: along the joint's motion, along its radius, along its axis.
pub const DIRECTIONS: usize = 3;
/// Parts of a curve: what is common to both sides in each direction, then half of the reversal in each.
pub(crate) const PARTS: usize = 2 * DIRECTIONS;
/// More knots than this are a mistake.
pub(crate) const MOST_KNOTS: usize = 10_000;

/// Where the knots are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knots {
    /// Lower end of the range, rad or mm.
    pub from: f64,
    /// Upper end of the range, rad or mm.
    pub to: f64,
    /// After so much it repeats, rad or mm; the first knot of every period is at `from` and its
    /// multiples.
    pub period: Option<f64>,
    /// Number of knots over the range, ends included, or over one period.
    pub count: usize,
}

/// Why there is no such curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// The range makes no sense.
    #[error("a range from {from} to {to}; expected a range from the smaller to the larger value")]
    Range {
        /// Lower end as given.
        from: f64,
        /// Upper end as given.
        to: f64,
    },
    /// The period makes no sense.
    #[error("a period of {0}; expected a number above 0")]
    Period(f64),
    /// Too few or too many knots.
    #[error("{0} knots; expected 2 to {MOST_KNOTS}")]
    Count(usize),
    /// Directions with different numbers of values.
    #[error("{found} values in one direction and {expected} knots; expected as many")]
    Lengths {
        /// What was given.
        found: usize,
        /// How many knots there are.
        expected: usize,
    },
    /// A value that is no number, or a standard deviation that is negative.
    #[error("a value that is not a number")]
    NotANumber,
}

impl Knots {
    /// Whether the knots are valid.
    ///
    /// # Errors
    /// See [`CurveError`].
    pub fn check(&self) -> Result<(), CurveError> {
        let Self { from, to, .. } = *self;
        // Written so that NaN fails.
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(CurveError::Range { from, to });
        }
        if let Some(period) = self.period
            && !(period.is_finite() && period > 0.0)
        {
            return Err(CurveError::Period(period));
        }
        if self.count < 2 || self.count > MOST_KNOTS {
            return Err(CurveError::Count(self.count));
        }
        Ok(())
    }

    /// Which values count at `q`, and how much. Outside the range: as at its end.
    pub fn weights(&self, q: f64) -> [(usize, f64); 4] {
        let q = q.max(self.from).min(self.to);
        let (first, t) = self.split(q);
        let (t2, t3) = (t * t, t * t * t);
        let w = [
            0.5 * (2.0 * t2 - t - t3),
            0.5 * (3.0 * t3 - 5.0 * t2 + 2.0),
            0.5 * (t + 4.0 * t2 - 3.0 * t3),
            0.5 * (t3 - t2),
        ];
        self.placed(first, w)
    }

    /// The derivatives of the weights by `q`; none outside the range, where the end is held.
    pub fn slopes(&self, q: f64) -> [(usize, f64); 4] {
        let (first, t) = self.split(q.max(self.from).min(self.to));
        let per_step = if self.covers(q) {
            0.5 / self.step()
        } else {
            0.0
        };
        let t2 = t * t;
        let w = [
            4.0 * t - 1.0 - 3.0 * t2,
            9.0 * t2 - 10.0 * t,
            1.0 + 8.0 * t - 9.0 * t2,
            3.0 * t2 - 2.0 * t,
        ];
        self.placed(first, w.map(|w| w * per_step))
    }

    /// Weights of the four knots around the step that begins at knot `first`.
    fn placed(&self, first: usize, mut w: [f64; 4]) -> [(usize, f64); 4] {
        let n = self.count;
        if self.period.is_some() {
            let at = |k: usize| (first + n + k).saturating_sub(1) % n.max(1);
            return std::array::from_fn(|k| (at(k), w[k]));
        }
        // Beyond the ends the values go on straight.
        if first == 0 {
            w[1] += 2.0 * w[0];
            w[2] -= w[0];
            w[0] = 0.0;
        }
        if first + 2 == n {
            w[2] += 2.0 * w[3];
            w[1] -= w[3];
            w[3] = 0.0;
        }
        let at = |k: usize| (first + k).saturating_sub(1).min(n.saturating_sub(1));
        std::array::from_fn(|k| (at(k), w[k]))
    }

    /// The knot at or below a value in the range, and the share of the way to the next one.
    fn split(&self, q: f64) -> (usize, f64) {
        let (n, above) = (self.count, q - self.from);
        if let Some(period) = self.period {
            return split(
                (above / period).rem_euclid(1.0) * n as f64,
                n.saturating_sub(1),
            );
        }
        let (gaps, last) = (n.saturating_sub(1), n.saturating_sub(2));
        split(above / (self.to - self.from) * gaps as f64, last)
    }

    /// Whether something was measured there.
    pub fn covers(&self, q: f64) -> bool {
        q >= self.from && q <= self.to
    }

    /// The places of the knots, rad or mm; with a period those of the first one.
    pub fn places(&self) -> Vec<f64> {
        let step = self.step();
        (0..self.count)
            .map(|k| self.from + step * k as f64)
            .collect()
    }

    /// From one knot to the next, rad or mm.
    fn step(&self) -> f64 {
        match self.period {
            Some(period) => period / self.count as f64,
            None => (self.to - self.from) / self.count.saturating_sub(1) as f64,
        }
    }
}

/// The whole part, at most `largest`, and the rest.
fn split(u: f64, largest: usize) -> (usize, f64) {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and the number of knots; NaN becomes 0"
    )]
    let whole = (u as usize).min(largest);
    (whole, u - whole as f64)
}

/// Values at the knots, or their standard deviations, part by part: rad (a sliding joint: mm) along the motion, mm
/// across it; none where the curve does nothing.
pub type Parts = [Vec<f64>; PARTS];

/// A cubic spline over a joint's value in three directions, given at equal steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    knots: Knots,
    values: Parts,
    sigma: Parts,
}

impl Curve {
    /// A curve from its values at the knots and their standard deviations, each along the joint's motion, along
    /// its radius and along its axis: first those common to both sides, then half of the reversal.
    ///
    /// # Errors
    /// See [`CurveError`].
    pub fn new(
        knots: Knots,
        values: [Vec<f64>; PARTS],
        sigma: [Vec<f64>; PARTS],
    ) -> Result<Self, CurveError> {
        knots.check()?;
        for (values, sigma) in values.iter().zip(&sigma) {
            let expected = if values.is_empty() { 0 } else { knots.count };
            for found in [values.len(), sigma.len()] {
                if found != expected {
                    return Err(CurveError::Lengths {
                        found,
                        expected: knots.count,
                    });
                }
            }
            let good = values.iter().all(|v| v.is_finite())
                && sigma.iter().all(|s| s.is_finite() && *s >= 0.0);
            if !good {
                return Err(CurveError::NotANumber);
            }
        }
        Ok(Self {
            knots,
            values,
            sigma,
        })
    }

    /// Where the knots are.
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// Values at the knots of a part (0 to 5); empty where the curve does nothing.
    pub fn values(&self, part: usize) -> &[f64] {
        self.values.get(part).map_or(&[], Vec::as_slice)
    }

    /// Their standard deviations.
    pub fn sigma(&self, part: usize) -> &[f64] {
        self.sigma.get(part).map_or(&[], Vec::as_slice)
    }

    /// The curve at a joint's value: along the joint's motion (rad or mm), along its radius and
    /// along its axis (mm). Outside the measured range the end values are held.
    pub fn at(&self, q: f64, dir: f64) -> [f64; DIRECTIONS] {
        self.weighed(&self.knots.weights(q), dir)
    }

    /// The derivatives of the curve by the joint's value, per rad or per mm.
    pub fn slope(&self, q: f64, dir: f64) -> [f64; DIRECTIONS] {
        self.weighed(&self.knots.slopes(q), dir)
    }

    fn weighed(&self, weights: &[(usize, f64); 4], dir: f64) -> [f64; DIRECTIONS] {
        let part = |part: usize| {
            let values = &self.values[part];
            if values.is_empty() {
                return 0.0;
            }
            weights.iter().map(|(k, w)| w * values[*k]).sum::<f64>()
        };
        std::array::from_fn(|d| part(d) + dir * part(DIRECTIONS + d))
    }

    /// How sure the curve is there, one standard deviation; `None` outside the measured range:
    /// not measured.
    pub fn sigma_at(&self, q: f64, dir: f64) -> Option<[f64; DIRECTIONS]> {
        if !self.knots.covers(q) {
            return None;
        }
        // Between the knots: straight, from one to the next.
        let n = self.knots.count;
        let (first, t) = self.knots.split(q);
        let next = (first + 1) % n;
        let part = |part: usize| {
            let sigma = &self.sigma[part];
            if sigma.is_empty() {
                return 0.0;
            }
            (1.0 - t) * sigma[first] + t * sigma[next]
        };
        Some(std::array::from_fn(|d| {
            part(d).hypot(dir * part(DIRECTIONS + d))
        }))
    }

    /// The same curve along the joint's motion alone.
    #[must_use]
    pub fn along_the_motion(&self) -> Self {
        let only = |all: &Parts| {
            let kept = |part: usize| part.is_multiple_of(DIRECTIONS);
            std::array::from_fn(|part| {
                if kept(part) {
                    all[part].clone()
                } else {
                    Vec::new()
                }
            })
        };
        Self {
            knots: self.knots,
            values: only(&self.values),
            sigma: only(&self.sigma),
        }
    }

    /// The largest value at a knot by direction, on either side, without its sign.
    pub fn largest(&self) -> [f64; DIRECTIONS] {
        let places = self.knots.places().into_iter();
        let both = places.flat_map(|q| [-1.0, 1.0].map(|dir| self.at(q, dir)));
        both.fold([0.0; DIRECTIONS], |most, here| {
            std::array::from_fn(|d| most[d].max(here[d].abs()))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knots(period: Option<f64>) -> Knots {
        Knots {
            from: -1.0,
            to: 2.0,
            period,
            count: 7,
        }
    }

    fn curve(knots: Knots, f: impl Fn(f64) -> f64) -> Curve {
        let values: Vec<f64> = knots.places().into_iter().map(f).collect();
        let sigma = vec![0.1; values.len()];
        Curve::new(knots, along(values), along(sigma)).unwrap()
    }

    /// Along the motion, the same on both sides.
    fn along(values: Vec<f64>) -> Parts {
        let mut parts = Parts::default();
        parts[0] = values;
        parts
    }

    #[test]
    fn it_runs_through_its_knots_and_keeps_a_straight_line_straight() {
        let line = curve(knots(None), |q| 3.0 - 2.0 * q);
        for k in 0..=300 {
            let q = -1.0 + 0.01 * f64::from(k);
            assert!((line.at(q, 0.0)[0] - (3.0 - 2.0 * q)).abs() < 1e-12, "{q}");
        }
        let wave = curve(knots(None), |q| (2.0 * q).sin());
        for (q, v) in wave.knots().places().iter().zip(wave.values(0)) {
            assert!((wave.at(*q, 0.0)[0] - v).abs() < 1e-12);
        }
    }

    #[test]
    fn outside_the_range_the_end_is_held_and_nothing_is_known() {
        let line = curve(knots(None), |q| q);
        assert_eq!(line.at(-7.0, 1.0), line.at(-1.0, -1.0));
        assert_eq!(line.at(9.0, 0.0), line.at(2.0, 0.0));
        assert_eq!(line.sigma_at(9.0, 0.0), None);
        assert_eq!(line.sigma_at(-1.1, 0.0), None);
        assert_eq!(line.sigma_at(0.3, 0.0), Some([0.1, 0.0, 0.0]));
    }

    #[test]
    fn a_period_repeats_without_a_seam() {
        let wave = curve(knots(Some(0.5)), |q| {
            (std::f64::consts::TAU * q / 0.5).sin()
        });
        for q in [-0.9, -0.51, 0.0, 0.13] {
            let [here, next] = [q, q + 0.5].map(|q| wave.at(q, 0.0)[0]);
            assert!((here - next).abs() < 1e-12, "{q}");
        }
        let seam = [-0.5 - 1e-9, -0.5 + 1e-9].map(|q| wave.at(q, 0.0)[0]);
        assert!((seam[0] - seam[1]).abs() < 1e-6);
    }

    #[test]
    fn the_slope_is_the_derivative() {
        for period in [None, Some(0.5)] {
            let wave = curve(knots(period), |q| (2.0 * q).sin());
            for k in 1..300 {
                let q = -1.0 + 0.01 * f64::from(k) + 0.0037;
                let [below, above] = [q - 1e-6, q + 1e-6].map(|q| wave.at(q, 0.0)[0]);
                let by_difference = (above - below) / 2e-6;
                assert!((wave.slope(q, 0.0)[0] - by_difference).abs() < 1e-7, "{q}");
            }
            assert_eq!(wave.slope(-1.5, 0.0), [0.0; 3]);
            assert_eq!(wave.slope(2.5, 0.0), [0.0; 3]);
        }
    }

    #[test]
    fn two_knots_are_a_line_and_bad_ones_are_refused() {
        let two = Knots {
            count: 2,
            ..knots(None)
        };
        assert!((curve(two, |q| q).at(0.5, 0.0)[0] - 0.5).abs() < 1e-12);
        let bad = [
            Knots { count: 1, ..two },
            Knots { to: -1.0, ..two },
            Knots {
                from: f64::NAN,
                ..two
            },
            Knots {
                period: Some(0.0),
                ..two
            },
        ];
        for knots in bad {
            assert!(knots.check().is_err(), "{knots:?}");
        }
        let short = along(vec![1.0]);
        assert!(Curve::new(two, short.clone(), short).is_err());
    }

    #[test]
    fn half_of_the_reversal_is_added_on_one_side_and_taken_away_on_the_other() {
        let knots = knots(None);
        let mut values = along(knots.places());
        values[DIRECTIONS] = vec![0.5; knots.count];
        let mut sigma = along(vec![0.3; knots.count]);
        sigma[DIRECTIONS] = vec![0.4; knots.count];
        let curve = Curve::new(knots, values, sigma).unwrap();
        let at = [-1.0, 0.0, 1.0].map(|dir| curve.at(0.25, dir)[0]);
        for (found, wanted) in at.iter().zip([-0.25, 0.25, 0.75]) {
            assert!((found - wanted).abs() < 1e-12, "{at:?}");
        }
        assert_eq!(curve.slope(0.25, 1.0)[0], curve.slope(0.25, -1.0)[0]);
        let sure = [0.0, -1.0].map(|dir| curve.sigma_at(0.25, dir).unwrap()[0]);
        assert!((sure[0] - 0.3).abs() < 1e-12 && (sure[1] - 0.5).abs() < 1e-12);
        assert_eq!(curve.largest(), [2.5, 0.0, 0.0]);
        assert_eq!(curve.along_the_motion(), curve);
    }
}
