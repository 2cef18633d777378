//! The deviation charts in egui.

use egui::{Color32, Shape, Stroke, Ui, pos2};
use egui_plot::PlotTransform;

use crate::gui::cache::charts::over::{Over, Variable};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::scale::thinned;
use crate::gui::plots::chart_spec::Sketch;
use crate::gui::plots::legend::{self, Entry, Sign};
use crate::gui::plots::{Drawing, figure, gestures, marks};
use crate::gui::style::tokens::Palette;
use crate::gui::workbench::{Command, Workbench};
use crate::gui::workspace;

use super::columns::{self, Axes};
use super::layout::{self, Extent, Many};
use super::model::{Dot, Series, names};
use crate::gui::cache::charts::envelope::Envelope;

/// A sample is under the pointer within this many points.
const REACH: f32 = 14.0;
/// Of so many near it at most; more stand on one another.
const MOST_NEAR: usize = 400;

/// What the chart shows at present, and where.
pub(super) struct Shown<'a> {
    pub(super) workbench: &'a Workbench,
    pub(super) over: Over,
    pub(super) series: Series,
    pub(super) envelope: Option<&'a Envelope>,
    pub(super) only_after: bool,
    pub(super) extent: Extent,
    pub(super) band: Option<[f64; 2]>,
    pub(super) axes: Axes,
}

impl<'a> Shown<'a> {
    pub(super) fn of(workbench: &'a Workbench, over: Over) -> Self {
        let view = workbench.view();
        let units = workbench.units();
        let series = Series::of(workbench, over);
        let only_after = workbench.only_after();
        let envelope = workbench.envelope();
        let extent = layout::extent(&series, envelope, only_after);
        let band = layout::band(&series, &extent, view.component == Component::Length);
        let span = extent.x[1] - extent.x[0];
        let scale = over.scale(workbench.subject(), units, span);
        Self {
            workbench,
            over,
            series,
            envelope,
            only_after,
            extent,
            band,
            axes: Axes { units, scale },
        }
    }

    /// What stands below, with the unit.
    pub(super) fn across(&self) -> String {
        let label = self.over.label(self.workbench.subject());
        format!("{label}, {}", self.axes.scale.unit)
    }

    pub(super) fn upwards(&self) -> String {
        let name = self.workbench.view().component.name();
        format!("{name}, {}", self.axes.units.length_name())
    }

    pub(super) fn dots(&self, samples: &[usize]) -> Vec<Dot> {
        let dot = |sample: &usize| Dot::of(self.workbench, self.over, *sample);
        samples.iter().map(dot).collect()
    }

    /// What is drawn of many samples between two places of the chart; `None` where all are drawn.
    pub(super) fn in_sight(&self, shown: [f64; 2], points: f64) -> Option<Many> {
        let x = shown.map(|x| self.axes.scale.inner(x));
        let envelope = self.envelope?;
        Some(layout::in_sight(envelope, x, points))
    }

    pub(super) fn in_frame(&self, transform: &PlotTransform) -> Option<Many> {
        let bounds = transform.bounds();
        let shown = [bounds.min()[0], bounds.max()[0]];
        self.in_sight(shown, f64::from(transform.frame().width()))
    }

    /// What has to be said.
    pub(super) fn note(&self, many: bool) -> String {
        let mut notes = Vec::new();
        let joints = &self.workbench.subject().session.robot.joints;
        let component = self.workbench.view().component;
        let polar = [Component::Tangential, Component::Radial, Component::Axial];
        if let [first, _, ..] = joints.as_slice()
            && polar.contains(&component)
        {
            // The axis below may be another joint's.
            notes.push(format!("{} to {}", component.name(), first.name));
        }
        let [low, high] = layout::along(&self.series, self.envelope);
        if low == high && self.over.variable != Variable::Joint {
            let what = self.over.label(self.workbench.subject());
            notes.push(format!("the {what} never changes"));
        }
        if many {
            notes.push("from the smallest to the largest in each column".to_owned());
        } else if self.envelope.is_none() {
            notes.extend(thinned(self.series.stride, "point"));
        }
        match self.series.unplaced {
            0 => {}
            1 => notes.push("one sample has no value and is not shown".to_owned()),
            n => notes.push(format!("{n} samples have no value and are not shown")),
        }
        notes.join(" · ")
    }

    /// What is seen, in words.
    pub(super) fn says(&self) -> String {
        let units = self.axes.units;
        let all = layout::whole(&self.series, self.envelope);
        let between = |mm: [f64; 2]| format!("{} to {}", units.length(mm[0]), units.length(mm[1]));
        let Some(all) = all else {
            return "no sample to show".to_owned();
        };
        let count = self.workbench.subject().overview.usable.len() - self.series.unplaced;
        let mut says = format!(
            "{} deviation of {count} samples over {} from {} to {}",
            self.workbench.view().component.name(),
            self.over.label(self.workbench.subject()),
            self.axes.scale.says(all.x[0]),
            self.axes.scale.says(all.x[1]),
        );
        for (name, mm) in [("before", all.before_mm), ("after", all.after_mm)] {
            if let Some(mm) = mm {
                says += &format!(", {name} {}", between(mm));
            }
        }
        if let Some(tolerance) = self.series.tolerance_mm {
            says += &format!(", tolerance {}", units.length(tolerance));
        }
        says
    }
}

/// Whether no sample has a place along the chart. Of many the background knows.
pub(super) fn is_missing(workbench: &Workbench, over: Over) -> bool {
    match workbench.envelope() {
        Some(envelope) => envelope.placed() == 0,
        None => over.is_missing(workbench.subject()),
    }
}

/// Shows the chart in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, over: Over, commands: &mut Vec<Command>) {
    if is_missing(workbench, over) {
        let missing = over.needs();
        return legend::empty(ui, missing.title, missing.why);
    }
    let palette = Palette::of(ui);
    let view = workbench.view();
    let shown = Shown::of(workbench, over);
    let many = shown.envelope;
    let many = many.is_some_and(|envelope| layout::are_many(envelope, shown.extent.x));
    legend::show(
        ui,
        &shown.note(many),
        &entries(&shown, many, &palette),
        commands,
    );

    let corners = shown.axes.corners(&shown.extent);
    let frame = Sketch {
        title: String::new(),
        across: shown.across(),
        upwards: shown.upwards(),
        bounds: corners,
        degrees: shown.axes.scale.degrees,
        ticks: Vec::new(),
        inks: Vec::new(),
        legend: Vec::new(),
        note: String::new(),
    };
    let [short, name] = names(workbench.chart());
    let id = (short, view.component.name(), shown.only_after);
    let emphasised = view.hovered.or(view.selected);
    let drawn = &shown;
    let plot = frame.plot(id, view, &palette);
    let plotted = gestures::show(ui, plot, |plot| {
        let draw = move |transform: &PlotTransform, shapes: &mut Vec<Shape>| {
            let axes = &drawn.axes;
            ground(shapes, transform, drawn, &palette);
            match drawn.in_frame(transform) {
                None => dots(shapes, transform, &drawn.series.dots, drawn, &palette),
                Some(Many::Samples(samples)) => {
                    dots(shapes, transform, &drawn.dots(&samples), drawn, &palette);
                }
                Some(Many::Columns(columns)) => {
                    let only = drawn.only_after;
                    shapes.push(columns::mesh(transform, &columns, only, axes, &palette));
                }
            }
            let subject = workbench.subject();
            let marked = workspace::marked(view, subject.len()).chain(emphasised);
            for sample in marked.filter(|sample| subject.usable[*sample]) {
                let dot = Dot::of(workbench, over, sample);
                let mm = dot.after_mm.unwrap_or(dot.before_mm);
                if dot.x.is_finite() {
                    let here = transform.position_from_point(&axes.at(dot.x, mm));
                    shapes.push(marks::ring(here, 8.0, Stroke::new(2.5, palette.accent)));
                }
            }
        };
        plot.add(Drawing::new("deviation", corners, draw));
    });
    let (response, transform) = (plotted.response, plotted.transform);
    let component = view.component.name();
    let name = match over.variable {
        Variable::Joint => format!("deviation chart, {component}"),
        _ => format!("{} chart, {component}", name.to_lowercase()),
    };
    figure(&response, &name, shown.says());

    let under = response.hover_pos().and_then(|pointer| {
        let near = shown.envelope.map(|envelope| {
            let place = |x: f32| transform.value_from_position(pos2(x, pointer.y)).x;
            let around = [pointer.x - REACH, pointer.x + REACH];
            let around = around.map(|x| shown.axes.scale.inner(place(x)));
            shown.dots(&envelope.samples(around, MOST_NEAR).collect::<Vec<_>>())
        });
        let near = near.as_deref().unwrap_or(&shown.series.dots);
        under(near, &shown, &transform, pointer)
    });
    workspace::hover(&response, workbench, under, commands);
}

/// The sample whose mark is under the pointer.
fn under(
    dots: &[Dot],
    shown: &Shown,
    transform: &PlotTransform,
    pointer: egui::Pos2,
) -> Option<usize> {
    let candidates = dots.iter().flat_map(|dot| {
        let before = (!shown.only_after).then_some(dot.before_mm);
        let marks = before.into_iter().chain(dot.after_mm);
        marks.map(|mm| {
            let here = transform.position_from_point(&shown.axes.at(dot.x, mm));
            (dot.sample, [here.x, here.y])
        })
    });
    workspace::nearest(candidates, [pointer.x, pointer.y], REACH)
}

/// Tolerance, boundaries and zero.
fn ground(shapes: &mut Vec<Shape>, transform: &PlotTransform, shown: &Shown, palette: &Palette) {
    let frame = *transform.frame();
    let (axes, extent) = (&shown.axes, &shown.extent);
    let y = |mm: f64| transform.position_from_point(&axes.at(extent.x[0], mm)).y;
    if let Some([low, high]) = shown.band {
        let corners = [pos2(frame.left(), y(high)), pos2(frame.right(), y(low))];
        let rect = egui::Rect::from_two_pos(corners[0], corners[1]);
        let fill = palette.within.gamma_multiply(0.14);
        shapes.push(Shape::rect_filled(rect, 0.0, fill));
    }
    for boundary in &shown.series.boundaries_rad {
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
    shown: &Shown,
    palette: &Palette,
) {
    let axes = &shown.axes;
    let identified = dots.iter().any(|d| d.after_mm.is_some());
    if !shown.only_after {
        let (fill, edge) = if identified {
            (Color32::TRANSPARENT, palette.before.gamma_multiply(0.75))
        } else {
            (palette.before.gamma_multiply(0.35), palette.before)
        };
        for dot in dots {
            let here = transform.position_from_point(&axes.at(dot.x, dot.before_mm));
            let stroke = Stroke::new(1.2, edge);
            shapes.push(marks::pointing(here, 3.2, dot.side, fill, stroke));
        }
    }
    for dot in dots {
        if let Some(after) = dot.after_mm {
            let here = transform.position_from_point(&axes.at(dot.x, after));
            let stroke = Stroke::new(0.8, palette.surface);
            shapes.push(marks::pointing(here, 3.4, dot.side, palette.after, stroke));
        }
    }
}

fn entries(shown: &Shown, many: bool, palette: &Palette) -> Vec<Entry> {
    let of_many = shown.envelope.map(Envelope::sides);
    let sides = of_many.unwrap_or_else(|| shown.series.dots.iter().any(|d| d.side != 0.0));
    let clear = Color32::TRANSPARENT;
    let before = Sign::Dot(0.0, clear, palette.before);
    let mut entries = vec![Entry::before(shown.workbench, before)];
    if shown.workbench.answer().is_some() {
        let after = Sign::Dot(0.0, palette.after, palette.after);
        entries.push(Entry::new("after", after));
    }
    if sides && !many {
        let way = |side: f64| Sign::Dot(side, clear, palette.muted);
        entries.push(Entry::new("moving positive", way(1.0)));
        entries.push(Entry::new("negative", way(-1.0)));
    }
    if shown.band.is_some() {
        let band = Sign::Bar(palette.within.gamma_multiply(0.3), true);
        entries.push(Entry::new("tolerance", band));
    }
    entries
}
