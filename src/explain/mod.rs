//! An answer, said once for every place where a person reads it: sections of few kinds of blocks, in the language of
//! this thread. Terminal, window and report show blocks and word nothing of an answer themselves; what differs by
//! place is how much is asked for (`Detail`), and what a place adds to a section ([`Topic`]).

mod clean;
mod diagnosis;
mod found;
mod geometry;
mod history;
#[cfg(any(feature = "cli", feature = "gui"))]
mod identification;
#[cfg(any(feature = "cli", feature = "gui"))]
mod imported;
mod open;
mod parameters;
#[cfg(feature = "cli")]
mod plan;
#[cfg(any(feature = "cli", feature = "gui"))]
mod program;
mod sight;
mod standards;
#[cfg(any(feature = "cli", feature = "gui"))]
mod table;
#[cfg(any(feature = "cli", feature = "gui"))]
mod verification;

use crate::present::drawing::Drawing;
use crate::present::numbers::{mm, plain};
use crate::present::table::Table;
use crate::present::units::Units;

pub(crate) use clean::cleaned;
pub use clean::{clean, clean_note};
pub(crate) use diagnosis::{answer, diagnosis, expected, floor_from, noise, remarks};
pub(crate) use history::history;
#[cfg(feature = "cli")]
pub(crate) use identification::identification;
#[cfg(feature = "gui")]
pub(crate) use identification::remarks_on_fit;
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use imported::imported;
pub(crate) use parameters::values;
#[cfg(feature = "cli")]
pub(crate) use plan::plan;
#[cfg(feature = "cli")]
pub(crate) use program::left_as_it_is;
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use program::program;
pub(crate) use standards::standards;
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use table::{Exported, table};
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use verification::verification;

/// A part of an answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// What it is about, where a place adds something of its own.
    pub topic: Topic,
    /// Heading.
    pub title: String,
    /// What is in it.
    pub blocks: Vec<Block>,
}

impl Section {
    /// A section of these pieces.
    pub fn new(title: impl Into<String>, blocks: Vec<Block>) -> Self {
        Self::of(Topic::Other, title, blocks)
    }

    pub(crate) fn of(topic: Topic, title: impl Into<String>, blocks: Vec<Block>) -> Self {
        let title = title.into();
        Self {
            topic,
            title,
            blocks,
        }
    }
}

/// What a section is about: the window puts its buttons there, the report knows under which heading it belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// The verdict, as its title, with the figures that it rests on.
    Answer,
    /// Which of the problems of the data.
    DataProblem(usize),
    /// Which of the effects that were found.
    Found(usize),
    /// Names that the samples cannot tell apart.
    Rivals,
    /// What no name explains.
    Unexplained,
    /// What predicts and has no name.
    Unnamed,
    /// What to measure next.
    NextPoses,
    /// Targets of a program that are not corrected.
    LeftAsIs,
    /// Samples that do not count.
    Outliers,
    /// What the samples do not determine.
    NotIdentifiable,
    /// What would have been seen.
    Limits,
    /// What could not be seen.
    NotTestable,
    /// Anything else.
    Other,
}

/// A piece of a section.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A heading inside the section.
    Heading(String),
    /// A paragraph.
    Text(String),
    /// A paragraph that must not be overlooked.
    Warning(String),
    /// Points one below another.
    List(Vec<String>),
    /// Names with what belongs to them, which may have several lines.
    Facts(Vec<Fact>),
    /// A table.
    Table(Table),
    /// A plot with its caption.
    Plot(Drawing, String),
    /// Lines to fill in by hand: label and what is there already.
    Sign(Vec<Fact>),
}

/// A name and what belongs to it.
pub type Fact = (String, String);

/// A name with what belongs to it.
pub(crate) fn fact(name: &str, value: impl Into<String>) -> Fact {
    (name.to_owned(), value.into())
}

/// A length to the nanometre: a model has to give the same figure wherever it is checked.
#[cfg(any(feature = "cli", feature = "gui"))]
fn to_the_nanometre(length_mm: f64, detail: Detail) -> String {
    match detail.units {
        None => format!("{length_mm:.6} mm"),
        Some(units) => units.length(length_mm),
    }
}

/// How much of an answer is asked for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Detail {
    /// Units of lengths as the reader chose them, with three digits; `None`: mm with the four decimals of a report.
    pub(crate) units: Option<Units>,
    /// Most points of a list; how many more there are is said.
    pub(crate) most: usize,
    /// On one page: a sentence in place of facts, the poses and combinations counted.
    pub(crate) brief: bool,
    /// Sizes of what was found stand with it, not in a table of all parameters.
    pub(crate) sizes: bool,
}

impl Detail {
    /// In the terminal: on one page.
    #[cfg(feature = "cli")]
    pub(crate) const TERMINAL: Self = Self {
        units: None,
        most: 6,
        brief: true,
        sizes: true,
    };
    /// In a report: everything, on paper.
    pub(crate) const REPORT: Self = Self {
        units: None,
        most: 20,
        brief: false,
        sizes: false,
    };

    /// In the window.
    #[cfg(feature = "gui")]
    pub(crate) fn window(units: Units) -> Self {
        Self {
            units: Some(units),
            most: 8,
            brief: false,
            sizes: true,
        }
    }

    /// A length.
    fn length(self, length_mm: f64) -> String {
        self.units
            .map_or_else(|| mm(length_mm), |units| units.length(length_mm))
    }

    /// A length before and after.
    fn lengths(self, [before, after]: [f64; 2]) -> String {
        match self.units {
            None => format!("{} → {} mm", plain(before), plain(after)),
            Some(units) => format!("{} → {}", units.length_number(before), units.length(after)),
        }
    }

    /// The first points, and how many more there are.
    fn first(self, mut points: Vec<String>) -> Vec<String> {
        let more = points.len().saturating_sub(self.most);
        points.truncate(self.most);
        if more > 0 {
            points.push(say!("and {more} more", more = more));
        }
        points
    }

    /// The same of facts; the count of the others stands behind the last name.
    fn first_facts(self, mut facts: Vec<Fact>) -> Vec<Block> {
        let more = facts.len().saturating_sub(self.most);
        facts.truncate(self.most);
        let mut blocks = vec![Block::Facts(facts)];
        if more > 0 {
            blocks.push(Block::Text(say!("and {more} more", more = more)));
        }
        blocks
    }
}
