//! The kernel of a smooth curve and its size, chosen by marginal likelihood ([`groups`](super::groups)).
//!
//! ```text
//! c = L z,   z ~ N(0, σ² t²),   L Lᵀ = K,   K_ij = k(|u_i − u_j|/ℓ),   Jᵀ B c = 0
//! ```
//!
//! c: the values of a part of the curve at its knots u, t its size in units of the noise, B its columns and J those of
//! the base. k is of the Matérn family: of order ½ it may jump, of order 3/2 and 5/2 it is smooth; in addition there
//! is the squared exponential, infinitely smooth. Of what is periodic the distance of two knots is a chord (Rasmussen
//! & Williams 2006, 4.2). The condition makes the curve orthogonal to the base: L without the combinations that are
//! not, `L (1 − Q Qᵀ)` with Q a basis of `Lᵀ Bᵀ J`.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::groups::{Remaining, Solved};
use crate::linear::{Basis, cross};
use crate::{odds, rounding};

/// Lengths of the prior that are tried, in shares of the range (of the period).
const LENGTHS: [f64; 6] = [1.0, 0.5, 0.25, 0.12, 0.06, 0.03];
/// The smoothness of a curve: its correlation at a distance in lengths.
const SMOOTHNESS: [fn(f64) -> f64; 4] = [
    |r| (-r).exp(),
    |r| (1.0 + r) * (-r).exp(),
    |r| (1.0 + r + r * r / 3.0) * (-r).exp(),
    |r| (-0.5 * r * r).exp(),
];
/// Sizes that are tried first, in units of the noise: each four times the last.
fn sizes() -> impl Iterator<Item = f64> {
    (0..8).map(|k| 0.2 * 4.0_f64.powi(k))
}

/// The prior of each part: its kernel, by its number among those that are tried, and its size in units of the noise;
/// `None`: the part is zero.
pub(super) type Prior = Vec<Option<(usize, f64)>>;

/// Kernels of a range (of a period): L of every length and smoothness, lengths in descending order for each.
#[derive(Debug, Clone)]
pub(super) struct Kernels(Vec<DMatrix<f64>>);

impl Kernels {
    pub(super) fn new(knots: usize, periodic: bool) -> Option<Self> {
        let steps = if periodic { knots } else { knots - 1 } as f64;
        let apart = |i: usize, j: usize| {
            let d = i.abs_diff(j) as f64 / steps;
            if periodic { (PI * d).sin() / PI } else { d }
        };
        let root = |correlation: fn(f64) -> f64, length: f64| {
            let rough = |i: usize, j: usize| if i == j { rounding::COMPUTED } else { 0.0 };
            let all = |i, j| correlation(apart(i, j) / length) + rough(i, j);
            Some(DMatrix::from_fn(knots, knots, all).cholesky()?.unpack())
        };
        let all = SMOOTHNESS.into_iter();
        let all = all.flat_map(|own| LENGTHS.map(|length| root(own, length)));
        all.collect::<Option<Vec<_>>>().map(Self)
    }

    fn knots(&self) -> usize {
        self.0[0].nrows()
    }

    /// About how many straight pieces are equivalent: three over the shortest length.
    pub(super) fn pieces(prior: &Prior) -> f64 {
        let all = prior.iter().flatten();
        all.map(|(kernel, _)| 3.0 / LENGTHS[kernel % LENGTHS.len()])
            .fold(0.0, f64::max)
    }

    /// The next lengths, and the other smoothnesses of the same length.
    fn neighbours(kernel: usize) -> impl Iterator<Item = usize> {
        let lengths = LENGTHS.len();
        let (order, length) = (kernel / lengths, kernel % lengths);
        let next = [length.wrapping_sub(1), length + 1].into_iter();
        let next = next.filter(move |k| *k < lengths);
        let orders = (0..SMOOTHNESS.len()).filter(move |k| *k != order);
        next.map(move |k| order * lengths + k)
            .chain(orders.map(move |k| k * lengths + length))
    }

    /// The columns of the parts that there are.
    fn columns_of(&self, prior: &Prior) -> Vec<usize> {
        let there = (0..prior.len()).filter(|part| prior[*part].is_some());
        let knots = self.knots();
        there
            .flat_map(|part| part * knots..(part + 1) * knots)
            .collect()
    }

    /// `t L (1 − Q Qᵀ)` of the parts that there are, whose columns alone `own` has.
    fn combinations(&self, own: &Remaining, prior: &Prior) -> DMatrix<f64> {
        let knots = self.knots();
        let mut l = DMatrix::zeros(own.columns(), own.columns());
        for (at, (kernel, size)) in prior.iter().flatten().enumerate() {
            let mut of_part = l.view_mut((at * knots, at * knots), (knots, knots));
            of_part.copy_from(&(&self.0[*kernel] * *size));
        }
        let q = Basis::new(&cross(&l, &own.common)).q;
        let taken = &l * &q;
        l.gemm(-1.0, &taken, &q.transpose(), 1.0);
        l
    }

    /// The curve with a prior.
    pub(super) fn fit(&self, remaining: &Remaining, prior: &Prior) -> Option<Fitted> {
        let columns = self.columns_of(prior);
        let own = remaining.only(&columns);
        let combinations = self.combinations(&own, prior);
        let none = vec![0; columns.len()];
        let solved = own.through(&combinations).solved(&none, &[1.0])?;
        Some(Fitted {
            all: remaining.columns(),
            columns,
            combinations,
            solved,
        })
    }

    fn ln_evidence(&self, remaining: &Remaining, prior: &Prior) -> f64 {
        let fitted = self.fit(remaining, prior);
        fitted.map_or(f64::NEG_INFINITY, |fitted| fitted.solved.ln_evidence())
    }

    /// The likeliest prior, and how much likelier the samples are with it, as a logarithm: parts are added one after
    /// the other, while the gain of each exceeds its penalty; `None` where no part does.
    pub(super) fn likeliest(&self, remaining: &Remaining) -> Option<(Prior, f64)> {
        let parts = remaining.columns() / self.knots();
        let mut best: (Prior, f64) = (vec![None; parts], remaining.alone());
        let mut unexplained = remaining.clone();
        while let Some((part, own)) = self.one_more(&unexplained, &best.0) {
            let mut with = best.0.clone();
            with[part] = Some(own);
            let (with, ln_evidence) = self.refined(remaining, with);
            if ln_evidence <= best.1 + odds::OPEN.nats() {
                break;
            }
            unexplained = remaining.without(&self.fit(remaining, &with)?.values());
            best = (with, ln_evidence);
        }
        let likelier = best.1 - remaining.alone();
        best.0
            .iter()
            .any(Option::is_some)
            .then_some((best.0, likelier))
    }

    /// The part that alone gains most on the residual of the others, with its kernel and size.
    fn one_more(&self, unexplained: &Remaining, before: &Prior) -> Option<(usize, (usize, f64))> {
        let free = (0..before.len()).filter(|part| before[*part].is_none());
        let all = free.flat_map(|part| (0..self.0.len()).map(move |kernel| (part, kernel)));
        let mut best = None;
        let mut most = unexplained.alone();
        for (part, kernel) in all {
            let mut prior: Prior = vec![None; before.len()];
            prior[part] = Some((kernel, 1.0));
            let own = unexplained.only(&self.columns_of(&prior));
            let alone = own.through(&self.combinations(&own, &prior));
            let none = vec![0; alone.columns()];
            for size in sizes() {
                let solved = alone.solved(&none, &[size * size]);
                let Some(here) = solved.map(|solved| solved.ln_evidence()) else {
                    continue;
                };
                if here > most {
                    (best, most) = (Some((part, (kernel, size))), here);
                }
            }
        }
        best
    }

    /// The likeliest prior near a given one, of the same parts, and its evidence.
    pub(super) fn refined(&self, remaining: &Remaining, start: Prior) -> (Prior, f64) {
        let first = self.ln_evidence(remaining, &start);
        let mut best = (start, first);
        for step in [2.0, 1.4, 1.2] {
            for part in 0..best.0.len() {
                let Some((kernel, size)) = best.0[part] else {
                    continue;
                };
                let sizes = [step, 1.0 / step].map(|factor| (kernel, size * factor));
                let others = Self::neighbours(kernel).map(|other| (other, size));
                for own in sizes.into_iter().chain(others) {
                    let mut trial = best.0.clone();
                    trial[part] = Some(own);
                    let here = self.ln_evidence(remaining, &trial);
                    if here > best.1 {
                        best = (trial, here);
                    }
                }
            }
        }
        best
    }
}

/// A curve under a prior.
pub(super) struct Fitted {
    /// How many columns there are, and which of them are those of the parts.
    all: usize,
    columns: Vec<usize>,
    combinations: DMatrix<f64>,
    solved: Solved,
}

impl Fitted {
    /// Values at the knots, part by part; zero where there is no curve.
    pub(super) fn values(&self) -> DVector<f64> {
        self.of_all((&self.combinations * self.solved.coefficients()).iter())
    }

    /// Their standard deviations.
    pub(super) fn sigma(&self) -> DVector<f64> {
        let own = &self.combinations * self.solved.deviations().transpose();
        let norms: Vec<f64> = own.row_iter().map(|row| row.norm()).collect();
        self.of_all(norms.iter())
    }

    fn of_all<'v>(&self, own: impl Iterator<Item = &'v f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.all);
        for (column, value) in self.columns.iter().zip(own) {
            all[*column] = *value;
        }
        all
    }
}
