//! Repeatability: at every pose each joint is off by an error of its own, which all rows that are measured before the
//! robot moves again share.
//!
//! ```text
//! y_k = model + J_k δ_p + w(t_k) + ε_k,   δ_p ~ N(0, s²) for each joint anew at each pose p
//! ```
//!
//! `J_k` is the derivative of a row with respect to the joints, so that an error of a joint is longer the farther the
//! reflector is from it. δ is a state in addition to that of the slow part `w`: one Kalman filter whitens all
//! coordinates of the samples in turn, and resets δ at a new pose. With h the derivatives of a row with respect to the
//! states:
//!
//! ```text
//! S = hᵀP h + σ²,   K = P h/S,   v = y − hᵀm,   m ← m + K v,   P ← P − K (P h)ᵀ,   whitened = v/√S
//! ```

use super::Noise;
use crate::fit::levers::Moves;
use crate::lanes::TOGETHER;

/// Predicts one row after the other from those before: the covariance of the states on the way.
#[derive(Debug, Clone)]
pub(crate) struct Predictor {
    /// Joints come first, then the slow part along x, y, z, where there is one.
    joints: usize,
    pub(crate) states: usize,
    variance_of_joints: f64,
    sigma_mm: [f64; 3],
    slow_mm: [f64; 3],
    time_constant_s: f64,
    before: Option<(f64, usize)>,
    covariance: Vec<f64>,
}

/// The change of the states before the rows of a sample are seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Passage {
    /// Whether the robot has moved.
    pub(crate) moved: bool,
    /// The decay of the slow part.
    pub(crate) decay: f64,
}

impl Predictor {
    pub(crate) fn new(noise: &Noise, joints: usize) -> Self {
        let states = joints + if noise.slow.is_some() { 3 } else { 0 };
        Self {
            joints,
            states,
            variance_of_joints: noise.joints_rad * noise.joints_rad,
            sigma_mm: noise.sigma_mm,
            slow_mm: noise.slow.map_or([0.0; 3], |slow| slow.rms_mm),
            time_constant_s: noise.slow.map_or(1.0, |slow| slow.time_constant_s),
            before: None,
            covariance: vec![0.0; states * states],
        }
    }

    /// Goes on to a sample of a pose.
    pub(crate) fn advance(&mut self, time: f64, pose: usize) -> Passage {
        let passage = Passage {
            moved: self.before.is_none_or(|before| before.1 != pose),
            decay: self
                .before
                .map_or(0.0, |before| decayed(time - before.0, self.time_constant_s)),
        };
        self.before = Some((time, pose));
        let (joints, states) = (self.joints, self.states);
        let retained = |state: usize| passage.retained(joints, state);
        for i in 0..states {
            for j in 0..states {
                self.covariance[i * states + j] *= retained(i) * retained(j);
            }
            let own = if i >= joints {
                self.slow_mm[i - joints].powi(2) * (1.0 - passage.decay * passage.decay)
            } else if passage.moved {
                self.variance_of_joints
            } else {
                0.0
            };
            self.covariance[i * states + i] += own;
        }
        passage
    }

    /// Processes one row of the sample along an axis: `row` has its derivatives with respect to the joints, and
    /// receives those with respect to all states, the gains, and one over the standard deviation of the innovation.
    pub(crate) fn take(&mut self, axis: usize, lever: impl Fn(usize) -> f64, row: &mut [f64]) {
        let states = self.states;
        let (derivatives, rest) = row.split_at_mut(states);
        for (state, h) in derivatives.iter_mut().enumerate() {
            *h = match state.checked_sub(self.joints) {
                None => lever(state),
                Some(slow) => f64::from(u8::from(slow == axis)),
            };
        }
        let (gains, spread) = rest.split_at_mut(states);
        for (i, gain) in gains.iter_mut().enumerate() {
            let own = &self.covariance[i * states..(i + 1) * states];
            *gain = own.iter().zip(&*derivatives).map(|(p, h)| p * h).sum();
        }
        let predicted: f64 = gains.iter().zip(&*derivatives).map(|(g, h)| g * h).sum();
        let variance = predicted.max(0.0) + self.sigma_mm[axis].powi(2);
        for i in 0..states {
            for j in 0..states {
                self.covariance[i * states + j] -= gains[i] * gains[j] / variance;
            }
        }
        for gain in &mut *gains {
            *gain /= variance;
        }
        spread[0] = 1.0 / variance.sqrt();
    }

    /// Numbers of a row.
    pub(crate) fn width(&self) -> usize {
        2 * self.states + 1
    }

    /// The states of a column after the passage to another sample.
    pub(crate) fn pass(&self, passage: Passage, states: &mut [f64]) {
        passage.through(self.joints, states);
    }
}

impl Passage {
    fn retained(self, joints: usize, state: usize) -> f64 {
        match (state < joints, self.moved) {
            (true, true) => 0.0,
            (true, false) => 1.0,
            (false, _) => self.decay,
        }
    }

    fn through(self, joints: usize, states: &mut [f64]) {
        for (state, value) in states.iter_mut().enumerate() {
            *value *= self.retained(joints, state);
        }
    }

    fn through_all(self, joints: usize, states: &mut [Together]) {
        for (state, values) in states.iter_mut().enumerate() {
            let retained = self.retained(joints, state);
            *values = values.map(|value| value * retained);
        }
    }
}

/// The decay of the state after so long. A clock that jumps back is a restart, after an unknown time.
pub(crate) fn decayed(apart: f64, tau: f64) -> f64 {
    if apart >= 0.0 {
        (-apart / tau).exp()
    } else {
        0.0
    }
}

/// The whitened innovation of a value of a row given the states of its column; the states are updated.
#[inline]
pub(crate) fn whitened(row: &[f64], states: &mut [f64], value: f64) -> f64 {
    let (derivatives, rest) = row.split_at(states.len());
    let (gains, spread) = rest.split_at(states.len());
    let known: f64 = derivatives.iter().zip(&*states).map(|(h, m)| h * m).sum();
    let new = value - known;
    for (state, gain) in states.iter_mut().zip(gains) {
        *state += gain * new;
    }
    new * spread[0]
}

/// Values of columns that go through the filter together: so they are added a vector at a time.
type Together = [f64; TOGETHER];

/// Some columns, one after the other.
struct Columns<'v> {
    values: &'v mut [f64],
    height: usize,
}

fn gathered(columns: &Columns, row: usize) -> Together {
    let mut own = [0.0; TOGETHER];
    for (own, column) in own.iter_mut().zip(columns.values.chunks(columns.height)) {
        *own = column[row];
    }
    own
}

fn scatter(columns: &mut Columns, row: usize, own: Together) {
    for (own, column) in own.iter().zip(columns.values.chunks_mut(columns.height)) {
        column[row] = *own;
    }
}

#[inline]
fn add(to: &mut Together, factor: f64, own: &Together) {
    for (to, own) in to.iter_mut().zip(own) {
        *to += factor * own;
    }
}

/// The filter of some rows, axis after axis of all samples.
#[derive(Debug, Clone)]
pub(crate) struct JointFilter {
    joints: usize,
    states: usize,
    axes: usize,
    passages: Vec<Passage>,
    /// Sample by sample, axis by axis.
    rows: Vec<f64>,
}

impl JointFilter {
    pub(crate) fn new(noise: &Noise, times: &[f64], axes: &[usize], moves: &Moves) -> Self {
        let n = times.len();
        let mut predictor = Predictor::new(noise, moves.levers.ncols());
        let width = predictor.width();
        let mut rows = vec![0.0; n * axes.len() * width];
        let mut each = rows.chunks_mut(width);
        let mut passages = Vec::with_capacity(n);
        for (k, (time, pose)) in times.iter().zip(&moves.poses).enumerate() {
            passages.push(predictor.advance(*time, *pose as usize));
            for (a, axis) in axes.iter().enumerate() {
                let lever = |joint: usize| moves.levers[(a * n + k, joint)];
                if let Some(row) = each.next() {
                    predictor.take(*axis, lever, row);
                }
            }
        }
        Self {
            joints: predictor.joints,
            states: predictor.states,
            axes: axes.len(),
            passages,
            rows,
        }
    }

    /// Of a row the derivatives with respect to the states, the gains, and one over the standard deviation of the
    /// innovation.
    fn parts(&self, sample: usize, axis: usize) -> (&[f64], &[f64], f64) {
        let width = 2 * self.states + 1;
        let at = (sample * self.axes + axis) * width;
        let (derivatives, rest) = self.rows[at..at + width].split_at(self.states);
        let (gains, spread) = rest.split_at(self.states);
        (derivatives, gains, spread[0])
    }

    /// Whitens columns of rows.
    pub(crate) fn whiten(&self, values: &mut [f64]) {
        let n = self.passages.len();
        self.through(values, |columns, states| {
            for (k, passage) in self.passages.iter().enumerate() {
                passage.through_all(self.joints, states);
                for a in 0..self.axes {
                    let (derivatives, gains, spread) = self.parts(k, a);
                    let mut new = gathered(columns, a * n + k);
                    for (h, state) in derivatives.iter().zip(&*states) {
                        add(&mut new, -h, state);
                    }
                    for (gain, state) in gains.iter().zip(&mut *states) {
                        add(state, *gain, &new);
                    }
                    scatter(columns, a * n + k, new.map(|new| new * spread));
                }
            }
        });
    }

    /// The transposed of [`whiten`](Self::whiten), from the last row back:
    ///
    /// ```text
    /// y_k = z_k/√S_k + Kᵀλ,   λ ← λ − h y_k
    /// ```
    pub(crate) fn whiten_transposed(&self, values: &mut [f64]) {
        let n = self.passages.len();
        self.through(values, |columns, later| {
            for (k, passage) in self.passages.iter().enumerate().rev() {
                for a in (0..self.axes).rev() {
                    let (derivatives, gains, spread) = self.parts(k, a);
                    let mut own = gathered(columns, a * n + k).map(|z| z * spread);
                    for (gain, later) in gains.iter().zip(&*later) {
                        add(&mut own, *gain, later);
                    }
                    for (h, later) in derivatives.iter().zip(&mut *later) {
                        add(later, -h, &own);
                    }
                    scatter(columns, a * n + k, own);
                }
                passage.through_all(self.joints, later);
            }
        });
    }

    /// Hands some columns on at a time, each with the states of all, which begin at nothing.
    fn through(&self, values: &mut [f64], pass: impl Fn(&mut Columns, &mut [Together])) {
        let height = (self.passages.len() * self.axes).max(1);
        let mut states = vec![[0.0; TOGETHER]; self.states];
        for values in values.chunks_mut(height * TOGETHER) {
            states.fill([0.0; TOGETHER]);
            pass(&mut Columns { values, height }, &mut states);
        }
    }

    /// Logarithm of the determinant of the covariance that the filter takes out.
    pub(crate) fn ln_determinant(&self) -> f64 {
        let spreads = self.rows.chunks(2 * self.states + 1);
        spreads.map(|row| -2.0 * row[2 * self.states].ln()).sum()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::fit::noise::Slow;

    /// The filter whitens as the Cholesky factor of the dense covariance does, of a robot that does not repeat exactly
    /// and a frame that drifts, and its transpose is the factor's transpose.
    #[test]
    fn the_filter_whitens_as_the_dense_covariance_does() {
        let poses = [0, 0, 0, 1, 2, 2, 3, 3];
        let times = [0.0, 2.0, 3.0, 30.0, 41.0, 44.0, 3.0, 9.0];
        let axes = [0, 1, 2];
        let (n, joints) = (poses.len(), 4);
        let levers = DMatrix::from_fn(3 * n, joints, |i, j| ((3 * i + 7 * j) as f64).sin());
        let moves = Moves {
            poses: poses.to_vec(),
            levers: levers.clone(),
        };
        let slow = Slow {
            rms_mm: [0.7, 0.0, 0.2],
            time_constant_s: 20.0,
        };
        for slow in [None, Some(slow)] {
            let noise = Noise {
                sigma_mm: [0.3, 0.2, 0.4],
                joints_rad: 0.9,
                slow,
                ..Noise::white(1.0)
            };
            // Along an axis, sample by sample: the order in which the filter takes them.
            let row = |i: usize| (i / 3, i % 3);
            let part = |k: usize| usize::from(k >= 6);
            let covariance = DMatrix::from_fn(3 * n, 3 * n, |i, j| {
                let ((k, a), (l, b)) = (row(i), row(j));
                let shared = |j: usize| levers[(a * n + k, j)] * levers[(b * n + l, j)];
                let joints: f64 = (0..joints).map(shared).sum();
                let of_pose = f64::from(u8::from(poses[k] == poses[l])) * 0.81 * joints;
                let wander = slow
                    .filter(|_| a == b && part(k) == part(l))
                    .map_or(0.0, |s| {
                        let apart: f64 = times[k] - times[l];
                        s.rms_mm[a].powi(2) * (-apart.abs() / s.time_constant_s).exp()
                    });
                let white = f64::from(u8::from(i == j)) * noise.sigma_mm[a].powi(2);
                of_pose + wander + white
            });
            let filter = JointFilter::new(&noise, &times, &axes, &moves);
            let y = DVector::from_fn(3 * n, |i, _| (i as f64 + 1.0).sin());
            let mut white = y.clone();
            filter.whiten(white.as_mut_slice());
            let in_turn =
                |v: &DVector<f64>| DVector::from_fn(3 * n, |i, _| v[row(i).1 * n + row(i).0]);
            let factor = covariance.clone().cholesky().unwrap();
            let expected = factor.l().solve_lower_triangular(&in_turn(&y)).unwrap();
            assert!((in_turn(&white) - expected).norm() < 1e-9);
            let determinant = factor.l().diagonal().map(f64::ln).sum() * 2.0;
            assert!((filter.ln_determinant() - determinant).abs() < 1e-9);
            let z = DVector::from_fn(3 * n, |k, _| (k as f64 * 1.7).cos());
            let mut turned = z.clone();
            filter.whiten_transposed(turned.as_mut_slice());
            assert!((turned.dot(&y) - z.dot(&white)).abs() < 1e-9);
        }
    }
}
