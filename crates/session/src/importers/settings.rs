//! What a person can say about a file, what the program found out by itself, and what it has to
//! ask.

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::quoted;
use crate::importers::columns::Columns;
use crate::importers::role::Role;
use crate::importers::units::{AngleUnit, LengthUnit, TimeUnit};
use crate::progress::ProgressSpan;
use crate::tables::Separator;
use crate::tables::decimals::Decimal;
use crate::tables::encoding::Encoding;
use crate::text::{Template, Text};
use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

/// What a person says about a file. Everything may be left open; what cannot be found out is
/// asked.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reading {
    /// What wrote it.
    pub kind: Option<&'static Importer>,
    /// Its name, for messages.
    pub file: Option<PathBuf>,
    /// The unit of coordinates that do not say theirs.
    pub unit: Option<LengthUnit>,
    /// The unit of angles that do not say theirs.
    pub angle_unit: Option<AngleUnit>,
    /// The unit of times that do not say theirs.
    pub time_unit: Option<TimeUnit>,
    /// The decimal sign.
    pub decimal: Option<Decimal>,
    /// What separates cells.
    pub separator: Option<Separator>,
    /// The line of the header, counted from 1; 0: there is none. `None`: it is found.
    pub header: Option<u64>,
    /// What the columns are, in the words of a session: `name`, `group`, `x`, `x_mm`, `q1_deg`,
    /// `time_s`, …; `-` leaves one out, `auto` takes what its heading says. Empty: all headings say.
    pub columns: Vec<String>,
    /// Whether columns that are only guessed by their headings are taken as they are proposed.
    pub confirmed: bool,
    /// Rigid bodies or markers to take.
    pub names: Vec<String>,
    /// Whether to turn coordinates with y upwards so that z points upwards.
    pub z_up: bool,
    /// The joint that an axis measurement is about, counted from 0.
    pub joint: usize,
    /// Whether that joint slides, so that its positions are lengths.
    pub slides: bool,
    /// How far the robot reaches, mm: helps to ask for the unit.
    pub reach_mm: Option<f64>,
    /// Names of the robot's joints and whether they slide, from base to tool; empty: not known.
    pub joints: Vec<(String, bool)>,
    /// Options that only the file's format has, by their names without dashes.
    pub options: BTreeMap<&'static str, String>,
}

impl Reading {
    /// The length that an option states, mm; otherwise what is wrong, and what is expected.
    pub(crate) fn length_mm(&self, option: &str) -> Result<Option<f64>, (Text, Text)> {
        let Some(said) = self.options.get(option) else {
            return Ok(None);
        };
        match said.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Some(value)),
            _ => Err((wrong_value(option, said), text!("a length in mm"))),
        }
    }

    /// The file as a place for messages.
    pub(crate) fn place(&self) -> Place {
        self.file.as_ref().map(Place::file).unwrap_or_default()
    }
}

/// What a question is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum About {
    /// The unit of lengths: [`Reading::unit`].
    Unit,
    /// The unit of angles: [`Reading::angle_unit`].
    AngleUnit,
    /// The unit of times: [`Reading::time_unit`].
    TimeUnit,
    /// The decimal sign: [`Reading::decimal`].
    Decimal,
    /// What the columns are: [`Reading::columns`].
    Columns,
    /// Which rigid body or marker: [`Reading::names`].
    Name,
    /// An option that only the file's format has, by its name: [`Reading::options`].
    Own(&'static str),
}

impl About {
    /// The option that answers it on the command line.
    pub fn option(self) -> String {
        let name = match self {
            Self::Unit => "unit",
            Self::AngleUnit => "angle-unit",
            Self::TimeUnit => "time-unit",
            Self::Decimal => "decimal",
            Self::Columns => "columns",
            Self::Name => "name",
            Self::Own(name) => name,
        };
        format!("--{name}")
    }
}

/// Something that only a person can say.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// What it is about.
    pub about: About,
    /// Where in the file it came up.
    pub place: Place,
    /// What is not known, and what the answers would mean.
    pub text: Text,
    /// Possible answers as the command line takes them; empty where there are too many.
    pub answers: Vec<String>,
}

impl Question {
    pub(crate) fn new(about: About, place: Place, says: impl Into<Text>, answers: &[&str]) -> Self {
        Self {
            about,
            place,
            text: says.into(),
            answers: answers.iter().map(|&answer| answer.to_owned()).collect(),
        }
    }

    /// The question as the reason why a file is refused.
    pub fn as_diagnostic(&self) -> Diagnostic {
        let option = self.about.option();
        let expected = match (&self.answers[..], self.about) {
            ([], About::Columns) => {
                text!(
                    "{option} with what each column is, for instance {option} name,x_mm,y_mm,z_mm,-",
                    option
                )
            }
            ([], _) => Text::verbatim(option),
            ([proposal], About::Columns) => {
                text!(
                    "--confirm if they are, else {option} with what each is, now {proposal}",
                    option,
                    proposal
                )
            }
            (answers, _) => text!("{option} {answers}", option, answers = answers.join(" or ")),
        };
        Diagnostic::error(self.place.clone(), self.text.clone(), expected)
    }
}

/// How the meaning of a column is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// A person said it.
    Said,
    /// The format has it so, or the heading is one of a session's.
    Certain,
    /// From the words of a heading that some other program wrote.
    FromHeading,
    /// From what stands in the column and from its place.
    FromContent,
}

impl Known {
    /// Whether it should be looked at.
    pub fn is_guess(self) -> bool {
        matches!(self, Self::FromHeading | Self::FromContent)
    }

    /// How a heading is known to mean what it is taken for.
    pub(crate) fn by_heading(heading: &str) -> Self {
        let plain = heading.trim().trim_matches('"').to_lowercase();
        match Role::from_word(&plain) {
            _ if plain.is_empty() => Self::FromContent,
            Some(_) => Self::Certain,
            None => Self::FromHeading,
        }
    }
}

/// A column and what it is taken for.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnGuess {
    /// Its heading in the file; empty without a header.
    pub heading: String,
    /// What it is taken for, in the words of [`Reading::columns`].
    pub meaning: String,
    /// How that is known.
    pub confidence: Known,
}

impl ColumnGuess {
    /// The columns as a sheet shows them, none of which is a guess.
    pub(crate) fn certain(columns: &Columns) -> impl Iterator<Item = Self> {
        columns.list.iter().map(|column| Self {
            heading: column.name.clone(),
            meaning: column.role.to_string(),
            confidence: Known::Certain,
        })
    }

    /// Whether it is used, and only a guess.
    pub fn is_guess(&self) -> bool {
        self.confidence.is_guess() && !matches!(self.meaning.as_str(), "" | "-")
    }
}

/// What was found out about a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Inspection {
    /// What wrote it.
    pub kind: Option<&'static Importer>,
    /// How its characters are stored.
    pub encoding: Encoding,
    /// What separates cells.
    pub separator: Option<Separator>,
    /// The decimal sign; `None` while it is asked for.
    pub decimal: Option<Decimal>,
    /// Lines before the table, the last ones.
    pub preamble: Vec<String>,
    /// The line of the header, if there is one.
    pub header_line: Option<u64>,
    /// The columns of the table.
    pub columns: Vec<ColumnGuess>,
    /// The first rows as they stand.
    pub first_rows: Vec<Vec<String>>,
    /// Number of rows.
    pub rows: usize,
    /// Rigid bodies, markers or points that the file names, the first ones.
    pub names: Vec<String>,
    /// Where the unit of length comes from, in words.
    pub unit: Text,
    /// What has to be answered before the file can be imported.
    pub questions: Vec<Question>,
    /// Errors, warnings and notes.
    pub findings: Vec<Diagnostic>,
}

pub(crate) struct ReadContext<'a> {
    /// The file as text; empty where it is none.
    pub(crate) text: &'a str,
    /// The file as it is.
    pub(crate) bytes: &'a [u8],
    pub(crate) reading: &'a Reading,
    pub(crate) place: Place,
    pub(crate) found: Inspection,
    /// The work that reading it is a part of.
    pub(crate) part: ProgressSpan<'a>,
}

impl<'a> ReadContext<'a> {
    pub(crate) fn new(
        text: &'a str,
        bytes: &'a [u8],
        reading: &'a Reading,
        part: ProgressSpan<'a>,
    ) -> Self {
        Self {
            text,
            bytes,
            reading,
            place: reading.place(),
            found: Inspection::default(),
            part,
        }
    }
}

/// What was given for an option that takes something else.
pub(crate) fn wrong_value(option: &str, said: &str) -> Text {
    text!("--{option}: {found}", option, found = quoted(said))
}

/// A format that instruments write.
pub struct Importer {
    /// Its name for `--as`.
    pub id: &'static str,
    /// What it is, for a user who has only the file.
    pub title: Template,
    /// What is asked about its files.
    pub asks: Questions,
    /// Options that only this format has.
    pub options: &'static [OwnOption],
    /// How its files are known from others.
    pub(crate) known_by: KnownBy,
    pub(crate) read: fn(&mut ReadContext<'_>) -> Option<Columns>,
}

impl PartialEq for Importer {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for Importer {}

impl fmt::Debug for Importer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id)
    }
}

/// What a person is asked about the files of a format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a question of the sheet by itself"
)]
pub struct Questions {
    /// The separator, the header and the decimal sign.
    pub table: bool,
    /// What the columns mean.
    pub columns: Meanings,
    /// Whether y points upwards, as it does in some formats.
    pub y_up: bool,
    /// Which of the things that the file names are to be taken.
    pub names: bool,
    /// Which joint was measured.
    pub joint: bool,
}

impl Questions {
    /// As of any table.
    pub const TABLE: Self = Self {
        table: true,
        columns: Meanings::Session,
        y_up: false,
        names: false,
        joint: false,
    };
}

/// What the columns of a format can mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meanings {
    /// What a session's columns can.
    Session,
    /// The format has them fixed.
    Fixed,
    /// One of these: the word, and what a person calls it.
    Own(&'static [(&'static str, &'static str)]),
}

/// An option of the command line that one format has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OwnOption {
    /// Its name without the dashes.
    pub name: &'static str,
    /// What the window calls it.
    pub title: Template,
    /// What stands for its value in the help, such as `TOPIC`.
    pub value: &'static str,
    /// What it says.
    pub help: Template,
    /// The values that it can have; empty: any.
    pub values: &'static [&'static str],
}

/// How the files of a format are known when it is not stated.
pub(crate) enum KnownBy {
    /// By their first bytes, which no other format has: they are no text.
    Bytes(fn(&[u8]) -> bool),
    /// By how their text starts, as that of no other format does.
    Text(fn(&str) -> bool),
    /// By having nothing against them; who is pickier is asked earlier.
    Reading {
        /// Its turn among the formats that are asked.
        turn: u8,
        /// Whether it suits, by what reading it brought.
        suits: Suits,
    },
}

impl KnownBy {
    /// By having a header, under which nothing is wrong.
    pub(crate) const fn headed(turn: u8) -> Self {
        Self::Reading {
            turn,
            suits: |trial| trial.is_sound && trial.headings.is_some(),
        }
    }
}

/// Whether a file suits a format, by what reading it brought.
pub(crate) type Suits = fn(&Trial) -> bool;

/// What came of reading a file as one of a format.
pub(crate) struct Trial {
    /// Nothing is wrong, and the columns need no explanation.
    pub(crate) is_sound: bool,
    /// The headings, if the table has a header.
    pub(crate) headings: Option<Vec<String>>,
    /// Nothing is left to ask.
    pub(crate) is_complete: bool,
}
