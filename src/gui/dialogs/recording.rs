//! Recording from an instrument's software: where the lines come from, what they are, where they go.

use egui::{Id, RichText, TextEdit, Ui};

use crate::gui::core::recording::{Wanted, free_name};
use crate::gui::style::tokens::{Palette, size};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(520.0);
    widgets::heading(ui, say!("recording-record-from-instrument"));
    if let Some((wanted, heard)) = workbench.recording() {
        ui.label(heard.says());
        widgets::hint(
            ui,
            format!("{} → {}", wanted.address, wanted.path.display()),
        );
        if let Some(last) = &heard.last_refused {
            widgets::hint(ui, say!("recording-left-out-last", line = last));
        }
        if super::ends::buttons(ui, say!("recording-stop"), true, commands) {
            commands.push(Command::StopRecording);
            commands.push(Command::Sheet(None));
        }
        return;
    }
    let robot = &workbench.subject().session.robot;
    widgets::hint(
        ui,
        say!("recording-lines-of-text-become", robot = robot.name),
    );
    let id = Id::unique("recording");
    let blank = || Wanted {
        address: "tcp://".to_owned(),
        path: free_name(
            workbench
                .placed("x".as_ref())
                .parent()
                .unwrap_or("".as_ref()),
        ),
        ..Wanted::default()
    };
    let mut wanted: Wanted = ui.data(|data| data.get_temp(id)).unwrap_or_else(blank);
    let mut path = wanted.path.display().to_string();
    let fields = [
        (
            say!("recording-address"),
            &mut wanted.address,
            say!("recording-address-forms"),
        ),
        (
            say!("recording-columns"),
            &mut wanted.columns,
            say!("recording-empty-the-first-line"),
        ),
        (
            say!("recording-file"),
            &mut path,
            say!("recording-a-new-csv-table"),
        ),
    ];
    for (name, text, hint) in fields {
        widgets::form_row(ui, name, |ui| {
            let hint = RichText::new(hint).color(Palette::of(ui).muted);
            let field = TextEdit::singleline(text).hint_text(hint);
            let field = ui.add(field.char_limit(1000).desired_width(f32::INFINITY));
            let name = name.to_owned();
            widgets::label(&field, name);
        });
    }
    wanted.path = path.into();
    let placed = Wanted {
        path: workbench.placed(&wanted.path),
        ..wanted.clone()
    };
    let problem = placed.problem();
    let empty = matches!(wanted.address.trim(), "tcp://" | "udp://" | "");
    match &problem {
        Some(_) if empty => widgets::hint(ui, say!("recording-type-where-it-sends")),
        Some(problem) => widgets::wrong(ui, problem),
        None => {}
    }
    let small = RichText::new(say!("recording-columns-such-as"));
    ui.label(small.size(size::SMALL).color(Palette::of(ui).muted));
    ui.data_mut(|data| data.insert_temp(id, wanted));
    if super::ends::buttons_without_enter(ui, say!("recording-record"), problem.is_none(), commands)
    {
        ui.data_mut(|data| data.remove_temp::<Wanted>(id));
        commands.push(Command::Record(Box::new(placed)));
    }
}
