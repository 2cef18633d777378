//! Positioning of one axis after ISO 230-2:2014, from deviations `x_ij` = measured − commanded at
//! positions i = 1…m, approached j = 1…n times from below (↑) and from above (↓).
//!
//! ```text
//! x̄_i↑ = Σ_j x_ij↑ / n                       mean unidirectional deviation (↓ alike)
//! s_i↑ = √( Σ_j (x_ij↑ − x̄_i↑)² / (n − 1) )   estimator of the repeatability
//! x̄_i  = (x̄_i↑ + x̄_i↓) / 2                   mean bidirectional deviation
//! B_i  = x̄_i↑ − x̄_i↓                          reversal; B = max |B_i|, B̄ = Σ B_i / m
//! R_i↑ = 4 s_i↑,  R_i = max(2 s_i↑ + 2 s_i↓ + |B_i|, R_i↑, R_i↓);  R↑, R↓, R the largest
//! E↑   = max x̄_i↑ − min x̄_i↑,  E over both sides;  M = max x̄_i − min x̄_i
//! A↑   = max(x̄_i↑ + 2 s_i↑) − min(x̄_i↑ − 2 s_i↑),  A over both sides
//! ```
//!
//! E, M and A are ranges: a constant error of the axis (its zero) is in none of them. The unit is
//! that of the deviations. What cannot be computed is `None`: a reversal needs both sides, a
//! standard deviation two approaches.
use crate::text::Template;

/// Deviations at one commanded position, seconds of arc or mm.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Position {
    /// The commanded position, degrees or mm.
    pub commanded: f64,
    /// Deviations of approaches from below, in measuring order.
    pub up: Vec<f64>,
    /// Deviations of approaches from above.
    pub down: Vec<f64>,
}

/// What one position gives, in the unit of its deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtPosition {
    /// The commanded position, degrees or mm.
    pub commanded: f64,
    /// Numbers of approaches from below and from above.
    pub runs: [usize; 2],
    /// `x̄_i↑` and `x̄_i↓`.
    pub mean: [Option<f64>; 2],
    /// `s_i↑` and `s_i↓`.
    pub deviation: [Option<f64>; 2],
    /// `R_i↑` and `R_i↓`.
    pub repeatability: [Option<f64>; 2],
    /// `x̄_i`.
    pub mean_of_both: Option<f64>,
    /// `B_i`.
    pub reversal: Option<f64>,
    /// `R_i`.
    pub repeatability_of_both: Option<f64>,
}

/// What the axis gives, in the unit of the deviations. Pairs are from below and from above.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Positioning {
    /// Position by position.
    pub positions: Vec<AtPosition>,
    /// B, the reversal value of the axis.
    pub reversal: Option<f64>,
    /// B̄, the mean reversal value.
    pub mean_reversal: Option<f64>,
    /// R↑ and R↓, unidirectional repeatability.
    pub repeatability: [Option<f64>; 2],
    /// R, bidirectional repeatability.
    pub repeatability_of_both: Option<f64>,
    /// E↑ and E↓, unidirectional systematic deviation.
    pub systematic: [Option<f64>; 2],
    /// E, bidirectional systematic deviation.
    pub systematic_of_both: Option<f64>,
    /// M, range of the mean bidirectional deviation.
    pub mean_range: Option<f64>,
    /// A↑ and A↓, unidirectional accuracy.
    pub accuracy: [Option<f64>; 2],
    /// A, bidirectional accuracy.
    pub accuracy_of_both: Option<f64>,
}

impl AtPosition {
    fn new(position: &Position) -> Self {
        let sides = [&position.up, &position.down];
        let mean = sides.map(|x| mean(x));
        let deviation = sides.map(|x| sample_deviation(x));
        let reversal = both(mean).map(|[up, down]| up - down);
        let repeatability = deviation.map(|s| s.map(|s| 4.0 * s));
        let of_both = reversal.zip(both(deviation)).map(|(b, [up, down])| {
            let across = 2.0 * up + 2.0 * down + b.abs();
            across.max(4.0 * up).max(4.0 * down)
        });
        Self {
            commanded: position.commanded,
            runs: sides.map(Vec::len),
            mean,
            deviation,
            repeatability,
            mean_of_both: both(mean).map(|[up, down]| f64::midpoint(up, down)),
            reversal,
            repeatability_of_both: of_both,
        }
    }

    /// x̄ + k s of one side.
    fn bound(&self, side: usize, k: f64) -> Option<f64> {
        Some(self.mean[side]? + k * self.deviation[side]?)
    }
}

impl Positioning {
    /// The figures of an axis.
    pub fn new(positions: &[Position]) -> Self {
        let at: Vec<AtPosition> = positions.iter().map(AtPosition::new).collect();
        let on = |side: usize| [side];
        let range = |sides: &[usize], k: f64| {
            let high = all(&at, sides, |p, side| p.bound_or_mean(side, k))?;
            let low = all(&at, sides, |p, side| p.bound_or_mean(side, -k))?;
            Some(largest(&high)? - smallest(&low)?)
        };
        let reversals = all(&at, &[0], |p, _| p.reversal);
        let means = all(&at, &[0], |p, _| p.mean_of_both);
        let repeatable = |side: usize| {
            all(&at, &on(side), |p, side| p.repeatability[side]).and_then(|r| largest(&r))
        };
        Self {
            reversal: reversals
                .as_ref()
                .and_then(|b| largest(&b.iter().map(|b| b.abs()).collect::<Vec<_>>())),
            mean_reversal: reversals.as_ref().and_then(|b| mean(b)),
            repeatability: [repeatable(0), repeatable(1)],
            repeatability_of_both: all(&at, &[0], |p, _| p.repeatability_of_both)
                .and_then(|r| largest(&r)),
            systematic: [range(&on(0), 0.0), range(&on(1), 0.0)],
            systematic_of_both: range(&[0, 1], 0.0),
            mean_range: means.and_then(|m| Some(largest(&m)? - smallest(&m)?)),
            accuracy: [range(&on(0), 2.0), range(&on(1), 2.0)],
            accuracy_of_both: range(&[0, 1], 2.0),
            positions: at,
        }
    }

    /// The axis' figures with the standard's symbols and names.
    pub fn rows(&self) -> [(&'static str, Template, Option<f64>); 12] {
        let ([r_up, r_down], [e_up, e_down]) = (self.repeatability, self.systematic);
        let [a_up, a_down] = self.accuracy;
        [
            ("A", phrase!("accuracy"), self.accuracy_of_both),
            ("A↑", phrase!("accuracy"), a_up),
            ("A↓", phrase!("accuracy"), a_down),
            (
                "E",
                phrase!("systematic deviation"),
                self.systematic_of_both,
            ),
            ("E↑", phrase!("systematic deviation"), e_up),
            ("E↓", phrase!("systematic deviation"), e_down),
            (
                "M",
                phrase!("range of the mean bidirectional deviation"),
                self.mean_range,
            ),
            ("R", phrase!("repeatability"), self.repeatability_of_both),
            ("R↑", phrase!("repeatability"), r_up),
            ("R↓", phrase!("repeatability"), r_down),
            ("B", phrase!("reversal value"), self.reversal),
            ("B mean", phrase!("mean reversal value"), self.mean_reversal),
        ]
    }

    /// Fewest approaches from below and from above.
    pub fn fewest_runs(&self) -> [usize; 2] {
        let fewest = |side: usize| self.positions.iter().map(|p| p.runs[side]).min();
        [fewest(0).unwrap_or(0), fewest(1).unwrap_or(0)]
    }
}

impl AtPosition {
    fn bound_or_mean(&self, side: usize, k: f64) -> Option<f64> {
        if k == 0.0 {
            self.mean[side]
        } else {
            self.bound(side, k)
        }
    }
}

/// A value of every position and side; `None` where one has none.
fn all(
    at: &[AtPosition],
    sides: &[usize],
    value: impl Fn(&AtPosition, usize) -> Option<f64>,
) -> Option<Vec<f64>> {
    let pairs = at.iter().flat_map(|p| sides.iter().map(move |s| (p, *s)));
    pairs.map(|(p, side)| value(p, side)).collect()
}

fn both(pair: [Option<f64>; 2]) -> Option<[f64; 2]> {
    Some([pair[0]?, pair[1]?])
}

fn largest(values: &[f64]) -> Option<f64> {
    values.iter().copied().reduce(f64::max)
}

fn smallest(values: &[f64]) -> Option<f64> {
    values.iter().copied().reduce(f64::min)
}

/// Arithmetic mean; `None` of nothing.
pub(super) fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Standard deviation of a sample, divided by n − 1; `None` of fewer than two.
pub(super) fn sample_deviation(values: &[f64]) -> Option<f64> {
    let mean = mean(values)?;
    let square: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    (values.len() > 1).then(|| (square / (values.len() - 1) as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn position(commanded: f64, up: &[f64], down: &[f64]) -> Position {
        Position {
            commanded,
            up: up.to_vec(),
            down: down.to_vec(),
        }
    }

    #[test]
    fn two_positions_by_hand() {
        // s↑ = √2, √2·2; s↓ = 0, √2; B = −2, +1.
        let figures = Positioning::new(&[
            position(0.0, &[1.0, 3.0], &[4.0, 4.0]),
            position(10.0, &[0.0, 4.0], &[0.0, 2.0]),
        ]);
        let root = 2.0_f64.sqrt();
        let near = |value: Option<f64>, expected: f64| {
            assert!(
                (value.expect("a figure") - expected).abs() < 1e-12,
                "{value:?} {expected}"
            );
        };
        near(figures.reversal, 2.0);
        near(figures.mean_reversal, -0.5);
        near(figures.repeatability[0], 8.0 * root);
        near(figures.repeatability[1], 4.0 * root);
        near(figures.repeatability_of_both, 8.0 * root);
        near(figures.systematic[0], 0.0);
        near(figures.systematic[1], 3.0);
        near(figures.systematic_of_both, 3.0);
        near(figures.mean_range, 1.5);
        near(figures.accuracy[0], 8.0 * root);
        near(figures.accuracy[1], 4.0 - (1.0 - 2.0 * root));
        near(
            figures.accuracy_of_both,
            (2.0 + 4.0 * root) - (2.0 - 4.0 * root),
        );
    }

    #[test]
    fn one_approach_has_means_and_no_spread_one_side_has_no_reversal() {
        let once =
            Positioning::new(&[position(0.0, &[1.0], &[2.0]), position(1.0, &[3.0], &[5.0])]);
        assert_eq!(once.reversal, Some(2.0));
        assert_eq!(once.systematic_of_both, Some(4.0));
        assert_eq!(once.accuracy_of_both, None);
        assert_eq!(once.repeatability_of_both, None);
        let one_way = Positioning::new(&[
            position(0.0, &[1.0, 2.0], &[]),
            position(1.0, &[3.0, 3.0], &[]),
        ]);
        assert_eq!(one_way.reversal, None);
        assert!(one_way.accuracy[0].is_some());
        assert_eq!(one_way.accuracy[1], None);
        assert_eq!(Positioning::new(&[]), Positioning::default());
    }
}
