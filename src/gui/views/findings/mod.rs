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

use crate::gui::language::names::title_of;
use crate::gui::language::of_core;
use crate::gui::views::names::{curve_link, not_identifiable, title, titles};
use crate::gui::views::{copies, unexplained};

pub(in crate::gui::views) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    widgets::heading(ui, say!("diagnosis-diagnosis"));
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
        0 => say!("diagnosis-nothing-found-so-far"),
        _ => say!("diagnosis-found-so-far-a-likelier"),
    };
    so_far(
        ui,
        say!("diagnosis-diagnosis-is-running"),
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
        0 => say!("diagnosis-it-had-found-nothing-until"),
        _ => {
            say!("diagnosis-found-until-then-not-yet")
        }
    };
    so_far(ui, say!("diagnosis-diagnosis-stopped"), says, found);
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
        copies::button(ui, say!("diagnosis-found-effects"), || copies::found(d));
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
        Verdict::Noise => (say!("diagnosis-nothing-is-missing"), palette.within),
        Verdict::Explained => (
            say!("diagnosis-explained-the-remaining-error"),
            palette.within,
        ),
        Verdict::PartlyExplained => (say!("diagnosis-partly-explained-an-error"), palette.warning),
        Verdict::Unexplained => (
            say!("diagnosis-not-explained-by-any-effect"),
            palette.warning,
        ),
    };
    let from = match d.floor.from {
        FloorFrom::Repeats => say!("diagnosis-from-repeats"),
        FloorFrom::Instrument => say!("diagnosis-of-the-instrument"),
        FloorFrom::Estimated => say!("common-estimated"),
    };
    widgets::card(ui, |ui| {
        let says = RichText::new(says).font(strong(size::HEADING));
        ui.label(says.color(color));
        if d.stopped == Some(Stopped::Asked) {
            let says = say!("diagnosis-diagnosis-stopped");
            ui.label(RichText::new(says).color(palette.warning));
        }
        if !d.tested_anything() {
            let none = say!("diagnosis-these-samples-can-show-no");
            ui.label(RichText::new(none).color(palette.warning));
        }
        if !d.equivalent.is_empty() {
            let also = say!("diagnosis-the-samples-also-allow-another");
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
        widgets::fact_of(ui, "common-rms-error", gaps);
        if let Some(unseen) = &d.held_out.gaps {
            let gaps = format!("{} → {}", mm(unseen.identified_mm), mm(unseen.end_mm));
            widgets::fact_of(
                ui,
                "common-held-out",
                format!("{gaps} {}", units.length_name()),
            );
        }
        let floor = format!("{}, {from}", units.length(d.floor.mm));
        widgets::fact_of(ui, "common-noise-floor", floor);
        noise(ui, workbench, d);
        widgets::hint(
            ui,
            say!("diagnosis-held-out", how = of_core(&d.held_out.how)),
        );
    });
}

/// What there is to say of the noise, and of a fit that cannot be relied on.
fn noise(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let units = workbench.units();
    if let Some(noise) = &d.unexplained.noise {
        widgets::fact_of(ui, "diagnosis-noise-stated", units.length(noise.stated_mm));
        widgets::fact_of(ui, "diagnosis-noise-as-found", units.length(noise.found_mm));
    }
    if let Some(slow) = &d.noise.slow {
        let says = say!("diagnosis-slow-noise", slow = of_core(&slow.says()));
        widgets::hint_about(ui, says, help::SLOW_NOISE);
    }
    let quality = &d.identification.quality;
    if !quality.converged {
        let says = say!("common-the-fit-did-not-converge", stopped = quality.stopped);
        ui.label(RichText::new(says).color(Palette::of(ui).warning));
    }
}

fn equivalent(ui: &mut Ui, d: &Diagnosis) {
    if d.equivalent.is_empty() {
        return;
    }
    widgets::card(ui, |ui| {
        title(ui, say!("diagnosis-the-samples-cannot-rule-out"));
        for one in &d.equivalent {
            ui.label(say!(
                "diagnosis-instead",
                instead = titles(&one.instead),
                explanation = titles(&one.explanation)
            ));
            let odds = significant(one.odds, 2);
            widgets::hint(
                ui,
                say!(
                    "diagnosis-1-against",
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
            title(ui, say!("diagnosis-excluded-by-hand"));
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
                "diagnosis-excluded-outliers",
                excluded = excluded,
                all = all
            ),
        );
        for one in d.outliers.iter().take(MOST) {
            let off = workbench.units().length(one.deviation_mm);
            widgets::fact(ui, &say!("common-sample", sample = one.sample + 1), off);
        }
        if d.outliers.len() > MOST {
            widgets::hint(
                ui,
                say!("diagnosis-and-more", more = d.outliers.len() - MOST),
            );
        }
    });
}
