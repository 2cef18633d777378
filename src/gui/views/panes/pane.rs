//! A pane: its bar with the handle, and what it shows.

use egui::{Response, Sense, Ui, vec2};

use crate::gui::style::tokens::{Palette, space};
use crate::gui::view::{ChartPane, Content, Key, Pane};
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::gui::{widgets, workspace};

use super::menu::name_of;
use super::{chart, menu};

/// What stands above a pane that is shown in place of all.
pub(super) type Above = fn(&mut Ui, &Workbench, &mut Vec<Command>);

/// A pane with its bar. Its handle, which the pointer moves it by where several are shown.
pub(super) fn contents(
    ui: &mut Ui,
    workbench: &Workbench,
    pane: &Pane,
    above: Option<Above>,
    commands: &mut Vec<Command>,
) -> Option<Response> {
    let whole = ui.available_rect_before_wrap();
    ui.painter()
        .rect_filled(whole, 0.0, Palette::of(ui).surface);
    let inside = egui::UiBuilder::new().max_rect(whole.shrink(f32::from(space::PLOT)));
    let mut handle = None;
    ui.scope_builder(inside, |ui| match &pane.shows {
        Content::Workspace => {
            let mut first = |ui: &mut Ui, commands: &mut Vec<Command>| {
                handle = Some(grip(ui, workbench, pane, commands));
            };
            workspace::bar(ui, workbench, above, &mut first, commands);
            workspace::show(ui, workbench, commands);
        }
        Content::Chart(looked_at) => {
            if let Some(above) = above {
                widgets::row(ui, |ui| above(ui, workbench, commands));
            }
            let place = place(workbench, pane.key, looked_at);
            let mut first = |ui: &mut Ui, commands: &mut Vec<Command>| {
                handle = Some(grip(ui, workbench, pane, commands));
            };
            chart::show(ui, workbench, place, &mut first, commands);
        }
    });
    handle
}

fn place<'a>(workbench: &Workbench, key: Key, pane: &'a ChartPane) -> chart::Place<'a> {
    let mut charts = workbench.view().panes.charts();
    let number = charts.position(|(one, _)| one == key).map_or(1, |k| k + 1);
    let several = workbench.view().panes.charts().count() > 1;
    chart::Place {
        key,
        pane,
        number: several.then_some(number),
    }
}

/// Six dots: what a pane is moved by, and where it says what can be done with it.
fn grip(ui: &mut Ui, workbench: &Workbench, pane: &Pane, commands: &mut Vec<Command>) -> Response {
    let name = name_of(workbench, pane);
    let says = say!("Arrange {plot}", plot = name);
    let sign = widgets::sign_that(ui, &says, Sense::click_and_drag());
    for (x, y) in [
        (-3.0, -5.0),
        (3.0, -5.0),
        (-3.0, 0.0),
        (3.0, 0.0),
        (-3.0, 5.0),
        (3.0, 5.0),
    ] {
        ui.painter()
            .circle_filled(sign.rect.center() + vec2(x, y), 1.5, sign.color);
    }
    menu::show(ui, workbench, pane, &sign.response, commands);
    sign.response
        .on_hover_text(say!("Drag to move it; click to split, move or close it"))
}

/// Which pane is shown where there is room for one only.
pub(super) fn switch(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let panes = &workbench.view().panes;
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
        commands.push(Command::View(ViewChange::Activate(key)));
    }
}
