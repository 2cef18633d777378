//! Robot, reflectors and instrument as they are filled in: numbers as the file has them (mm, degrees,
//! kg), checked as they are typed, and the session that follows from them.

use nalgebra::Vector3;

use crate::diagnostic::{Place, Severity};
use crate::gui::core::robot_table::Row;
use crate::kinematics::{Joint, JointKind, pose_from_parts};
use crate::sessions::{Session, Sigma, Target};
use crate::units::{deg_from_rad, rad_from_deg};

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SetupForm {
    /// Name of the robot.
    pub(crate) robot: String,
    /// Joints from base to tool.
    pub(crate) joints: Vec<Row>,
    /// Position of the tool at home, mm.
    pub(crate) tool_mm: [f64; 3],
    /// Its orientation: w, x, y, z.
    pub(crate) tool_wxyz: [f64; 4],
    /// Gravity, m/s².
    pub(crate) gravity: Option<[f64; 3]>,
    /// Reflectors.
    pub(crate) targets: Vec<Target>,
    /// Name of the instrument.
    pub(crate) instrument: String,
    /// Its noise, mm.
    pub(crate) sigma: Option<Sigma>,
}

/// A part of the form that a message can stand at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Field {
    /// A joint's name.
    JointName(usize),
    /// A joint's axis.
    Axis(usize),
    /// A joint's travel.
    Limits(usize),
    /// A link's mass.
    Mass(usize),
    /// The tool's orientation.
    Tool,
    /// A reflector.
    Target(usize),
    /// The instrument's noise.
    Sigma,
    /// The joints as a whole.
    Joints,
}

/// A message and where it stands.
pub(crate) type Problem = (Field, String);

impl SetupForm {
    /// The form as the session fills it in.
    pub(crate) fn of(session: &Session) -> Self {
        let robot = &session.robot;
        let tool = &robot.base_from_tool;
        let turned = tool.rotation.quaternion();
        Self {
            robot: robot.name.clone(),
            joints: robot.joints.iter().map(Row::of).collect(),
            tool_mm: tool.translation.vector.into(),
            tool_wxyz: [turned.w, turned.i, turned.j, turned.k],
            gravity: robot.gravity_m_s2.map(Into::into),
            targets: session.targets.clone(),
            instrument: session.instrument.name.clone(),
            sigma: session.instrument.sigma_mm,
        }
    }

    /// The session with what is filled in here. What was not changed stays as it was to the last
    /// bit.
    ///
    /// # Errors
    /// Everything that is wrong, each with its field.
    pub(crate) fn session(&self, session: &Session) -> Result<Session, Vec<Problem>> {
        let mut problems = Vec::new();
        let before = Self::of(session);
        let mut next = session.clone();
        next.robot.name.clone_from(&self.robot);
        for (k, (form, joint)) in self.joints.iter().zip(&mut next.robot.joints).enumerate() {
            let was = &before.joints[k];
            if form != was {
                change_joint(joint, form, was, k, &mut problems);
            }
            if form.slides != was.slides {
                relabel(&mut next.samples, k, form.kind());
            }
            let taken = self.joints[..k].iter().any(|j| j.name == form.name);
            if form.name.trim().is_empty() {
                problems.push((Field::JointName(k), say!("a joint needs a name").to_owned()));
            } else if taken {
                let says = say!("another joint is called {form}", form = form.name);
                problems.push((Field::JointName(k), says));
            }
        }
        if (self.tool_mm, self.tool_wxyz) != (before.tool_mm, before.tool_wxyz) {
            match pose_from_parts(self.tool_mm, self.tool_wxyz) {
                Ok(pose) => next.robot.base_from_tool = pose,
                Err(error) => problems.push((Field::Tool, error.to_string())),
            }
        }
        next.robot.gravity_m_s2 = self.gravity.map(Vector3::from);
        self.targets(&mut next, &mut problems);
        next.instrument.name.clone_from(&self.instrument);
        next.instrument.sigma_mm = self.sigma;
        let sound = match self.sigma {
            None => true,
            Some(Sigma::Overall(sigma)) => sigma.is_finite() && sigma > 0.0,
            Some(Sigma::PerAxis(sigma)) => sigma.iter().all(|s| s.is_finite() && *s > 0.0),
        };
        if !sound {
            problems.push((
                Field::Sigma,
                say!("the noise is a number above 0").to_owned(),
            ));
        }
        if problems.is_empty() {
            let wrong = next.robot.problems(&Place::default()).into_iter();
            let wrong = wrong.filter(|d| d.severity == Severity::Error);
            problems.extend(wrong.map(|d| (Field::Joints, d.to_string())));
        }
        if problems.is_empty() {
            Ok(next)
        } else {
            Err(problems)
        }
    }

    fn targets(&self, next: &mut Session, problems: &mut Vec<Problem>) {
        let targets = self.targets.iter().map(|form| Target {
            name: form.name.trim().to_owned(),
            ..*form
        });
        next.targets = targets.collect();
        for (k, form) in self.targets.iter().enumerate() {
            let name = form.name.trim();
            if name.is_empty() {
                problems.push((
                    Field::Target(k),
                    say!("a reflector needs a name").to_owned(),
                ));
            } else if self.targets[..k].iter().any(|t| t.name.trim() == name) {
                let says = say!("another reflector is called {name}", name);
                problems.push((Field::Target(k), says));
            }
        }
    }

    /// Whether the last reflector may go: no sample shows it, and it is not the only one.
    pub(crate) fn last_target_is_free(&self, session: &Session) -> bool {
        let last = self.targets.len().saturating_sub(1);
        let shown = session.samples.target.as_ref();
        let shown = shown.is_some_and(|t| t.iter().any(|t| *t as usize == last));
        last > 0 && !shown
    }
}

fn change_joint(joint: &mut Joint, form: &Row, was: &Row, k: usize, problems: &mut Vec<Problem>) {
    form.name.trim().clone_into(&mut joint.name);
    joint.kind = form.kind();
    if form.numbers != was.numbers {
        match form.axis() {
            Ok(axis) => joint.axis = axis,
            Err(error) => problems.push((Field::Axis(k), error.to_string())),
        }
    }
    if (form.travel, form.slides) != (was.travel, was.slides) {
        joint.limits = form.limits();
        if form.travel.is_some_and(|[from, to]| from >= to) {
            let says = say!("limits run from the smaller to the larger value");
            problems.push((Field::Limits(k), says.to_owned()));
        }
    }
    joint.link = form.link_mass();
    if form
        .link
        .is_some_and(|(mass, _)| mass.is_nan() || mass < 0.0)
    {
        problems.push((Field::Mass(k), say!("a mass is 0 kg or more").to_owned()));
    }
}

/// A joint that turns instead of sliding, or the other way round: the numbers in the file stay, 30°
/// become 30 mm.
fn relabel(samples: &mut crate::sessions::Samples, joint: usize, kind: JointKind) {
    let change = |value: &mut f64| {
        *value = match kind {
            JointKind::Prismatic => deg_from_rad(*value),
            JointKind::Revolute => rad_from_deg(*value),
        };
    };
    samples.q[joint].iter_mut().for_each(change);
    samples.q_read[joint].iter_mut().flatten().for_each(change);
    samples.speed[joint].iter_mut().flatten().for_each(change);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::files::first_example;

    fn session() -> Session {
        first_example().session.clone()
    }

    fn wrong(change: impl FnOnce(&mut SetupForm)) -> Vec<Field> {
        let session = session();
        let mut form = SetupForm::of(&session);
        change(&mut form);
        let problems = form.session(&session).expect_err("it is wrong");
        problems.into_iter().map(|(field, _)| field).collect()
    }

    #[test]
    fn a_form_that_nobody_touched_is_the_session_to_the_last_bit() {
        let session = session();
        let same = SetupForm::of(&session).session(&session).unwrap();
        assert_eq!(same, session);
    }

    #[test]
    fn what_is_filled_in_is_what_the_session_says() {
        let session = session();
        let mut form = SetupForm::of(&session);
        form.joints[0].travel = Some([-45.0, 60.0]);
        form.joints[0].numbers[..3].copy_from_slice(&[0.0, 0.0, -2.0]);
        form.sigma = Some(Sigma::PerAxis([0.01, 0.02, 0.03]));
        form.gravity = None;
        form.targets[0].position_mm[0] += 5.0;
        let next = form.session(&session).unwrap();
        let again = SetupForm::of(&next);
        assert_eq!(again.joints[0].numbers[..3], [0.0, 0.0, -1.0]);
        let [from, to] = again.joints[0].travel.unwrap();
        assert!((from + 45.0).abs() < 1e-12 && (to - 60.0).abs() < 1e-12);
        assert_eq!(
            next.instrument.sigma_mm,
            Some(Sigma::PerAxis([0.01, 0.02, 0.03]))
        );
        assert_eq!(again.targets, form.targets);
        assert_eq!(next.samples, session.samples);
    }

    #[test]
    fn what_makes_no_robot_is_said_at_its_field() {
        assert_eq!(wrong(|f| f.joints[0].numbers = [0.0; 6]), [Field::Axis(0)]);
        assert_eq!(
            wrong(|f| f.joints[0].travel = Some([5.0, 5.0])),
            [Field::Limits(0)]
        );
        assert_eq!(
            wrong(|f| f.joints[0].link = Some((-1.0, [0.0; 3]))),
            [Field::Mass(0)]
        );
        assert_eq!(
            wrong(|f| f.joints[0].name = " ".into()),
            [Field::JointName(0)]
        );
        assert_eq!(wrong(|f| f.tool_wxyz = [0.0; 4]), [Field::Tool]);
        assert_eq!(
            wrong(|f| f.sigma = Some(Sigma::Overall(0.0))),
            [Field::Sigma]
        );
        assert_eq!(
            wrong(|f| f.targets[1].name = f.targets[0].name.clone()),
            [Field::Target(1)]
        );
    }

    #[test]
    fn a_joint_that_slides_after_all_keeps_the_numbers_of_the_file() {
        let session = session();
        let mut form = SetupForm::of(&session);
        form.joints[0].slides = true;
        let next = form.session(&session).unwrap();
        let degrees = deg_from_rad(session.samples.q[0][3]);
        assert!((next.samples.q[0][3] - degrees).abs() < 1e-9);
        assert_eq!(SetupForm::of(&next).joints[0].travel, form.joints[0].travel);
    }
}
