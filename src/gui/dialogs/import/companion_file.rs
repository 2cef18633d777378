//! Files beside the measured one, and the field in which the path of one is typed: commands, points that are known
//! in the base frame, reflectors.

use crate::gui::workbench::Workbench;
use std::path::{Path, PathBuf};

use egui::{DragValue, Grid, RichText, TextEdit, Ui};

use crate::importers::{Alignment, Matching};
use crate::language;
use crate::sessions::Target;
use crate::text::length;

use crate::gui::core::disk::name_of;
use crate::gui::import_draft::{Companion, ImportAnswers, ImportDraft};
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::widgets;

/// Where the robot was sent.
pub(super) fn commanded(
    ui: &mut Ui,
    now: &ImportDraft,
    next: &mut ImportAnswers,
    workbench: &Workbench,
) {
    let title = say!("Commanded positions, if the table does not have them");
    let field = (
        say!("File of the commands"),
        say!("a table with q1_deg, … and perhaps name, time_s, dir1, load_kg"),
    );
    widgets::section(ui, title);
    let which = (Companion::Commands, now);
    path(ui, field, &mut next.commands, which, workbench);
    if next.commands.trim().is_empty() {
        return;
    }
    let ways = [
        (Some(Matching::Order), say!("by order")),
        (Some(Matching::Name), say!("by name")),
        (Some(Matching::Time), say!("by time")),
    ];
    // By default as the import has found it, once it could be tried.
    let tried = now.trial().and_then(|trial| trial.matched.as_ref());
    let found = tried.map(|matched| matched.by);
    let matching = next.matching.or(found);
    widgets::form_row(ui, say!("Matched"), |ui| {
        if let Some(chosen) = widgets::segmented(ui, &ways, matching) {
            next.matching = chosen;
        }
    });
    if next.matching != Some(Matching::Time) {
        return;
    }
    let trial = now.trial();
    let clock = trial.and_then(|t| t.matched.as_ref()?.clock);
    widgets::form_row(ui, say!("Clocks apart by"), |ui| {
        let found = next.clock_offset_s.is_none();
        let ways = [
            (true, say!("found from the motion")),
            (false, say!("typed")),
        ];
        if let Some(found) = widgets::segmented(ui, &ways, found) {
            next.clock_offset_s = (!found).then(|| clock.map_or(0.0, |clock| clock.offset_s));
        }
        if let Some(offset) = &mut next.clock_offset_s {
            let field = DragValue::new(offset)
                .speed(0.01)
                .max_decimals(6)
                .suffix(" s");
            widgets::cell_number(
                ui,
                say!("Seconds to add to a measured time"),
                "s",
                110.0,
                field,
            );
        }
    });
    if let Some(clock) = clock {
        let says = match clock.sigma_s {
            Some(sigma) => say!(
                "The measured clock needs {offset_s} s to agree with the commands, ± {sigma} s (95 %); {rms} are left",
                offset_s = format!("{:+.4}", clock.offset_s),
                sigma = format!("{:.4}", 1.96 * sigma),
                rms = language::spoken(length(clock.rms_mm, 3))
            ),
            None => say!(
                "With {offset_s} s added, {rms} are left between path and measurements",
                offset_s = format!("{:+.4}", clock.offset_s),
                rms = language::spoken(length(clock.rms_mm, 3))
            ),
        };
        widgets::hint(ui, says);
    }
}

/// Whether the rows say from where each joint came.
pub(super) fn order_of_rows(ui: &mut Ui, next: &mut ImportAnswers) {
    if next.matching != Some(Matching::Time) {
        ui.checkbox(
            &mut next.in_measuring_order,
            say!("the rows are in the order in which they were measured"),
        )
        .on_hover_text(say!(
            "The side from which each joint came follows from the row before, so that backlash can be tested"
        ));
    }
}

/// Points that bring the instrument's frame into the base frame.
pub(super) fn base_frame(
    ui: &mut Ui,
    now: &ImportDraft,
    next: &mut ImportAnswers,
    workbench: &Workbench,
) {
    let title = say!("Reference points (base frame), if the instrument has a frame of its own");
    let field = (
        say!("File of the known points"),
        say!("a table with name, x_mm, y_mm, z_mm; the same names as in the measured file"),
    );
    widgets::section(ui, title);
    let which = (Companion::Reference, now);
    path(ui, field, &mut next.reference, which, workbench);
    if next.reference.trim().is_empty() {
        return;
    }
    ui.checkbox(&mut next.scale, say!("fit a scale too"));
    let trial = now.trial();
    if let Some(alignment) = trial.and_then(|trial| trial.alignment.as_ref()) {
        residuals(ui, alignment);
    }
}

/// How far each point is off after the alignment.
fn residuals(ui: &mut Ui, alignment: &Alignment) {
    let palette = Palette::of(ui);
    let left_out = alignment.outliers().count();
    let used = alignment.residuals.len() - left_out;
    let rms = language::spoken(length(alignment.rms_mm, 4));
    let says = if left_out > 0 {
        say!(
            "{used} points fit with {rms} (root mean square), {left_out} excluded: measured or surveyed wrongly, or moved since",
            used,
            rms,
            left_out
        )
    } else {
        say!("{used} points fit with {rms} (root mean square)", used, rms)
    };
    widgets::hint(ui, says);
    if (alignment.scale - 1.0).abs() > 0.0 {
        let ppm = 1e6 * (alignment.scale - 1.0);
        widgets::hint(
            ui,
            say!(
                "scaled by {scale} ({ppm} ppm)",
                scale = format!("{:.6}", alignment.scale),
                ppm = format!("{ppm:+.1}")
            ),
        );
    }
    ui.scope(|ui| {
        widgets::dense(ui);
        let grid = Grid::new("residuals of the alignment").striped(true);
        grid.spacing([18.0, 2.0]).show(ui, |ui| {
            for heading in [
                say!("point"),
                say!("residual, mm"),
                say!("in x"),
                say!("in y"),
                say!("in z"),
                "",
            ] {
                ui.label(RichText::new(heading).font(strong(size::SMALL)));
            }
            ui.end_row();
            for residual in alignment.residuals.iter().take(60) {
                let color = if residual.is_outlier {
                    palette.outside
                } else {
                    palette.text
                };
                let v = residual.vector_mm;
                let cell = |text: String| RichText::new(text).size(size::SMALL).color(color);
                ui.label(cell(residual.name.clone()));
                ui.label(cell(format!("{:.4}", v.norm())));
                for part in [v.x, v.y, v.z] {
                    ui.label(cell(format!("{part:+.4}")));
                }
                let word = if residual.is_outlier {
                    say!("excluded")
                } else {
                    ""
                };
                ui.label(cell(word.to_owned()));
                ui.end_row();
            }
        });
    });
}

/// Where the reflectors sit.
pub(super) fn reflectors(
    ui: &mut Ui,
    open: &[Target],
    now: &ImportDraft,
    next: &mut ImportAnswers,
    workbench: &Workbench,
) {
    let title = say!("Reflectors in the tool frame, if there are several");
    let field = (
        say!("File of the reflectors"),
        say!("a table with name, x_mm, y_mm, z_mm; without it one sits at the tool's origin"),
    );
    widgets::section(ui, title);
    let which = (Companion::Targets, now);
    path(ui, field, &mut next.targets, which, workbench);
    if open.len() > 1 && next.targets.trim().is_empty() {
        let names: Vec<&str> = open.iter().map(|target| &*target.name).collect();
        let text = say!(
            "those of the open session: {names}",
            names = names.join(", ")
        );
        let mut taken = next.own_targets.is_some();
        if ui.checkbox(&mut taken, text).changed() {
            next.own_targets = taken.then(|| open.to_vec());
        }
    } else {
        next.own_targets = None;
    }
}

/// A field for the path of a file, with a button that asks for it.
pub(super) fn path(
    ui: &mut Ui,
    (label, hint): (&str, &str),
    typed: &mut String,
    (which, now): (Companion, &ImportDraft),
    workbench: &Workbench,
) -> bool {
    let mut changed = false;
    ui.horizontal(|ui| {
        let text = egui::WidgetText::from(say!("Choose…"));
        let text = text.into_galley(ui, None, f32::INFINITY, egui::TextStyle::Button);
        let button = text.size().x + 2.0 * ui.spacing().button_padding.x;
        let room = ui.available_width() - button - ui.spacing().item_spacing.x;
        let field = TextEdit::singleline(typed).hint_text(hint);
        let field = ui.add_sized([room.max(80.0), space::CONTROL], field);
        widgets::label(&field, label);
        changed = field.changed();
        let button = ui.button(say!("Choose…"));
        widgets::label(&button, say!("Choose: {label}", label));
        if button.clicked() {
            workbench.then(move |bench| bench.choose_beside(which));
        }
    });
    if !typed.trim().is_empty() {
        let is_this = |(of, path): &&(Companion, PathBuf)| {
            *of == which && path.as_path() == Path::new(typed.as_str())
        };
        if now.taken.iter().any(|one| is_this(&one)) {
            let says = say!("Taken because its name is that of the file");
            widgets::hint(ui, says);
        }
        return changed;
    }
    ui.horizontal_wrapped(|ui| {
        for path in now.neighbours.suiting(which) {
            let file = name_of(path);
            let text = say!("Use {file} from the same folder", file);
            let link = ui.link(RichText::new(text).size(size::SMALL));
            widgets::label(&link, say!("Use {file}: {label}", file, label));
            if link.clicked() {
                *typed = path.display().to_string();
                changed = true;
            }
        }
    });
    changed
}
