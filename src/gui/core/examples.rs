//! Sessions that come with the program.

use crate::sessions::files::bundled::{BUNDLED, Bundled};
use crate::text::{Template, spoken};

/// A session that comes with the program: keys of what is said of it, and its files.
pub(crate) struct Example {
    name: Template,
    what: Template,
    files: &'static Bundled,
}

impl Example {
    /// Its name in the menu.
    pub(crate) fn name(&self) -> &'static str {
        spoken(self.name)
    }

    /// What is in it.
    pub(crate) fn what(&self) -> &'static str {
        spoken(self.what)
    }

    /// Document and samples.
    pub(crate) fn files(&self) -> (&'static [u8], &'static [u8]) {
        (self.files.document, self.files.samples)
    }
}

/// Every session that comes with the program; the window opens on the first.
pub(crate) const EXAMPLES: [Example; 3] = [
    Example {
        name: phrase!("Lamp commissioning"),
        what: phrase!("two reflectors, both sides, noise, while the machine warms up"),
        files: &BUNDLED[0],
    },
    Example {
        name: phrase!("The paper's 30 samples"),
        what: phrase!("six regions of five samples, without noise"),
        files: &BUNDLED[1],
    },
    Example {
        name: phrase!("The paper's full run"),
        what: phrase!("361 samples, every half degree"),
        files: &BUNDLED[2],
    },
];
