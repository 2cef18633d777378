//! Buttons: with words on them, or with a sign, whose words are said to who cannot see it.

use egui::response::Flags;
use egui::{
    Button, Color32, Context, CornerRadius, FontId, Frame, Id, Key, KeyboardShortcut, Margin,
    Modifiers, Response, RichText, Role, Stroke, Ui, WidgetInfo, vec2,
};

use crate::gui::style::{Palette, size, space, strong};
use crate::gui::widgets::words::width_of;
use crate::gui::workbench::Workbench;

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

/// The window's buttons beside egui's own.
pub(crate) trait Buttons {
    /// The one thing to do next, as wide as the panel.
    fn primary(&mut self, text: &str) -> Response;
    /// Something else that can be done, as wide as the panel.
    fn secondary(&mut self, text: &str) -> Response;
    /// One of several, side by side. The one that was clicked.
    fn segmented<T: Copy + PartialEq>(&mut self, options: &[(T, &str)], current: T) -> Option<T>;
    /// A square button with a sign, called by its name.
    fn icon_button(&mut self, sign: &str, name: &str) -> Response;
    /// A button without a frame, called by its name whatever it shows.
    fn bare_button<'a>(&mut self, shown: impl egui::IntoAtoms<'a>, name: &str) -> Response;
    /// The buttons at the end of a sheet, each with whether it can be pressed; the last one stands out. Which was.
    fn foot<const N: usize>(&mut self, buttons: [(&str, bool); N]) -> Option<usize>;
}

impl Buttons for Ui {
    fn primary(&mut self, text: &str) -> Response {
        let mut response = wide(self, text, true, space::PRIMARY);
        if is_asked_for(self) {
            response.flags |= Flags::FAKE_PRIMARY_CLICKED;
        }
        response
    }

    fn secondary(&mut self, text: &str) -> Response {
        wide(self, text, false, 32.0)
    }

    fn segmented<T: Copy + PartialEq>(&mut self, options: &[(T, &str)], current: T) -> Option<T> {
        let palette = Palette::of(self);
        let mut chosen = None;
        let frame = Frame::NONE
            .fill(palette.inset)
            .stroke(Stroke::new(1.0, palette.line))
            .corner_radius(CornerRadius::same(space::ROUND))
            .inner_margin(Margin::same(2));
        frame.show(self, |ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            ui.horizontal(|ui| {
                // Where a row runs from right to left the first still stands at the left.
                let backwards = ui.layout().prefer_right_to_left();
                for k in 0..options.len() {
                    let k = if backwards { options.len() - 1 - k } else { k };
                    let (value, name) = options[k];
                    let on = value == current;
                    if segment(ui, palette, name, on).clicked() && !on {
                        chosen = Some(value);
                    }
                }
            });
        });
        chosen
    }

    fn icon_button(&mut self, sign: &str, name: &str) -> Response {
        self.bare_button(icon(sign), name)
    }

    fn bare_button<'a>(&mut self, shown: impl egui::IntoAtoms<'a>, name: &str) -> Response {
        let button = Button::new(shown).frame_when_inactive(false);
        let button = button.min_size(vec2(28.0, 24.0));
        // No scope: in a row that wraps it goes to the next one.
        let usual = self.spacing().button_padding.x;
        self.spacing_mut().button_padding.x = space::TIGHT;
        let response = self.add(button);
        self.spacing_mut().button_padding.x = usual;
        let enabled = self.is_enabled();
        response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
        response
    }

    fn foot<const N: usize>(&mut self, buttons: [(&str, bool); N]) -> Option<usize> {
        self.add_space(space::ROW);
        self.columns_const(|columns: &mut [Ui; N]| {
            let mut pressed = None;
            for (k, (text, enabled)) in buttons.into_iter().enumerate() {
                let button = columns[k].add_enabled_ui(enabled, |ui| {
                    if k + 1 == N {
                        ui.primary(text)
                    } else {
                        wide(ui, text, false, space::PRIMARY)
                    }
                });
                pressed = pressed.or(button.inner.clicked().then_some(k));
            }
            pressed
        })
    }
}

/// The buttons at the end of a sheet: one that leaves it, and what it is for, where that can be done. Whether that was
/// pressed.
pub(crate) fn ended(ui: &mut Ui, workbench: &Workbench, (name, ready): (&str, bool)) -> bool {
    let pressed = ui.foot([(say!("Cancel"), true), (name, ready)]);
    if pressed == Some(0) {
        workbench.then(|bench| bench.show_sheet(None));
    }
    pressed == Some(1)
}

/// A button as wide as there is room, filled where it stands out.
fn wide(ui: &mut Ui, text: &str, filled: bool, height: f32) -> Response {
    let palette = Palette::of(ui);
    let darker = |t| palette.accent.lerp_to_gamma(palette.text, t);
    // At rest, under the pointer, pressed.
    let fills = [palette.surface, palette.inset, palette.accent_soft];
    let filling = [palette.accent, darker(0.12), darker(0.25)];
    let (fills, color, edge) = if filled {
        (filling, palette.on_accent, Color32::TRANSPARENT)
    } else {
        (fills, palette.text, palette.outline)
    };
    let font = if filled {
        strong(size::BODY)
    } else {
        FontId::proportional(size::BODY)
    };
    // No line begins with the sign that a dialog follows.
    let text = text.replace(" …", "\u{a0}…");
    let label = RichText::new(text).font(font).color(color);
    ui.scope(|ui| {
        paint_states(ui, fills, edge);
        let room = vec2(ui.available_width(), height);
        ui.add_sized(room, Button::new(label).wrap())
    })
    .inner
}

/// What buttons are filled with at rest, under the pointer and pressed, and their edge.
fn paint_states(ui: &mut Ui, [rest, hovered, pressed]: [Color32; 3], edge: Color32) {
    let widgets = &mut ui.visuals_mut().widgets;
    for (state, fill) in [
        (&mut widgets.inactive, rest),
        (&mut widgets.noninteractive, rest),
        (&mut widgets.hovered, hovered),
        (&mut widgets.open, hovered),
        (&mut widgets.active, pressed),
    ] {
        state.weak_bg_fill = fill;
        state.bg_stroke = Stroke::new(1.0, edge);
    }
}

/// They press the one thing to do next, wherever the focus is.
pub(crate) const NEXT: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Enter);

/// In which pass [`NEXT`] was pressed.
fn asked() -> Id {
    Id::unique("what comes next was asked for")
}

/// Reads [`NEXT`]. What is typed into a field ends with it, and is taken over before the button is pressed.
pub(crate) fn read_next(ctx: &Context) {
    let pass = ctx.cumulative_pass_nr();
    if ctx.input_mut(|input| input.consume_shortcut(&NEXT)) {
        ctx.memory_mut(|memory| {
            if let Some(focused) = memory.focused() {
                memory.surrender_focus(focused);
            }
            memory.data.insert_temp(asked(), pass);
        });
        ctx.request_repaint();
    }
}

/// Whether it is this button that [`NEXT`] asks for: behind a sheet none is.
fn is_asked_for(ui: &Ui) -> bool {
    const LASTS: u64 = 4;
    let ctx = ui.ctx();
    let asked_in = ctx.data(|data| data.get_temp::<u64>(asked()));
    let lately = asked_in.is_some_and(|pass| {
        let passes = ctx.cumulative_pass_nr() - pass;
        (1..=LASTS).contains(&passes)
    });
    let top = ctx.memory(egui::Memory::top_modal_layer);
    let here = ui.is_enabled() && top.is_none_or(|top| top == ui.layer_id());
    if lately && here {
        ctx.data_mut(|data| data.remove::<u64>(asked()));
    }
    lately && here
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

/// How much room they take side by side, points.
pub(crate) fn width_of_segments<T>(ui: &Ui, options: &[(T, &str)]) -> f32 {
    let padding = 2.0 * ui.spacing().button_padding.x;
    let each = options
        .iter()
        .map(|(_, name)| width_of(ui, name, strong(size::SMALL)) + padding);
    // The frame around them and the gaps between them.
    each.sum::<f32>() + 6.0 + 2.0 * options.len() as f32
}

fn segment(ui: &mut Ui, palette: Palette, name: &str, on: bool) -> Response {
    let text = RichText::new(name);
    let text = if on {
        text.font(strong(size::SMALL)).color(palette.accent)
    } else {
        text.small().weak()
    };
    let (rest, edge) = if on {
        (palette.surface, palette.outline)
    } else {
        (Color32::TRANSPARENT, Color32::TRANSPARENT)
    };
    paint_states(ui, [rest, palette.surface, palette.accent_soft], edge);
    let button = Button::new(text)
        .corner_radius(CornerRadius::same(space::ROUND - 2))
        .min_size(vec2(34.0, 22.0));
    let response = ui.add(button);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, enabled, on, name));
    response
}

/// Signs, of the icon font (Phosphor; `assets/fonts/subset.py` says which it is cut to).
pub(crate) const UNDO: &str = "\u{E08A}";
pub(crate) const REDO: &str = "\u{E08C}";
pub(crate) const SAVE: &str = "\u{E20C}";
pub(crate) const COPY: &str = "\u{E1CA}";
pub(crate) const FIT: &str = "\u{E1D0}";
pub(crate) const SIDE: &str = "\u{EC24}";

/// A sign, as large as buttons have it.
pub(crate) fn icon(sign: &str) -> RichText {
    RichText::new(sign).size(size::HEADING)
}
