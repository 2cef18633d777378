//! Step 4: search for what is missing.

use crate::text::{spoken, within};
use egui::{ProgressBar, RichText, Ui};

use super::blocks::in_words;
use super::coverage::count_testable;
use crate::diagnosis::Verdict;
use crate::gui::core::answer::{SEARCHING, STAGES};
use crate::gui::core::document::Method;
use crate::gui::style::{Palette, size, strong};
use crate::gui::view::Step;
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    if workbench.loaded_session().is_empty() {
        widgets::hint(
            ui,
            say!("Open a session that was measured on this robot first"),
        );
        return;
    }
    widgets::hint(
        ui,
        say!(
            "Finds the physical effects that the model lacks. Each is checked on samples that its fit has not used (cross-validation)"
        ),
    );
    if workbench.searching().is_some() {
        stages(ui, workbench);
        return;
    }
    if workbench.diagnosis().is_some() {
        widgets::section(ui, say!("RMS error"));
        errors(ui, workbench);
        widgets::secondary(ui, say!("Run diagnosis again")).does(workbench, Workbench::search);
    } else {
        before(ui, workbench);
    }
    // Without a diagnosis it was restored after a kill, or the samples are others: what was added stays in the model.
    switches(ui, workbench);
}

/// The errors step by step, as a diagnosis has them, or as far as they are known without one.
fn errors(ui: &mut Ui, workbench: &Workbench) {
    let (found, loaded_session) = (workbench.diagnosis(), workbench.loaded_session());
    let [nominal, identified, floor] = match (found, workbench.answer()) {
        (Some(d), _) => [d.gap.start_mm, d.gap.identified_mm, d.floor.mm].map(Some),
        (None, answer) => [
            loaded_session.gap_before.map(|gap| gap.rms_mm),
            answer.map(|a| a.identification.gap.after.rms_mm),
            loaded_session.coverage.floor_mm,
        ],
    };
    let left = workbench.left_by_table_mm().filter(|_| found.is_some());
    let fact_of = |ui: &mut Ui, name, mm: Option<f64>| {
        if let Some(mm) = mm {
            widgets::fact_of(ui, name, workbench.units().length(mm));
        }
    };
    fact_of(ui, phrase!("nominal robot"), nominal);
    fact_of(ui, phrase!("identified"), identified);
    let end = found.map(|d| d.gap.end_mm);
    fact_of(ui, phrase!("with found effects"), end);
    fact_of(ui, phrase!("left by the table"), left);
    fact_of(ui, phrase!("noise floor"), floor);
}

/// Where the work stands before there is a search.
fn before(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    widgets::section(ui, say!("RMS error so far"));
    errors(ui, workbench);
    let answer = workbench.answer();
    let left = answer.map(|a| a.identification.gap.after.rms_mm);
    let floor = loaded_session.coverage.floor_mm;
    let says = match (left, floor) {
        (None, _) => say!("The diagnosis identifies by itself: Identify need not come first"),
        (Some(left), Some(floor)) if left < 1.2 * floor => {
            say!(
                "Little error is left above the instrument's noise. The diagnosis says where nothing is missing, with the detection limits"
            )
        }
        (Some(_), Some(_)) => {
            say!("More error is left than noise explains: something is missing in the model")
        }
        (Some(_), None) => {
            say!(
                "The noise of the instrument is not stated: the diagnosis estimates it from the samples"
            )
        }
    };
    widgets::hint(ui, says);
    let document = workbench.document();
    if document.loaded_model.is_some() || document.identified && document.method == Method::Regional
    {
        let says = say!(
            "The diagnosis starts from the full model, which takes the place of what is identified now. Undo brings that back"
        );
        widgets::hint(ui, says);
    }
    widgets::section(ui, say!("What it can find"));
    let [_, no] = count_testable(ui, workbench);
    if no > 0 {
        widgets::hint(
            ui,
            say!(
                "Why the others are not testable is listed at the right, with what to measure for them"
            ),
        );
    }
}

/// Where the search is.
fn stages(ui: &mut Ui, workbench: &Workbench) {
    let Some(running) = workbench.searching() else {
        return;
    };
    let palette = Palette::of(ui);
    widgets::section(ui, say!("Diagnosing"));
    let (reached, found) = (running.stage(), running.found());
    for (k, stage) in STAGES.into_iter().enumerate() {
        let text = RichText::new(spoken(stage));
        ui.label(match k.cmp(&reached) {
            std::cmp::Ordering::Less => text.color(palette.within),
            std::cmp::Ordering::Equal => text.font(strong(size::BODY)),
            std::cmp::Ordering::Greater => text.color(palette.muted),
        });
        // The results name them, where they are in sight.
        let named = crate::gui::actions::layout(ui.ctx(), workbench).results();
        if k == SEARCHING && !named {
            names_so_far(ui, &found);
        }
    }
    let bar = ProgressBar::new(running.progress().unwrap_or(0.0));
    ui.add(bar.desired_height(8.0).fill(palette.accent));
    widgets::look_again_soon(ui);
}

/// What was found so far; a later step may exchange it for something likelier.
fn names_so_far(ui: &mut Ui, found: &[String]) {
    for name in found {
        let title = crate::present::names::title_of(name);
        ui.indent((say!("found so far"), name), |ui| ui.label(title));
    }
    if !found.is_empty() {
        widgets::hint(
            ui,
            say!("so far; a likelier name may take the place of one"),
        );
    }
}

/// What each effect is worth: switched off and on.
pub(super) fn switches(ui: &mut Ui, workbench: &Workbench) {
    let added = &workbench.document().added;
    if added.is_empty() {
        return;
    }
    widgets::section(ui, say!("In the model"));
    for (index, one) in added.iter().enumerate() {
        let mut on = one.on;
        let about = one.term.effect.about();
        let joint = about.per_joint.then_some(one.term.joint + 1);
        let name = in_words(about.id, joint, workbench);
        let switch = ui.checkbox(&mut on, &name);
        widgets::label(&switch, say!("use {effect}", effect = within(&name)));
        if switch.changed() {
            workbench.then(move |bench| bench.switch(index, on));
        }
    }
}

/// What the step has to show for itself.
pub(super) fn state(workbench: &Workbench) -> (String, bool) {
    if workbench.searching().is_some() {
        return (say!("searching").to_owned(), false);
    }
    let on = workbench.document().in_the_model().count();
    let caption = match (workbench.diagnosis(), on) {
        (_, 1) => say!("one effect in the model").to_owned(),
        (_, 2..) => say!("{on} effects in the model", on),
        (None, _) => return (say!("not yet").to_owned(), false),
        (Some(diagnosis), _) => match (diagnosis.verdict, diagnosis.found.len()) {
            (Verdict::Noise, _) => say!("nothing is missing").to_owned(),
            (Verdict::Unexplained, _) => say!("something unexplained").to_owned(),
            (_, 1) => say!("one effect found").to_owned(),
            (_, n) => say!("{n} effects found", n),
        },
    };
    (caption, true)
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    if workbench.searching().is_some() {
        // It lies where it was started: the second click of a double click is not meant for it.
        let meant = widgets::has_stood(ui, "stop the search");
        let stop = |ui: &mut Ui| widgets::secondary(ui, say!("Stop the search"));
        ui.add_enabled_ui(meant, stop)
            .inner
            .does(workbench, Workbench::stop_search);
        return;
    }
    let missing = workbench.not_added();
    if workbench.diagnosis().is_none() {
        let measured = !workbench.loaded_session().is_empty();
        let button = ui.add_enabled_ui(measured, |ui| widgets::primary(ui, say!("Run diagnosis")));
        button.inner.does(workbench, Workbench::search);
    } else if !missing.is_empty() {
        // The effect that was found comes before the table that would leave it uncorrected.
        let text = super::blocks::add_all(missing.len());
        widgets::primary(ui, &text).does(workbench, move |bench| bench.add(&missing));
    } else if widgets::primary(ui, say!("Continue to export")).clicked() {
        workbench.then(move |bench| bench.view.step = Step::Export);
    }
}
