//! The exact fit while samples are still coming: from sample to sample by recursive least squares
//! ([`Recursive`]), and from scratch whenever the linearisation has become too old.
//!
//! From scratch means the whole of [`identify_exact`](super::identify_exact): which effects the
//! samples can show, settings, outliers, the weights of the axes. In between all that stands still,
//! and a new sample that is far off is left out at once.

use crate::effects::{JointValues, Term};
use crate::model::Model;
use crate::sessions::Session;

use super::IdentifyError;
use super::exact::{Fresh, prepare, report};
use super::gap::deviations;
use super::outcome::{Identification, NotIdentifiable};
use super::problem::{Problem, Watch};
use super::recursive::Recursive;
use super::robust::suspects;

/// What one answer leaves for the next.
#[derive(Debug, Clone)]
pub struct Live {
    recursive: Recursive,
    /// Which samples were taken.
    used: Vec<bool>,
    not_identifiable: Vec<NotIdentifiable>,
    effects: Vec<String>,
    known: Vec<Term>,
    /// Whether the last answer came from the new samples alone.
    online: bool,
}

impl Live {
    /// Whether the last answer came by the new samples alone, and not from scratch.
    pub fn is_online(&self) -> bool {
        self.online
    }

    /// Whether this can be brought along to what is asked for now.
    fn leads_to(&self, session: &Session, effects: &[String], known: &[Term]) -> bool {
        // The sums of several joints lack the rows of their priors: those are fitted from scratch.
        !super::base_model::is_arm(session)
            && self.effects == effects
            && self.known == known
            && self.recursive.linearised_at().robot == session.robot
            && self.used.len() <= session.samples.len()
    }
}

/// Fits the named effects and terms like [`identify_with`](super::identify_with). `before` is what
/// the answer to the same question left when the session was shorter: then only the samples behind
/// those are fitted, at a cost that does not grow with the number before.
///
/// # Errors
/// As [`identify_watched`](super::identify_watched).
pub fn identify_live(
    session: &Session,
    effects: &[String],
    known: &[Term],
    values: JointValues,
    before: Option<&Live>,
    go_on: &dyn Fn() -> bool,
) -> Result<(Identification, Live), IdentifyError> {
    let before = before.filter(|b| b.leads_to(session, effects, known));
    if let Some(found) = before.and_then(|b| brought_along(session, b, values, go_on)) {
        return Ok(found);
    }
    let fresh = Fresh::fitted(prepare(session, effects, known, values, go_on)?, go_on)?;
    let live = Live {
        recursive: Recursive::at(&fresh.problem, &fresh.fitted.model),
        used: fresh.problem.used.clone(),
        not_identifiable: fresh.not_identifiable.clone(),
        effects: effects.to_vec(),
        known: known.to_vec(),
        online: false,
    };
    Ok((fresh.report(session), live))
}

/// The answer by the new samples alone; `None` where the linearisation would be too old.
fn brought_along(
    session: &Session,
    before: &Live,
    values: JointValues,
    go_on: &dyn Fn() -> bool,
) -> Option<(Identification, Live)> {
    let mut live = before.clone();
    let mut problem = Problem::new(session, values);
    problem.watch = Watch::by(go_on);
    let now = deviations(&problem, &live.recursive.solution().model);
    let suspected = suspects(&problem, &now);
    for sample in live.used.len()..session.samples.len() {
        live.used.push(problem.fit[sample] && !suspected[sample]);
    }
    problem.used.clone_from(&live.used);
    live.recursive.take(&mut problem);
    if live.recursive.is_stale() || !go_on() {
        return None;
    }
    live.online = true;
    let nominal = Model::nominal(session.robot.clone());
    let solution = live.recursive.solution();
    let open = live.not_identifiable.clone();
    Some((report(session, &problem, solution, &nominal, open), live))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identification::{DEFAULT_EFFECTS, identify_exact};
    use crate::sessions::{Samples, Sigma, parse_with_csv};

    fn bundled() -> Session {
        let document = include_bytes!("../../sessions/lamp-commissioning.json");
        let samples = include_bytes!("../../sessions/lamp-commissioning.csv");
        parse_with_csv(document, samples).unwrap().session
    }

    fn first(session: &Session, n: usize) -> Session {
        let mut first = session.clone();
        let behind: Vec<usize> = (n..session.samples.len()).collect();
        Samples::remove(&mut first.samples, &behind);
        first
    }

    fn effects() -> Vec<String> {
        DEFAULT_EFFECTS.map(str::to_owned).to_vec()
    }

    /// How many answers came from the new samples alone, and how far the furthest of them was from
    /// the batch's, in parts of its interval.
    fn growing(whole: &Session) -> (usize, f64) {
        let values = JointValues::default();
        let (mut live, mut online, mut worst) = (None, 0, 0.0_f64);
        for n in (40..=whole.samples.len()).step_by(4) {
            let now = first(whole, n);
            let (found, next) =
                identify_live(&now, &effects(), &[], values, live.as_ref(), &|| true).unwrap();
            let batch = identify_exact(&now, &effects(), values).unwrap();
            if next.is_online() {
                online += 1;
            } else {
                assert_eq!(found, batch, "{n} samples");
            }
            live = Some(next);
            for (a, b) in found.parameters.iter().zip(&batch.parameters) {
                let [low, high] = b.ci95.unwrap();
                worst = worst.max((a.value - b.value).abs() / (high - low));
            }
        }
        (online, worst)
    }

    #[test]
    fn a_session_that_grows_has_the_answer_of_the_batch_at_every_moment() {
        // With the weights of the axes given, nothing but the linearisation is older.
        let mut whole = bundled();
        whole.instrument.sigma_mm = Some(Sigma::PerAxis([0.03; 3]));
        let (online, worst) = growing(&whole);
        assert!(online > 20, "only {online} came from the new samples alone");
        assert!(worst < 1e-3, "{worst} of an interval");
    }

    #[test]
    fn weights_that_are_a_little_old_matter_less_than_the_noise() {
        let (online, worst) = growing(&bundled());
        assert!(online > 20, "only {online} came from the new samples alone");
        assert!(worst < 0.1, "{worst} of an interval");
    }

    #[test]
    fn another_question_begins_from_scratch() {
        let whole = bundled();
        let values = JointValues::default();
        let go_on = || true;
        let (_, live) =
            identify_live(&first(&whole, 190), &effects(), &[], values, None, &go_on).unwrap();
        let more = vec!["joint-zero-offset".to_owned()];
        let (found, next) = identify_live(&whole, &more, &[], values, Some(&live), &go_on).unwrap();
        assert!(!next.is_online());
        assert_eq!(found, identify_exact(&whole, &more, values).unwrap());
    }

    #[test]
    fn nobody_waits_for_an_answer_that_was_cancelled() {
        let found = identify_live(
            &bundled(),
            &effects(),
            &[],
            JointValues::default(),
            None,
            &|| false,
        );
        assert_eq!(found.unwrap_err(), IdentifyError::Cancelled);
    }
}
