//! Recording from an instrument's software: where the lines come from, what they are, where they go.

use egui::{Id, RichText, TextEdit, Ui};

use crate::gui::file_state::recording::{RecordingRequest, free_name};
use crate::gui::style::tokens::{Palette, size};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Task, ViewChange, Workbench};

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(520.0);
    widgets::heading(ui, say!("Record from instrument"));
    if let Some((wanted, heard)) = workbench.recording() {
        ui.label(heard.describe());
        widgets::hint(
            ui,
            format!("{} → {}", wanted.address, wanted.path.display()),
        );
        if let Some(last) = heard.last_refused() {
            widgets::hint(ui, say!("Last excluded: {line}", line = last));
        }
        if super::ends::buttons(ui, say!("Stop recording"), true, commands) {
            commands.push(Command::Stop(Task::Recording));
            commands.push(Command::View(ViewChange::Sheet(None)));
        }
        return;
    }
    let robot = &workbench.loaded_session().session.robot;
    widgets::hint(
        ui,
        say!(
            "Lines of text, one for each measurement, become samples of a new session of {robot}; a connection that ends is made again",
            robot = robot.name
        ),
    );
    let id = Id::unique("recording");
    let blank = || RecordingRequest {
        address: "tcp://".to_owned(),
        path: free_name(
            workbench
                .placed("x".as_ref())
                .parent()
                .unwrap_or("".as_ref()),
        ),
        ..RecordingRequest::default()
    };
    let mut wanted: RecordingRequest = ui.data(|data| data.get_temp(id)).unwrap_or_else(blank);
    let mut path = wanted.path.display().to_string();
    let fields = [
        (
            say!("Address"),
            &mut wanted.address,
            say!("tcp://HOST:PORT or udp://:PORT"),
        ),
        (
            say!("Columns"),
            &mut wanted.columns,
            say!("empty: the first line names them"),
        ),
        (say!("File"), &mut path, say!("a new CSV table")),
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
    let placed = RecordingRequest {
        path: workbench.placed(&wanted.path),
        ..wanted.clone()
    };
    let problem = placed.problem();
    let empty = matches!(wanted.address.trim(), "tcp://" | "udp://" | "");
    match &problem {
        Some(_) if empty => widgets::hint(
            ui,
            say!("Type where the instrument's software sends, such as tcp://192.168.0.10:4000"),
        ),
        Some(problem) => widgets::wrong(ui, problem),
        None => {}
    }
    let small = RichText::new(say!(
        "Columns such as q1_deg, x_mm, y_mm, z_mm; between commas, semicolons, tabs or spaces"
    ));
    ui.label(small.size(size::SMALL).color(Palette::of(ui).muted));
    ui.data_mut(|data| data.insert_temp(id, wanted));
    if super::ends::buttons_without_enter(ui, say!("Record"), problem.is_none(), commands) {
        ui.data_mut(|data| data.remove_temp::<RecordingRequest>(id));
        commands.push(Command::Record(Box::new(placed)));
    }
}
