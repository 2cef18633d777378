//! What plots are made of: axes in the window's type, with a label wherever one fits; marks, the strip
//! above them, gestures, a chart on the screen. A plot itself is a model (what is shown), a layout (where it
//! goes; both are tested without pixels) and paint (egui).

pub(crate) mod chart;
pub(crate) mod gestures;
pub(crate) mod legend;
pub(crate) mod marks;

pub(crate) use marks::{Drawing, disc};

use egui::{FontId, Rangef, Response, RichText, Role, Ui, WidgetInfo};
use egui_plot::{Axis, AxisHints, GridMark};

use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::{Plot, What};
use crate::gui::widgets;
use crate::gui::workbench::{Asked, Command};
use crate::present::chart::{Ticks, ticks};
use crate::present::numbers::trimmed;

/// Saves a plot as a file.
pub(crate) fn picture(ui: &mut Ui, plot: Plot, commands: &mut Vec<Command>) {
    let says = say!("Save picture of the {plot}…", plot = plot.title());
    if widgets::save_button(ui, &says).clicked() {
        commands.push(Command::Ask(Asked::WhereToExport(What::Picture(plot))));
    }
}

/// Names a chart for those who do not see it, and says what is seen in it.
pub(crate) fn figure(response: &Response, name: &str, says: String) {
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, name));
    response
        .ctx
        .accesskit_node_builder(response.id, |node| node.set_description(says));
}

/// An axis with this label; `shown` turns a value of the plot into the one that is written.
pub(crate) fn axis<'a>(
    axis: Axis,
    label: String,
    palette: &Palette,
    shown: impl Fn(f64) -> f64 + 'a,
) -> Vec<AxisHints<'a>> {
    let label = RichText::new(label).size(size::SMALL).color(palette.muted);
    let room = match axis {
        Axis::X => Rangef::new(34.0, 56.0),
        Axis::Y => Rangef::new(18.0, 28.0),
    };
    let hints = AxisHints::new(axis)
        .label(label)
        .label_spacing(room)
        .tick_label_color(palette.muted)
        .tick_label_font(FontId::proportional(size::SMALL))
        .formatter(move |mark, _| trimmed(shown(mark.value), 4));
    vec![match axis {
        Axis::X => hints,
        Axis::Y => hints.min_thickness(40.0),
    }]
}

/// A chart's axis, with a word for each place where it has words, which take up so much room.
pub(super) fn of_chart<'a>(
    side: Axis,
    of: &crate::present::chart::Axis,
    palette: &Palette,
    width: f32,
) -> Vec<AxisHints<'a>> {
    let hints = axis(side, of.label.clone(), palette, |x| x);
    let Ticks::Words(words) = &of.ticks else {
        return hints;
    };
    let words = words.clone();
    let named = move |place: f64| {
        let word = words.iter().find(|(at, _)| (at - place).abs() < 0.5);
        word.map_or_else(String::new, |(_, word)| word.clone())
    };
    let color = match side {
        Axis::X => palette.muted,
        Axis::Y => palette.text,
    };
    let with_words = |hint: AxisHints<'a>| {
        let named = named.clone();
        let hint = hint.label_spacing(Rangef::new(10.0, 16.0));
        hint.min_thickness(width)
            .tick_label_color(color)
            .formatter(move |mark, _| named(mark.value))
    };
    hints.into_iter().map(with_words).collect()
}

/// Where a chart's axis has labels between two ends, at most about `most` of them.
pub(super) fn places(of: &Ticks, bounds: (f64, f64), most: f64) -> Vec<GridMark> {
    match of {
        Ticks::Words(words) => {
            let mark = |(value, _): &(f64, String)| GridMark {
                value: *value,
                step_size: 1.0,
            };
            words.iter().map(mark).collect()
        }
        other => steps(bounds, *other == Ticks::Degrees, most),
    }
}

/// Grid lines at round numbers of the unit in which values are written, `per` of it for one of the plot's.
pub(crate) fn steps_in(per: f64, (low, high): (f64, f64), lines: f64) -> Vec<GridMark> {
    let marks = steps((low * per, high * per), false, lines).into_iter();
    let back = |mark: GridMark| GridMark {
        value: mark.value / per,
        step_size: mark.step_size / per,
    };
    marks.map(back).collect()
}

/// Grid lines at round numbers, at most about `lines`, so that each gets its label: in degrees at
/// parts of a turn.
fn steps((low, high): (f64, f64), degrees: bool, lines: f64) -> Vec<GridMark> {
    let (values, step_size) = ticks([low, high], degrees, lines);
    let mark = |value| GridMark { value, step_size };
    values.into_iter().map(mark).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_round_in_the_unit_in_which_they_are_written() {
        let per_mm = 1.0 / 25.4;
        let marks = steps_in(per_mm, (-420.0, 420.0), 9.0);
        let inches: Vec<f64> = marks.iter().map(|mark| mark.value * per_mm).collect();
        assert_eq!(inches.len(), 7, "{inches:?}");
        for inch in inches {
            assert!((inch / 5.0 - (inch / 5.0).round()).abs() < 1e-9, "{inch}");
        }
    }
}
