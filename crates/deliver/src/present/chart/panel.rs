//! A rectangle with scales on paper: frame, grid, ticks with numbers.

use super::{Axis, Ticks, ticks};
use crate::present::drawing::{Anchor, Drawing, INK, Item, Label, MUTED, RULE, Stroke};

/// Size of the numbers at the ticks, points.
pub(crate) const SMALL: f64 = 7.0;
/// Width of a plot that fills a page of A4 between its margins, points.
pub const FULL_WIDTH: f64 = 487.0;

#[derive(Debug, Clone, Copy)]
pub struct Panel {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    pub x: [f64; 2],
    pub y: [f64; 2],
}

impl Panel {
    pub(crate) fn at(&self, x: f64, y: f64) -> [f64; 2] {
        let share = |v: f64, [low, high]: [f64; 2]| (v - low) / (high - low);
        [
            self.left + self.width * share(x, self.x),
            self.top + self.height * (1.0 - share(y, self.y)),
        ]
    }

    /// Grid lines with what stands at the ticks, then the frame. Words have no lines.
    pub fn frame(&self, axes: [&Axis; 2], most: [f64; 2], drawing: &mut Drawing) {
        let (bottom, right) = (self.top + self.height, self.left + self.width);
        let (across, lines) = marks(axes[0], self.x, most[0]);
        for (x, word) in across {
            let [at, _] = self.at(x, self.y[0]);
            if lines {
                drawing.line([at, self.top], [at, bottom], Stroke::new(0.4, RULE));
            }
            let label = Label::new([at, bottom + SMALL + 2.5], word, SMALL, MUTED);
            drawing.text(label.anchored(Anchor::Middle));
        }
        let (upwards, lines) = marks(axes[1], self.y, most[1]);
        for (y, word) in upwards {
            let [_, at] = self.at(self.x[0], y);
            if lines {
                drawing.line([self.left, at], [right, at], Stroke::new(0.4, RULE));
            }
            let colour = if lines { MUTED } else { INK };
            let label = Label::new([self.left - 4.0, at + 2.4], word, SMALL, colour);
            drawing.text(label.anchored(Anchor::End));
        }
        let frame = vec![[self.left, self.top], [self.left, bottom], [right, bottom]];
        let lines = Item::Lines(vec![frame], Stroke::new(0.6, MUTED));
        drawing.items.push(lines);
    }

    pub(crate) fn title(&self, title: &str, drawing: &mut Drawing) {
        let label = Label::new([self.left, self.top - 6.0], title, 8.0, INK);
        drawing.text(label.bold());
    }

    pub fn x_label(&self, label: &str, drawing: &mut Drawing) {
        let at = [self.left + self.width / 2.0, self.top + self.height + 20.0];
        drawing.text(Label::new(at, label, SMALL, MUTED).anchored(Anchor::Middle));
    }

    pub fn y_label(&self, label: &str, left: f64, drawing: &mut Drawing) {
        let mut label = Label::new([left, self.top + self.height / 2.0], label, SMALL, MUTED);
        label.upwards = true;
        drawing.text(label.anchored(Anchor::Middle));
    }
}

/// What stands at the ticks of an axis, and whether lines belong to them.
fn marks(axis: &Axis, bounds: [f64; 2], most: f64) -> (Vec<(f64, String)>, bool) {
    if let Ticks::Words(words) = &axis.ticks {
        return (words.clone(), false);
    }
    let (values, step) = ticks(bounds, axis.ticks == Ticks::Degrees, most);
    let named = |value: f64| (value, number(value, step));
    (values.into_iter().map(named).collect(), true)
}

/// A multiple of a round step, with as many decimals as the step has.
fn number(value: f64, step: f64) -> String {
    if step < 1e-6 || value.abs() >= 1e9 {
        return format!("{value:.2e}").replace('-', "−");
    }
    let decimals = (0..6).find(|d| (step * 10f64.powi(*d)).fract() < 1e-9);
    #[allow(clippy::cast_sign_loss, reason = "from 0 to 6")]
    let decimals = decimals.unwrap_or(6) as usize;
    format!("{:.decimals$}", value + 0.0).replace('-', "−")
}

/// A range that is not empty: what is one value gets room around it.
pub(crate) fn padded([low, high]: [f64; 2]) -> [f64; 2] {
    if !(low.is_finite() && high.is_finite()) {
        return [0.0, 1.0];
    }
    if high > low {
        return [low, high];
    }
    let by = if low == 0.0 { 1.0 } else { low.abs() * 0.1 };
    [low - by, high + by]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_the_digits_of_their_step() {
        assert_eq!(number(-0.25, 0.05), "−0.25");
        assert_eq!(number(30.0, 30.0), "30");
        assert_eq!(number(0.0, 0.2), "0.0");
        assert_eq!(number(-1e-9, 5e-10), "−1.00e−9");
    }

    #[test]
    fn a_single_value_has_room() {
        assert_eq!(padded([2.0, 2.0]), [1.8, 2.2]);
        assert_eq!(padded([f64::INFINITY, f64::NEG_INFINITY]), [0.0, 1.0]);
    }
}
