//! The middle: the workspace, and below it a chart with the bar in which it is chosen.

use egui::{
    Align, CentralPanel, ComboBox, CursorIcon, Frame, Layout, Margin, Panel, Response, Ui, pos2,
    vec2,
};

use crate::gui::charts::{Bar, CHARTS, ChartChoice, ChartKind, Scene, Shown, deviation};
use crate::gui::core::loaded_session::Component;
use crate::gui::plots::{self, figure, picture};
use crate::gui::style::{Palette, space};
use crate::gui::view::{Front, Plot, Step};
use crate::gui::widgets::{self, Buttons, Does, Forms, MIDDLE, Words};
use crate::gui::workbench::Workbench;
use crate::gui::workspace::{self, Handles, marked, nearest};

use super::copies;

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

fn plotted(ui: &mut Ui, workbench: &Workbench, kind: &ChartKind, shown: &Shown) {
    let view = &workbench.view;
    let before = workbench.answer().map(|_| !view.only_after);
    plots::chart::legend(ui, &shown.chart, before, workbench);
    let title = format!("{} {}", kind.id, shown.chart.title);
    let fitted = view.fitted.charts;
    let id = (&*title, workbench.only_after(), fitted);
    let loaded_session = workbench.loaded_session();
    let usable = |sample: &usize| loaded_session.usable[*sample];
    let emphasised = view.hovered.or(view.selected).filter(usable);
    let ringed = marked(view, loaded_session.len()).filter(usable);
    // Boundaries of regions are dragged where they stand over the joint's angle.
    let divided = view.step == Step::Regions
        && kind.id == deviation::ANGLE.id
        && loaded_session.single_revolute();
    if divided {
        workspace::grab(ui, workbench);
    }
    let ringed = ringed.chain(emphasised);
    let (response, transform) = plots::chart::show(ui, id, shown, ringed, emphasised);
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
    figure(&response, &shown.name, shown.description());
    let pointer = response.hover_pos();
    if !shown.series.is_empty() {
        let under = pointer.and_then(|pointer| {
            let [from, to] = [-REACH, REACH]
                .map(|reach| transform.value_from_position(pointer + vec2(reach, 0.0)).x);
            let near = shown.series.iter().flat_map(|series| {
                let near = series.in_sight([from, to]).iter();
                near.filter_map(|sample| Some((*sample as usize, series.at(*sample as usize)?)))
            });
            let at = |(sample, [x, y]): (usize, [f64; 2])| {
                let at = egui_plot::PlotPoint::new(x, y);
                (sample, transform.position_from_point(&at))
            };
            nearest(near.map(at), pointer, REACH)
        });
        workspace::hover(&response, workbench, under);
    }
    let under = pointer.map(|pointer| transform.value_from_position(pointer).x);
    let within = |bar: &&Bar| under.is_some_and(|x| (bar.x[0]..=bar.x[1]).contains(&x));
    if let Some(bar) = shown.bars.iter().find(within) {
        pointed(response, bar, workbench);
    }
}

/// Says what the bar under the pointer is; a click marks its samples.
fn pointed(response: Response, bar: &Bar, workbench: &Workbench) {
    let response = if bar.samples.is_empty() {
        response
    } else {
        let samples = bar.samples.clone();
        response.does(workbench, move |bench| bench.view.mark(samples));
        response.on_hover_cursor(CursorIcon::PointingHand)
    };
    let facts = (bar.title.clone(), bar.lines.clone());
    response.on_hover_ui_at_pointer(|ui| {
        widgets::facts(ui, &facts);
    });
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

/// The chart, and what is chosen for it.
fn lists(ui: &mut Ui, workbench: &Workbench, kind: &ChartKind, scene: &Scene) {
    use ChartChoice::{Axis, Component as OfComponent, Joint};
    let offered = CHARTS.iter().filter(|chart| (chart.is_offered)(scene));
    let offered = offered.map(|chart| (chart.id, chart.name()));
    let named = (say!("Choose chart"), &*kind.name());
    let offered = (offered, kind.id);
    list(ui, workbench, named, offered, Workbench::show_chart);
    let session = &scene.loaded_session.session;
    if matches!(kind.of, OfComponent | Joint) {
        let planar = session.samples.z_mm.is_none();
        let offered = Component::ALL.into_iter();
        let offered = offered.filter(|c| !(planar && c.out_of_plane()));
        let offered = (offered.map(|c| (c, c.name())), scene.component);
        let named = (say!("Component"), scene.component.name());
        list(ui, workbench, named, offered, |bench, c| {
            bench.view.component = c;
        });
    }
    let joints = &session.robot.joints;
    if matches!(kind.of, Axis | Joint) && joints.len() > 1 {
        let offered = joints.iter().map(|joint| &joint.name);
        let offered = (offered.enumerate(), scene.joint());
        let named = (say!("Joint of the chart"), &*joints[scene.joint()].name);
        list(ui, workbench, named, offered, |bench, joint| {
            bench.view.joint = joint;
        });
    }
}

fn bar(ui: &mut Ui, workbench: &Workbench, kind: &ChartKind, scene: &Scene) {
    ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
        ui.spacing_mut().item_spacing.x = space::TIGHT;
        picture(ui, Plot::Chart(kind.id), workbench);
        if plots::fit(ui, say!("Fit chart to view")) {
            workbench.then(|bench| bench.view.fitted.charts += 1);
        }
        copies::chart_button(ui, kind, workbench);
        ui.question(kind.word);
        // What there is no room for stands below.
        let rows = Layout::left_to_right(Align::Min).with_main_wrap(true);
        ui.with_layout(rows, |ui| {
            ui.spacing_mut().item_spacing.x = space::ROW;
            lists(ui, workbench, kind, scene);
        });
    });
}
