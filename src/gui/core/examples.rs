//! Sessions that come with the program.

use crate::gui::language::text;
use crate::sessions::bundled::{BUNDLED, Bundled};

/// A session that comes with the program: keys of what is said of it, and its files.
pub(crate) struct Example {
    name: &'static str,
    what: &'static str,
    files: &'static Bundled,
}

impl Example {
    /// Its name in the menu.
    pub(crate) fn name(&self) -> &'static str {
        text(self.name)
    }

    /// What is in it.
    pub(crate) fn what(&self) -> &'static str {
        text(self.what)
    }

    /// Document and samples.
    pub(crate) fn files(&self) -> (&'static [u8], &'static [u8]) {
        (self.files.document, self.files.samples)
    }
}

/// Every session that comes with the program; the window opens on the first.
pub(crate) const EXAMPLES: [Example; 3] = [
    Example {
        name: "example-lamp",
        what: "example-lamp-what",
        files: &BUNDLED[0],
    },
    Example {
        name: "example-samples",
        what: "example-samples-what",
        files: &BUNDLED[1],
    },
    Example {
        name: "example-run",
        what: "example-run-what",
        files: &BUNDLED[2],
    },
];
