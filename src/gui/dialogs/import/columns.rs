//! The columns: what each is taken for, how that is known, its heading, and the first rows.

use std::sync::Arc;

use egui::{ComboBox, Grid, RichText, ScrollArea, Ui};

use crate::gui::import_draft::ImportDraft;
use crate::gui::style::{Palette, size, strong};
use crate::gui::widgets::{self, Words};
use crate::importers::{ColumnGuess, Importer, Known, Meanings};
use crate::kinematics::Robot;
use crate::present::units::in_unit;

/// Rows that are shown.
const ROWS: usize = 5;
/// Joints that are offered while no robot is known.
const JOINTS: usize = 6;

/// A meaning: the word for it and what a person calls it.
type Meaning = (String, String);

/// Every meaning that a column of such a file can have.
fn meanings(kind: Option<&Importer>, joints: usize) -> Vec<Meaning> {
    let mut all = Vec::new();
    let mut add = |word: &str, text: &str| all.push((word.to_owned(), text.to_owned()));
    add("-", say!("not imported"));
    if let Some(Meanings::Own(words)) = kind.map(|importer| importer.asks.columns) {
        for (word, text) in words {
            add(word, text);
        }
        return all;
    }
    add("name", say!("point name"));
    add("group", say!("group of points"));
    add("target", say!("reflector"));
    for axis in ["x", "y", "z"] {
        add(axis, &say!("{axis}, unit as chosen", axis));
        for unit in ["mm", "m", "in"] {
            add(&format!("{axis}_{unit}"), &format!("{axis}, {unit}"));
        }
    }
    let units = [("deg", "°"), ("rad", "rad"), ("mm", "mm")];
    for n in 1..=joints {
        for (unit, sign) in units {
            let text = say!("joint {n} commanded, {sign}", n, sign);
            add(&format!("q{n}_{unit}"), &text);
        }
        for (unit, sign) in units {
            let text = say!("joint {n} read back, {sign}", n, sign);
            add(&format!("q{n}_read_{unit}"), &text);
        }
        add(&format!("dir{n}"), &say!("side joint {n} came from", n));
        let text = say!("speed of joint {n}, °/s", n);
        add(&format!("speed{n}_deg_s"), &text);
    }
    add("load_kg", &in_unit(say!("load"), "kg"));
    add("temperature_c", &in_unit(say!("temperature"), "°C"));
    add("time_s", say!("time, s"));
    add("setup", say!("setup of the instrument"));
    add("use", say!("fit, held-out or excluded"));
    for part in ["w", "x", "y", "z"] {
        add(&format!("q{part}"), &say!("orientation {part}", part));
    }
    all
}

/// How a meaning is known, in a word.
fn how(guess: &ColumnGuess) -> &'static str {
    if matches!(guess.meaning.as_str(), "" | "-") {
        return "";
    }
    match guess.confidence {
        Known::Said => say!("as you said"),
        Known::Certain => say!("certain"),
        Known::FromHeading => say!("from header, please confirm"),
        Known::FromContent => say!("guessed from the values"),
    }
}

pub(super) fn show(ui: &mut Ui, draft: &mut ImportDraft) {
    let seen = Arc::clone(&draft.seen);
    let found = &seen.inspection;
    if found.columns.is_empty() {
        return;
    }
    ui.section(say!(
        "Columns: what each is, how that is known, its heading, first rows"
    ));
    let robot = seen.robot.as_ref().and_then(|r| r.as_ref().ok());
    let joints = robot.map_or(JOINTS, Robot::joint_count);
    let offered = meanings(found.kind, joints);
    if let Some((k, word)) = table(ui, draft, &offered) {
        let reading = &mut draft.answers.reading;
        reading.columns = in_words(found.kind, &found.columns, &reading.columns);
        reading.columns[k] = word;
    }
    if !found.preamble.is_empty() {
        let lines: Vec<&str> = found.preamble.iter().map(String::as_str).take(3).collect();
        ui.hint(say!("Before the table: {lines}", lines = lines.join(" / ")));
    }
    if found.questions.is_empty() && draft.asks_for_confirmation() {
        widgets::card(ui, |ui| {
            let guesses = found.columns.iter().filter(|c| c.is_guess()).count();
            let says = say!(
                one "{count} of {columns} columns is guessed: compare it with the first rows", "{count} of {columns} columns are guessed: compare them with the first rows",
                count = guesses,
                columns = found.columns.len()
            );
            ui.colored_label(Palette::of(ui).warning, says);
            if ui.button(say!("The columns are right")).clicked() {
                draft.confirm();
            }
        });
    }
}

/// The columns as words that mean the same when they are said, and are guesses still where they
/// were.
fn in_words(kind: Option<&Importer>, columns: &[ColumnGuess], before: &[String]) -> Vec<String> {
    let columns_of = kind.map(|importer| importer.asks.columns);
    let own_words = matches!(columns_of, Some(Meanings::Own(_)));
    let word = |(k, guess): (usize, &ColumnGuess)| match (guess.confidence, guess.heading.as_str())
    {
        (Known::Said, _) => before.get(k).unwrap_or(&guess.meaning).clone(),
        (_, "") if matches!(guess.meaning.as_str(), "" | "-") => "-".to_owned(),
        // Such a file's headings are its words.
        (_, "") if own_words => guess.meaning.clone(),
        (_, heading) if own_words => heading.to_owned(),
        // A heading may say more than a word can: a time in ms, a length in cm.
        _ => "auto".to_owned(),
    };
    columns.iter().enumerate().map(word).collect()
}

fn table(ui: &mut Ui, now: &ImportDraft, offered: &[Meaning]) -> Option<(usize, String)> {
    let found = &now.seen.inspection;
    let (mut changed, warning) = (None, Palette::of(ui).warning);
    let fixed = found
        .kind
        .is_some_and(|importer| importer.asks.columns == Meanings::Fixed);
    let bar = ScrollArea::horizontal().id_salt("columns");
    bar.show(ui, |ui| {
        let grid = Grid::new("columns of the file")
            .striped(true)
            .min_row_height(18.0);
        grid.spacing([10.0, 4.0]).show(ui, |ui| {
            for (k, guess) in found.columns.iter().enumerate() {
                let meaning = offered.iter().find(|(word, _)| *word == guess.meaning);
                let text = match (guess.meaning.as_str(), meaning) {
                    ("" | "-", _) => say!("not imported"),
                    (_, Some((_, text))) => text,
                    (other, None) => other,
                };
                if fixed {
                    ui.label(text);
                    continue;
                }
                let list = ComboBox::from_id_salt(("meaning", k)).selected_text(text);
                let list = list.width(118.0).height(320.0);
                let label = say!("Meaning of column {k}", k = k + 1);
                let offered = offered.iter().map(|(word, text)| (word.as_str(), text));
                let chosen = widgets::list(ui, label, list, offered, guess.meaning.as_str());
                if let Some(word) = chosen {
                    changed = Some((k, word.to_owned()));
                }
            }
            ui.end_row();
            widgets::dense(ui);
            for guess in &found.columns {
                let how = RichText::new(how(guess)).small();
                let asked = guess.is_guess() && now.asks_for_confirmation();
                ui.label(if asked {
                    how.color(warning)
                } else {
                    how.weak()
                });
            }
            ui.end_row();
            if found.columns.iter().any(|c| !c.heading.is_empty()) {
                for guess in &found.columns {
                    ui.label(RichText::new(&guess.heading).font(strong(size::SMALL)));
                }
                ui.end_row();
            }
            for cells in found.first_rows.iter().take(ROWS) {
                for k in 0..found.columns.len() {
                    ui.caption(cells.get(k).map_or("", String::as_str));
                }
                ui.end_row();
            }
        });
    });
    changed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::importers::{Reading, find, inspect};

    #[test]
    fn every_meaning_that_is_offered_is_understood() {
        for meaning in meanings(find("csv"), 3) {
            let reading = Reading {
                kind: find("csv"),
                columns: vec![meaning.0.clone()],
                ..Reading::default()
            };
            let found = inspect(b"1 2 3 4\n5 6 7 8\n", &reading);
            let unknown = |finding: &&crate::diagnostic::Diagnostic| {
                finding.to_string().contains("among the columns given")
            };
            assert!(
                found.findings.iter().find(unknown).is_none(),
                "{}",
                meaning.0
            );
            assert_eq!(found.columns[0].meaning, meaning.0);
        }
    }

    #[test]
    fn choosing_one_column_leaves_the_others_what_they_are() {
        let text = b"Timestamp [ms];X [cm];Y [cm];Z [cm];Spalte 5\n1;2,5;3,5;4,5;5\n";
        let reading = Reading {
            kind: find("csv"),
            ..Reading::default()
        };
        let found = inspect(text, &reading);
        let mut words = in_words(found.kind, &found.columns, &[]);
        "load_kg".clone_into(&mut words[4]);
        let reading = Reading {
            columns: words,
            ..reading
        };
        let again = inspect(text, &reading);
        let meant = |found: &crate::importers::Inspection| -> Vec<String> {
            found.columns.iter().map(|c| c.meaning.clone()).collect()
        };
        assert_eq!(meant(&again)[..4], meant(&found)[..4]);
        assert_eq!(again.unit, found.unit);
        assert_eq!(again.columns[4].meaning, "load_kg");
        assert_eq!(again.columns[4].confidence, Known::Said);
    }
}
