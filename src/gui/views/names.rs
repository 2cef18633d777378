//! How panels name effects and parameters, and the few cards that several of them show.

use egui::{RichText, Ui};

use crate::fit::Estimate;
use crate::gui::charts::effect;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::language::spoken;
use crate::present::names::{parameter, title_on, usual_size};

pub(in crate::gui::views) fn title(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::BODY)));
}

/// The title of an effect, with its joint where the robot has several.
pub(in crate::gui::views) fn in_words(
    id: &str,
    joint: Option<usize>,
    workbench: &Workbench,
) -> String {
    title_on(
        id,
        joint,
        workbench.loaded_session().session.robot.joints.len(),
    )
}

/// Says which sizes no machine has.
pub(in crate::gui::views) fn implausible(ui: &mut Ui, estimates: &[Estimate]) {
    let warning = Palette::of(ui).warning;
    for one in estimates {
        let Some(says) = one.implausible() else {
            continue;
        };
        let text = format!(
            "{}: {} ({})",
            parameter(one.name).0,
            spoken(&says),
            usual_size(one)
        );
        ui.label(RichText::new(text).color(warning));
    }
}

/// Shows what an effect does, in the chart.
pub(in crate::gui::views) fn curve_link(
    ui: &mut Ui,
    workbench: &Workbench,
    index: usize,
    commands: &mut Vec<Command>,
) {
    let view = workbench.view();
    let shown = workbench.shows(effect::ID) && view.effect == index;
    let button = ui.add_enabled_ui(!shown, |ui| widgets::secondary(ui, say!("Show its curve")));
    if button.inner.clicked() {
        commands.push(Command::View(ViewChange::ShowEffect(index)));
    }
}
