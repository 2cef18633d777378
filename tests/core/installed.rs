//! What the system shows of the program: `truepose integrate`, man pages and completions.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

#[cfg(all(feature = "gui", target_os = "linux"))]
use std::{
    fs,
    path::{Path, PathBuf},
};

use std::process::{Command, Output};

fn truepose(arguments: &[&str]) -> Output {
    let mut command = crate::program::truepose();
    command
        .args(arguments)
        .output()
        .expect("the program starts")
}

fn printed(arguments: &[&str]) -> String {
    let ran = truepose(arguments);
    assert_eq!(ran.status.code(), Some(0), "{arguments:?}");
    String::from_utf8(ran.stdout).unwrap()
}

/// The commands that `--help` lists.
fn commands() -> Vec<String> {
    let help = printed(&["--help"]);
    let lines = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let lines = lines.take_while(|line| line.starts_with("  "));
    let names = lines.map(|line| line.split_whitespace().next().unwrap().to_owned());
    names.filter(|name| name != "help").collect()
}

#[cfg(all(feature = "gui", target_os = "linux"))]
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push(path);
        }
    }
    found
}

/// Runs a tool of the machine; `None`, said aloud, where it has none.
fn tool(name: &str, arguments: &[&str]) -> Option<Output> {
    let ran = Command::new(name).args(arguments).output().ok();
    if ran.is_none() {
        eprintln!("skipped: no {name}");
    }
    ran
}

#[cfg(all(feature = "gui", target_os = "linux"))]
#[test]
fn everything_is_put_where_a_desktop_looks_and_taken_away_again() {
    let prefix = tempfile::tempdir().unwrap();
    let at = prefix.path().to_str().unwrap();
    let share = prefix.path().join("share");
    assert_eq!(
        truepose(&["integrate", "--prefix", at]).status.code(),
        Some(0)
    );
    let commands = commands();
    assert!(commands.len() >= 14, "{commands:?}");
    for name in &commands {
        let page = fs::read_to_string(share.join(format!("man/man1/truepose-{name}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{name}");
    }
    for path in [
        "man/man1/truepose.1",
        "icons/hicolor/48x48/apps/truepose.png",
        "icons/hicolor/scalable/apps/truepose.svg",
    ] {
        assert!(share.join(path).exists(), "{path}");
    }
    // What comes with the program lies where the program says it is.
    let session = share.join("truepose/sessions/lamp-commissioning.json");
    let session = session.to_str().unwrap();
    assert_eq!(truepose(&["identify", session]).status.code(), Some(0));
    let entry = fs::read_to_string(share.join("applications/truepose.desktop")).unwrap();
    let file_type = fs::read_to_string(share.join("mime/packages/truepose.xml")).unwrap();
    let kind = entry
        .lines()
        .find_map(|line| line.strip_prefix("MimeType="));
    let kind = kind.unwrap().trim_end_matches(';');
    assert!(file_type.contains(&format!("type=\"{kind}\"")), "{kind}");
    // The program does not lie in the prefix: it is started by its path.
    let start = format!("Exec=\"{}\" %f\n", env!("CARGO_BIN_EXE_truepose"));
    assert!(entry.contains(&start), "{entry}");
    if let Some(ran) = tool(
        "update-mime-database",
        &[share.join("mime").to_str().unwrap()],
    ) {
        assert!(ran.status.success());
        let globs = fs::read_to_string(share.join("mime/globs2")).unwrap();
        assert!(
            globs.contains(&format!("{kind}:*.truepose.json")),
            "{globs}"
        );
        fs::remove_dir_all(share.join("mime")).unwrap();
    }

    let count = files(&share).len();
    let again = truepose(&["integrate", "--prefix", at]);
    assert_eq!(
        again.status.code(),
        Some(2),
        "files are replaced only by force"
    );
    assert_eq!(files(&share).len(), count, "and nothing is written");
    assert!(
        truepose(&["integrate", "--prefix", at, "--force"])
            .status
            .success()
    );
    assert!(
        truepose(&["integrate", "--prefix", at, "--remove"])
            .status
            .success()
    );
    let left = files(&share);
    let left = left
        .iter()
        .filter(|path| !path.starts_with(share.join("mime")));
    assert_eq!(left.count(), 0);
    let never_there = truepose(&["integrate", "--prefix", at, "--remove"]);
    assert!(never_there.status.success());
}

#[cfg(all(feature = "gui", target_os = "linux"))]
#[test]
fn a_program_in_the_prefix_is_started_by_its_name() {
    let prefix = tempfile::tempdir().unwrap();
    let program = prefix.path().join("bin/truepose");
    fs::create_dir(prefix.path().join("bin")).unwrap();
    if fs::hard_link(env!("CARGO_BIN_EXE_truepose"), &program).is_err() {
        fs::copy(env!("CARGO_BIN_EXE_truepose"), &program).unwrap();
    }
    let mut command = crate::program::english(Command::new(&program));
    command.arg("integrate").arg("--prefix").arg(prefix.path());
    assert!(command.output().unwrap().status.success());
    let entry = prefix.path().join("share/applications/truepose.desktop");
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/truepose.desktop");
    assert_eq!(fs::read(entry).unwrap(), fs::read(bundled).unwrap());

    // Far from its sources and without a display it names a session that is there.
    let mut command = crate::program::english(Command::new(&program));
    command
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env("HOME", prefix.path())
        .current_dir(prefix.path());
    let says = String::from_utf8(command.output().unwrap().stderr).unwrap();
    let session = "lamp-commissioning.json";
    let named = says.split_whitespace().find(|word| word.ends_with(session));
    assert!(Path::new(named.unwrap()).is_file(), "{says}");
}

#[test]
fn shells_complete_every_command_and_its_options() {
    let bash = printed(&["completions", "bash"]);
    for name in commands() {
        for shell in ["bash", "zsh", "fish"] {
            assert!(
                printed(&["completions", shell]).contains(&name),
                "{shell}: {name}"
            );
        }
    }
    let script = format!(
        "{bash}\nCOMP_WORDS=(truepose history --js); COMP_CWORD=2\n\
         _truepose truepose --js history\necho \"${{COMPREPLY[*]}}\""
    );
    if let Some(ran) = tool("bash", &["-c", &script]) {
        assert_eq!(String::from_utf8_lossy(&ran.stdout), "--json\n");
    }
}

#[test]
fn a_page_of_no_command_is_refused_with_those_there_are() {
    let refused = truepose(&["man", "nothing"]);
    assert_eq!(refused.status.code(), Some(2));
    let message = String::from_utf8(refused.stderr).unwrap();
    assert!(
        message.contains("expected one of simulate, robots, import"),
        "{message}"
    );
    assert!(printed(&["man"]).contains("Exit status"));
}
