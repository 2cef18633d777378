//! What would have been seen, and what these samples could not show.

use super::{Block, Detail, Fact, Section, Topic};
use crate::diagnosis::Diagnosis;
use crate::present::limits;
use crate::present::names::title;

/// Every effect that was looked for and not found, with the size from which it would have been seen.
pub(super) fn limits(d: &Diagnosis, detail: Detail) -> Option<Section> {
    let lines = limits::limits(d, name).into_iter();
    let facts = lines.map(|line| (line.names, line.text)).collect();
    let heading = say!("Not found; detection limits (95 %)");
    listed(Topic::Limits, heading, facts, detail)
}

/// What these samples cannot show, a line for each reason.
pub(super) fn not_testable(d: &Diagnosis, detail: Detail) -> Option<Section> {
    let lines = limits::not_testable(d, name).into_iter();
    let facts = lines.map(|line| (line.names, line.text)).collect();
    let heading = say!("Not testable with these samples");
    listed(Topic::NotTestable, heading, facts, detail)
}

fn name(effect: &str) -> String {
    title(effect).to_owned()
}

fn listed(topic: Topic, heading: &str, mut facts: Vec<Fact>, detail: Detail) -> Option<Section> {
    facts.truncate(4 * detail.most);
    (!facts.is_empty()).then(|| Section::of(topic, heading, vec![Block::Facts(facts)]))
}
