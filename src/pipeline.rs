//! The whole job on one screen: a session in, a calibration, its proof and a table out.
//!
//! The terminal and the window go through these functions, so they cannot give different answers.

use crate::compensation::verification::VerifyError;
use crate::compensation::{Verification, verify};
use crate::diagnosis::{DiagnoseError, Diagnosis, Options, Watch};
use crate::diagnostic::Rejected;
use crate::effects::{Inputs, JointValues};
use crate::export::{Export, ExportError, Format, Job};
use crate::fit::{
    DEFAULT_EFFECTS, Identification, IdentifyError, identify_exact, identify_regional,
    identify_without_priors,
};
use crate::model::Calibration;
use crate::programs::{self, CompensateError};
use crate::sessions::division::RegionChoice;
use crate::sessions::{Loaded, Session, hash_of_samples, load};
use crate::set_up_errors::{DataProblem, Mended, noticed};

/// How a session is to be identified.
#[derive(Debug, Clone, PartialEq)]
pub enum Method {
    /// Nonlinear least squares for these effects.
    Exact {
        /// Names of the effects.
        effects: Vec<String>,
        /// Whether weak priors hold the geometry of several joints where few poses show it.
        priors: bool,
    },
    /// The paper's constant corrections by region.
    Regional(RegionChoice),
}

impl Default for Method {
    fn default() -> Self {
        Self::Exact {
            effects: DEFAULT_EFFECTS.map(str::to_owned).to_vec(),
            priors: true,
        }
    }
}

/// Why the job could not be done.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// The session cannot be read.
    #[error(transparent)]
    Rejected(#[from] Rejected),
    /// It cannot be identified.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// The model cannot be checked.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// There is no table.
    #[error(transparent)]
    Export(#[from] ExportError),
}

/// Everything that comes out of a session.
#[derive(Debug, Clone)]
pub struct Calibrated {
    /// What was identified, with intervals.
    pub identification: Identification,
    /// What the model and its corrections do to the gap.
    pub verification: Verification,
    /// The table for the first joint.
    pub export: Export,
    /// The session and what was noticed while reading it.
    pub loaded: Loaded,
    /// The model, to be saved.
    pub calibration: Calibration,
}

/// Reads a session, identifies it, checks the model and makes a table.
///
/// # Errors
/// See [`PipelineError`].
pub fn calibrate(
    path: &std::path::Path,
    method: &Method,
    format: &Format,
    file_name: &str,
) -> Result<Calibrated, PipelineError> {
    let loaded = load(path)?;
    let (identification, calibration) = identify(&loaded.session, method, JointValues::Commanded)?;
    let verification = verify(&calibration, &loaded.session)?;
    let job = Job::new(&calibration, file_name);
    let export = format.exporter.export(&job)?;
    Ok(Calibrated {
        identification,
        verification,
        export,
        loaded,
        calibration,
    })
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
    let identification = match method {
        Method::Exact { effects, priors } if *priors => identify_exact(session, effects, values)?,
        Method::Exact { effects, .. } => identify_without_priors(session, effects, values)?,
        Method::Regional(choice) => identify_regional(session, choice, values)?,
    };
    let calibration = identification.calibration(session, &Inputs::new(session, values));
    Ok((identification, calibration))
}

/// What an identification answers, with the mistakes of setting up that it noticed.
#[derive(Debug, Clone)]
pub struct Identified {
    /// The answer.
    pub identification: Identification,
    /// The model, to be saved.
    pub calibration: Calibration,
    /// Mistakes of setting up. A robot with several joints is identified without them, one joint as
    /// it stands.
    pub data_problems: Vec<DataProblem>,
}

/// Like [`identify`], looking for mistakes of setting up first, as [`diagnose`] does.
///
/// # Errors
/// See [`IdentifyError`].
pub fn identify_checked(
    session: &Session,
    method: &Method,
    values: JointValues,
) -> Result<Identified, IdentifyError> {
    let checked = match method {
        Method::Exact { .. } => noticed(session, values),
        Method::Regional(_) => Mended {
            session: std::borrow::Cow::Borrowed(session),
            problems: Vec::new(),
        },
    };
    let (identification, mut calibration) = identify(&checked.session, method, values)?;
    // The model came from the file as it is.
    calibration.samples_hash = hash_of_samples(session);
    Ok(Identified {
        identification,
        calibration,
        data_problems: checked.problems,
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
    crate::diagnosis::diagnose(session, options, &crate::design::next_poses::propose, watch)
}

/// Corrects the targets of a table or a robot program in place.
///
/// # Errors
/// See [`CompensateError`].
pub fn compensate(request: &programs::Request) -> Result<programs::Answer, CompensateError> {
    programs::compensate(request)
}
