//! Sections of blocks: what every answer is made of.

use crate::present::drawing::Drawing;
use crate::present::numbers::with_minus_signs;
use crate::present::table::Table;

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

    /// As it stands on paper and on a screen: see [`Block::with_minus_signs`].
    pub(crate) fn with_minus_signs(mut self) -> Self {
        self.title = with_minus_signs(&self.title);
        let blocks = self.blocks.into_iter();
        self.blocks = blocks.map(Block::with_minus_signs).collect();
        self
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

impl Block {
    /// With real minus signs before its numbers; those of the terminal are read by other programs.
    pub(crate) fn with_minus_signs(mut self) -> Self {
        let written = |text: &mut String| *text = with_minus_signs(text);
        match &mut self {
            Self::Text(text) | Self::Warning(text) => written(text),
            Self::List(points) => points.iter_mut().for_each(written),
            Self::Facts(facts) => facts.iter_mut().for_each(|(_, value)| written(value)),
            Self::Table(table) => {
                let cells = table.rows.iter_mut().flatten();
                cells.for_each(|cell| written(&mut cell.shown));
            }
            Self::Heading(_) | Self::Plot(..) | Self::Sign(_) => {}
        }
        self
    }
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

impl Block {
    /// A paragraph.
    pub(crate) fn text(says: impl Into<String>) -> Self {
        Self::Text(says.into())
    }
}

/// A name and what belongs to it.
pub type Fact = (String, String);

/// A name with what belongs to it.
pub(crate) fn fact(name: impl Into<String>, value: impl Into<String>) -> Fact {
    (name.into(), value.into())
}
