//! The whole job on one screen: a session in, a calibration, its proof, a table and a report out.
//!
//! Terminal and window call these functions and none of the steps behind them (a test of the house
//! holds that), so they cannot give different answers. A step that is one function of its module is
//! passed on under its own name.
//!
//! ```
//! use truepose::effects::JointValues;
//! use truepose::export::Job;
//! use truepose::pipeline::{Method, export, hand_out, identify, load, verify};
//!
//! let session = load("sessions/paper-30.json")?.session;
//! let (found, calibration) = identify(&session, &Method::default(), JointValues::Commanded)?;
//! let offset = &found.parameters[0];
//! assert_eq!((offset.effect, offset.name), ("joint-zero-offset", "offset_deg"));
//! assert!((offset.value + 3.0).abs() < 1e-9, "the robot stands 3° behind its command");
//! assert!(verify(&calibration, &session)?.model.rms_mm < 1e-9);
//! let verified = hand_out(&calibration, &session)?;
//! let table = export("csv", &Job::new(&verified, "table.csv"))?;
//! assert_eq!(table.documents[0].name, "table.csv");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::borrow::Cow;
use std::path::Path;

use crate::answers::identification::FULL_MODEL;
use crate::compensation::decision::{FittedErrors, MeasuredDeviation};
use crate::compensation::{NotHandedOut, Verification, VerifiedCalibration, VerifyError};
use crate::diagnosis::{DiagnoseError, Diagnosis, Options, Watch};
use crate::diagnostic::Rejected;
use crate::effects::{Inputs, JointValues, MEASURING_FRAME, Role, Term, called};
use crate::export::{Export, ExportError, Job, find, gaps_of_export};
use crate::fit::gap::{Spread, deviations};
use crate::fit::problem::Problem;
use crate::fit::{self, base_model};
use crate::fit::{DEFAULT_EFFECTS, Identification, IdentifyError, identify_regional};
use crate::model::{Calibration, ResidualStep, SetUp};
use crate::report::{Evidence, Extras, Kind, PdfError, Report, ReportError, Written};
use crate::sessions::division::RegionChoice;
use crate::sessions::{Session, SessionCorrection};
use crate::set_up_errors::{CorrectedSession, DataProblem, corrected_session, noticed};
use crate::standards::Standards;
use crate::text::Text;

pub use crate::design::{plan_robot, plan_session};
pub use crate::history::{history, history_watched};
pub use crate::importers::{import, import_watched};
pub use crate::model::format_v1::is_model;
pub use crate::paper::{RegionalStart, regional_start};
pub use crate::programs::{compensate, measuring_list, measuring_program};
pub use crate::sessions::{load, save};
pub use crate::sessions::{
    load_robot, load_watched, parse, parse_with_csv, save_watched, save_with_samples, write_inline,
};
pub use crate::simulation::{load_scenario, parse_scenario, simulate};

/// How far the nominal robot is off over a session's samples, before anything is identified; `None` where no sample
/// can be used.
pub fn nominal_error(session: &Session) -> Option<Spread> {
    let problem = Problem::new(session, JointValues::Commanded);
    let nominal = base_model::nominal(&session.robot, session, &problem);
    let left = deviations(&problem, &nominal);
    Spread::of(&left.length_mm, |i| problem.fit[i], |_| false)
}

/// How a session is to be identified.
#[derive(Debug, Clone, PartialEq)]
pub enum Method {
    /// Nonlinear least squares.
    Exact {
        /// Names of the effects.
        effects: Vec<String>,
        /// Effects that a diagnosis found, with their settings, in the order found.
        with: Vec<Term>,
        /// Whether weak priors hold the geometry of several joints where few poses show it.
        priors: bool,
    },
    /// The paper's constant corrections by region.
    Regional(RegionChoice),
}

impl Default for Method {
    fn default() -> Self {
        Self::exact(&DEFAULT_EFFECTS)
    }
}

impl Method {
    /// Least squares for the effects of these names, with the priors.
    pub fn exact(effects: &[&str]) -> Self {
        Self::Exact {
            effects: effects.iter().map(|&id| id.to_owned()).collect(),
            with: Vec::new(),
            priors: true,
        }
    }
}

/// Identifies a session by one method, and makes the calibration that goes with the answer.
///
/// # Errors
/// See [`IdentifyError`].
pub fn identify(
    session: &Session,
    method: &Method,
    values: JointValues,
) -> Result<(Identification, Calibration), IdentifyError> {
    identify_watched(session, method, values, &|| true)
}

/// Like [`identify`], asking before every pass over the samples whether to go on.
///
/// # Errors
/// See [`IdentifyError`].
pub fn identify_watched(
    session: &Session,
    method: &Method,
    values: JointValues,
    keep_going: &dyn Fn() -> bool,
) -> Result<(Identification, Calibration), IdentifyError> {
    let session = &*session.whole()?;
    let identification = match method {
        Method::Exact {
            effects,
            with,
            priors,
        } => fit::identify_watched(session, effects, with, *priors, values, keep_going)?,
        Method::Regional(choice) => identify_regional(session, choice, values)?,
    };
    let mut calibration = identification.calibration(session, &Inputs::new(session, values));
    if values == JointValues::Read {
        let made = calibration.set_up.all().iter().cloned();
        calibration.set_up = SetUp::new(made.chain([SessionCorrection::TakeReadBack]));
    }
    if let Method::Exact {
        effects,
        with,
        priors,
    } = method
        && !with.is_empty()
    {
        calibration.history.truncate(1);
        let fitted_with = |with: &[Term]| {
            let fitted =
                fit::identify_watched(session, effects, with, *priors, values, keep_going)?;
            Ok(fitted.gap.after.rms_mm)
        };
        let last_mm = identification.gap.after.rms_mm;
        calibration
            .history
            .extend(history_of_steps(with, last_mm, fitted_with)?);
    }
    Ok((identification, calibration))
}

/// What is left before and after each of the terms that were found, in their order; with all of them `last_mm`.
fn history_of_steps(
    terms: &[Term],
    last_mm: f64,
    fitted_with: impl Fn(&[Term]) -> Result<f64, IdentifyError>,
) -> Result<Vec<ResidualStep>, IdentifyError> {
    let step = |n: usize| {
        Ok(ResidualStep {
            what: match n.checked_sub(1) {
                None => FULL_MODEL.to_owned(),
                Some(last) => format!("with {}", terms[last].effect.about().id),
            },
            gap_mm: if n == terms.len() {
                last_mm
            } else {
                fitted_with(&terms[..n])?
            },
            held_out_mm: None,
            runs_held_out_mm: None,
            values_held_out_mm: None,
        })
    };
    (0..=terms.len()).map(step).collect()
}

/// What an identification answers, with the set-up errors that it noticed.
#[derive(Debug, Clone)]
pub struct Identified {
    /// The answer.
    pub identification: Identification,
    /// The model, to be saved.
    pub calibration: Calibration,
    /// Problems of the data; what is mechanical was corrected before the fit.
    pub data_problems: Vec<DataProblem>,
}

/// Like [`identify`], looking for set-up errors first, as [`diagnose`] does.
///
/// # Errors
/// See [`IdentifyError`].
pub fn identify_checked(
    session: &Session,
    method: &Method,
    values: JointValues,
) -> Result<Identified, IdentifyError> {
    identify_checked_unless(session, method, values, &|| true)
}

/// Like [`identify_checked`], asking before every pass over the samples whether to go on.
///
/// # Errors
/// See [`IdentifyError`].
pub fn identify_checked_unless(
    session: &Session,
    method: &Method,
    values: JointValues,
    keep_going: &dyn Fn() -> bool,
) -> Result<Identified, IdentifyError> {
    let session = &*session.whole()?;
    let checked = match method {
        Method::Exact { .. } => noticed(session, values),
        Method::Regional(_) => CorrectedSession {
            session: Cow::Borrowed(session),
            problems: Vec::new(),
        },
    };
    let (identification, calibration) =
        identify_watched(&checked.session, method, values, keep_going)?;
    let mut data_problems = checked.problems;
    data_problems.extend(identification.many_set_aside());
    data_problems.extend(identification.far_tool());
    Ok(Identified {
        identification,
        calibration,
        data_problems,
    })
}

/// Diagnoses a session: what is missing, how sure that is, and what to measure next.
///
/// # Errors
/// See [`DiagnoseError`].
pub fn diagnose(
    session: &Session,
    options: &Options,
    watch: Watch,
) -> Result<Diagnosis, DiagnoseError> {
    let session = &*session.whole()?;
    crate::diagnosis::diagnose(session, options, &crate::design::propose, watch)
}

/// What a model brings on a session.
///
/// # Errors
/// See [`VerifyError`].
pub fn verify(calibration: &Calibration, session: &Session) -> Result<Verification, VerifyError> {
    crate::compensation::verify(calibration, session)
}

/// A calibration, verified on the raw session that it came from: the one value of which files are made.
/// It is made here and nowhere else, and can be read but not changed:
///
/// ```compile_fail,E0423
/// use truepose::compensation::VerifiedCalibration;
/// fn made(calibration: truepose::model::Calibration) {
///     let _ = VerifiedCalibration(calibration);
/// }
/// ```
///
/// ```compile_fail,E0594
/// fn change(verified: &mut truepose::compensation::VerifiedCalibration) {
///     verified.samples_hash = String::new();
/// }
/// ```
///
/// Nothing that writes takes a calibration that was not verified:
///
/// ```compile_fail,E0308
/// fn made(calibration: &truepose::model::Calibration) {
///     let _ = truepose::pipeline::write_model(calibration);
/// }
/// ```
///
/// ```compile_fail,E0308
/// fn made(calibration: &truepose::model::Calibration) {
///     let _ = truepose::export::Job::new(calibration, "table.csv");
/// }
/// ```
///
/// ```compile_fail,E0308
/// fn made(calibration: &truepose::model::Calibration) {
///     let _ = truepose::compensation::JointTable::new(calibration, 0, 1.0, Default::default());
/// }
/// ```
///
/// ```compile_fail,E0308
/// fn made(calibration: &truepose::model::Calibration) {
///     let _ = truepose::pipeline::report_of_model(calibration, &Default::default());
/// }
/// ```
///
/// ```compile_fail,E0432
/// use truepose::model::format_v1::write_model;
/// ```
///
/// # Errors
/// See [`NotHandedOut`].
pub fn hand_out(
    calibration: &Calibration,
    session: &Session,
) -> Result<VerifiedCalibration, NotHandedOut> {
    VerifiedCalibration::on(calibration, session)
}

/// What is handed out, and what it takes the place of.
#[derive(Debug, Clone)]
pub struct HandedOut {
    /// The calibration.
    pub calibration: VerifiedCalibration,
    /// Where it is not the one that was asked for: what it is, and why the other is refused.
    pub instead: Option<Text>,
}

/// Like [`hand_out`]; what is refused is replaced by the next best that holds: the model with fewer names, that of
/// [`identify`], the nominal robot where its frame is.
///
/// # Errors
/// Why the calibration is refused, where nothing else holds either.
pub fn hand_out_next_best(
    calibration: &Calibration,
    session: &Session,
) -> Result<HandedOut, NotHandedOut> {
    let why = match hand_out(calibration, session) {
        Ok(calibration) => {
            return Ok(HandedOut {
                calibration,
                instead: None,
            });
        }
        // A session that this robot cannot follow has nothing else either.
        Err(why @ NotHandedOut::Verify(_)) => return Err(why),
        Err(why) => why,
    };
    if !calibration.regions.is_empty() {
        return Err(why);
    }
    let is_read = |made: &&SessionCorrection| **made == SessionCorrection::TakeReadBack;
    let mut made = calibration.set_up.corrections().iter();
    let values = match made.find(is_read) {
        Some(_) => JointValues::Read,
        None => JointValues::Commanded,
    };
    let held = |method: &Method| {
        let next = identify_checked(session, method, values).ok()?;
        hand_out(&next.calibration, session).ok()
    };
    let terms = calibration.model.terms().iter();
    let names: Vec<Term> = terms
        .filter(|term| term.effect.about().role == Role::Candidate)
        .cloned()
        .collect();
    let with = |kept: usize| Method::Exact {
        effects: DEFAULT_EFFECTS.map(str::to_owned).to_vec(),
        with: names[..kept].to_vec(),
        priors: true,
    };
    let instead = |calibration, what: Text| HandedOut {
        calibration,
        instead: Some(text!(
            "{why}; in its place: {what}",
            why = why.describe(),
            what
        )),
    };
    for kept in (0..=names.len()).rev() {
        if let Some(next) = held(&with(kept)) {
            let what = match kept {
                0 => text!("the model of identify, without names"),
                _ => text!(
                    "the model with {names}",
                    names = Text::listed(
                        names[..kept]
                            .iter()
                            .map(|term| called(term.effect.about().id)),
                        ", "
                    )
                ),
            };
            return Ok(instead(next, what));
        }
    }
    let frame = [MEASURING_FRAME.about().id];
    let of_frame = if session.samples.setups.is_some() {
        &frame[..0]
    } else {
        &frame
    };
    match held(&Method::exact(of_frame)) {
        Some(next) => Ok(instead(
            next,
            text!("the nominal robot in its measuring frame"),
        )),
        None => Err(why),
    }
}

/// The calibration of a model file.
///
/// # Errors
/// Everything in it that is no model.
pub fn load_model(path: impl AsRef<Path>) -> Result<VerifiedCalibration, Rejected> {
    VerifiedCalibration::load(path)
}

/// The model as the text of its file.
pub fn write_model(calibration: &VerifiedCalibration) -> String {
    calibration.document()
}

/// Accuracy and repeatability as ISO 230-2 and ISO 9283 have them, as measured and with the model's
/// corrections where there is one.
///
/// # Errors
/// See [`VerifyError`].
pub fn standards(
    session: &Session,
    calibration: Option<&Calibration>,
) -> Result<Standards, VerifyError> {
    crate::standards::standards(session, calibration)
}

/// Makes the documents of an export in the format of this name, in memory.
///
/// # Errors
/// See [`ExportError`].
pub fn export(format: &str, job: &Job) -> Result<Export, ExportError> {
    let Some(format) = find(format) else {
        let unknown = text!("no format is called '{format}'", format);
        return Err(ExportError::Refused(unknown));
    };
    let set_up = &job.calibration.set_up;
    if format.rules.is_none() && set_up.moves_joints() {
        return Err(ExportError::Refused(text!(
            "{format} holds joint values as the robot's description has them, and the controller of the model's session has them otherwise ({why}): correct the controller or the description, identify again and export that model",
            format = format.title,
            why = set_up.describe()
        )));
    }
    format.exporter.export(job)
}

/// An export beside what it does to the session that it is held against.
#[derive(Debug, Clone)]
pub struct CheckedExport {
    /// The export.
    pub export: Export,
    /// RMS errors of the session as it stands and under the export, where both can be said.
    pub gaps: Option<[Spread; 2]>,
}

/// Like [`export`], refusing what would make a session worse.
///
/// # Errors
/// See [`ExportError`].
pub fn export_for(
    format: &str,
    job: &Job,
    session: &Session,
) -> Result<CheckedExport, ExportError> {
    let export = export(format, job)?;
    let session = session.whole();
    let session = session
        .as_deref()
        .map_err(|error| ExportError::Refused(error.describe()))?;
    let gaps = gaps_of_export(job.calibration, session, &export);
    match gaps {
        Some([before, after]) if after.rms_mm > before.rms_mm => Err(ExportError::MakesWorse {
            session: session.name.clone(),
            is_table: export.reads_as.is_some(),
            before_mm: before.rms_mm,
            after_mm: after.rms_mm,
        }),
        _ => Ok(CheckedExport { export, gaps }),
    }
}

/// The report of a session. `watch` is told of the diagnosis and may stop it.
///
/// # Errors
/// If the session cannot be diagnosed, or `watch` stops it.
pub fn report(
    session: &Session,
    options: &Options,
    extras: &Extras,
    watch: Watch,
) -> Result<Report, ReportError> {
    let found = diagnose(session, options, watch)?;
    report_of_diagnosis(session, &found, None, options, extras)
}

/// The report of a session whose diagnosis is there already, with the model that is in use: tables
/// are made from it, and so the errors that are promised are its own. `None`: what was found. Where
/// the two differ the report says in what.
///
/// # Errors
/// If no sample can be used, or the model is not handed out.
pub fn report_of_diagnosis(
    session: &Session,
    found: &Diagnosis,
    in_use: Option<&VerifiedCalibration>,
    options: &Options,
    extras: &Extras,
) -> Result<Report, ReportError> {
    let mut session = session.whole().map_err(DiagnoseError::from)?;
    if let Some(tolerance_mm) = extras.details.tolerance_mm {
        session.to_mut().tolerance_mm = Some(tolerance_mm);
    }
    let session = &*session;
    // What is reported is the session that was diagnosed: without its set-up errors.
    let corrected = corrected_session(session, options.joint_values).session;
    let all_found = hand_out_next_best(&found.calibration(session), session)?.calibration;
    let calibration = in_use.unwrap_or(&all_found);
    let evidence = Evidence {
        session: &corrected,
        as_read: session,
        found,
        all_found: &all_found,
        in_use,
        verification: verify(calibration, session)?,
        standards: standards(&corrected, Some(calibration)),
    };
    Report::of_session(&evidence, extras)
}

/// The report of a model alone.
pub fn report_of_model(calibration: &VerifiedCalibration, extras: &Extras) -> Report {
    Report::of_model(calibration, extras)
}

/// The deviation that is held against a tolerance, with its uncertainty.
///
/// # Errors
/// Why nothing can be decided.
pub fn conformity(
    session: &Session,
    calibration: &Calibration,
    fitted: FittedErrors,
) -> Result<MeasuredDeviation, Text> {
    let verification = verify(calibration, session).map_err(|error| error.describe())?;
    MeasuredDeviation::of(session, &verification, fitted).map_err(Text::from)
}

/// A report as a file of this kind, with the fonts of this machine where the bundled ones do not do.
///
/// # Errors
/// If a font cannot be used.
pub fn write_report(report: &Report, kind: Kind) -> Result<Written, PdfError> {
    report.written(kind)
}
