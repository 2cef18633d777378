//! What can be done with a region: a menu at the end of its row, and keys while that has the focus.

use crate::gui::workbench::Workbench;
use egui::{Button, Id, Key, Modifiers, Ui};

use crate::gui::core::boundaries;
use crate::gui::widgets;
use crate::sessions::Region;

/// Widths of the columns: name, from, to, samples, what can be done; the ends share what is left.
pub(super) const COLUMNS: [f32; 5] = [38.0, 60.0, 60.0, 36.0, 26.0];

/// The field for a region's name: the menu's “Rename” puts the cursor into it.
pub(super) fn name_id(ui: &Ui, region: usize) -> Id {
    ui.ctx().viewport_id().0.with(("name of region", region))
}

/// Whether a key was pressed that is meant for the control with this focus.
fn key(ui: &Ui, focused: bool, key: Key) -> bool {
    focused && ui.input_mut(|i| i.consume_key(Modifiers::NONE, key))
}

/// One thing that can be done.
struct RowAction {
    name: &'static str,
    key: Key,
    shown: &'static str,
    /// What it does, or why it cannot be done.
    does: Result<RowEffect, &'static str>,
}

enum RowEffect {
    Split,
    /// Of this and the one after it.
    Join(usize),
    Delete,
    Rename,
}

fn deeds(regions: &[Region], k: usize) -> [RowAction; 4] {
    let (before, next) = (
        boundaries::before(regions, k),
        boundaries::next_to(regions, k),
    );
    let last = regions.len() < 2;
    [
        RowAction {
            name: say!("Split in half"),
            key: Key::S,
            shown: "S",
            does: crate::gui::core::boundaries::split(regions, k)
                .map(|_| RowEffect::Split)
                .ok_or(say!("it is too narrow")),
        },
        RowAction {
            name: if next.is_none() && before.is_some() {
                say!("Merge with previous")
            } else {
                say!("Merge with next")
            },
            key: Key::M,
            shown: "M",
            does: next
                .map(|_| k)
                .or(before)
                .map(RowEffect::Join)
                .ok_or(say!("no region touches it")),
        },
        RowAction {
            name: say!("Delete"),
            key: Key::Delete,
            shown: "Del",
            does: (!last)
                .then_some(RowEffect::Delete)
                .ok_or(say!("the last region stays")),
        },
        RowAction {
            name: say!("Rename"),
            key: Key::R,
            shown: "R",
            does: Ok(RowEffect::Rename),
        },
    ]
}

pub(super) fn more(ui: &mut Ui, regions: &[Region], k: usize, workbench: &Workbench) {
    let mut done = None;
    let menu = ui.scope(|ui| {
        ui.spacing_mut().button_padding = egui::vec2(4.0, 2.0);
        ui.spacing_mut().interact_size.x = COLUMNS[4];
        ui.menu_button("…", |ui| {
            ui.set_min_width(180.0);
            for deed in deeds(regions, k) {
                let button = Button::new(deed.name).shortcut_text(deed.shown);
                let response = ui.add_enabled(deed.does.is_ok(), button);
                let response = match &deed.does {
                    Err(because) => response.on_disabled_hover_text(*because),
                    Ok(_) => response,
                };
                if (response.clicked() || key(ui, true, deed.key))
                    && let Ok(does) = deed.does
                {
                    done = Some(does);
                    ui.close();
                }
            }
        })
    });
    let response = menu.inner.response;
    let says = say!("Change region {name}", name = regions[k].name);
    widgets::label(&response, says);
    let focused = response.has_focus();
    response.on_hover_text(say!(
        "with the focus here: S splits, M merges, Del deletes, R renames"
    ));
    for deed in deeds(regions, k) {
        if let (true, Ok(does)) = (key(ui, focused, deed.key), deed.does) {
            done = Some(does);
        }
    }
    match done {
        Some(RowEffect::Split) => workbench.then(move |bench| {
            bench.edit(phrase!("split region"), |document| document.split(k));
        }),
        Some(RowEffect::Join(first)) => workbench.then(move |bench| {
            bench.edit(phrase!("merge regions"), |document| document.join(first));
        }),
        Some(RowEffect::Delete) => workbench.then(move |bench| {
            bench.edit(phrase!("delete region"), |document| document.delete(k));
        }),
        Some(RowEffect::Rename) => {
            let id = name_id(ui, k);
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        None => {}
    }
}
