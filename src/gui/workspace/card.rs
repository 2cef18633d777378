//! The card beside the sample under the pointer: what matters of it, and everything once it is
//! chosen.

use std::sync::Arc;

use egui::{
    Area, Color32, Context, FontId, Galley, Id, Order, Pos2, Rect, Role, Sense, Stroke, StrokeKind,
    Vec2, WidgetInfo, pos2, vec2,
};

use crate::gui::style::tokens::{DARK, LIGHT, size, strong};
use crate::gui::workbench::Workbench;

use super::about::{Line, about, brief};
use super::free_space;

/// From the pointer to the card, points: a mark under the pointer is at most 14 away, and its ring
/// has a radius of 9.
const GAP: f32 = 26.0;
const MARGIN: Vec2 = vec2(10.0, 7.0);
/// Between a name and its value, and between two columns of both.
const BETWEEN: f32 = 12.0;
const COLUMNS: f32 = 18.0;
/// More lines than this stand in two columns.
const TALL: usize = 5;

pub(super) fn show(
    ctx: &Context,
    workbench: &Workbench,
    sample: usize,
    pointer: Pos2,
    frame: Rect,
) {
    let dark = ctx.global_style().visuals.dark_mode;
    let palette = if dark { DARK } else { LIGHT };
    let chosen = workbench.view().selected == Some(sample);
    let (title, lines) = if chosen {
        about(workbench, sample)
    } else {
        brief(workbench, sample)
    };
    let text = |text: &str, font: FontId, color: Color32| {
        ctx.fonts_mut(|fonts| fonts.layout_no_wrap(text.to_owned(), font, color))
    };
    let small = || FontId::proportional(size::SMALL);
    let head = text(&title, strong(size::BODY), palette.text);
    let hint = (!chosen).then(|| text(say!("click for more"), small(), palette.muted));
    let rows: Vec<[Arc<Galley>; 2]> = lines
        .iter()
        .map(|(name, value)| {
            [
                text(name, small(), palette.muted),
                text(value, small(), palette.text),
            ]
        })
        .collect();
    let sizes: Vec<[Vec2; 2]> = rows
        .iter()
        .map(|row| [row[0].size(), row[1].size()])
        .collect();
    let top = head.size().y + 4.0;
    let hint_wide = hint.as_ref().map_or(0.0, |hint| hint.size().x + BETWEEN);
    let least = head.size().x + hint_wide;
    let (places, wide, high) = places(&sizes, least);
    let all = vec2(wide, top + high) + 2.0 * MARGIN;
    let window = ctx.content_rect().shrink(4.0);
    let card = free_space::card(pointer, all, GAP, frame, window);
    let says = spoken(&title, &lines);
    let area = Area::new(Id::unique("sample card"))
        .order(Order::Tooltip)
        .fixed_pos(card.min)
        .constrain(false)
        .interactable(false);
    area.show(ctx, |ui| {
        let (rect, response) = ui.allocate_exact_size(all, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Tooltip, true, says.clone()));
        let painter = ui.painter();
        let edge = Stroke::new(1.0, palette.line);
        let round = f32::from(crate::gui::style::tokens::space::ROUND);
        painter.add(ui.visuals().popup_shadow.as_shape(rect, round));
        painter.rect(rect, round, palette.surface, edge, StrokeKind::Inside);
        let corner = rect.min + MARGIN;
        if let Some(hint) = hint {
            let y = corner.y + 0.5 * (head.size().y - hint.size().y);
            let x = rect.right() - MARGIN.x - hint.size().x;
            painter.galley(pos2(x, y), hint, palette.muted);
        }
        painter.galley(corner, head, palette.text);
        for (row, [name, value]) in rows.into_iter().zip(places) {
            let below = corner + vec2(0.0, top);
            let [a, b] = row;
            painter.galley(below + name, a, palette.muted);
            painter.galley(below + value, b, palette.text);
        }
    });
}

/// The card in one line.
fn spoken(title: &str, lines: &[Line]) -> String {
    let parts: Vec<String> = lines.iter().map(|(n, v)| format!("{n} {v}")).collect();
    say!(
        "card of {title}: {parts}",
        title = title,
        parts = parts.join(", ")
    )
}

/// Where names and values of these sizes stand, with values flush right in each column; and width
/// and height of all of it, at least so wide.
fn places(sizes: &[[Vec2; 2]], least: f32) -> (Vec<[Vec2; 2]>, f32, f32) {
    let columns = if sizes.len() > TALL { 2 } else { 1 };
    let in_one = sizes.len().div_ceil(columns).max(1);
    let wide = |column: &[[Vec2; 2]]| {
        let of = |k: usize| column.iter().map(|row| row[k].x).fold(0.0, f32::max);
        of(0) + BETWEEN + of(1)
    };
    let mut widths: Vec<f32> = sizes.chunks(in_one).map(wide).collect();
    let gaps = COLUMNS * widths.len().saturating_sub(1) as f32;
    let more = (least - widths.iter().sum::<f32>() - gaps).max(0.0);
    if let Some(last) = widths.last_mut() {
        *last += more;
    }
    let mut places = Vec::with_capacity(sizes.len());
    let (mut left, mut high) = (0.0, 0.0_f32);
    for (column, wide) in sizes.chunks(in_one).zip(&widths) {
        let mut y = 0.0;
        for [name, value] in column {
            places.push([vec2(left, y), vec2(left + wide - value.x, y)]);
            y += name.y.max(value.y) + 2.0;
        }
        high = high.max(y);
        left += wide + COLUMNS;
    }
    let all = widths.iter().sum::<f32>() + gaps;
    (places, all.max(least), high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_below_one_another_and_many_of_them_in_two_columns() {
        let row = [vec2(40.0, 14.0), vec2(60.0, 14.0)];
        let (few, wide, high) = places(&[row; 3], 0.0);
        assert_eq!((wide, high), (112.0, 48.0));
        assert!(few.windows(2).all(|pair| pair[1][0].y > pair[0][0].y));
        let (many, wide, high) = places(&[row; 12], 0.0);
        assert_eq!((wide, high), (242.0, 96.0));
        for [name, value] in &many {
            assert!(name.x + row[0].x <= value.x && value.x + row[1].x <= wide);
            assert!(value.y + row[1].y <= high);
        }
    }

    #[test]
    fn the_title_fits_even_where_there_is_nothing_to_say() {
        let (places, wide, high) = places(&[], 130.0);
        assert!(places.is_empty() && wide == 130.0 && high == 0.0);
    }
}
