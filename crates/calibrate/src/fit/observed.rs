//! The fit of other measurements than points: starting values, what the measurements do not determine, and their rows.

use nalgebra::DMatrix;

use crate::effects::{FixedMask, PlaceKind, Role, Setting, TOOL_ORIENTATION, Term};
use crate::model::Model;
use crate::observations::figures::{KindFigures, by_kind};
use crate::observations::gauge::Open;
use crate::observations::{KINDS, Layer, Observable, RowBlock, gauge, start};
use crate::sessions::Session;

use super::frames::frames_from;
use super::priors::key;
use super::problem::Problem;
use super::spread::spread;
use crate::answers::identification::NotIdentifiable;
use crate::model::names::coefficient_names;

/// Frames, places and the turn of the tool of a robot with several joints.
pub(super) fn terms(session: &Session, layer: &Layer) -> Vec<Term> {
    let nominal = Model::nominal(session.robot.clone());
    let mut terms = frames(session, layer, &nominal);
    let placed = Model::new(session.robot.clone(), terms.clone());
    terms.extend(start::unknown_places(layer, &placed));
    if layer.shows_attitude() {
        let mut turn = Term::absent(&TOOL_ORIENTATION, 0, 0.0);
        turn.coefficients = start::tool_turn(layer, &placed).to_vec();
        terms.push(turn);
    }
    terms
}

/// The same with effects that the user chose: frames only where the session has setups.
pub(crate) fn extra_terms(session: &Session, layer: &Layer) -> Vec<Term> {
    let nominal = Model::nominal(session.robot.clone());
    let mut terms = Vec::new();
    if session.samples.setups.is_some() || gauge::open(layer).base {
        terms = frames(session, layer, &nominal);
    }
    let placed = Model::new(session.robot.clone(), terms.clone());
    terms.extend(start::unknown_places(layer, &placed));
    terms
}

/// A frame for each setup, or the one of the instrument.
fn frames(session: &Session, layer: &Layer, nominal: &Model) -> Vec<Term> {
    let open = gauge::open(layer).base;
    frames_from(session, |inside| {
        (!open).then(|| start::frame(layer, nominal, inside))?
    })
}

/// The nominal robot, with the places that its measurements refer to taken from a model, and the frames of setups,
/// whose place a session with setups does not state. Without setups no frame is fitted to the nominal robot, and a
/// place that is not known is where it seems to be from there, not from the frame of the model.
pub(crate) fn nominal_of(session: &Session, layer: Option<&Layer>, model: &Model) -> Model {
    let has_setups = session.samples.setups.is_some();
    let of_setup = |term: &Term| has_setups && term.effect.about().setting == Setting::Setup;
    if let Some(layer) = layer.filter(|_| !has_setups) {
        let nominal = Model::nominal(session.robot.clone());
        let places = start::unknown_places(layer, &nominal);
        return Model::new(session.robot.clone(), places);
    }
    model.without(|term| PlaceKind::of(term).is_none() && !of_setup(term))
}

/// Combinations that the kinds of measurement do not determine whatever the poses are; none for plain points.
pub(super) fn open(problem: &Problem) -> Open {
    problem
        .observed
        .as_ref()
        .map(gauge::open)
        .unwrap_or_default()
}

/// Holds a size that no measurement shows by the priors, and reports it.
pub(super) fn hold_size(
    problem: &mut Problem,
    model: &Model,
    not_identifiable: &mut Vec<NotIdentifiable>,
) -> Model {
    let Some(layer) = problem.observed.as_ref().filter(|_| open(problem).size) else {
        return model.clone();
    };
    let model = if model.robot.joints.len() == 1 {
        with_length_held(model)
    } else {
        model.clone()
    };
    let usual = problem.priors.usual(&model, !open(problem).base);
    let size = gauge::size(layer, &model, &usual);
    not_identifiable.push(NotIdentifiable {
        combination: text!("overall size: all lengths of the robot and of the places together"),
        because: match &size {
            Some(size) => text!(
                "directions, touches and sockets show no length: the nominal size is kept (known to about {percent} % from what is usual for links); one known length sets it, a distance between two sockets or a second known station",
                percent = format!("{:.2}", 100.0 * size.sigma)
            ),
            None => text!("directions, touches and sockets show no length: the nominal size is kept; one known length sets it, a distance between two sockets or a second known station"),
        },
    });
    problem.priors.size = size.map_or(Vec::new(), |size| {
        let coefficients = model.columns().map(|(term, k)| key(term, k));
        let weighed = coefficients.zip(size.weights);
        weighed.filter(|own| own.1 != 0.0).collect()
    });
    model
}

/// The model with its frames held where the base is open, and a description of that: the places contain it.
pub(super) fn with_base_held(
    problem: &Problem,
    model: Model,
    not_identifiable: &mut Vec<NotIdentifiable>,
) -> Model {
    if !open(problem).base {
        return model;
    }
    let names = coefficient_names(&model);
    let mut terms = model.terms().to_vec();
    let mut first = 0;
    for term in &mut terms {
        let own = names[first..].iter().take(term.coefficients.len());
        first += term.coefficients.len();
        if term.effect.about().role != Role::FreeFrame {
            continue;
        }
        for (k, name) in own.enumerate() {
            if term.held.contains(k) {
                continue;
            }
            term.coefficients[k] = 0.0;
            term.held = term.held.with(k);
            not_identifiable.push(NotIdentifiable {
                combination: name.clone(),
                because: text!("the base is open: what was measured refers to places that are not known, and does not say where the robot stands; it is held where it is, and the places carry it"),
            });
        }
    }
    Model::new(model.robot.clone(), terms)
}

fn with_length_held(model: &Model) -> Model {
    model.with_each(|_, term| {
        if term.effect.about().role == Role::ToolRadius {
            term.held = FixedMask::default().with(0);
        }
    })
}

/// The size that the priors hold, as a row in addition to the Jacobian in mm.
pub(super) fn add_size(problem: &Problem, model: &Model, reach_mm: f64, rows: &mut DMatrix<f64>) {
    // Where the base is open the rows are those of points, which show lengths.
    if problem.priors.size.is_empty() || open(problem).base {
        return;
    }
    let weight = reach_mm * (rows.nrows() as f64).sqrt();
    let first = rows.nrows();
    let wider = std::mem::replace(rows, DMatrix::zeros(0, 0));
    *rows = wider.insert_row(first, 0.0);
    for (k, own) in problem.priors.size_row(model).into_iter().enumerate() {
        rows[(first, k)] = weight * own;
    }
}

/// The Jacobian of the observations that count, or of about `most` of them. Where the base is open, a column of the
/// robot is only determined up to a motion of the whole: then the targets themselves replace what unknown places
/// measure of them, and the frame the places.
pub(super) fn columns(layer: &Layer, model: &Model, most: usize) -> DMatrix<f64> {
    let open = gauge::open(layer).base;
    let mut kept = vec![false; layer.used.len()];
    for item in spread(&layer.used, most) {
        kept[item] = true;
    }
    let mut all: Vec<Vec<f64>> = vec![Vec::new(); model.coefficient_count()];
    layer.visit(model, true, |block: &mut RowBlock| {
        block.keep(&kept);
        for (lane, item) in block.items.iter().enumerate() {
            let looks = item.map(|item| KINDS[layer.items[item].kind].about().looks);
            if open && looks != Some(Observable::AtAttitude) {
                continue;
            }
            for axis in (0..3).filter(|axis| block.rows[*axis][lane]) {
                for (own, column) in all.iter_mut().zip(&block.columns) {
                    own.push(column[axis][lane]);
                }
            }
        }
    });
    if open {
        layer.visit_points(model, |item, _, columns| {
            if kept[item] {
                for axis in 0..3 {
                    for (own, column) in all.iter_mut().zip(columns) {
                        own.push(column[axis]);
                    }
                }
            }
        });
    }
    let rows = all.first().map_or(0, Vec::len);
    DMatrix::from_fn(rows, all.len(), |row, column| all[column][row])
}

/// Errors by kind, where more than plain points was measured.
pub(super) fn figures(problem: &Problem, before: &Model, after: &Model) -> Vec<KindFigures> {
    let layer = problem.observed.as_ref();
    layer.map_or(Vec::new(), |layer| by_kind(layer, before, after))
}
