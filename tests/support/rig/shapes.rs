//! Shapes over the angle that no catalogue has, and the form of a target.

use super::Random;

/// A deviation of the joint over its angle; of a form, of the radius of what is measured.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A slope from one angle on, to one side: a cable that pulls. Size, angle, side.
    Kink(f64, f64, f64),
    /// One level for each sector: size, and (where the sector begins, its level).
    Levels(f64, Vec<(f64, f64)>),
    /// A wave whose frequency grows over the range: size, half of the range, first and last
    /// frequency in cycles per turn, phase.
    Chirp(f64, f64, [f64; 2], f64),
    /// Waves of the target's own surface along the radius: size in mm, and (order, share, phase).
    Form(f64, Vec<(f64, f64, f64)>),
}

pub const STRANGE: [&str; 3] = ["kink", "levels", "chirp"];

impl Shape {
    pub fn id(&self) -> &'static str {
        match self {
            Self::Kink(..) => "kink",
            Self::Levels(..) => "levels",
            Self::Chirp(..) => "chirp",
            Self::Form(..) => "form",
        }
    }

    /// The same at another size.
    pub fn times(&self, f: f64) -> Self {
        let mut shape = self.clone();
        match &mut shape {
            Self::Kink(a, ..) | Self::Levels(a, _) | Self::Chirp(a, ..) | Self::Form(a, _) => {
                *a *= f;
            }
        }
        shape
    }

    /// By how much the joint turns too far, rad.
    pub fn angle(&self, q: f64) -> f64 {
        match self {
            Self::Kink(a, c, side) => a * (side * (q - c)).max(0.0),
            Self::Levels(a, sectors) => {
                let own = sectors.iter().rev().find(|(from, _)| q >= *from);
                a * own.or(sectors.first()).map_or(0.0, |(_, level)| *level)
            }
            Self::Chirp(a, span, [from, to], phase) => {
                let x = q + span;
                a * (from * x + (to - from) * x * x / (4.0 * span) + phase).sin()
            }
            Self::Form(..) => 0.0,
        }
    }

    /// By how much the measured point lies too far out, mm.
    pub fn radial(&self, q: f64) -> f64 {
        match self {
            Self::Form(a, waves) => {
                let all = waves.iter().map(|(k, share, p)| share * (k * q + p).cos());
                a * all.sum::<f64>()
            }
            _ => 0.0,
        }
    }

    /// One at random for a range from −span to span, of some size.
    pub fn random(id: &str, random: &mut Random, span: f64) -> Self {
        match id {
            "kink" => {
                let at = random.between(-0.5, 0.5) * span;
                let side = if random.unit() < 0.5 { -1.0 } else { 1.0 };
                Self::Kink(5e-4, at, side)
            }
            "levels" => {
                let count = 4 + random.below(7);
                let mut from: Vec<f64> = (1..count).map(|_| random.between(-span, span)).collect();
                from.push(-span);
                from.sort_by(f64::total_cmp);
                let sectors = from.into_iter().map(|at| (at, random.normal()));
                Self::Levels(3e-4, sectors.collect())
            }
            "chirp" => {
                let last = random.between(10.0, 25.0);
                let phase = random.between(0.0, std::f64::consts::TAU);
                Self::Chirp(3e-4, span, [2.0, last], phase)
            }
            "form" => {
                let mut wave = |order: u32| {
                    let phase = random.between(0.0, std::f64::consts::TAU);
                    (f64::from(order), random.normal(), phase)
                };
                Self::Form(0.02, (8..=40).map(&mut wave).collect())
            }
            other => panic!("no shape {other}"),
        }
    }
}
