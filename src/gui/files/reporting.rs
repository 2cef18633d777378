//! The calibration report, written in the background: of the session as a search sees it, or of the
//! model at hand. The ending of the file's name says whether it is HTML or PDF.

use crate::language::spoken;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::history::History;
use crate::report::exported::sidecar_of;
use crate::report::{ExportedTable, Extras, Kind};
use crate::{fonts, pipeline};

use crate::gui::cache::identified::IdentifiedAnswer;
use crate::gui::core::answer::{self, Search};
use crate::gui::core::document::Document;
use crate::gui::file_state::machines::Stated;
use crate::gui::files;
use crate::gui::jobs::Watch;
use crate::gui::view::Message;

/// Where a report comes from.
#[derive(Debug, Clone)]
pub(crate) enum Source {
    /// A session, with its search if there was one, and the model in use if there is one.
    Session(
        Arc<Document>,
        Option<Arc<Search>>,
        Option<Arc<IdentifiedAnswer>>,
    ),
    Model(Arc<IdentifiedAnswer>),
}

/// A report to be written.
#[derive(Debug, Clone)]
pub(crate) struct ReportRequest {
    /// Where it comes from.
    pub(crate) source: Source,
    /// What the certificate states besides its measurements.
    pub(crate) stated: Stated,
    /// Where the machine's other sessions lie, and the name of its robot; `None`: without its history.
    pub(crate) past: Option<(PathBuf, String)>,
    /// Tables that were exported from this session.
    pub(crate) tables: Vec<PathBuf>,
    /// Files that it may not replace.
    pub(crate) inputs: Vec<PathBuf>,
}

/// Writes it, whole or not at all.
pub(crate) fn write(wanted: &ReportRequest, path: &Path, replace: bool, watch: &Watch) -> Message {
    let mut details = Vec::new();
    let written = make(wanted, path, replace, watch, &mut details);
    match written {
        Ok(()) => files::saved(path, details),
        Err(problem) => files::not_written(path, problem),
    }
}

fn make(
    wanted: &ReportRequest,
    path: &Path,
    replace: bool,
    watch: &Watch,
    details: &mut Vec<String>,
) -> Result<(), String> {
    let kind = Kind::of(path).map_err(spoken)?;
    // A long search is not begun for a file that cannot be written.
    files::can_be_written(path, replace, &wanted.inputs)?;
    let extras = Extras {
        details: wanted.stated.complete()?,
        history: past(wanted, watch)?,
        tables: named_tables(&wanted.tables, details),
    };
    let report = match &wanted.source {
        Source::Model(outcome) => pipeline::report_of_model(&*outcome.handed_out()?, &extras),
        Source::Session(document, searched, in_use) => {
            let session = document.session_to_save();
            let options = answer::options();
            let there = searched.as_ref().and_then(|s| s.answer.as_ref().ok());
            let made;
            let found = if let Some(found) = there {
                // The tolerance may have been changed since: it decides nothing in a search.
                found
            } else {
                details.push(say!("The diagnosis was run for it").to_owned());
                made = pipeline::diagnose(&session, &options, &answer::progress_callback(watch))
                    .map_err(|e| spoken(e.describe()))?;
                &made
            };
            let in_use = in_use.as_ref().filter(|o| o.answer.is_ok());
            let in_use = in_use.map(|o| o.handed_out()).transpose()?;
            pipeline::report_of_diagnosis(&session, found, in_use.as_deref(), &options, &extras)
                .map_err(|e| spoken(e.describe()))?
        }
    };
    let written = pipeline::write_report(&report, kind).map_err(|e| e.to_string())?;
    if !written.unshown.is_empty() {
        let says = spoken(fonts::cannot_be_shown(&written.unshown));
        details.push(say!(
            "Some letters are written in it as codes: {says}",
            says
        ));
    }
    files::write_one(path, replace, &written.bytes, watch)
}

/// What became of the machine, where its folder has more than one measurement of it.
fn past(wanted: &ReportRequest, watch: &Watch) -> Result<Option<History>, String> {
    let Some((folder, robot)) = &wanted.past else {
        return Ok(None);
    };
    let report_progress = watch.progress_callback();
    pipeline::history_of_robot(folder, robot, &report_progress).map_err(|_| files::cancelled())
}

/// The tables with their hashes; what cannot be named any more is said.
fn named_tables(paths: &[PathBuf], details: &mut Vec<String>) -> Vec<ExportedTable> {
    let mut tables = Vec::new();
    // A model has no sidecar; it is no table.
    for path in paths.iter().filter(|path| sidecar_of(path).exists()) {
        match ExportedTable::read(path) {
            Ok(table) => {
                details.push(say!(
                    "Names the table {table} with its hash",
                    table = table.name
                ));
                tables.push(table);
            }
            Err(because) => details.push(say!(
                "A table is not named in it: {because}",
                because = spoken(because.describe())
            )),
        }
    }
    tables
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::files::first_example;

    fn wanted() -> ReportRequest {
        ReportRequest {
            source: Source::Session(Arc::new(Document::new(first_example())), None, None),
            stated: Stated::default(),
            past: None,
            tables: Vec::new(),
            inputs: Vec::new(),
        }
    }

    fn files_in(folder: &Path) -> usize {
        std::fs::read_dir(folder).expect("it can be listed").count()
    }

    #[test]
    fn a_cancelled_report_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let watch = Watch::default();
        watch.stop();
        write(&wanted(), &folder.path().join("report.pdf"), false, &watch);
        assert_eq!(files_in(folder.path()), 0);
    }

    #[test]
    fn a_file_that_is_cancelled_at_its_end_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("report.html");
        let watch = Watch::default();
        watch.stop();
        assert!(files::write_one(&path, false, b"text", &watch).is_err());
        assert_eq!(files_in(folder.path()), 0);
        let watch = Watch::default();
        assert_eq!(files::write_one(&path, false, b"text", &watch), Ok(()));
        assert_eq!(files_in(folder.path()), 1);
    }

    #[test]
    fn a_file_that_cannot_be_written_is_refused_before_the_search() {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, says) in [
            ("report.txt", ".html or .pdf"),
            ("report", ".html or .pdf"),
            ("not there/report.pdf", "folder not found"),
        ] {
            let watch = Watch::default();
            let message = write(&wanted(), &folder.path().join(name), false, &watch);
            assert!(
                message.wrong && message.details[0].contains(says),
                "{message:?}"
            );
            assert!(!watch.begun(), "the search was not begun");
        }
    }
}
