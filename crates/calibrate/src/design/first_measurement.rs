//! A first measurement of a robot: what a technician should do before anything is known.
//!
//! The conditions follow a schedule, so that nothing changes together with something else: loads
//! in the order 0 L L 0 0 L L 0 (a drift in time cancels), the machine cold, warming up, warm and
//! cooling down, both reflectors and all speeds in every stretch, short approaches after a
//! reversal, and returns to earlier poses under the same conditions. Joint values are then chosen
//! one pose after the other by greedy D-optimality ([`super::exchange`]) over random candidates,
//! with J the columns of every effect of the catalogue that the robot can show, each scaled to the
//! same size. Random candidates also leave no equal steps, behind which an order could hide.

use nalgebra::{DMatrix, DVector};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::diagnosis::NextPose;
use crate::effects::Inputs;
use crate::kinematics::{Range, Robot};
use crate::model::Model;
use crate::sessions::Target;
use crate::text::Text;

use super::candidates::{Arrival, Candidate, Writing, anywhere, inputs, usual_speed};
use super::covariance::inverse;
use super::every_effect::every_effect;
use super::exchange::{Criterion, choose};
use super::imagined::SECONDS_PER_POSE;
use super::information::Information;
use super::needs::WARMING_C;
use super::rows::Rows;
use super::typed::typed;

/// Load in each eighth of the measurement, as a share of the test load.
const LOADS: [f64; 8] = [0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0];
/// Warmth in each quarter, as a share of the warming: cold, warming up, warm, cooling down.
pub(crate) const WARMTHS: [f64; 4] = [0.0, 0.5, 1.0, 0.35];
/// Speeds in turn, in units of a modest one: most poses at standstill.
const SPEEDS: [f64; 5] = [0.0, 1.0, 0.0, 2.0, 0.0];
/// Lengths of the short approaches, as shares of a joint's range.
const SHORT: [f64; 3] = [0.01, 0.03, 0.09];

/// Random poses over which the columns are scaled.
const POOL: u32 = 64;
/// Multiplications that a design may take, and how many candidates each pose has within them.
const EFFORT: usize = 600_000_000;
const CANDIDATES: [usize; 2] = [12, 160];

/// What a first measurement is made for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Request<'r> {
    pub(crate) robot: &'r Robot,
    pub(crate) targets: &'r [Target],
    /// So many of the targets are mounted already.
    pub(crate) mounted: usize,
    pub(crate) ranges: &'r [Range],
    pub(crate) poses: usize,
    pub(crate) load_kg: f64,
    pub(crate) seed: u64,
    /// What was measured already, along which axes.
    pub(crate) measured: Option<(&'r Inputs<'r>, &'r [usize])>,
}

/// The poses in measuring order, beside what is known.
pub(crate) fn design(request: &Request) -> Vec<NextPose> {
    let mut slots = Slots::new(request);
    choose(&mut slots, request.poses);
    let writing = Writing {
        targets: request.targets,
        mounted: request.mounted,
        speeds: true,
        loads: slots.planned.iter().any(|c| c.load_kg != 0.0),
        temperatures: true,
    };
    let poses = slots.planned.iter().map(|c| writing.pose(c, why(c)));
    poses.collect()
}

/// The schedule, slot by slot: each has candidates of its own.
struct Slots<'r> {
    request: &'r Request<'r>,
    /// Circumstances of every slot, without places and sides.
    schedule: Vec<Candidate>,
    /// Every effect that the robot can show, and what scales its columns to a root mean square of one.
    model: Model,
    scale: DVector<f64>,
    planned: Vec<Candidate>,
    candidates: Vec<Candidate>,
    information: Information,
    random: ChaCha8Rng,
}

impl<'r> Slots<'r> {
    fn new(request: &'r Request<'r>) -> Self {
        let Request { robot, ranges, .. } = *request;
        let mut random = ChaCha8Rng::seed_from_u64(request.seed ^ 0x5eed);
        let duration_s = SECONDS_PER_POSE * request.poses as f64;
        let model = every_effect(robot, ranges, 0.5 * duration_s);
        let p = model.coefficient_count();
        let pool: Vec<Candidate> = (0..POOL)
            .map(|k| {
                let side = |_| if random.random::<bool>() { 1.0 } else { -1.0 };
                let dir: Vec<f64> = (0..ranges.len()).map(side).collect();
                let units = robot.joints.iter().map(|j| usual_speed(j.kind));
                Candidate {
                    speed: units.zip(&dir).map(|(u, d)| u * d).collect(),
                    dir,
                    arrival: [Arrival::Short(0.03), Arrival::Long][usize::from(k % 3 != 0)],
                    load_kg: f64::from(k % 2),
                    above_20_c: WARMING_C * f64::from(k % 4) / 3.0,
                    target: k % u32::try_from(request.targets.len()).unwrap_or(1),
                    time_s: duration_s * f64::from(k) / f64::from(POOL),
                    ..Candidate::at(anywhere(ranges, &mut random))
                }
            })
            .collect();
        let mut slots = Self {
            request,
            schedule: Vec::new(),
            information: Information::new(
                Rows::zeros(p, std::iter::empty()),
                DMatrix::identity(p, p),
            ),
            scale: DVector::from_element(p, 1.0),
            model,
            planned: Vec::with_capacity(request.poses),
            candidates: Vec::new(),
            random,
        };
        let squares = slots.rows(&request.inputs(&pool), &[0, 1, 2]).squares();
        let unit = |sum: f64| {
            if sum > 0.0 {
                (f64::from(POOL) / sum).sqrt()
            } else {
                0.0
            }
        };
        slots.scale = squares.into_iter().map(unit).collect::<Vec<_>>().into();
        if let Some((measured, axes)) = request.measured {
            let rows = slots.rows(measured, axes);
            let known = &mut slots.information.covariance;
            rows.add_to(known, 0..rows.len());
            *known = inverse(known);
        }
        slots.schedule = schedule(request, &mut slots.random);
        slots.refill();
        slots
    }

    /// The scaled columns of every effect.
    fn rows(&self, inputs: &Inputs, axes: &[usize]) -> Rows {
        let mut all = Rows::of_points([&self.model; 2], inputs, axes, [1.0; 3]);
        for (mut row, scale) in all.columns.row_iter_mut().zip(&self.scale) {
            row *= *scale;
        }
        all
    }

    /// Candidates for the next slot, and what each would add behind the poses before.
    fn refill(&mut self) {
        let Some(like) = self.schedule.get(self.planned.len()).cloned() else {
            return;
        };
        self.candidates = self.next_candidates(&like);
        let mut inputs = self.request.inputs(&self.candidates);
        let travels = travels(&self.planned, &self.candidates);
        inputs.travel = travels.into_iter().map(Some).collect();
        let covariance = self.information.covariance.clone();
        self.information = Information::new(self.rows(&inputs, &[0, 1, 2]), covariance);
    }

    /// From 0 at an earlier place to 1 far from all: places that lie together hide what is local.
    fn gap(&self, choice: &Candidate) -> f64 {
        let apart = |earlier: &Candidate| {
            let pairs = choice.q.iter().zip(&earlier.q).zip(self.request.ranges);
            let each = pairs.map(|((a, b), range)| ((a - b) / (range.to - range.from)).abs());
            each.fold(0.0, f64::max)
        };
        let nearest = self.planned.iter().map(apart).fold(1.0, f64::min);
        let step = 1.0 / (self.planned.len() + 1) as f64;
        1.0 - (-(2.0 * nearest / step).powi(2)).exp()
    }
}

impl Request<'_> {
    fn inputs(&self, candidates: &[Candidate]) -> Inputs<'static> {
        inputs(self.robot, self.targets, self.ranges, candidates, Some(0.0))
    }
}

/// Travel since the last reversal of each joint at each choice, were it the next.
fn travels(before: &[Candidate], choices: &[Candidate]) -> Vec<Vec<f64>> {
    let joints = choices.first().map_or(0, |c| c.q.len());
    let after = |j: usize, choice: &Candidate| {
        let all: Vec<&Candidate> = before.iter().chain([choice]).collect();
        // Only the way since the last reversal counts.
        all.windows(2).fold(f64::INFINITY, |travel, pair| {
            let moved = (pair[1].q[j] - pair[0].q[j]).abs();
            let on = pair[1].dir[j] == pair[0].dir[j];
            if on { travel + moved } else { moved }
        })
    };
    let of = |j| choices.iter().map(|c| after(j, c)).collect();
    (0..joints).map(of).collect()
}

impl Criterion for Slots<'_> {
    fn worths(&self) -> Vec<f64> {
        let worth = |(k, one): (usize, &Candidate)| {
            let gap = self.gap(one);
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
fn schedule(request: &Request, random: &mut ChaCha8Rng) -> Vec<Candidate> {
    let (n, targets) = (request.poses, request.targets.len());
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
    let joints = request.robot.joints.iter();
    let units: Vec<f64> = joints.map(|j| usual_speed(j.kind)).collect();
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
        let (ranges, before) = (self.request.ranges, &self.planned);
        let joints = &self.request.robot.joints;
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
                last.q[j] - last.dir[j] * typed(way, joints[j].kind)
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
        let p = self.scale.len();
        let affordable = EFFORT / (3 * p * p * self.request.poses).max(1);
        let drawn = (0..affordable.clamp(CANDIDATES[0], CANDIDATES[1])).map(|k| {
            // The ends belong to the travel: some candidates lie there.
            let mut q = anywhere(ranges, random);
            if k % 8 == 0 {
                let joint = random.random_range(0..ranges.len());
                let (range, low) = (&ranges[joint], random.random::<bool>());
                q[joint] = if low { range.from } else { range.to };
            }
            for ((q, range), joint) in q.iter_mut().zip(ranges).zip(joints) {
                *q = typed(*q, joint.kind).clamp(range.from, range.to);
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
