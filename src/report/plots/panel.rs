//! A rectangle with scales: frame, grid, ticks with numbers.

use super::round_below;
use crate::report::drawing::{Anchor, Drawing, INK, Label, MUTED, RULE, Stroke};
use crate::report::numbers::short;

/// Size of the numbers at the ticks, points.
pub(crate) const SMALL: f64 = 7.0;

/// See the module.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Panel {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) x: [f64; 2],
    pub(crate) y: [f64; 2],
}

impl Panel {
    pub(crate) fn at(&self, x: f64, y: f64) -> [f64; 2] {
        let share = |v: f64, [low, high]: [f64; 2]| (v - low) / (high - low);
        [
            self.left + self.width * share(x, self.x),
            self.top + self.height * (1.0 - share(y, self.y)),
        ]
    }

    /// Grid lines with numbers, then the frame.
    pub(crate) fn frame(&self, ticks: [usize; 2], drawing: &mut Drawing) {
        let bottom = self.top + self.height;
        for x in round_values(self.x, ticks[0]) {
            let [at, _] = self.at(x, self.y[0]);
            drawing.line([at, self.top], [at, bottom], Stroke::new(0.4, RULE));
            let label = Label::new([at, bottom + SMALL + 2.5], short(x), SMALL, MUTED);
            drawing.text(label.anchored(Anchor::Middle));
        }
        for y in round_values(self.y, ticks[1]) {
            let [_, at] = self.at(self.x[0], y);
            let right = self.left + self.width;
            drawing.line([self.left, at], [right, at], Stroke::new(0.4, RULE));
            let label = Label::new([self.left - 4.0, at + 2.4], short(y), SMALL, MUTED);
            drawing.text(label.anchored(Anchor::End));
        }
        let left_top = [self.left, self.top];
        let left_bottom = [self.left, bottom];
        let right_bottom = [self.left + self.width, bottom];
        let frame = vec![left_top, left_bottom, right_bottom];
        let stroke = Stroke::new(0.6, MUTED);
        drawing
            .items
            .push(crate::report::drawing::Item::Lines(vec![frame], stroke));
    }

    pub(crate) fn title(&self, title: &str, drawing: &mut Drawing) {
        let label = Label::new([self.left, self.top - 6.0], title, 8.0, INK);
        drawing.text(label.bold());
    }

    pub(crate) fn x_label(&self, label: &str, drawing: &mut Drawing) {
        let at = [self.left + self.width / 2.0, self.top + self.height + 20.0];
        drawing.text(Label::new(at, label, SMALL, MUTED).anchored(Anchor::Middle));
    }

    pub(crate) fn y_label(&self, label: &str, left: f64, drawing: &mut Drawing) {
        let mut label = Label::new([left, self.top + self.height / 2.0], label, SMALL, MUTED);
        label.upwards = true;
        drawing.text(label.anchored(Anchor::Middle));
    }
}

/// Round values in a range, at most about `most` of them.
pub(crate) fn round_values([low, high]: [f64; 2], most: usize) -> Vec<f64> {
    let wanted = (high - low) / most as f64;
    let mut step = round_below(wanted);
    if !(wanted > 0.0 && wanted.is_finite()) {
        return Vec::new();
    }
    while step < wanted * (1.0 - 1e-9) {
        step = round_below(step * 2.5);
    }
    let first = (low / step - 1e-9).ceil();
    let values = (0..=most + 1).map(|k| (first + k as f64) * step);
    values.take_while(|v| *v <= high + step * 1e-9).collect()
}

/// A range that is not empty: what is one value gets room around it.
pub(crate) fn room([low, high]: [f64; 2]) -> [f64; 2] {
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
    fn ticks_are_round_and_few() {
        assert_eq!(
            round_values([-150.0, 150.0], 6),
            [-150.0, -100.0, -50.0, 0.0, 50.0, 100.0, 150.0]
        );
        assert_eq!(round_values([0.0, 3.3], 4), [0.0, 1.0, 2.0, 3.0]);
        assert!(round_values([1.0, 1.0], 4).is_empty());
        assert_eq!(room([2.0, 2.0]), [1.8, 2.2]);
        assert_eq!(room([f64::INFINITY, f64::NEG_INFINITY]), [0.0, 1.0]);
    }
}
