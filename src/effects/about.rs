//! What is written about an effect: its name, its equation, its parameters, and the words that a
//! technician reads.

use crate::kinematics::JointKind;

/// Where in the flow from command to measured point an effect acts. Effects of one stage act in
/// the order of the catalogue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Changes the joint's output angle.
    Joint,
    /// Moves the reflector in the tool, at home.
    Tool,
    /// Moves the reflector behind a joint, before the joint turns it.
    Link,
    /// Moves the reflector in front of a joint, after the joint has turned it.
    Bearing,
    /// Moves the point in the base or in the measuring frame.
    World,
}

/// A parameter as the user reads it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantity {
    /// Name with its unit, as in `width_deg`.
    pub name: &'static str,
    /// Inner units (mm, rad, s, kg, °C, N·m) in one of the parameter's.
    pub inner: f64,
}

impl Quantity {
    /// The largest value that makes any sense, inner units: a turn of one radian, a metre, a scale
    /// of two. What the samples leave open within this range they do not determine.
    pub fn reach(&self) -> f64 {
        let name = self.name;
        if name.contains("ppm") {
            1.0
        } else if name.contains("deg") || name.contains("mrad") || name.contains("urad") {
            // An angle, and an angle for each kelvin or newton metre.
            1.0
        } else if name.ends_with("_s") {
            100.0
        } else {
            1000.0
        }
    }

    /// The quantity on a joint of this kind: where a joint slides, its degrees are millimetres.
    #[must_use]
    pub fn on(self, kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => self,
            JointKind::Prismatic => SLIDING
                .iter()
                .find(|(turning, _)| *turning == self.name)
                .map_or(self, |(_, name)| Self { name, inner: 1.0 }),
        }
    }
}

/// Names of a joint's own quantities, where it turns and where it slides.
const SLIDING: [(&str, &str); 4] = [
    ("offset_deg", "offset_mm"),
    ("width_deg", "width_mm"),
    ("fade_deg", "fade_mm"),
    ("deg_per_degc", "mm_per_degc"),
];

/// A parameter that does not enter linearly: it is scanned, not solved for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Setting {
    /// There is none.
    None,
    /// Cycles per turn. The error motions of a bearing (ISO 230-7) come round with the turn, so that
    /// theirs are whole; a gear's ratio need not be (see [`Setting::takes_fractions`]).
    Order {
        /// The smallest.
        from: u16,
        /// The largest.
        to: u16,
    },
    /// The time of a step, s.
    Time,
    /// The travel after a reversal over which an effect fades, rad; the user reads degrees. It is
    /// scanned coarsely and solved for from there ([`Form::Fading`]).
    Fade,
    /// Which measuring frame (counted from 0); not a parameter of the robot.
    Setup,
    /// Which place that measurements refer to (counted from 0); not a parameter of the robot.
    Place,
    /// Which target's own part: 0 for what all of them share, else the target counted from 1.
    Target,
}

impl Setting {
    /// Whether it is an order that need not be a whole number: one that reaches beyond the error
    /// motions of a bearing.
    pub fn takes_fractions(&self) -> bool {
        matches!(self, Self::Order { to, .. } if *to > 6)
    }
}

/// What an effect follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// The values of the joints, and nothing else.
    Angle,
    /// The side from which a joint came.
    Side,
    /// The speed of a joint.
    Speed,
    /// The load.
    Load,
    /// The temperature.
    Temperature,
    /// The time.
    Time,
}

/// How the parameters relate to the coefficients that identification solves for. Every
/// coefficient is zero where the effect is absent, and the model is smooth in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// Each parameter is a coefficient in another unit.
    Plain(&'static [Quantity]),
    /// An amplitude A ≥ 0 and a phase φ in [0°, 360°): the coefficients are A·cos φ and A·sin φ.
    Harmonic(Quantity),
    /// A size, and how far the fade lies from the term's setting f₀: fade = f₀ eᵘ. The coefficients
    /// are the size and u. Where the size is zero the samples do not depend on u.
    Fading(Quantity),
}

impl Form {
    /// Number of coefficients on which the samples depend where the effect is absent: the first
    /// ones. Where it has no size, where it fades does not matter.
    pub fn coefficients_at_zero(&self) -> usize {
        match self {
            Self::Fading(_) => 1,
            form => form.coefficients(),
        }
    }

    /// The parameters that are sizes: neither a setting nor a phase.
    pub fn sizes(&self) -> &[Quantity] {
        match self {
            Self::Plain(quantities) => quantities,
            Self::Harmonic(quantity) | Self::Fading(quantity) => std::slice::from_ref(quantity),
        }
    }

    /// [`Quantity::reach`] of each coefficient.
    pub fn reaches(&self) -> Vec<f64> {
        match self {
            Self::Plain(quantities) => quantities.iter().map(Quantity::reach).collect(),
            Self::Harmonic(quantity) => vec![quantity.reach(); 2],
            // A fade is known to a factor of twenty, or not at all.
            Self::Fading(quantity) => vec![quantity.reach(), 3.0],
        }
    }

    /// Number of coefficients.
    pub fn coefficients(&self) -> usize {
        match self {
            Self::Plain(quantities) => quantities.len(),
            Self::Harmonic(_) | Self::Fading(_) => 2,
        }
    }
}

/// Everything that is written about an effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct About {
    /// The name that files and commands use.
    pub id: &'static str,
    /// The name in words.
    pub title: &'static str,
    /// Where it acts.
    pub stage: Stage,
    /// Whether it belongs to one joint.
    pub per_joint: bool,
    /// Parameters that are solved for.
    pub form: Form,
    /// The parameter that is scanned.
    pub setting: Setting,
    /// The exact equation, in the contract's symbols.
    pub equation: &'static str,
    /// Where the equation comes from.
    pub source: &'static str,
    /// What in the machine causes it.
    pub cause: &'static str,
    /// What it follows: where the samples show no change of it, nothing shows the effect.
    pub over: Over,
    /// Whether its sizes (an amplitude apart, which is one by its form) cannot be negative.
    pub never_negative: bool,
    /// Sizes above this, in the unit of its parameters, are said to be implausible: ten times the
    /// usual ones. `None` where any size is usual.
    pub implausible_above: Option<f64>,
    /// Sizes that are usual; for reading, never a prior.
    pub usual_size: &'static str,
    /// What it is confused with, and what tells them apart.
    pub confused_with: &'static str,
    /// What to look at on the machine.
    pub check: &'static str,
}

/// One degree in rad.
pub const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// One part in a million.
pub const PPM: f64 = 1e-6;
/// One milliradian in rad.
pub const MILLIRADIAN: f64 = 1e-3;
