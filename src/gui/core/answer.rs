//! What an identification answers, and a model that was read from a file: it takes the place of an
//! identification, so that the same panels show both.
//!
//! With a session of the same robot it is held against the samples by
//! [`verify`](crate::compensation::verify), as the terminal does it. Without one there is nothing to
//! hold it against: its parameters, its table and its history are shown by themselves.

use std::path::{Path, PathBuf};

use crate::answers::diagnosis::DataProblem;
use crate::compensation::{Verification, VerifiedCalibration};
use crate::fit::gap::Spread;
use crate::fit::uncertainty::{NORMAL_95, all_estimates};
use crate::fit::{Gap, Identification, Outlier, Quality, RegionResult};
use crate::language::spoken;
use crate::model::{Calibration, RegionalCorrection};
use crate::pipeline::verify;
use crate::sessions::regions::Assignment;
use crate::sessions::{Instrument, Region, Samples, Session, hash_of_samples};

use super::loaded_session::{LoadedSession, Origin};

/// An identification, and what is left of every sample's deviation.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub(crate) identification: Identification,
    /// The model that goes with it, to be saved and exported.
    pub(crate) calibration: Calibration,
    /// Problems of the data; what is mechanical was corrected before the fit.
    pub(crate) data_problems: Vec<DataProblem>,
    /// Where the model was read from, if it was.
    pub(crate) loaded: Option<LoadedModelSummary>,
    /// What is left of the deviations, mm; NaN for samples that cannot be used.
    pub(crate) after_mm: [Vec<f64>; 3],
    /// Their lengths, mm.
    pub(crate) lengths_mm: Vec<f64>,
    /// Suspected outliers.
    pub(crate) suspected: Vec<bool>,
}

/// What there is to say about a model that was read from a file.
#[derive(Debug, Clone)]
pub(crate) struct LoadedModelSummary {
    pub(crate) file: String,
    /// What it does on the session; `None` where nothing was measured.
    pub(crate) verification: Option<Verification>,
}

impl Answer {
    /// What is left of a sample's deviation, mm.
    pub(crate) fn deviation_after(&self, sample: usize) -> [f64; 3] {
        std::array::from_fn(|axis| self.after_mm[axis][sample])
    }
}

/// A model and the file that it was read from.
#[derive(Debug, Clone)]
pub(crate) struct LoadedModel {
    pub(crate) calibration: VerifiedCalibration,
    pub(crate) path: PathBuf,
}

impl PartialEq for LoadedModel {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl LoadedModel {
    /// A model that was read from a file.
    pub(crate) fn new(calibration: VerifiedCalibration, path: &Path) -> Self {
        Self {
            calibration,
            path: path.to_path_buf(),
        }
    }

    pub(crate) fn file_name(&self) -> String {
        let name = self.path.file_name().unwrap_or(self.path.as_os_str());
        name.to_string_lossy().into_owned()
    }

    /// Whether a session was measured on the model's robot.
    pub(crate) fn is_of(&self, session: &Session) -> bool {
        self.calibration.model.robot == session.robot
    }

    /// Whether the model came from the samples of this session.
    pub(crate) fn came_from(&self, session: &Session) -> bool {
        self.is_of(session) && hash_of_samples(session) == self.calibration.samples_hash
    }

    /// The model's robot with no sample measured on it.
    pub(crate) fn alone(&self) -> LoadedSession {
        let Calibration { model, targets, .. } = &*self.calibration;
        let joints = model.robot.joints.len();
        let session = Session {
            name: self.calibration.session.clone(),
            note: String::new(),
            robot: model.robot.clone(),
            targets: targets.clone(),
            instrument: Instrument::default(),
            tolerance_mm: self.calibration.tolerance_mm,
            regions: Vec::new(),
            compensated_by: None,
            samples: Samples {
                q: vec![Vec::new(); joints],
                q_read: vec![None; joints],
                dir: vec![None; joints],
                speed: vec![None; joints],
                z_mm: Some(Vec::new()),
                ..Samples::default()
            },
            path: None,
        };
        let mut loaded_session =
            LoadedSession::new(session, Vec::new(), Origin::Model(self.path.clone()));
        loaded_session.measured_range = self.calibration.measured.first().copied();
        loaded_session
    }
}

/// Method of an [`Identification`] that was none.
pub(crate) const METHOD: &str = "model";

/// What the model says about a session.
pub(crate) fn answer(
    loaded_model: &LoadedModel,
    loaded_session: &LoadedSession,
) -> Result<Answer, String> {
    let calibration = Calibration::clone(&loaded_model.calibration);
    let mut loaded = LoadedModelSummary {
        file: loaded_model.file_name(),
        verification: None,
    };
    if loaded_session.is_empty() {
        let identification = identification(loaded_model, loaded_session, None);
        return Ok(Answer {
            identification,
            calibration,
            data_problems: Vec::new(),
            loaded: Some(loaded),
            after_mm: Default::default(),
            lengths_mm: Vec::new(),
            suspected: Vec::new(),
        });
    }
    let verification =
        verify(&calibration, &loaded_session.session).map_err(|e| spoken(e.describe()))?;
    let identification = identification(loaded_model, loaded_session, Some(&verification));
    let mut suspected = vec![false; loaded_session.len()];
    for outlier in &verification.outliers {
        suspected[*outlier] = true;
    }
    let after = verification.after.clone();
    loaded.verification = Some(verification);
    Ok(Answer {
        identification,
        calibration,
        data_problems: Vec::new(),
        loaded: Some(loaded),
        after_mm: after.axes_mm,
        lengths_mm: after.length_mm,
        suspected,
    })
}

fn identification(
    loaded_model: &LoadedModel,
    loaded_session: &LoadedSession,
    verified: Option<&Verification>,
) -> Identification {
    let Calibration {
        model, covariance, ..
    } = &*loaded_model.calibration;
    let nothing = Spread {
        rms_mm: 0.0,
        max_mm: 0.0,
    };
    let coefficients = model.coefficient_count();
    let outlier = |v: &Verification, sample: usize| Outlier {
        sample,
        deviation_mm: v.after.length_mm[sample],
    };
    Identification {
        session: loaded_session.session.name.clone(),
        method: METHOD,
        samples: loaded_session.len(),
        model: model.clone(),
        covariance: covariance.clone(),
        parameters: all_estimates(&loaded_model.calibration, NORMAL_95),
        regions: regions(loaded_model, loaded_session, verified),
        not_identifiable: Vec::new(),
        gap: Gap {
            before: verified.map_or(nothing, |v| v.nominal),
            after: verified.map_or(nothing, |v| v.model),
            samples: verified.map_or(0, |v| v.samples),
        },
        held_out: None,
        levels: Vec::new(),
        expected: None,
        outliers: verified.map_or_else(Vec::new, |v| {
            v.outliers
                .iter()
                .map(|sample| outlier(v, *sample))
                .collect()
        }),
        left_out: Vec::new(),
        noise_mm: None,
        noise: None,
        kinds: Vec::new(),
        quality: Quality {
            stopped: phrase!("read from a file"),
            converged: true,
            passes: 0,
            coefficients,
            rank: coefficients,
            condition: 1.0,
        },
        notes: verified.map_or_else(Vec::new, |v| v.notes.clone()),
    }
}

fn regions(
    loaded_model: &LoadedModel,
    loaded_session: &LoadedSession,
    verified: Option<&Verification>,
) -> Vec<RegionResult> {
    let corrections = &loaded_model.calibration.regions;
    let regions: Vec<Region> = corrections.iter().map(RegionalCorrection::region).collect();
    let assignment = Assignment::new(&regions);
    let before_mm = loaded_session.in_plane_before();
    let rms = |region: usize, lengths_mm: &[f64]| {
        let inside = |i: usize| assignment.region_of(loaded_session.q(i)) == Some(region);
        let spread = Spread::of(lengths_mm, inside, |_| false);
        spread.map_or(f64::NAN, |s| s.rms_mm)
    };
    let result = |(k, correction): (usize, &RegionalCorrection)| RegionResult {
        correction: correction.clone(),
        theta_ci95: None,
        l1_ci95: None,
        rms_before_mm: rms(k, &before_mm),
        rms_after_mm: verified.map_or(f64::NAN, |v| rms(k, &v.after.length_mm)),
    };
    corrections.iter().enumerate().map(result).collect()
}
