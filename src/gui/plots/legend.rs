//! Legends, in rows of their own above a plot, so that no mark is covered: names with their signs before them.

use egui::{
    Color32, FontId, Label, Rect, Response, RichText, Role, Sense, Shape, Stroke, StrokeKind, Ui,
    Vec2, WidgetInfo, pos2, vec2,
};

use crate::gui::plots::chart::color;
use crate::gui::plots::mark;
use crate::gui::style::{Palette, size};
use crate::gui::workbench::Workbench;
use crate::present::chart::{Chart, Entry, LegendSymbol};

/// Height of a row, points.
const HEIGHT: f32 = 18.0;
/// Width of a sign, points.
pub(crate) const SIGN: f32 = 12.0;
/// Between a sign and its name, points.
const GAP: f32 = 4.0;

/// Rows of a legend, as many as it takes; so much lies between entries and between rows, points.
pub(crate) fn rows<R>(ui: &mut Ui, between: Vec2, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let scope = ui.scope(|ui| {
        ui.spacing_mut().item_spacing = between;
        ui.spacing_mut().interact_size.y = HEIGHT;
        ui.horizontal_wrapped(contents).inner
    });
    scope.inner
}

/// A name in this colour, with a sign before it whose shapes lie about the middle of so much room. Where the room is.
pub(crate) fn entry(
    ui: &mut Ui,
    (sign, room): (Vec<Shape>, f32),
    (name, color): (&str, Color32),
    sense: Sense,
) -> (Rect, Response) {
    let font = FontId::proportional(size::SMALL);
    let painter = ui.painter().clone();
    let galley = painter.layout_no_wrap(name.to_owned(), font, color);
    let between = if room > 0.0 && !name.is_empty() {
        GAP
    } else {
        0.0
    };
    let wide = vec2(room + between + galley.size().x, HEIGHT);
    let (rect, response) = ui.allocate_exact_size(wide, sense);
    if sense.senses_click() && (response.hovered() || response.has_focus()) {
        let behind = rect.expand2(vec2(4.0, 0.0));
        painter.rect_filled(behind, 3.0, Palette::of(ui).inset);
    }
    let place = rect.with_max_x(rect.left() + room);
    painter.extend(sign.into_iter().map(|mut shape| {
        shape.translate(place.center().to_vec2());
        shape
    }));
    let at = pos2(
        place.right() + between,
        rect.center().y - 0.5 * galley.size().y,
    );
    painter.galley(at, galley, color);
    (place, response)
}

/// A chart of this height has room for lines more, points.
const HIGH: f32 = 220.0;

/// What the marks of a chart are, and what has to be said; what may go is left out by a press. `shown`: whether it is
/// there; `None`: it cannot go.
pub(crate) fn legend(ui: &mut Ui, chart: &Chart, shown: Option<bool>, workbench: &Workbench) {
    let high = ui.available_height() > HIGH;
    rows(ui, vec2(12.0, 0.0), |ui| {
        for one in &chart.legend {
            let shown = shown.filter(|_| one.may_go);
            if of_chart(ui, one, shown) {
                workbench.then(move |bench| bench.view.only_after = shown == Some(true));
            }
        }
        if !chart.note.is_empty() {
            let note = Label::new(RichText::new(&chart.note).small().weak());
            ui.add(if high { note.wrap() } else { note.truncate() });
        }
    });
}

/// A name with its mark; whether it was pressed.
fn of_chart(ui: &mut Ui, one: &Entry, shown: Option<bool>) -> bool {
    let palette = Palette::of(ui);
    let off = shown == Some(false);
    let text = if off { palette.nominal } else { palette.muted };
    let full = color(one.role, &palette);
    let faded = if off { full.gamma_multiply(0.35) } else { full };
    let sense = shown.map_or(Sense::hover(), |_| Sense::click());
    let name = &one.name;
    let (sign, response) = entry(ui, (symbol(one, faded), SIGN), (name, text), sense);
    response.widget_info(|| match shown {
        Some(shown) => WidgetInfo::selected(Role::CheckBox, true, shown, say!("show {name}", name)),
        None => WidgetInfo::labeled(Role::Label, true, name),
    });
    if off {
        let through = (sign.right() + GAP)..=response.rect.right();
        let y = response.rect.center().y;
        ui.painter().hline(through, y, Stroke::new(1.0, text));
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

fn symbol(entry: &Entry, color: Color32) -> Vec<Shape> {
    let square = Rect::from_center_size(egui::Pos2::ZERO, vec2(9.0, 9.0));
    let ends = [-0.5, 0.5].map(|end| pos2(end * SIGN, 0.0));
    let line = Stroke::new(1.8, color);
    match (entry.sign, entry.filled) {
        (LegendSymbol::Mark(form), filled) => {
            let fill = if filled { color } else { Color32::TRANSPARENT };
            vec![mark(
                square.center(),
                3.4,
                form,
                fill,
                Stroke::new(1.2, color),
            )]
        }
        (LegendSymbol::Band, _) => {
            vec![Shape::rect_filled(square, 1.0, color.gamma_multiply(0.3))]
        }
        (LegendSymbol::Bar, true) => vec![Shape::rect_filled(square, 1.0, color)],
        (LegendSymbol::Bar, false) => {
            let edge = Stroke::new(1.5, color);
            vec![Shape::rect_stroke(square, 1.0, edge, StrokeKind::Inside)]
        }
        (LegendSymbol::Line, true) => vec![Shape::line_segment(ends, line)],
        (LegendSymbol::Line, false) => Shape::dashed_line(&ends, line, 3.5, 2.0),
    }
}
