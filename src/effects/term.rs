//! An effect in a model: which joint, which setting, how large.

use crate::numeric::extent;
use crate::text::Text;
use std::sync::Arc;

use crate::kinematics::{Axis, JointKind, Range, Robot};
use crate::units::wrapped_positive;

use super::about::{Form, Quantity, Setting};
use super::curve::Curve;
use super::places::PlaceKind;
use super::units::{DEGREE, MILLIRADIAN, Unit};
use super::unnamed::Rest;
use super::{Effect, Role, find, form_with};

/// An effect with its values. Coefficients are in inner units; all zero means that the effect is
/// absent.
#[derive(Clone)]
pub struct Term {
    /// The effect.
    pub effect: &'static Effect,
    /// Its joint, counted from 0; 0 where the effect belongs to none.
    pub joint: usize,
    /// The scanned parameter: an order, a time in s, a fade in rad, the index of a frame.
    pub setting: f64,
    /// What identification solves for, inner units: rad, mm, or those by what the effect is
    /// proportional to.
    pub coefficients: Vec<f64>,
    /// The curve of an unexplained correction, which no identification changes.
    pub curve: Option<Arc<Curve>>,
    /// What predicts without a name, which no identification changes either.
    pub rest: Option<Arc<Rest>>,
    /// Coefficients that no fit moves.
    pub held: Held,
    /// Name of the setup or of the target that the term belongs to, where it belongs to one.
    pub label: Option<Arc<str>>,
}

/// Which coefficients of a term stay as they are: what the samples cannot tell from something
/// else is zero, and is carried by that.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Held(u32);

impl Held {
    /// All of them.
    pub(crate) const ALL: Self = Self(u32::MAX);

    /// The same with one coefficient more.
    #[must_use]
    pub fn with(self, coefficient: usize) -> Self {
        Self(self.0 | 1 << coefficient)
    }

    /// Whether a coefficient is held.
    pub fn contains(self, coefficient: usize) -> bool {
        coefficient < 32 && self.0 & (1 << coefficient) != 0
    }

    /// Whether none is.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// One named value as the user reads it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Name with its unit.
    pub name: &'static str,
    /// Value in that unit.
    pub value: f64,
}

/// Why a term could not be made from names and values.
#[derive(Debug, Clone, PartialEq)]
pub enum TermError {
    /// No effect of this name.
    UnknownEffect(String),
    /// A joint that the robot does not have.
    NoSuchJoint {
        /// The joint, counted from 1.
        joint: usize,
        /// How many there are.
        joints: usize,
    },
    /// A parameter that the effect does not have.
    UnknownParameter {
        /// The effect.
        effect: &'static str,
        /// What was given.
        name: String,
        /// What there is.
        known: String,
    },
    /// A parameter without which the effect has no meaning.
    Missing {
        /// The effect.
        effect: &'static str,
        /// What is missing.
        name: &'static str,
    },
    /// A value outside what the effect takes.
    OutOfRange {
        /// The effect.
        effect: &'static str,
        /// The parameter.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What it takes.
        expected: Text,
    },
}

impl TermError {
    /// In words.
    pub fn says(&self) -> Text {
        match self {
            Self::UnknownEffect(effect) => text!(
                "no effect is called '{effect}'; `truepose effects` lists them",
                effect = effect
            ),
            Self::NoSuchJoint { joint, joints } => text!(
                "joint {joint}: the robot has {joints}",
                joint = joint,
                joints = joints
            ),
            Self::UnknownParameter {
                effect,
                name,
                known,
            } => text!(
                "'{effect}' has no parameter '{name}'; it has {known}",
                effect = effect,
                name = name,
                known = known
            ),
            Self::Missing { effect, name } => {
                text!("'{effect}' needs '{name}'", effect = effect, name = name)
            }
            Self::OutOfRange {
                effect,
                name,
                value,
                expected,
            } => text!(
                "'{effect}': {name} is {value}; expected {expected}",
                effect = effect,
                name = name,
                value = value,
                expected = expected
            ),
        }
    }
}

displays_what_it_says!(TermError);

impl std::error::Error for TermError {}

impl Term {
    /// An effect that is absent so far: all coefficients zero.
    pub fn absent(effect: &'static Effect, joint: usize, setting: f64) -> Self {
        Self {
            effect,
            joint,
            setting,
            coefficients: vec![0.0; effect.about().form.coefficients()],
            curve: None,
            rest: None,
            held: Held::default(),
            label: None,
        }
    }

    /// From an effect's name, a joint counted from 1 and parameters in the user's units. A
    /// parameter that is left out is zero, a setting has to be there.
    ///
    /// # Errors
    /// An unknown effect or parameter, a joint that is not there, a setting that is missing or
    /// out of range.
    pub fn from_parameters(
        id: &str,
        joint: usize,
        given: &[(&str, f64)],
        joints: usize,
    ) -> Result<Self, TermError> {
        let effect = find(id).ok_or_else(|| TermError::UnknownEffect(id.to_owned()))?;
        let given = &renamed(given)[..];
        let effect = form_with(effect, |form| {
            let names = [JointKind::Revolute, JointKind::Prismatic].map(|k| names_on(form, k));
            let known = |(name, _): &(&str, f64)| names.iter().any(|n| n.contains(name));
            given.iter().all(known)
        });
        let about = effect.about();
        if joint == 0 || joint > joints {
            return Err(TermError::NoSuchJoint { joint, joints });
        }
        if about.role == Role::Unexplained {
            let (effect, name) = (about.id, "curve");
            return Err(TermError::Missing { effect, name });
        }
        let known = [JointKind::Revolute, JointKind::Prismatic].map(|k| names_on(effect, k));
        let is_known = |name: &str| known.iter().any(|names| names.contains(&name));
        if let Some((name, _)) = given.iter().find(|(name, _)| !is_known(name)) {
            return Err(TermError::UnknownParameter {
                effect: about.id,
                name: (*name).to_owned(),
                known: known[0].join(", "),
            });
        }
        // A quantity of a sliding joint goes by its own name.
        let inner_value = |quantity: Quantity| {
            let turning = given.iter().find(|g| g.0 == quantity.name);
            let on_slide = quantity.on(JointKind::Prismatic);
            let sliding = given.iter().find(|g| g.0 == on_slide.name);
            let inner = |g: &(&str, f64), q: Quantity| g.1 * q.unit.inner;
            turning
                .map(|g| inner(g, quantity))
                .or_else(|| sliding.map(|g| inner(g, on_slide)))
        };
        let value = |name: &str| given.iter().find(|g| g.0 == name).map(|g| g.1);
        let mut term = Self::absent(effect, joint - 1, 0.0);
        if let Some(quantity) = setting_quantity(about.setting) {
            let missing = TermError::Missing {
                effect: about.id,
                name: quantity.name,
            };
            let usual = || match about.setting {
                Setting::Listed(listed) => (listed.usual)(joint - 1),
                _ => None,
            };
            let usual = || usual().map(|value| value * quantity.unit.inner);
            term.setting = inner_value(quantity).or_else(usual).ok_or(missing)?;
            let outer = term.setting / quantity.unit.inner;
            check_setting(effect, [joint - 1, joints], quantity.name, outer)?;
        }
        match about.form {
            Form::Plain(quantities) => {
                for (coefficient, quantity) in term.coefficients.iter_mut().zip(quantities) {
                    *coefficient = inner_value(*quantity).unwrap_or(0.0);
                }
            }
            Form::Harmonic(quantity) => {
                let amplitude = value(quantity.name).unwrap_or(0.0) * quantity.unit.inner;
                let phase = crate::units::rad_from_deg(value("phase_deg").unwrap_or(0.0));
                term.coefficients = vec![amplitude * phase.cos(), amplitude * phase.sin()];
            }
            Form::Fading(quantity) => {
                term.coefficients[0] = inner_value(quantity).unwrap_or(0.0);
            }
        }
        Ok(term)
    }

    /// The parameters as the user reads them, on a joint that turns.
    pub fn parameters(&self) -> Vec<Parameter> {
        self.parameters_on(JointKind::Revolute)
    }

    /// The parameters as the user reads them, on a joint of this kind.
    pub fn parameters_on(&self, kind: JointKind) -> Vec<Parameter> {
        let about = self.effect.about();
        let mut parameters = Vec::new();
        if let Some(quantity) = setting_quantity(about.setting) {
            let Quantity { name, unit, .. } = quantity.on(kind);
            let value = self.scanned() / unit.inner;
            parameters.push(Parameter { name, value });
        }
        match about.form {
            Form::Plain(quantities) => {
                for (coefficient, quantity) in self.coefficients.iter().zip(quantities) {
                    let quantity = quantity.on(kind);
                    parameters.push(Parameter {
                        name: quantity.name,
                        value: coefficient / quantity.unit.inner,
                    });
                }
            }
            Form::Harmonic(quantity) => {
                let (a, b) = (self.coefficient(0), self.coefficient(1));
                parameters.push(Parameter {
                    name: quantity.name,
                    value: a.hypot(b) / quantity.unit.inner,
                });
                parameters.push(Parameter {
                    name: "phase_deg",
                    value: crate::units::deg_from_rad(wrapped_positive(b.atan2(a))),
                });
            }
            Form::Fading(quantity) => {
                let quantity = quantity.on(kind);
                parameters.push(Parameter {
                    name: quantity.name,
                    value: self.coefficient(0) / quantity.unit.inner,
                });
            }
        }
        parameters
    }

    /// The scanned parameter with what was solved for beside it, inner units.
    fn scanned(&self) -> f64 {
        match self.effect.about().form {
            Form::Fading(_) => fade(self.setting, self.coefficient(1)),
            Form::Plain(_) | Form::Harmonic(_) => self.setting,
        }
    }

    /// The same effect, bit by bit, with the fade that was solved for as its setting.
    #[must_use]
    pub fn settled(&self) -> Self {
        let mut settled = self.clone();
        settled.setting = self.scanned();
        if let Form::Fading(_) = self.effect.about().form {
            settled
                .coefficients
                .iter_mut()
                .skip(1)
                .for_each(|c| *c = 0.0);
        }
        settled
    }

    /// A coefficient; one that a caller left out is zero.
    fn coefficient(&self, index: usize) -> f64 {
        self.coefficients.get(index).copied().unwrap_or(0.0)
    }

    /// The coefficients after a step, which moves no fade by more than a factor [`e^½`](fade) at
    /// once: far from the solution a linear step means nothing for it.
    pub(crate) fn step(&mut self, by: &[f64]) {
        let held = self.held;
        for (k, (coefficient, by)) in self.coefficients.iter_mut().zip(by).enumerate() {
            if !held.contains(k) {
                *coefficient += by;
            }
        }
        let free_turn = match self.effect.about().setting {
            Setting::Setup => true,
            Setting::Place => PlaceKind::of(self) == Some(PlaceKind::Station),
            _ => false,
        };
        if free_turn && !held.contains(0) {
            super::measuring_frame::unwind(&mut self.coefficients);
        }
        if let (Form::Fading(_), Some(by)) = (self.effect.about().form, by.get(1)) {
            let before = self.coefficients[1] - by;
            let moved = before + by.clamp(-LONGEST_STEP, LONGEST_STEP);
            self.coefficients[1] = moved.clamp(-FARTHEST, FARTHEST);
        }
    }

    /// The effect's name for reading; of a robot with several joints with the joint, counted from 1.
    pub fn name_on(&self, robot: &crate::kinematics::Robot) -> String {
        let about = self.effect.about();
        if about.per_joint && robot.joints.len() > 1 {
            format!("{} {}", about.id, self.joint.saturating_add(1))
        } else {
            about.id.to_owned()
        }
    }

    /// Whether two terms are the same effect on the same joint at the same setting.
    pub fn same_column(&self, other: &Self) -> bool {
        self.joint == other.joint
            && self.setting == other.setting
            && self.effect.about().id == other.effect.about().id
    }
}

impl std::fmt::Debug for Term {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Term")
            .field("effect", &self.effect.about().id)
            .field("joint", &(self.joint + 1))
            .field("setting", &self.setting)
            .field("coefficients", &self.coefficients)
            .field("curve", &self.curve)
            .field("rest", &self.rest)
            .field("held", &self.held)
            .field("label", &self.label)
            .finish()
    }
}

impl PartialEq for Term {
    fn eq(&self, other: &Self) -> bool {
        self.same_column(other)
            && self.coefficients == other.coefficients
            && self.curve == other.curve
            && self.rest == other.rest
    }
}

/// Parameters under the names that they have now: a measuring frame's turns were in degrees once.
fn renamed<'n>(given: &[(&'n str, f64)]) -> Vec<(&'n str, f64)> {
    const TURNS: [(&str, &str); 3] = [
        ("about_x_deg", "about_x_mrad"),
        ("about_y_deg", "about_y_mrad"),
        ("about_z_deg", "about_z_mrad"),
    ];
    let now = |(name, value): &(&'n str, f64)| {
        let turn = TURNS.iter().find(|(before, _)| before == name);
        turn.map_or((*name, *value), |(_, now)| {
            (*now, value * DEGREE / MILLIRADIAN)
        })
    };
    given.iter().map(now).collect()
}

/// How far a fade moves in one step, and from its setting, as logarithms.
const LONGEST_STEP: f64 = 0.5;
const FARTHEST: f64 = 3.0;

/// The fade of a setting and its coefficient u: f₀ eᵘ.
pub(super) fn fade(setting: f64, u: f64) -> f64 {
    // Times one is exact, so a settled term acts like the one it came from, bit by bit.
    setting * u.exp()
}

/// Name and inner size of the scanned parameter, where the user sees one.
pub(crate) fn setting_quantity(setting: Setting) -> Option<Quantity> {
    match setting {
        Setting::None | Setting::Setup | Setting::Target | Setting::Place => None,
        Setting::Order { from, .. } => {
            let unit = Unit::ONE.like(f64::from(from));
            Some(Quantity::new("order", unit))
        }
        Setting::Time => Some(Quantity::new("time_s", Unit::SECOND.like(120.0))),
        Setting::Fade => {
            let degrees = Quantity::new("fade_deg", Unit::DEGREE.like(5.0));
            Some(degrees.sliding("fade_mm", Unit::MM))
        }
        Setting::Listed(listed) => Some(listed.quantity),
    }
}

/// Names of an effect's parameters in the order in which they are shown.
pub(crate) fn parameter_names(effect: &Effect) -> Vec<&'static str> {
    names_on(effect, JointKind::Revolute)
}

/// The same on a joint of this kind.
pub(crate) fn names_on(effect: &Effect, kind: JointKind) -> Vec<&'static str> {
    let about = effect.about();
    let setting = setting_quantity(about.setting);
    let mut names: Vec<_> = setting.map(|s| s.on(kind).name).into_iter().collect();
    match about.form {
        Form::Plain(quantities) => names.extend(quantities.iter().map(|q| q.on(kind).name)),
        Form::Harmonic(quantity) => names.extend([quantity.name, "phase_deg"]),
        Form::Fading(quantity) => names.push(quantity.on(kind).name),
    }
    names
}

/// An effect's parameters at values that can be seen in a simulation.
pub(crate) fn parameters_to_see(effect: &Effect) -> Vec<(&'static str, f64)> {
    let about = effect.about();
    let quantities = setting_quantity(about.setting).into_iter();
    let quantities = quantities.chain(about.form.quantities().iter().copied());
    let shown = quantities.map(|q| (q.name, q.unit.example));
    let phase = matches!(about.form, Form::Harmonic(_)).then_some(("phase_deg", 30.0));
    shown.chain(phase).collect()
}

/// Names of what identification solves for, one for each coefficient; an amplitude and its phase
/// stand for their two parts.
pub(crate) fn coefficient_names_on(effect: &Effect, kind: JointKind) -> Vec<&'static str> {
    let mut names = names_on(effect, kind);
    match effect.about().form {
        // The fade is shown first and solved for last.
        Form::Fading(_) => names.reverse(),
        form => {
            let settings = names.len().saturating_sub(form.coefficients());
            names.drain(..settings);
        }
    }
    names
}

fn check_setting(
    effect: &Effect,
    [joint, joints]: [usize; 2],
    name: &'static str,
    given: f64,
) -> Result<(), TermError> {
    let about = effect.about();
    let expected = match about.setting {
        Setting::Order { from, to } => {
            let fraction = about.setting.takes_fractions();
            let whole = fraction || given.fract() == 0.0;
            let inside = given >= f64::from(from) && given <= f64::from(to);
            (!(whole && inside)).then(|| {
                if fraction {
                    text!("a number from {from} to {to}", from = from, to = to)
                } else {
                    text!("a whole number from {from} to {to}", from = from, to = to)
                }
            })
        }
        Setting::Fade => (given < 0.0 || !given.is_finite()).then(|| text!("zero or more")),
        Setting::Time => (!given.is_finite()).then(|| text!("a time")),
        Setting::Listed(listed) => {
            (!(listed.takes)(given, joint, joints)).then(|| listed.expected.into())
        }
        Setting::None | Setting::Setup | Setting::Target | Setting::Place => None,
    };
    match expected {
        Some(expected) => Err(TermError::OutOfRange {
            effect: about.id,
            name,
            value: given,
            expected,
        }),
        None => Ok(()),
    }
}

/// Directions and points of one joint that effects refer to, base frame, at home.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointFrame {
    /// A point on the axis, mm.
    pub origin_mm: [f64; 3],
    /// Along the axis, a unit vector.
    pub along: [f64; 3],
    /// Across the axis: the base frame's x, made perpendicular (y where x is along the axis).
    pub across_1: [f64; 3],
    /// Across the axis, a quarter turn further.
    pub across_2: [f64; 3],
    /// From the axis to the tool's origin; zero where the tool lies on the axis.
    pub radial: [f64; 3],
    /// A quarter turn from `radial`, in the joint's positive sense.
    pub tangential: [f64; 3],
    /// The tool's distance from the axis, mm.
    pub radius_mm: f64,
    /// The point on the axis at the height of the tool's origin, mm.
    pub foot_mm: [f64; 3],
}

impl JointFrame {
    /// The frame of a joint; of one that the robot has not, about the base's z.
    pub fn new(robot: &Robot, joint: usize) -> Self {
        use nalgebra::Vector3;
        let base_z = Axis {
            direction: Vector3::z_axis(),
            point_mm: nalgebra::Point3::origin(),
        };
        let axis = robot.joints.get(joint).map_or(base_z, |joint| joint.axis);
        let along = axis.direction.into_inner();
        let across = |v: Vector3<f64>| v - along * along.dot(&v);
        let x = across(Vector3::x());
        let across_1 = if x.norm() > 1e-3 {
            x
        } else {
            across(Vector3::y())
        }
        .normalize();
        let tool = robot.base_from_tool.translation.vector;
        let arm = tool - axis.point_mm.coords;
        let radial = across(arm);
        let radius_mm = radial.norm();
        let on_axis = radius_mm <= 1e-9 * (1.0 + arm.norm());
        let radial = if on_axis {
            Vector3::zeros()
        } else {
            radial / radius_mm
        };
        Self {
            origin_mm: axis.point_mm.coords.into(),
            along: along.into(),
            across_1: across_1.into(),
            across_2: along.cross(&across_1).into(),
            radial: radial.into(),
            tangential: along.cross(&radial).into(),
            radius_mm: if on_axis { 0.0 } else { radius_mm },
            foot_mm: (axis.point_mm.coords + along * along.dot(&arm)).into(),
        }
    }

    /// The plane that the tool turns in: away from the axis at home, and a quarter turn further. Of a
    /// tool on the axis any direction across it will do.
    pub(crate) fn plane_of_motion(&self) -> [[f64; 3]; 2] {
        if self.radius_mm > 0.0 {
            [self.radial, self.tangential]
        } else {
            [self.across_1, self.across_2]
        }
    }
}

/// A term in its place in a model: what an effect gets to act with.
#[derive(Debug, Clone)]
pub struct Placed {
    /// Joint, counted from 0.
    pub joint: usize,
    /// The scanned parameter.
    pub setting: f64,
    /// Coefficients in inner units.
    pub coefficients: Vec<f64>,
    /// The curve of an unexplained correction.
    pub curve: Option<Arc<Curve>>,
    /// What predicts without a name.
    pub rest: Option<Arc<Rest>>,
    /// Where its columns begin among the model's.
    pub first_column: usize,
    /// The joint's frame.
    pub frame: JointFrame,
    /// Direction of gravity, base frame; `None`: unknown.
    pub down: Option<[f64; 3]>,
    /// Time of the first sample, s.
    pub start_s: f64,
}

/// Limits of a joint, else the range of its values in the data.
pub(crate) fn travel_of(robot: &Robot, joint: usize, q: &[f64]) -> Range {
    robot.joints[joint].limits.unwrap_or_else(|| {
        let [from, to] = extent(q.iter().copied());
        Range { from, to }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sliding_joints_offset_is_in_millimetres() {
        let term = Term::from_parameters("joint-zero-offset", 3, &[("offset_mm", 0.5)], 3).unwrap();
        assert_eq!(term.coefficients, [0.5]);
        let read = term.parameters_on(JointKind::Prismatic);
        assert_eq!((read[0].name, read[0].value), ("offset_mm", 0.5));
        let turning = Term::from_parameters("backlash", 1, &[("width_deg", 1.0)], 1).unwrap();
        assert_eq!(turning.coefficients, [DEGREE]);
    }

    #[test]
    fn every_form_of_an_effect_is_known_by_its_parameters() {
        for effect in crate::effects::CATALOGUE {
            let forms = std::iter::once(*effect).chain(effect.other_forms.iter().copied());
            for form in forms {
                let names = parameter_names(form);
                let mut given = parameters_to_see(form);
                if let Some(other) = given.iter_mut().find(|(name, _)| *name == "from_joint") {
                    other.1 = 1.0;
                }
                let id = form.about().id;
                let read =
                    Term::from_parameters(id, 2, &given, 3).map(|t| parameter_names(t.effect));
                assert_eq!(read.unwrap_or_else(|e| panic!("{id}: {e}")), names);
            }
        }
    }

    #[test]
    fn an_unknown_parameter_is_refused_with_the_known_ones() {
        let wrong = Term::from_parameters("backlash", 1, &[("width_mrad", 1.0)], 1).unwrap_err();
        assert!(wrong.to_string().contains("width_deg"), "{wrong}");
    }
}
