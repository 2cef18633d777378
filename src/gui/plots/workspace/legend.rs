//! The scale of the vectors, what the marks mean, and what is not shown.

use egui::{Align2, Color32, FontId, Pos2, Rect, Shape, Stroke, Ui, pos2, vec2};
use egui_plot::PlotTransform;

use crate::gui::commands::Workbench;
use crate::gui::plots::{marks, thinned};
use crate::gui::tokens::{Palette, size};
use crate::gui::units::trimmed;
use crate::gui::view::{Canvas, Colouring};

use super::layout;
use super::model::Scene;
use super::scales;

/// The longest that the scale's arrow gets, points.
const LONGEST_SCALE: f64 = 90.0;

/// The scale of the vectors, what the marks mean, and what is not shown.
pub(super) fn show(
    ui: &mut Ui,
    scene: &Scene,
    transform: &PlotTransform,
    workbench: &Workbench,
    palette: &Palette,
) {
    let units = workbench.units();
    let frame = *transform.frame();
    let painter = ui.painter().with_clip_rect(frame);
    let font = FontId::proportional(size::SMALL);
    let points_per_mm = transform.dpos_dvalue_x().abs();
    let mm = layout::scale_mm(scene.magnification, points_per_mm, LONGEST_SCALE);
    let long = points_from(mm * scene.magnification * points_per_mm);
    let corner = frame.left_top() + vec2(12.0, 16.0);
    let color = if scene.look.colouring != Colouring::State {
        palette.muted
    } else if scene.look.answered {
        palette.after
    } else {
        palette.before
    };
    let mut shapes = Vec::new();
    marks::arrow(
        &mut shapes,
        corner,
        corner + vec2(long, 0.0),
        Stroke::new(2.0, color),
    );
    painter.extend(shapes);
    let says = format!(
        "{} {}",
        trimmed(units.length_value(mm), 6),
        units.length_name()
    );
    painter.text(
        corner + vec2(long + 8.0, 0.0),
        Align2::LEFT_CENTER,
        says,
        font.clone(),
        palette.muted,
    );
    let notes = if scene.canvas == Canvas::Shapes {
        let thinned = [
            thinned(scene.arrow_stride, "arrow"),
            thinned(scene.point_stride, "point"),
        ];
        thinned.into_iter().flatten().collect()
    } else {
        layout::drawn(scene, layout::counts(scene, transform))
    };
    for (line, note) in notes.into_iter().enumerate() {
        let at = corner + vec2(0.0, 18.0 * (line + 1) as f32);
        let galley = painter.layout_no_wrap(note, font.clone(), palette.muted);
        let place = Align2::LEFT_CENTER.anchor_size(at, galley.size());
        let back = place.expand2(vec2(3.0, 1.0));
        painter.rect_filled(back, 2.0, palette.surface.gamma_multiply(0.85));
        painter.galley(place.min, galley, palette.muted);
    }
    meanings(ui, frame, workbench, scene, palette);
    scales::show(ui, frame, scene, workbench, palette);
}

/// A mark of the legend.
#[derive(Clone, Copy)]
enum Sign {
    Line(Color32, f32),
    Disc(Color32),
    Diamond(Color32),
}

impl Sign {
    fn shape(self, at: Pos2, palette: &Palette) -> Shape {
        match self {
            Self::Line(color, width) => {
                let half = vec2(7.0, 0.0);
                Shape::line_segment([at - half, at + half], Stroke::new(width, color))
            }
            Self::Disc(color) => marks::disc(at, 2.8, color),
            Self::Diamond(color) => {
                marks::diamond(at, 4.2, palette.surface, Stroke::new(1.4, color))
            }
        }
    }
}

/// What the marks mean, from right to left along the lower edge.
fn meanings(ui: &Ui, frame: Rect, workbench: &Workbench, scene: &Scene, palette: &Palette) {
    let painter = ui.painter().with_clip_rect(frame);
    let mut entries = Vec::new();
    if !scene.paths_mm.is_empty() {
        entries.push(("nominal path", Sign::Line(palette.nominal, 1.25)));
    }
    if scene.look.ghosts() {
        let faint = palette.before.gamma_multiply(0.5);
        entries.push(("before", Sign::Line(faint, 1.5)));
        entries.push(("after", Sign::Line(palette.after, 1.8)));
    }
    if workbench.document().tolerance_mm.is_some() {
        entries.push(("within", Sign::Disc(palette.within)));
        entries.push(("outside", Sign::Diamond(palette.outside)));
    } else {
        entries.push(("measured", Sign::Disc(palette.text)));
    }
    let font = FontId::proportional(size::SMALL);
    let mut right = frame.right() - 12.0;
    let y = frame.bottom() - 14.0;
    for (name, sign) in entries.into_iter().rev() {
        let galley = painter.layout_no_wrap(name.to_owned(), font.clone(), palette.muted);
        let place = Align2::RIGHT_CENTER.anchor_size(pos2(right, y), galley.size());
        let back = place.expand2(vec2(3.0, 2.0));
        let back = back.with_min_x(back.left() - 22.0);
        painter.rect_filled(back, 2.0, palette.surface.gamma_multiply(0.8));
        painter.galley(place.min, galley, palette.muted);
        painter.add(sign.shape(pos2(place.left() - 12.0, y), palette));
        right = place.left() - 32.0;
    }
}

/// A length on the screen.
#[allow(
    clippy::cast_possible_truncation,
    reason = "a length on the screen is a small number"
)]
fn points_from(length: f64) -> f32 {
    length as f32
}
