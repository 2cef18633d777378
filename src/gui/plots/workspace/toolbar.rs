//! The bar over the workspace plot: from where it is looked at, what is shown, and how.

use egui::{Align, ComboBox, Layout, RichText, Slider, Ui};

use crate::gui::commands::{Command, Workbench};
use crate::gui::pictures::Plot;
use crate::gui::plots::picture;
use crate::gui::tokens::{size, space};
use crate::gui::units::significant;
use crate::gui::view::{Colouring, Plane};
use crate::gui::widgets::{self, caption, fine, title};

use super::model::{magnification as magnification_of, offers};

/// Shows the bar.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let view = workbench.view();
    let measured = !workbench.subject().is_empty();
    ui.horizontal(|ui| {
        title(ui, "Workspace");
        let planes = Plane::ALL.map(|plane| (plane, plane.name()));
        if let Some(plane) = widgets::segmented(ui, &planes, view.plane) {
            commands.push(Command::Look(plane));
        }
        if measured {
            ui.add_space(space::TIGHT);
            heat(ui, workbench, commands);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if measured {
                picture(ui, Plot::Workspace, commands);
            }
            if workbench.answer().is_some() && measured {
                blend(ui, workbench, commands);
            }
        });
    });
    if measured {
        ui.horizontal(|ui| {
            magnification(ui, workbench, commands);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                colouring(ui, workbench, commands);
            });
        });
    }
}

/// From before to after.
fn blend(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let mut blend = workbench.view().blend;
    caption(ui, "after");
    fine(ui, 64.0);
    let slider = ui.add(Slider::new(&mut blend, 0.0..=1.0).show_value(false));
    ui.ctx()
        .accesskit_node_builder(slider.id, |node| node.set_label("From before to after"));
    if slider.changed() {
        commands.push(Command::Blend(blend));
    }
    caption(ui, "before");
}

/// How long the vectors are drawn.
fn magnification(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let subject = workbench.subject();
    let before = subject.overview.readable;
    let now = magnification_of(workbench.view(), subject);
    caption(ui, "vectors");
    let mut factor = now;
    fine(ui, 70.0);
    let slider = Slider::new(&mut factor, 1.0..=100_000.0)
        .logarithmic(true)
        .show_value(false);
    let slider = ui.add(slider);
    ui.ctx()
        .accesskit_node_builder(slider.id, |node| node.set_label("Length of vectors"));
    if slider.changed() && factor != now {
        commands.push(Command::Magnify(Some(factor)));
    }
    caption(ui, &format!("× {}", significant(now, 2)));
    let Some(after) = workbench.after() else {
        return;
    };
    let left = after.readable;
    ui.add_space(space::ROW);
    if ui.available_width() > SPELT_OUT {
        caption(ui, "readable");
    }
    let options = [(Some(before), "before"), (Some(left), "after")];
    match widgets::segmented(ui, &options, Some(now)) {
        Some(Some(factor)) if factor == before => commands.push(Command::Magnify(None)),
        Some(factor) => commands.push(Command::Magnify(factor)),
        None => {}
    }
}

/// With so much room the lengths at which vectors can be read have a name before them, points.
const SPELT_OUT: f32 = 340.0;
/// With so much room beside it the list of colours has its name before it, points.
const NAMED: f32 = 48.0;

/// With less room the heat map's name would run into what blends before and after, points.
const BESIDE_THE_BLEND: f32 = 330.0;

/// Whether the error between the samples is shown.
fn heat(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let mut shown = workbench.view().heat;
    let roomy = ui.available_width() > BESIDE_THE_BLEND;
    let text = if roomy { "heat map" } else { "heat" };
    let text = RichText::new(text).size(size::SMALL);
    let says = "the root mean square deviation between the samples, fading away from them";
    let checkbox = ui.checkbox(&mut shown, text).on_hover_text(says);
    ui.ctx()
        .accesskit_node_builder(checkbox.id, |node| node.set_label("heat map"));
    if checkbox.changed() {
        commands.push(Command::Heat(shown));
    }
}

/// What the colour of the vectors says.
fn colouring(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let now = workbench.view().colouring;
    let shown = if offers(workbench.subject(), now) {
        now
    } else {
        Colouring::State
    };
    let text = RichText::new(shown.name()).size(size::SMALL);
    let list = ComboBox::from_id_salt("colouring").selected_text(text);
    let list = list.width(112.0).height(280.0).show_ui(ui, |ui| {
        for colouring in Colouring::ALL {
            if !offers(workbench.subject(), colouring) {
                continue;
            }
            let chosen = colouring == shown;
            if ui.selectable_label(chosen, colouring.name()).clicked() && !chosen {
                commands.push(Command::Colour(colouring));
            }
        }
    });
    ui.ctx()
        .accesskit_node_builder(list.response.id, |node| node.set_label("Colour of vectors"));
    if ui.available_width() > NAMED {
        caption(ui, "colour");
    }
}
