//! The targets of a table or a robot program, corrected: how many, by how much, which lines change, which
//! targets are left as they are and why.

use egui::{Button, DragValue, Label, RadioButton, RichText, ScrollArea, Ui, vec2};

use crate::explain::{self, Detail, Section, Topic};
use crate::gui::core::compensated::{Changed, CompensationRequest, MOST_KG};
use crate::gui::core::disk::name_of;
use crate::gui::files;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::What;
use crate::gui::views::blocks;
use crate::gui::widgets::{self, Does, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::programs::{DifferingNumber, ExternalAxes, Precedence};

/// Widest, points.
const WIDE: f32 = 860.0;
/// The share of the window's height that the targets, and the lines, have at most.
const HIGH: f32 = 0.3;
/// Height of everything else in the sheet, points: in a low window its buttons are in sight all the same.
const OTHER: f32 = 396.0;
/// Least height of the targets, and of the lines, points.
const LEAST: f32 = 90.0;
/// So many targets and remarks of a kind are listed; the sidecar has all of them.
const MOST_LEFT: usize = 30;

pub(super) fn compensation(ui: &mut Ui, workbench: &Workbench) {
    let Some(compensated) = workbench.compensated() else {
        return workbench.then(move |bench| bench.show_sheet(None));
    };
    let name = name_of(&compensated.wanted.path);
    widgets::head(ui, WIDE, say!("Compensate {name}", name));
    let differs: &[DifferingNumber] = match &compensated.result {
        Err(not_corrected) => &not_corrected.differs,
        Ok(_) => &[],
    };
    asked(ui, &compensated.wanted, differs, workbench);
    match &compensated.result {
        Err(not_corrected) => {
            for problem in not_corrected.problems.iter().take(MOST_LEFT) {
                ui.wrong(problem);
            }
        }
        Ok(corrected) => {
            ui.fact(say!("read as"), corrected.language);
            let detail = Detail::window(workbench.units());
            let orientation = workbench.loaded_session().session.robot.mobility() == 6;
            let says = explain::program(&corrected.answer, orientation, MOST_LEFT, detail);
            describe(ui, &says);
            lines(ui, &corrected.changed);
        }
    }
    // Where nothing was corrected what is asked above is answered, or another file is taken.
    let (next, ready) = match &compensated.result {
        Ok(corrected) => (
            widgets::dots(say!("Save corrected file")),
            corrected.summary.corrected > 0,
        ),
        Err(_) if differs.is_empty() => (widgets::dots(say!("Choose another file")), true),
        Err(_) => (widgets::dots(say!("Save corrected file")), false),
    };
    if widgets::ended(ui, workbench, (&next, ready)) {
        if compensated.result.is_err() {
            workbench.then(Workbench::choose_targets);
        } else {
            workbench.then(|bench| bench.choose_where_to_export(What::Targets));
        }
    }
}

/// The load where the file says none, as what a robot carries bends it, which frame is the base, and whose tool and
/// frame hold where the program's are not the model's.
fn asked(
    ui: &mut Ui,
    before: &CompensationRequest,
    differs: &[DifferingNumber],
    workbench: &Workbench,
) {
    let mut wanted = before.clone();
    let field = DragValue::new(&mut wanted.load_kg)
        .range(0.0..=MOST_KG)
        .speed(0.1)
        .suffix(" kg")
        .update_while_editing(false);
    ui.number(say!("load where the file says none"), "kg", field);
    let says = say!("the measuring frame is the robot's base");
    ui.checkbox(&mut wanted.measured_frame, says);
    if files::is_program(&wanted.path) {
        declarations(ui, &mut wanted, workbench);
    }
    let asks = |of, settled| differs.contains(&of) || settled;
    let holds = [
        (Precedence::Model, say!("the model's tool or base")),
        (Precedence::Program, say!("as the program writes it")),
    ];
    let open = Precedence::Unsettled;
    if asks(DifferingNumber::Tool, wanted.tool != open) {
        one_of(ui, say!("Tool of the program"), holds, &mut wanted.tool);
    }
    if asks(DifferingNumber::Frame, wanted.frame != open) {
        one_of(ui, say!("Frame of the program"), holds, &mut wanted.frame);
    }
    if asks(
        DifferingNumber::External,
        wanted.external != ExternalAxes::Asked,
    ) {
        let choices = [
            (ExternalAxes::CarryRobot, say!("carries the robot")),
            (ExternalAxes::Other, say!("moves something else")),
        ];
        one_of(ui, say!("External axis"), choices, &mut wanted.external);
    }
    ui.folded(say!("More"), |ui| {
        for (name, written, typed) in wanted.typed.fields() {
            ui.form_row(name, |ui| {
                let size = vec2(220.0, space::CONTROL);
                let says = format!("{name}: {written}");
                if let Some(text) = widgets::text_when_complete(ui, &says, typed, size) {
                    text.trim().clone_into(typed);
                }
                ui.caption(written);
            });
        }
    });
    if wanted != *before {
        workbench.then(move |bench| bench.compensate(wanted));
    }
}

/// Files of the controller that are read with a program.
fn declarations(ui: &mut Ui, wanted: &mut CompensationRequest, workbench: &Workbench) {
    ui.horizontal_wrapped(|ui| {
        let of = say!("Files of the controller");
        ui.label(of);
        let mut gone = None;
        for (k, path) in wanted.with.iter().enumerate() {
            let name = name_of(path);
            let shown = ui.label(RichText::new(&*name).font(strong(size::SMALL)));
            shown.on_hover_text(path.display().to_string());
            let without = ui.named(say!("Without {name}", name), Button::new("×").small());
            gone = gone.or(without.clicked().then_some(k));
        }
        let choose = Button::new(say!("Choose…"));
        let choose = ui.named(format!("{}: {of}", say!("Choose…")), choose);
        let choose = choose.on_hover_text(say!(
            "What the program uses and does not declare itself: tools, frames, loads, points (a KUKA’s $config.dat, a RAPID module, a FANUC’s SYSFRAME.VA). They are read and not corrected"
        ));
        let before = wanted.clone();
        choose.does(workbench, |bench| bench.choose_declarations(before));
        if let Some(k) = gone {
            wanted.with.remove(k);
        }
    });
}

/// One of two, or neither yet.
fn one_of<T: PartialEq>(ui: &mut Ui, of: &str, choices: [(T, &str); 2], value: &mut T) {
    ui.horizontal_wrapped(|ui| {
        ui.label(of);
        for (choice, text) in choices {
            let name = format!("{of}: {text}");
            let radio = RadioButton::new(*value == choice, text);
            if ui.named(name, radio).clicked() {
                *value = choice;
            }
        }
    });
}

/// What there is to say of the targets: how many, how far off, which are left and why.
fn describe(ui: &mut Ui, sections: &[Section]) {
    ScrollArea::vertical()
        .id_salt("what became of the targets")
        .max_height(high(ui))
        .show(ui, |ui| {
            for section in sections {
                blocks::title(ui, section, None);
                if section.topic == Topic::LeftAsIs {
                    blocks::warned(ui, &section.blocks);
                } else {
                    blocks::show(ui, &section.blocks);
                }
                ui.add_space(space::TIGHT);
            }
        });
}

fn high(ui: &Ui) -> f32 {
    let window = ui.ctx().content_rect().height();
    (0.5 * (window - OTHER)).min(HIGH * window).max(LEAST)
}

/// What changes, each line before and after.
fn lines(ui: &mut Ui, changed: &[Changed]) {
    if changed.is_empty() {
        return;
    }
    ui.section(say!("Lines that change"));
    let palette = Palette::of(ui);
    let scroll = ScrollArea::both()
        .id_salt("lines that change")
        .max_height(high(ui))
        .auto_shrink([false, true]);
    let line = |ui: &mut Ui, row: usize| {
        let one = &changed[row / 2];
        let (sign, text, color) = if row.is_multiple_of(2) {
            ("−", &one.before, palette.muted)
        } else {
            ("+", &one.after, palette.text)
        };
        for text in [&format!("{:>5} {sign}", one.line), text] {
            let text = RichText::new(text).monospace().size(size::SMALL);
            ui.add(Label::new(text.color(color)).extend());
        }
    };
    ui.scope(|ui| {
        widgets::dense(ui);
        let high = ui.spacing().interact_size.y;
        scroll.show_rows(ui, high, 2 * changed.len(), |ui, rows| {
            for row in rows {
                ui.horizontal(|ui| line(ui, row));
            }
        });
    });
}
