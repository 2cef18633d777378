//! The few controls that egui does not have, in the window's own look.

use egui::{
    Align, Button, Color32, CornerRadius, DragValue, Frame, Layout, Margin, Response, RichText,
    Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use super::help::{self, Word};
use super::tokens::{DARK, LIGHT, Palette, size, space, strong};
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
    sentence(ui, RichText::new(text).size(size::NOTE).color(muted));
}

/// Text whose lines are no longer than can be read.
fn sentence(ui: &mut Ui, text: RichText) -> Response {
    ui.scope(|ui| {
        ui.set_max_width(ui.available_width().min(space::LINE));
        ui.add(egui::Label::new(text).wrap())
    })
    .inner
}

/// A sentence that explains, with a word in it that can be explained in turn.
pub(crate) fn hint_about(ui: &mut Ui, text: impl Into<String>, word: Word) {
    let muted = Palette::of(ui).muted;
    let text = RichText::new(text).size(size::NOTE).color(muted);
    let response = sentence(ui, text);
    explained(response, word);
}

/// What is wrong with the field above.
pub(crate) fn wrong(ui: &mut Ui, text: &str) {
    let color = Palette::of(ui).outside;
    sentence(ui, RichText::new(text).size(size::NOTE).color(color));
}

/// What a wide button looks like: at rest, under the pointer, pressed.
struct Look {
    fills: [Color32; 3],
    text: Color32,
    edge: Color32,
    heavy: bool,
    height: f32,
}

fn wide(ui: &mut Ui, text: &str, look: &Look) -> Response {
    let font = if look.heavy {
        strong(size::BODY)
    } else {
        egui::FontId::proportional(size::BODY)
    };
    let label = RichText::new(text).font(font).color(look.text);
    ui.scope(|ui| {
        let [rest, hovered, pressed] = look.fills;
        let widgets = &mut ui.visuals_mut().widgets;
        for (state, fill) in [
            (&mut widgets.inactive, rest),
            (&mut widgets.noninteractive, rest),
            (&mut widgets.hovered, hovered),
            (&mut widgets.open, hovered),
            (&mut widgets.active, pressed),
        ] {
            state.weak_bg_fill = fill;
            state.bg_stroke = Stroke::new(1.0, look.edge);
        }
        let room = vec2(ui.available_width(), look.height);
        ui.add_sized(room, Button::new(label).wrap())
    })
    .inner
}

/// The one thing to do next, as wide as the panel.
pub(crate) fn primary(ui: &mut Ui, text: &str) -> Response {
    let palette = Palette::of(ui);
    let darker = |t| palette.accent.lerp_to_gamma(palette.text, t);
    let look = Look {
        fills: [palette.accent, darker(0.12), darker(0.25)],
        text: palette.on_accent,
        edge: Color32::TRANSPARENT,
        heavy: true,
        height: space::PRIMARY,
    };
    wide(ui, text, &look)
}

/// Something else that can be done, as wide as the panel.
pub(crate) fn secondary(ui: &mut Ui, text: &str) -> Response {
    quiet(ui, text, 32.0)
}

/// The same beside the one that stands out, and as high.
pub(crate) fn other(ui: &mut Ui, text: &str) -> Response {
    quiet(ui, text, space::PRIMARY)
}

fn quiet(ui: &mut Ui, text: &str, height: f32) -> Response {
    let palette = Palette::of(ui);
    let look = Look {
        fills: [palette.surface, palette.inset, palette.accent_soft],
        text: palette.text,
        edge: palette.outline,
        heavy: false,
        height,
    };
    wide(ui, text, &look)
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
        .stroke(Stroke::new(1.0, palette.line))
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
                let response = segment(ui, palette, name, meant, on);
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

fn segment(ui: &mut Ui, palette: Palette, name: &str, meant: &str, on: bool) -> Response {
    let text = RichText::new(name);
    let text = if on {
        text.font(strong(size::SMALL)).color(palette.accent)
    } else {
        text.size(size::SMALL).color(palette.muted)
    };
    let (rest, edge) = if on {
        (palette.surface, palette.outline)
    } else {
        (Color32::TRANSPARENT, Color32::TRANSPARENT)
    };
    let widgets = &mut ui.visuals_mut().widgets;
    for (state, fill) in [
        (&mut widgets.inactive, rest),
        (&mut widgets.hovered, palette.surface),
        (&mut widgets.active, palette.accent_soft),
    ] {
        state.weak_bg_fill = fill;
        state.bg_stroke = Stroke::new(1.0, edge);
    }
    let button = Button::new(text)
        .corner_radius(CornerRadius::same(space::ROUND - 2))
        .min_size(vec2(34.0, 22.0));
    let response = ui.add(button);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, enabled, on, meant));
    response
}

/// What is longer than its panel: it fades where it goes on, and its bar stands in the panel's
/// margin, so that edges keep their line with or without it.
pub(crate) fn scroll(
    ui: &mut Ui,
    salt: impl std::hash::Hash + std::fmt::Debug,
    contents: impl FnOnce(&mut Ui),
) {
    let room = ui.available_rect_before_wrap();
    let with_bar = room.with_max_x(room.right() + space::GUTTER);
    // The panel is not to grow by the bar in its margin.
    let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(with_bar));
    egui::ScrollArea::vertical()
        .id_salt(salt)
        .auto_shrink([false, false])
        .show(&mut inside, |ui| {
            ui.set_width(room.width().min(ui.available_width()));
            contents(ui);
        });
    ui.advance_cursor_after_rect(room);
}

/// A surface of its own.
pub(crate) fn card<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let palette = Palette::of(ui);
    let frame = Frame::NONE
        .fill(palette.surface)
        .stroke(Stroke::new(1.0, palette.line))
        .corner_radius(CornerRadius::same(space::ROUND + 2))
        .inner_margin(Margin::same(space::CARD));
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
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepRow<'a> {
    /// Which one, from 1.
    pub(crate) number: usize,
    /// Its name.
    pub(crate) name: &'a str,
    /// What it has to show.
    pub(crate) caption: &'a str,
    /// How far it has come.
    pub(crate) progress: Progress,
    /// Whether it is the one that is worked on.
    pub(crate) selected: bool,
    /// Whether name and caption share one line.
    pub(crate) low: bool,
}

impl StepRow<'_> {
    /// Shows it.
    pub(crate) fn show(self, ui: &mut Ui) -> Response {
        let palette = Palette::of(ui);
        let height = if self.low { 30.0 } else { 44.0 };
        let room = vec2(ui.available_width(), height);
        let (rect, response) = ui.allocate_exact_size(room, Sense::click());
        let enabled = ui.is_enabled();
        let says = format!("{} {}", self.number, self.name);
        response.widget_info(|| WidgetInfo::selected(Role::Tab, enabled, self.selected, &says));
        let painter = ui.painter();
        let round = CornerRadius::same(space::ROUND);
        if self.selected {
            painter.rect_filled(rect, round, palette.accent_soft);
        } else if response.hovered() {
            painter.rect_filled(rect, round, palette.inset);
        }
        self.badge(painter, palette, pos2(rect.left() + 22.0, rect.center().y));
        let name_color = if self.selected {
            palette.accent
        } else {
            palette.text
        };
        let middle = rect.center().y;
        let left = rect.left() + 44.0;
        let cut = |text: &str, font: egui::FontId, color: Color32, width: f32| {
            let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
            job.wrap.max_width = width;
            job.wrap.max_rows = 1;
            job.wrap.break_anywhere = true;
            painter.layout_job(job)
        };
        let width = rect.right() - left - space::ROW;
        let name = cut(self.name, strong(size::BODY), name_color, width);
        let beside = if self.low { name.size().x + 12.0 } else { 0.0 };
        let small = egui::FontId::proportional(size::SMALL);
        let caption = cut(self.caption, small, palette.muted, width - beside);
        let place = |galley: &egui::Galley, x: f32, y: f32| pos2(x, y - 0.5 * galley.size().y);
        let (name_y, caption_at) = if self.low {
            let x = rect.right() - space::ROW - caption.size().x;
            (middle, place(&caption, x, middle))
        } else {
            (middle - 8.0, place(&caption, left, middle + 9.0))
        };
        let name_at = place(&name, left, name_y);
        let shortened = caption.elided;
        painter.galley(name_at, name, name_color);
        painter.galley(caption_at, caption, palette.muted);
        if shortened {
            response.on_hover_text(self.caption)
        } else {
            response
        }
    }

    /// Its number, or a tick.
    fn badge(self, painter: &egui::Painter, palette: Palette, centre: egui::Pos2) {
        let done = self.progress == Progress::Done;
        let (fill, edge, text) = match (done, self.selected) {
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
            painter.text(centre, middle, self.number, strong(size::SMALL), text);
        }
    }
}

/// A ring around whatever has the keyboard, in the layer that it is in.
pub(crate) fn focus_ring(ctx: &egui::Context) {
    let Some(response) = ctx
        .memory(egui::Memory::focused)
        .and_then(|id| ctx.read_response(id))
    else {
        return;
    };
    let palette = if ctx.global_style().visuals.dark_mode {
        DARK
    } else {
        LIGHT
    };
    // What is scrolled out of sight has no ring.
    let seen = response.interact_rect.expand(2.0 * space::RING);
    let painter = ctx.layer_painter(response.layer_id).with_clip_rect(seen);
    let round = CornerRadius::same(space::ROUND + 1);
    let ring = Stroke::new(space::RING, palette.accent);
    painter.rect_stroke(response.rect, round, ring, StrokeKind::Outside);
}

/// A name and what it is: on one line, or below each other where that is too narrow.
pub(crate) fn fact(ui: &mut Ui, name: &str, value: impl Into<String>) {
    let palette = Palette::of(ui);
    let value = value.into();
    let font = egui::TextStyle::Body.resolve(ui.style());
    let width = |text: &str| {
        let galley = ui
            .painter()
            .layout_no_wrap(text.to_owned(), font.clone(), palette.text);
        galley.size().x
    };
    let beside = width(name) + 12.0 + width(&value) <= ui.available_width();
    let label = |ui: &mut Ui| {
        let text = RichText::new(name).color(palette.muted);
        let label = ui.add(egui::Label::new(text).wrap());
        if let Some(word) = help::about(name) {
            explained(label, word);
        }
    };
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = 16.0;
        ui.spacing_mut().item_spacing.y = 4.0;
        if beside {
            ui.horizontal(|ui| {
                label(ui);
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    ui.label(value);
                });
            });
        } else {
            ui.spacing_mut().item_spacing.y = 1.0;
            label(ui);
            ui.with_layout(Layout::top_down(Align::Max), |ui| {
                ui.add(egui::Label::new(value).wrap());
            });
        }
    });
}

/// A number in a column of a grid: its end is where the others end.
pub(crate) fn cell_right(ui: &mut Ui, text: RichText) -> Response {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(text))
        .inner
}

/// Says what an effect is when the pointer rests on its name.
pub(crate) fn explained_effect(response: Response, id: &str) -> Response {
    let Some(about) = crate::effects::find(id).map(crate::effects::Effect::about) else {
        return response;
    };
    response.on_hover_ui(|ui| {
        ui.set_max_width(space::TIP);
        ui.label(RichText::new(about.title).font(strong(size::BODY)));
        ui.label(about.cause);
        hint(ui, format!("usually {}", about.usual_size));
        hint(ui, about.equation);
    })
}

/// Says what a word means when the pointer rests on it.
pub(crate) fn explained(response: Response, word: Word) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(space::TIP);
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
    let font = egui::FontId::proportional(size::TINY);
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

/// A window with its right-hand side: opens it or shuts it. Where it is shut its name stands beside
/// the sign.
pub(crate) fn side_button(ui: &mut Ui, open: bool, says: &str) -> Response {
    let palette = Palette::of(ui);
    let name = (!open).then(|| {
        let text = "Results".to_owned();
        ui.painter()
            .layout_no_wrap(text, strong(size::SMALL), palette.accent)
    });
    let width = name.as_ref().map_or(0.0, |name| name.size().x + 8.0);
    let (rect, response) = ui.allocate_exact_size(vec2(30.0 + width, 28.0), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, says));
    let painter = ui.painter();
    let lit = response.hovered() || response.has_focus();
    if lit {
        painter.rect_filled(rect, CornerRadius::same(space::ROUND), palette.inset);
    }
    let color = if open { palette.text } else { palette.accent };
    let centre = pos2(rect.right() - 15.0, rect.center().y);
    let frame = egui::Rect::from_center_size(centre, vec2(16.0, 13.0));
    let edge = Stroke::new(1.5, color);
    painter.rect_stroke(frame, CornerRadius::same(2), edge, StrokeKind::Middle);
    let mut side = frame;
    side.set_left(frame.right() - 5.5);
    if open {
        painter.rect_filled(side, CornerRadius::ZERO, color);
    } else {
        painter.vline(side.left(), frame.y_range(), edge);
    }
    if let Some(name) = name {
        let at = pos2(rect.left() + 6.0, rect.center().y - 0.5 * name.size().y);
        painter.galley(at, name, color);
    }
    response.on_hover_text(says)
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
