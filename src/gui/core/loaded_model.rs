//! A model that was read from a file: it takes the place of an identification.
//!
//! With a session of the same robot it is held against the samples by
//! [`verify`](crate::compensation::verify), as the terminal does it. Without one there is nothing
//! to hold it against: its parameters, its table and its history are shown by themselves.

use std::path::{Path, PathBuf};

use crate::compensation::VerifiedCalibration;
use crate::model::Calibration;
use crate::sessions::{Instrument, Samples, Session, hash_of_samples};

use super::loaded_session::{LoadedSession, Origin};

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
