//! Tables as text for a spreadsheet: tabs between the columns, full digits, the decimal sign that
//! the user chose.

use egui::{Button, RichText, Ui, vec2};

use crate::effects::find;
use crate::gui::tokens::{size, space};
use crate::gui::units::{cell, plain_number};
use crate::gui::widgets;
use crate::identification::{Estimate, RegionResult};
use crate::units::deg_from_rad;

use super::results::named;

/// A button that copies a table.
pub(super) fn button(ui: &mut Ui, of: &str, text: impl FnOnce() -> String) {
    ui.add_space(space::TIGHT);
    // Higher than the rows of a dense table: it is pressed, not read.
    let button = Button::new(RichText::new("Copy table").size(size::SMALL));
    let button = ui.add(button.min_size(vec2(0.0, 22.0)));
    ui.ctx().accesskit_node_builder(button.id, |node| {
        node.set_label(format!("Copy table of {of}"));
    });
    if button.clicked() {
        ui.copy_text(text());
    }
}

/// The mark in a chart's bar that copies its numbers.
pub(super) fn chart_button(ui: &mut Ui, of: &str, text: impl FnOnce() -> String) {
    let says = format!("Copy numbers: {}", of.to_lowercase());
    if widgets::copy_button(ui, &says).clicked() {
        ui.copy_text(text());
    }
}

/// Every parameter with its interval.
pub(super) fn parameters(estimates: &[Estimate]) -> String {
    let mut text = "effect\tjoint\tparameter\tvalue\t95 % from\t95 % to\tunit\n".to_owned();
    for one in estimates {
        let (name, unit) = named(one.name);
        let [from, to] = ends(one.ci95);
        row(
            &mut text,
            &[
                find(one.effect)
                    .map_or(one.effect, |e| e.about().title)
                    .to_owned(),
                one.joint
                    .map_or_else(String::new, |joint| joint.to_string()),
                name,
                plain_number(one.value),
                from,
                to,
                unit.to_owned(),
            ],
        );
    }
    text
}

/// Every region's correction with its intervals.
pub(super) fn regions(results: &[RegionResult]) -> String {
    let mut text = "region\tfrom, deg\tto, deg\tsamples\tdtheta, rad\t95 % from\t95 % to\t\
                    dl1, mm\t95 % from\t95 % to\tgap before, mm\tgap after, mm\n"
        .to_owned();
    for result in results {
        let correction = &result.correction;
        let ([theta_from, theta_to], [l1_from, l1_to]) =
            (ends(result.theta_ci95), ends(result.l1_ci95));
        row(
            &mut text,
            &[
                cell(&correction.name),
                plain_number(deg_from_rad(correction.from_rad)),
                plain_number(deg_from_rad(correction.to_rad)),
                correction.samples.to_string(),
                plain_number(correction.theta_rad),
                theta_from,
                theta_to,
                plain_number(correction.l1_mm),
                l1_from,
                l1_to,
                plain_number(result.rms_before_mm),
                plain_number(result.rms_after_mm),
            ],
        );
    }
    text
}

fn ends(interval: Option<[f64; 2]>) -> [String; 2] {
    interval.map_or_else(Default::default, |ends| ends.map(plain_number))
}

fn row(text: &mut String, cells: &[String]) {
    *text += &cells.join("\t");
    text.push('\n');
}
