//! Sessions that come with the program.

use crate::gui::language::text;

/// A session that comes with the program: keys of what is said of it, and its files.
pub(crate) struct Example {
    name: &'static str,
    what: &'static str,
    document: &'static [u8],
    samples: &'static [u8],
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
        (self.document, self.samples)
    }
}

/// Every session that comes with the program; the window opens on the first.
pub(crate) const EXAMPLES: [Example; 3] = [
    Example {
        name: "example-lamp",
        what: "example-lamp-what",
        document: include_bytes!("../../../sessions/lamp-commissioning.json"),
        samples: include_bytes!("../../../sessions/lamp-commissioning.csv"),
    },
    Example {
        name: "example-samples",
        what: "example-samples-what",
        document: include_bytes!("../../../sessions/paper-30.json"),
        samples: include_bytes!("../../../sessions/paper-30.csv"),
    },
    Example {
        name: "example-run",
        what: "example-run-what",
        document: include_bytes!("../../../sessions/paper-run.json"),
        samples: include_bytes!("../../../sessions/paper-run.csv"),
    },
];
