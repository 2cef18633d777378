//! The standards' figures of the session, as the window shows them: worked out in the background,
//! once for each identification.

use std::sync::Arc;

use crate::standards::axis::AxisTest;
use crate::standards::pose::{Largest, PoseTest};
use crate::standards::{Positioning, at_least, standards};

use super::identified::Outcome;
use crate::gui::units::{plain_number, significant};

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

/// The figures of one test.
#[derive(Debug, Clone)]
pub(crate) struct Group {
    /// What was tested.
    pub(crate) title: String,
    /// After which standard.
    pub(crate) standard: &'static str,
    /// Unit of the figures.
    pub(crate) unit: &'static str,
    /// Under which conditions.
    pub(crate) says: String,
    pub(crate) rows: Vec<Row>,
    /// Why others are missing.
    pub(crate) missing: Vec<String>,
}

#[derive(Debug, Clone)]
pub(crate) struct Row {
    /// Its symbol in the standard.
    pub(crate) symbol: &'static str,
    pub(crate) name: &'static str,
    /// As measured.
    pub(crate) before: Option<f64>,
    /// With corrected commands.
    pub(crate) after: Option<f64>,
}

impl Row {
    /// Both values as the screen shows them.
    pub(crate) fn shown(&self) -> [String; 2] {
        [self.before, self.after]
            .map(|value| value.map_or_else(|| "–".to_owned(), |v| significant(v, 3)))
    }
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
    let figures = standards(session, Some(&answer.calibration)).map_err(|e| e.to_string())?;
    let mut groups: Vec<Group> = figures.axes.iter().map(of_axis).collect();
    groups.push(of_poses(&figures.poses, figures.compensated));
    Ok(Made {
        groups,
        notes: figures.notes,
    })
}

fn of_axis(axis: &AxisTest) -> Group {
    let mut group = Group {
        title: format!("Joint {} ({})", axis.joint + 1, axis.name),
        standard: "ISO 230-2",
        unit: axis.unit,
        says: String::new(),
        rows: Vec::new(),
        missing: axis.missing.iter().cloned().collect(),
    };
    let Some(series) = axis.series.first() else {
        return group;
    };
    let [up, down] = series.before.fewest_runs();
    group.says = format!(
        "{}; {} positions, {} from below, {} from above",
        series.fixed.in_words(axis),
        series.before.positions.len(),
        at_least(up),
        at_least(down)
    );
    let after = series.after.as_ref().map(Positioning::rows);
    let rows = series.before.rows().into_iter().enumerate();
    group.rows = rows
        .filter(|(_, (_, _, before))| before.is_some())
        .map(|(k, (symbol, name, before))| Row {
            symbol,
            name,
            before,
            after: after.as_ref().and_then(|rows| rows[k].2),
        })
        .collect();
    group.missing.extend(series.missing.iter().cloned());
    let others = axis.series.len() - 1 + axis.more;
    if others > 0 {
        group.missing.push(format!(
            "{others} more series under other conditions, which are not shown here"
        ));
    }
    group
}

fn of_poses(test: &PoseTest, compensated: bool) -> Group {
    let before = test.largest(false);
    let after = if compensated {
        test.largest(true)
    } else {
        Largest::default()
    };
    let rows = before.rows().into_iter().zip(after.rows());
    Group {
        title: "Poses".to_owned(),
        standard: "ISO 9283",
        unit: "mm",
        says: match test.poses.len() {
            0 => String::new(),
            1 => "one pose with two cycles or more".to_owned(),
            n => format!("the largest of {n} poses with two cycles or more"),
        },
        rows: rows
            .filter(|((_, _, before), _)| before.is_some())
            .map(|((symbol, name, before), (_, _, after))| Row {
                symbol,
                name,
                before,
                after,
            })
            .collect(),
        missing: test.missing.clone(),
    }
}

/// The figures as a table for a spreadsheet, tabs between the columns.
pub(crate) fn as_text(made: &Made) -> String {
    let mut text =
        "standard\tof\tsymbol\tfigure\tunit\tas measured\tcorrected commands\n".to_owned();
    let number = |value: Option<f64>| value.map_or_else(String::new, plain_number);
    for group in &made.groups {
        for row in &group.rows {
            let cells = [
                group.standard.to_owned(),
                crate::gui::units::cell(&group.title),
                row.symbol.to_owned(),
                row.name.to_owned(),
                group.unit.to_owned(),
                number(row.before),
                number(row.after),
            ];
            text += &cells.join("\t");
            text.push('\n');
        }
    }
    text
}
