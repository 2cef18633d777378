//! New by simulation: a robot of the library or one that was typed, its poses and what is hidden in it; what is wrong
//! with the numbers, and the session that comes out of them.

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::effects::term::parameters_to_see;
use crate::effects::{
    BESIDE_THE_CATALOGUE, CATALOGUE, OF_A_FIRST_SIMULATION, Role, Setting, Term, find,
};
use crate::kinematics::{JointKind, Robot};
use crate::pipeline;
use crate::robots::LibraryRobot;
use crate::sessions::Session;
use crate::simulation::{HiddenEffect, SimulateError, SimulationRequest, parse_scenario};
use crate::text::Text;

use super::document::as_saved;
use super::robot_table::RobotTable;

/// Poses where nothing else is filled in.
const POSES: usize = 120;

/// More poses than this are for the terminal.
const MOST_POSES: usize = 100_000;

/// What the fields are called.
pub(crate) mod field {
    use crate::text::Template;

    pub(crate) const NOISE: Template = phrase!("noise");
    pub(crate) const POSES: Template = phrase!(in "simulation", "poses");
}

/// An effect with the values that are filled in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chosen {
    /// The effect's name.
    pub(crate) id: &'static str,
    /// Its joint, counted from 1.
    pub(crate) joint: usize,
    pub(crate) parameters: Vec<(&'static str, f64)>,
}

impl Chosen {
    /// An effect of a joint of this number and kind, at values that can be seen; `None` where the joint cannot
    /// have it.
    pub(crate) fn on(id: &'static str, (joint, kind): (usize, JointKind)) -> Option<Self> {
        let effect = crate::effects::find(id)?;
        let index = joint.checked_sub(1)?;
        if !(effect.exists_on)(index, kind) {
            return None;
        }
        let mut parameters = parameters_to_see(effect, kind);
        if let Setting::Listed(listed) = effect.about().setting {
            let usual = (listed.usual)(index)?;
            let mut all = parameters.iter_mut();
            if let Some((_, value)) = all.find(|(name, _)| *name == listed.quantity.name) {
                *value = usual;
            }
        }
        Some(Self {
            id,
            joint,
            parameters,
        })
    }

    /// The same where its joint was exchanged for one of this kind: millimetres in place of degrees.
    pub(crate) fn suits(&mut self, kind: JointKind) {
        let there = self.parameters.iter().map(|(name, _)| *name);
        if let Some(fresh) = Self::on(self.id, (self.joint, kind))
            && !there.eq(fresh.parameters.iter().map(|(name, _)| *name))
        {
            *self = fresh;
        }
    }

    /// Whether it belongs to one joint.
    pub(crate) fn per_joint(&self) -> bool {
        crate::effects::find(self.id).is_some_and(|effect| effect.about().per_joint)
    }
}

/// A robot that is simulated.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SimulatedRobot {
    /// What it is called.
    pub(crate) title: String,
    pub(crate) robot: Robot,
    /// Rated load, kg.
    pub(crate) payload_kg: Option<f64>,
}

impl SimulatedRobot {
    /// One of the library.
    pub(crate) fn of(robot: &LibraryRobot) -> Arc<Self> {
        Arc::new(Self {
            title: robot.title(),
            robot: robot.robot.clone(),
            payload_kg: robot.payload_kg,
        })
    }

    /// One that was typed; `None` while it is no robot.
    pub(crate) fn typed(table: &RobotTable) -> Option<Arc<Self>> {
        let robot = table.robot().ok()?;
        Some(Arc::new(Self {
            title: robot.name.clone(),
            robot,
            payload_kg: None,
        }))
    }
}

/// What is simulated, as it is filled in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Form {
    pub(crate) robot: Arc<SimulatedRobot>,
    /// Poses of that robot, anywhere in its ranges.
    pub(crate) poses: usize,
    /// What the robot does that its controller does not know.
    pub(crate) effects: Vec<Chosen>,
    /// Noise of the instrument, mm.
    pub(crate) noise_mm: f64,
    /// Where the noise begins.
    pub(crate) seed: u64,
}

impl Default for Form {
    /// A lamp on one axis that turns.
    fn default() -> Self {
        Self::of(SimulatedRobot::typed(&RobotTable::lamp()).expect("a test makes it a robot"))
    }
}

impl Form {
    /// The form for a robot, with something hidden in it to begin with: in a joint that
    /// carries much: a simulation of a robot without errors would show nothing.
    pub(crate) fn of(robot: Arc<SimulatedRobot>) -> Self {
        let mut form = Self {
            robot,
            poses: POSES,
            effects: Vec::new(),
            noise_mm: 0.03,
            seed: 1,
        };
        let joint = form.joints().min(2);
        let kind = form.joint_kind(joint);
        let hidden = OF_A_FIRST_SIMULATION.map(|id| Chosen::on(id, (joint, kind)));
        form.effects.extend(hidden.into_iter().flatten());
        form
    }

    /// Whether it is of the robot that it begins with where none was chosen.
    pub(crate) fn is_of_the_lamp(&self) -> bool {
        self.robot == Self::default().robot
    }

    /// The same as it was opened.
    pub(crate) fn untouched(&self) -> Self {
        Self::of(Arc::clone(&self.robot))
    }

    /// Joints of what is simulated.
    pub(crate) fn joints(&self) -> usize {
        self.robot.robot.joint_count()
    }

    /// Effects that can be chosen.
    pub(crate) fn offered(&self) -> impl Iterator<Item = (&'static str, &'static str)> + use<> {
        let several = self.joints() > 1;
        let kinds: Vec<JointKind> = (1..=self.joints()).map(|j| self.joint_kind(j)).collect();
        let all = CATALOGUE.iter().chain(BESIDE_THE_CATALOGUE);
        let exists = all.filter(move |effect| {
            let mut joints = kinds.iter().enumerate();
            joints.any(|(joint, kind)| (effect.exists_on)(joint, *kind))
        });
        let all = exists.map(|effect| effect.about());
        all.filter(move |about| match about.role {
            Role::Candidate | Role::JointZero => true,
            Role::JointAxis | Role::ToolPlace => several,
            Role::ToolRadius => !several,
            _ => false,
        })
        .map(|about| (about.id, crate::present::names::title(about.id)))
    }

    /// How a joint moves, counted from 1.
    pub(crate) fn joint_kind(&self, joint: usize) -> JointKind {
        let joint = joint.checked_sub(1);
        let joint = joint.and_then(|joint| self.robot.robot.joints.get(joint));
        joint.map_or(JointKind::Revolute, |joint| joint.kind)
    }

    /// One more effect of this name, on the first joint that has none; `None` where all have it.
    pub(crate) fn another(&self, id: &'static str) -> Option<Chosen> {
        let per_joint = find(id)?.about().per_joint;
        let joints = if per_joint { self.joints() } else { 1 };
        let taken = |joint: &usize| self.effects.iter().any(|o| (o.id, o.joint) == (id, *joint));
        let mut free = (1..=joints).filter(|joint| !taken(joint));
        free.find_map(|joint| Chosen::on(id, (joint, self.joint_kind(joint))))
    }

    /// What is wrong with the numbers; `None` where they can be simulated.
    pub(crate) fn problem(&self) -> Option<String> {
        self.problems().into_iter().next().map(|(_, says)| says)
    }

    /// Everything that is wrong with the numbers, each with the field or the effect that it is about.
    pub(crate) fn problems(&self) -> Vec<(&'static str, String)> {
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
        let joints = self.joints();
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

    fn request(&self) -> SimulationRequest {
        let robot = self.robot.robot.clone();
        let mut request = SimulationRequest::of(robot, self.robot.payload_kg, self.poses);
        request.noise_mm = self.noise_mm;
        request.seed = self.seed;
        let hidden = self.effects.iter().map(|chosen| HiddenEffect {
            effect: chosen.id.to_owned(),
            joint: chosen.per_joint().then_some(chosen.joint),
            parameters: chosen
                .parameters
                .iter()
                .map(|(name, value)| ((*name).to_owned(), *value))
                .collect(),
        });
        request.effects = hidden.collect();
        request
    }

    /// The session and what is hidden in it; `watch` hears which part is done, and may break it off.
    ///
    /// # Errors
    /// What is wrong with the numbers.
    pub(crate) fn session(
        &self,
        watch: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(Session, Vec<Term>), Vec<Text>> {
        if let Some(problem) = self.problem() {
            return Err(vec![Text::verbatim(problem)]);
        }
        let document = self.request().scenario();
        let scenario = parse_scenario(document.as_bytes()).map_err(SimulateError::Rejected);
        let made = scenario.and_then(|one| pipeline::simulate(&one.scenario, self.seed, watch));
        match made {
            Ok((mut session, truth)) => {
                as_saved(&mut session);
                Ok((session, truth.effects))
            }
            Err(SimulateError::Rejected(rejected)) => {
                let problems = rejected.diagnostics.iter();
                Err(problems.map(|d| d.found.clone()).collect())
            }
            Err(stopped @ SimulateError::Stopped) => Err(vec![Text::verbatim(stopped.to_string())]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::in_the_first_joint;
    use crate::robots::library;
    use crate::simulation::unwatched;

    #[test]
    fn the_form_as_it_opens_can_be_simulated_with_every_effect_on_offer() {
        let (session, hidden) = Form::default().session(unwatched).expect("it is valid");
        assert_eq!((session.samples.len(), hidden.len()), (3 * POSES, 2));
        for (id, _) in Form::default().offered() {
            let form = Form {
                effects: vec![in_the_first_joint(id).expect("it is in the catalogue")],
                ..Form::default()
            };
            assert_eq!(form.problem(), None, "{id}");
        }
    }

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
        let mut backlash = in_the_first_joint("backlash").expect("it is in the catalogue");
        backlash.joint = 9;
        form.effects = vec![backlash];
        form.poses = 0;
        let names: Vec<&str> = form.problems().iter().map(|p| p.0).collect();
        assert_eq!(names, [field::POSES.english(), "backlash"]);
    }
}
