//! The formats that instruments write: one file each, and one line each in the register below.
//!
//! A format says in its [`Importer`] what it is called, how its files are known, what the window
//! asks about them and which options are its own; terminal, window, tests of damaged files and
//! fuzzers find all of that here. `docs/extending.md` goes through an example.

use crate::text::Template;
use std::fmt;

use crate::importers::columns::Columns;
use crate::importers::euler::EULER;
use crate::importers::reader::Case;

/// Makes the modules and the list of the names given, so that a format is registered in one line.
macro_rules! register {
    ($($name:ident),* $(,)?) => {
        $(pub(crate) mod $name;)*
        /// Every format, in the order in which lists show them.
        pub static IMPORTERS: &[&Importer] = &[$(&$name::IMPORTER),*];
    };
}

// rustfmt does not see through the macro: scripts/check names the files to it.
register! {
    csv,
    tracker,
    iso230,
    optitrack,
    tum,
    mcap,
    board,
    ballbar,
    tpoint,
}

/// A format that instruments write.
pub struct Importer {
    /// Its name for `--as`.
    pub id: &'static str,
    /// What it is, for somebody who has only the file.
    pub plainly: Template,
    /// What is asked about its files.
    pub asks: Asks,
    /// Options that only this format has.
    pub options: &'static [OwnOption],
    /// How its files are known from others.
    pub(crate) known_by: KnownBy,
    pub(crate) read: fn(&mut Case<'_>) -> Option<Columns>,
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
pub struct Asks {
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

impl Asks {
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

/// The order of the angles of an orientation, in tables that a person explains.
pub(crate) const EULER_OPTION: OwnOption = OwnOption {
    name: EULER,
    title: phrase!("Angles of the orientation"),
    value: "ORDER",
    help: phrase!(
        "how rx, ry, rz (or euler1, euler2, euler3) make an orientation: an order of axes and whether they move, \
           such as zyx-moving, xyz-fixed (= zyx-moving) or zyz-moving; rpy (= xyz-fixed); rotvec"
    ),
    values: &[],
};

/// How the files of a format are known when nobody says what they are.
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

/// The format with this name.
pub fn find(id: &str) -> Option<&'static Importer> {
    IMPORTERS.iter().copied().find(|importer| importer.id == id)
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::*;

    fn sources(folder: &Path, all: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                sources(&path, all);
            } else if path.extension().is_some_and(|end| end == "rs") {
                all.push(path);
            }
        }
    }

    fn source_folder() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
    }

    #[test]
    fn every_file_of_this_folder_is_registered() {
        for entry in std::fs::read_dir(source_folder().join("importers/formats")).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            if name != "mod" {
                assert!(
                    find(&name).is_some(),
                    "{name} is in no line of the register"
                );
            }
        }
    }

    /// The tables that commands and reference points come in are read by two of the formats, and TPOINT's
    /// terms are an export of that name.
    const USED_BESIDE: [&str; 3] = ["csv", "tracker", "tpoint"];

    #[test]
    fn nothing_else_knows_a_format_by_its_name() {
        let mut all = Vec::new();
        sources(&source_folder(), &mut all);
        let formats = source_folder().join("importers/formats");
        let elsewhere = all.iter().filter(|path| !path.starts_with(&formats));
        for path in elsewhere {
            let text = std::fs::read_to_string(path).unwrap();
            for importer in IMPORTERS.iter().filter(|i| !USED_BESIDE.contains(&i.id)) {
                let names = [
                    format!("\"{}\"", importer.id),
                    format!("formats::{}", importer.id),
                ];
                let named = names.iter().find(|name| text.contains(*name));
                assert_eq!(named, None, "{}", path.display());
            }
        }
    }

    #[test]
    fn own_options_of_one_name_are_one_option() {
        let options = IMPORTERS.iter().flat_map(|importer| importer.options);
        for option in options.clone() {
            let mut same = options.clone().filter(|other| other.name == option.name);
            assert!(same.all(|other| other == option), "{}", option.name);
        }
    }
}
