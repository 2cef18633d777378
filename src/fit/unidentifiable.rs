//! What the samples do not determine, in words: the directions of the coefficients' space along
//! which nothing changes, each as the parameters that can be exchanged for one another.

use crate::effects::term::coefficient_names_on;
use crate::effects::{Effect, Setting};
use crate::kinematics::Robot;
use crate::model::Model;

use super::solver::Solution;
use crate::answers::identification::NotIdentifiable;

/// An effect's name, with its joint where the robot has several.
pub(super) fn name_on_joint(effect: &dyn Effect, joint: usize, robot: &Robot) -> String {
    let id = effect.about().id;
    if effect.about().per_joint && robot.joints.len() > 1 {
        format!("{id} of joint {}", joint + 1)
    } else {
        id.to_owned()
    }
}

/// `effect.parameter` for every coefficient; an amplitude and its phase stand as their two parts.
pub(super) fn coefficient_names(model: &Model) -> Vec<String> {
    let names = model.terms().iter().flat_map(|term| {
        let about = term.effect.about();
        let place = match (about.setting, &term.label) {
            (Setting::Setup, Some(name)) => format!("{} of setup {name}", about.id),
            (Setting::Place, Some(name)) => format!("{} {name}", about.id),
            (Setting::Target, Some(name)) => format!("{} of target {name}", about.id),
            _ => name_on_joint(term.effect, term.joint, &model.robot),
        };
        coefficient_names_on(term.effect, model.robot.joints[term.joint].kind)
            .into_iter()
            .map(move |name| format!("{place}: {name}"))
            .collect::<Vec<_>>()
    });
    names.collect()
}

/// What is fitted beside the model has no name.
const UNNAMED: &str = "what no name explains";

/// Every combination of coefficients that the samples leave open.
pub(super) fn undetermined_combinations(solution: &Solution) -> Vec<NotIdentifiable> {
    let mut names = coefficient_names(&solution.model);
    names.resize(names.len() + solution.beside.len(), UNNAMED.to_owned());
    let directions = solution.spectrum.null_directions();
    let directions = directions.iter().map(|direction| {
        let size = |k: usize| direction.components[k].abs();
        let scaled = |k: usize| solution.spectrum.scaled_component(&direction.components, k);
        let largest = (0..names.len()).map(scaled).fold(0.0, f64::max);
        let mut involved: Vec<usize> = (0..names.len())
            .filter(|k| size(*k) > 0.0 && scaled(*k) > 0.02 * largest)
            .collect();
        involved.sort_by(|a, b| scaled(*b).total_cmp(&scaled(*a)));
        let listed: Vec<&str> = involved.iter().map(|k| names[*k].as_str()).collect();
        let because = if listed.len() == 1 {
            "the samples do not depend on it"
        } else {
            "the samples show only their sum: a change of one can be undone by the others"
        };
        NotIdentifiable {
            combination: listed.join(" with "),
            because: because.to_owned(),
        }
    });
    directions.collect()
}
