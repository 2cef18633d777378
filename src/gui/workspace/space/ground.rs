//! What gives the view in space its bearings: a grid on the plane z = 0 of the base, and frames.

use egui::{Align2, FontId, Pos2, Shape, Stroke, Ui};

use crate::gui::core::scale::round_down;
use crate::gui::plots::marks;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::{Ball, Facing};

/// Squares of the grid from its middle to its edge, at least.
const SQUARES: f64 = 4.0;
/// Length of a frame's axis, points.
const AXIS: f64 = 34.0;

/// Side of a square of the grid, mm: round, and so that there are a few of them.
pub(super) fn square_mm(ball: &Ball) -> f64 {
    round_down(ball.radius_mm / SQUARES)
}

/// The grid under everything, in whole squares of the base frame: pairs of ends, mm.
pub(super) fn lines(ball: &Ball) -> Vec<[[f64; 3]; 2]> {
    let square = square_mm(ball);
    let ends = [0, 1].map(|k| {
        let reach = |sign: f64| (ball.centre_mm[k] + sign * ball.radius_mm) / square;
        [reach(-1.0).floor() * square, reach(1.0).ceil() * square]
    });
    let mut lines = Vec::new();
    for along in 0..2 {
        let [from, to] = ends[along];
        let [first, last] = ends[1 - along];
        let count = crate::numeric::whole((last - first) / square + 0.5);
        for n in 0..=count {
            let across = first + n as f64 * square;
            let at = |t: f64| {
                let mut p = [0.0; 3];
                p[along] = t;
                p[1 - along] = across;
                p
            };
            lines.push([at(from), at(to)]);
        }
    }
    lines
}

/// Draws the grid.
pub(super) fn grid(
    shapes: &mut Vec<Shape>,
    ball: &Ball,
    screen: &impl Fn([f64; 3]) -> Pos2,
    palette: &Palette,
) {
    for ends in lines(ball) {
        let through_origin = ends.iter().all(|p| p[0] == 0.0) || ends.iter().all(|p| p[1] == 0.0);
        let color = if through_origin {
            palette.line.lerp_to_gamma(palette.nominal, 0.4)
        } else {
            palette.line
        };
        shapes.push(Shape::line_segment(
            ends.map(screen),
            Stroke::new(1.0, color),
        ));
    }
}

/// A frame: where it is, its axes as unit vectors, and its name.
pub(super) struct Triad<'a> {
    pub(super) at_mm: [f64; 3],
    pub(super) axes: [[f64; 3]; 3],
    pub(super) name: &'a str,
}

/// Draws a frame with its axes' letters and its name; an axis that is looked along has none.
pub(super) fn frame(
    ui: &Ui,
    triad: &Triad<'_>,
    facing: &Facing,
    points_per_mm: f64,
    screen: &impl Fn([f64; 3]) -> Pos2,
    palette: &Palette,
) {
    let from = screen(triad.at_mm);
    let font = FontId::proportional(size::SMALL);
    let mut shapes = Vec::new();
    let mut below = from.y;
    for (axis, letter) in triad.axes.iter().zip(["x", "y", "z"]) {
        let [right, up] = facing.flat(*axis);
        if right.hypot(up) < 0.2 {
            continue;
        }
        let end = |points: f64| {
            screen([0, 1, 2].map(|k| triad.at_mm[k] + axis[k] * points / points_per_mm))
        };
        marks::arrow(&mut shapes, from, end(AXIS), Stroke::new(1.5, palette.text));
        let at = end(AXIS + 8.0);
        below = below.max(at.y + 6.0);
        ui.painter().text(
            at,
            Align2::CENTER_CENTER,
            letter,
            font.clone(),
            palette.text,
        );
    }
    ui.painter().extend(shapes);
    let at = egui::pos2(from.x, below + 2.0);
    ui.painter()
        .text(at, Align2::CENTER_TOP, triad.name, font, palette.muted);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_lies_on_the_base_in_round_squares_and_holds_everything() {
        let ball = Ball {
            centre_mm: [130.0, -70.0, 400.0],
            radius_mm: 910.0,
        };
        assert_eq!(square_mm(&ball), 200.0);
        let lines = lines(&ball);
        assert!(lines.iter().flatten().all(|p| p[2] == 0.0));
        for k in 0..2 {
            let of = |pick: fn(f64, f64) -> f64, start| {
                lines.iter().flatten().map(|p| p[k]).fold(start, pick)
            };
            let (low, high) = (of(f64::min, 1e9), of(f64::max, -1e9));
            assert!(low <= ball.centre_mm[k] - 910.0 && ball.centre_mm[k] + 910.0 <= high);
            assert_eq!((low % 200.0, high % 200.0), (0.0, 0.0));
        }
        // One of them goes through the origin in each direction.
        assert_eq!(
            lines
                .iter()
                .filter(|[a, b]| a[0] == 0.0 && b[0] == 0.0)
                .count(),
            1
        );
        assert!(lines.len() < 40);
    }
}
