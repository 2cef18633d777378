//! What the window's own tests start from: a workbench whose tasks run at once.

use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use crate::effects::term::parameter_names;
use crate::effects::{Term, joint_zero, tool_radius};
use crate::kinematics::{Axis, Joint, JointKind, LinkMass, Pose, Range, Robot, RobotSource};
use crate::sessions::{Instrument, Session, Sigma};
use crate::simulation::{Noise, NoiseKind, Order, Poses, Scenario, Sweep, unwatched};
use crate::units::rad_from_deg;

use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::core::simulate::Chosen;
use crate::gui::import_draft::ImportDraft;
use crate::gui::jobs::{Jobs, Runner};
use crate::gui::view::Sheet;
use crate::gui::workbench::Workbench;

/// A lamp on one axis that turns, off by 3° and 5 mm too short, swept there and back in steps of this many degrees,
/// with these effects and a little noise.
pub(crate) fn lamp(step_deg: f64, effects: &[&'static str]) -> Arc<LoadedSession> {
    let axis = Axis::through(Vector3::z(), Point3::origin()).expect("it has a direction");
    let mut joint = Joint::new("pan", JointKind::Revolute, axis);
    let [from, to] = [-90.0, 90.0].map(rad_from_deg);
    joint.limits = Some(Range { from, to });
    joint.link = Some(LinkMass {
        mass_kg: 4.0,
        centre_mm: Point3::new(125.0, 0.0, 0.0),
    });
    let robot = Robot {
        name: "simulated lamp".to_owned(),
        joints: vec![joint],
        base_from_tool: Pose::translation(250.0, 0.0, 300.0),
        gravity_m_s2: Some(Vector3::new(0.0, 0.0, -9.81)),
        source: RobotSource::Axes,
    };
    let sweep = Sweep {
        joint: 0,
        from,
        to,
        step: rad_from_deg(step_deg),
        both_ways: true,
        repeats: 1,
        order: Order::Sweep,
    };
    let name = "simulated-1".to_owned();
    let mut scenario = Scenario::new(name, robot, Poses::Sweep(sweep));
    let sigma_mm = 0.03;
    scenario.instrument = Instrument {
        name: "simulated tracker".to_owned(),
        sigma_mm: Some(Sigma::Overall(sigma_mm)),
        ..Instrument::default()
    };
    scenario.tolerance_mm = Some(0.2);
    let own = [(joint_zero(), -3.0), (tool_radius(), -5.0)];
    let own = own.map(|(effect, value)| {
        let names = parameter_names(effect).into_iter();
        (effect.about().id, names.map(|name| (name, value)).collect())
    });
    let chosen = effects.iter().map(|id| {
        let chosen = in_the_first_joint(id).expect("it is in the catalogue");
        (chosen.id, chosen.parameters)
    });
    let terms = own.into_iter().chain(chosen);
    let term = |(id, parameters): (_, Vec<_>)| Term::from_parameters(id, 1, &parameters, 1);
    scenario.effects = terms.map(|one| term(one).expect("it is one")).collect();
    let kind = NoiseKind::Gauss;
    scenario.noise = Some(Noise { sigma_mm, kind });
    scenario.seed = 1;
    scenario.circumstances.seconds_per_pose = Some(6.0);
    let made = crate::pipeline::simulate(&scenario, 1, unwatched);
    let (session, truth): (Session, _) = made.expect("it can be simulated");
    let mut loaded_session = LoadedSession::new(session, Vec::new(), Origin::Simulated);
    loaded_session.hidden = Some(truth.effects.into());
    Arc::new(loaded_session)
}

/// A workbench on a simulated session: both directions, backlash and a little noise.
pub(crate) fn workbench() -> Workbench {
    workbench_on(lamp(3.0, &["backlash"]))
}

pub(crate) fn workbench_on(session: Arc<LoadedSession>) -> Workbench {
    let jobs = Jobs::new(Runner::AtOnce, Arc::new(|| {}));
    Workbench::new(session, jobs)
}

/// An effect of the first joint, which turns, at values that can be seen.
pub(crate) fn in_the_first_joint(id: &'static str) -> Option<Chosen> {
    Chosen::on(id, (1, JointKind::Revolute))
}

impl Workbench {
    /// Whether the answer that is shown belongs to the document as it is.
    pub(crate) fn settled(&self) -> bool {
        match (self.question(), self.derived.identified.made()) {
            (None, _) => true,
            (Some(asked), Some((of, _))) => *of == asked,
            (Some(_), None) => false,
        }
    }

    /// Changes what is said of a foreign file, and looks at it with that.
    pub(crate) fn change_draft(&mut self, change: impl FnOnce(&mut ImportDraft)) {
        if let Some(Sheet::Import(draft)) = &mut self.view.sheet {
            change(draft);
        }
        self.keep_looking();
    }
}
