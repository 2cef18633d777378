//! What a curve over a joint is fitted to: the residuals of a model along the joint's motion, across it and along its
//! axis, each a problem of its own with its own noise,
//!
//! ```text
//! y_d = J_d β_d + m_d (c_d(q) + dir h_d(q)) + e_d
//! ```
//!
//! `m_d`: mm by which the point moves for a unit of the curve (along a turning joint's motion its radius). The three are
//! orthogonal, so that a coordinate that was not measured, or was computed from the others, adds nothing to them.

use nalgebra::{DMatrix, DVector};

use crate::effects::curve::{DIRECTIONS, Knots};
use crate::effects::{EACH_DIRECTION, Term};
use crate::fit::noise::{Noise, SMALLEST_SIGMA_MM, Slow};
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::linear::Basis;
use crate::model::Model;

use super::likelihood::{NamesAlone, SIDES, Sums};

/// A longer session is thinned evenly to so many samples: there are hundreds for each knot then.
const MOST_SAMPLES: usize = 3000;
/// Most knots of a curve over a range.
pub(super) const MOST_KNOTS: usize = 61;
/// Values of the joint closer than this (rad or mm) are the same pose.
pub(super) const SAME: f64 = 1e-6;
/// A direction of which less than this share is left beside the others was not measured; a column of which less is
/// along a direction does nothing there.
const MEASURED: f64 = 1e-3;

/// With fewer different values of a joint no curve rivals a name.
const FEWEST_TO_RIVAL: usize = 10;

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
    /// The directions that were measured.
    pub(super) along: Vec<Along>,
}

/// One direction: a row for each sample in which it was measured.
pub(super) struct Along {
    /// Along the motion, the radius, the axis.
    pub(super) direction: usize,
    /// Which samples.
    pub(super) samples: Vec<usize>,
    /// A value of 1 at a knot, in rad or mm: it moves the samples by 1 mm, root mean square.
    pub(super) unit: f64,
    /// Residual, mm.
    pub(super) residual: DVector<f64>,
    /// Of what is fitted beside the curve, scaled to length 1.
    pub(super) names: DMatrix<f64>,
    /// mm by which a unit of the curve moves each sample.
    moves: DVector<f64>,
    /// Standard deviation of the white part and of the slow part, mm, and its time constant, s; where it wanders.
    slow: Option<[f64; 3]>,
    times: Vec<f64>,
}

impl<'a> Columns<'a> {
    /// Of the samples of a problem that count; `beside` says which terms of the model are fitted beside the curve,
    /// which takes nothing from them.
    pub(super) fn new(
        problem: &Problem<'a>,
        model: &Model,
        joint: usize,
        beside: impl Fn(&Term) -> bool,
    ) -> Self {
        let problem = problem.thinned(MOST_SAMPLES);
        let rows = Rows::of(&problem).seen_by(model);
        let probe = Term::absent(&EACH_DIRECTION, joint, 0.0);
        let model = model.with_term(probe.clone());
        let (mut residual, mut all) = rows.extract(&model);
        for row in 0..rows.len() {
            let mm = rows.mm(row);
            residual[row] *= mm;
            all.row_mut(row).scale_mut(mm);
        }
        let of = |pick: &dyn Fn(&Term) -> bool| -> Vec<usize> {
            let all = model.columns().enumerate();
            all.filter(|(_, (term, _))| pick(term))
                .map(|(k, _)| k)
                .collect()
        };
        let is_probe = |term: &Term| term.same_column(&probe);
        let directions = all.select_columns(&of(&is_probe));
        let names = all.select_columns(&of(&|term| !is_probe(term) && beside(term)));
        let q = rows.inputs.q[joint].to_vec();
        let dir = rows.inputs.dir[joint].as_deref();
        let dir = dir.map_or_else(|| vec![0.0; q.len()], <[f64]>::to_vec);
        let values = different(&q);
        Self {
            joint,
            along: Along::each(&rows, &directions, &names, &residual),
            rows,
            q,
            dir,
            values,
        }
    }

    pub(super) fn from(&self) -> f64 {
        self.q.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub(super) fn to(&self) -> f64 {
        self.q.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// Sets the noise of each direction by what is left of its samples; whether it wanders in any.
    pub(super) fn wander(&mut self, left: &[DVector<f64>]) -> bool {
        let mut slow = false;
        for (along, left) in self.along.iter_mut().zip(left) {
            slow |= along.wander(&self.rows, left);
        }
        slow
    }
}

impl Along {
    fn each(
        rows: &Rows,
        directions: &DMatrix<f64>,
        names: &DMatrix<f64>,
        residual: &DVector<f64>,
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
                let left = length(&v);
                if left > 0.0 && left > MEASURED * length(&whole) {
                    for x in &mut v {
                        *x /= left;
                    }
                    taken.push(v.clone());
                    own.push((sample, v, left));
                }
            }
            if own.is_empty() {
                continue;
            }
            let along = |k: usize, of: &dyn Fn(usize) -> f64| -> f64 {
                let (sample, u, _) = &own[k];
                u.iter()
                    .enumerate()
                    .map(|(a, u)| u * of(a * n + sample))
                    .sum()
            };
            let m = own.len();
            let mut beside =
                DMatrix::from_fn(m, names.ncols(), |k, c| along(k, &|row| names[(row, c)]));
            for (mut column, whole) in beside.column_iter_mut().zip(names.column_iter()) {
                let norm = column.norm();
                // What moves nothing in this direction leaves rounding there.
                if norm > MEASURED * whole.norm() {
                    column.unscale_mut(norm);
                } else {
                    column.fill(0.0);
                }
            }
            let moves = DVector::from_iterator(m, own.iter().map(|o| o.2));
            all.push(Self {
                direction,
                unit: (m as f64).sqrt() / moves.norm(),
                residual: DVector::from_fn(m, |k, _| along(k, &|row| residual[row])),
                names: beside,
                moves,
                slow: None,
                times: own.iter().map(|o| rows.times[o.0]).collect(),
                samples: own.into_iter().map(|o| o.0).collect(),
            });
        }
        all
    }

    /// Columns of the values at the knots in mm, those of both sides and those of half the reversal.
    pub(super) fn curve(&self, columns: &Columns, knots: &Knots) -> DMatrix<f64> {
        let mut raw = DMatrix::zeros(self.samples.len(), SIDES * knots.count);
        for (row, sample) in self.samples.iter().enumerate() {
            for (k, weight) in knots.weights(columns.q[*sample]) {
                let by = weight * self.moves[row] * self.unit;
                raw[(row, k)] += by;
                raw[(row, knots.count + k)] += columns.dir[*sample] * by;
            }
        }
        raw
    }

    /// Rows of the samples that `pick` picks.
    pub(super) fn rows(&self, pick: impl Fn(usize) -> bool) -> impl Iterator<Item = usize> {
        (0..self.samples.len()).filter(move |row| pick(self.samples[*row]))
    }

    /// Products over the rows that `keep` keeps, whitened where the noise wanders.
    pub(super) fn sums(&self, curve: &DMatrix<f64>, keep: impl Fn(usize) -> bool) -> Option<Sums> {
        let rows: Vec<usize> = self.rows(keep).collect();
        let mut b = curve.select_rows(&rows);
        let mut j = self.names.select_rows(&rows);
        let mut y = self.residual.select_rows(&rows);
        if let Some([sigma, rms, tau]) = self.slow {
            let times: Vec<f64> = rows.iter().map(|row| self.times[*row]).collect();
            let noise = Noise {
                sigma_mm: [sigma; 3],
                slow: Some(Slow {
                    rms_mm: [rms; 3],
                    time_constant_s: tau,
                }),
                ..Noise::white(sigma)
            };
            let filter = noise.filter_over(&times, &[0]);
            filter.whiten(b.as_mut_slice());
            filter.whiten(j.as_mut_slice());
            filter.whiten(y.as_mut_slice());
        }
        let rounded = self
            .slow
            .map_or(SMALLEST_SIGMA_MM, |[s, ..]| SMALLEST_SIGMA_MM / s);
        Sums::of(&b, &j, &y, rounded * rounded)
    }

    /// Sets the noise by what is left of the samples; whether it wanders.
    fn wander(&mut self, rows: &Rows, left: &DVector<f64>) -> bool {
        let noise = Noise::estimate(None, &rows.of_one_axis(&self.samples), left, &self.names);
        self.slow = noise
            .slow
            .map(|slow| [noise.sigma_mm[0], slow.rms_mm[0], slow.time_constant_s]);
        self.slow.is_some()
    }

    /// The constant by which what is fitted beside the curve moves without one.
    pub(super) fn constant_alone(&self) -> f64 {
        let none = DMatrix::zeros(self.samples.len(), 0);
        let step = self
            .sums(&none, |_| true)
            .map(|sums| NamesAlone::new(&sums).step);
        step.map_or(0.0, |step| self.as_constant(&step))
    }

    /// The constant of the curve, in its unit, that moves the samples as a step of what is fitted beside it does.
    pub(super) fn as_constant(&self, step: &DVector<f64>) -> f64 {
        let moved = &self.names * step;
        let unit = DMatrix::from_columns(&[self.moves.scale(self.unit)]);
        Basis::new(&unit)
            .solve(&moved)
            .get(0)
            .copied()
            .unwrap_or(0.0)
    }
}

/// Knots over the range and products of the columns of a curve common to both sides, in all directions together and
/// whitened by a noise, with all columns of a model beside them; `None` with too few values of the joint.
pub(super) fn together(
    problem: &Problem,
    noise: &Noise,
    model: &Model,
    joint: usize,
) -> Option<(Knots, Sums)> {
    let problem = problem.thinned(MOST_SAMPLES);
    let rows = Rows::of(&problem);
    let n = rows.samples.len();
    let probe = Term::absent(&EACH_DIRECTION, joint, 0.0);
    let with = model.with_term(probe.clone());
    let (mut residual, all) = rows.extract(&with);
    let is_probe: Vec<bool> = with.columns().map(|(t, _)| t.same_column(&probe)).collect();
    let (unit, own): (Vec<usize>, Vec<usize>) = (0..all.ncols()).partition(|k| is_probe[*k]);
    let (directions, mut names) = (all.select_columns(&unit), all.select_columns(&own));
    let q = &rows.inputs.q[joint];
    let values = different(q);
    if values.len() < FEWEST_TO_RIVAL {
        return None;
    }
    let knots = Knots {
        from: values[0],
        to: values[values.len() - 1],
        period: None,
        count: values.len().clamp(4, MOST_KNOTS),
    };
    let filter = noise.filter(&rows);
    // One unit of the curve moves a sample by one unit of its noise, root mean square.
    let mut white = directions.clone();
    filter.whiten(white.as_mut_slice());
    let size = |d: usize| (white.column(d).norm_squared() / n as f64).sqrt();
    let scale: [f64; DIRECTIONS] = std::array::from_fn(|d| match size(d) {
        size if size > 0.0 => 1.0 / size,
        _ => 0.0,
    });
    let mut curve = DMatrix::zeros(rows.len(), DIRECTIONS * knots.count);
    for (sample, q) in q.iter().enumerate() {
        for (k, weight) in knots.weights(*q) {
            for row in (sample..rows.len()).step_by(n) {
                for d in 0..DIRECTIONS {
                    curve[(row, d * knots.count + k)] += weight * scale[d] * directions[(row, d)];
                }
            }
        }
    }
    filter.whiten(curve.as_mut_slice());
    filter.whiten(names.as_mut_slice());
    filter.whiten(residual.as_mut_slice());
    for mut column in names.column_iter_mut() {
        let norm = column.norm();
        if norm > 0.0 {
            column.unscale_mut(norm);
        }
    }
    let sigma = rows.axes.iter().map(|a| noise.sigma_mm[*a]);
    let smallest = sigma.fold(f64::INFINITY, f64::min);
    let floor = (SMALLEST_SIGMA_MM / smallest).powi(2);
    let measured: Vec<usize> = (0..rows.len()).filter(|row| rows.has(*row)).collect();
    let [curve, names] = [curve, names].map(|all| all.select_rows(&measured));
    let sums = Sums::of(&curve, &names, &residual.select_rows(&measured), floor)?;
    Some((knots, sums))
}

/// Different values of a joint, in ascending order.
fn different(q: &[f64]) -> Vec<f64> {
    let mut values = q.to_vec();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() < SAME);
    values
}
