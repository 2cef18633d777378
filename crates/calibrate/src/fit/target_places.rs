//! Which targets are where the session states them, as far as a fit in which all places are free determines it.
//!
//! Such a fit determines the targets in the tool but for a shift, which is the tool's, and a turn about the last
//! joint's axis, which is its zero offset. The motion is chosen that explains most with least: a target at its own
//! stated place costs nothing, one at the stated place of another is a wrong name, any other costs three numbers.
//! Where several motions explain the targets equally well, as of two targets that disagree, the tool is not
//! determined, and the answer must not suggest that it is.

use super::priors::MISSED;
use crate::odds;
use nalgebra::{Rotation3, Unit, Vector3};

use super::gap::lengths_mm;
use super::problem::Problem;
use crate::effects::{TOOL_POSITION, joint_zero};
use crate::kinematics::quaternion::log_of_matrix;
use crate::kinematics::{JointKind, Robot};
use crate::model::Model;

/// Of more targets than these no wrong names are looked for.
const MOST_NAMES: usize = 12;

/// A target as a fit with free places shows it.
#[derive(Debug, Clone)]
pub(crate) struct SeenTarget {
    /// At whose stated place it should be.
    pub(crate) of: usize,
    /// Its place in the tool, but for the shift that all share, mm.
    pub(crate) at_mm: Vector3<f64>,
    /// The distance from its stated place that is allowed, mm.
    pub(crate) within_mm: f64,
}

/// How well the targets agree.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Agreement {
    /// One motion of the tool explains them best.
    Settled {
        /// The stated place of each in the tool, mm.
        places_mm: Vec<Vector3<f64>>,
        /// At whose stated place each is; `None`: at none.
        at: Vec<Option<usize>>,
    },
    /// Several explain them equally well, that are so far from one another, mm.
    Open {
        /// The largest distance between two.
        across_mm: f64,
    },
}

/// How far from its stated place a target may be, mm: `sigma` of what is stated, and the median residual over so many
/// samples of it.
pub(crate) fn within_mm(sigma: f64, median_mm: f64, samples: usize) -> f64 {
    let shown = median_mm * (3.0 / samples.max(1) as f64).sqrt();
    MISSED * sigma.max(shown)
}

/// Standard deviation of the places of so many targets, mm, with which the 95 % interval of the shift that they share
/// reaches from either of two shifts so far apart to the other.
pub(crate) fn sigma_between(across_mm: f64, targets: usize) -> f64 {
    0.6 * across_mm * (targets as f64).sqrt()
}

/// The axis in the tool's frame about which the last joint turns the targets.
pub(crate) fn last_axis(robot: &Robot) -> Option<Unit<Vector3<f64>>> {
    let last = robot.joints.last()?;
    let turns = last.kind == JointKind::Revolute;
    turns.then(|| robot.base_from_tool.rotation.inverse() * last.axis.direction)
}

/// The standard deviation of a zero offset, rad.
fn zero_sigma() -> f64 {
    let priors = joint_zero().about().priors;
    priors.first().map_or(f64::INFINITY, |prior| prior.sigma)
}

/// A motion that all targets share.
#[derive(Debug, Clone, Copy)]
struct Motion {
    turn: Rotation3<f64>,
    shift_mm: Vector3<f64>,
}

impl Motion {
    /// The place of a target without it.
    fn undone(&self, seen: &SeenTarget) -> Vector3<f64> {
        self.turn.inverse() * (seen.at_mm - self.shift_mm)
    }

    /// The best one that takes stated places to where targets are measured.
    fn of(pairs: &[(Vector3<f64>, Vector3<f64>)], about: Option<Unit<Vector3<f64>>>) -> Self {
        let many = pairs.len().max(1) as f64;
        let from = pairs.iter().map(|p| p.0).sum::<Vector3<f64>>() / many;
        let to = pairs.iter().map(|p| p.1).sum::<Vector3<f64>>() / many;
        let turn = about.map_or_else(Rotation3::identity, |about| {
            let across = |v: Vector3<f64>| v - about.into_inner() * about.dot(&v);
            let (mut along, mut around) = (0.0, 0.0);
            for pair in pairs {
                let [a, b] = [across(pair.0 - from), across(pair.1 - to)];
                along += a.dot(&b);
                around += about.dot(&a.cross(&b));
            }
            Rotation3::from_axis_angle(&about, f64::atan2(around, along))
        });
        Self {
            turn,
            shift_mm: to - turn * from,
        }
    }
}

/// Where the tool and its targets are; `stated` is `None` for a target of which nothing is stated, `about` the axis
/// about which all may be turned.
pub(crate) fn agreement(
    seen: &[SeenTarget],
    stated: &[Option<Vector3<f64>>],
    about: Option<Unit<Vector3<f64>>>,
) -> Agreement {
    let mut best: Vec<(usize, Explained, Motion, f64)> = Vec::new();
    for (motion, around) in motions(seen, stated, about) {
        let (_, first, _) = explained(seen, stated, &motion, |one| one.within_mm.hypot(around));
        // The targets that agree determine the tool together.
        let own = seen.iter().zip(&first);
        let pairs: Vec<_> = own
            .filter_map(|(seen, at)| Some((stated[(*at)?]?, seen.at_mm)))
            .collect();
        let motion = Motion::of(&pairs, about);
        let (cost, at, missed) = explained(seen, stated, &motion, |one| one.within_mm);
        let least = best.first().map_or(usize::MAX, |b| b.0);
        if cost < least {
            best.clear();
        }
        if cost <= least && best.iter().all(|b| b.1 != at) {
            best.push((
                cost,
                at,
                motion,
                missed + (log_of_matrix(&motion.turn).norm() / zero_sigma()).powi(2),
            ));
        }
    }
    let least = best.iter().map(|b| b.3).fold(f64::INFINITY, f64::min);
    best.retain(|b| b.3 <= least + 2.0 * odds::CLEAR.nats());
    if let [(_, at, motion, _)] = &mut best[..] {
        return Agreement::Settled {
            places_mm: seen.iter().map(|one| motion.undone(one)).collect(),
            at: std::mem::take(at),
        };
    }
    let shifts: Vec<Vector3<f64>> = best.iter().map(|b| b.2.shift_mm).collect();
    Agreement::Open {
        across_mm: largest_distance(&shifts),
    }
}

/// Motions that take the stated places of one or two targets to where they, or others, are measured; and how far off
/// the targets may be that they are made of, mm.
fn motions(
    seen: &[SeenTarget],
    stated: &[Option<Vector3<f64>>],
    about: Option<Unit<Vector3<f64>>>,
) -> Vec<(Motion, f64)> {
    let places = |one: &SeenTarget| {
        let of = one.of;
        let all = stated.iter().enumerate();
        all.filter(move |(target, _)| stated.len() <= MOST_NAMES || *target == of)
            .filter_map(|(target, place)| Some((target, (*place)?)))
            .collect::<Vec<_>>()
    };
    let mut all = Vec::new();
    for (k, one) in seen.iter().enumerate() {
        for (target, place) in places(one) {
            let first = (place, one.at_mm);
            all.push((Motion::of(&[first], None), one.within_mm));
            let others = if about.is_some() { MOST_NAMES } else { 0 };
            for other in seen[k + 1..].iter().take(others) {
                for (_, place) in places(other).into_iter().filter(|p| p.0 != target) {
                    let second = (place, other.at_mm);
                    let motion = Motion::of(&[first, second], about);
                    let around = one.within_mm.hypot(other.within_mm);
                    let apart = |seen: &SeenTarget, place: Vector3<f64>| {
                        (motion.undone(seen) - place).norm()
                    };
                    let fits = apart(one, first.0).max(apart(other, second.0)) <= around;
                    if fits && log_of_matrix(&motion.turn).norm() <= MISSED * zero_sigma() {
                        all.push((motion, around));
                    }
                }
            }
        }
    }
    all
}

/// At whose stated place each target is, if at any.
type Explained = Vec<Option<usize>>;

/// The cost of targets given a motion, at whose stated place each is, and the squares by which they miss it, in units
/// of their standard deviations.
fn explained(
    seen: &[SeenTarget],
    stated: &[Option<Vector3<f64>>],
    motion: &Motion,
    within: impl Fn(&SeenTarget) -> f64,
) -> (usize, Explained, f64) {
    let (mut cost, mut missed) = (0, 0.0);
    let mut at = Vec::with_capacity(seen.len());
    for one in seen {
        let here = motion.undone(one);
        let is_at = |target: &usize| {
            let place = stated.get(*target).copied().flatten();
            place.is_some_and(|place| (here - place).norm() <= within(one))
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
            Some(_) => 1,
            None => 3,
        };
        if let Some(place) = place.and_then(|target| stated[target]) {
            missed += (MISSED * (here - place).norm() / one.within_mm).powi(2);
        }
        at.push(place);
    }
    (cost, at, missed)
}

/// How far the shifts of the targets from their own stated places are from one another, mm.
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

    const AXIS: Option<Unit<Vector3<f64>>> = Some(Unit::new_unchecked(Vector3::new(0.0, 0.0, 1.0)));

    #[test]
    fn the_last_zero_offset_turns_all_targets() {
        let stated = places();
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.03);
        let at = |k: usize| turn * stated[k].unwrap() + tool();
        let off = Vector3::new(1.0, -0.4, 0.8);
        let all = [
            seen(0, at(1)),
            seen(1, at(0)),
            seen(2, at(2)),
            seen(2, at(2) + off),
        ];
        let Agreement::Settled {
            places_mm,
            at: found,
        } = agreement(&all, &stated, AXIS)
        else {
            panic!("one motion explains all but one");
        };
        assert_eq!(found, [Some(1), Some(0), Some(2), None]);
        let by = places_mm[3] - stated[2].unwrap();
        assert!((by - turn.inverse() * off).norm() < 1e-9, "{by}");
    }

    #[test]
    fn a_turn_that_hardly_fits_is_none() {
        // About x the second would nearly be where it is measured, were the third elsewhere.
        let of = |x, y, z| Some(Vector3::new(x, y, z));
        let stated = [
            of(10.0, 5.0, 70.0),
            of(75.0, -20.0, 35.0),
            of(-45.0, 60.0, 50.0),
        ];
        let at = |k: usize| stated[k].unwrap() + tool();
        let off = Vector3::new(0.0, 2.0, -1.0);
        let all = [seen(0, at(0)), seen(1, at(1) + off), seen(2, at(2))];
        let about = Some(Vector3::x_axis());
        let Agreement::Settled { at: found, .. } = agreement(&all, &stated, about) else {
            panic!("two of three agree");
        };
        assert_eq!(found, [Some(0), None, Some(2)]);
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
            places_mm,
            at: found,
        } = agreement(&all, &stated, AXIS)
        else {
            panic!("two of three agree");
        };
        assert!((places_mm[1] - stated[1].unwrap() - off).norm() < 1e-9);
        assert_eq!(found, [Some(0), None, Some(2)]);
        // One that moved later is one more, and does not outvote the two.
        let two = [seen(0, at(0)), seen(1, at(1)), seen(1, at(1) + off)];
        let Agreement::Settled { at: found, .. } = agreement(&two, &stated, AXIS) else {
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
            places_mm,
            at: found,
        } = agreement(&all, &stated, AXIS)
        else {
            panic!("one shift explains all");
        };
        assert!((places_mm[0] - stated[1].unwrap()).norm() < 1e-9);
        assert_eq!(found, [Some(1), Some(0), Some(2)]);
        let turned = [seen(0, at(1)), seen(1, at(2)), seen(2, at(0))];
        let Agreement::Settled { at: found, .. } = agreement(&turned, &stated, AXIS) else {
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
            &stated,
            AXIS
        )));
        // All moved by the same halfway: before or after cannot be distinguished.
        let all = [0, 1, 2, 0, 1, 2].map(|k| seen(k, at(k)));
        let mut moved = all.to_vec();
        moved[3..].iter_mut().for_each(|one| one.at_mm += off);
        assert!(close(agreement(&moved, &stated, AXIS)));
        // The mean of the targets is known so that its interval holds both.
        let sigma = sigma_between(5.0, 2);
        assert!(1.96 * sigma / 2.0_f64.sqrt() > 5.0);
    }
}
