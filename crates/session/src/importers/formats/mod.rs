//! The formats that instruments write: one file each, and one line each in the register below.
//!
//! A format says in its [`Importer`] what it is called, how its files are known, what the window
//! asks about them and which options are its own; terminal, window, tests of damaged files and
//! fuzzers find all of that here. `docs/extending.md` goes through an example.

pub(crate) use super::options::EULER_OPTION;
pub use super::settings::{Importer, Meanings, OwnOption, Questions};
pub(crate) use super::settings::{KnownBy, Suits, Trial};

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
                    "no format has the id {name}: it is the name of its file"
                );
            }
        }
    }

    /// The tables that commands and reference points come in are read by two of the formats.
    const USED_BESIDE: [&str; 2] = ["csv", "tracker"];

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
