//! A chart on the screen.

use egui::epaint::Mesh;
use egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Response, Shape, Stroke, StrokeKind, Ui, pos2,
    vec2,
};
use egui_plot::{Axis, Plot, PlotPoint, PlotTransform};

use crate::gui::scene::dashes;
use crate::gui::style::tokens::{Palette, size};
use crate::present::chart::{Bar, Chart, ColourRole, Item, Ticks};
use crate::present::drawing::Anchor;

use super::{Drawing, gestures, marks, of_chart, places};

/// What something that stands for this is drawn in.
pub(super) fn color(stands: ColourRole, palette: &Palette) -> Color32 {
    match stands {
        ColourRole::Before => palette.before,
        ColourRole::After | ColourRole::Corrected => palette.after,
        ColourRole::Reference => palette.nominal,
        ColourRole::Tolerance => palette.within,
        ColourRole::Noise => palette.muted,
        ColourRole::Curve => palette.accent,
    }
}

/// Shows a chart, and more on top of it: what was done with it, and where it is. Charts of another
/// `id` are looked at anew.
pub(crate) fn show<'a>(
    ui: &mut Ui,
    id: (&str, bool, u64),
    chart: &'a Chart,
    more: impl Fn(&Canvas<'_>, &mut Vec<Shape>) + 'a,
) -> (Response, PlotTransform) {
    let palette = Palette::of(ui);
    let alone = !chart
        .items
        .iter()
        .any(|item| item.colour_role() == Some(ColourRole::After));
    let beside = label_width(ui.painter(), chart, &palette);
    // No closer than their numbers need, which are left out otherwise.
    let room = (ui.available_width() - beside.max(40.0)) / 50.0;
    let most = f64::from(room.clamp(3.0, 9.0));
    let plot = plot(id, chart, beside, most, &palette);
    let plotted = gestures::show(ui, plot, |plot| {
        let draw = move |ui: &Ui, transform: &PlotTransform, shapes: &mut Vec<Shape>| {
            let canvas = Canvas {
                transform,
                painter: ui.painter(),
                palette: &palette,
                alone,
            };
            for item in &chart.items {
                canvas.draw(item, shapes);
            }
            more(&canvas, shapes);
        };
        plot.add(Drawing::new("chart", chart.bounds, draw));
    });
    (plotted.response, plotted.transform)
}

/// Room for the words beside a chart, points; none where it has numbers.
fn label_width(painter: &Painter, chart: &Chart, palette: &Palette) -> f32 {
    let Ticks::Words(words) = &chart.upwards.ticks else {
        return 0.0;
    };
    let font = FontId::proportional(size::SMALL);
    let wide = words.iter().map(|(_, word)| {
        let galley = painter.layout_no_wrap(word.clone(), font.clone(), palette.text);
        galley.size().x + 12.0
    });
    wide.fold(0.0, f32::max)
}

fn plot<'a>(
    id: impl std::hash::Hash + std::fmt::Debug,
    chart: &Chart,
    label_width: f32,
    most: f64,
    palette: &Palette,
) -> Plot<'a> {
    let [across, upwards] = [&chart.across, &chart.upwards];
    let lines = [across, upwards].map(|axis| !matches!(axis.ticks, Ticks::Words(_)));
    let [x, y] = [across.ticks.clone(), upwards.ticks.clone()];
    gestures::plot(id)
        .set_margin_fraction(egui::Vec2::ZERO)
        .grid_color(palette.line)
        .show_grid(lines)
        .x_grid_spacer(move |input| places(&x, input.bounds, most))
        .y_grid_spacer(move |input| places(&y, input.bounds, 4.0))
        .custom_x_axes(of_chart(Axis::X, across, palette, 0.0))
        .custom_y_axes(of_chart(Axis::Y, upwards, palette, label_width))
}

/// What a chart is drawn on.
pub(crate) struct Canvas<'a> {
    pub(crate) transform: &'a PlotTransform,
    painter: &'a Painter,
    pub(crate) palette: &'a Palette,
    /// Whether there is nothing after to be seen through what was before.
    alone: bool,
}

/// A dash and the gap after it, points.
const DASH: [f32; 2] = [5.0, 3.5];

/// The lowest that a column gets, points.
const LEAST: f32 = 1.5;

impl Canvas<'_> {
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> Pos2 {
        self.transform.position_from_point(&PlotPoint::new(x, y))
    }

    pub(crate) fn draw(&self, item: &Item, shapes: &mut Vec<Shape>) {
        let palette = self.palette;
        let color = item
            .colour_role()
            .map_or(palette.muted, |s| color(s, palette));
        match item {
            Item::Band([low, high], _) => {
                let frame = self.transform.frame();
                let (low, high) = (self.at([0.0, *low]).y, self.at([0.0, *high]).y);
                let corners = [pos2(frame.left(), high), pos2(frame.right(), low)];
                let rect = Rect::from_two_pos(corners[0], corners[1]);
                shapes.push(Shape::rect_filled(rect, 0.0, color.gamma_multiply(0.14)));
            }
            Item::Bars(bars, _, filled) => {
                for [from, to] in bars {
                    let rect = Rect::from_two_pos(self.at(*from), self.at(*to));
                    if *filled {
                        shapes.push(Shape::rect_filled(rect, 0.0, color.gamma_multiply(0.85)));
                    } else {
                        let stroke = Stroke::new(1.3, color);
                        shapes.push(Shape::rect_filled(rect, 0.0, color.gamma_multiply(0.10)));
                        shapes.push(Shape::rect_stroke(rect, 0.0, stroke, StrokeKind::Inside));
                    }
                }
            }
            Item::Columns(bars, _, filled) => shapes.push(self.columns(bars, color, *filled)),
            Item::Line(points, _, width, dashed) => {
                let points: Vec<_> = points.iter().map(|p| self.at(*p)).collect();
                let stroke = Stroke::new(*width, color);
                if *dashed {
                    shapes.extend(dashes(&points, stroke, DASH));
                } else {
                    shapes.push(Shape::line(points, stroke));
                }
            }
            Item::Marks(marks, _, filled) => {
                let (fill, stroke, radius) = if *filled {
                    (color, Stroke::new(0.8, palette.surface), 3.4)
                } else if self.alone {
                    (color.gamma_multiply(0.35), Stroke::new(1.2, color), 3.2)
                } else {
                    let edge = Stroke::new(1.2, color.gamma_multiply(0.75));
                    (Color32::TRANSPARENT, edge, 3.2)
                };
                let places = marks.iter().map(|m| (self.at(m.at), m.form));
                let ctx = self.painter.ctx();
                marks::many(ctx, places, (radius, fill, stroke), shapes);
            }
            Item::Word(word) => {
                let font = FontId::proportional(size::SMALL);
                let galley = self.painter.layout_no_wrap(word.text.clone(), font, color);
                let [across, upwards] = [
                    match word.anchor {
                        Anchor::Start => egui::Align::Min,
                        Anchor::Middle => egui::Align::Center,
                        Anchor::End => egui::Align::Max,
                    },
                    if word.below {
                        egui::Align::Min
                    } else {
                        egui::Align::Center
                    },
                ];
                let anchor = Align2([across, upwards]);
                let rect = anchor.anchor_size(self.at(word.at), galley.size());
                shapes.push(Shape::galley(rect.min, galley, color));
            }
        }
    }

    /// All columns as one mesh: solid, or as a pale band with edges.
    fn columns(&self, bars: &[Bar], color: Color32, filled: bool) -> Shape {
        let mut mesh = Mesh::default();
        for [from, to] in bars {
            let rect = Rect::from_two_pos(self.at(*from), self.at(*to));
            let rect = rect.expand2(vec2(0.0, (0.5 * (LEAST - rect.height())).max(0.0)));
            if filled {
                mesh.add_colored_rect(rect, color.gamma_multiply(0.85));
                continue;
            }
            mesh.add_colored_rect(rect, color.gamma_multiply(0.3));
            for top in [rect.top(), rect.bottom() - LEAST] {
                let size = vec2(rect.width(), LEAST);
                let edge = Rect::from_min_size(pos2(rect.left(), top), size);
                mesh.add_colored_rect(edge, color);
            }
        }
        Shape::mesh(mesh)
    }
}
