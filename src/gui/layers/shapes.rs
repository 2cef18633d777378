//! The heat map where there is nothing to draw with but egui: a net of coloured corners.

use egui::epaint::Mesh;
use egui_plot::{PlotPoint, PlotTransform};

use crate::gui::style::tokens::Palette;
use crate::gui::view::Colouring;

use super::frame::{HEAT, Look, scale_at};
use crate::gui::cache::heat::{Heat, blended};
use crate::numeric::single;

/// Corners along each side.
const CORNERS: u32 = 64;

/// The map over the rectangle that it has.
pub(crate) fn mesh(heat: &Heat, look: &Look, palette: &Palette, transform: &PlotTransform) -> Mesh {
    let mut mesh = Mesh::default();
    let sides = heat.size.map(|n| (n.max(2) - 1) as f64 * heat.cell_mm);
    let part = |k: u32| f64::from(k) / f64::from(CORNERS - 1) * (1.0 - 1e-9);
    for (row, column) in (0..CORNERS).flat_map(|row| (0..CORNERS).map(move |column| (row, column)))
    {
        let x = heat.first_mm[0] + part(column) * sides[0];
        let y = heat.first_mm[1] + part(row) * sides[1];
        let cell = heat.at([x, y]);
        let rms_mm = blended(cell, f64::from(look.blend));
        let color = scale_at(Colouring::Deviation, palette, single(rms_mm / look.long_mm));
        let color = color.gamma_multiply(HEAT * single(cell[3]));
        mesh.colored_vertex(transform.position_from_point(&PlotPoint::new(x, y)), color);
        if row > 0 && column > 0 {
            let here = row * CORNERS + column;
            let [left, below] = [here - 1, here - CORNERS];
            mesh.add_triangle(here, left, below);
            mesh.add_triangle(left, below, below - 1);
        }
    }
    mesh
}
