//! Blunders of setting up, tried before any effect: on a real arm with a tracker they were worth
//! more than any effect, and faked one.
//!
//! A blunder is a hypothesis about the data: the session is changed as the blunder would have it,
//! the base fit is made again, and the change is believed if the gap falls to a small part of
//! what it was and only then makes sense for a robot. The search goes on with the mended session.

use std::borrow::Cow;

use nalgebra::{Isometry3, Vector3};

use crate::effects::{JointValues, Term, find};
use crate::identification::alignment::best_rigid_motion;
use crate::identification::gap::deviations;
use crate::identification::problem::{Problem, unusable};
use crate::identification::solver::solve;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::sessions::{Samples, Session, Setups};
use crate::units::{deg_from_rad, rad_from_deg};

use super::{Mend, Options};

/// A mistake in the data, its evidence, and how to mend it.
#[derive(Debug, Clone, PartialEq)]
pub struct DataProblem {
    /// What is wrong.
    pub what: String,
    /// What speaks for it.
    pub evidence: String,
    /// What to do.
    pub proposal: String,
    /// The same as a change of the session, where that is mechanical.
    pub mend: Option<Mend>,
    /// The samples that it is about, counted from 0; empty where it is about all of them.
    pub samples: Vec<usize>,
}

/// A session with its blunders mended, and what they were.
#[derive(Debug, Clone)]
pub struct Mended<'a> {
    /// The session to go on with.
    pub session: Cow<'a, Session>,
    /// What was wrong.
    pub problems: Vec<DataProblem>,
}

/// Samples that a trial looks at.
const MOST_SAMPLES: usize = 400;
/// With fewer samples a blunder cannot be told from an effect.
const FEWEST_SAMPLES: usize = 6;
/// A gap below this share of the robot's size is no blunder.
const GROSS_SHARE: f64 = 0.01;
/// The gap has to fall to less than this.
const MENDED_SHARE: f64 = 0.2;

/// Tries the blunders and mends what it finds.
pub fn mend<'a>(session: &'a Session, options: &Options) -> Mended<'a> {
    let mut problems = Vec::new();
    losses(session, &mut problems);
    lagging_read_back(session, &mut problems);
    let mut mended: Cow<'a, Session> = Cow::Borrowed(session);
    // One blunder may hide another: at most two in a row.
    for _ in 0..2 {
        let Some((better, problem)) = gross_blunder(&mended, options) else {
            break;
        };
        problems.push(problem);
        mended = Cow::Owned(better);
    }
    mislocked(&mended, options, &mut problems);
    Mended {
        session: mended,
        problems,
    }
}

/// A hypothesis: what is wrong, what to do, and how the data would read without it.
struct Hypothesis {
    what: String,
    proposal: String,
    mend: Mend,
}

fn gross_blunder(session: &Session, options: &Options) -> Option<(Session, DataProblem)> {
    let sample = thinned(session);
    if sample.samples.len() < FEWEST_SAMPLES {
        return None;
    }
    let gap = base_gap(&sample, options)?;
    let size = size_mm(&sample);
    if gap < GROSS_SHARE * size {
        return None;
    }
    let mut best: Option<(f64, Hypothesis)> = None;
    for hypothesis in hypotheses(&sample) {
        let mut trial = sample.clone();
        hypothesis.mend.apply(&mut trial);
        let Some(after) = base_gap(&trial, options) else {
            continue;
        };
        // A change of unit changes the measure as well.
        let after = after * (size / size_mm(&trial).max(1e-12)).min(1.0);
        if after < MENDED_SHARE * gap && best.as_ref().is_none_or(|b| after < 0.8 * b.0) {
            best = Some((after, hypothesis));
        }
    }
    let (after, hypothesis) = best?;
    let mut better = session.clone();
    hypothesis.mend.apply(&mut better);
    let problem = DataProblem {
        evidence: format!(
            "with zero offset and link length fitted the gap is {gap:.3} mm as it stands and {after:.3} mm without the mistake"
        ),
        what: hypothesis.what,
        proposal: hypothesis.proposal,
        mend: Some(hypothesis.mend),
        samples: Vec::new(),
    };
    Some((better, problem))
}

/// The session's tool distance or the spread of its points, whichever is larger, mm.
fn size_mm(session: &Session) -> f64 {
    let samples = &session.samples;
    let square = |i: usize| {
        let z = samples.z_mm.as_ref().map_or(0.0, |z| z[i]);
        samples.x_mm[i].powi(2) + samples.y_mm[i].powi(2) + z * z
    };
    let all: Vec<f64> = (0..samples.len())
        .map(square)
        .filter(|v| v.is_finite())
        .collect();
    (all.iter().sum::<f64>() / all.len().max(1) as f64).sqrt()
}

/// Median length of the deviations after the base fit, mm. A zero offset beyond
/// [`LARGEST_OFFSET_DEG`] counts as a gap: a joint that reversed with its home a quarter turn off
/// would pass for two axes that were swapped.
fn base_gap(session: &Session, options: &Options) -> Option<f64> {
    let problem = Problem::new(session, options.joint_values);
    let mut terms = Vec::new();
    for joint in 0..session.robot.joints.len() {
        terms.push(Term::absent(find("joint-zero-offset")?, joint, 0.0));
    }
    if let [joint] = session.robot.joints.as_slice()
        && joint.kind == JointKind::Revolute
    {
        terms.push(Term::absent(find("link-length")?, 0, 0.0));
    }
    terms.extend(crate::identification::free_frames(session, &problem));
    let start = Model::new(session.robot.clone(), terms);
    let fitted = solve(&problem, &start);
    let after = deviations(&problem, &fitted.model);
    let mut lengths: Vec<f64> = after
        .length_mm
        .iter()
        .copied()
        .filter(|v| v.is_finite())
        .collect();
    lengths.sort_by(f64::total_cmp);
    let median = lengths.get(lengths.len() / 2).copied()?;
    let offsets = fitted
        .model
        .terms()
        .iter()
        .filter(|t| t.effect.about().id == "joint-zero-offset");
    let largest = offsets
        .filter(|t| session.robot.joints[t.joint].kind == JointKind::Revolute)
        .map(|t| t.coefficients[0].sin().atan2(t.coefficients[0].cos()).abs())
        .fold(0.0, f64::max);
    let beyond = (largest - rad_from_deg(LARGEST_OFFSET_DEG)).max(0.0);
    Some(median + beyond * size_mm(session))
}

/// No joint is calibrated with a zero offset larger than this; its home is a quarter turn off.
const LARGEST_OFFSET_DEG: f64 = 45.0;

#[allow(
    clippy::too_many_lines,
    reason = "a list of hypotheses reads best in one piece"
)]
fn hypotheses(session: &Session) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    let mut push = |what: String, proposal: String, mend: Mend| {
        all.push(Hypothesis {
            what,
            proposal,
            mend,
        });
    };
    for joint in 0..session.robot.joints.len() {
        let number = joint + 1;
        push(
            format!("joint {number} counts the other way round"),
            format!(
                "reverse the sign of joint {number} in the robot's description or in the samples"
            ),
            Mend::ScaleJoint {
                joint,
                factor: -1.0,
            },
        );
        if session.robot.joints[joint].kind != JointKind::Revolute {
            continue;
        }
        for (factor, what) in [
            (rad_from_deg(1.0), "are in degrees but were read as radians"),
            (deg_from_rad(1.0), "are in radians but were read as degrees"),
        ] {
            push(
                format!("the values of joint {number} {what}"),
                format!("correct the unit in the heading of q{number}"),
                Mend::ScaleJoint { joint, factor },
            );
        }
        for turn in [90.0, -90.0, 180.0] {
            push(
                format!("the home position of joint {number} is off by {turn}°"),
                format!("add {turn}° to joint {number} at home, or home the joint again"),
                Mend::TurnHome {
                    joint,
                    by_rad: rad_from_deg(turn),
                },
            );
        }
    }
    let units = [
        (1000.0, "in metres but were read as millimetres"),
        (0.001, "in micrometres or were multiplied by 1000"),
        (25.4, "in inches but were read as millimetres"),
        (1.0 / 25.4, "in millimetres but were read as inches"),
    ];
    for (factor, what) in units {
        push(
            format!("the measured coordinates are {what}"),
            "correct the unit in the headings of x, y and z".to_owned(),
            Mend::ScaleLengths(factor),
        );
    }
    if session.samples.z_mm.is_some() {
        for (order, what) in [
            ([1, 0, 2], "x and y"),
            ([0, 2, 1], "y and z"),
            ([2, 1, 0], "x and z"),
            ([1, 2, 0], "x, y and z (read as y, z, x)"),
            ([2, 0, 1], "x, y and z (read as z, x, y)"),
        ] {
            push(
                format!("the measured axes {what} are swapped"),
                "exchange the headings of the measured columns".to_owned(),
                Mend::Reorder(order),
            );
        }
    } else {
        push(
            "the measured axes x and y are swapped".to_owned(),
            "exchange the headings of the measured columns".to_owned(),
            Mend::Reorder([1, 0, 2]),
        );
    }
    if let Some(frame) = misaligned_frame(session) {
        let t = frame.translation.vector;
        let turn = deg_from_rad(frame.rotation.angle());
        push(
            "the measuring frame was never aligned with the robot's base".to_owned(),
            format!(
                "align the instrument (turned by {turn:.2}°, moved by {:.2}, {:.2}, {:.2} mm), or give the samples a `setup` column so that the frame is fitted",
                t.x, t.y, t.z
            ),
            Mend::FreeFrame,
        );
    }
    all
}

/// The rigid motion between the robot and the measurement, where the frame is not fitted anyway
/// and the motion is too large for an effect.
fn misaligned_frame(session: &Session) -> Option<Isometry3<f64>> {
    if session.samples.setups.is_some() {
        return None;
    }
    let problem = Problem::new(session, JointValues::Commanded);
    let zero = find("joint-zero-offset")?;
    let terms = (0..session.robot.joints.len()).map(|j| Term::absent(zero, j, 0.0));
    let start = Model::new(session.robot.clone(), terms.collect());
    let fitted = solve(&problem, &start).model;
    let predicted = fitted.predict(&problem.inputs);
    let motion = best_rigid_motion(session, &predicted, |i| problem.usable[i])?;
    let turned = motion.rotation.angle() > rad_from_deg(LEAST_TURN_DEG);
    let moved = motion.translation.vector.norm() > LEAST_MOVE_MM;
    (turned || moved).then_some(motion)
}

/// Ten times what is usual for a tilt or an offset of the base.
const LEAST_TURN_DEG: f64 = 1.5;
const LEAST_MOVE_MM: f64 = 60.0;

/// Every so many-th sample, so that a trial is quick.
fn thinned(session: &Session) -> Session {
    let n = session.samples.len();
    let keep: Vec<usize> = if n <= MOST_SAMPLES {
        (0..n).collect()
    } else {
        (0..MOST_SAMPLES).map(|k| k * n / MOST_SAMPLES).collect()
    };
    let old = &session.samples;
    let pick = |c: &Vec<f64>| -> Vec<f64> { keep.iter().map(|i| c[*i]).collect() };
    let each = |c: &[Option<Vec<f64>>]| c.iter().map(|c| c.as_ref().map(pick)).collect();
    let samples = Samples {
        q: old.q.iter().map(pick).collect(),
        q_read: each(&old.q_read),
        x_mm: pick(&old.x_mm),
        y_mm: pick(&old.y_mm),
        z_mm: old.z_mm.as_ref().map(pick),
        target: old
            .target
            .as_ref()
            .map(|t| keep.iter().map(|i| t[*i]).collect()),
        dir: each(&old.dir),
        speed: each(&old.speed),
        setups: old.setups.as_ref().map(|s| Setups {
            names: s.names.clone(),
            index: keep.iter().map(|i| s.index[*i]).collect(),
        }),
        ..Samples::default()
    };
    // Field by field: a clone of the whole would copy a million samples first.
    Session {
        name: String::new(),
        note: String::new(),
        robot: session.robot.clone(),
        targets: session.targets.clone(),
        instrument: session.instrument.clone(),
        tolerance_mm: session.tolerance_mm,
        regions: Vec::new(),
        compensated_by: None,
        samples,
        path: None,
    }
}

/// Samples where the instrument lost the reflector.
fn losses(session: &Session, problems: &mut Vec<DataProblem>) {
    use crate::identification::problem::Unusable;
    let lost: Vec<usize> = (0..session.samples.len())
        .filter(|i| unusable(session, *i) == Some(Unusable::LostReflector))
        .collect();
    if lost.is_empty() {
        return;
    }
    problems.push(DataProblem {
        what: format!("the instrument lost the reflector in {}", listed(&lost)),
        evidence: "it wrote 0, 0, 0".to_owned(),
        proposal: "these samples are left out; measure them again".to_owned(),
        mend: Some(Mend::Remove(lost.clone())),
        samples: lost,
    });
}

/// Samples that are far off and lie where another reflector is, or all at one place.
fn mislocked(session: &Session, options: &Options, problems: &mut Vec<DataProblem>) {
    if session.samples.len() > 20_000 || session.samples.len() < 8 {
        return;
    }
    let mut problem = Problem::new(session, options.joint_values);
    let terms = find("joint-zero-offset").map(|e| Term::absent(e, 0, 0.0));
    let start = Model::new(session.robot.clone(), terms.into_iter().collect());
    let fitted = crate::identification::fit_without_outliers(&mut problem, &start).model;
    let off: Vec<usize> = (0..problem.fit.len())
        .filter(|i| problem.fit[*i] && !problem.used[*i])
        .collect();
    if off.is_empty() || off.len() * 3 > problem.fit.len() {
        return;
    }
    let samples = &session.samples;
    let at = |i: usize| {
        let z = samples.z_mm.as_ref().map_or(0.0, |z| z[i]);
        Vector3::new(samples.x_mm[i], samples.y_mm[i], z)
    };
    for other in 0..session.targets.len() {
        let mut inputs = problem.inputs.clone();
        let n = inputs.len();
        let number = u32::try_from(other).unwrap_or(0);
        inputs.target = Some(Cow::Owned(vec![number; n]));
        let elsewhere = fitted.predict(&inputs);
        let here = |i: usize| problem.inputs.target.as_ref().map_or(0, |t| t[i]) != number;
        let close: Vec<usize> = off
            .iter()
            .copied()
            .filter(|i| here(*i) && (at(*i) - Vector3::from(elsewhere.get(*i))).norm() < 3.0)
            .collect();
        if !close.is_empty() {
            let name = &session.targets[other].name;
            problems.push(DataProblem {
                what: format!(
                    "the instrument saw reflector {name} instead in {}",
                    listed(&close)
                ),
                evidence: format!("the points lie where {name} should be"),
                proposal: "these samples are left out; correct their target or measure them again"
                    .to_owned(),
                mend: Some(Mend::Remove(close.clone())),
                samples: close,
            });
        }
    }
    // The same point again and again while the robot moves.
    let stuck: Vec<usize> = off
        .iter()
        .copied()
        .filter(|i| {
            let same = off.iter().filter(|j| (at(**j) - at(*i)).norm() < 0.5);
            same.count() >= 3
        })
        .collect();
    if !stuck.is_empty() {
        problems.push(DataProblem {
            what: format!(
                "the instrument was locked on a point that does not move in {}",
                listed(&stuck)
            ),
            evidence: "the measured point stays while the robot moves".to_owned(),
            proposal: "these samples are left out; measure them again".to_owned(),
            mend: Some(Mend::Remove(stuck.clone())),
            samples: stuck,
        });
    }
}

/// A read-back that lags the command in proportion to the speed.
fn lagging_read_back(session: &Session, problems: &mut Vec<DataProblem>) {
    let samples = &session.samples;
    for joint in 0..samples.q.len() {
        let Some(read) = &samples.q_read[joint] else {
            continue;
        };
        let pairs = |by: &[f64]| -> Vec<(f64, f64)> {
            (0..read.len())
                .map(|i| (by[i], read[i] - samples.q[joint][i]))
                .filter(|(v, e)| v.is_finite() && e.is_finite() && *v != 0.0)
                .collect()
        };
        let by_speed = samples.speed[joint].as_ref().map(|v| (pairs(v), "speed"));
        let by_side = samples.dir[joint].as_ref().map(|v| (pairs(v), "side"));
        let found = by_speed.into_iter().chain(by_side).find_map(|(pairs, by)| {
            let (slope, t) = slope_through_zero(&pairs)?;
            (slope < 0.0 && t > 5.0).then_some((slope, by, pairs.len()))
        });
        let Some((slope, by, count)) = found else {
            continue;
        };
        let number = joint + 1;
        let size = if by == "speed" {
            format!("{:.2} ms", -1000.0 * slope)
        } else {
            format!("{:.4}° towards the side it came from", -deg_from_rad(slope))
        };
        problems.push(DataProblem {
            what: format!("the values read back from joint {number} lag the command by {size}"),
            evidence: format!("read − commanded follows the {by} over {count} samples"),
            proposal: format!(
                "read joint {number} back at standstill; with --joint-values read the lag looks like backlash"
            ),
            mend: None,
            samples: Vec::new(),
        });
    }
}

/// Slope of a line through zero, and its t value.
fn slope_through_zero(pairs: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = pairs.len();
    if n < 8 {
        return None;
    }
    let xx: f64 = pairs.iter().map(|p| p.0 * p.0).sum();
    let xy: f64 = pairs.iter().map(|p| p.0 * p.1).sum();
    let slope = xy / xx;
    let left: f64 = pairs.iter().map(|p| (p.1 - slope * p.0).powi(2)).sum();
    let error = (left / (n - 1) as f64 / xx).sqrt();
    Some((slope, slope.abs() / error.max(1e-300)))
}

/// Sample numbers for reading, counted from 1.
fn listed(samples: &[usize]) -> String {
    let first: Vec<String> = samples
        .iter()
        .take(8)
        .map(|i| (i + 1).to_string())
        .collect();
    let more = samples.len().saturating_sub(8);
    let noun = if samples.len() == 1 {
        "sample"
    } else {
        "samples"
    };
    if more > 0 {
        format!("{noun} {} and {more} more", first.join(", "))
    } else {
        format!("{noun} {}", first.join(", "))
    }
}
