//! The errors of a calibration on a session: its own, or another one of the same robot.
//!
//! - *nominal*: measured − nominal robot, of a session with setups from where each fits best. *model*: measured −
//!   model.
//! - *within tolerance*: poses whose deviation is at most the tolerance, before (nominal) and after
//!   (model); the tolerance is the session's, else the calibration's.
//! - *compensated*: what would be measured with the table active, measured − model + the model's
//!   own residual: it contains noise and everything unknown. The table is for the reference conditions,
//!   so the effects of load, warmth and speed at the sample are in it as well.
//! - *cannot be removed by joints*: the residual of the model when each command is corrected for its
//!   own conditions; root mean square over the poses.
//!
//! A session that was measured with a table active (`compensated_by`) is not compensated a second
//! time. If it was this model's table, the model predicts where the corrected commands lead.
//!
//! Frames of another session (a bump of the tripod, its drift, its setups) do not apply to this one: they count only
//! where the samples are the ones that the calibration came from. A setup that the model knows by its name is where
//! the model has it; for another one the frame is fitted, and that is reported. So is the tool's position in a session
//! with another tool or other targets: joints and links carry over.
//!
//! Every RMS error is over all samples, including suspected outliers; in addition there is the one without those, with
//! their number, and where they are many or belong together that is a problem of the data. Of the session that the
//! model came from the held-out samples are separate. For the paper's method everything is in the plane of motion; z
//! is not used.

use crate::budget;
use crate::effects::{Inputs, MEASURING_FRAME, Owner, Role, Term, called};
use crate::fit::expected::uncertainties_mm;
use crate::fit::gap::{Deviations, Spread};
use crate::fit::problem::Problem;
use crate::fit::spread::spread;
use crate::fit::unseen::nothing_held;
use crate::kinematics::JointKind;
use crate::kinematics::quaternion::log;
use crate::model::rigid_motion::best_rigid_motion;
use crate::model::{Calibration, Model, Positions};
use crate::sessions::{Session, hash_of_samples};
use crate::text::Text;

use crate::answers::diagnosis::DataProblem;
use crate::answers::rms_error::rms_error;

use super::conditions::Conditions;
use super::plan::Compensation;
use super::set_aside;

/// Numbers of poses within the tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WithinTolerance {
    /// With the nominal robot.
    pub before: usize,
    /// With the model.
    pub after: usize,
    /// With corrected commands; `None` for a session that was compensated already.
    pub corrected: Option<usize>,
    /// Of so many.
    pub of: usize,
}

/// The robot with its commands corrected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compensated {
    /// The error of the nominal robot, mm.
    pub gap: Spread,
    /// What no joint can remove, root mean square, mm.
    pub cannot_be_removed_by_joints_mm: f64,
}

/// The error without the samples that are suspected outliers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trimmed {
    /// RMS error of the nominal robot, mm.
    pub nominal_mm: f64,
    /// RMS error of the model, mm.
    pub model_mm: f64,
    /// So many samples were set aside.
    pub set_aside: usize,
}

impl Trimmed {
    /// Of the lengths that count, to the nominal robot and to the model, mm; `None` where nothing is suspected.
    pub(super) fn of(
        nominal_mm: &[f64],
        model_mm: &[f64],
        counts: impl Fn(usize) -> bool,
        suspected: &[bool],
    ) -> Option<Self> {
        let is_set_aside = |i: &usize| counts(*i) && suspected[*i];
        let set_aside = (0..model_mm.len()).filter(is_set_aside).count();
        let rms_mm = |lengths_mm: &[f64]| {
            let spread = Spread::of(lengths_mm, |i| counts(i) && !suspected[i], |_| false);
            spread.map_or(f64::NAN, |spread| spread.rms_mm)
        };
        (set_aside > 0).then(|| Self {
            nominal_mm: rms_mm(nominal_mm),
            model_mm: rms_mm(model_mm),
            set_aside,
        })
    }
}

/// RMS errors of samples that no fit has seen, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOutErrors {
    /// How many there are.
    pub samples: usize,
    /// Nominal robot.
    pub nominal_mm: f64,
    /// Model.
    pub model_mm: f64,
}

/// Errors in mm of the nominal robot, the model and corrected commands on one session.
#[derive(Debug, Clone, PartialEq)]
pub struct Verification {
    /// Name of the session.
    pub session: String,
    /// Number of samples that could be used.
    pub samples: usize,
    /// Error of the nominal robot.
    pub nominal: Spread,
    /// Error of the model.
    pub model: Spread,
    /// `None` without a tolerance.
    pub within_tolerance: Option<WithinTolerance>,
    /// `None` for a session that was compensated already.
    pub compensated: Option<Compensated>,
    /// Measured − nominal robot, sample by sample.
    pub before: Deviations,
    /// Measured − model, sample by sample.
    pub after: Deviations,
    /// RMS errors of the held-out samples of the session that the model came from, which are in none of the
    /// above; `None` of any other session, all of whose samples are unseen.
    pub held_out: Option<HeldOutErrors>,
    /// The same without suspected outliers; `None` where there are none.
    pub trimmed: Option<Trimmed>,
    /// Suspected outliers that are too many to be set aside, or that belong together.
    pub data_problems: Vec<DataProblem>,
    /// Suspected outliers, counted from 0.
    pub outliers: Vec<usize>,
    /// Other notes.
    pub notes: Vec<Text>,
}

/// What a session is compared by.
pub(super) struct Compared<'p, 'a> {
    pub(super) problem: &'p Problem<'a>,
    /// Samples that are held out.
    pub(super) apart: &'p [bool],
    /// Suspected outliers.
    pub(super) suspected: &'p [bool],
    pub(super) tolerance_mm: Option<f64>,
    /// The errors with corrected commands, and what no joint can remove, root mean square, mm.
    pub(super) with_table: Option<(Deviations, f64)>,
}

impl Compared<'_, '_> {
    /// The figures of measured − nominal robot and measured − model.
    pub(super) fn verified(
        &self,
        before: Deviations,
        after: Deviations,
        notes: Vec<Text>,
    ) -> Result<Verification, VerifyError> {
        let (problem, session) = (self.problem, self.problem.session);
        let counts = |i: usize| problem.fit[i];
        let spread = |d: &Deviations| Spread::of(&d.length_mm, counts, |_| false);
        let within = |d: &Deviations, mm: f64| {
            let lengths = d.length_mm.iter().zip(&problem.fit);
            lengths.filter(|(l, counts)| **counts && **l <= mm).count()
        };
        let compensated = |(deviations, cannot): &(Deviations, f64)| {
            Some(Compensated {
                gap: spread(deviations)?,
                cannot_be_removed_by_joints_mm: *cannot,
            })
        };
        let suspected = self.suspected;
        Ok(Verification {
            session: session.name.clone(),
            samples: problem.usable.iter().filter(|u| **u).count(),
            nominal: spread(&before).ok_or(VerifyError::NothingToVerify)?,
            model: spread(&after).ok_or(VerifyError::NothingToVerify)?,
            within_tolerance: self.tolerance_mm.map(|mm| WithinTolerance {
                before: within(&before, mm),
                after: within(&after, mm),
                corrected: self.with_table.as_ref().map(|own| within(&own.0, mm)),
                of: problem.fit.iter().filter(|f| **f).count(),
            }),
            compensated: self.with_table.as_ref().and_then(compensated),
            held_out: held_out(self.apart, &before, &after),
            trimmed: Trimmed::of(&before.length_mm, &after.length_mm, counts, suspected),
            data_problems: set_aside::findings(session, &after.length_mm, counts, suspected),
            outliers: (0..suspected.len())
                .filter(|i| counts(*i) && suspected[*i])
                .collect(),
            before,
            after,
            notes,
        })
    }
}

/// Why a session cannot be compared with a model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum VerifyError {
    /// Another number or kind of joints.
    DifferentRobots {
        /// Joints of the session's robot.
        session: Text,
        /// Joints of the model's robot.
        model: Text,
    },
    /// No sample is complete.
    NothingToVerify,
    /// The session is no whole one: columns of different lengths, more joints than a robot has.
    Rejected(crate::diagnostic::Rejected),
}

impl VerifyError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::DifferentRobots { session, model } => text!(
                "the session's robot has {session} and the model's {model}: they are different robots",
                session,
                model
            ),
            Self::NothingToVerify => text!(
                "no sample can be used: every one lacks a joint value or a measured point (x_mm, y_mm)"
            ),
            Self::Rejected(inner) => inner.describe(),
        }
    }
}

displays_what_it_says!(VerifyError);

impl std::error::Error for VerifyError {}

impl From<crate::diagnostic::Rejected> for VerifyError {
    fn from(error: crate::diagnostic::Rejected) -> Self {
        Self::Rejected(error)
    }
}

/// Samples that the session that a model came from holds out.
pub(super) fn held_out_of(problem: &Problem, own: bool) -> Vec<bool> {
    let held_out = problem.session.samples.held_out.as_deref();
    let is_apart = |i: usize| own && problem.usable[i] && held_out.is_some_and(|h| h[i]);
    (0..problem.usable.len()).map(is_apart).collect()
}

/// Samples that the figures are taken over: every one that can be used, of the session that a model came from those
/// that may be fitted. Where there are none of these, all.
pub(super) fn counted(problem: &Problem, apart: &[bool]) -> Vec<bool> {
    let pairs = problem.usable.iter().zip(apart);
    let counted: Vec<bool> = pairs.map(|(usable, apart)| *usable && !apart).collect();
    if counted.contains(&true) {
        counted
    } else {
        problem.usable.clone()
    }
}

/// Errors of the samples that are held out.
fn held_out(
    is_held_out: &[bool],
    before: &Deviations,
    after: &Deviations,
) -> Option<HeldOutErrors> {
    let rms = |d: &Deviations| Spread::of(&d.length_mm, |i| is_held_out[i], |_| false);
    Some(HeldOutErrors {
        samples: is_held_out.iter().filter(|apart| **apart).count(),
        nominal_mm: rms(before)?.rms_mm,
        model_mm: rms(after)?.rms_mm,
    })
}

/// Whether the model came from these samples.
pub(super) fn is_own(calibration: &Calibration, session: &Session) -> bool {
    hash_of_samples(session) == calibration.samples_hash
}

pub(super) fn same_robot(
    calibration: &Calibration,
    session: &Session,
) -> Result<Vec<Text>, VerifyError> {
    let kinds = |robot: &crate::kinematics::Robot| {
        let kind_in_words = |kind: JointKind| match kind {
            JointKind::Revolute => Text::named(kind.name(), phrase!("revolute")),
            JointKind::Prismatic => Text::named(kind.name(), phrase!("prismatic")),
        };
        Text::listed(robot.joints.iter().map(|j| kind_in_words(j.kind)), ", ")
    };
    let (a, b) = (&session.robot, &calibration.model.robot);
    let (a, b) = (kinds(a), kinds(b));
    if a != b {
        return Err(VerifyError::DifferentRobots {
            session: a,
            model: b,
        });
    }
    let same = session
        .robot
        .joints
        .iter()
        .zip(&calibration.model.robot.joints);
    let same_axes = same.into_iter().all(|(a, b)| a.axis == b.axis);
    // The tool of an arm is fitted; a single axis has separate effects for the place of its tool.
    let same_tool = session.robot.base_from_tool == calibration.model.robot.base_from_tool;
    Ok(
        match (same_axes, same_tool || session.robot.joints.len() > 1) {
            (true, true) => Vec::new(),
            (true, false) => vec![text!(
                "the session's robot has another tool than the model's: the model's nominal robot is used"
            )],
            (false, _) => vec![text!(
                "the session's robot has other axes than the model's: the model's nominal robot is used"
            )],
        },
    )
}

/// The corrections that were active while measuring; `None` where there were none, or where they
/// are another model's.
pub(super) fn applied_corrections(
    hash: &str,
    session: &Session,
    compensation: &Compensation,
    inputs: &Inputs,
    notes: &mut Vec<Text>,
) -> Option<Vec<Vec<f64>>> {
    let by = session.compensated_by.as_ref()?;
    let ours = by == hash;
    notes.push(
        if ours {
            text!("the session was measured with this model's table active: it shows what is left, and is not compensated a second time")
        } else {
            text!("the session was measured with another model's table active: it is not compensated a second time, and this model does not know what that table did")
        },
    );
    let table = Conditions::default().impose_on(inputs);
    ours.then(|| compensation.joint_corrections(&table))
}

/// Terms of the model of which a coefficient was held in the fit because no sample shows it: its variance is zero.
fn are_held(calibration: &Calibration) -> Vec<bool> {
    let mut first = 0;
    let terms = calibration.model.terms().iter();
    let held = terms.map(|term| {
        let own = first..first + term.coefficients.len();
        first = own.end;
        let covariance = calibration.covariance.as_ref();
        covariance
            .is_some_and(|c| c.nrows() >= own.end && own.into_iter().any(|k| c[(k, k)] == 0.0))
    });
    held.collect()
}

/// Whether a model's predictions in a fitted frame are less certain than those of the nominal robot were right where
/// it was measured: one joint that was swept leaves the place of the instrument undetermined by the errors of the
/// other joints.
fn is_unsure(
    calibration: &Calibration,
    frame: &Term,
    problem: &Problem,
    inside: &dyn Fn(usize) -> bool,
) -> bool {
    let (Some(covariance), Some(nominal)) = (&calibration.covariance, calibration.history.first())
    else {
        return false;
    };
    let inside: Vec<bool> = (0..problem.usable.len()).map(inside).collect();
    let mut inputs = problem.inputs.select(&spread(&inside, budget::OF_A_TRIAL));
    if let Some(setups) = &mut inputs.setup {
        setups.fill(frame.setting);
    }
    let unsure_mm = uncertainties_mm(&nothing_held(&calibration.model), &inputs, covariance);
    let unsure_mm = unsure_mm.and_then(|all| rms_error(all.into_iter()));
    unsure_mm.is_some_and(|unsure_mm| unsure_mm > nominal.gap_mm)
}

/// The model as it applies to this session, without shifts and drifts of another one. A setup that the model knows by
/// name is where the model has it, another one, and one whose frame the model's own samples did not determine (two
/// poses of one reflector), where it fits best.
pub(super) fn model_for(
    calibration: &Calibration,
    session: &Session,
    problem: &Problem,
    notes: &mut Vec<Text>,
) -> Model {
    if hash_of_samples(session) == calibration.samples_hash {
        return calibration.model.clone();
    }
    let is_frame = |t: &Term| t.effect.about().role == Role::FreeFrame;
    let setups = session.samples.setups.as_ref();
    // Without setups on either side there is one instrument, and it was not moved.
    let arm = session.robot.joints.len() > 1;
    let one_place = |t: &Term| arm && is_frame(t) && t.label.is_none() && setups.is_none();
    let theirs = |t: &Term| t.effect.about().owner == Owner::Session && !one_place(t);
    let dropped: Vec<&str> = calibration
        .model
        .terms()
        .iter()
        .filter(|t| theirs(t) && !is_frame(t))
        .map(|t| t.effect.about().id)
        .collect();
    if !dropped.is_empty() {
        notes.push(text!(
            "{effects} belong to the session that the model came from and are excluded",
            effects = Text::listed(dropped.into_iter().map(called), ", ")
        ));
    }
    let mut model = calibration.model.without(theirs);
    let Some(setups) = setups else {
        return model;
    };
    let held = are_held(calibration);
    // What moved the instrument while the model's samples were taken moved it further since.
    let drifts = |t: &Term| theirs(t) && t.effect.about().role == Role::Candidate;
    let moves = calibration.model.terms().iter().any(drifts);
    let predicted = model.predict(&problem.inputs);
    for (setup, name) in setups.names.iter().enumerate() {
        let inside = |i: usize| problem.usable[i] && setups.index[i] as usize == setup;
        let known = calibration.model.terms().iter().zip(&held);
        let mut known = known.filter(|(t, _)| is_frame(t) && t.label.as_deref() == Some(name));
        match known.next() {
            Some(_) if moves => notes.push(text!(
                "the frame of setup {name} moved while the model's own samples were taken: it is fitted to these samples",
                name
            )),
            Some((frame, false)) if !is_unsure(calibration, frame, problem, &inside) => {
                let setting = setup as f64;
                model = model.with_term(Term {
                    setting,
                    ..frame.clone()
                });
                continue;
            }
            Some(_) => notes.push(text!(
                "the model's own samples do not determine the frame of setup {name}: it is fitted to these samples",
                name
            )),
            None => notes.push(text!(
                "the model knows no setup {name}: its frame is fitted to these samples",
                name
            )),
        }
        if let Some(frame) = best_rigid_motion(session, &predicted, inside) {
            let mut term = Term::absent(&MEASURING_FRAME, 0, setup as f64);
            let turn = log(&frame.rotation);
            let shift = frame.translation.vector;
            term.coefficients = [turn.as_slice(), shift.as_slice()].concat();
            model = model.with_term(term);
        }
    }
    model
}

pub(super) fn where_the_model_is(
    compensation: &Compensation,
    full: &Model,
    inputs: &Inputs,
    applied: Option<&[Vec<f64>]>,
) -> Positions {
    let none: Vec<Vec<f64>>;
    let corrections = if let Some(applied) = applied {
        applied
    } else {
        none = vec![vec![0.0; inputs.len()]; inputs.q.len()];
        &none
    };
    if compensation.regional.is_some() {
        return compensation.reached(inputs, corrections);
    }
    let mut corrected_inputs = inputs.clone();
    for (q, by) in corrected_inputs.q.iter_mut().zip(corrections) {
        for (q, by) in q.to_mut().iter_mut().zip(by) {
            *q += by;
        }
    }
    full.predict(&corrected_inputs)
}

/// Deviations of the measured points from expected ones; NaN where a sample cannot be used.
pub(super) fn measured_minus(
    session: &Session,
    problem: &Problem,
    compensation: &Compensation,
    expected: impl Fn(usize) -> [f64; 3],
) -> Deviations {
    let samples = &session.samples;
    let mut deviations = Deviations::default();
    for i in 0..samples.len() {
        let expected = expected(i);
        let z = samples.z_mm.as_ref().map_or(expected[2], |z| z[i]);
        let measured = [samples.x_mm[i], samples.y_mm[i], z];
        let e = if problem.usable[i] {
            compensation.deviation(measured, expected)
        } else {
            [f64::NAN; 3]
        };
        for (column, value) in deviations.axes_mm.iter_mut().zip(e) {
            column.push(value);
        }
        deviations.length_mm.push(crate::lanes::dot(e, e).sqrt());
    }
    deviations
}
