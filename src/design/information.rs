//! What a first measurement knows so far, pose by pose, and which pose adds the most to it (greedy
//! D-optimality, see `first_measurement`).

use nalgebra::DMatrix;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::effects::{CATALOGUE, Setting, Survey, Term};
use crate::kinematics::{Range, Robot};
use crate::model::Model;
use crate::sessions::Target;

use super::candidate_poses::{self, CandidatePose};
use super::comparison::{Axes, Prediction, inverse, predictions};
use super::first_measurement::{PlannedPose, SECONDS_PER_POSE, reflectors};
use super::needs::{WARMING_C, all_met};

/// Settings of gear orders that stand for all of them.
const ORDERS: [f64; 5] = [3.0, 4.0, 5.0, 7.0, 12.0];

/// The information so far and how to add to it.
pub(crate) struct Information {
    robot: Robot,
    targets: Vec<Target>,
    ranges: Vec<Range>,
    pub(crate) model: Model,
    scale: Vec<f64>,
    covariance: DMatrix<f64>,
    pub(crate) candidates: usize,
}

/// Multiplications that a design may take.
const EFFORT: usize = 600_000_000;

impl Information {
    pub(crate) fn new(
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
        let pool: Vec<CandidatePose> = (0..64)
            .map(|k| {
                let side = |_| if random.random::<bool>() { 1.0 } else { -1.0 };
                let dir: Vec<f64> = (0..ranges.len()).map(side).collect();
                let units = robot
                    .joints
                    .iter()
                    .map(|j| candidate_poses::usual_speed(j.kind));
                CandidatePose {
                    q: candidate_poses::anywhere(ranges, random),
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
    pub(crate) fn learn(&mut self, known: &[Prediction]) {
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

    fn seen(&self, choices: &[CandidatePose], travel: Option<&[Vec<f64>]>) -> Vec<Prediction> {
        let mut inputs =
            candidate_poses::inputs(&self.robot, &self.targets, &self.ranges, choices, Some(0.0));
        if let Some(travel) = travel {
            for (own, travel) in inputs.travel.iter_mut().zip(travel) {
                *own = Some(travel.clone());
            }
        }
        let axes = Axes {
            axes: vec![0, 1, 2],
            sigma_mm: [1.0; 3],
        };
        predictions(&self.model, &self.model, &inputs, &axes)
    }

    /// From 0 at an earlier place to 1 far from all: places that lie together hide what is local.
    fn gap(&self, choice: &CandidatePose, before: &[PlannedPose]) -> f64 {
        let apart = |planned_pose: &PlannedPose| {
            let each = (0..self.ranges.len()).map(|j| {
                let span = self.ranges[j].to - self.ranges[j].from;
                ((choice.q[j] - planned_pose.choice.q[j]) / span).abs()
            });
            each.fold(0.0, f64::max)
        };
        let nearest = before.iter().map(apart).fold(1.0, f64::min);
        let step = 1.0 / (before.len() + 1) as f64;
        1.0 - (-(2.0 * nearest / step).powi(2)).exp()
    }

    /// The candidate that adds most; it is taken.
    pub(crate) fn best(&mut self, candidates: &[PlannedPose], before: &[PlannedPose]) -> usize {
        let choices: Vec<CandidatePose> = candidates.iter().map(|s| s.choice.clone()).collect();
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
fn travels(before: &[PlannedPose], choices: &[CandidatePose]) -> Vec<Vec<f64>> {
    let joints = choices.first().map_or(0, |c| c.q.len());
    let after = |j: usize, choice: &CandidatePose| {
        let mut travel = f64::INFINITY;
        let all = before.iter().map(|s| &s.choice).chain([choice]);
        let all: Vec<&CandidatePose> = all.collect();
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
                Setting::None | Setting::Setup | Setting::Target | Setting::Place => vec![0.0],
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
                Setting::Listed(listed) => vec![listed.stands_for_all(joint)],
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
    let session = super::expected_information::imagined(robot, &reflectors(robot), &[], None);
    let inputs = crate::effects::Inputs::new(&session, crate::effects::JointValues::Commanded);
    let mut survey = all_met(&Survey::new(&session, &inputs));
    for (joint, range) in survey.joints.iter_mut().zip(ranges) {
        joint.span = range.to - range.from;
    }
    survey.spatial = true;
    survey
}
