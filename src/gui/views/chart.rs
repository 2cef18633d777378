//! What stands below the workspace: a bar in which the chart is chosen, and the chart.

use egui::{Align, ComboBox, CursorIcon, Layout, Shape, Stroke, StrokeKind, Ui};
use egui::{Rect, pos2};

use crate::gui::charts::{self, Bars, CHARTS, Kind, Pointed, Samples, Shown};
use crate::gui::core::loaded_session::Component;
use crate::gui::plots::chart::{self, Canvas};
use crate::gui::plots::{figure, gestures, legend, marks, picture};
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::view::Plot;
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};
use crate::gui::workspace::{self, marked, nearest};

use super::copies;

/// Room for the marks at the right end of the bar, points.
const MARKS: f32 = 120.0;
/// Room for a list, points.
const LIST: f32 = 104.0;
/// What a list has beside the name that is chosen, points.
const ARROW: f32 = 42.0;
/// Space beside each name where charts stand side by side: as much as there is room for.
const BESIDE: [f32; 3] = [10.0, 7.0, 5.0];
/// A sample is under the pointer within this many points.
const REACH: f32 = 14.0;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let kind = workbench.chart();
    bar(ui, workbench, kind, commands);
    let scene = workbench.scene_of(kind);
    match charts::shown(kind, &scene) {
        Ok(shown) => plotted(ui, workbench, kind, &shown, commands),
        Err(missing) => legend::empty(ui, &missing.title, missing.why),
    }
}

fn plotted(
    ui: &mut Ui,
    workbench: &Workbench,
    kind: &dyn Kind,
    shown: &Shown<'_>,
    commands: &mut Vec<Command>,
) {
    let view = workbench.view();
    let before = workbench.answer().map(|_| !view.only_after);
    legend::show(ui, &shown.chart, before, commands);
    let title = format!("{} {}", kind.about().id, shown.chart.title);
    let id = (&*title, workbench.only_after());
    let emphasised = view.hovered.or(view.selected);
    let usable = |sample: &usize| workbench.subject().usable[*sample];
    let more = |canvas: &Canvas<'_>, shapes: &mut Vec<Shape>| match &shown.pointed {
        Pointed::Nothing => {}
        Pointed::Samples(samples) => {
            let there = marked(view, workbench.subject().len()).chain(emphasised);
            drawn_samples(&**samples, there.filter(usable), canvas, shapes);
        }
        Pointed::Bars(bars) => {
            let bar = emphasised.filter(usable).and_then(|sample| bars.of(sample));
            shapes.extend(bar.map(|bar| framed(bar, canvas)));
        }
    };
    let (response, transform) = chart::show(ui, id, &shown.chart, view, more);
    figure(&response, &shown.name, shown.says.clone());
    match &shown.pointed {
        Pointed::Nothing => {}
        Pointed::Samples(samples) => {
            let under = response.hover_pos().and_then(|pointer| {
                let ends = [pointer.x - REACH, pointer.x + REACH];
                let place = |x: f32| transform.value_from_position(pos2(x, pointer.y)).x;
                let candidates = samples
                    .near(ends.map(place))
                    .into_iter()
                    .flat_map(|sample| {
                        let marks = samples.marks(sample).into_iter();
                        marks.map(move |[x, y]| (sample, egui_plot::PlotPoint::new(x, y)))
                    });
                let candidates = candidates.map(|(sample, point)| {
                    let here = transform.position_from_point(&point);
                    (sample, [here.x, here.y])
                });
                nearest(candidates, [pointer.x, pointer.y], REACH)
            });
            workspace::hover(&response, workbench, under, commands);
        }
        Pointed::Bars(bars) => pointed(response, &transform, &**bars, commands),
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
    let width = f64::from(canvas.transform.frame().width());
    for item in samples.in_sight([bounds.min()[0], bounds.max()[0]], width) {
        canvas.draw(&item, shapes);
    }
    let stroke = Stroke::new(2.5, canvas.palette.accent);
    for place in ringed.filter_map(|sample| samples.marks(sample).pop()) {
        shapes.push(marks::ring(canvas.at(place), 8.0, stroke));
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
    commands: &mut Vec<Command>,
) {
    let pointer = response.hover_pos();
    let under = pointer.map(|pointer| transform.value_from_position(pointer).x);
    let Some(facts) = under.and_then(|x| bars.at(x)) else {
        return;
    };
    let response = if facts.samples.is_empty() {
        response
    } else {
        if response.clicked() {
            commands.push(Command::Mark(facts.samples.clone()));
        }
        response.on_hover_cursor(CursorIcon::PointingHand)
    };
    response.on_hover_ui_at_pointer(|ui| {
        widgets::facts(ui, &(facts.title, facts.lines));
    });
}

/// What is chosen in a list or side by side, and how it is called.
struct Choice<'a, T> {
    /// What the list is called.
    of: &'static str,
    /// What can be chosen: itself, its name side by side, its name in the list.
    offered: Vec<(T, &'a str, &'a str)>,
    current: T,
}

impl<T: Copy + PartialEq> Choice<'_, T> {
    /// How wide it is side by side with so much space beside each name, points.
    fn width(&self, ui: &Ui, beside: f32) -> f32 {
        let font = egui::FontId::proportional(size::SMALL);
        let color = Palette::of(ui).text;
        let padding = 2.0 * beside + 3.0;
        let wide = self.offered.iter().map(|(_, short, _)| {
            let text = (*short).to_owned();
            let galley = ui.painter().layout_no_wrap(text, font.clone(), color);
            galley.size().x + padding
        });
        wide.map(|w| w.max(36.0)).sum::<f32>() + 8.0
    }

    /// Shows it side by side with so much space beside each name, or as a list that is at most so wide
    /// where its short name does for that.
    fn show(&self, ui: &mut Ui, side_by_side: Option<f32>, most: f32) -> Option<T> {
        if let Some(beside) = side_by_side {
            let shown = ui.scope(|ui| {
                ui.spacing_mut().button_padding.x = beside;
                widgets::segmented_named(ui, &self.offered, self.current)
            });
            return shown.inner;
        }
        let mut chosen = None;
        let current = self.offered.iter().find(|(one, ..)| *one == self.current);
        let (short, name) = current.map_or(("", ""), |(_, short, name)| (*short, *name));
        let font = egui::FontId::proportional(size::SMALL);
        let galley = ui
            .painter()
            .layout_no_wrap(name.to_owned(), font, Palette::of(ui).text);
        let shown = if galley.size().x + ARROW > most {
            short
        } else {
            name
        };
        let list = ComboBox::from_id_salt(self.of)
            .selected_text(egui::RichText::new(shown).size(size::SMALL))
            .width(0.0)
            .height(360.0);
        let list = list.show_ui(ui, |ui| {
            for (one, _, name) in &self.offered {
                if ui.selectable_label(*one == self.current, *name).clicked() {
                    chosen = Some(*one);
                }
            }
        });
        widgets::label(&list.response, self.of);
        chosen.filter(|one| *one != self.current)
    }
}

fn charts(workbench: &Workbench, current: &dyn Kind) -> Choice<'static, &'static str> {
    let scene = workbench.scene();
    let offered = CHARTS.iter().filter(|chart| chart.is_offered(&scene));
    let offered = offered.map(|chart| chart.about());
    Choice {
        of: say!("Chart"),
        offered: offered.map(|a| (a.id, a.short(), a.name())).collect(),
        current: current.about().id,
    }
}

fn components(workbench: &Workbench) -> Choice<'static, Component> {
    let planar = workbench.subject().session.samples.z_mm.is_none();
    let offered = Component::ALL.into_iter();
    let offered = offered.filter(|c| !(planar && c.out_of_plane()));
    Choice {
        of: say!("Component"),
        offered: offered.map(|c| (c, c.name(), c.name())).collect(),
        current: workbench.view().component,
    }
}

/// The joints, where there are several and the chart is about one of them.
fn joints<'a>(workbench: &'a Workbench, chart: &dyn Kind) -> Option<Choice<'a, usize>> {
    let joints = &workbench.subject().session.robot.joints;
    let offered = joints.iter().enumerate();
    (chart.about().of_joint && joints.len() > 1).then(|| Choice {
        of: say!("Joint of the chart"),
        offered: offered.map(|(k, j)| (k, &*j.name, &*j.name)).collect(),
        current: workbench.chart_joint(),
    })
}

fn bar(ui: &mut Ui, workbench: &Workbench, kind: &dyn Kind, commands: &mut Vec<Command>) {
    let about = kind.about();
    let charts = charts(workbench, kind);
    let components = about.of_component.then(|| components(workbench));
    let joints = joints(workbench, kind);
    // Side by side as long as there is room: the charts first, they are what is looked for.
    let lists = [components.is_some(), joints.is_some()];
    let lists = lists.into_iter().filter(|there| *there).count() as f32;
    let room = ui.available_width() - MARKS - LIST * lists;
    let fits = |beside: &f32| charts.width(ui, *beside) <= room;
    let beside = BESIDE.into_iter().find(fits);
    let left = room - beside.map_or(f32::INFINITY, |beside| charts.width(ui, beside));
    let wide = |c: &Choice<Component>| LIST + left >= c.width(ui, BESIDE[0]);
    let components_beside = components.as_ref().filter(|c| wide(c)).map(|_| BESIDE[0]);
    widgets::row(ui, |ui| {
        ui.spacing_mut().item_spacing.x = space::ROW;
        if let Some(chart) = charts.show(ui, beside, room) {
            commands.push(Command::Chart(chart));
        }
        if let Some(component) =
            components.and_then(|c| c.show(ui, components_beside, f32::INFINITY))
        {
            commands.push(Command::Component(component));
        }
        if let Some(joint) = joints.and_then(|j| j.show(ui, None, f32::INFINITY)) {
            commands.push(Command::ChartJoint(joint));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = space::TIGHT;
            picture(ui, Plot::Chart(about.id), commands);
            gestures::fit(ui, say!("Fit chart to view"), Command::FitChart, commands);
            copies::chart_button(ui, about.name(), || {
                kind.numbers(&workbench.scene_of(kind)).tabbed()
            });
            widgets::question(ui, about.word);
        });
    });
}
