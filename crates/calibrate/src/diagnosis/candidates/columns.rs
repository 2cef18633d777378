//! The columns of the Jacobian of every candidate, stored compactly.
//!
//! What a candidate does to one joint is a number for each sample times how the target moves with that
//! joint. Of a column `w = L (d ∘ f)`, with `L` the filter that whitens, `d` the move of every row and
//! `f` a number for each sample, products with rows need a third of the numbers and no whitened column:
//!
//! ```text
//! wᵀz = fᵀg,   g_i = Σ_a d_(a,i) (Lᵀz)_(a,i)
//! ```
//!
//! Columns of another form are kept row by row.

use nalgebra::{DMatrix, DVector};

use crate::fit::noise::Filter;
use crate::lanes::{LANES, TOGETHER};
use crate::rounding;
use crate::side_by_side::Threads;

/// Columns with one direction, or row by row.
#[derive(Debug, Clone)]
struct Group {
    /// The move of every row; `None` where the columns are kept row by row.
    direction: Option<DVector<f64>>,
    /// Place of the first among all columns.
    first: usize,
    /// The number of columns of names; they come before the others.
    named: usize,
    values: DMatrix<f64>,
}

/// Which of the candidates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CandidateSubset {
    Names,
    All,
}

/// The columns of all candidates, stored compactly.
#[derive(Debug, Clone)]
pub(crate) struct Columns {
    rows: usize,
    samples: usize,
    groups: Vec<Group>,
}

/// Columns that are put together.
pub(crate) struct ColumnBuilder {
    rows: usize,
    samples: usize,
    /// The first is kept row by row.
    groups: Vec<GroupBuilder>,
}

/// A group that still grows.
#[derive(Default)]
struct GroupBuilder {
    direction: Option<DVector<f64>>,
    /// Its square over the rows of each sample.
    squares: Vec<f64>,
    values: Vec<f64>,
    /// Columns so far, and how many of them have names.
    count: usize,
    named: usize,
}

/// The place of a candidate's columns: the group, and its first column there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slot(usize, usize);

/// Sums the products over the rows of each sample.
fn sums_of_samples(samples: usize, a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut sums = vec![-0.0; samples];
    let axes = a.chunks_exact(samples.max(1));
    for (a, b) in axes.zip(b.chunks_exact(samples.max(1))) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    sums
}

impl GroupBuilder {
    /// Appends the number of each sample by which a column is this direction; whether it is, to so much.
    fn along(&self, column: &[f64], least: f64, values: &mut Vec<f64>) -> bool {
        let Some(direction) = &self.direction else {
            return false;
        };
        let direction = direction.as_slice();
        let n = self.squares.len();
        // In blocks of samples: most columns are not, and the first block shows it.
        for from in (0..n).step_by(LANES) {
            let to = (from + LANES).min(n);
            let mut own = [-0.0; LANES];
            let own = &mut own[..to - from];
            let axes = || {
                (0..column.len())
                    .step_by(n)
                    .map(|axis| axis + from..axis + to)
            };
            for rows in axes() {
                let pairs = direction[rows.clone()].iter().zip(&column[rows]);
                for (value, (d, c)) in own.iter_mut().zip(pairs) {
                    *value += d * c;
                }
            }
            for (value, square) in own.iter_mut().zip(&self.squares[from..to]) {
                *value = if *square > 0.0 { *value / square } else { 0.0 };
            }
            let is = axes().all(|rows| {
                let pairs = direction[rows.clone()].iter().zip(&column[rows]);
                let rows = own.iter().zip(pairs);
                rows.fold(true, |is, (value, (d, c))| {
                    is & ((c - value * d).abs() <= least)
                })
            });
            if !is {
                return false;
            }
            values.extend_from_slice(own);
        }
        true
    }
}

impl ColumnBuilder {
    /// Empty, for rows of so many samples, axis by axis; `directions` are how the rows may move.
    pub(crate) fn new(rows: usize, samples: usize, directions: &[DVector<f64>]) -> Self {
        let along = directions.iter().map(|d| GroupBuilder {
            squares: sums_of_samples(samples, d.as_slice(), d.as_slice()),
            direction: Some(d.clone()),
            ..GroupBuilder::default()
        });
        Self {
            rows,
            samples,
            groups: std::iter::once(GroupBuilder::default())
                .chain(along)
                .collect(),
        }
    }

    /// The candidates added so far are named; those that follow are anonymous shapes.
    pub(crate) fn names_end(&mut self) {
        for group in &mut self.groups {
            group.named = group.count;
        }
    }

    /// Takes the columns of one candidate.
    pub(crate) fn push(&mut self, columns: &DMatrix<f64>) -> Slot {
        let height = columns.nrows().max(1);
        let each = columns.as_slice().chunks_exact(height);
        let largest = |column: &[f64]| column.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        let each: Vec<(&[f64], f64)> = each.map(|c| (c, rounding::COMPUTED * largest(c))).collect();
        let found = self.groups.iter().enumerate().find_map(|(at, group)| {
            let mut values = Vec::new();
            let mut all = each.iter();
            all.all(|(column, least)| group.along(column, *least, &mut values))
                .then_some((at, values))
        });
        let (at, values) = found.unwrap_or_else(|| (0, columns.as_slice().to_vec()));
        let group = &mut self.groups[at];
        let slot = Slot(at, group.count);
        group.count += columns.ncols();
        group.values.extend(values);
        slot
    }

    /// All of them, and where each slot begins among them.
    pub(crate) fn done(self) -> (Columns, impl Fn(Slot) -> usize) {
        let mut first = 0;
        let mut groups = Vec::new();
        for mut group in self.groups {
            // The most numbers that a search keeps: what grew has room for up to as many again.
            group.values.shrink_to_fit();
            let height = match group.direction {
                Some(_) => self.samples,
                None => self.rows,
            };
            groups.push(Group {
                direction: group.direction,
                first,
                named: group.named,
                values: DMatrix::from_vec(height, group.count, group.values),
            });
            first += group.count;
        }
        let starts: Vec<usize> = groups.iter().map(|g| g.first).collect();
        let columns = Columns {
            rows: self.rows,
            samples: self.samples,
            groups,
        };
        (columns, move |Slot(group, at)| starts[group] + at)
    }
}

impl Columns {
    /// Number of columns.
    pub(crate) fn count(&self) -> usize {
        self.groups.iter().map(|g| g.values.ncols()).sum()
    }

    /// Whether every number of some adjacent columns is finite.
    pub(crate) fn are_finite(&self, first: usize, count: usize) -> bool {
        let group = &self.groups[self.group(first)];
        let at = first - group.first;
        at + count <= group.values.ncols()
            && group
                .values
                .columns(at, count)
                .iter()
                .all(|v| v.is_finite())
    }

    /// Which group a column is in.
    fn group(&self, column: usize) -> usize {
        let up_to = self.groups.partition_point(|g| g.first <= column);
        let with_any = |g: &Group| g.values.ncols() > 0;
        self.groups[..up_to].iter().rposition(with_any).unwrap_or(0)
    }

    /// Columns from a place on, row by row, as they were pushed.
    pub(crate) fn raw(&self, first: usize, count: usize) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.rows, count);
        for (k, mut own) in all.column_iter_mut().enumerate() {
            let group = &self.groups[self.group(first + k)];
            let values = group.values.column(first + k - group.first);
            match &group.direction {
                None => own.copy_from(&values),
                Some(direction) => {
                    let n = self.samples.max(1);
                    let axes = own.as_mut_slice().chunks_exact_mut(n);
                    for (own, d) in axes.zip(direction.as_slice().chunks_exact(n)) {
                        for (own, (d, value)) in own.iter_mut().zip(d.iter().zip(values.iter())) {
                            *own = d * value;
                        }
                    }
                }
            }
        }
        all
    }

    /// Some columns, row by row.
    pub(crate) fn raw_of(&self, which: &[usize]) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.rows, which.len());
        for (k, column) in which.iter().enumerate() {
            all.set_column(k, &self.raw(*column, 1).column(0));
        }
        all
    }

    /// Whitened columns from a place on, with so many rows of zeros more.
    pub(crate) fn white(
        &self,
        filter: &Filter,
        first: usize,
        count: usize,
        more: usize,
    ) -> DMatrix<f64> {
        let mut own = self.raw(first, count);
        filter.whiten(own.as_mut_slice());
        pad_rows(own, more)
    }

    /// Products of whitened columns with vectors of all rows, a row of products for each; zero for the others.
    pub(crate) fn products(
        &self,
        filter: &Filter,
        z: &DMatrix<f64>,
        among: CandidateSubset,
        threads: Threads,
    ) -> DMatrix<f64> {
        let of_samples = self.of_samples(filter, z);
        let mut all = DMatrix::zeros(z.ncols(), self.count());
        for (group, g) in self.groups.iter().zip(&of_samples) {
            let count = group.count(among);
            let mut own = all.columns_mut(group.first, count);
            if z.ncols() > TOGETHER {
                let stretches = threads.stretches(count, LANES);
                let of = |k: usize| {
                    let stretch = &stretches[k];
                    g * group.values.columns(stretch.start, stretch.len())
                };
                if let [_] = stretches[..] {
                    own.gemm(1.0, g, &group.values.columns(0, count), 0.0);
                    continue;
                }
                let all = threads.each(stretches.len(), of);
                for (stretch, of_stretch) in stretches.iter().zip(all) {
                    let mut own = own.columns_mut(stretch.start, stretch.len());
                    own.copy_from(&of_stretch);
                }
                continue;
            }
            let columns = group.values.columns(0, count);
            own.copy_from(&columns.tr_mul(&g.transpose()).transpose());
        }
        all
    }

    /// Vectors in the form that products with each group need: a row for each vector.
    pub(crate) fn of_samples(&self, filter: &Filter, z: &DMatrix<f64>) -> Vec<DMatrix<f64>> {
        let mut turned = z.rows(0, self.rows).into_owned();
        filter.whiten_transposed(turned.as_mut_slice());
        let one = |group: &Group| {
            let mut all = DMatrix::zeros(group.values.nrows(), z.ncols());
            for (k, mut own) in all.column_iter_mut().enumerate() {
                let from = &turned.as_slice()[k * self.rows..(k + 1) * self.rows];
                own.as_mut_slice()
                    .copy_from_slice(&group.of_samples(from, self.samples));
            }
            all.transpose()
        };
        self.groups.iter().map(one).collect()
    }

    /// How many columns from this one on are in its group.
    pub(crate) fn together(&self, first: usize) -> usize {
        let group = &self.groups[self.group(first)];
        group.first + group.values.ncols() - first
    }

    /// Products of columns that are [`together`](Self::together) with vectors
    /// [by sample](Self::of_samples): a row for each vector. Single precision is enough for what noise does.
    pub(crate) fn products_near(
        &self,
        of_samples: &[DMatrix<f32>],
        first: usize,
        count: usize,
    ) -> DMatrix<f32> {
        let at = self.group(first);
        let group = &self.groups[at];
        let own = group.values.columns(first - group.first, count);
        &of_samples[at] * own.map(|v| v as f32)
    }
}

impl Group {
    /// So many of its columns, which are the first.
    fn count(&self, among: CandidateSubset) -> usize {
        match among {
            CandidateSubset::Names => self.named,
            CandidateSubset::All => self.values.ncols(),
        }
    }

    /// A row vector in the form that products with the group's values need.
    fn of_samples(&self, z: &[f64], samples: usize) -> Vec<f64> {
        let Some(direction) = &self.direction else {
            return z.to_vec();
        };
        let mut g = vec![0.0; samples];
        let axes = direction.as_slice().chunks_exact(samples.max(1));
        for (d, z) in axes.zip(z.chunks_exact(samples.max(1))) {
            for (g, (d, z)) in g.iter_mut().zip(d.iter().zip(z)) {
                *g += d * z;
            }
        }
        g
    }
}

/// A matrix with so many rows of zeros more.
pub(crate) fn pad_rows(columns: DMatrix<f64>, more: usize) -> DMatrix<f64> {
    if more == 0 {
        return columns;
    }
    let (rows, count) = columns.shape();
    let mut all = Vec::with_capacity((rows + more) * count);
    for k in 0..count {
        all.extend_from_slice(&columns.as_slice()[k * rows..(k + 1) * rows]);
        all.resize((k + 1) * (rows + more), 0.0);
    }
    DMatrix::from_vec(rows + more, count, all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::noise::{Noise, Slow};

    /// Columns over one direction and others, under noise that wanders along one axis: products are
    /// those of the whitened columns.
    #[test]
    fn products_are_those_of_the_columns_row_by_row() {
        let (n, axes) = (11, 3);
        let value = |i: usize, k: usize| ((i * 7 + k * 3) as f64 * 0.61).sin();
        let direction = DVector::from_fn(n * axes, |i, _| value(i, 40));
        let over = |k: usize| DVector::from_fn(n * axes, |i, _| direction[i] * value(i % n, k));
        let free = |k: usize| DVector::from_fn(n * axes, |i, _| value(i, 20 + k));
        let candidates = [
            DMatrix::from_columns(&[over(0), over(1)]),
            DMatrix::from_columns(&[free(0)]),
            DMatrix::from_columns(&[over(2)]),
            DMatrix::from_columns(&[over(3), free(1)]),
        ];
        let mut gathering = ColumnBuilder::new(n * axes, n, &[free(9), direction.clone()]);
        let mut slots = vec![
            gathering.push(&candidates[0]),
            gathering.push(&candidates[1]),
        ];
        gathering.names_end();
        slots.extend(candidates[2..].iter().map(|c| gathering.push(c)));
        let (columns, first) = gathering.done();
        assert_eq!(columns.count(), 6);
        assert_eq!(
            columns
                .groups
                .iter()
                .map(|g| g.values.ncols())
                .collect::<Vec<_>>(),
            [3, 0, 3]
        );
        let noise = Noise {
            slow: Some(Slow {
                rms_mm: [0.0, 0.4, 0.0],
                time_constant_s: 3.0,
            }),
            ..Noise::white(0.5)
        };
        let times: Vec<f64> = (0..n).map(|k| k as f64).collect();
        let filter = noise.filter_over(&times, &[0, 1, 2]);
        let z = DMatrix::from_fn(n * axes + 2, 5, |i, k| value(i, k + 70));
        let all = columns.products(&filter, &z, CandidateSubset::All, Threads::ONE);
        let one = z.columns(3, 1).into_owned();
        let one = columns.products(&filter, &one, CandidateSubset::All, Threads::ONE);
        let names = columns.products(&filter, &z, CandidateSubset::Names, Threads::ONE);
        let named = names.column_iter().zip(all.column_iter());
        let named: Vec<_> = named.filter(|(own, _)| own.norm() > 0.0).collect();
        assert_eq!(named.len(), 3);
        assert!(
            named
                .iter()
                .all(|(own, of_all)| (own - of_all).norm() < 1e-12)
        );
        let by_sample: Vec<DMatrix<f32>> = columns
            .of_samples(&filter, &z)
            .iter()
            .map(|g| g.map(|v| v as f32))
            .collect();
        for (slot, expected) in slots.into_iter().zip(&candidates) {
            let at = first(slot);
            assert!((columns.raw(at, expected.ncols()) - expected).norm() < 1e-12);
            let mut white = expected.clone();
            filter.whiten(white.as_mut_slice());
            let white = pad_rows(white, 2);
            assert!((columns.white(&filter, at, white.ncols(), 2) - &white).norm() < 1e-12);
            let products = z.tr_mul(&white);
            let own = all.columns(at, white.ncols());
            assert!((&products - own).norm() < 1e-12);
            assert!(
                (products.row(3).transpose() - one.columns(at, white.ncols()).transpose()).norm()
                    < 1e-12
            );
            assert!(columns.together(at) >= white.ncols());
            let near = columns.products_near(&by_sample, at, white.ncols());
            assert!((products - near.map(f64::from)).norm() < 1e-5);
        }
    }
}
