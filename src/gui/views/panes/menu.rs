//! What a pane is called, how it is changed, and the menu of its handle.

use egui::{Button, Popup, Response, Role, Ui, WidgetInfo};

use crate::gui::actions::{CHART_BELOW, CHART_BESIDE, CLOSE_CHART, WindowState};
use crate::gui::view::{ChartPane, Content, Edge, Key, Pane, Panes, Plot, What};
use crate::gui::workbench::{Asked, Command, ViewChange, Workbench};

/// What a pane is called.
pub(super) fn name_of(workbench: &Workbench, pane: &Pane) -> String {
    match &pane.shows {
        Content::Workspace => say!("Workspace").to_owned(),
        Content::Chart(chart) => workbench.kind(chart).about().name().to_owned(),
    }
}

/// The panes with this done to the chart in one of them.
pub(super) fn changed(
    workbench: &Workbench,
    key: Key,
    change: impl FnOnce(&mut ChartPane),
) -> Command {
    rearranged(workbench, |panes| {
        if let Some(pane) = panes.chart_mut(key) {
            change(pane);
        }
        panes.activate(key);
    })
}

/// The panes with this done to them.
pub(super) fn rearranged(workbench: &Workbench, change: impl FnOnce(&mut Panes)) -> Command {
    let mut panes = workbench.view().panes.clone();
    change(&mut panes);
    Command::View(ViewChange::Panes(Box::new(panes)))
}

pub(super) fn show(
    ui: &Ui,
    workbench: &Workbench,
    pane: &Pane,
    handle: &Response,
    commands: &mut Vec<Command>,
) {
    let ctx = ui.ctx().clone();
    let now = WindowState {
        ctx: &ctx,
        workbench,
    };
    let key = pane.key;
    Popup::menu(handle).show(|ui| {
        ui.set_min_width(220.0);
        let item = |ui: &mut Ui, name: &str, keys: Option<String>, enabled: bool| {
            let button = Button::new(name).shortcut_text(keys.unwrap_or_default());
            let response = ui.add_enabled(enabled, button);
            response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
            response.clicked()
        };
        if let Content::Chart(chart) = &pane.shows {
            let id = workbench.kind(chart).about().id;
            let plot = Plot::Chart(id);
            for (name, what) in [
                (say!("Save data…"), What::Numbers(id)),
                (say!("Save picture…"), What::Picture(plot)),
            ] {
                if item(ui, name, None, true) {
                    commands.push(Command::View(ViewChange::Activate(key)));
                    commands.push(Command::Ask(Asked::WhereToExport(what)));
                }
            }
            if item(ui, say!("Copy numbers"), None, true) {
                commands.push(Command::View(ViewChange::Activate(key)));
                commands.push(Command::CopyNumbers(id));
            }
            if item(ui, say!("Fit chart to view"), None, true) {
                commands.push(Command::View(ViewChange::FitChart(key)));
            }
            ui.separator();
        }
        let panes = &workbench.view().panes;
        let active = panes.active() == key;
        // The keys are for the active pane.
        let keys = |action: &crate::gui::actions::Action| active.then(|| action.keys(&ctx));
        for (action, edge) in [(CHART_BESIDE, Edge::Right), (CHART_BELOW, Edge::Bottom)] {
            if item(ui, &action.label(now), keys(&action), panes.has_room()) {
                let with = workbench.with_chart(key, edge);
                commands.push(Command::View(ViewChange::Panes(Box::new(with))));
            }
        }
        if panes.panes().len() > 1 {
            ui.separator();
            for edge in Edge::ALL {
                let name = match edge {
                    Edge::Left => say!("Move to the left"),
                    Edge::Right => say!("Move to the right"),
                    Edge::Top => say!("Move to the top"),
                    Edge::Bottom => say!("Move to the bottom"),
                };
                if item(ui, name, None, true) {
                    commands.push(rearranged(workbench, |panes| panes.move_to(key, edge)));
                }
            }
        }
        if pane.shows != Content::Workspace {
            ui.separator();
            if item(ui, &CLOSE_CHART.label(now), keys(&CLOSE_CHART), true) {
                commands.push(rearranged(workbench, |panes| panes.close(key)));
            }
        }
    });
}
