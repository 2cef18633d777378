//! Saving a session, whole or not at all.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::pipeline;
use crate::sessions::{Replacing, samples_path};

use crate::gui::core::disk::{FileChange, Fingerprint};
use crate::gui::jobs::Watch;
use crate::gui::view::Message;

use super::advice::advice;

/// What saving may replace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Replace {
    Nothing,
    /// What has that name: the user was asked. But not what changed since it was read.
    Named,
    /// The files that the session came from, and no others.
    Own,
    /// Whatever is there: the user was asked about that as well.
    Whatever,
}

/// How saving went.
#[derive(Debug)]
pub(crate) struct Saved {
    /// The document that was saved.
    pub(crate) document: Arc<crate::gui::core::document::Document>,
    pub(crate) path: PathBuf,
    /// The files as they look now, the document first; or why there are none.
    pub(crate) result: Result<Vec<Fingerprint>, NotSaved>,
}

/// Why a session was not saved.
#[derive(Debug)]
pub(crate) enum NotSaved {
    /// This file changed since it was read.
    Changed(PathBuf),
    /// Something else.
    Because(Message),
}

/// Writes a session: the document, and its samples beside it. `known` are the files that it came
/// from, as they looked then: what changed since is replaced only where that was asked for.
pub(crate) fn save(
    document: Arc<crate::gui::core::document::Document>,
    path: &Path,
    replace: Replace,
    mut known: Vec<Fingerprint>,
    watch: &Watch,
) -> Saved {
    let path = if path.extension().is_none() {
        path.with_extension("json")
    } else {
        path.to_path_buf()
    };
    let outputs = [path.clone(), samples_path(&path)];
    let changed = outputs.iter().find(|output| {
        let print = known.iter_mut().find(|k| same_file(&k.path, output));
        print.is_some_and(|print| print.look() == Some(FileChange::Changed))
    });
    let result = if let (Some(changed), true) = (changed, replace != Replace::Whatever) {
        Err(NotSaved::Changed(changed.clone()))
    } else {
        let is_own = |output: &PathBuf| known.iter().any(|k| same_file(&k.path, output));
        let force = match replace {
            Replace::Nothing => false,
            Replace::Named | Replace::Whatever => true,
            Replace::Own => outputs.iter().all(|o| is_own(o) || !o.exists()),
        };
        let replacing = Replacing { force, inputs: &[] };
        let session = document.session_to_save();
        match pipeline::save_watched(&session, &path, replacing, watch.progress_callback()) {
            Ok(_) => Ok(outputs.iter().filter_map(|o| Fingerprint::of(o)).collect()),
            Err(error) => Err(NotSaved::Because(Message::wrong(
                say!("{path} could not be saved", path = path.display()),
                vec![
                    advice(&error),
                    say!("What was there before is there still").to_owned(),
                ],
            ))),
        }
    };
    Saved {
        document,
        path,
        result,
    }
}

fn same_file(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}
