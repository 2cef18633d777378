//! The robot in egui. The nominal one is a tube, the real one a line with a filled tool: form says
//! what colour says.

use egui::{Color32, Pos2, Rect, Shape, Stroke, Ui, Vec2, pos2, vec2};
use egui_plot::PlotTransform;

use crate::gui::plots::marks;
use crate::gui::style::tokens::{Palette, size};
use crate::numeric::single;
use crate::present::numbers::trimmed;

use super::super::free_space;
use super::model::{Drawn, Sign};

/// Width of the nominal robot's tube, and of its wall, points.
const TUBE: [f32; 2] = [9.0, 1.25];
/// Width of the real robot's line.
const LINE: f32 = 2.5;
/// Below this part of its length an axis is looked along.
const END_ON: f32 = 0.35;
/// How much of the robot is seen that nobody asked for.
pub(crate) const FAINT: f32 = 0.6;

fn screen(transform: &PlotTransform, p: [f64; 2]) -> Pos2 {
    transform.position_from_point(&egui_plot::PlotPoint::new(p[0], p[1]))
}

/// Both robots, beneath what was measured.
pub(crate) fn beneath(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    drawn: &Drawn,
    palette: &Palette,
) {
    let seen = |color: Color32| {
        if drawn.asked_for {
            color
        } else {
            palette.surface.lerp_to_gamma(color, FAINT)
        }
    };
    let edge = seen(palette.nominal);
    let at = |p: &[f64; 2]| screen(transform, *p);
    let nominal: Vec<Pos2> = drawn.nominal_mm.iter().map(at).collect();
    if let Some(base) = nominal.first() {
        let stroke = Stroke::new(1.25, edge);
        let below = if drawn.upright { 9.0 } else { 0.0 };
        let base = *base + vec2(0.0, below);
        shapes.extend(foot(base, drawn.upright, stroke, palette.surface));
    }
    // All walls first, so that links run into one another.
    for (width, color) in [(TUBE[0], edge), (TUBE[0] - 2.0 * TUBE[1], palette.surface)] {
        for pair in nominal.windows(2) {
            shapes.push(Shape::line_segment(
                [pair[0], pair[1]],
                Stroke::new(width, color),
            ));
        }
        for corner in &nominal {
            shapes.push(marks::disc(*corner, 0.5 * width, color));
        }
    }
    real_beneath(shapes, transform, drawn, palette);
    if let Some(tool) = nominal.last() {
        let stroke = Stroke::new(1.5, edge);
        let fill = palette.surface;
        shapes.push(marks::disc(*tool, 5.5, fill));
        shapes.push(marks::ring(*tool, 5.5, stroke));
    }
    for sign in &drawn.signs {
        let stroke = Stroke::new(1.5, seen(palette.text));
        joint(shapes, screen(transform, sign.at_mm), sign, stroke, palette);
    }
}

/// The real robot, where somebody asked for this pose.
pub(crate) fn real_beneath(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    drawn: &Drawn,
    palette: &Palette,
) {
    let Some(real) = drawn.real.as_ref().filter(|_| drawn.asked_for) else {
        return;
    };
    let color = if real.identified {
        palette.after
    } else {
        palette.before
    };
    let corners = real.corners_mm.iter().map(|p| screen(transform, *p));
    let corners: Vec<Pos2> = corners.collect();
    shapes.push(Shape::line(corners.clone(), Stroke::new(LINE, color)));
    if let Some(tool) = corners.last() {
        shapes.push(marks::disc(*tool, 5.0, palette.surface));
        shapes.push(marks::disc(*tool, 4.0, color));
    }
}

/// What the robot stands on: hatched ground, or a plate where one looks at it from above.
fn foot(at: Pos2, upright: bool, stroke: Stroke, fill: Color32) -> Vec<Shape> {
    let mut shapes = Vec::new();
    let mut line = |a: [f32; 2], b: [f32; 2]| {
        let ends = [at + vec2(a[0], a[1]), at + vec2(b[0], b[1])];
        shapes.push(Shape::line_segment(ends, stroke));
    };
    if upright {
        line([-18.0, 0.0], [18.0, 0.0]);
        for k in 0..6_u8 {
            let x = -15.0 + 6.0 * f32::from(k);
            line([x, 0.0], [x - 5.0, 6.0]);
        }
    } else {
        let plate = Rect::from_center_size(at, Vec2::splat(26.0));
        let corners = [
            plate.left_top(),
            plate.right_top(),
            plate.right_bottom(),
            plate.left_bottom(),
        ];
        shapes.push(Shape::convex_polygon(corners.to_vec(), fill, stroke));
        for corner in corners {
            let bolt = corner + 0.22 * (at - corner);
            shapes.push(marks::ring(bolt, 1.5, Stroke::new(1.0, stroke.color)));
        }
    }
    shapes
}

/// A joint: a drum on its axis from the side, its end from above; round where it turns, square
/// where it slides.
fn joint(shapes: &mut Vec<Shape>, at: Pos2, sign: &Sign, stroke: Stroke, palette: &Palette) {
    let along = vec2(single(sign.along[0]), -single(sign.along[1]));
    let length = along.length();
    let box_of = |x: Vec2, y: Vec2| vec![at + x + y, at - x + y, at - x - y, at + x - y];
    if length < END_ON {
        if sign.turns {
            shapes.push(marks::disc(at, 6.5, palette.surface));
            shapes.push(marks::ring(at, 6.5, stroke));
        } else {
            let corners = box_of(vec2(6.0, 0.0), vec2(0.0, 6.0));
            shapes.push(Shape::convex_polygon(corners, palette.surface, stroke));
        }
        shapes.push(marks::disc(at, 1.8, stroke.color));
        return;
    }
    let unit = along / length;
    let across = vec2(-unit.y, unit.x);
    let axis = [at - unit * 19.0 * length, at + unit * 19.0 * length];
    let thin = Stroke::new(1.0, stroke.color);
    shapes.extend(Shape::dashed_line(&axis, thin, 5.0, 2.5));
    let (half, wide) = if sign.turns { (9.0, 5.5) } else { (11.0, 6.0) };
    let corners = box_of(unit * half * length, across * wide);
    shapes.push(Shape::convex_polygon(corners, palette.surface, stroke));
    if sign.turns {
        // An end of the drum as it is seen: the shorter the drum, the rounder.
        shapes.push(marks::disc(at, 1.8, stroke.color));
    } else {
        for way in [-1.0, 1.0] {
            marks::arrow(
                shapes,
                at,
                at + unit * way * 9.0,
                Stroke::new(1.2, stroke.color),
            );
        }
    }
}

/// The joint values beside the tool, where they are least in the way; only said, not `written`,
/// where the card at the pointer has them.
pub(crate) fn values(
    ui: &mut Ui,
    transform: &PlotTransform,
    drawn: &Drawn,
    written: bool,
    crowd: &[Pos2],
    palette: &Palette,
) {
    const MOST: usize = 8;
    let says = drawn.says();
    let frame = *transform.frame();
    let tool = drawn.nominal_mm.last().map(|p| screen(transform, *p));
    let Some(tool) = tool.filter(|t| written && frame.contains(*t)) else {
        said(
            ui,
            Rect::from_min_size(frame.left_top(), Vec2::splat(1.0)),
            &says,
        );
        return;
    };
    let font = egui::FontId::proportional(size::SMALL);
    let row = |text: String, color| ui.painter().layout_no_wrap(text, font.clone(), color);
    let title = drawn
        .sample
        .map(|sample| say!("sample {sample}", sample = sample + 1));
    let head = title.map(|title| row(title, palette.muted));
    let mut rows: Vec<_> = drawn
        .values
        .iter()
        .take(MOST)
        .map(|(name, value)| row(format!("{name} {value}"), palette.text))
        .collect();
    if drawn.values.len() > MOST {
        rows.push(row(
            say!("and {more} more", more = drawn.values.len() - MOST),
            palette.muted,
        ));
    }
    if let Some(real) = &drawn.real {
        let what = if real.identified {
            say!("identified")
        } else {
            say!("measured")
        };
        rows.push(row(
            format!("{what} × {}", trimmed(real.times, 2)),
            palette.muted,
        ));
    }
    rows.splice(0..0, head);
    let high: f32 = rows.iter().map(|r| r.size().y).sum();
    let wide = rows.iter().map(|r| r.size().x).fold(0.0, f32::max);
    let card = vec2(wide + 12.0, high + 6.0);
    let places = free_space::everywhere(tool, card, 16.0, frame);
    let chain: Vec<Pos2> = drawn
        .nominal_mm
        .windows(2)
        .flat_map(|pair| {
            let ends = [screen(transform, pair[0]), screen(transform, pair[1])];
            (0..=8_u8).map(move |k| ends[0].lerp(ends[1], f32::from(k) / 8.0))
        })
        .collect();
    let Some(place) = free_space::freest(&places, frame, &[crowd, &chain, &chain, &chain]) else {
        said(ui, Rect::from_center_size(tool, Vec2::splat(1.0)), &says);
        return;
    };
    let painter = ui.painter().with_clip_rect(frame);
    painter.rect(
        place,
        4.0,
        palette.surface.gamma_multiply(0.9),
        Stroke::new(1.0, palette.line),
        egui::StrokeKind::Inside,
    );
    let mut at = place.min + vec2(6.0, 3.0);
    for galley in rows {
        let next = at.y + galley.size().y;
        painter.galley(at, galley, palette.text);
        at = pos2(at.x, next);
    }
    said(ui, place, &says);
}

/// A line for whoever cannot see the plot.
fn said(ui: &Ui, place: Rect, says: &str) {
    let id = ui.scope_id().with("robot");
    let response = ui.interact(place, id, egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, says));
}
