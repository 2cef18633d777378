//! What is not saved: a path to save to, as it is typed; what would be lost, before it is; a file that changed,
//! before it is replaced; and what windows that are gone have left behind.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use egui::{Id, Key, TextEdit, Ui};

use crate::text::capital;

use crate::gui::core::disk::name_of;
use crate::gui::view::{NextAction, Sheet, What};
use crate::gui::widgets::{self, Buttons, Forms, Words};
use crate::gui::workbench::Workbench;

/// Shows what would be lost, and what can be done about it.
pub(super) fn losses(ui: &mut Ui, workbench: &Workbench, then: &NextAction) {
    let discard = say!("Go on without saving");
    widgets::head(ui, 520.0, say!("{question}?", question = discard));
    let name = &workbench.loaded_session().session.name;
    let losses = workbench.at_risk();
    if losses.session {
        let file = workbench.file().and_then(Path::file_name);
        ui.label(match file {
            Some(file) => say!(
                "Changes of {name} are not in its file, {file}",
                name,
                file = file.to_string_lossy()
            ),
            None => say!("The session {name} has not been saved", name),
        });
    }
    if losses.model {
        ui.label(say!(
            "What was identified from {name} has not been saved",
            name
        ));
    }
    let save = match (losses.session, losses.model) {
        (true, true) => widgets::dots(say!("Save session and model")),
        (true, false) => say!("Save session").to_owned(),
        (false, true) => widgets::dots(say!("Save model")),
        (false, false) => discard.to_owned(),
    };
    let then = then.clone();
    match ui.foot([(say!("Cancel"), true), (discard, true), (&save, true)]) {
        Some(0) => workbench.then(|bench| bench.show_sheet(None)),
        Some(2) if losses.any() => workbench.then(move |bench| bench.save_then(then)),
        Some(_) => workbench.then(move |bench| bench.go(then)),
        None => {}
    }
}

/// Asks before what was typed on a sheet is discarded.
pub(super) fn typed(ui: &mut Ui, sheet: &Sheet, workbench: &Workbench) {
    widgets::head(ui, 420.0, say!("Discard what was typed?"));
    let pressed = ui.foot([(say!("Discard"), true), (say!("Go on with it"), true)]);
    if pressed.is_some() || widgets::entered(ui) {
        let next = match pressed {
            Some(0) => sheet.before(),
            _ => Some(sheet.clone()),
        };
        workbench.then(|bench| bench.show_sheet(next));
    }
}

/// Asks whether a file that changed since it was read is to be replaced.
pub(super) fn overwrite(ui: &mut Ui, path: &Path, workbench: &Workbench) {
    widgets::head(ui, 420.0, say!("Replace what another program wrote?"));
    ui.label(say!(
        "{path} changed since it was read. Saving here would replace what was written there",
        path = path.display()
    ));
    let (keep, lose) = (
        widgets::dots(say!("Save under another name")),
        say!("Replace it"),
    );
    match ui.foot([(say!("Cancel"), true), (lose, true), (&keep, true)]) {
        Some(1) => workbench.then(Workbench::save_despite),
        Some(pressed) => workbench.then(move |bench| {
            bench.show_sheet(None);
            if pressed == 2 {
                bench.choose_where_to_export(What::Session);
            }
        }),
        None => {}
    }
}

/// What a window that is gone has left behind: what, from when, and whether to bring it back.
pub(super) fn recovery(ui: &mut Ui, workbench: &Workbench) {
    let Some(left) = workbench.left_behind() else {
        return;
    };
    widgets::head(ui, 460.0, say!("Recover unsaved work"));
    ui.hint(say!(
        "The last time the program ended without warning. What is not restored now is offered again"
    ));
    widgets::card(ui, |ui| {
        ui.bold(&left.kept.session.name);
        if let Some(ago) = left.when.and_then(ago) {
            ui.fact(say!("last saved"), ago);
        }
        let samples = left.kept.session.samples.len().to_string();
        ui.fact(say!("samples"), samples);
        if let Some(file) = &left.kept.about.file {
            ui.fact(say!("file"), name_of(file));
        }
    });
    // What is discarded cannot be brought back: it takes a second press.
    let id = Id::unique(("discard of the recovery", left.when));
    let sure = ui.data(|data| data.get_temp(id).unwrap_or(false));
    let discard = if sure {
        say!("Discard for good")
    } else {
        say!("Discard")
    };
    match ui.foot([
        (discard, true),
        (say!("Not now"), true),
        (&capital(say!("restore")), true),
    ]) {
        Some(0) if sure => workbench.then(Workbench::discard_left_behind),
        Some(0) => drop(ui.data_mut(|data| data.insert_temp(id, true))),
        Some(1) => workbench.then(|bench| bench.show_sheet(None)),
        Some(_) => workbench.then(Workbench::restore),
        None => {}
    }
}

/// How long ago, in words.
#[allow(
    clippy::disallowed_methods,
    reason = "a person wants to know from when it is; nothing is worked out from it"
)]
fn ago(when: SystemTime) -> Option<String> {
    Some(in_words(SystemTime::now().duration_since(when).ok()?))
}

fn in_words(ago: Duration) -> String {
    let seconds = ago.as_secs();
    match seconds {
        0..3600 => say!(one "{count} minute ago", "{count} minutes ago", count = seconds / 60),
        3600..86_400 => say!(one "{count} hour ago", "{count} hours ago", count = seconds / 3600),
        _ => say!(one "{count} day ago", "{count} days ago", count = seconds / 86_400),
    }
}

#[cfg(test)]
#[test]
fn a_time_is_said_in_words() {
    let says = |s| in_words(Duration::from_secs(s));
    assert_eq!(says(5), "0 minutes ago");
    assert_eq!(says(61), "1 minute ago");
    assert_eq!(says(7300), "2 hours ago");
    assert_eq!(says(200_000), "2 days ago");
}

/// A file to write to.
pub(super) fn path(
    ui: &mut Ui,
    workbench: &Workbench,
    what: What,
    (typed, allowed): (&mut String, &mut bool),
) {
    widgets::head(ui, 420.0, what.title());
    let edit = TextEdit::singleline(typed).desired_width(f32::INFINITY);
    let field = ui.named(say!("Path to save to"), edit);
    // The field is what the sheet is for: what is typed goes into it from the first letter on.
    if ui.memory(|memory| memory.focused().is_none()) && !field.lost_focus() {
        field.request_focus();
        widgets::select_all(ui, field.id, typed);
    }
    let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    let place = workbench.placed(typed.trim().as_ref());
    ui.hint(place.display().to_string());
    ui.checkbox(allowed, say!("replace the file if it exists"));
    let named = !typed.trim().is_empty();
    let pressed = widgets::ended(ui, workbench, (say!("Save"), named));
    if named && (pressed || entered || widgets::entered(ui)) {
        let (path, allowed) = (PathBuf::from(typed.trim()), *allowed);
        workbench.then(move |bench| bench.export_as(what, path, allowed));
    }
}
