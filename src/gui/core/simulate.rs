//! New by simulation: a small form, or the numbers of a robot of the library or one that was typed; what is wrong with
//! them, and the session that comes out of it.

use std::ops::ControlFlow;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use crate::diagnostic::Rejected;
use crate::effects::term::{parameter_names, parameters_to_see};
use crate::effects::{
    BESIDE_THE_CATALOGUE, CATALOGUE, OF_A_FIRST_SIMULATION, Over, Role, Setting, Term, find,
    joint_zero, role, tool_radius,
};
use crate::kinematics::{Axis, Joint, JointKind, LinkMass, Pose, Range, Robot};
use crate::robots::LibraryRobot;
use crate::sessions::{Instrument, Session, Sigma};
use crate::simulation::{
    HiddenEffect, Noise, NoiseKind, Order, Poses, Scenario, SimulateError, SimulationRequest,
    Sweep, Temperature, parse_scenario,
};
use crate::text::Text;
use crate::units::rad_from_deg;

/// More samples than this are for the terminal.
const MOST_SAMPLES: f64 = 1e6;
/// Seconds from one pose to the next.
const SECONDS_PER_POSE: f64 = 6.0;

/// What the fields are called.
pub(crate) mod field {
    use crate::text::Template;

    pub(crate) const RADIUS: Template = phrase!("nominal radius");
    pub(crate) const OFFSET: Template = phrase!("zero offset");
    pub(crate) const LENGTH: Template = phrase!("length error");
    pub(crate) const TOLERANCE: Template = phrase!("tolerance");
    pub(crate) const FROM: Template = phrase!("from");
    pub(crate) const TO: Template = phrase!("to");
    pub(crate) const STEP: Template = phrase!("step");
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
    /// An effect of the first joint, which turns, at values that can be seen.
    #[cfg(any(test, debug_assertions))]
    pub(crate) fn new(id: &'static str) -> Option<Self> {
        Self::on(id, (1, JointKind::Revolute))
    }

    /// An effect of a joint of this number and kind, at values that can be seen; `None` where the joint cannot
    /// have it.
    pub(super) fn on(id: &'static str, (joint, kind): (usize, JointKind)) -> Option<Self> {
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
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Form {
    /// A robot of the library or one that was typed; `None`: a lamp on one turning axis.
    pub(crate) robot: Option<Arc<SimulatedRobot>>,
    /// Poses of that robot, anywhere in its ranges.
    pub(crate) poses: usize,
    /// Nominal radius of the tool, mm.
    pub(crate) radius_mm: f64,
    /// The sweep begins here, deg.
    pub(crate) from_deg: f64,
    /// And ends here, deg.
    pub(crate) to_deg: f64,
    /// From pose to pose, deg.
    pub(crate) step_deg: f64,
    /// Whether it comes back the same way.
    pub(crate) both_ways: bool,
    /// Zero offset of the joint, deg.
    pub(crate) offset_deg: f64,
    /// How much longer the link is, mm.
    pub(crate) length_error_mm: f64,
    /// What else the robot does.
    pub(crate) effects: Vec<Chosen>,
    /// Noise of the instrument, mm.
    pub(crate) noise_mm: f64,
    /// How far a position may be off, mm.
    pub(crate) tolerance_mm: f64,
    /// Where the noise begins.
    pub(crate) seed: u64,
}

impl Default for Form {
    fn default() -> Self {
        Self {
            robot: None,
            poses: 0,
            radius_mm: 250.0,
            from_deg: -90.0,
            to_deg: 90.0,
            step_deg: 3.0,
            both_ways: true,
            offset_deg: -3.0,
            length_error_mm: -5.0,
            effects: Vec::new(),
            noise_mm: 0.03,
            tolerance_mm: 0.2,
            seed: 1,
        }
    }
}

impl Form {
    /// The same as it was opened.
    pub(crate) fn untouched(&self) -> Self {
        self.robot.clone().map_or_else(Self::default, Self::of)
    }

    /// Joints of what is simulated.
    pub(crate) fn joints(&self) -> usize {
        let robot = self.robot.as_ref();
        robot.map_or(1, |robot| robot.robot.joint_count())
    }

    /// Effects that can be chosen: all that a single turning joint can have but the two that have
    /// fields of their own; of a robot the errors of its geometry as well, which have none there.
    pub(crate) fn offered(&self) -> impl Iterator<Item = (&'static str, &'static str)> + use<> {
        let several = self.joints() > 1;
        let robot = self.robot.is_some();
        let kinds: Vec<JointKind> = (1..=self.joints()).map(|j| self.joint_kind(j)).collect();
        let all = CATALOGUE.iter().chain(BESIDE_THE_CATALOGUE);
        let exists = all.filter(move |effect| {
            let mut joints = kinds.iter().enumerate();
            joints.any(|(joint, kind)| (effect.exists_on)(joint, *kind))
        });
        let all = exists.map(|effect| effect.about());
        all.filter(move |about| match about.role {
            Role::Candidate => true,
            Role::JointZero => robot,
            Role::JointAxis | Role::ToolPlace => several,
            Role::ToolRadius => robot && !several,
            _ => false,
        })
        .map(|about| (about.id, crate::present::names::title(about.id)))
    }

    /// How a joint moves, counted from 1.
    pub(crate) fn joint_kind(&self, joint: usize) -> JointKind {
        let robot = self.robot.as_ref();
        let joint = robot.and_then(|robot| robot.robot.joints.get(joint.checked_sub(1)?));
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
        if let Some(robot) = &self.robot {
            return self.problems_of(robot);
        }
        let fields = [
            (field::RADIUS, self.radius_mm),
            (field::OFFSET, self.offset_deg),
            (field::LENGTH, self.length_error_mm),
            (field::TOLERANCE, self.tolerance_mm),
            (field::FROM, self.from_deg),
            (field::TO, self.to_deg),
            (field::STEP, self.step_deg),
            (field::NOISE, self.noise_mm),
        ];
        let infinite = fields.iter().filter(|(_, value)| !value.is_finite());
        let mut problems: Vec<_> = infinite
            .map(|(name, _)| (name.english(), say!("this field needs a number").to_owned()))
            .collect();
        let mut check = |wrong: bool, name: &'static str, says: &str| {
            if wrong && problems.iter().all(|(other, _)| *other != name) {
                problems.push((name, says.to_owned()));
            }
        };
        let radius = (self.radius_mm <= 0.0).then(|| say!("the radius has to be above 0 mm"));
        let tolerance = (self.tolerance_mm < 0.0).then(|| say!("the tolerance cannot be below 0"));
        let to = (self.from_deg >= self.to_deg)
            .then(|| say!("the sweep has to run from the smaller to the larger angle"));
        let step = (self.step_deg <= 0.0).then(|| say!("the step has to be above 0°"));
        let poses = (self.to_deg - self.from_deg) / self.step_deg;
        let many = (poses > MOST_SAMPLES)
            .then(|| say!("that is more than a million poses; take a larger step"));
        let noise = (self.noise_mm < 0.0).then(|| say!("the noise cannot be below 0"));
        for (place, says) in [
            (field::RADIUS, radius),
            (field::TOLERANCE, tolerance),
            (field::TO, to),
            (field::STEP, step),
            (field::STEP, many),
            (field::NOISE, noise),
        ] {
            check(says.is_some(), place.english(), says.unwrap_or_default());
        }
        for chosen in &self.effects {
            let infinite = chosen.parameters.iter().any(|(_, v)| !v.is_finite());
            check(infinite, chosen.id, say!("every field needs a number"));
        }
        for term in self.parts() {
            let place = match role(term.0) {
                Role::JointZero => field::OFFSET.english(),
                Role::ToolRadius => field::LENGTH.english(),
                _ => term.0,
            };
            if let Err(says) = term.1 {
                check(true, place, &says);
            }
        }
        problems
    }

    /// The effects by their names, as terms or why they are none.
    fn parts(&self) -> impl Iterator<Item = (&'static str, Result<Term, String>)> {
        let own = [
            (joint_zero(), self.offset_deg),
            (tool_radius(), self.length_error_mm),
        ];
        let own = own.map(|(effect, value)| {
            let names = parameter_names(effect).into_iter();
            let parameters = names.map(|name| (name, value)).collect();
            (effect.about().id, parameters)
        });
        let chosen = self.effects.iter().map(|c| (c.id, c.parameters.clone()));
        own.into_iter().chain(chosen).map(|(id, parameters)| {
            let term = Term::from_parameters(id, 1, &parameters, 1);
            (id, term.map_err(|e| e.to_string()))
        })
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
        if let Some(robot) = &self.robot {
            return self.session_of(robot, watch);
        }
        let scenario = self.scenario().map_err(|says| vec![Text::verbatim(says)])?;
        self.simulated(Ok(scenario), watch)
    }

    /// The session of a scenario and what is hidden in it, or why there is none.
    pub(super) fn simulated(
        &self,
        scenario: Result<Scenario, Rejected>,
        watch: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(Session, Vec<Term>), Vec<Text>> {
        let scenario = scenario.map_err(SimulateError::Rejected);
        match scenario.and_then(|one| crate::pipeline::simulate(&one, self.seed, watch)) {
            Ok((session, truth)) => Ok((session, truth.effects)),
            Err(SimulateError::Rejected(rejected)) => {
                let problems = rejected.diagnostics.iter();
                Err(problems.map(|d| d.found.clone()).collect())
            }
            Err(stopped @ SimulateError::Stopped) => Err(vec![Text::verbatim(stopped.to_string())]),
        }
    }

    fn scenario(&self) -> Result<Scenario, String> {
        let poses = Poses::Sweep(Sweep {
            joint: 0,
            from: rad_from_deg(self.from_deg),
            to: rad_from_deg(self.to_deg),
            step: rad_from_deg(self.step_deg),
            both_ways: self.both_ways,
            repeats: 1,
            order: Order::Sweep,
        });
        let name = format!("simulated-{}", self.seed);
        let mut scenario = Scenario::new(name, self.robot()?, poses);
        scenario.instrument = Instrument {
            name: "simulated tracker".to_owned(),
            sigma_mm: (self.noise_mm > 0.0).then_some(Sigma::Overall(self.noise_mm)),
            ..Instrument::default()
        };
        scenario.tolerance_mm = (self.tolerance_mm > 0.0).then_some(self.tolerance_mm);
        let terms = self.parts().map(|(_, term)| term);
        scenario.effects = terms.collect::<Result<_, _>>()?;
        scenario.noise = (self.noise_mm > 0.0).then_some(Noise {
            sigma_mm: self.noise_mm,
            kind: NoiseKind::Gauss,
        });
        scenario.seed = self.seed;
        // What the chosen effects depend on has to vary, or they would not show.
        let follows = |over: Over| {
            let mut chosen = self.effects.iter().filter_map(|chosen| find(chosen.id));
            chosen.any(|effect| effect.about().over == over)
        };
        let conditions = &mut scenario.circumstances;
        conditions.seconds_per_pose = Some(SECONDS_PER_POSE);
        if follows(Over::Speed) {
            conditions.speeds = [0.0, 5.0, 20.0].map(rad_from_deg).to_vec();
        }
        if follows(Over::Load) {
            conditions.loads_kg = vec![0.0, 3.0, 6.0];
        }
        if follows(Over::Temperature) {
            conditions.temperature = Some(Temperature::WarmUp {
                from_c: 20.0,
                to_c: 26.0,
                time_constant_s: 600.0,
            });
        }
        Ok(scenario)
    }

    fn robot(&self) -> Result<Robot, String> {
        let axis = Axis::through(Vector3::z(), Point3::origin()).map_err(|e| e.to_string())?;
        let mut joint = Joint::new("pan", JointKind::Revolute, axis);
        joint.limits = Some(Range {
            from: rad_from_deg(self.from_deg),
            to: rad_from_deg(self.to_deg),
        });
        joint.link = Some(LinkMass {
            mass_kg: 4.0,
            centre_mm: Point3::new(0.5 * self.radius_mm, 0.0, 0.0),
        });
        Ok(Robot {
            name: "simulated lamp".to_owned(),
            joints: vec![joint],
            base_from_tool: Pose::translation(self.radius_mm, 0.0, 300.0),
            gravity_m_s2: Some(Vector3::new(0.0, 0.0, -9.81)),
            source: crate::kinematics::RobotSource::Axes,
        })
    }
}

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
    use crate::simulation::unwatched;

    #[test]
    fn the_form_as_it_opens_can_be_simulated() {
        let (session, _) = Form::default()
            .session(unwatched)
            .expect("the default is valid");
        assert_eq!(session.samples.len(), 122);
        let x = session.samples.x_mm[30];
        assert!(
            (x - 245.0 * (-3.0_f64).to_radians().cos()).abs() < 0.2,
            "{x}"
        );
    }

    #[test]
    fn every_effect_on_offer_can_be_simulated_as_it_is_proposed() {
        for (id, _) in Form::default().offered() {
            let form = Form {
                effects: vec![Chosen::new(id).expect("it is in the catalogue")],
                ..Form::default()
            };
            assert_eq!(form.problem(), None, "{id}");
        }
    }

    #[test]
    fn what_cannot_be_simulated_is_said() {
        let form = Form {
            step_deg: 0.0,
            ..Form::default()
        };
        assert!(form.problem().expect("no step").contains("step"));
    }

    #[test]
    fn every_wrong_number_is_named_at_its_field() {
        let mut form = Form {
            radius_mm: -10.0,
            from_deg: 200.0,
            step_deg: 0.0,
            noise_mm: f64::NAN,
            ..Form::default()
        };
        let names = |form: &Form| -> Vec<&str> { form.problems().iter().map(|p| p.0).collect() };
        assert_eq!(
            names(&form),
            [
                field::NOISE.english(),
                field::RADIUS.english(),
                field::TO.english(),
                field::STEP.english()
            ]
        );
        form = Form::default();
        let mut backlash = Chosen::new("backlash").expect("it is in the catalogue");
        backlash.parameters[0].1 = f64::NAN;
        form.effects.push(backlash);
        assert_eq!(names(&form), ["backlash"]);
    }
}

#[cfg(test)]
mod tests_of_simulate_robot {
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
