//! Sums over the samples from which every order is fitted: one pass, however many orders.
//!
//! The normal equations of 1, cos jθ, sin jθ, … need no other sums of the angles than those of
//! cos kθ and sin kθ, here `c` and `s`, because a product of two waves is two waves:
//!
//! ```text
//! Σ cos jθ cos kθ = (c_{j−k} + c_{j+k}) / 2      Σ sin jθ sin kθ = (c_{j−k} − c_{j+k}) / 2
//! Σ cos jθ sin kθ = (s_{j+k} + s_{k−j}) / 2
//! ```
//!
//! cos kθ and sin kθ come from those of k − 1 by one multiplication of complex numbers.

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sums {
    /// Number of samples.
    pub(super) count: f64,
    /// Σ cos kθ and Σ sin kθ, k from 0.
    angles: Vec<[f64; 2]>,
    /// Of each series of values, its mean taken off: Σ y cos kθ and Σ y sin kθ, and Σ y².
    series: Vec<(Vec<[f64; 2]>, f64)>,
}

impl Sums {
    /// Sums over angles, rad, and some series of values at them, for orders up to `highest`.
    pub(super) fn new(angles_rad: &[f64], series: &[&[f64]], highest: usize) -> Self {
        let count = angles_rad.len() as f64;
        let means = series
            .iter()
            .map(|y| y.iter().sum::<f64>() / count.max(1.0));
        let means: Vec<f64> = means.collect();
        let mut angles = vec![[0.0; 2]; 2 * highest + 1];
        let mut sums: Vec<_> = series
            .iter()
            .map(|_| (vec![[0.0; 2]; highest + 1], 0.0))
            .collect();
        let mut values = vec![0.0; series.len()];
        for (i, angle) in angles_rad.iter().enumerate() {
            let (sin, cos) = angle.sin_cos();
            for (k, y) in series.iter().enumerate() {
                values[k] = y[i] - means[k];
                sums[k].1 += values[k] * values[k];
            }
            let [mut re, mut im] = [1.0, 0.0];
            for (m, sum) in angles.iter_mut().enumerate() {
                sum[0] += re;
                sum[1] += im;
                if m <= highest {
                    for (value, (of, _)) in values.iter().zip(&mut sums) {
                        of[m][0] += value * re;
                        of[m][1] += value * im;
                    }
                }
                (re, im) = (re * cos - im * sin, re * sin + im * cos);
            }
        }
        Self {
            count,
            angles,
            series: sums,
        }
    }

    /// Sum of squares of a series about its mean.
    pub(super) fn squares(&self, series: usize) -> f64 {
        self.series[series].1
    }

    /// Products of a series with cosine and sine of an order.
    pub(super) fn with(&self, series: usize, order: usize) -> [f64; 2] {
        self.series[series].0[order]
    }

    /// Sums of cosine and sine of an order: its products with the constant.
    pub(super) fn alone(&self, order: usize) -> [f64; 2] {
        self.angles[order]
    }

    /// Products of cosine and sine of one order (rows) with those of another (columns).
    pub(super) fn between(&self, j: usize, k: usize) -> [[f64; 2]; 2] {
        let [c_plus, s_plus] = self.angles[j + k];
        let [c_minus, s_minus] = self.angles[j.abs_diff(k)];
        // Σ sin((k − j)θ)
        let s_minus = if k >= j { s_minus } else { -s_minus };
        [
            [0.5 * (c_minus + c_plus), 0.5 * (s_plus + s_minus)],
            [0.5 * (s_plus - s_minus), 0.5 * (c_minus - c_plus)],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sums_are_those_of_the_products() {
        let angles: Vec<f64> = (0..57).map(|i| f64::from(i * i % 91) * 0.07).collect();
        let values: Vec<f64> = (0..57).map(|i| f64::from(i * 13 % 29)).collect();
        let sums = Sums::new(&angles, &[&values], 9);
        let mean = values.iter().sum::<f64>() / 57.0;
        let wave = |k: usize, part: usize, angle: f64| {
            let (sin, cos) = (k as f64 * angle).sin_cos();
            [cos, sin][part]
        };
        for (j, k) in [(1, 1), (2, 5), (9, 4)] {
            let between = sums.between(j, k);
            for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let product = |angle: &f64| wave(j, a, *angle) * wave(k, b, *angle);
                let expected: f64 = angles.iter().map(product).sum();
                assert!((between[a][b] - expected).abs() < 1e-10, "{j} {k} {a} {b}");
            }
        }
        let pairs = || angles.iter().zip(&values);
        let expected: f64 = pairs().map(|(a, y)| (y - mean) * wave(7, 1, *a)).sum();
        assert!((sums.with(0, 7)[1] - expected).abs() < 1e-9);
        let squares: f64 = values.iter().map(|y| (y - mean) * (y - mean)).sum();
        assert!((sums.squares(0) - squares).abs() < 1e-9 * squares);
    }
}
