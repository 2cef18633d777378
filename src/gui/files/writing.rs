//! Writing sessions, tables, models, lists and pictures, whole or not at all.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Color32, ColorImage};

use crate::atomic::{StagedFile, WriteError, commit_both, refuse_to_replace_inputs};
use crate::diagnosis::Options;
use crate::export::Document;
use crate::gui::cache::{IdentifiedAnswer, PreviewRequest};
use crate::gui::core::compensated::Compensated;
use crate::gui::core::disk::{FileChange, Fingerprint, name_of};
use crate::gui::core::document;
use crate::gui::core::search::{Search, progress_callback};
use crate::gui::file_state::Stated;
use crate::gui::files::system::{advice, cancelled, ending};
use crate::gui::jobs::Watch;
use crate::gui::view::{Message, What};
use crate::language::spoken;
use crate::report::exported::sidecar_of;
use crate::report::{ExportedTable, Extras, Kind};
use crate::sessions::{Replacing, samples_path};
use crate::{fonts, pipeline};

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
    pub(crate) document: Arc<document::Document>,
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
    document: Arc<document::Document>,
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
            Err(error) => Err(NotSaved::Because(not_written(&path, advice(&error)))),
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

/// Documents, the first of them under the name that is chosen, and what there is to say about them; or why there are
/// none.
pub(crate) type Made = Result<(Vec<Document>, Vec<String>), String>;

/// Makes what stands in a file, and writes it with what belongs beside it: all of it, or nothing.
pub(crate) fn write(
    make: impl FnOnce(&Path, &Watch) -> Made,
    path: &Path,
    replace: bool,
    inputs: &[PathBuf],
    watch: &Watch,
) -> Message {
    let write = || {
        // Nothing is worked out for a file that cannot be written.
        can_be_written(path, replace, inputs).map_err(|error| advice(&error))?;
        let (documents, details) = make(path, watch)?;
        write_all(&documents, path, replace, watch)?;
        Ok(details)
    };
    match write() {
        Ok(details) => Message::saved(path, details),
        Err(problem) => not_written(path, problem),
    }
}

/// A document by itself.
pub(crate) fn alone(bytes: Vec<u8>) -> Vec<Document> {
    let name = String::new();
    vec![Document { name, bytes }]
}

/// A table with the files that belong to it, or a model.
pub(crate) fn documents(
    wanted: &PreviewRequest,
    what: What,
    path: &Path,
) -> Result<Vec<Document>, String> {
    let name = path.file_name().and_then(|name| name.to_str());
    let name = name.ok_or(say!("expected the name of a file, in UTF-8"))?;
    if what == What::Model {
        let verified = wanted.identified.handed_out()?;
        return Ok(vec![Document {
            name: name.to_owned(),
            bytes: pipeline::write_model(&verified).into_bytes(),
        }]);
    }
    // Not as it is shown: the documents say what the file is called.
    Ok(wanted.made(name)?.export.documents)
}

/// Writes documents, the first of them under this name and the others beside it: all of them or nothing, and nothing
/// where it was cancelled meanwhile.
fn write_all(
    documents: &[Document],
    path: &Path,
    replace: bool,
    watch: &Watch,
) -> Result<(), String> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let place = |k: usize, document: &Document| {
        if k == 0 {
            path.to_path_buf()
        } else {
            folder.join(&document.name)
        }
    };
    let places = documents.iter().enumerate();
    let places: Vec<PathBuf> = places.map(|(k, d)| place(k, d)).collect();
    // All of them are on the disk before the first has its name.
    let write = |(place, document): (&PathBuf, &Document)| {
        StagedFile::write(place, replace, |file| file.write_all(&document.bytes))
    };
    let written: Result<Vec<StagedFile>, WriteError> =
        places.iter().zip(documents).map(write).collect();
    let mut written = written.map_err(|error| advice(&error))?;
    if watch.stopped() {
        return Err(cancelled());
    }
    let committed = if written.len() == 2
        && let (Some(second), Some(first)) = (written.pop(), written.pop())
    {
        commit_both(first, second)
    } else {
        written.into_iter().try_for_each(StagedFile::commit)
    };
    committed.map_err(|error| advice(&error))
}

/// Corrected targets, and what was changed beside them.
pub(crate) fn targets(compensated: &Compensated, path: &Path) -> Made {
    let corrected = compensated.result.as_ref();
    let corrected = corrected.map_err(|not_corrected| not_corrected.problems.join("\n"))?;
    let mut documents = alone(corrected.answer.bytes.clone());
    documents.push(Document {
        name: name_of(&sidecar_of(path)).into_owned(),
        bytes: corrected.sidecar.clone(),
    });
    Ok((documents, Vec::new()))
}

/// Whether a file may stand there: told before the work that it takes is begun.
fn can_be_written(path: &Path, replace: bool, inputs: &[PathBuf]) -> Result<(), WriteError> {
    let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
    refuse_to_replace_inputs(path, &inputs)?;
    if path.is_file() && !replace {
        return Err(WriteError::Exists(path.to_path_buf()));
    }
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
    if folder.is_some_and(|folder| !folder.is_dir()) {
        let (path, source) = (path.to_path_buf(), ErrorKind::NotFound.into());
        return Err(WriteError::Io { path, source });
    }
    Ok(())
}

/// Says that a file was not written.
pub(crate) fn not_written(path: &Path, problem: String) -> Message {
    Message::wrong(
        say!("{path} was not written", path = path.display()),
        vec![
            problem,
            say!("What was there before is there still").to_owned(),
        ],
    )
}

/// A picture, under a name with its ending.
pub(crate) fn picture(
    made: impl FnOnce() -> Result<Vec<u8>, String>,
    path: &Path,
    form: &str,
) -> Made {
    if ending(path).as_deref() != Some(form) {
        return Err(say!(
            "expected a file name that ends in .{ending}",
            ending = form
        ));
    }
    Ok((alone(made()?), Vec::new()))
}

/// An image as a file.
pub(crate) fn png(image: &ColorImage) -> Result<Vec<u8>, String> {
    let [width, height] = image
        .size
        .map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let rgba: Vec<u8> = image.pixels.iter().flat_map(Color32::to_array).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    let written = encoder.write_header();
    let written = written.and_then(|mut writer| writer.write_image_data(&rgba));
    written.map(|()| bytes).map_err(|error| error.to_string())
}

/// Where a report comes from.
#[derive(Debug, Clone)]
pub(crate) enum Source {
    /// A session, with its search if there was one, and the model in use if there is one.
    Session(
        Arc<document::Document>,
        Option<Arc<Search>>,
        Option<Arc<IdentifiedAnswer>>,
    ),
    Model(Arc<IdentifiedAnswer>),
}

/// The report: what the certificate states besides its measurements, and the tables that were exported from this
/// session.
pub(crate) fn report(
    source: &Source,
    (stated, tables): (&Stated, &[PathBuf]),
    path: &Path,
    watch: &Watch,
) -> Made {
    let mut details = Vec::new();
    let kind = Kind::of(path).map_err(spoken)?;
    let extras = Extras {
        details: stated.complete()?,
        tables: named_tables(tables, &mut details),
    };
    let report = match source {
        Source::Model(outcome) => pipeline::report_of_model(&*outcome.handed_out()?, &extras),
        Source::Session(document, searched, in_use) => {
            let session = document.session_to_save();
            let options = Options::default();
            let there = searched.as_ref().and_then(|s| s.answer.as_ref().ok());
            let made;
            let found = if let Some(found) = there {
                // The tolerance may have been changed since: it decides nothing in a search.
                found
            } else {
                details.push(say!("The diagnosis was run for it").to_owned());
                made = pipeline::diagnose(&session, &options, &progress_callback(watch))
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
    Ok((alone(written.bytes), details))
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

    fn report(path: &Path, watch: &Watch) -> Made {
        let document = document::Document::new(first_example());
        let source = Source::Session(Arc::new(document), None, None);
        super::report(&source, (&Stated::default(), &[]), path, watch)
    }

    fn files_in(folder: &Path) -> usize {
        std::fs::read_dir(folder).expect("it can be listed").count()
    }

    #[test]
    fn a_cancelled_report_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let watch = Watch::default();
        watch.stop();
        write(
            report,
            &folder.path().join("report.pdf"),
            false,
            &[],
            &watch,
        );
        assert_eq!(files_in(folder.path()), 0);
    }

    #[test]
    fn a_file_that_is_cancelled_at_its_end_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("report.html");
        let watch = Watch::default();
        watch.stop();
        assert!(write_all(&alone(b"text".to_vec()), &path, false, &watch).is_err());
        assert_eq!(files_in(folder.path()), 0);
        let watch = Watch::default();
        assert_eq!(
            write_all(&alone(b"text".to_vec()), &path, false, &watch),
            Ok(())
        );
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
            let message = write(report, &folder.path().join(name), false, &[], &watch);
            assert!(
                message.wrong && message.details[0].contains(says),
                "{message:?}"
            );
            assert!(!watch.begun(), "the search was not begun");
        }
    }
}
