//! Axes in the window's type, with a label wherever one fits.

use egui::{FontId, Rangef, RichText};
use egui_plot::{Axis, AxisHints, GridMark};

use crate::gui::style::tokens::{Palette, size};
use crate::gui::units::trimmed;

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

/// The axis below with a word for each place.
pub(crate) fn named_axis<'a>(
    label: String,
    palette: &Palette,
    words: Vec<(f64, String)>,
) -> Vec<AxisHints<'a>> {
    let mut hints = axis(Axis::X, label, palette, |x| x);
    let named = move |place: f64| {
        let word = words.iter().find(|(at, _)| (at - place).abs() < 0.5);
        word.map_or_else(String::new, |(_, word)| word.clone())
    };
    if let Some(hint) = hints.pop() {
        let hint = hint.label_spacing(Rangef::new(10.0, 16.0));
        hints.push(hint.formatter(move |mark, _| named(mark.value)));
    }
    hints
}

/// Grid lines at round numbers, at most about `lines`, so that each gets its label: in degrees at
/// parts of a turn.
pub(crate) fn steps(bounds: (f64, f64), degrees: bool, lines: f64) -> Vec<GridMark> {
    const PARTS_OF_A_TURN: [f64; 9] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0];
    let (low, high) = bounds;
    let wanted = (high - low) / lines;
    if !(wanted.is_finite() && wanted > 0.0) {
        return Vec::new();
    }
    let in_degrees = || PARTS_OF_A_TURN.into_iter().find(|part| *part >= wanted);
    let step = if degrees && wanted > 0.5 {
        in_degrees().unwrap_or(360.0)
    } else {
        // The smallest of 1, 2, 5 × 10ⁿ that is not below.
        let below = crate::gui::core::scale::round_down(wanted);
        let lead = below / 10f64.powf(below.log10().floor());
        if below >= wanted * (1.0 - 1e-9) {
            below
        } else if (lead - 2.0).abs() < 0.5 {
            below * 2.5
        } else {
            below * 2.0
        }
    };
    let first = (low / step).ceil();
    let last = (high / step).floor();
    (0..50_u8)
        .map(|k| first + f64::from(k))
        .take_while(|line| *line <= last)
        .map(|line| GridMark {
            value: line * step,
            step_size: step,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(bounds: (f64, f64), degrees: bool) -> Vec<f64> {
        steps(bounds, degrees, 9.0)
            .iter()
            .map(|mark| mark.value)
            .collect()
    }

    #[test]
    fn degrees_are_divided_into_parts_of_a_turn() {
        let marks = values((-95.0, 95.0), true);
        assert_eq!(marks, [-90.0, -60.0, -30.0, 0.0, 30.0, 60.0, 90.0]);
    }

    #[test]
    fn lengths_are_divided_decimally() {
        assert_eq!(
            values((-0.9, 14.0), false),
            [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0]
        );
        assert!(values((f64::NAN, 1.0), false).is_empty());
    }
}
