//! The standards' figures of the session, as the window shows them: worked out in the background,
//! once for each identification.

use std::sync::Arc;

use super::identified::Outcome;
use crate::present::standards::{Group, groups};
use crate::present::table::{Cell, Table};

#[derive(Debug, Clone)]
pub(crate) struct Figures {
    /// The identification behind the corrected commands.
    pub(crate) outcome: Arc<Outcome>,
    /// The figures, or why there are none; `None` while they are worked out.
    pub(crate) made: Option<Result<Made, String>>,
}

/// What the standards say.
#[derive(Debug, Clone, Default)]
pub(crate) struct Made {
    /// One for each axis, and one for the poses.
    pub(crate) groups: Vec<Group>,
    /// What else there is to say.
    pub(crate) notes: Vec<String>,
}

impl Figures {
    /// Works them out. Takes its time with many samples.
    pub(crate) fn of(outcome: Arc<Outcome>) -> Self {
        let made = made(&outcome);
        Self {
            outcome,
            made: Some(made),
        }
    }
}

fn made(outcome: &Outcome) -> Result<Made, String> {
    let answer = outcome.answer.as_ref().map_err(Clone::clone)?;
    let session = &outcome.question.subject.session;
    let figures = crate::pipeline::standards(session, Some(&answer.calibration))
        .map_err(|e| e.to_string())?;
    Ok(Made {
        groups: groups(&figures, 1),
        notes: figures.notes,
    })
}

/// The figures as a table for a spreadsheet, tabs between the columns.
pub(crate) fn as_text(made: &Made) -> String {
    let headings = [
        "standard",
        "of",
        "symbol",
        "figure",
        "unit",
        "as measured",
        "corrected commands",
    ];
    let mut table = Table::new(headings);
    for group in &made.groups {
        for row in &group.rows {
            table.row([
                group.standard.into(),
                group.title().into(),
                row.symbol.into(),
                row.name.into(),
                group.unit.into(),
                row.before.into(),
                Cell::from(row.after),
            ]);
        }
    }
    table.tabbed()
}
