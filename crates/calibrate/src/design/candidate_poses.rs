//! Candidate poses for a session: places within the limits, sides of approach, speeds, loads, temperatures and
//! reflectors, as every combination of them; and what models show at them and at the samples.

use nalgebra::DMatrix;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::candidate::{Arrival, Candidate, Writing, anywhere, at, inputs, ranges, usual_speed};
use super::imagined::{LATER_S, with_candidates};
use super::measuring_methods::{MeasuringMethod, last_setup, ways};
use super::rows::Rows;
use crate::diagnosis::NextPose;
use crate::diagnosis::evidence::Regression;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::Inputs;
use crate::fit::problem::Problem;
use crate::kinematics::{Joint, Range};
use crate::model::Model;
use crate::numeric::GOLDEN_RATIO;
use crate::observations::Layer;
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
pub(crate) struct CandidatePoses<'p> {
    pub(crate) problem: &'p Problem<'p>,
    pub(crate) regression: &'p Regression<'p>,
    /// The ways in which the session measures where that is not points alone: every candidate is measured
    /// in one of them.
    ways: Vec<MeasuringMethod>,
    targets: Vec<Target>,
    ranges: Vec<Range>,
    pub(crate) candidates: Vec<Candidate>,
    pub(crate) inputs: Inputs<'static>,
    /// The candidates as samples, each measured in its way as far as the base model knows, where points are not all
    /// that is measured.
    taken: Option<Session>,
}

impl<'p> CandidatePoses<'p> {
    pub(crate) fn new(
        prepared: &'p PreparedSearch,
        targets: Vec<Target>,
        conditions: &Conditions,
    ) -> Self {
        let (problem, base) = (&*prepared.problem, &prepared.regression.base);
        let session = problem.session;
        let ranges = ranges(&session.robot, Some(&problem.inputs));
        let mut places = places(&ranges, prepared.options().seed, conditions.uneven);
        for q in &mut places {
            session.robot.follow(q);
        }
        let mut own_ways = Vec::new();
        let candidates = if problem.observed.is_none() {
            let places: Vec<_> = places.into_iter().map(Candidate::at).collect();
            let each: Vec<u32> = (0..u32::try_from(targets.len()).unwrap_or(1)).collect();
            let all = combinations(&places, conditions);
            each_with(&all, &each, |c, target| c.target = target)
        } else {
            let all = ways(session, None);
            let every = all.len().div_ceil(MOST_WAYS).max(1);
            own_ways = all.into_iter().step_by(every).collect();
            let mut there = Vec::new();
            for (index, way) in own_ways.iter().enumerate() {
                let brought = |q: &Vec<f64>| way.brought(index, session, base, &ranges, q.clone());
                there.extend(places.iter().filter_map(brought));
            }
            combinations(&there, conditions)
        };
        let start = Some(problem.inputs.start_s());
        let mut inputs = inputs(&session.robot, &targets, &ranges, &candidates, start);
        if !own_ways.is_empty() {
            inputs.setup = last_setup(session).map(|last| vec![last; candidates.len()]);
        }
        let mut all = Self {
            problem,
            regression: &prepared.regression,
            ways: own_ways,
            targets,
            ranges,
            candidates,
            inputs,
            taken: None,
        };
        if problem.observed.is_some() {
            let own = &all.candidates;
            let like = |way: usize| all.ways[way].like;
            let mut taken = with_candidates(session, base, own, like, &all.writing());
            let new = session.samples.len()..taken.samples.len();
            taken.samples.select(&new.map(Some).collect::<Vec<_>>());
            all.taken = Some(taken);
        }
        all
    }

    /// What each candidate shows of `truth` where `other` is refitted, in units of the noise that the session
    /// was found to have.
    pub(crate) fn rows(&self, truth: &Model, other: &Model) -> Rows {
        let Regression { rows, noise, .. } = self.regression;
        let Some(taken) = &self.taken else {
            return Rows::of_points([truth, other], &self.inputs, &rows.axes, noise.sigma_mm);
        };
        let mut layer = Layer::at(taken, &self.inputs);
        if let Some(so_far) = rows.observed() {
            layer.sigma.clone_from(&so_far.layer().sigma);
            layer.unit_mm = so_far.layer().unit_mm;
        }
        let of = |model: &Model| Rows::of_layer(&layer, model, noise.sigma_mm).0;
        let mut all = of(other);
        all.difference -= of(truth).difference;
        all
    }

    /// Gram matrix of a model's columns over the samples.
    pub(crate) fn gram(&self, model: &Model) -> DMatrix<f64> {
        let Regression { rows, noise, .. } = self.regression;
        let white = noise.whitened(rows, &rows.extract(model).1);
        white.tr_mul(&white)
    }

    fn writing(&self) -> Writing<'_> {
        let session = self.problem.session;
        Writing {
            targets: &self.targets,
            mounted: session.targets.len(),
            speeds: session.samples.speed.iter().any(Option::is_some),
            loads: session.samples.load_kg.is_some(),
            temperatures: false,
        }
    }

    /// The pose of a candidate; before a short approach the place where the joints reverse.
    pub(crate) fn poses(&self, candidate: usize, why: &Text) -> Vec<NextPose> {
        let candidate = &self.candidates[candidate];
        let session = self.problem.session;
        let why = match self.ways.get(candidate.way) {
            Some(way) => text!("{why}; measure {kinds}", why, kinds = way.describe(session)),
            None => why.clone(),
        };
        let pose = self.writing().pose(candidate, why);
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
                (GOLDEN_RATIO * (k as f64 + 1.0)).fract()
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
