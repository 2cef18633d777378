//! What an import brings: samples, how they fit the nominal robot, how commands and measurements came together.

use super::{Block, Detail, Fact, Section, Topic, fact};
use crate::fit::gap::Spread;
use crate::importers::{Alignment, Matched, Matching};
use crate::present::numbers::grouped;

/// What there is to say; problems and notes with their places are the import log.
#[doc(hidden)]
pub fn imported(
    samples: usize,
    nominal: Option<Spread>,
    matched: Option<&Matched>,
    alignment: Option<&Alignment>,
    detail: Detail,
) -> Section {
    let mut facts = vec![fact(say!("samples"), grouped(samples))];
    if let Some(nominal) = nominal {
        let error = detail.length(nominal.rms_mm);
        facts.push(fact(say!("RMS error, nominal robot"), error));
    }
    if let Some(matched) = matched {
        facts.extend(matched_by(matched));
    }
    if let Some(alignment) = alignment {
        let points = say!(
            "{points} points, RMS distance {rms}",
            points = alignment.residuals.len() - alignment.outliers().count(),
            rms = detail.length(alignment.rms_mm)
        );
        facts.push(fact(say!("reference points"), points));
    }
    let title = say!("What the import brings");
    Section::of(Topic::Answer, title, vec![Block::Facts(facts)])
}

fn matched_by(matched: &Matched) -> Vec<Fact> {
    let by = match matched.by {
        Matching::Order => say!("row order"),
        Matching::Time => say!("time"),
        Matching::Name => say!("name"),
    };
    let unmatched = say!(
        "{measurements} measured, {commands} commanded",
        measurements = matched.lonely_measurements.len(),
        commands = matched.lonely_commands.len()
    );
    let mut facts = vec![
        fact(say!("matched by"), by),
        fact(say!("unmatched"), unmatched),
    ];
    if let Some(clock) = &matched.clock {
        let offset = match clock.ci95_s() {
            Some([from, to]) => format!("{:.4} ± {:.4} s", clock.offset_s, 0.5 * (to - from)),
            None => format!("{:.4} s", clock.offset_s),
        };
        facts.push(fact(say!("clock offset"), offset));
    }
    facts
}
