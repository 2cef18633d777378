//! The few controls that egui does not have, in the window's own look.

use egui::{
    Align, Button, Color32, CornerRadius, DragValue, Frame, Layout, Margin, Response, RichText,
    Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::help::{self, Word};
use super::tokens::{Palette, size, space, strong};
use super::units::typed;

/// What a panel is about.
pub(crate) fn heading(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::HEADING)));
}

/// What the next group is about.
pub(crate) fn section(ui: &mut Ui, text: &str) {
    ui.add_space(space::ROW);
    let muted = Palette::of(ui).muted;
    ui.label(RichText::new(text).font(strong(size::SMALL)).color(muted));
}

/// What stands in the bar of a plot.
pub(crate) fn title(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::BODY)));
    ui.add_space(space::ROW);
}

/// A word beside a control of such a bar.
pub(crate) fn caption(ui: &mut Ui, text: &str) -> egui::Response {
    let muted = Palette::of(ui).muted;
    ui.label(RichText::new(text).size(size::SMALL).color(muted))
}

/// The sliders of the bars are finer than those of forms.
pub(crate) fn fine(ui: &mut Ui, width: f32) {
    ui.spacing_mut().slider_width = width;
    ui.spacing_mut().interact_size.y = 18.0;
}

/// A sentence that explains.
pub(crate) fn hint(ui: &mut Ui, text: impl Into<String>) {
    let muted = Palette::of(ui).muted;
    ui.add(egui::Label::new(RichText::new(text).size(size::SMALL + 0.5).color(muted)).wrap());
}

/// A sentence that explains, with a word in it that can be explained in turn.
pub(crate) fn hint_about(ui: &mut Ui, text: impl Into<String>, word: Word) {
    let muted = Palette::of(ui).muted;
    let text = RichText::new(text).size(size::SMALL + 0.5).color(muted);
    let response = ui.add(egui::Label::new(text).wrap());
    explained(response, word);
}

/// What is wrong with the field above.
pub(crate) fn wrong(ui: &mut Ui, text: &str) {
    let color = Palette::of(ui).outside;
    let text = RichText::new(text).size(size::SMALL + 0.5).color(color);
    ui.add(egui::Label::new(text).wrap());
}

/// The one thing to do next, as wide as the panel.
pub(crate) fn primary(ui: &mut Ui, text: &str) -> Response {
    let palette = Palette::of(ui);
    let label = RichText::new(text)
        .font(strong(size::BODY))
        .color(palette.on_accent);
    let button = Button::new(label).fill(palette.accent);
    ui.add_sized(vec2(ui.available_width(), 36.0), button)
}

/// Something else that can be done, as wide as the panel.
pub(crate) fn secondary(ui: &mut Ui, text: &str) -> Response {
    let palette = Palette::of(ui);
    let button = Button::new(text)
        .fill(palette.surface)
        .stroke(Stroke::new(1.0, palette.line));
    ui.add_sized(vec2(ui.available_width(), 32.0), button)
}

/// One of several, side by side. The one that was clicked.
pub(crate) fn segmented<T: Copy + PartialEq>(
    ui: &mut Ui,
    options: &[(T, &str)],
    current: T,
) -> Option<T> {
    let named = options.iter().map(|(value, name)| (*value, *name, *name));
    segmented_named(ui, &named.collect::<Vec<_>>(), current)
}

/// The same where a short name is shown and a longer one says what it means.
pub(crate) fn segmented_named<T: Copy + PartialEq>(
    ui: &mut Ui,
    options: &[(T, &str, &str)],
    current: T,
) -> Option<T> {
    let palette = Palette::of(ui);
    let mut chosen = None;
    let frame = Frame::NONE
        .fill(palette.inset)
        .corner_radius(CornerRadius::same(space::ROUND))
        .inner_margin(Margin::same(2));
    frame.show(ui, |ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        ui.horizontal(|ui| {
            // Where a row runs from right to left the first still stands at the left.
            let backwards = ui.layout().prefer_right_to_left();
            for k in 0..options.len() {
                let k = if backwards { options.len() - 1 - k } else { k };
                let (value, name, meant) = &options[k];
                let on = *value == current;
                let (text, fill) = if on {
                    (palette.accent, palette.surface)
                } else {
                    (palette.muted, Color32::TRANSPARENT)
                };
                let label = if on {
                    RichText::new(*name).font(strong(size::SMALL)).color(text)
                } else {
                    RichText::new(*name).size(size::SMALL).color(text)
                };
                let button = Button::new(label)
                    .fill(fill)
                    .corner_radius(CornerRadius::same(space::ROUND - 2))
                    .min_size(vec2(34.0, 22.0));
                let response = ui.add(button);
                let enabled = ui.is_enabled();
                response
                    .widget_info(|| WidgetInfo::selected(Role::RadioButton, enabled, on, meant));
                if response.clicked() && !on {
                    chosen = Some(*value);
                }
                if name != meant {
                    response.on_hover_text(*meant);
                }
            }
        });
    });
    chosen
}

/// A surface of its own.
pub(crate) fn card<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let palette = Palette::of(ui);
    let frame = Frame::NONE
        .fill(palette.surface)
        .stroke(Stroke::new(1.0, palette.line))
        .corner_radius(CornerRadius::same(space::ROUND + 2))
        .inner_margin(Margin::same(14));
    let shown = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        contents(ui)
    });
    shown.inner
}

/// How far a step has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Progress {
    /// Nothing to show for it yet.
    Open,
    /// Done.
    Done,
}

/// A step in the list of steps.
pub(crate) fn step_row(
    ui: &mut Ui,
    number: usize,
    name: &str,
    caption: &str,
    progress: Progress,
    selected: bool,
) -> Response {
    let palette = Palette::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 44.0), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| {
        WidgetInfo::selected(Role::Tab, enabled, selected, format!("{number} {name}"))
    });
    let painter = ui.painter();
    let round = CornerRadius::same(space::ROUND);
    if selected {
        painter.rect_filled(rect, round, palette.accent_soft);
    } else if response.hovered() {
        painter.rect_filled(rect, round, palette.inset);
    }
    if response.has_focus() {
        let stroke = Stroke::new(1.5, palette.accent);
        painter.rect_stroke(rect, round, stroke, StrokeKind::Inside);
    }
    let centre = pos2(rect.left() + 22.0, rect.center().y);
    let done = progress == Progress::Done;
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
        painter.text(
            centre,
            egui::Align2::CENTER_CENTER,
            number,
            strong(size::SMALL),
            text,
        );
    }
    let left = rect.left() + 44.0;
    let name_color = if selected {
        palette.accent
    } else {
        palette.text
    };
    painter.text(
        pos2(left, rect.center().y - 8.0),
        egui::Align2::LEFT_CENTER,
        name,
        strong(size::BODY),
        name_color,
    );
    painter.text(
        pos2(left, rect.center().y + 9.0),
        egui::Align2::LEFT_CENTER,
        caption,
        egui::FontId::proportional(size::SMALL),
        palette.muted,
    );
    response
}

/// A name and what it is, on one line.
pub(crate) fn fact(ui: &mut Ui, name: &str, value: impl Into<String>) {
    let palette = Palette::of(ui);
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = 16.0;
        ui.spacing_mut().item_spacing.y = 4.0;
        ui.horizontal(|ui| {
            let label = ui.label(RichText::new(name).color(palette.muted));
            if let Some(word) = help::about(name) {
                explained(label, word);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.add(egui::Label::new(value.into()).truncate());
            });
        });
    });
}

/// Says what a word means when the pointer rests on it.
pub(crate) fn explained(response: Response, word: Word) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(280.0);
        ui.label(RichText::new(word.name).font(strong(size::BODY)));
        ui.label(word.means);
    })
}

/// A question mark that says what a word means.
pub(crate) fn question(ui: &mut Ui, word: Word) {
    let palette = Palette::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::hover());
    let says = format!("what {} means", word.name.to_lowercase());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, says.clone()));
    let painter = ui.painter();
    painter.circle_stroke(rect.center(), 6.5, Stroke::new(1.0, palette.nominal));
    let font = egui::FontId::proportional(10.0);
    let centre = egui::Align2::CENTER_CENTER;
    painter.text(rect.center(), centre, "?", font, palette.muted);
    explained(response, word);
}

/// Rows of text stand close together; rows of controls need room.
pub(crate) fn dense(ui: &mut Ui) {
    ui.spacing_mut().interact_size.y = 16.0;
    ui.spacing_mut().item_spacing.y = 3.0;
}

/// What is said about what the pointer is on.
pub(crate) fn facts(ui: &mut Ui, (title, lines): &(String, Vec<(String, String)>)) {
    let palette = Palette::of(ui);
    ui.set_max_width(220.0);
    dense(ui);
    ui.label(RichText::new(title).font(strong(size::BODY)));
    egui::Grid::new("facts")
        .num_columns(2)
        .spacing([16.0, 2.0])
        .show(ui, |ui| {
            for (name, value) in lines {
                ui.label(RichText::new(name).size(size::SMALL).color(palette.muted));
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.label(RichText::new(value).size(size::SMALL));
                });
                ui.end_row();
            }
        });
}

/// A field that takes a number when it is complete, with a point or a comma.
fn typing(field: DragValue<'_>) -> DragValue<'_> {
    field.update_while_editing(false).custom_parser(typed)
}

/// A number with its name before it.
pub(crate) fn number(ui: &mut Ui, name: &str, field: DragValue<'_>) -> Response {
    let muted = Palette::of(ui).muted;
    let row = ui.horizontal(|ui| {
        let label = ui.label(RichText::new(name).color(muted));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_sized([96.0, space::CONTROL], typing(field))
                .labelled_by(label.id)
        })
        .inner
    });
    row.inner
}

/// A row of a form on a sheet: its name, as wide as all the others, and what is chosen.
pub(crate) fn form_row(ui: &mut Ui, name: &str, control: impl FnOnce(&mut Ui)) {
    const NAMES: f32 = 136.0;
    let muted = Palette::of(ui).muted;
    ui.horizontal(|ui| {
        let room = vec2(NAMES, space::CONTROL);
        ui.allocate_ui_with_layout(room, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(NAMES);
            ui.label(RichText::new(name).color(muted));
        });
        control(ui);
    });
}

/// A field for a number as a table has it: no wider than it must be.
pub(crate) fn cell_number(ui: &mut Ui, name: &str, width: f32, field: DragValue<'_>) -> Response {
    let response = ui.add_sized([width, 24.0], typing(field));
    let name = name.to_owned();
    ui.ctx()
        .accesskit_node_builder(response.id, |node| node.set_label(name));
    response
}

/// A curved arrow: back (undo) or forth (redo).
pub(crate) fn history_button(ui: &mut Ui, forth: bool, enabled: bool, says: &str) -> Response {
    let palette = Palette::of(ui);
    let sense = if enabled {
        Sense::click()
    } else {
        Sense::hover()
    };
    let (rect, response) = ui.allocate_exact_size(vec2(30.0, 28.0), sense);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, says));
    let painter = ui.painter();
    if enabled && (response.hovered() || response.has_focus()) {
        painter.rect_filled(rect, CornerRadius::same(space::ROUND), palette.inset);
    }
    let color = if enabled {
        palette.text
    } else {
        palette.nominal.gamma_multiply(0.6)
    };
    let flip = if forth { -1.0 } else { 1.0 };
    let at = |x: f32, y: f32| rect.center() + vec2(flip * x, y);
    let arc = (0..=14).map(|k| {
        let angle = std::f32::consts::PI * (1.0 - k as f32 / 14.0);
        at(5.0 * angle.cos(), 1.0 - 5.0 * angle.sin())
    });
    let mut line: Vec<_> = arc.collect();
    line.push(at(5.0, 5.0));
    painter.line(line, Stroke::new(1.6, color));
    let head = vec![at(-5.0, 5.0), at(-8.6, 0.2), at(-1.4, 0.2)];
    painter.add(egui::Shape::convex_polygon(head, color, Stroke::NONE));
    response.on_hover_text(says)
}

/// An arrow into a tray: saves what stands beside it.
pub(crate) fn save_button(ui: &mut Ui, name: &str) -> Response {
    let palette = Palette::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(24.0, 24.0), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    let painter = ui.painter();
    let lit = response.hovered() || response.has_focus();
    if lit {
        painter.rect_filled(rect, CornerRadius::same(space::ROUND), palette.inset);
    }
    let color = if lit { palette.text } else { palette.muted };
    let at = |x: f32, y: f32| rect.center() + vec2(x, y);
    let line = |points: Vec<egui::Pos2>| {
        painter.line(points, Stroke::new(1.5, color));
    };
    line(vec![at(0.0, -6.5), at(0.0, 2.0)]);
    line(vec![at(-3.5, -1.5), at(0.0, 2.0), at(3.5, -1.5)]);
    line(vec![
        at(-6.5, 2.5),
        at(-6.5, 6.0),
        at(6.5, 6.0),
        at(6.5, 2.5),
    ]);
    response.on_hover_text(name)
}

/// Two sheets: copies what stands beside it.
pub(crate) fn copy_button(ui: &mut Ui, name: &str) -> Response {
    let palette = Palette::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(24.0, 24.0), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    let painter = ui.painter();
    let lit = response.hovered() || response.has_focus();
    if lit {
        painter.rect_filled(rect, CornerRadius::same(space::ROUND), palette.inset);
    }
    let color = if lit { palette.text } else { palette.muted };
    let sheet = |x: f32, y: f32| {
        let corner = rect.center() + vec2(x, y);
        egui::Rect::from_min_size(corner, vec2(8.5, 9.5))
    };
    let stroke = Stroke::new(1.5, color);
    painter.rect_stroke(sheet(-2.0, -6.5), 1.5, stroke, StrokeKind::Middle);
    let ground = if lit { palette.inset } else { palette.surface };
    painter.rect(sheet(-6.5, -3.0), 1.5, ground, stroke, StrokeKind::Middle);
    response.on_hover_text(name)
}

/// Part of a whole as a bar: before above, after below.
pub(crate) fn share_bar(ui: &mut Ui, part: f32, color: Color32) {
    let palette = Palette::of(ui);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 6.0), Sense::hover());
    let painter = ui.painter();
    painter.rect_filled(rect, 3.0, palette.inset);
    let mut filled = rect;
    filled.set_width(rect.width() * part.clamp(0.0, 1.0));
    painter.rect_filled(filled, 3.0, color);
}
