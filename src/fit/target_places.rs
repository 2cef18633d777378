//! Which targets are where the session says, as far as a fit in which all places are free tells.
//!
//! Such a fit shows the targets in the tool but for a shift that all share, which is the tool's. That shift is the
//! one that explains most with least: a target that is at its own stated place needs nothing, one at the stated place
//! of another a wrong name, any other three numbers of its own. Where two shifts explain the targets equally well,
//! as of two targets that disagree, nothing tells where the tool is, and no answer may look as if something did.

use nalgebra::Vector3;

use super::gap::lengths_mm;
use super::problem::Problem;
use crate::effects::TOOL_POSITION;
use crate::model::Model;

/// A target is off beyond so many standard deviations of what is known of it and of what the fit shows.
const OFF: f64 = 4.0;
/// How much a target costs that has the name of another …
const WRONG_NAME: usize = 1;
/// … and one that is elsewhere: three numbers.
const ELSEWHERE: usize = 3;
/// Of more targets than these no wrong names are looked for.
const MOST_NAMES: usize = 64;

/// A target as a fit with free places shows it.
#[derive(Debug, Clone)]
pub(crate) struct SeenTarget {
    /// At whose stated place it should be.
    pub(crate) of: usize,
    /// Where it is in the tool, but for the shift that all share, mm.
    pub(crate) at_mm: Vector3<f64>,
    /// How far from its stated place it may be, mm.
    pub(crate) within_mm: f64,
}

/// What targets say together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Agreement {
    /// One shift of the tool explains them best.
    Settled {
        /// What all share, mm.
        shift_mm: Vector3<f64>,
        /// At whose stated place each is; `None`: at none.
        at: Vec<Option<usize>>,
    },
    /// Several explain them equally well, that are so far from one another, mm.
    Open {
        /// The largest distance between two.
        across_mm: f64,
    },
}

/// How far from its stated place a target may be, mm: `sigma` of what is stated, and the median error that is left
/// over so many samples of it.
pub(crate) fn within_mm(sigma: f64, median_mm: f64, samples: usize) -> f64 {
    let shown = median_mm * (3.0 / samples.max(1) as f64).sqrt();
    OFF * sigma.max(shown)
}

/// Standard deviation of the places of so many targets, mm, beside which the 95 % interval of the shift that they
/// share reaches from either of two shifts so far apart to the other.
pub(crate) fn sigma_between(across_mm: f64, targets: usize) -> f64 {
    0.6 * across_mm * (targets as f64).sqrt()
}

/// Where the tool and its targets are; `stated` is `None` for a target of which nothing is stated.
pub(crate) fn agreement(seen: &[SeenTarget], stated: &[Option<Vector3<f64>>]) -> Agreement {
    let mut best: Vec<(usize, Vec<Option<usize>>, Vector3<f64>)> = Vec::new();
    let names = stated.len() <= MOST_NAMES;
    for one in seen {
        for (target, place) in stated.iter().enumerate() {
            let Some(place) = place.filter(|_| names || target == one.of) else {
                continue;
            };
            let around = |other: &SeenTarget| other.within_mm.hypot(one.within_mm);
            let (_, at) = explained(seen, stated, one.at_mm - place, around);
            // As many as agree say together where the tool is.
            let own = seen.iter().zip(&at);
            let shifts: Vec<Vector3<f64>> = own
                .filter_map(|(seen, at)| Some(seen.at_mm - stated[(*at)?]?))
                .collect();
            let shift = shifts.iter().sum::<Vector3<f64>>() / shifts.len().max(1) as f64;
            let (cost, at) = explained(seen, stated, shift, |other| other.within_mm);
            let least = best.first().map_or(usize::MAX, |b| b.0);
            if cost < least {
                best.clear();
            }
            if cost <= least && best.iter().all(|b| b.1 != at) {
                best.push((cost, at, shift));
            }
        }
    }
    if let [(_, at, shift)] = &mut best[..] {
        return Agreement::Settled {
            shift_mm: *shift,
            at: std::mem::take(at),
        };
    }
    let shifts: Vec<Vector3<f64>> = best.iter().map(|b| b.2).collect();
    Agreement::Open {
        across_mm: largest_distance(&shifts),
    }
}

/// How far the shifts are from one another that the targets show, each beside its own stated place, mm.
pub(crate) fn across_mm(seen: &[SeenTarget], stated: &[Option<Vector3<f64>>]) -> f64 {
    let shift = |one: &SeenTarget| Some(one.at_mm - (*stated.get(one.of)?)?);
    let shifts: Vec<Vector3<f64>> = seen.iter().filter_map(shift).collect();
    largest_distance(&shifts)
}

fn largest_distance(all: &[Vector3<f64>]) -> f64 {
    let mut across = 0.0_f64;
    for (k, one) in all.iter().enumerate() {
        for other in &all[k + 1..] {
            across = across.max((one - other).norm());
        }
    }
    across
}

/// What targets cost beside a shift, and at whose stated place each is.
fn explained(
    seen: &[SeenTarget],
    stated: &[Option<Vector3<f64>>],
    shift: Vector3<f64>,
    within: impl Fn(&SeenTarget) -> f64,
) -> (usize, Vec<Option<usize>>) {
    let mut cost = 0;
    let mut at = Vec::with_capacity(seen.len());
    for one in seen {
        let away = |place: &Vector3<f64>| (one.at_mm - shift - place).norm();
        let is_at = |target: &usize| {
            let place = stated.get(*target).copied().flatten();
            place.is_some_and(|place| away(&place) <= within(one))
        };
        let own = Some(one.of).filter(is_at);
        let others = if stated.len() <= MOST_NAMES {
            stated.len()
        } else {
            0
        };
        let place = own.or_else(|| (0..others).find(is_at));
        cost += match place {
            Some(target) if target == one.of => 0,
            Some(_) => WRONG_NAME,
            None => ELSEWHERE,
        };
        at.push(place);
    }
    (cost, at)
}

/// Each target's own part in a model, mm, with its number, counted from 0.
pub(crate) fn own_parts(model: &Model) -> Vec<(usize, Vector3<f64>)> {
    let id = TOOL_POSITION.about().id;
    let terms = model.terms().iter();
    let own = terms.filter(|t| t.effect.about().id == id && t.setting > 0.0);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a setting is a small whole number"
    )]
    own.map(|t| {
        let by = Vector3::from_column_slice(&t.coefficients[..3]);
        (t.setting as usize - 1, by)
    })
    .collect()
}

/// The targets of a fit with free places, of those of which a place is stated; `of` says whose it is.
pub(crate) fn seen_targets(
    problem: &Problem,
    model: &Model,
    sigma: f64,
    of: impl Fn(usize) -> Option<usize>,
) -> Vec<(usize, SeenTarget)> {
    let session = problem.session;
    let mut lengths = lengths_mm(problem, model);
    lengths.retain(|v| v.is_finite());
    lengths.sort_by(f64::total_cmp);
    let median = lengths.get(lengths.len() / 2).copied().unwrap_or(0.0);
    let column = problem.inputs.target.as_deref().unwrap_or_default();
    let samples = |target: usize| {
        let rows = column.iter().zip(&problem.used);
        rows.filter(|(own, used)| **used && **own as usize == target)
            .count()
    };
    let parts = own_parts(model).into_iter();
    let seen = parts.filter_map(|(target, by)| {
        let one = SeenTarget {
            of: of(target)?,
            at_mm: session.targets.get(target)?.position_mm.coords + by,
            within_mm: within_mm(sigma, median, samples(target)),
        };
        Some((target, one))
    });
    seen.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> Vec<Option<Vector3<f64>>> {
        let of = |x, y, z| Some(Vector3::new(x, y, z));
        vec![
            of(0.0, 0.0, 60.0),
            of(70.0, 20.0, 40.0),
            of(-40.0, 60.0, 50.0),
        ]
    }

    fn seen(of: usize, at_mm: Vector3<f64>) -> SeenTarget {
        SeenTarget {
            of,
            at_mm,
            within_mm: 0.2,
        }
    }

    fn tool() -> Vector3<f64> {
        Vector3::new(1.2, -3.4, 0.5)
    }

    #[test]
    fn the_majority_of_targets_says_where_the_tool_is() {
        let stated = places();
        let at = |k: usize| stated[k].unwrap() + tool();
        let off = Vector3::new(0.0, 140.0, 0.0);
        let all = [seen(0, at(0)), seen(1, at(1) + off), seen(2, at(2))];
        let Agreement::Settled {
            shift_mm,
            at: found,
        } = agreement(&all, &stated)
        else {
            panic!("two of three agree");
        };
        assert!((shift_mm - tool()).norm() < 1e-9);
        assert_eq!(found, [Some(0), None, Some(2)]);
        // One that moved later is one more, and does not outvote the two.
        let two = [seen(0, at(0)), seen(1, at(1)), seen(1, at(1) + off)];
        let Agreement::Settled { at: found, .. } = agreement(&two, &stated) else {
            panic!("two of three agree");
        };
        assert_eq!(found, [Some(0), Some(1), None]);
    }

    #[test]
    fn exchanged_names_are_recognised_by_the_places() {
        let stated = places();
        let at = |k: usize| stated[k].unwrap() + tool();
        let all = [seen(0, at(1)), seen(1, at(0)), seen(2, at(2))];
        let Agreement::Settled {
            shift_mm,
            at: found,
        } = agreement(&all, &stated)
        else {
            panic!("one shift explains all");
        };
        assert!((shift_mm - tool()).norm() < 1e-9);
        assert_eq!(found, [Some(1), Some(0), Some(2)]);
        let turned = [seen(0, at(1)), seen(1, at(2)), seen(2, at(0))];
        let Agreement::Settled { at: found, .. } = agreement(&turned, &stated) else {
            panic!("one shift explains all");
        };
        assert_eq!(found, [Some(1), Some(2), Some(0)]);
    }

    #[test]
    fn two_targets_that_disagree_leave_it_open() {
        let stated = places();
        let at = |k: usize| stated[k].unwrap() + tool();
        let off = Vector3::new(0.0, 3.0, 4.0);
        let open = Agreement::Open { across_mm: 5.0 };
        let close = |found: Agreement| match (found, &open) {
            (Agreement::Open { across_mm: a }, Agreement::Open { across_mm: b }) => {
                (a - b).abs() < 1e-9
            }
            _ => false,
        };
        assert!(close(agreement(
            &[seen(0, at(0)), seen(1, at(1) + off)],
            &stated
        )));
        // All moved by the same halfway: before or after, nothing tells.
        let all = [0, 1, 2, 0, 1, 2].map(|k| seen(k, at(k)));
        let mut moved = all.to_vec();
        moved[3..].iter_mut().for_each(|one| one.at_mm += off);
        assert!(close(agreement(&moved, &stated)));
        // The mean of the targets is known so that its interval holds both.
        let sigma = sigma_between(5.0, 2);
        assert!(1.96 * sigma / 2.0_f64.sqrt() > 5.0);
    }
}
