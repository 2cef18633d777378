//! Figures of each kind of measurement after a fit: its noise, outliers, its errors.

use nalgebra::{DMatrix, DVector};

use crate::lanes::LANES;
use crate::model::Model;
use crate::{budget, fewest};

use super::outliers::{are_the_rule, as_if_seen, kept, suspected};
use super::{KINDS, Layer};

/// Deviation of every sample, as columns, mm; NaN where a sample cannot be used.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Deviations {
    /// Along x, y and z of the measuring frame; z is zero in a planar session.
    pub axes_mm: [Vec<f64>; 3],
    /// Lengths.
    pub length_mm: Vec<f64>,
}

/// Errors of one kind of measurement, in the unit that people read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Number of measurements, suspected outliers included.
    pub count: usize,
    /// Root mean square of the nominal robot, without suspected outliers.
    pub before_rms: f64,
    /// The same of the model.
    pub after_rms: f64,
    /// Largest of the nominal robot.
    pub before_max: f64,
    /// Largest of the model.
    pub after_max: f64,
}

/// Errors and noise of one kind of measurement, in its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct KindFigures {
    /// The kind.
    pub kind: &'static str,
    /// Unit of the numbers: mm or mrad.
    pub unit: &'static str,
    /// Of what was fitted.
    pub fitted: Option<Errors>,
    /// Of what the session holds out.
    pub held_out: Option<Errors>,
    /// Root mean square of measurements that no fit has seen, each fifth predicted by the others; where
    /// a diagnosis has looked; in `unit`.
    pub unseen_rms: Option<f64>,
    /// Number of suspected outliers.
    pub outliers: usize,
    /// Number of rows that were fitted.
    pub rows: usize,
    /// σ as the session states it, in `unit`.
    pub stated_sigma: Option<f64>,
    /// Root mean square over the rows of what was fitted: what σ seems to be, in
    /// `unit`.
    pub found_sigma: Option<f64>,
}

/// One row after the other of every item: whitened residuals and lengths.
struct WhitenedRows {
    /// In units of the noise.
    rows: Vec<[f64; 3]>,
    /// Inner units.
    length: Vec<f64>,
    /// As mm.
    length_mm: Vec<f64>,
    /// Along x, y, z.
    along: Vec<[f64; 3]>,
}

fn residuals(layer: &Layer, model: &Model) -> WhitenedRows {
    let n = layer.items.len();
    let mut residuals = WhitenedRows {
        rows: vec![[0.0; 3]; n],
        length: vec![f64::NAN; n],
        length_mm: vec![f64::NAN; n],
        along: vec![[f64::NAN; 3]; n],
    };
    layer.visit(model, false, |block| {
        for (lane, item) in block.items.iter().enumerate() {
            let Some(item) = *item else { continue };
            debug_assert!(lane < LANES);
            residuals.rows[item] = [0, 1, 2].map(|row| block.left[row][lane] / layer.unit_mm);
            residuals.along[item] = [0, 1, 2].map(|axis| block.along[axis][lane]);
            residuals.length[item] = block.length[lane];
            residuals.length_mm[item] = block.length_mm[lane];
        }
    });
    residuals
}

/// How many standard deviations of itself a noise has to be below the stated one to be believed instead.
const CLEARLY: f64 = 3.0;

/// Judges the residuals of a model: outliers of each kind compared with its own bulk, and the noise of kinds whose σ
/// is not stated. `rank` is the number of coefficients that the rows determine, `covariance` theirs in units of the
/// noise times the layer's. Returns whether anything that matters has changed.
///
/// Where several kinds were measured, one whose noise is clearly below its stated value has the weight of the former:
/// a careful figure in the data sheet of one instrument would leave the robot to the other. A noise above the stated
/// one may be an effect that is still missing, and changes no weight.
pub fn judge(
    layer: &mut Layer,
    model: &Model,
    rank: usize,
    covariance: impl FnOnce() -> DMatrix<f64>,
) -> bool {
    let residuals = residuals(layer, model);
    // What the fit has not seen is farther off for that.
    let mut as_seen = residuals.rows.clone();
    if layer.used.contains(&false) {
        let rows = layer.used_rows();
        for (item, leverage) in leverages_of_unseen(layer, model, &covariance()) {
            let factor = as_if_seen(rank, rows, leverage);
            as_seen[item] = as_seen[item].map(|e| e * factor);
        }
    }
    let marked = outlying(layer, &as_seen);
    let kept = layer
        .fit
        .iter()
        .zip(&marked)
        .map(|(fit, apart)| *fit && !apart);
    let used: Vec<bool> = kept.collect();
    let mut changed = used != layer.used;
    layer.used = used;
    layer.suspected = marked;
    let all = layer.used_rows();
    let freedom = all.saturating_sub(rank).max(1) as f64 / all.max(1) as f64;
    for kind in 0..KINDS.len() {
        let Some((found, rows)) = spread(layer, kind, &residuals) else {
            continue;
        };
        let found = found * layer.sigma[kind];
        let now = match KINDS[kind].sigma(&layer.session.instrument) {
            // What is not stated is never taken for better than rounding.
            None => (found / freedom.sqrt()).max(1e-3 * KINDS[kind].about().usual_sigma),
            Some(stated) if rows < all => no_larger(stated, found, rows, rank),
            Some(_) => continue,
        };
        changed |= (now / layer.sigma[kind]).ln().abs() > budget::SETTLED;
        layer.sigma[kind] = now;
    }
    changed
}

/// Of every item that does not count how much the fit's own error adds to the square of its deviation, in units of the
/// noise: `tr(J C Jᵀ)/rows`.
fn leverages_of_unseen(
    layer: &Layer,
    model: &Model,
    covariance: &DMatrix<f64>,
) -> Vec<(usize, f64)> {
    let mut leverages = Vec::new();
    let mut row = DVector::zeros(model.coefficient_count());
    layer.visit(model, true, |block| {
        for (lane, item) in block.items.iter().enumerate() {
            let Some(item) = item.filter(|item| !layer.used[*item]) else {
                continue;
            };
            let own = layer.items[item].rows;
            let mut sum = 0.0;
            for axis in 0..own {
                for (value, column) in row.iter_mut().zip(&block.columns) {
                    *value = column[axis][lane];
                }
                sum += row.dot(&(covariance * &row));
            }
            leverages.push((item, sum / own as f64));
        }
    });
    leverages
}

/// The stated noise of a kind, or the estimated one where that is clearly less, were all coefficients fitted to this
/// kind alone.
fn no_larger(stated: f64, found: f64, rows: usize, rank: usize) -> f64 {
    let freedom = rows.saturating_sub(rank).max(1) as f64;
    let found = found * (rows as f64 / freedom).sqrt();
    let clear = 1.0 - CLEARLY * (2.0 / freedom).sqrt();
    if (found / stated).powi(2) < clear {
        found
    } else {
        stated
    }
}

/// Which observations are outliers of their kind given a model.
pub fn outliers_given(layer: &Layer, model: &Model) -> Vec<bool> {
    outlying(layer, &residuals(layer, model).rows)
}

/// Which observations are outliers of their kind, from the residual of each in units of its noise; those to be fitted
/// make the bulk.
pub fn outlying(layer: &Layer, residuals: &[[f64; 3]]) -> Vec<bool> {
    let mut marked = vec![false; layer.items.len()];
    for kind in 0..KINDS.len() {
        for rows in 1..=3 {
            let own: Vec<usize> = (0..layer.items.len())
                .filter(|i| layer.items[*i].kind == kind && layer.items[*i].rows == rows)
                .collect();
            let axes: Vec<Vec<f64>> = (0..rows)
                .map(|row| own.iter().map(|i| residuals[*i][row]).collect())
                .collect();
            let axes: Vec<&[f64]> = axes.iter().map(Vec::as_slice).collect();
            let counts: Vec<bool> = own.iter().map(|i| layer.fit[*i]).collect();
            let apart = suspected(&axes, &counts, &vec![1.0; rows], false);
            for (item, apart) in own.into_iter().zip(apart) {
                marked[item] = apart;
            }
        }
    }
    marked
}

/// The residual of every row that counts, in units of its noise.
pub fn whitened(layer: &Layer, model: &Model) -> Vec<f64> {
    let residuals = residuals(layer, model);
    let items = (0..layer.items.len()).filter(|i| layer.used[*i]);
    items
        .flat_map(|i| residuals.rows[i].into_iter().take(layer.items[i].rows))
        .collect()
}

/// The residuals of a kind whose noise is stated.
pub struct ResidualsOfKind {
    pub name: &'static str,
    /// Squares of its rows that count, in units of the stated noise.
    pub squares: Vec<f64>,
}

/// The residuals of every kind whose noise is stated.
pub fn residuals_of_kinds(layer: &Layer, model: &Model) -> Vec<ResidualsOfKind> {
    let residuals = residuals(layer, model);
    let mut all = Vec::new();
    for (kind, own) in KINDS.iter().enumerate() {
        let items =
            (0..layer.items.len()).filter(|i| layer.items[*i].kind == kind && layer.used[*i]);
        let Some(stated) = own.sigma(&layer.session.instrument) else {
            continue;
        };
        let to_stated = layer.sigma[kind] / stated;
        let squares: Vec<f64> = items
            .flat_map(|i| residuals.rows[i].into_iter().take(layer.items[i].rows))
            .map(|e| (e * to_stated).powi(2))
            .collect();
        if !squares.is_empty() {
            let name = own.about().name;
            all.push(ResidualsOfKind { name, squares });
        }
    }
    all
}

/// Root mean square over the whitened rows of the items of a kind that count, and their number.
fn spread(layer: &Layer, kind: usize, residuals: &WhitenedRows) -> Option<(f64, usize)> {
    let (mut sum, mut count) = (0.0, 0);
    for (i, item) in layer.items.iter().enumerate() {
        if item.kind == kind && layer.used[i] {
            sum += residuals.rows[i].iter().map(|v| v * v).sum::<f64>();
            count += item.rows;
        }
    }
    (count >= fewest::OF_A_PART).then(|| ((sum / count as f64).sqrt(), count))
}

/// Deviations of every sample: along the axes of a point, and a length in mm; where a sample was
/// measured in several ways, in the one that looks at where the target is. NaN without any.
pub fn deviations(layer: &Layer, model: &Model) -> Deviations {
    let residuals = residuals(layer, model);
    let n = layer.session.samples.len();
    let mut deviations = Deviations {
        axes_mm: std::array::from_fn(|_| vec![f64::NAN; n]),
        length_mm: vec![f64::NAN; n],
    };
    for i in layer.length_items() {
        let sample = layer.items[i].sample;
        deviations.length_mm[sample] = residuals.length_mm[i];
        for axis in 0..3 {
            deviations.axes_mm[axis][sample] = residuals.along[i][axis];
        }
    }
    deviations
}

/// Root mean square of a coordinate of what is a length in mm, for a fit of so many coefficients: the estimated noise,
/// without a row of an angle in it. `None` where nothing counts.
pub fn coordinate_mm(layer: &Layer, model: &Model, rank: f64) -> Option<f64> {
    let residuals = residuals(layer, model);
    let (mut sum, mut rows) = (0.0, 0);
    for i in layer.length_items().into_iter().filter(|i| layer.used[*i]) {
        sum += residuals.length_mm[i].powi(2);
        rows += layer.items[i].rows;
    }
    // Every row pays for the coefficients with its share.
    let kept = kept(rank, layer.used_rows());
    (rows > 0).then(|| (sum / (rows as f64 * kept)).sqrt())
}

/// The figures of every kind that was measured; `before` is the nominal robot.
pub fn by_kind(layer: &Layer, before: &Model, after: &Model) -> Vec<KindFigures> {
    let (then, now) = (residuals(layer, before), residuals(layer, after));
    let mut all = Vec::new();
    for (kind, own) in KINDS.iter().enumerate() {
        let (unit, factor) = own.about().unit.read();
        let items: Vec<usize> = (0..layer.items.len())
            .filter(|i| layer.items[*i].kind == kind)
            .collect();
        if items.is_empty() {
            continue;
        }
        let errors = |fit: bool| {
            let own: Vec<usize> = items
                .iter()
                .copied()
                .filter(|i| layer.fit[*i] == fit)
                .collect();
            let clean: Vec<usize> = own
                .iter()
                .copied()
                .filter(|i| !layer.suspected[*i])
                .collect();
            let many = are_the_rule(own.len() - clean.len(), own.len());
            let counted = if many { &own } else { &clean };
            let rms = |residuals: &WhitenedRows| {
                let sum: f64 = counted.iter().map(|i| residuals.length[*i].powi(2)).sum();
                (sum / counted.len() as f64).sqrt() * factor
            };
            let max = |residuals: &WhitenedRows| {
                own.iter().map(|i| residuals.length[*i]).fold(0.0, f64::max) * factor
            };
            (!own.is_empty()).then(|| Errors {
                count: own.len(),
                before_rms: rms(&then),
                after_rms: rms(&now),
                before_max: max(&then),
                after_max: max(&now),
            })
        };
        let stated = own.sigma(&layer.session.instrument);
        all.push(KindFigures {
            kind: own.about().name,
            unit,
            fitted: errors(true),
            held_out: errors(false),
            unseen_rms: None,
            outliers: items.iter().filter(|i| layer.suspected[**i]).count(),
            rows: items
                .iter()
                .filter(|i| layer.used[**i])
                .map(|i| layer.items[*i].rows)
                .sum(),
            stated_sigma: stated.map(|s| s * factor),
            found_sigma: spread(layer, kind, &now).map(|(s, _)| s * layer.sigma[kind] * factor),
        });
    }
    all
}
