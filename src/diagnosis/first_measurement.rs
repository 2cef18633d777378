//! A first measurement of a robot: what a technician should do before anything is known.
//!
//! The conditions follow a schedule, so that nothing changes together with something else: loads
//! in the order 0 L L 0 0 L L 0 (a drift in time cancels), the machine cold, warming up, warm and
//! cooling down, both reflectors and all speeds in every stretch, short approaches after a
//! reversal, and returns to earlier poses under the same conditions. Joint values are then chosen
//! one pose after the other by greedy D-optimality (Fedorov 1972) over random candidates:
//!
//! ```text
//! maximise ln det(1 + J C Jᵀ),   C ← C − C Jᵀ (1 + J C Jᵀ)⁻¹ J C
//! ```
//!
//! with J the columns of every effect of the catalogue that the robot can show, each scaled to the
//! same size. Random candidates also leave no equal steps, behind which an order could hide.

use nalgebra::{DMatrix, Point3};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::effects::{CATALOGUE, Setting, Survey, Term};
use crate::kinematics::{JointKind, Range, Robot};
use crate::model::Model;
use crate::sessions::Target;

use super::contest::{Axes, Prospect, inverse, prospects};
use super::offer::{self, Choice};
use super::unlock::{WARMING_C, all_met};

/// Time for a pose, s, as far as drifts are concerned.
pub(super) const SECONDS_PER_POSE: f64 = 10.0;
/// Load in each eighth of the measurement, as a share of the test load.
const LOADS: [f64; 8] = [0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0];
/// Warmth in each quarter, as a share of the warming: cold, warming up, warm, cooling down.
const WARMTHS: [f64; 4] = [0.0, 0.5, 1.0, 0.35];
/// Speeds in turn, in units of a modest one: most poses at standstill.
const SPEEDS: [f64; 5] = [0.0, 1.0, 0.0, 2.0, 0.0];
/// Lengths of the short approaches, as shares of a joint's range.
const SHORT: [f64; 3] = [0.01, 0.03, 0.09];
/// Settings of gear orders that stand for all of them.
const ORDERS: [f64; 5] = [3.0, 4.0, 5.0, 7.0, 12.0];

/// What a first measurement is made for.
#[derive(Debug, Clone)]
pub(super) struct Brief {
    pub(super) poses: usize,
    pub(super) load_kg: f64,
    pub(super) seed: u64,
}

/// How a pose is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Way {
    /// From far.
    Long,
    /// After a reversal so many of the joint's ranges before.
    Short(f64),
    /// The same pose as that one (counted from 0).
    Return(usize),
}

/// One pose of the design.
#[derive(Debug, Clone)]
pub(super) struct Stop {
    pub(super) choice: Choice,
    pub(super) way: Way,
}

/// The reflectors of a first measurement: the tool's origin and one more, where something turns.
pub(super) fn reflectors(robot: &Robot) -> Vec<Target> {
    let mut targets = vec![Target {
        name: "T1".to_owned(),
        position_mm: Point3::origin(),
    }];
    if robot.joints.iter().any(|j| j.kind == JointKind::Revolute) {
        targets.extend(offer::other_reflectors(robot, &targets).into_iter().take(1));
    }
    targets
}

/// What was measured already, as a model's columns show it.
pub(super) type Known<'a> = &'a dyn Fn(&Model) -> Vec<Prospect>;

/// The poses in measuring order.
pub(super) fn design(robot: &Robot, targets: &[Target], brief: &Brief) -> Vec<Stop> {
    let ranges = offer::ranges(robot, None);
    extension(robot, targets, &ranges, brief, &|_| Vec::new())
}

/// More poses beside what is known.
pub(super) fn extension(
    robot: &Robot,
    targets: &[Target],
    ranges: &[Range],
    brief: &Brief,
    known: Known,
) -> Vec<Stop> {
    let n = brief.poses;
    let mut random = ChaCha8Rng::seed_from_u64(brief.seed ^ 0x5eed);
    let mut information = Information::new(robot, targets, ranges, n, &mut random);
    information.learn(&known(&information.model));
    let schedule = Schedule::new(robot, targets.len(), brief, &mut random);
    let mut stops: Vec<Stop> = Vec::with_capacity(n);
    for i in 0..n {
        let like = schedule.conditions(i);
        let candidates = candidates(
            ranges,
            &stops,
            &like,
            schedule.ways[i],
            &information,
            &mut random,
        );
        let best = information.best(&candidates, &stops);
        stops.extend(candidates.into_iter().nth(best));
    }
    stops
}

/// Conditions of every pose, before its joint values.
struct Schedule {
    plain: Choice,
    count: usize,
    unit: Vec<f64>,
    load_kg: f64,
    speeds: Vec<f64>,
    targets: Vec<u32>,
    ways: Vec<WayWanted>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum WayWanted {
    Long,
    Short(f64),
    Return,
}

impl Schedule {
    fn new(robot: &Robot, targets: usize, brief: &Brief, random: &mut ChaCha8Rng) -> Self {
        let n = brief.poses;
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
        let way = |i: usize| match i % 5 {
            1 if i >= 5 => WayWanted::Short(SHORT[(i / 5) % SHORT.len()]),
            // Returns wait until there is something to return to.
            4 if 4 * i > n => WayWanted::Return,
            _ => WayWanted::Long,
        };
        Self {
            plain: Choice {
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
                .map(|j| offer::usual_speed(j.kind))
                .collect(),
            load_kg: brief.load_kg,
            speeds,
            targets: of,
            ways: (0..n).map(way).collect(),
        }
    }

    /// Everything but where and from which side; speeds without their signs.
    fn conditions(&self, i: usize) -> Choice {
        let part = |parts: usize| i * parts / self.count.max(1);
        Choice {
            speed: self.unit.iter().map(|u| u * self.speeds[i]).collect(),
            load_kg: LOADS[part(LOADS.len())] * self.load_kg,
            warmth_c: WARMTHS[part(WARMTHS.len())] * WARMING_C,
            target: self.targets[i],
            time_s: SECONDS_PER_POSE * i as f64,
            ..self.plain.clone()
        }
    }
}

/// Stops that may come next.
fn candidates(
    ranges: &[Range],
    before: &[Stop],
    like: &Choice,
    wanted: WayWanted,
    information: &Information,
    random: &mut ChaCha8Rng,
) -> Vec<Stop> {
    let last = before.last().map(|s| &s.choice);
    let reached = |q: Vec<f64>, way: Way| {
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
        let choice = Choice {
            q,
            dir,
            speed,
            ..like.clone()
        };
        Stop { choice, way }
    };
    if let (WayWanted::Short(share), Some(last)) = (wanted, last) {
        let step = |j: usize| {
            let range = &ranges[j];
            last.q[j] - last.dir[j] * typed(share * (range.to - range.from), range)
        };
        let q: Vec<f64> = (0..ranges.len()).map(step).collect();
        let inside = q
            .iter()
            .zip(ranges)
            .all(|(q, r)| *q >= r.from && *q <= r.to);
        if inside {
            return vec![reached(q, Way::Short(share))];
        }
    }
    if wanted == WayWanted::Return {
        let same = |s: &&Stop| s.choice.load_kg == like.load_kg && !matches!(s.way, Way::Return(_));
        let earlier = before.len().saturating_sub(2);
        let all: Vec<Stop> = before[..earlier]
            .iter()
            .enumerate()
            .filter(|(_, s)| same(s))
            .map(|(k, s)| Stop {
                choice: Choice {
                    warmth_c: like.warmth_c,
                    time_s: like.time_s,
                    ..s.choice.clone()
                },
                way: Way::Return(k),
            })
            .collect();
        // Where the way leads there from the right side, no detour is needed.
        let direct = |s: &&Stop| {
            let came = reached(s.choice.q.clone(), Way::Long);
            came.choice.dir == s.choice.dir
        };
        let short: Vec<Stop> = all.iter().filter(direct).cloned().collect();
        if let Some(one) = [short, all].into_iter().find(|list| !list.is_empty()) {
            let pick = random.random_range(0..one.len());
            return vec![one[pick].clone()];
        }
    }
    let drawn = (0..information.candidates).map(|k| {
        // The ends belong to the travel: some candidates lie there.
        let mut q = offer::anywhere(ranges, random);
        if k % 8 == 0 {
            let joint = random.random_range(0..ranges.len());
            let range = &ranges[joint];
            q[joint] = if random.random::<bool>() {
                range.from
            } else {
                range.to
            };
        }
        let q = q.iter().zip(ranges).map(|(q, range)| {
            let rounded = typed(*q, range);
            rounded.clamp(range.from, range.to)
        });
        reached(q.collect(), Way::Long)
    });
    drawn.collect()
}

/// Rounded to what a technician types: a tenth of a degree or of a millimetre.
fn typed(value: f64, range: &Range) -> f64 {
    let step = if range.to - range.from < 20.0 {
        0.1_f64.to_radians()
    } else {
        0.1
    };
    (value / step).round() * step
}

/// The information so far and how to add to it.
struct Information {
    robot: Robot,
    targets: Vec<Target>,
    ranges: Vec<Range>,
    model: Model,
    scale: Vec<f64>,
    covariance: DMatrix<f64>,
    candidates: usize,
}

/// Multiplications that a design may take.
const EFFORT: usize = 600_000_000;

impl Information {
    fn new(
        robot: &Robot,
        targets: &[Target],
        ranges: &[Range],
        poses: usize,
        random: &mut ChaCha8Rng,
    ) -> Self {
        let model = every_effect(robot, ranges, poses);
        let p = model.coefficient_count();
        let mut information = Self {
            robot: robot.clone(),
            targets: targets.to_vec(),
            ranges: ranges.to_vec(),
            scale: vec![1.0; p],
            covariance: DMatrix::identity(p, p),
            candidates: (EFFORT / (3 * p * p * poses).max(1)).clamp(12, 160),
            model,
        };
        // Each column is scaled to a root mean square of one over random poses and conditions.
        let mut sum = vec![0.0; p];
        let pool: Vec<Choice> = (0..64)
            .map(|k| {
                let side = |_| if random.random::<bool>() { 1.0 } else { -1.0 };
                let dir: Vec<f64> = (0..ranges.len()).map(side).collect();
                let units = robot.joints.iter().map(|j| offer::usual_speed(j.kind));
                Choice {
                    q: offer::anywhere(ranges, random),
                    speed: units.zip(&dir).map(|(u, d)| u * d).collect(),
                    dir,
                    approach: (k % 3 == 0).then_some(0.03),
                    load_kg: f64::from(k % 2),
                    warmth_c: WARMING_C * f64::from(k % 4) / 3.0,
                    target: k % u32::try_from(targets.len()).unwrap_or(1),
                    time_s: SECONDS_PER_POSE * poses as f64 * f64::from(k) / 64.0,
                }
            })
            .collect();
        for seen in information.seen(&pool, None) {
            for (k, sum) in sum.iter_mut().enumerate() {
                *sum += seen.columns.column(k).norm_squared() / 64.0;
            }
        }
        for (scale, sum) in information.scale.iter_mut().zip(sum) {
            *scale = if sum > 0.0 { 1.0 / sum.sqrt() } else { 0.0 };
        }
        information
    }

    /// Takes in what was measured already.
    fn learn(&mut self, known: &[Prospect]) {
        let p = self.scale.len();
        let mut precision = DMatrix::identity(p, p);
        for seen in known {
            let mut columns = seen.columns.clone();
            for (k, scale) in self.scale.iter().enumerate() {
                columns.column_mut(k).scale_mut(*scale);
            }
            precision.gemm_tr(1.0, &columns, &columns, 1.0);
        }
        if !known.is_empty() {
            self.covariance = inverse(&precision);
        }
    }

    fn seen(&self, choices: &[Choice], travel: Option<&[Vec<f64>]>) -> Vec<Prospect> {
        let mut inputs =
            offer::inputs(&self.robot, &self.targets, &self.ranges, choices, Some(0.0));
        if let Some(travel) = travel {
            for (own, travel) in inputs.travel.iter_mut().zip(travel) {
                *own = Some(travel.clone());
            }
        }
        let axes = Axes {
            axes: vec![0, 1, 2],
            sigma_mm: [1.0; 3],
        };
        prospects(&self.model, &self.model, &inputs, &axes)
    }

    /// From 0 at an earlier place to 1 far from all: places that lie together hide what is local.
    fn gap(&self, choice: &Choice, before: &[Stop]) -> f64 {
        let apart = |stop: &Stop| {
            let each = (0..self.ranges.len()).map(|j| {
                let span = self.ranges[j].to - self.ranges[j].from;
                ((choice.q[j] - stop.choice.q[j]) / span).abs()
            });
            each.fold(0.0, f64::max)
        };
        let nearest = before.iter().map(apart).fold(1.0, f64::min);
        let step = 1.0 / (before.len() + 1) as f64;
        1.0 - (-(2.0 * nearest / step).powi(2)).exp()
    }

    /// The candidate that adds most; it is taken.
    fn best(&mut self, candidates: &[Stop], before: &[Stop]) -> usize {
        let choices: Vec<Choice> = candidates.iter().map(|s| s.choice.clone()).collect();
        let travel = travels(before, &choices);
        let mut scaled: Vec<DMatrix<f64>> = Vec::new();
        for seen in self.seen(&choices, Some(&travel)) {
            let mut columns = seen.columns;
            for (k, scale) in self.scale.iter().enumerate() {
                columns.column_mut(k).scale_mut(*scale);
            }
            scaled.push(columns);
        }
        let spread = |j: &DMatrix<f64>| {
            let mut spread = j * &self.covariance * j.transpose();
            for k in 0..spread.nrows() {
                spread[(k, k)] += 1.0;
            }
            spread
        };
        let worth = |j: &DMatrix<f64>| spread(j).determinant();
        let values: Vec<f64> = if scaled.len() > 1 {
            let gaps = choices.iter().map(|c| self.gap(c, before));
            scaled
                .iter()
                .zip(gaps)
                .map(|(j, gap)| worth(j) * gap)
                .collect()
        } else {
            vec![0.0; scaled.len()]
        };
        let best = (0..values.len())
            .max_by(|a, b| values[*a].total_cmp(&values[*b]).then(b.cmp(a)))
            .unwrap_or(0);
        if let Some(j) = scaled.get(best)
            && let Some(factor) = spread(j).cholesky()
        {
            let carried = &self.covariance * j.transpose();
            self.covariance -= &carried * factor.solve(&carried.transpose());
        }
        best
    }
}

/// Travel since the last reversal of each joint at each choice, were it the next.
fn travels(before: &[Stop], choices: &[Choice]) -> Vec<Vec<f64>> {
    let joints = choices.first().map_or(0, |c| c.q.len());
    let after = |j: usize, choice: &Choice| {
        let mut travel = f64::INFINITY;
        let all = before.iter().map(|s| &s.choice).chain([choice]);
        let all: Vec<&Choice> = all.collect();
        // Only the way since the last reversal counts.
        for pair in all.windows(2) {
            let moved = (pair[1].q[j] - pair[0].q[j]).abs();
            travel = if pair[1].dir[j] == pair[0].dir[j] {
                travel + moved
            } else {
                moved
            };
        }
        travel
    };
    (0..joints)
        .map(|j| choices.iter().map(|c| after(j, c)).collect())
        .collect()
}

/// A model with every effect that this robot can show, absent, at settings that stand for all.
fn every_effect(robot: &Robot, ranges: &[Range], poses: usize) -> Model {
    let survey = ideal_survey(robot, ranges);
    let mut terms = Vec::new();
    for effect in CATALOGUE {
        let about = effect.about();
        let joints = if about.per_joint { ranges.len() } else { 1 };
        for (joint, range) in ranges.iter().enumerate().take(joints) {
            if effect.obstacle(&survey, joint).is_some() {
                continue;
            }
            let settings: Vec<f64> = match about.setting {
                Setting::None | Setting::Setup => vec![0.0],
                Setting::Order { to, .. } if to > 6 && ranges.len() == 1 => ORDERS.to_vec(),
                Setting::Order { from, to } => {
                    let most = if ranges.len() > 1 { from } else { to };
                    (from..=most).map(f64::from).collect()
                }
                Setting::Fade => vec![0.02, 0.08]
                    .into_iter()
                    .map(|share| share * (range.to - range.from))
                    .collect(),
                Setting::Time => vec![0.5 * SECONDS_PER_POSE * poses as f64],
            };
            terms.extend(
                settings
                    .into_iter()
                    .map(|s| Term::absent(*effect, joint, s)),
            );
        }
    }
    Model::new(robot.clone(), terms)
}

/// The survey of a robot under all conditions that poses can meet.
fn ideal_survey(robot: &Robot, ranges: &[Range]) -> Survey {
    let session = super::foresight::imagined(robot, &reflectors(robot), &[], None);
    let inputs = crate::effects::Inputs::new(&session, crate::effects::JointValues::Commanded);
    let mut survey = all_met(&Survey::new(&session, &inputs));
    for (joint, range) in survey.joints.iter_mut().zip(ranges) {
        joint.span = range.to - range.from;
    }
    survey.spatial = true;
    survey
}
