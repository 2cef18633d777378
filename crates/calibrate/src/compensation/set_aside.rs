//! Samples of a check that are suspected outliers: single ones are outliers, many of them or some that belong
//! together are evidence.

use crate::answers::diagnosis::DataProblem;
use crate::fewest;
use crate::model::Calibration;
use crate::sessions::{Group, Session};
use crate::text::Text;
use crate::text::length;

/// More than this share of the samples is more than accidents.
const MOST_SHARE: f64 = 0.02;

/// The samples that the fit of a model set aside, marked among so many, where they are those of its own session.
pub(super) fn of_its_own(
    calibration: &Calibration,
    own: bool,
    samples: usize,
) -> Option<Vec<bool>> {
    let set_aside = calibration.set_aside.as_ref().filter(|_| own)?;
    let mut marked = vec![false; samples];
    for sample in set_aside {
        *marked.get_mut(*sample)? = true;
    }
    Some(marked)
}

/// The findings about the suspected samples among those that count, from the residuals of every sample, mm.
pub(super) fn findings(
    session: &Session,
    lengths_mm: &[f64],
    counts: impl Fn(usize) -> bool,
    suspected: &[bool],
) -> Vec<DataProblem> {
    let all: Vec<usize> = (0..suspected.len()).filter(|i| counts(*i)).collect();
    let set_aside: Vec<usize> = all.iter().copied().filter(|i| suspected[*i]).collect();
    let mut problems = Vec::new();
    if set_aside.is_empty() {
        return problems;
    }
    let far = |samples: &[usize]| {
        let square: f64 = samples.iter().map(|i| lengths_mm[*i].powi(2)).sum();
        (square / samples.len().max(1) as f64).sqrt()
    };
    let mut problem = |what: Text, evidence: Text, samples: Vec<usize>| {
        problems.push(DataProblem {
            what,
            evidence,
            proposal: text!(
                "look at them before the model is used: the RMS error over all samples is the one that counts"
            ),
            mend: None,
            samples,
        });
    };
    let groups = groups(session, &all);
    let mut is_explained = false;
    for (name, members) in &groups {
        let inside: Vec<usize> = members.iter().copied().filter(|i| suspected[*i]).collect();
        let whole = members.len() < all.len();
        if whole && inside.len() >= fewest::NO_ACCIDENT && 2 * inside.len() >= members.len() {
            is_explained = true;
            problem(
                text!("{thing} is not where the model has it", thing = name),
                text!(
                    "{inside} of its {all} samples are suspected, with an RMS error of {error}",
                    inside = inside.len(),
                    all = members.len(),
                    error = length(far(&inside), 3)
                ),
                inside,
            );
        }
    }
    if let Some(run) = longest_run(&in_order(session, &all), suspected)
        && run.len() >= fewest::NO_ACCIDENT
        && (!is_explained || run.len() * 2 > set_aside.len())
    {
        is_explained = true;
        let (first, last) = (run[0] + 1, run[run.len() - 1] + 1);
        problem(
            text!(
                "samples {first} to {last} do not follow the model, {count} in a row",
                first,
                last,
                count = run.len()
            ),
            text!("their RMS error is {error}", error = length(far(&run), 3)),
            run,
        );
    }
    if !is_explained && set_aside.len() as f64 > MOST_SHARE * all.len() as f64 {
        let evidence = text!(
            "their RMS error is {error}, more than {share} % of the samples are among them",
            error = length(far(&set_aside), 3),
            share = format!("{:.0}", 100.0 * MOST_SHARE)
        );
        let what = text!(
            "{suspected} of {all} samples do not follow the model",
            suspected = set_aside.len(),
            all = all.len()
        );
        problem(what, evidence, set_aside);
    }
    problems
}

/// Samples by target and by setup, where there are several.
fn groups(session: &Session, all: &[usize]) -> Vec<(Text, Vec<usize>)> {
    let samples = &session.samples;
    let mut groups = Vec::new();
    let mut add = |group: Text, index: &[u32], of: usize| {
        let members: Vec<usize> = all
            .iter()
            .copied()
            .filter(|i| index[*i] as usize == of)
            .collect();
        if !members.is_empty() {
            groups.push((group, members));
        }
    };
    if let Some(index) = &samples.target {
        for (k, target) in session.targets.iter().enumerate() {
            add(Group::Target.called(&*target.name), index, k);
        }
    }
    if let Some(setups) = &samples.setups {
        for (k, name) in setups.names.iter().enumerate() {
            add(Group::Setup.called(&**name), &setups.index, k);
        }
    }
    groups
}

/// The samples in the order in which they were measured.
fn in_order(session: &Session, all: &[usize]) -> Vec<usize> {
    let mut order = all.to_vec();
    if let Some(time) = &session.samples.time_s
        && all.iter().all(|i| time[*i].is_finite())
    {
        order.sort_by(|a, b| time[*a].total_cmp(&time[*b]).then(a.cmp(b)));
    }
    order
}

/// The longest stretch of suspected samples in this order; a single one that is not suspected does
/// not end it, and is not in it.
fn longest_run(order: &[usize], suspected: &[bool]) -> Option<Vec<usize>> {
    let (mut best, mut run, mut between) = (Vec::new(), Vec::new(), 0);
    for sample in order {
        if suspected[*sample] {
            run.push(*sample);
            between = 0;
        } else {
            between += 1;
        }
        if between > 1 {
            run.clear();
        }
        if run.len() > best.len() {
            best.clone_from(&run);
        }
    }
    (!best.is_empty()).then_some(best)
}
