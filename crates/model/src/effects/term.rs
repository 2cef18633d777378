//! An effect, and a term: an effect in a model, with its joint, its setting and its size. An effect describes its
//! terms.

use super::about::{About, Form, Quantity, Setting};
use super::block::Block;
use super::inputs::Inputs;
use super::placed::Placed;
use super::survey;
use super::survey::Survey;

use crate::numeric::extent;
use crate::text::Text;
use std::sync::Arc;

use crate::kinematics::{JointKind, Range, Robot};
use crate::units::wrapped_positive;

use super::curve::Curve;
use super::rest::Rest;
use super::units::Unit;

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
    pub held: FixedMask,
    /// Name of the setup or of the target that the term belongs to, where it belongs to one.
    pub label: Option<Arc<str>>,
}

/// Which coefficients of a term are held: what the samples cannot distinguish from something else is zero, and is
/// attributed to that.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FixedMask(u32);

impl FixedMask {
    /// All of them.
    #[doc(hidden)]
    pub const ALL: Self = Self(u32::MAX);

    /// The same with one coefficient more, of the first 32: others are always free.
    #[must_use]
    pub fn with(self, coefficient: usize) -> Self {
        let shift = u32::try_from(coefficient).unwrap_or(u32::MAX);
        Self(self.0 | 1_u32.checked_shl(shift).unwrap_or(0))
    }

    /// Whether a coefficient is held.
    pub fn contains(self, coefficient: usize) -> bool {
        coefficient < u32::BITS as usize && self.0 & (1 << coefficient) != 0
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
            held: FixedMask::default(),
            label: None,
        }
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
            let value = self.scanned() / unit.scale;
            parameters.push(Parameter { name, value });
        }
        match about.form {
            Form::Plain(quantities) => {
                for (coefficient, quantity) in self.coefficients.iter().zip(quantities) {
                    let quantity = quantity.on(kind);
                    parameters.push(Parameter {
                        name: quantity.name,
                        value: coefficient / quantity.unit.scale,
                    });
                }
            }
            Form::Harmonic(quantity) => {
                let (a, b) = (self.coefficient(0), self.coefficient(1));
                parameters.push(Parameter {
                    name: quantity.name,
                    value: a.hypot(b) / quantity.unit.scale,
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
                    value: self.coefficient(0) / quantity.unit.scale,
                });
            }
        }
        parameters
    }

    /// The scanned parameter with what was solved for with it, inner units.
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

/// The fade of a setting and its coefficient u: f₀ eᵘ.
pub(super) fn fade(setting: f64, u: f64) -> f64 {
    // Times one is exact, so a settled term acts like the one it came from, bit by bit.
    setting * u.exp()
}

/// Name and inner size of the scanned parameter, where the user sees one.
pub fn setting_quantity(setting: Setting) -> Option<Quantity> {
    match setting {
        Setting::None | Setting::Setup | Setting::Target | Setting::Place => None,
        Setting::Order { from, .. } => {
            let unit = Unit::ONE.with_example(f64::from(from));
            Some(Quantity::new("order", unit))
        }
        Setting::Time => Some(Quantity::new("time_s", Unit::SECOND.with_example(120.0))),
        Setting::Fade => {
            let degrees = Quantity::new("fade_deg", Unit::DEGREE.with_example(5.0));
            Some(degrees.sliding("fade_mm", Unit::MM))
        }
        Setting::Listed(listed) => Some(listed.quantity),
    }
}

/// Names of an effect's parameters in the order in which they are shown.
pub fn parameter_names(effect: &Effect) -> Vec<&'static str> {
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

/// An effect's parameters on a joint of this kind, at values that can be seen in a simulation.
pub fn parameters_to_see(effect: &Effect, kind: JointKind) -> Vec<(&'static str, f64)> {
    let about = effect.about();
    let quantities = setting_quantity(about.setting).into_iter();
    let quantities = quantities.chain(about.form.quantities().iter().copied());
    let quantities = quantities.filter(|q| q.matters_on(kind));
    let shown = quantities.map(|q| (q.on(kind).name, q.on(kind).unit.example));
    let phase = matches!(about.form, Form::Harmonic(_)).then_some(("phase_deg", 30.0));
    shown.chain(phase).collect()
}

/// Names of what identification solves for, one for each coefficient; an amplitude and its phase represent their two
/// parts.
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

/// Limits of a joint, else the range of its values in the data.
pub fn travel_of(robot: &Robot, joint: usize, q: &[f64]) -> Range {
    robot.joints[joint].limits.unwrap_or_else(|| {
        let [from, to] = extent(q.iter().copied());
        Range { from, to }
    })
}

/// One physical effect: the words about it, and what it does.
pub struct Effect {
    pub(super) about: About,
    /// Whether there is such an effect on a joint at all, whatever is measured.
    pub exists_on: fn(usize, JointKind) -> bool,
    /// The same effect with other parameters, for sessions that know less of the machine; one whose parameters another
    /// has as well is before it.
    pub other_forms: &'static [&'static Effect],
    /// Which of [`Effect::other_forms`] a session like this one takes for a joint, if any.
    pub takes_form: fn(&Survey, usize) -> Option<&'static Effect>,
    /// What in the controller's data would remove the effect where commands of the joints cannot;
    /// `None` where only work on the machine does.
    pub remedy: Option<fn(&Robot, &Term) -> Text>,
    /// Figures of the effect in a session that are no parameters of it.
    pub figures: fn(&Placed, &Robot, &Inputs) -> Vec<Figure>,
    /// Changes a block of samples as the effect does, and sets the columns of its coefficients.
    pub act: fn(&Placed, &mut Block),
}

/// The name of a figure with its unit, and the value where the samples show it.
pub type Figure = (&'static str, Option<f64>);

impl Effect {
    /// An effect of one form on every joint, without remedy and figures.
    pub const fn new(about: About, act: fn(&Placed, &mut Block)) -> Self {
        Self {
            about,
            exists_on: |_, _| true,
            other_forms: &[],
            takes_form: |_, _| None,
            remedy: None,
            figures: |_, _, _| Vec::new(),
            act,
        }
    }

    /// Its name, equation, parameters and the words about it.
    pub const fn about(&self) -> &About {
        &self.about
    }

    /// Why this session cannot show the effect on this joint; `None` where it can: the first of
    /// its needs that is not met.
    pub fn obstacle(&self, survey: &Survey, joint: usize) -> Option<Text> {
        if joint >= survey.joints.len() {
            return Some(survey::no_joint(joint));
        }
        let needs = self.about.needs.iter();
        needs
            .map(|need| (need.unmet)(survey, joint))
            .find_map(|reason| reason)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::units::DEGREE;

    #[test]
    fn only_the_first_coefficients_can_be_held() {
        let held = FixedMask::default().with(31).with(32).with(64);
        assert!(held.contains(31) && !held.contains(0) && !held.contains(32));
    }

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
                let mut given = parameters_to_see(form, JointKind::Revolute);
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
