//! Axes in the window's type, with a label wherever one fits.

use egui::{FontId, Rangef, RichText};
use egui_plot::{Axis, AxisHints};

use crate::gui::tokens::{Palette, size};
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
