//! What is copied from the window: tables as text for a spreadsheet (tabs between the columns, full
//! digits, the decimal sign that the user chose).

use egui::{Button, RichText, Ui, vec2};

use crate::diagnosis::Diagnosis;
use crate::effects::find;
use crate::fit::{Estimate, RegionResult};
use crate::gui::charts::ChartKind;
use crate::gui::style::space;
use crate::gui::view::Message;
use crate::gui::widgets::{self, Buttons, Does, Forms};
use crate::gui::workbench::Workbench;
use crate::present::names::parameter_in_english as parameter;
use crate::present::table::{Cell, Table};
use crate::units::deg_from_rad;

/// A button that copies a table.
pub(super) fn button(ui: &mut Ui, workbench: &Workbench, of: &str, text: impl FnOnce() -> String) {
    ui.add_space(space::TIGHT);
    // Higher than the rows of a dense table: it is pressed, not read.
    let button = Button::new(RichText::new(say!("Copy table")).small()).min_size(vec2(78.0, 22.0));
    if ui.named(say!("Copy table of {of}", of), button).clicked() {
        ui.copy_text(text());
        let says = format!("{}: {of}", say!("Copied"));
        workbench.then(|bench| bench.view.message = Some(Message::done(says, Vec::new())));
    }
}

/// The mark in a chart's bar that copies its numbers, once they are made in the background.
pub(super) fn chart_button(ui: &mut Ui, kind: &ChartKind, workbench: &Workbench) {
    let (chart, ctx) = (kind.id, ui.ctx().clone());
    let says = say!("Copy numbers: {of}", of = kind.name().to_lowercase());
    let button = ui.icon_button(widgets::COPY, &says).on_hover_text(&says);
    button.does(workbench, move |bench| {
        bench.copy_numbers(chart, move |text| ctx.copy_text(text));
    });
}

/// The title of an effect: what is copied is English, as files are.
fn effect_title(id: &str) -> &str {
    find(id).map_or(id, |effect| effect.about().title.english())
}

/// The columns of a parameter with its interval.
const PARAMETER: &str = "effect | joint | parameter | value | 95 % from | 95 % to | unit";

/// The cells of a parameter with its interval.
fn estimate(one: &Estimate) -> Vec<Cell> {
    let (name, unit) = parameter(one.name);
    let [from, to] = ends(one.ci95);
    let (effect, value) = (effect_title(one.effect).into(), one.value.into());
    vec![
        effect,
        one.joint.into(),
        name.into(),
        value,
        from,
        to,
        unit.into(),
    ]
}

fn ends(interval: Option<[f64; 2]>) -> [Cell; 2] {
    interval.map_or_else(Default::default, |ends| ends.map(Cell::from))
}

/// Every parameter with its interval.
pub(super) fn parameters(estimates: &[Estimate]) -> String {
    let mut table = Table::headed(PARAMETER);
    table.rows = estimates.iter().map(estimate).collect();
    table.tabbed()
}

/// What was found, parameter by parameter, each with the evidence of its name.
pub(super) fn found(d: &Diagnosis) -> String {
    let mut table = Table::headed(format!(
        "{PARAMETER} | noise alone, 1 of | odds over the next candidate | share | RMS error before, mm \
         | RMS error after, mm | cross-validated before, mm | cross-validated after, mm"
    ));
    for found in &d.found {
        for one in &found.parameters {
            let mut cells = estimate(one);
            let odds = [
                (1.0 / found.p_familywise.p).round(),
                found.odds_over_next,
                found.share,
            ];
            cells.extend(odds.into_iter().chain(found.gap_mm).map(Cell::from));
            cells.extend(ends(found.held_out_mm));
            table.rows.push(cells);
        }
    }
    table.tabbed()
}

/// Sample by sample: what was commanded and measured, and how far that is from the simulation.
pub(super) fn samples(workbench: &Workbench) -> String {
    let loaded_session = workbench.loaded_session();
    let (session, answer) = (&loaded_session.session, workbench.answer());
    let mut heads = vec!["sample".to_owned()];
    let joints = session.robot.joints.iter().enumerate();
    heads.extend(joints.map(|(j, joint)| format!("q{}, {}", j + 1, joint.kind.unit())));
    let others = "reflector | x, mm | y, mm | z, mm | before, mm | after, mm";
    heads.extend(others.split(" | ").map(str::to_owned));
    let mut table = Table::new(heads);
    let samples = &session.samples;
    for sample in 0..loaded_session.len() {
        let mut cells = vec![Cell::from(sample + 1)];
        let joints = session.robot.joints.iter().zip(&samples.q);
        cells.extend(joints.map(|(joint, q)| Cell::from(joint.kind.to_display(q[sample]))));
        let target = samples
            .target
            .as_ref()
            .map(|target| target[sample] as usize);
        let target = target.and_then(|target| session.targets.get(target));
        cells.push(target.map(|target| target.name.as_str()).into());
        let z = samples.z_mm.as_ref().map_or(f64::NAN, |z| z[sample]);
        let before = loaded_session.before.length_mm[sample];
        let after = answer.map_or(f64::NAN, |answer| answer.after.length_mm[sample]);
        let numbers = [samples.x_mm[sample], samples.y_mm[sample], z, before, after];
        cells.extend(numbers.map(Cell::from));
        table.rows.push(cells);
    }
    table.tabbed()
}

/// Every region's correction with its intervals.
pub(super) fn regions(results: &[RegionResult]) -> String {
    let mut table = Table::headed(
        "region | from, deg | to, deg | samples | dtheta, rad | 95 % from \
 | 95 % to | dl1, mm | 95 % from | 95 % to | RMS error before, mm | RMS error after, mm",
    );
    for result in results {
        let c = &result.correction;
        let [theta_from, theta_to] = ends(result.theta_ci95);
        let [l1_from, l1_to] = ends(result.l1_ci95);
        table.row([
            c.name.as_str().into(),
            deg_from_rad(c.from_rad).into(),
            deg_from_rad(c.to_rad).into(),
            c.samples.into(),
            c.theta_rad.into(),
            theta_from,
            theta_to,
            c.l1_mm.into(),
            l1_from,
            l1_to,
            result.rms_before_mm.into(),
            Cell::from(result.rms_after_mm),
        ]);
    }
    table.tabbed()
}
