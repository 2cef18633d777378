//! A name that was found: its values, its evidence, what to check, and whether it is in the model.

use egui::{Grid, RichText, Ui};

use crate::diagnosis::{Diagnosis, Found};
use crate::fit::Estimate;
use crate::gui::core::edit::Edit;
use crate::gui::core::search::term_of;
use crate::gui::help;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::views::names::{implausible, in_words};
use crate::gui::widgets::{self, dense};
use crate::gui::workbench::{Command, Workbench};
use crate::language::names::{figure, parameter, title_of};
use crate::language::of_core;
use crate::present::numbers::significant;
use crate::present::units::Units;
use crate::text::within;

pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    d: &Diagnosis,
    found: &Found,
    commands: &mut Vec<Command>,
) {
    let units = workbench.units();
    let name = in_words(found.effect, found.joint, workbench);
    let head = ui.label(RichText::new(&name).font(strong(size::HEADING)));
    widgets::explained_effect(head, found.effect);
    ui.scope(|ui| {
        dense(ui);
        estimates(ui, units, found.effect, &found.parameters);
        for one in &found.figures {
            widgets::hint(ui, figure(*one));
        }
        let sign = if found.p_family.bound { '<' } else { '=' };
        widgets::hint_about(
            ui,
            say!(
                "p {sign} {p} (chance that noise alone looks like this)",
                sign = sign,
                p = found.p_family.p
            ),
            help::P_FAMILY,
        );
        if let Some(next) = &found.next {
            let odds = if found.odds_over_next > 1000.0 {
                say!("More than 1000").to_owned()
            } else {
                significant(found.odds_over_next, 2)
            };
            let next = within(&title_of(next)).into_owned();
            let text = say!(
                "{odds} times likelier than the next candidate, {next}",
                odds = odds,
                next = next
            );
            widgets::hint_about(ui, text, help::ODDS);
        }
    });
    let mm = |mm: f64| units.length_number(mm);
    let from_to = |[a, b]: [f64; 2]| format!("{} → {} {}", mm(a), mm(b), units.length_name());
    match found.held_out_mm {
        Some(gap) => widgets::fact_of(ui, phrase!("cross-validated RMS error"), from_to(gap)),
        None => widgets::fact_of(ui, phrase!("RMS error"), from_to(found.gap_mm)),
    }
    widgets::fact_of(ui, phrase!("noise floor"), units.length(d.floor.mm));
    ui.label(RichText::new(say!("What to check")).font(strong(size::SMALL)));
    widgets::hint(ui, of_core(found.check));
    let Some(term) = term_of(d, found) else {
        return;
    };
    let mut added = workbench.document().added.iter();
    match added.position(|a| a.term.same_column(&term)) {
        None => {
            // The button that stands out is the one at the foot of the step, which adds all of them.
            if widgets::secondary(ui, say!("Add to model")).clicked() {
                commands.push(Command::Edit(Edit::Add(vec![term])));
            }
        }
        Some(index) => {
            let mut on = workbench.document().added[index].on;
            if ui.checkbox(&mut on, say!("in the model")).changed() {
                commands.push(Command::Edit(Edit::Switch(index, on)));
            }
        }
    }
}

fn estimates(ui: &mut Ui, units: Units, id: &str, parameters: &[Estimate]) {
    let palette = Palette::of(ui);
    Grid::new(("found", id))
        .num_columns(3)
        .spacing([10.0, 4.0])
        .min_col_width(0.0)
        .show(ui, |ui| {
            for one in parameters {
                let (name, unit) = parameter(one.name);
                let (value, half, unit) = units.estimate(one, unit);
                ui.label(name);
                widgets::cell_right(ui, RichText::new(value).font(strong(size::BODY)));
                ui.label(
                    RichText::new(format!("{} {unit}", of_core(&half)).trim_end())
                        .color(palette.muted),
                );
                ui.end_row();
            }
        });
    implausible(ui, parameters);
}
