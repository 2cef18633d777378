//! Buttons: with words on them, or with a sign, whose words are said to who cannot see it.

use egui::response::Flags;
use egui::{
    Align, Button, CollapsingHeader, Color32, Context, CornerRadius, FontId, Frame, Id, Key,
    KeyboardShortcut, Layout, Margin, Modifiers, Response, RichText, Role, Sense, Stroke, Ui,
    WidgetInfo, vec2,
};

use crate::gui::help::{self, Word};
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::workbench::Workbench;
use crate::text::{Template, spoken, within};

/// What is done by a press.
pub(crate) trait Does {
    /// Does this once the frame is drawn, where it was pressed.
    fn does(&self, workbench: &Workbench, change: impl FnOnce(&mut Workbench) + Send + 'static);
}

impl Does for Response {
    fn does(&self, workbench: &Workbench, change: impl FnOnce(&mut Workbench) + Send + 'static) {
        if self.clicked() {
            workbench.then(change);
        }
    }
}

/// What a wide button looks like: at rest, under the pointer, pressed.
struct ButtonLook {
    fills: [Color32; 3],
    text: Color32,
    edge: Color32,
    heavy: bool,
    height: f32,
}

fn wide(ui: &mut Ui, text: &str, look: &ButtonLook) -> Response {
    let font = if look.heavy {
        strong(size::BODY)
    } else {
        egui::FontId::proportional(size::BODY)
    };
    // No line begins with the sign that a dialog follows.
    let text = text.replace(" …", "\u{a0}…");
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

/// They press the one thing to do next, wherever the focus is.
pub(crate) const NEXT: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Enter);

/// In which pass [`NEXT`] was pressed.
#[derive(Clone, Copy)]
struct Asked(u64);

fn asked() -> Id {
    Id::unique("what comes next was asked for")
}

/// Reads [`NEXT`]. What is typed into a field ends with it, and is taken over before the button is pressed.
pub(crate) fn read_next(ctx: &Context) {
    const LASTS: u64 = 4;
    let pass = ctx.cumulative_pass_nr();
    if ctx.input_mut(|input| input.consume_shortcut(&NEXT)) {
        ctx.memory_mut(|memory| {
            if let Some(focused) = memory.focused() {
                memory.surrender_focus(focused);
            }
            memory.data.insert_temp(asked(), Asked(pass));
        });
        ctx.request_repaint();
    } else if let Some(Asked(before)) = ctx.data(|data| data.get_temp(asked()))
        && pass > before + LASTS
    {
        // Nothing comes next here.
        ctx.data_mut(|data| data.remove::<Asked>(asked()));
    }
}

/// Whether it is this button that [`NEXT`] asks for: behind a sheet none is.
fn is_asked_for(ui: &Ui) -> bool {
    let ctx = ui.ctx();
    let Some(Asked(before)) = ctx.data(|data| data.get_temp(asked())) else {
        return false;
    };
    let top = ctx.memory(egui::Memory::top_modal_layer);
    let here = ui.is_enabled() && top.is_none_or(|top| top == ui.layer_id());
    let now = here && ctx.cumulative_pass_nr() > before;
    if now {
        ctx.data_mut(|data| data.remove::<Asked>(asked()));
    }
    now
}

/// The one thing to do next, as wide as the panel.
pub(crate) fn primary(ui: &mut Ui, text: &str) -> Response {
    let palette = Palette::of(ui);
    let darker = |t| palette.accent.lerp_to_gamma(palette.text, t);
    let look = ButtonLook {
        fills: [palette.accent, darker(0.12), darker(0.25)],
        text: palette.on_accent,
        edge: Color32::TRANSPARENT,
        heavy: true,
        height: space::PRIMARY,
    };
    let mut response = wide(ui, text, &look);
    if is_asked_for(ui) {
        response.flags |= Flags::FAKE_PRIMARY_CLICKED;
    }
    response
}

/// Whether what has this name has been in sight for half a second without a break: what comes up under the pointer
/// would else be pressed by a click that was meant for what was there before.
pub(crate) fn has_stood(ui: &Ui, name: &str) -> bool {
    const SETTLES_S: f64 = 0.5;
    /// Passes of a frame that are not shown lie between two that are.
    const BREAK: u64 = 16;
    let (id, pass) = (Id::unique(name), ui.ctx().cumulative_pass_nr());
    let now = ui.input(|input| input.time);
    let before: Option<(f64, u64)> = ui.data(|data| data.get_temp(id));
    let since = before.filter(|(_, seen)| pass <= seen + BREAK);
    let since = since.map_or(now, |(since, _)| since);
    ui.data_mut(|data| data.insert_temp(id, (since, pass)));
    let left = since + SETTLES_S - now;
    if left > 0.0 {
        let left = std::time::Duration::from_secs_f64(left);
        ui.ctx().request_repaint_after(left);
    }
    left <= 0.0
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
    let look = ButtonLook {
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

/// How much room they take side by side, points.
pub(crate) fn width_of_segments<T>(ui: &Ui, options: &[(T, &str)]) -> f32 {
    let padding = 2.0 * ui.spacing().button_padding.x;
    let each = options
        .iter()
        .map(|(_, name)| width_of(ui, name, strong(size::SMALL)) + padding);
    // The frame around them and the gaps between them.
    each.sum::<f32>() + 6.0 + 2.0 * options.len() as f32
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

/// Signs, of the icon font (Phosphor; `assets/fonts/subset.py` says which it is cut to).
pub(crate) const UNDO: &str = "\u{E08A}";
pub(crate) const REDO: &str = "\u{E08C}";
pub(crate) const SAVE: &str = "\u{E20C}";
pub(crate) const COPY: &str = "\u{E1CA}";
pub(crate) const FIT: &str = "\u{E1D0}";
pub(crate) const SIDE: &str = "\u{EC24}";

/// A square button with a sign, called by its name.
pub(crate) fn icon_button(ui: &mut Ui, sign: &str, name: &str) -> Response {
    bare_button(ui, icon(sign), name)
}

/// A sign, as large as buttons have it.
pub(crate) fn icon(sign: &str) -> RichText {
    RichText::new(sign).size(size::HEADING)
}

/// A button without a frame, called by its name whatever it shows.
pub(crate) fn bare_button<'a>(
    ui: &mut Ui,
    shown: impl egui::IntoAtoms<'a>,
    name: &str,
) -> Response {
    let button = Button::new(shown).frame_when_inactive(false);
    let button = button.min_size(vec2(28.0, 24.0));
    // No scope: in a row that wraps it goes to the next one.
    let usual = ui.spacing().button_padding.x;
    ui.spacing_mut().button_padding.x = space::TIGHT;
    let response = ui.add(button);
    ui.spacing_mut().button_padding.x = usual;
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    response
}

// Words: what stands over, beside and below controls, and numbers with their names.

/// What a panel is about.
pub(crate) fn heading(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::HEADING)));
}

/// How wide a text is in one line, points.
pub(crate) fn width_of(ui: &Ui, text: &str, font: egui::FontId) -> f32 {
    let galley = ui
        .painter()
        .layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
    galley.size().x
}

/// What the next group is about.
pub(crate) fn section(ui: &mut Ui, text: &str) {
    ui.add_space(space::ROW);
    let muted = Palette::of(ui).muted;
    ui.label(RichText::new(text).font(strong(size::SMALL)).color(muted));
}

/// The name of something, or what stands out among other words.
pub(crate) fn bold(ui: &mut Ui, text: impl Into<String>) -> Response {
    ui.label(RichText::new(text).font(strong(size::BODY)))
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

/// Height of a window that has room for more than what is done, points.
const ROOMY: f32 = 480.0;

/// The same above a button that is always in sight: in a low window the controls of the step need the room.
pub(crate) fn hint_above_the_button(ui: &mut Ui, text: impl Into<String>) {
    if ui.ctx().content_rect().height() >= ROOMY {
        hint(ui, text);
    }
}

/// Text whose lines are no longer than can be read.
fn sentence(ui: &mut Ui, text: RichText) -> Response {
    ui.scope(|ui| {
        ui.set_max_width(ui.available_width().min(space::LINE));
        ui.add(egui::Label::new(text).wrap())
    })
    .inner
}

/// What is wrong with the field above.
pub(crate) fn wrong(ui: &mut Ui, text: &str) {
    let color = Palette::of(ui).outside;
    sentence(ui, RichText::new(text).size(size::NOTE).color(color));
}

/// As [`fact`], of a name that is spoken here.
pub(crate) fn fact_of(ui: &mut Ui, name: Template, value: impl Into<String>) {
    fact(ui, spoken(name), value);
}

/// Names a control for those who do not see it.
pub(crate) fn label(response: &Response, name: impl Into<Box<str>>) {
    let name = name.into();
    let ctx = &response.ctx;
    ctx.accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// What folds away below a small title.
pub(crate) fn folded(ui: &mut Ui, text: &str, size: f32, contents: impl FnOnce(&mut Ui)) {
    let title = RichText::new(text).size(size).color(Palette::of(ui).muted);
    let header = CollapsingHeader::new(title).id_salt(text);
    header.show(ui, contents);
}

/// A name and what it is: on one line, or below each other where that is too narrow.
pub(crate) fn fact(ui: &mut Ui, name: &str, value: impl Into<String>) {
    let palette = Palette::of(ui);
    let value = value.into();
    let font = egui::TextStyle::Body.resolve(ui.style());
    let width = |text: &str| width_of(ui, text, font.clone());
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
            ui.add(egui::Label::new(value).wrap());
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
        bold(ui, crate::present::names::title(id));
        ui.label(spoken(about.cause));
        let usual_size = spoken(about.usual_size);
        hint(ui, say!("usually {usual_size}", usual_size));
        hint(ui, about.equation);
    })
}

/// Says what a word means when the pointer rests on it.
pub(crate) fn explained(response: Response, word: Word) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(space::TIP);
        bold(ui, word.name());
        ui.label(word.means());
    })
}

/// A question mark that says what a word means.
pub(crate) fn question(ui: &mut Ui, word: Word) {
    let palette = Palette::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(16.0, 16.0), Sense::hover());
    let says = say!("what {word} means", word = within(word.name()));
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
    ui.set_width(220.0);
    dense(ui);
    bold(ui, title);
    let small = FontId::proportional(size::SMALL);
    let styles = &mut ui.style_mut().text_styles;
    styles.insert(egui::TextStyle::Body, small);
    for (name, value) in lines {
        fact(ui, name, value);
    }
}
