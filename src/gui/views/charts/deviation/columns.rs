//! The axes of a deviation chart, and columns of extremes in egui: before as a pale band with edges, after as a solid one.

use egui::epaint::Mesh;
use egui::{Color32, Rect, Shape, pos2};
use egui_plot::{PlotPoint, PlotTransform};

use crate::gui::cache::charts::over::Scale;
use crate::gui::style::tokens::Palette;
use crate::gui::units::Units;

use super::layout::Extent;
use crate::gui::cache::charts::envelope::Column;

/// The chart's axes in the user's units.
#[derive(Clone)]
pub(super) struct Axes {
    pub(super) units: Units,
    pub(super) scale: Scale,
}

impl Axes {
    pub(super) fn at(&self, x: f64, mm: f64) -> PlotPoint {
        PlotPoint::new(self.scale.shown(x), self.units.length_value(mm))
    }

    pub(super) fn corners(&self, extent: &Extent) -> [[f64; 2]; 2] {
        [0, 1].map(|k| {
            let corner = self.at(extent.x[k], extent.mm[k]);
            [corner.x, corner.y]
        })
    }
}

/// The lowest that a column gets, points.
const LEAST: f32 = 1.5;

/// All columns as one mesh.
pub(super) fn mesh(
    transform: &PlotTransform,
    columns: &[Column],
    only_after: bool,
    axes: &Axes,
    palette: &Palette,
) -> Shape {
    let mut mesh = Mesh::default();
    let rect = |column: &Column, mm: [f64; 2]| {
        let [a, b] = [0, 1].map(|k| transform.position_from_point(&axes.at(column.x[k], mm[k])));
        let rect = Rect::from_two_pos(a, b);
        rect.expand2(egui::vec2(0.0, (0.5 * (LEAST - rect.height())).max(0.0)))
    };
    let before = columns.iter().filter(|_| !only_after);
    for column in before {
        if let Some(mm) = column.before_mm {
            let whole = rect(column, mm);
            add(&mut mesh, whole, palette.before.gamma_multiply(0.3));
            let [left, right] = [whole.left(), whole.right()];
            for [top, bottom] in [
                [whole.top(), whole.top() + LEAST],
                [whole.bottom() - LEAST, whole.bottom()],
            ] {
                let edge = Rect::from_min_max(pos2(left, top), pos2(right, bottom));
                add(&mut mesh, edge, palette.before);
            }
        }
    }
    for column in columns {
        if let Some(mm) = column.after_mm {
            add(
                &mut mesh,
                rect(column, mm),
                palette.after.gamma_multiply(0.85),
            );
        }
    }
    Shape::mesh(mesh)
}

fn add(mesh: &mut Mesh, rect: Rect, color: Color32) {
    mesh.add_colored_rect(rect, color);
}
