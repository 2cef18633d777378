//! The line between a chart's bar and the chart: what the marks are, and what has to be said. It
//! stands beside the plot, not on it, so that it covers no sample.

use egui::{
    Align, Color32, FontId, Layout, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange};
use crate::present::chart::{Chart, Entry, LegendSymbol};

use super::{chart, marks};

/// Height of the line, points.
const HEIGHT: f32 = 18.0;
/// Width of a mark, points.
const MARK: f32 = 16.0;
/// Between names, points.
const BETWEEN: f32 = 12.0;

/// Shows it. What was before can be left out where there is something after: `shown` says whether
/// it is there.
pub(crate) fn show(ui: &mut Ui, chart: &Chart, shown: Option<bool>, commands: &mut Vec<Command>) {
    let font = FontId::proportional(size::SMALL);
    let wide = |one: &Entry| {
        let color = Palette::of(ui).muted;
        let name = ui
            .painter()
            .layout_no_wrap(one.name.clone(), font.clone(), color);
        MARK + name.size().x + BETWEEN
    };
    if chart.legend.iter().map(wide).sum::<f32>() > ui.available_width() {
        return in_lines(ui, chart, shown, commands);
    }
    let room = vec2(ui.available_width(), HEIGHT);
    ui.allocate_ui_with_layout(room, Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = BETWEEN;
        for one in chart.legend.iter().rev() {
            let shown = shown.filter(|_| one.may_go);
            if entry(ui, one, shown) {
                commands.push(Command::View(ViewChange::OnlyAfter(shown == Some(true))));
            }
        }
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            if !chart.note.is_empty() {
                ui.add(note(ui, chart).truncate());
            }
        });
    });
    ui.add_space(-space::TIGHT);
}

/// The same in a narrow chart: as many lines as it takes, and the note below them.
fn in_lines(ui: &mut Ui, chart: &Chart, shown: Option<bool>, commands: &mut Vec<Command>) {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = HEIGHT;
        ui.spacing_mut().item_spacing = vec2(BETWEEN, 0.0);
        ui.horizontal_wrapped(|ui| {
            for one in &chart.legend {
                let shown = shown.filter(|_| one.may_go);
                if entry(ui, one, shown) {
                    commands.push(Command::View(ViewChange::OnlyAfter(shown == Some(true))));
                }
            }
        });
    });
    if !chart.note.is_empty() {
        ui.add(note(ui, chart).wrap());
    }
}

fn note(ui: &Ui, chart: &Chart) -> egui::Label {
    let text = egui::RichText::new(&chart.note);
    egui::Label::new(text.size(size::SMALL).color(Palette::of(ui).muted))
}

/// A name with its mark; whether it was pressed.
fn entry(ui: &mut Ui, entry: &Entry, shown: Option<bool>) -> bool {
    let palette = Palette::of(ui);
    let off = shown == Some(false);
    let color = if off { palette.nominal } else { palette.muted };
    let font = FontId::proportional(size::SMALL);
    let painter = ui.painter().clone();
    let galley = painter.layout_no_wrap(entry.name.clone(), font, color);
    let sense = if shown.is_some() {
        Sense::click()
    } else {
        Sense::hover()
    };
    let wide = vec2(MARK + galley.size().x, HEIGHT);
    let (rect, response) = ui.allocate_exact_size(wide, sense);
    let name = &entry.name;
    match shown {
        Some(shown) => response.widget_info(|| {
            WidgetInfo::selected(
                Role::CheckBox,
                true,
                shown,
                say!("show {name}", name = name),
            )
        }),
        None => response.widget_info(|| WidgetInfo::labeled(Role::Label, true, name)),
    }
    if shown.is_some() && (response.hovered() || response.has_focus()) {
        painter.rect_filled(rect.expand2(vec2(4.0, 0.0)), 3.0, palette.inset);
    }
    let middle = pos2(rect.left() + 5.0, rect.center().y);
    let full = chart::color(entry.role, &palette);
    let faded = if off { full.gamma_multiply(0.35) } else { full };
    painter.extend(symbol(middle, entry, faded));
    let at = pos2(rect.left() + MARK, rect.center().y - 0.5 * galley.size().y);
    let right = at.x + galley.size().x;
    painter.galley(at, galley, color);
    if off {
        let through = [pos2(at.x, rect.center().y), pos2(right, rect.center().y)];
        painter.line_segment(through, Stroke::new(1.0, color));
    }
    let clicked = response.clicked();
    if let Some(shown) = shown {
        response.on_hover_text(if shown {
            say!("Leave it out, so that what is left can be seen")
        } else {
            say!("Show it as well")
        });
    }
    clicked
}

fn symbol(at: egui::Pos2, entry: &Entry, color: Color32) -> Vec<Shape> {
    match entry.sign {
        LegendSymbol::Mark(form) => {
            let fill = if entry.filled {
                color
            } else {
                Color32::TRANSPARENT
            };
            vec![marks::mark(at, 3.4, form, fill, Stroke::new(1.2, color))]
        }
        LegendSymbol::Bar | LegendSymbol::Band => {
            let rect = Rect::from_center_size(at, vec2(9.0, 9.0));
            vec![if entry.sign == LegendSymbol::Band {
                Shape::rect_filled(rect, 1.0, color.gamma_multiply(0.3))
            } else if entry.filled {
                Shape::rect_filled(rect, 1.0, color)
            } else {
                let inside = egui::StrokeKind::Inside;
                Shape::rect_stroke(rect, 1.0, Stroke::new(1.5, color), inside)
            }]
        }
        LegendSymbol::Line => {
            let ends = [at - vec2(6.0, 0.0), at + vec2(6.0, 0.0)];
            let stroke = Stroke::new(1.8, color);
            if entry.filled {
                vec![Shape::line_segment(ends, stroke)]
            } else {
                Shape::dashed_line(&ends, stroke, 3.5, 2.0)
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
