//! Shapes without a name: the forms of an error that no effect of the catalogue explains.
//!
//! A shape is a function of one variable (joint angle, time, speed, …) times a direction (along the motion of a joint,
//! along its radius, along its axis, or the axes of the measuring frame). They take part in the search together with
//! the names, so that a name cannot win by imitating them, and they pay for every setting that was tried to find them.

use std::f64::consts::TAU;

use crate::text::Text;
use crate::units::deg_from_rad;

/// What a shape is a function of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Variable {
    /// Commanded value of a joint, rad or mm.
    Joint(usize),
    /// Time, s.
    Time,
    /// Side from which a joint came.
    Side(usize),
    /// Signed speed of a joint.
    Speed(usize),
    /// Load, kg.
    Load,
    /// Temperature over 20 °C.
    Warmth,
    /// One reflector against the others.
    Target(u32),
}

/// Where a shape pushes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Direction {
    /// As a joint's angle does, mm/rad.
    Tangential(usize),
    /// Along the radius of the single joint.
    Radial,
    /// Along the axis of the single joint.
    Axial,
    /// Across the motion of a joint (the first number) that slides, or as its guide turns it: the second is that of its
    /// [moves](crate::effects::rest::MOVES).
    Guide(usize, usize),
    /// x, y, z of the measuring frame: three columns.
    Frame,
    /// One of the measured axes of the measuring frame.
    Along(usize),
    /// Along the motion of the single joint and in both directions across it: three columns.
    Body,
}

/// The function of the variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Profile {
    /// 1.
    Constant,
    /// The variable itself, measured from its origin (see [`Variable::origin`]).
    Ramp,
    /// Its absolute value, from its origin.
    Absolute,
    /// Its square, from its origin.
    Square,
    /// `exp(−((v − centre)/width)²/2)`.
    Bump {
        /// Middle.
        centre: f64,
        /// Standard width.
        width: f64,
    },
    /// The variable from an edge on, zero before it; of the other way round where `below` is true.
    Kink {
        /// The edge.
        at: f64,
        /// Whether it acts below the edge.
        below: bool,
    },
    /// A polygon over the range with so many pieces.
    Curve {
        /// How many.
        pieces: usize,
    },
    /// 1 between two edges.
    Plateau {
        /// Lower edge.
        from: f64,
        /// Upper edge; infinite for a step.
        to: f64,
    },
    /// Sine and cosine of so many cycles per turn (per rad·2π), and their harmonics.
    Periodic {
        /// Fundamental.
        cycles: f64,
        /// How many multiples of it.
        harmonics: usize,
    },
    /// The variable times sine and cosine of the first joint's angle.
    TimesTurn,
}

/// A shape without a name over a joint, time, load or temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Its variable.
    pub variable: Variable,
    /// Where it pushes.
    pub direction: Direction,
    /// How.
    pub profile: Profile,
    /// How many of its kind were tried.
    pub tried: f64,
}

/// Where something unexplained is.
#[derive(Debug, Clone, PartialEq)]
pub enum Where {
    /// Between two values of a variable, in the units of the file's column.
    Range {
        /// The column's name.
        variable: String,
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// Periodic in a joint's angle.
    Cycles {
        /// The column's name.
        variable: String,
        /// Cycles per turn.
        cycles_per_turn: f64,
    },
}

impl Profile {
    /// Number of values it gives.
    pub fn count(&self) -> usize {
        match self {
            Self::Periodic { harmonics, .. } => 2 * harmonics,
            Self::Curve { pieces } => pieces + 1,
            Self::TimesTurn => 2,
            _ => 1,
        }
    }

    /// The number of its own parameters: where it is, how wide, how often it returns.
    pub fn settings(&self) -> usize {
        match self {
            Self::Bump { .. } | Self::Plateau { .. } => 2,
            Self::Kink { .. } | Self::Periodic { .. } => 1,
            _ => 0,
        }
    }

    /// Its values at one sample: `v` the variable, `origin` where it does nothing, `range` what was
    /// measured of it,
    /// `angle` of the first joint.
    pub fn values(&self, v: f64, origin: f64, range: (f64, f64), angle: f64) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.count());
        self.each(v, origin, range, angle, |_, value| values.push(value));
        values
    }

    /// Hands on each of its [`values`](Self::values), in their order.
    pub fn each(
        &self,
        v: f64,
        origin: f64,
        range: (f64, f64),
        angle: f64,
        mut put: impl FnMut(usize, f64),
    ) {
        match *self {
            Self::Curve { pieces } => {
                let step = ((range.1 - range.0) / pieces as f64).max(f64::MIN_POSITIVE);
                let hat = |k: usize| 1.0 - ((v - range.0) / step - k as f64).abs();
                for k in 0..=pieces {
                    put(k, hat(k).max(0.0));
                }
            }
            Self::Constant => put(0, 1.0),
            Self::Ramp => put(0, v - origin),
            Self::Absolute => put(0, (v - origin).abs()),
            Self::Square => put(0, (v - origin) * (v - origin)),
            Self::Bump { centre, width } => {
                let z = (v - centre) / width;
                put(0, (-0.5 * z * z).exp());
            }
            Self::Kink { at, below } => {
                let beyond = if below { at - v } else { v - at };
                put(0, beyond.max(0.0));
            }
            Self::Plateau { from, to } => put(0, f64::from(u8::from(v >= from && v < to))),
            Self::Periodic { cycles, harmonics } => {
                for k in 1..=harmonics {
                    let (s, c) = (cycles * k as f64 * v).sin_cos();
                    put(2 * k - 2, s);
                    put(2 * k - 1, c);
                }
            }
            Self::TimesTurn => {
                let (s, c) = angle.sin_cos();
                put(0, v * s);
                put(1, v * c);
            }
        }
    }
}

impl Variable {
    /// Where a slope over it starts: joints in the middle of the measured range, time at the
    /// first sample, conditions where they do nothing.
    pub fn origin(self, range: (f64, f64)) -> f64 {
        match self {
            Self::Joint(_) => 0.5 * (range.0 + range.1),
            Self::Time => range.0,
            _ => 0.0,
        }
    }

    /// Name of the column in the file.
    pub fn column(self, prismatic: impl Fn(usize) -> bool) -> String {
        let unit = |joint: usize| if prismatic(joint) { "mm" } else { "deg" };
        match self {
            Self::Joint(j) => format!("q{}_{}", j + 1, unit(j)),
            Self::Time => "time_s".to_owned(),
            Self::Side(j) => format!("dir{}", j + 1),
            Self::Speed(j) => format!("speed{}_{}_s", j + 1, unit(j)),
            Self::Load => "load_kg".to_owned(),
            Self::Warmth => "temperature_c".to_owned(),
            Self::Target(_) => "target".to_owned(),
        }
    }

    /// A value as in the file.
    pub fn shown(self, v: f64, prismatic: impl Fn(usize) -> bool) -> f64 {
        match self {
            Self::Joint(j) | Self::Speed(j) if !prismatic(j) => deg_from_rad(v),
            Self::Warmth => v + 20.0,
            _ => v,
        }
    }
}

impl Shape {
    /// Settings that are fitted finely after the scan.
    pub fn refined(&self) -> usize {
        match self.profile {
            Profile::Bump { .. } | Profile::Plateau { .. } => 2,
            Profile::Periodic { .. } | Profile::Kink { .. } => 1,
            _ => 0,
        }
    }

    /// Where it is; `range` is the variable's in the data.
    pub fn place(&self, range: (f64, f64), prismatic: impl Fn(usize) -> bool + Copy) -> Where {
        let variable = self.variable.column(prismatic);
        let between = |from: f64, to: f64| Where::Range {
            variable: variable.clone(),
            from: self.variable.shown(from.max(range.0), prismatic),
            to: self.variable.shown(to.min(range.1), prismatic),
        };
        match self.profile {
            Profile::Bump { centre, width } => between(centre - 2.0 * width, centre + 2.0 * width),
            Profile::Plateau { from, to } => between(from, to),
            Profile::Kink { at, below: true } => between(range.0, at),
            Profile::Kink { at, below: false } => between(at, range.1),
            Profile::Periodic { cycles, .. } => {
                let revolute = matches!(self.variable, Variable::Joint(j) if !prismatic(j));
                Where::Cycles {
                    variable,
                    // Of a sliding joint: cycles per metre.
                    cycles_per_turn: if revolute {
                        cycles
                    } else {
                        cycles * 1000.0 / TAU
                    },
                }
            }
            _ => between(range.0, range.1),
        }
    }

    /// In words.
    pub fn describe(&self) -> Text {
        let along = match self.direction {
            Direction::Tangential(j) => text!("along the motion of joint {joint}", joint = j + 1),
            Direction::Radial => text!("along the radius"),
            Direction::Axial => text!("along the axis"),
            Direction::Guide(_, 1 | 2) => text!("across the guide"),
            Direction::Guide(_, 3) => text!("as a roll of the carriage"),
            Direction::Guide(..) => text!("as a pitch or yaw of the carriage"),
            Direction::Frame | Direction::Along(_) => text!("in the measuring frame"),
            Direction::Body => text!("with the moving body"),
        };
        let what = match self.profile {
            Profile::Constant => phrase!("a constant"),
            Profile::Ramp => phrase!("a straight slope"),
            Profile::Absolute => phrase!("a slope away from the middle"),
            Profile::Square => phrase!("a parabola"),
            Profile::Curve { .. } => phrase!("a curve of no known form"),
            Profile::Bump { .. } => phrase!("a local bump"),
            Profile::Plateau { .. } => phrase!("a step or plateau"),
            Profile::Kink { .. } => phrase!("a slope from one value on"),
            Profile::Periodic { harmonics: 1, .. } => phrase!("a wave"),
            Profile::Periodic { .. } => phrase!("a periodic pattern with harmonics"),
            Profile::TimesTurn => phrase!("a wave of one turn in proportion"),
        };
        match self.variable {
            Variable::Joint(j) => text!(
                "{shape} over the value of joint {joint}, {along}",
                shape = what,
                joint = j + 1,
                along
            ),
            Variable::Time => text!("{shape} over time, {along}", shape = what, along),
            Variable::Side(j) => text!(
                "{shape} over the side from which joint {joint} came, {along}",
                shape = what,
                joint = j + 1,
                along
            ),
            Variable::Speed(j) => text!(
                "{shape} over the speed of joint {joint}, {along}",
                shape = what,
                joint = j + 1,
                along
            ),
            Variable::Load => text!("{shape} over the load, {along}", shape = what, along),
            Variable::Warmth => {
                text!("{shape} over temperature, {along}", shape = what, along)
            }
            Variable::Target(_) => text!(
                "{shape} of one reflector against the others, {along}",
                shape = what,
                along
            ),
        }
    }
}
