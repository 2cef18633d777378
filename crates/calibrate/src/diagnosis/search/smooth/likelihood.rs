//! How smooth a curve is, and how far it goes: chosen by its marginal likelihood.
//!
//! ```text
//! y = J β + B c + e,   e ~ N(0, σ²),   c ~ N(0, σ² Λ⁻¹),   Λ_p = (κ_p² 1 + DᵀD)^α_p / t_p²,   Jᵀ B c = 0
//! ```
//!
//! y: whitened residuals of the named model, J its columns, B those of the curve's parts at its knots, D first
//! differences. The prior of each part is a Gaussian process of the Matérn family on a grid (Lindgren, Rue &
//! Lindström 2011): α = 1 may jump, α = 2 and 3 are smooth (of order ½, 3/2 and 5/2); κ is one over its length,
//! t its size in units of the noise. Beside it stands the infinitely smooth one, with the covariance of a Gaussian. The condition makes the curve orthogonal to the names, so that it takes nothing
//! from them. With c integrated out and σ profiled,
//!
//! ```text
//! ln E = ½ ln|Λ|' − ½ ln|BᵀB + Λ|' − (ν/2) ln(yᵀy − gᵀc),   ν = rows − rank J
//! ```
//!
//! where |·|' is the determinant within the condition: `|A|' = |A| |Nᵀ A⁻¹ N|`, N an orthonormal
//! basis of the conditions. (Restricted likelihood: Wahba 1985, Wood 2011.)

use std::f64::consts::PI;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::fit::spectrum::Spectrum;
use crate::linear::Basis;

/// Sides of a direction: what is common to both, and half of the reversal.
pub(super) const SIDES: usize = 2;
/// A name whose column has less than this in common with the curve's is orthogonal to it anyway.
const ORTHOGONAL: f64 = 1e-9;

/// Products of the whitened columns over some rows.
#[derive(Debug, Clone)]
pub(super) struct Sums {
    /// `BᵀB`, side by side.
    bb: DMatrix<f64>,
    /// `BᵀJ`.
    bj: DMatrix<f64>,
    jj: DMatrix<f64>,
    by: DVector<f64>,
    jy: DVector<f64>,
    yy: f64,
    rows: f64,
}

impl Sums {
    /// Of the curve's columns, the names' and the residual; `floor` is what rounding leaves in one row, squared.
    /// `None` without rows.
    pub(super) fn of(
        b: &DMatrix<f64>,
        j: &DMatrix<f64>,
        y: &DVector<f64>,
        floor: f64,
    ) -> Option<Self> {
        let rows = y.len() as f64;
        (rows > 0.0).then(|| Self {
            bb: b.tr_mul(b),
            bj: b.tr_mul(j),
            jj: j.tr_mul(j),
            by: b.tr_mul(y),
            jy: j.tr_mul(y),
            yy: y.norm_squared() + floor * rows,
            rows,
        })
    }
}

impl Sums {
    /// The same of what is left once parts of the curve have these values; their columns are gone then.
    fn without(&self, values: &DVector<f64>) -> Self {
        let taken = &self.bb * values;
        Self {
            by: &self.by - &taken,
            jy: &self.jy - self.bj.tr_mul(values),
            yy: (self.yy - 2.0 * values.dot(&self.by) + values.dot(&taken)).max(f64::MIN_POSITIVE),
            ..self.clone()
        }
    }
}

/// The shape of the prior: everything but the sizes.
#[derive(Debug, Clone)]
pub(super) struct Kernel {
    /// In shares of the range.
    length: f64,
    /// Inverse covariance of the values in one direction at size 1.
    precision: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    ln_determinant: f64,
}

impl Kernel {
    /// Over so many knots; `length` in shares of the range (of the period).
    fn new(knots: usize, periodic: bool, length: f64, smoothness: Smoothness) -> Option<Self> {
        let precision = match smoothness {
            Smoothness::Matern(order) => Self::matern(knots, periodic, length, order),
            Smoothness::Gaussian => Self::gaussian(knots, periodic, length)?,
        };
        let factor = precision.clone().cholesky()?;
        let ln_determinant = ln_determinant(&factor);
        Some(Self {
            length,
            precision,
            factor,
            ln_determinant,
        })
    }

    /// Infinitely smooth: `exp(−d²/2ℓ²)`, of a period `exp(−sin²(π d)/(2 π² ℓ²))`, with as little besides as keeps its
    /// inverse a number.
    fn gaussian(knots: usize, periodic: bool, length: f64) -> Option<DMatrix<f64>> {
        let steps = if periodic { knots } else { knots - 1 } as f64;
        let apart = |i: usize, j: usize| {
            let d = i.abs_diff(j) as f64 / steps;
            let d = if periodic { (PI * d).sin() / PI } else { d };
            d / length
        };
        let rough = |i: usize, j: usize| if i == j { BESIDE_SMOOTH } else { 0.0 };
        let covariance = DMatrix::from_fn(knots, knots, |i, j| {
            (-0.5 * apart(i, j).powi(2)).exp() + rough(i, j)
        });
        Some(covariance.cholesky()?.inverse())
    }

    /// `(κ² 1 + DᵀD)^α`, at size 1: the variance at the knots is 1 on average.
    fn matern(knots: usize, periodic: bool, length: f64, order: i32) -> DMatrix<f64> {
        let steps = if periodic { knots } else { knots - 1 };
        let kappa = 1.0 / (length * steps as f64);
        let mut q = DMatrix::identity(knots, knots) * (kappa * kappa);
        for k in 0..steps {
            let next = (k + 1) % knots;
            q[(k, k)] += 1.0;
            q[(next, next)] += 1.0;
            q[(k, next)] -= 1.0;
            q[(next, k)] -= 1.0;
        }
        let precision = match order {
            1 => q,
            2 => &q * &q,
            _ => &q * &q * &q,
        };
        let covariance = precision.clone().cholesky().map(|factor| factor.inverse());
        let variance = covariance.map_or(1.0, |c| c.trace() / knots as f64);
        precision * variance
    }

    /// About how many straight pieces say as much: three over each length.
    pub(super) fn pieces(&self) -> f64 {
        3.0 / self.length
    }

    fn knots(&self) -> usize {
        self.precision.nrows()
    }
}

fn ln_determinant(factor: &Cholesky<f64, Dyn>) -> f64 {
    let l = factor.l_dirty();
    (0..l.nrows()).map(|k| 2.0 * l[(k, k)].ln()).sum()
}

/// The prior of each part: its kernel, by its number among those that are tried, and its size in units of the
/// noise; `None`: the part is nothing.
pub(super) type Prior = Vec<Option<(usize, f64)>>;

/// Kernels of a range (of a period): of every length and smoothness, lengths in ascending order for each.
#[derive(Debug, Clone)]
pub(super) struct Kernels(Vec<Kernel>);

impl Kernels {
    pub(super) fn new(knots: usize, periodic: bool) -> Option<Self> {
        let all = SMOOTHNESS
            .into_iter()
            .flat_map(|smoothness| LENGTHS.map(|length| (smoothness, length)));
        let kernels =
            all.map(|(smoothness, length)| Kernel::new(knots, periodic, length, smoothness));
        kernels.collect::<Option<Vec<Kernel>>>().map(Self)
    }

    pub(super) fn get(&self, kernel: usize) -> &Kernel {
        &self.0[kernel]
    }
}

/// The names' own step on the same rows, and what it leaves.
#[derive(Debug, Clone)]
pub(super) struct NamesAlone {
    pub(super) step: DVector<f64>,
    /// Sum of squares that is left.
    left: f64,
    freedom: f64,
    /// Evidence of no curve at all.
    pub(super) ln_evidence: f64,
}

impl NamesAlone {
    pub(super) fn new(sums: &Sums) -> Self {
        let spectrum = Spectrum::new(&sums.jj);
        let step = spectrum.step(&sums.jy, 0.0);
        let left = (sums.yy - step.dot(&sums.jy)).max(f64::MIN_POSITIVE);
        let freedom = (sums.rows - spectrum.rank() as f64).max(1.0);
        Self {
            ln_evidence: -0.5 * freedom * left.ln(),
            step,
            left,
            freedom,
        }
    }
}

/// A curve fitted under given sizes.
#[derive(Debug, Clone)]
pub(super) struct Fitted {
    /// Values at the knots, part by part; zero where there is no curve.
    pub(super) values: DVector<f64>,
    /// Their standard deviations.
    pub(super) sigma: DVector<f64>,
    pub(super) ln_evidence: f64,
}

/// A curve of some parts: everything but the sizes.
struct OfParts<'k> {
    kernels: Vec<&'k Kernel>,
    /// Where their values stand among those of all parts, and how many those are.
    own: Vec<usize>,
    of_all: usize,
    bb: DMatrix<f64>,
    g: DVector<f64>,
    conditions: DMatrix<f64>,
    /// `Nᵀ Λ⁻¹ N` at size 1, of each part's own.
    prior: Vec<DMatrix<f64>>,
}

/// Fits the curve; `None` where the conditions leave nothing of it. The standard deviations cost
/// more than the rest and are zero unless `sure` asks for them.
pub(super) fn fit(
    sums: &Sums,
    names: &NamesAlone,
    kernels: &Kernels,
    prior: &Prior,
    sure: bool,
) -> Option<Fitted> {
    OfParts::new(sums, kernels, prior)?.fit(names, &sizes_of(prior), sure)
}

fn sizes_of(prior: &Prior) -> Vec<f64> {
    prior.iter().flatten().map(|(_, size)| *size).collect()
}

impl<'k> OfParts<'k> {
    /// Of the parts that have a size; `None` where the conditions leave nothing of it.
    fn new(sums: &Sums, kernels: &'k Kernels, prior: &Prior) -> Option<Self> {
        let parts: Vec<usize> = (0..prior.len()).filter(|p| prior[*p].is_some()).collect();
        let kernels: Vec<&Kernel> = prior
            .iter()
            .flatten()
            .map(|(kernel, _)| kernels.get(*kernel))
            .collect();
        let knots = kernels.first()?.knots();
        let values = parts.iter().flat_map(|d| d * knots..(d + 1) * knots);
        let own: Vec<usize> = values.collect();
        let conditions = conditions(sums, &own);
        if conditions.ncols() >= own.len() {
            return None;
        }
        let of_part = |block: usize| {
            let part = conditions.rows(block * knots, knots).into_owned();
            part.tr_mul(&kernels[block].factor.solve(&part))
        };
        Some(Self {
            bb: sums.bb.select_rows(&own).select_columns(&own),
            g: sums.by.select_rows(&own),
            prior: (0..parts.len()).map(of_part).collect(),
            kernels,
            conditions,
            own,
            of_all: sums.by.len(),
        })
    }

    fn fit(&self, names: &NamesAlone, sizes: &[f64], sure: bool) -> Option<Fitted> {
        let n = &self.conditions;
        let knots = self.kernels.first()?.knots();
        let mut m = self.bb.clone();
        let mut prior = DMatrix::zeros(n.ncols(), n.ncols());
        let mut ln_prior = 0.0;
        for (block, (kernel, size)) in self.kernels.iter().zip(sizes).enumerate() {
            let at = block * knots;
            let mut view = m.view_mut((at, at), (knots, knots));
            view += &kernel.precision / (size * size);
            prior += &self.prior[block] * (size * size);
            ln_prior += kernel.ln_determinant - 2.0 * knots as f64 * size.ln();
        }
        let factor = m.cholesky()?;
        let solved = factor.solve(n);
        let inside = n.tr_mul(&solved).cholesky()?;
        let free = factor.solve(&self.g);
        let values = &free - &solved * inside.solve(&n.tr_mul(&free));
        let ln_prior = ln_prior + ln_determinant(&prior.cholesky()?);
        let ln_posterior = ln_determinant(&factor) + ln_determinant(&inside);
        let left = names.left - self.g.dot(&values);
        if left.is_nan() || left <= 0.0 {
            return None;
        }
        let ln_evidence = 0.5 * (ln_prior - ln_posterior) - 0.5 * names.freedom * left.ln();
        let mut all = DVector::zeros(self.of_all);
        let mut sigma = DVector::zeros(self.of_all);
        for (k, at) in self.own.iter().enumerate() {
            all[*at] = values[k];
        }
        if sure {
            let covariance = factor.inverse() - &solved * inside.inverse() * solved.transpose();
            let variance = left / names.freedom;
            for (k, at) in self.own.iter().enumerate() {
                sigma[*at] = (covariance[(k, k)].max(0.0) * variance).sqrt();
            }
        }
        ln_evidence.is_finite().then_some(Fitted {
            values: all,
            sigma,
            ln_evidence,
        })
    }
}

/// Orthonormal directions in the space of the values that would move a name.
fn conditions(sums: &Sums, own: &[usize]) -> DMatrix<f64> {
    let mut all = sums.bj.select_rows(own);
    let size = |g: f64| g.max(0.0).sqrt();
    let largest = own
        .iter()
        .map(|k| size(sums.bb[(*k, *k)]))
        .fold(0.0, f64::max);
    let mut kept = Vec::new();
    for column in 0..all.ncols() {
        let name = size(sums.jj[(column, column)]);
        let mut own = all.column_mut(column);
        let norm = own.norm();
        if name > 0.0 && norm > ORTHOGONAL * name * largest {
            own /= norm;
            kept.push(column);
        }
    }
    Basis::new(&all.select_columns(&kept)).q
}

/// Lengths of the prior that are tried, in shares of the range (of the period).
const LENGTHS: [f64; 6] = [1.0, 0.5, 0.25, 0.12, 0.06, 0.03];

/// How smooth a curve is.
#[derive(Debug, Clone, Copy)]
enum Smoothness {
    /// α: 1 as jumps, 2 as a bend, 3 as a wave.
    Matern(i32),
    /// As a bow.
    Gaussian,
}

const SMOOTHNESS: [Smoothness; 4] = [
    Smoothness::Matern(1),
    Smoothness::Matern(2),
    Smoothness::Matern(3),
    Smoothness::Gaussian,
];
/// Variance of a rough part beside an infinitely smooth curve, whose covariance has no inverse: some 10⁻³ of its size,
/// below the noise of a curve that is a thousand times the noise.
const BESIDE_SMOOTH: f64 = 1e-7;
/// Sizes that are tried first, in units of the noise: each four times the last.
fn sizes() -> impl Iterator<Item = f64> {
    (0..8).map(|k| 0.2 * 4.0_f64.powi(k))
}

/// A part has to make the residuals so much likelier, as a logarithm: twenty times.
const WORTH: f64 = 3.0;

/// The likeliest prior: parts one after the other, while each is worth it; `None` where no part is.
pub(super) fn likeliest(sums: &Sums, names: &NamesAlone, kernels: &Kernels) -> Option<Prior> {
    let parts = sums.by.len() / kernels.get(0).knots();
    let mut best: (Prior, f64) = (vec![None; parts], names.ln_evidence);
    let mut left = sums.clone();
    let mut without = names.clone();
    while let Some((part, own)) = one_more(&left, &without, kernels, &best.0) {
        let mut with = best.0.clone();
        with[part] = Some(own);
        let with = refined(sums, names, kernels, with);
        let Some(fitted) = fit(sums, names, kernels, &with, false) else {
            break;
        };
        if fitted.ln_evidence <= best.1 + WORTH {
            break;
        }
        best = (with, fitted.ln_evidence);
        left = sums.without(&fitted.values);
        without = NamesAlone::new(&left);
    }
    best.0.iter().any(Option::is_some).then_some(best.0)
}

/// A part, with its kernel and its size.
type OneMore = (usize, (usize, f64));

/// The part that alone says most of what the others leave, with its kernel and size.
fn one_more(left: &Sums, names: &NamesAlone, kernels: &Kernels, before: &Prior) -> Option<OneMore> {
    let free = (0..before.len()).filter(|part| before[*part].is_none());
    let all = free.flat_map(|part| (0..kernels.0.len()).map(move |kernel| (part, kernel)));
    let mut best: Option<(OneMore, f64)> = None;
    for (part, kernel) in all {
        let mut prior: Prior = vec![None; before.len()];
        prior[part] = Some((kernel, 1.0));
        let Some(alone) = OfParts::new(left, kernels, &prior) else {
            continue;
        };
        for size in sizes() {
            let Some(fitted) = alone.fit(names, &[size], false) else {
                continue;
            };
            if best.as_ref().is_none_or(|b| fitted.ln_evidence > b.1) {
                best = Some(((part, (kernel, size)), fitted.ln_evidence));
            }
        }
    }
    best.filter(|b| b.1 > names.ln_evidence).map(|b| b.0)
}

/// The likeliest prior near a given one, of the same parts.
pub(super) fn refined(sums: &Sums, names: &NamesAlone, kernels: &Kernels, start: Prior) -> Prior {
    let value = |prior: &Prior| {
        let fitted = fit(sums, names, kernels, prior, false);
        fitted.map_or(f64::NEG_INFINITY, |f| f.ln_evidence)
    };
    let first = value(&start);
    let mut best = (start, first);
    for step in [2.0, 1.4, 1.2] {
        for part in 0..best.0.len() {
            let Some((kernel, size)) = best.0[part] else {
                continue;
            };
            let others = kernels
                .beside(kernel)
                .into_iter()
                .map(|other| (other, size));
            let sizes = [step, 1.0 / step].map(|factor| (kernel, size * factor));
            for own in sizes.into_iter().chain(others) {
                let mut trial = best.0.clone();
                trial[part] = Some(own);
                let here = value(&trial);
                if here > best.1 {
                    best = (trial, here);
                }
            }
        }
    }
    best.0
}

impl Kernels {
    /// The next lengths, and the other smoothnesses of the same length.
    fn beside(&self, kernel: usize) -> Vec<usize> {
        let lengths = LENGTHS.len();
        let (order, length) = (kernel / lengths, kernel % lengths);
        let next = [length.wrapping_sub(1), length + 1].into_iter();
        let next = next.filter(|k| *k < lengths).map(|k| order * lengths + k);
        let orders = (0..SMOOTHNESS.len()).filter(|k| *k != order);
        next.chain(orders.map(|k| k * lengths + length))
            .filter(|k| *k < self.0.len())
            .collect()
    }
}
