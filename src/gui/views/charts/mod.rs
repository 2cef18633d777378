//! What stands below the workspace: a bar in which the chart is chosen, and the chart.

pub(crate) mod correction;
pub(crate) mod deviation;
pub(crate) mod effect;
pub(crate) mod histogram;
pub(crate) mod orders;
pub(crate) mod waterfall;

use egui::{Align, ComboBox, Layout, Ui};

use crate::gui::core::subject::Component;
use crate::gui::help::{self, Word};
use crate::gui::plots::sketch::Sketch;
use crate::gui::plots::{gestures, picture, strip};
use crate::gui::style::tokens::{Palette, size, space};
use crate::gui::view::Chart;
use crate::gui::view::Plot;
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

use super::copies;

/// Room for the marks at the right end of the bar, points.
const MARKS: f32 = 120.0;
/// Room for a list, points.
const LIST: f32 = 104.0;
/// Space beside each name where charts stand side by side: as much as there is room for.
const BESIDE: [f32; 3] = [10.0, 7.0, 5.0];

/// The chart as it is shown, to be saved.
pub(super) fn sketch(workbench: &Workbench, plot: Plot) -> Option<Sketch> {
    let chart = match plot {
        Plot::Workspace | Plot::Polar | Plot::Waterfall => return None,
        Plot::Deviation => Chart::Angle,
        Plot::Chart(chart) => chart,
    };
    match chart {
        Chart::Orders => orders::sketch(workbench),
        Chart::Histogram => histogram::sketch(workbench),
        Chart::Effect => effect::sketch(workbench),
        Chart::Gap => None,
        Chart::Table => correction::sketch(workbench.export()?.ok()?),
        _ => deviation::sketch(workbench, workbench.over_in(chart)?),
    }
}

/// Shows the bar and the chart.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let chart = workbench.chart();
    bar(ui, workbench, chart, commands);
    match chart {
        Chart::Angle | Chart::Time | Chart::Load | Chart::Temperature => {
            if let Some(over) = workbench.over_in(chart) {
                deviation::show(ui, workbench, over, commands);
            }
        }
        Chart::Orders => orders::show(ui, workbench, commands),
        Chart::Histogram => histogram::show(ui, workbench, commands),
        Chart::Effect => effect::show(ui, workbench, commands),
        Chart::Gap => {
            let says = "root mean square over the samples that were fitted";
            strip::show(ui, says, &[], commands);
            waterfall::show(ui, workbench);
        }
        Chart::Table => {
            if let Some(Ok(made)) = workbench.export() {
                strip::show(ui, &correction::caption(made), &[], commands);
                correction::show(ui, workbench, made);
            }
        }
    }
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
    let offered = Chart::ALL.into_iter().filter(|c| workbench.offers(*c));
    Choice {
        of: "Chart",
        offered: offered.map(|c| (c, c.short(), c.name())).collect(),
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
fn joints(workbench: &Workbench, chart: Chart) -> Option<Choice<'_, usize>> {
    let joints = &workbench.subject().session.robot.joints;
    let about_one = matches!(
        chart,
        Chart::Angle | Chart::Time | Chart::Load | Chart::Temperature | Chart::Orders
    );
    let offered = joints.iter().enumerate();
    (about_one && joints.len() > 1).then(|| Choice {
        of: "Joint of the chart",
        offered: offered.map(|(k, j)| (k, &*j.name, &*j.name)).collect(),
        current: workbench.chart_joint(),
    })
}

fn bar(ui: &mut Ui, workbench: &Workbench, chart: Chart, commands: &mut Vec<Command>) {
    let charts = charts(workbench, chart);
    let components = chart.has_components().then(|| components(workbench));
    let joints = joints(workbench, chart);
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
            if has_picture(workbench, chart) {
                picture(ui, plot_of(chart), commands);
            }
            if chart != Chart::Gap {
                gestures::fit(ui, "Fit chart to view", Command::FitChart, commands);
            }
            copies::chart_button(ui, chart.name(), || numbers(workbench, chart));
            widgets::question(ui, word(chart));
        });
    });
}

/// What the chart's question mark explains.
fn word(chart: Chart) -> Word {
    match chart {
        Chart::Angle => help::DEVIATION,
        Chart::Time => help::OVER_TIME,
        Chart::Load => help::OVER_LOAD,
        Chart::Temperature => help::OVER_TEMPERATURE,
        Chart::Orders => help::ORDERS,
        Chart::Histogram => help::HISTOGRAM,
        Chart::Gap => help::GAP,
        Chart::Effect => help::EFFECT_CURVE,
        Chart::Table => help::CORRECTION,
    }
}

/// The chart as a file.
fn plot_of(chart: Chart) -> Plot {
    match chart {
        Chart::Gap => Plot::Waterfall,
        Chart::Angle => Plot::Deviation,
        other => Plot::Chart(other),
    }
}

fn has_picture(workbench: &Workbench, chart: Chart) -> bool {
    match chart {
        Chart::Gap => true,
        Chart::Table => workbench.export().is_some_and(|made| made.is_ok()),
        _ => !workbench.subject().is_empty(),
    }
}

/// The chart as a table for a spreadsheet.
fn numbers(workbench: &Workbench, chart: Chart) -> String {
    match chart {
        Chart::Orders => orders::numbers(workbench),
        Chart::Histogram => histogram::numbers(workbench),
        Chart::Effect => effect::numbers(workbench),
        Chart::Gap => waterfall::numbers(workbench),
        Chart::Table => match workbench.export() {
            Some(Ok(made)) => correction::numbers(made),
            _ => String::new(),
        },
        _ => workbench
            .over_in(chart)
            .map_or_else(String::new, |over| deviation::numbers(workbench, over)),
    }
}
