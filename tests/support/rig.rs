//! A rotary axis on paper, measured by a tracker on paper: exact geometry, written down once more
//! from the contract's table and sharing no code with the model. Sessions leave it as JSON text.

#![allow(dead_code, reason = "each test uses a part of the rig")]
#![allow(
    unreachable_pub,
    reason = "included in tests and in the benchmark alike"
)]
#![allow(
    clippy::struct_excessive_bools,
    clippy::too_many_lines,
    reason = "a design is a list of what is measured, the geometry one equation for each effect"
)]

#[path = "rig/designs.rs"]
pub mod designs;
#[path = "rig/noise.rs"]
pub mod noise;
#[path = "rig/shapes.rs"]
pub mod shapes;

use std::fmt::Write as _;

use shapes::Shape;

/// A small generator of random numbers (splitmix64 and Box–Muller).
#[derive(Clone)]
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }
    pub fn normal(&mut self) -> f64 {
        let r = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        r * (std::f64::consts::TAU * self.unit()).cos()
    }
    pub fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.next() % n as u64).expect("below a usize")
    }
}

/// What is hidden in a session.
#[derive(Clone, Debug, PartialEq)]
pub enum Hidden {
    Scale(f64),
    Eccentricity(f64, f64),
    TwoCycle(f64, f64),
    Gear(f64, f64, f64),
    Backlash(f64),
    LostMotion(f64, f64),
    Lag(f64),
    ThermalZero(f64),
    Compliance(f64),
    ThermalGrowth(f64),
    Runout(f64, f64, f64),
    Wobble(f64, f64, f64),
    Droop(f64),
    Tilt(f64, f64),
    BaseOffset([f64; 3]),
    InstrumentScale(f64),
    Shift(f64, [f64; 3]),
    Drift([f64; 3]),
    Bump(f64, f64, f64),
    Sawtooth(f64, f64),
    Plateau(f64, f64, f64),
    Shape(Shape),
}

impl Hidden {
    pub fn id(&self) -> &'static str {
        match self {
            Self::Scale(_) => "joint-scale",
            Self::Eccentricity(..) => "encoder-eccentricity",
            Self::TwoCycle(..) => "encoder-two-cycle",
            Self::Gear(..) => "gear-transmission-error",
            Self::Backlash(_) => "backlash",
            Self::LostMotion(..) => "lost-motion",
            Self::Lag(_) => "tracking-lag",
            Self::ThermalZero(_) => "thermal-zero-drift",
            Self::Compliance(_) => "joint-compliance",
            Self::ThermalGrowth(_) => "thermal-growth",
            Self::Runout(..) => "bearing-runout",
            Self::Wobble(..) => "axis-wobble",
            Self::Droop(_) => "link-droop",
            Self::Tilt(..) => "axis-tilt",
            Self::BaseOffset(_) => "base-offset",
            Self::InstrumentScale(_) => "instrument-scale",
            Self::Shift(..) => "frame-shift",
            Self::Drift(_) => "frame-drift",
            Self::Bump(..) => "bump",
            Self::Sawtooth(..) => "sawtooth",
            Self::Plateau(..) => "plateau",
            Self::Shape(shape) => shape.id(),
        }
    }

    /// The same at another size.
    pub fn times(&self, f: f64) -> Self {
        let three = |v: &[f64; 3]| v.map(|x| x * f);
        match self {
            Self::Scale(a) => Self::Scale(a * f),
            Self::Eccentricity(a, p) => Self::Eccentricity(a * f, *p),
            Self::TwoCycle(a, p) => Self::TwoCycle(a * f, *p),
            Self::Gear(k, a, p) => Self::Gear(*k, a * f, *p),
            Self::Backlash(a) => Self::Backlash(a * f),
            Self::LostMotion(a, d) => Self::LostMotion(a * f, *d),
            Self::Lag(a) => Self::Lag(a * f),
            Self::ThermalZero(a) => Self::ThermalZero(a * f),
            Self::Compliance(a) => Self::Compliance(a * f),
            Self::ThermalGrowth(a) => Self::ThermalGrowth(a * f),
            Self::Runout(k, a, p) => Self::Runout(*k, a * f, *p),
            Self::Wobble(k, a, p) => Self::Wobble(*k, a * f, *p),
            Self::Droop(a) => Self::Droop(a * f),
            Self::Tilt(a, b) => Self::Tilt(a * f, b * f),
            Self::BaseOffset(v) => Self::BaseOffset(three(v)),
            Self::InstrumentScale(a) => Self::InstrumentScale(a * f),
            Self::Shift(t, v) => Self::Shift(*t, three(v)),
            Self::Drift(v) => Self::Drift(three(v)),
            Self::Bump(a, c, w) => Self::Bump(a * f, *c, *w),
            Self::Sawtooth(a, p) => Self::Sawtooth(a * f, *p),
            Self::Plateau(a, x, y) => Self::Plateau(a * f, *x, *y),
            Self::Shape(shape) => Self::Shape(shape.times(f)),
        }
    }

    /// Its parameters as the contract names them.
    pub fn parameters(&self) -> Vec<(&'static str, f64)> {
        let wave = |amplitude: &'static str, a: f64, p: f64| {
            vec![(amplitude, a), ("phase_deg", p.to_degrees())]
        };
        let three = |names: [&'static str; 3], v: &[f64; 3], unit: f64| {
            (0..3).map(|k| (names[k], v[k] * unit)).collect()
        };
        match self {
            Self::Scale(k) | Self::InstrumentScale(k) => vec![("scale_ppm", k * 1e6)],
            Self::Eccentricity(a, p) | Self::TwoCycle(a, p) | Self::Gear(_, a, p) => {
                wave("amplitude_deg", a.to_degrees(), *p)
            }
            Self::Backlash(w) | Self::LostMotion(w, _) => vec![("width_deg", w.to_degrees())],
            Self::Lag(d) => vec![("delay_s", *d)],
            Self::ThermalZero(k) => vec![("deg_per_degc", k.to_degrees())],
            Self::Compliance(c) => vec![("compliance_urad_per_nm", c * 1e6)],
            Self::ThermalGrowth(a) => vec![("ppm_per_degc", a * 1e6)],
            Self::Runout(_, a, p) => wave("amplitude_mm", *a, *p),
            Self::Wobble(_, a, p) => wave("amplitude_mrad", a * 1e3, *p),
            Self::Droop(d) => vec![("mm_per_kg", *d)],
            Self::Tilt(x, y) => vec![("about_x_mrad", x * 1e3), ("about_y_mrad", y * 1e3)],
            Self::BaseOffset(v) => three(["x_mm", "y_mm", "z_mm"], v, 1.0),
            Self::Shift(t, v) => {
                let mut all: Vec<_> = three(["x_mm", "y_mm", "z_mm"], v, 1.0);
                all.push(("time_s", *t));
                all
            }
            Self::Drift(v) => three(["x_mm_per_h", "y_mm_per_h", "z_mm_per_h"], v, 3600.0),
            Self::Bump(..) | Self::Sawtooth(..) | Self::Plateau(..) | Self::Shape(_) => Vec::new(),
        }
    }

    /// One of the catalogue at random, of some size.
    pub fn random(id: &str, random: &mut Random, design: &Design) -> Self {
        let phase = random.between(0.0, std::f64::consts::TAU);
        let v = [random.normal(), random.normal(), random.normal()];
        let sign = if random.unit() < 0.5 { -1.0 } else { 1.0 };
        let end = 6.0 * design.samples as f64;
        let span = design.span_deg.to_radians();
        match id {
            "joint-scale" => Self::Scale(2e-4 * sign),
            "encoder-eccentricity" => Self::Eccentricity(1e-4, phase),
            "encoder-two-cycle" => Self::TwoCycle(1e-4, phase),
            "gear-transmission-error" => {
                let orders = [
                    3.0, 4.0, 5.0, 7.0, 9.0, 12.0, 16.0, 21.0, 30.0, 48.0, 60.0, 100.0,
                ];
                Self::Gear(orders[random.below(orders.len())], 1e-4, phase)
            }
            "backlash" => Self::Backlash(2e-4),
            "lost-motion" => Self::LostMotion(2e-4, random.between(3.0, 10.0).to_radians()),
            "tracking-lag" => Self::Lag(1e-3),
            "thermal-zero-drift" => Self::ThermalZero(5e-5 * sign),
            "joint-compliance" => Self::Compliance(3e-5),
            "thermal-growth" => Self::ThermalGrowth(5e-5),
            "bearing-runout" => Self::Runout(2.0 + random.below(5) as f64, 0.02, phase),
            "axis-wobble" => Self::Wobble(2.0 + random.below(5) as f64, 1e-4, phase),
            "link-droop" => Self::Droop(0.005),
            "axis-tilt" => Self::Tilt(1e-4 * v[0], 1e-4 * v[1]),
            "base-offset" => Self::BaseOffset(v.map(|x| 0.02 * x)),
            "instrument-scale" => Self::InstrumentScale(1e-4 * sign),
            "frame-shift" => Self::Shift(random.between(0.2, 0.8) * end, v.map(|x| 0.02 * x)),
            "frame-drift" => Self::Drift(v.map(|x| 0.02 * x / end)),
            "bump" => {
                let width = random.between(0.02, 0.06) * 2.0 * span;
                Self::Bump(5e-4 * sign, random.between(-0.7, 0.7) * span, width)
            }
            "sawtooth" => Self::Sawtooth(5e-4 * sign, random.between(20.0, 60.0).to_radians()),
            "plateau" => {
                let from = random.between(-0.7, 0.3) * span;
                Self::Plateau(3e-4 * sign, from, from + random.between(0.15, 0.45) * span)
            }
            other => panic!("no effect {other}"),
        }
    }
}

pub const NAMES: [&str; 18] = [
    "joint-scale",
    "encoder-eccentricity",
    "encoder-two-cycle",
    "gear-transmission-error",
    "backlash",
    "lost-motion",
    "tracking-lag",
    "thermal-zero-drift",
    "joint-compliance",
    "thermal-growth",
    "bearing-runout",
    "axis-wobble",
    "link-droop",
    "axis-tilt",
    "base-offset",
    "instrument-scale",
    "frame-shift",
    "frame-drift",
];

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Gauss,
    Tails,
    Correlated,
    Unequal,
    Outliers,
    Quantised,
    /// Correlated in time, ρ = 0.8.
    Sluggish,
    /// Heavy tails, correlation, unequal axes and outliers at once.
    Mixed,
}

/// How a session is measured.
#[derive(Clone, Debug)]
pub struct Design {
    pub samples: usize,
    /// Half of the range.
    pub span_deg: f64,
    pub shuffled: bool,
    pub reflectors: usize,
    pub one_speed: bool,
    pub one_way: bool,
    pub conditions: bool,
    pub gravity_across: bool,
    pub kind: Kind,
    pub sigma_mm: f64,
}

impl Default for Design {
    fn default() -> Self {
        Self {
            samples: 120,
            span_deg: 170.0,
            shuffled: true,
            reflectors: 1,
            one_speed: false,
            one_way: false,
            conditions: true,
            gravity_across: false,
            kind: Kind::Gauss,
            sigma_mm: 0.03,
        }
    }
}

/// What the session says of the instrument's noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stated {
    /// The σ of the design.
    Design,
    /// This σ, mm.
    Other(f64),
    Nothing,
}

/// One pose with its conditions.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    pub q: f64,
    pub dir: f64,
    pub speed: f64,
    pub load: f64,
    pub warmth: f64,
    pub time: f64,
    pub travel: f64,
    pub target: usize,
}

const HOME: [f64; 3] = [250.0, 0.0, 300.0];

/// A session on its way: poses, reflectors, truth.
#[derive(Clone)]
pub struct Rig {
    pub design: Design,
    pub shots: Vec<Shot>,
    pub targets: Vec<[f64; 3]>,
    pub offset: f64,
    pub length: f64,
    pub hidden: Vec<Hidden>,
    pub measured: Vec<[f64; 3]>,
    /// Which shots the session marks as held out; those beyond its end are not.
    pub held_out: Vec<bool>,
    /// By how much what is read back lags the command, s; `None`: there is no such column.
    pub read_back_lag_s: Option<f64>,
    pub stated: Stated,
}

impl Rig {
    pub fn new(design: &Design, random: &mut Random) -> Self {
        let n = design.samples;
        let mut angles: Vec<f64> = Vec::new();
        let poses = n / design.reflectors;
        let up = if design.one_way { poses } else { poses / 2 };
        for part in [up, poses - up] {
            for k in 0..part {
                let at = (k as f64 + random.between(-0.35, 0.35)) / (part.max(2) - 1) as f64;
                angles.push((2.0 * at.clamp(0.0, 1.0) - 1.0) * design.span_deg);
            }
        }
        let mut order: Vec<(f64, f64)> = angles
            .iter()
            .enumerate()
            .map(|(k, a)| {
                let back = k >= up;
                (if back { -*a } else { *a }, if back { -1.0 } else { 1.0 })
            })
            .collect();
        if design.shuffled {
            for k in (1..order.len()).rev() {
                order.swap(k, random.below(k + 1));
            }
        }
        let mut shots = Vec::new();
        let mut last: Option<(f64, f64, f64)> = None;
        let mut time = 0.0;
        for (angle, way) in order {
            let q = angle.to_radians();
            let dir = if design.one_way {
                1.0
            } else if design.shuffled {
                if random.unit() < 0.5 { -1.0 } else { 1.0 }
            } else {
                way
            };
            let speeds = [0.0_f64, 5.0, 20.0];
            let speed = if design.one_speed {
                10.0
            } else {
                speeds[random.below(3)]
            };
            let load = [0.0, 3.0, 6.0][random.below(3)];
            let warmth = 1.5 * random.normal();
            let travel = match last {
                None => f64::INFINITY,
                Some((q0, d0, t0)) => {
                    let moved = (q - q0).abs();
                    if d0 == dir { t0 + moved } else { moved }
                }
            };
            last = Some((q, dir, travel));
            for target in 0..design.reflectors {
                // The second reflector is seen from the same pose: no travel in between.
                shots.push(Shot {
                    q,
                    dir,
                    speed: dir * speed.to_radians(),
                    load,
                    warmth,
                    time,
                    travel,
                    target,
                });
                time += 6.0;
            }
        }
        Self {
            design: design.clone(),
            shots,
            targets: vec![[0.0; 3], [120.0, 0.0, 40.0]][..design.reflectors].to_vec(),
            offset: random.between(-0.5, 0.5).to_radians(),
            length: random.between(-1.8, 1.8),
            hidden: Vec::new(),
            measured: Vec::new(),
            held_out: Vec::new(),
            read_back_lag_s: None,
            stated: Stated::Design,
        }
    }

    fn gravity(&self) -> [f64; 3] {
        if self.design.gravity_across {
            [0.0, -9.81, 0.0]
        } else {
            [0.0, 0.0, -9.81]
        }
    }

    /// Where the reflector is, exactly.
    pub fn point(&self, shot: &Shot, hidden: &[Hidden]) -> [f64; 3] {
        let q = shot.q;
        let mut theta = q;
        let g = self.gravity();
        // In the order of the contract's table.
        let rank = |h: &Hidden| NAMES.iter().position(|n| *n == h.id()).unwrap_or(99);
        let mut hidden: Vec<&Hidden> = hidden.iter().collect();
        hidden.sort_by_key(|h| rank(h));
        for h in &hidden {
            if let Hidden::Scale(k) = h {
                theta *= 1.0 + k;
            }
        }
        theta += self.offset;
        for h in &hidden {
            theta += match h {
                Hidden::Eccentricity(a, p) => (a * (q - p).sin()).asin(),
                Hidden::TwoCycle(a, p) => a * (2.0 * q + p).sin(),
                Hidden::Gear(k, a, p) => a * (k * q + p).sin(),
                Hidden::Backlash(b) => -shot.dir * b / 2.0,
                Hidden::LostMotion(w, f) => {
                    -shot.dir * (w / 2.0) * (1.0 - 2.0 * (-shot.travel / f).exp())
                }
                Hidden::Lag(d) => -shot.speed * d,
                Hidden::ThermalZero(k) => k * shot.warmth,
                Hidden::Bump(a, c, w) => a * (-0.5 * ((q - c) / w).powi(2)).exp(),
                Hidden::Sawtooth(a, p) => a * ((q / p) - (q / p).floor() - 0.5),
                Hidden::Plateau(a, x, y) if q >= *x && q < *y => *a,
                Hidden::Shape(shape) => shape.angle(q),
                _ => 0.0,
            };
        }
        for h in &hidden {
            if let Hidden::Compliance(c) = h {
                let start = theta;
                for _ in 0..60 {
                    let arm = [HOME[0] * theta.cos(), HOME[0] * theta.sin()];
                    let torque = (arm[0] * g[1] - arm[1] * g[0]) * shot.load * 1e-3;
                    theta = start + c * torque;
                }
            }
        }
        let target = self.targets[shot.target];
        let mut home = [
            HOME[0] + target[0] + self.length,
            HOME[1] + target[1],
            HOME[2] + target[2],
        ];
        for h in &hidden {
            if let Hidden::ThermalGrowth(a) = h {
                home[0] *= 1.0 + a * shot.warmth;
                home[1] *= 1.0 + a * shot.warmth;
            }
        }
        let (s, c) = theta.sin_cos();
        let mut p = [
            home[0] * c - home[1] * s,
            home[0] * s + home[1] * c,
            home[2],
        ];
        let radius = home[0].hypot(home[1]);
        for h in &hidden {
            match h {
                Hidden::Runout(k, a, f) => {
                    p[0] += a * (k * q + f).cos();
                    p[1] += a * (k * q + f).sin();
                }
                Hidden::Wobble(k, a, f) => p[2] += radius * a * (k * q + f).cos(),
                Hidden::Droop(d) => {
                    let norm = 9.81;
                    for axis in 0..3 {
                        p[axis] += d * shot.load * g[axis] / norm;
                    }
                }
                Hidden::Tilt(x, y) => {
                    p[2] -= HOME[2];
                    let (sx, cx) = x.sin_cos();
                    p = [p[0], p[1] * cx - p[2] * sx, p[1] * sx + p[2] * cx];
                    let (sy, cy) = y.sin_cos();
                    p = [p[0] * cy + p[2] * sy, p[1], -p[0] * sy + p[2] * cy];
                    p[2] += HOME[2];
                }
                Hidden::BaseOffset(v) => p = [p[0] + v[0], p[1] + v[1], p[2] + v[2]],
                Hidden::InstrumentScale(s) => p = p.map(|x| x * (1.0 + s)),
                Hidden::Shift(t, v) if shot.time >= *t => {
                    p = [p[0] + v[0], p[1] + v[1], p[2] + v[2]];
                }
                Hidden::Drift(v) => {
                    p = [
                        p[0] + v[0] * shot.time,
                        p[1] + v[1] * shot.time,
                        p[2] + v[2] * shot.time,
                    ];
                }
                Hidden::Shape(shape) => {
                    let out = shape.radial(q);
                    p = [p[0] + out * c, p[1] + out * s, p[2]];
                }
                _ => {}
            }
        }
        p
    }

    /// ‖effect beside zero offset and link length‖² / σ².
    pub fn strength(&self, hidden: &Hidden) -> f64 {
        let mut d: Vec<f64> = Vec::new();
        let (mut t, mut r) = (Vec::new(), Vec::new());
        let mut turned = self.clone();
        turned.offset += 1e-5;
        let mut longer = self.clone();
        longer.length += 1e-3;
        for shot in &self.shots {
            let at = self.point(shot, &[]);
            let with = self.point(shot, std::slice::from_ref(hidden));
            let (a, b) = (turned.point(shot, &[]), longer.point(shot, &[]));
            for k in 0..3 {
                d.push(with[k] - at[k]);
                t.push(a[k] - at[k]);
                r.push(b[k] - at[k]);
            }
        }
        let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(x, y)| x * y).sum() };
        for basis in [t, r] {
            let f = dot(&basis, &d) / dot(&basis, &basis);
            d.iter_mut().zip(&basis).for_each(|(x, y)| *x -= f * y);
        }
        dot(&d, &d) / self.design.sigma_mm.powi(2)
    }

    /// The effect at a size that gives it this strength.
    pub fn sized(&self, hidden: &Hidden, lambda: f64) -> Hidden {
        let mut h = hidden.clone();
        for _ in 0..3 {
            h = h.times((lambda / self.strength(&h)).sqrt());
        }
        h
    }

    /// What the tests measure most: these effects, hidden at random, each of this size.
    pub fn measured(design: &Design, ids: &[&str], lambda: f64, seed: u64) -> (Self, Random) {
        let mut random = Random(seed);
        let mut rig = Self::new(design, &mut random);
        for id in ids {
            let hidden = Hidden::random(id, &mut random, design);
            let hidden = rig.sized(&hidden, lambda);
            rig.hidden.push(hidden);
        }
        rig.measure(&mut random);
        (rig, random)
    }

    /// Measures all shots.
    pub fn measure(&mut self, random: &mut Random) {
        let sigma = self.design.sigma_mm;
        let mut before = [0.0; 3];
        let hidden = self.hidden.clone();
        let mut measured = Vec::new();
        for (k, shot) in self.shots.iter().enumerate() {
            let mut p = self.point(shot, &hidden);
            let kind = self.design.kind;
            for (axis, value) in p.iter_mut().enumerate() {
                let own = match kind {
                    Kind::Tails | Kind::Mixed => {
                        let chi: f64 = (0..4).map(|_| random.normal().powi(2)).sum();
                        random.normal() / (chi / 4.0).sqrt() / 2.0_f64.sqrt()
                    }
                    _ => random.normal(),
                };
                let rho: f64 = match kind {
                    Kind::Correlated | Kind::Mixed if k > 0 => 0.5,
                    Kind::Sluggish if k > 0 => 0.8,
                    _ => 0.0,
                };
                let e = rho * before[axis] + (1.0 - rho * rho).sqrt() * own;
                before[axis] = e;
                let share = match kind {
                    Kind::Unequal | Kind::Mixed => [0.5, 1.0, 1.33][axis],
                    _ => 1.0,
                };
                *value += sigma * share * e;
                if kind == Kind::Quantised {
                    *value = (*value / 0.02).round() * 0.02;
                }
            }
            let with_outliers = matches!(kind, Kind::Outliers | Kind::Mixed);
            if with_outliers && random.unit() < 0.02 {
                let v = [random.normal(), random.normal(), random.normal()];
                let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
                for axis in 0..3 {
                    p[axis] += 0.4 * v[axis] / norm;
                }
            }
            measured.push(p);
        }
        self.measured = measured;
    }

    /// Measures more shots, after the others.
    pub fn measure_more(&mut self, shots: Vec<Shot>, random: &mut Random) {
        let mut more = self.clone();
        more.shots = shots;
        more.measure(random);
        self.shots.extend(more.shots);
        self.measured.extend(more.measured);
    }

    /// Measures as many shots again, of the same design, that the session marks as held out.
    pub fn measure_unseen(&mut self, random: &mut Random) {
        let unseen = Self::new(&self.design, random).shots;
        self.held_out = vec![false; self.shots.len()];
        self.held_out.resize(self.shots.len() + unseen.len(), true);
        self.measure_more(unseen, random);
    }

    /// The session as a document with inline samples.
    pub fn json(&self, name: &str) -> String {
        let column = |f: &dyn Fn(usize) -> String| -> String {
            let cells: Vec<String> = (0..self.shots.len()).map(f).collect();
            format!("[{}]", cells.join(","))
        };
        let number = |f: &dyn Fn(&Shot) -> f64| column(&|i| format!("{}", f(&self.shots[i])));
        let mut columns = vec![
            ("q1_deg", number(&|s| s.q.to_degrees())),
            ("x_mm", column(&|i| format!("{:.9}", self.measured[i][0]))),
            ("y_mm", column(&|i| format!("{:.9}", self.measured[i][1]))),
            ("z_mm", column(&|i| format!("{:.9}", self.measured[i][2]))),
            ("dir1", number(&|s| s.dir)),
            ("time_s", number(&|s| s.time)),
        ];
        if self.design.conditions {
            columns.push(("speed1_deg_s", number(&|s| s.speed.to_degrees())));
            columns.push(("load_kg", number(&|s| s.load)));
            columns.push(("temperature_c", number(&|s| s.warmth + 20.0)));
        }
        if let Some(lag) = self.read_back_lag_s {
            columns.push((
                "q1_read_deg",
                number(&|s| (s.q - lag * s.speed).to_degrees()),
            ));
        }
        if self.held_out.contains(&true) {
            let of = |i: usize| self.held_out.get(i).is_some_and(|h| *h);
            let cell = |i| if of(i) { "\"held-out\"" } else { "\"fit\"" };
            columns.push(("use", column(&|i| cell(i).to_owned())));
        }
        if self.targets.len() > 1 {
            columns.push((
                "target",
                column(&|i| format!("\"T{}\"", self.shots[i].target + 1)),
            ));
        }
        let mut targets = String::new();
        for (k, t) in self.targets.iter().enumerate() {
            let comma = if k > 0 { "," } else { "" };
            let _ = write!(
                targets,
                "{comma}\"T{}\":[{},{},{}]",
                k + 1,
                t[0],
                t[1],
                t[2]
            );
        }
        let columns: Vec<String> = columns
            .iter()
            .map(|(n, c)| format!("\"{n}\":{c}"))
            .collect();
        let g = self.gravity();
        let sigma = match self.stated {
            Stated::Design => format!(r#","sigma_mm":{}"#, self.design.sigma_mm),
            Stated::Other(sigma) => format!(r#","sigma_mm":{sigma}"#),
            Stated::Nothing => String::new(),
        };
        format!(
            r#"{{"format":"truepose-session/1","name":"{name}","robot":{{"name":"rig","joints":[{{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-180,180]}}],"tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},"gravity_m_s2":[{},{},{}]}},"targets":{{{targets}}},"instrument":{{"name":"tracker"{sigma}}},"samples":{{"columns":{{{}}}}}}}"#,
            g[0],
            g[1],
            g[2],
            columns.join(",")
        )
    }
}
