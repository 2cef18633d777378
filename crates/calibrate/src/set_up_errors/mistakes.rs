//! Set-up errors that hold for all rows, each with its joint.
//!
//! A trial fits what would be adjusted when a robot is mounted ([`trial`]), and compares the median error. A change of
//! the samples that reduces it to a small part, and to what the geometry of a robot may explain, corrects a mistake.
//! Changes that do so equally well are reported together: the sign of a spherical wrist's middle joint is equivalent
//! to both neighbours' homes by 180°, the sign of a positioner's first joint to the home of the second, the home of
//! joint 1 to the measuring frame.
//!
//! Trials run away where few poses determine what they fit, and then anything is better. So the uncorrected session is
//! also compared with the nominal robot with the best rigid motion, and with the whole base model with its priors; the
//! best of all counts. A change keeps the samples to the robot's scale, ends with values that a robot may have, and
//! predicts samples that it was not fitted to.

use nalgebra::{Rotation3, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::answers::far_tool::farthest_tool_mm;
use crate::effects::{JointValues, MEASURING_FRAME, Role, Setting, Term};
use crate::fit::base_model;
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::numeric::extent;
use crate::sessions::{Session, SessionCorrection};
use crate::text::{Text, length};
use crate::units::{deg_from_rad, rad_from_deg};

use super::changes::{Change, changes, frame_is_free, is_of_one_coordinate};
use super::fits::{is_small_turn, share_within, thinned, trial};
use super::nearest::Nominal;
use super::several::several;
use super::thresholds::{
    CORRECTED_SHARE, EQUAL, FEWEST_SAMPLES, HALF, NEARLY_ALL, PLAUSIBLE_SHARE, size_mm,
};

/// Samples that a trial looks at.
const MOST_SAMPLES: usize = 120;
/// A median error below this share of the spread of the points, or of the robot's reach, is no mistake of setting up.
const GROSS_SHARE: f64 = 0.005;
/// A residual of at most so many times the best counts as equivalent in these samples.
const ALIKE: f64 = 1.25;
/// Where no mistake alone explains the samples, so many of the best are tried in pairs.
const MOST_PAIRED: usize = 5;
/// The spread of the points agrees with that of the robot within this, as a ratio.
const TO_SCALE: f64 = 2.0;
/// With fewer samples none can be held out.
const FEWEST_TO_SPLIT: usize = 24;
/// Held-out samples may have residuals of at most so many times the limit of a change.
const UNSEEN: f64 = 2.0;
/// Ten times what is usual for a tilt or an offset of the base.
const LEAST_TURN_DEG: f64 = 1.5;
const LEAST_MOVE_MM: f64 = 60.0;

/// The mistake that explains the samples, or those that do so together; else a frame that nobody aligned.
pub(super) fn of_all_rows(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let part = thinned(session, MOST_SAMPLES);
    if part.samples.len() < FEWEST_SAMPLES.max(session.robot.joints.len() + 4) {
        return Vec::new();
    }
    let found = [HALF, NEARLY_ALL]
        .into_iter()
        .filter_map(|share| Some(Judge::of(&part, values, share)?.likeliest()))
        .find(|found| !found.is_empty());
    found.unwrap_or_else(|| never_aligned(&part, values).into_iter().collect())
}

/// A session with these changes.
fn changed(part: &Session, corrections: &[SessionCorrection]) -> Session {
    let mut changed = part.clone();
    for correction in corrections {
        correction.apply(&mut changed);
    }
    changed
}

/// By how much the points are spread less widely than in the uncorrected session.
fn shrunk(part: &Session, changed: &Session) -> f64 {
    part.samples.spread_mm() / changed.samples.spread_mm().max(1e-12)
}

/// A change and the error of the compared share of the samples with it, in the units of the uncorrected samples, mm.
type Tried = (Change, f64);

/// What a change has to do for belief.
struct Judge<'a> {
    part: &'a Session,
    values: JointValues,
    /// The share of the samples that is compared.
    share: f64,
    /// The error of the uncorrected samples, and the largest error after a change, mm.
    before_mm: f64,
    most_mm: f64,
    /// Whether the nominal robot moves its points along x, y, z by more than it may be off.
    moves: [bool; 3],
}

impl<'a> Judge<'a> {
    /// `None` where nothing is wrong.
    fn of(part: &'a Session, values: JointValues, share: f64) -> Option<Self> {
        let spread = part.samples.spread_mm();
        let gross = GROSS_SHARE * spread.max(size_mm(part));
        let before_mm = least_mm(part, values, frame_is_free(part), share, gross);
        (before_mm >= gross).then(|| Self {
            part,
            values,
            share,
            before_mm,
            most_mm: (CORRECTED_SHARE * before_mm).min(PLAUSIBLE_SHARE * spread),
            moves: nominal_mm(part, values).map(|along| {
                let [low, high] = extent(&along);
                high - low > GROSS_SHARE * size_mm(part)
            }),
        })
    }

    /// The change that explains the samples, or the two, or many.
    fn likeliest(&self) -> Vec<DataProblem> {
        let tried = self.tried(self.part);
        if let Some((_, corrections, problem)) = self.named(&tried) {
            return if self.predicts(self.part, &corrections) {
                vec![problem]
            } else {
                Vec::new()
            };
        }
        let single = tried.iter().filter(|(change, residual_mm)| {
            *residual_mm < self.before_mm && change.corrections.len() == 1
        });
        let mut nearest: Vec<&Tried> = single.collect();
        nearest.sort_by(|a, b| a.1.total_cmp(&b.1));
        let with_another = |(first, residual_mm): &Tried| {
            let without = changed(self.part, &first.corrections);
            let (least, corrections, second) = self.named(&self.tried(&without))?;
            let both = vec![self.problem(first, &[], *residual_mm), second];
            self.predicts(&without, &corrections)
                .then_some((least, both))
        };
        let pairs = nearest
            .into_iter()
            .take(MOST_PAIRED)
            .filter_map(with_another);
        match pairs.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((_, both)) => both,
            None if self.share == HALF && base_model::is_arm(self.part) => self.many(),
            None => Vec::new(),
        }
    }

    /// Every change that ends where a robot may be.
    fn tried(&self, part: &Session) -> Vec<Tried> {
        let all = changes(part, self.values).into_iter().filter_map(|change| {
            let then = changed(part, &change.corrections);
            // One coordinate that is too small does not change the others: no robot follows it.
            let of_one = change.corrections.iter().any(is_of_one_coordinate);
            if !of_one && !is_to_scale(part, &then, self.values) {
                return None;
            }
            // What no motion changes has no unit that shows.
            let still = |correction: &SessionCorrection| match correction {
                SessionCorrection::ScaleCoordinate { axis, .. } => !self.moves[*axis],
                _ => false,
            };
            if change.corrections.iter().any(still) {
                return None;
            }
            let end = trial(&then, self.values, frame_is_free(part))?;
            if !is_plausible(&then, &end.model) {
                return None;
            }
            // Where the points become larger, the measure does. One coordinate counts in units of all also where it
            // becomes smaller: a slide along an axis whose coordinate shrinks to nothing is explained by anything.
            let most = if of_one { f64::INFINITY } else { 1.0 };
            Some((
                change,
                end.within_mm(self.share) * shrunk(part, &then).min(most),
            ))
        });
        all.collect()
    }

    /// The change with the smallest residual, if that is small enough, with the equivalent ones; before it the
    /// residual, mm.
    fn named(&self, tried: &[Tried]) -> Option<(f64, Vec<SessionCorrection>, DataProblem)> {
        let least = tried.iter().map(|t| t.1).min_by(f64::total_cmp)?;
        if least > self.most_mm {
            return None;
        }
        // The list begins with the simplest.
        let (main, residual_mm) = tried
            .iter()
            .find(|(c, residual_mm)| *residual_mm <= EQUAL * least && c.corrections.len() == 1)?;
        let same = |(c, residual_mm): &&Tried| *residual_mm <= ALIKE * least && c.what != main.what;
        let twins: Vec<Text> = tried
            .iter()
            .filter(same)
            .map(|(c, _)| c.what.clone())
            .collect();
        Some((
            *residual_mm,
            main.corrections.clone(),
            self.problem(main, &twins, *residual_mm),
        ))
    }

    fn problem(&self, change: &Change, twins: &[Text], after_mm: f64) -> DataProblem {
        let (before, after) = (in_words(self.before_mm), length(after_mm, 3));
        DataProblem::of_all(
            Change::with_equivalents(change.what.clone(), twins),
            if self.share == HALF {
                text!(
                    "with the frame, the tool and the zero offsets fitted the median error is {before} as it stands and {after} with the set-up error corrected",
                    before,
                    after
                )
            } else {
                text!(
                    "with the frame, the tool and the zero offsets fitted a tenth of the samples are off by more than {before} as it stands and {after} with the set-up error corrected",
                    before,
                    after
                )
            },
            change.proposal.clone(),
            change.corrections.first().cloned(),
        )
    }

    /// Conventions that differ in many joints at once, each as a separate mistake.
    fn many(&self) -> Vec<DataProblem> {
        let changes = several(self.part, self.values, self.most_mm);
        let corrections: Vec<SessionCorrection> =
            changes.iter().flat_map(|c| c.corrections.clone()).collect();
        let corrected = changed(self.part, &corrections);
        let end = trial(&corrected, self.values, true).filter(|end| {
            end.within_mm(HALF) <= self.most_mm && is_plausible(&corrected, &end.model)
        });
        let Some(end) =
            end.filter(|_| !corrections.is_empty() && self.predicts(self.part, &corrections))
        else {
            return Vec::new();
        };
        let evidence = text!(
            "with the frame, the tool and the zero offsets fitted the median error is {before} as it stands and {after} with all {count} set-up errors corrected",
            before = in_words(self.before_mm),
            after = length(end.within_mm(HALF), 3),
            count = changes.len()
        );
        let problem = |change: Change| {
            let correction = change.corrections.into_iter().next();
            DataProblem::of_all(change.what, evidence.clone(), change.proposal, correction)
        };
        changes.into_iter().map(problem).collect()
    }

    /// Whether a change predicts samples that its trial has not seen, the compared share of them to within its limit.
    fn predicts(&self, part: &Session, corrections: &[SessionCorrection]) -> bool {
        let changed = changed(part, corrections);
        let n = changed.samples.len();
        if n < FEWEST_TO_SPLIT {
            return true;
        }
        let half = |odd: usize| {
            let rows = (odd..n).step_by(2).map(Some);
            changed.of_rows(&rows.collect::<Vec<_>>())
        };
        let unseen = half(1);
        trial(&half(0), self.values, frame_is_free(part)).is_some_and(|end| {
            let residual_mm = lengths_mm(&Problem::new(&unseen, self.values), &end.model);
            // The limit is in the units of the uncorrected samples.
            let scale = (1.0 / shrunk(part, &changed)).max(1.0);
            share_within(residual_mm, self.share) <= UNSEEN * self.most_mm * scale
        })
    }
}

/// A median error in words; it is infinite where nothing fits.
fn in_words(residual_mm: f64) -> Text {
    if residual_mm.is_finite() {
        length(residual_mm, 3)
    } else {
        text!("far beyond what a fit could explain")
    }
}

/// The least error of so large a share of the uncorrected samples, mm; infinite where nothing fits. Once it is small
/// enough no further fit is tried.
fn least_mm(
    part: &Session,
    values: JointValues,
    free_frame: bool,
    share: f64,
    enough_mm: f64,
) -> f64 {
    let adjusted = trial(part, values, free_frame).map_or(f64::INFINITY, |t| t.within_mm(share));
    if adjusted < enough_mm {
        return adjusted;
    }
    let moved = free_frame || part.samples.setups.is_some();
    let nominal = share_within(Nominal::of(part, values).lengths_mm(moved), share);
    adjusted
        .min(nominal)
        .min(with_priors_mm(part, values, moved, share))
}

/// The same with an arm's whole base model and its priors; infinite for points of another size than the robot's:
/// shrinking links fit those whatever the robot is.
fn with_priors_mm(part: &Session, values: JointValues, free_frame: bool, share: f64) -> f64 {
    if !base_model::is_arm(part) || !has_the_robots_size(part, values) {
        return f64::INFINITY;
    }
    let mut problem = Problem::new(part, values);
    let frame = MEASURING_FRAME.about().id;
    let start = base_model::start(part, &problem, |id| free_frame || id != frame);
    let model = base_model::fit(&mut problem, &start, true).solution.model;
    if is_plausible(part, &model) {
        share_within(lengths_mm(&problem, &model), share)
    } else {
        f64::INFINITY
    }
}

/// Whether the zero offsets and the tool of a model are those of a robot that was set up.
fn is_plausible(session: &Session, model: &Model) -> bool {
    let most = farthest_tool_mm(&session.robot);
    model
        .terms()
        .iter()
        .all(|term| match term.effect.about().role {
            Role::JointZero => is_small_turn(session, term),
            Role::ToolPlace => Vector3::from_column_slice(&term.coefficients[..3]).norm() <= most,
            _ => true,
        })
}

/// Whether a change that scales the samples brings them to the size of the robot, which they do not have
/// as they are.
fn is_to_scale(part: &Session, changed: &Session, values: JointValues) -> bool {
    let is_scaled = shrunk(part, changed).ln().abs() > 0.01;
    !is_scaled || has_the_robots_size(changed, values) && !has_the_robots_size(part, values)
}

/// Where the nominal robot has the points.
fn nominal_mm(session: &Session, values: JointValues) -> [Vec<f64>; 3] {
    let problem = Problem::new(session, values);
    let nominal = Model::nominal(session.robot.clone()).predict(&problem.inputs);
    [nominal.x_mm, nominal.y_mm, nominal.z_mm]
}

/// Whether the points are spread as widely as the nominal robot spreads them.
fn has_the_robots_size(session: &Session, values: JointValues) -> bool {
    let [x_mm, y_mm, z_mm] = nominal_mm(session, values);
    let mut seen = session.samples.clone();
    (seen.x_mm, seen.y_mm) = (x_mm, y_mm);
    seen.z_mm = session.samples.z_mm.is_some().then_some(z_mm);
    let ratio = session.samples.spread_mm() / seen.spread_mm().max(1e-12);
    (1.0 / TO_SCALE..=TO_SCALE).contains(&ratio)
}

/// A measuring frame that was not aligned, where the session has no free one.
fn never_aligned(part: &Session, values: JointValues) -> Option<DataProblem> {
    if part.samples.setups.is_some() || part.samples.z_mm.is_none() {
        return None;
    }
    let free = trial(part, values, true)?;
    let free_mm = free.within_mm(HALF);
    let fixed_mm = least_mm(part, values, false, HALF, 0.0);
    let is_frame = |t: &&Term| t.effect.about().setting == Setting::Setup;
    let frame = free.model.terms().iter().find(is_frame)?;
    let turn = Vector3::from_column_slice(&frame.coefficients[..3]);
    let shift = Vector3::from_column_slice(&frame.coefficients[3..]);
    let first = &part.robot.joints[0];
    let axis = first.axis.direction.into_inner();
    let point = first.axis.point_mm.coords;
    // Where the motion takes a point of the axis.
    let to = Rotation3::new(turn) * point + shift;
    let is_turned = turn.norm() > rad_from_deg(LEAST_TURN_DEG);
    let far = if base_model::is_arm(part) {
        is_turned || shift.norm() > LEAST_MOVE_MM
    } else {
        // Of a single axis a turn about it is its zero offset, and a small rest is a base offset or a tilt.
        let tilt = turn - axis * axis.dot(&turn);
        tilt.norm() > rad_from_deg(LEAST_TURN_DEG) || (to - point).norm() > LEAST_MOVE_MM
    };
    let gross = fixed_mm > GROSS_SHARE * part.samples.spread_mm();
    if !far || !gross || free_mm > CORRECTED_SHARE * fixed_mm {
        return None;
    }
    let about_axis = is_turned
        && turn.cross(&axis).norm() < 0.02 * turn.norm()
        && first.kind == JointKind::Revolute
        && (to - point).cross(&axis).norm() < LEAST_MOVE_MM;
    let turned = format!("{:.2}°", deg_from_rad(turn.norm()));
    let home = text!(
        "the home position of joint {joint} is off by {turn}",
        joint = 1,
        turn = turned.clone()
    );
    Some(DataProblem::of_all(
        Change::with_equivalents(
            text!("the measuring frame was never aligned with the robot's base"),
            if about_axis {
                std::slice::from_ref(&home)
            } else {
                &[]
            },
        ),
        text!(
            "the median error is {fixed} as it stands and {free} with the frame fitted",
            fixed = in_words(fixed_mm),
            free = length(free_mm, 3)
        ),
        text!(
            "align the instrument (turned by {turn}, moved by {shift}), or give the samples a `setup` column so that the frame is fitted",
            turn = turned,
            shift = format!("{:.2}, {:.2}, {:.2} mm", shift.x, shift.y, shift.z)
        ),
        SessionCorrection::FreeFrame,
    ))
}
