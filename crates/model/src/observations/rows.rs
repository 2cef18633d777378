//! Observations as the rows of a regression: up to three for each of them, row by row of all of them,
//! those that an observation does not have zero.
//!
//! Rows are in units of the layer (σ of the kind is `unit_mm`), so that one number is the noise of all of them. Their
//! size in mm, for figures that people read, depends on the row: an angle is seen across a distance, and of a pose the
//! point alone is a length.

use nalgebra::{DMatrix, DVector};

use crate::lanes::Lanes;
use crate::model::Model;

use super::{KINDS, Kind, Layer, Residual};

/// Observations as rows of a regression, up to three each.
#[derive(Debug, Clone)]
pub struct ObservedRows<'a> {
    layer: Layer<'a>,
    /// Rows of the observation that has most.
    pub width: usize,
    /// Inner units of the kind of one unit of each row.
    base_units: Vec<f64>,
    /// mm of one unit of each row; zero where another observation of the sample is its length.
    mm: Vec<f64>,
    /// Number of samples.
    samples: usize,
}

impl<'a> ObservedRows<'a> {
    /// Of the observations that are marked.
    pub fn new(layer: &Layer<'a>, counted: &[bool]) -> Self {
        let layer = layer.only(counted);
        let width = layer.items.iter().map(|item| item.rows).max().unwrap_or(1);
        Self {
            base_units: vec![0.0; layer.items.len() * width],
            mm: vec![0.0; layer.items.len() * width],
            samples: 0,
            width,
            layer,
        }
    }

    /// The same with some of its observations only.
    #[doc(hidden)]
    #[must_use]
    pub fn only(&self, kept: &[bool]) -> Self {
        Self::new(&self.layer, kept)
    }

    /// Takes the distances across which angles are seen from a model.
    #[doc(hidden)]
    pub fn see_by(&mut self, model: &Model) {
        let layer = &self.layer;
        let n = layer.items.len();
        let lengths = layer.length_items();
        let mut is_length = vec![false; n];
        for k in &lengths {
            is_length[*k] = true;
        }
        let levers = layer.levers_mm(model);
        for (k, item) in layer.items.iter().enumerate() {
            let kind = KINDS[item.kind];
            let sigma = layer.sigma[item.kind];
            for (row, unit) in units(kind, layer, item.sample, sigma, item.rows) {
                self.base_units[row * n + k] = unit / layer.unit_mm;
                if is_length[k] {
                    self.mm[row * n + k] = levers[k] * unit / layer.unit_mm;
                }
            }
        }
        self.samples = lengths.len();
    }

    /// The observations.
    pub fn layer(&self) -> &Layer<'a> {
        &self.layer
    }

    /// Number of rows that there are.
    pub fn count(&self) -> usize {
        self.layer.items.iter().map(|item| item.rows).sum()
    }

    /// Whether there is this row.
    pub fn has(&self, row: usize) -> bool {
        let n = self.layer.items.len();
        row / n < self.layer.items[row % n].rows
    }

    /// mm of one unit of a row.
    pub fn mm(&self, row: usize) -> f64 {
        self.mm[row]
    }

    /// Root mean square lengths of the observations of every kind, inner units; `None` of a kind that
    /// is not among them.
    pub fn by_kind(&self, e: &DVector<f64>) -> Vec<Option<f64>> {
        let n = self.layer.items.len();
        let of = |kind: usize| {
            let own = (0..n).filter(|k| self.layer.items[*k].kind == kind);
            let squares: Vec<f64> = own
                .map(|k| {
                    let rows = (0..self.width).map(|row| row * n + k);
                    rows.map(|row| (self.base_units[row] * e[row]).powi(2))
                        .sum()
                })
                .collect();
            let mean = squares.iter().sum::<f64>() / squares.len() as f64;
            (!squares.is_empty()).then(|| mean.sqrt())
        };
        (0..KINDS.len()).map(of).collect()
    }

    /// Number of samples that have a length.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Root mean square length of the deviations where noise of `sigma_mm` is all there is, mm.
    pub fn noise_mm(&self, sigma_mm: f64) -> f64 {
        let square: f64 = self.mm.iter().map(|mm| (mm * sigma_mm).powi(2)).sum();
        (square / self.samples.max(1) as f64).sqrt()
    }

    /// Residuals (measured − predicted) and the columns of every coefficient, in units of the layer.
    pub fn extract(&self, model: &Model) -> (DVector<f64>, DMatrix<f64>) {
        let n = self.layer.items.len();
        let mut residual = DVector::zeros(n * self.width);
        let height = n * self.width;
        let mut columns = DMatrix::zeros(height, model.coefficient_count());
        self.layer.visit(model, true, |block| {
            for row in 0..self.width {
                // A number for each lane goes to where its item is, column by column.
                let (to, there) = (row * n..(row + 1) * n, &block.rows[row]);
                let lanes = block.items.iter().enumerate();
                let lanes = lanes.filter_map(|(lane, item)| Some((lane, (*item)?)));
                let lanes: Vec<(usize, usize)> = lanes.filter(|own| there[own.0]).collect();
                let put = |from: &Lanes, to: &mut [f64]| {
                    for (lane, item) in &lanes {
                        to[*item] = from[*lane];
                    }
                };
                put(&block.left[row], &mut residual.as_mut_slice()[to.clone()]);
                for k in &block.live {
                    let own = &mut columns.as_mut_slice()[k * height..(k + 1) * height];
                    put(&block.columns[*k][row], &mut own[to.clone()]);
                }
            }
        });
        (residual, columns)
    }

    /// The residuals of [`extract`](Self::extract) alone.
    pub fn residual(&self, model: &Model) -> DVector<f64> {
        let n = self.layer.items.len();
        let mut residual = DVector::zeros(n * self.width);
        self.layer.visit(model, false, |block| {
            for (lane, item) in block.items.iter().enumerate() {
                let Some(item) = *item else { continue };
                for row in (0..self.width).filter(|row| block.rows[*row][lane]) {
                    residual[row * n + item] = block.left[row][lane];
                }
            }
        });
        residual
    }

    /// The priors of the distances between sockets, in units of σ.
    pub fn known_distances(&self, model: &Model) -> (DVector<f64>, DMatrix<f64>) {
        let block = self.layer.distances(model);
        let unit = 1.0 / self.layer.unit_mm;
        let count = block.items.len();
        (
            DVector::from_fn(count, |lane, _| block.left[0][lane] * unit),
            DMatrix::from_fn(count, model.coefficient_count(), |lane, k| {
                block.columns[k][0][lane] * unit
            }),
        )
    }

    /// What the rows show of targets that are elsewhere, each by so many mm along x, y, z: how a
    /// tool is turned they do not.
    pub fn displaced(&self, model: &Model, by: impl Fn(usize) -> [f64; 3]) -> DVector<f64> {
        let n = self.layer.items.len();
        let mut column = DVector::zeros(n * self.width);
        for (item, rows) in self.layer.by_point(model).into_iter().enumerate() {
            let by = by(item);
            for (row, along) in rows.iter().enumerate().take(self.layer.items[item].rows) {
                column[row * n + item] = (0..3).map(|k| along[k] * by[k]).sum();
            }
        }
        column
    }
}

/// What one σ of each row is in inner units of the kind.
fn units(
    kind: &dyn Kind,
    layer: &Layer,
    sample: usize,
    sigma: f64,
    rows: usize,
) -> Vec<(usize, f64)> {
    let mut whitening = DMatrix::zeros(rows, rows);
    for k in 0..rows {
        let mut one = Residual::new(rows);
        one.left[k] = 1.0;
        let white = kind.weighed(layer.session, sample, sigma, &one);
        for row in 0..rows {
            whitening[(row, k)] = white.left[row];
        }
    }
    let back = whitening.try_inverse();
    let unit = |row: usize| back.as_ref().map_or(0.0, |back| back.column(row).norm());
    (0..rows).map(|row| (row, unit(row))).collect()
}
