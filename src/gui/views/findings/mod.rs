//! What a search found: the verdict, names with their evidence, what cannot be told apart, what no
//! name explains, and what to measure next.

mod card;
mod data;
mod hidden;
mod limits;
mod next;

use egui::{RichText, Ui};

use crate::diagnosis::{Diagnosis, FloorFrom, Stopped, Verdict};
use crate::gui::jobs::Running;
use crate::gui::style::tokens::{Palette, size, space, strong};
use crate::gui::workbench::{Command, Workbench};
use crate::gui::{help, widgets};
use crate::present::numbers::{grouped, significant};

use crate::gui::views::names::{curve_link, not_identifiable, title, titles};
use crate::gui::views::{copies, unexplained};
use crate::language::names::title_of;
use crate::language::of_core;

pub(in crate::gui::views) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    widgets::heading(ui, say!("Diagnosis"));
    ui.add_space(space::TIGHT);
    widgets::scroll(ui, "findings", |ui| {
        ui.spacing_mut().item_spacing.y = space::ROW;
        let beneath = if workbench.searching().is_some() {
            under_way(ui, workbench);
            None
        } else {
            stopped(ui, workbench);
            workbench.searched()
        };
        match beneath {
            None => crate::gui::views::coverage::show(ui, workbench),
            Some(Err(because)) => widgets::hint(ui, because),
            Some(Ok(diagnosis)) => all(ui, workbench, diagnosis, commands),
        }
    });
}

/// A diagnosis is running: what it has found so far.
fn under_way(ui: &mut Ui, workbench: &Workbench) {
    let found = workbench.searching().map(Running::found);
    let says = match found.as_ref().map_or(0, Vec::len) {
        0 => say!("Nothing found so far"),
        _ => say!("Found so far; a likelier name may take the place of one"),
    };
    so_far(
        ui,
        say!("Diagnosis is running"),
        says,
        &found.unwrap_or_default(),
    );
}

/// What a diagnosis that was stopped had found until then.
fn stopped(ui: &mut Ui, workbench: &Workbench) {
    let Some(found) = workbench.stopped() else {
        return;
    };
    let says = match found.len() {
        0 => say!("It had found nothing until then"),
        _ => {
            say!(
                "Found until then, not yet tested against other names: run the diagnosis again to test them"
            )
        }
    };
    so_far(ui, say!("Diagnosis stopped"), says, found);
}

fn so_far(ui: &mut Ui, name: &str, says: &str, found: &[String]) {
    widgets::card(ui, |ui| {
        title(ui, name);
        widgets::hint(ui, says);
        for name in found {
            let label = ui.label(title_of(name));
            let id = name.split(' ').next().unwrap_or(name);
            widgets::explained_effect(label, id);
        }
    });
}

fn all(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis, commands: &mut Vec<Command>) {
    verdict(ui, workbench, d);
    hidden::show(ui, workbench, d);
    data::show(ui, d, commands);
    for (index, found) in d.found.iter().enumerate() {
        widgets::card(ui, |ui| {
            card::show(ui, workbench, d, found, commands);
            curve_link(ui, workbench, index, commands);
        });
    }
    if !d.found.is_empty() {
        copies::button(ui, say!("found effects"), || copies::found(d));
    }
    equivalent(ui, d);
    unexplained::card(ui, workbench, d, commands);
    if !d.next_poses.is_empty() {
        widgets::card(ui, |ui| next::show(ui, workbench, &d.next_poses, commands));
    }
    excluded(ui, workbench, d);
    not_identifiable(ui, &d.identification.not_identifiable);
    limits::show(ui, d);
    limits::not_testable(ui, d);
}

fn verdict(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let palette = Palette::of(ui);
    let units = workbench.units();
    let (says, color) = match d.verdict {
        Verdict::Noise => (say!("Nothing is missing"), palette.within),
        Verdict::Explained => (
            say!("Explained: the remaining error is at the noise floor"),
            palette.within,
        ),
        Verdict::PartlyExplained => (
            say!("Partly explained: an error is left without a name"),
            palette.warning,
        ),
        Verdict::Unexplained => (say!("Not explained by any effect"), palette.warning),
    };
    let from = match d.floor.from {
        FloorFrom::Repeats => say!("from repeats"),
        FloorFrom::Instrument => say!("of the instrument"),
        FloorFrom::Estimated => say!("estimated"),
    };
    widgets::card(ui, |ui| {
        let says = RichText::new(says).font(strong(size::HEADING));
        ui.label(says.color(color));
        if d.stopped == Some(Stopped::Asked) {
            let says = say!("Diagnosis stopped");
            ui.label(RichText::new(says).color(palette.warning));
        }
        if !d.tested_anything() {
            let none =
                say!("these samples can show no effect: that nothing was found says nothing");
            ui.label(RichText::new(none).color(palette.warning));
        }
        if !d.equivalent.is_empty() {
            let also = say!("the samples also allow another explanation, see below");
            ui.label(RichText::new(also).color(palette.warning));
        }
        let mm = |mm: f64| units.length_number(mm);
        let gaps = format!(
            "{} → {} → {} {}",
            mm(d.gap.start_mm),
            mm(d.gap.identified_mm),
            mm(d.gap.end_mm),
            units.length_name()
        );
        widgets::fact_of(ui, phrase!("RMS error"), gaps);
        if let Some(unseen) = &d.held_out.gaps {
            let gaps = format!("{} → {}", mm(unseen.identified_mm), mm(unseen.end_mm));
            widgets::fact_of(
                ui,
                phrase!("held out"),
                format!("{gaps} {}", units.length_name()),
            );
        }
        let floor = format!("{}, {from}", units.length(d.floor.mm));
        widgets::fact_of(ui, phrase!("noise floor"), floor);
        noise(ui, workbench, d);
        widgets::hint(ui, say!("Held out: {how}", how = of_core(&d.held_out.how)));
    });
}

/// What there is to say of the noise, and of a fit that cannot be relied on.
fn noise(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let units = workbench.units();
    if let Some(noise) = &d.unexplained.noise {
        widgets::fact_of(
            ui,
            phrase!("noise σ, stated"),
            units.length(noise.stated_mm),
        );
        widgets::fact_of(
            ui,
            phrase!("noise σ, as found"),
            units.length(noise.found_mm),
        );
    }
    if let Some(slow) = &d.noise.slow {
        let says = say!("Slow noise: {slow}", slow = of_core(&slow.says()));
        widgets::hint_about(ui, says, help::SLOW_NOISE);
    }
    let quality = &d.identification.quality;
    if !quality.converged {
        let says = say!(
            "the fit did not converge: {stopped}",
            stopped = quality.stopped
        );
        ui.label(RichText::new(says).color(Palette::of(ui).warning));
    }
}

fn equivalent(ui: &mut Ui, d: &Diagnosis) {
    if d.equivalent.is_empty() {
        return;
    }
    widgets::card(ui, |ui| {
        title(ui, say!("The samples cannot rule out"));
        for one in &d.equivalent {
            ui.label(say!(
                "{instead} instead of {explanation}",
                instead = titles(&one.instead),
                explanation = titles(&one.explanation)
            ));
            let odds = significant(one.odds, 2);
            widgets::hint(
                ui,
                say!(
                    "{odds} : 1 against it. {separate_by}",
                    odds = odds,
                    separate_by = of_core(&one.separate_by)
                ),
            );
        }
    });
}

fn excluded(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    const MOST: usize = 8;
    if let Some(says) = d.identification.excluded_in_words() {
        widgets::card(ui, |ui| {
            title(ui, say!("Excluded by hand"));
            widgets::hint(ui, says);
        });
    }
    if d.outliers.is_empty() {
        return;
    }
    widgets::card(ui, |ui| {
        let (excluded, all) = (d.outliers.len(), grouped(d.samples));
        title(
            ui,
            &say!(
                "Excluded outliers: {excluded} of {all}",
                excluded = excluded,
                all = all
            ),
        );
        for one in d.outliers.iter().take(MOST) {
            let off = workbench.units().length(one.deviation_mm);
            widgets::fact(ui, &say!("sample {sample}", sample = one.sample + 1), off);
        }
        if d.outliers.len() > MOST {
            widgets::hint(ui, say!("and {more} more", more = d.outliers.len() - MOST));
        }
    });
}
