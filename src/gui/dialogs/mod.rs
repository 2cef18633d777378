//! Sheets over the window.

use egui::style::NumberFormatter;
use egui::{Align2, Context, Frame, Id, LayerId, Margin, Modal, Popup, ScrollArea, Ui, vec2};

use crate::gui::charts::CHARTS;
use crate::gui::help;
use crate::gui::style::{Palette, space};
use crate::gui::view::Sheet;
use crate::gui::widgets::{self, Buttons, Does, Words};
use crate::gui::workbench::Workbench;

mod compensation;
mod import;
mod preferences;
mod record;
mod robots;
mod setup;
mod unsaved;

/// Where a sheet's head is, in parts of the window's height.
const HEAD: f32 = 0.09;
/// Width of what is said while a dialog of the system is open, points.
const ASKING: f32 = 300.0;

/// Shows the open sheet, if there is one.
pub(crate) fn show(ui: &Ui, workbench: &mut Workbench) {
    // It changes what is its own; all else is left in the workbench to be done.
    let Some(mut sheet) = workbench.view.sheet.take() else {
        return;
    };
    let before = sheet.clone();
    shown(ui, workbench, &mut sheet);
    if sheet != before {
        workbench.then(Workbench::keep_looking);
    }
    workbench.view.sheet = Some(sheet);
}

fn shown(ui: &Ui, workbench: &Workbench, sheet: &mut Sheet) {
    // By its head: a sheet that becomes longer or shorter while it is filled in does not move.
    let id = Id::unique("sheet");
    let below = HEAD * ui.ctx().content_rect().height();
    let area = Modal::default_area(id).anchor(Align2::CENTER_TOP, vec2(0.0, below));
    let shown = veiled(ui, id).area(area).show(ui.ctx(), |ui| {
        ui.spacing_mut().item_spacing.y = space::ROW;
        as_short_as_they_are(ui);
        // On a small screen, or with large text, a sheet is higher than the window, and its rows are wider.
        let room = widgets::room_of_a_sheet(ui);
        let scroll = ScrollArea::both()
            .max_width(room.x)
            .max_height(room.y)
            .min_scrolled_width(room.x)
            .min_scrolled_height(room.y);
        scroll.show(ui, |ui| {
            match sheet {
                Sheet::Path {
                    what,
                    path,
                    replace,
                } => unsaved::path(ui, workbench, *what, (path, replace)),
                Sheet::Simulate(form) => robots::simulation(ui, form, workbench),
                Sheet::Setup { form, .. } => setup::show(ui, form, workbench),
                Sheet::Discard(typed) => unsaved::typed(ui, typed, workbench),
                Sheet::Unsaved(then) => unsaved::losses(ui, workbench, then),
                Sheet::Overwrite(path) => unsaved::overwrite(ui, path, workbench),
                Sheet::Import(foreign) => import::show(ui, workbench, foreign),
                Sheet::About => about(ui, workbench),
                Sheet::Compensation => compensation::compensation(ui, workbench),
                Sheet::Details => record::details(ui, workbench),
                Sheet::Preferences => {
                    preferences::preferences(ui, workbench);
                    done(ui, workbench);
                }
                Sheet::Recovery => unsaved::recovery(ui, workbench),
                Sheet::Robots => robots::robots(ui, workbench),
                Sheet::Words => words(ui, workbench),
            }
            widgets::focus_in_sight(ui);
        });
    });
    lists_above(ui.ctx(), shown.response.layer_id);
    let beside = shown.backdrop_response.clicked() && sheet.holds_entries();
    let field = sheet.is_a_form() && widgets::was_typed_into(ui.ctx());
    if shown.should_close() && !beside && !field {
        let escaped = sheet.escaped();
        workbench.then(|bench| bench.show_sheet(escaped));
    }
}

/// Over the window, which is veiled behind it.
fn veiled(ui: &Ui, id: Id) -> Modal {
    let frame = Frame::popup(ui.style()).inner_margin(Margin::same(space::SHEET));
    let modal = Modal::new(id).frame(frame);
    modal.backdrop_color(Palette::of(ui).veil)
}

/// The button at the end of a sheet that only says something.
fn done(ui: &mut Ui, workbench: &Workbench) {
    if ui.foot([(say!("Done"), true)]).is_some() || widgets::entered(ui) {
        workbench.then(|bench| bench.show_sheet(None));
    }
}

/// While a dialog of the system is open the window takes no commands: what it asks for is for what is open now. It is
/// said, as on some systems the dialog may lie behind the window.
pub(crate) fn asking(ui: &Ui, workbench: &Workbench) {
    let Some(asking) = workbench.asking() else {
        return;
    };
    veiled(ui, Id::unique("dialog of the system")).show(ui.ctx(), |ui| {
        widgets::wide(ui, ASKING);
        ui.spacing_mut().item_spacing.y = space::ROW;
        ui.bold(&asking.what);
        ui.hint(say!("The window goes on once the dialog is answered"));
        ui.secondary(say!("Go on without it"))
            .does(workbench, Workbench::stop_asking);
    });
}

/// Numbers in fields without the zeros that a field has for its finest step: `30°`, not `30.00°`.
fn as_short_as_they_are(ui: &mut Ui) {
    let usual = ui.style().number_formatter.clone();
    ui.style_mut().number_formatter =
        NumberFormatter::new(move |value, decimals| usual.format(value, 0..=*decimals.end()));
}

/// A list that is opened in a sheet is above it. The click that opens it brings the sheet to the top, and a list
/// that was there before, when the sheet was last open, would stay below it.
fn lists_above(ctx: &Context, sheet: LayerId) {
    if !Popup::is_any_open(ctx) {
        return;
    }
    for layer in ctx.memory(|memory| memory.areas().visible_layer_ids()) {
        if layer.order == sheet.order && layer != sheet {
            ctx.set_sublayer(sheet, layer);
        }
    }
}

// What this program is, what can be done in it by keys and mouse, and what the words mean.

fn about(ui: &mut Ui, workbench: &Workbench) {
    widgets::head(ui, 400.0, "truepose");
    ui.hint(say!(
        "version {version}",
        version = env!("CARGO_PKG_VERSION")
    ));
    ui.label(say!("Calibrates a robot at commissioning: finds where measurement and simulation disagree, and writes what the controller needs"));
    ui.hint(say!(
        "Everything in this window can be done in the terminal too: truepose --help"
    ));
    done(ui, workbench);
}

/// Height of what stands around the list, points.
const REST: f32 = 240.0;

/// What the words mean, all of them.
fn words(ui: &mut Ui, workbench: &Workbench) {
    widgets::head(ui, 520.0, say!("Glossary"));
    let high = (ui.ctx().content_rect().height() - REST).clamp(120.0, 460.0);
    ScrollArea::vertical().max_height(high).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 3.0;
        let charts = CHARTS.iter().map(|chart| chart.word);
        let charts = charts.filter(|word| !help::ALL.contains(word));
        for word in help::ALL.iter().copied().chain(charts) {
            ui.bold(word.name());
            ui.label(word.means());
            ui.add_space(space::ROW);
        }
    });
    done(ui, workbench);
}
