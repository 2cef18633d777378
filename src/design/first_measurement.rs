//! A first measurement of a robot: what a technician should do before anything is known.
//!
//! The conditions follow a schedule, so that nothing changes together with something else: loads
//! in the order 0 L L 0 0 L L 0 (a drift in time cancels), the machine cold, warming up, warm and
//! cooling down, both reflectors and all speeds in every stretch, short approaches after a
//! reversal, and returns to earlier poses under the same conditions. Joint values are then chosen
//! one pose after the other by greedy D-optimality ([`super::exchange`]) over random candidates,
//! with J the columns of every effect of the catalogue that the robot can show, each scaled to the
//! same size. Random candidates also leave no equal steps, behind which an order could hide.

use nalgebra::{DMatrix, Point3};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::kinematics::{JointKind, Range, Robot};
use crate::model::Model;
use crate::sessions::Target;

use super::candidate_poses::{self, CandidatePose};
use super::comparison::Prediction;
use super::exchange::{Criterion, Information, choose};
use super::imagined::SECONDS_PER_POSE;
use super::information::Columns;
use super::needs::WARMING_C;

/// Load in each eighth of the measurement, as a share of the test load.
const LOADS: [f64; 8] = [0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0];
/// Warmth in each quarter, as a share of the warming: cold, warming up, warm, cooling down.
pub(crate) const WARMTHS: [f64; 4] = [0.0, 0.5, 1.0, 0.35];
/// Speeds in turn, in units of a modest one: most poses at standstill.
const SPEEDS: [f64; 5] = [0.0, 1.0, 0.0, 2.0, 0.0];
/// Lengths of the short approaches, as shares of a joint's range.
const SHORT: [f64; 3] = [0.01, 0.03, 0.09];

/// What a first measurement is made for.
#[derive(Debug, Clone)]
pub(crate) struct Request {
    pub(crate) poses: usize,
    pub(crate) load_kg: f64,
    pub(crate) seed: u64,
}

/// How a pose is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Arrival {
    /// From far.
    Long,
    /// After a reversal so many of the joint's ranges before.
    Short(f64),
    /// The same pose as that one (counted from 0).
    Return(usize),
}

/// One pose of the design.
#[derive(Debug, Clone)]
pub(crate) struct PlannedPose {
    pub(crate) choice: CandidatePose,
    pub(crate) arrival: Arrival,
}

/// The reflectors of a first measurement: the tool's origin and one more, where something turns.
pub(crate) fn reflectors(robot: &Robot) -> Vec<Target> {
    let mut targets = vec![Target {
        name: "T1".to_owned(),
        position_mm: Point3::origin(),
    }];
    if robot.joints.iter().any(|j| j.kind == JointKind::Revolute) {
        targets.extend(
            candidate_poses::other_reflectors(robot, &targets)
                .into_iter()
                .take(1),
        );
    }
    targets
}

/// What was measured already, as a model's columns show it.
pub(crate) type Known<'a> = &'a dyn Fn(&Model) -> Vec<Prediction>;

/// The poses in measuring order.
pub(crate) fn design(robot: &Robot, targets: &[Target], request: &Request) -> Vec<PlannedPose> {
    let ranges = candidate_poses::ranges(robot, None);
    extension(robot, targets, &ranges, request, &|_| Vec::new())
}

/// More poses beside what is known.
pub(crate) fn extension(
    robot: &Robot,
    targets: &[Target],
    ranges: &[Range],
    request: &Request,
    known: Known,
) -> Vec<PlannedPose> {
    let n = request.poses;
    let mut random = ChaCha8Rng::seed_from_u64(request.seed ^ 0x5eed);
    let columns = Columns::new(robot, targets, ranges, n, &mut random);
    let covariance = columns.known(&known(&columns.model));
    let nothing = Information::new(DMatrix::zeros(0, covariance.ncols()), vec![0], covariance);
    let mut slots = Slots {
        schedule: Schedule::new(robot, targets.len(), request, &mut random),
        kinds: robot.joints.iter().map(|j| j.kind).collect(),
        planned: Vec::with_capacity(n),
        candidates: Vec::new(),
        information: nothing,
        ranges,
        columns,
        random,
    };
    slots.offer();
    choose(&mut slots, n);
    slots.planned
}

/// The schedule, slot by slot: each has candidates of its own.
struct Slots<'r> {
    schedule: Schedule,
    kinds: Vec<JointKind>,
    ranges: &'r [Range],
    columns: Columns,
    planned: Vec<PlannedPose>,
    candidates: Vec<PlannedPose>,
    information: Information,
    random: ChaCha8Rng,
}

impl Slots<'_> {
    /// Candidates for the next slot.
    fn offer(&mut self) {
        let slot = self.planned.len();
        if slot >= self.schedule.count {
            return;
        }
        let like = self.schedule.conditions(slot);
        self.candidates = self.next_candidates(&like, self.schedule.arrivals[slot]);
        let covariance = self.information.covariance.clone();
        let now = self
            .columns
            .information(&self.candidates, &self.planned, covariance);
        self.information = now;
    }
}

impl Criterion for Slots<'_> {
    fn worths(&self) -> Vec<f64> {
        let worth = |(k, one): (usize, &PlannedPose)| {
            let gap = self.columns.gap(&one.choice, &self.planned);
            // Every slot is filled, whatever it shows.
            (self.information.gain(k).exp() * gap).max(1e-6)
        };
        self.candidates.iter().enumerate().map(worth).collect()
    }

    fn take(&mut self, candidate: usize) {
        self.information.take(candidate);
        self.planned.push(self.candidates[candidate].clone());
        self.offer();
    }
}

/// Conditions of every pose, before its joint values.
struct Schedule {
    plain: CandidatePose,
    count: usize,
    unit: Vec<f64>,
    load_kg: f64,
    speeds: Vec<f64>,
    targets: Vec<u32>,
    arrivals: Vec<ArrivalWanted>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum ArrivalWanted {
    Long,
    Short(f64),
    Return,
}

impl Schedule {
    fn new(robot: &Robot, targets: usize, request: &Request, random: &mut ChaCha8Rng) -> Self {
        let n = request.poses;
        let joints = robot.joints.len();
        // Stretches of ten hold every speed for every reflector once, in random order.
        let mut speeds = Vec::new();
        let mut of = Vec::new();
        while speeds.len() < n {
            let mut stretch: Vec<(f64, u32)> = (0..2 * SPEEDS.len())
                .map(|k| {
                    let target = (k / SPEEDS.len()) % targets.max(1);
                    (SPEEDS[k % SPEEDS.len()], u32::try_from(target).unwrap_or(0))
                })
                .collect();
            stretch.shuffle(random);
            speeds.extend(stretch.iter().map(|s| s.0));
            of.extend(stretch.iter().map(|s| s.1));
        }
        let arrival = |i: usize| match i % 5 {
            1 if i >= 5 => ArrivalWanted::Short(SHORT[(i / 5) % SHORT.len()]),
            // Returns wait until there is something to return to.
            4 if 4 * i > n => ArrivalWanted::Return,
            _ => ArrivalWanted::Long,
        };
        Self {
            plain: CandidatePose {
                q: vec![0.0; joints],
                dir: vec![1.0; joints],
                speed: vec![0.0; joints],
                approach: None,
                load_kg: 0.0,
                warmth_c: 0.0,
                target: 0,
                time_s: 0.0,
            },
            count: n,
            unit: robot
                .joints
                .iter()
                .map(|j| candidate_poses::usual_speed(j.kind))
                .collect(),
            load_kg: request.load_kg,
            speeds,
            targets: of,
            arrivals: (0..n).map(arrival).collect(),
        }
    }

    /// Everything but where and from which side; speeds without their signs.
    fn conditions(&self, i: usize) -> CandidatePose {
        let part = |parts: usize| i * parts / self.count.max(1);
        CandidatePose {
            speed: self.unit.iter().map(|u| u * self.speeds[i]).collect(),
            load_kg: LOADS[part(LOADS.len())] * self.load_kg,
            warmth_c: WARMTHS[part(WARMTHS.len())] * WARMING_C,
            target: self.targets[i],
            time_s: SECONDS_PER_POSE * i as f64,
            ..self.plain.clone()
        }
    }
}

impl Slots<'_> {
    /// Stops that may come next.
    fn next_candidates(&mut self, like: &CandidatePose, wanted: ArrivalWanted) -> Vec<PlannedPose> {
        let (ranges, kinds, before) = (self.ranges, &self.kinds, &self.planned);
        let random = &mut self.random;
        let last = before.last().map(|s| &s.choice);
        let reached = |q: Vec<f64>, arrival: Arrival| {
            let from = |j: usize| last.map_or(0.5 * (ranges[j].from + ranges[j].to), |l| l.q[j]);
            let dir: Vec<f64> = (0..q.len())
                .map(|j| if q[j] >= from(j) { 1.0 } else { -1.0 })
                .collect();
            let speed = like
                .speed
                .iter()
                .zip(&dir)
                .map(|(s, d)| s * d + 0.0)
                .collect();
            let choice = CandidatePose {
                q,
                dir,
                speed,
                ..like.clone()
            };
            PlannedPose { choice, arrival }
        };
        if let (ArrivalWanted::Short(share), Some(last)) = (wanted, last) {
            let step = |j: usize| {
                let range = &ranges[j];
                last.q[j]
                    - last.dir[j]
                        * candidate_poses::typed(share * (range.to - range.from), kinds[j])
            };
            let q: Vec<f64> = (0..ranges.len()).map(step).collect();
            let inside = q
                .iter()
                .zip(ranges)
                .all(|(q, r)| *q >= r.from && *q <= r.to);
            if inside {
                return vec![reached(q, Arrival::Short(share))];
            }
        }
        if wanted == ArrivalWanted::Return {
            let same = |s: &&PlannedPose| {
                s.choice.load_kg == like.load_kg && !matches!(s.arrival, Arrival::Return(_))
            };
            let earlier = before.len().saturating_sub(2);
            let all: Vec<PlannedPose> = before[..earlier]
                .iter()
                .enumerate()
                .filter(|(_, s)| same(s))
                .map(|(k, s)| PlannedPose {
                    choice: CandidatePose {
                        warmth_c: like.warmth_c,
                        time_s: like.time_s,
                        ..s.choice.clone()
                    },
                    arrival: Arrival::Return(k),
                })
                .collect();
            // Where the way leads there from the right side, no detour is needed.
            let direct = |s: &&PlannedPose| {
                let came = reached(s.choice.q.clone(), Arrival::Long);
                came.choice.dir == s.choice.dir
            };
            let short: Vec<PlannedPose> = all.iter().filter(direct).cloned().collect();
            if let Some(one) = [short, all].into_iter().find(|list| !list.is_empty()) {
                let pick = random.random_range(0..one.len());
                return vec![one[pick].clone()];
            }
        }
        let drawn = (0..self.columns.candidates).map(|k| {
            // The ends belong to the travel: some candidates lie there.
            let mut q = candidate_poses::anywhere(ranges, random);
            if k % 8 == 0 {
                let joint = random.random_range(0..ranges.len());
                let range = &ranges[joint];
                q[joint] = if random.random::<bool>() {
                    range.from
                } else {
                    range.to
                };
            }
            let q = q.iter().zip(ranges).zip(kinds).map(|((q, range), kind)| {
                let rounded = candidate_poses::typed(*q, *kind);
                rounded.clamp(range.from, range.to)
            });
            reached(q.collect(), Arrival::Long)
        });
        drawn.collect()
    }
}
