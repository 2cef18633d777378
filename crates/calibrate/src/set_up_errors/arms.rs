//! Mistakes of setting up a robot with several joints, each with its joint.
//!
//! A trial fits the measuring frame, one shift of the tool and the zero offsets, as the one who mounts
//! a robot would adjust them, and looks at the median error. What some change of the samples brings
//! down to a small part, and to what the geometry of a robot may leave, is a mistake. Changes that do
//! so equally well are said together: the sign of a spherical wrist's middle joint is both
//! neighbours' homes by 180°, the sign of a positioner's first joint the home of the second, the home
//! of joint 1 the measuring frame.

use nalgebra::Vector3;

use crate::effects::{JointValues, Setting, Term};
use crate::kinematics::JointKind;
use crate::sessions::{Session, SessionCorrection};
use crate::text::Text;
use crate::text::length;
use crate::units::{deg_from_rad, rad_from_deg};

use super::arm_hypotheses::{Change, changes};
use super::hypotheses::{LEAST_MOVE_MM, LEAST_TURN_DEG, change_of_measure, is_of_one_coordinate};
use super::several::several;
use super::thinned::thinned_to;
use super::thresholds::{EQUAL, FEWEST_SAMPLES, HALF, MENDED_SHARE, NEARLY_ALL, PLAUSIBLE_SHARE};
use super::trial::trial;
use super::{DataProblem, as_it_stands};

/// Samples that a trial looks at.
const MOST_SAMPLES: usize = 120;
/// A median error below this share of the spread of the points is no mistake of setting up …
const GROSS_SHARE: f64 = 0.005;
/// … nor one below this share of the robot's reach …
const GROSS_OF_ROBOT: f64 = 0.005;
/// What leaves so many times as much as the best says the same in these samples.
const ALIKE: f64 = 1.25;
/// Where no mistake alone explains the samples, so many of the best are tried in pairs.
const MOST_PAIRED: usize = 5;

/// The session without its mistakes; `None` where there is none.
pub(super) fn corrected(
    session: &Session,
    values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    let mut part = thinned_to(session, MOST_SAMPLES);
    if part.samples.len() < FEWEST_SAMPLES.max(session.robot.joints.len() + 4) {
        return None;
    }
    let mut mends: Vec<SessionCorrection> = Vec::new();
    for problem in mistakes(&part, values) {
        if let Some(mend) = &problem.mend {
            mend.apply(&mut part);
            mends.push(mend.clone());
        }
        problems.push(problem);
    }
    if let Some(problem) = never_aligned(&part, values) {
        problems.push(problem);
        mends.push(SessionCorrection::FreeFrame);
    }
    (!mends.is_empty()).then(|| {
        let mut better = session.clone();
        for mend in &mends {
            mend.apply(&mut better);
        }
        better
    })
}

/// Spread of the measured points about their mean, root mean square, mm.
fn spread_mm(session: &Session) -> f64 {
    session.samples.spread_mm()
}

/// One change of the samples and what it leaves.
struct TriedChange {
    change: Change,
    /// What the compared share of the samples is off by, in the units of the samples as they stand, mm.
    left_mm: f64,
}

/// The mistake that explains the samples, or the two.
fn mistakes(part: &Session, values: JointValues) -> Vec<DataProblem> {
    let found = mistakes_within(part, values, HALF);
    if found.is_empty() {
        mistakes_within(part, values, NEARLY_ALL)
    } else {
        found
    }
}

/// The same by what so large a share of the samples is off by at most.
fn mistakes_within(part: &Session, values: JointValues, share: f64) -> Vec<DataProblem> {
    let spread = spread_mm(part);
    let adjusted = trial(part, values, true).map_or(f64::INFINITY, |t| t.within_mm(share));
    if adjusted < GROSS_SHARE * spread {
        return Vec::new();
    }
    // A trial that ran away on poses that show little is no reason to doubt the samples.
    let before = adjusted.min(as_it_stands::least_mm(part, values, true, share));
    if before < GROSS_SHARE * spread || before < GROSS_OF_ROBOT * part.robot.length_along_links_mm()
    {
        return Vec::new();
    }
    let most = (MENDED_SHARE * before).min(PLAUSIBLE_SHARE * spread);
    let tried = all_tried(part, values, share);
    if let Some((problem, mends, _)) = named(&tried, [share, before], most) {
        let proved = as_it_stands::predicts(part, values, &mends, [share, most]);
        return if proved { vec![problem] } else { Vec::new() };
    }
    let mut nearest: Vec<&TriedChange> = tried.iter().filter(|t| t.left_mm < before).collect();
    nearest.sort_by(|a, b| a.left_mm.total_cmp(&b.left_mm));
    let mut best: Option<(f64, [DataProblem; 2])> = None;
    for first in nearest.into_iter().take(MOST_PAIRED) {
        let [mend] = first.change.mends.as_slice() else {
            continue;
        };
        let mut without = part.clone();
        mend.apply(&mut without);
        let all = all_tried(&without, values, share);
        let Some((second, mends, left)) = named(&all, [share, before], most) else {
            continue;
        };
        if !as_it_stands::predicts(&without, values, &mends, [share, most]) {
            continue;
        }
        if best.as_ref().is_none_or(|b| left < b.0) {
            let of_first = problem_of(&first.change, &[], [share, before], first.left_mm);
            best = Some((left, [of_first, second]));
        }
    }
    match best {
        Some((_, two)) => two.into(),
        None if share == HALF => many(part, values, before, most),
        None => Vec::new(),
    }
}

/// Conventions that differ in many joints at once, each as a mistake of its own.
fn many(part: &Session, values: JointValues, before: f64, most: f64) -> Vec<DataProblem> {
    let changes = several(part, values, most);
    let mends: Vec<SessionCorrection> = changes
        .iter()
        .flat_map(|change| change.mends.iter().cloned())
        .collect();
    let mut corrected = part.clone();
    for mend in &mends {
        mend.apply(&mut corrected);
    }
    let Some(end) = trial(&corrected, values, true).filter(|_| !changes.is_empty()) else {
        return Vec::new();
    };
    let after = end.median_mm();
    let believed = after <= most
        && as_it_stands::is_plausible(&corrected, &end.model)
        && as_it_stands::predicts(part, values, &mends, [HALF, most]);
    if !believed {
        return Vec::new();
    }
    let count = changes.len();
    let problem = |change: Change| DataProblem {
        what: change.what,
        evidence: text!(
            "with the frame, the tool and the zero offsets fitted the median error is {before} as it stands and {after} with all {count} set-up errors corrected",
            before = median(before),
            after = length(after, 3),
            count
        ),
        proposal: change.proposal,
        mend: change.mends.into_iter().next(),
        samples: Vec::new(),
    };
    changes.into_iter().map(problem).collect()
}

/// A median error in words; it is infinite where nothing fits.
fn median(left_mm: f64) -> Text {
    if left_mm.is_finite() {
        length(left_mm, 3)
    } else {
        text!("far beyond what a fit could explain")
    }
}

/// Every change that ends where a robot may be.
fn all_tried(part: &Session, values: JointValues, share: f64) -> Vec<TriedChange> {
    let spread = spread_mm(part);
    let all = changes(part, values).into_iter().filter_map(|change| {
        let mut trial_of = part.clone();
        for mend in &change.mends {
            mend.apply(&mut trial_of);
        }
        // One coordinate that is too small leaves the others as they are: no robot follows it.
        let of_one = change.mends.iter().any(is_of_one_coordinate);
        if !of_one && !as_it_stands::is_to_scale(part, &trial_of, values) {
            return None;
        }
        let end = trial(&trial_of, values, true)?;
        let left = end.within_mm(share);
        if !as_it_stands::is_plausible(&trial_of, &end.model) {
            return None;
        }
        let scale = change_of_measure(&change.mends, spread, spread_mm(&trial_of));
        Some(TriedChange {
            change,
            left_mm: left * scale,
        })
    });
    all.collect()
}

/// The change that leaves least, if that is little enough, with those that say the same; and what it
/// leaves, mm, behind the changes.
fn named(
    tried: &[TriedChange],
    [share, before]: [f64; 2],
    most: f64,
) -> Option<(DataProblem, Vec<SessionCorrection>, f64)> {
    let least = tried
        .iter()
        .map(|t| t.left_mm)
        .fold(f64::INFINITY, f64::min);
    if least > most {
        return None;
    }
    // The list begins with what is simplest.
    let main = tried
        .iter()
        .find(|t| t.left_mm <= EQUAL * least && t.change.mends.len() == 1)?;
    let same = |t: &&TriedChange| t.left_mm <= ALIKE * least && t.change.what != main.change.what;
    let twins: Vec<&Text> = tried.iter().filter(same).map(|t| &t.change.what).collect();
    let problem = problem_of(&main.change, &twins, [share, before], main.left_mm);
    Some((problem, main.change.mends.clone(), main.left_mm))
}

fn problem_of(
    change: &Change,
    twins: &[&Text],
    [share, before]: [f64; 2],
    after: f64,
) -> DataProblem {
    let what = if twins.is_empty() {
        change.what.clone()
    } else {
        text!(
            "{what}; in these samples the same as: {others}",
            what = &change.what,
            others = Text::listed(twins.iter().copied(), "; ")
        )
    };
    DataProblem {
        what,
        evidence: if share == HALF {
            text!(
                "with the frame, the tool and the zero offsets fitted the median error is {before} as it stands and {after} with the set-up error corrected",
                before = median(before),
                after = length(after, 3)
            )
        } else {
            text!(
                "with the frame, the tool and the zero offsets fitted a tenth of the samples are off by more than {before} as it stands and {after} with the set-up error corrected",
                before = median(before),
                after = length(after, 3)
            )
        },
        proposal: change.proposal.clone(),
        mend: change.mends.first().cloned(),
        samples: Vec::new(),
    }
}

/// A measuring frame that was not aligned, where the session has no free one.
fn never_aligned(part: &Session, values: JointValues) -> Option<DataProblem> {
    if part.samples.setups.is_some() || part.samples.z_mm.is_none() {
        return None;
    }
    let free = trial(part, values, true)?;
    let adjusted = trial(part, values, false).map_or(f64::INFINITY, |t| t.median_mm());
    let fixed = adjusted.min(as_it_stands::least_mm(part, values, false, HALF));
    let is_frame = |t: &&Term| t.effect.about().setting == Setting::Setup;
    let frame = free.model.terms().iter().find(is_frame)?;
    let turn = Vector3::from_column_slice(&frame.coefficients[..3]);
    let shift = Vector3::from_column_slice(&frame.coefficients[3..]);
    let far = turn.norm() > rad_from_deg(LEAST_TURN_DEG) || shift.norm() > LEAST_MOVE_MM;
    let gross = fixed > GROSS_SHARE * spread_mm(part);
    if !far || !gross || free.median_mm() > MENDED_SHARE * fixed {
        return None;
    }
    let first = &part.robot.joints[0];
    let axis = first.axis.direction.into_inner();
    let about_axis = turn.norm() > rad_from_deg(LEAST_TURN_DEG)
        && turn.cross(&axis).norm() < 0.02 * turn.norm()
        && first.kind == JointKind::Revolute
        && {
            // Where the motion takes a point of the axis, across it.
            let point = first.axis.point_mm.coords;
            let to = nalgebra::Rotation3::new(turn) * point + shift;
            (to - point).cross(&axis).norm() < LEAST_MOVE_MM
        };
    let degrees = deg_from_rad(turn.norm());
    let never = text!("the measuring frame was never aligned with the robot's base");
    Some(DataProblem {
        what: if about_axis {
            text!(
                "{what}; in these samples the same as: {others}",
                what = never,
                others = text!(
                    "the home position of joint {joint} is off by {turn}",
                    joint = 1,
                    turn = format!("{degrees:.2}°")
                )
            )
        } else {
            never
        },
        evidence: if fixed.is_finite() {
            text!(
                "the median error is {fixed} as it stands and {free} with the frame fitted",
                fixed = length(fixed, 3),
                free = length(free.median_mm(), 3)
            )
        } else {
            text!(
                "no geometry fits the samples as they stand; with the frame fitted the median error is {free}",
                free = length(free.median_mm(), 3)
            )
        },
        proposal: text!(
            "align the instrument (turned by {turn}, moved by {shift}), or give the samples a `setup` column so that the frame is fitted",
            turn = format!("{degrees:.2}°"),
            shift = format!("{:.2}, {:.2}, {:.2} mm", shift.x, shift.y, shift.z)
        ),
        mend: Some(SessionCorrection::FreeFrame),
        samples: Vec::new(),
    })
}
