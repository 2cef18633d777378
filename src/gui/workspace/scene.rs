//! What is seen of samples in a plane and in space: the heat map, the nominal path, error vectors,
//! measured points and what stands out; in space also what gives it its bearings, a grid on the plane z = 0 of
//! the base, and frames.

use std::sync::Arc;

use egui::epaint::Mesh;
use egui::text::{LayoutJob, TextWrapping};
use egui::{Align2, Color32, Rect, Shape, Stroke, TextureOptions, pos2, vec2};
use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};

use crate::gui::core::overview::round_down;
use crate::gui::layers::gpu::CloudLayer;
use crate::gui::layers::{Frame, WIDTH, heat_map, map_in_plot};
use crate::gui::style::{size, strong};
use crate::gui::view::Ball;
use crate::gui::workbench::Workbench;
use crate::gui::workspace::fitting::{self, HANDLE, SECTOR};
use crate::gui::workspace::model::{Dial, Shown, shown};
use crate::gui::workspace::pen::{Camera, Pen};
use crate::gui::workspace::pointer::marked;
use crate::gui::workspace::robot::{Drawn, body};
use crate::numeric::whole;
use crate::present::chart::Form;
use crate::present::numbers::trimmed;
use crate::sessions::Region;

/// Names of regions stand so far from the axis, in parts of the farthest reflector's distance.
const NAMES: f64 = 0.42;
/// Squares of the grid from its middle to its edge, at least.
const SQUARES: f64 = 4.0;
/// Length of a frame's axis, points.
const AXIS: f64 = 34.0;

/// The workspace in a plane.
pub(super) fn plane(
    pen: Pen<'_>,
    workbench: &Workbench,
    shown: &Shown,
    robot: Option<&Drawn>,
    editing: bool,
    camera: &Camera,
) {
    let regions = &workbench.document().regions;
    if let Some(dial) = &shown.dial {
        sectors(pen, dial, regions, editing, camera);
    }
    heat(pen, workbench, shown, camera);
    path(pen, shown, camera);
    if let Some(robot) = robot {
        body(pen, robot, camera);
    }
    samples(pen, workbench, shown, camera);
    emphasised(pen, workbench, shown, camera);
    if let Some(dial) = &shown.dial {
        names_of_regions(pen, dial, regions, camera);
    }
}

fn sectors(pen: Pen<'_>, dial: &Dial, regions: &[Region], editing: bool, camera: &Camera) {
    let mut order: Vec<usize> = (0..regions.len()).collect();
    order.sort_by(|a, b| regions[*a].from_rad.total_cmp(&regions[*b].from_rad));
    // All of them together, without soft edges: neighbouring pieces leave no seams.
    let mut mesh = Mesh::default();
    for (place, region) in order.into_iter().map(|k| &regions[k]).enumerate() {
        let color = pen.palette.sectors[place % 2];
        let centre = u32::try_from(mesh.vertices.len()).unwrap_or(u32::MAX);
        mesh.colored_vertex(camera.at_flat(dial.centre_mm), color);
        for (point, k) in fitting::edge(dial, region.from_rad, region.to_rad).zip(1..) {
            mesh.colored_vertex(camera.at_flat(point), color);
            if k > 1 {
                mesh.add_triangle(centre, centre + k - 1, centre + k);
            }
        }
    }
    pen.painter.add(Shape::mesh(mesh));
    let (end, stroke) = if editing {
        (HANDLE, Stroke::new(1.5, pen.palette.accent))
    } else {
        (SECTOR, Stroke::new(1.0, pen.palette.line))
    };
    for angle in regions.iter().flat_map(|r| [r.from_rad, r.to_rad]) {
        let at = |part: f64| camera.at_flat(dial.at(angle, part * dial.radius_mm));
        pen.line([0.0, end].map(at), stroke);
    }
}

/// The heat map, if it is shown.
fn heat(pen: Pen<'_>, workbench: &Workbench, shown: &Shown, camera: &Camera) {
    let Some(heat) = workbench.heat() else {
        return;
    };
    let (look, palette, ctx) = (&shown.look, pen.palette, pen.painter.ctx());
    let of = (Arc::clone(heat), look.blend, look.long_mm, palette.surface);
    let picture = workbench.derived.heat_picture.get(of, || {
        let image = heat_map(heat, look, palette);
        ctx.load_texture("heat map", image, TextureOptions::LINEAR)
    });
    pen.painter
        .add(map_in_plot(heat, picture.id(), &camera.transform));
}

/// The way of each reflector on the nominal robot, with how sure the model is of it.
fn path(pen: Pen<'_>, shown: &Shown, camera: &Camera) {
    let palette = pen.palette;
    for path in &shown.paths_mm {
        let points = path.iter().map(|p| camera.at(*p));
        pen.line(points, Stroke::new(1.25, palette.nominal));
    }
    if let Some(dial) = &shown.dial {
        let centre = camera.at_flat(dial.centre_mm);
        let stroke = Stroke::new(1.5, palette.nominal);
        for half in [vec2(6.0, 0.0), vec2(0.0, 6.0)] {
            pen.line([centre - half, centre + half], stroke);
        }
        pen.mark(centre, (Form::Disc, 3.5), Color32::TRANSPARENT, stroke);
    }
}

/// Measured points and error vectors.
fn samples(pen: Pen<'_>, workbench: &Workbench, shown: &Shown, camera: &Camera) {
    let pixels = pen.painter.pixels_per_point();
    let layer = CloudLayer {
        cloud: Arc::clone(workbench.loaded_session().cloud()),
        remainder: workbench.answer().map(|a| Arc::clone(&a.remainder)),
        frame: Frame::new(&shown.look, pen.palette, &camera.transform, pixels),
        counts: fitting::counts(shown, &camera.transform),
        only: shown.vectors.clone(),
        ghosts: shown.look.ghosts(),
    };
    pen.painter.add(layer.shape(camera.frame()));
}

/// The samples that a finding is about, and the one under the pointer or else the chosen one.
fn emphasised(pen: Pen<'_>, workbench: &Workbench, all: &Shown, camera: &Camera) {
    let (view, loaded_session) = (&workbench.view, workbench.loaded_session());
    let palette = pen.palette;
    let measured =
        |sample: usize| loaded_session.usable[sample].then(|| loaded_session.measured(sample));
    let ring = |at: [f64; 3]| {
        let edge = Stroke::new(2.5, palette.accent);
        pen.mark(camera.at(at), (Form::Disc, 9.0), Color32::TRANSPARENT, edge);
    };
    for at in marked(view, loaded_session.len()).filter_map(measured) {
        ring(at);
    }
    let sample = view.hovered.or(view.selected);
    if let Some((sample, at)) = sample.and_then(|sample| Some((sample, measured(sample)?))) {
        // Its vector over all others, whatever their colour.
        let e = shown(workbench, sample);
        let from = [0, 1, 2].map(|k| at[k] - e[k]);
        let to = [0, 1, 2].map(|k| from[k] + all.look.magnification * e[k]);
        let ends = [from, to].map(|p| camera.at(p));
        pen.arrow(ends, Stroke::new(2.0 * WIDTH + 2.0, palette.surface));
        pen.arrow(ends, Stroke::new(2.0 * WIDTH, palette.accent));
        ring(at);
    }
}

fn names_of_regions(pen: Pen<'_>, dial: &Dial, regions: &[Region], camera: &Camera) {
    let at = |q: f64| camera.at_flat(dial.at(q, NAMES * dial.radius_mm));
    for region in regions {
        let middle = at(0.5 * (region.from_rad + region.to_rad));
        // As wide as the sector is there.
        let room = if region.to_rad - region.from_rad < std::f64::consts::PI {
            at(region.from_rad).distance(at(region.to_rad))
        } else {
            2.0 * middle.distance(camera.at_flat(dial.centre_mm))
        };
        let (name, font) = (region.name.clone(), strong(size::BODY));
        let mut job = LayoutJob::simple_singleline(name, font, pen.palette.muted);
        job.wrap = TextWrapping::truncate_at_width(room.max(24.0));
        let galley = pen.painter.layout_job(job);
        let place = Align2::CENTER_CENTER.anchor_size(middle, galley.size());
        pen.painter.galley(place.min, galley, pen.palette.muted);
    }
}

/// The camera of a picture of space here, which shows this ball of the base frame.
pub(super) fn in_sight(workbench: &Workbench, ball: &Ball, rect: Rect) -> Camera {
    let size = [rect.width(), rect.height()].map(f64::from);
    let mut bounds = workbench.view.camera.bounds(ball, size);
    // What is drawn has the coordinates of the measuring frame.
    let facing = workbench.facing();
    let shift = facing.flat(workbench.base().translation.vector.into());
    for end in &mut bounds {
        *end = [0, 1].map(|k| end[k] + shift[k]);
    }
    Camera::showing(facing, bounds, rect)
}

/// Grid, robot, samples and frames.
pub(super) fn in_space(
    pen: Pen<'_>,
    workbench: &Workbench,
    shown: &Shown,
    robot: Option<&Drawn>,
    (ball, camera): (&Ball, &Camera),
) {
    grid(pen, workbench, ball, camera);
    path(pen, shown, camera);
    if let Some(robot) = robot {
        body(pen, robot, camera);
    }
    samples(pen, workbench, shown, camera);
    emphasised(pen, workbench, shown, camera);
    frames(pen, workbench, robot, camera);
    side_of_squares(pen, workbench, ball, camera);
}

/// Side of a square of the grid, mm: round in the unit of which `per_mm` are a millimetre, and so that there are a few
/// of them.
fn square_mm(ball: &Ball, per_mm: f64) -> f64 {
    round_down(per_mm * ball.radius_mm / SQUARES) / per_mm
}

/// The grid under everything, in whole squares of the base frame: pairs of ends, mm.
fn lines(ball: &Ball, per_mm: f64) -> Vec<[[f64; 3]; 2]> {
    let square = square_mm(ball, per_mm);
    let ends = [0, 1].map(|k| {
        let reach = |sign: f64| (ball.centre_mm[k] + sign * ball.radius_mm) / square;
        [reach(-1.0).floor() * square, reach(1.0).ceil() * square]
    });
    let mut lines = Vec::new();
    for along in 0..2 {
        let [first, last] = ends[1 - along];
        for n in 0..=whole((last - first) / square + 0.5) {
            let mut both = [[0.0; 3]; 2];
            for (p, end) in both.iter_mut().zip(ends[along]) {
                (p[along], p[1 - along]) = (end, first + n as f64 * square);
            }
            lines.push(both);
        }
    }
    lines
}

fn grid(pen: Pen<'_>, workbench: &Workbench, ball: &Ball, camera: &Camera) {
    let base = workbench.base();
    let per_mm = workbench.units().length_value(1.0);
    let axis = pen.palette.line.lerp_to_gamma(pen.palette.nominal, 0.4);
    for ends in lines(ball, per_mm) {
        let through_origin = ends.iter().all(|p| p[0] == 0.0) || ends.iter().all(|p| p[1] == 0.0);
        let color = if through_origin {
            axis
        } else {
            pen.palette.line
        };
        let ends = ends.map(|p| camera.at((base * Point3::from(p)).into()));
        pen.line(ends, Stroke::new(1.0, color));
    }
}

/// How long the side of a square is, in the corner.
fn side_of_squares(pen: Pen<'_>, workbench: &Workbench, ball: &Ball, camera: &Camera) {
    let units = workbench.units();
    let per_mm = units.length_value(1.0);
    let square = trimmed(units.length_value(square_mm(ball, per_mm)), 3);
    let says = say!("grid {square} {unit}", square, unit = units.length_name());
    let corner = camera.frame().left_bottom() + vec2(4.0, -4.0);
    pen.label(corner, Align2::LEFT_BOTTOM, says, pen.palette.muted);
}

/// The frames of base, tool and instrument.
fn frames(pen: Pen<'_>, workbench: &Workbench, robot: Option<&Drawn>, camera: &Camera) {
    let base = workbench.base();
    frame(pen, say!("base"), base, camera);
    let session = &workbench.loaded_session().session;
    if let Some(robot) = robot.filter(|r| r.asked_for) {
        let tool = base * session.robot.base_from_tool(&robot.q);
        frame(pen, say!("tool"), tool, camera);
    }
    let instrument = &session.instrument;
    let own_frame = workbench.found_base().or(workbench.loaded_session().base);
    let stands = instrument.tracker.map(|tracker| tracker.position_mm.coords);
    if let Some(at) = stands.or(own_frame.map(|_| Vector3::zeros())) {
        // A tracker that stands aside is seen from farther away.
        let at = Isometry3::from_parts(at.into(), UnitQuaternion::identity());
        frame(pen, &instrument.name, at, camera);
    }
}

/// A frame with its axes' letters and its name; an axis that is looked along has none.
fn frame(pen: Pen<'_>, name: &str, frame: Isometry3<f64>, camera: &Camera) {
    let origin = frame.translation.vector;
    let from = camera.at(origin.into());
    let mut below = from.y;
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    for (axis, letter) in axes.into_iter().zip(["x", "y", "z"]) {
        let along = frame.rotation * axis;
        if camera.direction(along.into()).length() < 0.2 {
            continue;
        }
        let end = |points: f64| {
            let end = origin + along * (points / camera.points_per_mm());
            camera.at(end.into())
        };
        pen.arrow([from, end(AXIS)], Stroke::new(1.5, pen.palette.text));
        let beyond = end(AXIS + 8.0);
        below = below.max(beyond.y + 6.0);
        pen.label(beyond, Align2::CENTER_CENTER, letter, pen.palette.text);
    }
    let below = pos2(from.x, below + 2.0);
    pen.label(below, Align2::CENTER_TOP, name, pen.palette.muted);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_lies_on_the_base_in_round_squares_and_holds_everything() {
        let ball = Ball {
            centre_mm: [130.0, -70.0, 400.0],
            radius_mm: 910.0,
        };
        assert_eq!(square_mm(&ball, 1.0), 200.0);
        let lines = lines(&ball, 1.0);
        assert!(lines.iter().flatten().all(|p| p[2] == 0.0));
        for k in 0..2 {
            let of = |pick: fn(f64, f64) -> f64, start| {
                lines.iter().flatten().map(|p| p[k]).fold(start, pick)
            };
            let (low, high) = (of(f64::min, 1e9), of(f64::max, -1e9));
            assert!(low <= ball.centre_mm[k] - 910.0 && ball.centre_mm[k] + 910.0 <= high);
            assert_eq!((low % 200.0, high % 200.0), (0.0, 0.0));
        }
        // One of them goes through the origin in each direction.
        let through = |[a, b]: &&[[f64; 3]; 2]| a[0] == 0.0 && b[0] == 0.0;
        assert_eq!(lines.iter().filter(through).count(), 1);
        assert!(lines.len() < 40);
    }
}
