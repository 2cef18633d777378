//! Targets in files that robots are driven by: tables of poses and robot programs.
//!
//! A reader finds the targets of a file, each number with its place, and leaves every other byte
//! alone: comments and strings are no targets, and what a program computes at run time is listed.
//! [`compensate()`] replaces the numbers by those of the corrected commands, in place. [`measuring_list()`] and
//! [`measuring_program`] write poses to measure.
//!
//! # To add a language
//! Write one file like its neighbours, which says how statements end, what they declare, set and move to
//! (`walk` follows scopes, branches and calls), and add one line to [`LANGUAGES`].
//!
//! Poses are taken in the frame and of the tool that the file declares for them (`frames`); where it
//! declares none, they are those of the model's tool in the frame that the caller states
//! ([`Request::frame`]). What the file declares in numbers is compared with the model first
//! ([`ProgramFrames`]).

mod answer;
mod axes;
mod compensate;
mod configuration;
mod convention;
mod corrected;
mod csv;
mod edit;
mod fanuc;
mod frames;
mod krl;
mod language;
mod measuring_list;
mod number;
mod pose;
mod program;
mod program_frames;
mod rapid;
mod referred;
mod request;
mod resolve;
mod rewrite;
mod sequence;
mod settle;
mod stated_load;
mod target;
mod text;
mod urscript;
mod walk;
mod words;
mod write;

pub use answer::{Answer, Outcome, Reason, SkippedTarget, Written};
pub use axes::{Axes, Slot};
pub use compensate::compensate;
pub use language::Language;
pub use measuring_list::{measuring_list, measuring_program};
pub use number::Number;
pub use pose::{Frame, Orientation};
pub use program::Program;
pub use program_frames::{
    Difference, Differences, DifferingNumber, ExternalAxes, ModelTool, Precedence, ProgramFrames,
};
pub use request::{Beside, CompensateError, Request};
pub use target::{Circumstances, Posture, Remark, Shape, Target};
pub use text::Text;
pub use write::{Stop, stops};

/// Every language, in the order in which their looks are tried.
pub const LANGUAGES: &[Language] = &[
    Language {
        id: "fanuc-ls",
        title: "FANUC LS",
        extensions: &["ls"],
        orientation: Orientation::XyzFixedDegrees,
        looks_like: fanuc::looks_like,
        read: fanuc::read,
    },
    Language {
        id: "krl",
        title: "KRL",
        extensions: &["src", "dat", "sub"],
        orientation: Orientation::ZyxDegrees,
        looks_like: krl::looks_like,
        read: krl::read,
    },
    Language {
        id: "rapid",
        title: "RAPID",
        extensions: &["mod", "modx", "sys", "sysx", "prg"],
        orientation: Orientation::Quaternion,
        looks_like: rapid::looks_like,
        read: rapid::read,
    },
    Language {
        id: "urscript",
        title: "URScript",
        extensions: &["script", "urscript"],
        orientation: Orientation::RotationVector,
        looks_like: urscript::looks_like,
        read: urscript::read,
    },
    Language {
        id: "csv",
        title: "CSV",
        extensions: &["csv", "tsv"],
        orientation: Orientation::Quaternion,
        looks_like: csv::looks_like,
        read: csv::read,
    },
];

/// The language of this name.
pub fn find(id: &str) -> Option<&'static Language> {
    LANGUAGES.iter().find(|language| language.id == id)
}

/// The file that is read with this one: the `.dat` of a `.src`, or the other way round, where it is there.
pub fn beside(path: &std::path::Path, language: &Language) -> Option<std::path::PathBuf> {
    let ending = path.extension()?.to_str()?;
    language
        .extensions
        .contains(&&*ending.to_lowercase())
        .then_some(())?;
    let other = match ending {
        "src" => "dat",
        "dat" => "src",
        "SRC" => "DAT",
        "DAT" => "SRC",
        _ => return None,
    };
    Some(path.with_extension(other)).filter(|other| other.is_file())
}

/// The language of a file: by the ending of its name, else by what it looks like.
pub fn language_of(path: &std::path::Path, bytes: &[u8]) -> Option<&'static Language> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let by_name = |l: &&Language| ending.as_deref().is_some_and(|e| l.extensions.contains(&e));
    let mut all = LANGUAGES.iter();
    all.clone()
        .find(by_name)
        .or_else(|| all.find(|language| (language.looks_like)(bytes)))
}
