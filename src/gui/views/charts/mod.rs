//! What stands below the workspace: a bar in which the chart is chosen, and the chart.

mod correction;
mod deviation;
mod effect;
mod histogram;
mod orders;
mod view;
mod waterfall;

use egui::{Align, ComboBox, Layout, Ui};

use crate::gui::core::loaded_session::Component;
use crate::gui::plots::chart_spec::Sketch;
use crate::gui::plots::{gestures, picture};
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::view::{Chart, Plot};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

use super::copies;
use view::View;

/// Room for the marks at the right end of the bar, points.
const MARKS: f32 = 120.0;
/// Room for a list, points.
const LIST: f32 = 104.0;
/// Space beside each name where charts stand side by side: as much as there is room for.
const BESIDE: [f32; 3] = [10.0, 7.0, 5.0];

/// Every chart, in the order in which they are offered.
static CHARTS: [View; 9] = [
    deviation::ANGLE,
    deviation::TIME,
    deviation::LOAD,
    deviation::TEMPERATURE,
    orders::VIEW,
    histogram::VIEW,
    waterfall::VIEW,
    effect::VIEW,
    correction::VIEW,
];

fn view_of(chart: Chart) -> &'static View {
    let there = CHARTS.iter().find(|view| view.chart == chart);
    // A test finds one that is not registered.
    there.unwrap_or(&CHARTS[0])
}

/// The chart as it is shown, to be saved.
pub(super) fn sketch(workbench: &Workbench, plot: Plot) -> Option<Sketch> {
    match plot {
        Plot::Workspace | Plot::Polar => None,
        Plot::Chart(chart) => (view_of(chart).sketch)(workbench, chart),
    }
}

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let view = view_of(workbench.chart());
    bar(ui, workbench, view, commands);
    (view.show)(ui, workbench, commands);
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

    /// Shows it side by side with so much space beside each name, or as a list.
    fn show(&self, ui: &mut Ui, side_by_side: Option<f32>) -> Option<T> {
        if let Some(beside) = side_by_side {
            let shown = ui.scope(|ui| {
                ui.spacing_mut().button_padding.x = beside;
                widgets::segmented_named(ui, &self.offered, self.current)
            });
            return shown.inner;
        }
        let mut chosen = None;
        let current = self.offered.iter().find(|(one, ..)| *one == self.current);
        let shown = current.map_or("", |(_, _, name)| name);
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
        ui.ctx()
            .accesskit_node_builder(list.response.id, |node| node.set_label(self.of));
        chosen.filter(|one| *one != self.current)
    }
}

fn charts(workbench: &Workbench, current: Chart) -> Choice<'static, Chart> {
    let offered = CHARTS.iter().filter(|view| workbench.offers(view.chart));
    Choice {
        of: "Chart",
        offered: offered.map(|v| (v.chart, v.short, v.name)).collect(),
        current,
    }
}

fn components(workbench: &Workbench) -> Choice<'static, Component> {
    let planar = workbench.subject().session.samples.z_mm.is_none();
    let offered = Component::ALL.into_iter();
    let offered = offered.filter(|c| !(planar && c.out_of_plane()));
    Choice {
        of: "Component",
        offered: offered.map(|c| (c, c.name(), c.name())).collect(),
        current: workbench.view().component,
    }
}

/// The joints, where there are several and the chart is about one of them.
fn joints<'a>(workbench: &'a Workbench, view: &View) -> Option<Choice<'a, usize>> {
    let joints = &workbench.subject().session.robot.joints;
    let offered = joints.iter().enumerate();
    (view.of_joint && joints.len() > 1).then(|| Choice {
        of: "Joint of the chart",
        offered: offered.map(|(k, j)| (k, &*j.name, &*j.name)).collect(),
        current: workbench.chart_joint(),
    })
}

fn bar(ui: &mut Ui, workbench: &Workbench, view: &View, commands: &mut Vec<Command>) {
    let chart = view.chart;
    let charts = charts(workbench, chart);
    let components = view.of_component.then(|| components(workbench));
    let joints = joints(workbench, view);
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
        if let Some(chart) = charts.show(ui, beside) {
            commands.push(Command::Chart(chart));
        }
        if let Some(component) = components.and_then(|c| c.show(ui, components_beside)) {
            commands.push(Command::Component(component));
        }
        if let Some(joint) = joints.and_then(|j| j.show(ui, None)) {
            commands.push(Command::ChartJoint(joint));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = space::TIGHT;
            if (view.has_picture)(workbench) {
                picture(ui, Plot::Chart(chart), commands);
            }
            if chart != Chart::Gap {
                gestures::fit(ui, "Fit chart to view", Command::FitChart, commands);
            }
            copies::chart_button(ui, view.name, || (view.numbers)(workbench));
            widgets::question(ui, view.word);
        });
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_chart_is_registered_once() {
        for chart in Chart::ALL {
            let views = CHARTS.iter().filter(|view| view.chart == chart).count();
            assert_eq!(views, 1, "{chart:?}");
        }
        assert_eq!(CHARTS.len(), Chart::ALL.len());
    }
}
