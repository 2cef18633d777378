//! The report in a language of the tests: no word that a person reads is outside of the sentences of the catalogues,
//! but for names, numbers, units and hashes.

use std::collections::BTreeSet;
use std::path::Path;

use truepose::compensation::decision::Rule;
use truepose::diagnosis::Options;
use truepose::pipeline;
use truepose::present::drawing::{Drawing, Item};
use truepose::report::document::{Block, Report};
use truepose::report::{Details, Extras, html};
use truepose::sessions::Session;
use truepose::sessions::load;
use truepose::text::{Language, choose};

/// Units, axes, and the symbols and names of standards.
const SYMBOLS: [&str; 15] = [
    "mm", "kg", "ppm", "deg", "rad", "mrad", "µrad", "arcsec", "ISO", "AP", "RP", "vAP", "AT",
    "RT", "mean",
];

/// What the core says and no catalogue has, and why.
const UNTRANSLATED: [&str; 0] = [];

fn session(name: &str) -> Session {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    load(root.join("sessions").join(name))
        .expect("a bundled session")
        .session
}

fn extras() -> Extras {
    Extras {
        details: Details {
            customer: "Lamp".to_owned(),
            rule: Some(Rule::Iso14253),
            ..Details::default()
        },
        ..Extras::default()
    }
}

fn report(session: &Session, language: Language) -> Report {
    choose(language);
    let made = pipeline::report(session, &Options::default(), &extras(), &|_| true);
    choose(Language::English);
    made.expect("a report")
}

/// Everything that can be read.
fn texts(report: &Report) -> Vec<String> {
    let mut all = vec![
        report.title.clone(),
        report.answer.clone(),
        report.foot.clone(),
    ];
    all.extend(report.decision.iter().map(|(_, says)| says.clone()));
    for figure in &report.headline {
        all.extend([&figure.name, &figure.value, &figure.reference].map(Clone::clone));
    }
    for section in &report.sections {
        all.push(section.title.clone());
        for block in &section.blocks {
            match block {
                Block::Heading(text) | Block::Text(text) | Block::Warning(text) => {
                    all.push(text.clone());
                }
                Block::List(points) => all.extend(points.iter().cloned()),
                Block::Facts(facts) | Block::Sign(facts) => {
                    all.extend(
                        facts
                            .iter()
                            .flat_map(|(name, value)| [name, value])
                            .cloned(),
                    );
                }
                Block::Table(table) => {
                    // They may be one sentence.
                    let heads = table.columns.iter().map(|column| column.heading.as_str());
                    all.push(heads.collect::<Vec<_>>().join(" | "));
                    all.extend(table.rows.iter().flatten().map(|cell| cell.shown.clone()));
                }
                Block::Plot(drawing, caption) => {
                    all.push(caption.clone());
                    all.extend(labels(drawing));
                }
            }
        }
    }
    all
}

fn labels(drawing: &Drawing) -> impl Iterator<Item = String> {
    drawing.items.iter().filter_map(|item| match item {
        Item::Text(label) => Some(label.text.clone()),
        _ => None,
    })
}

/// What stands outside of ⟦ ⟧.
fn outside(text: &str) -> String {
    let mut depth = 0_u32;
    let mut outside = String::new();
    for c in text.chars() {
        match c {
            '⟦' => depth += 1,
            '⟧' => depth = depth.saturating_sub(1),
            _ if depth == 0 => outside.push(c),
            _ => continue,
        }
        if depth > 0 {
            outside.push(' ');
        }
    }
    outside
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !c.is_alphabetic());
    words.filter(|word| word.chars().count() > 1)
}

/// The names in a session.
fn names(session: &Session) -> BTreeSet<String> {
    let robot = &session.robot;
    let own = [
        &session.name,
        &session.note,
        &robot.name,
        &session.instrument.name,
    ];
    let joints = robot.joints.iter().map(|joint| &joint.name);
    let targets = session.targets.iter().map(|target| &target.name);
    let all = own.into_iter().chain(joints).chain(targets);
    all.flat_map(|text| words(text).map(str::to_owned).collect::<Vec<_>>())
        .collect()
}

/// Texts with a word that is in no catalogue.
fn untranslated(report: &Report, session: &Session) -> Vec<String> {
    let names = names(session);
    let is_hash = |token: &str| token.len() >= 12 && token.bytes().all(|b| b.is_ascii_hexdigit());
    let foreign = |text: &String| {
        let rest = outside(text);
        let tokens = rest.split_whitespace().filter(|token| !is_hash(token));
        let mut found = tokens.flat_map(words);
        found.any(|word| {
            !names.contains(word)
                && !SYMBOLS.contains(&word)
                && !["truepose", "Lamp"].contains(&word)
                && !UNTRANSLATED.contains(&word)
        })
    };
    texts(report).into_iter().filter(foreign).collect()
}

#[test]
fn every_sentence_of_a_report_is_in_the_catalogues() {
    for name in ["lamp-commissioning.json", "arm/arm.json"] {
        let session = session(name);
        let found = untranslated(&report(&session, Language::Marked), &session);
        assert!(found.is_empty(), "{name}:\n{}", found.join("\n"));
    }
}

#[test]
fn every_sentence_of_the_report_of_a_model_is_in_the_catalogues() {
    let session = session("paper-30.json");
    let found = pipeline::diagnose(&session, &Options::default(), &|_| true).expect("a diagnosis");
    let model = pipeline::hand_out(&found.calibration(&session), &session).expect("it is verified");
    choose(Language::Marked);
    let made = pipeline::report_of_model(&model, &extras());
    choose(Language::English);
    let found = untranslated(&made, &session);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_report_names_its_language_whoever_writes_it() {
    let session = session("paper-30.json");
    let english = html(&report(&session, Language::English));
    let german = report(&session, Language::German);
    // The thread speaks English again.
    let german = html(&german);
    assert!(english.contains("<html lang=\"en\">") && english.contains("Calibration report"));
    for said in [
        "<html lang=\"de\">",
        "Kalibrierbericht",
        "Seite \" counter(page) \" von \" counter(pages) \"",
    ] {
        assert!(german.contains(said), "{said}");
    }
    assert!(!german.contains("Calibration report"));
    // Numbers are written alike.
    let numbers = |page: &str| -> Vec<String> {
        let tables = page.split("<td class=\"n\">").skip(1);
        let cells = tables.filter_map(|rest| rest.split("</td>").next());
        cells
            .filter(|cell| cell.starts_with(|c: char| c.is_ascii_digit() || c == '−'))
            .map(str::to_owned)
            .collect()
    };
    assert_eq!(numbers(&english), numbers(&german));
}
