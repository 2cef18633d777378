//! What the polar view shows, as a scene: its first coordinate is the angle of the joint, rad, its
//! second the deviation, divisions. Before is hollow, after is filled; triangles point the way that
//! the joint came.

use std::f64::consts::TAU;

use crate::gui::cache::charts::Envelope;
use crate::gui::scene::{ColourToken, Form, Item, Label, LegendEntry, Mark, Place, Scene, Stroke};
use crate::gui::workbench::Workbench;
use crate::numeric::single;
use crate::present::numbers::trimmed;
use crate::present::units::Units;

use super::super::pointer::marked;
use super::model::{Polar, PolarSample, Trace};

/// Radius of the nominal circle, divisions.
pub(super) const NOMINAL: f64 = 8.0;
/// Spokes are so many parts of a turn apart.
const SPOKES: u8 = 12;
/// Room for the names of the spokes, divisions.
const ROOM: f64 = 1.9;
/// Chords of circles are parts of a turn.
const CHORDS: u16 = 180;
/// More samples than this are shown by their extremes.
const MOST_SPOTS: usize = 600;
/// Columns of extremes around.
const COLUMNS: usize = 720;
/// The least thickness of extremes, points.
const LEAST: f64 = 1.5;

/// Smallest and largest corner, divisions from the middle.
pub(super) fn bounds(polar: &Polar) -> [[f64; 2]; 2] {
    let out = NOMINAL + polar.divisions[1] + ROOM;
    [[-out; 2], [out; 2]]
}

/// The view where a division is so many points.
pub(super) fn scene(workbench: &Workbench, polar: &Polar, points: f64) -> Scene {
    let loaded_session = &**workbench.loaded_session();
    let view = workbench.view();
    let only_after = workbench.only_after();
    let of =
        |sample: usize| PolarSample::of(loaded_session, workbench.answer(), view.component, sample);
    let mut scene = Scene::default();
    axes(&mut scene, polar);
    match workbench.around() {
        Some(envelope) if envelope.count(polar.range) > MOST_SPOTS => {
            extremes(&mut scene, polar, envelope, only_after, LEAST / points);
        }
        Some(envelope) => {
            let all = envelope.samples(polar.range, MOST_SPOTS);
            let spots: Vec<PolarSample> = all.map(of).collect();
            dots(&mut scene, polar, &spots, only_after);
        }
        None => {
            means(&mut scene, polar);
            dots(&mut scene, polar, &polar.spots, only_after);
        }
    }
    let emphasised = view.hovered.or(view.selected);
    let there = marked(view, loaded_session.len()).chain(emphasised);
    for sample in there.filter(|sample| loaded_session.usable[*sample]) {
        for at in places(polar, &of(sample), only_after).into_iter().flatten() {
            let ring = Stroke::new(2.5, ColourToken::Accent);
            scene.mark(Mark::ring(at, Form::Disc, 8.0, ring));
        }
    }
    names(&mut scene, polar, workbench.units());
    scene
}

/// Where a spot's deviations are: before, unless only what is left is shown, and after.
pub(super) fn places(polar: &Polar, spot: &PolarSample, only_after: bool) -> [Option<[f64; 3]>; 2] {
    let at = |mm: f64| {
        let at = [spot.q, mm / polar.division_mm, 0.0];
        at.iter().all(|v| v.is_finite()).then_some(at)
    };
    let before = (!only_after || spot.after_mm.is_none()).then_some(spot.before_mm);
    [before.and_then(at), spot.after_mm.and_then(at)]
}

/// A circle at so many divisions from the nominal one; a piece of it begins at each angle.
fn circle(divisions: f64) -> impl Iterator<Item = Place> {
    (0..=CHORDS).map(move |k| {
        let q = TAU * f64::from(k) / f64::from(CHORDS);
        Place::from([q, divisions, 0.0])
    })
}

/// Rings, spokes, the tolerance and the nominal circle.
fn axes(scene: &mut Scene, polar: &Polar) {
    let ring = |divisions: f64, stroke| Item::Line(circle(divisions).collect(), stroke);
    if let Some(band) = polar.band_mm() {
        let [inner, outer] = band.map(|mm| mm / polar.division_mm);
        let fill = ColourToken::Within.clear(0.16);
        let ends = circle(inner).zip(circle(outer));
        let net = ends.flat_map(|(a, b)| [(a, fill), (b, fill)]);
        scene.items.push(Item::Net(net.collect(), 2));
        let edge = Stroke::new(1.0, ColourToken::Within.clear(0.7)).dashed(4.0, 3.0);
        scene.items.extend([inner, outer].map(|at| ring(at, edge)));
    }
    let thin = Stroke::new(1.0, ColourToken::Line);
    let [inside, outside] = polar.divisions;
    for (most, way) in [(inside, -1.0), (outside, 1.0)] {
        let rings = (1..=crate::numeric::whole(most)).map(|k| ring(way * k as f64, thin));
        scene.items.extend(rings);
    }
    for k in 0..SPOKES {
        scene.line([-inside, outside].map(|at| [spoke(k), at, 0.0]), thin);
    }
    let nominal = Stroke::new(1.75, ColourToken::Nominal);
    scene.items.push(ring(0.0, nominal));
}

fn spoke(k: u8) -> f64 {
    TAU * f64::from(k) / f64::from(SPOKES)
}

/// Means at each angle: before is dashed.
fn means(scene: &mut Scene, polar: &Polar) {
    let before = Stroke::new(1.25, ColourToken::Before.clear(0.8)).dashed(5.0, 3.0);
    let after = Stroke::new(1.5, ColourToken::After);
    let lines = |traces: &[Trace], stroke| -> Vec<Item> {
        let point = |[q, mm]: &[f64; 2]| Place::from([*q, mm / polar.division_mm, 0.0]);
        let pieces = traces.iter().flat_map(|trace| &trace.pieces);
        let line = |piece: &Vec<[f64; 2]>| Item::Line(piece.iter().map(point).collect(), stroke);
        pieces.map(line).collect()
    };
    scene.items.extend(lines(&polar.before, before));
    scene.items.extend(lines(&polar.after, after));
}

fn dots(scene: &mut Scene, polar: &Polar, spots: &[PolarSample], only_after: bool) {
    let identified = spots.iter().any(|s| s.after_mm.is_some());
    let form = |spot: &PolarSample| match spot.side {
        0.0 => Form::Disc,
        side => Form::Ahead([side.signum(), 0.0, 0.0]),
    };
    let mut after = Vec::new();
    for spot in spots {
        let at = places(polar, spot, only_after);
        if let Some(at) = at[0] {
            let part = if identified { 0.75 } else { 1.0 };
            let edge = Stroke::new(1.2, ColourToken::Before.clear(part));
            let mark = Mark::ring(at, form(spot), 3.2, edge).of(spot.sample);
            let fill = (!identified).then(|| ColourToken::Before.clear(0.35));
            scene.mark(Mark { fill, ..mark });
        }
        if let Some(at) = at[1] {
            let edge = Stroke::new(0.8, ColourToken::Surface);
            let mark = Mark::filled(at, form(spot), 3.4, ColourToken::After).edged(edge);
            after.push(Item::Mark(mark.of(spot.sample)));
        }
    }
    scene.items.extend(after);
}

/// What lies between the smallest and the largest deviation in each piece of the circle, at least so
/// thick.
fn extremes(scene: &mut Scene, polar: &Polar, envelope: &Envelope, only_after: bool, least: f64) {
    let [low, high] = polar.range;
    let columns = envelope.columns([low, high + 1e-9], COLUMNS);
    let thick = |mm: [f64; 2]| {
        // Nothing reaches over the middle.
        let [a, b] = mm.map(|mm| (mm / polar.division_mm).max(-NOMINAL));
        let more = (0.5 * (least - (b - a))).max(0.0);
        [a - more, b + more]
    };
    let mut pieces = Vec::new();
    let mut add = |q: [f64; 2], [low, high]: [f64; 2], ink| {
        let corners = [(q[0], low), (q[0], high), (q[1], high), (q[1], low)];
        let [a, b, c, d] = corners.map(|(q, at)| [single(q), single(at), 0.0]);
        pieces.extend([([a, b, c], ink), ([a, c, d], ink)]);
    };
    for column in columns.iter().filter(|_| !only_after) {
        if let Some([low, high]) = column.before_mm.map(thick) {
            add(column.x, [low, high], ColourToken::Before.clear(0.3));
            add(column.x, [low, low + least], ColourToken::Before.into());
            add(column.x, [high - least, high], ColourToken::Before.into());
        }
    }
    for column in columns.iter() {
        if let Some(ends) = column.after_mm.map(thick) {
            add(column.x, ends, ColourToken::After.clear(0.85));
        }
    }
    scene.items.push(Item::Triangles(pieces));
}

/// Angles around, and what the rings stand for. What would lie on its neighbour is left out, and
/// nothing is cut by the frame.
fn names(scene: &mut Scene, polar: &Polar, units: Units) {
    let [inside, outside] = polar.divisions;
    // The quarters first: they stay where there is room for few.
    let mut spokes: Vec<u8> = (0..SPOKES).collect();
    spokes.sort_by_key(|k| (k % 3 != 0, k % 2 != 0, *k));
    for k in spokes {
        let q = spoke(k);
        // Angles as joints have them: from −180° to 180°.
        let turn = if q > std::f64::consts::PI + 1e-9 {
            TAU
        } else {
            0.0
        };
        let name = Label::new(
            [q, outside + 0.9, 0.0],
            units.angle(q - turn),
            ColourToken::Muted,
        );
        let room = Some([4.0, 1.0]);
        scene.label(Label {
            padding: room,
            ..name
        });
    }
    for divisions in [outside, -inside] {
        let value = units.length_value(divisions * polar.division_mm);
        let says = format!("{} {}", trimmed(value, 6), units.length_name());
        let name = Label::new([names_at(polar), divisions, 0.0], says, ColourToken::Muted);
        scene.label(Label {
            padding: Some([3.0, 1.0]),
            background: Some(ColourToken::Surface.into()),
            ..name
        });
    }
}

/// The angle at which the rings are named: in the widest place without samples, or else between
/// two spokes.
fn names_at(polar: &Polar) -> f64 {
    let [low, high] = polar.range;
    let free = TAU - (high - low);
    let middle = if free.is_finite() && free > spoke(1) {
        high + 0.5 * free
    } else {
        0.0
    };
    // Never on a spoke, whose own name stands there.
    ((middle / spoke(1)).floor() + 0.5) * spoke(1)
}

/// What the marks mean.
pub(crate) fn legend(workbench: &Workbench, polar: &Polar) -> Vec<LegendEntry> {
    let answered = workbench.answer().is_some();
    let only_after = workbench.only_after();
    let middle = [0.0; 3];
    let line = |width, token: ColourToken| Stroke::new(width, token);
    let mut all = vec![LegendEntry::line(
        say!("nominal circle"),
        line(1.75, ColourToken::Nominal),
    )];
    if !only_after {
        let ring = Mark::ring(middle, Form::Disc, 3.4, line(1.2, ColourToken::Before));
        all.push(LegendEntry::mark(say!("before"), ring));
    }
    if answered {
        let disc = Mark::filled(middle, Form::Disc, 2.8, ColourToken::After);
        all.push(LegendEntry::mark(say!("after"), disc));
    }
    if workbench.around().is_none() {
        if !only_after {
            let dashes = line(1.25, ColourToken::Before).dashed(4.0, 2.5);
            all.push(LegendEntry::line(say!("mean before"), dashes));
        }
        if answered {
            all.push(LegendEntry::line(
                say!("mean after"),
                line(1.5, ColourToken::After),
            ));
        }
    }
    if polar.spots.iter().any(|s| s.side != 0.0) {
        for (name, side) in [(say!("approach +"), 1.0), (say!("approach −"), -1.0)] {
            let edge = line(1.2, ColourToken::Muted);
            let mark = Mark::ring(middle, Form::Ahead([side, 0.0, 0.0]), 3.4, edge);
            all.push(LegendEntry::mark(name, mark));
        }
    }
    if polar.tolerance_mm.is_some() {
        all.push(LegendEntry::band(
            say!("tolerance"),
            ColourToken::Within.clear(0.3),
        ));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::loaded_session::Component;

    fn polar() -> Polar {
        let spot = PolarSample {
            sample: 0,
            q: 0.5,
            before_mm: 0.4,
            after_mm: Some(-0.1),
            side: 0.0,
        };
        Polar::from_spots(vec![spot], Component::Radial, false, 1.0)
    }

    #[test]
    fn a_deviation_outwards_is_outside_the_nominal_circle_by_its_divisions() {
        let polar = polar();
        assert_eq!(polar.division_mm, 0.1);
        let [before, after] = places(&polar, &polar.spots[0], false).map(|at| at.expect("finite"));
        assert!((before[1] - 4.0).abs() < 1e-9 && after[1] < 0.0);
        let [low, high] = bounds(&polar);
        let out = NOMINAL + before[1];
        assert!(high[0] > out && low[1] < -out);
    }

    #[test]
    fn rings_are_named_where_no_samples_are() {
        let mut polar = polar();
        polar.range = [-2.0, 2.0];
        let between = names_at(&polar).to_degrees();
        assert!((between - 165.0).abs() < 1e-9 || (between - 195.0).abs() < 1e-9);
        polar.range = [-3.1, 3.1];
        let between = names_at(&polar).to_degrees();
        assert!((between - 15.0).abs() < 1e-9);
    }
}
