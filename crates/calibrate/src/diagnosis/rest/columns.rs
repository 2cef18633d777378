//! The regression of a curve over a joint: the residuals of a model along the joint's motion, across it and along its
//! axis, each a problem with its own noise,
//!
//! ```text
//! y_d = J_d β_d + m_d (c_d(q) + dir h_d(q)) + e_d
//! ```
//!
//! `m_d`: mm by which the point moves for a unit of the curve (along a turning joint's motion its radius). The three
//! are orthogonal, so that a coordinate that was not measured, or was computed from the others, adds nothing to them.
//! With a known noise they are one problem, all rows as they are.

use nalgebra::{DMatrix, DVector};

use crate::effects::curve::{DIRECTIONS, Knots};
use crate::effects::{EACH_DIRECTION, Term};
use crate::fit::gauge::MOST_SEEN;
use crate::fit::noise::{Filter, Noise, Slow};
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::linear::Basis;
use crate::model::Model;
use crate::rounding;

use super::held_out::Whitened;

/// A longer session is thinned evenly to so many samples: some fifty for each knot.
const MOST_SAMPLES: usize = 3000;

/// See the module.
pub(super) struct Columns<'a> {
    /// Counted from 0.
    pub(super) joint: usize,
    pub(super) rows: Rows<'a>,
    pub(super) q: Vec<f64>,
    /// The side from which the joint came: 1, −1, or 0 where it is not known.
    pub(super) dir: Vec<f64>,
    /// Different values of the joint, in ascending order.
    pub(super) values: Vec<f64>,
    /// Rows that share a noise: of each direction that was measured, or all.
    pub(super) blocks: Vec<Block>,
}

/// Rows that share a noise.
pub(super) struct Block {
    /// Which sample each is of.
    pub(super) samples: Vec<usize>,
    /// Along the motion, the radius, the axis: the directions of the curve that affect them.
    pub(super) directions: Vec<usize>,
    /// A value of 1 at a knot of each direction, in rad or mm: it moves the samples by 1 mm, root mean square.
    pub(super) unit: Vec<f64>,
    /// Residual, mm.
    pub(super) residual: DVector<f64>,
    /// Of the terms that are fitted with the curve, scaled to length 1.
    pub(super) base: DMatrix<f64>,
    /// mm by which a unit of the curve in each direction moves each row.
    moves: DMatrix<f64>,
    /// The whitening filter; `None`: their noise is white and of one size.
    filter: Option<Filter>,
    /// The square of the rounding in one of them, whitened.
    floor: f64,
    /// Those that were measured.
    pub(super) measured: Vec<usize>,
}

impl<'a> Columns<'a> {
    /// Of the samples of a problem that count, direction by direction; `fitted_with` selects the terms of the model that
    /// are fitted with the curve, which is orthogonal to them.
    pub(super) fn new(
        problem: &Problem<'a>,
        model: &Model,
        joint: usize,
        fitted_with: impl Fn(&Term) -> bool,
    ) -> Self {
        let rows = Rows::of(&problem.thinned(MOST_SAMPLES)).seen_by(model);
        let [mut directions, mut base, mut residual] = extracted(&rows, model, joint, fitted_with);
        for row in 0..rows.len() {
            for all in [&mut directions, &mut base, &mut residual] {
                all.row_mut(row).scale_mut(rows.mm(row));
            }
        }
        let blocks = Block::each(&rows, &directions, &base, &residual);
        Self::of(rows, joint, blocks)
    }

    /// The same in all directions together with a known noise, and with all terms of the model.
    pub(super) fn together(
        problem: &Problem<'a>,
        noise: &Noise,
        model: &Model,
        joint: usize,
    ) -> Self {
        let rows = Rows::of(&problem.thinned(MOST_SAMPLES));
        let [moves, mut base, residual] = extracted(&rows, model, joint, |_| true);
        let n = rows.samples.len();
        for mut column in base.column_iter_mut() {
            let norm = column.norm();
            if norm > 0.0 {
                column.unscale_mut(norm);
            }
        }
        let white = noise.whitened(&rows, &moves);
        let unit = |d: usize| match white.column(d).norm() {
            norm if norm > 0.0 => (n as f64).sqrt() / norm,
            _ => 0.0,
        };
        let sigma = rows.axes.iter().map(|a| noise.sigma_mm[*a]);
        let smallest = sigma.fold(f64::INFINITY, f64::min);
        let block = Block {
            samples: (0..rows.len()).map(|row| row % n).collect(),
            directions: (0..DIRECTIONS).collect(),
            unit: (0..DIRECTIONS).map(unit).collect(),
            residual: residual.column(0).into_owned(),
            base,
            moves,
            filter: Some(noise.filter(&rows)),
            floor: (rounding::WRITTEN / smallest).powi(2),
            measured: (0..rows.len()).filter(|row| rows.has(*row)).collect(),
        };
        Self::of(rows, joint, vec![block])
    }

    fn of(rows: Rows<'a>, joint: usize, blocks: Vec<Block>) -> Self {
        let q = rows.inputs.q[joint].to_vec();
        let dir = rows.inputs.dir[joint].as_deref();
        let dir = dir.map_or_else(|| vec![0.0; q.len()], <[f64]>::to_vec);
        let mut values = q.clone();
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| (*a - *b).abs() < rounding::WRITTEN);
        Self {
            joint,
            rows,
            q,
            dir,
            values,
            blocks,
        }
    }

    /// So many knots over the range.
    pub(super) fn knots(&self, count: usize) -> Knots {
        Knots {
            from: self.values.first().copied().unwrap_or(0.0),
            to: self.values.last().copied().unwrap_or(0.0),
            period: None,
            count,
        }
    }

    /// Estimates the noise of each block from the residuals of its rows; whether it is slow in any.
    pub(super) fn wander(&mut self, residuals: &[DVector<f64>]) -> bool {
        let mut slow = false;
        for (block, residuals) in self.blocks.iter_mut().zip(residuals) {
            slow |= block.wander(&self.rows, residuals);
        }
        slow
    }
}

/// The move of rows in each direction by a unit of a curve over a joint, the columns of the terms that are fitted with
/// it, and the residual.
fn extracted(
    rows: &Rows,
    model: &Model,
    joint: usize,
    fitted_with: impl Fn(&Term) -> bool,
) -> [DMatrix<f64>; 3] {
    let probe = Term::absent(&EACH_DIRECTION, joint, 0.0);
    let model = model.with_term(probe.clone());
    let (residual, all) = rows.extract(&model);
    let of = |pick: &dyn Fn(&Term) -> bool| {
        let all_columns = model.columns().enumerate();
        let own: Vec<usize> = all_columns
            .filter(|(_, (term, _))| pick(term))
            .map(|(k, _)| k)
            .collect();
        all.select_columns(&own)
    };
    let is_probe = |term: &Term| term.same_column(&probe);
    let residual = DMatrix::from_columns(&[residual]);
    [
        of(&is_probe).columns(0, DIRECTIONS).into_owned(),
        of(&|term| !is_probe(term) && fitted_with(term)),
        residual,
    ]
}

impl Block {
    fn each(
        rows: &Rows,
        directions: &DMatrix<f64>,
        base: &DMatrix<f64>,
        residual: &DMatrix<f64>,
    ) -> Vec<Self> {
        let (n, axes) = (rows.samples.len(), rows.axes.len());
        let mut taken: Vec<Vec<Vec<f64>>> = vec![Vec::new(); n];
        let mut all = Vec::new();
        for direction in 0..DIRECTIONS {
            let mut own: Vec<(usize, Vec<f64>, f64)> = Vec::new();
            for (sample, taken) in taken.iter_mut().enumerate() {
                let whole: Vec<f64> = (0..axes)
                    .map(|a| directions[(a * n + sample, direction)])
                    .collect();
                let mut v = whole.clone();
                for u in taken.iter() {
                    let along: f64 = u.iter().zip(&v).map(|(u, v)| u * v).sum();
                    for (v, u) in v.iter_mut().zip(u) {
                        *v -= along * u;
                    }
                }
                let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
                let norm = length(&v);
                if norm > 0.0 && norm > MOST_SEEN * length(&whole) {
                    for x in &mut v {
                        *x /= norm;
                    }
                    taken.push(v.clone());
                    own.push((sample, v, norm));
                }
            }
            if own.is_empty() {
                continue;
            }
            let along = |k: usize, all: &DMatrix<f64>, column: usize| -> f64 {
                let (sample, u, _) = &own[k];
                let of = u.iter().enumerate();
                of.map(|(a, u)| u * all[(a * n + sample, column)]).sum()
            };
            let m = own.len();
            let mut own_base = DMatrix::from_fn(m, base.ncols(), |k, c| along(k, base, c));
            for (mut column, whole) in own_base.column_iter_mut().zip(base.column_iter()) {
                let norm = column.norm();
                // Only rounding: the column does not act in this direction.
                if norm > MOST_SEEN * whole.norm() {
                    column.unscale_mut(norm);
                } else {
                    column.fill(0.0);
                }
            }
            let moves = DVector::from_iterator(m, own.iter().map(|o| o.2));
            all.push(Self {
                directions: vec![direction],
                unit: vec![(m as f64).sqrt() / moves.norm()],
                residual: DVector::from_fn(m, |k, _| along(k, residual, 0)),
                base: own_base,
                moves: DMatrix::from_columns(&[moves]),
                filter: None,
                floor: rounding::WRITTEN * rounding::WRITTEN,
                samples: own.into_iter().map(|o| o.0).collect(),
                measured: (0..m).collect(),
            });
        }
        all
    }

    /// Columns of the values at the knots in mm: in each direction those of both sides, then, of so many `sides` as two,
    /// in each those of half the reversal.
    pub(super) fn curve(&self, columns: &Columns, knots: &Knots, sides: usize) -> DMatrix<f64> {
        let directions = self.directions.len();
        let mut raw = DMatrix::zeros(self.samples.len(), sides * directions * knots.count);
        for (row, sample) in self.samples.iter().enumerate() {
            for (k, weight) in knots.weights(columns.q[*sample]) {
                for d in 0..directions {
                    let by = weight * self.moves[(row, d)] * self.unit[d];
                    raw[(row, d * knots.count + k)] += by;
                    if sides > 1 {
                        let at = (directions + d) * knots.count + k;
                        raw[(row, at)] += columns.dir[*sample] * by;
                    }
                }
            }
        }
        raw
    }

    /// All columns with the residual, whitened.
    pub(super) fn whitened(&self, curve: &DMatrix<f64>) -> Whitened {
        let (base, own) = (self.base.ncols(), curve.ncols());
        let mut all = self.base.clone().resize_horizontally(base + own + 1, 0.0);
        all.columns_mut(base, own).copy_from(curve);
        all.set_column(base + own, &self.residual);
        let mut white = all.clone();
        if let Some(filter) = &self.filter {
            filter.whiten(white.as_mut_slice());
        }
        Whitened {
            white,
            raw: self.filter.is_some().then_some(all),
            base,
            measured: self.samples.iter().map(|sample| (*sample, 1.0)).collect(),
            floor: self.floor,
        }
    }

    /// Estimates the noise from the residuals of the rows; whether it is slow.
    fn wander(&mut self, rows: &Rows, residuals: &DVector<f64>) -> bool {
        let own = rows.of_one_axis(&self.samples);
        let noise = Noise::estimate(None, &own, residuals, &self.base);
        let slow = noise.slow.map(|slow| Slow {
            rms_mm: [slow.rms_mm[0]; 3],
            ..slow
        });
        let sigma = noise.sigma_mm[0];
        let noise = Noise {
            slow,
            ..Noise::white(sigma)
        };
        if slow.is_some() {
            self.filter = Some(noise.filter_over(&own.times, &[0]));
            self.floor = (rounding::WRITTEN / sigma).powi(2);
        }
        slow.is_some()
    }

    /// The constant of a curve in a direction, in its unit, that moves the samples as a step of the base does.
    pub(super) fn as_constant(&self, step: &DVector<f64>) -> f64 {
        let moved = &self.base * step;
        let unit = DMatrix::from_columns(&[self.moves.column(0).scale(self.unit[0])]);
        Basis::new(&unit)
            .solve(&moved)
            .get(0)
            .copied()
            .unwrap_or(0.0)
    }
}
