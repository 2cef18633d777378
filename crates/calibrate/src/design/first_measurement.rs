//! A first measurement of a robot with one joint, before anything is known.
//!
//! The conditions follow a schedule, so that nothing changes together with something else: loads
//! in the order 0 L L 0 0 L L 0 (a drift in time cancels), the machine cold, warming up, warm and
//! cooling down, both reflectors and all speeds in every stretch, short approaches after a
//! reversal, and returns to earlier poses under the same conditions. Joint values are then chosen
//! one pose after the other by greedy D-optimality ([`super::information`]) over random candidates,
//! with J the columns of every effect of the catalogue that the robot can show, each scaled to the
//! same size. Random candidates also leave no equal steps, behind which an order could hide.
//!
//! ```text
//! worth = det(1 + J C Jᵀ) (1 − exp(−(2 n d)²))
//! ```
//!
//! with d the distance to the nearest of n − 1 earlier poses as a share of the travel: places that lie together do not
//! show local effects.

use nalgebra::{DMatrix, DVector};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::diagnosis::NextPose;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::Inputs;
use crate::kinematics::{JointKind, Range};
use crate::model::Model;
use crate::rounding;
use crate::text::Text;

use super::candidate::{Arrival, Candidate, Writing, anywhere, inputs, ranges, typed, usual_speed};
use super::covariance::inverse;
use super::every_effect::every_effect;
use super::exchange::{Criterion, choose};
use super::imagined::{SECONDS_PER_POSE, extended};
use super::information::Information;
use super::needs::{WARMING_C, test_load_kg};
use super::plan::Plan;
use super::plan_options::PlanOptions;
use super::rows::Rows;

/// Load in each stretch, as a share of the test load: it is changed twice, and a drift in time cancels.
pub(super) const LOADS: [f64; 4] = [0.0, 1.0, 1.0, 0.0];
/// Warmth in each quarter, as a share of the warming: cold, warming up, warm, cooling down.
pub(crate) const WARMTHS: [f64; 4] = [0.0, 0.5, 1.0, 0.35];
/// Speeds in turn, in units of a modest one: most poses at standstill.
const SPEEDS: [f64; 5] = [0.0, 1.0, 0.0, 2.0, 0.0];
/// Lengths of the short approaches, as shares of the range.
const SHORT: [f64; 3] = [0.01, 0.03, 0.09];
/// Random poses over which the columns are scaled.
const POOL: u32 = 64;
/// Multiplications that a design may take, and how many candidates each pose has within them.
const EFFORT: usize = 600_000_000;
const CANDIDATES: [usize; 2] = [12, 160];
/// One candidate of so many is at an end of the travel, which belongs to it.
const ENDS_EVERY: usize = 8;

/// So many poses in measuring order of the robot of a plan; where a session was measured in addition to it, and to
/// the poses that the plan has already.
pub(crate) fn design(
    plan: &Plan,
    poses: usize,
    options: &PlanOptions,
    measured: Option<&PreparedSearch>,
) -> Vec<NextPose> {
    let mut slots = Slots::new(plan, poses, options, measured);
    choose(&mut slots, poses);
    let writing = Writing {
        targets: &plan.targets,
        mounted: measured.map_or(1, |search| search.problem.session.targets.len()),
        speeds: true,
        loads: slots.planned.iter().any(|c| c.load_kg != 0.0),
        temperatures: true,
    };
    let poses = slots.planned.iter().map(|c| writing.pose(c, why(c)));
    poses.collect()
}

/// The schedule, slot by slot: each has separate candidates.
struct Slots<'r> {
    plan: &'r Plan,
    range: Range,
    poses: usize,
    load_kg: f64,
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
    fn new(
        plan: &'r Plan,
        poses: usize,
        options: &PlanOptions,
        measured: Option<&PreparedSearch>,
    ) -> Self {
        let heaviest = measured.map_or(0.0, |search| search.survey.largest_load_kg);
        let range = ranges(&plan.robot, measured.map(|search| &search.problem.inputs))[0];
        let middle_s = 0.5 * SECONDS_PER_POSE * poses as f64;
        let model = every_effect(&plan.robot, &[range], middle_s);
        let p = model.coefficient_count();
        let nothing = Rows::zeros(p, std::iter::empty());
        let mut slots = Self {
            plan,
            range,
            poses,
            load_kg: test_load_kg(options.load_kg, heaviest),
            schedule: Vec::new(),
            information: Information::new(nothing, DMatrix::identity(p, p)),
            scale: DVector::from_element(p, 1.0),
            planned: Vec::with_capacity(poses),
            candidates: Vec::new(),
            model,
            random: ChaCha8Rng::seed_from_u64(options.diagnosis.seed ^ 0x5eed),
        };
        let pool = slots.pool();
        slots.schedule = slots.scheduled();
        let squares = slots.rows(&slots.inputs(&pool), &[0, 1, 2]).squares();
        let of = |sum: &f64| {
            if *sum > 0.0 {
                (f64::from(POOL) / sum).sqrt()
            } else {
                0.0
            }
        };
        slots.scale = DVector::from_iterator(p, squares.iter().map(of));
        if let Some(PreparedSearch {
            problem,
            regression,
            ..
        }) = measured
        {
            let (session, base) = (problem.session, &regression.base);
            let so_far = extended(session, base, &plan.poses, &plan.targets);
            let inputs = Inputs::new(&so_far, options.diagnosis.joint_values);
            let rows = slots.rows(&inputs, &regression.rows.axes);
            let known = &mut slots.information.covariance;
            rows.add_to(known, 0..rows.len());
            *known = inverse(known);
        }
        slots.refill();
        slots
    }

    fn kind(&self) -> JointKind {
        self.plan.robot.joints[0].kind
    }

    fn inputs(&self, candidates: &[Candidate]) -> Inputs<'static> {
        let Plan { robot, targets, .. } = self.plan;
        inputs(robot, targets, &[self.range], candidates, Some(0.0))
    }

    /// Random poses and conditions.
    fn pool(&mut self) -> Vec<Candidate> {
        let (range, speed) = (self.range, usual_speed(self.kind()));
        let targets = u32::try_from(self.plan.targets.len()).unwrap_or(1);
        let duration_s = SECONDS_PER_POSE * self.poses as f64;
        let random = &mut self.random;
        let one = |k: u32| {
            let side = if random.random::<bool>() { 1.0 } else { -1.0 };
            Candidate {
                dir: vec![side],
                speed: vec![side * speed],
                arrival: [Arrival::Short(0.03), Arrival::Long][usize::from(!k.is_multiple_of(3))],
                load_kg: f64::from(k % 2),
                above_20_c: WARMING_C * f64::from(k % 4) / 3.0,
                target: k % targets,
                time_s: duration_s * f64::from(k) / f64::from(POOL),
                ..Candidate::at(anywhere(&[range], random))
            }
        };
        (0..POOL).map(one).collect()
    }

    /// Circumstances of every pose, before its joint value: speeds without their signs, arrivals as they are
    /// wanted (a return may be to any pose).
    fn scheduled(&mut self) -> Vec<Candidate> {
        let (n, targets) = (self.poses, self.plan.targets.len());
        // Stretches of ten hold every speed for every reflector once, in random order.
        let mut in_turn: Vec<(f64, u32)> = Vec::new();
        while in_turn.len() < n {
            let one = |k: usize| {
                let target = (k / SPEEDS.len()) % targets.max(1);
                (SPEEDS[k % SPEEDS.len()], u32::try_from(target).unwrap_or(0))
            };
            let mut stretch: Vec<(f64, u32)> = (0..2 * SPEEDS.len()).map(one).collect();
            stretch.shuffle(&mut self.random);
            in_turn.extend(stretch);
        }
        let slot = |(i, (speed, target)): (usize, (f64, u32))| Candidate {
            speed: vec![usual_speed(self.kind()) * speed],
            arrival: match i % 5 {
                1 if i >= 5 => Arrival::Short(SHORT[(i / 5) % SHORT.len()]),
                // Returns wait until there is something to return to.
                4 if 4 * i > n => Arrival::Return(0),
                _ => Arrival::Long,
            },
            load_kg: LOADS[2 * i * LOADS.len() / n % LOADS.len()] * self.load_kg,
            above_20_c: WARMTHS[i * WARMTHS.len() / n] * WARMING_C,
            target,
            time_s: SECONDS_PER_POSE * i as f64,
            ..Candidate::at(vec![0.0])
        };
        in_turn.into_iter().take(n).enumerate().map(slot).collect()
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
        let mut inputs = self.inputs(&self.candidates);
        let travel = self.candidates.iter().map(|c| self.travel(c));
        inputs.travel = vec![Some(travel.collect())];
        let covariance = self.information.covariance.clone();
        self.information = Information::new(self.rows(&inputs, &[0, 1, 2]), covariance);
    }

    /// Travel since the last reversal at a choice, were it the next.
    fn travel(&self, choice: &Candidate) -> f64 {
        let all: Vec<&Candidate> = self.planned.iter().chain([choice]).collect();
        all.windows(2).fold(f64::INFINITY, |travel, pair| {
            let moved = (pair[1].q[0] - pair[0].q[0]).abs();
            let on = pair[1].dir == pair[0].dir;
            if on { travel + moved } else { moved }
        })
    }

    /// From 0 at an earlier place to 1 far from all.
    fn gap(&self, choice: &Candidate) -> f64 {
        let Range { from, to } = self.range;
        let apart = |earlier: &Candidate| ((choice.q[0] - earlier.q[0]) / (to - from)).abs();
        let nearest = self.planned.iter().map(apart).fold(1.0, f64::min);
        let step = 1.0 / (self.planned.len() + 1) as f64;
        1.0 - (-(2.0 * nearest / step).powi(2)).exp()
    }

    /// Poses that may come next.
    fn next_candidates(&mut self, like: &Candidate) -> Vec<Candidate> {
        let (range, kind, before) = (self.range, self.kind(), &self.planned);
        let last = before.last();
        let here = last.map_or(0.5 * (range.from + range.to), |last| last.q[0]);
        let reached = |q: f64, arrival: Arrival| {
            let side = if q >= here { 1.0 } else { -1.0 };
            Candidate {
                q: vec![q],
                dir: vec![side],
                speed: vec![like.speed[0] * side + 0.0],
                arrival,
                ..like.clone()
            }
        };
        if let (Arrival::Short(share), Some(last)) = (like.arrival, last) {
            let q = here - last.dir[0] * typed(share * (range.to - range.from), kind);
            if (range.from..=range.to).contains(&q) {
                return vec![reached(q, like.arrival)];
            }
        }
        let random = &mut self.random;
        if matches!(like.arrival, Arrival::Return(_)) {
            let earlier = before[..before.len().saturating_sub(2)].iter().enumerate();
            let returns = |own: &Candidate| matches!(own.arrival, Arrival::Return(_));
            let all: Vec<Candidate> = earlier
                .filter(|(_, own)| own.load_kg == like.load_kg && !returns(own))
                .map(|(k, own)| Candidate {
                    above_20_c: like.above_20_c,
                    time_s: like.time_s,
                    arrival: Arrival::Return(k),
                    ..own.clone()
                })
                .collect();
            // Where the way leads there from the right side, no detour is needed.
            let direct = |own: &&Candidate| reached(own.q[0], Arrival::Long).dir == own.dir;
            let short: Vec<Candidate> = all.iter().filter(direct).cloned().collect();
            if let Some(some) = [short, all].into_iter().find(|list| !list.is_empty()) {
                return vec![some[random.random_range(0..some.len())].clone()];
            }
        }
        let p = self.scale.len();
        let affordable = EFFORT / (3 * p * p * self.poses).max(1);
        let drawn = (0..affordable.clamp(CANDIDATES[0], CANDIDATES[1])).map(|k| {
            let mut q = anywhere(&[range], random)[0];
            if k % ENDS_EVERY == 0 {
                // Which joint is drawn as well, so that a seed gives the plan that it always gave.
                let _ = random.random_range(0..1_usize);
                q = if random.random::<bool>() {
                    range.from
                } else {
                    range.to
                };
            }
            reached(typed(q, kind).clamp(range.from, range.to), Arrival::Long)
        });
        drawn.collect()
    }
}

impl Criterion for Slots<'_> {
    fn worths(&self) -> Vec<f64> {
        let all = self.candidates.iter().enumerate();
        let worth = all.map(|(k, one)| self.information.gain(k).exp() * self.gap(one));
        worth.map(|worth| worth.max(rounding::WRITTEN)).collect()
    }

    fn take(&mut self, candidate: usize) {
        self.information.take(candidate);
        self.planned.push(self.candidates[candidate].clone());
        self.refill();
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
