//! Sessions that come with the program.

use std::sync::Arc;

use crate::progress::{Progress, ReadError, unwatched};
use crate::sessions::{self};

use crate::gui::core::subject::{Origin, Subject};
use crate::gui::view::Message;

use super::opening::{Opened, looked_through, not_read};

/// A session that comes with the program.
pub(crate) struct Example {
    /// Its name in the menu.
    pub(crate) name: &'static str,
    /// What it is.
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

/// The example that the window opens on.
pub(crate) fn first_example() -> Arc<Subject> {
    let example = &EXAMPLES[0];
    let loaded = sessions::parse_with_csv(example.document, example.samples);
    let loaded = loaded.expect("a test reads every bundled session");
    Arc::new(Subject::new(
        loaded.session,
        loaded.findings,
        Origin::Bundled,
    ))
}

/// Reads a bundled session.
pub(crate) fn open_example(index: usize) -> Result<Opened, Message> {
    let Some(example) = EXAMPLES.get(index) else {
        return Err(Message {
            wrong: true,
            title: "There is no such example".to_owned(),
            details: vec!["The examples are in the File menu".to_owned()],
        });
    };
    let loaded = sessions::parse_with_csv(example.document, example.samples);
    let nobody = Progress::new(&unwatched);
    let subject = loaded.map_err(ReadError::from);
    let subject = subject.and_then(|l| Ok(looked_through(l, Origin::Bundled, nobody.whole())?));
    subject
        .map(Opened::Session)
        .map_err(|error| not_read(example.name, "opened", &error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bundled_session_can_be_read() {
        for (index, example) in EXAMPLES.iter().enumerate() {
            assert!(open_example(index).is_ok(), "{}", example.name);
        }
    }
}
