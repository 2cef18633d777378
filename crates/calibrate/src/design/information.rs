//! What poses show of every effect of the catalogue.

use nalgebra::DMatrix;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::effects::{CATALOGUE, Effect, Setting, Survey, Term};
use crate::kinematics::{Range, Robot};
use crate::model::Model;
use crate::sessions::Target;

use super::candidates::{Arrival, Candidate, anywhere, inputs, reflectors, usual_speed};
use super::comparison::{Axes, Prediction, predictions};
use super::exchange::Information;
use super::expected_rows::{SECONDS_PER_POSE, unmeasured};
use super::inverse::inverse;
use super::needs::{WARMING_C, all_met};

/// Settings of gear orders that stand for all of them.
const ORDERS: [f64; 5] = [3.0, 4.0, 5.0, 7.0, 12.0];

/// The columns of every effect that a robot can show, each scaled to a root mean square of one.
pub(crate) struct Columns {
    robot: Robot,
    targets: Vec<Target>,
    ranges: Vec<Range>,
    pub(crate) model: Model,
    scale: Vec<f64>,
    /// Candidates for each pose.
    pub(crate) candidates: usize,
}

/// Multiplications that a design may take.
const EFFORT: usize = 600_000_000;

impl Columns {
    pub(crate) fn new(
        robot: &Robot,
        targets: &[Target],
        ranges: &[Range],
        poses: usize,
        random: &mut ChaCha8Rng,
    ) -> Self {
        let model = every_effect(robot, ranges, 0.5 * SECONDS_PER_POSE * poses as f64);
        let p = model.coefficient_count();
        let mut columns = Self {
            robot: robot.clone(),
            targets: targets.to_vec(),
            ranges: ranges.to_vec(),
            scale: vec![1.0; p],
            candidates: (EFFORT / (3 * p * p * poses).max(1)).clamp(12, 160),
            model,
        };
        // Over random poses and conditions.
        let pool: Vec<Candidate> = (0..64)
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
                    target: k % u32::try_from(targets.len()).unwrap_or(1),
                    time_s: SECONDS_PER_POSE * poses as f64 * f64::from(k) / 64.0,
                    ..Candidate::at(anywhere(ranges, random))
                }
            })
            .collect();
        let (rows, _) = columns.of_choices(&pool, None);
        let unit = |k: usize| {
            let sum = rows.column(k).norm_squared() / 64.0;
            if sum > 0.0 { 1.0 / sum.sqrt() } else { 0.0 }
        };
        columns.scale = (0..p).map(unit).collect();
        columns
    }

    /// What is known of the scaled coefficients once these were measured, and nothing before.
    pub(crate) fn measured_information(&self, measured: &[Prediction]) -> DMatrix<f64> {
        let p = self.scale.len();
        let mut precision = DMatrix::identity(p, p);
        if measured.is_empty() {
            return precision;
        }
        let (rows, _) = self.scaled(measured);
        precision.gemm_tr(1.0, &rows, &rows, 1.0);
        inverse(&precision)
    }

    /// Scaled rows, one below the other, and where each begins.
    fn scaled(&self, seen: &[Prediction]) -> (DMatrix<f64>, Vec<usize>) {
        let mut first = vec![0];
        first.extend(seen.iter().scan(0, |end, one| {
            *end += one.columns.nrows();
            Some(*end)
        }));
        let mut rows = DMatrix::zeros(first[seen.len()], self.scale.len());
        for (one, from) in seen.iter().zip(&first) {
            rows.rows_mut(*from, one.columns.nrows())
                .copy_from(&one.columns);
        }
        for (mut column, scale) in rows.column_iter_mut().zip(&self.scale) {
            column *= *scale;
        }
        (rows, first)
    }

    fn of_choices(
        &self,
        choices: &[Candidate],
        travel: Option<Vec<Vec<f64>>>,
    ) -> (DMatrix<f64>, Vec<usize>) {
        let mut inputs = inputs(&self.robot, &self.targets, &self.ranges, choices, Some(0.0));
        if let Some(travel) = travel {
            inputs.travel = travel.into_iter().map(Some).collect();
        }
        let axes = Axes {
            axes: vec![0, 1, 2],
            sigma_mm: [1.0; 3],
        };
        self.scaled(&predictions(&self.model, &self.model, &inputs, &axes))
    }

    /// From 0 at an earlier place to 1 far from all: places that lie together hide what is local.
    pub(crate) fn gap(&self, choice: &Candidate, before: &[Candidate]) -> f64 {
        let apart = |earlier: &Candidate| {
            let pairs = choice.q.iter().zip(&earlier.q).zip(&self.ranges);
            let each = pairs.map(|((a, b), range)| ((a - b) / (range.to - range.from)).abs());
            each.fold(0.0, f64::max)
        };
        let nearest = before.iter().map(apart).fold(1.0, f64::min);
        let step = 1.0 / (before.len() + 1) as f64;
        1.0 - (-(2.0 * nearest / step).powi(2)).exp()
    }

    /// What each of some poses would add behind those before.
    pub(crate) fn information(
        &self,
        candidates: &[Candidate],
        before: &[Candidate],
        covariance: DMatrix<f64>,
    ) -> Information {
        let travel = travels(before, candidates);
        let (rows, first) = self.of_choices(candidates, Some(travel));
        Information::new(&rows, first, covariance)
    }
}

/// Travel since the last reversal of each joint at each choice, were it the next.
fn travels(before: &[Candidate], choices: &[Candidate]) -> Vec<Vec<f64>> {
    let joints = choices.first().map_or(0, |c| c.q.len());
    let after = |j: usize, choice: &Candidate| {
        let mut travel = f64::INFINITY;
        let all: Vec<&Candidate> = before.iter().chain([choice]).collect();
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
pub(crate) fn every_effect(robot: &Robot, ranges: &[Range], middle_s: f64) -> Model {
    let survey = ideal_survey(robot, ranges);
    let mut terms = Vec::new();
    for effect in CATALOGUE {
        let about = effect.about();
        let joints = if about.per_joint { ranges.len() } else { 1 };
        for (joint, range) in ranges.iter().enumerate().take(joints) {
            if effect.obstacle(&survey, joint).is_some() {
                continue;
            }
            let several = ranges.len() > 1;
            let fades = [0.02, 0.08].map(|share| share * (range.to - range.from));
            match about.setting {
                Setting::Order { to, .. } if to > 6 && !several => {
                    terms.extend(ORDERS.map(|order| Term::absent(effect, joint, order)));
                }
                _ => {
                    let orders = if several { 1 } else { u16::MAX };
                    terms.extend(standing(effect, joint, orders, &fades, middle_s));
                }
            }
        }
    }
    Model::new(robot.clone(), terms)
}

/// An effect, absent, at settings that stand for all: orders up to one (its lowest at least), fades, a time.
pub(crate) fn standing(
    effect: &'static Effect,
    joint: usize,
    orders: u16,
    fades: &[f64],
    time_s: f64,
) -> Vec<Term> {
    let settings: Vec<f64> = match effect.about().setting {
        Setting::None | Setting::Setup | Setting::Target | Setting::Place => vec![0.0],
        Setting::Order { from, to } => (from..=to.min(orders.max(from))).map(f64::from).collect(),
        Setting::Fade => fades.to_vec(),
        Setting::Time => vec![time_s],
        Setting::Listed(listed) => vec![listed.stands_for_all(joint)],
    };
    let absent = |setting| Term::absent(effect, joint, setting);
    settings.into_iter().map(absent).collect()
}

/// The survey of a robot under all conditions that poses can meet.
fn ideal_survey(robot: &Robot, ranges: &[Range]) -> Survey {
    let session = unmeasured(robot, &reflectors(robot), None);
    let inputs = crate::effects::Inputs::new(&session, crate::effects::JointValues::Commanded);
    let mut survey = all_met(&Survey::new(&session, &inputs));
    for (joint, range) in survey.joints.iter_mut().zip(ranges) {
        joint.span = range.to - range.from;
    }
    survey.spatial = true;
    survey
}
