//! The kinds of measurement: one file each, and one line each in the register below.

use super::Kind;
use crate::text::Text;

mod angles;

/// Makes the modules and the list of the names given, so that a kind is registered in one line.
macro_rules! register {
    ($($name:ident: $kind:ident),* $(,)?) => {
        $(pub(crate) mod $name;)*
        /// Every kind, in the order in which they are listed.
        pub const KINDS: &[&dyn Kind] = &[$(&$name::$kind),*];
    };
}

// rustfmt does not see through the macro: scripts/check names the files to it.
register! {
    point: Point,
    orientation: Orientation,
    distance: Distance,
    bearing: Bearing,
    pointing: Pointing,
    socket: Socket,
    touch: Touch,
}

/// A kind by its name in answers, in words.
#[doc(hidden)]
pub fn kind_in_words(name: &str) -> Text {
    let known = KINDS.iter().find(|kind| kind.about().name == name);
    known.map_or_else(|| Text::verbatim(name), |kind| kind.about().in_words())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_this_folder_is_registered() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/observations/kinds");
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let is_kind = std::fs::read_to_string(&path)
                .unwrap()
                .contains("\nimpl Kind for ");
            let name = path.file_stem().unwrap().to_str().unwrap();
            let registered = KINDS.iter().any(|kind| kind.about().name == name);
            assert_eq!(registered, is_kind, "{name}");
        }
    }
}
