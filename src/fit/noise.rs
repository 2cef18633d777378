//! The noise of a measurement: white along each axis, plus a part that wanders slowly in time (a
//! tripod that settles, air, a tracker that warms up).
//!
//! ```text
//! y_a(t_k) = model + w_a(t_k) + ε_k,   ε ~ N(0, σ_a²),   E w_a(t) w_a(u) = s_a² exp(−|t − u|/τ)
//! ```
//!
//! The slow part is an Ornstein–Uhlenbeck process (a Matérn process of order ½), whose
//! state-space form makes a Kalman filter whiten any column at a cost linear in the number of
//! samples (Hartikainen & Särkkä 2010):
//!
//! ```text
//! a = exp(−Δt/τ),   P⁻ = a² P + s² (1 − a²),   S = P⁻ + σ²,   K = P⁻/S,
//! v = y − a m,      m ← a m + K v,             P = (1 − K) P⁻,  whitened = v/√S
//! ```
//!
//! Time is time: a pause counts as long as it took, and where the clock jumps back (a restart) the
//! process begins anew. Without a clock samples are taken as one unit of time apart.
//!
//! σ, s and τ are those of the largest restricted likelihood beside the columns of a fit
//! (Patterson & Thompson 1971): restricted, so that what the fit swallows is not held against the
//! noise.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::sessions::{Session, Sigma};

use super::regression::Rows;

/// A part of the noise that wanders slowly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slow {
    /// Root mean square along x, y, z, mm.
    pub rms_mm: [f64; 3],
    /// Time over which it forgets where it was, s (samples, where the session has no clock).
    pub time_constant_s: f64,
}

impl Slow {
    /// In words, where everything that has a name is in the model.
    pub fn says(&self) -> String {
        format!("the measuring frame wanders by {}", self.extent())
    }

    /// In words, where the model may lack what changes with time as the poses do.
    pub fn says_of_remaining_error(&self) -> String {
        format!(
            "a part of the remaining error goes on from sample to sample, {}: a diagnosis looks \
             for effects in it",
            self.extent()
        )
    }

    fn extent(&self) -> String {
        let length = self.rms_mm.iter().map(|s| s * s).sum::<f64>().sqrt();
        format!(
            "{length:.4} mm (root mean square) within {:.1} min",
            self.time_constant_s / 60.0
        )
    }
}

/// The size of the white noise as it is stated for the instrument, and as it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedNoise {
    /// As stated, root mean square over the axes, mm.
    pub stated_mm: f64,
    /// As found, mm.
    pub found_mm: f64,
}

/// Stated and found noise that differ by more than this factor are told.
const WORTH_TELLING: f64 = 1.15;

impl StatedNoise {
    /// Stated and found noise of the measured axes.
    pub fn of(stated: Sigma, found_mm: [f64; 3], axes: &[usize]) -> Self {
        let stated_mm = match stated {
            Sigma::Overall(sigma) => sigma,
            Sigma::PerAxis(sigma) => over(sigma, axes),
        };
        Self {
            stated_mm,
            found_mm: over(found_mm, axes),
        }
    }

    /// Whether the two differ by more than 15 %.
    pub fn differs(&self) -> bool {
        let ratio = self.found_mm / self.stated_mm;
        !(WORTH_TELLING.recip()..=WORTH_TELLING).contains(&ratio)
    }

    /// In words.
    pub fn says(&self) -> String {
        let Self {
            stated_mm,
            found_mm,
        } = self;
        format!(
            "σ = {found_mm:.4} mm as found, {stated_mm:.4} mm as stated for the instrument \
             ({:.2} times)",
            found_mm / stated_mm
        )
    }
}

/// Root mean square over some axes.
fn over(sigma: [f64; 3], axes: &[usize]) -> f64 {
    let sum: f64 = axes.iter().map(|a| sigma[*a].powi(2)).sum();
    (sum / axes.len().max(1) as f64).sqrt()
}

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// Standard deviation of the white part along x, y, z, mm.
    pub sigma_mm: [f64; 3],
    /// The slow part, where the residuals show one.
    pub slow: Option<Slow>,
    /// Whether the axes were found, or stated, to differ.
    pub unequal: bool,
    /// Twice the logarithm by which the slow part makes the residuals likelier.
    pub slow_evidence: f64,
    /// What else it may be, with its share of the probability: a time constant and the variances
    /// of the slow part in units of the white one's (all zero: white). Intervals average over it.
    pub(crate) alternatives: Vec<(f64, f64, [f64; 3])>,
}

/// Twice the logarithm of a likelihood ratio (two degrees of freedom) from which on the axes
/// differ: p < 0.0004.
const UNEQUAL_EVIDENCE: f64 = 16.0;
/// Ratios of axes beyond this are something that the model lacks, not noise.
const MOST_UNEQUAL: f64 = 10.0;
/// With fewer samples neither axes nor a slow part are told apart.
const FEWEST_SAMPLES: usize = 20;
/// Twice the logarithm of the likelihood ratio from which on a slow part is there. A time constant
/// and a size for each axis on the boundary of their range: white noise exceeds it in about one
/// session of a hundred (`hidden_effects noise`).
const SLOW_EVIDENCE: f64 = 12.0;
/// Below this noise is rounding, mm.
pub const SMALLEST_SIGMA_MM: f64 = 1e-6;
/// Variances of the slow part that are tried first, in units of the white part's.
const RATIOS: [f64; 4] = [0.1, 0.6, 4.0, 60.0];
/// The largest: what is left of the white part is a thousandth.
const MOST_RATIO: f64 = 1e3;

impl Noise {
    /// White noise of one size on all axes.
    pub fn white(sigma_mm: f64) -> Self {
        Self {
            sigma_mm: [sigma_mm; 3],
            slow: None,
            unequal: false,
            slow_evidence: 0.0,
            alternatives: Vec::new(),
        }
    }

    /// This noise beside the one that is stated for the instrument, where one is.
    pub fn against_stated(&self, session: &Session) -> Option<StatedNoise> {
        let stated = session.instrument.sigma_mm?;
        let planar = session.samples.z_mm.is_none();
        let axes = if planar { &[0, 1][..] } else { &[0, 1, 2] };
        Some(StatedNoise::of(stated, self.sigma_mm, axes))
    }

    /// From raw residuals and the columns of the fit that left them.
    pub fn estimate(
        stated: Option<Sigma>,
        rows: &Rows,
        residual: &DVector<f64>,
        columns: &DMatrix<f64>,
    ) -> Self {
        let mut noise = Self::white(1.0);
        if let Some(Sigma::PerAxis(sigma)) = stated {
            noise.sigma_mm = sigma;
            noise.unequal = true;
        }
        if rows.is_empty() {
            return noise;
        }
        let restricted = Restricted::new(rows, residual, columns);
        let mut sums = restricted.sums(0.0, [0.0; 3]);
        let enough = rows.samples.len() >= FEWEST_SAMPLES;
        if enough {
            noise.balance_axes(&restricted, &sums);
            let white = restricted.likelihood(&sums, &noise.sigma_mm);
            let (best, tried) = noise.slowest(&restricted, white);
            noise.alternatives = alternatives(white, &tried);
            if let Some((likelihood, tau, ratio)) = best {
                noise.slow_evidence = 2.0 * (likelihood - white);
                if noise.slow_evidence > SLOW_EVIDENCE {
                    sums = restricted.sums(tau, ratio);
                    noise.balance_axes(&restricted, &sums);
                    let rms = |a: usize| ratio[a].sqrt() * noise.sigma_mm[a];
                    noise.slow = Some(Slow {
                        rms_mm: [rms(0), rms(1), rms(2)],
                        time_constant_s: tau,
                    });
                }
            }
        }
        let scale = restricted
            .scale(&sums, &noise.sigma_mm)
            .max(SMALLEST_SIGMA_MM);
        noise.scaled(scale)
    }

    /// Noise of the same size that is known to be white.
    #[must_use]
    pub fn made_white(&self) -> Self {
        let slow = self.slow.map_or([0.0; 3], |s| s.rms_mm);
        let total = |axis: usize| self.sigma_mm[axis].hypot(slow[axis]);
        Self {
            sigma_mm: [total(0), total(1), total(2)],
            slow: None,
            alternatives: Vec::new(),
            ..self.clone()
        }
    }

    /// The same noise so many times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut noise = self.clone();
        noise.sigma_mm = noise.sigma_mm.map(|s| s * factor);
        if let Some(slow) = &mut noise.slow {
            slow.rms_mm = slow.rms_mm.map(|s| s * factor);
        }
        noise
    }

    /// Sizes of the axes relative to each other, where they clearly differ.
    fn balance_axes(&mut self, restricted: &Restricted, sums: &[AxisSums]) {
        let mut stated = self.unequal;
        for _ in 0..2 {
            let spread = restricted.spread(sums, &self.sigma_mm);
            let freedom: f64 = spread.iter().map(|s| s.1).sum();
            let pooled = spread.iter().map(|s| s.0 * s.1).sum::<f64>() / freedom.max(1.0);
            if pooled.sqrt() < SMALLEST_SIGMA_MM {
                return;
            }
            let ratio = |s: f64| (s / pooled).max(1e-6);
            let evidence: f64 = spread.iter().map(|s| -s.1 * ratio(s.0).ln()).sum();
            if stated || !self.unequal && evidence < UNEQUAL_EVIDENCE {
                return;
            }
            stated = false;
            self.unequal = true;
            for (axis, s) in restricted.axes.iter().zip(&spread) {
                self.sigma_mm[*axis] *= ratio(s.0).sqrt();
            }
            let largest = self.sigma_mm.iter().copied().fold(0.0, f64::max);
            self.sigma_mm = self.sigma_mm.map(|s| s.max(largest / MOST_UNEQUAL));
        }
    }

    /// Likelihood, time constant and variance ratios of the likeliest slow part, and of those on an
    /// even grid.
    fn slowest(&self, restricted: &Restricted, white: f64) -> (Option<Trial>, Vec<Trial>) {
        let at = |tau: f64, ratio: [f64; 3]| {
            let sums = restricted.sums(tau, ratio);
            restricted.likelihood(&sums, &self.sigma_mm)
        };
        let (shortest, longest) = restricted.times();
        let mut best: Option<Trial> = None;
        let mut tried: Vec<Trial> = Vec::new();
        let mut keep = |tau: f64, ratio: [f64; 3]| {
            let value = at(tau, ratio);
            if tried.len() < GRID {
                tried.push((value, tau, ratio));
            }
            let better = value.is_finite() && best.is_none_or(|b| value > b.0);
            if better {
                best = Some((value, tau, ratio));
            }
            (better, best)
        };
        // A first look decides whether to look closer.
        let steps = ((longest / shortest).ln() / 4.0_f64.ln()).ceil().max(1.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small whole number"
        )]
        let steps_whole = steps as usize;
        let times: Vec<f64> = (0..=steps_whole)
            .map(|k| shortest * (longest / shortest).powf(k as f64 / steps))
            .collect();
        for tau in &times {
            keep(*tau, [RATIOS[1]; 3]);
        }
        let (_, first) = keep(times[0], [RATIOS[2]; 3]);
        if first.is_none_or(|b| b.0 < white - 4.0) {
            return (None, Vec::new());
        }
        for tau in &times {
            for ratio in [RATIOS[0], RATIOS[2], RATIOS[3]] {
                keep(*tau, [ratio; 3]);
            }
        }
        let (_, mut now) = keep(times[0], [RATIOS[1]; 3]);
        for factor in [2.0_f64, 1.4, 1.2] {
            let Some((_, tau, ratio)) = now else { break };
            for by in [factor, 1.0 / factor] {
                keep((tau * by).clamp(0.5 * shortest, longest), ratio);
            }
            let Some((_, tau, mut ratio)) = keep(tau, ratio).1 else {
                break;
            };
            for axis in &restricted.axes {
                for by in [factor * factor, 1.0 / (factor * factor), 0.0] {
                    let mut trial = ratio;
                    trial[*axis] = (ratio[*axis] * by).clamp(0.0, MOST_RATIO);
                    if let (true, Some(b)) = keep(tau, trial) {
                        ratio = b.2;
                    }
                }
            }
            now = keep(tau, ratio).1;
        }
        // Everything up to here was the grid and the first look, which lies on it.
        tried.truncate(4 * times.len() + 1);
        (now, tried)
    }

    /// The noises that the residuals allow besides, with their shares; intervals are averaged over
    /// them. The first is this one where it is the only one.
    pub(crate) fn possible(&self) -> Vec<(f64, Self)> {
        let one = |(share, tau, ratio): &(f64, f64, [f64; 3])| {
            let rms = |axis: usize| ratio[axis].sqrt() * self.sigma_mm[axis];
            let slow = (ratio.iter().any(|r| *r > 0.0)).then(|| Slow {
                rms_mm: [rms(0), rms(1), rms(2)],
                time_constant_s: *tau,
            });
            let noise = Self {
                slow,
                alternatives: Vec::new(),
                ..self.clone()
            };
            (*share, noise)
        };
        self.alternatives.iter().map(one).collect()
    }

    /// The filter that whitens rows.
    pub fn filter(&self, rows: &Rows) -> Filter {
        self.filter_over(&rows.times, &rows.axes)
    }

    /// The filter for samples at these times.
    pub fn filter_over(&self, times: &[f64], axes: &[usize]) -> Filter {
        let one = |axis: &usize| match self.slow {
            Some(slow) if slow.rms_mm[*axis] > 0.0 => {
                let sigma = self.sigma_mm[*axis];
                Axis::Slow(steps(
                    times,
                    slow.time_constant_s,
                    sigma,
                    slow.rms_mm[*axis],
                ))
            }
            _ => Axis::White(1.0 / self.sigma_mm[*axis]),
        };
        Filter {
            axes: axes.iter().map(one).collect(),
            samples: times.len(),
        }
    }

    /// Whitened columns.
    pub fn whitened(&self, rows: &Rows, raw: &DMatrix<f64>) -> DMatrix<f64> {
        let mut white = raw.clone();
        self.filter(rows).whiten(white.as_mut_slice());
        white
    }

    /// A whitened vector.
    pub fn whitened_vector(&self, rows: &Rows, raw: &DVector<f64>) -> DVector<f64> {
        let mut white = raw.clone();
        self.filter(rows).whiten(white.as_mut_slice());
        white
    }

    /// Whether two estimates whiten alike, within what estimates from a few hundred samples differ.
    pub fn whitens_like(&self, other: &Self) -> bool {
        let share = |n: &Self| n.correlation(0.0);
        let time = |n: &Self| n.slow.map_or(0.0, |s| s.time_constant_s.ln());
        let size = |n: &Self, axis: usize| {
            let total = n.total_mm(&[0, 1, 2]).max(SMALLEST_SIGMA_MM);
            (n.sigma_mm[axis] / total).max(1e-3).ln()
        };
        self.slow.is_some() == other.slow.is_some()
            && (share(self) - share(other)).abs() < 0.1
            && (time(self) - time(other)).abs() < 0.5
            && (0..3).all(|axis| (size(self, axis) - size(other, axis)).abs() < 0.05)
    }

    /// Root mean square of both parts over some axes, mm.
    pub fn total_mm(&self, axes: &[usize]) -> f64 {
        let one = |a: &usize| {
            let slow = self.slow.map_or(0.0, |s| s.rms_mm[*a]);
            self.sigma_mm[*a].powi(2) + slow * slow
        };
        (axes.iter().map(one).sum::<f64>() / axes.len().max(1) as f64).sqrt()
    }

    /// Correlation of the noise from one sample to the next, `step_s` apart.
    pub fn correlation(&self, step_s: f64) -> f64 {
        self.slow.map_or(0.0, |slow| {
            let (mut all, mut own) = (0.0, 0.0);
            for axis in 0..3 {
                let s2 = slow.rms_mm[axis].powi(2);
                own += s2;
                all += s2 + self.sigma_mm[axis].powi(2);
            }
            own / f64::max(all, f64::MIN_POSITIVE) * (-step_s / slow.time_constant_s).exp()
        })
    }
}

/// Likelihood, time constant and variances of the slow part in units of the white one's.
type Trial = (f64, f64, [f64; 3]);

/// More points of the grid are not kept.
const GRID: usize = 80;
/// Alternatives below this share of the likeliest say nothing …
const LEAST_SHARE: f64 = 0.03;
/// … and more than so many cost more than they say.
const MOST_ALTERNATIVES: usize = 8;
/// What a slow part pays beforehand against white noise, as a logarithm: hardly anything. An interval
/// that allows for a slow part that is not there is a little too wide, one that does not is far too
/// narrow (`hidden_effects intervals`).
const PRICE_OF_A_SLOW_PART: f64 = 1.0;

/// Shares of the probability: white noise against the points of the grid together.
fn alternatives(white: f64, tried: &[Trial]) -> Vec<(f64, f64, [f64; 3])> {
    if tried.is_empty() {
        return Vec::new();
    }
    let each = PRICE_OF_A_SLOW_PART + (tried.len() as f64).ln();
    let slow = tried.iter().map(|(l, tau, ratio)| (l - each, *tau, *ratio));
    let mut all: Vec<Trial> = [(white, 1.0, [0.0; 3])].into_iter().chain(slow).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let largest = all[0].0;
    all.retain(|a| (a.0 - largest).exp() > LEAST_SHARE);
    all.truncate(MOST_ALTERNATIVES);
    let total: f64 = all.iter().map(|a| (a.0 - largest).exp()).sum();
    all.iter()
        .map(|(l, tau, ratio)| ((l - largest).exp() / total, *tau, *ratio))
        .collect()
}

/// What one sample does in the filter of an axis.
#[derive(Debug, Clone, Copy, Default)]
pub struct Step {
    /// How much of the state is left from the sample before.
    pub carry: f64,
    /// How much of what is new goes into the state.
    pub gain: f64,
    /// One over the standard deviation of what is new.
    pub inverse_spread: f64,
}

#[derive(Debug, Clone)]
enum Axis {
    White(f64),
    Slow(Vec<Step>),
}

/// Whitens columns, axis by axis.
#[derive(Debug, Clone)]
pub struct Filter {
    axes: Vec<Axis>,
    samples: usize,
}

/// Columns that go through the filter together, so that they do not wait for one another.
const TOGETHER: usize = 8;

impl Filter {
    /// Whitens columns of rows, one column after the other, an axis after the other in each.
    pub fn whiten(&self, values: &mut [f64]) {
        let n = self.samples;
        let m = n * self.axes.len();
        if m == 0 {
            return;
        }
        for columns in values.chunks_mut(m * TOGETHER) {
            let count = columns.len() / m;
            for (a, axis) in self.axes.iter().enumerate() {
                match axis {
                    Axis::White(scale) => {
                        for column in columns.chunks_mut(m) {
                            for value in &mut column[a * n..(a + 1) * n] {
                                *value *= scale;
                            }
                        }
                    }
                    Axis::Slow(steps) => {
                        let mut state = [0.0; TOGETHER];
                        for (k, step) in steps.iter().enumerate() {
                            for (c, state) in state.iter_mut().enumerate().take(count) {
                                let value = &mut columns[c * m + a * n + k];
                                let new = *value - step.carry * *state;
                                *state = step.carry * *state + step.gain * new;
                                *value = new * step.inverse_spread;
                            }
                        }
                    }
                }
            }
        }
    }

    /// Logarithm of the determinant of the covariance that the filter takes out.
    pub fn ln_determinant(&self) -> f64 {
        let one = |axis: &Axis| match axis {
            Axis::White(scale) => -2.0 * self.samples as f64 * scale.ln(),
            Axis::Slow(steps) => steps.iter().map(|s| -2.0 * s.inverse_spread.ln()).sum(),
        };
        self.axes.iter().map(one).sum()
    }
}

/// The steps of a filter; see the module.
fn steps(times: &[f64], tau: f64, sigma: f64, rms: f64) -> Vec<Step> {
    let mut variance = rms * rms;
    let mut before = f64::NAN;
    let step = |time: &f64| {
        let carry = carried(*time - before, tau);
        before = *time;
        Step::after(carry, sigma, rms, &mut variance)
    };
    times.iter().map(step).collect()
}

/// How much of the state is left after so long. A clock that jumps back is a restart, after an
/// unknown time.
pub(super) fn carried(apart: f64, tau: f64) -> f64 {
    if apart >= 0.0 {
        (-apart / tau).exp()
    } else {
        0.0
    }
}

impl Step {
    /// The next step; `variance` is that of the state, before and after.
    #[inline]
    pub(super) fn after(carry: f64, sigma: f64, rms: f64, variance: &mut f64) -> Self {
        let (s2, white) = (rms * rms, sigma * sigma);
        let predicted = carry * carry * *variance + s2 * (1.0 - carry * carry);
        let spread = predicted + white;
        *variance = predicted * white / spread;
        Self {
            carry,
            gain: predicted / spread,
            inverse_spread: 1.0 / spread.sqrt(),
        }
    }
}

/// Products of whitened columns along one axis.
struct AxisSums {
    gram: DMatrix<f64>,
    ln_determinant: f64,
}

/// The restricted likelihood of noise beside the columns of a fit.
struct Restricted<'r> {
    rows: &'r Rows,
    axes: Vec<usize>,
    /// For each axis its rows of columns and residual.
    parts: Vec<DMatrix<f64>>,
    p: usize,
}

impl<'r> Restricted<'r> {
    fn new(rows: &'r Rows, residual: &DVector<f64>, columns: &DMatrix<f64>) -> Self {
        // The same span, well conditioned, whatever the noise is.
        let basis = super::linear::Basis::new(columns).q;
        let p = basis.ncols();
        let mut all = basis.insert_column(p, 0.0);
        all.set_column(p, residual);
        let n = rows.samples.len();
        let part = |a: usize| all.rows(a * n, n).into_owned();
        Self {
            rows,
            axes: rows.axes.clone(),
            parts: (0..rows.axes.len()).map(part).collect(),
            p,
        }
    }

    /// Shortest and longest time constant that the samples can tell. What does not come back
    /// within the session cannot be told from an offset and a drift of the frame, which are effects.
    fn times(&self) -> (f64, f64) {
        let times = &self.rows.times;
        let mut apart: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
        apart.retain(|d| *d > 0.0);
        apart.sort_by(f64::total_cmp);
        let Some(middle) = apart.get(apart.len() / 2).copied() else {
            return (1.0, 1.0);
        };
        let total: f64 = apart.iter().sum();
        (middle, total.max(middle))
    }

    /// White part 1, slow part of these variances.
    fn sums(&self, tau: f64, ratio: [f64; 3]) -> Vec<AxisSums> {
        let one = |(part, axis): (&DMatrix<f64>, &usize)| {
            let mut noise = Noise::white(1.0);
            if ratio[*axis] > 0.0 {
                noise.slow = Some(Slow {
                    rms_mm: ratio.map(f64::sqrt),
                    time_constant_s: tau,
                });
            }
            let filter = noise.filter_over(&self.rows.times, &[*axis]);
            let mut white = part.clone();
            filter.whiten(white.as_mut_slice());
            AxisSums {
                gram: white.tr_mul(&white),
                ln_determinant: filter.ln_determinant(),
            }
        };
        self.parts.iter().zip(&self.axes).map(one).collect()
    }

    /// Gram matrix of all axes, its factor, and the step to the residual.
    fn solved(
        &self,
        sums: &[AxisSums],
        sigma: &[f64; 3],
    ) -> Option<(Cholesky<f64, nalgebra::Dyn>, DVector<f64>, f64)> {
        let p = self.p;
        let mut total = DMatrix::zeros(p + 1, p + 1);
        for (own, axis) in sums.iter().zip(&self.axes) {
            total += &own.gram / sigma[*axis].powi(2);
        }
        let inner = total.view((0, 0), (p, p)).into_owned();
        let pull = total.view((0, p), (p, 1)).column(0).into_owned();
        let factor = Cholesky::new(inner)?;
        let step = factor.solve(&pull);
        let left = total[(p, p)] - step.dot(&pull);
        Some((factor, step, left.max(0.0)))
    }

    fn freedom(&self) -> f64 {
        ((self.rows.len() as f64) - self.p as f64).max(1.0)
    }

    /// Standard deviation that is left, in units of σ.
    fn scale(&self, sums: &[AxisSums], sigma: &[f64; 3]) -> f64 {
        let solved = self.solved(sums, sigma);
        solved.map_or(0.0, |(_, _, left)| (left / self.freedom()).sqrt())
    }

    /// Variance along each axis in units of σ², with its degrees of freedom.
    fn spread(&self, sums: &[AxisSums], sigma: &[f64; 3]) -> Vec<(f64, f64)> {
        let p = self.p;
        let n = self.rows.samples.len() as f64;
        let Some((factor, step, _)) = self.solved(sums, sigma) else {
            return vec![(1.0, n); self.axes.len()];
        };
        let one = |(own, axis): (&AxisSums, &usize)| {
            let weight = 1.0 / sigma[*axis].powi(2);
            let inner = own.gram.view((0, 0), (p, p)).into_owned();
            let pull = own.gram.view((0, p), (p, 1)).column(0).into_owned();
            let square = own.gram[(p, p)] - 2.0 * step.dot(&pull) + step.dot(&(&inner * &step));
            let spent = factor.solve(&inner).trace() * weight;
            let freedom = (n - spent).max(1.0);
            (square.max(0.0) * weight / freedom, freedom)
        };
        sums.iter().zip(&self.axes).map(one).collect()
    }

    /// Logarithm, up to a constant, with the common size profiled out.
    fn likelihood(&self, sums: &[AxisSums], sigma: &[f64; 3]) -> f64 {
        let Some((factor, _, left)) = self.solved(sums, sigma) else {
            return f64::NEG_INFINITY;
        };
        let freedom = self.freedom();
        let variance = (left / freedom).max(SMALLEST_SIGMA_MM * SMALLEST_SIGMA_MM);
        let l = factor.l_dirty();
        let inner: f64 = (0..self.p).map(|k| 2.0 * l[(k, k)].ln()).sum();
        let n = self.rows.samples.len() as f64;
        let outer: f64 = sums
            .iter()
            .zip(&self.axes)
            .map(|(own, axis)| own.ln_determinant + 2.0 * n * sigma[*axis].ln())
            .sum();
        -0.5 * (freedom * variance.ln() + inner + outer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The whitening of the filter is that of the dense covariance's Cholesky factor.
    #[test]
    fn the_filter_whitens_as_the_dense_covariance_does() {
        let times = [0.0, 2.0, 3.0, 3600.0, 3601.0, 3.0, 9.0];
        let (tau, sigma, rms) = (5.0, 0.3, 0.7);
        // The sixth sample comes after a restart.
        let part = |k: usize| usize::from(k >= 5);
        let covariance = DMatrix::from_fn(7, 7, |i, j| {
            let together = if part(i) == part(j) {
                let apart: f64 = times[i] - times[j];
                rms * rms * (-apart.abs() / tau).exp()
            } else {
                0.0
            };
            together + if i == j { sigma * sigma } else { 0.0 }
        });
        let noise = Noise {
            sigma_mm: [sigma; 3],
            slow: Some(Slow {
                rms_mm: [rms; 3],
                time_constant_s: tau,
            }),
            unequal: false,
            slow_evidence: 0.0,
            alternatives: Vec::new(),
        };
        let filter = noise.filter_over(&times, &[0]);
        let y = DVector::from_fn(7, |k, _| (k as f64 + 1.0).sin());
        let mut white = y.clone();
        filter.whiten(white.as_mut_slice());
        let factor = covariance.clone().cholesky().unwrap();
        let expected = factor.l().solve_lower_triangular(&y).unwrap();
        assert!((white - expected).norm() < 1e-9);
        assert!((filter.ln_determinant() - covariance.determinant().ln()).abs() < 1e-9);
    }
}
