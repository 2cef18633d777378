//! A table or a corrected robot as it is exported: what it leaves of a session, what joint commands cannot correct,
//! what its numbers mean.

use super::{Block, Detail, Fact, Section, Topic, cleaned, fact};
use crate::compensation::Remainder;
use crate::export::Export;
use crate::fit::gap::Spread;
use crate::present::numbers::with_minus_signs;
use crate::text::{Text, capital};

/// An export with what it is held against.
#[derive(Debug, Clone, Copy)]
#[doc(hidden)]
pub struct Exported<'a> {
    /// The export.
    pub export: &'a Export,
    /// RMS error of the session under the export, where there is one and that can be said.
    pub error: Option<Spread>,
    /// RMS error of the nominal robot on the session, as every other answer states it.
    pub nominal: Option<Spread>,
    /// RMS error of the model itself on the session, mm, where that is known.
    pub identified_mm: Option<f64>,
    /// What no joint can correct; `None` where that was not worked out.
    pub remainder: Option<&'a Remainder>,
}

/// What it leaves, what its numbers mean, what else there is to know.
#[doc(hidden)]
pub fn table(of: &Exported<'_>, detail: Detail) -> Vec<Section> {
    let _speaking = detail.speaking();
    let mut sections: Vec<Section> = leaves(of, detail).into_iter().collect();
    let meaning: Vec<String> = of
        .export
        .meaning
        .iter()
        .map(|line| spoken(line, detail))
        .collect();
    // Notes are for places that show nothing else: they have the meaning and what no joint can correct in them.
    let said = of.remainder.map_or(&[][..], |_| &of.export.stays);
    let more = of.export.notes.iter().filter(|line| !said.contains(line));
    let more = more.map(|line| spoken(line, detail));
    let more: Vec<String> = more.filter(|line| !meaning.contains(line)).collect();
    for (title, lines) in [
        (say!("What the numbers mean"), meaning),
        (say!("Notes"), more),
    ] {
        if !lines.is_empty() {
            sections.push(Section::new(title, vec![Block::List(lines)]));
        }
    }
    sections
}

/// A line of the export; other programs read the terminal's minus signs.
fn spoken(line: &Text, detail: Detail) -> String {
    let line = cleaned(line);
    if detail.brief {
        line
    } else {
        with_minus_signs(&line)
    }
}

/// What no joint removes, effect by effect: over the measured range, as files have it, since the samples of a session
/// would give other digits; of the session what only its conditions show, such as a load.
pub(crate) fn not_correctable(in_file: &[Text], of_session: &[Text]) -> Vec<Text> {
    // What stands before the size.
    let about = |line: &Text| {
        let line = cleaned(line);
        let before = line.split('.').next().unwrap_or_default();
        before
            .trim_end_matches(|c: char| c.is_ascii_digit())
            .to_owned()
    };
    let is_new = |line: &&Text| in_file.iter().all(|known| about(known) != about(line));
    let more = of_session.iter().filter(is_new);
    in_file.iter().chain(more).cloned().collect()
}

/// The error that is left: of the session where there is one, else what the model says of every joint command.
fn leaves(of: &Exported<'_>, detail: Detail) -> Option<Section> {
    let describes = of.export.robot.is_some();
    let cannot = of.remainder.filter(|_| !describes);
    let mut blocks = Vec::new();
    let title = if let Some(error) = of.error {
        blocks.push(Block::Facts(figures(of, error, cannot, detail)));
        if cannot.is_some_and(|remainder| error.rms_mm < remainder.rms_mm) {
            let says =
                say!("The predicted residual exceeds the measured one: the model does not fit");
            blocks.push(Block::Warning(says.to_owned()));
        }
        let title = if describes {
            say!("RMS error with this robot")
        } else {
            say!("RMS error left by the table")
        };
        title.to_owned()
    } else {
        let left = detail.length(cannot?.rms_mm);
        let own = fact(say!("not correctable by joint commands"), left);
        blocks.push(Block::Facts(vec![own]));
        capital(say!("not correctable by joint commands"))
    };
    if let Some(remainder) = cannot {
        // Its sum, which stands above, comes first.
        let in_file = of.export.stays.get(1..).unwrap_or_default();
        let lines = not_correctable(in_file, &remainder.describe());
        let says: Vec<String> = lines.iter().map(|line| spoken(line, detail)).collect();
        if !says.is_empty() {
            blocks.push(Block::List(says));
        }
    }
    Some(Section::of(Topic::Answer, title, blocks))
}

/// The figure that the controller is left with, and what it is to be read with: first how much of it no command removes.
fn figures(
    of: &Exported<'_>,
    error: Spread,
    cannot: Option<&Remainder>,
    detail: Detail,
) -> Vec<Fact> {
    let leaves = of.export.left.as_ref().and_then(|left| left.leaves);
    let figures = [
        (say!("RMS error"), Some(error.rms_mm)),
        (
            say!("not correctable by joint commands"),
            cannot.map(|remainder| remainder.rms_mm),
        ),
        (say!("largest"), Some(error.max_mm)),
        (
            say!("RMS error, cross-validated"),
            leaves.map(|leaves| leaves.leaves_mm),
        ),
        (
            say!("RMS error, nominal robot"),
            of.nominal.map(|nominal| nominal.rms_mm),
        ),
        (say!("model and measurement"), of.identified_mm),
    ];
    let figures = figures.into_iter();
    figures
        .filter_map(|(name, mm)| Some(fact(name, detail.length(mm?))))
        .collect()
}
