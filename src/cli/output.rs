//! Standard output: one JSON document, or text.

use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::atomic::WriteError;
use crate::compensation::NotHandedOut;
use crate::diagnostic::Diagnostic;
use crate::kinematics::Robot;
use crate::language::finding;
use crate::model::Calibration;
use crate::pipeline::{self, load, load_robot};
use crate::robots::{LibraryRobot, named};
use crate::sessions::Loaded;

use super::failure::Failure;
use super::plain::plain;
use anyhow::Context;

/// Prints one JSON document.
pub(crate) fn json(document: &impl Serialize) -> Result<(), Failure> {
    let mut text =
        serde_json::to_string_pretty(document).context(text!("cannot write the answer"))?;
    text.push('\n');
    bytes(text.as_bytes())
}

/// Prints text. A reader that has had enough (`| head`) is no failure.
pub(crate) fn text(text: &str) -> Result<(), Failure> {
    bytes(plain(text).as_bytes())
}

/// Prints what is no text for people, as it is.
pub(crate) fn bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
    match written {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => Ok(other.context(text!("cannot write to standard output"))?),
    }
}

/// Reads a session, and tells what was noticed.
pub(crate) fn session(path: &Path) -> Result<Loaded, Failure> {
    let loaded = load(path)?;
    findings(&loaded.findings);
    Ok(loaded)
}

/// Reads a robot, or takes it from the library, and tells what was noticed.
pub(crate) fn robot(path: &Path) -> Result<Robot, Failure> {
    robot_and_origin(path).map(|(robot, _)| robot)
}

/// The robot of a file; where there is no such file, of the library, with what that says of it.
pub(crate) fn robot_and_origin(
    path: &Path,
) -> Result<(Robot, Option<&'static LibraryRobot>), Failure> {
    if is_a_robots_name(path) {
        let text = path.to_string_lossy();
        let found = named(&text).map_err(|error| {
            Failure::WrongInput(text!(
                "there is no file '{file}', and {error}",
                file = text.as_ref(),
                error = error.to_string()
            ))
        })?;
        return Ok((found.robot.clone(), Some(found)));
    }
    let loaded = load_robot(path)?;
    findings(&loaded.findings);
    Ok((loaded.robot, None))
}

/// Whether this can only be the name of a robot: no file is called so, nor looks like one.
pub(crate) fn is_a_robots_name(path: &Path) -> bool {
    let text = path.to_string_lossy();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let of_a_file = ["json", "csv", "urdf", "xml", "mjcf"];
    let like_a_file = of_a_file
        .iter()
        .any(|other| ending.eq_ignore_ascii_case(other));
    !like_a_file && !text.contains(['/', '\\']) && !text.is_empty() && !path.exists()
}

/// Tells the user what was noticed in an input.
pub(crate) fn findings(findings: &[Diagnostic]) {
    let sentences: Vec<String> = findings.iter().map(finding).collect();
    messages(&sentences);
}

/// Tells the user something beside the answer.
pub(crate) fn messages<T: std::fmt::Display>(messages: &[T]) {
    let lines = messages
        .iter()
        .map(|message| format!("truepose: {message}\n"));
    aside(&lines.collect::<String>());
}

/// Prints an answer on standard error, where standard output is a file.
pub(crate) fn aside(text: &str) {
    // A closed standard error is no reason to fail: what was asked for is written elsewhere.
    let _ = std::io::stderr().lock().write_all(plain(text).as_bytes());
}

/// Refuses to mix two documents on standard output.
pub(crate) fn one_use_of_standard_output(
    first: bool,
    second: bool,
    first_name: &str,
    second_name: &str,
) -> Result<(), Failure> {
    if first && second {
        return Err(Failure::WrongInput(text!(
            "{first} and {second} both write to standard output; give one of them a file name",
            first = first_name,
            second = second_name
        )));
    }
    Ok(())
}

/// Whether an output is standard output.
pub(crate) fn is_standard_output(out: Option<&Path>) -> bool {
    out.is_some_and(|out| out.as_os_str() == "-")
}

/// Refuses a file that exists and may not be replaced, before anything else is written.
pub(crate) fn can_be_written(out: &Path, force: bool) -> Result<(), Failure> {
    if out.exists() && !out.is_file() {
        return Err(WriteError::NotAFile(out.to_path_buf()).into());
    }
    if out.exists() && !force {
        return Err(WriteError::Exists(out.to_path_buf()).into());
    }
    Ok(())
}

/// Writes a document whole or not at all; `-` is standard output.
pub(crate) fn document(
    out: &Path,
    bytes: &[u8],
    force: bool,
    inputs: &[PathBuf],
) -> Result<(), Failure> {
    if out.as_os_str() == "-" {
        let mut stdout = std::io::stdout().lock();
        let written = stdout.write_all(bytes).and_then(|()| stdout.flush());
        return Ok(written.context(text!("cannot write to standard output"))?);
    }
    crate::atomic::refuse_to_replace_inputs(out, &paths(inputs))?;
    Ok(crate::atomic::write_atomically(out, force, |file| {
        file.write_all(bytes)
    })?)
}

/// Writes the model of an answer, where one is asked for, or the next best that holds, and says so. What is handed
/// back is why nothing is handed out: the answer says all the same what was found, and is printed before that.
pub(crate) fn model(
    out: Option<&Path>,
    calibration: impl FnOnce() -> Calibration,
    loaded: &Loaded,
    force: bool,
) -> Result<Option<NotHandedOut>, Failure> {
    let Some(out) = out else {
        return Ok(None);
    };
    match pipeline::hand_out_next_best(&calibration(), &loaded.session) {
        Ok(handed_out) => {
            messages(handed_out.instead.as_slice());
            let text = pipeline::write_model(&handed_out.calibration);
            document(out, text.as_bytes(), force, &loaded.files)?;
            Ok(None)
        }
        Err(why) => Ok(Some(why)),
    }
}

/// Paths by reference.
pub(crate) fn paths(owned: &[PathBuf]) -> Vec<&Path> {
    owned.iter().map(PathBuf::as_path).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::JointValues;
    use crate::pipeline::Method;

    /// The model of another robot is refused; what these samples show takes its place.
    #[test]
    fn what_is_refused_is_replaced_by_the_next_best() {
        let folder = tempfile::tempdir().expect("a folder");
        let bundled = |name: &str| {
            let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions");
            load(root.join(name)).expect("bundled")
        };
        let own = bundled("paper-30.json");
        let identified = |loaded: &Loaded| {
            let (method, values) = (Method::default(), JointValues::Commanded);
            pipeline::identify(&loaded.session, &method, values)
                .expect("identified")
                .1
        };
        let calibration = identified(&own);
        let out = folder.path().join("m.json");
        let written = model(Some(&out), || calibration.clone(), &own, false);
        assert!(matches!(written, Ok(None)) && out.exists());
        // Of another robot than the session's: what was said of it does not hold.
        let mut other = bundled("paper-30.json");
        other
            .session
            .samples
            .x_mm
            .iter_mut()
            .for_each(|x| *x += 5.0);
        let out = folder.path().join("n.json");
        assert!(pipeline::hand_out(&calibration, &other.session).is_err());
        let written = model(Some(&out), || calibration.clone(), &other, false);
        assert!(matches!(written, Ok(None)));
        let instead = pipeline::load_model(&out).expect("written");
        assert_eq!(instead.model.terms().len(), calibration.model.terms().len());
        assert_ne!(instead.model, calibration.model);
    }
}
