//! What an identification answers, made ready for drawing.

use std::cell::Cell;
use std::sync::Arc;

use crate::compensation::Verification;
use crate::diagnosis::Diagnosis;
use crate::effects::inputs::reflectors_at_home;
use crate::effects::{Inputs, JointValues, Term};
use crate::fit::gap::deviations;
use crate::fit::problem::Problem;
use crate::fit::regions::{Assignment, RegionChoice};
use crate::fit::{Identification, identify_regional, identify_watched};
use crate::model::{Calibration, GapStep};

use super::document::{Asks, Question};
use super::layers::Remainder;
use super::overview::{Lengths, readable};
use super::subject::Subject;
use super::tasks::Watch;

/// An answer to a question.
#[derive(Debug, Clone)]
pub(crate) struct Outcome {
    /// What was asked.
    pub(crate) question: Question,
    /// The answer, or why there is none.
    pub(crate) answer: Result<Answer, String>,
    /// What follows from it for drawing.
    pub(crate) after: Option<After>,
}

/// What every frame needs to know of an answer, worked out once.
#[derive(Debug, Clone)]
pub(crate) struct After {
    /// What is left, as it is uploaded.
    pub(crate) remainder: Arc<Remainder>,
    /// Lengths of what is left.
    pub(crate) lengths: Lengths,
    /// The magnification at which what is left can be read.
    pub(crate) readable: f64,
}

impl After {
    fn new(subject: &Subject, answer: &Answer) -> Self {
        let remainder = subject.cloud.remainder(&answer.after_mm, &answer.suspected);
        Self {
            remainder: Arc::new(remainder),
            lengths: Lengths::new(&answer.lengths_mm),
            readable: readable(subject.overview.reach_mm, &answer.lengths_mm),
        }
    }
}

/// An identification, and what is left of every sample's deviation.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    /// The identification.
    pub(crate) identification: Identification,
    /// The model that goes with it, to be saved and exported.
    pub(crate) calibration: Calibration,
    /// Where the model was read from, if it was.
    pub(crate) loaded: Option<Loaded>,
    /// What is left of the deviations, mm; NaN for samples that cannot be used.
    pub(crate) after_mm: [Vec<f64>; 3],
    /// Their lengths, mm.
    pub(crate) lengths_mm: Vec<f64>,
    /// Suspected outliers.
    pub(crate) suspected: Vec<bool>,
}

/// What there is to say about a model that was read from a file.
#[derive(Debug, Clone)]
pub(crate) struct Loaded {
    /// The file's name.
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

impl Outcome {
    /// Works the answer out. Takes its time with many samples.
    pub(crate) fn of(question: Question, watch: &Watch) -> Self {
        let answer = answer(&question, watch);
        let after = answer.as_ref().ok();
        let after = after.map(|answer| After::new(&question.subject, answer));
        Self {
            question,
            answer,
            after,
        }
    }
}

fn answer(question: &Question, watch: &Watch) -> Result<Answer, String> {
    let subject = &*question.subject;
    let session = &subject.session;
    let values = JointValues::Commanded;
    let mut steps = vec![];
    let searched = searched(question);
    let (identification, after_mm) = match &question.asks {
        Asks::Exact { effects, with, .. } => {
            let effects: Vec<String> = effects.iter().map(|&e| e.to_owned()).collect();
            // How many passes there will be nobody knows; each takes a part of what is left.
            let left = Cell::new(1.0_f64);
            let go_on = || {
                left.set(left.get() * 0.85);
                watch.done(1.0 - left.get());
                !watch.stopped()
            };
            let first = |n: usize| identify_watched(session, &effects, &with[..n], values, &go_on);
            let identification = first(with.len()).map_err(|e| e.to_string())?;
            let identification = if let Some((diagnosis, calibration)) = &searched {
                diagnosis.identification(session, calibration, identification)
            } else {
                for n in 0..with.len() {
                    let before = first(n).map_err(|e| e.to_string())?;
                    steps.push(before.gap.after.rms_mm);
                }
                steps.push(identification.gap.after.rms_mm);
                identification
            };
            let problem = Problem::new(session, values);
            let after = deviations(&problem, &identification.model);
            (identification, after.axes_mm)
        }
        Asks::Regional(regions) => {
            let choice = RegionChoice::Given(regions.to_vec());
            let identification =
                identify_regional(session, &choice, values).map_err(|e| e.to_string())?;
            let after = after_regional(subject, &identification);
            (identification, after)
        }
        Asks::Given(given) => return given.answer(subject),
    };
    let length = |i: usize| after_mm.iter().map(|e| e[i] * e[i]).sum::<f64>().sqrt();
    let lengths_mm = (0..subject.len()).map(length).collect();
    let mut suspected = vec![false; subject.len()];
    for outlier in &identification.outliers {
        suspected[outlier.sample] = true;
    }
    let calibration = if let Some((_, calibration)) = searched {
        calibration
    } else {
        let mut plain = identification.calibration(session, &Inputs::new(session, values));
        if let Asks::Exact { with, .. } = &question.asks
            && !with.is_empty()
        {
            plain.history.truncate(1);
            plain.history.extend(history(with, &steps));
        }
        plain
    };
    Ok(Answer {
        identification,
        calibration,
        loaded: None,
        after_mm,
        lengths_mm,
        suspected,
    })
}

/// What a search says, and its calibration, where all that it found is asked for; with its smooth
/// correction only where that is asked for too.
fn searched(question: &Question) -> Option<(Diagnosis, Calibration)> {
    let Asks::Exact { with, found, .. } = &question.asks else {
        return None;
    };
    let mut diagnosis = found.as_ref()?.diagnosis()?.clone();
    if with.len() == diagnosis.found.len() {
        diagnosis = diagnosis.uncorrected();
    }
    let calibration = diagnosis.calibration(&question.subject.session);
    Some((diagnosis, calibration))
}

/// The gap after the identification and after each effect that was added.
fn history(with: &[Term], gaps_mm: &[f64]) -> Vec<GapStep> {
    let name = |k: usize| match k.checked_sub(1).map(|k| &with[k]) {
        None => "exact identification".to_owned(),
        Some(term) => format!("with {}", term.effect.about().id),
    };
    let step = |(k, gap_mm): (usize, &f64)| GapStep {
        what: name(k),
        gap_mm: *gap_mm,
        held_out_mm: None,
    };
    gaps_mm.iter().enumerate().map(step).collect()
}

/// Deviations after the paper's correction (8): e + M Δρ of the sample's region, in the plane of
/// motion at home. A sample in no region keeps its deviation: nothing corrects it.
fn after_regional(subject: &Subject, identification: &Identification) -> [Vec<f64>; 3] {
    let session = &subject.session;
    let inputs = Inputs::new(session, JointValues::Commanded);
    let frame = subject.joint;
    let (x, y) = if frame.radius_mm > 0.0 {
        (frame.radial, frame.tangential)
    } else {
        (frame.across_1, frame.across_2)
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let radii = reflectors_at_home(session).into_iter().map(|home| {
        let arm = std::array::from_fn(|k| home[k] - frame.origin_mm[k]);
        dot(arm, x).hypot(dot(arm, y))
    });
    let radii: Vec<f64> = radii.collect();
    let corrections = identification.regions.iter().map(|r| &r.correction);
    let regions = corrections.clone().map(|c| crate::sessions::Region {
        name: c.name.clone(),
        from_rad: c.from_rad,
        to_rad: c.to_rad,
    });
    let (regions, corrections): (Vec<_>, Vec<_>) = (regions.collect(), corrections.collect());
    let assignment = Assignment::new(&regions);
    let mut after = subject.before.axes_mm.clone();
    for sample in 0..subject.len() {
        let Some(region) = assignment.region_of(inputs.q[0][sample]) else {
            continue;
        };
        let correction = corrections[region];
        let target = inputs.target.as_deref().map_or(0, |t| t[sample] as usize);
        let along_y_mm = radii[target] * correction.theta_rad;
        for axis in 0..3 {
            after[axis][sample] += x[axis] * correction.l1_mm + y[axis] * along_y_mm;
        }
    }
    after
}
