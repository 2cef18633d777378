//! The terminal in the languages of the program: what a person reads follows `--language`, and what a program reads
//! is the same in all of them.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Output;

use crate::program::truepose;

const LANGUAGES: [&str; 3] = ["en", "de", "zh"];

/// Units and symbols, and what has the same name in every language.
const NAMES: &[&str] = &[
    "mrad", "rad", "deg", "ppm", "arcsec", "min", "ISO", "RMS", "URDF", "MJCF", "truepose",
];

/// The bundled sessions, models of them, and other inputs.
struct Bench(tempfile::TempDir);

impl Bench {
    fn new() -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        let sessions = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions");
        for folder in [sessions.join("arm"), sessions] {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_file() {
                    fs::copy(&path, bench.path().join(path.file_name().unwrap())).unwrap();
                }
            }
        }
        bench
    }

    fn with_models() -> Self {
        let bench = Self::new();
        for [session, model] in [["lamp-commissioning", "column"], ["arm", "arm-model"]] {
            let (session, model) = (format!("{session}.json"), format!("{model}.json"));
            bench.done(&["diagnose", &session, "--out", &model]);
        }
        bench
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn ran(&self, arguments: &[&str]) -> Output {
        let mut command = truepose();
        for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(name);
        }
        command
            .args(arguments)
            .current_dir(self.path())
            .output()
            .unwrap()
    }

    fn done(&self, arguments: &[&str]) -> Output {
        let ran = self.ran(arguments);
        let said = String::from_utf8_lossy(&ran.stderr);
        assert_eq!(ran.status.code(), Some(0), "{arguments:?}: {said}");
        ran
    }

    /// All that it says, in this language.
    fn said(&self, language: &str, arguments: &[&str]) -> String {
        let ran = self.ran(&[&["--language", language][..], arguments].concat());
        String::from_utf8([ran.stderr, ran.stdout].concat()).unwrap()
    }
}

/// Words that stand outside of the marks and are no names.
fn unmarked(text: &str) -> Vec<String> {
    let (mut outside, mut depth) = (String::new(), 0);
    for c in text.chars() {
        match c {
            '⟦' => depth += 1,
            '⟧' => depth -= 1,
            c if depth == 0 => outside.push(c),
            _ => {}
        }
    }
    let is_name = |word: &&str| {
        word.contains(['_', '/', '=', '.', '\'', '+'])
            || word.contains("--")
            || word.contains(|c: char| c.is_ascii_digit())
    };
    let words = outside.split_whitespace();
    let words = words.map(|word| word.trim_matches(|c: char| !c.is_alphanumeric() && c != '-'));
    let words = words.filter(|word| !is_name(word) && word.chars().any(char::is_alphabetic));
    let words = words.filter(|word| word.len() > 2 && !NAMES.contains(word));
    words.map(str::to_owned).collect()
}

#[test]
fn whatever_the_terminal_says_is_a_sentence_of_the_catalogues() {
    if !cfg!(debug_assertions) {
        return; // Only builds for tests know the marked language.
    }
    let bench = Bench::with_models();
    fs::write(
        bench.path().join("bad.json"),
        "{\"format\": 3,\n\"robot\": }",
    )
    .unwrap();
    let commands = [
        "identify paper-30.json",
        "identify paper-30.json --method regional",
        "identify lamp-commissioning.json",
        "identify arm.json",
        "identify bad.json",
        "identify paper-30.json --effects nonsense",
        "identify paper-30.json --out column.json",
        "diagnose lamp-commissioning.json",
        "diagnose lamp-commissioning.json --without encoder-eccentricity",
        "diagnose paper-30.json --held-out 3",
        "diagnose paper-run.json --start regional",
        "diagnose arm.json",
        "diagnose bad.json",
        "verify column.json lamp-commissioning.json",
        "verify column.json arm.json",
        "plan lamp-commissioning.json",
        "plan lamp-commissioning.json --poses 8",
        "plan lamp-commissioning.json --separate backlash,tracking-lag",
        "plan ur5e --poses 12",
        "plan ur5e --iso9283",
        "plan ur5e --poses 0",
        "compensate arm-model.json cell.mod --out c.mod",
        "compensate arm-model.json commands.csv --out c.csv",
        "standards lamp-commissioning.json",
        "standards arm.json",
        "history .",
        "export column.json --to linuxcnc --out e.comp --session lamp-commissioning.json",
        "export arm-model.json --to urdf --out e.urdf",
        "simulate --robot ur5e --out s.json --effect backlash",
        "record tcp://nowhere --out r.csv",
        "effects",
    ];
    // What the machine, its samples and its joints are called.
    let own = [
        "lamp",
        "lamp-commissioning",
        "arm-model",
        "paper-run",
        "commissioning",
        "paper",
        "full",
        "run",
        "samples",
        "six-axis",
        "arm",
        "rotating",
        "column",
        "Universal",
        "Robots",
        "UR5e",
        "tcp",
        "nowhere",
        "nonsense",
        "cell",
        "slide-lead-error",
        "slide",
        "lead",
        "tspot",
        "tspotX",
        "X,Y,Z,A,B,C",
        "QW",
        "QX",
        "QY",
        "QZ",
    ];
    // A key of LinuxCNC's configuration.
    let key = "[TRAJ] ANGULAR_UNITS";
    let mut wrong = BTreeMap::new();
    for command in commands {
        let arguments: Vec<&str> = command.split(' ').collect();
        let said = bench.said("marked", &arguments);
        assert!(said.contains('⟦'), "{command}: {said}");
        let equation = |line: &&str| {
            let signs = ['=', '·', 'δ'];
            command == "effects" && line.contains(signs) || line.contains(key)
        };
        for line in said.lines().filter(|line| !equation(line)) {
            let mut words = unmarked(line);
            words.retain(|word| !own.contains(&word.as_str()) && !is_id(word));
            if !words.is_empty() {
                wrong.entry(line.to_owned()).or_insert((command, words));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Whether it is the id of an effect: options take it.
fn is_id(word: &str) -> bool {
    truepose::effects::find(word).is_some()
}

#[test]
fn documents_and_files_are_the_same_in_every_language() {
    let bench = Bench::with_models();
    let commands = [
        "identify paper-30.json",
        "diagnose lamp-commissioning.json",
        "diagnose lamp-commissioning.json --without encoder-eccentricity",
        "verify column.json lamp-commissioning.json",
        "plan lamp-commissioning.json --poses 4 --out OUT.csv",
        "plan ur5e --iso9283",
        "compensate arm-model.json cell.mod --as-modelled --out OUT.mod",
        "standards lamp-commissioning.json",
        "history .",
        "export column.json --to csv --out OUT.table.csv --session lamp-commissioning.json",
        "export arm-model.json --to urdf --out OUT.urdf",
        "simulate lamp-commissioning.scenario.json --out OUT.session.json",
        "effects",
        "robots ur5e",
    ];
    for command in commands {
        let of = |language: &str| {
            let command = format!("--language {language} {command} --json");
            let arguments: Vec<&str> = command.split(' ').collect();
            let ran = bench.ran(&arguments);
            assert!(!ran.stdout.is_empty(), "{command}");
            let mut bytes = vec![ran.stdout];
            // What was written is read, and makes room for the next language.
            for entry in fs::read_dir(bench.path()).unwrap() {
                let path = entry.unwrap().path();
                let name = path.file_name().unwrap().to_string_lossy().into_owned();
                if name.starts_with("OUT") {
                    bytes.push([name.into_bytes(), fs::read(&path).unwrap()].concat());
                    fs::remove_file(path).unwrap();
                }
            }
            bytes.sort();
            bytes
        };
        let english = of("en");
        for language in &LANGUAGES[1..] {
            assert!(of(language) == english, "{command}: {language}");
        }
    }
}

#[test]
fn comments_in_a_controller_s_file_follow_the_language_and_its_numbers_do_not() {
    let bench = Bench::new();
    bench.done(&["identify", "paper-30.json", "--out", "column.json"]);
    for (format, file) in [("c-header", "e.h"), ("twincat-nc", "e.txt")] {
        let of = |language: &str| {
            let command = format!("export column.json --to {format} --out {file} --force");
            let arguments = command.split(' ').chain(["--language", language]);
            bench.done(&arguments.collect::<Vec<_>>());
            let text = fs::read_to_string(bench.path().join(file)).unwrap();
            let is_comment = |line: &&str| {
                let line = line.trim_start();
                line.starts_with("//") || line.starts_with("/*") || line.starts_with('*')
            };
            let lines: (Vec<&str>, Vec<&str>) = text.lines().partition(is_comment);
            [lines.0.join("\n"), lines.1.join("\n")]
        };
        let [said, code] = of("en");
        for (language, word) in [("de", "Korrektur"), ("zh", "修正")] {
            let [other, same] = of(language);
            assert!(
                said.contains("Correction") && other.contains(word),
                "{other}"
            );
            assert!(!other.contains("Correction of"), "{other}");
            assert_eq!(same, code, "{format}, {language}");
        }
    }
}

#[test]
fn a_german_error_names_file_line_and_column() {
    let bench = Bench::new();
    fs::write(
        bench.path().join("bad.json"),
        "{\"format\": \"truepose-session/1\",\n\"robot\": }",
    )
    .unwrap();
    let said = bench.said("de", &["identify", "bad.json"]);
    assert!(
        said.starts_with("truepose: bad.json, Zeile 2, Spalte 10: "),
        "{said}"
    );
    let ran = bench.ran(&["identify", "bad.json", "--language", "de"]);
    assert_eq!(ran.status.code(), Some(2));
}

#[test]
fn the_language_is_an_option_anywhere_or_that_of_the_environment() {
    let bench = Bench::new();
    let identify = ["identify", "paper-30.json"];
    let english = bench.said("en", &identify);
    let german = bench.said("de", &identify);
    assert!(
        english.contains("RMS error") && german.contains("RMS-Fehler"),
        "{german}"
    );
    let behind = bench.done(&[&identify[..], &["--language=de"]].concat());
    assert_eq!(
        String::from_utf8([behind.stderr, behind.stdout].concat()).unwrap(),
        german
    );
    for (variable, value, said) in [
        ("LC_ALL", "de_AT.UTF-8", &german),
        ("LC_ALL", "fr_FR.UTF-8", &english),
        ("LANG", "de_DE", &german),
    ] {
        let mut command = truepose();
        command.env_remove("LC_ALL").env_remove("LC_MESSAGES");
        let ran = command
            .env(variable, value)
            .args(identify)
            .current_dir(bench.path())
            .output()
            .unwrap();
        let own = String::from_utf8([ran.stderr, ran.stdout].concat()).unwrap();
        assert_eq!(own, *said, "{variable}={value}");
    }
    // A language of programs is another thing.
    let plan = [
        "plan", "ur5e", "--poses", "9", "--as", "krl", "--out", "p.src",
    ];
    bench.done(&[&["--language", "zh"][..], &plan].concat());
    for wrong in [
        &["--language", "fr"][..],
        &["--language"],
        &["--language", ""],
    ] {
        let ran = bench.ran(&[&identify[..], wrong].concat());
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(2), "{wrong:?}: {said}");
        assert!(
            ran.stdout.is_empty() && said.contains("--language"),
            "{said}"
        );
    }
    let both = bench.ran(&["paper-30.json", "identify", "paper-30.json"]);
    assert_eq!(both.status.code(), Some(2));
}

#[test]
fn columns_stand_above_each_other_in_every_language() {
    let bench = Bench::with_models();
    // How wide a terminal shows it, up to where the numbers begin.
    let wide = |text: &str| {
        text.chars()
            .map(|c| if c >= '\u{2e80}' { 2 } else { 1 })
            .sum::<usize>()
    };
    for language in LANGUAGES {
        let said = bench.said(
            language,
            &["verify", "column.json", "lamp-commissioning.json"],
        );
        // Behind the session and the heading stand the figures, set in.
        let figures = said
            .lines()
            .skip(2)
            .map_while(|line| line.strip_prefix("  "));
        let begins = figures.map(|line| {
            let labels = line.split("  ").next().unwrap().len();
            wide(&line[..labels]) + line[labels..].chars().take_while(|c| *c == ' ').count()
        });
        let begins: Vec<usize> = begins.collect();
        assert!(
            begins.len() > 3 && begins.iter().all(|at| *at == begins[0]),
            "{said}"
        );
    }
}
