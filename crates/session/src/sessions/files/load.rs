//! From a file, or from memory, to a session and what is worth knowing about it.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::atomic::folder_of;
use crate::diagnostic::{Diagnostic, Place, Rejected, Severity, summarised, unreadable};
use crate::document::{Fields, Path as JsonPath};
use crate::kinematics::Joint;
use crate::progress::{Progress, ProgressSpan, ReadError, unwatched};
use crate::sessions::domain::{Samples, Session};
use crate::sessions::files::assemble::Declared;
use crate::sessions::files::file_hash;
use crate::sessions::files::format_v1::head;
use crate::sessions::files::format_v1::head::SamplesAt;
use crate::sessions::files::format_v1::inline;
use crate::sessions::files::{assemble, open};
use crate::sessions::validation;

/// A session and the notes and warnings that came up on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// What the file says.
    pub session: Session,
    /// Notes and warnings, in the order of the input; no errors.
    pub findings: Vec<Diagnostic>,
    /// Every file that was read: the document, its samples, the robot's URDF. No output may replace
    /// them.
    pub files: Vec<PathBuf>,
}

/// What lies beside a document.
#[derive(Clone, Copy)]
enum CompanionFile<'a> {
    Nothing,
    Folder(&'a Path),
    Csv(&'a [u8]),
}

/// Reads the session at `path` and the samples beside it.
///
/// # Errors
/// [`Rejected`] with every problem that was found, each with file, line, column and what was
/// expected. Nothing is read but regular files: the document itself, and samples in its folder or
/// below.
pub fn load(path: impl AsRef<Path>) -> Result<Loaded, Rejected> {
    load_watched(path, unwatched).map_err(ReadError::rejected)
}

/// As [`load`]. `watch` hears now and then which part is done (0 to 1), and may break it off.
///
/// # Errors
/// As [`load`], and [`ReadError::Cancelled`].
pub fn load_watched(
    path: impl AsRef<Path>,
    watch: impl Fn(f64) -> ControlFlow<()>,
) -> Result<Loaded, ReadError> {
    let progress = Progress::new(&watch);
    let whole = progress.whole();
    let path = path.as_ref();
    let is_large = std::fs::metadata(path).is_ok_and(|document| document.len() > LARGE_DOCUMENT);
    let read = if is_large { 0.2 } else { 0.01 };
    let bytes = open::read_document_in(path, whole.part(0.0, read))?;
    let companion = CompanionFile::Folder(folder_of(path));
    let mut loaded = read_session(Some(path), &bytes, companion, whole.part(read, 1.0))?;
    loaded.session.path = Some(path.to_path_buf());
    loaded.files.insert(0, path.to_path_buf());
    whole.reached(1.0)?;
    Ok(loaded)
}

/// A document of more bytes has its samples in it: reading it is the work. Of a smaller one they are
/// in the file beside it.
const LARGE_DOCUMENT: u64 = 1 << 20;

/// Reads a session that needs no other file: its samples are inline.
///
/// # Errors
/// As [`load`].
pub fn parse(document: &[u8]) -> Result<Loaded, Rejected> {
    let progress = Progress::new(&unwatched);
    read_session(None, document, CompanionFile::Nothing, progress.whole())
        .map_err(ReadError::rejected)
}

/// Reads a session whose samples, if they are in a file, are these.
///
/// # Errors
/// As [`load`].
pub fn parse_with_csv(document: &[u8], samples: &[u8]) -> Result<Loaded, Rejected> {
    let (progress, beside) = (Progress::new(&unwatched), CompanionFile::Csv(samples));
    read_session(None, document, beside, progress.whole()).map_err(ReadError::rejected)
}

fn read_session(
    path: Option<&Path>,
    bytes: &[u8],
    companion: CompanionFile<'_>,
    part: ProgressSpan<'_>,
) -> Result<Loaded, ReadError> {
    let place = path.map(Place::file).unwrap_or_default();
    let text = open::as_text(bytes, &place)?;
    let is_large = bytes.len() as u64 > LARGE_DOCUMENT;
    let parsed = if is_large { 0.8 } else { 0.01 };
    let (mut fields, root) = Fields::open_in(place, text, part.part(0.0, parsed))?;
    let refused = |diagnostics| Err(Rejected::of(diagnostics).into());
    let Some((head, samples)) = head::read(&mut fields, root) else {
        return refused(fields.findings);
    };
    let joints: Option<Vec<Joint>> = head.robot.as_ref().map(|robot| robot.joints.clone());
    let declared = Declared {
        targets: &head.targets,
        references: &head.instrument.references,
    };
    let wanted = TableRequest {
        joints: joints.as_deref(),
        declared,
        part: part.part(parsed, 0.95),
        sha256: None,
    };
    let samples = samples.and_then(|at| read_samples(at, companion, &wanted, &mut fields));
    part.check()?;
    let (Some(robot), Some(mut samples)) = (head.robot, samples) else {
        return refused(fields.findings);
    };
    samples.follow(&robot.joints);
    let session = Session {
        name: head.name,
        note: head.note,
        robot,
        targets: head.targets,
        instrument: head.instrument,
        tolerance_mm: head.tolerance_mm,
        regions: head.regions,
        compensated_by: head.compensated_by,
        samples,
        path: None,
    };
    if !fields.has_errors() {
        let place = path.map(Place::file).unwrap_or_default();
        fields
            .findings
            .extend(validation::findings(&session, &place));
    }
    let findings = accept(fields.findings)?;
    Ok(Loaded {
        session,
        findings,
        files: fields.also_read,
    })
}

/// Reads the samples, from where the document has them.
fn read_samples(
    at: SamplesAt,
    companion: CompanionFile<'_>,
    wanted: &TableRequest<'_>,
    fields: &mut Fields<'_>,
) -> Option<Samples> {
    match at {
        SamplesAt::Inline(node) => {
            let inline = inline::read(fields, node, wanted.joints)?;
            let whole = fields.source.place(0).in_field("samples.columns");
            let source = fields.source.clone();
            let locate = inline.locator(&source);
            let findings = &mut fields.findings;
            Some(assemble::samples(
                inline.table,
                wanted.declared,
                &locate,
                &whole,
                findings,
            ))
        }
        SamplesAt::File(name, at, sha256) => {
            let place = fields.place(at, &JsonPath::Root.key("samples").key("file"));
            let wanted = TableRequest { sha256, ..*wanted };
            samples_file(&name, &place, companion, &wanted, fields)
        }
    }
}

/// What the document says of the samples beside it, and which part of the work it is to read them.
struct TableRequest<'a> {
    joints: Option<&'a [Joint]>,
    declared: Declared<'a>,
    part: ProgressSpan<'a>,
    /// The hash of the samples that the document was written with.
    sha256: Option<String>,
}

/// Reads the samples that the document at `place` calls `name`.
fn samples_file(
    name: &str,
    place: &Place,
    companion: CompanionFile<'_>,
    wanted: &TableRequest<'_>,
    fields: &mut Fields<'_>,
) -> Option<Samples> {
    let findings = &mut fields.findings;
    let opened = match companion {
        CompanionFile::Csv(bytes) => {
            let file = Place::file(name);
            return samples_from(bytes, &file, place, wanted, wanted.part, findings);
        }
        CompanionFile::Nothing => Err((
            text!("samples in a file: {name}", name),
            text!("samples inside the document, as it was read without a folder"),
        )),
        CompanionFile::Folder(folder) => open::samples_path(folder, name).and_then(|path| {
            let (file, length) = open::open_regular(&path)
                .map_err(|(found, expected)| (text!("{found}: {name}", found, name), expected))?;
            Ok((path, file, length))
        }),
    };
    let (path, file, length) = match opened {
        Ok(opened) => opened,
        Err((found, expected)) => {
            findings.push(Diagnostic::error(place.clone(), found, expected));
            return None;
        }
    };
    fields.also_read.push(path.clone());
    let csv = Place::file(path);
    match open::read_whole(file, length, wanted.part.part(0.0, 0.2)) {
        Ok(bytes) => {
            let part = wanted.part.part(0.2, 1.0);
            samples_from(&bytes, &csv, place, wanted, part, findings)
        }
        Err(error) => {
            let expected = text!("a file that can be read");
            findings.push(Diagnostic::error(csv, unreadable(&error), expected));
            None
        }
    }
}

fn samples_from(
    bytes: &[u8],
    file: &Place,
    named_at: &Place,
    wanted: &TableRequest<'_>,
    part: ProgressSpan<'_>,
    findings: &mut Vec<Diagnostic>,
) -> Option<Samples> {
    let table = assemble::table(bytes, file, wanted.joints, findings, part)?;
    if let Some(own) = &wanted.sha256 {
        let found = file_hash::of(bytes);
        if found != *own {
            findings.push(others_samples(&found, own, file, named_at));
        }
    }
    Some(assemble::rows(table, wanted.declared, file, findings))
}

/// What is said where the samples beside a document are not those that it was written with.
fn others_samples(found: &str, own: &str, file: &Place, named_at: &Place) -> Diagnostic {
    // The place names the folder.
    let csv = file.file.as_deref().and_then(Path::file_name);
    let csv = csv.map_or_else(String::new, |csv| csv.to_string_lossy().into_owned());
    let found = text!(
        "the samples in {csv} are not those that this session was saved with: their sha256 is {found}…, \
         the session's {own}…",
        csv,
        found = &found[..12],
        own = &own[..12]
    );
    let expected = text!(
        "the samples file that was written with the session; if it was edited on purpose, \
                    save the session anew or take \"sha256\" out of it"
    );
    Diagnostic::warning(named_at.clone(), found, expected)
}

/// Lets notes and warnings pass; an error refuses everything.
pub(super) fn accept(findings: Vec<Diagnostic>) -> Result<Vec<Diagnostic>, Rejected> {
    if findings
        .iter()
        .any(|finding| finding.severity == Severity::Error)
    {
        return Err(Rejected::of(findings));
    }
    Ok(summarised(findings))
}
