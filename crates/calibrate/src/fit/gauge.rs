//! The gauge of the base model: combinations of coefficients that are not identifiable, and which of them are held.
//!
//! Some combinations are not identifiable whatever the poses are: where axis 1 runs in the frame of an unknown
//! instrument, the last zero offset and a target on the tool, a zero offset and a turn of the next axis about the same
//! direction. The columns of the Jacobian (mm at the targets per mm or per rad) are visited in a fixed order of
//! preference,
//!
//! ```text
//! frames · tool · targets · zero offsets 1 … n · tool orientation · link geometry 1 … n
//! ```
//!
//! (where orientation is measured the tool's comes before the zero offsets; places that measurements
//! refer to and that are not known, [`crate::effects::places`], before everything)
//!
//! and where a column is linearly dependent on those before it (modified Gram–Schmidt, twice, Björck 1967) the last of
//! those in the combination is held at zero: the last of the kind that has a good part in it, lest a zero offset of 70
//! mm of lever replace a shift and become large. So the same robot gives the same values in every session that
//! determines them, and what joint 1 shares with the frame is attributed to the frame, what the last joint shares with
//! the tool to the tool, what neighbours share to the first. What is held is reported. The choice is made at the
//! nominal geometry, where columns are exact copies of one another, and kept while the fit goes on. The weak priors
//! ([`super::priors`]) do not affect it; what the session states of its targets does, as it is a measurement.
//!
//! Source: Meggiolaro & Dubowsky, *An analytical method to eliminate the redundant parameters in
//! robot calibration*, 2000.

use nalgebra::DMatrix;

use crate::answers::identification::NotIdentifiable;
use crate::effects::{Inputs, LINK_GEOMETRY, Role};
use crate::linear::Kept;
use crate::model::Model;
use crate::model::names::{coefficient_names, together};
use crate::observations::Layer;
use crate::sessions::Sigma;
use crate::text::Text;
use crate::{budget, rounding};

use super::observed;
use super::problem::Problem;
use super::spread::spread;
use super::usual_noise::{USUAL_NOISE_MM, stated_variance};

/// A column whose projection orthogonal to others is less than this share of it is a copy of them. Rounded axes
/// (1.5708 for a right angle) give some 4e-6.
pub(crate) const COPY: f64 = 1e-4;
/// What is stated makes a column no copy by this share; of a combination that is not determined the projection of its
/// held coefficient's column is at most as large.
pub(crate) const MOST_SEEN: f64 = 10.0 * COPY;
/// Of a combination the last coefficient is held, of those of its kind that have so large a part in it, as moves of
/// the tool; and those with so large a part are named.
const GOOD_PART: f64 = 0.3;
pub(super) const NAMED_PART: f64 = 0.02;

/// The model with everything held that the samples cannot show, whatever was held in it before.
pub(crate) fn gauged(problem: &Problem, start: &Model) -> Model {
    with_gauge(problem, start).0
}

/// The model with everything held at zero that is linearly dependent on what comes before it, and a description of
/// that. Links that are held altogether are left out.
pub(super) fn with_gauge(problem: &Problem, start: &Model) -> (Model, Vec<NotIdentifiable>) {
    let names = coefficient_names(start);
    let places = in_order(problem, start);
    let mut rows = columns(problem, start);
    add_targets(problem, start, &mut rows);
    let reach_mm = start.robot.longest_lever_mm();
    observed::add_size(problem, start, reach_mm, &mut rows);
    let size = |place: &Place| if place.turns { reach_mm } else { 1.0 };
    let mut basis = Kept::new(rows.nrows());
    let mut terms = start.terms().to_vec();
    let mut held = Vec::new();
    let open = observed::open(problem).base;
    for (rank, place) in places.iter().enumerate() {
        if open && place.class == Class::Place {
            // They contain the base, and the frame replaces them here.
            continue;
        }
        let column = rows.column(place.column).into_owned();
        let own = column.norm();
        let unit = if place.turns { 1e-3 } else { 1.0 };
        let seen = own * unit / (rows.nrows() as f64).sqrt() > rounding::WRITTEN;
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
        let others: Vec<&Text> = parts.iter().map(|p| &names[places[p.0].column]).collect();
        let place = &places[last];
        terms[place.term].held = terms[place.term].held.with(place.coefficient);
        // At zero an instrument at an unknown place would be wrong by all of its distance.
        let stays = place.class == Class::Frame;
        if !stays {
            terms[place.term].coefficients[place.coefficient] = 0.0;
        }
        let own = &names[place.column];
        held.push(NotIdentifiable {
            combination: together([&[own], &others[..]].concat().into_iter().cloned()),
            because: match (others.is_empty(), stays) {
                (true, true) => text!("the samples do not depend on it: it stays where it began"),
                (true, false) => text!("the samples do not depend on it: it is held at zero"),
                (false, true) => text!(
                    "only the combination is observable: {own} stays where it began, the others carry it",
                    own
                ),
                (false, false) => text!(
                    "only the combination is observable: {own} is held at zero, the others carry it",
                    own
                ),
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
        !(all_held && about.id == LINK_GEOMETRY.about().id)
    });
    (Model::new(start.robot.clone(), terms), held)
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
    // Terms are in the order of joints, setups and targets already.
    all.sort_by_key(|place| place.class);
    all
}

/// The Jacobian on the samples that count, or on enough of them, mm; three rows a sample, those of
/// an axis that was not measured zero.
pub(super) fn columns(problem: &Problem, model: &Model) -> DMatrix<f64> {
    if let Some(layer) = &problem.observed {
        return observed::columns(layer, model, budget::SAMPLES);
    }
    let chosen = spread(&problem.used, budget::SAMPLES);
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

/// The stated places of the targets, as separate rows.
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
        .filter(|place| {
            let term = &model.terms()[place.term];
            problem.priors.holds(term, place.coefficient)
        })
        .map(|place| place.column)
        .collect();
    let first = rows.nrows();
    let wider = std::mem::replace(rows, DMatrix::zeros(0, 0));
    *rows = wider.insert_rows(first, own.len(), 0.0);
    // However little is stated, it separates what the targets share from what each has on its own.
    let least = MOST_SEEN * (first as f64).sqrt();
    for (row, column) in own.into_iter().enumerate() {
        rows[(first + row, column)] = (noise / sigma).max(least);
    }
}
