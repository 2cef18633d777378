//! What may be measured next: places within the limits, sides of approach, speeds, loads,
//! temperatures and reflectors, as every combination of them.
//!
//! Joint values stay inside the limits (where there are none, inside what was measured). An
//! approach is long, so that lost motion has built up, or it begins with a reversal a stated way
//! before the pose. A new reflector may stand on a bar of at most [`REACH_MM`].

use crate::diagnosis::NextPose;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::effects::term::travel_of;
use crate::effects::{Inputs, JointFrame};
use crate::kinematics::{Joint, JointKind, Range, Robot};
use crate::sessions::{Session, Target};
use crate::text::Text;
use nalgebra::{Point3, Vector3};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::imagined::{LATER_S, alone};
use super::measuring_methods::{MeasuringMethod, last_setup, ways};

/// How far from the first reflector a second one can be held, mm: a light bar on the flange.
pub(crate) const REACH_MM: f64 = 300.0;
/// Travel of a joint without stated limits and without samples: a full turn, or ± half a
/// metre.
const FREE: [f64; 2] = [std::f64::consts::PI, 500.0];
/// Angles that are tried over the range of a joint.
const ANGLES: usize = 24;
/// Joint vectors of an arm that are drawn at random beside the sweeps of single joints.
const VECTORS: usize = 60;
/// Ways of measuring that are offered.
const MOST_WAYS: usize = 6;

/// How a pose is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Arrival {
    /// From far.
    Long,
    /// After a reversal so many of each joint's ranges before.
    Short(f64),
    /// The same pose as that one of the list (counted from 0).
    Return(usize),
}

/// What may be measured: a place and the conditions there.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Candidate {
    /// rad or mm.
    pub(crate) q: Vec<f64>,
    /// Sides from which the joints come.
    pub(crate) dir: Vec<f64>,
    /// Signed, rad/s or mm/s.
    pub(crate) speed: Vec<f64>,
    pub(crate) arrival: Arrival,
    pub(crate) load_kg: f64,
    /// Above 20 °C, K.
    pub(crate) above_20_c: f64,
    pub(crate) target: u32,
    pub(crate) time_s: f64,
    /// Which of several ways of measuring ([`super::arm`]).
    pub(crate) way: usize,
}

impl Candidate {
    /// At standstill, without load, at 20 °C, of the first reflector, from no stated side.
    pub(crate) fn at(q: Vec<f64>) -> Self {
        Self {
            dir: vec![0.0; q.len()],
            speed: vec![0.0; q.len()],
            q,
            arrival: Arrival::Long,
            load_kg: 0.0,
            above_20_c: 0.0,
            target: 0,
            time_s: 0.0,
            way: 0,
        }
    }

    /// Whether it is measured while a joint moves.
    pub(crate) fn moves(&self) -> bool {
        self.speed.iter().any(|s| *s != 0.0)
    }
}

/// How candidates are written down as poses: which conditions are stated although nothing changes them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Writing<'t> {
    pub(crate) targets: &'t [Target],
    /// So many of the targets are there already; a pose of another says where it has to be mounted.
    pub(crate) mounted: usize,
    pub(crate) speeds: bool,
    pub(crate) loads: bool,
    pub(crate) temperatures: bool,
}

impl Writing<'_> {
    /// The pose of a candidate, and why it is measured.
    pub(crate) fn pose(&self, candidate: &Candidate, why: Text) -> NextPose {
        let index = candidate.target as usize;
        let target = self.targets.get(index);
        let (load_kg, above_20_c) = (candidate.load_kg, candidate.above_20_c);
        let speed = || candidate.speed.clone();
        NextPose {
            q: candidate.q.clone(),
            dir: candidate.dir.clone(),
            target: target
                .filter(|_| self.targets.len() > 1)
                .map(|t| t.name.clone()),
            target_mm: target
                .filter(|_| index >= self.mounted)
                .map(|t| t.position_mm.coords.into()),
            speed: (self.speeds || candidate.moves()).then(speed),
            load_kg: (self.loads || load_kg != 0.0).then_some(load_kg),
            temperature_c: (self.temperatures || above_20_c != 0.0)
                .then_some(above_20_c + REFERENCE_TEMPERATURE_C),
            why,
        }
    }
}

/// Conditions that are offered; every combination of them is a choice.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Conditions {
    /// Multiples of each joint's unit of speed.
    pub(crate) speeds: Vec<f64>,
    /// rad/s or mm/s, one for each joint.
    pub(crate) unit_of_speed: Vec<f64>,
    pub(crate) loads_kg: Vec<f64>,
    pub(crate) above_20_c: Vec<f64>,
    pub(crate) arrivals: Vec<Arrival>,
    pub(crate) time_s: f64,
    /// Whether the places of a joint are to be uneven steps, behind which no order can hide.
    pub(crate) uneven: bool,
}

impl Conditions {
    /// Standstill, no load, 20 °C and long approaches, after what was measured; where joints moved their
    /// largest speeds are the units.
    pub(crate) fn after(prepared: &PreparedSearch) -> Self {
        let joints = prepared.problem.session.robot.joints.iter();
        let unit = |(joint, survey): (&Joint, &crate::effects::survey::JointSurvey)| {
            if survey.largest_speed > 0.0 {
                survey.largest_speed
            } else {
                usual_speed(joint.kind)
            }
        };
        let times = prepared.problem.inputs.time_s.as_deref().unwrap_or(&[]);
        Self {
            speeds: vec![0.0],
            unit_of_speed: joints.zip(&prepared.survey.joints).map(unit).collect(),
            loads_kg: vec![0.0],
            above_20_c: vec![0.0],
            arrivals: vec![Arrival::Long],
            time_s: times.iter().copied().fold(0.0, f64::max) + LATER_S,
            uneven: false,
        }
    }
}

/// What is offered beside a session: its reflectors and perhaps one more, under all conditions.
#[derive(Debug, Clone)]
pub(crate) struct CandidatePoses {
    /// The ways in which the session measures where that is not points alone: every candidate is measured
    /// in one of them.
    pub(crate) ways: Vec<MeasuringMethod>,
    pub(crate) targets: Vec<Target>,
    pub(crate) ranges: Vec<Range>,
    pub(crate) candidates: Vec<Candidate>,
}

impl CandidatePoses {
    pub(crate) fn new(
        prepared: &PreparedSearch,
        targets: Vec<Target>,
        conditions: &Conditions,
    ) -> Self {
        let session = prepared.problem.session;
        let ranges = ranges(&session.robot, Some(&prepared.problem.inputs));
        let mut places = places(&ranges, prepared.options().seed, conditions.uneven);
        for q in &mut places {
            session.robot.follow(q);
        }
        if prepared.problem.observed.is_none() {
            let places: Vec<_> = places.into_iter().map(Candidate::at).collect();
            let each: Vec<u32> = (0..u32::try_from(targets.len()).unwrap_or(1)).collect();
            let candidates = combinations(&places, conditions);
            return Self {
                candidates: each_with(&candidates, &each, |c, target| c.target = target),
                ways: Vec::new(),
                ranges,
                targets,
            };
        }
        let mut ways = ways(session, None);
        let every = ways.len().div_ceil(MOST_WAYS).max(1);
        ways = ways.into_iter().step_by(every).collect();
        let base = &prepared.regression.base;
        let of_way = |(index, way): (usize, &MeasuringMethod)| -> Vec<Candidate> {
            let here = |q: &Vec<f64>| way.brought(session, base, &ranges, q.clone());
            let at = |q| Candidate {
                target: way.target,
                way: index,
                ..Candidate::at(q)
            };
            places.iter().filter_map(here).map(at).collect()
        };
        let places: Vec<_> = ways.iter().enumerate().flat_map(of_way).collect();
        Self {
            candidates: combinations(&places, conditions),
            ways,
            ranges,
            targets,
        }
    }

    /// The candidates as samples, each measured in its way as far as the base model knows; `None` where
    /// points alone are measured.
    pub(crate) fn session(&self, prepared: &PreparedSearch) -> Option<Session> {
        prepared.problem.observed.as_ref()?;
        let writing = self.writing(prepared);
        let all = self.candidates.iter();
        let poses = all.clone().map(|c| writing.pose(c, Text::default()));
        let like: Vec<_> = all.map(|c| self.ways[c.way].like).collect();
        let (session, base) = (prepared.problem.session, &prepared.regression.base);
        Some(alone(session, base, &poses.collect::<Vec<_>>(), &like))
    }

    fn writing(&self, prepared: &PreparedSearch) -> Writing<'_> {
        let session = prepared.problem.session;
        Writing {
            targets: &self.targets,
            mounted: session.targets.len(),
            speeds: session.samples.speed.iter().any(Option::is_some),
            loads: session.samples.load_kg.is_some(),
            temperatures: false,
        }
    }

    pub(crate) fn inputs(&self, prepared: &PreparedSearch) -> Inputs<'static> {
        let start = prepared.problem.inputs.start_s();
        let session = prepared.problem.session;
        let (ranges, all) = (&self.ranges, &self.candidates);
        let mut inputs = inputs(&session.robot, &self.targets, ranges, all, Some(start));
        if !self.ways.is_empty() {
            inputs.setup = last_setup(session).map(|last| vec![last; all.len()]);
        }
        inputs
    }

    /// The pose of a candidate; before a short approach the place where the joints reverse.
    pub(crate) fn poses(
        &self,
        prepared: &PreparedSearch,
        candidate: usize,
        why: &Text,
    ) -> Vec<NextPose> {
        let candidate = &self.candidates[candidate];
        let session = prepared.problem.session;
        let why = match self.ways.get(candidate.way) {
            Some(way) => text!("{why}; measure {kinds}", why, kinds = way.describe(session)),
            None => why.clone(),
        };
        let pose = self.writing(prepared).pose(candidate, why);
        let Arrival::Short(share) = candidate.arrival else {
            return vec![pose];
        };
        // The joint comes from the other side to a place from which it reverses towards the pose.
        let from = |(j, q): (usize, &f64)| {
            let range = &self.ranges[j];
            let back = q - candidate.dir[j] * share * (range.to - range.from);
            back.clamp(range.from, range.to)
        };
        let turning = NextPose {
            q: candidate.q.iter().enumerate().map(from).collect(),
            dir: candidate.dir.iter().map(|d| -d).collect(),
            why: text!("reverse here, for a short approach to the next pose"),
            ..pose.clone()
        };
        vec![turning, pose]
    }
}

/// A modest speed: 10°/s, or 50 mm/s.
pub(crate) fn usual_speed(kind: JointKind) -> f64 {
    match kind {
        JointKind::Revolute => 10.0_f64.to_radians(),
        JointKind::Prismatic => 50.0,
    }
}

/// Where each joint may be sent: its limits, else what was measured, else a full turn.
pub(crate) fn ranges(robot: &Robot, measured: Option<&Inputs>) -> Vec<Range> {
    let of = |(index, joint): (usize, &Joint)| {
        let free = FREE[usize::from(joint.kind == JointKind::Prismatic)];
        let q = measured.map_or(&[][..], |inputs| &inputs.q[index]);
        let travel = travel_of(robot, index, q);
        if travel.from < travel.to {
            travel
        } else {
            Range {
                from: -free,
                to: free,
            }
        }
    };
    robot.joints.iter().enumerate().map(of).collect()
}

/// Every candidate with each of these values.
fn each_with<T: Copy>(
    all: &[Candidate],
    values: &[T],
    set: impl Fn(&mut Candidate, T),
) -> Vec<Candidate> {
    let with = |(one, value): (&Candidate, &T)| {
        let mut one = one.clone();
        set(&mut one, *value);
        one
    };
    let pairs = all.iter().flat_map(|c| values.iter().map(move |v| (c, v)));
    pairs.map(with).collect()
}

/// All combinations of places, sides and conditions; the last change first.
fn combinations(places: &[Candidate], conditions: &Conditions) -> Vec<Candidate> {
    let all = each_with(places, &[-1.0, 1.0], |c, side| c.dir.fill(side));
    let all = each_with(&all, &conditions.speeds, |c, speed| {
        let units = c.dir.iter().zip(&conditions.unit_of_speed);
        c.speed = units
            .map(|(side, unit)| side * speed * unit + 0.0)
            .collect();
    });
    let all = each_with(&all, &conditions.arrivals, |c, arrival| {
        c.arrival = arrival;
    });
    let all = each_with(&all, &conditions.loads_kg, |c, load| c.load_kg = load);
    each_with(&all, &conditions.above_20_c, |c, warmth| {
        c.above_20_c = warmth;
        c.time_s = conditions.time_s;
    })
}

/// Each joint over its range with the others in the middle, and for an arm some at random.
fn places(ranges: &[Range], seed: u64, uneven: bool) -> Vec<Vec<f64>> {
    let middle: Vec<f64> = ranges.iter().map(|r| 0.5 * (r.from + r.to)).collect();
    let mut places = Vec::new();
    let angles = (2 * ANGLES / (1 + ranges.len())).max(6);
    for (joint, range) in ranges.iter().enumerate() {
        for k in 0..angles {
            let mut q = middle.clone();
            // Anywhere within its part of the range (Kronecker's sequence).
            let inside = if uneven {
                (0.618_033_988_749_894_9 * (k as f64 + 1.0)).fract()
            } else {
                0.5
            };
            q[joint] = at(range, (k as f64 + inside) / angles as f64);
            places.push(q);
        }
    }
    if ranges.len() > 1 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        places.extend((0..VECTORS).map(|_| anywhere(ranges, &mut random)));
    }
    places
}

/// The point of a range at this share of it.
fn at(range: &Range, share: f64) -> f64 {
    let exact = range.from + (range.to - range.from) * share;
    exact.clamp(range.from, range.to)
}

/// Joint values anywhere within the ranges.
pub(crate) fn anywhere(ranges: &[Range], random: &mut impl Rng) -> Vec<f64> {
    use rand::RngExt as _;
    let one = |range: &Range| at(range, random.random::<f64>());
    ranges.iter().map(one).collect()
}

/// Candidates as the effects take them, `start_s` being the time from which drifts count.
pub(crate) fn inputs(
    robot: &Robot,
    targets: &[Target],
    ranges: &[Range],
    candidates: &[Candidate],
    start_s: Option<f64>,
) -> Inputs<'static> {
    let column = |f: &dyn Fn(&Candidate) -> f64| candidates.iter().map(f).collect::<Vec<f64>>();
    let home = |t: &Target| (robot.base_from_tool * t.position_mm).coords.into();
    let q = (0..ranges.len()).map(|j| column(&|c| c.q[j])).collect();
    let mut inputs = Inputs::at_poses(q, targets.iter().map(home).collect());
    for (j, range) in ranges.iter().enumerate() {
        let span = range.to - range.from;
        inputs.dir[j] = Some(column(&|c| c.dir[j]).into());
        inputs.speed[j] = Some(column(&|c| c.speed[j]).into());
        let travel = |c: &Candidate| match c.arrival {
            Arrival::Short(share) => share * span,
            _ => f64::INFINITY,
        };
        inputs.travel[j] = Some(column(&travel));
    }
    inputs.load_kg = Some(column(&|c| c.load_kg).into());
    inputs.above_20_c = Some(column(&|c| c.above_20_c));
    inputs.target = Some(candidates.iter().map(|c| c.target).collect());
    inputs.time_s = Some(column(&|c| c.time_s).into());
    inputs.start_s = start_s;
    inputs
}

/// These reflectors, and where there is but one and something turns the likeliest other.
pub(crate) fn with_another(robot: &Robot, mut targets: Vec<Target>) -> Vec<Target> {
    if targets.len() < 2 && robot.joints.iter().any(|j| j.kind == JointKind::Revolute) {
        targets.extend(other_reflectors(robot, &targets).into_iter().take(1));
    }
    targets
}

/// Places for a second reflector within reach of the first, the likeliest to help first: further
/// out and higher, across the first axis, and in towards it.
pub(crate) fn other_reflectors(robot: &Robot, targets: &[Target]) -> Vec<Target> {
    let turns = |j: &Joint| j.kind == JointKind::Revolute;
    let frame = JointFrame::new(robot, robot.joints.iter().position(turns).unwrap_or(0));
    let [outward, _] = frame.plane_of_motion();
    let (outward, along) = (Vector3::from(outward), Vector3::from(frame.along));
    let across = along.cross(&outward);
    let shifts = [
        outward * 0.9 + along * 0.4,
        outward * 0.3 + across * 0.85 + along * 0.4,
        outward * -0.9 + along * 0.4,
    ];
    let first = targets
        .first()
        .map_or_else(Vector3::zeros, |t| t.position_mm.coords);
    let mut name = format!("T{}", targets.len() + 1);
    while targets.iter().any(|t| t.name == name) {
        name.push('n');
    }
    let at = |shift: Vector3<f64>| {
        let in_tool = robot.base_from_tool.rotation.inverse() * (shift * REACH_MM);
        Target {
            name: name.clone(),
            position_mm: (first + in_tool).map(|v| (v / 5.0).round() * 5.0).into(),
        }
    };
    shifts.into_iter().map(at).collect()
}

/// The reflectors of a first measurement: the tool's origin and one more, where something turns.
pub(crate) fn reflectors(robot: &Robot) -> Vec<Target> {
    let origin = Target {
        name: "T1".to_owned(),
        position_mm: Point3::origin(),
    };
    with_another(robot, vec![origin])
}
