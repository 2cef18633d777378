//! What a report says, once, for every format: sections of a few kinds of blocks. Texts are already
//! in the reader's units and language; whatever a user named has passed [`clean`].

use super::logo::Logo;
use crate::compensation::decision::Outcome;
pub use crate::explain::{Block, Section, clean, clean_note};
pub use crate::present::table::{Column, Table};
use crate::text::Language;

/// A report.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The heading.
    pub title: String,
    /// What it is about: the session's name.
    pub subject: String,
    /// The answer in one sentence.
    pub answer: String,
    /// Picture in the head.
    pub logo: Option<Logo>,
    /// Whether the tolerance is kept: the outcome, and what it rests on.
    pub decision: Option<(Outcome, String)>,
    /// The figures that answer it.
    pub headline: Vec<Figure>,
    /// The sections in order.
    pub sections: Vec<Section>,
    /// What stands at the foot of every page.
    pub foot: String,
    /// The language that it is in: that of the thread which made it.
    pub language: Language,
}

/// A figure with its name and what to hold it against.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Name.
    pub name: String,
    /// Value with its unit.
    pub value: String,
    /// What to hold it against; may be empty.
    pub reference: String,
}
