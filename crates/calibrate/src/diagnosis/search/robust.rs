//! Outliers while the base model is still incomplete: with many columns at once whatever is smooth or periodic is
//! fitted, and what deviates from that is an outlier, not an effect.
//!
//! Iteratively reweighted least squares on whole samples: Huber's weights first, then Tukey's biweight, which
//! redescends to zero (Holland & Welsch 1977). A residual is divided by its share of the deviation, one minus the
//! leverage. Rows with the same commands weigh as one: eight shots at a pose that was missed are no eighth of a curve.
//! An outlier of the base model is used again where the other poses predict most of it with the many columns,
//!
//! ```text
//! |e₋ₚ| < ½ |e of the base|,   e₋ₚ = (1 − A W)⁻¹ e,   A = Qₚ (Qᵀ W Q)⁻¹ Qₚᵀ
//! ```
//!
//! with p all rows of the same commands, as a pose that decides a column alone is always followed.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};

use crate::distributions::CHI_MEDIANS;
use crate::effects::place::MOST;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::linear::{Basis, cross, solve_lower};
use crate::observations::figures::outlying;
use crate::observations::outliers::suspected;
use crate::sessions::poses::ByPose;
use crate::{fewest, rounding};

use crate::diagnosis::evidence::Regression;

/// The columns are too many where they are more than this share of the rows. (Derived: the mean leverage is then above
/// ½, a fit follows most of any outlier, and good poses deviate from that.)
const MOST_OF_ROWS: f64 = 0.5;

/// Rounds of each kind of weights.
const ROUNDS: [usize; 2] = [3, 6];
/// Huber's and Tukey's constants for three axes: the 95 % and 99.9 % points of χ.
/// (Holland & Welsch 1977 for the weights.)
const TUNING: [f64; 2] = [2.8, 5.5];

/// The samples of the regression, and whether they are suspected.
pub(crate) fn suspected_given_many(
    problem: &Problem,
    regression: &Regression,
    most: usize,
) -> Vec<(usize, bool)> {
    let mut all = problem.clone();
    all.set_counted(all.to_fit().to_vec());
    all.thin(most);
    let rows = Rows::of(&all);
    let n = rows.samples.len();
    if n < fewest::TO_SEARCH {
        return Vec::new();
    }
    // The columns are needed for the suspected samples as well.
    let same = rows.samples == regression.rows.samples;
    let rich = if same {
        regression.table.columns.raw_of(&regression.table.rich)
    } else {
        regression.table.rich_on(&rows, &regression.base)
    };
    let (residual, columns) = rows.extract_with_known(&regression.base, &problem.priors);
    let own = columns.ncols();
    let mut design = columns.resize_horizontally(own + rich.ncols(), 0.0);
    let (m, width) = rich.shape();
    design.view_mut((0, own), (m, width)).copy_from(&rich);
    let q = Basis::new(&design).q;
    let axes = rows.axes.len();
    let places = ByPose::of_places(&rows.inputs.q, n);
    let share = places.shares();
    if q.ncols() as f64 > MOST_OF_ROWS * independent_rows(&rows, &places) as f64 {
        return Vec::new();
    }
    let mut weights = vec![1.0; n];
    let mut residuals = residual.clone();
    for (stage, rounds) in ROUNDS.into_iter().enumerate() {
        for _ in 0..rounds {
            let Some(fitted) = weighted(&q, &residual, [&weights, &share], axes) else {
                return Vec::new();
            };
            let kept = fitted.kept;
            residuals = fitted.residuals;
            let lengths: Vec<f64> = (0..n)
                .map(|i| {
                    let squares = (0..axes).map(|a| {
                        let row = a * n + i;
                        residuals[row] * residuals[row] / kept[row]
                    });
                    squares.sum::<f64>().sqrt() * as_of_three(&rows, i)
                })
                .collect();
            let mut sorted = lengths.clone();
            let (_, median, _) = sorted.select_nth_unstable_by(n / 2, f64::total_cmp);
            // The median length of three axes is 1.54 standard deviations.
            let scale = (*median / CHI_MEDIANS[2]).max(rounding::WRITTEN);
            for (w, length) in weights.iter_mut().zip(&lengths) {
                let z = length / (scale * TUNING[stage]);
                *w = match stage {
                    0 => (1.0 / z.max(f64::MIN_POSITIVE)).min(1.0),
                    _ if z < 1.0 => (1.0 - z * z).powi(2),
                    _ => 0.0,
                };
            }
        }
    }
    let Some(fitted) = weighted(&q, &residual, [&weights, &share], axes) else {
        return Vec::new();
    };
    let kept = &fitted.kept;
    let condemned = {
        let counted = problem.counted();
        let is_suspect = |i: &usize| !counted[rows.samples[*i]];
        let weights: Vec<f64> = weights.iter().zip(&share).map(|(w, s)| w * s).collect();
        not_acquitted(&places, &residual, &fitted, &weights, is_suspect)
    };
    let deviations: Vec<Vec<f64>> = (0..axes)
        .map(|a| {
            (0..n)
                .map(|i| residuals[a * n + i] / kept[a * n + i].sqrt())
                .collect()
        })
        .collect();
    if let Some(observed) = rows.observed() {
        let unit = observed.layer().unit_mm;
        let of = |i: usize| [0, 1, 2].map(|a| deviations.get(a).map_or(0.0, |d| d[i] / unit));
        let white: Vec<[f64; 3]> = (0..n).map(of).collect();
        let marked = outlying(observed.layer(), &white);
        return with(&rows, marked, &condemned);
    }
    let columns: Vec<&[f64]> = deviations.iter().map(|d| &d[..]).collect();
    let sigma: Vec<f64> = rows
        .axes
        .iter()
        .map(|a| 1.0 / problem.axis_weights[*a].sqrt())
        .collect();
    let marked = suspected(&columns, &vec![true; n], &sigma, true);
    with(&rows, marked, &condemned)
}

/// The number of independent rows: those of a pose show no more than where one body is.
fn independent_rows(rows: &Rows, places: &ByPose) -> usize {
    let own = |i: usize| {
        let observed = rows.observed();
        observed.map_or(rows.axes.len(), |o| o.layer().items[i].rows)
    };
    let of_pose = |pose: Vec<usize>| pose.into_iter().map(own).sum::<usize>().min(MOST);
    places.samples().into_iter().map(of_pose).sum()
}

/// The samples, with the marked ones and those that stay marked.
fn with(rows: &Rows, marked: Vec<bool>, condemned: &BTreeSet<usize>) -> Vec<(usize, bool)> {
    let marked = marked.into_iter().enumerate();
    let marked = marked.map(|(i, marked)| (rows.samples[i], marked || condemned.contains(&i)));
    marked.collect()
}

/// The suspects of which the other poses, with the many columns, do not predict most.
fn not_acquitted(
    places: &ByPose,
    of_base: &DVector<f64>,
    fitted: &Weighted,
    weights: &[f64],
    is_suspect: impl Fn(&usize) -> bool,
) -> BTreeSet<usize> {
    let n = weights.len();
    let axes = of_base.len() / n;
    let mut condemned = BTreeSet::new();
    let all = places.samples().into_iter();
    for own in all.filter(|own| own.iter().any(&is_suspect)) {
        let at = |i: usize| (0..axes).map(move |axis| axis * n + i);
        let own_rows: Vec<usize> = own.iter().copied().flat_map(at).collect();
        let spread = fitted.spread.select_columns(&own_rows);
        let mut kept = -spread.tr_mul(&spread);
        for (mut column, row) in kept.column_iter_mut().zip(&own_rows) {
            column *= weights[row % n];
        }
        for k in 0..own_rows.len() {
            kept[(k, k)] += 1.0;
        }
        let e = fitted.residuals.select_rows(&own_rows);
        let others = kept.lu().solve(&e);
        let half = 0.5 * of_base.select_rows(&own_rows).norm();
        if !others.is_some_and(|residuals| residuals.norm() < half) {
            condemned.extend(own.iter().copied().filter(&is_suspect));
        }
    }
    condemned
}

/// By how much the length of an observation with fewer rows than three is as rare as that of three.
fn as_of_three(rows: &Rows, observation: usize) -> f64 {
    let Some(observed) = rows.observed() else {
        return 1.0;
    };
    let own = observed.layer().items[observation].rows;
    CHI_MEDIANS[2] / CHI_MEDIANS[own.clamp(1, 3) - 1]
}

/// A weighted fit.
struct Weighted {
    /// The residuals.
    residuals: DVector<f64>,
    /// Of each row the share of the noise variance in its residual.
    kept: Vec<f64>,
    /// `L⁻¹ Qᵀ`, where `L Lᵀ = Qᵀ W Q`.
    spread: DMatrix<f64>,
}

/// All rows of a pose together weigh what one alone would.
fn weighted(
    q: &DMatrix<f64>,
    residual: &DVector<f64>,
    [weights, share]: [&[f64]; 2],
    axes: usize,
) -> Option<Weighted> {
    let n = weights.len();
    let mut scaled = q.clone();
    for mut column in scaled.column_iter_mut() {
        for a in 0..axes {
            for (i, (w, share)) in weights.iter().zip(share).enumerate() {
                column[a * n + i] *= w * share;
            }
        }
    }
    let mut gram = cross(&scaled, q);
    for k in 0..gram.nrows() {
        gram[(k, k)] += 1e-9;
    }
    let factor = gram.cholesky()?;
    let step = factor.solve(&scaled.tr_mul(residual));
    let residuals = residual - q * step;
    let spread = solve_lower(factor.l_dirty(), q.transpose());
    let kept = (0..axes * n)
        .map(|row| {
            let leverage = spread.column(row).norm_squared();
            let w = weights[row % n];
            // In the fit a row pulls it towards itself; at an unfitted row the fit's own error adds.
            (1.0 - 2.0 * w * leverage + leverage * w)
                .clamp(0.1, 1.0)
                .max(if w < 1e-3 {
                    1.0 + leverage.min(3.0)
                } else {
                    0.0
                })
        })
        .collect();
    Some(Weighted {
        residuals,
        kept,
        spread,
    })
}
