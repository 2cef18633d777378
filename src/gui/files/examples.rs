//! Opening the sessions that come with the program.

use std::sync::Arc;

use crate::gui::core::examples::EXAMPLES;
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::view::Message;
use crate::pipeline;
use crate::progress::{Progress, ReadError, unwatched};

use super::opening::{Opened, looked_through, not_opened};

/// The example that the window opens on.
pub(crate) fn first_example() -> Arc<LoadedSession> {
    let example = &EXAMPLES[0];
    let (document, samples) = example.files();
    let loaded = pipeline::parse_with_csv(document, samples);
    let loaded = loaded.expect("a test reads every bundled session");
    Arc::new(LoadedSession::new(
        loaded.session,
        loaded.findings,
        Origin::Bundled,
    ))
}

/// Reads a bundled session.
pub(crate) fn open_example(index: usize) -> Result<Opened, Message> {
    let Some(example) = EXAMPLES.get(index) else {
        return Err(Message::wrong(
            say!("There is no such example").to_owned(),
            vec![say!("The examples are in the File menu").to_owned()],
        ));
    };
    let (document, samples) = example.files();
    let loaded = pipeline::parse_with_csv(document, samples);
    let progress = Progress::new(&unwatched);
    let loaded_session = loaded.map_err(ReadError::from);
    let loaded_session = loaded_session
        .and_then(|l| Ok(looked_through(l, Origin::Bundled, None, progress.whole())?));
    loaded_session
        .map(Opened::Session)
        .map_err(|error| not_opened(example.name(), &error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bundled_session_can_be_read() {
        for (index, example) in EXAMPLES.iter().enumerate() {
            assert!(open_example(index).is_ok(), "{}", example.name());
        }
    }
}
