//! The sides of the window. At the left the list of steps, the controls of the chosen one, and what to do next; at the
//! right what it has found.

use egui::text::{LayoutJob, TextFormat};
use egui::{Button, Panel, Response, Role, Stroke, Ui, UiBuilder, Vec2, WidgetInfo, vec2};

use crate::gui::core::document::Method;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{Side, Step};
use crate::gui::widgets::{self, Buttons, Does, Forms};
use crate::gui::workbench::Workbench;
use crate::text::capital;

use super::{export, gap, regions, results, samples, session};

type Show = fn(&mut Ui, &Workbench);

/// A step of the work: its controls, and the button at the foot.
fn of(step: Step) -> (Show, Show) {
    match step {
        Step::Session => (session::show, session::next),
        Step::Regions => (regions::show, regions::next),
        Step::Identify => (results::controls, results::next),
        Step::Gap => (gap::show, gap::next),
        Step::Export => (export::show, export::next),
    }
}

/// Whether there is something to show for a step.
fn is_done(step: Step, workbench: &Workbench) -> bool {
    let document = workbench.document();
    match step {
        Step::Session => true,
        Step::Regions => document.identified && document.method == Method::Regional,
        Step::Identify => workbench.answer().is_some(),
        Step::Gap if workbench.searching().is_some() => false,
        Step::Gap => workbench.diagnosis().is_some() || document.in_the_model().next().is_some(),
        Step::Export => workbench.exported().next().is_some(),
    }
}

/// The button at the foot stands no lower than this below the top of its panel, points.
const HIGHEST: f32 = 960.0;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    // On a high screen the button at the foot would be far from what it belongs to.
    let mut rect = ui.available_rect_before_wrap();
    rect.set_height(rect.height().min(HIGHEST));
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        all(ui, workbench);
    });
}

fn all(ui: &mut Ui, workbench: &Workbench) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let now = workbench.view.step;
    let (show, next) = of(now);
    for (index, step) in workbench.steps().iter().copied().enumerate() {
        let done = is_done(step, workbench);
        let row = step_row(ui, (index + 1, step.name()), done, now == step);
        row.does(workbench, move |bench| bench.view.step = step);
    }
    ui.spacing_mut().item_spacing.y = space::ROW;
    ui.add_space(space::ROW);
    ui.separator();
    let frame = egui::Frame::NONE.inner_margin(egui::Margin::ZERO);
    let foot = Panel::bottom("next")
        .resizable(false)
        .show_separator_line(false)
        .frame(frame)
        .show(ui, |ui| {
            ui.add_space(space::ROW);
            next(ui, workbench);
        });
    widgets::settle(ui, foot.response.id, foot.response.rect);
    widgets::scroll(ui, ("controls", now.name()), |ui| {
        show(ui, workbench);
    });
}

/// A step in the list of steps: its number or a tick, and its name.
fn step_row(ui: &mut Ui, (number, name): (usize, &str), done: bool, selected: bool) -> Response {
    let palette = Palette::of(ui);
    let color = if selected {
        palette.accent
    } else {
        palette.text
    };
    let mut text = LayoutJob::default();
    text.append(name, 34.0, TextFormat::simple(strong(size::BODY), color));
    let text = ui.painter().layout_job(text);
    let button = Button::selectable(selected, text).shortcut_text("");
    let response = ui.add(button.min_size(vec2(ui.available_width(), 34.0)));
    let (enabled, says) = (ui.is_enabled(), format!("{number} {name}"));
    response.widget_info(|| WidgetInfo::selected(Role::Tab, enabled, selected, &says));
    let centre = response.rect.left_center() + vec2(22.0, 0.0);
    badge(ui.painter(), palette, centre, (number, done, selected));
    response
}

/// Its number, or a tick.
fn badge(
    painter: &egui::Painter,
    palette: Palette,
    centre: egui::Pos2,
    (number, done, selected): (usize, bool, bool),
) {
    let (fill, edge, text) = match (done, selected) {
        (true, _) => (palette.accent, palette.accent, palette.on_accent),
        (false, true) => (palette.surface, palette.accent, palette.accent),
        (false, false) => (palette.surface, palette.nominal, palette.muted),
    };
    painter.circle(centre, 11.0, fill, Stroke::new(1.5, edge));
    if done {
        let at = |x: f32, y: f32| centre + Vec2::new(x, y);
        let tick = vec![at(-4.5, 0.2), at(-1.3, 3.6), at(4.8, -3.6)];
        painter.line(tick, Stroke::new(2.0, text));
    } else {
        let middle = egui::Align2::CENTER_CENTER;
        painter.text(centre, middle, number, strong(size::SMALL), text);
    }
}

/// The right-hand side: what the step has found, or the samples.
pub(crate) fn results(ui: &mut Ui, workbench: &Workbench) {
    let side = workbench.view.side;
    if workbench.view.step == Step::Export {
        ui.heading(say!("Export"));
        ui.add_space(space::TIGHT);
        widgets::scroll(ui, "export", |ui| export::preview(ui, workbench));
        return;
    }
    if workbench.view.step == Step::Gap && side == Side::Results {
        return gap::findings(ui, workbench);
    }
    let sides = [
        (Side::Results, say!("Summary")),
        (Side::Samples, &capital(say!("samples"))),
    ];
    ui.row(|ui| {
        // Where there is no room for both, what is chosen says where one is.
        let title = say!("Results");
        let of_title = widgets::width_of(ui, title, strong(size::HEADING)) + space::ROW;
        if of_title + widgets::width_of_segments(ui, &sides) <= ui.available_width() {
            ui.heading(title);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if let Some(side) = ui.segmented(&sides, side) {
                workbench.then(move |bench| bench.view.side = side);
            }
        });
    });
    ui.add_space(space::TIGHT);
    match side {
        Side::Samples => samples::show(ui, workbench),
        Side::Results => {
            widgets::scroll(ui, "results", |ui| results::summary(ui, workbench));
        }
    }
}
