//! The standards' figures of the session, as the window shows them: worked out in the background,
//! once for each identification.

use crate::language::spoken;
use crate::text::Text;
use std::sync::Arc;

use super::identified::IdentifiedAnswer;
use crate::compensation::decision::{FittedErrors, MeasuredDeviation};
use crate::pipeline;
use crate::present::standards::{Group, groups};
use crate::present::table::{Cell, Table};

#[derive(Debug, Clone)]
pub(crate) struct Figures {
    /// The identification behind the corrected commands.
    pub(crate) identified: Arc<IdentifiedAnswer>,
    /// What noise alone leaves, where a diagnosis has shown it.
    pub(crate) floor_mm: Option<f64>,
    /// The figures, or why there are none; `None` while they are worked out.
    pub(crate) made: Option<Result<StandardsFigures, String>>,
}

/// What the standards say.
#[derive(Debug, Clone)]
pub(crate) struct StandardsFigures {
    /// The deviation that is held against the tolerance, or why there is none.
    pub(crate) measured: Result<MeasuredDeviation, Text>,
    /// One for each axis, and one for the poses.
    pub(crate) groups: Vec<Group>,
    /// What else there is to say.
    pub(crate) notes: Vec<Text>,
}

impl Figures {
    /// Works them out. Takes its time with many samples.
    pub(crate) fn of(outcome: Arc<IdentifiedAnswer>, floor_mm: Option<f64>) -> Self {
        let made = made(&outcome, floor_mm);
        Self {
            identified: outcome,
            floor_mm,
            made: Some(made),
        }
    }
}

fn made(outcome: &IdentifiedAnswer, floor_mm: Option<f64>) -> Result<StandardsFigures, String> {
    let answer = outcome.answer.as_ref().map_err(Clone::clone)?;
    let session = &outcome.question.loaded_session.session;
    let figures = pipeline::standards(session, Some(&answer.calibration))
        .map_err(|e| spoken(e.describe()))?;
    let found = &answer.identification;
    let fitted = FittedErrors {
        fit_mm: found.gap.after.rms_mm,
        held_out_mm: found.held_out.as_ref().map(|gap| gap.after.rms_mm),
        floor_mm,
    };
    Ok(StandardsFigures {
        measured: pipeline::conformity(session, &answer.calibration, fitted),
        groups: groups(&figures, 1),
        notes: figures.notes,
    })
}

/// The figures as a table for a spreadsheet, tabs between the columns.
pub(crate) fn as_text(made: &StandardsFigures) -> String {
    let mut table =
        Table::headed("standard | of | symbol | figure | unit | as measured | corrected commands");
    for group in &made.groups {
        for row in &group.rows {
            table.row([
                group.standard.into(),
                group.title.to_string().into(),
                row.symbol.into(),
                row.name.english().into(),
                group.unit.into(),
                row.before.into(),
                Cell::from(row.after),
            ]);
        }
    }
    table.tabbed()
}
