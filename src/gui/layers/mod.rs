//! What the workspace shows once for each sample, for any number of samples: error vectors,
//! measured points, and between them the error as a heat map.
//!
//! The samples go to the graphics processor once, when they change; panning, zooming, turning to
//! another plane, blending from before to after and colouring change one small uniform. So a frame
//! costs the window the same for a hundred samples as for a million. What does take time is worked
//! out where sessions are read and answers are found, in the background.
//!
//! - Model: the samples as they are uploaded, in [`loaded_session`](crate::gui::core::loaded_session); `heat` (the error
//!   over the plane), in [`cache`](crate::gui::cache).
//! - Layout, here: where all of it goes in this frame, the uniform of all shaders, worked out without any of them;
//!   the heat map as a picture that lies in the plot.
//! - Paint: `gpu` (what egui calls back, in space by depth and in a picture of their own, and what stays on the
//!   graphics processor).

pub(crate) mod gpu;
#[cfg(test)]
mod tests;

use egui::{Color32, ColorImage, Rect, Shape, TextureId, pos2};
use egui_plot::{PlotPoint, PlotTransform};

use crate::numeric::single;

use crate::gui::cache::heat::Heat;
use crate::gui::style::{Palette, STOPS};
use crate::gui::view::Facing;

/// Rows of four numbers; `layers.wgsl` names them.
const ROWS: usize = 16;

/// Width of an error vector, points, at any zoom.
pub(crate) const WIDTH: f32 = 1.6;
/// How much of what is beneath the heat map hides.
pub(crate) const HEAT: f32 = 0.72;

/// How much of its colour what is farthest loses.
const FADE: f32 = 0.6;

/// What the layers show, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerOptions {
    pub(crate) facing: Facing,
    /// What is nearer or farther than the middle by no more than this is drawn by its depth, mm;
    /// `None`: depth does not count.
    pub(crate) deep_mm: Option<f64>,
    /// The middle of the cloud, mm.
    pub(crate) centre_mm: [f64; 3],
    /// Whether the deviations before are of another frame, so that they are not shown beside.
    pub(crate) framed: bool,
    /// From before, 0, to after, 1; 0 without an answer.
    pub(crate) blend: f32,
    pub(crate) answered: bool,
    /// How much longer than real the vectors are drawn.
    pub(crate) magnification: f64,
    /// The upper end of the scale of deviations, mm.
    pub(crate) long_mm: f64,
    /// How far a sample may be off, mm.
    pub(crate) tolerance_mm: Option<f64>,

    /// Size of marks, where 1 is the size of few.
    pub(crate) mark: f32,
}

impl LayerOptions {
    /// Whether the deviations before stand pale beside those that are shown: only where no colour
    /// has to be compared with theirs.
    pub(crate) fn ghosts(&self) -> bool {
        self.answered && self.blend > 0.0 && !self.framed
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    pub(crate) rows: [[f32; 4]; ROWS],
}

impl Frame {
    /// The frame of a plot. `pixels` is how many of the screen's pixels a point takes.
    pub(crate) fn new(
        look: &LayerOptions,
        palette: &Palette,
        transform: &PlotTransform,
        pixels: f32,
    ) -> Self {
        let axis = |[x, y, z]: [f64; 3], last: f64| [x, y, z, last].map(single);
        let middle = look.facing.flat(look.centre_mm);
        let at = transform.position_from_point(&PlotPoint::new(middle[0], middle[1]));
        let viewport = viewport(*transform.frame(), pixels);
        let [sx, sy] = [transform.dpos_dvalue_x(), transform.dpos_dvalue_y()];
        let tolerance = look.tolerance_mm.map_or(-1.0, single);
        let mut rows = [[0.0; 4]; ROWS];
        rows[0] = axis(look.facing.right, 0.0);
        rows[1] = axis(look.facing.up, 0.0);
        rows[2] = [
            single(sx) * pixels,
            single(sy) * pixels,
            at.x * pixels - viewport.left(),
            at.y * pixels - viewport.top(),
        ];
        // The last depends on whether the target wants linear colours.
        rows[3] = [viewport.width(), viewport.height(), pixels, 0.0];
        rows[4] = [look.blend, single(look.magnification), 0.0, tolerance];
        let answered = if look.answered { 1.0 } else { 0.0 };
        rows[5] = [0.0, answered, WIDTH, look.mark];
        rows[6] = [0.0, 0.0, 0.0, look.deep_mm.map_or(0.0, |_| FADE)];
        rows[7] = [viewport.left(), viewport.top(), 0.0, 0.0];
        let flat = if look.answered {
            palette.after
        } else {
            palette.before
        };
        rows[8] = straight(flat, 1.0);
        rows[9] = straight(palette.before, 0.38);
        rows[10] = straight(palette.text, 1.0);
        rows[11] = straight(palette.within, 1.0);
        rows[12] = straight(palette.outside, 1.0);
        rows[13] = straight(palette.surface, 1.0);
        rows[14] = straight(palette.warning, 1.0);
        rows[15] = look.deep_mm.map_or([0.0; 4], |deep| {
            axis(look.facing.towards, 0.5 / deep.max(1e-9))
        });

        Self { rows }
    }

    /// Width and height of what is drawn on, pixels; at least 1 and at most so many.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within what a texture can be"
    )]
    fn size(&self, most: u32) -> [u32; 2] {
        let [width, height, ..] = self.rows[3];
        [width, height].map(|side| side.clamp(1.0, most as f32) as u32)
    }
}

/// The heat map as a picture, a pixel for each cell: √((1−t)² |b|² + 2t(1−t) b·a + t² |a|²) at the blend t.
pub(crate) fn heat_map(heat: &Heat, look: &LayerOptions, palette: &Palette) -> ColorImage {
    let t = look.blend;
    let pixel = |[bb, ba, aa, opacity]: [f32; 4]| {
        let squared = (1.0 - t).powi(2) * bb + 2.0 * t * (1.0 - t) * ba + t * t * aa;
        let part = squared.max(0.0).sqrt() / single(look.long_mm.max(1e-12));
        // The map is of lengths, whatever the colour of vectors says.
        scale_at(palette, part).gamma_multiply(HEAT * opacity)
    };
    let rows = heat.cells.chunks(heat.size[0]).rev();
    ColorImage::new(heat.size, rows.flatten().map(|cell| pixel(*cell)).collect())
}

/// That picture where it goes in a plot: cells are where their middles are.
pub(crate) fn map_in_plot(heat: &Heat, picture: TextureId, transform: &PlotTransform) -> Shape {
    let corner = |cell: [f64; 2]| {
        let [x, y] = [0, 1].map(|k| heat.first_mm[k] + (cell[k] - 0.5) * heat.cell_mm);
        transform.position_from_point(&PlotPoint::new(x, y))
    };
    let ends = [[0.0; 2], heat.size.map(|n| n as f64)].map(corner);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    let rect = Rect::from_two_pos(ends[0], ends[1]);
    Shape::image(picture, rect, whole, Color32::WHITE)
}

/// The pixels that egui draws a plot's frame on.
fn viewport(frame: Rect, pixels: f32) -> Rect {
    let corner = |p: egui::Pos2| egui::pos2((p.x * pixels).round(), (p.y * pixels).round());
    Rect::from_min_max(corner(frame.min), corner(frame.max))
}

/// A colour of the scale, at 0 to 1.
pub(crate) fn scale_at(palette: &Palette, part: f32) -> Color32 {
    let place = part.clamp(0.0, 1.0) * (STOPS - 1) as f32;
    let first = crate::numeric::whole(f64::from(place)).min(STOPS - 2);
    palette.scale[first].lerp_to_gamma(palette.scale[first + 1], place - first as f32)
}

fn straight(color: Color32, opacity: f32) -> [f32; 4] {
    let [r, g, b] = [color.r(), color.g(), color.b()].map(|c| f32::from(c) / 255.0);
    [r, g, b, opacity]
}

#[cfg(test)]
mod frames {
    use super::*;
    use crate::gui::style::LIGHT;
    use egui_plot::PlotBounds;

    const LOOK: LayerOptions = LayerOptions {
        facing: Facing {
            right: [1.0, 0.0, 0.0],
            up: [0.0, 0.0, 1.0],
            towards: [0.0, -1.0, 0.0],
        },
        deep_mm: None,
        framed: false,
        centre_mm: [10.0, 20.0, 30.0],
        blend: 0.0,
        answered: false,
        magnification: 50.0,
        long_mm: 2.0,
        tolerance_mm: None,
        mark: 1.0,
    };

    /// A plot of 400 × 200 points at (30, 40), 200 mm wide.
    fn transform(middle: [f64; 2]) -> PlotTransform {
        let frame = Rect::from_min_size(egui::pos2(30.0, 40.0), egui::vec2(400.0, 200.0));
        let [x, y] = middle;
        let bounds = PlotBounds::from_min_max([x - 100.0, y - 50.0], [x + 100.0, y + 50.0]);
        PlotTransform::new(frame, bounds, false)
    }

    /// What the shader makes of a point, in pixels of the viewport.
    fn placed(frame: &Frame, p: [f64; 3]) -> [f32; 2] {
        let relative = [0, 1, 2].map(|k| single(p[k] - LOOK.centre_mm[k]));
        let along = |row: [f32; 4]| (0..3).map(|k| row[k] * relative[k]).sum::<f32>();
        let [sx, sy, ox, oy] = frame.rows[2];
        [
            ox + sx * along(frame.rows[0]),
            oy + sy * along(frame.rows[1]),
        ]
    }

    #[test]
    fn a_point_is_where_the_plot_has_it_at_any_pixel_density() {
        let transform = transform([12.0, 33.0]);
        for pixels in [1.0, 1.5, 2.0] {
            let frame = Frame::new(&LOOK, &LIGHT, &transform, pixels);
            for p in [[10.0, 0.0, 30.0], [-40.0, 7.0, 55.0]] {
                let expected = transform.position_from_point(&PlotPoint::new(p[0], p[2]));
                let corner = viewport(*transform.frame(), pixels).min;
                let [x, y] = placed(&frame, p);
                assert!((x + corner.x - pixels * expected.x).abs() < 1e-3);
                assert!((y + corner.y - pixels * expected.y).abs() < 1e-3);
            }
        }
    }

    #[test]
    fn both_axes_have_the_same_scale_and_up_is_up() {
        let frame = Frame::new(&LOOK, &LIGHT, &transform([0.0, 0.0]), 1.0);
        let [sx, sy, ..] = frame.rows[2];
        assert!((sx - 2.0).abs() < 1e-6 && (sy + 2.0).abs() < 1e-6);
    }

    #[test]
    fn zooming_changes_the_scale_and_not_the_width_of_lines() {
        let near = Frame::new(&LOOK, &LIGHT, &transform([0.0, 0.0]), 2.0);
        let frame = Rect::from_min_size(egui::pos2(30.0, 40.0), egui::vec2(400.0, 200.0));
        let bounds = PlotBounds::from_min_max([-1000.0, -500.0], [1000.0, 500.0]);
        let far = PlotTransform::new(frame, bounds, false);
        let far = Frame::new(&LOOK, &LIGHT, &far, 2.0);
        assert!((near.rows[2][0] / far.rows[2][0] - 10.0).abs() < 1e-4);
        assert_eq!(near.rows[5], far.rows[5]);
    }

    #[test]
    fn a_scale_goes_through_its_colours() {
        let sequence = |part| scale_at(&LIGHT, part);
        assert_eq!(sequence(-1.0), LIGHT.scale[0]);
        assert_eq!(sequence(2.0), LIGHT.scale[STOPS - 1]);
    }
}
