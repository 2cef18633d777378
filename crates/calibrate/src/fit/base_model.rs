//! The base model of a robot with several joints, which every calibration contains, for identification and
//! diagnosis alike: the measuring frame, the zero offset and the link geometry of every joint, and
//! the tool with its targets. A robot with a single joint has its zero offset and link length.
//!
//! Combinations that are not identifiable are fixed by the gauge (`gauge.rs`).
//!
//! # Starting values
//! An instrument at an unknown place is first aligned by the best rigid motion; frame, tool and zeros are fitted
//! before the links. Where targets miss their stated places the tool is taken to be turned, and only where that is not
//! enough are their places free. Any other prior that is missed by many σ is dropped.
//!
//! Sources: Mooring, Roth & Driels, *Fundamentals of Manipulator Calibration*, 1991; Meggiolaro &
//! Dubowsky, *An analytical method to eliminate the redundant parameters in robot calibration*, 2000;
//! Khalil & Dombre, *Modeling, Identification and Control of Robots*, ch. 11.

use std::borrow::Cow;

use crate::effects::{
    Effect, LINK_GEOMETRY, MEASURING_FRAME, OF_A_SINGLE_AXIS, Setting, Survey, TOOL_ORIENTATION,
    TOOL_POSITION, Term, find, joint_zero, role,
};
use crate::kinematics::{JointKind, Robot};
use crate::model::Model;
use crate::sessions::{Session, Target};
use crate::text::{Text, angle, length};
use crate::{budget, fewest};

use super::estimator::fit_without_outliers;
use super::frames::frames_from;
use super::gauge::with_gauge;
use super::observed;
use super::prior_scale::{self, Widths};
use super::priors::{Priors, of_one_target};
use super::problem::Problem;
use super::solver::{Solution, Stopped, equations_at, solve};
use super::target_places::{
    Agreement, SeenTarget, across_mm, agreement, last_axis, seen_targets, sigma_between,
};
use super::usual_noise::{USUAL_NOISE_MM, stated_variance};
use crate::answers::identification::NotIdentifiable;
use crate::model::names::coefficient_names;
use crate::model::rigid_motion::best_rigid_motion;

/// A turn or a move beyond this is no error of an alignment: the frame was never aligned.
const NEVER_ALIGNED_RAD: f64 = 0.1;
const NEVER_ALIGNED_MM: f64 = 100.0;

/// Whether the robot has a base model of its own here: several joints.
pub(crate) fn is_arm(session: &Session) -> bool {
    session.robot.joints.len() > 1
}

/// Whether an effect belongs to every calibration of this session's robot.
pub(crate) fn belongs(id: &str) -> bool {
    role(id).is_of_every_calibration()
}

/// The terms of the base model besides the effects of the catalogue: frames, tool, links. `exists` states whether a
/// name may be used at all.
pub(crate) fn terms(
    session: &Session,
    problem: &Problem,
    exists: impl Fn(&str) -> bool,
) -> Vec<Term> {
    let mut terms = Vec::new();
    let of = |effect: &'static Effect| exists(effect.about().id);
    if let Some(layer) = &problem.observed {
        terms.extend(observed::terms(session, layer));
    } else if of(&MEASURING_FRAME) {
        terms.extend(frames(session, problem));
    }
    if of(&TOOL_POSITION) {
        terms.push(Term::absent(&TOOL_POSITION, 0, 0.0));
        terms.extend(targets(session, problem));
    }
    if of(&LINK_GEOMETRY) {
        for (joint, of_joint) in session.robot.joints.iter().enumerate() {
            let mut term = Term::absent(&LINK_GEOMETRY, joint, 0.0);
            if of_joint.kind == JointKind::Prismatic {
                // It does not matter where a slide runs, only in which direction.
                term.held = term.held.with(0).with(1);
            }
            terms.push(term);
        }
    }
    terms
}

/// All of it: zero offsets, frames, tool, links; of a single joint its zero offset and link length where they can be
/// tested, and its `extra_terms`.
pub fn start(session: &Session, problem: &Problem, exists: impl Fn(&str) -> bool) -> Model {
    let mut all = Vec::new();
    if is_arm(session) {
        if exists(joint_zero().about().id) {
            let joints = 0..session.robot.joints.len();
            all.extend(joints.map(|joint| Term::absent(joint_zero(), joint, 0.0)));
        }
        all.extend(terms(session, problem, exists));
    } else {
        all.extend(of_a_single_joint(session, problem, exists));
        all.extend(extra_terms(session, problem));
    }
    Model::new(session.robot.clone(), all)
}

/// Zero offset and link length of the only joint, where the samples can show them.
pub(crate) fn of_a_single_joint(
    session: &Session,
    problem: &Problem,
    exists: impl Fn(&str) -> bool,
) -> Vec<Term> {
    let survey = Survey::new(session, &problem.inputs);
    let all = OF_A_SINGLE_AXIS.into_iter().filter(|id| exists(id));
    let testable = all
        .filter_map(find)
        .filter(|effect| effect.obstacle(&survey, 0).is_none());
    testable
        .map(|effect| Term::absent(effect, 0, 0.0))
        .collect()
}

/// The terms that are fitted in addition to the parameters of a single joint, or to names alone: unknown places of
/// what was measured, or a frame for each setup.
pub(crate) fn extra_terms(session: &Session, problem: &Problem) -> Vec<Term> {
    match &problem.observed {
        Some(layer) => observed::extra_terms(session, layer),
        None => free_frames(session, problem),
    }
}

/// A frame for each setup, or the one of the instrument, from the best rigid motion.
fn frames(session: &Session, problem: &Problem) -> Vec<Term> {
    let nominal = Model::nominal(session.robot.clone()).predict(&problem.inputs);
    frames_from(session, |inside| {
        best_rigid_motion(session, &nominal, |i| problem.used[i] && inside(i))
    })
}

/// A free frame for each setup where the session has setups, started from the best rigid motion.
fn free_frames(session: &Session, problem: &Problem) -> Vec<Term> {
    match &session.samples.setups {
        Some(_) => frames(session, problem),
        None => Vec::new(),
    }
}

/// The nominal robot, in each setup where the best rigid motion puts it: a session with setups does not state where
/// its instrument was, and that is no error of the robot.
pub fn nominal(robot: &Robot, session: &Session, problem: &Problem) -> Model {
    Model::new(robot.clone(), free_frames(session, problem))
}

/// Each target's own part, where the session shows several.
fn targets(session: &Session, problem: &Problem) -> Vec<Term> {
    let Some(column) = problem.inputs.target.as_deref() else {
        return Vec::new();
    };
    let mut seen: Vec<u32> = (0..column.len())
        .filter(|i| problem.fit[*i])
        .map(|i| column[i])
        .collect();
    seen.sort_unstable();
    seen.dedup();
    if seen.len() < 2 {
        return Vec::new();
    }
    let own = |target: &u32| {
        let mut term = Term::absent(&TOOL_POSITION, 0, f64::from(*target) + 1.0);
        let of_session = session.targets.get(*target as usize);
        term.label = of_session.map(|t| t.name.as_str().into());
        term
    };
    seen.iter().map(own).collect()
}

/// A fit of the base model and whatever else a model holds.
pub struct Fitted {
    /// The solution.
    pub solution: Solution,
    /// The parameters that are held at zero.
    pub held: Vec<NotIdentifiable>,
    /// Other notes.
    pub notes: Vec<Text>,
}

/// Fits a model with a base model in it: gauge, frame and tool before links, outliers, priors that
/// turn out wrong. The problem keeps the priors and the samples that count. `weak` is whether the
/// weak priors hold. Nothing is known beforehand of a single joint whose points were measured.
pub fn fit(problem: &mut Problem, start: &Model, weak: bool) -> Fitted {
    let mut notes = Vec::new();
    if !is_arm(problem.session) && problem.observed.is_none() {
        return Fitted {
            solution: fit_without_outliers(problem, start),
            held: Vec::new(),
            notes,
        };
    }
    problem.priors = priors(problem, start, weak, &mut notes);
    let mut open = Vec::new();
    let sized = observed::hold_size(problem, start, &mut open);
    let start = &sized;
    let (mut model, mut held) = with_gauge(problem, start);
    let mut solution = solve(problem, &links_held(&model));
    solution = fit_without_outliers(problem, &with_held_of(&solution.model, &model));
    for _ in 0..budget::ROUNDS {
        if solution.stopped == Stopped::Cancelled {
            break;
        }
        let before = problem.priors.variance;
        let width = problem.priors.ln_scale;
        let widths = likeliest_widths(problem, &solution);
        problem.priors.variance = match widths {
            Some(widths) => widths.variance.max(least_variance(problem)),
            None => variance(problem, &solution),
        };
        problem.priors.ln_scale = widths.map_or(width, |widths| widths.ln_scale);
        let settled = (problem.priors.variance / before).ln().abs() < budget::SETTLED
            && problem.priors.ln_scale == width;
        let missed = problem.priors.missed(&solution.model);
        if missed.is_empty() && settled {
            break;
        }
        let (of_targets, others): (Vec<_>, Vec<_>) =
            missed.into_iter().partition(|m| of_one_target(&m.0));
        if !of_targets.is_empty() {
            // A tool that is mounted turned moves every target; only then their places are doubtful.
            let start = if is_turned(&model) || !may_turn(problem, start) {
                notes.push(doubt_targets(problem, start));
                Cow::Borrowed(start)
            } else {
                let turned = Term::absent(&TOOL_ORIENTATION, 0, 0.0);
                Cow::Owned(start.with_term(turned))
            };
            // What they share with the tool is another thing now.
            (model, held) = with_gauge(problem, &start);
            solution = solve(problem, &links_held(&model));
            solution.model = with_held_of(&solution.model, &model);
        }
        let names: Vec<Text> = others
            .iter()
            .map(|(term, k)| name_of(&start.robot, term, *k))
            .collect();
        if of_targets.is_empty() && !names.is_empty() {
            problem.priors.free(&others);
            notes.push(text!(
                "beyond what is usual by more than four times, and fitted without a prior: {names}",
                names = Text::listed(names, ", ")
            ));
        }
        solution = fit_without_outliers(problem, &solution.model);
    }
    // The likeliest variance is one of a few that were tried; a plan and an expected error need it finer.
    if problem.priors.weak {
        problem.priors.variance = variance(problem, &solution);
    }
    held.splice(0..0, open);
    Fitted {
        solution,
        held,
        notes,
    }
}

/// The widths of the weak priors of this robot, at a solution; `None` without weak priors.
fn likeliest_widths(problem: &Problem, solution: &Solution) -> Option<Widths> {
    let weak = problem.priors.weak;
    weak.then(|| equations_at(problem, solution))
        .and_then(|normal| {
            let rows = problem.rows();
            prior_scale::likeliest(&problem.priors, &solution.model, &normal, rows)
        })
}

/// Fits a model once more with the weak priors of this robot's own width and everything that the model contains, with
/// known noise.
pub(crate) fn with_own_widths(problem: &mut Problem, mut solution: Solution) -> Solution {
    for _ in 0..budget::ROUNDS {
        match likeliest_widths(problem, &solution) {
            Some(widths) if widths.ln_scale != problem.priors.ln_scale => {
                problem.priors.ln_scale = widths.ln_scale;
                solution = solve(problem, &solution.model);
            }
            _ => break,
        }
    }
    solution
}

/// Frees the targets that are not where the session states them. Where these cannot be determined, all get the
/// uncertainty by which they disagree: were they free, the one that the gauge fixes would determine the tool.
fn doubt_targets(problem: &mut Problem, start: &Model) -> Text {
    let Some(stated) = problem.priors.targets_mm.take() else {
        return Text::default();
    };
    let (model, _) = with_gauge(problem, start);
    let near = solve(problem, &links_held(&model)).model;
    let free = fit_without_outliers(problem, &with_held_of(&near, &model)).model;
    let session = problem.session;
    let holds = |target: usize| problem.priors.holds_target(target);
    let seen = seen_targets(problem, &free, stated, |target| {
        holds(target).then_some(target)
    });
    let (numbers, seen): (Vec<usize>, Vec<SeenTarget>) = seen.into_iter().unzip();
    let place = |(k, target): (usize, &Target)| holds(k).then_some(target.position_mm.coords);
    let places: Vec<_> = session.targets.iter().enumerate().map(place).collect();
    problem.priors.targets_mm = Some(stated);
    let off: Vec<usize> = match agreement(&seen, &places, last_axis(&session.robot)) {
        Agreement::Settled { at, .. } => {
            let own = numbers.iter().zip(at);
            own.filter(|(own, at)| Some(**own) != *at)
                .map(|o| *o.0)
                .collect()
        }
        Agreement::Open { .. } => Vec::new(),
    };
    if off.is_empty() {
        let wide = sigma_between(across_mm(&seen, &places), seen.len());
        problem.priors.targets_mm = Some(wide.max(2.0 * stated));
        return text!(
            "the targets do not sit where the session says, within their stated uncertainty: their places are fitted freely"
        );
    }
    let names = off.iter().map(|target| {
        problem.priors.free_target(*target);
        Text::verbatim(session.targets[*target].name.clone())
    });
    let names: Vec<Text> = names.collect();
    text!(
        "not where the session says, and their places fitted freely: {targets}",
        targets = Text::listed(&names, ", ")
    )
}

/// The priors.
fn priors(problem: &Problem, start: &Model, weak: bool, notes: &mut Vec<Text>) -> Priors {
    let session = problem.session;
    let mut aligned = session.samples.setups.is_none();
    let frame = |t: &&Term| t.effect.about().setting == Setting::Setup;
    if let Some(frame) = start.terms().iter().find(frame).filter(|_| aligned) {
        let c = &frame.coefficients;
        let turn = (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]).sqrt();
        let shift = (c[3] * c[3] + c[4] * c[4] + c[5] * c[5]).sqrt();
        if turn > NEVER_ALIGNED_RAD || shift > NEVER_ALIGNED_MM {
            aligned = false;
            notes.push(text!(
                "the measuring frame was never aligned with the robot's base (turned by {turn}, moved by {shift}): it is fitted freely",
                turn = angle(turn, 1),
                shift = length(shift, 0)
            ));
        }
    }
    let mut priors = Priors {
        weak,
        aligned,
        targets_mm: session.instrument.targets_sigma_mm,
        variance: stated_variance(problem).unwrap_or(USUAL_NOISE_MM * USUAL_NOISE_MM),
        ..Priors::default()
    };
    if priors.targets_mm.is_some() {
        let free = (0..session.targets.len()).filter(|target| !session.has_placed(*target));
        free.for_each(|target| priors.free_target(target));
    }
    priors
}

/// The same from the residuals: where something is missing, rows weigh less compared with the priors. Where all rows
/// are followed exactly there is no residual: the priors choose among the exact solutions then.
fn variance(problem: &Problem, solution: &Solution) -> f64 {
    let rows = problem.rows() + problem.priors.of_its_own(&solution.model);
    let freedom = rows.saturating_sub(solution.spectrum.rank());
    let shown = if freedom > 0 {
        solution.cost.max(0.0) / freedom as f64
    } else {
        0.0
    };
    shown.max(least_variance(problem))
}

/// With the noise known, rows are in units of it.
fn least_variance(problem: &Problem) -> f64 {
    match stated_variance(problem) {
        Some(stated) if problem.noise.is_none() => stated,
        _ => 1e-12,
    }
}

/// Whether a model has the tool's orientation in it.
fn is_turned(model: &Model) -> bool {
    let id = TOOL_ORIENTATION.about().id;
    model.terms().iter().any(|t| t.effect.about().id == id)
}

/// Whether targets of known arrangement could show the tool's orientation.
fn may_turn(problem: &Problem, start: &Model) -> bool {
    let placed = |t: &&Term| of_one_target(t) && problem.priors.holds(t, 0);
    let targets = start.terms().iter().filter(placed).count();
    targets >= fewest::OF_A_BODY && problem.priors.targets_mm.is_some()
}

/// The model with its links where they are.
fn links_held(model: &Model) -> Model {
    model.with_each(|_, term| {
        if term.effect.about().id == LINK_GEOMETRY.about().id {
            for k in 0..term.coefficients.len() {
                term.held = term.held.with(k);
            }
        }
    })
}

/// The values of one model with those that are held in another of the same terms.
fn with_held_of(values: &Model, held: &Model) -> Model {
    values.with_each(|index, term| term.held = held.terms()[index].held)
}

fn name_of(robot: &Robot, term: &Term, coefficient: usize) -> Text {
    let alone = Model::new(robot.clone(), vec![term.clone()]);
    let names = coefficient_names(&alone);
    names.into_iter().nth(coefficient).unwrap_or_default()
}
