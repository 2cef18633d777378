//! A first measurement of a robot: what a technician should do before anything is known.
//!
//! The conditions follow a schedule, so that nothing changes together with something else: loads
//! in the order 0 L L 0 0 L L 0 (a drift in time cancels), the machine cold, warming up, warm and
//! cooling down, both reflectors and all speeds in every stretch, short approaches after a
//! reversal, and returns to earlier poses under the same conditions. Joint values are then chosen
//! one pose after the other by greedy D-optimality ([`super::exchange`]) over random candidates,
//! with J the columns of every effect of the catalogue that the robot can show, each scaled to the
//! same size. Random candidates also leave no equal steps, behind which an order could hide.

use nalgebra::DMatrix;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::diagnosis::NextPose;
use crate::kinematics::{JointKind, Range, Robot};
use crate::model::Model;
use crate::sessions::Target;
use crate::text::Text;

use super::candidates::{Arrival, Candidate, Writing, anywhere, usual_speed};
use super::comparison::Prediction;
use super::exchange::{Criterion, Information, choose};
use super::expected_rows::SECONDS_PER_POSE;
use super::information::Columns;
use super::needs::WARMING_C;
use super::typed::typed;

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

/// What was measured already, as a model's columns show it.
pub(crate) type Known<'a> = &'a dyn Fn(&Model) -> Vec<Prediction>;

/// The poses in measuring order, beside what is known; so many of the targets are mounted already.
pub(crate) fn design(
    robot: &Robot,
    targets: &[Target],
    mounted: usize,
    ranges: &[Range],
    request: &Request,
    prior_information: Known,
) -> Vec<NextPose> {
    let n = request.poses;
    let mut random = ChaCha8Rng::seed_from_u64(request.seed ^ 0x5eed);
    let columns = Columns::new(robot, targets, ranges, n, &mut random);
    let covariance = columns.measured_information(&prior_information(&columns.model));
    let nothing = Information::new(&DMatrix::zeros(0, covariance.ncols()), vec![0], covariance);
    let mut slots = Slots {
        schedule: schedule(robot, targets.len(), request, &mut random),
        kinds: robot.joints.iter().map(|j| j.kind).collect(),
        planned: Vec::with_capacity(n),
        candidates: Vec::new(),
        information: nothing,
        ranges,
        columns,
        random,
    };
    slots.refill();
    choose(&mut slots, n);
    let writing = Writing {
        targets,
        mounted,
        speeds: true,
        loads: slots.planned.iter().any(|c| c.load_kg != 0.0),
        temperatures: true,
    };
    let poses = slots.planned.iter().map(|c| writing.pose(c, why(c)));
    poses.collect()
}

/// The schedule, slot by slot: each has candidates of its own.
struct Slots<'r> {
    /// Circumstances of every slot, without places and sides.
    schedule: Vec<Candidate>,
    kinds: Vec<JointKind>,
    ranges: &'r [Range],
    columns: Columns,
    planned: Vec<Candidate>,
    candidates: Vec<Candidate>,
    information: Information,
    random: ChaCha8Rng,
}

impl Slots<'_> {
    /// Candidates for the next slot.
    fn refill(&mut self) {
        let Some(like) = self.schedule.get(self.planned.len()).cloned() else {
            return;
        };
        self.candidates = self.next_candidates(&like);
        let covariance = self.information.covariance.clone();
        let now = self
            .columns
            .information(&self.candidates, &self.planned, covariance);
        self.information = now;
    }
}

impl Criterion for Slots<'_> {
    fn worths(&self) -> Vec<f64> {
        let worth = |(k, one): (usize, &Candidate)| {
            let gap = self.columns.gap(one, &self.planned);
            // Every slot is filled, whatever it shows.
            (self.information.gain(k).exp() * gap).max(1e-6)
        };
        self.candidates.iter().enumerate().map(worth).collect()
    }

    fn take(&mut self, candidate: usize) {
        self.information.take(candidate);
        self.planned.push(self.candidates[candidate].clone());
        self.refill();
    }
}

/// Circumstances of every pose, before its joint values: speeds without their signs, arrivals as they are
/// wanted (a return may be to any pose).
fn schedule(
    robot: &Robot,
    targets: usize,
    request: &Request,
    random: &mut ChaCha8Rng,
) -> Vec<Candidate> {
    let n = request.poses;
    // Stretches of ten hold every speed for every reflector once, in random order.
    let mut in_turn: Vec<(f64, u32)> = Vec::new();
    while in_turn.len() < n {
        let one = |k: usize| {
            let target = (k / SPEEDS.len()) % targets.max(1);
            (SPEEDS[k % SPEEDS.len()], u32::try_from(target).unwrap_or(0))
        };
        let mut stretch: Vec<(f64, u32)> = (0..2 * SPEEDS.len()).map(one).collect();
        stretch.shuffle(random);
        in_turn.extend(stretch);
    }
    let units: Vec<f64> = robot.joints.iter().map(|j| usual_speed(j.kind)).collect();
    let slot = |(i, (speed, target)): (usize, (f64, u32))| {
        let part = |parts: usize| i * parts / n;
        Candidate {
            speed: units.iter().map(|unit| unit * speed).collect(),
            arrival: match i % 5 {
                1 if i >= 5 => Arrival::Short(SHORT[(i / 5) % SHORT.len()]),
                // Returns wait until there is something to return to.
                4 if 4 * i > n => Arrival::Return(0),
                _ => Arrival::Long,
            },
            load_kg: LOADS[part(LOADS.len())] * request.load_kg,
            above_20_c: WARMTHS[part(WARMTHS.len())] * WARMING_C,
            target,
            time_s: SECONDS_PER_POSE * i as f64,
            ..Candidate::at(vec![0.0; units.len()])
        }
    };
    in_turn.into_iter().take(n).enumerate().map(slot).collect()
}

impl Slots<'_> {
    /// Poses that may come next.
    fn next_candidates(&mut self, like: &Candidate) -> Vec<Candidate> {
        let wanted = like.arrival;
        let (ranges, kinds, before) = (self.ranges, &self.kinds, &self.planned);
        let random = &mut self.random;
        let last = before.last();
        let reached = |q: Vec<f64>, arrival: Arrival| {
            let middle = |range: &Range| 0.5 * (range.from + range.to);
            let from = |j: usize| last.map_or_else(|| middle(&ranges[j]), |l| l.q[j]);
            let side = |(j, q): (usize, &f64)| if *q >= from(j) { 1.0 } else { -1.0 };
            let dir: Vec<f64> = q.iter().enumerate().map(side).collect();
            let speed = like.speed.iter().zip(&dir).map(|(s, d)| s * d + 0.0);
            Candidate {
                q,
                speed: speed.collect(),
                dir,
                arrival,
                ..like.clone()
            }
        };
        if let (Arrival::Short(share), Some(last)) = (wanted, last) {
            let step = |j: usize| {
                let way = share * (ranges[j].to - ranges[j].from);
                last.q[j] - last.dir[j] * typed(way, kinds[j])
            };
            let q: Vec<f64> = (0..ranges.len()).map(step).collect();
            let mut pairs = q.iter().zip(ranges);
            if pairs.all(|(q, r)| *q >= r.from && *q <= r.to) {
                return vec![reached(q, wanted)];
            }
        }
        if matches!(wanted, Arrival::Return(_)) {
            let earlier = before[..before.len().saturating_sub(2)].iter().enumerate();
            let all: Vec<Candidate> = earlier
                .filter(|(_, s)| s.load_kg == like.load_kg)
                .filter(|(_, s)| !matches!(s.arrival, Arrival::Return(_)))
                .map(|(k, s)| Candidate {
                    above_20_c: like.above_20_c,
                    time_s: like.time_s,
                    arrival: Arrival::Return(k),
                    ..s.clone()
                })
                .collect();
            // Where the way leads there from the right side, no detour is needed.
            let direct = |s: &&Candidate| reached(s.q.clone(), Arrival::Long).dir == s.dir;
            let short: Vec<Candidate> = all.iter().filter(direct).cloned().collect();
            if let Some(one) = [short, all].into_iter().find(|list| !list.is_empty()) {
                let pick = random.random_range(0..one.len());
                return vec![one[pick].clone()];
            }
        }
        let drawn = (0..self.columns.candidates).map(|k| {
            // The ends belong to the travel: some candidates lie there.
            let mut q = anywhere(ranges, random);
            if k % 8 == 0 {
                let joint = random.random_range(0..ranges.len());
                let (range, low) = (&ranges[joint], random.random::<bool>());
                q[joint] = if low { range.from } else { range.to };
            }
            for ((q, range), kind) in q.iter_mut().zip(ranges).zip(kinds) {
                *q = typed(*q, *kind).clamp(range.from, range.to);
            }
            reached(q, Arrival::Long)
        });
        drawn.collect()
    }
}

fn why(candidate: &Candidate) -> Text {
    match candidate.arrival {
        Arrival::Return(to) => text!(
            "return to pose {pose} of this list: repeatability",
            pose = to + 1
        ),
        Arrival::Short(_) => {
            text!("a short approach after a reversal: lost motion against backlash")
        }
        Arrival::Long if candidate.moves() => {
            text!("measure while moving: tracking lag against backlash")
        }
        Arrival::Long => text!("a place that tells most, unequal steps"),
    }
}
