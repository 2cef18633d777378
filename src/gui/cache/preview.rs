//! An export as it would be written: made ready to be looked at before it is saved.

use crate::language::spoken;
use std::sync::Arc;

use crate::compensation::Remainder;
use crate::effects::{Inputs, JointValues};
use crate::export::poses::measured_poses;
use crate::export::{Export, Job};
use crate::fit::gap::Spread;
use crate::pipeline;

use super::identified::IdentifiedAnswer;
use crate::gui::core::document::ExportChoice;

/// What is to be exported.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PreviewRequest {
    /// The identification that it comes from.
    pub(crate) identified: Arc<IdentifiedAnswer>,
    pub(crate) choice: ExportChoice,
    /// What the file is called, where it was saved already: what is to be entered in the controller
    /// names it.
    pub(crate) name: Option<String>,
}

#[derive(Debug, Clone)]
pub(crate) struct Preview {
    pub(crate) wanted: PreviewRequest,
    /// What it gives, or why it gives nothing.
    pub(crate) made: Result<ExportPreview, String>,
}

/// An export and what it does.
#[derive(Debug, Clone)]
pub(crate) struct ExportPreview {
    /// Name of the joint whose table it is.
    pub(crate) joint: String,
    pub(crate) export: Export,
    /// What no joint can remove.
    pub(crate) remainder: Remainder,
    /// RMS error of the session with this export, the controller's own interpolation in it.
    pub(crate) error: Option<Spread>,
}

impl Preview {
    /// Makes the export in memory.
    pub(crate) fn of(wanted: PreviewRequest) -> Self {
        let made = made(&wanted);
        Self { wanted, made }
    }
}

fn made(wanted: &PreviewRequest) -> Result<ExportPreview, String> {
    let PreviewRequest {
        identified: outcome,
        choice,
        name,
    } = wanted;
    let session = &outcome.question.loaded_session.session;
    let calibration = &*outcome.handed_out()?;
    let name = name.clone();
    let name = name.unwrap_or_else(|| choice.file_name(&session.name));
    let job = Job {
        joint: choice.joint,
        step: choice.step,
        ..Job::new(calibration, &name)
    };
    let inputs = if outcome.question.loaded_session.is_empty() {
        measured_poses(&job)
    } else {
        Inputs::new(session, JointValues::Commanded)
    };
    let made =
        pipeline::export_for(choice.format, &job, session).map_err(|e| spoken(e.describe()))?;
    let export = made.export;
    Ok(ExportPreview {
        remainder: Remainder::new(calibration, &inputs),
        error: made.gaps.map(|[_, after]| after),
        joint: session.robot.joints[choice.joint].name.clone(),
        export,
    })
}
