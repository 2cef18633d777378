//! The description of an effect: its name, its equation, its parameters, and the words that a technician reads.

use crate::kinematics::JointKind;
use crate::text::Template;

use super::needs::Need;
use super::survey::Survey;
use super::units::Unit;

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
    /// Its unit.
    pub unit: Unit,
    /// Its meaning where its joint is prismatic.
    pub on_slide: OnSlide,
}

/// What a quantity is on a joint that slides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OnSlide {
    /// The same.
    Same,
    /// Another name and unit: degrees become millimetres.
    As(&'static str, Unit),
    /// It has no meaning there.
    Meaningless,
}

impl Quantity {
    /// A quantity that is the same on joints of every kind.
    pub const fn new(name: &'static str, unit: Unit) -> Self {
        let on_slide = OnSlide::Same;
        Self {
            name,
            unit,
            on_slide,
        }
    }

    /// A position or a shift, mm.
    pub const XYZ_MM: [Self; 3] = [
        Self::new("x_mm", Unit::MM),
        Self::new("y_mm", Unit::MM),
        Self::new("z_mm", Unit::MM),
    ];

    /// With another name and unit where the joint slides.
    #[must_use]
    pub const fn sliding(self, name: &'static str, unit: Unit) -> Self {
        let on_slide = OnSlide::As(name, unit);
        Self { on_slide, ..self }
    }

    /// Without a meaning where the joint slides.
    #[must_use]
    pub const fn not_sliding(self) -> Self {
        let on_slide = OnSlide::Meaningless;
        Self { on_slide, ..self }
    }

    /// The quantity on a joint of this kind: where a joint slides, its degrees are millimetres.
    #[must_use]
    pub fn on(self, kind: JointKind) -> Self {
        match (kind, self.on_slide) {
            (JointKind::Prismatic, OnSlide::As(name, unit)) => Self::new(name, unit),
            _ => self,
        }
    }

    /// Whether it means anything on a joint of this kind.
    pub fn matters_on(&self, kind: JointKind) -> bool {
        kind == JointKind::Revolute || self.on_slide != OnSlide::Meaningless
    }
}

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
    /// Another quantity, described in the effect's file.
    Listed(&'static Listed),
}

/// A parameter that is tried at the values that its effect lists.
#[derive(Debug)]
pub struct Listed {
    /// Its name and unit.
    pub quantity: Quantity,
    /// The values that a search tries in a session for a joint (counted from 0), inner units.
    pub tried: fn(&Survey, usize) -> Vec<f64>,
    /// What an input may be, in words …
    pub expected: Template,
    /// … and whether a value, in the parameter's unit, is one of those for a joint counted from 0
    /// on a robot with so many.
    pub takes: fn(f64, usize, usize) -> bool,
    /// The value where an input gives none, in the parameter's unit; `None`: it has to be given.
    pub usual: fn(usize) -> Option<f64>,
}

impl Listed {
    /// A representative value where nothing is measured yet, inner units.
    pub fn stands_for_all(&self, joint: usize) -> f64 {
        let unit = self.quantity.unit;
        (self.usual)(joint).unwrap_or(unit.example) * unit.scale
    }
}

impl PartialEq for Listed {
    fn eq(&self, other: &Self) -> bool {
        self.quantity == other.quantity
    }
}

impl Setting {
    /// Whether a search tries several values of it.
    pub fn is_scanned(&self) -> bool {
        !matches!(self, Self::None | Self::Setup | Self::Target | Self::Place)
    }

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
    /// The travel of a joint since it last reversed.
    Travel,
    /// The speed of a joint.
    Speed,
    /// The load.
    Load,
    /// The temperature.
    Temperature,
    /// The time.
    Time,
}

impl Over {
    /// Whether the side from which a joint came matters.
    pub fn has_sides(self) -> bool {
        matches!(self, Self::Side | Self::Travel | Self::Speed)
    }
}

/// A condition of measuring that new poses can vary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Condition {
    /// The speed of the joints.
    Speed,
    /// The temperature.
    Temperature,
    /// How far a joint has come since it reversed.
    Approach,
}

/// The part of an effect in the model of every robot, if it has one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// None: a name that a search may find.
    Candidate,
    /// The zero of a joint.
    JointZero,
    /// The length from a single axis to the tool.
    ToolRadius,
    /// Where the axis of a joint runs, on a robot with several.
    JointAxis,
    /// Where the tool and its targets are, on a robot with several joints.
    ToolPlace,
    /// How the tool is turned, on a robot with several joints.
    ToolTurn,
    /// A free frame of the instrument.
    FreeFrame,
    /// A place that measurements refer to.
    Place,
    /// What no name explains.
    Unexplained,
}

impl Role {
    /// Whether it belongs to the calibration of a robot.
    pub fn is_of_every_calibration(self) -> bool {
        !matches!(self, Self::Candidate | Self::Unexplained)
    }
}

/// Whose error an effect is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// The robot's: commands can be corrected for it, and another session shows it as well.
    Robot,
    /// The instrument's.
    Instrument,
    /// The instrument's, during one session.
    Session,
}

/// A weak expectation of its size: the standard deviation of a coefficient before anything is
/// measured, inner units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// Where the joint turns, or whatever it does.
    pub sigma: f64,
    /// Where the joint slides.
    pub sigma_on_slide: f64,
    /// Whether it holds only where the instrument was aligned with the base.
    pub if_aligned: bool,
}

impl Prior {
    /// The same on every joint.
    pub const fn of(sigma: f64) -> Self {
        Self {
            sigma,
            sigma_on_slide: sigma,
            if_aligned: false,
        }
    }

    /// For an instrument that was aligned.
    pub const fn of_aligned(sigma: f64) -> Self {
        Self {
            if_aligned: true,
            ..Self::of(sigma)
        }
    }
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
    pub fn quantities(&self) -> &[Quantity] {
        match self {
            Self::Plain(quantities) => quantities,
            Self::Harmonic(quantity) | Self::Fading(quantity) => std::slice::from_ref(quantity),
        }
    }

    /// [`Unit::reach`] of each coefficient.
    pub fn max_magnitudes(&self) -> Vec<f64> {
        match self {
            Self::Plain(quantities) => quantities.iter().map(|q| q.unit.reach).collect(),
            Self::Harmonic(quantity) => vec![quantity.unit.reach; 2],
            // A fade is known to a factor of twenty, or not at all.
            Self::Fading(quantity) => vec![quantity.unit.reach, 3.0],
        }
    }

    /// Whether a coefficient is an angle on a joint of this kind.
    pub fn turns(&self, coefficient: usize, kind: JointKind) -> bool {
        match self {
            Self::Plain(quantities) => quantities
                .get(coefficient)
                .is_some_and(|q| q.on(kind).unit.turns),
            Self::Harmonic(quantity) | Self::Fading(quantity) => quantity.on(kind).unit.turns,
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

/// Everything that is known of an effect before anything is measured. What is left out of an effect's file is as in
/// [`About::PLAIN`].
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a fact of an effect, stated by its name"
)]
#[derive(Debug, Clone, Copy)]
pub struct About {
    /// The name that files and commands use.
    pub id: &'static str,
    /// The name in words.
    pub title: Template,
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
    pub cause: Template,
    /// The variable of its chart. Where the samples show no change of it, nothing shows the effect.
    pub over: Over,
    /// What a session must have; the first that it lacks is reported.
    pub needs: &'static [Need],
    /// Cycles per turn of a wave that has no other order; at equal steps a gear's order may look the same.
    pub cycles_per_turn: Option<u32>,
    /// Whether its sizes (an amplitude apart, which is one by its form) cannot be negative.
    pub non_negative: bool,
    /// Whether none of its components can be negative: one that clearly is rules it out.
    pub no_component_negative: bool,
    /// Sizes above this, in the unit of its parameters, are reported as implausible: ten times the usual ones. `None`
    /// where any size is usual.
    pub implausible_above: Option<f64>,
    /// Sizes that are usual; for reading, never a prior.
    pub usual_size: Template,
    /// What it is confused with, and what distinguishes them.
    pub confused_with: Template,
    /// Conditions that poses have to vary to distinguish it from what it is confused with.
    pub distinguished_by: &'static [Condition],
    /// The effect that it becomes where its setting goes to a limit: left out with that one, and never in one model
    /// with it on the same joint.
    pub becomes: Option<&'static str>,
    /// Whether it changes with the values of other joints than its own.
    pub of_other_joints: bool,
    /// What to look at on the machine.
    pub check: Template,
    /// Its part in every calibration.
    pub role: Role,
    /// Whose error it is.
    pub owner: Owner,
    /// The priors of its coefficients, one for each; empty: none.
    pub priors: &'static [Prior],
}

impl About {
    /// What most effects have in common: a candidate of the robot without anything scanned, that
    /// follows the joints' values and needs nothing.
    pub const PLAIN: Self = Self {
        id: "",
        title: phrase!(""),
        stage: Stage::Joint,
        per_joint: true,
        form: Form::Plain(&[]),
        setting: Setting::None,
        equation: "",
        source: "",
        cause: phrase!(""),
        over: Over::Angle,
        needs: &[],
        cycles_per_turn: None,
        non_negative: false,
        no_component_negative: false,
        implausible_above: None,
        usual_size: phrase!(""),
        confused_with: phrase!(""),
        distinguished_by: &[],
        becomes: None,
        of_other_joints: false,
        check: phrase!(""),
        role: Role::Candidate,
        owner: Owner::Robot,
        priors: &[],
    };

    /// What effects that cannot be in one model on the same joint have in common: an effect and what it becomes in the
    /// limit.
    pub fn family(&self) -> &'static str {
        self.becomes.unwrap_or(self.id)
    }
}
