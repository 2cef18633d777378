//! The length of the deviation over a joint's value, one panel for each stage, each with its own
//! scale. The form of a mark says from which side the joint came.

use super::panel::{Panel, room};
use super::{FULL_WIDTH, Stage, Stages, thinned};
use crate::report::drawing::{Drawing, INK, Item, Label, MUTED, Shape, Stroke};
use crate::report::numbers::short;

const PANEL: f64 = 92.0;
const TOP: f64 = 18.0;
const BETWEEN: f64 = 34.0;
const LEFT: f64 = 46.0;
/// Marks in a panel.
const MOST: usize = 1200;

/// One panel below the other.
pub fn deviation(stages: &Stages) -> Drawing {
    let count = stages.stages.len() as f64;
    let mut drawing = Drawing::new(FULL_WIDTH, TOP + count * (PANEL + BETWEEN) + 6.0);
    let (low, high) = stages
        .values
        .iter()
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(*v), b.max(*v))
        });
    let [low, high] = room([low, high]);
    let margin = (high - low) * 0.02;
    for (k, stage) in stages.stages.iter().enumerate() {
        let panel = Panel {
            left: LEFT,
            top: TOP + k as f64 * (PANEL + BETWEEN),
            width: FULL_WIDTH - LEFT - 4.0,
            height: PANEL,
            x: [low - margin, high + margin],
            y: [0.0, highest(stages, stage) * 1.06],
        };
        draw(stages, stage, &panel, &mut drawing);
        if k + 1 == stages.stages.len() {
            panel.x_label(&stages.over, &mut drawing);
        }
    }
    legend(stages, &mut drawing);
    drawing
}

/// The floor and the tolerance are shown where they do not flatten what there is to see.
fn highest(stages: &Stages, stage: &Stage) -> f64 {
    let lengths = stage.deviations.length_mm.iter();
    let largest = lengths
        .filter(|l| l.is_finite())
        .fold(0.0, |a: f64, b| a.max(*b));
    let lines = [stages.floor_mm, stages.tolerance_mm].into_iter().flatten();
    let top = lines
        .filter(|mm| *mm <= 4.0 * largest)
        .fold(largest, f64::max);
    // Below that there is only rounding to see.
    top.max(1e-6)
}

fn draw(stages: &Stages, stage: &Stage, panel: &Panel, drawing: &mut Drawing) {
    panel.frame([8, 4], drawing);
    panel.title(&stage.name, drawing);
    panel.y_label("deviation, mm", 8.0, drawing);
    let lengths = &stage.deviations.length_mm;
    let kept = thinned(&stage.usable(), MOST, |i| lengths[i]);
    for (shape, side) in [(Shape::Square, 0.0), (Shape::Up, 1.0), (Shape::Down, -1.0)] {
        let of_side = kept.iter().filter(|i| stages.side[**i] == side);
        let at: Vec<[f64; 2]> = of_side
            .map(|i| panel.at(stages.values[*i], lengths[*i]))
            .collect();
        if !at.is_empty() {
            drawing.items.push(Item::Marks {
                shape,
                at,
                half: 1.7,
                colour: stage.colour,
                filled: side >= 0.0,
            });
        }
    }
    for (mm, dash) in [
        (stages.floor_mm, [4.0, 2.5]),
        (stages.tolerance_mm, [1.2, 2.0]),
    ] {
        if let Some(mm) = mm.filter(|mm| *mm <= panel.y[1]) {
            let stroke = Stroke::new(0.9, INK).dashed(dash[0], dash[1]);
            drawing.line(panel.at(panel.x[0], mm), panel.at(panel.x[1], mm), stroke);
        }
    }
}

fn legend(stages: &Stages, drawing: &mut Drawing) {
    let y = drawing.height - 4.0;
    let mut x = LEFT;
    let known = stages.side.iter().any(|s| *s != 0.0);
    let marks: &[(Shape, bool, &str)] = if known {
        &[
            (Shape::Up, true, "from below"),
            (Shape::Down, false, "from above"),
        ]
    } else {
        &[(Shape::Square, true, "side not known")]
    };
    for (shape, filled, name) in marks {
        drawing.items.push(Item::Marks {
            shape: *shape,
            at: vec![[x + 2.0, y - 2.4]],
            half: 2.2,
            colour: MUTED,
            filled: *filled,
        });
        drawing.text(Label::new([x + 8.0, y], *name, 7.0, MUTED));
        x += 62.0;
    }
    for (name, mm, dash) in [
        ("noise floor", stages.floor_mm, [4.0, 2.5]),
        ("tolerance", stages.tolerance_mm, [1.2, 2.0]),
    ] {
        let Some(mm) = mm else { continue };
        let stroke = Stroke::new(0.9, INK).dashed(dash[0], dash[1]);
        drawing.line([x, y - 2.4], [x + 18.0, y - 2.4], stroke);
        let text = format!("{name} {} mm", short(mm));
        drawing.text(Label::new([x + 22.0, y], text, 7.0, MUTED));
        x += 120.0;
    }
}
