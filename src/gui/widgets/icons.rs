//! Buttons that show a sign instead of a word; their words are said to who cannot see it.

use egui::{
    Color32, CornerRadius, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2,
};

use crate::gui::style::tokens::{Palette, size, space, strong};

/// A window with its right-hand side: opens it or shuts it. Where it is shut its name stands beside
/// the sign.
pub(crate) fn side_button(ui: &mut Ui, open: bool, says: &str) -> Response {
    let palette = Palette::of(ui);
    let name = (!open).then(|| {
        let text = say!("Results").to_owned();
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

/// A square button on which a sign is drawn.
pub(crate) struct IconButton {
    /// Whether it was pressed, and so on.
    pub(crate) response: Response,
    pub(crate) rect: egui::Rect,
    /// Whether the pointer or the keyboard is on it.
    pub(crate) lit: bool,
    /// What the sign is drawn with.
    pub(crate) color: Color32,
}

impl IconButton {
    /// A point of the drawing, from its middle.
    pub(crate) fn at(&self, x: f32, y: f32) -> egui::Pos2 {
        self.rect.center() + vec2(x, y)
    }

    pub(crate) fn stroke(&self) -> Stroke {
        Stroke::new(1.5, self.color)
    }
}

/// Room for a sign, called by its name.
pub(crate) fn icon_button(ui: &mut Ui, name: &str) -> IconButton {
    sign_that(ui, name, Sense::click())
}

/// The same for one that is dragged as well.
pub(crate) fn sign_that(ui: &mut Ui, name: &str, sense: Sense) -> IconButton {
    let palette = Palette::of(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(24.0, 24.0), sense);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    let lit = response.hovered() || response.has_focus();
    if lit {
        let round = CornerRadius::same(space::ROUND);
        ui.painter().rect_filled(rect, round, palette.inset);
    }
    let color = if lit { palette.text } else { palette.muted };
    IconButton {
        response,
        rect,
        lit,
        color,
    }
}

/// An arrow into a tray: saves what stands beside it.
pub(crate) fn save_button(ui: &mut Ui, name: &str) -> Response {
    let sign = icon_button(ui, name);
    let at = |x, y| sign.at(x, y);
    let line = |points: Vec<egui::Pos2>| {
        ui.painter().line(points, sign.stroke());
    };
    line(vec![at(0.0, -6.5), at(0.0, 2.0)]);
    line(vec![at(-3.5, -1.5), at(0.0, 2.0), at(3.5, -1.5)]);
    line(vec![
        at(-6.5, 2.5),
        at(-6.5, 6.0),
        at(6.5, 6.0),
        at(6.5, 2.5),
    ]);
    sign.response.on_hover_text(name)
}

/// A small table over the tray of what is saved: saves the numbers of what stands beside it.
pub(crate) fn data_button(ui: &mut Ui, name: &str) -> Response {
    let sign = icon_button(ui, name);
    let table = egui::Rect::from_min_max(sign.at(-6.5, -6.0), sign.at(6.5, 6.0));
    let painter = ui.painter();
    let stroke = sign.stroke();
    painter.rect_stroke(table, 1.5, stroke, StrokeKind::Middle);
    painter.hline(table.x_range(), table.top() + 4.0, stroke);
    let thin = Stroke::new(1.0, sign.color);
    painter.hline(table.x_range(), table.top() + 8.0, thin);
    painter.vline(sign.rect.center().x, table.y_range(), thin);
    sign.response.on_hover_text(name)
}

/// Two sheets: copies what stands beside it.
pub(crate) fn copy_button(ui: &mut Ui, name: &str) -> Response {
    let sign = icon_button(ui, name);
    let sheet = |x, y| egui::Rect::from_min_size(sign.at(x, y), vec2(8.5, 9.5));
    let painter = ui.painter();
    let stroke = sign.stroke();
    painter.rect_stroke(sheet(-2.0, -6.5), 1.5, stroke, StrokeKind::Middle);
    let palette = Palette::of(ui);
    let ground = if sign.lit {
        palette.inset
    } else {
        palette.surface
    };
    painter.rect(sheet(-6.5, -3.0), 1.5, ground, stroke, StrokeKind::Middle);
    sign.response.on_hover_text(name)
}
