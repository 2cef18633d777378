//! The polar view as a drawing for a file.

use std::f64::consts::TAU;

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, Subject};
use crate::present::drawing::{
    AFTER, Anchor, BEFORE, Drawing, INK, Item, Label, MUTED, RULE, Shape, Stroke,
};
use crate::present::numbers::trimmed;

use super::layout::{self, Bearing, NOMINAL, SPOKES};
use super::model::{Polar, Spot, absent};

/// Width and height of the circle's square, points.
const SQUARE: f64 = 360.0;
/// Room for the title and what the marks mean, points.
const HEAD: f64 = 18.0;
const FOOT: f64 = 34.0;
/// Samples on a sheet; more are thinned, and the sheet says so.
const MOST: usize = 4000;

/// The view of a session on a sheet.
///
/// # Errors
/// Why it has none, in words.
pub(crate) fn sheet(
    subject: &Subject,
    answer: Option<&Answer>,
    component: Component,
    only_after: bool,
    tolerance_mm: Option<f64>,
) -> Result<Drawing, String> {
    if let Some(because) = absent(subject) {
        return Err(because.to_owned());
    }
    let usable = &subject.overview.usable;
    let stride = crate::gui::core::scale::stride(usable.len(), MOST);
    let samples = usable.iter().step_by(stride).map(|s| *s as usize);
    let spots = samples.map(|sample| Spot::of(subject, answer, component, sample));
    let only_after = only_after && answer.is_some();
    let mut polar = Polar::from_spots(spots.collect(), component, only_after);
    polar.tolerance_mm = tolerance_mm;
    let mut drawing = Drawing::new(SQUARE, HEAD + SQUARE + FOOT);
    let [low, high] = layout::bounds(&polar);
    let scale = SQUARE / (high[0] - low[0]);
    let middle = [0.5 * SQUARE, HEAD + 0.5 * SQUARE];
    let at = |[x, y]: [f64; 2]| [middle[0] + scale * x, middle[1] - scale * y];
    let bearing = Bearing::of([1.0, 0.0], [0.0, 1.0]);
    ground(&mut drawing, &polar, bearing, &at);
    for (traces, stroke) in [
        (&polar.before, Stroke::new(0.8, BEFORE).dashed(3.0, 2.0)),
        (&polar.after, Stroke::new(1.0, AFTER)),
    ] {
        let pieces = traces.iter().flat_map(|trace| &trace.pieces);
        let point = |[q, mm]: &[f64; 2]| at(bearing.at(*q, layout::radius(&polar, *mm)));
        let lines = pieces.map(|piece| piece.iter().map(point).collect());
        drawing.items.push(Item::Lines(lines.collect(), stroke));
    }
    marks(&mut drawing, &polar, bearing, only_after, &at);
    words(&mut drawing, &polar, answer.is_some(), only_after, stride);
    Ok(drawing)
}

fn ground(
    drawing: &mut Drawing,
    polar: &Polar,
    bearing: Bearing,
    at: &impl Fn([f64; 2]) -> [f64; 2],
) {
    let ring = |divisions: f64| layout::circle(divisions).into_iter().map(at).collect();
    let thin = Stroke::new(0.4, RULE);
    let [inside, outside] = polar.divisions;
    for (most, way) in [(inside, -1.0), (outside, 1.0)] {
        let rings = (1..=crate::numeric::whole(most)).map(|k| ring(NOMINAL + way * k as f64));
        drawing.items.push(Item::Lines(rings.collect(), thin));
    }
    for k in 0..SPOKES {
        let q = TAU * f64::from(k) / f64::from(SPOKES);
        let ends = [NOMINAL - inside, NOMINAL + outside];
        let [from, to] = ends.map(|divisions| at(bearing.at(q, divisions)));
        drawing.line(from, to, thin);
        let name = at(bearing.at(q, NOMINAL + outside + 0.9));
        let degrees = if k > SPOKES / 2 {
            30.0 * f64::from(k) - 360.0
        } else {
            30.0 * f64::from(k)
        };
        let text = format!("{}°", trimmed(degrees, 0));
        let label = Label::new([name[0], name[1] + 2.5], text, 7.0, MUTED);
        drawing.text(label.anchored(Anchor::Middle));
    }
    if let Some(band) = polar.band_mm() {
        let stroke = Stroke::new(0.7, AFTER).dashed(2.0, 2.0);
        let circles = band.map(|mm| ring(layout::radius(polar, mm))).to_vec();
        drawing.items.push(Item::Lines(circles, stroke));
    }
    let nominal = Item::Lines(vec![ring(NOMINAL)], Stroke::new(1.0, MUTED));
    drawing.items.push(nominal);
}

/// Before is an outline, after is filled; the form tells the side.
fn marks(
    drawing: &mut Drawing,
    polar: &Polar,
    bearing: Bearing,
    only_after: bool,
    at: &impl Fn([f64; 2]) -> [f64; 2],
) {
    for (side, shape) in [(1.0, Shape::Up), (-1.0, Shape::Down), (0.0, Shape::Square)] {
        let of_side = || polar.spots.iter().filter(move |s| s.side == side);
        let place = |q: f64, mm: f64| at(bearing.at(q, layout::radius(polar, mm)));
        let finite = |p: &[f64; 2]| p[0].is_finite() && p[1].is_finite();
        let before = of_side().filter(|_| !only_after);
        let before = before.map(|s| place(s.q, s.before_mm));
        let after = of_side().filter_map(|s| Some(place(s.q, s.after_mm?)));
        let (before, after) = (before.filter(finite), after.filter(finite));
        for (at, colour, filled) in [
            (before.collect::<Vec<_>>(), BEFORE, false),
            (after.collect(), AFTER, true),
        ] {
            if !at.is_empty() {
                let half = 2.0;
                drawing.items.push(Item::Marks {
                    shape,
                    at,
                    half,
                    colour,
                    filled,
                });
            }
        }
    }
}

fn words(drawing: &mut Drawing, polar: &Polar, answered: bool, only_after: bool, stride: usize) {
    let title = say!(
        "{component} deviation around the angle",
        component = polar.component.name()
    );
    drawing.text(Label::new([0.0, 11.0], title, 9.0, INK).bold());
    let scale = say!(
        "1 division = {division} mm; the thick circle is nominal",
        division = trimmed(polar.division_mm, 6)
    );
    let mut says = vec![scale];
    let shown = match (answered, only_after) {
        (false, _) => say!("outline: before"),
        (true, false) => say!("outline: before, filled: after"),
        (true, true) => say!("filled: after"),
    };
    let mut marks = shown.to_owned();
    if polar.spots.iter().any(|s| s.side != 0.0) {
        marks += say!("; tip up: moving positive, tip down: negative");
    }
    if let Some(tolerance) = polar.tolerance_mm {
        marks += &say!(
            "; dashed: tolerance {tolerance} mm",
            tolerance = trimmed(tolerance, 6)
        );
    }
    if stride > 1 {
        marks += &say!("; 1 of {stride} samples", stride = stride);
    }
    says.push(marks);
    for (k, line) in says.into_iter().enumerate() {
        let y = HEAD + SQUARE + 11.0 + 11.0 * k as f64;
        drawing.text(Label::new([0.0, y], line, 7.0, MUTED));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;

    #[test]
    fn a_sheet_holds_every_sample_and_states_its_scale() {
        let workbench = workbench();
        let subject = workbench.subject();
        let drawing = sheet(subject, None, Component::Radial, true, Some(0.2)).expect("it turns");
        let count = |item: &Item| match item {
            Item::Marks { at, .. } => at.len(),
            _ => 0,
        };
        assert_eq!(
            drawing.items.iter().map(count).sum::<usize>(),
            subject.len()
        );
        let says = |part: &str| {
            let mut items = drawing.items.iter();
            items.any(|item| matches!(item, Item::Text(label) if label.text.contains(part)))
        };
        assert!(says("1 division = ") && says("tolerance 0.2 mm") && says("moving positive"));
        for item in &drawing.items {
            if let Item::Marks { at, .. } = item {
                let inside = |p: &[f64; 2]| {
                    p[0] > 0.0 && p[0] < drawing.width && p[1] > 0.0 && p[1] < drawing.height
                };
                assert!(at.iter().all(inside));
            }
        }
    }
}
