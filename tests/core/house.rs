//! Rules of the house that the compiler does not hold: what may know of what.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use truepose::effects::{BESIDE_THE_CATALOGUE, CATALOGUE};

/// One line of code, outside tests and without its comment.
pub(crate) struct Line {
    /// Below the `src` of its crate.
    pub(crate) path: String,
    file: PathBuf,
    number: usize,
    pub(crate) text: String,
}

impl Line {
    /// Where it is, and what it says.
    fn shown(&self) -> String {
        let (file, text) = (self.file.display(), self.text.trim());
        format!("{file}:{}: {text}", self.number)
    }
}

/// The folders of the sources: of every crate, and of the program.
pub(crate) fn sources() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = fs::read_dir(root.join("crates")).unwrap();
    let mut all: Vec<PathBuf> = crates.map(|one| one.unwrap().path().join("src")).collect();
    all.push(root.join("src"));
    all.sort();
    all
}

/// Every Rust file below a folder.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    files_ending(folder, "rs")
}

/// Every file of this ending below a folder.
pub(crate) fn files_ending(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files_ending(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// What stands above what only tests see, those of the window too.
const OF_TESTS: [&str; 2] = ["#[cfg(test)]", "#[cfg(any(test, debug_assertions))]"];

/// Modules that their parent declares under `#[cfg(test)]`.
fn test_modules(all: &[(PathBuf, String)]) -> Vec<PathBuf> {
    let mut modules = Vec::new();
    for (path, text) in all {
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        for pair in lines.windows(2) {
            let declared = pair[1].strip_prefix("pub(crate) ").unwrap_or(pair[1]);
            let name = declared
                .strip_prefix("mod ")
                .and_then(|rest| rest.strip_suffix(';'));
            if let (true, Some(name)) = (pair[0] == "#[cfg(test)]", name) {
                let stem = path.file_stem().unwrap().to_str().unwrap();
                let own = ["mod", "lib"].contains(&stem);
                let parent = path.parent().unwrap();
                let folder = if own {
                    parent.to_path_buf()
                } else {
                    parent.join(stem)
                };
                modules.push(folder.join(name));
            }
        }
    }
    modules
}

/// The code of all crates, without tests and comments.
pub(crate) fn code() -> Vec<Line> {
    let lines: Vec<Line> = sources()
        .iter()
        .flat_map(|source| code_below(source))
        .collect();
    assert!(lines.len() > 10_000, "the sources are not where they were");
    lines
}

fn code_below(root: &Path) -> Vec<Line> {
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        (path, text)
    };
    let all: Vec<_> = files(root).into_iter().map(read).collect();
    let tests = test_modules(&all);
    let mut lines = Vec::new();
    for (path, text) in &all {
        let of_tests = tests
            .iter()
            .any(|module| path.starts_with(module) || path.with_extension("") == *module);
        if of_tests {
            continue;
        }
        let relative = path.strip_prefix(root).unwrap();
        let home = Path::new(env!("CARGO_MANIFEST_DIR"));
        let file = path.strip_prefix(home).unwrap();
        // Tests stand beneath the code.
        let code = text.lines().enumerate().take_while({
            let mut before = "";
            move |(_, line)| {
                let module =
                    line.starts_with("mod ") || line.starts_with("pub") && line.contains(" mod ");
                let tests = OF_TESTS.contains(&before) && module && line.ends_with('{');
                before = line;
                !tests
            }
        });
        for (k, line) in code {
            if !line.trim_start().starts_with("//") {
                lines.push(Line {
                    path: relative.to_str().unwrap().replace('\\', "/"),
                    file: file.to_owned(),
                    number: k + 1,
                    text: line.to_owned(),
                });
            }
        }
    }
    lines
}

fn report(rule: &str, found: &[String]) {
    assert!(found.is_empty(), "{rule}\n{}", found.join("\n"));
}

#[test]
fn an_effect_is_named_in_its_own_file_and_nowhere_else() {
    let effects = CATALOGUE.iter().chain(BESIDE_THE_CATALOGUE);
    // What has no name is called "unexplained" and "unnamed" in the answers too, where it is no effect.
    let ids: Vec<String> = effects
        .map(|effect| effect.about().id)
        .filter(|id| !["unexplained", "unnamed"].contains(id))
        .map(|id| format!("\"{id}\""))
        .collect();
    let found: Vec<String> = code()
        .iter()
        .filter(|line| !line.path.starts_with("effects/"))
        .filter(|line| ids.iter().any(|id| line.text.contains(id)))
        .map(Line::shown)
        .collect();
    report(
        "ask the effect's data (About: role, owner, over, needs, setting …), not its name:",
        &found,
    );
}

#[test]
fn an_effect_is_named_in_a_file_or_folder_of_its_own() {
    let mut found = Vec::new();
    let code = code();
    for effect in CATALOGUE.iter().chain(BESIDE_THE_CATALOGUE) {
        let id = effect.about().id;
        let quoted = format!("\"{id}\"");
        let own = format!("effects/{}.rs", id.replace('-', "_"));
        let of_its_own = format!("effects/{}/", id.replace('-', "_"));
        for line in code.iter().filter(|l| l.path.starts_with("effects/")) {
            // What an effect becomes in the limit, its own file says.
            let limit = line.text.contains("becomes: Some(");
            if line.path != own
                && !line.path.starts_with(&of_its_own)
                && line.text.contains(&quoted)
                && !limit
            {
                found.push(line.shown());
            }
        }
    }
    report("one effect, one file:", &found);
}

#[test]
fn what_the_head_of_a_folder_lists_is_there() {
    let all: Vec<PathBuf> = sources().iter().flat_map(|source| files(source)).collect();
    let stem = |path: &Path| path.file_stem().unwrap().to_str().unwrap().to_owned();
    let folders = all.iter().filter_map(|file| file.parent());
    let modules: BTreeSet<String> = all
        .iter()
        .map(|file| stem(file))
        .chain(folders.map(stem))
        .collect();
    let mut found = Vec::new();
    let mut listed = 0;
    for file in all.iter().filter(|file| file.ends_with("mod.rs")) {
        for line in fs::read_to_string(file).unwrap().lines() {
            let Some((names, _)) = line
                .strip_prefix("//! - ")
                .and_then(|item| item.split_once(": "))
            else {
                continue;
            };
            // What stands in a list besides names of files is in the form of a path, of a type or of a call.
            let is_file = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
            for name in names
                .split('`')
                .skip(1)
                .step_by(2)
                .filter(|name| name.chars().all(is_file))
            {
                listed += 1;
                if !modules.contains(name) {
                    found.push(format!("{}: {name}", file.display()));
                }
            }
        }
    }
    assert!(listed > 80, "the heads of folders list {listed} files");
    report(
        "the head of a folder names a file that is not there:",
        &found,
    );
}

#[test]
fn matrices_are_decomposed_where_that_ends() {
    let own = [
        "SymmetricEigen::new(",
        ".symmetric_eigen(",
        ".svd(",
        "SVD::new(",
        ".singular_values()",
        ".pseudo_inverse(",
    ];
    let found: Vec<String> = code()
        .iter()
        .filter(|line| line.path != "decompose.rs")
        .filter(|line| own.iter().any(|name| line.text.contains(name)))
        .map(Line::shown)
        .collect();
    report(
        "nalgebra's own may go on for ever, take crate::decompose:",
        &found,
    );
}

#[test]
fn the_vector_of_a_rotation_is_taken_where_it_is_a_number() {
    let found: Vec<String> = code()
        .iter()
        .filter(|line| line.text.contains(".scaled_axis("))
        .map(Line::shown)
        .collect();
    report(
        "nalgebra's own is no number for some matrices, take crate::kinematics::quaternion:",
        &found,
    );
}

#[test]
fn the_core_knows_nothing_of_the_window() {
    // The command that opens the window has to. To the other crates Cargo gives no library of the window.
    let may = ["cli/window.rs", "lib.rs"];
    let found: Vec<String> = code()
        .iter()
        .filter(|line| !line.path.starts_with("gui/") && !may.contains(&line.path.as_str()))
        .filter(|line| {
            ["crate::gui", "truepose::gui", "egui", "eframe"]
                .iter()
                .any(|name| line.text.contains(name))
        })
        .map(Line::shown)
        .collect();
    report("the core does not import the window:", &found);
}

/// The steps of the job: module and function. Terminal and window reach them by `pipeline` alone.
const STEPS: [(&str, &str); 28] = [
    ("sessions", "load"),
    ("sessions", "load_robot"),
    ("sessions", "load_watched"),
    ("sessions", "parse"),
    ("sessions", "parse_with_csv"),
    ("sessions", "save"),
    ("sessions", "save_watched"),
    ("sessions", "write_inline"),
    ("model", "is_model"),
    ("model", "load_model"),
    ("compensation", "VerifiedCalibration::on"),
    ("fit", "identify_exact"),
    ("fit", "identify_regional"),
    ("fit", "identify_watched"),
    ("diagnosis", "diagnose"),
    ("paper", "regional_start"),
    ("compensation", "verify"),
    ("standards", "standards"),
    ("programs", "compensate"),
    ("design", "measuring_list"),
    ("design", "measuring_program"),
    ("design", "plan_robot"),
    ("design", "plan_session"),
    ("simulation", "load_scenario"),
    ("simulation", "simulate"),
    ("importers", "import"),
    ("importers", "import_watched"),
    ("history", "history"),
];

/// The paths that `use` brings into a file.
fn imported(code: &str) -> Vec<String> {
    fn expand(before: &str, tree: &str, paths: &mut Vec<String>) {
        let tree = tree.trim();
        let Some(brace) = tree.find('{') else {
            let path = tree.split(" as ").next().unwrap_or_default();
            paths.push(format!("{before}{path}"));
            return;
        };
        let before = format!("{before}{}", &tree[..brace]);
        let inside = &tree[brace + 1..tree.rfind('}').unwrap()];
        let (mut depth, mut start) = (0, 0);
        for (at, c) in inside.char_indices().chain([(inside.len(), ',')]) {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    expand(&before, &inside[start..at], paths);
                    start = at + 1;
                }
                _ => {}
            }
        }
    }
    let mut paths = Vec::new();
    for statement in code.split(';') {
        let tree = statement.rsplit_once("use ").map(|(_, tree)| tree);
        if let Some(tree) = tree.filter(|t| t.starts_with("crate::") || t.starts_with("truepose::"))
        {
            expand("", tree, &mut paths);
        }
    }
    paths
}

#[test]
fn terminal_and_window_go_through_the_pipeline_and_nothing_else() {
    let mut files: Vec<(String, String)> = Vec::new();
    for line in code() {
        if !line.path.starts_with("cli/") && !line.path.starts_with("gui/") {
            continue;
        }
        if files.last().is_none_or(|(path, _)| *path != line.path) {
            files.push((line.path.clone(), String::new()));
        }
        let (_, text) = files.last_mut().unwrap();
        *text += line.text.trim();
        text.push(' ');
    }
    let mut found = Vec::new();
    for (path, text) in &files {
        let paths = imported(text);
        for (module, step) in STEPS {
            let is_step = |path: &String| {
                let names: Vec<&str> = path.split("::").collect();
                names.len() > 2 && names[1] == module && names.last() == Some(&step)
            };
            let in_full = format!("{module}::{step}(");
            if paths.iter().any(is_step) || text.contains(&in_full) {
                found.push(format!("src/{path}: {module}::{step}"));
            }
        }
        for step in [".exporter", "Report::of_", "report::html", "report::pdf"] {
            if text.contains(step) {
                found.push(format!("src/{path}: {step}"));
            }
        }
    }
    report("take it from `pipeline`:", &found);
}

#[test]
fn the_window_takes_no_joint_for_the_only_one() {
    let found: Vec<String> = code()
        .iter()
        .filter(|line| line.path.starts_with("gui/") && line.text.contains("joints[0]"))
        .map(Line::shown)
        .collect();
    report("a robot has as many joints as it has:", &found);
}

/// The window's folders from the bottom to the top; what stands in one row is of one floor.
const FLOORS: [&[&str]; 14] = [
    &["language"],
    &["jobs", "help", "style"],
    &["core"],
    &["import_draft"],
    &["view"],
    &["cache"],
    &["charts"],
    &["files", "file_state"],
    &["workbench"],
    &["actions", "layers", "widgets"],
    &["plots"],
    &["workspace"],
    &["views"],
    &["dialogs"],
];

/// The first name behind every `from` in a line, also of those in braces.
fn named_after<'a>(line: &'a str, from: &str) -> Vec<&'a str> {
    let word = |text: &'a str| {
        let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
        &text[..end.unwrap_or(text.len())]
    };
    let mut names = Vec::new();
    for (at, _) in line.match_indices(from) {
        let rest = &line[at + from.len()..];
        match rest.strip_prefix('{') {
            Some(all) => names.extend(all.split(',').map(|one| word(one.trim()))),
            None => names.push(word(rest)),
        }
    }
    names
}

#[test]
fn the_document_knows_no_cache_the_cache_no_view_and_nothing_in_the_window_what_stands_above() {
    let floor = |name: &str| FLOORS.iter().position(|floor| floor.contains(&name));
    let mut found = Vec::new();
    for line in code() {
        let Some(inside) = line.path.strip_prefix("gui/") else {
            continue;
        };
        let own = inside.split(['/', '.']).next().unwrap_or_default();
        // The shell and the module of all stand over everything.
        if ["app", "mod", "testing"].contains(&own) {
            continue;
        }
        let own_floor = floor(own).unwrap_or_else(|| panic!("gui/{own} stands on no floor"));
        // A file of its own reaches the others by `super` as well.
        let mut named = named_after(&line.text, "crate::gui::");
        if inside.matches('/').count() == 0 {
            named.extend(named_after(&line.text, "super::"));
        }
        let up = |name: &&str| floor(name).is_some_and(|floor| floor > own_floor) || *name == "app";
        for name in named.into_iter().filter(up) {
            found.push(format!(
                "src/{}:{}: {name} stands above {own}",
                line.path, line.number
            ));
        }
    }
    report("the window is built from the bottom to the top:", &found);
}
