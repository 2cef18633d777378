//! The line between a chart's bar and the chart: what the marks are, and what has to be said. It
//! stands beside the plot, not on it, so that it covers no sample.

use egui::{
    Align, Color32, FontId, Layout, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

use super::marks;

/// Height of the line, points.
const HEIGHT: f32 = 18.0;
/// Width of a mark, points.
const MARK: f32 = 16.0;

/// What stands before a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Sign {
    /// A dot, or a triangle that points the way the joint came.
    Dot(f64, Color32, Color32),
    /// A bar, filled or outlined.
    Bar(Color32, bool),
    /// A line, whole or dashed.
    Line(Color32, bool),
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) sign: Sign,
    /// Whether it is shown, where that can be chosen.
    pub(crate) shown: Option<bool>,
}

impl Entry {
    /// A name that is always there.
    pub(crate) fn new(name: impl Into<String>, sign: Sign) -> Self {
        Self {
            name: name.into(),
            sign,
            shown: None,
        }
    }

    /// The deviation before: it can be left out once there is one after.
    pub(crate) fn before(workbench: &Workbench, sign: Sign) -> Self {
        let shown = workbench.answer().map(|_| !workbench.view().only_after);
        Self {
            shown,
            ..Self::new("before", sign)
        }
    }
}

pub(crate) fn show(ui: &mut Ui, note: &str, entries: &[Entry], commands: &mut Vec<Command>) {
    let room = vec2(ui.available_width(), HEIGHT);
    ui.allocate_ui_with_layout(room, Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 12.0;
        for one in entries.iter().rev() {
            if entry(ui, one) {
                commands.push(Command::OnlyAfter(one.shown == Some(true)));
            }
        }
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let muted = Palette::of(ui).muted;
            let text = egui::RichText::new(note).size(size::SMALL).color(muted);
            if !note.is_empty() {
                ui.add(egui::Label::new(text).truncate());
            }
        });
    });
    ui.add_space(-space::TIGHT);
}

/// A name with its mark; whether it was pressed.
fn entry(ui: &mut Ui, entry: &Entry) -> bool {
    let palette = Palette::of(ui);
    let off = entry.shown == Some(false);
    let color = if off { palette.nominal } else { palette.muted };
    let font = FontId::proportional(size::SMALL);
    let painter = ui.painter().clone();
    let galley = painter.layout_no_wrap(entry.name.clone(), font, color);
    let sense = if entry.shown.is_some() {
        Sense::click()
    } else {
        Sense::hover()
    };
    let wide = vec2(MARK + galley.size().x, HEIGHT);
    let (rect, response) = ui.allocate_exact_size(wide, sense);
    let name = &entry.name;
    match entry.shown {
        Some(shown) => response.widget_info(|| {
            WidgetInfo::selected(Role::CheckBox, true, shown, format!("show {name}"))
        }),
        None => response.widget_info(|| WidgetInfo::labeled(Role::Label, true, name)),
    }
    if entry.shown.is_some() && (response.hovered() || response.has_focus()) {
        painter.rect_filled(rect.expand2(vec2(4.0, 0.0)), 3.0, palette.inset);
    }
    let middle = pos2(rect.left() + 5.0, rect.center().y);
    let fade = |c: Color32| if off { c.gamma_multiply(0.35) } else { c };
    painter.extend(sign(middle, entry.sign, fade));
    let at = pos2(rect.left() + MARK, rect.center().y - 0.5 * galley.size().y);
    let right = at.x + galley.size().x;
    painter.galley(at, galley, color);
    if off {
        let through = [pos2(at.x, rect.center().y), pos2(right, rect.center().y)];
        painter.line_segment(through, Stroke::new(1.0, color));
    }
    let clicked = response.clicked();
    if let Some(shown) = entry.shown {
        response.on_hover_text(if shown {
            "Leave it out, so that what is left can be seen"
        } else {
            "Show it as well"
        });
    }
    clicked
}

fn sign(at: egui::Pos2, sign: Sign, fade: impl Fn(Color32) -> Color32) -> Vec<Shape> {
    match sign {
        Sign::Dot(side, fill, edge) => {
            let edge = Stroke::new(1.2, fade(edge));
            vec![marks::pointing(at, 3.4, side, fade(fill), edge)]
        }
        Sign::Bar(color, filled) => {
            let rect = Rect::from_center_size(at, vec2(9.0, 9.0));
            let color = fade(color);
            vec![if filled {
                Shape::rect_filled(rect, 1.0, color)
            } else {
                let inside = egui::StrokeKind::Inside;
                Shape::rect_stroke(rect, 1.0, Stroke::new(1.5, color), inside)
            }]
        }
        Sign::Line(color, dashed) => {
            let ends = [at - vec2(6.0, 0.0), at + vec2(6.0, 0.0)];
            let stroke = Stroke::new(1.8, fade(color));
            if dashed {
                Shape::dashed_line(&ends, stroke, 3.5, 2.0)
            } else {
                vec![Shape::line_segment(ends, stroke)]
            }
        }
    }
}

/// What stands in the place of a chart that cannot be drawn.
pub(crate) fn empty(ui: &mut Ui, title: &str, why: &str) {
    let room = ui.available_size();
    let (rect, response) = ui.allocate_exact_size(room, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, format!("{title}. {why}")));
    let inner = rect.shrink2(vec2(24.0, 0.0));
    let wide = inner.width().min(460.0);
    let area = Rect::from_center_size(inner.center(), vec2(wide, inner.height()));
    let top = area.top() + 0.3 * area.height();
    let area = area.with_min_y(top);
    let layout = Layout::top_down(Align::Center);
    ui.scope_builder(egui::UiBuilder::new().max_rect(area).layout(layout), |ui| {
        widgets::title(ui, title);
        widgets::hint(ui, why);
    });
}
