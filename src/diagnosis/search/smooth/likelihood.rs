//! How smooth a curve is, and how far it goes: chosen by its marginal likelihood.
//!
//! ```text
//! y = J β + B c + e,   e ~ N(0, σ²),   c ~ N(0, σ² Λ⁻¹),   Λ_d = (κ² 1 + DᵀD)^α / t_d²,   Jᵀ B c = 0
//! ```
//!
//! y: whitened residuals of the named model, J its columns, B the curve's at its knots, D first
//! differences. The prior is a Gaussian process of the Matérn family on a grid (Lindgren, Rue &
//! Lindström 2011): α = 1 may jump, α = 2 is smooth; κ is one over its length, t its size in units
//! of the noise. The condition makes the curve orthogonal to the names, so that it takes nothing
//! from them. With c integrated out and σ profiled,
//!
//! ```text
//! ln E = ½ ln|Λ|' − ½ ln|BᵀB + Λ|' − (ν/2) ln(yᵀy − gᵀc),   ν = rows − rank J
//! ```
//!
//! where |·|' is the determinant within the condition: `|A|' = |A| |Nᵀ A⁻¹ N|`, N an orthonormal
//! basis of the conditions. (Restricted likelihood: Wahba 1985, Wood 2011.)

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::effects::curve::DIRECTIONS;
use crate::fit::spectrum::Spectrum;
use crate::linear::Basis;

/// A name whose column has less than this in common with the curve's is orthogonal to it anyway.
const ORTHOGONAL: f64 = 1e-9;

/// Products of the whitened columns over some rows; sums of such products add up.
#[derive(Debug, Clone)]
pub(super) struct Sums {
    /// `BᵀB`, direction by direction.
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
    /// Over some rows of the curve's columns, the names' and the residual.
    pub(super) fn of(b: &DMatrix<f64>, j: &DMatrix<f64>, y: &DVector<f64>, rows: &[usize]) -> Self {
        let (b, j, y) = (
            b.select_rows(rows),
            j.select_rows(rows),
            y.select_rows(rows),
        );
        Self {
            bb: b.tr_mul(&b),
            bj: b.tr_mul(&j),
            jj: j.tr_mul(&j),
            by: b.tr_mul(&y),
            jy: j.tr_mul(&y),
            yy: y.norm_squared(),
            rows: rows.len() as f64,
        }
    }

    /// All of these together; `floor` is what rounding leaves in one row, squared.
    pub(super) fn total<'s>(parts: impl Iterator<Item = &'s Self>, floor: f64) -> Option<Self> {
        let sum = parts.fold(None, |sum: Option<Self>, part| {
            Some(match sum {
                None => part.clone(),
                Some(sum) => Self {
                    bb: sum.bb + &part.bb,
                    bj: sum.bj + &part.bj,
                    jj: sum.jj + &part.jj,
                    by: sum.by + &part.by,
                    jy: sum.jy + &part.jy,
                    yy: sum.yy + part.yy,
                    rows: sum.rows + part.rows,
                },
            })
        });
        sum.map(|sum| Self {
            yy: sum.yy + floor * sum.rows,
            ..sum
        })
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
    /// Over so many knots; `length` in shares of the range (of the period), `order` α.
    pub(super) fn new(knots: usize, periodic: bool, length: f64, order: i32) -> Option<Self> {
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
        let precision = if order == 2 { &q * &q } else { q };
        // Size 1: the variance at the knots, on average.
        let variance = precision.clone().cholesky()?.inverse().trace() / knots as f64;
        let precision = precision * variance;
        let factor = precision.clone().cholesky()?;
        let ln_determinant = ln_determinant(&factor);
        Some(Self {
            length,
            precision,
            factor,
            ln_determinant,
        })
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

/// Size of the curve in each direction in units of the noise; `None`: nothing there.
pub(super) type Sizes = [Option<f64>; DIRECTIONS];

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
    /// Values at the knots, direction by direction; zero where there is no curve.
    pub(super) values: DVector<f64>,
    /// Their standard deviations.
    pub(super) sigma: DVector<f64>,
    pub(super) ln_evidence: f64,
}

/// A curve in some directions: everything but the sizes.
struct Directed<'k> {
    kernel: &'k Kernel,
    directions: Vec<usize>,
    /// Where their values stand among those of all directions.
    own: Vec<usize>,
    bb: DMatrix<f64>,
    g: DVector<f64>,
    conditions: DMatrix<f64>,
    /// `Nᵀ Λ⁻¹ N` at size 1, of each direction's own.
    prior: Vec<DMatrix<f64>>,
}

/// Fits the curve; `None` where the conditions leave nothing of it. The standard deviations cost
/// more than the rest and are zero unless `sure` asks for them.
pub(super) fn fit(
    sums: &Sums,
    names: &NamesAlone,
    kernel: &Kernel,
    sizes: &Sizes,
    sure: bool,
) -> Option<Fitted> {
    Directed::new(sums, kernel, sizes)?.fit(names, sizes, sure)
}

impl<'k> Directed<'k> {
    /// In the directions that have a size; `None` where the conditions leave nothing of it.
    fn new(sums: &Sums, kernel: &'k Kernel, sizes: &Sizes) -> Option<Self> {
        let knots = kernel.knots();
        let with_size = |d: &usize| sizes[*d].is_some();
        let directions: Vec<usize> = (0..DIRECTIONS).filter(with_size).collect();
        let values = directions.iter().flat_map(|d| d * knots..(d + 1) * knots);
        let own: Vec<usize> = values.collect();
        if own.is_empty() {
            return None;
        }
        let conditions = conditions(sums, &own);
        if conditions.ncols() >= own.len() {
            return None;
        }
        let prior = |block: usize| {
            let part = conditions.rows(block * knots, knots).into_owned();
            part.tr_mul(&kernel.factor.solve(&part))
        };
        Some(Self {
            kernel,
            bb: sums.bb.select_rows(&own).select_columns(&own),
            g: sums.by.select_rows(&own),
            prior: (0..directions.len()).map(prior).collect(),
            conditions,
            directions,
            own,
        })
    }

    fn fit(&self, names: &NamesAlone, sizes: &Sizes, sure: bool) -> Option<Fitted> {
        let (kernel, knots, n) = (self.kernel, self.kernel.knots(), &self.conditions);
        let mut m = self.bb.clone();
        let mut prior = DMatrix::zeros(n.ncols(), n.ncols());
        let mut ln_prior = 0.0;
        for (block, direction) in self.directions.iter().enumerate() {
            let size = sizes[*direction]?;
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
        if left <= 0.0 {
            return None;
        }
        let ln_evidence = 0.5 * (ln_prior - ln_posterior) - 0.5 * names.freedom * left.ln();
        let mut all = DVector::zeros(DIRECTIONS * knots);
        let mut sigma = DVector::zeros(DIRECTIONS * knots);
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

/// Sizes that are tried first, in units of the noise: each four times the last.
fn sizes() -> impl Iterator<Item = f64> {
    (0..8).map(|k| 0.2 * 4.0_f64.powi(k))
}

/// A direction has to make the residuals so much likelier, as a logarithm: twenty times.
const WORTH: f64 = 3.0;

/// The best size of the curve in the one direction that says most.
pub(super) fn first_direction(
    sums: &Sums,
    names: &NamesAlone,
    kernel: &Kernel,
) -> Option<(Sizes, f64)> {
    one_more(sums, names, kernel, &[None; DIRECTIONS], names.ln_evidence)
}

/// Directions one after the other, while each is worth it, then all sizes finely.
pub(super) fn all_directions(
    sums: &Sums,
    names: &NamesAlone,
    kernel: &Kernel,
    first: (Sizes, f64),
) -> Sizes {
    let mut best = first;
    while let Some(next) = one_more(sums, names, kernel, &best.0, best.1) {
        best = next;
    }
    finely(sums, names, kernel, best.0)
}

fn one_more(
    sums: &Sums,
    names: &NamesAlone,
    kernel: &Kernel,
    before: &Sizes,
    than: f64,
) -> Option<(Sizes, f64)> {
    let mut tried: Vec<(Sizes, f64)> = Vec::new();
    for d in (0..DIRECTIONS).filter(|d| before[*d].is_none()) {
        let with = |size: f64| {
            let mut trial = *before;
            trial[d] = Some(size);
            trial
        };
        let Some(directed) = Directed::new(sums, kernel, &with(1.0)) else {
            continue;
        };
        tried.extend(sizes().map(with).filter_map(|trial| {
            let fitted = directed.fit(names, &trial, false)?;
            Some((trial, fitted.ln_evidence))
        }));
    }
    let best = tried.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (best.1 > than + WORTH).then_some(best)
}

/// The likeliest sizes near given ones, of the same directions.
pub(super) fn finely(sums: &Sums, names: &NamesAlone, kernel: &Kernel, start: Sizes) -> Sizes {
    let Some(directed) = Directed::new(sums, kernel, &start) else {
        return start;
    };
    let value = |t: &Sizes| {
        let fitted = directed.fit(names, t, false);
        fitted.map_or(f64::NEG_INFINITY, |f| f.ln_evidence)
    };
    let mut best = (start, value(&start));
    for step in [2.0, 1.4, 1.2] {
        for d in (0..DIRECTIONS).filter(|d| start[*d].is_some()) {
            for factor in [step, 1.0 / step] {
                for _ in 0..3 {
                    let mut trial = best.0;
                    trial[d] = trial[d].map(|size| size * factor);
                    let here = value(&trial);
                    if here <= best.1 {
                        break;
                    }
                    best = (trial, here);
                }
            }
        }
    }
    best.0
}
