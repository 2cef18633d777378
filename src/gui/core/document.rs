//! What the window works on, as one value: everything in it can be undone. Also how its regions came to be
//! divided, and what the adaptive division decided and why.

use std::sync::Arc;

use crate::diagnosis::Diagnosis;
use crate::effects::{JointValues, Term};
use crate::export::{find, usual};
use crate::fit::{DEFAULT_EFFECTS, regions_of};
use crate::kinematics::Robot;
use crate::language::spoken;
use crate::model::RegionalCorrection;
use crate::pipeline::{self, identify};
use crate::present::units::Units;
use crate::sessions::division::RegionChoice;
use crate::sessions::{Region, Session};

use super::answer::LoadedModel;
use super::answer::{self, Search};
use super::loaded_session::LoadedSession;

/// How the robot is identified.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Method {
    /// Nonlinear least squares in the measuring frame.
    #[default]
    Exact,
    /// The paper's corrections, region by region.
    Regional,
}

/// Which table is exported, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ExportChoice {
    /// Name of the format.
    pub(crate) format: &'static str,
    /// Joint, counted from 0.
    pub(crate) joint: usize,
    /// Step of the table, degrees or mm; `None`: what the format needs.
    pub(crate) step: Option<f64>,
}

impl ExportChoice {
    /// What is offered first.
    fn usual(robot: &Robot) -> Self {
        Self {
            format: usual(robot).id,
            joint: 0,
            step: None,
        }
    }

    /// Whether it is the same table, at whatever step.
    pub(crate) fn is_of_the_table(self, other: Self) -> bool {
        (self.format, self.joint) == (other.format, other.joint)
    }

    /// What the file is called unless the user says otherwise.
    pub(crate) fn file_name(&self, session: &str) -> String {
        let (session, format) = (plain(session), find(self.format));
        let extension = format.map_or("txt", |format| format.extension);
        if format.is_some_and(|format| format.rules.is_none()) {
            // It is about the whole robot.
            return format!("{session}.{extension}");
        }
        format!("{session}-joint-{}.{extension}", self.joint + 1)
    }
}

/// A name that every file system takes.
pub(crate) fn plain(name: &str) -> String {
    let kept = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
    let words = name.split(|c| !kept(c)).filter(|word| !word.is_empty());
    let name = words.collect::<Vec<_>>().join("-");
    if name.is_empty() {
        "session".to_owned()
    } else {
        name
    }
}

/// An effect that a search found and that was added to the model.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Added {
    /// Its term, as the search left it.
    pub(crate) term: Term,
    /// Whether it is in the model at present.
    pub(crate) on: bool,
}

/// How a session was identified, as far as that outlives the window.
#[derive(Debug, Clone)]
pub(crate) struct Choices {
    pub(crate) identified: bool,
    pub(crate) method: Method,
    /// Effects of the exact fit; names that no effect has do not count.
    pub(crate) effects: Vec<String>,
    /// Effects that were added to it.
    pub(crate) added: Vec<Added>,
}

/// See the module. Cloning is cheap: the session is shared.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Document {
    pub(crate) loaded_session: Arc<LoadedSession>,
    /// Regions of joint 1.
    pub(crate) regions: Arc<[Region]>,
    pub(crate) division: Division,
    pub(crate) method: Method,
    /// Effects of the exact fit, in the order of the catalogue.
    pub(crate) effects: Vec<&'static str>,
    /// Effects that a search found and that were added to the exact fit, in that order.
    pub(crate) added: Arc<[Added]>,
    /// How far a measured position may be off, mm.
    pub(crate) tolerance_mm: Option<f64>,
    /// How the table is exported.
    pub(crate) export: ExportChoice,
    /// A model that takes the place of the identification.
    pub(crate) loaded_model: Option<Arc<LoadedModel>>,
    /// Whether the robot is to be identified; from then on the answer follows every change.
    pub(crate) identified: bool,
}

impl Document {
    /// A session as it is opened: its own regions and tolerance, nothing identified yet.
    pub(crate) fn new(loaded_session: Arc<LoadedSession>) -> Self {
        let regions = if loaded_session.single_revolute() && !loaded_session.is_empty() {
            // A session at one angle has no range to divide, and so no regions.
            regions_of(&RegionChoice::FromSession, &loaded_session.session).unwrap_or_default()
        } else {
            Vec::new()
        };
        let division = if loaded_session.session.regions.is_empty() {
            Division::Even
        } else {
            Division::Given
        };
        Self {
            regions: regions.into(),
            division,
            method: Method::default(),
            effects: DEFAULT_EFFECTS.to_vec(),
            added: Arc::from([]),
            tolerance_mm: loaded_session.session.tolerance_mm,
            export: ExportChoice::usual(&loaded_session.session.robot),
            loaded_model: None,
            identified: false,
            loaded_session,
        }
    }

    /// The same with a model that was read from a file.
    pub(crate) fn with_model(self, loaded_model: Arc<LoadedModel>) -> Self {
        let regions = if self.loaded_session.is_empty() {
            loaded_model
                .calibration
                .regions
                .iter()
                .map(RegionalCorrection::region)
                .collect()
        } else {
            self.regions
        };
        Self {
            regions,
            loaded_model: Some(loaded_model),
            identified: true,
            ..self
        }
    }

    /// The session with what was changed here, as it is saved.
    pub(crate) fn session_to_save(&self) -> Session {
        let mut session = self.loaded_session.session.clone();
        session.regions = self.regions.to_vec();
        session.tolerance_mm = self.tolerance_mm;
        session
    }

    /// What was added and is switched on.
    pub(crate) fn in_the_model(&self) -> impl Iterator<Item = &Term> {
        let on = self.added.iter().filter(|added| added.on);
        on.map(|added| &added.term)
    }

    /// What the answer depends on; `None` while nothing is to be identified.
    pub(crate) fn question(&self) -> Option<Question> {
        self.identified.then(|| Question {
            loaded_session: Arc::clone(&self.loaded_session),
            asks: match (&self.loaded_model, self.method) {
                (Some(given), _) => QuestionDetails::Given(Arc::clone(given)),
                (None, Method::Exact) => QuestionDetails::Exact {
                    effects: self.effects.clone(),
                    with: self.in_the_model().cloned().collect(),
                    found: None,
                },
                (None, Method::Regional) => QuestionDetails::Regional(Arc::clone(&self.regions)),
            },
        })
    }
}

/// What to identify, from what.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Question {
    pub(crate) loaded_session: Arc<LoadedSession>,
    pub(crate) asks: QuestionDetails,
}

/// The part of a [`Question`] beside the session.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum QuestionDetails {
    /// Exactly these effects.
    Exact {
        effects: Vec<&'static str>,
        /// What a search found, with its settings.
        with: Vec<Term>,
        /// The search, where all of this is just what it found: its own values are the answer then.
        found: Option<RequestedSearch>,
    },
    /// A correction for each of these regions.
    Regional(Arc<[Region]>),
    /// What this model says.
    Given(Arc<LoadedModel>),
}

/// A search whose answer is asked for.
#[derive(Debug, Clone)]
pub(crate) struct RequestedSearch {
    search: Arc<Search>,
    /// Whether the smooth correction of what no name explains is asked for too.
    corrected: bool,
}

impl PartialEq for RequestedSearch {
    fn eq(&self, other: &Self) -> bool {
        let same = Arc::ptr_eq(&self.search, &other.search);
        self.corrected == other.corrected && (same || self.search.answer == other.search.answer)
    }
}

impl RequestedSearch {
    /// The search, where these terms are all that it found.
    fn all_of(search: &Arc<Search>, with: &[Term]) -> Option<Self> {
        let diagnosis = search.answer.as_ref().ok()?;
        let mut terms: Vec<Term> = answer::terms(diagnosis).into_iter().flatten().collect();
        let same = |terms: &[Term]| {
            terms.len() == with.len() && terms.iter().all(|term| with.contains(term))
        };
        let corrected = diagnosis.correction().is_some();
        let all = same(&terms);
        let all_names = corrected && terms.pop().is_some() && same(&terms);
        (all || all_names).then(|| Self {
            search: Arc::clone(search),
            corrected: corrected && all,
        })
    }

    /// What it found, with no more of the smooth correction than is asked for.
    pub(crate) fn diagnosis(&self) -> Option<Diagnosis> {
        let diagnosis = self.search.answer.as_ref().ok()?.clone();
        Some(if self.corrected {
            diagnosis
        } else {
            diagnosis.uncorrected()
        })
    }
}

impl Question {
    /// The same, answered by the search where it asks for all that the search found and nothing
    /// else. A session with set-up errors was corrected before it was searched: its own fit is another.
    pub(crate) fn found_by(mut self, search: &Arc<Search>) -> Self {
        let QuestionDetails::Exact {
            effects,
            with,
            found,
        } = &mut self.asks
        else {
            return self;
        };
        let base = effects.len() == DEFAULT_EFFECTS.len()
            && DEFAULT_EFFECTS.iter().all(|id| effects.contains(id));
        let clean = |d: &Diagnosis| d.data_problems.is_empty();
        let as_given = search.answer.as_ref().is_ok_and(clean);
        if base && as_given && Arc::ptr_eq(&search.loaded_session, &self.loaded_session) {
            *found = RequestedSearch::all_of(search, with);
        }
        self
    }
}

/// How the regions came about.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) enum Division {
    /// All of the same width.
    Even,
    /// The session's own, or changed by hand since.
    #[default]
    Given,
    /// Where the samples ask for them.
    Adaptive(Decision),
}

/// What the adaptive division decided.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Decision {
    /// How many regions.
    pub(crate) regions: usize,
    /// The gap that they leave, mm; `None` where nothing can be identified by region.
    pub(crate) left_mm: Option<f64>,
    /// The gap that as many even ones leave, mm.
    pub(crate) even_mm: Option<f64>,
}

impl Decision {
    /// What was decided and why, in one line.
    pub(crate) fn describe(&self, units: Units) -> String {
        if self.regions == 1 {
            return say!("One region: nowhere does the deviation change by more than the noise")
                .to_owned();
        }
        let n = self.regions;
        match (self.left_mm, self.even_mm) {
            (Some(left), Some(even)) => say!(
                "{n} regions: a boundary where the deviation changes by more than the noise. They leave {left}, {n} even ones {even}",
                n,
                left = units.length(left),
                even = units.length(even)
            ),
            _ => say!(
                "{n} regions: a boundary where the deviation changes by more than the noise",
                n
            ),
        }
    }
}

/// Divides where the samples ask for it. Takes its time with many samples.
pub(crate) fn adapt(session: &Session) -> Result<(Vec<Region>, Decision), String> {
    let regions = regions_of(&RegionChoice::Adaptive, session).map_err(|e| spoken(e.describe()))?;
    let left = |choice| {
        let method = pipeline::Method::Regional(choice);
        let (found, _) = identify(session, &method, JointValues::Commanded).ok()?;
        Some(found.gap.after.rms_mm)
    };
    let decision = Decision {
        regions: regions.len(),
        left_mm: left(RegionChoice::Given(regions.clone())),
        even_mm: left(RegionChoice::Uniform(regions.len())),
    };
    Ok((regions, decision))
}
