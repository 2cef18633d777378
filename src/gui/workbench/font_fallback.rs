//! Letters that the bundled fonts lack.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::fonts::{Library, Purpose};
use crate::gui::style::font_fallback::Characters;
use crate::text::LANGUAGES;

use super::Workbench;

impl Workbench {
    /// What is known of letters.
    pub(crate) fn characters(&self) -> &Characters {
        &self.characters
    }

    /// So many of the faces that were found egui draws with.
    pub(crate) fn draws_with(&mut self, faces: usize) {
        self.characters.drawn = faces;
    }

    /// Looks for letters in this library from now on.
    pub(crate) fn read_letters_from(&mut self, library: Arc<Library>) {
        self.characters.library = library;
    }

    /// Looks for a face for the names of the languages.
    pub(super) fn find_names_of_languages(&mut self) {
        let names = LANGUAGES.iter().flat_map(|(_, _, own)| own.chars());
        self.find_letters(names.filter(|c| !c.is_ascii()).collect(), false);
    }

    /// Looks for a face for these, in the background; `aloud`: what no face has is said.
    pub(super) fn find_letters(&mut self, wanted: BTreeSet<char>, aloud: bool) {
        let new = self.characters.new_among(wanted);
        if new.is_empty() {
            return;
        }
        let library = Arc::clone(&self.characters.library);
        self.jobs.quietly(
            move || library.covering(&new, Purpose::Screen),
            move |bench: &mut Self, found| bench.characters.take(found, aloud),
        );
    }

    /// The user has read that they cannot be shown.
    pub(super) fn dismiss_letters(&mut self) {
        self.characters.unshown.clear();
    }
}
