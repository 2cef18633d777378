//! Sessions that come with the program.

/// A session that comes with the program.
pub(crate) struct Example {
    /// Its name in the menu.
    pub(crate) name: &'static str,
    pub(crate) what: &'static str,
    document: &'static [u8],
    samples: &'static [u8],
}

impl Example {
    /// Document and samples.
    pub(crate) fn files(&self) -> (&'static [u8], &'static [u8]) {
        (self.document, self.samples)
    }
}

/// Every session that comes with the program; the window opens on the first.
pub(crate) const EXAMPLES: [Example; 3] = [
    Example {
        name: "Lamp commissioning",
        what: "two reflectors, both sides, noise, while the machine warms up",
        document: include_bytes!("../../../sessions/lamp-commissioning.json"),
        samples: include_bytes!("../../../sessions/lamp-commissioning.csv"),
    },
    Example {
        name: "The paper's 30 samples",
        what: "six regions of five samples, without noise",
        document: include_bytes!("../../../sessions/paper-30.json"),
        samples: include_bytes!("../../../sessions/paper-30.csv"),
    },
    Example {
        name: "The paper's full run",
        what: "361 samples, every half degree",
        document: include_bytes!("../../../sessions/paper-run.json"),
        samples: include_bytes!("../../../sessions/paper-run.csv"),
    },
];
