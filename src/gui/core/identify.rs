//! The work behind an answer: the identification that a question asks for.

use crate::language::spoken;
use std::cell::Cell;

use crate::compensation::Regional;
use crate::diagnosis::Diagnosis;
use crate::effects::{Inputs, JointValues, Term};
use crate::fit::Identification;
use crate::fit::gap::{Spread, deviations};
use crate::fit::problem::Problem;
use crate::pipeline::{Identified, Method, identify_checked, identify_checked_unless, verify};
use crate::sessions::Session;
use crate::sessions::division::RegionChoice;

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::question::{Question, QuestionDetails, RequestedSearch};
use crate::gui::jobs::Watch;

use super::answer::{of_model, suspected};

/// Works the answer to a question out. Takes its time with many samples.
pub(crate) fn answer(question: &Question, watch: &Watch) -> Result<Answer, String> {
    let loaded_session = &*question.loaded_session;
    let session = &loaded_session.session;
    let values = JointValues::Commanded;
    let Identified {
        identification,
        calibration,
        data_problems,
    } = match &question.asks {
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
    let after_mm = if let QuestionDetails::Regional(_) = &question.asks {
        after_regional(loaded_session, &identification)
    } else if data_problems.iter().any(|problem| problem.mend.is_some()) {
        // The model reads the samples as they were corrected.
        let verification = verify(&calibration, session).map_err(|e| spoken(e.describe()))?;
        verification.after.axes_mm
    } else {
        deviations(&Problem::new(session, values), &identification.model).axes_mm
    };
    let length = |i: usize| after_mm.iter().map(|e| e[i] * e[i]).sum::<f64>().sqrt();
    let lengths_mm = (0..loaded_session.len()).map(length).collect();
    let suspected = suspected(&identification, loaded_session.len());
    Ok(Answer {
        identification,
        calibration,
        data_problems,
        loaded: None,
        after_mm,
        lengths_mm,
        suspected,
    })
}

/// What a search says, where all that it found is asked for: its own fit, and the smooth correction
/// where that is asked for too.
fn of_search(session: &Session, diagnosis: &Diagnosis) -> Identified {
    let calibration = diagnosis.calibration(session);
    let mut identification = diagnosis.identification.clone();
    if diagnosis.correction().is_some() {
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
