//! The gap step by step, from the nominal robot to the model with everything that was found. A bar
//! is the gap of the samples that were fitted, a diamond that of samples that no fit has seen.

use super::{FULL_WIDTH, shortened};
use crate::model::GapStep;
use crate::report::drawing::{
    AFTER, BEFORE, CORRECTED, Colour, Drawing, INK, Item, Label, MUTED, Shape, Stroke,
};
use crate::report::numbers::{plain, short};

const ROW: f64 = 17.0;
const TOP: f64 = 20.0;
const NAMES: f64 = 150.0;
const NUMBERS: f64 = 100.0;
/// Steps that are drawn; a longer history is drawn from its ends.
const MOST: usize = 24;

/// Where the numbers stand.
const RIGHT: f64 = FULL_WIDTH - NUMBERS + 8.0;

/// The steps as bars, with the noise floor and the tolerance as lines.
pub fn waterfall(steps: &[GapStep], floor_mm: Option<f64>, tolerance_mm: Option<f64>) -> Drawing {
    let shown = ends(steps);
    let bottom = TOP + ROW * shown.len() as f64;
    let mut drawing = Drawing::new(FULL_WIDTH, bottom + 14.0);
    let gaps = shown.iter().flat_map(|s| [Some(s.gap_mm), s.held_out_mm]);
    let finite = gaps.flatten().filter(|mm| mm.is_finite());
    let largest = finite.fold(0.0, f64::max);
    let width = FULL_WIDTH - NAMES - NUMBERS;
    let scale = if largest > 0.0 { width / largest } else { 0.0 };
    let heads = [(0.0, "fit, mm"), (48.0, "cross-validated, mm")];
    for (by, head) in heads {
        drawing.text(Label::new([RIGHT + by, TOP - 6.0], head, 7.0, MUTED));
    }
    for (k, step) in shown.iter().enumerate() {
        let colour = match k {
            0 => BEFORE,
            k if k + 1 == shown.len() => AFTER,
            _ => CORRECTED,
        };
        bar(step, TOP + ROW * k as f64, scale, colour, &mut drawing);
    }
    let mut legend = NAMES;
    for (name, value, dash) in [
        ("noise floor", floor_mm, [4.0, 2.5]),
        ("tolerance", tolerance_mm, [1.2, 2.0]),
    ] {
        let Some(mm) = value.filter(|mm| *mm * scale <= width && mm.is_finite()) else {
            continue;
        };
        let stroke = Stroke::new(0.9, INK).dashed(dash[0], dash[1]);
        let x = NAMES + mm * scale;
        drawing.line([x, TOP], [x, bottom], stroke);
        let y = bottom + 8.0;
        drawing.line([legend, y], [legend + 18.0, y], stroke);
        let label = format!("{name} {} mm", short(mm));
        drawing.text(Label::new([legend + 22.0, y + 2.5], label, 7.0, MUTED));
        legend += 122.0;
    }
    if shown.iter().any(|s| s.held_out_mm.is_some()) {
        diamond([4.0, bottom + 8.0], &mut drawing);
        let label = "on samples that no fit has seen";
        drawing.text(Label::new([11.0, bottom + 10.5], label, 7.0, MUTED));
    }
    drawing
}

/// All steps, or the first and the last of many.
fn ends(steps: &[GapStep]) -> Vec<&GapStep> {
    if steps.len() <= MOST {
        return steps.iter().collect();
    }
    let (first, last) = (&steps[..MOST / 2], &steps[steps.len() - MOST / 2..]);
    first.iter().chain(last).collect()
}

fn bar(step: &GapStep, y: f64, scale: f64, colour: Colour, drawing: &mut Drawing) {
    let middle = y + ROW / 2.0;
    let base = middle + 2.8;
    let name = shortened(&step.what, 34);
    drawing.text(Label::new([0.0, base], name, 8.0, INK));
    let length = (step.gap_mm * scale).max(0.8);
    let size = [length, ROW - 6.0];
    drawing
        .items
        .push(Item::Box([NAMES, y + 3.0], size, colour));
    drawing.text(Label::new([RIGHT, base], plain(step.gap_mm), 8.0, INK).bold());
    if let Some(mm) = step.held_out_mm {
        diamond([NAMES + mm * scale, middle], drawing);
        drawing.text(Label::new([RIGHT + 48.0, base], plain(mm), 8.0, MUTED));
    }
}

fn diamond(at: [f64; 2], drawing: &mut Drawing) {
    drawing.items.push(Item::Marks {
        shape: Shape::Diamond,
        at: vec![at],
        half: 3.2,
        colour: INK,
        filled: false,
    });
}
