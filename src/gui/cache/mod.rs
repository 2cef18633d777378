//! What is worked out once, in the background, so that no frame looks at all samples; and what plots of many samples
//! stand on: the heat map, what the charts are made of. A few samples are simply looked at
//! anew in every frame, so that nothing has to be waited for.

use std::cell::RefCell;
use std::sync::{Arc, OnceLock};

use crate::compensation::decision::{FittedErrors, MeasuredDeviation};
use crate::compensation::{self, VerifiedCalibration};
use crate::effects::{Inputs, JointValues};
use crate::export::poses::measured_poses;
use crate::export::{Export, Job, Options, Reference};
use crate::fit::gap::Spread;
use crate::gui::core::answer::{Answer, Question, QuestionDetails, answer};
use crate::gui::core::document::ExportChoice;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::jobs::Watch;
use crate::language::spoken;
use crate::pipeline::{self, CheckedExport};
use crate::sessions::files::open::read_document;
use crate::standards::Standards;
use crate::text::Text;

pub(crate) mod heat;

/// The session and the answer that something is worked out for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlotInputs {
    pub(crate) loaded_session: Arc<LoadedSession>,
    pub(crate) identified: Option<Arc<IdentifiedAnswer>>,
}

/// What was worked out last, and of what: the same is not worked out again.
#[derive(Debug)]
pub(crate) struct Memo<K, V>(RefCell<Option<(K, V)>>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(RefCell::new(None))
    }
}

impl<K: PartialEq, V: Clone> Memo<K, V> {
    pub(crate) fn get(&self, of: K, make: impl FnOnce() -> V) -> V {
        let last = self.0.take().filter(|(before, _)| *before == of);
        let (of, made) = last.unwrap_or_else(|| (of, make()));
        self.0.replace(Some((of, made.clone())));
        made
    }
}

impl PlotInputs {
    pub(crate) fn answer(&self) -> Option<&Answer> {
        self.identified.as_ref()?.answer.as_ref().ok()
    }
}

// An answer to a question, made ready for drawing, and what is worked out of it in the background: the
// export as it would be written, and the standards' figures.

/// An answer to a question.
#[derive(Debug, Clone)]
pub(crate) struct IdentifiedAnswer {
    pub(crate) question: Question,
    /// The answer, or why there is none.
    pub(crate) answer: Result<Answer, String>,
    /// What files are made of, or why none are; worked out when it is first asked for.
    handed_out: OnceLock<Result<Arc<VerifiedCalibration>, String>>,
}

only_itself!(IdentifiedAnswer);

impl IdentifiedAnswer {
    /// Works the answer out. Takes its time with many samples.
    pub(crate) fn to(question: Question, watch: &Watch) -> Self {
        Self {
            answer: answer(&question, watch),
            question,
            handed_out: OnceLock::new(),
        }
    }

    /// The model that files are made of: verified on the session that it came from, or read from a file.
    /// Takes its time with many samples.
    pub(crate) fn handed_out(&self) -> Result<Arc<VerifiedCalibration>, String> {
        let verified = || {
            let answer = self.answer.as_ref().map_err(Clone::clone)?;
            if let QuestionDetails::Given(given) = &self.question.asks {
                return Ok(Arc::new(given.calibration.clone()));
            }
            let session = &self.question.loaded_session.session;
            let verified = pipeline::hand_out(&answer.calibration, session);
            verified
                .map(Arc::new)
                .map_err(|error| spoken(error.describe()))
        };
        self.handed_out.get_or_init(verified).clone()
    }
}

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

impl PreviewRequest {
    /// The export under this name; refused where it makes the session worse.
    pub(crate) fn made(&self, name: &str) -> Result<CheckedExport, String> {
        let choice = &self.choice;
        let reference = choice.reference.as_ref().map(|path| {
            let read = read_document(path);
            read.map(|bytes| (path.display().to_string(), bytes))
        });
        let reference = reference.transpose();
        let reference = reference.map_err(|error| spoken(error.describe()))?;
        let verified = self.identified.handed_out()?;
        let job = Job {
            joint: choice.joint,
            step: choice.step,
            options: Options {
                zeros: choice.zeros,
                motors: choice.motors,
                convention: choice.convention,
                reference: (reference.as_ref()).map(|(name, bytes)| Reference { name, bytes }),
            },
            ..Job::new(&verified, name)
        };
        let session = &self.identified.question.loaded_session.session;
        pipeline::export_for(choice.format, &job, session).map_err(|e| spoken(e.describe()))
    }
}

/// An export as it would be written, and what it does.
#[derive(Debug)]
pub(crate) struct ExportPreview {
    /// Name of the joint whose table it is.
    pub(crate) joint: String,
    pub(crate) export: Export,
    /// What no joint can remove.
    pub(crate) remainder: compensation::Remainder,
    /// RMS error of the session with this export, the controller's own interpolation in it.
    pub(crate) error: Option<Spread>,
}

only_itself!(ExportPreview);

/// Makes an export in memory, to be looked at before it is saved, or says why there is none.
pub(crate) fn preview(wanted: &PreviewRequest) -> Result<Arc<ExportPreview>, String> {
    let (outcome, choice) = (&wanted.identified, &wanted.choice);
    let session = &outcome.question.loaded_session.session;
    let calibration = &*outcome.handed_out()?;
    let name = wanted.name.clone();
    let name = name.unwrap_or_else(|| choice.file_name(&session.name));
    let inputs = if outcome.question.loaded_session.is_empty() {
        measured_poses(&Job::new(calibration, &name))
    } else {
        Inputs::new(session, JointValues::Commanded)
    };
    let made = wanted.made(&name)?;
    Ok(Arc::new(ExportPreview {
        remainder: compensation::Remainder::new(calibration, &inputs),
        error: made.gaps.map(|[_, after]| after),
        joint: session.robot.joints[choice.joint].name.clone(),
        export: made.export,
    }))
}

/// What the standards say.
#[derive(Debug, Clone)]
pub(crate) struct StandardsFigures {
    /// The deviation that is held against the tolerance, or why there is none.
    pub(crate) measured: Result<MeasuredDeviation, Text>,
    pub(crate) standards: Standards,
}

/// The standards' figures of a session, as the window shows them. Takes its time with many samples.
///
/// # Errors
/// Why there are none.
pub(crate) fn figures(
    of: &PlotInputs,
    diagnosed: Option<FittedErrors>,
) -> Result<StandardsFigures, String> {
    let session = &of.loaded_session.session;
    let answer = of.answer().ok_or(say!("Identify the robot first"))?;
    let figures = pipeline::standards(session, Some(&answer.calibration))
        .map_err(|e| spoken(e.describe()))?;
    let fitted = diagnosed.unwrap_or_else(|| FittedErrors::from(&answer.identification));
    Ok(StandardsFigures {
        measured: pipeline::conformity(session, &answer.calibration, fitted),
        standards: figures,
    })
}
