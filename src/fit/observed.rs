//! What the fit of other measurements than points needs beside that of points: where it begins, what
//! the measurements leave open, and their rows.

use nalgebra::DMatrix;

use crate::effects::{Effect, Held, MeasuringFrame, Term, ToolOrientation};
use crate::model::Model;
use crate::observations::figures::{KindFigures, by_kind};
use crate::observations::places::PlaceKind;
use crate::observations::{Layer, RowBlock, gauge, start};
use crate::sessions::Session;

use super::outcome::NotIdentifiable;
use super::priors::key;
use super::problem::Problem;
use super::unidentifiable::coefficient_names;

/// Frames, places and the turn of the tool of a robot with several joints.
pub(super) fn terms(session: &Session, layer: &Layer) -> Vec<Term> {
    let nominal = Model::nominal(session.robot.clone());
    let mut terms = frames(session, layer, &nominal);
    let placed = Model::new(session.robot.clone(), terms.clone());
    terms.extend(start::unknown_places(layer, &placed));
    if layer.shows_attitude() {
        let mut turn = Term::absent(&ToolOrientation, 0, 0.0);
        turn.coefficients = start::tool_turn(layer, &placed).to_vec();
        terms.push(turn);
    }
    terms
}

/// The same beside effects that somebody chose: frames only where the session has setups.
pub(super) fn terms_beside(session: &Session, layer: &Layer) -> Vec<Term> {
    let nominal = Model::nominal(session.robot.clone());
    let mut terms = Vec::new();
    if session.samples.setups.is_some() {
        terms = frames(session, layer, &nominal);
    }
    let placed = Model::new(session.robot.clone(), terms.clone());
    terms.extend(start::unknown_places(layer, &placed));
    terms
}

/// A frame for each setup, or the one of the instrument.
fn frames(session: &Session, layer: &Layer, nominal: &Model) -> Vec<Term> {
    let setups = session.samples.setups.as_ref();
    let open = gauge::open(layer).base;
    let frame = |setup: usize| {
        let inside = |i: usize| setups.is_none_or(|s| s.index[i] as usize == setup);
        let mut term = Term::absent(&MeasuringFrame, 0, setup as f64);
        term.label = setups.map(|s| s.names[setup].as_str().into());
        let motion = (!open).then(|| start::frame(layer, nominal, inside));
        if let Some(motion) = motion.flatten() {
            let turn = motion.rotation.scaled_axis();
            let shift = motion.translation.vector;
            term.coefficients = [turn.as_slice(), shift.as_slice()].concat();
        }
        term
    };
    let count = setups.map_or(1, |s| s.names.len());
    (0..count).map(frame).collect()
}

/// The places of a model and nothing else: the nominal robot beside what its measurements refer to.
pub(super) fn places_alone(model: &Model) -> Model {
    model.without(|term| PlaceKind::of(term).is_none())
}

/// The model with everything held that its kinds of measurement cannot show whatever the poses are,
/// in words too; the size that none shows goes to the priors.
pub(super) fn with_open_held(
    problem: &mut Problem,
    model: &Model,
    said: &mut Vec<NotIdentifiable>,
) -> Model {
    let Some(layer) = &problem.observed else {
        return model.clone();
    };
    let open = gauge::open(layer);
    let mut model = model.clone();
    if open.base {
        let names = coefficient_names(&model);
        let mut terms = model.terms().to_vec();
        let mut first = 0;
        for term in &mut terms {
            let own = names[first..].iter().take(term.coefficients.len());
            first += term.coefficients.len();
            if !gauge::carries_base(term) {
                continue;
            }
            let of_frame = term.effect.about().id == MeasuringFrame.about().id;
            for (k, name) in own
                .enumerate()
                .filter(|(k, _)| !term.held.contains(*k))
                .collect::<Vec<_>>()
            {
                term.coefficients[k] = 0.0;
                term.held = term.held.with(k);
                said.push(NotIdentifiable {
                    combination: name.clone(),
                    because: because_base(of_frame),
                });
            }
        }
        model = Model::new(model.robot.clone(), terms);
    }
    if open.size {
        if model.robot.joints.len() == 1 {
            model = with_length_held(&model);
        }
        let usual = problem.priors.usual(&model);
        let size = gauge::size(layer, &model, &usual);
        let of = size.as_ref().map_or(String::new(), |size| {
            format!(
                " (known to about {:.2} % from what is usual for links)",
                100.0 * size.sigma
            )
        });
        said.push(NotIdentifiable {
            combination: "overall size: all lengths of the robot and of the places together"
                .to_owned(),
            because: format!(
                "directions, touches and sockets show no length: the nominal size is kept{of}; one \
                 known length sets it, a distance between two sockets or a second known station"
            ),
        });
        problem.priors.size = size.map_or(Vec::new(), |size| {
            let coefficients = model.terms().iter().flat_map(|term| {
                let own = 0..term.coefficients.len();
                own.map(move |k| key(term, k))
            });
            let weighed = coefficients.zip(size.weights);
            weighed.filter(|own| own.1 != 0.0).collect()
        });
    }
    model
}

fn because_base(of_frame: bool) -> String {
    if of_frame {
        "the base is open: what was measured refers to places that are not known, and says nothing of \
         where the robot stands among others; it is held where it is, and the places carry it"
            .to_owned()
    } else {
        "it moves the robot as a whole, and the base is open: it is held at zero, and the places \
         carry it"
            .to_owned()
    }
}

fn with_length_held(model: &Model) -> Model {
    let terms = model.terms().iter().map(|term| {
        let mut term = term.clone();
        if term.effect.about().id == super::DEFAULT_EFFECTS[1] {
            term.held = Held::default().with(0);
        }
        term
    });
    Model::new(model.robot.clone(), terms.collect())
}

/// The size that the priors hold, as a row beside the columns of a Jacobian in mm.
pub(super) fn add_size(problem: &Problem, model: &Model, reach_mm: f64, rows: &mut DMatrix<f64>) {
    if problem.priors.size.is_empty() {
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

/// The Jacobian of the observations that count, or of `most` of them, three rows each.
pub(super) fn columns(layer: &Layer, model: &Model, most: usize) -> DMatrix<f64> {
    let mut kept = layer.used.clone();
    let count = kept.iter().filter(|used| **used).count();
    if count > most {
        let mut seen = 0;
        for used in kept.iter_mut().filter(|used| **used) {
            // Evenly: the k-th stays where k·most/count steps on.
            *used = (seen + 1) * most / count > seen * most / count;
            seen += 1;
        }
    }
    let mut all: Vec<Vec<f64>> = vec![Vec::new(); model.coefficient_count()];
    layer.visit(model, true, |block: &mut RowBlock| {
        block.keep(&kept);
        for lane in 0..block.items.len() {
            for axis in 0..3 {
                if !block.rows[axis][lane] {
                    continue;
                }
                for (own, column) in all.iter_mut().zip(&block.columns) {
                    own.push(column[axis][lane]);
                }
            }
        }
    });
    let rows = all.first().map_or(0, Vec::len);
    DMatrix::from_fn(rows, all.len(), |row, column| all[column][row])
}

/// Errors by kind, where more than plain points was measured.
pub(super) fn figures(problem: &Problem, before: &Model, after: &Model) -> Vec<KindFigures> {
    let layer = problem.observed.as_ref();
    layer.map_or(Vec::new(), |layer| by_kind(layer, before, after))
}
