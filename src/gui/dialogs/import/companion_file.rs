//! Files beside the measured one: commands, points that are known in the base frame, reflectors.

use egui::{DragValue, Grid, RichText, Ui};

use crate::gui::import_draft::{Beside, Foreign, Said};
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::widgets;
use crate::gui::workbench::Command;
use crate::importers::{Alignment, Matching, Motion};

/// Where the robot was sent.
pub(super) fn commanded(ui: &mut Ui, now: &Foreign, next: &mut Said, commands: &mut Vec<Command>) {
    widgets::section(ui, say!("import-where-the-robot-was-sent"));
    let field = (
        say!("import-file-of-the-commands"),
        say!("import-a-table-with-q1-deg"),
    );
    let which = (Beside::Commands, now);
    super::parts::path(ui, field, &mut next.commands, which, commands);
    if next.commands.trim().is_empty() {
        return;
    }
    let ways = [
        (Matching::Order, say!("import-by-order")),
        (Matching::Name, say!("import-by-name")),
        (Matching::Time, say!("import-by-time")),
    ];
    widgets::form_row(ui, say!("import-matched"), |ui| {
        if let Some(matching) = widgets::segmented(ui, &ways, next.matching) {
            next.matching = matching;
        }
    });
    if next.matching != Matching::Time {
        return;
    }
    let kinds = [
        (Motion::Auto, say!("import-as-it-suits")),
        (Motion::Stops, say!("import-the-mean-of-each-stop")),
        (Motion::All, say!("import-all")),
    ];
    widgets::form_row(ui, say!("import-samples-are"), |ui| {
        if let Some(motion) = widgets::segmented(ui, &kinds, next.motion) {
            next.motion = motion;
        }
    });
    let trial = now.trial();
    let clock = trial.and_then(|t| t.matched.as_ref()?.clock);
    widgets::form_row(ui, say!("import-clocks-apart"), |ui| {
        let found = next.clock_offset_s.is_none();
        let ways = [
            (true, say!("import-found-from-the-motion")),
            (false, say!("import-typed")),
        ];
        if let Some(found) = widgets::segmented(ui, &ways, found) {
            next.clock_offset_s = (!found).then(|| clock.map_or(0.0, |clock| clock.offset_s));
        }
        if let Some(offset) = &mut next.clock_offset_s {
            let field = DragValue::new(offset)
                .speed(0.01)
                .max_decimals(6)
                .suffix(" s");
            widgets::cell_number(ui, say!("import-seconds-to-add"), "s", 110.0, field);
        }
    });
    if let Some(clock) = clock {
        let says = match clock.sigma_s {
            Some(sigma) => say!(
                "import-the-measured-clock-needs-s",
                offset_s = format!("{:+.4}", clock.offset_s),
                sigma = format!("{:.4}", 1.96 * sigma),
                rms = format!("{:.3}", clock.rms_mm)
            ),
            None => say!(
                "import-with-s-added-mm-are",
                offset_s = format!("{:+.4}", clock.offset_s),
                rms = format!("{:.3}", clock.rms_mm)
            ),
        };
        widgets::hint(ui, says);
    }
}

/// Points that bring the instrument's frame into the base frame.
pub(super) fn base_frame(ui: &mut Ui, now: &Foreign, next: &mut Said, commands: &mut Vec<Command>) {
    widgets::section(ui, say!("import-points-known-in-the-base"));
    let field = (
        say!("import-file-of-the-known-points"),
        say!("import-a-table-with-name-x"),
    );
    let which = (Beside::Reference, now);
    super::parts::path(ui, field, &mut next.reference, which, commands);
    if next.reference.trim().is_empty() {
        return;
    }
    ui.checkbox(&mut next.scale, say!("import-fit-a-scale-too"));
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
    let mut says = say!(
        "import-points-fit-with-mm-root",
        used = used,
        rms = format!("{:.4}", alignment.rms_mm)
    );
    if left_out > 0 {
        says += &say!(
            "import-excluded-measured-or-surveyed-wrongly",
            left_out = left_out
        );
    }
    widgets::hint(ui, says);
    if (alignment.scale - 1.0).abs() > 0.0 {
        let ppm = 1e6 * (alignment.scale - 1.0);
        widgets::hint(
            ui,
            say!(
                "import-scaled-by-ppm",
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
                say!("import-point"),
                say!("import-off-by-mm"),
                say!("import-in-x"),
                say!("import-in-y"),
                say!("import-in-z"),
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
                    say!("common-excluded")
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
pub(super) fn reflectors(ui: &mut Ui, now: &Foreign, next: &mut Said, commands: &mut Vec<Command>) {
    widgets::section(ui, say!("import-reflectors-in-the-tool-frame"));
    let field = (
        say!("import-file-of-the-reflectors"),
        say!("import-a-table-with-name-x-mm"),
    );
    let which = (Beside::Targets, now);
    super::parts::path(ui, field, &mut next.targets, which, commands);
}
