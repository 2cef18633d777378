//! How large the deviation is at each whole number of cycles per turn, by least squares: samples
//! are not evenly spaced, and may cover a part of a turn only.
//!
//! ```text
//! y(θ) = y₀ + Σ (a_k cos kθ + b_k sin kθ) + noise,      amplitude of order k = √(a_k² + b_k²)
//! ```
//!
//! Orders that stand out are taken into the model one after the other, the largest first, and all
//! of them fitted together each time (orthogonal matching pursuit; Pati, Rezaiifar & Krishnaprasad
//! 1993), so that a large order does not lend its size to its neighbours. What an order has that
//! does not stand out is its part of the residual. Order k stands out where its gain G in the sum
//! of squares R of the residual is more than noise gives to the largest of K orders but once in a
//! hundred sessions:
//!
//! ```text
//! P(G/R > g) = (1 − g)^(ν/2) for one order;      g = 1 − (1 − 0.99^(1/K))^(2/ν)
//! ```
//!
//! (the F test of two columns against ν degrees of freedom). The noise line is the amplitude with
//! just that gain.

mod sums;

use std::f64::consts::TAU;

use crate::numeric::whole;
use nalgebra::{Cholesky, DMatrix, DVector, Matrix2, Vector2};

use sums::Sums;

/// Orders from 1 to here are shown, as far as the samples tell them apart.
const HIGHEST: usize = 24;
/// Noise alone gives no bar above the line in this share of sessions.
const QUIET: f64 = 0.99;
/// On each side of an order that is known (a gear's).
const AROUND: usize = 2;
/// Orders beyond this would take too long.
const MOST: usize = 400;
/// An order of which the samples show less than this share (of half of them) is not shown.
const SEEN: f64 = 0.02;

/// The size of one order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitude {
    /// How large it is, mm.
    pub mm: f64,
    /// How large noise alone makes it; `None` where there are too few samples to say.
    pub line_mm: Option<f64>,
}

impl Amplitude {
    /// Whether it is more than noise.
    pub fn stands_out(self) -> bool {
        self.line_mm.is_some_and(|line| self.mm > line)
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Order {
    /// Cycles per turn.
    pub order: usize,
    /// Of the nominal robot's deviation.
    pub before: Amplitude,
    /// Of what is left.
    pub after: Option<Amplitude>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// The orders, ascending; those that the range does not show are left out.
    pub orders: Vec<Order>,
    /// Orders up to this one cannot be seen in the range; 0: all can.
    pub unseen: usize,
    /// Which part of a turn the samples cover.
    pub turns: f64,
    /// Orders of gears that are known.
    pub gears: Vec<usize>,
    /// Number of samples.
    pub(crate) samples: usize,
}

impl Spectrum {
    /// Of values before, and after where they are known, at these angles (rad). `gears` are
    /// orders that have to be looked at with their neighbours.
    pub fn new(angles_rad: &[f64], before: &[f64], after: Option<&[f64]>, gears: &[usize]) -> Self {
        let (turns, finest) = reach(angles_rad);
        let freedom = angles_rad.len().saturating_sub(1) / 4;
        let highest = HIGHEST.min(finest).min(freedom);
        let mut orders: Vec<usize> = (1..=highest).collect();
        let gears: Vec<usize> = gears.iter().copied().filter(|g| *g <= MOST).collect();
        if highest > 0 {
            for gear in &gears {
                orders.extend(gear.saturating_sub(AROUND).max(1)..=gear + AROUND);
            }
        }
        orders.sort_unstable();
        orders.dedup();
        let series: Vec<&[f64]> = [Some(before), after].into_iter().flatten().collect();
        let largest = orders.last().copied().unwrap_or(0);
        let sums = Sums::new(angles_rad, &series, largest);
        let seen = |order: &usize| {
            let share = smallest(&alone(&sums, *order)) / (0.5 * sums.count);
            share > SEEN
        };
        let unseen = orders.iter().position(&seen).unwrap_or(orders.len());
        let unseen = orders[..unseen].last().copied().unwrap_or(0);
        orders.retain(seen);
        let fits: Vec<_> = (0..series.len()).map(|k| fit(&sums, k, &orders)).collect();
        let order = |(k, order): (usize, &usize)| Order {
            order: *order,
            before: fits[0][k],
            after: fits.get(1).map(|fit| fit[k]),
        };
        Self {
            orders: orders.iter().enumerate().map(order).collect(),
            unseen,
            turns,
            gears,
            samples: angles_rad.len(),
        }
    }
}

/// Which part of a turn angles cover, and the highest order that their number can show.
fn reach(angles_rad: &[f64]) -> (f64, usize) {
    let mut sorted = angles_rad.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    let (Some(first), Some(last)) = (sorted.first(), sorted.last()) else {
        return (0.0, 0);
    };
    let range = last - first;
    if sorted.len() < 5 || range <= 0.0 {
        return (range / TAU, 0);
    }
    let finest = 0.5 * TAU * (sorted.len() - 1) as f64 / range;
    // A turn and its end are the same angle.
    (range / TAU, whole(finest - 1e-6))
}

/// Products of cosine and sine of an order, a constant taken off.
fn alone(sums: &Sums, order: usize) -> Matrix2<f64> {
    let [[a, b], [c, d]] = sums.between(order, order);
    let [p, q] = sums.alone(order);
    let n = sums.count.max(1.0);
    Matrix2::new(a - p * p / n, b - p * q / n, c - p * q / n, d - q * q / n)
}

/// Smallest eigenvalue of a symmetric matrix.
fn smallest(m: &Matrix2<f64>) -> f64 {
    let (half, apart) = (0.5 * m.trace(), 0.5 * (m[(0, 0)] - m[(1, 1)]));
    half - apart.hypot(m[(0, 1)])
}

fn fit(sums: &Sums, series: usize, orders: &[usize]) -> Vec<Amplitude> {
    let alone: Vec<Matrix2<f64>> = orders.iter().map(|k| alone(sums, *k)).collect();
    let mut taken: Vec<usize> = Vec::new();
    let mut left = OrderFit::of(sums, series, orders, &taken);
    while let Some(next) = left.largest(&alone, &taken)
        && left.share(next, &alone) > left.needed(orders.len())
    {
        taken.push(next);
        let fitted = OrderFit::of(sums, series, orders, &taken);
        if !(fitted.solved && fitted.freedom > 2.0) {
            taken.pop();
            break;
        }
        left = fitted;
    }
    let amplitude = |k: usize| {
        let at = taken.iter().position(|t| *t == k);
        let waves = match at {
            Some(at) => left.fitted[at],
            None => solved(&alone[k], left.with[k]),
        };
        // The amplitude that has, in this phase, just the gain that is needed.
        let size = waves.norm();
        let phase = if size > 0.0 {
            waves / size
        } else {
            Vector2::x()
        };
        let per_mm = (alone[k] * phase).dot(&phase);
        let gain = left.needed(orders.len()) * left.squares;
        let line = (per_mm > 0.0).then(|| (gain / per_mm).sqrt());
        Amplitude {
            mm: size,
            line_mm: line.filter(|_| left.freedom > 2.0 && gain > 0.0),
        }
    };
    (0..orders.len()).map(amplitude).collect()
}

fn solved(m: &Matrix2<f64>, r: Vector2<f64>) -> Vector2<f64> {
    m.try_inverse()
        .map_or_else(Vector2::zeros, |inverse| inverse * r)
}

/// What is left when some orders are in the model.
struct OrderFit {
    /// Cosine and sine of each order in the model.
    fitted: Vec<Vector2<f64>>,
    /// Products of the residual with every order.
    with: Vec<Vector2<f64>>,
    /// Sum of squares of the residual.
    squares: f64,
    /// Degrees of freedom beside the model and one order more.
    freedom: f64,
    /// Whether the orders in the model could be told apart.
    solved: bool,
}

impl OrderFit {
    fn of(sums: &Sums, series: usize, orders: &[usize], taken: &[usize]) -> Self {
        let p = 1 + 2 * taken.len();
        let mut gram = DMatrix::zeros(p, p);
        let mut products = DVector::zeros(p);
        gram[(0, 0)] = sums.count;
        for (i, a) in taken.iter().enumerate() {
            let (at, order) = (1 + 2 * i, orders[*a]);
            let (own, y) = (sums.alone(order), sums.with(series, order));
            for part in 0..2 {
                gram[(0, at + part)] = own[part];
                gram[(at + part, 0)] = own[part];
                products[at + part] = y[part];
            }
            for (j, b) in taken.iter().enumerate() {
                let between = sums.between(order, orders[*b]);
                for row in 0..2 {
                    for column in 0..2 {
                        gram[(at + row, 1 + 2 * j + column)] = between[row][column];
                    }
                }
            }
        }
        let cholesky = Cholesky::new(gram);
        let solved = cholesky.is_some();
        let x = cholesky.map_or_else(|| DVector::zeros(p), |c| c.solve(&products));
        let of = |i: usize| Vector2::new(x[1 + 2 * i], x[2 + 2 * i]);
        let with = orders.iter().map(|k| {
            let mut left = Vector2::from(sums.with(series, *k));
            left -= Vector2::from(sums.alone(*k)) * x[0];
            for (i, a) in taken.iter().enumerate() {
                let [row_1, row_2] = sums.between(*k, orders[*a]);
                let w = of(i);
                left -= Vector2::new(
                    row_1[0] * w[0] + row_1[1] * w[1],
                    row_2[0] * w[0] + row_2[1] * w[1],
                );
            }
            left
        });
        Self {
            with: with.collect(),
            fitted: (0..taken.len()).map(of).collect(),
            squares: (sums.squares(series) - products.dot(&x)).max(0.0),
            freedom: sums.count - p as f64 - 2.0,
            solved,
        }
    }

    /// The part of the residual's squares that an order takes away.
    fn share(&self, k: usize, alone: &[Matrix2<f64>]) -> f64 {
        if self.squares <= 0.0 {
            return 0.0;
        }
        solved(&alone[k], self.with[k]).dot(&self.with[k]) / self.squares
    }

    fn largest(&self, alone: &[Matrix2<f64>], taken: &[usize]) -> Option<usize> {
        let open = (0..alone.len()).filter(|k| !taken.contains(k));
        open.max_by(|a, b| self.share(*a, alone).total_cmp(&self.share(*b, alone)))
    }

    /// The part that it has to take away to be more than noise.
    fn needed(&self, orders: usize) -> f64 {
        if self.freedom <= 2.0 || orders == 0 {
            return 1.0;
        }
        let one = 1.0 - QUIET.powf(1.0 / orders as f64);
        1.0 - one.powf(2.0 / self.freedom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    /// Angles that are not evenly spaced, rad.
    fn angles(random: &mut ChaCha8Rng, n: usize, from: f64, to: f64) -> Vec<f64> {
        let angle = |_| random.random_range(from..to);
        (0..n).map(angle).collect()
    }

    fn noise(random: &mut ChaCha8Rng) -> f64 {
        StandardNormal.sample(random)
    }

    #[test]
    fn a_hidden_three_cycle_error_is_the_bar_at_three_with_its_amplitude() {
        let mut random = ChaCha8Rng::seed_from_u64(4);
        for (from, to) in [(-3.1, 3.1), (-2.6, 2.6), (-1.6, 1.6)] {
            let angles = angles(&mut random, 150, from, to);
            let y: Vec<f64> = angles
                .iter()
                .map(|q| 5.0 + 0.3 * (3.0 * q + 0.7).sin() + 0.03 * noise(&mut random))
                .collect();
            let spectrum = Spectrum::new(&angles, &y, Some(&y), &[]);
            let out: Vec<_> = spectrum
                .orders
                .iter()
                .filter(|o| o.before.stands_out())
                .collect();
            assert_eq!(out.len(), 1, "{from}: {out:?}");
            assert_eq!(out[0].order, 3);
            assert!((out[0].before.mm - 0.3).abs() < 0.02, "{out:?}");
            assert_eq!(out[0].after, Some(out[0].before));
        }
    }

    #[test]
    fn a_large_order_does_not_hide_a_small_one_beside_it() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let angles = angles(&mut random, 200, -2.6, 2.6);
        let y: Vec<f64> = angles
            .iter()
            .map(|q| 4.0 * q.cos() + 0.1 * (37.0 * q).sin() + 0.02 * noise(&mut random))
            .collect();
        let spectrum = Spectrum::new(&angles, &y, None, &[37]);
        let of = |order: usize| {
            let found = spectrum.orders.iter().find(|o| o.order == order);
            found.expect("it is shown").before
        };
        assert!((of(1).mm - 4.0).abs() < 0.02, "{:?}", of(1));
        assert!((of(37).mm - 0.1).abs() < 0.01, "{:?}", of(37));
        assert!(of(1).stands_out() && of(37).stands_out());
        assert!(!of(2).stands_out() && of(2).mm < 0.02, "{:?}", of(2));
        assert!(spectrum.orders.iter().any(|o| o.order == 35));
    }

    #[test]
    fn noise_alone_stays_below_the_line_in_ninety_five_of_a_hundred_sessions() {
        let quiet = |seed: u64| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let wide = if seed.is_multiple_of(2) { 3.1 } else { 1.6 };
            let angles = angles(&mut random, 90, -wide, wide);
            let y: Vec<f64> = angles.iter().map(|_| noise(&mut random)).collect();
            let spectrum = Spectrum::new(&angles, &y, None, &[]);
            assert!(!spectrum.orders.is_empty());
            !spectrum.orders.iter().any(|o| o.before.stands_out())
        };
        let sessions = 600;
        let quiet = (0..sessions).filter(|seed| quiet(*seed)).count();
        let share = quiet as f64 / sessions as f64;
        assert!(share >= 0.95, "{share}");
        // The line is not simply far above everything.
        assert!(share < 1.0, "{share}");
    }

    #[test]
    fn what_the_samples_cannot_show_is_left_out_and_said() {
        let few = |angles: &[f64]| Spectrum::new(angles, &vec![1.0; angles.len()], None, &[37]);
        assert!(few(&[]).orders.is_empty());
        assert!(few(&[1.0]).orders.is_empty());
        assert!(few(&[0.5; 40]).orders.is_empty(), "one angle, many times");
        // A quarter of a turn: one cycle per turn is hardly more than a slope there.
        let angles: Vec<f64> = (0..100).map(|i| f64::from(i) * 0.0157).collect();
        let quarter = few(&angles);
        assert_eq!(quarter.unseen, 1);
        assert!(quarter.orders.iter().all(|o| o.order > 1));
        // Equal values have no order at all, and no line can be drawn from nothing.
        assert!(quarter.orders.iter().all(|o| o.before.mm == 0.0));
    }

    #[test]
    fn as_many_orders_are_shown_as_the_number_of_angles_allows() {
        let turn = |n: u32| {
            let angles: Vec<f64> = (0..n).map(|i| TAU * f64::from(i) / f64::from(n)).collect();
            let repeated = [angles.clone(), angles.clone(), angles].concat();
            let y: Vec<f64> = repeated.iter().map(|a| a.cos()).collect();
            let last = Spectrum::new(&repeated, &y, None, &[]).orders;
            last.last().expect("some are shown").order
        };
        // n equal steps: order k and order n − k are the same samples.
        assert_eq!(turn(12), 5);
        assert_eq!(turn(120), HIGHEST);
    }
}
