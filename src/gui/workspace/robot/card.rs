//! The joint values on a card beside the tool.

use egui::{Pos2, Rect, Stroke, Ui, Vec2, pos2, vec2};

use crate::gui::scene::Camera;
use crate::gui::style::tokens::{Palette, size};
use crate::present::numbers::trimmed;

use super::super::free_space;
use super::model::Drawn;

/// The joint values beside the tool, where they are least in the way; only said, not `written`,
/// where the card at the pointer has them.
pub(crate) fn values(
    ui: &mut Ui,
    camera: &Camera,
    drawn: &Drawn,
    written: bool,
    obstacles: &[Pos2],
    palette: &Palette,
) {
    const MOST: usize = 8;
    let says = drawn.describe();
    let frame = camera.frame();
    let chain = drawn.corners_mm.iter();
    let chain: Vec<Pos2> = chain.map(|p| camera.at(p.coords.into())).collect();
    let tool = chain.last().copied();
    let Some(tool) = tool.filter(|t| written && frame.contains(*t)) else {
        label(
            ui,
            Rect::from_min_size(frame.left_top(), Vec2::splat(1.0)),
            &says,
        );
        return;
    };
    let font = egui::FontId::proportional(size::SMALL);
    let row = |text: String, color| ui.painter().layout_no_wrap(text, font.clone(), color);
    let title = drawn
        .sample
        .map(|sample| say!("sample {sample}", sample = sample + 1));
    let head = title.map(|title| row(title, palette.muted));
    let mut rows: Vec<_> = drawn
        .values
        .iter()
        .take(MOST)
        .map(|(name, value)| row(format!("{name} {value}"), palette.text))
        .collect();
    if drawn.values.len() > MOST {
        rows.push(row(
            say!("and {more} more", more = drawn.values.len() - MOST),
            palette.muted,
        ));
    }
    if let Some(real) = &drawn.real {
        let what = if real.identified {
            say!("identified")
        } else {
            say!("measured")
        };
        rows.push(row(
            format!("{what} × {}", trimmed(real.times, 2)),
            palette.muted,
        ));
    }
    rows.splice(0..0, head);
    let high: f32 = rows.iter().map(|r| r.size().y).sum();
    let wide = rows.iter().map(|r| r.size().x).fold(0.0, f32::max);
    let card = vec2(wide + 12.0, high + 6.0);
    let places = free_space::everywhere(tool, card, 16.0, frame);
    let along = |pair: &[Pos2]| {
        let (from, to) = (pair[0], pair[1]);
        (0..=8_u8).map(move |k| from.lerp(to, f32::from(k) / 8.0))
    };
    let chain: Vec<Pos2> = chain.windows(2).flat_map(along).collect();
    let Some(place) = free_space::freest(&places, frame, &[obstacles, &chain, &chain, &chain])
    else {
        label(ui, Rect::from_center_size(tool, Vec2::splat(1.0)), &says);
        return;
    };
    let painter = ui.painter().with_clip_rect(frame);
    painter.rect(
        place,
        4.0,
        palette.surface.gamma_multiply(0.9),
        Stroke::new(1.0, palette.line),
        egui::StrokeKind::Inside,
    );
    let mut at = place.min + vec2(6.0, 3.0);
    for galley in rows {
        let next = at.y + galley.size().y;
        painter.galley(at, galley, palette.text);
        at = pos2(at.x, next);
    }
    label(ui, place, &says);
}

/// A line for screen readers.
fn label(ui: &Ui, place: Rect, says: &str) {
    let id = ui.scope_id().with("robot");
    let response = ui.interact(place, id, egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, says));
}
