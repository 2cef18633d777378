//! The left-hand side: the list of steps, the controls of the chosen one, and what to do next; and what
//! both sides of the window are pulled by.

use egui::text::{LayoutJob, TextFormat};
use egui::{Button, Panel, Response, Role, Stroke, Ui, UiBuilder, Vec2, WidgetInfo, vec2};

use crate::gui::style::Layout;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::Step;
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;

use super::{export, gap, regions, results, session};

type Show = fn(&mut Ui, &Workbench);
type State = fn(&Workbench) -> (String, bool);

/// A step of the work: its controls, the button at the foot; what it has to show for itself, and whether it is done.
fn of(step: Step) -> (Show, Show, State) {
    match step {
        Step::Session => (session::show, session::next, session::state),
        Step::Regions => (regions::show, regions::next, regions::state),
        Step::Identify => (results::controls, results::next, results::state),
        Step::Gap => (gap::show, gap::next, gap::state),
        Step::Export => (export::show, export::next, export::state),
    }
}

/// The button at the foot stands no lower than this below the top of its panel, points.
const HIGHEST: f32 = 960.0;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, room: Layout) {
    // On a high screen the button at the foot would be far from what it belongs to.
    let mut rect = ui.available_rect_before_wrap();
    rect.set_height(rect.height().min(HIGHEST));
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        all(ui, workbench, room);
    });
}

fn all(ui: &mut Ui, workbench: &Workbench, room: Layout) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let now = workbench.view.step;
    let (show, next, _) = of(now);
    for (index, step) in workbench.steps().iter().copied().enumerate() {
        let (_, _, state) = of(step);
        let (caption, done) = state(workbench);
        let selected = now == step;
        let row = step_row(
            ui,
            (index + 1, step.name()),
            (&caption, done),
            (selected, room.low),
        );
        row.does(workbench, move |bench| bench.view.step = step);
    }
    ui.spacing_mut().item_spacing.y = space::ROW;
    ui.add_space(space::ROW);
    ui.separator();
    let frame = egui::Frame::NONE.inner_margin(egui::Margin::ZERO);
    Panel::bottom("next")
        .resizable(false)
        .show_separator_line(false)
        .frame(frame)
        .show(ui, |ui| {
            ui.add_space(space::ROW);
            next(ui, workbench);
        });
    widgets::scroll(ui, ("controls", now.name()), |ui| {
        show(ui, workbench);
    });
}

/// A step in the list of steps: its number, its name, and what it has to show.
fn step_row(
    ui: &mut Ui,
    (number, name): (usize, &str),
    (caption, done): (&str, bool),
    (selected, low): (bool, bool),
) -> Response {
    /// Room for the badge, points.
    const BADGE: f32 = 34.0;
    let palette = Palette::of(ui);
    let color = if selected {
        palette.accent
    } else {
        palette.text
    };
    let wide = ui.available_width();
    let mut text = LayoutJob::default();
    text.wrap.max_width = wide - 2.0 * space::ROW;
    text.wrap.max_rows = if low { 1 } else { 2 };
    text.wrap.break_anywhere = true;
    let name_format = TextFormat::simple(strong(size::BODY), color);
    text.append(name, BADGE, name_format.clone());
    let small = TextFormat::simple(egui::FontId::proportional(size::SMALL), palette.muted);
    if low {
        text.append(caption, 12.0, small);
    } else {
        text.append("\n", 0.0, name_format);
        text.append(caption, BADGE, small);
    }
    let text = ui.painter().layout_job(text);
    let shortened = text.elided;
    let button = Button::selectable(selected, text).shortcut_text("");
    let high = if low { 30.0 } else { 44.0 };
    let response = ui.add(button.min_size(vec2(wide, high)));
    let enabled = ui.is_enabled();
    let says = format!("{number} {name}");
    response.widget_info(|| WidgetInfo::selected(Role::Tab, enabled, selected, &says));
    let centre = response.rect.left_center() + vec2(22.0, 0.0);
    badge(ui.painter(), palette, centre, (number, done, selected));
    if shortened {
        response.on_hover_text(caption)
    } else {
        response
    }
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
