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
    /// A whole number of cycles per turn.
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
    /// Which target's own part: 0 for what all of them share, else the target counted from 1.
    Target,
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
