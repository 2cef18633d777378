//! The gap step by step: the nominal robot, the identification, each effect that was added, and
//! the noise floor below which no model can come.

use super::{ChartChoice, ChartKind, ChartPlaceholder, Scene, Shown};
use crate::gui::core::document::Method;
use crate::gui::help;
use crate::gui::view::Step;
use crate::model::ResidualStep;
use crate::present::chart::{gap, in_words};
use crate::present::numbers::significant;
use crate::present::table::{Cell, Table};

pub(crate) static GAP: ChartKind = ChartKind {
    name: phrase!("Gap by step"),
    is_offered: |scene| scene.answer().is_some() && !scene.loaded_session.is_empty(),
    suits: |scene| scene.step == Step::Gap,
    ..ChartKind::new("gap by step", help::GAP, ChartChoice::All, show, numbers)
};

fn steps(scene: &Scene) -> &[ResidualStep] {
    scene
        .answer()
        .map_or(&[], |answer| &answer.calibration.history)
}

/// Those of what was found while nothing of it is in the model: the fits are one upon the other.
fn proposed(scene: &Scene) -> &[ResidualStep] {
    let exact = scene.document.method == Method::Exact;
    match scene.diagnosis() {
        Some(found) if exact && scene.document.added.is_empty() => {
            found.history.get(2..).unwrap_or(&[])
        }
        _ => &[],
    }
}

fn show(scene: &Scene) -> Result<Shown, ChartPlaceholder> {
    let number = |mm: f64| significant(scene.units.length_value(mm), 3);
    let lengths = scene.lengths(&number);
    let floor_mm = scene.diagnosis().map(|d| d.floor.mm);
    let steps = steps(scene);
    let proposed = proposed(scene);
    let tolerance_mm = scene.document.tolerance_mm;
    let chart = gap(steps, proposed, floor_mm, tolerance_mm, lengths);
    let mut chart = chart.ok_or(ChartPlaceholder::new(say!("nothing is identified yet"), ""))?;
    if !proposed.is_empty() {
        say!("outlined: not in the model").clone_into(&mut chart.note);
    }
    let says = |s: &ResidualStep| format!("{} {}", in_words(&s.what), number(s.gap_mm));
    let says: Vec<String> = steps.iter().chain(proposed).map(says).collect();
    let name = say!("gap by step: {steps}", steps = says.join(", "));
    Ok(Shown::new(chart, name))
}

fn numbers(scene: &Scene) -> Table {
    let mut table = Table::headed("step | gap, mm | in the model");
    for (steps, in_model) in [(steps(scene), 1_usize), (proposed(scene), 0)] {
        for step in steps {
            let what = Cell::from(in_words(&step.what));
            table.row([what, step.gap_mm.into(), Cell::from(in_model)]);
        }
    }
    table
}
