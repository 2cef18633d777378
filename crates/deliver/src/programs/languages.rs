//! The languages that targets are read in.

use super::axes::Axes;
use super::language::Language;
use super::pose::Orientation;
use super::{csv, fanuc, krl, rapid, urscript};

/// Every language, in the order in which their looks are tried.
pub const LANGUAGES: &[Language] = &[
    Language {
        id: "fanuc-ls",
        title: "FANUC LS",
        extensions: &["ls"],
        orientation: Orientation::XyzFixedDegrees,
        fits: |axes| axes.check_own("E1 to E3"),
        looks_like: fanuc::looks_like,
        read: fanuc::read,
    },
    Language {
        id: "krl",
        title: "KRL",
        extensions: &["src", "dat", "sub"],
        orientation: Orientation::ZyxDegrees,
        fits: |axes| axes.check_own("E1 to E6"),
        looks_like: krl::looks_like,
        read: krl::read,
    },
    Language {
        id: "rapid",
        title: "RAPID",
        extensions: &["mod", "modx", "sys", "sysx", "prg"],
        orientation: Orientation::Quaternion,
        fits: |axes| axes.check_own("eax_a to eax_f"),
        looks_like: rapid::looks_like,
        read: rapid::read,
    },
    Language {
        id: "urscript",
        title: "URScript",
        extensions: &["script", "urscript"],
        orientation: Orientation::RotationVector,
        fits: Axes::check_turning,
        looks_like: urscript::looks_like,
        read: urscript::read,
    },
    Language {
        id: "csv",
        title: "CSV",
        extensions: &["csv", "tsv"],
        orientation: Orientation::Quaternion,
        fits: |_| Ok(()),
        looks_like: csv::looks_like,
        read: csv::read,
    },
];

/// The language of this name.
pub fn find(id: &str) -> Option<&'static Language> {
    LANGUAGES.iter().find(|language| language.id == id)
}
