//! The sample under the pointer, in every plot of samples.

use egui::{Button, CursorIcon, Role, Ui, WidgetInfo};

use crate::gui::actions::{EXCLUDE, WindowState};
use crate::gui::view::ViewState;
use crate::gui::workbench::{Command, ViewChange, Workbench};

use super::card;

/// A sample is under the pointer within this many points.
pub(super) const REACH: f32 = 14.0;

/// Sends what is under the pointer, and says what it is.
pub(crate) fn hover(
    response: &egui::Response,
    workbench: &Workbench,
    under: Option<usize>,
    commands: &mut Vec<Command>,
) {
    let left = left(response, &response.ctx);
    if (response.hovered() || left) && under != workbench.view().hovered {
        commands.push(Command::View(ViewChange::Hover(under)));
    }
    if response.clicked() || response.secondary_clicked() && under.is_some() {
        commands.push(Command::View(ViewChange::Select(under)));
    }
    if workbench.view().selected.is_some() {
        response.context_menu(|ui| sample_menu(ui, workbench, commands));
    }
    if let Some(sample) = under
        && let Some(pointer) = response.hover_pos()
    {
        response.ctx.set_cursor_icon(CursorIcon::PointingHand);
        card::show(&response.ctx, workbench, sample, pointer, response.rect);
    }
}

/// What can be done with the chosen samples.
pub(crate) fn sample_menu(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let ctx = ui.ctx().clone();
    let now = WindowState {
        ctx: &ctx,
        workbench,
    };
    let button = Button::new(EXCLUDE.label(now)).shortcut_text(EXCLUDE.keys(&ctx));
    let name = EXCLUDE.label(now);
    let response = ui.add_enabled(EXCLUDE.enabled(now), button);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    if response.clicked() {
        commands.push(EXCLUDE.command(now));
        ui.close();
    }
}

/// The samples that a finding is about, no more than can be told apart.
pub(crate) fn marked(view: &ViewState, samples: usize) -> impl Iterator<Item = usize> + '_ {
    const MOST: usize = 2000;
    let there = view.marked.iter().copied().filter(move |s| *s < samples);
    there.take(MOST)
}

/// Whether the pointer has just left this widget.
pub(crate) fn left(response: &egui::Response, ctx: &egui::Context) -> bool {
    let id = response.id.with("was hovered");
    let now = response.hovered();
    ctx.data_mut(|data| {
        let before: bool = data.get_temp(id).unwrap_or_default();
        data.insert_temp(id, now);
        before && !now
    })
}
