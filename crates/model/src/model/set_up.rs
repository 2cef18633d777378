//! The conventions of a controller and an instrument where they are not those of the robot's description:
//! set-up errors that were corrected before the fit.
//!
//! A model describes the robot in its own convention. What comes in raw (the samples of a session, the joint
//! values of a program) is brought into it by the corrections in their order; what goes out (corrected
//! commands, tables, poses to measure) is brought back by their inverses in reverse order, as the
//! controller still has its sign and its home.
//!
//! ```text
//! q = c_n(… c_2(c_1(q_raw)))          q_raw = c_1⁻¹(… c_n⁻¹(q))
//! ```
//!
//! Joint values are in rad and mm. Corrections of single samples (rows that were paired again, copies, a load in
//! another unit, a target that is elsewhere) are about the one session that the model came from: they are kept so that
//! this session is read as it was fitted, and no other is.

use std::borrow::Cow;

use crate::kinematics::{JointKind, Robot};
use crate::sessions::{Corrected, Session, SessionCorrection, hash_of_samples};
use crate::text::Text;

/// Corrections between what controller and instrument write and what the robot's description means.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SetUp {
    /// In the order in which they were made.
    all: Vec<SessionCorrection>,
    conventions: Vec<SessionCorrection>,
}

/// A joint whose raw value differs from the model's by its sign and by a constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RawJoint {
    /// +1, or −1 where the raw value counts the other way.
    pub sign: f64,
    /// The joint's value in the model where the raw one is 0, rad or mm.
    pub at_zero: f64,
}

impl RawJoint {
    /// The joint's value in the model.
    pub fn to_model(self, raw: f64) -> f64 {
        self.sign * raw + self.at_zero
    }

    /// The raw value.
    pub fn to_raw(self, value: f64) -> f64 {
        self.sign * (value - self.at_zero)
    }

    /// Whether both are the same.
    pub fn is_plain(self) -> bool {
        self.sign > 0.0 && self.at_zero == 0.0
    }
}

/// Whether a correction is about how a controller or an instrument counts, not about samples.
fn is_a_convention(correction: &SessionCorrection) -> bool {
    matches!(
        correction,
        SessionCorrection::ScaleJoint { .. }
            | SessionCorrection::ScaleJoints { .. }
            | SessionCorrection::ExchangeJoints { .. }
            | SessionCorrection::CoupleJoint { .. }
            | SessionCorrection::TakeReadBack
            | SessionCorrection::TurnHome { .. }
            | SessionCorrection::ScaleLengths(_)
            | SessionCorrection::ScaleCoordinate { .. }
            | SessionCorrection::Reorder(_)
            | SessionCorrection::FreeFrame
            | SessionCorrection::TurnGravity(_)
            | SessionCorrection::StraightenSight(_)
    )
}

impl SetUp {
    /// Of corrections in the order in which they were made.
    pub fn new(corrections: impl IntoIterator<Item = SessionCorrection>) -> Self {
        let all: Vec<SessionCorrection> = corrections.into_iter().collect();
        let conventions = all.iter().filter(|one| is_a_convention(one));
        Self {
            conventions: conventions.cloned().collect(),
            all,
        }
    }

    /// Whether raw values are the model's, but for single samples of its own session.
    pub fn is_empty(&self) -> bool {
        self.conventions.is_empty()
    }

    /// Whether the model's own session is read as it is in its file.
    pub fn leaves_own_samples(&self) -> bool {
        self.all.is_empty()
    }

    /// The corrections of what holds for every session of this controller and instrument, in the order in which they are
    /// made.
    pub fn corrections(&self) -> &[SessionCorrection] {
        &self.conventions
    }

    /// Every correction of the model's own session, in the order in which they are made.
    pub fn all(&self) -> &[SessionCorrection] {
        &self.all
    }

    /// What the corrections of every session do, in words.
    pub fn describe(&self) -> Text {
        let mut all = Text::default();
        for (index, one) in self.conventions.iter().enumerate() {
            if index > 0 {
                all += Text::verbatim(", ");
            }
            all += one.describe();
        }
        all
    }

    /// A session as the model reads it; `own` is whether the model came from it. One that was corrected in memory
    /// stays as it is, and so does the measuring frame of a session that names its own.
    pub fn applied<'s>(&self, session: &'s Session, own: bool) -> Cow<'s, Session> {
        let made = if own { &self.all } else { &self.conventions };
        if made.is_empty() || session.samples.corrected.is_some() {
            return Cow::Borrowed(session);
        }
        let mut read = session.clone();
        for correction in made {
            if *correction == SessionCorrection::FreeFrame && read.samples.setups.is_some() {
                continue;
            }
            correction.apply_keeping_rows(&mut read);
        }
        read.samples.corrected = Some(Corrected {
            by: made.clone(),
            raw_hash: hash_of_samples(session),
        });
        Cow::Owned(read)
    }

    /// Whether it changes any joint value.
    pub fn moves_joints(&self) -> bool {
        let about_joints = |c: &SessionCorrection| {
            !matches!(
                c,
                SessionCorrection::TakeReadBack
                    | SessionCorrection::ScaleLengths(_)
                    | SessionCorrection::ScaleCoordinate { .. }
                    | SessionCorrection::Reorder(_)
                    | SessionCorrection::FreeFrame
                    | SessionCorrection::TurnGravity(_)
            )
        };
        self.conventions.iter().any(about_joints)
    }

    /// Raw joint values as the model has them.
    pub fn to_model(&self, robot: &Robot, q: &mut [f64]) {
        for correction in &self.conventions {
            changed(correction, robot, q, false);
        }
    }

    /// Joint values of the model as the controller takes them.
    pub fn to_raw(&self, robot: &Robot, q: &mut [f64]) {
        for correction in self.conventions.iter().rev() {
            changed(correction, robot, q, true);
        }
    }

    /// Sides from which joints come, or other signs of their motion, as the controller counts them.
    pub fn signs_to_raw(&self, signs: &mut [f64]) {
        for correction in self.conventions.iter().rev() {
            turned(correction, signs);
        }
    }

    /// Raw sides from which joints come, or other signs of their motion, as the model counts them.
    pub fn signs_to_model(&self, signs: &mut [f64]) {
        for correction in &self.conventions {
            turned(correction, signs);
        }
    }

    /// How one joint counts, where that is a matter of its own sign and home.
    ///
    /// # Errors
    /// In words why it is not: which other joint its value depends on, or that its unit was wrong.
    pub fn raw_joint(&self, joint: usize) -> Result<RawJoint, Text> {
        let mut own = RawJoint {
            sign: 1.0,
            at_zero: 0.0,
        };
        for correction in &self.conventions {
            match correction {
                SessionCorrection::ScaleJoint { joint: of, factor } if *of == joint => {
                    if factor.abs() != 1.0 {
                        return Err(text!(
                            "the session has the values of joint {joint} in another unit",
                            joint = joint + 1
                        ));
                    }
                    own.sign *= factor;
                    own.at_zero *= factor;
                }
                SessionCorrection::ScaleJoints { .. } => {
                    return Err(text!(
                        "the session has the values of all joints in another unit"
                    ));
                }
                SessionCorrection::TurnHome { joint: of, by_rad } if *of == joint => {
                    own.at_zero += by_rad;
                }
                SessionCorrection::ExchangeJoints { first, second }
                    if [*first, *second].contains(&joint) =>
                {
                    return Err(text!(
                        "the session has joints {a} and {b} exchanged",
                        a = first + 1,
                        b = second + 1
                    ));
                }
                SessionCorrection::CoupleJoint {
                    joint: of, from, ..
                } if [*of, *from].contains(&joint) => {
                    return Err(text!(
                        "the session has joints {a} and {b} coupled",
                        a = from + 1,
                        b = of + 1
                    ));
                }
                _ => {}
            }
        }
        Ok(own)
    }
}

/// One correction of the signs of joint motion, which is its own inverse.
fn turned(correction: &SessionCorrection, signs: &mut [f64]) {
    match correction {
        SessionCorrection::ScaleJoint { joint, factor } if *factor < 0.0 => {
            if let Some(sign) = signs.get_mut(*joint).filter(|sign| **sign != 0.0) {
                *sign = -*sign;
            }
        }
        SessionCorrection::ExchangeJoints { first, second }
            if (*first).max(*second) < signs.len() =>
        {
            signs.swap(*first, *second);
        }
        _ => {}
    }
}

/// One correction of joint values, or its inverse.
fn changed(correction: &SessionCorrection, robot: &Robot, q: &mut [f64], back: bool) {
    let scaled = |value: &mut f64, factor: f64| {
        if back {
            *value /= factor;
        } else {
            *value *= factor;
        }
    };
    match correction {
        SessionCorrection::ScaleJoint { joint, factor } => {
            if let Some(value) = q.get_mut(*joint) {
                scaled(value, *factor);
            }
        }
        SessionCorrection::ScaleJoints { factor } => {
            for (value, joint) in q.iter_mut().zip(&robot.joints) {
                if joint.kind == JointKind::Revolute {
                    scaled(value, *factor);
                }
            }
        }
        SessionCorrection::ExchangeJoints { first, second } if (*first).max(*second) < q.len() => {
            q.swap(*first, *second);
        }
        SessionCorrection::CoupleJoint {
            joint,
            from,
            factor,
        } if joint != from && (*joint).max(*from) < q.len() => {
            let by = factor * q[*from];
            q[*joint] += if back { -by } else { by };
        }
        SessionCorrection::TurnHome { joint, by_rad } => {
            if let Some(value) = q.get_mut(*joint) {
                *value += if back { -by_rad } else { *by_rad };
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    fn three_joints() -> Robot {
        let joint = r#"{"name":"j","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}"#;
        let tool = r#"{"position_mm":[1,0,0],"quaternion_wxyz":[1,0,0,0]}"#;
        let robot = format!(r#"{{"name":"r","joints":[{joint},{joint},{joint}],"tool":{tool}}}"#);
        crate::sessions::parse_robot(robot.as_bytes())
            .unwrap()
            .robot
    }

    #[test]
    fn what_goes_out_is_the_inverse_of_what_comes_in() {
        let robot = three_joints();
        let set_up = SetUp::new([
            SessionCorrection::ScaleJoint {
                joint: 2,
                factor: -1.0,
            },
            SessionCorrection::TurnHome {
                joint: 2,
                by_rad: 0.5,
            },
            SessionCorrection::CoupleJoint {
                joint: 2,
                from: 1,
                factor: -1.0,
            },
            SessionCorrection::ExchangeJoints {
                first: 0,
                second: 1,
            },
            SessionCorrection::Remove(vec![1, 2]),
        ]);
        assert_eq!(set_up.corrections().len(), 4);
        assert_eq!(set_up.all().len(), 5);
        let raw = [0.3, -0.7, 1.1];
        let mut q = raw;
        set_up.to_model(&robot, &mut q);
        assert_eq!(q, [-0.7, 0.3, -1.1 + 0.5 + 0.7]);
        set_up.to_raw(&robot, &mut q);
        for (a, b) in q.iter().zip(raw) {
            assert!((a - b).abs() < 1e-15, "{q:?}");
        }
        assert!(set_up.raw_joint(2).is_err());
    }

    #[test]
    fn a_joint_that_counts_the_other_way_from_another_home() {
        let set_up = SetUp::new([
            SessionCorrection::ScaleJoint {
                joint: 0,
                factor: -1.0,
            },
            SessionCorrection::TurnHome {
                joint: 0,
                by_rad: 0.25,
            },
        ]);
        let joint = set_up.raw_joint(0).unwrap();
        assert_eq!((joint.to_model(1.0), joint.to_raw(-0.75)), (-0.75, 1.0));
        assert!(set_up.raw_joint(1).unwrap().is_plain());
        let mut sides = [1.0, -1.0];
        set_up.signs_to_raw(&mut sides);
        assert_eq!(sides, [-1.0, -1.0]);
    }
}
