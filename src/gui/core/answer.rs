//! What is asked of the samples and what they answer, and a model that was read from a file: it takes the place of an
//! identification, so that the same panels show both.
//!
//! With a session of the same robot a model is held against the samples by
//! [`verify`](crate::compensation::verify), as the terminal does it. Without one there is nothing to
//! hold it against: its parameters and its table are shown by themselves.

use std::cell::Cell;
use std::path::PathBuf;
use std::sync::Arc;

use crate::answers::diagnosis::DataProblem;
use crate::compensation::{Regional, Verification, VerifiedCalibration};
use crate::diagnosis::Diagnosis;
use crate::effects::{Inputs, JointValues, Term};
use crate::fit::gap::{Deviations, Spread, deviations};
use crate::fit::problem::Problem;
use crate::fit::uncertainty::{all_estimates, normal_95};
use crate::fit::{DEFAULT_EFFECTS, Gap, Identification, Outlier, Quality, RegionResult};
use crate::gui::core::disk::name_of;
use crate::gui::core::loaded_session::{LoadedSession, Origin, Remainder};
use crate::gui::core::overview::Readable;
use crate::gui::core::search::{Search, term_of};
use crate::gui::jobs::Watch;
use crate::language::spoken;
use crate::model::{Calibration, RegionalCorrection};
use crate::numeric::Ascending;
use crate::pipeline::{Identified, Method, identify_checked, identify_checked_unless, verify};
use crate::sessions::division::RegionChoice;
use crate::sessions::regions::Assignment;
use crate::sessions::{Instrument, Region, Samples, Session, hash_of_samples};

/// An identification, and what is left of every sample's deviation.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub(crate) identification: Identification,
    /// The model that goes with it, to be saved and exported.
    pub(crate) calibration: Calibration,
    /// Problems of the data; what is mechanical was corrected before the fit.
    pub(crate) data_problems: Vec<DataProblem>,
    /// What a model that was read from a file does on the session; `None` where nothing was measured, or it was identified.
    pub(crate) verification: Option<Verification>,
    /// What is left of the deviations; NaN for samples that cannot be used.
    pub(crate) after: Deviations,
    /// The same as it is uploaded.
    pub(crate) remainder: Arc<Remainder>,
    /// Ascending of what is left.
    pub(crate) lengths: Ascending,
    /// What decides at which magnification what is left can be read.
    pub(crate) readable: Readable,
}

impl Answer {
    /// With what every frame needs to know of it.
    fn new(
        identified: Identified,
        verification: Option<Verification>,
        after: Deviations,
        loaded_session: &LoadedSession,
    ) -> Self {
        let suspected = suspected(&identified.identification, loaded_session.len());
        let remainder = loaded_session.cloud().remainder(&after.axes_mm, &suspected);
        Self {
            identification: identified.identification,
            calibration: identified.calibration,
            data_problems: identified.data_problems,
            verification,
            remainder: Arc::new(remainder),
            lengths: Ascending::new(&after.length_mm),
            readable: Readable::new(loaded_session.overview.radius_mm, &after.length_mm),
            after,
        }
    }

    /// What is left of a sample's deviation, mm.
    pub(crate) fn deviation_after(&self, sample: usize) -> [f64; 3] {
        std::array::from_fn(|axis| self.after.axes_mm[axis][sample])
    }
}

/// A model and the file that it was read from.
#[derive(Debug, Clone)]
pub(crate) struct LoadedModel {
    pub(crate) calibration: VerifiedCalibration,
    pub(crate) path: PathBuf,
}

only_itself!(LoadedModel);

impl LoadedModel {
    pub(crate) fn file_name(&self) -> String {
        name_of(&self.path).into_owned()
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
fn of_model(loaded_model: &LoadedModel, loaded_session: &LoadedSession) -> Result<Answer, String> {
    let calibration = Calibration::clone(&loaded_model.calibration);
    let verified = if loaded_session.is_empty() {
        None
    } else {
        let session = &loaded_session.session;
        Some(verify(&calibration, session).map_err(|e| spoken(e.describe()))?)
    };
    let after = verified.as_ref().map(|v| v.after.clone());
    let identified = Identified {
        identification: identification(loaded_model, loaded_session, verified.as_ref()),
        calibration,
        data_problems: Vec::new(),
    };
    let after = after.unwrap_or_default();
    Ok(Answer::new(identified, verified, after, loaded_session))
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
    let outliers = verified.into_iter().flat_map(|v| {
        v.outliers.iter().map(|sample| Outlier {
            sample: *sample,
            deviation_mm: v.after.length_mm[*sample],
        })
    });
    Identification {
        session: loaded_session.session.name.clone(),
        method: METHOD,
        samples: loaded_session.len(),
        model: model.clone(),
        covariance: covariance.clone(),
        parameters: all_estimates(&loaded_model.calibration, normal_95()),
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
        outliers: outliers.collect(),
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

/// Which samples an identification suspects.
fn suspected(identification: &Identification, samples: usize) -> Vec<bool> {
    let mut suspected = vec![false; samples];
    for outlier in &identification.outliers {
        suspected[outlier.sample] = true;
    }
    suspected
}

// What is asked of an identification: by value, so that the same is not answered twice; and where a search has answered it.

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
        let same = |terms: &[Term]| {
            terms.len() == with.len() && terms.iter().all(|term| with.contains(term))
        };
        let found = diagnosis.found.iter();
        let names: Vec<Term> = found.filter_map(|f| term_of(diagnosis, f)).collect();
        let unnamed = diagnosis.unnamed_terms();
        let all = same(&[&*names, &*unnamed].concat());
        // What is no curve over a single joint was fitted together with the geometry: without it the fit is another.
        let corrected = diagnosis.correction().is_some() && unnamed.len() == 1;
        (all || corrected && same(&names)).then(|| Self {
            search: Arc::clone(search),
            corrected: all,
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

// The work behind an answer: the identification that a question asks for.

/// Works the answer to a question out. Takes its time with many samples.
pub(crate) fn answer(question: &Question, watch: &Watch) -> Result<Answer, String> {
    let loaded_session = &*question.loaded_session;
    let session = &loaded_session.session;
    let values = JointValues::Commanded;
    let identified = match &question.asks {
        QuestionDetails::Given(given) => return of_model(given, loaded_session),
        QuestionDetails::Exact {
            effects,
            with,
            found,
        } => {
            let searched = found.as_ref().and_then(RequestedSearch::diagnosis);
            match searched {
                Some(diagnosis) => of_search(session, &diagnosis),
                None => fitted(session, effects, with, watch)?,
            }
        }
        QuestionDetails::Regional(regions) => {
            let method = Method::Regional(RegionChoice::Given(regions.to_vec()));
            identify_checked(session, &method, values).map_err(|e| spoken(e.describe()))?
        }
    };
    let mut problems = identified.data_problems.iter();
    let axes_mm = if let QuestionDetails::Regional(_) = &question.asks {
        after_regional(loaded_session, &identified.identification)
    } else if problems.any(|problem| problem.mend.is_some()) {
        // The model reads the samples as they were corrected.
        let verified = verify(&identified.calibration, session);
        verified.map_err(|e| spoken(e.describe()))?.after.axes_mm
    } else {
        deviations(
            &Problem::new(session, values),
            &identified.identification.model,
        )
        .axes_mm
    };
    let length = |i: usize| axes_mm.iter().map(|e| e[i] * e[i]).sum::<f64>().sqrt();
    let length_mm = (0..loaded_session.len()).map(length).collect();
    let after = Deviations { axes_mm, length_mm };
    Ok(Answer::new(identified, None, after, loaded_session))
}

/// What a search says, where all that it found is asked for: its own fit, and the smooth correction
/// where that is asked for too.
fn of_search(session: &Session, diagnosis: &Diagnosis) -> Identified {
    let calibration = diagnosis.calibration(session);
    let mut identification = diagnosis.identification.clone();
    if !diagnosis.unnamed_terms().is_empty() {
        // The correction was made beside the fit: only the error that remains is another.
        let problem = Problem::new(session, JointValues::Commanded);
        let left = deviations(&problem, &calibration.model).length_mm;
        let suspected = suspected(&identification, left.len());
        let after = Spread::of(&left, |i| problem.fit[i], |i| suspected[i]);
        identification.gap.after = after.unwrap_or(identification.gap.after);
        identification.model = calibration.model.clone();
    }
    Identified {
        identification,
        calibration,
        data_problems: Vec::new(),
    }
}

/// A fit of these effects, with some of what a search found, of the session without its set-up errors.
fn fitted(
    session: &Session,
    effects: &[&'static str],
    with: &[Term],
    watch: &Watch,
) -> Result<Identified, String> {
    // The number of passes is not known; each takes a part of what is left.
    let left = Cell::new(1.0_f64);
    let go_on = || {
        left.set(left.get() * 0.85);
        watch.done(1.0 - left.get());
        !watch.stopped()
    };
    let method = Method::Exact {
        effects: effects.iter().map(|&id| id.to_owned()).collect(),
        with: with.to_vec(),
        priors: true,
    };
    identify_checked_unless(session, &method, JointValues::Commanded, &go_on)
        .map_err(|e| spoken(e.describe()))
}

/// Deviations after the paper's correction (8): e + M Δρ of the sample's region, in the plane of
/// motion at home. A sample in no region keeps its deviation: nothing corrects it.
fn after_regional(
    loaded_session: &LoadedSession,
    identification: &Identification,
) -> [Vec<f64>; 3] {
    let session = &loaded_session.session;
    let inputs = Inputs::new(session, JointValues::Commanded);
    let corrections = identification.regions.iter().map(|r| r.correction.clone());
    let regional = Regional::new(&session.robot, &corrections.collect::<Vec<_>>());
    let mut after = loaded_session.before.axes_mm.clone();
    let by_sample = regional.corrections_at(&inputs.q[0]);
    for (sample, correction) in by_sample.into_iter().enumerate() {
        let Some(correction) = correction else {
            continue;
        };
        let target = inputs.target.as_deref().map_or(0, |t| t[sample] as usize);
        let home = inputs.reflectors_at_home[target];
        let shift = regional.position_correction(correction, home);
        for axis in 0..3 {
            after[axis][sample] += shift[axis];
        }
    }
    after
}
