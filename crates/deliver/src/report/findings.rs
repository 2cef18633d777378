//! What a diagnosis found, what it leaves open, and what it could not see: the sections of its answer, under the
//! headings of a report.

use super::document::{Block, Section};
use super::session::ReportContext;
use crate::explain::{self, Detail, Topic};

impl ReportContext<'_> {
    /// Effects, open points, and what could not be seen.
    pub(super) fn findings(&self) -> Findings {
        let (mut effects, mut open, mut sight) = (Vec::new(), Vec::new(), Vec::new());
        for section in explain::diagnosis(self.found, Detail::REPORT) {
            let under = match section.topic {
                Topic::Answer => continue,
                Topic::Found(_) => &mut effects,
                Topic::Limits | Topic::NotTestable => &mut sight,
                _ => &mut open,
            };
            under.push(Block::Heading(section.title));
            under.extend(section.blocks);
        }
        if open.is_empty() {
            let nothing = say!(
                "Nothing in these samples: no data problem, no rival explanation, nothing left without a name, no outlier"
            );
            open.push(Block::Text(nothing.to_owned()));
        }
        if sight.is_empty() {
            let all = say!("Every effect of the catalogue is in the model");
            sight.push(Block::Text(all.to_owned()));
        }
        let has_effects = !effects.is_empty();
        Findings {
            effects: has_effects.then(|| Section::new(say!("Effects found"), effects)),
            open: Section::new(say!("Open points"), open),
            sight: Section::new(say!("What the session could not show"), sight),
        }
    }
}

/// The sections of a diagnosis in a report.
pub(super) struct Findings {
    /// What was found; `None` where nothing was.
    pub(super) effects: Option<Section>,
    /// What is open.
    pub(super) open: Section,
    /// What could not be seen.
    pub(super) sight: Section,
}
