//! A simulation of a robot of the library, or of one that was typed: the form's numbers as a request, and what is wrong with them.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::effects::{OF_A_FIRST_SIMULATION, Term};
use crate::sessions::Session;
use crate::simulation::{HiddenEffect, SimulationRequest, parse_scenario};

use crate::text::Text;

use super::simulate::{Chosen, Form, SimulatedRobot, field};

/// Poses where nothing else is filled in.
const POSES: usize = 120;

/// More poses than this are for the terminal.
const MOST_POSES: usize = 100_000;

impl Form {
    /// The form for a robot, with something hidden in it to begin with: in a joint that
    /// carries much: a simulation of a robot without errors would show nothing.
    pub(crate) fn of(robot: Arc<SimulatedRobot>) -> Self {
        let mut form = Self {
            robot: Some(robot),
            poses: POSES,
            ..Self::default()
        };
        let joint = form.joints().min(2);
        let kind = form.joint_kind(joint);
        let hidden = OF_A_FIRST_SIMULATION.map(|id| Chosen::on(id, (joint, kind)));
        form.effects.extend(hidden.into_iter().flatten());
        form
    }

    fn request(&self, robot: &SimulatedRobot) -> SimulationRequest {
        let payload = robot.payload_kg;
        let mut request = SimulationRequest::of(robot.robot.clone(), payload, self.poses);
        request.noise_mm = self.noise_mm;
        request.seed = self.seed;
        request.effects = self
            .effects
            .iter()
            .map(|chosen| HiddenEffect {
                effect: chosen.id.to_owned(),
                joint: chosen.per_joint().then_some(chosen.joint),
                parameters: chosen
                    .parameters
                    .iter()
                    .map(|(name, value)| ((*name).to_owned(), *value))
                    .collect(),
            })
            .collect();
        request
    }

    /// Everything that is wrong with the numbers of a robot's simulation, by field or effect.
    pub(super) fn problems_of(&self, robot: &SimulatedRobot) -> Vec<(&'static str, String)> {
        let mut problems = Vec::new();
        if !(1..=MOST_POSES).contains(&self.poses) {
            problems.push((
                field::POSES.english(),
                say!("from 1 to {most} poses", most = MOST_POSES),
            ));
        }
        if !self.noise_mm.is_finite() || self.noise_mm < 0.0 {
            let says = say!("the noise cannot be below 0");
            problems.push((field::NOISE.english(), says.to_owned()));
        }
        let joints = robot.robot.joint_count();
        for chosen in &self.effects {
            let finite = chosen.parameters.iter().all(|(_, value)| value.is_finite());
            let says = if finite {
                let term =
                    Term::from_parameters(chosen.id, chosen.joint, &chosen.parameters, joints);
                term.err().map(|error| error.to_string())
            } else {
                Some(say!("every field needs a number").to_owned())
            };
            problems.extend(says.map(|says| (chosen.id, says)));
        }
        problems
    }

    /// The session of the robot.
    ///
    /// # Errors
    /// What is wrong with the numbers.
    pub(super) fn session_of(
        &self,
        robot: &SimulatedRobot,
        watch: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(Session, Vec<Term>), Vec<Text>> {
        let document = self.request(robot).scenario();
        let parsed = parse_scenario(document.as_bytes());
        self.simulated(parsed.map(|loaded| loaded.scenario), watch)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::JointKind;
    use crate::robots::library;
    use crate::simulation::unwatched;

    #[test]
    fn every_robot_of_the_library_can_be_simulated_as_the_form_opens() {
        for robot in library() {
            let mut form = Form::of(SimulatedRobot::of(robot));
            form.poses = 4;
            assert_eq!(form.problem(), None, "{}", robot.id);
            let (session, hidden) = form.session(unwatched).expect("it can be simulated");
            assert_eq!(
                (session.samples.len(), hidden.len()),
                (12, 2),
                "{}",
                robot.id
            );
        }
    }

    /// Also of joints that slide, whose sizes are millimetres.
    #[test]
    fn every_effect_can_be_hidden_in_every_joint_of_a_scara() {
        let mut scara = library().iter().filter(|robot| {
            let joints = &robot.robot.joints;
            let slides = |kind: JointKind| kind == JointKind::Prismatic;
            !slides(joints[0].kind) && joints.iter().any(|joint| slides(joint.kind))
        });
        let mut form = Form::of(SimulatedRobot::of(scara.next().expect("there is one")));
        form.effects.clear();
        let offered: Vec<&str> = form.offered().map(|(id, _)| id).collect();
        for wanted in ["joint-zero-offset", "link-geometry", "tool-position"] {
            assert!(offered.contains(&wanted), "{wanted}");
        }
        for id in offered {
            while let Some(one) = form.another(id) {
                form.effects.push(one);
            }
        }
        assert_eq!(form.problem(), None);
        let on = |joint: usize, name: &str| {
            let mut all = form.effects.iter();
            all.any(|e| e.joint == joint && e.id == "backlash" && e.parameters[0].0 == name)
        };
        assert!(on(1, "width_deg"));
        let slides = (1..=form.joints()).find(|j| form.joint_kind(*j) == JointKind::Prismatic);
        assert!(on(slides.expect("one slides"), "width_mm"));
    }

    #[test]
    fn a_joint_that_is_not_there_is_said_at_its_effect() {
        let robot = &library()[0];
        let mut form = Form::of(SimulatedRobot::of(robot));
        let mut backlash = Chosen::new("backlash").expect("it is in the catalogue");
        backlash.joint = 9;
        form.effects = vec![backlash];
        form.poses = 0;
        let names: Vec<&str> = form.problems().iter().map(|p| p.0).collect();
        assert_eq!(names, [field::POSES.english(), "backlash"]);
    }
}
