//! Poses that decide between explanations that the samples cannot tell apart: T-optimality,
//! greedily, over everything that may be measured.
//!
//! Each pair of explanations meets in two comparisons, for either may be the true one. Poses are
//! added until they decide all comparisons at once in `SURE` of all sessions, whichever explanation
//! is true (`decision`). Where one reflector cannot decide, the place of a second one is
//! chosen with the poses: the one that decides with the fewest.

use crate::effects::{Condition, Over, Term};
use crate::kinematics::JointKind;
use crate::sessions::{Session, Target};
use crate::units::deg_from_rad;

use super::candidate_poses::{self, CandidatePose, Conditions};
use super::comparison::{Axes, Comparison, Parting, enough_for, predictions};
use super::decision::{Decision, Explanation, Needed};
use super::enabling_poses;
use super::exchange::{Criterion, choose};
use super::imagined::LATER_S;
use crate::diagnosis::NextPose;
use crate::diagnosis::aliases::{self, Rival, UNDECIDED};
use crate::diagnosis::conclude::{Proposal, Undecided};
use crate::diagnosis::prepare::Prepared;
use crate::diagnosis::regression::{Fit, Regression};

/// Poses that are proposed at most.
pub(crate) const MOST: usize = 24;
/// Probability that the poses decide, whichever explanation is true. It is above the 95 % that are
/// promised by what the draws do not know: their own error, and tests beside the odds.
const SURE: f64 = 0.98;
/// Explanations that are compared, and of how many of them rivals are looked for.
const MOST_COMPETING: usize = 14;
const MOST_ASKED: usize = 3;
/// A separation that decides whatever the noise does.
const MOST_SEPARATION: f64 = 1e6;
/// One condition is proposed at most so often.
const REPEATS: u8 = 2;

/// What is offered, and where: the session's reflectors and perhaps one more.
#[derive(Debug, Clone)]
pub(crate) struct CandidatePoses {
    pub(crate) targets: Vec<Target>,
    pub(crate) ranges: Vec<crate::kinematics::Range>,
    pub(crate) poses: Vec<CandidatePose>,
}

impl CandidatePoses {
    pub(crate) fn new(prepared: &Prepared, targets: Vec<Target>, conditions: &Conditions) -> Self {
        let robot = &prepared.problem.session.robot;
        let ranges = candidate_poses::ranges(robot, Some(&prepared.problem.inputs));
        Self {
            poses: candidate_poses::combinations(&ranges, conditions, prepared.options().seed),
            ranges,
            targets,
        }
    }

    pub(crate) fn inputs(&self, prepared: &Prepared) -> crate::effects::Inputs<'static> {
        let start = prepared.problem.inputs.start_s();
        let robot = &prepared.problem.session.robot;
        candidate_poses::inputs(robot, &self.targets, &self.ranges, &self.poses, Some(start))
    }
}

/// Poses that tell the fit from its rivals, at most `most`.
pub(crate) fn separate(
    prepared: &Prepared,
    fit: &Fit,
    rivals: &[&Rival],
    most: usize,
) -> Vec<NextPose> {
    if rivals.is_empty() {
        return Vec::new();
    }
    let terms: Vec<&Term> = rivals
        .iter()
        .flat_map(|r| r.removed.iter().chain(&r.instead))
        .collect();
    let competing = competing(prepared, fit, rivals);
    let mut best: Option<Attempt> = None;
    for (at, targets) in reflector_sets(prepared).into_iter().enumerate() {
        let conditions = conditions(prepared, &terms, targets.len());
        let candidates = CandidatePoses::new(prepared, targets, &conditions);
        let attempt = attempt(prepared, candidates, &competing, most);
        // Another reflector has to be mounted: only where the others do not decide.
        let done = at == 0 && attempt.decides();
        if best.as_ref().is_none_or(|b| attempt.better_than(b)) {
            best = Some(attempt);
        }
        if done {
            break;
        }
    }
    let Some(Attempt {
        candidates, order, ..
    }) = best
    else {
        return Vec::new();
    };
    let why = why(rivals);
    let session = prepared.problem.session;
    let poses = order
        .into_iter()
        .flat_map(|k| poses_of(&candidates.poses[k], session, &candidates, &why));
    let mut poses: Vec<NextPose> = poses.take(most).collect();
    for k in 0..poses.len() {
        let (before, rest) = poses.split_at_mut(k);
        if before.iter().any(|earlier| rest[0].repeats(earlier)) {
            rest[0].why += "; measured a second time, as once is not enough over the noise";
        }
    }
    poses
}

/// What to measure next: poses that decide between the rivals, or where there are none, poses that
/// make testable what the session cannot show.
pub fn propose(undecided: &Undecided) -> Proposal {
    let (prepared, fit) = (undecided.prepared, undecided.fit);
    let poses = if undecided.rivals.is_empty() {
        enabling_poses::worth_enabling(prepared, fit, undecided.not_testable)
    } else {
        separate(prepared, fit, undecided.rivals, MOST)
    };
    let rivals = undecided.rivals.iter();
    Proposal {
        separate_by: rivals.map(|rival| separate_by(rival, &poses)).collect(),
        poses,
    }
}

/// The session's reflectors, and where there is but one, those with each place for another.
pub(crate) fn reflector_sets(prepared: &Prepared) -> Vec<Vec<Target>> {
    let session = prepared.problem.session;
    let turns = |j: &crate::effects::survey::JointSurvey| j.kind == JointKind::Revolute;
    if session.targets.len() > 1 || !prepared.survey.joints.iter().any(turns) {
        return vec![session.targets.clone()];
    }
    let others = candidate_poses::other_reflectors(&session.robot, &session.targets);
    let with = |other: Target| session.targets.iter().cloned().chain([other]).collect();
    let extended = others.into_iter().map(with);
    [session.targets.clone()]
        .into_iter()
        .chain(extended)
        .collect()
}

/// Conditions that matter to these effects.
pub(crate) fn conditions(prepared: &Prepared, terms: &[&Term], targets: usize) -> Conditions {
    let survey = &prepared.survey;
    let inputs = &prepared.problem.inputs;
    let told_by = |condition| {
        let mut abouts = terms.iter().map(|t| t.effect.about());
        abouts.any(|about| about.told_by.contains(&condition))
    };
    let moves = terms.iter().any(|t| t.effect.about().over == Over::Speed);
    let mut conditions = Conditions::plain(&prepared.problem.session.robot);
    for (unit, joint) in conditions.unit_of_speed.iter_mut().zip(&survey.joints) {
        if joint.largest_speed > 0.0 {
            *unit = joint.largest_speed;
        }
    }
    let speeds_known = survey.joints.iter().any(|j| j.speeds > 0);
    if moves || speeds_known && told_by(Condition::Speed) {
        conditions.speeds = vec![0.0, 1.0, 3.0];
    }
    if survey.loads > 0 && survey.largest_load_kg > 0.0 {
        conditions.loads_kg = vec![0.0, survey.largest_load_kg];
    }
    let thermal = told_by(Condition::Temperature);
    if let Some(warmth) = inputs.warmth_c.as_ref().filter(|_| thermal) {
        let low = warmth.iter().copied().fold(f64::INFINITY, f64::min);
        let high = warmth.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        conditions.warmths_c = vec![low, high];
        conditions.warmths_c.dedup();
    }
    if told_by(Condition::Approach) {
        conditions.approaches = vec![None, Some(0.01), Some(0.05)];
    }
    conditions.targets = (0..u32::try_from(targets).unwrap_or(1)).collect();
    conditions.time_s = later_s(prepared);
    conditions
}

/// A time after the last sample, s.
pub(crate) fn later_s(prepared: &Prepared) -> f64 {
    let times = prepared.problem.inputs.time_s.as_deref().unwrap_or(&[]);
    times.iter().copied().fold(0.0, f64::max) + LATER_S
}

/// The fit, its open rivals, and what comes close to any of them: what is ruled out now may come
/// back with new poses, and a rival that is true has rivals of its own.
fn competing(prepared: &Prepared, fit: &Fit, open: &[&Rival]) -> Vec<(Fit, bool)> {
    let regression = &prepared.regression;
    let mut all: Vec<(Fit, bool)> = vec![(fit.clone(), true)];
    let mut join = |one: &Fit, is_open: bool| {
        let known = all.iter().any(|(a, _)| same_terms(a, one));
        if !known && all.len() < MOST_COMPETING {
            all.push((one.clone(), is_open));
        }
    };
    for rival in open {
        join(&rival.fit, true);
    }
    let most_open = open.iter().take(MOST_ASKED).map(|r| &r.fit);
    for one in [fit].into_iter().chain(most_open) {
        for near in aliases::rivals(regression, one) {
            if near.other_names() {
                join(&near.fit, false);
            }
        }
    }
    all
}

fn same_terms(one: &Fit, other: &Fit) -> bool {
    let (a, b) = (one.model.terms(), other.model.terms());
    let within = |a: &[Term], b: &[Term]| a.iter().all(|t| b.iter().any(|o| o.same_column(t)));
    a.len() == b.len() && within(a, b)
}

/// Poses for one set of reflectors.
struct Attempt {
    candidates: CandidatePoses,
    order: Vec<usize>,
    /// What they are worth.
    needed: Needed,
    /// How much of the separation that is needed they bring, on average.
    separation: f64,
}

impl Attempt {
    fn decides(&self) -> bool {
        self.needed.unparted == 0 && self.needed.probability >= SURE
    }

    fn better_than(&self, other: &Self) -> bool {
        if self.needed.unparted != other.needed.unparted {
            return self.needed.unparted < other.needed.unparted;
        }
        match (self.decides(), other.decides()) {
            (true, true) => self.order.len() < other.order.len(),
            (true, false) => true,
            (false, true) => false,
            (false, false) => {
                let score = |a: &Self| a.needed.probability + a.separation;
                score(self) > score(other) + 0.03
            }
        }
    }
}

/// Rival models that are parted until the right one is found often enough.
struct Rivals {
    parting: Parting,
    decision: Decision,
}

impl Criterion for Rivals {
    fn worths(&self) -> Vec<f64> {
        self.parting.worths()
    }

    fn take(&mut self, candidate: usize) {
        self.parting.take(candidate);
        self.decision.take(candidate);
    }

    fn satisfied(&mut self) -> bool {
        if self.decision.probability() >= SURE {
            return true;
        }
        // All are far enough apart and still too few draws are decided: further apart, then.
        let comparisons = &mut self.parting.comparisons;
        while !comparisons.is_empty()
            && comparisons
                .iter()
                .all(|c| c.decided() && c.enough < MOST_SEPARATION)
        {
            for comparison in comparisons.iter_mut() {
                comparison.enough = 1.3 * comparison.enough.max(1.0);
            }
        }
        false
    }
}

/// Poses one after the other until they decide often enough, or `most` are chosen.
fn attempt(
    prepared: &Prepared,
    candidates: CandidatePoses,
    competing: &[(Fit, bool)],
    most: usize,
) -> Attempt {
    let regression = &prepared.regression;
    let inputs = candidates.inputs(prepared);
    let axes = axes_of(regression);
    let explanations: Vec<Explanation> = competing
        .iter()
        .map(|(fit, open)| Explanation { fit, open: *open })
        .collect();
    let decision = Decision::new(regression, &explanations, &inputs, &axes, UNDECIDED);
    let mut comparisons = Vec::new();
    for (i, truth) in explanations.iter().enumerate().filter(|(_, e)| e.open) {
        for (j, other) in explanations.iter().enumerate() {
            if decision.differ(i, j) {
                let seen = predictions(&truth.fit.model, &other.fit.model, &inputs, &axes);
                let lead = truth.fit.ln_evidence - other.fit.ln_evidence;
                let known = gram(regression, &other.fit.model);
                comparisons.push(Comparison::new(seen, &known, enough_for(UNDECIDED, lead)));
            }
        }
    }
    let first_enough: Vec<f64> = comparisons.iter().map(|c| c.enough).collect();
    let mut rivals = Rivals {
        parting: Parting::new(comparisons, candidates.poses.len(), REPEATS),
        decision,
    };
    let mut order = choose(&mut rivals, most);
    let Rivals { parting, decision } = rivals;
    let comparisons = parting.comparisons;
    let needed = decision.needed(SURE);
    order.truncate(needed.poses);
    let shares = comparisons.iter().zip(&first_enough);
    let shares = shares.map(|(c, enough)| (c.delta / enough.max(1.0)).min(1.0));
    Attempt {
        separation: shares.sum::<f64>() / comparisons.len().max(1) as f64,
        needed,
        order,
        candidates,
    }
}

/// Gram matrix of a model's columns over the samples.
pub(crate) fn gram(regression: &Regression, model: &crate::model::Model) -> nalgebra::DMatrix<f64> {
    let (_, columns) = regression.rows.extract(model);
    let white = regression.noise.whitened(&regression.rows, &columns);
    white.tr_mul(&white)
}

pub(crate) fn axes_of(regression: &Regression) -> Axes {
    Axes {
        axes: regression.rows.axes.clone(),
        sigma_mm: regression.noise.sigma_mm,
    }
}

/// What would tell a rival from the model, in words.
pub(crate) fn separate_by(rival: &Rival, poses: &[NextPose]) -> String {
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
    match poses.len() {
        1 => format!("measure the proposed pose{with}"),
        many => format!("measure the {many} proposed poses{with}"),
    }
}

fn why(rivals: &[&Rival]) -> String {
    let ids = |terms: &[Term]| -> String {
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

/// The pose of a choice; before a short approach the place where the joints reverse.
pub(crate) fn poses_of(
    choice: &CandidatePose,
    session: &Session,
    candidates: &CandidatePoses,
    why: &str,
) -> Vec<NextPose> {
    let target = &candidates.targets[choice.target as usize];
    let is_new = choice.target as usize >= session.targets.len();
    let samples = &session.samples;
    let shown: Vec<String> = choice
        .q
        .iter()
        .zip(&session.robot.joints)
        .map(|(q, joint)| match joint.kind {
            JointKind::Revolute => format!("{:.1}°", deg_from_rad(*q)),
            JointKind::Prismatic => format!("{q:.1} mm"),
        })
        .collect();
    let speed = samples.speed.iter().any(Option::is_some) || choice.speed.iter().any(|s| *s != 0.0);
    let pose = NextPose {
        q: choice.q.clone(),
        dir: choice.dir.clone(),
        target: (candidates.targets.len() > 1).then(|| target.name.clone()),
        target_mm: is_new.then(|| target.position_mm.coords.into()),
        speed: speed.then(|| choice.speed.clone()),
        load_kg: (samples.load_kg.is_some() || choice.load_kg != 0.0).then_some(choice.load_kg),
        temperature_c: (choice.warmth_c != 0.0)
            .then_some(choice.warmth_c + crate::effects::inputs::REFERENCE_TEMPERATURE_C),
        why: format!("{why}: they differ most at {}", shown.join(", ")),
    };
    let Some(share) = choice.approach else {
        return vec![pose];
    };
    // The joint comes from the other side to a place from which it reverses towards the pose.
    let from = |(j, q): (usize, &f64)| {
        let range = &candidates.ranges[j];
        let back = q - choice.dir[j] * share * (range.to - range.from);
        back.clamp(range.from, range.to)
    };
    let turning = NextPose {
        q: choice.q.iter().enumerate().map(from).collect(),
        dir: choice.dir.iter().map(|d| -d).collect(),
        why: "reverse here, for a short approach to the next pose".to_owned(),
        ..pose.clone()
    };
    vec![turning, pose]
}
