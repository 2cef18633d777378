//! What windows that are gone have left behind: what, from when, and whether to bring it back.

use std::fmt::Debug;
use std::hash::Hash;
use std::path::Path;
use std::time::{Duration, SystemTime};

use egui::{Id, RichText, ScrollArea, Ui};

use crate::gui::style::tokens::{size, space, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Command, LeftBehind, ViewChange, Workbench};

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(460.0);
    widgets::heading(ui, say!("Recover unsaved work"));
    widgets::hint(
        ui,
        say!(
            "The last time the program ended without warning. Nothing is lost unless it is discarded here: what is not restored now is offered again"
        ),
    );
    ScrollArea::vertical().max_height(360.0).show(ui, |ui| {
        for (index, left) in workbench.orphaned().iter().enumerate() {
            widgets::card(ui, |ui| {
                let title = match &left.kept {
                    Ok(kept) => kept.session.name.clone(),
                    Err(_) => say!("A file that is damaged").to_owned(),
                };
                ui.label(RichText::new(title).font(strong(size::BODY)));
                if let Some(ago) = left.when.and_then(ago) {
                    widgets::fact_of(ui, phrase!("last saved"), ago);
                }
                match &left.kept {
                    Ok(kept) => {
                        widgets::fact_of(
                            ui,
                            phrase!("samples"),
                            kept.session.samples.len().to_string(),
                        );
                        let file = kept.file.as_ref().and_then(|f| f.file_name());
                        let file = file.map_or(say!("no file").into(), |f| f.to_string_lossy());
                        widgets::fact_of(ui, phrase!("file"), file);
                    }
                    Err(because) => {
                        widgets::wrong(ui, because);
                        let name = left.path().file_name().unwrap_or_default();
                        widgets::hint(ui, name.to_string_lossy());
                    }
                }
                ui.add_space(space::TIGHT);
                ui.columns(2, |columns| {
                    let restore = if left.kept.is_ok() {
                        discard(&mut columns[0], index, left.path(), commands);
                        say!("Restore")
                    } else {
                        say!("Put it aside")
                    };
                    // The newest is first, and what is meant by most.
                    let button = if index == 0 {
                        widgets::primary(&mut columns[1], restore)
                    } else {
                        widgets::other(&mut columns[1], restore)
                    };
                    if button.clicked() {
                        commands.push(Command::Left(LeftBehind::Restore(index)));
                    }
                });
            });
        }
    });
    ui.columns(2, |columns| {
        discard_all(&mut columns[0], workbench.orphaned().len(), commands);
        if widgets::other(&mut columns[1], say!("Not now")).clicked() {
            commands.push(Command::View(ViewChange::Sheet(None)));
        }
    });
}

/// Discards one on the second press.
fn discard(ui: &mut Ui, index: usize, path: &Path, commands: &mut Vec<Command>) {
    if pressed_twice(ui, path, say!("Discard"), say!("Discard for good")) {
        commands.push(Command::Left(LeftBehind::Discard(index)));
    }
}

/// Discards everything on the second press.
fn discard_all(ui: &mut Ui, count: usize, commands: &mut Vec<Command>) {
    let sure = say!("Discard all {count} for good", count = count);
    if pressed_twice(ui, "all", say!("Discard all"), &sure) {
        commands.push(Command::Left(LeftBehind::DiscardAll));
    }
}

/// A button that asks in its own words, and acts on the second press: what is discarded cannot be brought back.
fn pressed_twice(ui: &mut Ui, what: impl Debug + Hash, asks: &str, sure: &str) -> bool {
    let id = Id::unique(("discard of the recovery", what));
    let is_sure = ui.data(|data| data.get_temp(id).unwrap_or(false));
    let clicked = widgets::other(ui, if is_sure { sure } else { asks }).clicked();
    if clicked {
        ui.data_mut(|data| data.insert_temp(id, !is_sure));
    }
    clicked && is_sure
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
        0..60 => say!("less than a minute ago").to_owned(),
        60..3600 => say!(one "{count} minute ago", "{count} minutes ago", count = seconds / 60),
        3600..86_400 => say!(one "{count} hour ago", "{count} hours ago", count = seconds / 3600),
        _ => say!(one "{count} day ago", "{count} days ago", count = seconds / 86_400),
    }
}

#[cfg(test)]
#[test]
fn a_time_is_said_in_words() {
    let says = |s| in_words(Duration::from_secs(s));
    assert_eq!(says(5), "less than a minute ago");
    assert_eq!(says(61), "1 minute ago");
    assert_eq!(says(7300), "2 hours ago");
    assert_eq!(says(200_000), "2 days ago");
}
