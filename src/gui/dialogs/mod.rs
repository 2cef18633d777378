//! Sheets over the window.

mod ends;
mod import;
mod preferences;
mod recovery;
mod simulation;
pub(crate) mod unsaved;
mod words;

use std::path::PathBuf;

use egui::{Grid, Id, Key, Margin, Modal, RichText, ScrollArea, TextEdit, Ui};

use crate::gui::plots::gestures;
use crate::gui::style::tokens::{Palette, size, space, strong};
use crate::gui::view::{Sheet, What};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

use crate::gui::actions;

use ends::{buttons, done};

/// Room around what a sheet says, points: half as much again as in a panel, which has the
/// window's edge beside it.
const SHEET: i8 = space::PANEL + space::PANEL / 2;

/// Between a sheet and the window's edges, together, points.
const MARGIN: f32 = 12.0;

/// Shows the open sheet, if there is one.
pub(crate) fn show(ui: &Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let Some(sheet) = &workbench.view().sheet else {
        return;
    };
    let frame = egui::Frame::popup(ui.style()).inner_margin(Margin::same(SHEET));
    let modal = Modal::new(Id::unique("sheet"))
        .frame(frame)
        .backdrop_color(Palette::of(ui).veil);
    let shown = modal.show(ui.ctx(), |ui| {
        ui.spacing_mut().item_spacing.y = space::ROW;
        // On a small screen, or with large text, a sheet is higher than the window.
        let high = ui.ctx().content_rect().height() - 2.0 * f32::from(SHEET) - MARGIN;
        let scroll = ScrollArea::vertical()
            .max_height(high)
            .min_scrolled_height(high);
        scroll.show(ui, |ui| match sheet {
            Sheet::SavePath { path, replace } => {
                let says = "The samples are written beside it, as a CSV file of the same name";
                let typed = (path.as_str(), *replace);
                match path_form(ui, workbench, ("Save session", says), typed, commands) {
                    Typed::Done { path, replace } => {
                        commands.push(Command::SaveAs { path, replace });
                    }
                    Typed::Changed { path, replace } => {
                        commands.push(Command::Sheet(Some(Sheet::SavePath { path, replace })));
                    }
                    Typed::Same => {}
                }
            }
            Sheet::ExportPath {
                what,
                path,
                replace,
            } => export(ui, workbench, *what, (path, *replace), commands),
            Sheet::Simulate(form) => simulation::show(ui, form, commands),
            Sheet::Unsaved(then) => unsaved::show(ui, workbench, then, commands),
            Sheet::Overwrite(path) => unsaved::overwrite(ui, path, commands),
            Sheet::Recover => recovery::show(ui, workbench, commands),
            Sheet::Import(foreign) => import::show(ui, workbench, foreign, commands),
            Sheet::Preferences => preferences::show(ui, workbench, commands),
            Sheet::Words => words::show(ui, commands),
            Sheet::Shortcuts => keys(ui, commands),
            Sheet::About => about(ui, commands),
        });
    });
    if shown.should_close() {
        commands.push(Command::Sheet(None));
    }
}

/// What was done with a path that is being typed.
enum Typed {
    /// It is complete.
    Done {
        path: PathBuf,
        replace: bool,
    },
    /// It is another now.
    Changed {
        path: String,
        replace: bool,
    },
    Same,
}

fn path_form(
    ui: &mut Ui,
    workbench: &Workbench,
    (title, says): (&str, &str),
    (path, replace): (&str, bool),
    commands: &mut Vec<Command>,
) -> Typed {
    ui.set_width(420.0);
    widgets::heading(ui, title);
    let (mut typed, mut allowed) = (path.to_owned(), replace);
    let field = ui.add(TextEdit::singleline(&mut typed).desired_width(f32::INFINITY));
    ui.ctx()
        .accesskit_node_builder(field.id, |node| node.set_label("Path to save to"));
    let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    let place = workbench.placed(typed.trim().as_ref());
    if let (Some(folder), Some(name)) = (place.parent(), place.file_name()) {
        let (folder, name) = (folder.display(), name.to_string_lossy());
        widgets::hint(ui, format!("{name}, in the folder {folder}"));
    }
    ui.checkbox(&mut allowed, "replace the file if it exists");
    widgets::hint(ui, says);
    let named = !typed.trim().is_empty();
    let pressed = buttons(ui, "Save", named, commands);
    if named && (pressed || entered) {
        Typed::Done {
            path: typed.trim().into(),
            replace: allowed,
        }
    } else if typed != path || allowed != replace {
        Typed::Changed {
            path: typed,
            replace: allowed,
        }
    } else {
        Typed::Same
    }
}

fn export(
    ui: &mut Ui,
    workbench: &Workbench,
    what: What,
    typed: (&str, bool),
    commands: &mut Vec<Command>,
) {
    let (title, says) = match what {
        What::Table => (
            "Save table",
            "A file that says what the table means is written beside it",
        ),
        What::Model => ("Save model", "The model can be exported and verified later"),
        What::Poses => (
            "Save measuring list",
            "A CSV table with the session's column names, to be measured next",
        ),
        What::Report(_) => (
            "Save report",
            "A name that ends in .html or .pdf; a session that was not searched yet is searched first",
        ),
        What::Picture(_) => ("Save picture", "A name that ends in .svg"),
    };
    match path_form(ui, workbench, (title, says), typed, commands) {
        Typed::Done { path, replace } => commands.push(Command::ExportTo {
            what,
            path,
            replace,
        }),
        Typed::Changed { path, replace } => {
            commands.push(Command::Sheet(Some(Sheet::ExportPath {
                what,
                path,
                replace,
            })));
        }
        Typed::Same => {}
    }
}

fn keys(ui: &mut Ui, commands: &mut Vec<Command>) {
    ui.set_width(600.0);
    widgets::heading(ui, "Keyboard and mouse");
    let others: [(&str, &str); 6] = [
        ("← →", "move the boundary that has the focus"),
        ("Shift+← →", "move it further"),
        ("Tab, Shift+Tab", "next control, the one before"),
        ("Space or Enter", "press it"),
        ("Ctrl++, Ctrl+−, Ctrl+0", "larger, smaller, usual text"),
        ("Esc", "close a sheet"),
    ];
    let all = actions::ALL.iter().map(|action| action.help(ui.ctx()));
    let others = others.map(|(keys, what)| (keys.to_owned(), what));
    let all: Vec<_> = all.chain(others).collect();
    let rows = all.len().div_ceil(2);
    ui.columns(2, |columns| {
        for (column, part) in columns.iter_mut().zip(all.chunks(rows)) {
            key_rows(column, part);
        }
    });
    ui.add_space(space::ROW);
    ui.label(RichText::new("The mouse, in the plots").font(strong(size::BODY)));
    let mouse = gestures::GESTURES.map(|(how, what)| (how.to_owned(), what));
    key_rows(ui, &mouse);
    done(ui, commands);
}

fn key_rows(ui: &mut Ui, rows: &[(String, &str)]) {
    let muted = Palette::of(ui).muted;
    widgets::dense(ui);
    Grid::new(("shortcuts", rows.len(), rows.first().map(|(keys, _)| keys)))
        .num_columns(2)
        .spacing([16.0, 6.0])
        .show(ui, |ui| {
            for (keys, what) in rows {
                ui.label(RichText::new(keys).color(muted));
                ui.label(*what);
                ui.end_row();
            }
        });
}

fn about(ui: &mut Ui, commands: &mut Vec<Command>) {
    ui.set_width(400.0);
    widgets::heading(ui, "truepose");
    widgets::hint(ui, concat!("version ", env!("CARGO_PKG_VERSION")));
    ui.label(
        "Calibrates a robot at commissioning: finds where measurement and simulation disagree, \
         and writes what the controller needs",
    );
    widgets::hint(
        ui,
        "Everything in this window can be done in the terminal too: truepose --help",
    );
    widgets::hint(
        ui,
        "Type: Inter, by the Inter project authors, SIL Open Font License 1.1",
    );
    done(ui, commands);
}
