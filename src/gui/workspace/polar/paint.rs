//! The polar view in egui: the rings, what they stand for, and what the pointer does.

use egui::epaint::Mesh;
use egui::{Align2, FontId, Pos2, Rect, Role, Shape, Stroke, Ui, WidgetInfo, vec2};
use egui_plot::PlotTransform;

use crate::gui::cache::envelope::Envelope;
use crate::gui::plots::{Drawing, gestures, marks};
use crate::gui::style::tokens::{Palette, size};
use crate::gui::workbench::{Command, Workbench};
use crate::present::numbers::trimmed;
use crate::present::units::Units;

use super::super::layout::nearest;
use super::super::model::dial;
use super::super::pointer::{hover, marked};
use super::layout::{self, Bearing, NOMINAL, SPOKES};
use super::marks::{dots, extremes, lines, screen};
use super::model::{Polar, Spot, scale};

/// A sample is under the pointer within this many points.
const REACH: f32 = 14.0;
/// Of so many near it at most; more stand on one another.
const MOST_NEAR: usize = 400;
/// More samples than this are shown by their extremes.
const MOST_SPOTS: usize = 600;

/// Shows the view in the space that is left, and sends what the pointer does.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, polar: &Polar, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let view = workbench.view();
    let units = workbench.units();
    let subject = &**workbench.subject();
    let bearing = dial(subject, view.plane).map_or_else(
        || Bearing::of([1.0, 0.0], [0.0, 1.0]),
        |dial| Bearing::of(dial.radial, dial.tangential),
    );
    let only_after = workbench.only_after();
    let envelope = workbench.around();
    let of = |sample: usize| Spot::of(subject, workbench.answer(), view.component, sample);
    let name = view.component.name();
    let plot = gestures::plot(("polar", name, only_after, view.fitted.workspace))
        .data_aspect(1.0)
        .show_axes(false)
        .show_grid(false)
        .set_margin_fraction(egui::Vec2::splat(0.01));
    let emphasised = view.hovered.or(view.selected);
    let shown = gestures::show(ui, plot, |plot| {
        let bounds = layout::bounds(polar);
        plot.add(Drawing::new("polar", bounds, |transform, shapes| {
            ground(shapes, transform, polar, bearing, &palette);
            match envelope {
                Some(envelope) if envelope.count(polar.range) > MOST_SPOTS => {
                    shapes.push(extremes(
                        transform, polar, envelope, bearing, only_after, &palette,
                    ));
                }
                Some(envelope) => {
                    let all = envelope.samples(polar.range, MOST_SPOTS);
                    let spots: Vec<Spot> = all.map(of).collect();
                    dots(
                        shapes, transform, polar, &spots, bearing, only_after, &palette,
                    );
                }
                None => {
                    lines(shapes, transform, polar, bearing, &palette);
                    dots(
                        shapes,
                        transform,
                        polar,
                        &polar.spots,
                        bearing,
                        only_after,
                        &palette,
                    );
                }
            }
            let there = marked(view, subject.len()).chain(emphasised);
            for sample in there.filter(|sample| subject.usable[*sample]) {
                let places = layout::places(polar, &of(sample), bearing, only_after, transform);
                for at in places.into_iter().flatten() {
                    shapes.push(marks::ring(at, 8.0, Stroke::new(2.5, palette.accent)));
                }
            }
        }));
    });
    let (response, transform) = (shown.response, shown.transform);
    let samples = subject.overview.usable.len();
    response.widget_info(|| {
        let says = say!(
            "polar view, {component}, {samples} samples, {polar}",
            component = polar.component.name(),
            samples = samples,
            polar = scale(polar, units)
        );
        WidgetInfo::labeled(Role::Figure, true, says)
    });
    names(ui, &transform, polar, bearing, units, &palette);
    let under = response.hover_pos().and_then(|pointer| {
        let near: Vec<Spot> = match envelope {
            None => polar.spots.clone(),
            Some(envelope) => near(envelope, polar, bearing, &transform, pointer)
                .map(of)
                .collect(),
        };
        let candidates = near.iter().flat_map(|spot| {
            let places = layout::places(polar, spot, bearing, only_after, &transform);
            let places = places.into_iter().flatten();
            places.map(|at| (spot.sample, [at.x, at.y]))
        });
        nearest(candidates, [pointer.x, pointer.y], REACH)
    });
    hover(&response, workbench, under, commands);
}

/// Samples at the angles around the pointer, on every turn.
fn near(
    envelope: &Envelope,
    polar: &Polar,
    bearing: Bearing,
    transform: &PlotTransform,
    pointer: Pos2,
) -> impl Iterator<Item = usize> {
    let at = transform.value_from_position(pointer);
    let distance = at.x.hypot(at.y).max(1e-6);
    let half = (f64::from(REACH) / transform.dpos_dvalue_x().abs() / distance).min(0.5);
    let [low, high] = polar.range;
    let turn = std::f64::consts::TAU;
    let first = bearing.angle_of([at.x, at.y], low);
    let angles = (0..8_u8).map(move |k| first + turn * f64::from(k));
    let angles = angles.take_while(move |q| *q <= high + half);
    let near = move |q: f64| envelope.samples([q - half, q + half], MOST_NEAR);
    angles.flat_map(near).collect::<Vec<_>>().into_iter()
}

/// Rings, spokes, the tolerance and the nominal circle.
fn ground(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    polar: &Polar,
    bearing: Bearing,
    palette: &Palette,
) {
    let ring = |divisions: f64| -> Vec<Pos2> {
        let points = layout::circle(divisions.max(0.0));
        points.into_iter().map(|p| screen(transform, p)).collect()
    };
    if let Some(band) = polar.band_mm() {
        let [inner, outer] = band.map(|mm| ring(layout::radius(polar, mm)));
        let mut mesh = Mesh::default();
        let fill = palette.within.gamma_multiply(0.16);
        for (k, (a, b)) in (0_u32..).zip(inner.iter().zip(&outer)) {
            mesh.colored_vertex(*a, fill);
            mesh.colored_vertex(*b, fill);
            if k > 0 {
                mesh.add_triangle(2 * k - 2, 2 * k - 1, 2 * k);
                mesh.add_triangle(2 * k - 1, 2 * k, 2 * k + 1);
            }
        }
        shapes.push(Shape::mesh(mesh));
        let edge = Stroke::new(1.0, palette.within.gamma_multiply(0.7));
        for circle in [&inner, &outer] {
            shapes.extend(Shape::dashed_line(circle, edge, 4.0, 3.0));
        }
    }
    let thin = Stroke::new(1.0, palette.line);
    let [inside, outside] = polar.divisions;
    for (most, way) in [(inside, -1.0), (outside, 1.0)] {
        for k in 1..=crate::numeric::whole(most) {
            shapes.push(Shape::line(ring(NOMINAL + way * k as f64), thin));
        }
    }
    let ends = [NOMINAL - inside, NOMINAL + outside];
    for k in 0..SPOKES {
        let q = spoke(k);
        let ends = ends.map(|divisions| screen(transform, bearing.at(q, divisions)));
        shapes.push(Shape::line_segment(ends, thin));
    }
    shapes.push(Shape::line(
        ring(NOMINAL),
        Stroke::new(1.75, palette.nominal),
    ));
}

fn spoke(k: u8) -> f64 {
    std::f64::consts::TAU * f64::from(k) / f64::from(SPOKES)
}

/// Angles around, and what the rings stand for. What would lie on its neighbour is left out, and
/// nothing is cut by the frame.
fn names(
    ui: &Ui,
    transform: &PlotTransform,
    polar: &Polar,
    bearing: Bearing,
    units: Units,
    palette: &Palette,
) {
    let frame = *transform.frame();
    let painter = ui.painter().with_clip_rect(frame);
    let font = FontId::proportional(size::SMALL);
    let galley = |text: String| painter.layout_no_wrap(text, font.clone(), palette.muted);
    let around = |at: Pos2, size: egui::Vec2| {
        let place = Align2::CENTER_CENTER.anchor_size(at, size);
        inside(place, frame)
    };
    let out = NOMINAL + polar.divisions[1] + 0.9;
    let mut taken: Vec<Rect> = Vec::new();
    // The quarters first: they stay where there is room for few.
    let mut spokes: Vec<u8> = (0..SPOKES).collect();
    spokes.sort_by_key(|k| (k % 3 != 0, k % 2 != 0, *k));
    for k in spokes {
        // Angles as joints have them: from −180° to 180°.
        let q = spoke(k);
        let named = if q > std::f64::consts::PI + 1e-9 {
            q - std::f64::consts::TAU
        } else {
            q
        };
        let galley = galley(units.angle(named));
        let place = around(screen(transform, bearing.at(q, out)), galley.size());
        if taken.iter().all(|other| !other.intersects(place)) {
            taken.push(place.expand2(vec2(4.0, 1.0)));
            painter.galley(place.min, galley, palette.muted);
        }
    }
    let q = layout::names_at(polar);
    let [inner, outer] = polar.divisions;
    for divisions in [outer, -inner] {
        let at = screen(transform, bearing.at(q, NOMINAL + divisions));
        let value = units.length_value(divisions * polar.division_mm);
        let galley = galley(format!("{} {}", trimmed(value, 6), units.length_name()));
        let place = around(at, galley.size());
        let back = place.expand2(vec2(3.0, 1.0));
        if taken.iter().all(|other| !other.intersects(back)) {
            taken.push(back);
            painter.rect_filled(back, 2.0, palette.surface);
            painter.galley(place.min, galley, palette.muted);
        }
    }
}

/// The same rectangle, moved so that it is within the frame.
fn inside(place: Rect, frame: Rect) -> Rect {
    let within = |low: f32, high: f32, from: f32, to: f32| (from - low).max((to - high).min(0.0));
    let x = within(place.left(), place.right(), frame.left(), frame.right());
    let y = within(place.top(), place.bottom(), frame.top(), frame.bottom());
    // Where one looks at a part, the names of what is elsewhere stay there.
    if x.abs() > place.width() || y.abs() > place.height() {
        return place;
    }
    place.translate(vec2(x, y))
}
