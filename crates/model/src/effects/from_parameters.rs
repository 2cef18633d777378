//! A term from names and values, as files, scenarios and the terminal state it.

use super::about::{Form, Quantity, Setting};
use super::term::{Effect, Term, names_on, setting_quantity};
use super::units::{DEGREE, MILLIRADIAN};
use super::{Role, find, form_with};
use crate::kinematics::JointKind;
use crate::text::Text;

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
        /// The names that are accepted.
        accepted: String,
    },
    /// A parameter without which the effect has no meaning.
    Missing {
        /// The effect.
        effect: &'static str,
        /// The name that is missing.
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
        /// What is expected.
        expected: Text,
    },
}

impl TermError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::UnknownEffect(effect) => text!(
                "no effect is called '{effect}'; `truepose effects` lists them",
                effect
            ),
            Self::NoSuchJoint { joint, joints } => {
                text!("joint {joint}: the robot has {joints}", joint, joints)
            }
            Self::UnknownParameter {
                effect,
                name,
                accepted: known,
            } => text!(
                "'{effect}' has no parameter '{name}'; it has {known}",
                effect,
                name,
                known
            ),
            Self::Missing { effect, name } => {
                text!("'{effect}' needs '{name}'", effect, name)
            }
            Self::OutOfRange {
                effect,
                name,
                value,
                expected,
            } => text!(
                "'{effect}': {name} is {value}; expected {expected}",
                effect,
                name,
                value,
                expected
            ),
        }
    }
}

displays_what_it_says!(TermError);

impl std::error::Error for TermError {}

impl Term {
    /// From an effect's name, a joint counted from 1 and parameters in the user's units. A
    /// parameter that is left out is zero, a setting has to be there.
    ///
    /// # Errors
    /// An unknown effect or parameter, a joint that is not there, a setting that is missing or
    /// out of range.
    pub fn from_parameters(
        id: &str,
        joint: usize,
        parameters: &[(&str, f64)],
        joints: usize,
    ) -> Result<Self, TermError> {
        let effect = find(id).ok_or_else(|| TermError::UnknownEffect(id.to_owned()))?;
        let given = &renamed(parameters)[..];
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
                accepted: known[0].join(", "),
            });
        }
        // A quantity of a sliding joint goes by its own name.
        let inner_value = |quantity: Quantity| {
            let turning = given.iter().find(|g| g.0 == quantity.name);
            let on_slide = quantity.on(JointKind::Prismatic);
            let sliding = given.iter().find(|g| g.0 == on_slide.name);
            let inner = |g: &(&str, f64), q: Quantity| g.1 * q.unit.scale;
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
            let usual = || usual().map(|value| value * quantity.unit.scale);
            term.setting = inner_value(quantity).or_else(usual).ok_or(missing)?;
            let outer = term.setting / quantity.unit.scale;
            check_setting(effect, [joint - 1, joints], quantity.name, outer)?;
        }
        match about.form {
            Form::Plain(quantities) => {
                for (coefficient, quantity) in term.coefficients.iter_mut().zip(quantities) {
                    *coefficient = inner_value(*quantity).unwrap_or(0.0);
                }
            }
            Form::Harmonic(quantity) => {
                let amplitude = value(quantity.name).unwrap_or(0.0) * quantity.unit.scale;
                let phase = crate::units::rad_from_deg(value("phase_deg").unwrap_or(0.0));
                term.coefficients = vec![amplitude * phase.cos(), amplitude * phase.sin()];
            }
            Form::Fading(quantity) => {
                term.coefficients[0] = inner_value(quantity).unwrap_or(0.0);
            }
        }
        Ok(term)
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

fn check_setting(
    effect: &Effect,
    [joint, joints]: [usize; 2],
    name: &'static str,
    value: f64,
) -> Result<(), TermError> {
    let about = effect.about();
    let expected = match about.setting {
        Setting::Order { from, to } => {
            let fraction = about.setting.takes_fractions();
            let whole = fraction || value.fract() == 0.0;
            let inside = value >= f64::from(from) && value <= f64::from(to);
            (!(whole && inside)).then(|| {
                if fraction {
                    text!("a number from {from} to {to}", from, to)
                } else {
                    text!("a whole number from {from} to {to}", from, to)
                }
            })
        }
        Setting::Fade => (value < 0.0 || !value.is_finite()).then(|| text!("zero or more")),
        Setting::Time => (!value.is_finite()).then(|| text!("a time")),
        Setting::Listed(listed) => {
            (!(listed.takes)(value, joint, joints)).then(|| listed.expected.into())
        }
        Setting::None | Setting::Setup | Setting::Target | Setting::Place => None,
    };
    match expected {
        Some(expected) => Err(TermError::OutOfRange {
            effect: about.id,
            name,
            value,
            expected,
        }),
        None => Ok(()),
    }
}
