//! What would have been seen, and what could not be.

use egui::{CollapsingHeader, RichText, Ui};

use crate::diagnosis::{Diagnosis, Sight};
use crate::gui::style::tokens::{Palette, size};
use crate::gui::units::{number_of, significant};
use crate::gui::views::copies;
use crate::gui::views::names::{named, title_of};
use crate::gui::widgets::{self};

pub(super) fn show(ui: &mut Ui, d: &Diagnosis) {
    if d.not_found.is_empty() {
        return;
    }
    let number = number_of(d.not_found.len(), "effect");
    let text = format!("Detection limits: {number}");
    folded(ui, text, |ui| {
        for limit in &d.not_found {
            let name = limit.joint.filter(|_| d.model.robot.joints.len() > 1);
            let name = name.map_or(limit.effect.to_owned(), |j| {
                format!("{} {}", limit.effect, j + 1)
            });
            ui.label(title_of(&name));
            let sizes = limit.sizes.iter().map(|(name, size)| {
                let (name, unit) = named(name);
                match Sight::of(*size) {
                    Sight::Above(size) => {
                        format!("{name} above {} {unit} (95 %)", significant(size, 2))
                    }
                    Sight::AtAnySize => format!("{name} of any size: there is no noise"),
                    Sight::AtNoSize => format!("{name} at no size, by these poses"),
                }
            });
            widgets::hint(ui, sizes.collect::<Vec<_>>().join(", "));
        }
        copies::button(ui, "detection limits", || copies::limits(d));
    });
}

pub(super) fn not_testable(ui: &mut Ui, d: &Diagnosis) {
    if d.not_testable.is_empty() {
        return;
    }
    let text = format!(
        "Not testable: {}",
        number_of(d.not_testable.len(), "effect")
    );
    folded(ui, text, |ui| {
        for one in &d.not_testable {
            let name = one.joint.filter(|_| d.model.robot.joints.len() > 1);
            let name = name.map_or(one.effect.to_owned(), |j| {
                format!("{} {}", one.effect, j + 1)
            });
            ui.label(title_of(&name));
            widgets::hint(ui, &one.because);
        }
    });
}

fn folded(ui: &mut Ui, text: String, contents: impl FnOnce(&mut Ui)) {
    let muted = Palette::of(ui).muted;
    let title = RichText::new(text.clone()).size(size::SMALL).color(muted);
    CollapsingHeader::new(title)
        .id_salt(text)
        .show(ui, contents);
}
