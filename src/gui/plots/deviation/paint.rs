//! The deviation chart in egui.

use egui::{Align2, Color32, FontId, Role, Shape, Stroke, Ui, WidgetInfo, pos2};
use egui_plot::{Axis, Plot, PlotPoint, PlotTransform};

use crate::gui::commands::{Command, Workbench};
use crate::gui::plots::{Drawing, axis, marks, steps, thinned, workspace};
use crate::gui::subject::Component;
use crate::gui::tokens::{Palette, size};
use crate::gui::units::Units;
use crate::gui::view::AngleUnit;

use super::columns;
use super::envelope::Envelope;
use super::layout::{self, Extent, Many};
use super::model::{Dot, Series};

/// A sample is under the pointer within this many points.
const REACH: f32 = 14.0;
/// Of so many near it at most; more stand on one another.
const MOST_NEAR: usize = 400;

/// The chart's axes in the user's units.
#[derive(Clone, Copy)]
pub(super) struct Axes {
    units: Units,
    turns: bool,
}

impl Axes {
    fn along(self, q: f64) -> f64 {
        if self.turns {
            self.units.angle_value(q)
        } else {
            self.units.length_value(q)
        }
    }

    /// The value of the joint at a place of the chart.
    fn q(self, x: f64) -> f64 {
        x / self.along(1.0)
    }

    pub(super) fn at(self, q: f64, mm: f64) -> PlotPoint {
        PlotPoint::new(self.along(q), self.units.length_value(mm))
    }
}

/// Shows the chart in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let view = workbench.view();
    let units = workbench.units();
    let series = Series::of(workbench);
    let only_after = view.only_after && workbench.answer().is_some();
    let envelope = workbench.envelope();
    let extent = layout::extent(&series, envelope, only_after);
    let band = layout::band(&series, &extent, view.component == Component::Length);
    let axes = Axes {
        units,
        turns: series.turns,
    };
    let joint = &workbench.subject().session.robot.joints[0].name;
    let unit = if series.turns {
        units.angle_name().trim()
    } else {
        units.length_name()
    };
    let corners = [
        [axes.along(extent.q[0]), units.length_value(extent.mm[0])],
        [axes.along(extent.q[1]), units.length_value(extent.mm[1])],
    ];
    let degrees = series.turns && units.angle == AngleUnit::Degree;
    let across = format!("{joint}, {unit}");
    let upwards = format!("{}, {}", view.component.name(), units.length_name());
    let plot = Plot::new(("deviation", view.component.name(), only_after, view.fitted))
        .show_x(false)
        .show_y(false)
        .show_background(false)
        .show_crosshair(false)
        .set_margin_fraction(egui::Vec2::ZERO)
        .grid_color(palette.line)
        .x_grid_spacer(move |input| steps(input.bounds, degrees, 9.0))
        .y_grid_spacer(|input| steps(input.bounds, false, 4.0))
        .custom_x_axes(axis(Axis::X, across, &palette, |q| q))
        .custom_y_axes(axis(Axis::Y, upwards, &palette, |mm| mm));
    let emphasised = view.hovered.or(view.selected);
    let drawn = &series;
    // What is drawn of the samples between two places of the chart.
    let in_sight = |transform: &PlotTransform| {
        envelope.map(|envelope| {
            let bounds = transform.bounds();
            let q = [bounds.min()[0], bounds.max()[0]].map(|x| axes.q(x));
            layout::in_sight(envelope, q, f64::from(transform.frame().width()))
        })
    };
    let these = |samples: &[usize]| -> Vec<Dot> {
        let dot = |sample: &usize| Dot::of(workbench, *sample);
        samples.iter().map(dot).collect()
    };
    let shown = plot.show(ui, |plot| {
        plot.add(Drawing::new(
            "deviation",
            corners,
            move |transform, shapes| {
                ground(shapes, transform, drawn, &extent, band, axes, &palette);
                match in_sight(transform) {
                    None => dots(shapes, transform, &drawn.dots, only_after, axes, &palette),
                    Some(Many::Samples(samples)) => {
                        let these = these(&samples);
                        dots(shapes, transform, &these, only_after, axes, &palette);
                    }
                    Some(Many::Columns(columns)) => {
                        let mesh = columns::mesh(transform, &columns, only_after, axes, &palette);
                        shapes.push(mesh);
                    }
                }
                let subject = workbench.subject();
                let marked = workspace::marked(view, subject.len()).chain(emphasised);
                for sample in marked.filter(|sample| subject.usable[*sample]) {
                    let dot = Dot::of(workbench, sample);
                    let mm = dot.after_mm.unwrap_or(dot.before_mm);
                    let here = transform.position_from_point(&axes.at(dot.q, mm));
                    shapes.push(marks::ring(here, 8.0, Stroke::new(2.5, palette.accent)));
                }
            },
        ));
    });
    let (response, transform) = (shown.response, shown.transform);
    let name = view.component.name();
    response.widget_info(|| {
        WidgetInfo::labeled(Role::Figure, true, format!("deviation chart, {name}"))
    });
    let many = matches!(in_sight(&transform), Some(Many::Columns(_)));
    legend(ui, &transform, workbench, &series, many, &palette);

    let under = response.hover_pos().and_then(|pointer| {
        let near = envelope.map(|envelope| {
            let q = |x: f32| axes.q(transform.value_from_position(pos2(x, pointer.y)).x);
            let around = [q(pointer.x - REACH), q(pointer.x + REACH)];
            these(&envelope.samples(around, MOST_NEAR).collect::<Vec<_>>())
        });
        let near = near.as_deref().unwrap_or(&series.dots);
        under(near, only_after, axes, &transform, pointer)
    });
    workspace::hover(&response, workbench, under, commands);
}

/// The sample whose mark is under the pointer.
fn under(
    dots: &[Dot],
    only_after: bool,
    axes: Axes,
    transform: &PlotTransform,
    pointer: egui::Pos2,
) -> Option<usize> {
    let candidates = dots.iter().flat_map(|dot| {
        let before = (!only_after).then_some(dot.before_mm);
        let marks = before.into_iter().chain(dot.after_mm);
        marks.map(|mm| {
            let here = transform.position_from_point(&axes.at(dot.q, mm));
            (dot.sample, [here.x, here.y])
        })
    });
    workspace::nearest(candidates, [pointer.x, pointer.y], REACH)
}

/// Tolerance, boundaries and zero.
fn ground(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    series: &Series,
    extent: &Extent,
    band: Option<[f64; 2]>,
    axes: Axes,
    palette: &Palette,
) {
    let frame = *transform.frame();
    let y = |mm: f64| transform.position_from_point(&axes.at(extent.q[0], mm)).y;
    if let Some([low, high]) = band {
        let corners = [pos2(frame.left(), y(high)), pos2(frame.right(), y(low))];
        let rect = egui::Rect::from_two_pos(corners[0], corners[1]);
        let fill = palette.within.gamma_multiply(0.14);
        shapes.push(Shape::rect_filled(rect, 0.0, fill));
    }
    for boundary in &series.boundaries_rad {
        let x = transform.position_from_point(&axes.at(*boundary, 0.0)).x;
        let ends = [pos2(x, frame.top()), pos2(x, frame.bottom())];
        let stroke = Stroke::new(1.0, palette.nominal.gamma_multiply(0.6));
        shapes.extend(Shape::dashed_line(&ends, stroke, 3.0, 4.0));
    }
    let zero = [pos2(frame.left(), y(0.0)), pos2(frame.right(), y(0.0))];
    shapes.push(Shape::line_segment(zero, Stroke::new(1.0, palette.nominal)));
}

fn dots(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    dots: &[Dot],
    only_after: bool,
    axes: Axes,
    palette: &Palette,
) {
    let identified = dots.iter().any(|d| d.after_mm.is_some());
    if !only_after {
        let (fill, edge) = if identified {
            (Color32::TRANSPARENT, palette.before.gamma_multiply(0.75))
        } else {
            (palette.before.gamma_multiply(0.35), palette.before)
        };
        for dot in dots {
            let here = transform.position_from_point(&axes.at(dot.q, dot.before_mm));
            let stroke = Stroke::new(1.2, edge);
            shapes.push(marks::pointing(here, 3.2, dot.side, fill, stroke));
        }
    }
    for dot in dots {
        if let Some(after) = dot.after_mm {
            let here = transform.position_from_point(&axes.at(dot.q, after));
            let stroke = Stroke::new(0.8, palette.surface);
            shapes.push(marks::pointing(here, 3.4, dot.side, palette.after, stroke));
        }
    }
}

fn legend(
    ui: &Ui,
    transform: &PlotTransform,
    workbench: &Workbench,
    series: &Series,
    many: bool,
    palette: &Palette,
) {
    let frame = *transform.frame();
    let painter = ui.painter().with_clip_rect(frame);
    let font = FontId::proportional(size::SMALL);
    let identified = workbench.answer().is_some();
    let only_after = workbench.view().only_after && identified;
    let of_many = workbench.envelope().map(Envelope::sides);
    let sides = of_many.unwrap_or_else(|| series.dots.iter().any(|d| d.side != 0.0));
    let mut entries: Vec<(&str, f64, Color32, Color32)> = Vec::new();
    let clear = Color32::TRANSPARENT;
    if !only_after {
        entries.push(("before", 0.0, clear, palette.before));
    }
    if identified {
        entries.push(("after", 0.0, palette.after, palette.after));
    }
    if sides && !many {
        entries.push(("moving positive", 1.0, clear, palette.muted));
        entries.push(("negative", -1.0, clear, palette.muted));
    }
    let mut right = frame.right() - 12.0;
    let y = frame.top() + 12.0;
    for (name, side, fill, edge) in entries.into_iter().rev() {
        let galley = painter.layout_no_wrap(name.to_owned(), font.clone(), palette.muted);
        let place = Align2::RIGHT_CENTER.anchor_size(pos2(right, y), galley.size());
        let back = place.expand2(egui::vec2(2.0, 1.0));
        let back = back.with_min_x(back.left() - 18.0);
        painter.rect_filled(back, 2.0, palette.surface.gamma_multiply(0.85));
        painter.galley(place.min, galley, palette.muted);
        let mark = pos2(place.left() - 10.0, y);
        painter.add(marks::pointing(
            mark,
            3.4,
            side,
            fill,
            Stroke::new(1.2, edge),
        ));
        right = place.left() - 28.0;
    }
    let note = if many {
        Some("from the smallest to the largest in each column".to_owned())
    } else {
        thinned(series.stride, "point").filter(|_| of_many.is_none())
    };
    if let Some(note) = note {
        let at = frame.left_top() + egui::vec2(12.0, 12.0);
        painter.text(at, Align2::LEFT_CENTER, note, font, palette.muted);
    }
}
