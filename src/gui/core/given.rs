//! A model that was read from a file: it takes the place of an identification.
//!
//! With a session of the same robot it is held against the samples by
//! [`verify`](crate::compensation::verify), as the terminal does it. Without one there is nothing
//! to hold it against: its parameters, its table and its history are shown by themselves.

use std::path::{Path, PathBuf};

use crate::compensation::{Verification, verify};
use crate::fit::gap::Spread;
use crate::fit::regions::Assignment;
use crate::fit::uncertainty::estimates;
use crate::fit::{Estimate, Gap, Identification, Outlier, Quality, RegionResult};
use crate::model::{Calibration, RegionalCorrection};
use crate::sessions::{Instrument, Region, Samples, Session, hash_of_samples};

use super::subject::{Origin, Subject};
use crate::gui::cache::outcome::{Answer, Loaded};

/// A model and the file that it was read from.
#[derive(Debug, Clone)]
pub(crate) struct Given {
    /// The model.
    pub(crate) calibration: Calibration,
    /// The file.
    pub(crate) path: PathBuf,
}

impl PartialEq for Given {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

/// The factor from a standard error to half of a 95 % interval: a model keeps its covariance and
/// not the number of samples behind it.
const HALF_WIDTH: f64 = 1.96;

/// Method of an [`Identification`] that was none.
pub(crate) const METHOD: &str = "model";

impl Given {
    /// A model that was read from a file.
    pub(crate) fn new(calibration: Calibration, path: &Path) -> Self {
        Self {
            calibration,
            path: path.to_path_buf(),
        }
    }

    /// The file's name.
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
    pub(crate) fn alone(&self) -> Subject {
        let Calibration { model, targets, .. } = &self.calibration;
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
        let mut subject = Subject::new(session, Vec::new(), Origin::Model(self.path.clone()));
        subject.measured_range = self.calibration.measured.first().copied();
        subject
    }

    /// What the model says about a session.
    pub(crate) fn answer(&self, subject: &Subject) -> Result<Answer, String> {
        let calibration = self.calibration.clone();
        let mut loaded = Loaded {
            file: self.file_name(),
            verification: None,
        };
        if subject.is_empty() {
            let identification = self.identification(subject, None);
            return Ok(Answer {
                identification,
                calibration,
                loaded: Some(loaded),
                after_mm: Default::default(),
                lengths_mm: Vec::new(),
                suspected: Vec::new(),
            });
        }
        let verification = verify(&calibration, &subject.session).map_err(|e| e.to_string())?;
        let identification = self.identification(subject, Some(&verification));
        let mut suspected = vec![false; subject.len()];
        for outlier in &verification.outliers {
            suspected[*outlier] = true;
        }
        let after = verification.after.clone();
        loaded.verification = Some(verification);
        Ok(Answer {
            identification,
            calibration,
            loaded: Some(loaded),
            after_mm: after.axes_mm,
            lengths_mm: after.length_mm,
            suspected,
        })
    }

    /// The model in the form of an identification: the same panels show both.
    fn identification(&self, subject: &Subject, verified: Option<&Verification>) -> Identification {
        let Calibration {
            model, covariance, ..
        } = &self.calibration;
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
            session: subject.session.name.clone(),
            method: METHOD,
            samples: subject.len(),
            model: model.clone(),
            covariance: covariance.clone(),
            parameters: self.parameters(),
            regions: self.regions(subject, verified),
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
                stopped: "read from a file",
                converged: true,
                passes: 0,
                coefficients,
                rank: coefficients,
                condition: 1.0,
            },
            notes: verified.map_or_else(Vec::new, |v| v.notes.clone()),
        }
    }

    fn parameters(&self) -> Vec<Estimate> {
        let Calibration {
            model, covariance, ..
        } = &self.calibration;
        let fits = |c: &&nalgebra::DMatrix<f64>| c.nrows() == model.coefficient_count();
        let covariance = covariance.as_ref().filter(fits);
        let mut first = 0;
        let mut all = Vec::new();
        for term in model.terms() {
            let size = term.coefficients.len();
            let own = covariance.map(|c| c.view((first, first), (size, size)).into_owned());
            let kind = model.robot.joints[term.joint].kind;
            let open = vec![false; size];
            all.extend(estimates(term, own.as_ref(), HALF_WIDTH, &open, kind));
            first += size;
        }
        all
    }

    fn regions(&self, subject: &Subject, verified: Option<&Verification>) -> Vec<RegionResult> {
        let region = |c: &RegionalCorrection| Region {
            name: c.name.clone(),
            from_rad: c.from_rad,
            to_rad: c.to_rad,
        };
        let corrections = &self.calibration.regions;
        let regions: Vec<Region> = corrections.iter().map(region).collect();
        let assignment = Assignment::new(&regions);
        let before_mm = subject.in_plane_before();
        let rms = |region: usize, lengths_mm: &[f64]| {
            let inside = |i: usize| assignment.region_of(subject.q(i)) == Some(region);
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
}
