//! Poses that decide between explanations that the samples cannot tell apart, and poses that show
//! what they cannot show yet.
//!
//! T-optimality (Atkinson & Fedorov 1975), greedily: the two models are fitted to the samples; a
//! pose is worth the squared difference of their predictions in units of the noise, after the
//! rival has been refitted to it as well as it can:
//!
//! ```text
//! Δ = min_β ‖d − J β‖² + βᵀ G β,   d the difference at the new poses, J the rival's columns there,
//!                                  G its Gram matrix over the samples
//! ```
//!
//! The log-odds after measuring are Δ/2 ± √Δ, so poses are added until Δ is well beyond what
//! 20 : 1 needs in 95 of 100 sessions.

use nalgebra::{DMatrix, DVector};

use crate::effects::Inputs;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::sessions::{Samples, Session, Target};
use crate::units::deg_from_rad;

use super::aliases::Rival;
use super::arena::{Arena, Fit};
use super::prepare::Prepared;

/// A pose to measure and its conditions.
#[derive(Debug, Clone, PartialEq)]
pub struct NextPose {
    /// Joint values, rad or mm.
    pub q: Vec<f64>,
    /// Side from which each joint comes.
    pub dir: Vec<f64>,
    /// Name of a reflector of the session, or of a new one; `None` where there is only one.
    pub target: Option<String>,
    /// Where a new reflector goes, tool frame, mm.
    pub target_mm: Option<[f64; 3]>,
    /// Signed speeds, rad/s or mm/s.
    pub speed: Option<Vec<f64>>,
    /// Load, kg.
    pub load_kg: Option<f64>,
    /// Temperature, °C.
    pub temperature_c: Option<f64>,
    /// Why.
    pub why: String,
}

/// The Δ that is enough: 20 : 1 in 95 of 100 sessions needs 21; the models' own errors and a
/// search for it more.
const ENOUGH: f64 = 110.0;
/// Poses that are proposed at most.
const MOST: usize = 24;
/// Angles that are tried over the range of a joint.
const ANGLES: usize = 18;
/// One condition is proposed at most so often.
const REPEATS: u8 = 2;

/// What may be measured.
#[derive(Debug, Clone)]
struct Choice {
    q: Vec<f64>,
    dir: f64,
    speed: f64,
    load_kg: f64,
    warmth_c: f64,
    target: u32,
}

/// A rival on its way to being told apart.
struct Contest {
    /// Rows of every choice: difference of the predictions, whitened.
    difference: Vec<DVector<f64>>,
    /// Columns of the model that is refitted.
    columns: Vec<DMatrix<f64>>,
    /// Gram matrix over the samples and the poses so far.
    gram: DMatrix<f64>,
    /// Columnsᵀ · difference over the poses so far.
    pull: DVector<f64>,
    /// ‖difference‖² over the poses so far.
    square: f64,
}

impl Contest {
    fn delta_with(&self, choice: Option<usize>) -> f64 {
        let (mut gram, mut pull, mut square) = (self.gram.clone(), self.pull.clone(), self.square);
        if let Some(k) = choice {
            let (j, d) = (&self.columns[k], &self.difference[k]);
            gram += j.tr_mul(j);
            pull += j.tr_mul(d);
            square += d.norm_squared();
        }
        let step = crate::identification::solver::Spectrum::new(&gram).step(&pull, 0.0);
        (square - step.dot(&pull)).max(0.0)
    }

    fn take(&mut self, k: usize) {
        let (j, d) = (&self.columns[k], &self.difference[k]);
        self.gram += j.tr_mul(j);
        self.pull += j.tr_mul(d);
        self.square += d.norm_squared();
    }
}

/// Poses that tell the fit from its rivals.
pub(super) fn separate(prepared: &Prepared, fit: &Fit, rivals: &[&Rival]) -> Vec<NextPose> {
    if rivals.is_empty() {
        return Vec::new();
    }
    let arena = &prepared.arena;
    let session = arena.problem.session;
    let (choices, extended) = choices(prepared, rivals);
    let inputs = inputs_of(&extended, &choices, prepared);
    let mut contests: Vec<Contest> = Vec::new();
    for rival in rivals {
        // Whichever of the two is true, the other one has to fail.
        contests.push(contest(arena, &inputs, &fit.model, &rival.fit.model));
        contests.push(contest(arena, &inputs, &rival.fit.model, &fit.model));
    }
    let mut taken = vec![0_u8; choices.len()];
    let mut order = Vec::new();
    while order.len() < MOST {
        let now: Vec<f64> = contests.iter().map(|c| c.delta_with(None)).collect();
        if now.iter().all(|d| *d >= ENOUGH) {
            break;
        }
        // What is still open counts; the gain of each contest up to where it is decided.
        let worth = |k: usize| -> f64 {
            contests
                .iter()
                .zip(&now)
                .filter(|(_, d)| **d < ENOUGH)
                .map(|(c, d)| (c.delta_with(Some(k)).min(ENOUGH) - d).max(0.0) / (1.0 + d))
                .sum()
        };
        let open = (0..choices.len()).filter(|k| taken[*k] < REPEATS);
        let best = open
            .map(|k| (k, worth(k)))
            .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        let Some((k, worth)) = best else { break };
        if worth <= 1e-9 {
            break;
        }
        taken[k] += 1;
        order.push(k);
        for contest in &mut contests {
            contest.take(k);
        }
    }
    let why = why(rivals);
    order
        .into_iter()
        .map(|k| pose(&choices[k], session, &extended, &why))
        .collect()
}

/// What would tell a rival from the model, in words.
pub(super) fn separate_by(rival: &Rival, poses: &[NextPose]) -> String {
    let words: Vec<&str> = rival
        .removed
        .iter()
        .chain(&rival.instead)
        .map(|t| t.effect.about().confused_with)
        .collect();
    let hint = words.first().copied().unwrap_or("");
    if poses.is_empty() {
        return format!("no pose within the limits tells them apart; {hint}");
    }
    let mut conditions = Vec::new();
    if poses.iter().any(|p| p.target_mm.is_some()) {
        conditions.push("a reflector at another radius");
    }
    if poses.iter().any(|p| p.speed.is_some()) {
        conditions.push("other speeds");
    }
    if poses.iter().any(|p| p.load_kg.is_some()) {
        conditions.push("other loads");
    }
    if poses.iter().any(|p| p.temperature_c.is_some()) {
        conditions.push("another temperature");
    }
    let with = if conditions.is_empty() {
        String::new()
    } else {
        format!(" with {}", conditions.join(", "))
    };
    format!("measure the {} poses of next_poses{with}", poses.len())
}

fn why(rivals: &[&Rival]) -> String {
    let ids = |terms: &[crate::effects::Term]| -> String {
        let ids: Vec<&str> = terms.iter().map(|t| t.effect.about().id).collect();
        ids.join(" + ")
    };
    let mut pairs: Vec<String> = Vec::new();
    for rival in rivals {
        let pair = format!("{} from {}", ids(&rival.removed), ids(&rival.instead));
        if !pairs.contains(&pair) && pairs.len() < 3 {
            pairs.push(pair);
        }
    }
    format!("tells {}", pairs.join(", and "))
}

/// Everything that may be measured, and the session with a reflector more.
fn choices(prepared: &Prepared, rivals: &[&Rival]) -> (Vec<Choice>, Session) {
    let arena = &prepared.arena;
    let mut extended = arena.problem.session.clone();
    let joints = &prepared.survey.joints;
    let revolute = joints.iter().any(|j| j.kind == JointKind::Revolute);
    if revolute && prepared.survey.targets < 2 {
        extended
            .targets
            .push(another_reflector(&extended, &joints[0].frame));
    }
    let all_terms = rivals
        .iter()
        .flat_map(|r| r.removed.iter().chain(&r.instead));
    let uses = |ids: &[&str]| {
        all_terms
            .clone()
            .any(|t| ids.contains(&t.effect.about().id))
    };
    let inputs = &prepared.problem.inputs;
    let fastest = joints.iter().map(|j| j.largest_speed).fold(0.0, f64::max);
    let speeds: Vec<f64> = if uses(&["tracking-lag", "backlash", "lost-motion"])
        && prepared.survey.joints[0].speeds > 0
        || uses(&["tracking-lag"])
    {
        let fast = if fastest > 0.0 {
            fastest
        } else {
            10.0_f64.to_radians()
        };
        vec![0.0, fast, 3.0 * fast]
    } else {
        vec![0.0]
    };
    let heaviest = prepared.survey.largest_load_kg;
    let loads = if prepared.survey.loads > 0 && heaviest > 0.0 {
        vec![0.0, heaviest]
    } else {
        vec![0.0]
    };
    let thermal = uses(&["thermal-growth", "thermal-zero-drift", "frame-drift"]);
    let warmth = match &inputs.warmth_c {
        Some(w) if thermal => {
            let (low, high) = w
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
                    (a.min(*v), b.max(*v))
                });
            vec![low, high]
        }
        _ => vec![0.0],
    };
    let mut places: Vec<Vec<f64>> = Vec::new();
    let middle: Vec<f64> = (0..joints.len()).map(|j| range_of(prepared, j).0).collect();
    for joint in 0..joints.len() {
        let (_, low, high) = range_of(prepared, joint);
        for k in 0..ANGLES {
            let mut q = middle.clone();
            q[joint] = low + (high - low) * (k as f64 + 0.5) / ANGLES as f64;
            places.push(q);
        }
    }
    let mut choices = Vec::new();
    for q in &places {
        for dir in [-1.0, 1.0] {
            for speed in &speeds {
                for load_kg in &loads {
                    for warmth_c in &warmth {
                        for target in 0..extended.targets.len() {
                            choices.push(Choice {
                                q: q.clone(),
                                dir,
                                speed: dir * speed,
                                load_kg: *load_kg,
                                warmth_c: *warmth_c,
                                target: u32::try_from(target).unwrap_or(0),
                            });
                        }
                    }
                }
            }
        }
    }
    (choices, extended)
}

/// Middle, lower and upper end of where a joint may be sent.
fn range_of(prepared: &Prepared, joint: usize) -> (f64, f64, f64) {
    let session = prepared.problem.session;
    let travel =
        crate::effects::term::travel_of(&session.robot, joint, &prepared.problem.inputs.q[joint]);
    (0.5 * (travel.from + travel.to), travel.from, travel.to)
}

/// Half as far again from the axis, and as much higher.
fn another_reflector(session: &Session, frame: &crate::effects::term::JointFrame) -> Target {
    let radius = if frame.radius_mm > 0.0 {
        frame.radius_mm
    } else {
        200.0
    };
    let outward = if frame.radius_mm > 0.0 {
        frame.radial
    } else {
        frame.across_1
    };
    let shift = nalgebra::Vector3::from(outward) * (0.5 * radius)
        + nalgebra::Vector3::from(frame.along) * (0.2 * radius);
    let in_tool = session.robot.base_from_tool.rotation.inverse() * shift;
    let first = session.targets[0].position_mm;
    let mut name = format!("T{}", session.targets.len() + 1);
    while session.targets.iter().any(|t| t.name == name) {
        name.push('n');
    }
    Target {
        name,
        position_mm: first + in_tool.map(f64::round),
    }
}

/// The choices as the effects take them, after the session's last sample.
fn inputs_of(extended: &Session, choices: &[Choice], prepared: &Prepared) -> Inputs<'static> {
    let joints = extended.robot.joints.len();
    let each = |f: &dyn Fn(&Choice) -> f64| choices.iter().map(f).collect::<Vec<f64>>();
    let zeros = vec![0.0; choices.len()];
    let times = prepared.problem.inputs.time_s.as_deref();
    let last = times.map(|t| t.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    let samples = Samples {
        q: (0..joints).map(|j| each(&|c| c.q[j])).collect(),
        q_read: vec![None; joints],
        x_mm: zeros.clone(),
        y_mm: zeros.clone(),
        z_mm: Some(zeros.clone()),
        target: Some(choices.iter().map(|c| c.target).collect()),
        dir: vec![Some(each(&|c| c.dir)); joints],
        speed: vec![Some(each(&|c| c.speed)); joints],
        load_kg: Some(each(&|c| c.load_kg)),
        temperature_c: Some(each(&|c| c.warmth_c + 20.0)),
        time_s: last.map(|t| vec![t + 60.0; choices.len()]),
        ..Samples::default()
    };
    let session = Session {
        samples,
        ..extended.clone()
    };
    let all: Vec<usize> = (0..choices.len()).collect();
    let mut inputs = Inputs::new(&session, super::prepare::values(prepared.options())).select(&all);
    inputs.start_s = Some(prepared.problem.inputs.start_s());
    // Approaches are long, and short ones where lost motion has to be told from backlash.
    for (travel, q) in inputs.travel.iter_mut().zip(&inputs.q) {
        if let Some(travel) = travel {
            for (k, t) in travel.iter_mut().enumerate() {
                *t = if k % 2 == 0 {
                    f64::INFINITY
                } else {
                    q[k].abs().max(0.1)
                };
            }
        }
    }
    inputs
}

fn contest(arena: &Arena, inputs: &Inputs, truth: &Model, other: &Model) -> Contest {
    let predicted = truth.predict(inputs);
    let (_, old_columns) = arena.rows.extract(other);
    let white = arena.noise.whitened(&arena.rows, &old_columns);
    let axes = &arena.rows.axes;
    let mut difference = Vec::new();
    let mut columns = Vec::new();
    other.visit(inputs, true, |start, block| {
        for i in 0..block.len {
            let at = predicted.get(start + i);
            difference.push(DVector::from_iterator(
                axes.len(),
                axes.iter()
                    .map(|a| (at[*a] - block.point[*a][i]) / arena.noise.sigma_mm[*a]),
            ));
            columns.push(DMatrix::from_fn(
                axes.len(),
                block.columns.len(),
                |row, k| block.columns[k][axes[row]][i] / arena.noise.sigma_mm[axes[row]],
            ));
        }
    });
    Contest {
        gram: white.tr_mul(&white),
        pull: DVector::zeros(white.ncols()),
        square: 0.0,
        difference,
        columns,
    }
}

fn pose(choice: &Choice, session: &Session, extended: &Session, why: &str) -> NextPose {
    let target = &extended.targets[choice.target as usize];
    let is_new = choice.target as usize >= session.targets.len();
    let samples = &session.samples;
    let joints = choice.q.len();
    let shown: Vec<String> = choice
        .q
        .iter()
        .map(|q| format!("{:.1}", deg_from_rad(*q)))
        .collect();
    let speed = samples.speed.iter().any(Option::is_some) || choice.speed != 0.0;
    NextPose {
        q: choice.q.clone(),
        dir: vec![choice.dir; joints],
        target: (extended.targets.len() > 1).then(|| target.name.clone()),
        target_mm: is_new.then(|| target.position_mm.coords.into()),
        speed: speed.then(|| vec![choice.speed; joints]),
        load_kg: samples.load_kg.as_ref().map(|_| choice.load_kg),
        temperature_c: (choice.warmth_c != 0.0).then_some(choice.warmth_c + 20.0),
        why: format!(
            "{why}: the explanations differ most at {}",
            shown.join(", ")
        ),
    }
}
