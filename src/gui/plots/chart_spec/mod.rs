//! A chart as lines, bars and marks in its own coordinates, drawn by egui on the screen and as SVG
//! in a file: what is saved is what is seen.

mod svg;

use egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Response, Shape, Stroke, StrokeKind, Ui, pos2,
};
use egui_plot::{Plot, PlotPoint, PlotTransform};

use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::ViewState;

use super::{Drawing, axis, gestures, marks, named_axis, steps};

/// What something stands for; it decides the colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stands {
    /// The deviation before.
    Before,
    /// What is left.
    After,
    /// A reference: zero, a boundary.
    Reference,
    Tolerance,
    /// What noise alone does.
    Noise,
    /// The curve that a model has.
    Curve,
}

impl Stands {
    /// Its colour on the screen.
    pub(crate) fn color(self, palette: &Palette) -> Color32 {
        match self {
            Self::Before => palette.before,
            Self::After => palette.after,
            Self::Reference => palette.nominal,
            Self::Tolerance => palette.within,
            Self::Noise => palette.muted,
            Self::Curve => palette.accent,
        }
    }
}

/// A mark at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Mark {
    pub(crate) at: [f64; 2],
    /// Side from which the joint came; 0: a disc.
    pub(crate) side: f64,
}

/// One thing on it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Ink {
    /// Between two heights, from side to side.
    Band([f64; 2], Stands),
    /// From corner to corner, filled or outlined.
    Bar([f64; 2], [f64; 2], Stands, bool),
    /// Through its points; width in points of the screen, dashed or whole.
    Line(Vec<[f64; 2]>, Stands, f32, bool),
    /// Marks, filled or outlined.
    Marks(Vec<Mark>, Stands, bool),
    /// A word that begins, ends or stands in the middle at a place.
    Word([f64; 2], String, Align2),
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sketch {
    /// What it shows, in one line.
    pub(crate) title: String,
    /// What stands below, with the unit.
    pub(crate) across: String,
    /// What stands beside, with the unit.
    pub(crate) upwards: String,
    /// Smallest and largest corner.
    pub(crate) bounds: [[f64; 2]; 2],
    /// Whether the axis below is divided into parts of a turn.
    pub(crate) degrees: bool,
    /// What stands below, and where, if it is not the numbers themselves.
    pub(crate) ticks: Vec<(f64, String)>,
    /// Bottom first.
    pub(crate) inks: Vec<Ink>,
    /// What the marks are; filled or outlined.
    pub(crate) legend: Vec<(String, Stands, bool)>,
    /// What has to be said.
    pub(crate) note: String,
}

impl Sketch {
    /// The plot that it is drawn in.
    pub(crate) fn plot<'a>(
        &self,
        id: (&str, &str, bool),
        view: &ViewState,
        palette: &Palette,
    ) -> Plot<'a> {
        let degrees = self.degrees;
        let (places, labels) = (self.ticks.clone(), self.ticks.clone());
        let across = if labels.is_empty() {
            axis(egui_plot::Axis::X, self.across.clone(), palette, |x| x)
        } else {
            named_axis(self.across.clone(), palette, labels)
        };
        gestures::plot((id, view.fitted.chart))
            .set_margin_fraction(egui::Vec2::ZERO)
            .grid_color(palette.line)
            .show_grid([self.ticks.is_empty(), true])
            .x_grid_spacer(move |input| {
                if places.is_empty() {
                    return steps(input.bounds, degrees, 9.0);
                }
                let mark = |(value, _): &(f64, String)| egui_plot::GridMark {
                    value: *value,
                    step_size: 1.0,
                };
                places.iter().map(mark).collect()
            })
            .y_grid_spacer(|input| steps(input.bounds, false, 4.0))
            .custom_x_axes(across)
            .custom_y_axes(axis(
                egui_plot::Axis::Y,
                self.upwards.clone(),
                palette,
                |y| y,
            ))
    }

    /// Shows it in a plot, and more on top of it: what was done with the plot, and where it is.
    pub(crate) fn show<'a>(
        &'a self,
        ui: &mut Ui,
        plot: Plot<'a>,
        palette: &'a Palette,
        more: impl Fn(&PlotTransform, &mut Vec<Shape>) + 'a,
    ) -> (Response, PlotTransform) {
        let painter = ui.painter().clone();
        let plotted = gestures::show(ui, plot, |plot| {
            let draw = move |transform: &PlotTransform, shapes: &mut Vec<Shape>| {
                self.shapes(&painter, transform, palette, shapes);
                more(transform, shapes);
            };
            plot.add(Drawing::new("chart", self.bounds, draw));
        });
        (plotted.response, plotted.transform)
    }

    /// Draws it.
    pub(crate) fn shapes(
        &self,
        painter: &Painter,
        transform: &PlotTransform,
        palette: &Palette,
        shapes: &mut Vec<Shape>,
    ) {
        let frame = *transform.frame();
        let at = |p: [f64; 2]| transform.position_from_point(&PlotPoint::new(p[0], p[1]));
        for ink in &self.inks {
            match ink {
                Ink::Band([low, high], stands) => {
                    let (low, high) = (at([0.0, *low]).y, at([0.0, *high]).y);
                    let corners = [pos2(frame.left(), high), pos2(frame.right(), low)];
                    let fill = stands.color(palette).gamma_multiply(0.14);
                    shapes.push(Shape::rect_filled(
                        Rect::from_two_pos(corners[0], corners[1]),
                        0.0,
                        fill,
                    ));
                }
                Ink::Bar(from, to, stands, filled) => {
                    let rect = Rect::from_two_pos(at(*from), at(*to));
                    let color = stands.color(palette);
                    if *filled {
                        shapes.push(Shape::rect_filled(rect, 0.0, color.gamma_multiply(0.85)));
                    } else {
                        let stroke = Stroke::new(1.3, color);
                        shapes.push(Shape::rect_filled(rect, 0.0, color.gamma_multiply(0.10)));
                        shapes.push(Shape::rect_stroke(rect, 0.0, stroke, StrokeKind::Inside));
                    }
                }
                Ink::Line(points, stands, width, dashed) => {
                    let points: Vec<_> = points.iter().map(|p| at(*p)).collect();
                    let stroke = Stroke::new(*width, stands.color(palette));
                    if *dashed {
                        shapes.extend(dashes(&points, stroke));
                    } else {
                        shapes.push(Shape::line(points, stroke));
                    }
                }
                Ink::Marks(marks, stands, filled) => {
                    let color = stands.color(palette);
                    let (fill, stroke, radius) = if *filled {
                        (color, Stroke::new(0.8, palette.surface), 3.4)
                    } else {
                        let edge = Stroke::new(1.2, color.gamma_multiply(0.75));
                        (Color32::TRANSPARENT, edge, 3.2)
                    };
                    for mark in marks {
                        let here = at(mark.at);
                        shapes.push(marks::pointing(here, radius, mark.side, fill, stroke));
                    }
                }
                Ink::Word(place, text, anchor) => {
                    let font = FontId::proportional(size::SMALL);
                    let galley = painter.layout_no_wrap(text.clone(), font, palette.muted);
                    let rect = anchor.anchor_size(at(*place), galley.size());
                    shapes.push(Shape::galley(rect.min, galley, palette.muted));
                }
            }
        }
    }
}

/// A dash and the gap after it, points.
const DASH: [f32; 2] = [5.0, 3.5];

/// A dashed line through points that may be nearer to each other than a dash is long.
fn dashes(points: &[Pos2], stroke: Stroke) -> Vec<Shape> {
    let mut shapes = Vec::new();
    let mut dash: Vec<Pos2> = points.first().copied().into_iter().collect();
    let (mut drawn, mut left) = (true, DASH[0]);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        let mut length = from.distance(to);
        if !length.is_finite() {
            continue;
        }
        while length > left {
            from += (to - from) * (left / length);
            length -= left;
            dash.push(from);
            if drawn {
                shapes.push(Shape::line(std::mem::take(&mut dash), stroke));
            }
            dash = vec![from];
            drawn = !drawn;
            left = DASH[usize::from(!drawn)];
        }
        left -= length;
        dash.push(to);
    }
    if drawn && dash.len() > 1 {
        shapes.push(Shape::line(dash, stroke));
    }
    shapes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::style::tokens::DARK;

    #[test]
    fn dashes_have_one_length_however_near_the_points_are() {
        let ends = [pos2(0.0, 3.0), pos2(85.0, 3.0)];
        let fine: Vec<Pos2> = (0_u8..=170)
            .map(|k| pos2(0.5 * f32::from(k), 3.0))
            .collect();
        let lengths = |points: &[Pos2]| {
            let shapes = dashes(points, Stroke::new(1.0, DARK.text));
            let of = |shape: &Shape| shape.visual_bounding_rect().width();
            shapes.iter().map(of).collect::<Vec<f32>>()
        };
        let (few, many) = (lengths(&ends), lengths(&fine));
        assert_eq!(few.len(), 10);
        assert_eq!(many.len(), 10);
        for (a, b) in few.iter().zip(&many) {
            assert!((a - b).abs() < 1e-2, "{few:?} {many:?}");
        }
        assert!(dashes(&ends[..1], Stroke::new(1.0, DARK.text)).is_empty());
    }
}
