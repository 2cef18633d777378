//! Levels of correction of a robot with several joints, so that a user sees what the controller at hand can use:
//!
//! ```text
//! zero offsets ⊂ with tool and frame ⊂ with links ⊂ with effects
//! ```
//!
//! Each level is fitted on its own; its errors are those on cells of the workspace that the fit has not seen. The
//! frame of an instrument that was never aligned belongs to every level: no controller has to know it.

pub(crate) use crate::answers::errors::Errors;
pub use crate::answers::errors::Level;
use crate::budget;
use crate::effects::{LINK_GEOMETRY, MEASURING_FRAME, Role, Setting};
use crate::model::Model;
use crate::text::Template;

use super::base_model;
use super::gap::lengths_mm;
use super::problem::Problem;
use super::solver::solve;
use super::spread::spread;
use crate::sessions::cells::{cells, folds_of_groups};

/// With fewer samples no error on unseen ones is reported.
const FEWEST: usize = 12;

/// The levels of an identified model, on the samples of the problem that count.
pub(crate) fn levels(problem: &Problem, identified: &Model) -> Vec<Level> {
    if problem.observed.is_none() && problem.samples() > budget::SAMPLES {
        // A separate session: the rows that do not count need not go through every fit.
        let rows = spread(problem.counted(), budget::SAMPLES);
        let session = problem
            .session
            .of_rows(&rows.iter().copied().map(Some).collect::<Vec<_>>());
        return of_part(&problem.of_rows(&session, &rows), identified);
    }
    let mut part = problem.clone();
    part.noise = None;
    part.thin(budget::SAMPLES);
    of_part(&part, identified)
}

fn of_part(part: &Problem, identified: &Model) -> Vec<Level> {
    let fold = folds(part, identified);
    let models = models(part, identified).into_iter();
    models
        .map(|(what, model)| level(part, &fold, what, &model))
        .collect()
}

/// For each sample the fold that it is in.
fn folds(problem: &Problem, identified: &Model) -> Vec<usize> {
    let predicted = identified.predict(&problem.inputs);
    let used: Vec<usize> = (0..problem.used.len())
        .filter(|i| problem.used[*i])
        .collect();
    let points: Vec<[f64; 3]> = used.iter().map(|i| predicted.get(*i)).collect();
    let mut fold = vec![0; problem.used.len()];
    let of_points = match &problem.observed {
        None => cells(&points, budget::CELLS)
            .into_iter()
            .map(|c| c % budget::FOLDS)
            .collect(),
        Some(layer) => {
            // What a sample refers to is known from its own kind only.
            let mut group = vec![0; problem.used.len()];
            for (item, reference) in layer.items.iter().zip(layer.references()).rev() {
                group[item.sample] = reference;
            }
            let groups: Vec<usize> = used.iter().map(|i| group[*i]).collect();
            folds_of_groups(&points, &groups, budget::FOLDS)
        }
    };
    for (sample, own) in used.iter().zip(of_points) {
        fold[*sample] = own;
    }
    fold
}

/// The model that each level starts from.
fn models(problem: &Problem, identified: &Model) -> Vec<(Template, Model)> {
    let (links, frame) = (LINK_GEOMETRY.about().id, MEASURING_FRAME.about().id);
    let session = problem.session;
    let unknown_frame = !problem.priors.aligned;
    let start = |keep: &dyn Fn(&str) -> bool| base_model::start(session, problem, keep);
    let tool = |t: &crate::effects::Term| matches!(t.effect.about().setting, Setting::Target);
    // Nor has it to know the places that measurements refer to.
    let place = |t: &crate::effects::Term| t.effect.about().role == Role::Place;
    let frames_only =
        |m: &Model| m.without(|t| !place(t) && (t.effect.about().id != frame || !unknown_frame));
    let with_frame = start(&|id| id != links);
    let turn = |t: &crate::effects::Term| t.effect.about().role == Role::ToolTurn;
    let zeros = with_frame
        .without(|t| tool(t) || turn(t) || t.effect.about().id == frame && !unknown_frame);
    let beyond = |m: &Model| m.without(|t| !base_model::belongs(t.effect.about().id));
    let base = beyond(identified);
    let nominal = if unknown_frame {
        phrase!("nominal robot, with the frame of the instrument")
    } else {
        phrase!("nominal robot")
    };
    let mut all = vec![
        (nominal, frames_only(&with_frame)),
        (phrase!("zero offsets"), zeros),
        (phrase!("with tool and frame"), with_frame),
        (phrase!("with links"), base.clone()),
    ];
    if identified.terms().len() > base.terms().len() {
        all.push((phrase!("with effects"), identified.clone()));
    }
    all
}

fn level(problem: &Problem, fold: &[usize], what: Template, start: &Model) -> Level {
    let solution = solve(problem, start);
    let residuals_mm = lengths_mm(problem, &solution.model);
    let used = |i: &usize| problem.used[*i];
    let own: Vec<f64> = (0..residuals_mm.len())
        .filter(used)
        .map(|i| residuals_mm[i])
        .collect();
    let enough = own.len() >= FEWEST;
    let unseen = || {
        let mut lengths = Vec::new();
        for k in 0..budget::FOLDS {
            let mut seen = problem.clone();
            let counted = seen.counted().iter().enumerate();
            let kept = counted.map(|(i, c)| *c && fold[seen.sample_of(i)] != k);
            seen.set_counted(kept.collect());
            let model = solve(&seen, &solution.model).model;
            let residuals_mm = lengths_mm(problem, &model);
            let held_out = (0..residuals_mm.len()).filter(|i| problem.used[*i] && fold[*i] == k);
            lengths.extend(held_out.map(|i| residuals_mm[i]));
        }
        Errors::of(lengths)
    };
    Level {
        what,
        parameters: solution.spectrum.rank(),
        rms_mm: Errors::of(own).map_or(0.0, |e| e.rms_mm),
        cross_validated: enough.then(unseen).flatten(),
    }
}

#[cfg(test)]
mod tests {
    use super::Errors;

    #[test]
    fn errors_state_mean_root_mean_square_percentile_and_largest() {
        let errors = Errors::of((1..=100).map(f64::from).chain([f64::NAN]).collect()).unwrap();
        assert_eq!(
            (errors.mean_mm, errors.p95_mm, errors.max_mm),
            (50.5, 95.0, 100.0)
        );
        assert!((errors.rms_mm - 3383.5_f64.sqrt()).abs() < 1e-9);
        assert_eq!(Errors::of(vec![f64::NAN]), None);
        assert_eq!(Errors::of(vec![2.0]).unwrap().p95_mm, 2.0);
    }
}
