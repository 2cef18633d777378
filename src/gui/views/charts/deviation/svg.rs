//! The deviation charts as they leave the window: a picture, and a table.

use crate::gui::cache::charts::over::Over;
use crate::gui::plots::chart_spec::{Ink, Mark, Sketch, Stands};
use crate::gui::units::plain_number;
use crate::gui::workbench::Workbench;

use super::layout::Many;
use super::model::Dot;
use super::paint::{Shown, is_missing};

/// Width of a saved picture's plot, points: so many columns are drawn of many samples.
const PAPER: f64 = 430.0;

/// The chart to be saved; `None` where there is nothing to show.
pub(crate) fn sketch(workbench: &Workbench, over: Over) -> Option<Sketch> {
    if is_missing(workbench, over) {
        return None;
    }
    let shown = Shown::of(workbench, over);
    let axes = &shown.axes;
    let bounds = axes.corners(&shown.extent);
    let value = |mm: f64| axes.units.length_value(mm);
    let mut inks = Vec::new();
    inks.extend(
        shown
            .band
            .map(|b| Ink::Band(b.map(value), Stands::Tolerance)),
    );
    for at in &shown.series.boundaries_rad {
        let x = axes.scale.shown(*at);
        let line = vec![[x, bounds[0][1]], [x, bounds[1][1]]];
        inks.push(Ink::Line(line, Stands::Reference, 0.6, true));
    }
    let zero = vec![[bounds[0][0], 0.0], [bounds[1][0], 0.0]];
    inks.push(Ink::Line(zero, Stands::Reference, 0.7, false));
    let in_sight = shown.in_sight([bounds[0][0], bounds[1][0]], PAPER);
    let identified = workbench.answer().is_some();
    let of_dots = |dots: &[Dot], inks: &mut Vec<Ink>| {
        let mark = |dot: &Dot, mm: f64| Mark {
            at: [axes.scale.shown(dot.x), value(mm)],
            side: dot.side,
        };
        if !shown.only_after {
            let before = dots.iter().map(|d| mark(d, d.before_mm)).collect();
            inks.push(Ink::Marks(before, Stands::Before, false));
        }
        let after = dots.iter().filter_map(|d| Some(mark(d, d.after_mm?)));
        inks.push(Ink::Marks(after.collect(), Stands::After, true));
    };
    let many = matches!(in_sight, Some(Many::Columns(_)));
    match in_sight {
        None => of_dots(&shown.series.dots, &mut inks),
        Some(Many::Samples(samples)) => of_dots(&shown.dots(&samples), &mut inks),
        Some(Many::Columns(columns)) => {
            for column in columns.iter() {
                let bar = |mm: [f64; 2], stands, filled| {
                    let [from, to] = [0, 1].map(|k| [axes.scale.shown(column.x[k]), value(mm[k])]);
                    Ink::Bar(from, to, stands, filled)
                };
                let before = column.before_mm.filter(|_| !shown.only_after);
                inks.extend(before.map(|mm| bar(mm, Stands::Before, false)));
                inks.extend(column.after_mm.map(|mm| bar(mm, Stands::After, true)));
            }
        }
    }
    let mut legend = Vec::new();
    if !shown.only_after {
        legend.push(("As measured".to_owned(), Stands::Before, false));
    }
    if identified {
        legend.push(("Against the model".to_owned(), Stands::After, true));
    }
    let name = workbench.view().component.name();
    let label = over.label(workbench.subject());
    Some(Sketch {
        title: format!("{name} deviation over {label}"),
        across: shown.across(),
        upwards: shown.upwards(),
        bounds,
        degrees: axes.scale.degrees,
        ticks: Vec::new(),
        inks,
        legend,
        note: shown.note(many),
    })
}

/// Every sample of the chart as a table: inner units, in measuring order.
pub(crate) fn numbers(workbench: &Workbench, over: Over) -> String {
    let subject = workbench.subject();
    let component = workbench.view().component.name();
    let along = over.heading(subject);
    let mut text =
        format!("sample\t{along}\tside\t{component} before, mm\t{component} after, mm\n");
    for sample in subject.overview.usable.iter().map(|s| *s as usize) {
        let dot = Dot::of(workbench, over, sample);
        let cells = [
            (sample + 1).to_string(),
            plain_number(over.cell(subject, dot.x)),
            plain_number(dot.side),
            plain_number(dot.before_mm),
            dot.after_mm.map_or_else(String::new, plain_number),
        ];
        text += &cells.join("\t");
        text.push('\n');
    }
    text
}
