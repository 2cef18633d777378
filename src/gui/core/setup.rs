//! A robot as it is filled in, and of the open session its reflectors and its instrument: numbers as the file has them
//! (mm, degrees, kg), checked as they are typed, and the session that follows from them.

use crate::gui::core::robot_table::RobotTable;
use crate::kinematics::JointKind;
use crate::language::spoken;
use crate::sessions::{Samples, Session, Sigma, Target};
use crate::units::{deg_from_rad, rad_from_deg};

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SetupForm {
    pub(crate) robot: RobotTable,
    /// What it was measured with, where it is the robot of the open session.
    pub(crate) measured: Option<Measured>,
}

/// Reflectors and instrument.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measured {
    pub(crate) targets: Vec<Target>,
    /// Name of the instrument.
    pub(crate) instrument: String,
    /// Its noise, mm.
    pub(crate) sigma: Option<Sigma>,
}

impl SetupForm {
    /// The form as the session fills it in.
    pub(crate) fn of(session: &Session) -> Self {
        Self {
            robot: RobotTable::of(&session.robot),
            measured: Some(Measured {
                targets: session.targets.clone(),
                instrument: session.instrument.name.clone(),
                sigma: session.instrument.sigma_mm,
            }),
        }
    }

    /// What is wrong with it, if anything is.
    pub(crate) fn problem(&self) -> Option<String> {
        let robot = self.robot.robot().err().map(|problem| spoken(&problem));
        robot.or_else(|| self.measured.as_ref()?.problem())
    }

    /// The session with what is filled in here. What was not changed stays as it was to the last
    /// bit.
    ///
    /// # Errors
    /// What is wrong.
    pub(crate) fn session(&self, session: &Session) -> Result<Session, String> {
        if let Some(problem) = self.problem() {
            return Err(problem);
        }
        if self.robot.rows.len() != session.robot.joints.len() {
            return Err(say!("the session has another number of joints").to_owned());
        }
        let mut next = session.clone();
        let robot = self.robot.changed(&session.robot);
        next.robot = robot.map_err(|problem| spoken(&problem))?;
        let joints = next.robot.joints.iter().zip(&session.robot.joints);
        for (joint, (now, was)) in joints.enumerate() {
            if now.kind != was.kind {
                relabel(&mut next.samples, joint, now.kind);
            }
        }
        if let Some(measured) = &self.measured {
            let named = |target: &Target| Target {
                name: target.name.trim().to_owned(),
                ..*target
            };
            next.targets = measured.targets.iter().map(named).collect();
            next.instrument.name.clone_from(&measured.instrument);
            next.instrument.sigma_mm = measured.sigma;
        }
        Ok(next)
    }
}

impl Measured {
    fn problem(&self) -> Option<String> {
        for (k, target) in self.targets.iter().enumerate() {
            let name = target.name.trim();
            if name.is_empty() {
                return Some(say!("a reflector needs a name").to_owned());
            }
            if self.targets[..k].iter().any(|t| t.name.trim() == name) {
                return Some(say!("{name} is taken; choose another name", name));
            }
            if !target.position_mm.iter().all(|mm| mm.is_finite()) {
                return Some(say!("every field needs a number").to_owned());
            }
        }
        let sound = match self.sigma {
            None => true,
            Some(Sigma::Overall(sigma)) => sigma.is_finite() && sigma > 0.0,
            Some(Sigma::PerAxis(sigma)) => sigma.iter().all(|s| s.is_finite() && *s > 0.0),
        };
        (!sound).then(|| say!("the noise is a number above 0").to_owned())
    }

    /// Whether the last reflector may go: no sample shows it, and it is not the only one.
    pub(crate) fn last_target_is_free(&self, session: &Session) -> bool {
        let last = self.targets.len().saturating_sub(1);
        let shown = session.samples.target.as_ref();
        let shown = shown.is_some_and(|t| t.iter().any(|t| *t as usize == last));
        last > 0 && !shown
    }
}

/// A joint that turns instead of sliding, or the other way round: the numbers in the file stay, 30°
/// become 30 mm.
fn relabel(samples: &mut Samples, joint: usize, kind: JointKind) {
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

    fn measured(form: &mut SetupForm) -> &mut Measured {
        form.measured.as_mut().expect("it is of a session")
    }

    fn wrong(change: impl FnOnce(&mut SetupForm)) -> String {
        let session = session();
        let mut form = SetupForm::of(&session);
        change(&mut form);
        form.session(&session).expect_err("it is wrong")
    }

    #[test]
    fn a_form_that_nobody_touched_is_the_session_to_the_last_bit() {
        let session = session();
        let same = SetupForm::of(&session).session(&session).unwrap();
        assert_eq!(same, session);
        // A name alone changes no number.
        let mut form = SetupForm::of(&session);
        form.robot.rows[0].name = "lamp".to_owned();
        let next = form.session(&session).unwrap();
        assert_eq!(next.robot.joints[0].axis, session.robot.joints[0].axis);
        assert_eq!(next.robot.joints[0].limits, session.robot.joints[0].limits);
        assert_eq!(next.robot.base_from_tool, session.robot.base_from_tool);
    }

    #[test]
    fn what_is_filled_in_is_what_the_session_says() {
        let session = session();
        let mut form = SetupForm::of(&session);
        form.robot.rows[0].travel = Some([-45.0, 60.0]);
        form.robot.rows[0].numbers[..3].copy_from_slice(&[0.0, 0.0, -2.0]);
        form.robot.gravity = None;
        measured(&mut form).sigma = Some(Sigma::PerAxis([0.01, 0.02, 0.03]));
        measured(&mut form).targets[0].position_mm[0] += 5.0;
        let next = form.session(&session).unwrap();
        let mut again = SetupForm::of(&next);
        assert_eq!(again.robot.rows[0].numbers[..3], [0.0, 0.0, -1.0]);
        let [from, to] = again.robot.rows[0].travel.unwrap();
        assert!((from + 45.0).abs() < 1e-12 && (to - 60.0).abs() < 1e-12);
        assert_eq!(
            next.instrument.sigma_mm,
            Some(Sigma::PerAxis([0.01, 0.02, 0.03]))
        );
        assert_eq!(measured(&mut again), measured(&mut form));
        assert_eq!(next.robot.gravity_m_s2, None);
        assert_eq!(next.samples, session.samples);
    }

    #[test]
    fn what_makes_no_robot_is_said() {
        for (says, change) in [
            (
                "zero",
                (|f| f.robot.rows[0].numbers = [0.0; 6]) as fn(&mut SetupForm),
            ),
            ("travel", |f| f.robot.rows[0].travel = Some([5.0, 5.0])),
            ("kg", |f| f.robot.rows[0].link = Some((-1.0, [0.0; 3]))),
            ("name", |f| f.robot.rows[0].name = " ".into()),
            ("noise", |f| {
                measured(f).sigma = Some(Sigma::Overall(0.0));
            }),
            ("is taken", |f| {
                let targets = &mut measured(f).targets;
                targets[1].name = targets[0].name.clone();
            }),
        ] {
            let found = wrong(change);
            assert!(found.contains(says), "{says}: {found}");
        }
    }

    #[test]
    fn a_joint_that_slides_after_all_keeps_the_numbers_of_the_file() {
        let session = session();
        let mut form = SetupForm::of(&session);
        form.robot.rows[0].slides = true;
        let next = form.session(&session).unwrap();
        let degrees = deg_from_rad(session.samples.q[0][3]);
        assert!((next.samples.q[0][3] - degrees).abs() < 1e-9);
        let again = SetupForm::of(&next);
        assert_eq!(again.robot.rows[0].travel, form.robot.rows[0].travel);
    }
}
