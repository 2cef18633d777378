//! What is known before anything is identified: what the samples cover, what can be seen in them,
//! and what comes next. So that the right-hand side helps from the first minute on.

use crate::language::spoken;
use egui::{RichText, Ui};

use crate::gui::style::{Palette, size, strong};
use crate::gui::view::Step;
use crate::gui::widgets::{self, Words};
use crate::gui::workbench::Workbench;
use crate::present::names::title;
use crate::present::numbers::grouped;

/// Shows it, what belongs to the step first.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    if workbench.loaded_session().is_empty() {
        return;
    }
    match workbench.view.step {
        Step::Session | Step::Regions | Step::Identify => {
            gap(ui, workbench);
            testable(ui, workbench);
        }
        Step::Gap => {
            if workbench.searching().is_none() && workbench.stopped().is_none() {
                search(ui);
            }
            testable(ui, workbench);
        }
        Step::Export => {
            formats(ui);
            gap(ui, workbench);
        }
    }
}

/// How far off the nominal robot is.
fn gap(ui: &mut Ui, workbench: &Workbench) {
    let units = workbench.units();
    let loaded_session = workbench.loaded_session();
    widgets::card(ui, |ui| {
        let name = ui.weak(say!("RMS error, nominal robot"));
        widgets::explained(name, crate::gui::help::GAP);
        let rms = loaded_session.gap_before;
        let rms = rms.map_or_else(|| "–".to_owned(), |g| units.length(g.rms_mm));
        let rms = RichText::new(rms).font(strong(size::DISPLAY));
        ui.label(rms.color(Palette::of(ui).before));
        if let Some(gap) = loaded_session.gap_before {
            ui.fact(say!("largest deviation"), units.length(gap.max_mm));
        }
        if let Some(tolerance_mm) = workbench.document().tolerance_mm {
            let (inside, all) = loaded_session.overview.lengths.within(tolerance_mm);
            let (inside, all) = (grouped(inside), grouped(all));
            let within = say!("{inside} of {all}", inside, all);
            ui.fact(say!("within tolerance"), within);
        }
        if let Some(floor_mm) = loaded_session.coverage.floor_mm {
            let floor = say!("{floor}, instrument", floor = units.length(floor_mm));
            ui.fact(say!("noise floor"), floor);
        }
        if !workbench.document().identified {
            ui.hint(say!(
                "Not identified yet. The identified parameters will be listed here, each with its 95 % interval"
            ));
        }
    });
}

/// Which effects can be seen in such samples, and which cannot.
fn testable(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    widgets::card(ui, |ui| {
        let known = &loaded_session.coverage;
        let (yes, no) = (known.testable.len(), known.not_testable.len());
        let says = say!("{inside} of {all}", inside = yes, all = yes + no);
        ui.fact(say!("testable effects"), says);
        let can = say!("{yes} can be tested", yes);
        ui.folded(&can, |ui| {
            let names = known.testable.iter();
            let names: Vec<&str> = names.map(|id| title(id)).collect();
            ui.hint(names.join(", ").to_lowercase());
        });
        if no > 0 {
            let cannot = say!("{no} cannot, and why", no);
            ui.folded(&cannot, |ui| not_testable(ui, workbench));
        }
    });
}

/// The effects that cannot be seen, each with the reason.
pub(super) fn not_testable(ui: &mut Ui, workbench: &Workbench) {
    for one in &workbench.loaded_session().coverage.not_testable {
        ui.label(title(one.effect));
        ui.hint(spoken(&one.because));
    }
}

/// What a search does, before there is one.
fn search(ui: &mut Ui) {
    widgets::card(ui, |ui| {
        ui.bold(say!("No diagnosis yet"));
        ui.hint(say!(
            "Effects that are found will be listed here with size, confidence and what to check on the machine. Where the samples cannot decide, both are listed, with the poses that would decide"
        ));
    });
}

/// What can be written, before there is anything to write.
fn formats(ui: &mut Ui) {
    widgets::card(ui, |ui| {
        ui.bold(say!("There is nothing to export yet"));
        ui.hint(say!(
            "The table comes from the identified robot. It will be shown here as text, with its sign convention in words, the RMS error that it leaves, and what joint commands cannot correct"
        ));
    });
}
