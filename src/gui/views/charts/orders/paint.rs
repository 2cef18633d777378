//! The order spectrum in egui.

use egui::{Align2, Ui};

use crate::gui::cache::charts::Charted;
use crate::gui::core::scale::LEAST_SPAN;
use crate::gui::plots::chart_spec::{Ink, Sketch, Stands};
use crate::gui::plots::figure;
use crate::gui::plots::legend::{self, Entry, Sign};
use crate::gui::style::tokens::Palette;
use crate::gui::units::{plain_number, whole};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

use crate::gui::cache::charts::orders::{Amplitude, LINE, Order, Spectrum};

/// Part of the height that is left for names.
const ROOM: f64 = 0.30;
/// Rows of names.
const ROWS: usize = 3;

/// The spectrum, or why there is none.
fn spectrum(workbench: &Workbench) -> Result<&Spectrum, (String, &'static str)> {
    let subject = workbench.subject();
    let joint = workbench.chart_joint();
    if !subject.joint_turns(joint) {
        let name = &subject.session.robot.joints[joint].name;
        return Err((
            format!("{name} slides"),
            "Orders are cycles per turn. Choose a joint that turns",
        ));
    }
    match workbench.charted() {
        Some(Charted::Orders(spectrum)) if !spectrum.orders.is_empty() => Ok(spectrum),
        Some(Charted::Orders(_)) => Err((
            "Too few different angles".to_owned(),
            "An order shows where a wave comes back with every turn: measure thirty angles or \
             more, spread over the whole range of the joint",
        )),
        _ => Err(("Computing…".to_owned(), "")),
    }
}

/// The amplitudes of an order that are shown: before, after.
fn shown(order: &Order, only_after: bool) -> [Option<Amplitude>; 2] {
    [Some(order.before).filter(|_| !only_after), order.after]
}

/// The spectrum as bars.
fn drawn(workbench: &Workbench, spectrum: &Spectrum) -> Sketch {
    let units = workbench.units();
    let only_after = workbench.only_after();
    let value = |mm: f64| units.length_value(mm);
    // The line belongs to what is shown last.
    let line_of = |order: &Order| {
        let last = shown(order, only_after).into_iter().flatten().last();
        last.and_then(|amplitude| amplitude.line_mm)
    };
    let of_order = |order: &Order| {
        let bars = shown(order, only_after).into_iter().flatten();
        bars.map(|a| a.mm).fold(0.0, f64::max)
    };
    let orders = &spectrum.orders;
    let bars = orders.iter().map(of_order);
    let lines = orders.iter().filter_map(line_of);
    let largest = bars.chain(lines).fold(LEAST_SPAN, f64::max);
    let top = largest / (1.0 - ROOM);
    let mut inks = Vec::new();
    for (slot, order) in orders.iter().enumerate() {
        let both = shown(order, only_after);
        let alone = both.iter().flatten().count() == 1;
        for (k, amplitude) in both.into_iter().enumerate() {
            let Some(amplitude) = amplitude else { continue };
            let [from, to] = match (alone, k) {
                (true, _) => [-0.3, 0.3],
                (false, 0) => [-0.38, -0.02],
                (false, _) => [0.02, 0.38],
            };
            let (stands, filled) = [(Stands::Before, false), (Stands::After, true)][k];
            let at = slot as f64;
            inks.push(Ink::Bar(
                [at + from, 0.0],
                [at + to, value(amplitude.mm)],
                stands,
                filled,
            ));
        }
    }
    let step = |(slot, order): (usize, &Order)| {
        let height = value(line_of(order)?);
        Some([[slot as f64 - 0.5, height], [slot as f64 + 0.5, height]])
    };
    let line: Vec<[f64; 2]> = orders
        .iter()
        .enumerate()
        .filter_map(step)
        .flatten()
        .collect();
    if !line.is_empty() {
        inks.push(Ink::Line(line, Stands::Noise, 1.6, true));
    }
    names(
        spectrum,
        only_after,
        value(largest),
        value(top),
        &of_order,
        &value,
        &mut inks,
    );
    let ticks = orders.iter().enumerate();
    let last = orders.len() as f64 - 0.4;
    let name = workbench.view().component.name();
    let joint = &workbench.subject().session.robot.joints[workbench.chart_joint()].name;
    let mut legend = Vec::new();
    if !only_after {
        legend.push(("As measured".to_owned(), Stands::Before, false));
    }
    if workbench.answer().is_some() {
        legend.push(("Against the model".to_owned(), Stands::After, true));
    }
    Sketch {
        title: format!("{name} deviation by order over {joint}"),
        across: format!("cycles per turn of {joint}"),
        upwards: format!("amplitude, {}", units.length_name()),
        bounds: [[-0.6, 0.0], [last, value(top)]],
        degrees: false,
        ticks: ticks
            .map(|(k, o)| (k as f64, o.order.to_string()))
            .collect(),
        inks,
        legend,
        note: note(spectrum),
    }
}

/// Names of orders that have a usual cause, with a line down to their bars.
fn names(
    spectrum: &Spectrum,
    only_after: bool,
    largest: f64,
    top: f64,
    of_order: &dyn Fn(&Order) -> f64,
    value: &dyn Fn(f64) -> f64,
    inks: &mut Vec<Ink>,
) {
    let mut row = 0;
    for (slot, order) in spectrum.orders.iter().enumerate() {
        let Some(cause) = spectrum.cause(order.order) else {
            continue;
        };
        let mut bars = shown(order, only_after).into_iter().flatten();
        if !bars.any(Amplitude::stands_out) {
            continue;
        }
        let part = (row % ROWS) as f64 + 0.6;
        row += 1;
        let height = top - (top - largest) * part / ROWS as f64;
        let at = slot as f64;
        let line = vec![[at, value(of_order(order))], [at, height]];
        inks.push(Ink::Line(line, Stands::Reference, 0.8, false));
        let word = format!(" {cause}");
        inks.push(Ink::Word([at, height], word, Align2::LEFT_CENTER));
    }
}

fn note(spectrum: &Spectrum) -> String {
    let has_line = spectrum.orders.iter().any(|o| o.before.line_mm.is_some());
    let line = if has_line {
        LINE.to_owned()
    } else {
        "too few samples to say what is noise".to_owned()
    };
    let mut notes = vec![line];
    notes.extend(spectrum.limits());
    notes.join(" · ")
}

/// What is seen, in words.
fn says(workbench: &Workbench, spectrum: &Spectrum) -> String {
    let units = workbench.units();
    let out = |pick: fn(&Order) -> Option<Amplitude>| {
        let mut out: Vec<(usize, f64)> = spectrum
            .orders
            .iter()
            .filter_map(|o| Some((o.order, pick(o).filter(|a| a.stands_out())?.mm)))
            .collect();
        out.sort_by(|a, b| b.1.total_cmp(&a.1));
        let words = out.iter().take(4).map(|(order, mm)| {
            let cause = spectrum.cause(*order);
            let cause = cause.map_or_else(String::new, |c| format!(" ({c})"));
            format!("order {order}{cause} with {}", units.length(*mm))
        });
        let words: Vec<String> = words.collect();
        if words.is_empty() {
            "nothing above the noise".to_owned()
        } else {
            words.join(", ")
        }
    };
    let mut says = format!(
        "{} orders of the {} deviation; before: {}",
        spectrum.orders.len(),
        workbench.view().component.name(),
        out(|o| Some(o.before))
    );
    if workbench.answer().is_some() {
        says += &format!("; after: {}", out(|o| o.after));
    }
    format!("{says}; {}", note(spectrum))
}

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let spectrum = match spectrum(workbench) {
        Ok(spectrum) => spectrum,
        Err((title, why)) => return legend::empty(ui, &title, why),
    };
    let palette = Palette::of(ui);
    let sketch = drawn(workbench, spectrum);
    let before = Sign::Bar(palette.before, false);
    let mut entries = vec![Entry::before(workbench, before)];
    if workbench.answer().is_some() {
        entries.push(Entry::new("after", Sign::Bar(palette.after, true)));
    }
    entries.push(Entry::new("noise", Sign::Line(palette.muted, true)));
    legend::show(ui, &sketch.note, &entries, commands);
    let component = workbench.view().component.name();
    let id = ("orders", component, workbench.only_after());
    let plot = sketch.plot(id, workbench.view(), &palette);
    let (response, transform) = sketch.show(ui, plot, &palette, |_, _| {});
    let name = format!("order spectrum, {component}");
    figure(&response, &name, says(workbench, spectrum));
    let under = response.hover_pos().and_then(|pointer| {
        let slot = transform.value_from_position(pointer).x.round();
        let slot = (slot >= 0.0).then(|| whole(slot))?;
        spectrum.orders.get(slot)
    });
    if let Some(order) = under {
        response.on_hover_ui_at_pointer(|ui| {
            widgets::facts(ui, &about(workbench, spectrum, order));
        });
    }
}

/// What is said about a bar.
fn about(
    workbench: &Workbench,
    spectrum: &Spectrum,
    order: &Order,
) -> (String, Vec<(String, String)>) {
    let units = workbench.units();
    let mut lines = Vec::new();
    let cause = spectrum.cause(order.order);
    lines.extend(cause.map(|cause| ("usual cause".to_owned(), cause.to_owned())));
    for (name, amplitude) in [("before", Some(order.before)), ("after", order.after)] {
        let Some(amplitude) = amplitude else { continue };
        lines.push((name.to_owned(), units.length(amplitude.mm)));
        if let Some(line) = amplitude.line_mm {
            lines.push((format!("noise, {name}"), units.length(line)));
        }
    }
    (format!("order {}", order.order), lines)
}

/// The chart to be saved.
pub(crate) fn sketch(workbench: &Workbench) -> Option<Sketch> {
    spectrum(workbench)
        .ok()
        .map(|found| drawn(workbench, found))
}

/// Every order as a table.
pub(crate) fn numbers(workbench: &Workbench) -> String {
    let mut text = "order\tbefore, mm\tnoise before, mm\tafter, mm\tnoise after, mm\t\
                    usual cause\n"
        .to_owned();
    let Ok(spectrum) = spectrum(workbench) else {
        return text;
    };
    let cell = |mm: Option<f64>| mm.map_or_else(String::new, plain_number);
    for order in &spectrum.orders {
        let cells = [
            order.order.to_string(),
            plain_number(order.before.mm),
            cell(order.before.line_mm),
            cell(order.after.map(|a| a.mm)),
            cell(order.after.and_then(|a| a.line_mm)),
            spectrum.cause(order.order).unwrap_or_default().to_owned(),
        ];
        text += &cells.join("\t");
        text.push('\n');
    }
    text
}
