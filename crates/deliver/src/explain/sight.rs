//! What would have been seen, and what these samples could not show.

use super::{Block, Detail, Fact, Section, Topic};
use crate::diagnosis::Diagnosis;
use crate::present::limits::{self, limits_of};

/// Every effect that was looked for and not found, with the size from which it would have been seen.
pub(super) fn limits(d: &Diagnosis, detail: Detail) -> Option<Section> {
    let facts = limits_of(&d.model.robot, &d.not_found);
    let heading = say!("Not found; detection limits (95 %)");
    listed(Topic::Limits, heading, facts, detail)
}

/// What these samples cannot show, a line for each reason.
pub(super) fn not_testable(d: &Diagnosis, detail: Detail) -> Option<Section> {
    let heading = say!("Not testable with these samples");
    listed(Topic::NotTestable, heading, limits::not_testable(d), detail)
}

fn listed(topic: Topic, heading: &str, mut facts: Vec<Fact>, detail: Detail) -> Option<Section> {
    facts.truncate(4 * detail.most);
    (!facts.is_empty()).then(|| Section::of(topic, heading, vec![Block::Facts(facts)]))
}
