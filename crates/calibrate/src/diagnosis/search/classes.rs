//! Suspects that are most of a condition (one side of approach, one speed, one load, one
//! reflector) are evidence of an effect of that condition, not accidents: a session with few
//! samples from the other side must not lose just these.

use crate::fewest;
use crate::fit::problem::Problem;

/// Uses suspects again that are more than half of their condition; `suspected` refers to the samples that the problem
/// counts.
pub(crate) fn keep(problem: &mut Problem, suspected: &[bool]) {
    let inputs = &problem.inputs;
    let n = suspected.len();
    let columns = inputs.dir.iter().chain(&inputs.speed).flatten();
    let loads = inputs.load_kg.iter();
    let mut keys: Vec<Vec<u64>> = columns
        .chain(loads)
        .map(|column| column.iter().map(|v| (v + 0.0).to_bits()).collect())
        .collect();
    let targets = inputs.target.iter();
    keys.extend(targets.map(|t| t.iter().map(|t| u64::from(*t)).collect()));
    let mut back = problem.counted().to_vec();
    let fit = problem.to_fit();
    for key in &keys {
        let of = |i: usize| key[problem.sample_of(i)];
        let mut order: Vec<usize> = (0..n).filter(|i| fit[*i]).collect();
        let all = order.len();
        order.sort_by_key(|i| of(*i));
        for class in order.chunk_by(|a, b| of(*a) == of(*b)) {
            let count = class.iter().filter(|i| suspected[**i]).count();
            if class.len() < all && count >= fewest::NO_ACCIDENT && 2 * count > class.len() {
                for i in class {
                    back[*i] |= suspected[*i];
                }
            }
        }
    }
    problem.set_counted(back);
}
