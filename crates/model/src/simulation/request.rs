//! A scenario from few words: a robot, how many poses, what is hidden in it. Everything else is as in a usual
//! measurement, with conditions under which every effect can show.
//!
//! The request becomes a document of `truepose-scenario/1` and is read like any other, so that what was
//! simulated can be kept, looked at and changed.

use crate::document::{Member, Value, object, text_of};
use crate::kinematics::{JointKind, Robot};
use crate::sessions::files::format_v1::robot::ROBOT;
use crate::simulation::scenario::NoiseKind;

/// Reflectors in the tool frame, mm: none on the last axis, where it would not show a turn about it.
const REFLECTORS_MM: [[f64; 3]; 4] = [
    [60.0, 0.0, 30.0],
    [-40.0, 60.0, 60.0],
    [-30.0, -70.0, 10.0],
    [20.0, 50.0, 90.0],
];

/// The largest number of reflectors of a request.
pub const MOST_REFLECTORS: usize = REFLECTORS_MM.len();

/// A machine that warms up does so by this, °C …
const WARM_UP_C: [f64; 2] = [20.0, 26.0];
/// … with a time constant of this part of the measurement.
const WARM_UP_SHARE: f64 = 0.25;

/// An effect to hide in the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct HiddenEffect {
    /// Its name in the catalogue.
    pub effect: String,
    /// Its joint, counted from 1, where it has one.
    pub joint: Option<usize>,
    /// Parameters in the user's units.
    pub parameters: Vec<(String, f64)>,
}

/// Where the robot goes.
#[derive(Debug, Clone, PartialEq)]
pub enum RequestedPoses {
    /// So many, every joint anywhere between its limits.
    Random(usize),
    /// One joint (from 1) over its whole range in so many stops, both ways.
    Sweep {
        /// The joint, counted from 1.
        joint: usize,
        /// Stops of one way.
        stops: usize,
    },
}

/// Temperature of the measurement.
#[derive(Debug, Clone, PartialEq)]
pub enum RequestedTemperature {
    /// The session does not state it.
    Unknown,
    /// These values, dealt over the poses, °C.
    Values(Vec<f64>),
    /// From one to the other, °C.
    WarmUp(f64, f64),
}

/// What is to be simulated. Begin with [`SimulationRequest::of`] and set what differs.
#[derive(Debug, Clone, PartialEq)]
pub struct SimulationRequest {
    /// Name of the session.
    pub name: String,
    /// The robot as its controller believes it to be.
    pub robot: Robot,
    /// Where it goes.
    pub poses: RequestedPoses,
    /// Reflectors at the tool, from 1 to [`MOST_REFLECTORS`].
    pub reflectors: usize,
    /// What the instrument is called.
    pub instrument: String,
    /// Its noise on each axis, mm.
    pub noise_mm: f64,
    /// How that is distributed.
    pub noise_kind: NoiseKind,
    /// Share of measurements that go wrong, and by how much, mm.
    pub outliers: Option<[f64; 2]>,
    /// Speeds at the moment of measuring, degrees per second; empty: not stated.
    pub speeds_deg_s: Vec<f64>,
    /// Loads, kg; empty: not stated.
    pub loads_kg: Vec<f64>,
    /// Temperature.
    pub temperature: RequestedTemperature,
    /// Time from pose to pose, s.
    pub seconds_per_pose: f64,
    /// The hidden effects.
    pub effects: Vec<HiddenEffect>,
    /// Seed of everything random.
    pub seed: u64,
}

impl SimulationRequest {
    /// A usual measurement of a robot that carries this much: so many poses anywhere, three reflectors, a
    /// tracker with 0.03 mm, standstill and two speeds, no load, half and all of it, a warm-up by 6 °C.
    pub fn of(robot: Robot, payload_kg: Option<f64>, poses: usize) -> Self {
        let full = payload_kg.filter(|load| *load > 0.0).unwrap_or(2.0);
        Self {
            name: format!("{}, simulated", robot.name),
            robot,
            poses: RequestedPoses::Random(poses),
            reflectors: 3,
            instrument: "laser tracker".to_owned(),
            noise_mm: 0.03,
            noise_kind: NoiseKind::Gauss,
            outliers: None,
            speeds_deg_s: vec![0.0, 10.0, 30.0],
            loads_kg: vec![0.0, 0.5 * full, full],
            temperature: RequestedTemperature::WarmUp(WARM_UP_C[0], WARM_UP_C[1]),
            seconds_per_pose: 6.0,
            effects: Vec::new(),
            seed: 0,
        }
    }

    /// The scenario as a document.
    pub fn scenario(&self) -> String {
        let reflectors = REFLECTORS_MM.iter().take(self.reflectors.max(1));
        let targets = reflectors.enumerate();
        let targets = targets.map(|(k, at)| Member::new(format!("T{}", k + 1), *at));
        text_of(&object! {
            "format": super::format_v1::FORMAT,
            "name": self.name.as_str(),
            "robot": (ROBOT.write)(&self.robot),
            "targets": Value::Object(targets.collect()),
            "instrument": object! { "name": self.instrument.as_str(), "sigma_mm": self.stated_sigma_mm() },
            "poses": self.poses(),
            "conditions": self.conditions(),
            "effects": self.effects.iter().map(hidden).collect::<Value>(),
            "noise": object! { "sigma_mm": self.noise_mm, "kind": self.noise_kind.name() },
            "outliers": self.outliers.map(|[share, mm]| object! { "share": share, "mm": mm }),
            "seed": self.seed,
        })
    }

    /// An instrument states more than nothing, also where none of it is simulated.
    fn stated_sigma_mm(&self) -> f64 {
        if self.noise_mm > 0.0 {
            self.noise_mm
        } else {
            0.001
        }
    }

    fn poses(&self) -> Value {
        match self.poses {
            RequestedPoses::Random(count) => object! { "random": object! { "count": count } },
            RequestedPoses::Sweep { joint, stops } => {
                let swept = self.robot.joints.get(joint.saturating_sub(1));
                let kind = swept.map_or(JointKind::Revolute, |joint| joint.kind);
                let limits = swept.and_then(|joint| joint.limits);
                let [from, to] = limits.map_or([-180.0, 180.0], |l| {
                    [l.from, l.to].map(|v| kind.to_display(v))
                });
                // Rounded towards less, so that the last stop stays within the range.
                let steps = stops.saturating_sub(1).max(1) as f64;
                let step = ((to - from) / steps * 1e6).floor() / 1e6;
                object! { "sweep": object! {
                    "joint": joint, "from_deg": from, "to_deg": to, "step_deg": step,
                    "both_ways": true, "order": "random",
                } }
            }
        }
    }

    fn conditions(&self) -> Value {
        let stops = match self.poses {
            RequestedPoses::Random(count) => count,
            RequestedPoses::Sweep { stops, .. } => 2 * stops,
        };
        let lasts_s = self.seconds_per_pose * stops.max(1) as f64;
        let temperature = match &self.temperature {
            RequestedTemperature::Unknown => Value::Absent,
            RequestedTemperature::Values(values) => values.as_slice().into(),
            RequestedTemperature::WarmUp(from, to) => object! {
                "from": *from, "to": *to, "time_constant_s": WARM_UP_SHARE * lasts_s,
            },
        };
        let given = |values: &[f64]| {
            if values.is_empty() {
                Value::Absent
            } else {
                values.into()
            }
        };
        object! {
            "speed_deg_s": given(&self.speeds_deg_s),
            "load_kg": given(&self.loads_kg),
            "temperature_c": temperature,
            "seconds_per_pose": self.seconds_per_pose,
        }
    }
}

fn hidden(effect: &HiddenEffect) -> Value {
    let parameters = effect.parameters.iter();
    let parameters = parameters.map(|(name, value)| Member::new(name.as_str(), *value));
    object! {
        "effect": effect.effect.as_str(),
        "joint": effect.joint.map_or(Value::Absent, Into::into),
        "parameters": Value::Object(parameters.collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::{Axis, Joint, Pose, Range, RobotSource};
    use crate::simulation::{parse_scenario, simulate, unwatched};
    use nalgebra::{Point3, Vector3};

    fn request() -> SimulationRequest {
        let axis = Axis::through(Vector3::z(), Point3::origin()).unwrap();
        let mut pan = Joint::new("pan", JointKind::Revolute, axis);
        pan.limits = Some(Range {
            from: -1.5,
            to: 2.0,
        });
        let robot = Robot {
            name: "pan".to_owned(),
            joints: vec![pan],
            base_from_tool: Pose::translation(250.0, 0.0, 300.0),
            gravity_m_s2: Some(Vector3::new(0.0, 0.0, -9.81)),
            source: RobotSource::Axes,
        };
        SimulationRequest::of(robot, Some(5.0), 40)
    }

    #[test]
    fn a_request_is_a_scenario_without_problems_and_its_effects_show() {
        let mut request = request();
        request.effects = vec![HiddenEffect {
            effect: "backlash".to_owned(),
            joint: Some(1),
            parameters: vec![("width_deg".to_owned(), 0.05)],
        }];
        let loaded = parse_scenario(request.scenario().as_bytes()).unwrap();
        assert_eq!(loaded.findings, []);
        let (session, truth) = simulate(&loaded.scenario, 7, unwatched).unwrap();
        assert_eq!(session.samples.len(), 120);
        assert_eq!(truth.effects.len(), 1);
        assert_eq!(truth.effects[0].effect.about().id, "backlash");
    }

    #[test]
    fn a_sweep_stays_within_the_range_and_conditions_can_be_left_out() {
        let mut request = request();
        request.poses = RequestedPoses::Sweep {
            joint: 1,
            stops: 13,
        };
        request.speeds_deg_s.clear();
        request.loads_kg.clear();
        request.temperature = RequestedTemperature::Unknown;
        let loaded = parse_scenario(request.scenario().as_bytes()).unwrap();
        let (session, _) = simulate(&loaded.scenario, 0, unwatched).unwrap();
        assert_eq!(session.samples.len(), 2 * 13 * 3);
        assert!(session.samples.load_kg.is_none() && session.samples.temperature_c.is_none());
    }
}
