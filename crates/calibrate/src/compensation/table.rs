//! The correction of one joint as a table over its limits, one column for each side.
//!
//! The table holds the whole correction, zero offset included. Outside the range that was measured
//! nothing is known: there the correction at the end of the range is held. The steps are equal; a
//! step that does not divide the travel is made smaller until it does. Between entries the value
//! is interpolated linearly.
//!
//! A robot with several joints gets a table that depends on one joint only: it cancels the effects of this joint on
//! its own angle (zero offset, scale, eccentricity, backlash …), so that it goes where it is commanded. Errors of the
//! geometry depend on all joints at once and cannot be in such a table; they belong into the controller's kinematic
//! data. Where the joint's wind-up depends on the other joints (compliance), they are at home, and the table states
//! it.

use crate::effects::{JointFrame, Stage, Term};
use crate::kinematics::{JointKind, Range};
use crate::lanes::add_scaled;
use crate::model::{Calibration, Model, RawJoint};
use crate::observations::ANGLES_AT_MM;
use crate::rounding;
use crate::text::Text;
use crate::units::deg_from_rad;

use super::conditions::{Conditions, Side};
use super::hand_out::VerifiedCalibration;
use super::interpolation::UniformTable;
use super::inverse::{closest_commands, places};
use super::plan::Compensation;
use super::table_error::TableError;

/// More entries than this are a slip of the keyboard.
pub(crate) const MOST_ENTRIES: usize = 1_000_000;

/// See the module. Values are in inner units; [`JointTable::to_display`] gives those of the user.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTable {
    /// Joint, counted from 0.
    pub joint: usize,
    /// Its name.
    pub name: String,
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// Commanded values in the user's unit: degrees or mm.
    pub commanded_outer: Vec<f64>,
    /// The step between them, in the user's unit.
    pub step_outer: f64,
    /// What to add when the joint moves to larger values, rad or mm.
    pub forward: Vec<f64>,
    /// What to add when it moves to smaller values, rad or mm.
    pub reverse: Vec<f64>,
    /// Range of the samples; outside it the end values are held. rad or mm.
    pub measured: Range,
    /// The conditions that it is made for.
    pub conditions: Conditions,
    /// What else there is to know about it.
    pub notes: Vec<Text>,
}

impl JointTable {
    /// The table of a joint (counted from 0) with a step in degrees or mm.
    ///
    /// # Errors
    /// See [`TableError`].
    pub fn new(
        calibration: &VerifiedCalibration,
        joint: usize,
        step_outer: f64,
        conditions: Conditions,
    ) -> Result<Self, TableError> {
        calibration.may_correct()?;
        let robot = &calibration.model.robot;
        let joints = robot.joints.len();
        let Some(own) = robot.joints.get(joint) else {
            return Err(TableError::None(text!(
                "joint {joint}: the robot has {joints}",
                joint = joint.saturating_add(1),
                joints
            )));
        };
        let mut notes = Vec::new();
        let raw = raw_joint(calibration, joint)?;
        let measured = *calibration.measured.get(joint).ok_or_else(no_range)?;
        let measured = in_raw_values(measured, raw);
        let travel = own.limits.unwrap_or(measured);
        if own.limits.is_none() {
            notes.push(text!(
                "the joint has no limits: the table covers the measured range"
            ));
        }
        let grid = EqualSteps::new(own.kind, travel, step_outer)?;
        notes.extend(grid.note(step_outer));
        let held: Vec<f64> = grid
            .to_base_units(own.kind)
            .iter()
            .map(|q| raw.to_model(q.max(measured.from).min(measured.to)))
            .collect();
        let column = |side: Side| {
            let side = if raw.sign < 0.0 {
                side.reversed()
            } else {
                side
            };
            let of_model = if joints == 1 {
                whole_correction(calibration, &held, side, &conditions)
            } else {
                own_correction(calibration, joint, &held, side, &conditions)
            };
            let signed = of_model.into_iter().map(|by| raw.sign * by);
            signed.collect::<Vec<f64>>()
        };
        if !raw.is_plain() {
            let outer = own.kind.to_display(raw.at_zero);
            let value = format!("{outer:.3}{}", own.kind.sign());
            notes.push(if raw.sign < 0.0 {
                text!(
                    "commands and corrections are the controller's: it counts joint {joint} the other way as the model, whose value is {value} where the controller's is 0",
                    joint = joint + 1,
                    value
                )
            } else {
                text!(
                    "commands and corrections are the controller's: it counts joint {joint} the same way as the model, whose value is {value} where the controller's is 0",
                    joint = joint + 1,
                    value
                )
            });
        }
        let (forward, reverse) = (column(Side::Forward), column(Side::Reverse));
        let mut table = Self {
            joint,
            name: own.name.clone(),
            kind: own.kind,
            commanded_outer: grid.commanded,
            step_outer: grid.step,
            forward,
            reverse,
            measured,
            conditions,
            notes,
        };
        table.add_notes(calibration, travel);
        Ok(table)
    }

    /// Unit of the joint as in names and texts.
    pub fn unit(&self) -> &'static str {
        self.kind.unit()
    }

    /// A value of the joint in the user's unit.
    pub fn to_display(&self, inner: f64) -> f64 {
        self.kind.to_display(inner)
    }

    /// The column of a side (in inner units, over commands in inner units), to look values up in.
    pub fn lookup(&self, side: Side) -> UniformTable {
        let inner = |outer: f64| self.kind.to_base_units(outer);
        let values: Vec<f64> = match side {
            Side::Forward => self.forward.clone(),
            Side::Reverse => self.reverse.clone(),
            Side::Unknown => {
                let both = self.forward.iter().zip(&self.reverse);
                both.map(|(f, r)| 0.5 * (f + r)).collect()
            }
        };
        let (from, step) = (inner(self.commanded_outer[0]), inner(self.step_outer));
        UniformTable::new(from, step, &values)
    }

    /// Notes on the table.
    fn add_notes(&mut self, calibration: &Calibration, travel: Range) {
        let (unit, outer) = (self.unit(), |v: f64| self.to_display(v));
        let mut notes = Vec::new();
        let measured = self.measured;
        if travel.from < measured.from || travel.to > measured.to {
            notes.push(text!(
                "measured from {from} to {to}; outside, the correction at the end of that range is held",
                from = format!("{:.3}", outer(measured.from)),
                to = format!("{:.3} {unit}", outer(measured.to))
            ));
        }
        let joints = calibration.model.robot.joints.len();
        if joints > 1 {
            let joint = self.joint + 1;
            notes.push(if self.kind == JointKind::Revolute {
                text!(
                    "the table cancels what joint {joint} does to its own angle; errors of the geometry depend on all joints and belong into the controller's kinematic data",
                    joint
                )
            } else {
                text!(
                    "the table cancels what joint {joint} does to its own travel; errors of the geometry depend on all joints and belong into the controller's kinematic data",
                    joint
                )
            });
            let terms = calibration.model.terms().iter();
            let own = terms.filter(|t| t.joint == self.joint);
            for about in own.map(|t| t.effect.about()) {
                if about.of_other_joints {
                    notes.push(text!(
                        "the {effect} of this joint depends on the other joints: here they are at home",
                        effect = Text::named(about.title.english().to_lowercase(), about.title)
                    ));
                }
            }
        }
        notes.extend(unexplained_part(calibration, self.joint));
        let mut own = calibration.model.terms().iter();
        if own.any(|t| t.rest().is_some()) {
            notes.push(text!(
                "what the model predicts without a name follows several joints and is not in this table"
            ));
        }
        if !calibration.regions.is_empty() {
            notes.push(text!(
                "the correction jumps at the boundaries of the regions; between two entries the table makes a ramp of it"
            ));
        }
        self.notes.extend(notes);
    }
}

fn no_range() -> TableError {
    TableError::None(text!(
        "the joint has no limits and was measured at a single value: there is no range for a table"
    ))
}

/// How the controller counts a joint.
fn raw_joint(calibration: &Calibration, joint: usize) -> Result<RawJoint, TableError> {
    let no_table = |why: Text| {
        TableError::None(text!(
            "no table for joint {joint}: {why}, and the model corrected that; correct it in the controller or in the session, identify again and make the table from that model",
            joint = joint + 1,
            why
        ))
    };
    calibration.set_up.raw_joint(joint).map_err(no_table)
}

/// A range of the model's values as the controller counts them.
fn in_raw_values(range: Range, raw: RawJoint) -> Range {
    let (a, b) = (raw.to_raw(range.from), raw.to_raw(range.to));
    Range {
        from: a.min(b),
        to: a.max(b),
    }
}

/// What of a joint's table has no name, in words.
fn unexplained_part(calibration: &Calibration, joint: usize) -> Vec<Text> {
    let model = &calibration.model;
    let slides = model.robot.joints[joint].kind == JointKind::Prismatic;
    let own = model.terms().iter().filter(|t| t.joint == joint);
    let curves = own.filter_map(Term::curve);
    let notes = curves.map(|curve| {
        let (unit, outer): (&str, fn(f64) -> f64) = if slides {
            (" mm", |v| v)
        } else {
            ("°", deg_from_rad)
        };
        text!(
            "up to {size} of it is an unexplained smooth correction, measured from {from} to {to}: no effect of the catalogue explains it, and outside that range its end values are held",
            size = format!("{:.4}{unit}", outer(curve.largest()[0])),
            from = format!("{:.2}", outer(curve.knots().from)),
            to = format!("{:.2}{unit}", outer(curve.knots().to))
        )
    });
    notes.collect()
}

/// Equal steps over the travel, in the user's unit.
struct EqualSteps {
    commanded: Vec<f64>,
    step: f64,
}

impl EqualSteps {
    fn new(kind: JointKind, travel: Range, step: f64) -> Result<Self, TableError> {
        if !(step.is_finite() && step > 0.0) {
            return Err(TableError::None(text!(
                "a step of {step}; expected a positive number",
                step
            )));
        }
        let outer = |v: f64| match kind {
            // Whole degrees come out whole.
            JointKind::Revolute => tidy(deg_from_rad(v)),
            JointKind::Prismatic => v,
        };
        let (from, to) = (outer(travel.from), outer(travel.to));
        let span = to - from;
        if !(span.is_finite() && span > 0.0) {
            return Err(no_range());
        }
        // A step that divides the travel up to rounding divides it.
        let steps = (span / step - 1e-9).ceil().max(1.0);
        if steps + 1.0 > MOST_ENTRIES as f64 {
            return Err(TableError::None(text!(
                "a step of {step} makes {entries} entries; expected at most {most}",
                step,
                entries = steps + 1.0,
                most = MOST_ENTRIES
            )));
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 1 and the most entries"
        )]
        let count = steps as usize;
        let at = |k: usize| {
            if k == count {
                to
            } else {
                tidy(from + span * k as f64 / steps)
            }
        };
        Ok(Self {
            commanded: (0..=count).map(at).collect(),
            step: span / steps,
        })
    }

    fn to_base_units(&self, kind: JointKind) -> Vec<f64> {
        let inner = |outer: &f64| kind.to_base_units(*outer);
        self.commanded.iter().map(inner).collect()
    }

    fn note(&self, asked: f64) -> Option<Text> {
        let differs = (self.step - asked).abs() > rounding::COMPUTED * asked;
        differs.then(|| {
            text!(
                "a step of {asked} does not divide the travel: the steps are {steps}",
                asked,
                steps = tidy(self.step)
            )
        })
    }
}

/// A number without the last bits of a conversion: 90.00000000000001 becomes 90.
fn tidy(value: f64) -> f64 {
    let rounded = (value * 1e9).round() / 1e9;
    if (value - rounded).abs() <= rounding::LAST_BITS * value.abs().max(1.0) {
        rounded
    } else {
        value
    }
}

/// Everything that the single joint can correct.
fn whole_correction(
    calibration: &Calibration,
    q: &[f64],
    side: Side,
    conditions: &Conditions,
) -> Vec<f64> {
    let compensation = Compensation::new(calibration);
    let homes = compensation.reflectors_at_home.clone();
    let inputs = conditions.inputs(vec![q.to_vec()], side, homes);
    let mut corrections = compensation.joint_corrections(&inputs);
    corrections.swap_remove(0)
}

/// The effects of a joint on its own value; of what is unexplained the part along its motion.
fn own_effects(model: &Model, joint: usize) -> Model {
    let own = |term: &Term| -> Option<Term> {
        if term.joint != joint {
            return None;
        }
        if let Some(curve) = term.curve() {
            return Some(Term::unexplained(joint, curve.along_the_motion()));
        }
        (term.effect.about().stage == Stage::Joint).then(|| term.clone())
    };
    let terms = model.terms().iter().filter_map(own);
    Model::new(model.robot.clone(), terms.collect())
}

/// What a joint of an arm can correct of its own value: its effects alone, at a point with a long lever about it.
fn own_correction(
    calibration: &Calibration,
    joint: usize,
    q: &[f64],
    side: Side,
    conditions: &Conditions,
) -> Vec<f64> {
    let robot = &calibration.model.robot;
    // A table over one joint does not hold what predicts without a name and follows several.
    let own = own_effects(&calibration.model.with_geometry_alone(), joint);
    let frame = JointFrame::new(robot, joint);
    let columns = (0..robot.joints.len()).map(|j| {
        if j == joint {
            q.to_vec()
        } else {
            vec![0.0; q.len()]
        }
    });
    let seen_at = vec![add_scaled(frame.origin_mm, frame.across_1, ANGLES_AT_MM)];
    let inputs = conditions.inputs(columns.collect(), side, seen_at);
    let wanted = places(&Model::nominal(robot.clone()), &inputs);
    let commands = closest_commands(&own, &inputs, &wanted, &[joint]);
    let commands = commands[joint].iter().zip(q);
    commands.map(|(command, q)| command - q).collect()
}

#[cfg(test)]
mod tests {
    use super::tidy;

    #[test]
    fn a_conversions_last_bits_go_and_what_was_asked_for_stays() {
        assert_eq!(tidy(90.000_000_000_000_01).to_string(), "90");
        assert_eq!(tidy(-0.300_000_000_000_000_04).to_string(), "-0.3");
        assert_eq!(tidy(0.123_456_789_012), 0.123_456_789_012);
    }
}
