//! The middle: the workspace, and below it a chart with the bar in which it is chosen.

use egui::{
    Align, CentralPanel, ComboBox, CursorIcon, Frame, Layout, Margin, Panel, Rect, Shape, Stroke,
    StrokeKind, Ui, pos2, vec2,
};

use crate::gui::charts::{
    Bars, CHARTS, ChartChoice, ChartKind, HoverTarget, Samples, Scene, Shown, deviation,
};
use crate::gui::core::loaded_session::Component;
use crate::gui::plots::chart::Canvas;
use crate::gui::plots::{self, figure, picture};
use crate::gui::style::{Palette, size, space};
use crate::gui::view::{Front, Plot, Step};
use crate::gui::widgets::{self, Buttons, Does, Forms, MIDDLE, Words};
use crate::gui::workbench::Workbench;
use crate::gui::workspace::{self, Handles, marked, nearest};

use super::copies;

/// Room for the marks at the right end of the bar, points.
const MARKS: f32 = 112.0;
/// What a list has beside the name that is chosen, points.
const ARROW: f32 = 42.0;
/// A sample is under the pointer within this many points.
const REACH: f32 = 14.0;

/// Around a plot, points.
fn framed_plot(ui: &Ui) -> Frame {
    let margin = Margin::same(space::PLOT);
    Frame::NONE
        .fill(Palette::of(ui).surface)
        .inner_margin(margin)
}

/// The middle: the workspace, and the chart below it; where there is no room for both one of them, and a switch.
pub(crate) fn middle(ui: &mut Ui, workbench: &Workbench) {
    /// The least height of the workspace and of a chart with their bars, points: so much can be read.
    const WORKSPACE: f32 = 336.0;
    const CHART: f32 = 258.0;
    let high = ui.available_height();
    let frame = framed_plot(ui);
    if high < WORKSPACE + CHART || ui.available_width() < MIDDLE {
        CentralPanel::no_frame().frame(frame).show(ui, |ui| {
            if workbench.view.front == Front::Chart {
                ui.row(|ui| switch(ui, workbench));
                show(ui, workbench);
            } else {
                workspace::bar(ui, workbench, Some(switch));
                workspace::show(ui, workbench);
            }
        });
        return;
    }
    // Of a window of another height the chart has its share again.
    Panel::bottom(format!("chart {high}"))
        .resizable(true)
        .default_size((0.34 * high).max(CHART))
        .size_range(CHART..=high - WORKSPACE)
        .frame(frame)
        .show(ui, |ui| {
            show(ui, workbench);
            ui.take_available_height();
        });
    CentralPanel::no_frame().frame(frame).show(ui, |ui| {
        workspace::bar(ui, workbench, None);
        workspace::show(ui, workbench);
    });
}

/// Which of the two is shown where there is room for one only.
fn switch(ui: &mut Ui, workbench: &Workbench) {
    let names = [
        (Front::Workspace, say!("Workspace")),
        (Front::Chart, say!("Chart")),
    ];
    if let Some(front) = ui.segmented(&names, workbench.view.front) {
        workbench.then(move |bench| bench.view.front = front);
    }
}

fn show(ui: &mut Ui, workbench: &Workbench) {
    let kind = workbench.kind();
    bar(ui, workbench, kind, &workbench.scene());
    match workbench.charted() {
        Some(Ok(shown)) => plotted(ui, workbench, kind, shown),
        Some(Err(missing)) => plots::chart::empty(ui, &missing.title, &missing.why),
        None => plots::chart::empty(ui, say!("Computing…"), ""),
    }
}

fn plotted(ui: &mut Ui, workbench: &Workbench, kind: &dyn ChartKind, shown: &Shown) {
    let view = &workbench.view;
    let before = workbench.answer().map(|_| !view.only_after);
    plots::chart::legend(ui, &shown.chart, before, workbench);
    let title = format!("{} {}", kind.about().id, shown.chart.title);
    let fitted = view.fitted.charts;
    let id = (&*title, workbench.only_after(), fitted);
    let emphasised = view.hovered.or(view.selected);
    let usable = |sample: &usize| workbench.loaded_session().usable[*sample];
    let more = |canvas: &Canvas<'_>, shapes: &mut Vec<Shape>| match &shown.pointed {
        HoverTarget::Nothing => {}
        HoverTarget::Samples(samples) => {
            let there = marked(view, workbench.loaded_session().len()).chain(emphasised);
            drawn_samples(&**samples, there.filter(usable), canvas, shapes);
        }
        HoverTarget::Bars(bars) => {
            let bar = emphasised.filter(usable).and_then(|sample| bars.of(sample));
            shapes.extend(bar.map(|bar| framed(bar, canvas)));
        }
    };
    // Boundaries of regions are dragged where they stand over the joint's angle.
    let divided = view.step == Step::Regions
        && kind.about().id == deviation::ANGLE.about().id
        && workbench.loaded_session().single_revolute();
    if divided {
        workspace::grab(ui, workbench);
    }
    let (response, transform) = plots::chart::show(ui, id, &shown.chart, more);
    if divided {
        let per_rad = workbench.units().angle_value(1.0);
        let frame = *transform.frame();
        let top = frame.top() + 12.0;
        let handles = Handles {
            at: &|angle| {
                let x = transform.position_from_point_x(per_rad * angle);
                pos2(x, top)
            },
            angle: &|at, _| transform.value_from_position(at).x / per_rad,
            frame,
            name: |at| say!("in the chart, boundary at {at}", at),
        };
        workspace::boundary_handles(ui, workbench, &handles);
    }
    figure(&response, &shown.name, shown.description.clone());
    match &shown.pointed {
        HoverTarget::Nothing => {}
        HoverTarget::Samples(samples) => {
            let under = response.hover_pos().and_then(|pointer| {
                let reach = vec2(REACH, -REACH);
                let [low, high] = [pointer - reach, pointer + reach]
                    .map(|corner| transform.value_from_position(corner));
                let near = samples.near([low.x, high.x], [low.y, high.y]);
                let candidates = near.into_iter().flat_map(|sample| {
                    let marks = samples.marks(sample).into_iter();
                    let at = |[x, y]: [f64; 2]| {
                        transform.position_from_point(&egui_plot::PlotPoint::new(x, y))
                    };
                    marks.map(move |mark| (sample, at(mark)))
                });
                nearest(candidates, pointer, REACH)
            });
            workspace::hover(&response, workbench, under);
        }
        HoverTarget::Bars(bars) => pointed(response, &transform, &**bars, workbench),
    }
}

/// What is in sight of many samples, and a ring around some.
fn drawn_samples(
    samples: &dyn Samples,
    ringed: impl Iterator<Item = usize>,
    canvas: &Canvas<'_>,
    shapes: &mut Vec<Shape>,
) {
    let bounds = canvas.transform.bounds();
    for item in samples.in_sight([bounds.min()[0], bounds.max()[0]]) {
        canvas.draw(&item, shapes);
    }
    let stroke = Stroke::new(2.5, canvas.palette.accent);
    for place in ringed.filter_map(|sample| samples.marks(sample).pop()) {
        shapes.push(Shape::circle_stroke(canvas.at(place), 8.0, stroke));
    }
}

fn framed(ends: [f64; 2], canvas: &Canvas<'_>) -> Shape {
    let [from, to] = ends.map(|x| canvas.at([x, 0.0]).x);
    let rect = Rect::from_x_y_ranges(from..=to, canvas.transform.frame().y_range());
    let stroke = Stroke::new(2.0, canvas.palette.accent);
    Shape::rect_stroke(rect, 2.0, stroke, StrokeKind::Inside)
}

/// Says what the bar under the pointer is; a click marks its samples.
fn pointed(
    response: egui::Response,
    transform: &egui_plot::PlotTransform,
    bars: &dyn Bars,
    workbench: &Workbench,
) {
    let pointer = response.hover_pos();
    let under = pointer.map(|pointer| transform.value_from_position(pointer).x);
    let Some(facts) = under.and_then(|x| bars.at(x)) else {
        return;
    };
    let response = if facts.samples.is_empty() {
        response
    } else {
        response.does(workbench, move |bench| {
            bench.view.mark(facts.samples.clone());
        });
        response.on_hover_cursor(CursorIcon::PointingHand)
    };
    response.on_hover_ui_at_pointer(|ui| {
        widgets::facts(ui, &(facts.title, facts.lines));
    });
}

/// Width of a list in the bar that shows this, points.
fn width(ui: &Ui, shown: &str) -> f32 {
    widgets::width_of(ui, shown, egui::FontId::proportional(size::SMALL)) + ARROW
}

/// A list in the bar, by its name, with what is chosen as it is shown there.
fn list<T: Copy + PartialEq + Send + 'static, N: AsRef<str>>(
    ui: &mut Ui,
    workbench: &Workbench,
    (of, shown): (&str, &str),
    (offered, current): (impl IntoIterator<Item = (T, N)>, T),
    does: impl FnOnce(&mut Workbench, T) + Send + 'static,
) {
    let list = ComboBox::from_id_salt(of)
        .selected_text(egui::RichText::new(shown).small())
        .width(0.0)
        .height(360.0);
    let chosen = widgets::list(ui, of, list, offered, current);
    if let Some(chosen) = chosen.filter(|chosen| *chosen != current) {
        workbench.then(move |bench| does(bench, chosen));
    }
}

/// Whether a component and whether a joint is chosen for a chart, and what they are called now.
fn chosen<'a>(scene: &'a Scene, kind: &dyn ChartKind) -> [Option<&'a str>; 2] {
    use ChartChoice::{Axis, Component, Joint};
    let of = kind.about().of;
    let joints = &scene.loaded_session.session.robot.joints;
    let joint = matches!(of, Axis | Joint) && joints.len() > 1;
    [
        matches!(of, Component | Joint).then(|| scene.component.name()),
        joint.then(|| &*joints[scene.joint()].name),
    ]
}

/// What is chosen for a chart beside itself.
fn others(ui: &mut Ui, workbench: &Workbench, kind: &dyn ChartKind, scene: &Scene) {
    let session = &scene.loaded_session.session;
    let [component, joint] = chosen(scene, kind);
    if let Some(shown) = component {
        let planar = session.samples.z_mm.is_none();
        let offered = Component::ALL.into_iter();
        let offered = offered.filter(|c| !(planar && c.out_of_plane()));
        let offered = (offered.map(|c| (c, c.name())), scene.component);
        let named = (say!("Component"), shown);
        list(ui, workbench, named, offered, |bench, c| {
            bench.view.component = c;
        });
    }
    if let Some(shown) = joint {
        let offered = session.robot.joints.iter().map(|joint| &joint.name);
        let offered = (offered.enumerate(), scene.joint());
        let named = (say!("Joint of the chart"), shown);
        list(ui, workbench, named, offered, |bench, joint| {
            bench.view.joint = joint;
        });
    }
}

fn bar(ui: &mut Ui, workbench: &Workbench, kind: &dyn ChartKind, scene: &Scene) {
    let about = kind.about();
    // What there is no room for stands below.
    let chosen = chosen(scene, kind).into_iter().flatten();
    let beside: f32 = chosen.map(|name| width(ui, name) + space::ROW).sum();
    let name = about.name();
    let room = ui.available_width() - beside - MARKS;
    let below = beside > 0.0 && room < width(ui, &name);
    ui.row(|ui| {
        ui.spacing_mut().item_spacing.x = space::ROW;
        let offered = CHARTS.iter().filter(|chart| chart.is_offered(scene));
        let offered = offered.map(|chart| (chart.about().id, chart.about().name()));
        let named = (say!("Choose chart"), &*name);
        list(
            ui,
            workbench,
            named,
            (offered, about.id),
            Workbench::show_chart,
        );
        if !below {
            others(ui, workbench, kind, scene);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = space::TIGHT;
            picture(ui, Plot::Chart(about.id), workbench);
            if plots::fit(ui, say!("Fit chart to view")) {
                workbench.then(|bench| bench.view.fitted.charts += 1);
            }
            copies::chart_button(ui, &about, workbench);
            ui.question(about.word);
        });
    });
    if below {
        ui.horizontal_wrapped(|ui| others(ui, workbench, kind, scene));
    }
}
