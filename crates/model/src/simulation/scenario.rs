//! The scenario of a simulation, in inner units (mm, rad, s, kg, °C).

use crate::text::{Template, Text};
use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Place};
use crate::effects::{AvailableColumns, PlaceKind, Term};
use crate::kinematics::Robot;
use crate::sessions::{Instrument, Region, Target};

/// See the module. Begin with [`Scenario::new`] and set what differs.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Name of the session.
    pub name: String,
    /// Free text for the session.
    pub note: String,
    /// The robot as its controller believes it to be.
    pub robot: Robot,
    /// Reflectors; every stop is measured on each of them, in this order.
    pub targets: Vec<Target>,
    /// The instrument as the session describes it; the simulated one is `noise`.
    pub instrument: Instrument,
    /// Tolerance of the session, mm.
    pub tolerance_mm: Option<f64>,
    /// Regions of the session.
    pub regions: Vec<Region>,
    /// Whether z is left unmeasured.
    pub planar: bool,
    /// Where the robot goes.
    pub poses: Poses,
    /// Speeds, loads, temperatures, time.
    pub circumstances: Circumstances,
    /// What makes the real robot differ from the nominal one.
    pub effects: Vec<Term>,
    /// What the instrument adds to each coordinate.
    pub noise: Option<Noise>,
    /// Measurements that went wrong.
    pub outliers: Option<Outliers>,
    /// How the samples are measured, in turn; points by default.
    pub measure: Vec<Measure>,
    /// Places that the written session does not state.
    pub unknown: Vec<PlaceKind>,
    /// Coordinates are rounded to multiples of this, mm.
    pub resolution_mm: Option<f64>,
    /// Default seed.
    pub seed: u64,
}

named! {
    /// How one sample is measured.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Measure {
        /// Where the target is.
        Point = "point",
        /// That, and how the tool is turned.
        Pose = "pose",
        /// From the anchors in turn.
        Distance = "distance",
        /// From the stations in turn.
        Bearing = "bearing",
        /// Where the tool points.
        Pointing = "pointing",
        /// The target sits in the sockets in turn; the stops are moved there.
        Socket = "socket",
        /// The target lies in the planes in turn; the stops are moved there.
        Touch = "touch",
    }
    /// Its name in files.
    pub fn name;
    /// Every one.
    pub const ALL;
}

/// Where the robot goes.
#[derive(Debug, Clone, PartialEq)]
pub enum Poses {
    /// One joint from end to end, the others at home.
    Sweep(Sweep),
    /// These stops in this order.
    List(Vec<Stop>),
    /// So many, every joint anywhere between its limits.
    Random(usize),
}

/// See [`Poses::Sweep`].
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Joint, counted from 0.
    pub joint: usize,
    /// First stop, rad or mm.
    pub from: f64,
    /// Last stop, where the steps lead there; rad or mm.
    pub to: f64,
    /// Way between two stops, rad or mm; its sign does not matter.
    pub step: f64,
    /// Whether every sweep is made back as well.
    pub both_ways: bool,
    /// How often the whole is made.
    pub repeats: usize,
    /// In which order the stops are visited.
    pub order: Order,
}

/// The order of a sweep's stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// One after the other.
    #[default]
    Sweep,
    /// Shuffled; the side from which a stop is reached follows from the stop before.
    Random,
}

/// One pose and how it is reached.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop {
    /// Joint values, rad or mm.
    pub q: Vec<f64>,
    /// Sides: +1 moving positive, −1, 0 unknown; `None`: not known at all.
    pub dir: Option<Vec<f64>>,
}

/// Conditions under which the stops are measured. Every list holds the values that occur; each
/// combination of speed, load and temperature occurs equally often, dealt from a shuffled deck, so
/// that no condition goes along with the angle or with another condition.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Circumstances {
    /// Speeds without sign, rad/s or mm/s; empty: the session does not state them.
    pub speeds: Vec<f64>,
    /// Loads, kg; empty: the session does not state them.
    pub loads_kg: Vec<f64>,
    /// Temperature.
    pub temperature: Option<Temperature>,
    /// Temperature of joints, one entry for each joint from the first on; `None`: not measured.
    pub joint_temperatures: Vec<Option<Temperature>>,
    /// Whether the torques about the turning joints are measured: gravity's, of load and links.
    pub torques: bool,
    /// Time from stop to stop, s; `None`: the session has no time.
    pub seconds_per_pose: Option<f64>,
}

/// Temperature of the stops.
#[derive(Debug, Clone, PartialEq)]
pub enum Temperature {
    /// These values, dealt like speeds and loads.
    Values(Vec<f64>),
    /// `to + (from − to) e^(−t/τ)`.
    WarmUp {
        /// At the first sample, °C.
        from_c: f64,
        /// In the end, °C.
        to_c: f64,
        /// τ, s.
        time_constant_s: f64,
    },
}

/// What the instrument adds to each coordinate; its root mean square is `sigma_mm`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Root mean square over the axes, mm.
    pub sigma_mm: f64,
    /// How it is distributed.
    pub kind: NoiseKind,
}

named! {
    /// How noise is distributed.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum NoiseKind {
        /// Normal, independent.
        #[default]
        Gauss = "gauss",
        /// Student's t with four degrees of freedom: heavy tails.
        T4 = "t4",
        /// Normal, each value correlated by 0.7 with the one before (autoregressive).
        Ar1 = "ar1",
    }
    /// Its name in files.
    pub fn name;
    /// Every one.
    pub const ALL;
}

/// Measurements that went wrong: a share of the samples is moved by a length in any direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outliers {
    /// Share of the samples, rounded to a whole number of them.
    pub share: f64,
    /// How far, mm.
    pub mm: f64,
}

/// More samples than this are a slip of the keyboard.
pub(crate) const MOST_SAMPLES: f64 = 2e7;

impl Scenario {
    /// One reflector at the tool's origin, no effect, no noise.
    pub fn new(name: impl Into<String>, robot: Robot, poses: Poses) -> Self {
        Self {
            name: name.into(),
            note: String::new(),
            robot,
            targets: vec![Target {
                name: "tool".to_owned(),
                position_mm: Point3::origin(),
            }],
            instrument: Instrument::default(),
            tolerance_mm: None,
            regions: Vec::new(),
            planar: false,
            poses,
            circumstances: Circumstances::default(),
            effects: Vec::new(),
            noise: None,
            outliers: None,
            measure: vec![Measure::Point],
            unknown: Vec::new(),
            resolution_mm: None,
            seed: 0,
        }
    }

    /// Everything that makes the scenario unusable (errors) or pointless in part (warnings). The reader of files has
    /// checked each value alone; this checks what they mean together.
    pub fn problems(&self) -> Vec<Diagnostic> {
        let mut problems = self.robot.out_of_range(&Place::default());
        if self.robot.joints.is_empty() {
            let place = field("robot.joints");
            problems.push(Diagnostic::error(
                place,
                text!("no joints"),
                text!("at least one joint"),
            ));
        }
        // What follows speaks of joints that there are.
        if !problems.is_empty() {
            return problems;
        }
        self.check_poses(&mut problems);
        self.check_numbers(&mut problems);
        self.check_effects(&mut problems);
        let joints = self.robot.joints.len();
        let effects = self.effects.iter().enumerate();
        for (k, term) in effects.filter(|(_, term)| term.joint < joints) {
            if let Some(reason) = self.why_idle(term) {
                problems.push(Diagnostic::warning(
                    field(format!("effects[{k}]")),
                    text!(
                        "{id} does nothing here: {reason}",
                        id = term.effect.about().id,
                        reason
                    ),
                    text!("a condition under which it shows"),
                ));
            }
        }
        problems
    }

    fn check_poses(&self, problems: &mut Vec<Diagnostic>) {
        let joints = self.robot.joints.len();
        let mut wrong = |at: &str, found: Text, expected: Template| {
            problems.push(Diagnostic::error(field(at), found, expected));
        };
        let outside = |joint: usize, q: f64| {
            let limits = self.robot.joints[joint].limits;
            // Conversion may have moved a value that is on a limit.
            limits.filter(|l| q < l.from - 1e-9 || q > l.to + 1e-9)
        };
        let inside = phrase!("values within the joint's limits");
        match &self.poses {
            Poses::Sweep(sweep) => {
                if sweep.joint >= joints {
                    let found = text!("joint {joint}", joint = sweep.joint.saturating_add(1));
                    wrong("poses.sweep.joint", found, phrase!("a joint of the robot"));
                    return;
                }
                let usable = sweep.from.is_finite() && sweep.to.is_finite();
                if !usable || !sweep.step.is_finite() || sweep.step == 0.0 || sweep.repeats == 0 {
                    let found = text!("a sweep without a step, a range or repeats");
                    wrong(
                        "poses.sweep",
                        found,
                        phrase!("finite ends, a step that is not 0, repeats from 1 on"),
                    );
                    return;
                }
                for (key, q) in [("from_deg", sweep.from), ("to_deg", sweep.to)] {
                    if outside(sweep.joint, q).is_some() {
                        let found = text!("a stop beyond the joint's limits");
                        wrong(&format!("poses.sweep.{key}"), found, inside);
                    }
                }
            }
            Poses::List(stops) => {
                if stops.is_empty() {
                    wrong("poses.list", text!("no pose"), phrase!("at least one"));
                }
                for (k, stop) in stops.iter().enumerate() {
                    let at = format!("poses.list[{k}]");
                    let fits = |column: &Vec<f64>| column.len() == joints;
                    if !fits(&stop.q) || !stop.dir.as_ref().is_none_or(fits) {
                        let found = text!("a different number of values");
                        wrong(&at, found, phrase!("one value for each joint"));
                    } else if (0..joints)
                        .any(|j| !stop.q[j].is_finite() || outside(j, stop.q[j]).is_some())
                    {
                        let found = text!("a stop beyond a joint's limits");
                        wrong(&at, found, inside);
                    }
                }
            }
            Poses::Random(count) => {
                if *count == 0 {
                    wrong(
                        "poses.random.count",
                        Text::verbatim("0"),
                        phrase!("at least 1"),
                    );
                }
                if self.robot.joints.iter().any(|j| j.limits.is_none()) {
                    let found = text!("a joint without limits");
                    wrong("poses.random", found, phrase!("limits for every joint"));
                }
            }
        }
        let samples = self.poses.stops() * self.targets.len() as f64;
        if !(1.0..=MOST_SAMPLES).contains(&samples) {
            let found = text!(one "{count} sample", "{count} samples", count = samples);
            wrong("poses", found, phrase!("between 1 and 20 000 000 samples"));
        }
    }

    /// Effects of joints that there are, with all of their coefficients.
    fn check_effects(&self, problems: &mut Vec<Diagnostic>) {
        let joints = self.robot.joints.len();
        for (k, term) in self.effects.iter().enumerate() {
            let at = format!("effects[{k}]");
            if term.joint >= joints {
                let found = text!("joint {joint}", joint = term.joint.saturating_add(1));
                let expected = text!("a joint from 1 to {joints}", joints);
                problems.push(Diagnostic::error(field(&at), found, expected));
            }
            let (found, expected) = (
                term.coefficients.len(),
                term.effect.about().form.coefficients(),
            );
            let finite = term.coefficients.iter().all(|value| value.is_finite());
            if found != expected || !finite {
                let found = text!(one "{count} coefficient", "{count} coefficients", count = found);
                let expected = text!("{expected} finite ones", expected);
                problems.push(Diagnostic::error(field(&at), found, expected));
            }
        }
    }

    fn check_numbers(&self, problems: &mut Vec<Diagnostic>) {
        let mut wrong = |at: &str, fine: bool, expected: Template| {
            if !fine {
                problems.push(Diagnostic::error(
                    field(at),
                    text!("an unusable value"),
                    expected,
                ));
            }
        };
        let positive = |v: f64| v.is_finite() && v > 0.0;
        let not_negative = |v: &f64| v.is_finite() && *v >= 0.0;
        let c = &self.circumstances;
        wrong(
            "conditions.speed_deg_s",
            c.speeds.iter().all(not_negative),
            phrase!("speeds from 0 on"),
        );
        wrong(
            "conditions.load_kg",
            c.loads_kg.iter().all(not_negative),
            phrase!("loads from 0 kg on"),
        );
        let time = c.seconds_per_pose;
        wrong(
            "conditions.seconds_per_pose",
            time.is_none_or(positive),
            phrase!("a time above 0 s"),
        );
        let of_joints = c.joint_temperatures.iter().flatten();
        let temperatures = c
            .temperature
            .iter()
            .map(|t| ("conditions.temperature_c", t));
        let temperatures =
            temperatures.chain(of_joints.map(|t| ("conditions.joint_temperatures_c", t)));
        let mut warm_up = false;
        for (field, temperature) in temperatures {
            match temperature {
                Temperature::WarmUp {
                    from_c,
                    to_c,
                    time_constant_s,
                } => {
                    let finite = from_c.is_finite() && to_c.is_finite();
                    let expected = phrase!("finite temperatures and a time constant above 0 s");
                    wrong(field, finite && positive(*time_constant_s), expected);
                    warm_up = true;
                }
                Temperature::Values(values) => {
                    let finite = values.iter().all(|v| v.is_finite());
                    wrong(field, finite, phrase!("finite temperatures"));
                }
            }
        }
        wrong(
            "conditions.seconds_per_pose",
            !warm_up || time.is_some(),
            phrase!("a time from pose to pose, as the machine warms up"),
        );
        let noise = self.noise.is_none_or(|n| not_negative(&n.sigma_mm));
        wrong("noise.sigma_mm", noise, phrase!("a length from 0 mm on"));
        let outliers = self
            .outliers
            .is_none_or(|o| (0.0..=1.0).contains(&o.share) && not_negative(&o.mm));
        wrong(
            "outliers",
            outliers,
            phrase!("a share from 0 to 1 and a length from 0 mm on"),
        );
        wrong(
            "noise.resolution_mm",
            self.resolution_mm.is_none_or(positive),
            phrase!("a length above 0 mm"),
        );
        wrong(
            "targets",
            !self.targets.is_empty(),
            phrase!("at least one target"),
        );
        self.check_measures(problems);
    }

    /// Every way to measure has what it refers to, and that is somewhere.
    fn check_measures(&self, problems: &mut Vec<Diagnostic>) {
        let all = &self.instrument.references;
        let mut wrong = |at: &str, fine: bool, expected: Template| {
            if !fine {
                problems.push(Diagnostic::error(
                    field(at),
                    text!("not where it is"),
                    expected,
                ));
            }
        };
        wrong(
            "measure",
            !self.measure.is_empty(),
            phrase!("at least one way to measure"),
        );
        for measure in &self.measure {
            match measure {
                Measure::Point | Measure::Pose => {}
                Measure::Distance => wrong(
                    "anchors",
                    !all.anchors.is_empty()
                        && all
                            .anchors
                            .iter()
                            .all(|a| a.position_mm.is_some() && a.offset_mm.is_some()),
                    phrase!("anchors with position_mm and offset_mm; \"unknown\" hides them"),
                ),
                Measure::Bearing => wrong(
                    "stations",
                    !all.stations.is_empty()
                        && all.pointing.as_ref().is_none_or(|p| p.stations.is_some())
                        && all
                            .stations
                            .iter()
                            .all(|s| s.position_mm.is_some() && s.attitude.is_some()),
                    phrase!(
                        "stations with position_mm and quaternion_wxyz that are not those of pointing; \
                     \"unknown\" hides them"
                    ),
                ),
                Measure::Pointing => wrong(
                    "pointing",
                    all.pointing.is_some() && all.stations.iter().all(|s| s.attitude.is_some()),
                    phrase!("the axis that points, and stations with quaternion_wxyz or none"),
                ),
                Measure::Socket => wrong(
                    "sockets",
                    !all.sockets.is_empty() && all.sockets.iter().all(|s| s.position_mm.is_some()),
                    phrase!("sockets with position_mm; \"unknown\" hides them"),
                ),
                Measure::Touch => wrong(
                    "planes",
                    !all.planes.is_empty() && all.planes.iter().all(|p| p.stated.is_some()),
                    phrase!("planes with normal and distance_mm; \"unknown\" hides them"),
                ),
            }
        }
    }

    /// Why an effect cannot show in this scenario.
    fn why_idle(&self, term: &Term) -> Option<Template> {
        let offered = self.offered();
        let needs = term.effect.about().needs.iter();
        needs
            .map(|need| (need.idle)(&offered))
            .find_map(|idle| idle)
    }

    /// What its conditions offer to effects.
    fn offered(&self) -> AvailableColumns {
        let c = &self.circumstances;
        AvailableColumns {
            time: c.seconds_per_pose.is_some(),
            temperature: c.temperature.is_some()
                || c.joint_temperatures.iter().any(Option::is_some),
            load: !c.loads_kg.is_empty(),
            link_masses: self.robot.joints.iter().any(|j| j.link.is_some()),
            gravity: self.robot.gravity_m_s2.is_some(),
            speed: c.speeds.iter().any(|v| *v != 0.0),
            sides: match &self.poses {
                Poses::List(stops) => stops.iter().any(|s| s.dir.is_some()),
                _ => true,
            },
        }
    }
}

impl Poses {
    /// How many stops they make.
    pub fn stops(&self) -> f64 {
        match self {
            Self::List(stops) => stops.len() as f64,
            Self::Random(count) => *count as f64,
            Self::Sweep(sweep) => {
                let ways = if sweep.both_ways { 2.0 } else { 1.0 };
                sweep.steps() * ways * sweep.repeats as f64
            }
        }
    }
}

impl Sweep {
    /// How many stops one way has: the end counts where the steps lead there.
    pub fn steps(&self) -> f64 {
        ((self.to - self.from).abs() / self.step.abs() + 1e-6).floor() + 1.0
    }
}

fn field(path: impl Into<String>) -> Place {
    Place::default().in_field(path)
}
