//! Reading and writing, as the background tasks do it: through the library, like the terminal.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::atomic::WriteError;
use crate::diagnostic::Diagnostic;
use crate::sessions::{self, Loaded, Replacing, Session};

use super::simulate::{Chosen, Form};
use super::subject::{Origin, Subject};
use super::tasks::Report;
use super::view::Message;

/// Sessions that come with the program: name, and what they are.
pub(crate) const EXAMPLES: [(&str, &str); 1] = [(
    "lamp-commissioning",
    "a noisy commissioning run, both directions",
)];

/// The example that the window opens on.
pub(crate) fn first_example() -> Arc<Subject> {
    Arc::new(example(0))
}

fn example(_: usize) -> Subject {
    let effects = ["backlash", "encoder-eccentricity"];
    let form = Form {
        effects: effects.into_iter().filter_map(Chosen::new).collect(),
        ..Form::default()
    };
    let mut session = form.session().expect("the example is valid");
    session.name = "lamp-commissioning".to_owned();
    Subject::new(session, Vec::new(), Origin::Bundled)
}

/// Reads a bundled session.
pub(crate) fn open_example(index: usize) -> Report {
    Report::Opened(Ok(Arc::new(example(index))))
}

/// Reads a session file.
pub(crate) fn open(path: &Path) -> Report {
    Report::Opened(match sessions::load(path) {
        Ok(Loaded { session, findings }) => {
            let origin = Origin::File(path.to_path_buf());
            Ok(Arc::new(Subject::new(session, findings, origin)))
        }
        Err(rejected) => Err(Message {
            wrong: true,
            title: format!("{} could not be opened; nothing was changed", path.display()),
            details: listed(&rejected.diagnostics),
        }),
    })
}

/// Findings as lines, no more than can be read.
fn listed(findings: &[Diagnostic]) -> Vec<String> {
    const MOST: usize = 8;
    let mut lines: Vec<String> = findings.iter().take(MOST).map(ToString::to_string).collect();
    if findings.len() > MOST {
        lines.push(format!("and {} more", findings.len() - MOST));
    }
    lines
}

/// Makes a session by simulation.
pub(crate) fn simulate(form: &Form) -> Report {
    Report::Opened(match form.session() {
        Ok(session) => Ok(Arc::new(Subject::new(
            session,
            Vec::new(),
            Origin::Simulated,
        ))),
        Err(problem) => Err(Message {
            wrong: true,
            title: "The simulation needs other numbers".to_owned(),
            details: vec![problem],
        }),
    })
}

/// Writes a session: the document, and its samples beside it.
pub(crate) fn save(session: &Session, path: &Path, replace: bool) -> Report {
    let path = if path.extension().is_none() {
        path.with_extension("json")
    } else {
        path.to_path_buf()
    };
    let replacing = Replacing {
        force: replace,
        inputs: &[],
    };
    Report::Saved(match sessions::save(session, &path, replacing) {
        Ok(_) => Ok(path),
        Err(error) => Err(Message {
            wrong: true,
            title: format!("{} could not be saved", path.display()),
            details: vec![
                if matches!(error, WriteError::Exists(_)) {
                    "it exists already; allow replacing it, or choose another name".to_owned()
                } else {
                    error.to_string()
                },
                "What was there before is there still".to_owned(),
            ],
        }),
    })
}

/// Asks the user for a session file.
pub(crate) fn choose_to_open() -> Report {
    let dialog = rfd::FileDialog::new()
        .set_title("Open session")
        .add_filter("Sessions and models", &["json"]);
    Report::ChosenToOpen(dialog.pick_file())
}

/// Asks the user where to save.
pub(crate) fn choose_to_save(name: &str) -> Report {
    let dialog = rfd::FileDialog::new()
        .set_title("Save session")
        .set_file_name(name)
        .add_filter("Session", &["json"]);
    Report::ChosenToSave(dialog.save_file())
}

/// What a session's file is called unless the user says otherwise.
pub(crate) fn file_name_for(session: &Session) -> String {
    let kept = |c: char| {
        if c.is_alphanumeric() || c == '-' || c == '_' {
            c
        } else {
            '-'
        }
    };
    let name: String = session.name.chars().map(kept).collect();
    let name = name.trim_matches('-');
    let name = if name.is_empty() { "session" } else { name };
    PathBuf::from(name)
        .with_extension("json")
        .display()
        .to_string()
}
