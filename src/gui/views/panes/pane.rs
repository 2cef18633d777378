//! A pane: its bar with the handle, the menu of that, and what it shows.

use egui::{Button, Popup, Response, Role, Sense, Ui, WidgetInfo, vec2};

use crate::gui::actions::{CHART_BELOW, CHART_BESIDE, CLOSE_CHART, WindowState};
use crate::gui::style::{Palette, space};
use crate::gui::view::{ChartPane, Content, Edge, Key, Pane, Plot, What};
use crate::gui::workbench::Workbench;
use crate::gui::{widgets, workspace};

use super::chart;

/// What stands above a pane that is shown in place of all.
pub(super) type Above = fn(&mut Ui, &Workbench);

/// A pane with its bar. Its handle, which the pointer moves it by where several are shown.
pub(super) fn contents(
    ui: &mut Ui,
    workbench: &Workbench,
    pane: &Pane,
    above: Option<Above>,
) -> Option<Response> {
    let whole = ui.available_rect_before_wrap();
    ui.painter()
        .rect_filled(whole, 0.0, Palette::of(ui).surface);
    let inside = egui::UiBuilder::new().max_rect(whole.shrink(f32::from(space::PLOT)));
    let mut handle = None;
    ui.scope_builder(inside, |ui| match &pane.shows {
        Content::Workspace => {
            let mut first = |ui: &mut Ui| {
                handle = Some(grip(ui, workbench, pane));
            };
            workspace::bar(ui, workbench, above, &mut first);
            workspace::show(ui, workbench);
        }
        Content::Chart(looked_at) => {
            if let Some(above) = above {
                widgets::row(ui, |ui| above(ui, workbench));
            }
            let place = place(workbench, pane.key, looked_at);
            let mut first = |ui: &mut Ui| {
                handle = Some(grip(ui, workbench, pane));
            };
            chart::show(ui, workbench, place, &mut first);
        }
    });
    handle
}

fn place<'a>(workbench: &Workbench, key: Key, pane: &'a ChartPane) -> chart::Place<'a> {
    let mut charts = workbench.view.panes.charts();
    let number = charts.position(|(one, _)| one == key).map_or(1, |k| k + 1);
    let several = workbench.view.panes.charts().count() > 1;
    chart::Place {
        key,
        pane,
        number: several.then_some(number),
    }
}

/// Six dots: what a pane is moved by, and where it says what can be done with it.
fn grip(ui: &mut Ui, workbench: &Workbench, pane: &Pane) -> Response {
    let name = name_of(workbench, pane);
    let says = say!("Arrange {plot}", plot = name);
    let (button, color) = widgets::bare_button(ui, &says, Sense::click_and_drag());
    for (x, y) in [
        (-3.0, -5.0),
        (3.0, -5.0),
        (-3.0, 0.0),
        (3.0, 0.0),
        (-3.0, 5.0),
        (3.0, 5.0),
    ] {
        ui.painter()
            .circle_filled(button.rect.center() + vec2(x, y), 1.5, color);
    }
    menu(ui, workbench, pane, &button);
    button.on_hover_text(say!("Drag to move it; click to split, move or close it"))
}

/// Which pane is shown where there is room for one only.
pub(super) fn switch(ui: &mut Ui, workbench: &Workbench) {
    let panes = &workbench.view.panes;
    let several = panes.charts().count() > 1;
    let mut number = 0;
    let names = panes.panes().into_iter().map(|pane| match pane.shows {
        Content::Workspace => {
            let name = say!("Workspace").to_owned();
            (pane.key, name.clone(), name)
        }
        Content::Chart(_) if !several => {
            let name = say!("Chart").to_owned();
            (pane.key, name.clone(), name)
        }
        Content::Chart(_) => {
            number += 1;
            let long = format!("{number}: {}", name_of(workbench, pane));
            (pane.key, number.to_string(), long)
        }
    });
    let names: Vec<(Key, String, String)> = names.collect();
    let named: Vec<(Key, &str, &str)> = names
        .iter()
        .map(|(key, short, long)| (*key, short.as_str(), long.as_str()))
        .collect();
    if let Some(key) = widgets::segmented_named(ui, &named, panes.active()) {
        workbench.then(move |bench| bench.view.panes.activate(key));
    }
}

/// What a pane is called.
pub(super) fn name_of(workbench: &Workbench, pane: &Pane) -> String {
    match &pane.shows {
        Content::Workspace => say!("Workspace").to_owned(),
        Content::Chart(chart) => workbench.kind(chart).about().name().to_owned(),
    }
}

/// What can be done with a pane: the menu of its handle.
fn menu(ui: &Ui, workbench: &Workbench, pane: &Pane, handle: &Response) {
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
                    workbench.then(move |bench| bench.view.panes.activate(key));
                    workbench.then(move |bench| bench.choose_where_to_export(what));
                }
            }
            if item(ui, say!("Copy numbers"), None, true) {
                workbench.then(move |bench| bench.view.panes.activate(key));
                workbench.then(move |bench| bench.copy_numbers(id));
            }
            if item(ui, say!("Fit chart to view"), None, true) {
                workbench.then(move |bench| bench.view.panes.fit(key));
            }
            ui.separator();
        }
        let panes = &workbench.view.panes;
        let active = panes.active() == key;
        // The keys are for the active pane.
        let keys = |action: &crate::gui::actions::Action| active.then(|| action.keys(&ctx));
        for (action, edge) in [(CHART_BESIDE, Edge::Right), (CHART_BELOW, Edge::Bottom)] {
            if item(ui, &action.label(now), keys(&action), panes.has_room()) {
                let with = workbench.with_chart(key, edge);
                workbench.then(move |bench| bench.arrange(with));
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
                    workbench.then(move |bench| bench.rearrange(|panes| panes.move_to(key, edge)));
                }
            }
        }
        if pane.shows != Content::Workspace {
            ui.separator();
            if item(ui, &CLOSE_CHART.label(now), keys(&CLOSE_CHART), true) {
                workbench.then(move |bench| bench.rearrange(|panes| panes.close(key)));
            }
        }
    });
}
