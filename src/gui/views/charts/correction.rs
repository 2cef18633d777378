//! The exported table as a curve: what is added to each command, for each side.

use egui::{Color32, Role, Stroke, Ui, WidgetInfo};
use egui_plot::{Axis, Line, PlotPoints};

use crate::compensation::SortedTable;
use crate::gui::cache::preview::Made;
use crate::gui::core::scale::{LEAST_SPAN, MOST_POINTS, stride, thinned};
use crate::gui::plots::chart_spec::{Ink, Sketch, Stands};
use crate::gui::plots::{axis, gestures, legend, steps};
use crate::gui::style::tokens::Palette;
use crate::gui::units::{cell, plain_number};
use crate::gui::view::Chart;
use crate::gui::workbench::Workbench;
use crate::gui::{help, widgets};

use super::view::View;
use crate::kinematics::JointKind;

pub(super) const VIEW: View = View {
    chart: Chart::Table,
    short: "table",
    name: "Correction table",
    word: help::CORRECTION,
    of_component: false,
    of_joint: false,
    show: |ui, workbench, commands| {
        if let Some(made) = made(workbench) {
            legend::show(ui, &caption(made), &[], commands);
            show(ui, workbench, made);
        }
    },
    sketch: |workbench, _| sketch(made(workbench)?),
    numbers: |workbench| made(workbench).map_or_else(String::new, numbers),
    has_picture: |workbench| made(workbench).is_some(),
};

fn made(workbench: &Workbench) -> Option<&Made> {
    workbench.export()?.ok()
}

/// Points of one curve: commanded value and correction, in the table's unit.
fn curve(column: &SortedTable) -> Vec<[f64; 2]> {
    let every = stride(column.values().len(), MOST_POINTS / 4);
    let all = column.places().iter().zip(column.values()).step_by(every);
    all.map(|(at, value)| [*at, *value]).collect()
}

/// What the upward axis has to show: zero, every correction, and no less than can be read. A
/// constant correction is a straight line then, not the noise of its last digit.
fn span<'p>(points: impl Iterator<Item = &'p [f64; 2]>) -> [f64; 2] {
    let finite = points.map(|p| p[1]).filter(|v| v.is_finite());
    let [low, high] = finite.fold([0.0_f64, 0.0_f64], |[a, b], v| [a.min(v), b.max(v)]);
    let more = 0.5 * (LEAST_SPAN - (high - low)).max(0.0);
    [low - more, high + more]
}

fn show(ui: &mut Ui, workbench: &Workbench, made: &Made) {
    let palette = Palette::of(ui);
    let Some(table) = &made.export.reads_as else {
        widgets::hint(
            ui,
            "This format describes the robot itself and has no table",
        );
        return;
    };
    let degrees = table.kind == JointKind::Revolute;
    let unit = if degrees { "°" } else { "mm" };
    let forward = curve(&table.forward);
    let has_sides = table.forward != table.reverse;
    let reverse = has_sides.then(|| curve(&table.reverse));
    let [low, high] = span(forward.iter().chain(reverse.iter().flatten()));
    let plot = gestures::plot(("correction", workbench.view().fitted.chart))
        .grid_color(palette.line)
        .include_y(low)
        .include_y(high)
        .set_margin_fraction(egui::vec2(0.03, 0.2))
        .x_grid_spacer(move |input| steps(input.bounds, degrees, 9.0))
        .y_grid_spacer(|input| steps(input.bounds, false, 4.0))
        .custom_x_axes(axis(
            Axis::X,
            format!("{}, {unit}", made.joint),
            &palette,
            |q| q,
        ))
        .custom_y_axes(axis(
            Axis::Y,
            format!("correction, {unit}"),
            &palette,
            |v| v,
        ));
    let line = |name: &str, points: Vec<[f64; 2]>, color: Color32| {
        Line::new(name, PlotPoints::from(points))
            .stroke(Stroke::new(2.0, color))
            .allow_hover(false)
    };
    let shown = gestures::show(ui, plot, |plot| {
        plot.line(line("forward", forward, palette.after));
        if let Some(reverse) = reverse {
            plot.line(
                line("reverse", reverse, palette.before)
                    .style(egui_plot::LineStyle::Dashed { length: 8.0 }),
            );
        }
    });
    shown
        .response
        .widget_info(|| WidgetInfo::labeled(Role::Figure, true, "correction table as a curve"));
}

/// Every entry as a table.
fn numbers(made: &Made) -> String {
    let Some(table) = &made.export.reads_as else {
        return String::new();
    };
    let unit = match table.kind {
        JointKind::Revolute => "deg",
        JointKind::Prismatic => "mm",
    };
    let joint = cell(&made.joint);
    let mut text = format!("{joint}, {unit}\tside\tcorrection, {unit}\n");
    for (side, column) in [("1", &table.forward), ("-1", &table.reverse)] {
        for (at, value) in column.places().iter().zip(column.values()) {
            let cells = [plain_number(*at), side.to_owned(), plain_number(*value)];
            text += &cells.join("\t");
            text.push('\n');
        }
    }
    text
}

/// The curve to be saved; `None` where the export has no table.
fn sketch(made: &Made) -> Option<Sketch> {
    let table = made.export.reads_as.as_ref()?;
    let degrees = table.kind == JointKind::Revolute;
    let unit = if degrees { "°" } else { "mm" };
    let (forward, reverse) = (curve(&table.forward), curve(&table.reverse));
    let [low, high] = span(forward.iter().chain(&reverse));
    let from = forward.first().map_or(0.0, |p| p[0]);
    let to = forward.last().map_or(1.0, |p| p[0]).max(from + 1e-6);
    let by = 0.1 * (high - low);
    let mut inks = Vec::new();
    let mut legend = vec![("forward".to_owned(), Stands::After, true)];
    if table.forward != table.reverse {
        inks.push(Ink::Line(reverse, Stands::Before, 2.0, true));
        legend.push(("reverse, dashed".to_owned(), Stands::Before, false));
    }
    inks.push(Ink::Line(forward, Stands::After, 2.0, false));
    Some(Sketch {
        title: "correction table".to_owned(),
        across: format!("{}, {unit}", made.joint),
        upwards: format!("correction, {unit}"),
        bounds: [[from, low - by], [to, high + by]],
        degrees,
        ticks: Vec::new(),
        inks,
        legend,
        note: caption(made),
    })
}

/// What has to be said about the curve.
fn caption(made: &Made) -> String {
    let Some(table) = &made.export.reads_as else {
        return String::new();
    };
    let mut says = if table.forward == table.reverse {
        "the same for both directions".to_owned()
    } else {
        "solid: moving positive · dashed: moving negative".to_owned()
    };
    let every = stride(table.forward.values().len(), MOST_POINTS / 4);
    if let Some(note) = thinned(every, "entry") {
        says = format!("{says} · {note}");
    }
    says
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_table_is_shown_from_zero() {
        let table = [[0.0, 0.3614], [1.0, 0.3614 + 1e-15]];
        let [low, high] = span(table.iter());
        assert_eq!(low, 0.0);
        assert!((high - 0.3614).abs() < 1e-12);
        let [low, high] = span([[0.0, 1e-17], [1.0, -1e-17]].iter());
        assert!(high - low >= 0.999 * LEAST_SPAN, "{low} {high}");
    }
}
