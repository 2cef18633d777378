//! The bar over the workspace plot: from where it is looked at, what is shown, and how.

use egui::{Align, ComboBox, Layout, RichText, Slider, Stroke, Ui, vec2};

use crate::gui::commands::{Command, Workbench};
use crate::gui::pictures::Plot;
use crate::gui::plots::picture;
use crate::gui::subject::Component;
use crate::gui::tokens::{Palette, size, space, strong};
use crate::gui::units::{significant, trimmed};
use crate::gui::view::{Colouring, Plane};
use crate::gui::widgets::{self, Sign, caption, fine, sign, title};

use super::model::{magnification as magnification_of, offers};

/// Shows the bar.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let view = workbench.view();
    let measured = !workbench.subject().is_empty();
    let blends = measured && !view.polar() && workbench.answer().is_some();
    let roomy = ui.available_width() > ROOMY;
    ui.horizontal(|ui| {
        let least = if blends { WITH_BLEND } else { TITLED };
        if ui.available_width() > least {
            title(ui, "Workspace");
        }
        let planes = Plane::ALL.map(|plane| (Some(plane), plane.name()));
        let views = [planes[0], planes[1], planes[2], (None, "polar")];
        let shown = (!view.polar()).then_some(view.plane);
        match widgets::segmented(ui, &views, shown) {
            Some(Some(plane)) => commands.push(Command::Look(plane)),
            Some(None) => commands.push(Command::LookAround),
            None => {}
        }
        if measured && view.polar() {
            component(ui, workbench, commands);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if measured {
                let plot = if view.polar() {
                    Plot::Polar
                } else {
                    Plot::Workspace
                };
                picture(ui, plot, commands);
            }
            fit(ui, commands);
            if measured && view.polar() && workbench.answer().is_some() {
                let shown = [(false, "both"), (true, "only after")];
                if let Some(only) = widgets::segmented(ui, &shown, view.only_after) {
                    commands.push(Command::OnlyAfter(only));
                }
            }
            if blends && roomy {
                ui.add_space(space::TIGHT);
                blend(ui, workbench, commands);
            }
        });
    });
    if !measured {
        return;
    }
    if view.polar() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        magnification(ui, workbench, commands);
        heat(ui, workbench, commands);
        colouring(ui, workbench, commands);
    });
    if blends && !roomy {
        ui.horizontal(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                blend(ui, workbench, commands);
            });
        });
    }
}

/// With less room the plot has no title, and before and after stand in a row of their own, points.
const TITLED: f32 = 400.0;
const WITH_BLEND: f32 = 540.0;
const ROOMY: f32 = 420.0;

/// Four corners: shows everything again. Says how to look at a part.
fn fit(ui: &mut Ui, commands: &mut Vec<Command>) {
    let Sign {
        response,
        rect,
        lit: _,
        color,
    } = sign(ui, "Fit to view");
    let painter = ui.painter();
    let at = |x: f32, y: f32| rect.center() + vec2(x, y);
    for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
        let corner = vec![
            at(6.5 * x, 2.5 * y),
            at(6.5 * x, 6.5 * y),
            at(2.5 * x, 6.5 * y),
        ];
        painter.line(corner, Stroke::new(1.5, color));
    }
    painter.add(crate::gui::plots::disc(rect.center(), 1.8, color));
    let response = response.on_hover_ui(|ui| {
        ui.set_max_width(280.0);
        ui.label(RichText::new("Fit to view").font(strong(size::BODY)));
        for (what, how) in [
            ("everything", "Home, or a double click on the plot"),
            ("closer", "pinch, or ctrl and the wheel"),
            ("a part", "drag with the right button"),
            ("move", "drag, or the wheel"),
        ] {
            ui.label(RichText::new(format!("{what}: {how}")).size(size::SMALL));
        }
    });
    if response.clicked() {
        commands.push(Command::Fit);
    }
}

/// What the polar view shows.
fn component(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let now = workbench.view().component;
    let planar = workbench.subject().session.samples.z_mm.is_none();
    let list = ComboBox::from_id_salt("polar component");
    let text = RichText::new(now.name()).size(size::SMALL);
    let list = list.width(84.0).selected_text(text).show_ui(ui, |ui| {
        for component in Component::ALL {
            if planar && component.out_of_plane() {
                continue;
            }
            let chosen = component == now;
            if ui.selectable_label(chosen, component.name()).clicked() && !chosen {
                commands.push(Command::Component(component));
            }
        }
    });
    ui.ctx().accesskit_node_builder(list.response.id, |node| {
        node.set_label("Component of the polar view");
    });
}

/// From before to after. What stands at the end that is shown is written stronger.
fn blend(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let mut blend = workbench.view().blend;
    let palette = Palette::of(ui);
    let end = |ui: &mut Ui, text: &str, shown: bool| {
        let text = RichText::new(text).size(size::SMALL);
        let text = if shown {
            text.color(palette.text).strong()
        } else {
            text.color(palette.muted)
        };
        ui.label(text);
    };
    end(ui, "after", blend >= 1.0);
    fine(ui, 64.0);
    let slider = ui.add(Slider::new(&mut blend, 0.0..=1.0).show_value(false));
    ui.ctx()
        .accesskit_node_builder(slider.id, |node| node.set_label("From before to after"));
    if slider.changed() {
        commands.push(Command::Blend(blend));
    }
    slider.on_hover_text(blend_says(blend));
    end(ui, "before", blend <= 0.0);
}

/// What the vectors, the marks and the heat map show.
fn blend_says(blend: f32) -> String {
    if blend <= 0.0 {
        "shown: the deviation before, measured − nominal robot".to_owned()
    } else if blend >= 1.0 {
        "shown: what is left after, measured − identified robot".to_owned()
    } else {
        let percent = trimmed(100.0 * f64::from(blend), 0);
        format!("shown: {percent} % of the way from before to after")
    }
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

/// Whether the error between the samples is shown.
fn heat(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let mut shown = workbench.view().heat;
    let text = RichText::new("heat map").size(size::SMALL);
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
    caption(ui, "colour");
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
}
