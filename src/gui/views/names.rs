//! How panels name effects and parameters, and the few cards that several of them show.

use egui::{RichText, Ui};

use crate::effects::find;
use crate::fit::{Estimate, IMPLAUSIBLE, NotIdentifiable};
use crate::gui::charts::effect;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

pub(in crate::gui::views) fn title(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::BODY)));
}

/// A name in words, with its joint where there are several.
pub(in crate::gui::views) fn in_words(
    id: &str,
    joint: Option<usize>,
    workbench: &Workbench,
) -> String {
    let title = find(id).map_or(id, |e| e.about().title);
    let joints = workbench.subject().session.robot.joints.len();
    match joint {
        Some(joint) if joints > 1 => format!("{title}, joint {joint}"),
        _ => title.to_owned(),
    }
}

/// Names in words; one with its joint is `id joint`.
pub(in crate::gui::views) fn titles(names: &[String]) -> String {
    let all = names.iter().map(|name| title_of(name).to_lowercase());
    all.collect::<Vec<_>>().join(" and ")
}

/// A name in words, with its joint where it has one.
pub(in crate::gui::views) fn title_of(name: &str) -> String {
    let (id, joint) = name.split_once(' ').unwrap_or((name, ""));
    let title = find(id).map_or(id, |e| e.about().title);
    if joint.is_empty() {
        title.to_owned()
    } else {
        format!("{title}, joint {joint}")
    }
}

/// A parameter's name and its unit, as people write them.
pub(in crate::gui::views) fn named(parameter: &str) -> (String, &'static str) {
    const UNITS: [(&str, &str); 16] = [
        ("_urad_per_nm", "µrad/(N·m)"),
        ("_mm_per_kg", "mm/kg"),
        ("_mm_per_h", "mm/h"),
        ("_ppm_per_degc", "ppm/°C"),
        ("ppm_per_degc", "ppm/°C"),
        ("mm_per_kg", "mm/kg"),
        ("deg_per_degc", "°/°C"),
        ("_ppm", "ppm"),
        ("_mrad", "mrad"),
        ("_rad", "rad"),
        ("_deg", "°"),
        ("_mm", "mm"),
        ("_um", "µm"),
        ("_s", "s"),
        ("_kg", "kg"),
        ("_c", "°C"),
    ];
    for (suffix, unit) in UNITS {
        if let Some(name) = parameter.strip_suffix(suffix) {
            let name = if name.is_empty() { "rate" } else { name };
            return (name.replace('_', " "), unit);
        }
    }
    (parameter.replace('_', " "), "")
}

/// Says which sizes no machine has.
pub(in crate::gui::views) fn implausible(ui: &mut Ui, estimates: &[Estimate]) {
    let warning = Palette::of(ui).warning;
    for one in estimates.iter().filter(|one| one.is_implausible()) {
        let usual = find(one.effect).map_or("", |e| e.about().usual_size);
        let text = format!("{}: {IMPLAUSIBLE} ({usual})", named(one.name).0);
        ui.label(RichText::new(text).color(warning));
    }
}

/// The card of what the samples do not determine.
pub(in crate::gui::views) fn not_identifiable(ui: &mut Ui, all: &[NotIdentifiable]) {
    if all.is_empty() {
        return;
    }
    widgets::card(ui, |ui| {
        title(ui, "Not identifiable");
        for one in all {
            ui.label(&one.combination);
            widgets::hint(ui, &one.because);
        }
    });
}

/// Shows what an effect does, in the chart.
pub(in crate::gui::views) fn curve_link(
    ui: &mut Ui,
    workbench: &Workbench,
    index: usize,
    commands: &mut Vec<Command>,
) {
    let view = workbench.view();
    let shown = workbench.chart().about().id == effect::ID && view.effect == index;
    let button = ui.add_enabled_ui(!shown, |ui| widgets::secondary(ui, "Show its curve"));
    if button.inner.clicked() {
        commands.push(Command::ShowEffect(index));
    }
}
