//! The history of the RMS error, step by step.

use crate::kinematics::Robot;
use crate::model::ResidualStep;
use crate::sessions::Session;

use super::named::Figures;
use super::predicting::Predicting;
use crate::diagnosis::search::Step;

/// Terms that belong to every calibration of a robot.
fn base_in_words(robot: &Robot) -> &'static str {
    match robot.joints.len() {
        1 => "zero offset and link length",
        _ => "geometry: frame, zero offsets, links and tool",
    }
}

pub(super) fn history(session: &Session, steps: &[Step], with: &Predicting) -> Vec<ResidualStep> {
    let Figures { gap, held_out } = &with.names;
    let seen = held_out.gaps.as_ref();
    let one = |what: String, gap_mm: f64, held_out_mm: Option<f64>| ResidualStep {
        what,
        gap_mm,
        held_out_mm,
        runs_held_out_mm: None,
        values_held_out_mm: None,
    };
    let base = base_in_words(&session.robot).to_owned();
    let mut history = vec![
        one(
            "nominal robot".to_owned(),
            gap.start_mm,
            seen.map(|g| g.start_mm),
        ),
        one(base, gap.identified_mm, seen.map(|g| g.identified_mm)),
    ];
    history.extend(steps.iter().map(|step| {
        let what = format!("with {}", step.term.name_on(&session.robot));
        one(what, step.gap_mm[1], step.held_out_mm.map(|h| h[1]))
    }));
    if let (Some(last), false) = (history.last_mut(), steps.is_empty()) {
        // The steps are those of the search; the last is what is handed out.
        last.gap_mm = gap.end_mm;
        last.held_out_mm = seen.map(|g| g.end_mm);
    }
    history.extend(with.unnamed.as_ref().map(|unnamed| {
        let curve = unnamed.curve.as_ref();
        let what = match curve {
            Some(_) => format!("with {}", crate::effects::UNEXPLAINED),
            None => "with what predicts without a name".to_owned(),
        };
        let seen = with.figures.held_out.gaps.map(|g| g.end_mm);
        ResidualStep {
            runs_held_out_mm: curve.and_then(|c| c.runs_held_out_mm),
            values_held_out_mm: curve.and_then(|c| c.values_held_out_mm),
            ..one(what, with.figures.gap.end_mm, seen)
        }
    }));
    history
}
