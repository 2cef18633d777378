//! Elimination of columns that affect a stretch of the samples only, one stretch after the other: an information
//! filter over the state of the slow noise.
//!
//! Of a stretch the unknowns are the state `z` of the slow noise before it, the coefficients `f` of its own columns
//! and the state `e` at its end; the coefficients `β` of the shared columns are kept. Filtered from a known state,
//! with white noise of 1, its samples and its end give
//!
//! ```text
//! G z + F f + C β = y,   (e − H z + A f + B β − b)/√P = 0
//! ```
//!
//! The products of `z` and `β` from the stretches before are added to those of these rows; `z` and `f` are eliminated,
//! and the products of `e` and `β` go on to the next one. The determinant gains that of the eliminated block, as `z`
//! and `f` are integrated out. The filter itself makes all of it from two rows more: one before the samples that sets
//! the state, one behind them that reads it (both states with the opposite sign).

use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::fit::noise::decayed;
use crate::fit::noise::filter::{Axis, Filter, Step};
use crate::fit::regression::Rows;
use crate::linear::{Basis, DEPENDENT, gram};

use super::summed::{NoiseShape, Summed};

/// With fewer stretches all columns at once are as fast.
const FEWEST_STRETCHES: usize = 4;
/// Columns that touch the same samples, at least, so that these are a stretch.
const FEWEST_COLUMNS: usize = 3;

/// The columns of a fit by the stretches of samples that they touch.
pub(super) struct Stretches {
    stretches: Vec<Stretch>,
    /// Columns of the stretches, independent.
    own: usize,
    /// Columns that all share, with the residual, which is the last.
    shared: usize,
}

struct Stretch {
    samples: Range<usize>,
    /// Rows of its samples, axis after axis: its own columns, orthonormal, then those that all share.
    columns: DMatrix<f64>,
    own: usize,
}

impl Stretches {
    /// `None` where few columns are those of a stretch.
    pub(super) fn of(rows: &Rows, residual: &DVector<f64>, columns: &DMatrix<f64>) -> Option<Self> {
        let n = rows.samples.len();
        if columns.nrows() != n * rows.axes.len() {
            return None;
        }
        let touched = touched(columns, n);
        let found = disjoint(&touched, n);
        if found.len() < FEWEST_STRETCHES {
            return None;
        }
        let of_stretch = |k: &usize, samples: &Range<usize>| {
            let touched = &touched[*k];
            samples.start <= touched.start && touched.end <= samples.end && !touched.is_empty()
        };
        let is_shared = |k: &usize| !found.iter().any(|samples| of_stretch(k, samples));
        let all = 0..columns.ncols();
        let shared: Vec<usize> = all.clone().filter(is_shared).collect();
        let mut common = columns.select_columns(&shared);
        let at = |a: usize, samples: &Range<usize>| (a * n + samples.start, samples.len());
        // The same span, well conditioned, whatever the noise is.
        let mut bases = Vec::new();
        for samples in &found {
            let own: Vec<usize> = all.clone().filter(|k| of_stretch(k, samples)).collect();
            let q = Basis::new(&picked(&columns.select_columns(&own), n, samples)).q;
            for _ in 0..2 {
                let here = picked(&common, n, samples);
                let remaining = &here - &q * q.tr_mul(&here);
                for a in 0..rows.axes.len() {
                    let (first, len) = at(a, samples);
                    common
                        .rows_mut(first, len)
                        .copy_from(&remaining.rows(a * len, len));
                }
            }
            bases.push(q);
        }
        let before = columns.select_columns(&shared);
        let common = independent(&common, &before);
        let width = common.ncols();
        let mut common = common.insert_column(width, 0.0);
        common.set_column(width, residual);
        let mut stretches = Vec::new();
        let mut from = 0;
        let mut add = |samples: Range<usize>, q: Option<&DMatrix<f64>>| {
            if samples.is_empty() {
                return;
            }
            let shared = picked(&common, n, &samples);
            let own = q.map_or(0, DMatrix::ncols);
            let mut columns = DMatrix::zeros(shared.nrows(), own + width + 1);
            if let Some(q) = q {
                columns.columns_mut(0, own).copy_from(q);
            }
            columns.columns_mut(own, width + 1).copy_from(&shared);
            stretches.push(Stretch {
                samples,
                columns,
                own,
            });
        };
        for (samples, q) in found.iter().zip(&bases) {
            add(from..samples.start, None);
            add(samples.clone(), Some(q));
            from = samples.end;
        }
        add(from..n, None);
        Some(Self {
            own: bases.iter().map(DMatrix::ncols).sum(),
            shared: width + 1,
            stretches,
        })
    }

    pub(super) fn rank(&self) -> usize {
        self.own + self.shared - 1
    }

    /// `None` where columns are dependent by rounding.
    pub(super) fn summed(&self, rows: &Rows, shape: NoiseShape) -> Option<Summed> {
        let slow: Vec<usize> = (0..rows.axes.len())
            .filter(|a| shape.ratio[rows.axes[*a]] > 0.0)
            .collect();
        let mut ln_determinant = 0.0;
        // Products of the state and the shared columns.
        let mut products = DMatrix::zeros(self.shared, self.shared);
        for (k, stretch) in self.stretches.iter().enumerate() {
            let goes_on = k + 1 < self.stretches.len();
            let layout = Layout {
                before: products.ncols() - self.shared,
                own: stretch.own,
                after: if goes_on { slow.len() } else { 0 },
            };
            let (white, ln_of_noise) = stretch.whitened(rows, shape, &slow, layout);
            let (remaining, ln_eliminated) = layout.eliminated(&white, &products)?;
            ln_determinant += ln_of_noise + ln_eliminated;
            products = remaining;
        }
        Some(Summed {
            gram: products,
            ln_determinant,
        })
    }
}

/// The samples from the first to the last that each column touches.
fn touched(columns: &DMatrix<f64>, n: usize) -> Vec<Range<usize>> {
    let of = |column: nalgebra::DVectorView<f64>| {
        let (mut first, mut end) = (n, 0);
        for axis in column.as_slice().chunks(n) {
            let own = axis.iter().position(|v| *v != 0.0);
            first = first.min(own.unwrap_or(n));
            end = end.max(axis.iter().rposition(|v| *v != 0.0).map_or(0, |k| k + 1));
        }
        first.min(end)..end
    };
    columns.column_iter().map(of).collect()
}

/// Stretches that several columns affect and nothing else, none within another, in order.
fn disjoint(touched: &[Range<usize>], n: usize) -> Vec<Range<usize>> {
    let mut count: BTreeMap<(usize, usize, usize), usize> = BTreeMap::new();
    for range in touched.iter().filter(|range| 2 * range.len() <= n) {
        // The shortest come first.
        *count
            .entry((range.len(), range.start, range.end))
            .or_default() += 1;
    }
    let mut found: Vec<Range<usize>> = Vec::new();
    for ((len, start, end), columns) in count {
        let apart = |other: &Range<usize>| other.end <= start || end <= other.start;
        if len > 0 && columns >= FEWEST_COLUMNS && found.iter().all(apart) {
            found.push(start..end);
        }
    }
    found.sort_by_key(|range| range.start);
    found
}

/// The rows of some samples, axis after axis.
fn picked(columns: &DMatrix<f64>, n: usize, samples: &Range<usize>) -> DMatrix<f64> {
    let (axes, len) = (columns.nrows() / n, samples.len());
    let mut own = DMatrix::zeros(axes * len, columns.ncols());
    for a in 0..axes {
        let rows = columns.rows(a * n + samples.start, len);
        own.rows_mut(a * len, len).copy_from(&rows);
    }
    own
}

/// A basis of columns of which a part was projected out; without those that are zero after it.
fn independent(remaining: &DMatrix<f64>, before: &DMatrix<f64>) -> DMatrix<f64> {
    let mut remaining = remaining.clone();
    for (mut column, before) in remaining.column_iter_mut().zip(before.column_iter()) {
        if column.norm() <= DEPENDENT * before.norm() {
            column.fill(0.0);
        }
    }
    Basis::new(&remaining).q
}

/// How many columns of a stretch's rows are of the state before it, its own, and of the state at its end; those that
/// all share follow.
#[derive(Clone, Copy)]
struct Layout {
    before: usize,
    own: usize,
    after: usize,
}

impl Stretch {
    /// Its rows, whitened, between one that sets the state and one that reads it, and the logarithm of the
    /// determinant of the noise in them.
    fn whitened(
        &self,
        rows: &Rows,
        shape: NoiseShape,
        slow: &[usize],
        layout: Layout,
    ) -> (DMatrix<f64>, f64) {
        let Layout { before, own, after } = layout;
        let (len, axes) = (self.samples.len(), rows.axes.len());
        let height = len + 2;
        let shared = self.columns.ncols() - own;
        let mut white = DMatrix::zeros(axes * height, before + own + after + shared);
        for a in 0..axes {
            let here = self.columns.rows(a * len, len);
            for (place, from, count) in [(before, 0, own), (before + own + after, own, shared)] {
                let mut part = white.view_mut((a * height + 1, place), (len, count));
                part.copy_from(&here.columns(from, count));
            }
        }
        for (state, a) in slow.iter().enumerate().take(before) {
            white[(a * height, state)] = 1.0;
        }
        let mut ln = 0.0;
        let mut of_ends = Vec::new();
        let filters = rows.axes.iter().map(|axis| {
            let sigma = shape.sigma[*axis];
            let rms = shape.ratio[*axis].sqrt() * sigma;
            if rms > 0.0 {
                let steps = self.steps(&rows.times, shape.tau, [sigma, rms], before > 0, after > 0);
                of_ends.push(steps[len + 1].inverse_spread);
                let spreads = steps.iter().map(|step| step.inverse_spread);
                ln -= spreads
                    .filter(|s| *s > 0.0)
                    .map(|s| 2.0 * s.ln())
                    .sum::<f64>();
                Axis::Slow(steps)
            } else {
                ln += 2.0 * len as f64 * sigma.ln();
                Axis::White(1.0 / sigma)
            }
        });
        let filter = Filter {
            axes: filters.collect(),
            samples: height,
            joints: None,
        };
        filter.whiten(white.as_mut_slice());
        for (state, (a, of_end)) in slow.iter().zip(of_ends).enumerate().take(after) {
            white[(a * height + len + 1, before + own + state)] = of_end;
        }
        (white, ln)
    }

    /// The steps of the filter along an axis with a white and a slow part: from a known state, where there is one
    /// before, to the end, where that is asked for.
    fn steps(
        &self,
        times: &[f64],
        tau: f64,
        [sigma, rms]: [f64; 2],
        goes_on: bool,
        is_read: bool,
    ) -> Vec<Step> {
        let samples = self.samples.clone();
        let sets = Step {
            decay: 0.0,
            gain: 1.0,
            inverse_spread: 0.0,
        };
        let (mut before, mut variance) = if goes_on {
            (times[samples.start - 1], 0.0)
        } else {
            (f64::NAN, rms * rms)
        };
        let mut steps = vec![sets];
        steps.extend(times[samples].iter().map(|time| {
            let decay = decayed(*time - before, tau);
            before = *time;
            Step::after(decay, sigma, rms, &mut variance)
        }));
        steps.push(Step {
            decay: 1.0,
            gain: 0.0,
            inverse_spread: if is_read { 1.0 / variance.sqrt() } else { 0.0 },
        });
        steps
    }
}

impl Layout {
    /// Products of the state at the end and the shared columns, and the logarithm of the determinant of the
    /// eliminated block. `products` has those of the state before and the shared columns.
    fn eliminated(
        self,
        white: &DMatrix<f64>,
        products: &DMatrix<f64>,
    ) -> Option<(DMatrix<f64>, f64)> {
        let mut all = gram(white);
        let (before, out) = (self.before, self.before + self.own);
        let first = out + self.after;
        let shared = all.ncols() - first;
        for (at, from, (height, width)) in [
            ((0, 0), (0, 0), (before, before)),
            ((0, first), (0, before), (before, shared)),
            ((first, first), (before, before), (shared, shared)),
        ] {
            let mut own = all.view_mut(at, (height, width));
            own += products.view(from, (height, width));
        }
        let rest = all.ncols() - out;
        let mut remaining = all.view((out, out), (rest, rest)).into_owned();
        if out == 0 {
            return Some((remaining, 0.0));
        }
        let factor = all.view((0, 0), (out, out)).into_owned().cholesky()?;
        let l = factor.l_dirty();
        let mut between = all.view((0, out), (out, rest)).into_owned();
        l.solve_lower_triangular_mut(&mut between);
        remaining -= gram(&between);
        let ln = (0..out).map(|k| 2.0 * l[(k, k)].ln()).sum();
        Some((remaining, ln))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::fit::example::sweep;
    use crate::fit::noise::restricted::{Columns, Restricted};
    use crate::fit::problem::Problem;

    const SIGMA: [f64; 3] = [0.05, 0.02, 0.11];

    /// Seven stretches of samples with five columns each and some samples between, three columns that all share and
    /// one that is the sum of a stretch's: as stretches and as a whole they know the same of every noise, up to a
    /// constant.
    #[test]
    fn columns_of_stretches_are_as_all_columns_at_once() {
        let session = sweep([0.0, 0.0, 1.0]);
        let problem = Problem::new(&session, JointValues::Commanded);
        let mut rows = Rows::of(&problem);
        let n = rows.samples.len();
        // A clock that is set back within a stretch.
        for time in rows.times.iter_mut().skip(n / 2) {
            *time -= 1000.0;
        }
        let wild = |i: usize, j: usize| (((i + 3) * (2 * j + 5)) as f64 * 0.37).sin();
        let long = n / 8;
        let mut columns = DMatrix::from_fn(3 * n, 3 + 7 * 5 + 1, |i, j| {
            let own = (j >= 3).then(|| 1 + (j - 3) / 5);
            let here = (i % n) / long == own.unwrap_or(0);
            if here || j < 3 { wild(i, j) } else { 0.0 }
        });
        let all: DVector<f64> =
            columns.columns(8, 5).column_sum() + columns.columns(18, 5).column_sum();
        columns.set_column(38, &all);
        let residual = DVector::from_fn(3 * n, |i, _| 0.1 * wild(i, 50));
        let apart = Restricted::new(&rows, &residual, &columns);
        assert!(matches!(apart.columns, Columns::Stretches(_)));
        let whole = Restricted {
            rows: &rows,
            axes: rows.axes.clone(),
            columns: Columns::Whole(super::super::whole::Whole::new(&rows, &residual, &columns)),
            together: None,
        };
        assert_eq!(apart.rank(), whole.rank());
        let shape = |tau: f64, ratio: [f64; 3]| NoiseShape {
            tau,
            ratio,
            sigma: SIGMA,
            joints_rad: 0.0,
        };
        let mut constant = None;
        for shape in [
            NoiseShape::white([1.0; 3]),
            NoiseShape::white(SIGMA),
            shape(40.0, [2.0, 0.0, 0.5]),
            shape(3.0, [0.1, 4.0, 60.0]),
            shape(900.0, [1000.0; 3]),
        ] {
            let differs = apart.likelihood(shape) - whole.likelihood(shape);
            let constant = *constant.get_or_insert(differs);
            assert!((differs - constant).abs() < 1e-7, "{differs} {constant}");
            assert!((apart.scale(shape) / whole.scale(shape) - 1.0).abs() < 1e-8);
            for (a, b) in apart.spread(shape).iter().zip(whole.spread(shape)) {
                assert!((a.1 - b.1).abs() < 1e-5 * n as f64, "{a:?} {b:?}");
                assert!((a.0 / b.0 - 1.0).abs() < 1e-5, "{a:?} {b:?}");
            }
        }
    }
}
