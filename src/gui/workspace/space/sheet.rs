//! The view in space as a drawing for a file: as it is seen, on paper.
//!
//! The robot is drawn from its meshes where the view draws it so: flat triangles, the farthest first. No
//! triangle is cut by another, so where two parts reach through each other the order is that of their
//! triangles' middles.

use egui::{Pos2, Rect, pos2, vec2};

use crate::gui::layers::scale_at;
use crate::gui::style::tokens::LIGHT;
use crate::gui::view::{Canvas, Colouring};
use crate::gui::workbench::Workbench;
use crate::present::drawing::{
    AFTER, Anchor, BEFORE, Colour, Drawing, INK, Item, Label, MUTED, RULE, Shape, Stroke,
};
use crate::present::numbers::trimmed;

use super::super::model::Scene;
use super::super::robot::Drawn;
use super::super::scales::scales;
use super::ground::{lines, square_mm};
use super::paint::{Space, surface_of};
use super::surface::Face;

/// Width and height of the picture, and of what is written below it, points.
const SIZE: [f64; 2] = [480.0, 360.0];
const FOOT: f64 = 30.0;
/// Length of an axis of the base frame, points.
const AXIS: f64 = 28.0;

fn on_sheet(at: Pos2) -> [f64; 2] {
    [at.x, at.y].map(f64::from)
}

/// The part of a line that is on the sheet (Liang & Barsky 1984).
fn clipped([from, to]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for k in 0..2 {
        let along = to[k] - from[k];
        for (way, room) in [(-along, from[k]), (along, SIZE[k] - from[k])] {
            if way == 0.0 && room < 0.0 || !room.is_finite() {
                return None;
            }
            if way < 0.0 {
                first = first.max(room / way);
            } else if way > 0.0 {
                last = last.min(room / way);
            }
        }
    }
    let at = |t: f64| [0, 1].map(|k| from[k] + t * (to[k] - from[k]));
    (first < last).then(|| [at(first), at(last)])
}

/// The part of a polygon that is on the sheet (Sutherland & Hodgman 1974).
fn on_the_sheet(mut corners: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    for (k, sign, most) in [
        (0, -1.0, 0.0),
        (0, 1.0, SIZE[0]),
        (1, -1.0, 0.0),
        (1, 1.0, SIZE[1]),
    ] {
        let beyond = |p: &[f64; 2]| sign * p[k] - most;
        let before = corners.clone();
        corners.clear();
        for (from, to) in before.iter().zip(before.iter().cycle().skip(1)) {
            let [a, b] = [from, to].map(beyond);
            if a <= 0.0 {
                corners.push(*from);
            }
            if (a <= 0.0) != (b <= 0.0) {
                let part = a / (a - b);
                corners.push([0, 1].map(|k| from[k] + part * (to[k] - from[k])));
            }
        }
    }
    corners
}

/// A triangle of the robot, in the greys of the view, in 32 steps: neighbours share one.
fn area(face: &Face) -> Option<(Vec<[f64; 2]>, Colour)> {
    let corners = on_the_sheet(face.corners.map(on_sheet).to_vec());
    let [r, g, b, _] = face.color.to_array().map(|part| part | 7);
    (corners.len() > 2).then_some((corners, Colour(r, g, b)))
}

/// Shaft and head of an arrow.
fn arrow(from: [f64; 2], to: [f64; 2]) -> Vec<[[f64; 2]; 2]> {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = dx.hypot(dy);
    if length.is_nan() || length < 0.4 {
        return Vec::new();
    }
    let head = (0.35 * length).min(4.0) / length;
    let side = |sign: f64| {
        [
            to[0] - head * (dx + sign * 0.5 * dy),
            to[1] - head * (dy - sign * 0.5 * dx),
        ]
    };
    vec![[from, to], [to, side(1.0)], [to, side(-1.0)]]
}

/// Adds lines, cut where the sheet ends.
fn add(drawing: &mut Drawing, lines: impl IntoIterator<Item = [[f64; 2]; 2]>, stroke: Stroke) {
    let inside = lines.into_iter().filter_map(clipped);
    let lines: Vec<Vec<[f64; 2]>> = inside.map(|ends| ends.to_vec()).collect();
    if !lines.is_empty() {
        drawing.items.push(Item::Lines(lines, stroke));
    }
}

/// The view on a sheet, and what it shows.
///
/// # Errors
/// There is nothing to draw.
pub(crate) fn sheet(workbench: &Workbench) -> Result<(Drawing, String), String> {
    if workbench.subject().is_empty() {
        return Err(say!("there are no samples to draw").to_owned());
    }
    let scene = Scene::on(workbench, Canvas::Shapes);
    let space = Space::new(
        workbench,
        Rect::from_min_size(pos2(0.0, 0.0), vec2(480.0, 360.0)),
    );
    let mut drawing = Drawing::new(SIZE[0], SIZE[1] + FOOT);
    let grid = lines(&space.ball);
    let grid = grid
        .into_iter()
        .map(|ends| ends.map(|p| on_sheet(space.screen(p))));
    add(&mut drawing, grid, Stroke::new(0.4, RULE));
    if let Some(robot) = Drawn::of(workbench) {
        let pairs = |corners: &[[f64; 2]]| -> Vec<[[f64; 2]; 2]> {
            let at: Vec<[f64; 2]> = corners.iter().map(|p| on_sheet(space.seen(*p))).collect();
            at.windows(2).map(|pair| [pair[0], pair[1]]).collect()
        };
        if let Some(faces) = surface_of(workbench, &robot, &space, &LIGHT) {
            let inside = faces.iter().filter_map(area).collect();
            drawing.items.push(Item::Areas(inside));
        } else {
            let links = pairs(&robot.nominal_mm);
            add(&mut drawing, links, Stroke::new(2.2, MUTED));
            let joints = robot.signs.iter();
            let joints = joints.map(|sign| on_sheet(space.seen(sign.at_mm)));
            mark(&mut drawing, Shape::Square, joints.collect(), 2.4, MUTED);
        }
        if let Some(real) = robot.real.as_ref().filter(|_| robot.asked_for) {
            let colour = if real.identified { AFTER } else { BEFORE };
            add(
                &mut drawing,
                pairs(&real.corners_mm),
                Stroke::new(1.0, colour),
            );
        }
    }
    vectors(&mut drawing, workbench, &scene, &space);
    axes(&mut drawing, &space);
    let says = words(&mut drawing, workbench, &scene, &space);
    Ok((drawing, says))
}

/// Measured points and error vectors, the farthest first.
fn vectors(drawing: &mut Drawing, workbench: &Workbench, scene: &Scene, space: &Space) {
    let m = scene.magnification;
    let tip = |from: [f64; 2], v: [f64; 2]| [from[0] + m * v[0], from[1] + m * v[1]];
    let flat = if scene.look.answered { AFTER } else { BEFORE };
    let at = |point: &super::super::model::Point| on_sheet(space.seen(point.at_mm));
    let colour_of = |colouring, part| {
        let [r, g, b, _] = scale_at(colouring, &LIGHT, part).to_array();
        Colour(r, g, b)
    };
    if scene.look.colouring == Colouring::State {
        let all = scene.points.iter().map(at).collect();
        mark(drawing, Shape::Diamond, all, 1.3, INK);
    } else {
        for point in &scene.points {
            let colour = point.says.map(|part| colour_of(scene.look.colouring, part));
            let at = vec![at(point)];
            mark(drawing, Shape::Diamond, at, 1.9, colour.unwrap_or(MUTED));
        }
    }
    for one in &scene.arrows {
        let colour = match (scene.look.colouring, one.says) {
            (Colouring::State, _) => flat,
            (colouring, Some(part)) => colour_of(colouring, part),
            (_, None) => MUTED,
        };
        let ends = [one.from_mm, tip(one.from_mm, one.vector_mm)];
        let [from, to] = ends.map(|p| on_sheet(space.seen(p)));
        add(drawing, arrow(from, to), Stroke::new(0.8, colour));
    }
    if let Some(sample) = workbench
        .view()
        .selected
        .filter(|s| workbench.subject().usable[*s])
    {
        let at = space.facing.flat(workbench.subject().measured(sample));
        let at = vec![on_sheet(space.seen(at))];
        let marks = Item::Marks {
            shape: Shape::Diamond,
            at,
            half: 5.0,
            colour: INK,
            filled: false,
        };
        drawing.items.push(marks);
    }
}

fn mark(drawing: &mut Drawing, shape: Shape, at: Vec<[f64; 2]>, half: f64, colour: Colour) {
    let inside = |p: &[f64; 2]| (0..2).all(|k| (0.0..=SIZE[k]).contains(&p[k]));
    let at: Vec<[f64; 2]> = at.into_iter().filter(inside).collect();
    if !at.is_empty() {
        drawing.items.push(Item::Marks {
            shape,
            at,
            half,
            colour,
            filled: true,
        });
    }
}

/// The frame of the base.
fn axes(drawing: &mut Drawing, space: &Space) {
    let from = on_sheet(space.screen([0.0; 3]));
    for (k, letter) in ["x", "y", "z"].into_iter().enumerate() {
        let end = |points: f64| {
            let mut p = [0.0; 3];
            p[k] = points / space.points_per_mm;
            on_sheet(space.screen(p))
        };
        add(drawing, arrow(from, end(AXIS)), Stroke::new(1.0, INK));
        let [x, y] = end(AXIS + 7.0);
        if clipped([from, [x, y]]) == Some([from, [x, y]]) {
            let label = Label::new([x, y + 2.5], letter, 7.0, INK);
            drawing.text(label.anchored(Anchor::Middle));
        }
    }
}

/// What it shows, in words below it; the first line is the title.
fn words(drawing: &mut Drawing, workbench: &Workbench, scene: &Scene, space: &Space) -> String {
    let session = crate::report::document::clean(&workbench.subject().session.name);
    let magnified = trimmed(scene.magnification, 3);
    let title = say!(
        "{session}: {samples} samples, {camera}, deviations {state} magnified {magnified} times",
        session = session,
        samples = scene.samples,
        camera = workbench.view().camera.says(),
        state = if scene.look.answered {
            say!("after")
        } else {
            say!("before")
        },
        magnified = magnified
    );
    let mut more = say!(
        "grid {square} mm",
        square = trimmed(square_mm(&space.ball), 3)
    );
    if scene.look.colouring != Colouring::State {
        let scale = scales(workbench, scene).into_iter().next();
        let says = scale.map_or_else(String::new, |scale| match scale.ends {
            Some([low, high]) => format!("{} {low} … {high}", scale.name),
            None => scale.name,
        });
        more += &say!("; colour: {colouring}", colouring = says);
    }
    for note in scene.notes() {
        more += &format!("; {note}");
    }
    for (k, line) in [title.clone(), more].into_iter().enumerate() {
        let at = [0.0, SIZE[1] + 12.0 + 11.0 * k as f64];
        drawing.text(Label::new(at, line, 7.0, MUTED));
    }
    title
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::{session_of_a_urdf, workbench};
    use crate::gui::view::Camera;
    use crate::gui::workbench::Command;

    #[test]
    fn a_line_is_cut_where_the_sheet_ends() {
        let [w, h] = SIZE;
        let across = clipped([[-50.0, 0.5 * h], [w + 50.0, 0.5 * h]]);
        assert_eq!(across, Some([[0.0, 0.5 * h], [w, 0.5 * h]]));
        let inside = [[1.0, 2.0], [30.0, 40.0]];
        assert_eq!(clipped(inside), Some(inside));
        assert_eq!(clipped([[-5.0, -5.0], [-5.0, 900.0]]), None);
        assert_eq!(clipped([[f64::NAN, 1.0], [2.0, 2.0]]), None);
    }

    #[test]
    fn an_area_is_cut_where_the_sheet_ends() {
        let inside = vec![[1.0, 2.0], [30.0, 40.0], [9.0, 60.0]];
        assert_eq!(on_the_sheet(inside.clone()), inside);
        let [w, h] = SIZE;
        let all = vec![[-w, -h], [3.0 * w, -h], [-w, 3.0 * h]];
        let cut = on_the_sheet(all);
        let twice_the_size: f64 = cut
            .iter()
            .zip(cut.iter().cycle().skip(1))
            .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
            .sum();
        assert!((twice_the_size - 2.0 * w * h).abs() < 1e-6, "{cut:?}");
        assert!(on_the_sheet(vec![[-1.0, 0.0], [-9.0, 5.0], [-1.0, 9.0]]).is_empty());
    }

    /// An arm of one joint whose link is a ball of so many triangles about the tool, and its samples.
    fn arm_with_a_ball(rings: u16) -> (tempfile::TempDir, Workbench) {
        let folder = tempfile::tempdir().expect("a folder");
        let mut mesh = String::new();
        let around = 2 * rings;
        for i in 0..=rings {
            for j in 0..around {
                let (sin, cos) = (f64::from(i) / f64::from(rings) * std::f64::consts::PI).sin_cos();
                let (y, x) = (f64::from(j) / f64::from(rings) * std::f64::consts::PI).sin_cos();
                mesh += &format!(
                    "v {} {} {}\n",
                    0.25 + 0.1 * sin * x,
                    0.1 * sin * y,
                    0.1 * cos
                );
            }
        }
        for i in 0..rings {
            for j in 0..around {
                let at =
                    |i: u16, j: u16| 1 + u32::from(i) * u32::from(around) + u32::from(j % around);
                let [a, b] = [at(i, j), at(i, j + 1)];
                let [c, d] = [at(i + 1, j + 1), at(i + 1, j)];
                mesh += &format!("f {a} {b} {c} {d}\n");
            }
        }
        let path = session_of_a_urdf(folder.path(), &mesh);
        let mut workbench = workbench();
        workbench.execute(Command::OpenFile(path));
        workbench.receive();
        workbench.execute(Command::LookFrom(None));
        (folder, workbench)
    }

    #[test]
    fn the_sheet_shows_the_meshes_that_the_view_shows_in_a_file_of_bounded_size() {
        let (_folder, workbench) = arm_with_a_ball(160);
        let (drawing, says) = sheet(&workbench).expect("there are samples");
        let areas = drawing.items.iter().filter_map(|item| match item {
            Item::Areas(areas) => Some(areas),
            _ => None,
        });
        let areas: Vec<_> = areas.collect();
        assert_eq!(areas.len(), 1);
        assert!(
            (1_000..=24_000).contains(&areas[0].len()),
            "{}",
            areas[0].len()
        );
        for p in areas[0].iter().flat_map(|(corners, _)| corners) {
            assert!((0..2).all(|k| (0.0..=SIZE[k]).contains(&p[k])), "{p:?}");
        }
        // In place of the links and joints, which are muted squares.
        let squares = |item: &Item| {
            matches!(
                item,
                Item::Marks {
                    shape: Shape::Square,
                    ..
                }
            )
        };
        assert!(!drawing.items.iter().any(squares));
        let svg = crate::report::svg::svg_file(&drawing, &says);
        assert!(svg.len() < 2_000_000, "{}", svg.len());
    }

    #[test]
    fn the_sheet_holds_what_is_seen_and_nothing_outside_it() {
        let mut workbench = workbench();
        workbench.execute(Command::LookFrom(None));
        let count = |workbench: &Workbench| {
            let (drawing, says) = sheet(workbench).expect("there are samples");
            let mut marks = 0;
            for item in &drawing.items {
                let points: Vec<[f64; 2]> = match item {
                    Item::Lines(lines, _) => lines.concat(),
                    Item::Marks { at, half, .. } if *half < 2.0 => {
                        marks += at.len();
                        at.clone()
                    }
                    _ => Vec::new(),
                };
                for p in points {
                    assert!((-1e-9..=SIZE[0] + 1e-9).contains(&p[0]), "{p:?}");
                    assert!((-1e-9..=SIZE[1] + 1e-9).contains(&p[1]), "{p:?}");
                }
            }
            (marks, says)
        };
        let (marks, says) = count(&workbench);
        assert_eq!(marks, workbench.subject().len());
        assert!(says.contains("isometric view"), "{says}");
        // Closer, less of it is on the sheet.
        let closer = Camera::default().zoomed(6.0, [0.0; 2]).orbited([30.0, 9.0]);
        workbench.execute(Command::Turn(closer));
        let (fewer, says) = count(&workbench);
        assert!(fewer < marks, "{fewer}");
        assert!(says.contains("seen from azimuth"), "{says}");
    }
}
