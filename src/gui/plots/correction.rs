//! The exported table as a curve: what is added to each command, for each side.

use egui::{Color32, FontId, Role, Stroke, Ui, WidgetInfo};
use egui_plot::{Axis, Line, Plot, PlotPoints};

use crate::gui::commands::Workbench;
use crate::gui::plots::{MOST_POINTS, axis, steps, stride, thinned};
use crate::gui::preview::Made;
use crate::gui::tokens::{Palette, size};
use crate::kinematics::JointKind;

/// Points of one curve: commanded value and correction, in the table's unit.
fn curve(made: &Made, values: &[f64]) -> Vec<[f64; 2]> {
    let table = &made.table;
    let every = stride(values.len(), MOST_POINTS / 4);
    let all = table.commanded_outer.iter().zip(values).step_by(every);
    all.map(|(at, value)| [*at, table.outer(*value)]).collect()
}

/// Shows the curve in the space that is left.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, made: &Made) {
    let palette = Palette::of(ui);
    let table = &made.table;
    let degrees = table.kind == JointKind::Revolute;
    let unit = if degrees { "°" } else { "mm" };
    let forward = curve(made, &table.forward);
    let reverse = table.has_sides().then(|| curve(made, &table.reverse));
    let plot = Plot::new(("correction", workbench.view().fitted))
        .show_x(false)
        .show_y(false)
        .show_background(false)
        .show_crosshair(false)
        .grid_color(palette.line)
        // A constant correction is a straight line, not the noise of its last digit.
        .include_y(0.0)
        .set_margin_fraction(egui::vec2(0.03, 0.2))
        .x_grid_spacer(move |input| steps(input.bounds, degrees))
        .y_grid_spacer(|input| steps(input.bounds, false))
        .custom_x_axes(axis(
            Axis::X,
            format!("{}, {unit}", table.name),
            &palette,
            |q| q,
        ))
        .custom_y_axes(axis(
            Axis::Y,
            format!("to be added, {unit}"),
            &palette,
            |v| v,
        ));
    let sides = reverse.is_some();
    let line = |name: &str, points: Vec<[f64; 2]>, color: Color32| {
        Line::new(name, PlotPoints::from(points))
            .stroke(Stroke::new(2.0, color))
            .allow_hover(false)
    };
    let shown = plot.show(ui, |plot| {
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
    let painter = ui.painter();
    let corner = shown.transform.frame().left_top() + egui::vec2(12.0, 4.0);
    let font = FontId::proportional(size::SMALL);
    let mut says = if sides {
        "solid: moving positive · dashed: moving negative".to_owned()
    } else {
        "the same for both directions".to_owned()
    };
    let every = stride(table.forward.len(), MOST_POINTS / 4);
    if let Some(note) = thinned(every, "entry") {
        says = format!("{says} · {note}");
    }
    painter.text(corner, egui::Align2::LEFT_TOP, says, font, palette.muted);
}
