//! The types of a diagnosis.

use crate::effects::curve::Curve;
use crate::effects::{Inputs, JointValues, Term};
use crate::model::shapes::{Shape, Where};
use crate::model::{Calibration, Model, ResidualStep, SetUp};
use crate::sessions::{Session, SessionCorrection};
use crate::text::{Template, Text};
use crate::text::{length, lengths};

use super::identification::{Estimate, Identification, Outlier};
use super::limits::Limit;
use super::noise::{Noise, StatedNoise};
use super::pose::NextPose;

named! {
    /// The short answer.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Verdict {
        /// Nothing is missing.
        Noise = "noise",
        /// Names explain what was missing.
        Explained = "explained",
        /// Names explain a part of it.
        PartlyExplained = "partly-explained",
        /// Something is missing that no name explains.
        Unexplained = "unexplained",
    }
    /// Its name in JSON.
    pub fn name;
}

/// Where the noise floor comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FloorFrom {
    /// Returns to the same pose.
    Repeats,
    /// The maker's statement of the instrument.
    Instrument,
    /// The residuals of the final model.
    Estimated,
}

/// The smallest RMS error that noise allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// Root mean square length, mm.
    pub mm: f64,
    /// Where it comes from.
    pub from: FloorFrom,
}

/// Gaps in mm: of the nominal robot, after the identification, with everything that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaps {
    /// Nominal robot.
    pub start_mm: f64,
    /// After zero offset and link length.
    pub identified_mm: f64,
    /// With everything that was found.
    pub end_mm: f64,
}

/// Gaps on samples that the fit has not seen.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// How they were held out.
    pub how: Text,
    /// How many.
    pub samples: usize,
    /// The gaps; `None` where there are too few samples.
    pub gaps: Option<Gaps>,
}

impl HeldOut {
    /// No error on unseen samples, for this reason.
    pub(crate) fn none(why: Text) -> Self {
        Self {
            how: why,
            samples: 0,
            gaps: None,
        }
    }
}

/// An effect that was missing.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundEffect {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 1; `None` where it belongs to none.
    pub joint: Option<usize>,
    /// Its parameters.
    pub parameters: Vec<Estimate>,
    /// Figures of it in this session that are no parameters: name with its unit, and the value where the
    /// samples show it.
    pub figures: Vec<(&'static str, Option<f64>)>,
    /// The chance that the search finds as much in noise alone.
    pub p_familywise: FamilyP,
    /// Its share of what was explained.
    pub share: f64,
    /// Gaps without and with it, in the order found, mm.
    pub gap_mm: [f64; 2],
    /// The same on samples that the fit has not seen; `None` where there are too few.
    pub held_out_mm: Option<[f64; 2]>,
    /// How much likelier than the next name in its place.
    pub odds_over_next: f64,
    /// Of a step, the times between which it lies with 95 %, s. (The interval of its `time_s` is that between the
    /// samples around the likeliest time.)
    pub within_s: Option<[f64; 2]>,
    /// The next name, if any.
    pub next: Option<String>,
    /// What else is known of it: the motor's turn that its order is of, when a step was, what looks the same.
    pub notes: Vec<Text>,
    /// The evidence in words, with the notes.
    pub explanation: Text,
    /// What to look at on the machine.
    pub check: Template,
}

/// Why a search ended before it had looked for everything. What is reported then is as certain as ever; there may be
/// more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stopped {
    /// The watcher asked for what was proven until then.
    Asked,
    /// The budget of the search is spent.
    Budget,
}

impl Stopped {
    /// In documents.
    pub fn name(self) -> &'static str {
        match self {
            Self::Asked => "asked",
            Self::Budget => "budget",
        }
    }

    /// In words.
    pub fn describe(self) -> Template {
        match self {
            Self::Asked => phrase!("the search was stopped: this is what was proven until then"),
            Self::Budget => {
                phrase!("the search stopped at its budget: this is what was proven until then")
            }
        }
    }
}

/// Another set of names that the samples cannot rule out.
#[derive(Debug, Clone, PartialEq)]
pub struct Equivalent {
    /// Names of the model that it replaces; of several joints each with its joint, as in
    /// `encoder-eccentricity 2`.
    pub explanation: Vec<String>,
    /// By these.
    pub instead: Vec<String>,
    /// How much likelier the model is.
    pub odds: f64,
    /// What would distinguish them.
    pub separate_by: Text,
    /// Where the names are the same: the other orders (of a screw the leads, mm) that the steps between the poses
    /// cannot distinguish from that of the model. Empty where the names differ.
    pub orders: Vec<f64>,
    /// The other model.
    pub model: Model,
}

/// The residual that no name explains.
#[derive(Debug, Clone, PartialEq)]
pub struct Unexplained {
    /// Whether something is.
    pub present: bool,
    /// Chance (0 to 1) that noise alone would look as much like it.
    pub p: f64,
    /// RMS residual, mm.
    pub rms_mm: f64,
    /// Where.
    pub place: Option<Where>,
    /// Names that only imitate a part of it; of several joints each with its joint.
    pub resembles: Vec<String>,
    /// In words; empty where nothing is unexplained.
    pub description: Text,
    /// The shapes themselves with their coefficients.
    pub shapes: Vec<(Shape, Vec<f64>)>,
    /// Noise as stated and as found, where they differ; whether anything is unexplained or not.
    pub noise: Option<StatedNoise>,
}

/// What predicts samples that no fit has seen and has no name; its terms are in the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Unnamed {
    /// RMS length by which it reduces the residuals, mm.
    pub rms_mm: f64,
    /// RMS error on samples that the fit has not seen, without and with it, mm.
    pub held_out_mm: [f64; 2],
    /// What it depends on: a column as in `q1_deg`, of several joints as in `joint 2 (gravity)`.
    pub over: Vec<Text>,
    /// The curve over the joint, of a robot with a single one.
    pub curve: Option<Correction>,
}

impl Unnamed {
    /// With what predicts in addition to it.
    pub(crate) fn and(self, more: Self) -> Self {
        Self {
            rms_mm: self.rms_mm.hypot(more.rms_mm),
            held_out_mm: [self.held_out_mm[0], more.held_out_mm[1]],
            over: [self.over, more.over].concat(),
            curve: self.curve,
        }
    }

    /// What predicts in addition to the curve over the joint.
    pub fn beside_the_curve(&self) -> &[Text] {
        let of_curve = usize::from(self.curve.is_some());
        &self.over[of_curve..]
    }

    /// In words.
    pub fn describe(&self) -> Text {
        let others = self.beside_the_curve();
        if let Some(curve) = &self.curve {
            let curve = curve.description.clone();
            if others.is_empty() {
                return curve;
            }
            return text!(
                "{curve}; in addition {over}, with which the cross-validated RMS error is {error}",
                curve,
                over = Text::listed(others, ", "),
                error = length(self.held_out_mm[1], 4)
            );
        }
        text!(
            "{size} that no name is proven for predict unseen poses all the same and are in the model: cross-validated {change}, over {over}; outside the measured range they fade to nothing",
            size = length(self.rms_mm, 4),
            change = lengths([self.held_out_mm[0], self.held_out_mm[1]], 4),
            over = Text::listed(&self.over, ", ")
        )
    }
}

/// What a diagnosis answers, with everything that terminal, window, report and JSON need; see [`crate::diagnosis`].
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Name of the session.
    pub session: String,
    /// Number of samples.
    pub samples: usize,
    /// The short answer.
    pub verdict: Verdict,
    /// Set-up errors and losses.
    pub data_problems: Vec<DataProblem>,
    /// Why something that might have been found was not looked for; `None` where everything was.
    pub stopped: Option<Stopped>,
    /// The noise floor.
    pub floor: Floor,
    /// Gaps over the samples that were fitted.
    pub gap: Gaps,
    /// Gaps over samples that were not.
    pub held_out: HeldOut,
    /// What belongs to every calibration.
    pub identified: Vec<Estimate>,
    /// What was missing, in the order found.
    pub found: Vec<FoundEffect>,
    /// What cannot be ruled out, likeliest first.
    pub equivalent: Vec<Equivalent>,
    /// What no name explains.
    pub unexplained: Unexplained,
    /// The part of the model without a name that predicts unseen poses; `None` where there is none.
    pub unnamed: Option<Unnamed>,
    /// What the session cannot show.
    pub not_testable: Vec<NotTestable>,
    /// What would have been seen.
    pub not_found: Vec<Limit>,
    /// Suspected samples, counted from 0.
    pub outliers: Vec<Outlier>,
    /// What to measure next.
    pub next_poses: Vec<NextPose>,
    /// The noise as the search saw it.
    pub noise: Noise,
    /// The model with everything that was found.
    pub model: Model,
    /// The fit that values and intervals come from.
    pub identification: Identification,
    /// The RMS error step by step.
    pub history: Vec<ResidualStep>,
    /// Corrections of the session's set-up, after which everything else here is; its poses to measure next
    /// are as the controller takes them.
    pub set_up: SetUp,
}

impl Diagnosis {
    /// What repeats over the only joint and has no name, if anything.
    pub fn correction(&self) -> Option<&Correction> {
        self.unnamed.as_ref()?.curve.as_ref()
    }

    /// The terms of the model that predict without a name.
    pub fn unnamed_terms(&self) -> Vec<Term> {
        let rest = self
            .model
            .terms()
            .iter()
            .filter(|term| term.rest().is_some());
        let curve = self.correction().map(|correction| &correction.term);
        curve.into_iter().chain(rest).cloned().collect()
    }

    /// The answer without what repeats over the only joint and has no name; as it is where more without a name was fitted
    /// in addition to that.
    #[must_use]
    pub fn uncorrected(mut self) -> Self {
        if self.unnamed_terms().len() > 1 {
            return self;
        }
        if let Some(curve) = self
            .unnamed
            .take_if(|own| own.curve.is_some())
            .and_then(|own| own.curve)
        {
            self.gap.end_mm = curve.gap_mm[0];
            if let Some(held_out) = &mut self.held_out.gaps {
                held_out.end_mm = curve.held_out_mm[0];
            }
            self.history.pop();
        }
        self
    }

    /// Whether the samples can show any effect besides the ones that every calibration has. Where they cannot, an
    /// empty result is no statement about the robot.
    pub fn tested_anything(&self) -> bool {
        !(self.found.is_empty() && self.not_found.is_empty())
    }

    /// The calibration that goes with this answer, to be saved and exported; with the smooth
    /// correction of what is unexplained, where there is one.
    pub fn calibration(&self, session: &Session) -> Calibration {
        let mut model = self.model.clone();
        if let Some(correction) = self.correction() {
            model = model.with_term(correction.term.clone());
        }
        let read = self.set_up.applied(session, true);
        let inputs = Inputs::new(&read, JointValues::Commanded);
        Calibration {
            model,
            history: self.history.clone(),
            set_up: self.set_up.clone(),
            ..self.identification.calibration(&read, &inputs)
        }
    }
}

/// The repeating curve over the only joint that has no name, and its gain.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// The model's term under the name `unexplained`.
    pub term: Term,
    /// RMS error over the samples that were fitted, without and with it, mm.
    pub gap_mm: [f64; 2],
    /// RMS error on samples that the fit has not seen, without and with it, mm.
    pub held_out_mm: [f64; 2],
    /// RMS error with it on runs that the fit has not seen, mm; `None` where there is one run.
    pub runs_held_out_mm: Option<f64>,
    /// RMS error with it on values of the joint that the fit has not seen, mm, where their neighbours do not predict
    /// them.
    pub values_held_out_mm: Option<f64>,
    /// How they were held out.
    pub how: Text,
    /// In words.
    pub description: Text,
}

impl Correction {
    /// Its curve.
    pub fn curve(&self) -> Option<&Curve> {
        self.term.curve()
    }
}

/// The chance that noise alone reaches as much in the whole search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FamilyP {
    /// The chance; never below one over the number of simulations.
    pub p: f64,
    /// Whether it is a bound: "fewer than".
    pub bound: bool,
}

/// An effect that this session cannot show, and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotTestable {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 0; `None` where it belongs to none.
    pub joint: Option<usize>,
    /// Why.
    pub because: Text,
}

/// A mistake in the data, its evidence, and its correction.
#[derive(Debug, Clone, PartialEq)]
pub struct DataProblem {
    /// What is wrong.
    pub what: Text,
    /// What speaks for it.
    pub evidence: Text,
    /// What to do.
    pub proposal: Text,
    /// The same as a change of the session, where that is mechanical.
    pub mend: Option<SessionCorrection>,
    /// The samples that it is about, counted from 0; empty where it is about all of them.
    pub samples: Vec<usize>,
}

impl DataProblem {
    /// A mistake in all samples; without a correction it is only reported.
    pub(crate) fn of_all(
        what: Text,
        evidence: Text,
        proposal: Text,
        mend: impl Into<Option<SessionCorrection>>,
    ) -> Self {
        Self {
            what,
            evidence,
            proposal,
            mend: mend.into(),
            samples: Vec::new(),
        }
    }

    /// Samples that are to be left out.
    pub(crate) fn of_rows(what: Text, evidence: Text, proposal: Text, rows: Vec<usize>) -> Self {
        Self {
            mend: Some(SessionCorrection::Remove(rows.clone())),
            samples: rows,
            ..Self::of_all(what, evidence, proposal, None)
        }
    }
}
