//! Noise with a part that is slow in time, and outliers of a stated size, with what was drawn on
//! record. The rig's own kinds of noise stay in `Rig::measure`.

use super::{Random, Rig};

/// How the slow part moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path {
    /// Ornstein–Uhlenbeck, Matérn 1/2: rough, stationary.
    Rough,
    /// Matérn 3/2: smooth, stationary.
    Smooth,
    /// A random walk: it never comes back.
    Walk,
}

/// The part that is slow in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slow {
    pub path: Path,
    /// Its share of the whole variance; of a walk, on average over a session.
    pub share: f64,
    pub time_constant_s: f64,
    /// Sizes along x, y and z beside one another.
    pub axes: [f64; 3],
}

impl Slow {
    /// 10 to 50 % of the variance, 30 to 600 s, in half of the sessions unlike along the axes.
    pub fn random(path: Path, random: &mut Random) -> Self {
        let share = random.between(0.1, 0.5);
        let time_constant_s = 30.0 * 20.0_f64.powf(random.unit());
        let mut axes = [1.0; 3];
        if random.unit() < 0.5 {
            axes = of_unit_square(axes.map(|_| random.between(0.3, 1.7)));
        }
        Self {
            path,
            share,
            time_constant_s,
            axes,
        }
    }

    /// A path of unit variance at these times.
    fn drawn(&self, times: &[f64], random: &mut Random) -> Vec<f64> {
        match self.path {
            Path::Rough => along(times, random.normal(), |x, dt| {
                let carry = (-dt / self.time_constant_s).exp();
                carry * x + (1.0 - carry * carry).sqrt() * random.normal()
            }),
            Path::Smooth => {
                let rate = 3.0_f64.sqrt() / self.time_constant_s;
                // Value and slope over the rate: both of unit variance, independent at one time.
                let start = (random.normal(), random.normal());
                let path = along(times, start, |at, dt| smooth_step(at, rate * dt, random));
                path.into_iter().map(|at| at.0).collect()
            }
            Path::Walk => {
                let all = times.last().unwrap_or(&0.0) - times.first().unwrap_or(&0.0);
                let path = along(times, 0.0, |x, dt| {
                    // About its own mean a walk of variance q·t has q·T/6.
                    x + (6.0 * dt / all.max(1e-9)).sqrt() * random.normal()
                });
                let mean = path.iter().sum::<f64>() / path.len().max(1) as f64;
                path.into_iter().map(|x| x - mean).collect()
            }
        }
    }
}

/// Outliers: how many, and how long in units of each axis' σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outliers {
    pub share: f64,
    pub sigmas: [f64; 2],
    /// How many of them lie along one axis alone.
    pub along_one: f64,
}

/// What a session is measured with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// σ along x, y and z over that of the design.
    pub axes: [f64; 3],
    pub slow: Option<Slow>,
    pub outliers: Option<Outliers>,
}

/// White, of the design's σ.
pub const WHITE: Noise = Noise {
    axes: [1.0; 3],
    slow: None,
    outliers: None,
};

/// σ along x, y and z as `Kind::Unequal` has it.
pub const UNEQUAL: [f64; 3] = [0.5, 1.0, 1.33];

/// σ along x, y and z at random, up to some five times apart, of root mean square 1.
pub fn any_axes(random: &mut Random) -> [f64; 3] {
    of_unit_square([0; 3].map(|_| 0.2 * 5.0_f64.powf(random.unit())))
}

fn of_unit_square(axes: [f64; 3]) -> [f64; 3] {
    let square: f64 = axes.iter().map(|a| a * a / 3.0).sum();
    axes.map(|a| a / square.sqrt())
}

/// What was drawn.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Root mean square length of the noise, without the outliers, mm.
    pub noise_mm: f64,
    /// Which samples are outliers.
    pub outlier: Vec<bool>,
}

impl Rig {
    /// Measures all shots with this noise.
    pub fn measure_with(&mut self, noise: &Noise, random: &mut Random) -> Drawn {
        let sigma = self.design.sigma_mm;
        let times: Vec<f64> = self.shots.iter().map(|s| s.time).collect();
        let share = noise.slow.map_or(0.0, |s| s.share);
        let slow = noise.slow.map(|slow| {
            let size = |axis: usize| slow.axes[axis] * slow.share.sqrt();
            [0, 1, 2].map(|axis| -> Vec<f64> {
                let path = slow.drawn(&times, random);
                path.into_iter().map(|x| x * size(axis)).collect()
            })
        });
        let white = (1.0 - share).sqrt();
        let mut drawn = Drawn {
            noise_mm: 0.0,
            outlier: Vec::new(),
        };
        let mut measured = Vec::new();
        for (i, shot) in self.shots.iter().enumerate() {
            let mut p = self.point(shot, &self.hidden);
            for (axis, value) in p.iter_mut().enumerate() {
                let wander = slow.as_ref().map_or(0.0, |s| s[axis][i]);
                let e = sigma * noise.axes[axis] * (white * random.normal() + wander);
                drawn.noise_mm += e * e;
                *value += e;
            }
            let outlier = noise.outliers.filter(|o| random.unit() < o.share);
            drawn.outlier.push(outlier.is_some());
            if let Some(Outliers {
                sigmas, along_one, ..
            }) = outlier
            {
                let mut v = [random.normal(), random.normal(), random.normal()];
                if random.unit() < along_one {
                    let alone = random.below(3);
                    (0..3).for_each(|axis| v[axis] *= f64::from(u8::from(axis == alone)));
                }
                let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
                let length = random.between(sigmas[0], sigmas[1]);
                for axis in 0..3 {
                    p[axis] += length * sigma * noise.axes[axis] * v[axis] / norm;
                }
            }
            measured.push(p);
        }
        drawn.noise_mm = (drawn.noise_mm / self.shots.len().max(1) as f64).sqrt();
        self.measured = measured;
        drawn
    }
}

/// States at these times, each made of the one before and the time between.
fn along<S: Copy>(times: &[f64], start: S, mut on: impl FnMut(S, f64) -> S) -> Vec<S> {
    let mut at = start;
    let mut all = Vec::new();
    for (i, time) in times.iter().enumerate() {
        if i > 0 {
            at = on(at, time - times[i - 1]);
        }
        all.push(at);
    }
    all
}

/// Matérn 3/2 over a step of `h` = rate · dt, exactly: with y = ẋ/rate,
///
/// ```text
/// F = e^(−h) (1 + h, h; −h, 1 − h),   Q = 1 − F Fᵀ
/// ```
fn smooth_step((x, y): (f64, f64), h: f64, random: &mut Random) -> (f64, f64) {
    let e = (-h).exp();
    let f = [[e * (1.0 + h), e * h], [-e * h, e * (1.0 - h)]];
    let q =
        |i: usize, j: usize| f64::from(u8::from(i == j)) - f[i][0] * f[j][0] - f[i][1] * f[j][1];
    // Cholesky factor of Q.
    let a = q(0, 0).max(0.0).sqrt();
    let b = if a > 0.0 { q(0, 1) / a } else { 0.0 };
    let c = (q(1, 1) - b * b).max(0.0).sqrt();
    let (u, v) = (random.normal(), random.normal());
    (
        f[0][0] * x + f[0][1] * y + a * u,
        f[1][0] * x + f[1][1] * y + b * u + c * v,
    )
}
