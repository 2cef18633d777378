//! The documents: every command in `README.md` and in the pages of `docs` prints what stands there, and
//! the walk's files are what its scenario makes.

#[path = "../../examples/walk_through_files/arm_files.rs"]
#[allow(unreachable_pub, reason = "an example uses the same module")]
mod arm_files;
#[path = "../../examples/walk_through_files/files.rs"]
#[allow(unreachable_pub, reason = "an example uses the same module")]
mod files;

#[path = "../../examples/calibrate_an_arm.rs"]
mod calibrate_an_arm;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::house;

/// What the pages of `docs` may have together: who adds a paragraph shortens another.
const MOST_WORDS: usize = 16_000;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn raw() -> PathBuf {
    root().join("sessions/walk-through")
}

#[test]
fn the_files_are_what_their_scenario_makes() {
    let made = files::from_scenario(&raw()).expect("the scenario can be read");
    let mut bytes = 0;
    for (name, text) in made.list {
        let kept = fs::read_to_string(raw().join(name)).expect("the file is there");
        let hint = "cargo run --no-default-features --example walk_through_files makes it again";
        assert!(kept == text, "{name} is another file: {hint}");
        bytes += text.len();
    }
    assert!(bytes < 60_000, "{bytes} bytes");
    let table = fs::read_to_string(root().join("docs/walk-through.md")).expect("the document");
    for entry in fs::read_dir(raw()).expect("the files are there") {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy();
        assert!(table.contains(&format!("`{name}`")), "{name} is not told");
    }
}

#[test]
fn the_files_of_the_arm_are_what_its_session_holds() {
    let folder = root().join("sessions/arm");
    for (name, text) in arm_files::from_session(&folder).expect("the session can be read") {
        let kept = fs::read_to_string(folder.join(name)).expect("the file is there");
        let hint = "cargo run --no-default-features --example walk_through_files makes it again";
        assert!(kept == text, "{name} is another file: {hint}");
    }
}

/// Whether a line of the text has these parts, in their order. Runs of spaces are one.
fn has(line: &str, parts: &[String]) -> bool {
    let mut rest = line;
    parts.iter().all(|part| match rest.find(part.as_str()) {
        Some(at) => {
            rest = &rest[at + part.len()..];
            true
        }
        None => false,
    })
}

fn plain(line: &str) -> String {
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The words of a command line; quotes hold some together.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (k, part) in line.split('"').enumerate() {
        if k % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

/// The blocks of a document that show a terminal: with what it prints, or with commands alone.
fn blocks(text: &str) -> Vec<Vec<String>> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            let block = lines.by_ref().take_while(|line| !line.starts_with("```"));
            let block: Vec<String> = block.map(str::to_owned).collect();
            let is_tried =
                |line: &String| line.starts_with("$ truepose") || line.starts_with("$ python3");
            if block.iter().any(is_tried) {
                let text = block.join("\n").replace("\\\n", " ");
                blocks.push(text.lines().map(str::to_owned).collect());
            } else if block.iter().any(|line| line.starts_with("truepose import")) {
                blocks.push(commands_alone(&block));
            }
        }
    }
    blocks
}

/// A block of commands without a prompt: remarks are left out, and a line that goes on is one.
fn commands_alone(block: &[String]) -> Vec<String> {
    let lines = block.iter().filter(|line| !line.starts_with('#'));
    let lines: Vec<&str> = lines.map(String::as_str).collect();
    let text = lines.join("\n").replace("\\\n", " ");
    text.lines().map(|line| format!("$ {line}")).collect()
}

/// Runs one command and compares what it prints with what the document says.
fn run(folder: &Path, command: &str, expected: &[String]) {
    let words = words(command);
    let program = match words[0].as_str() {
        "truepose" => env!("CARGO_BIN_EXE_truepose"),
        "python3" => "python3",
        other => panic!("$ {command}: {other} cannot be tried"),
    };
    let ran = crate::program::english(Command::new(program))
        .args(&words[1..])
        .current_dir(folder)
        .output()
        .expect("the program runs");
    let said = [&ran.stderr[..], &ran.stdout[..]].concat();
    let said = String::from_utf8(said).expect("it prints UTF-8");
    let asks = expected.iter().any(|line| line.contains("expected --"));
    let status = if asks { 2 } else { 0 };
    assert_eq!(ran.status.code(), Some(status), "$ {command}\n{said}");
    let mut lines = said.lines().map(plain);
    for line in expected {
        let parts: Vec<String> = line.split('…').map(plain).collect();
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        let found = parts.is_empty() || lines.any(|said| has(&said, &parts));
        assert!(found, "$ {command}\nnothing says: {line}\n{said}");
    }
}

/// Runs every command of a document in a folder, in their order; how many there were.
fn play(document: &str, folder: &Path) -> usize {
    let text = fs::read_to_string(root().join(document)).expect("the document");
    let mut count = 0;
    let mut folder = folder.to_path_buf();
    for block in blocks(&text) {
        let commands: Vec<usize> = (0..block.len())
            .filter(|&k| block[k].starts_with("$ "))
            .collect();
        for (k, &at) in commands.iter().enumerate() {
            let end = commands.get(k + 1).copied().unwrap_or(block.len());
            match block[at].strip_prefix("$ cd ") {
                Some(below) => folder.push(below),
                None => run(&folder, &block[at][2..], &block[at + 1..end]),
            }
            count += 1;
        }
    }
    count
}

/// Copies the files of a folder, not what is in folders below it.
fn copy_files(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("the files are there") {
        let path = entry.expect("an entry").path();
        if path.is_file() {
            fs::copy(&path, to.join(path.file_name().expect("a name"))).expect("copied");
        }
    }
}

fn check_written(folder: &Path, names: &[&str], report: &str) {
    for name in names {
        assert!(folder.join(name).exists(), "{name} was written");
    }
    let report = fs::read(folder.join(report)).expect("the report was written");
    assert!(report.starts_with(b"%PDF-"));
}

#[test]
fn every_command_of_the_walk_prints_what_stands_in_it() {
    let folder = tempfile::tempdir().expect("a folder");
    copy_files(&raw(), folder.path());
    let commands = play("docs/walk-through.md", folder.path());
    assert!(commands >= 11, "{commands} commands");
    let written = [
        "column.json",
        "column.model.json",
        "column.comp",
        "next.csv",
    ];
    check_written(folder.path(), &written, "column.pdf");
}

#[test]
fn every_command_of_the_readme_prints_what_stands_in_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let sessions = folder.path().join("sessions");
    copy_files(&root().join("sessions"), &sessions);
    let commands = play("README.md", folder.path());
    assert!(commands >= 4, "{commands} commands");
    check_written(folder.path(), &["lamp.model.json", "lamp.csv"], "lamp.pdf");
}

fn is_page(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|end| end == "md")
}

/// Whether this machine can run the scripts that a page shows.
fn has_numpy() -> bool {
    let tried = Command::new("python3")
        .args(["-c", "import numpy"])
        .output();
    let has = tried.is_ok_and(|tried| tried.status.success());
    if !has {
        eprintln!("skipped: no python3 with numpy");
    }
    has
}

#[test]
fn every_command_of_the_other_pages_prints_what_stands_in_it() {
    // The walk has files of its own.
    let elsewhere = ["walk-through.md"];
    let mut pages: Vec<String> = fs::read_dir(root().join("docs"))
        .expect("the pages")
        .map(|entry| {
            entry
                .expect("a page")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .filter(|name| is_page(name) && !elsewhere.contains(&name.as_str()))
        .collect();
    pages.sort();
    let mut commands = 0;
    for page in pages {
        let page = format!("docs/{page}");
        let text = fs::read_to_string(root().join(&page)).expect("the page");
        if blocks(&text).is_empty() || (text.contains("$ python3") && !has_numpy()) {
            continue;
        }
        let folder = tempfile::tempdir().expect("a folder");
        // What instruments wrote lies beside the session that is made of it.
        copy_files(&root().join("tests/data/imports"), folder.path());
        for part in [
            "sessions",
            "sessions/arm",
            "tests/reference",
            "tests/data/arms",
        ] {
            copy_files(&root().join(part), &folder.path().join(part));
        }
        commands += play(&page, folder.path());
    }
    assert!(commands >= 30, "{commands} commands");
}

#[test]
fn every_page_is_in_the_books_contents_and_every_link_leads_somewhere() {
    let contents = fs::read_to_string(root().join("docs/README.md")).expect("the contents");
    for page in pages() {
        let name = page.file_name().expect("a name").to_string_lossy();
        let listed = [format!("]({name})"), format!("](../{name})")];
        assert!(
            name == "README.md" || listed.iter().any(|link| contents.contains(link)),
            "{name}"
        );
        let text = fs::read_to_string(&page).expect("the page");
        let links = text
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split_once(')'));
        for (link, _) in links.filter(|(link, _)| !link.contains("://")) {
            let (file, _) = link.split_once('#').unwrap_or((link, ""));
            let there = page.parent().expect("a folder").join(file).exists();
            assert!(file.is_empty() || there, "{}: {link}", page.display());
        }
    }
}

#[test]
fn the_example_of_the_library_calibrates_an_arm() {
    calibrate_an_arm::main().expect("it runs to its end");
}

/// The pages at the root.
const AT_THE_ROOT: [&str; 3] = ["README.md", "SECURITY.md", "CHANGELOG.md"];

/// The pages that a person reads: those of `docs`, those at the root, and the figures beside what measures them.
fn pages() -> Vec<PathBuf> {
    let beside = ["benches/README.md", "fuzz/README.md"];
    let pages = AT_THE_ROOT.into_iter().chain(beside);
    let mut pages: Vec<PathBuf> = pages.map(|name| root().join(name)).collect();
    for entry in fs::read_dir(root().join("docs")).expect("the pages") {
        let path = entry.expect("a page").path();
        if is_page(&path.to_string_lossy()) {
            pages.push(path);
        }
    }
    pages.sort();
    pages
}

#[test]
fn every_picture_of_the_documents_is_there_and_shown_with_words_for_who_does_not_see_it() {
    let mut shown = 0;
    for page in pages() {
        let text = fs::read_to_string(&page).expect("the page");
        let folder = page.parent().expect("a folder");
        for part in text.split("![").skip(1) {
            let (words, rest) = part.split_once("](").expect("a link");
            let (picture, _) = rest.split_once(')').expect("its end");
            assert!(words.len() > 10, "{}: {picture}", page.display());
            assert!(
                folder.join(picture).exists(),
                "{}: {picture}",
                page.display()
            );
            shown += 1;
        }
    }
    assert!(shown >= 15, "{shown} pictures");
}

/// The anchor that a heading has.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || [' ', '-', '_'].contains(c);
    let plain: String = heading.trim().chars().filter(kept).collect();
    plain.to_lowercase().replace(' ', "-")
}

#[test]
fn every_link_to_a_place_of_a_page_finds_its_heading() {
    for page in pages() {
        let text = fs::read_to_string(&page).expect("the page");
        let links = text.split("](").skip(1);
        let links = links.filter_map(|rest| rest.split_once(')'));
        for (link, _) in links.filter(|(link, _)| !link.contains("://")) {
            let Some((file, place)) = link.split_once('#') else {
                continue;
            };
            let there = match file {
                "" => page.clone(),
                file => page.parent().expect("a folder").join(file),
            };
            let there = fs::read_to_string(&there).expect("a page");
            let mut headings = there.lines().filter(|line| line.starts_with('#'));
            let found = headings.any(|line| anchor(line.trim_start_matches('#')) == place);
            assert!(found, "{}: {link}", page.display());
        }
    }
}

/// A file or a folder of this repository that a page names in code, without what stands behind it.
fn named_file(code: &str) -> Option<&str> {
    let file = code.split([' ', ':', '#']).next()?;
    let folders = [
        "src/",
        "crates/",
        "tests/",
        "scripts/",
        "docs/",
        "assets/",
        "sessions/",
        "benches/",
        "examples/",
        "fuzz/",
    ];
    let is_one = folders.iter().any(|folder| file.starts_with(folder));
    (is_one && !file.contains(['*', '$', '…'])).then_some(file)
}

#[test]
fn every_file_that_a_page_names_is_there() {
    let mut folders = house::sources();
    folders.extend(["tests", "docs/examples/extending"].map(|folder| root().join(folder)));
    let sources: Vec<PathBuf> = folders
        .iter()
        .flat_map(|folder| house::files(folder))
        .collect();
    let mut named = 0;
    for page in pages() {
        let text = fs::read_to_string(&page).expect("the page");
        let parts: Vec<&str> = text.split('`').collect();
        // Code within lines; the files of the exercises are made by who does them.
        for pair in parts.chunks_exact(2) {
            let [before, code] = pair else { continue };
            if before.ends_with(" as ") {
                continue;
            }
            if let Some(file) = named_file(code) {
                assert!(root().join(file).exists(), "{}: {file}", page.display());
                named += 1;
            } else if Path::new(code).extension().is_some_and(|e| e == "rs") {
                // The end of its path, where the page has said in which folder.
                let is_one = sources.iter().any(|source| source.ends_with(code));
                assert!(is_one, "{}: {code}", page.display());
                named += 1;
            }
        }
    }
    assert!(named > 80, "{named} files");
}

/// How many words a page has that somebody wrote: without what commands print and tests compare, without the
/// lines of tables and the glossary, which is the window's own.
fn written_words(page: &Path) -> usize {
    let text = fs::read_to_string(page).expect("the page");
    let (text, _) = text.split_once("\n## Glossary\n").unwrap_or((&text, ""));
    let outside = text.split("```").step_by(2);
    let words = outside.flat_map(str::split_whitespace);
    words
        .filter(|word| word.contains(char::is_alphanumeric))
        .count()
}

#[test]
fn the_pages_stay_few_and_short() {
    let of_docs: Vec<PathBuf> = pages()
        .into_iter()
        .filter(|page| page.starts_with(root().join("docs")))
        .collect();
    assert!(of_docs.len() <= 15, "{} pages in docs", of_docs.len());
    let words: usize = of_docs.iter().map(|page| written_words(page)).sum();
    assert!(words <= MOST_WORDS, "{words} words");
    let front = written_words(&root().join("README.md"));
    assert!(front <= 1000, "{front} words on the front page");
}

/// What `docs/extending.md` shows as the sources are is what they are: `scripts/exercises` makes a copy and
/// changes it, and compiles and tests it where more time is given (`scripts/check-slow`).
#[test]
fn the_exercises_apply_to_the_sources_as_they_are() {
    let folder = tempfile::tempdir().expect("a folder");
    let Ok(ran) = Command::new("python3")
        .arg(root().join("scripts/exercises"))
        .arg("--dry")
        .env("CARGO_TARGET_DIR", folder.path())
        .output()
    else {
        eprintln!("skipped: no python3");
        return;
    };
    let said = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{said}");
    let source = folder.path().join("exercises");
    for (file, register, line) in [
        (
            "crates/model/src/effects/scale_expansion.rs",
            "crates/model/src/effects/catalogue.rs",
            "&super::scale_expansion::SCALE_EXPANSION,",
        ),
        (
            "crates/deliver/src/export/json.rs",
            "crates/deliver/src/export/mod.rs",
            "json,",
        ),
        (
            "crates/session/src/importers/formats/euroc.rs",
            "crates/session/src/importers/formats/mod.rs",
            "euroc,",
        ),
        (
            "crates/model/src/observations/kinds/height.rs",
            "crates/model/src/observations/kinds/mod.rs",
            "height: Height,",
        ),
        (
            "src/gui/charts/cumulative.rs",
            "src/gui/charts/mod.rs",
            "cumulative: CUMULATIVE;",
        ),
    ] {
        assert!(source.join(file).exists(), "{file}");
        let register = fs::read_to_string(source.join(register)).expect("the register");
        assert!(register.lines().any(|l| l.trim() == line), "{line}");
    }
}

/// Every threshold of the fit and the diagnosis says in the code what it is, and one script lists them.
#[test]
fn every_constant_that_decides_is_listed_with_its_reason() {
    let Ok(ran) = Command::new("python3")
        .arg(root().join("scripts/constants"))
        .output()
    else {
        eprintln!("skipped: no python3");
        return;
    };
    let listed = String::from_utf8(ran.stdout).expect("UTF-8");
    let said = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{said}");
    let rows: Vec<&str> = listed.lines().filter(|l| l.starts_with("| `")).collect();
    assert!(rows.len() > 200, "{} constants", rows.len());
    for (name, value) in [
        ("odds::TAKEN", "OnceIn(500.0)"),
        ("thresholds::NOTICEABLE", "1.15"),
        ("fit::spectrum::RANK_TOLERANCE", "1e-11"),
        ("compensation::set_aside::MOST_SHARE", "0.02"),
        ("set_up_errors::thresholds::LARGEST_OFFSET_DEG", "45.0"),
    ] {
        let row = format!("| `{name}` | {value} | ");
        assert!(rows.iter().any(|line| line.starts_with(&row)), "{row}");
    }
}
