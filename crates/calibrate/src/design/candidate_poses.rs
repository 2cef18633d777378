//! Candidate poses for a session: places within the limits, sides of approach, speeds, loads, temperatures and
//! reflectors, as every combination of them.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::candidate::{Arrival, Candidate, Writing, anywhere, at, inputs, ranges, usual_speed};
use super::imagined::{LATER_S, alone};
use super::measuring_methods::{MeasuringMethod, last_setup, ways};
use crate::diagnosis::NextPose;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::Inputs;
use crate::kinematics::{Joint, Range};
use crate::sessions::{Session, Target};
use crate::text::Text;

/// Ways of measuring that are offered.
const MOST_WAYS: usize = 6;

/// Angles that are tried over the range of a joint.
const ANGLES: usize = 24;
/// Joint vectors of an arm that are drawn at random in addition to the sweeps of single joints.
const VECTORS: usize = 60;

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

/// The candidates for a session: its reflectors and perhaps one more, under all conditions.
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
        let mut own_ways = Vec::new();
        let candidates = if prepared.problem.observed.is_none() {
            let places: Vec<_> = places.into_iter().map(Candidate::at).collect();
            let each: Vec<u32> = (0..u32::try_from(targets.len()).unwrap_or(1)).collect();
            let all = combinations(&places, conditions);
            each_with(&all, &each, |c, target| c.target = target)
        } else {
            let all = ways(session, None);
            let every = all.len().div_ceil(MOST_WAYS).max(1);
            own_ways = all.into_iter().step_by(every).collect();
            let base = &prepared.regression.base;
            let of_way = |(index, way): (usize, &MeasuringMethod)| {
                let brought = |q: &Vec<f64>| way.brought(session, base, &ranges, q.clone());
                let own = places.iter().filter_map(brought).map(|q| Candidate {
                    target: way.target,
                    way: index,
                    ..Candidate::at(q)
                });
                own.collect::<Vec<_>>()
            };
            let places: Vec<_> = own_ways.iter().enumerate().flat_map(of_way).collect();
            combinations(&places, conditions)
        };
        Self {
            ways: own_ways,
            targets,
            ranges,
            candidates,
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
