//! A chart in its pane: a bar in which it is chosen, and the chart.

use egui::{Align, ComboBox, CursorIcon, Layout, Rect, Shape, Stroke, StrokeKind, Ui, pos2, vec2};

use crate::gui::charts::{
    Bars, CHARTS, ChartChoice, ChartKind, HoverTarget, Samples, Scene, Shown, deviation,
};
use crate::gui::core::loaded_session::Component;
use crate::gui::plots::chart::Canvas;
use crate::gui::plots::{self, figure, picture, ring};
use crate::gui::style::{size, space};
use crate::gui::view::{ChartPane, Key, Plot, Step, What};
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;
use crate::gui::workspace::{self, Handles, marked, nearest};

use super::super::blocks;

/// Room for the handle, and for the marks at the right end of the bar, points.
const HANDLE: f32 = 32.0;
const MARKS: f32 = 148.0;
/// What a list has beside the name that is chosen, points.
const ARROW: f32 = 42.0;
/// A sample is under the pointer within this many points.
const REACH: f32 = 14.0;

/// Where a chart stands.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) key: Key,
    pub(super) pane: &'a ChartPane,
    /// Which of the charts it is, where there are several.
    pub(super) number: Option<usize>,
}

impl Place<'_> {
    /// What something of this chart is called, where others have the same.
    fn own(self, name: &str) -> String {
        match self.number {
            None => name.to_owned(),
            Some(number) => format!("{name}, {number}"),
        }
    }
}

/// What stands at the beginning of a bar.
pub(super) type First<'a> = &'a mut dyn FnMut(&mut Ui);

/// Shows it; `first` stands at the beginning of its bar.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, place: Place<'_>, first: First<'_>) {
    let kind = workbench.kind(place.pane);
    let scene = workbench.scene_in(place.pane);
    bar(ui, workbench, (place, kind, &scene), first);
    match kind.show(&scene) {
        Ok(shown) => plotted(ui, workbench, (place, kind), &shown),
        Err(missing) => plots::chart::empty(ui, &missing.title, missing.why),
    }
}

fn plotted(
    ui: &mut Ui,
    workbench: &Workbench,
    (place, kind): (Place<'_>, &dyn ChartKind),
    shown: &Shown<'_>,
) {
    let view = &workbench.view;
    let before = workbench.answer().map(|_| !view.only_after);
    plots::chart::legend(ui, &shown.chart, before, workbench);
    let title = format!("{} {}", kind.about().id, shown.chart.title);
    let fitted = view.fitted.charts + place.pane.fitted;
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
                    marks.map(move |[x, y]| (sample, egui_plot::PlotPoint::new(x, y)))
                });
                let candidates = candidates.map(|(sample, point)| {
                    let here = transform.position_from_point(&point);
                    (sample, [here.x, here.y])
                });
                nearest(candidates, [pointer.x, pointer.y], REACH)
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
        shapes.push(ring(canvas.at(place), 8.0, stroke));
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
    (of, shown): (String, &str),
    (offered, current): (impl IntoIterator<Item = (T, N)>, T),
    does: impl FnOnce(&mut Workbench, T) + Send + 'static,
) {
    let list = ComboBox::from_id_salt(&of)
        .selected_text(egui::RichText::new(shown).size(size::SMALL))
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

/// What is chosen for a chart beside itself. Of one that is alone the view keeps component and joint, so that the
/// workspace shows the same; of one of several its pane.
fn others(
    ui: &mut Ui,
    workbench: &Workbench,
    (place, kind, scene): (Place<'_>, &dyn ChartKind, &Scene),
) {
    let (key, alone) = (place.key, place.number.is_none());
    let session = &scene.loaded_session.session;
    let [component, joint] = chosen(scene, kind);
    if let Some(shown) = component {
        let of_view = alone && place.pane.component.is_none();
        let planar = session.samples.z_mm.is_none();
        let offered = Component::ALL.into_iter();
        let offered = offered.filter(|c| !(planar && c.out_of_plane()));
        let offered = (offered.map(|c| (c, c.name())), scene.component);
        let named = (place.own(say!("Component")), shown);
        list(ui, workbench, named, offered, move |bench, c| {
            if of_view {
                bench.view.component = c;
            } else {
                bench.change_chart(key, |pane| pane.component = Some(c));
            }
        });
    }
    if let Some(shown) = joint {
        let of_view = alone && place.pane.joint.is_none();
        let offered = session.robot.joints.iter().map(|joint| &joint.name);
        let named = (place.own(say!("Joint of the chart")), shown);
        let offered = (offered.enumerate(), scene.joint());
        list(ui, workbench, named, offered, move |bench, joint| {
            if of_view {
                bench.view.joint = joint;
            } else {
                bench.change_chart(key, |pane| pane.joint = Some(joint));
            }
        });
    }
}

fn bar(
    ui: &mut Ui,
    workbench: &Workbench,
    of: (Place<'_>, &dyn ChartKind, &Scene),
    first: First<'_>,
) {
    let (place, kind, scene) = of;
    let about = kind.about();
    // What there is no room for stands below, and the marks are in the menu of the handle as well.
    let chosen = chosen(scene, kind).into_iter().flatten();
    let beside: f32 = chosen.map(|name| width(ui, name) + space::ROW).sum();
    let beside_all = ui.available_width() - HANDLE - beside;
    let name = if beside_all - width(ui, about.name()) < MARKS {
        about.short()
    } else {
        about.name()
    };
    let room = beside_all - width(ui, name);
    widgets::row(ui, |ui| {
        ui.spacing_mut().item_spacing.x = space::ROW;
        first(ui);
        let scene = workbench.scene();
        let offered = CHARTS.iter().filter(|chart| chart.is_offered(&scene));
        let offered = offered.map(|chart| (chart.about().id, chart.about().name()));
        let (key, named) = (place.key, (place.own(say!("Choose chart")), name));
        list(
            ui,
            workbench,
            named,
            (offered, about.id),
            move |bench, chart| {
                bench.choose_chart(key, chart);
            },
        );
        if room >= 0.0 {
            others(ui, workbench, of);
        }
        if room >= MARKS {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = space::TIGHT;
                signs(ui, (place, kind), workbench);
            });
        }
    });
    if room < 0.0 && beside > 0.0 {
        ui.horizontal_wrapped(|ui| others(ui, workbench, of));
    }
}

/// What is done with a chart: what it means, its numbers, its picture.
fn signs(ui: &mut Ui, (place, kind): (Place<'_>, &dyn ChartKind), workbench: &Workbench) {
    let (key, about) = (place.key, kind.about());
    picture(ui, Plot::Chart(about.id), Some(key), workbench);
    let plot = Plot::Chart(about.id).title();
    let says = say!("Save data of the {plot}…", plot);
    let button = widgets::icon_button(ui, widgets::DATA, &says);
    if button.on_hover_text(&says).clicked() {
        // Of two that show the same it is this one.
        workbench.then(move |bench| {
            bench.view.panes.activate(key);
            bench.choose_where_to_export(What::Numbers(about.id));
        });
    }
    if plots::fit(ui, &place.own(say!("Fit chart to view"))) {
        workbench.then(move |bench| bench.view.panes.fit(key));
    }
    blocks::chart_button(ui, &about, key, workbench);
    widgets::question(ui, about.word);
}
