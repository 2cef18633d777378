//! The gap step by step, from the nominal robot to the model with everything that was found. A bar
//! is the gap of the samples that were fitted, a diamond that of samples that no fit has seen.

use super::FULL_WIDTH;
use crate::model::GapStep;
use crate::report::drawing::{
    AFTER, BEFORE, CORRECTED, Colour, Drawing, INK, Item, Label, MUTED, Shape, Stroke,
};
use crate::report::numbers::plain;

const ROW: f64 = 17.0;
const TOP: f64 = 20.0;
const NAMES: f64 = 150.0;
const NUMBERS: f64 = 100.0;
/// Steps that are drawn; a longer history is drawn from its ends.
const MOST: usize = 24;

/// The steps as bars, with the noise floor and the tolerance as lines.
pub fn waterfall(steps: &[GapStep], floor_mm: Option<f64>, tolerance_mm: Option<f64>) -> Drawing {
    let shown: Vec<&GapStep> = if steps.len() > MOST {
        let half = MOST / 2;
        steps[..half]
            .iter()
            .chain(&steps[steps.len() - half..])
            .collect()
    } else {
        steps.iter().collect()
    };
    let height = TOP + ROW * shown.len() as f64 + 14.0;
    let mut drawing = Drawing::new(FULL_WIDTH, height);
    let values = shown
        .iter()
        .flat_map(|s| [Some(s.gap_mm), s.held_out_mm])
        .flatten();
    let largest = values.filter(|v| v.is_finite()).fold(0.0, f64::max);
    let width = FULL_WIDTH - NAMES - NUMBERS;
    let scale = if largest > 0.0 { width / largest } else { 0.0 };
    let bottom = TOP + ROW * shown.len() as f64;
    for (k, step) in shown.iter().enumerate() {
        let y = TOP + ROW * k as f64;
        let middle = y + ROW / 2.0;
        drawing.text(Label::new([0.0, middle + 2.8], step.what.clone(), 8.0, INK));
        let colour = colour(k, shown.len());
        let length = (step.gap_mm * scale).max(0.8);
        drawing
            .items
            .push(Item::Box([NAMES, y + 3.0], [length, ROW - 6.0], colour));
        let held = step.held_out_mm.map(|mm| NAMES + mm * scale);
        if let Some(at) = held {
            drawing.items.push(Item::Marks {
                shape: Shape::Diamond,
                at: vec![[at, middle]],
                half: 3.2,
                colour: INK,
                filled: false,
            });
        }
        let right = FULL_WIDTH - NUMBERS + 8.0;
        drawing.text(Label::new([right, middle + 2.8], plain(step.gap_mm), 8.0, INK).bold());
        if let Some(mm) = step.held_out_mm {
            drawing.text(Label::new(
                [right + 48.0, middle + 2.8],
                plain(mm),
                8.0,
                MUTED,
            ));
        }
    }
    let right = FULL_WIDTH - NUMBERS + 8.0;
    drawing.text(Label::new([right, TOP - 6.0], "fit, mm", 7.0, MUTED));
    drawing.text(Label::new(
        [right + 48.0, TOP - 6.0],
        "unseen, mm",
        7.0,
        MUTED,
    ));
    let mut legend = NAMES;
    for (name, value, dash) in [
        ("noise floor", floor_mm, [4.0, 2.5]),
        ("tolerance", tolerance_mm, [1.2, 2.0]),
    ] {
        let Some(mm) = value.filter(|mm| *mm * scale <= width && mm.is_finite()) else {
            continue;
        };
        let x = NAMES + mm * scale;
        let stroke = Stroke::new(0.9, INK).dashed(dash[0], dash[1]);
        drawing.line([x, TOP], [x, bottom], stroke);
        drawing.line(
            [legend, bottom + 8.0],
            [legend + 18.0, bottom + 8.0],
            stroke,
        );
        let label = format!("{name} {} mm", plain(mm));
        drawing.text(Label::new(
            [legend + 22.0, bottom + 10.5],
            label,
            7.0,
            MUTED,
        ));
        legend += 122.0;
    }
    if shown.iter().any(|s| s.held_out_mm.is_some()) {
        drawing.items.push(Item::Marks {
            shape: Shape::Diamond,
            at: vec![[4.0, bottom + 8.0]],
            half: 3.2,
            colour: INK,
            filled: false,
        });
        drawing.text(Label::new(
            [11.0, bottom + 10.5],
            "on samples that no fit has seen",
            7.0,
            MUTED,
        ));
    }
    drawing
}

fn colour(step: usize, steps: usize) -> Colour {
    match step {
        0 => BEFORE,
        k if k + 1 == steps => AFTER,
        _ => CORRECTED,
    }
}
