//! What belongs to every calibration of a robot with several joints, for identification and
//! diagnosis alike: the measuring frame, the zero offset and the link geometry of every joint, and
//! the tool with its targets. A robot with a single joint keeps its zero offset and link length.
//!
//! # Gauge
//! Some of it the samples cannot tell apart whatever the poses are: where axis 1 runs in the frame
//! of an unknown instrument, the last zero offset and a target on the tool, a zero offset and a turn
//! of the next axis about the same direction. The columns of the Jacobian (mm at the targets per mm
//! or per rad) are gone through in a fixed order of preference,
//!
//! ```text
//! frames · tool · targets · zero offsets 1 … n · tool orientation · link geometry 1 … n
//! ```
//!
//! (where orientation is measured the tool's comes before the zero offsets; places that measurements
//! refer to and that are not known, [`crate::effects::places`], before everything)
//!
//! and where nothing of one is left beside those before it (modified Gram–Schmidt, twice, Björck 1967)
//! the last of those that make it up is held at zero: the last of the kind that has a good part in it, lest a zero
//! offset of 70 mm of lever stand for a shift and become large. So the same robot gives the same values in every session that shows it, and
//! what joint 1 shares with the frame belongs to the frame, what the last joint shares with the
//! tool to the tool, what neighbours share to the first. What is held is said in words. The choice is
//! made at the nominal geometry, where columns are exact copies of one another, and kept while the
//! fit goes on. The weak priors ([`super::priors`]) have no say in it; what the session states of its
//! targets has, as it is a measurement.
//!
//! # The way there
//! An instrument that stands anywhere is brought near by the best rigid motion; frame, tool and
//! zeros are fitted before the links. Where targets miss their places the tool is taken to be turned,
//! and only where that is not enough are their places free. Any other prior that is missed by far is let go.
//!
//! Sources: Mooring, Roth & Driels, *Fundamentals of Manipulator Calibration*, 1991; Meggiolaro &
//! Dubowsky, *An analytical method to eliminate the redundant parameters in robot calibration*, 2000;
//! Khalil & Dombre, *Modeling, Identification and Control of Robots*, ch. 11.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector, Isometry3};

use crate::effects::{
    Effect, Inputs, LinkGeometry, MeasuringFrame, Role, Setting, Term, ToolOrientation,
    ToolPosition, joint_zero, role,
};
use crate::kinematics::{JointKind, Robot};
use crate::model::Model;
use crate::observations::Layer;
use crate::sessions::{Session, Sigma};

use super::estimator::fit_without_outliers;
use super::priors::{Priors, of_one_target};
use super::problem::Problem;
use super::solver::{Solution, Stopped, solve};
use super::{linear, observed};
use crate::answers::identification::NotIdentifiable;
use crate::model::names::coefficient_names;
use crate::model::rigid_motion::best_rigid_motion;

/// A turn or a move beyond this is no error of an alignment: nobody aligned the frame.
const NEVER_ALIGNED_RAD: f64 = 0.1;
const NEVER_ALIGNED_MM: f64 = 100.0;

/// A column of which less than this share is left beside others is a copy of them. Rounded axes
/// (1.5708 for a right angle) leave some 4e-6.
const COPY: f64 = 1e-4;
/// Of what is a copy of one another the last is held, of those of its kind that have so large a part
/// in it, as moves of the tool; and those with so large a part are named.
const GOOD_PART: f64 = 0.3;
const NAMED_PART: f64 = 0.02;
/// A column that moves the samples by less than this is rounding, mm for a step of 1 mm or 1 mrad.
const ROUNDING_MM: f64 = 1e-6;
/// The gauge is found from so many samples at most.
const MOST_SAMPLES: usize = 3000;
/// Noise where nobody says, mm: what a tracker has.
const USUAL_NOISE_MM: f64 = 0.05;
const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;
/// How often priors may be weighed anew and let go.
const MOST_ROUNDS: usize = 8;
/// A variance that changes by no more than this, as a logarithm, has settled.
const SETTLED: f64 = 0.1;

/// Whether the robot has a base model of its own here: several joints.
pub fn is_arm(session: &Session) -> bool {
    session.robot.joints.len() > 1
}

/// Whether an effect belongs to every calibration of this session's robot.
pub fn belongs(id: &str) -> bool {
    role(id).is_of_every_calibration()
}

/// The terms of the base model that are beside the effects of the catalogue: frames, tool, links.
/// `exists` says whether a name may be used at all.
pub fn terms(session: &Session, problem: &Problem, exists: impl Fn(&str) -> bool) -> Vec<Term> {
    let mut terms = Vec::new();
    let of = |effect: &'static dyn Effect| exists(effect.about().id);
    if let Some(layer) = &problem.observed {
        terms.extend(observed::terms(session, layer));
    } else if of(&MeasuringFrame) {
        terms.extend(frames(session, problem));
    }
    if of(&ToolPosition) {
        terms.push(Term::absent(&ToolPosition, 0, 0.0));
        terms.extend(targets(session, problem));
    }
    if of(&LinkGeometry) {
        for (joint, of_joint) in session.robot.joints.iter().enumerate() {
            let mut term = Term::absent(&LinkGeometry, joint, 0.0);
            if of_joint.kind == JointKind::Prismatic {
                // It does not matter where a slide runs, only in which direction.
                term.held = term.held.with(0).with(1);
            }
            terms.push(term);
        }
    }
    terms
}

/// All of it: zero offsets, frames, tool, links.
pub fn start(session: &Session, problem: &Problem, exists: impl Fn(&str) -> bool) -> Model {
    let mut all = Vec::new();
    if exists(joint_zero().about().id) {
        let joints = 0..session.robot.joints.len();
        all.extend(joints.map(|joint| Term::absent(joint_zero(), joint, 0.0)));
    }
    all.extend(terms(session, problem, exists));
    Model::new(session.robot.clone(), all)
}

/// A frame for each setup, or the one of the instrument, from the best rigid motion.
fn frames(session: &Session, problem: &Problem) -> Vec<Term> {
    let nominal = Model::nominal(session.robot.clone()).predict(&problem.inputs);
    frames_from(session, |inside| {
        best_rigid_motion(session, &nominal, |i| problem.used[i] && inside(i))
    })
}

/// A free frame for each setup where the session has setups, started from the best rigid motion.
pub(crate) fn free_frames(session: &Session, problem: &Problem) -> Vec<Term> {
    match &session.samples.setups {
        Some(_) => frames(session, problem),
        None => Vec::new(),
    }
}

/// A frame for each setup, or the one of the instrument; `motion` says where it is from the samples
/// that it is asked for.
pub(super) fn frames_from(
    session: &Session,
    motion: impl Fn(&dyn Fn(usize) -> bool) -> Option<Isometry3<f64>>,
) -> Vec<Term> {
    let setups = session.samples.setups.as_ref();
    let frame = |setup: usize| {
        let mut term = Term::absent(&MeasuringFrame, 0, setup as f64);
        term.label = setups.map(|s| s.names[setup].as_str().into());
        let inside = |i: usize| setups.is_none_or(|s| s.index[i] as usize == setup);
        if let Some(motion) = motion(&inside) {
            let turn = motion.rotation.scaled_axis();
            let shift = motion.translation.vector;
            term.coefficients = [turn.as_slice(), shift.as_slice()].concat();
        }
        term
    };
    (0..setups.map_or(1, |s| s.names.len()))
        .map(frame)
        .collect()
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
        let mut term = Term::absent(&ToolPosition, 0, f64::from(*target) + 1.0);
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
    /// What is held at zero.
    pub held: Vec<NotIdentifiable>,
    /// What else there is to say.
    pub notes: Vec<String>,
}

/// Fits a model with a base model in it: gauge, frame and tool before links, outliers, priors that
/// turn out wrong. The problem keeps the priors and the samples that count. `weak` is whether the
/// weak priors hold.
pub fn fit(problem: &mut Problem, start: &Model, weak: bool) -> Fitted {
    let mut notes = Vec::new();
    problem.priors = priors(problem, start, weak, &mut notes);
    let mut open = Vec::new();
    let sized = observed::hold_size(problem, start, &mut open);
    let start = &sized;
    let (mut model, mut held) = with_gauge(problem, start);
    let mut solution = solve(problem, &links_held(&model));
    solution = fit_without_outliers(problem, &with_held_of(&solution.model, &model));
    for _ in 0..MOST_ROUNDS {
        if solution.stopped == Stopped::Cancelled {
            break;
        }
        let before = problem.priors.variance;
        problem.priors.variance = variance(problem, &solution);
        let settled = (problem.priors.variance / before).ln().abs() < SETTLED;
        let missed = problem.priors.missed(&solution.model);
        if missed.is_empty() && settled {
            break;
        }
        let (of_targets, others): (Vec<_>, Vec<_>) =
            missed.into_iter().partition(|m| of_one_target(&m.0));
        if !of_targets.is_empty() {
            // A tool that is mounted turned moves every target; only then are their places in doubt.
            let start = if is_turned(&model) || !may_turn(problem, start) {
                problem.priors.targets_mm = None;
                notes.push(
                    "the targets do not sit where the session says within targets_sigma_mm: their \
                     places are fitted freely"
                        .to_owned(),
                );
                Cow::Borrowed(start)
            } else {
                let turned = Term::absent(&ToolOrientation, 0, 0.0);
                Cow::Owned(start.with_term(turned))
            };
            // What they share with the tool is another thing now.
            (model, held) = with_gauge(problem, &start);
            solution = solve(problem, &links_held(&model));
            solution.model = with_held_of(&solution.model, &model);
        }
        let names: Vec<String> = others
            .iter()
            .map(|(term, k)| name_of(&start.robot, term, *k))
            .collect();
        if of_targets.is_empty() && !names.is_empty() {
            problem.priors.free(&others);
            notes.push(format!(
                "beyond what is usual by more than four times, and fitted without a prior: {}",
                names.join(", ")
            ));
        }
        solution = fit_without_outliers(problem, &solution.model);
    }
    held.splice(0..0, open);
    Fitted {
        solution,
        held,
        notes,
    }
}

/// What is known beforehand.
fn priors(problem: &Problem, start: &Model, weak: bool, notes: &mut Vec<String>) -> Priors {
    let session = problem.session;
    let mut aligned = session.samples.setups.is_none();
    let frame = |t: &&Term| t.effect.about().setting == Setting::Setup;
    if let Some(frame) = start.terms().iter().find(frame).filter(|_| aligned) {
        let c = &frame.coefficients;
        let turn = (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]).sqrt();
        let shift = (c[3] * c[3] + c[4] * c[4] + c[5] * c[5]).sqrt();
        if turn > NEVER_ALIGNED_RAD || shift > NEVER_ALIGNED_MM {
            aligned = false;
            notes.push(format!(
                "the measuring frame was never aligned with the robot's base (turned by {:.1}°, \
                 moved by {shift:.0} mm): it is fitted freely",
                turn.to_degrees()
            ));
        }
    }
    Priors {
        weak,
        aligned,
        targets_mm: session.instrument.targets_sigma_mm,
        variance: stated_variance(problem).unwrap_or(USUAL_NOISE_MM * USUAL_NOISE_MM),
        ..Priors::default()
    }
}

/// Variance of a coordinate of weight one, where the instrument's maker says.
fn stated_variance(problem: &Problem) -> Option<f64> {
    if let Some(layer) = &problem.observed {
        return Some(layer.unit_mm * layer.unit_mm);
    }
    problem
        .session
        .instrument
        .sigma_mm
        .map(|sigma| match sigma {
            Sigma::Overall(sigma) => sigma * sigma,
            Sigma::PerAxis(_) => 1.0,
        })
}

/// The same as the residuals show it: where something is missing they weigh less beside the priors.
fn variance(problem: &Problem, solution: &Solution) -> f64 {
    let freedom = problem.rows().saturating_sub(solution.spectrum.rank());
    let shown = if freedom > 0 {
        solution.cost.max(0.0) / freedom as f64
    } else {
        0.0
    };
    // With the noise known, rows are in units of it.
    let least = match stated_variance(problem) {
        Some(stated) if problem.noise.is_none() => stated,
        _ => 1e-12,
    };
    shown.max(least)
}

/// Whether a model has the tool's orientation in it.
fn is_turned(model: &Model) -> bool {
    let id = ToolOrientation.about().id;
    model.terms().iter().any(|t| t.effect.about().id == id)
}

/// Whether targets of known arrangement could show the tool's orientation.
fn may_turn(problem: &Problem, start: &Model) -> bool {
    let targets = start.terms().iter().filter(|t| of_one_target(t)).count();
    targets >= 3 && problem.priors.targets_mm.is_some()
}

/// The model with its links where they are.
fn links_held(model: &Model) -> Model {
    model.with_each(|_, term| {
        if term.effect.about().id == LinkGeometry.about().id {
            for k in 0..term.coefficients.len() {
                term.held = term.held.with(k);
            }
        }
    })
}

/// The values of one model with what is held in another of the same terms.
fn with_held_of(values: &Model, held: &Model) -> Model {
    values.with_each(|index, term| term.held = held.terms()[index].held)
}

fn name_of(robot: &Robot, term: &Term, coefficient: usize) -> String {
    let alone = Model::new(robot.clone(), vec![term.clone()]);
    let names = coefficient_names(&alone);
    names.into_iter().nth(coefficient).unwrap_or_default()
}

/// The model with everything held that the samples cannot show, whatever was held in it before.
pub(crate) fn gauged(problem: &Problem, start: &Model) -> Model {
    with_gauge(problem, start).0
}

/// The model with everything held at zero that the samples cannot tell from what comes before it,
/// and that in words. Links that are held altogether are left out.
fn with_gauge(problem: &Problem, start: &Model) -> (Model, Vec<NotIdentifiable>) {
    let names = coefficient_names(start);
    let places = in_order(problem, start);
    let mut rows = columns(problem, start);
    add_targets(problem, start, &mut rows);
    let reach_mm = reach_mm(&start.robot);
    observed::add_size(problem, start, reach_mm, &mut rows);
    let size = |place: &Place| if place.turns { reach_mm } else { 1.0 };
    let mut basis = Basis::new(rows.nrows());
    let mut terms = start.terms().to_vec();
    let mut held = Vec::new();
    let open = observed::open(problem).base;
    for (rank, place) in places.iter().enumerate() {
        if open && place.class == Class::Place {
            // They carry the base, and the frame stands for them here.
            continue;
        }
        let column = rows.column(place.column).into_owned();
        let own = column.norm();
        let unit = if place.turns { 1e-3 } else { 1.0 };
        let seen = own * unit / (rows.nrows() as f64).sqrt() > ROUNDING_MM;
        let free = basis.reject(&column);
        if seen && free.norm() > COPY * own {
            basis.push(rank, &column, &free);
            continue;
        }
        // What makes up the column, and the column itself.
        let mut parts = if seen {
            basis.parts(&column)
        } else {
            Vec::new()
        };
        parts.push((rank, 1.0));
        for (of, part) in &mut parts {
            *part = part.abs() * size(&places[*of]);
        }
        let largest = parts.iter().map(|p| p.1).fold(0.0, f64::max);
        // The last of its kind that has a good part in it: to hold another would make numbers large.
        let of_kind = |p: &&(usize, f64)| places[p.0].class == place.class;
        let most = parts.iter().filter(of_kind).map(|p| p.1);
        let enough = GOOD_PART * most.fold(0.0, f64::max);
        let mut fit_to_hold = parts.iter().filter(of_kind).filter(|p| p.1 >= enough);
        let last = fit_to_hold.next_back().map_or(rank, |p| p.0);
        if last != rank {
            basis.exchange(last, rank, &column, |k| {
                rows.column(places[k].column).into_owned()
            });
        }
        parts.retain(|p| p.0 != last && p.1 > NAMED_PART * largest);
        parts.sort_by(|a, b| b.1.total_cmp(&a.1));
        let others: Vec<&str> = parts
            .iter()
            .map(|p| names[places[p.0].column].as_str())
            .collect();
        let place = &places[last];
        terms[place.term].held = terms[place.term].held.with(place.coefficient);
        terms[place.term].coefficients[place.coefficient] = 0.0;
        let own = names[place.column].as_str();
        held.push(NotIdentifiable {
            combination: [&[own], &others[..]].concat().join(" with "),
            because: if others.is_empty() {
                "the samples do not depend on it: it is held at zero".to_owned()
            } else {
                format!(
                    "the samples show only their sum: {own} is held at zero, the others carry it"
                )
            },
        });
    }
    let mut of_base = Vec::new();
    let based = Model::new(start.robot.clone(), terms);
    let mut terms = observed::with_base_held(problem, based, &mut of_base)
        .terms()
        .to_vec();
    held.splice(0..0, of_base);
    terms.retain(|term| {
        let about = term.effect.about();
        let all_held = (0..term.coefficients.len()).all(|k| term.held.contains(k));
        !(all_held && about.id == LinkGeometry.about().id)
    });
    (Model::new(start.robot.clone(), terms), held)
}

/// How far the tool is from the farthest axis at home: what a turn of 1 rad may do, mm.
pub(crate) fn reach_mm(robot: &Robot) -> f64 {
    let tool = robot.base_from_tool.translation.vector;
    let axes = robot.joints.iter();
    let far = axes.map(|joint| (tool - joint.axis.point_mm.coords).norm());
    far.fold(100.0, f64::max)
}

/// In this order columns are preferred.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    Place,
    Frame,
    Tool,
    Target,
    ToolTurn,
    Zero,
    Turn,
    Link,
}

/// One coefficient of the base model.
struct Place {
    class: Class,
    term: usize,
    coefficient: usize,
    column: usize,
    /// Whether it is an angle.
    turns: bool,
}

/// The coefficients of the base model that are not held, in the order of preference.
fn in_order(problem: &Problem, model: &Model) -> Vec<Place> {
    // Where orientation is measured, what the last joint shares with the tool belongs to the tool.
    let attitude = problem.observed.as_ref().is_some_and(Layer::shows_attitude);
    let mut all = Vec::new();
    let mut first = 0;
    for (index, term) in model.terms().iter().enumerate() {
        let about = term.effect.about();
        let class = match about.role {
            Role::Place => Some(Class::Place),
            Role::FreeFrame => Some(Class::Frame),
            Role::ToolPlace if term.setting == 0.0 => Some(Class::Tool),
            Role::ToolPlace => Some(Class::Target),
            Role::JointZero => Some(Class::Zero),
            Role::ToolTurn if attitude => Some(Class::ToolTurn),
            Role::ToolTurn => Some(Class::Turn),
            Role::JointAxis => Some(Class::Link),
            Role::ToolRadius | Role::Candidate | Role::Unexplained => None,
        };
        for coefficient in 0..term.coefficients.len() {
            let kind = model.robot.joints[term.joint].kind;
            let turns = about.form.turns(coefficient, kind);
            if let Some(class) = class.filter(|_| !term.held.contains(coefficient)) {
                all.push(Place {
                    class,
                    term: index,
                    coefficient,
                    column: first + coefficient,
                    turns,
                });
            }
        }
        first += term.coefficients.len();
    }
    // Terms stand in the order of joints, setups and targets already.
    all.sort_by_key(|place| place.class);
    all
}

/// The Jacobian on the samples that count, or on enough of them, mm; three rows a sample, those of
/// an axis that was not measured zero.
fn columns(problem: &Problem, model: &Model) -> DMatrix<f64> {
    if let Some(layer) = &problem.observed {
        return observed::columns(layer, model, MOST_SAMPLES);
    }
    let chosen = spread(&problem.used, MOST_SAMPLES);
    let inputs: Inputs = problem.inputs.select(&chosen);
    let largest = problem.axis_weights.iter().copied().fold(0.0, f64::max);
    let mut rows = DMatrix::zeros(3 * chosen.len(), model.coefficient_count());
    model.visit(&inputs, true, |start, block| {
        for (k, column) in block.columns.iter().enumerate() {
            for (axis, lanes) in column.iter().enumerate() {
                let weight = (problem.axis_weights[axis] / largest).sqrt();
                for i in 0..block.len {
                    rows[(3 * (start + i) + axis, k)] = weight * lanes[i];
                }
            }
        }
    });
    rows
}

/// At most so many of those that count, in order: a step of the golden ratio inside each stretch, so
/// that no rhythm of the poses is hit.
pub(super) fn spread(used: &[bool], most: usize) -> Vec<usize> {
    let used: Vec<usize> = (0..used.len()).filter(|i| used[*i]).collect();
    if used.len() <= most {
        return used;
    }
    let stretch = used.len() as f64 / most as f64;
    let at = |k: usize| ((k as f64 + (k as f64 * GOLDEN_RATIO).fract()) * stretch).floor();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place among the samples"
    )]
    let index = |k: usize| (at(k) as usize).min(used.len() - 1);
    (0..most).map(|k| used[index(k)]).collect()
}

/// What the session states of its targets' places, as rows of their own.
fn add_targets(problem: &Problem, model: &Model, rows: &mut DMatrix<f64>) {
    let Some(sigma) = problem.priors.targets_mm else {
        return;
    };
    let noise = match problem.session.instrument.sigma_mm {
        _ if problem.observed.is_some() => stated_variance(problem).map_or(1.0, f64::sqrt),
        Some(Sigma::Overall(noise)) => noise,
        Some(Sigma::PerAxis(noise)) => noise.into_iter().fold(f64::INFINITY, f64::min),
        None => USUAL_NOISE_MM,
    };
    let own: Vec<usize> = in_order(problem, model)
        .iter()
        .filter(|place| place.class == Class::Target)
        .map(|place| place.column)
        .collect();
    let first = rows.nrows();
    let wider = std::mem::replace(rows, DMatrix::zeros(0, 0));
    *rows = wider.insert_rows(first, own.len(), 0.0);
    for (row, column) in own.into_iter().enumerate() {
        rows[(first + row, column)] = noise / sigma;
    }
}

/// Orthonormal columns, added one by one.
struct Basis {
    rows: usize,
    q: Vec<DVector<f64>>,
    /// For each: which it is, and its parts along those before it and itself.
    kept: Vec<(usize, Vec<f64>)>,
}

impl Basis {
    fn new(rows: usize) -> Self {
        Self {
            rows,
            q: Vec::new(),
            kept: Vec::new(),
        }
    }

    /// What is left of a column.
    fn reject(&self, column: &DVector<f64>) -> DVector<f64> {
        let mut left = column.clone();
        if self.q.len() >= self.rows {
            left.fill(0.0);
        }
        let mut part = [0.0];
        for _ in 0..2 {
            for q in &self.q {
                linear::reject(q.as_slice(), left.as_mut_slice(), &mut part);
            }
        }
        left
    }

    fn push(&mut self, index: usize, column: &DVector<f64>, free: &DVector<f64>) {
        let q = free / free.norm();
        let mut along = self.along(column);
        along.push(linear::dot(q.as_slice(), column.as_slice()));
        self.q.push(q);
        self.kept.push((index, along));
    }

    fn along(&self, column: &DVector<f64>) -> Vec<f64> {
        let one = |q: &DVector<f64>| linear::dot(q.as_slice(), column.as_slice());
        self.q.iter().map(one).collect()
    }

    /// How much of each kept column a dependent one is made of.
    fn parts(&self, column: &DVector<f64>) -> Vec<(usize, f64)> {
        let mut parts = self.along(column);
        for k in (0..parts.len()).rev() {
            let (earlier, along) = self.kept[k].1.split_at(k);
            parts[k] /= along[0];
            let value = parts[k];
            for (part, r) in parts.iter_mut().zip(earlier) {
                *part -= r * value;
            }
        }
        let kept = self.kept.iter().map(|k| k.0);
        kept.zip(parts).collect()
    }

    /// Takes a column in the place of another that was kept.
    fn exchange(
        &mut self,
        out: usize,
        new: usize,
        column: &DVector<f64>,
        of: impl Fn(usize) -> DVector<f64>,
    ) {
        // What comes before it stays as it is.
        let at = self.kept.iter().position(|k| k.0 == out);
        let at = at.unwrap_or(self.kept.len());
        let behind = self.kept.iter().skip(at + 1);
        let mut all: Vec<(usize, DVector<f64>)> = behind.map(|k| (k.0, of(k.0))).collect();
        all.push((new, column.clone()));
        self.q.truncate(at);
        self.kept.truncate(at);
        for (index, column) in all {
            let free = self.reject(&column);
            self.push(index, &column, &free);
        }
    }
}
