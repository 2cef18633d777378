//! What the samples do not determine, in words: the directions of the coefficients' space along
//! which nothing changes, each as the parameters that can be exchanged for one another.

use super::gauge::NAMED_PART;
use super::solver::Solution;
use crate::answers::identification::NotIdentifiable;
use crate::model::names::{coefficient_names, together};
use crate::text::{Template, Text};

/// The extra columns have no name.
const UNNAMED: Template = phrase!("what no name explains");

/// Every combination of coefficients that is not identifiable.
pub(super) fn undetermined_combinations(solution: &Solution) -> Vec<NotIdentifiable> {
    let mut names = coefficient_names(&solution.model);
    names.resize(
        names.len() + solution.extra_coefficients.len(),
        UNNAMED.into(),
    );
    let directions = solution.spectrum.null_directions();
    let directions = directions.iter().map(|direction| {
        let size = |k: usize| direction.components[k].abs();
        let scaled = |k: usize| solution.spectrum.scaled_component(&direction.components, k);
        let largest = (0..names.len()).map(scaled).fold(0.0, f64::max);
        let mut involved: Vec<usize> = (0..names.len())
            .filter(|k| size(*k) > 0.0 && scaled(*k) > NAMED_PART * largest)
            .collect();
        involved.sort_by(|a, b| scaled(*b).total_cmp(&scaled(*a)));
        let named = with_one_unnamed(&involved, names.len() - solution.extra_coefficients.len());
        let listed: Vec<&Text> = named.iter().map(|k| &names[*k]).collect();
        let because = if listed.len() == 1 {
            text!("the samples do not depend on it")
        } else {
            text!("only the combination is observable: a change of one can be undone by the others")
        };
        NotIdentifiable {
            combination: together(listed.into_iter().cloned()),
            because,
        }
    });
    directions.collect()
}

/// Of what has no name, which is fitted in many columns behind those of the model, the first alone.
fn with_one_unnamed(involved: &[usize], of_model: usize) -> Vec<usize> {
    let (mut named, without): (Vec<usize>, Vec<usize>) =
        involved.iter().partition(|k| **k < of_model);
    named.extend(without.first());
    named
}
