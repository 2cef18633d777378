//! Suspects in a cluster over a joint's angle are evidence of something local, not accidents: they are used again. Not
//! where they are gross: no machine has such an error, and rows of which the joint's value is missing are a cluster as
//! well.

use std::cell::LazyCell;
use std::collections::BTreeSet;

use super::classes;
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::model::Model;
use crate::thresholds::{GROSS_SHARE, size_mm};
use crate::{fewest, odds};

/// Uses clusters again.
pub(super) fn keep(problem: &mut Problem, base: &Model) {
    let fit = problem.to_fit().to_vec();
    let counted = problem.counted().iter();
    let suspected: Vec<bool> = fit.iter().zip(counted).map(|(f, c)| *f && !c).collect();
    let chosen = |of: &[bool]| poses_of(problem, (0..of.len()).filter(|i| of[*i]));
    let [count, fitted] = [&suspected, &fit].map(|of| chosen(of));
    if count < fewest::NO_ACCIDENT {
        return;
    }
    classes::keep(problem, &suspected);
    let share = count as f64 / fitted.max(1) as f64;
    let mut back = problem.counted().to_vec();
    let residual_mm = LazyCell::new(|| lengths_mm(problem, base));
    for joint in 0..problem.inputs.q.len() {
        let q = &problem.inputs.q[joint];
        let of = |i: usize| q[problem.sample_of(i)];
        for run in runs(&fit, &suspected, of) {
            // So many in a row by accident: n·share^run.
            let own = poses_of(problem, run.iter().copied());
            let accident = fitted as f64 * share.powi(i32::try_from(own).unwrap_or(64));
            if own >= fewest::NO_ACCIDENT
                && accident < odds::LIKELY.chance()
                && !is_gross(problem, &residual_mm, &run)
            {
                for index in run {
                    back[index] = true;
                }
            }
        }
    }
    problem.set_counted(back);
}

/// In how many poses these were measured: shots at one pose are one accident.
fn poses_of(problem: &Problem, counted: impl Iterator<Item = usize>) -> usize {
    let poses = problem.inputs.pose.as_deref();
    let of = |i: usize| poses.map_or(i, |poses| poses[problem.sample_of(i)] as usize);
    counted.map(of).collect::<BTreeSet<usize>>().len()
}

/// Whether most of the errors here are larger than any effect.
fn is_gross(problem: &Problem, residual_mm: &[f64], run: &[usize]) -> bool {
    let mut run: Vec<f64> = run
        .iter()
        .map(|i| residual_mm[problem.sample_of(*i)])
        .collect();
    run.sort_by(f64::total_cmp);
    run[run.len() / 2] > GROSS_SHARE * size_mm(problem.session)
}

/// The suspects between whose values no other has its own. Of many samples few are suspects: they are put in order,
/// and the others only part them.
fn runs(fit: &[bool], suspected: &[bool], of: impl Fn(usize) -> f64) -> Vec<Vec<usize>> {
    let along = |a: &usize, b: &usize| of(*a).total_cmp(&of(*b)).then(a.cmp(b));
    let mut suspects: Vec<usize> = (0..fit.len()).filter(|i| suspected[*i]).collect();
    suspects.sort_unstable_by(along);
    let mut parted = vec![false; suspects.len()];
    for other in (0..fit.len()).filter(|i| fit[*i] && !suspected[*i]) {
        let next = suspects.partition_point(|suspect| along(suspect, &other).is_lt());
        if let Some(parted) = parted.get_mut(next) {
            *parted = true;
        }
    }
    let mut runs: Vec<Vec<usize>> = Vec::new();
    for (suspect, parted) in suspects.into_iter().zip(parted) {
        match runs.last_mut() {
            Some(run) if !parted => run.push(suspect),
            _ => runs.push(vec![suspect]),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::runs;

    #[test]
    fn runs_are_those_of_all_samples_in_order() {
        // Values come twice, and not every sample is fitted.
        let of = |i: usize| ((i * 37) % 50) as f64;
        let fit: Vec<bool> = (0..100).map(|i| i % 7 != 3).collect();
        for every in [2, 3, 11, 90] {
            let suspected: Vec<bool> = (0..100)
                .map(|i| fit[i] && (of(i) < 9.0 || i % every == 1))
                .collect();
            let mut order: Vec<usize> = (0..100).filter(|i| fit[*i]).collect();
            order.sort_by(|a, b| of(*a).total_cmp(&of(*b)).then(a.cmp(b)));
            let of_all = order.split(|i| !suspected[*i]);
            let of_all: Vec<&[usize]> = of_all.filter(|run| !run.is_empty()).collect();
            assert!(of_all.iter().any(|run| run.len() > 9), "{every}");
            assert_eq!(runs(&fit, &suspected, of), of_all, "{every}");
        }
    }
}
