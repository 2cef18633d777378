//! The points where the nominal robot has them, each with its deviation as a magnified line; one
//! panel for each stage, with one magnification, so that they can be compared. Of the three views
//! along the axes of the measuring frame the one with the largest area is drawn.

use super::stages::thinned;
use super::{Stage, Stages};
use crate::numeric::extent;
use crate::present::chart::panel::{Panel, SMALL, padded};
use crate::present::chart::{Axis, FULL_WIDTH, among};
use crate::present::drawing::{Anchor, Drawing, Item, Label, MUTED, Shape, Stroke};

const LEFT: f64 = 30.0;
const TOP: f64 = 18.0;
const GAP: f64 = 36.0;
/// Lines in a panel.
const MOST: usize = 500;
/// A large deviation is drawn as long as this share of the view.
const LONG: f64 = 0.16;

/// The panels side by side. Also says by how much the deviations are magnified.
pub fn workspace(stages: &Stages) -> (Drawing, f64) {
    let axes = widest_view(stages);
    let extent = |axis: usize| {
        let values = column(stages, axis);
        extent(values.iter())
    };
    let (x, y) = (padded(extent(axes[0])), padded(extent(axes[1])));
    // A tool on the axis stays where it is.
    let size = (x[1] - x[0]).max(y[1] - y[0]).max(1e-6);
    let magnification = among(LONG * size / large(stages), &[8.0, 6.0, 5.0, 4.0, 3.0, 2.0]);
    let reach = size * (LONG + 0.06);
    let (x, y) = ([x[0] - reach, x[1] + reach], [y[0] - reach, y[1] + reach]);
    let count = stages.stages.len().max(1) as f64;
    let width = (FULL_WIDTH - LEFT - GAP * (count - 1.0)) / count;
    let height = (width * (y[1] - y[0]) / (x[1] - x[0])).clamp(0.35 * width, 1.5 * width);
    let mut drawing = Drawing::new(FULL_WIDTH, TOP + height + 26.0);
    for (k, stage) in stages.stages.iter().enumerate() {
        let mut panel = Panel {
            left: LEFT + k as f64 * (width + GAP),
            top: TOP,
            width,
            height,
            x,
            y,
        };
        panel.same_scale();
        let [across, upwards] = axes.map(|axis| Axis::numbers(format!("{}, mm", NAMES[axis])));
        panel.frame([&across, &upwards], [4.0, 4.0], &mut drawing);
        panel.title(&stage.name, &mut drawing);
        panel.x_label(&across.label, &mut drawing);
        lines(stages, stage, &panel, axes, magnification, &mut drawing);
    }
    let label = Label::new(
        [0.0, TOP + height / 2.0],
        format!("{}, mm", NAMES[axes[1]]),
        SMALL,
        MUTED,
    );
    let mut label = label.anchored(Anchor::Middle);
    label.at[0] = 5.0;
    label.upwards = true;
    drawing.text(label);
    (drawing, magnification)
}

const NAMES: [&str; 3] = ["x", "y", "z"];

impl Panel {
    /// Widens one range until a millimetre is as long on both axes.
    fn same_scale(&mut self) {
        let (sx, sy) = (
            self.width / (self.x[1] - self.x[0]),
            self.height / (self.y[1] - self.y[0]),
        );
        let widen = |range: &mut [f64; 2], by: f64| {
            let (middle, half) = (
                f64::midpoint(range[0], range[1]),
                (range[1] - range[0]) / 2.0,
            );
            *range = [middle - half * by, middle + half * by];
        };
        if sx > sy {
            widen(&mut self.x, sx / sy);
        } else {
            widen(&mut self.y, sy / sx);
        }
    }
}

fn column(stages: &Stages, axis: usize) -> &[f64] {
    match axis {
        0 => &stages.nominal.x_mm,
        1 => &stages.nominal.y_mm,
        _ => &stages.nominal.z_mm,
    }
}

fn widest_view(stages: &Stages) -> [usize; 2] {
    let extent = |axis: usize| {
        let [low, high] = extent(column(stages, axis).iter());
        (high - low).max(1e-6)
    };
    let mut best = [0, 1];
    for view in [[0, 2], [1, 2]] {
        let area = |view: [usize; 2]| extent(view[0]) * extent(view[1]);
        if area(view) > area(best) * (1.0 + 1e-9) {
            best = view;
        }
    }
    best
}

/// The length that one deviation in twenty exceeds at the first stage, mm.
fn large(stages: &Stages) -> f64 {
    let Some(first) = stages.stages.first() else {
        return 0.0;
    };
    let mut lengths: Vec<f64> = first.deviations.length_mm.clone();
    lengths.retain(|l| l.is_finite());
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() * 19 / 20).copied().unwrap_or(0.0)
}

fn lines(
    stages: &Stages,
    stage: &Stage,
    panel: &Panel,
    axes: [usize; 2],
    magnification: f64,
    drawing: &mut Drawing,
) {
    let lengths = &stage.deviations.length_mm;
    let mut points = stage.usable();
    points.retain(|i| stage.deviations.axes_mm[axes[0]][*i].is_finite());
    let kept = thinned(&points, MOST, |i| lengths[i]);
    let from = |i: usize| [column(stages, axes[0])[i], column(stages, axes[1])[i]];
    let mut ends = Vec::with_capacity(kept.len());
    let mut starts = Vec::with_capacity(kept.len());
    for i in kept {
        let [x, y] = from(i);
        let e = [0, 1].map(|k| stage.deviations.axes_mm[axes[k]][i] * magnification);
        starts.push(panel.at(x, y));
        // An outlier may not leave the panel and run over its neighbour.
        let within = |v: f64, [low, high]: [f64; 2]| v.clamp(low, high);
        let to = panel.at(within(x + e[0], panel.x), within(y + e[1], panel.y));
        ends.push(vec![panel.at(x, y), to]);
    }
    drawing
        .items
        .push(Item::Lines(ends, Stroke::new(0.8, stage.role.on_paper())));
    drawing.items.push(Item::Marks {
        shape: Shape::Square,
        at: starts,
        half: 1.0,
        colour: MUTED,
        filled: true,
    });
}
