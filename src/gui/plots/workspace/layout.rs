//! Where the parts of the workspace plot go: bounds, sectors, the scale, what is under the
//! pointer, what the hover says.

use egui::Pos2;
use egui_plot::{PlotPoint, PlotTransform};

use crate::gui::backdrop::FEW;
use crate::gui::commands::Workbench;
use crate::gui::plots::round_down;
use crate::gui::subject::Component;
use crate::gui::units::trimmed;
use crate::gui::view::Canvas;

use super::model::{Dial, Scene};

/// Sectors reach from the path's inside to its outside, in parts of the radius.
pub(crate) const SECTOR: (f64, f64) = (0.0, 1.10);
/// Boundaries' handles and region names stand outside it.
pub(crate) const HANDLE: f64 = 1.17;
/// Room for the handles.
const ROOM: f64 = 1.22;
/// Chords of a sector are no longer than this, rad.
const CHORD_RAD: f64 = 0.05;

/// Smallest and largest corner of everything, mm, with room for handles.
pub(crate) fn bounds(scene: &Scene) -> [[f64; 2]; 2] {
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    let mut take = |p: [f64; 2]| {
        for k in 0..2 {
            if p[k].is_finite() {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
    };
    scene.measured_mm.into_iter().for_each(&mut take);
    scene.robot_mm.into_iter().for_each(&mut take);
    for p in scene.paths_mm.iter().flatten() {
        take(*p);
    }
    if let Some(dial) = &scene.dial {
        take(dial.centre_mm);
        for p in scene.paths_mm.iter().flatten() {
            let arm = [p[0] - dial.centre_mm[0], p[1] - dial.centre_mm[1]];
            let out = ROOM * dial.radius_mm / arm[0].hypot(arm[1]).max(1e-9);
            take([
                dial.centre_mm[0] + out * arm[0],
                dial.centre_mm[1] + out * arm[1],
            ]);
        }
    }
    if !low[0].is_finite() || !low[1].is_finite() {
        return [[-1.0, -1.0], [1.0, 1.0]];
    }
    let margin = 0.03 * scene.reach_mm;
    [low.map(|v| v - margin), high.map(|v| v + margin)]
}

/// The corners of a sector as quadrilaterals, mm.
pub(crate) fn sector(dial: &Dial, from_rad: f64, to_rad: f64) -> Vec<[[f64; 2]; 4]> {
    let pieces = ((to_rad - from_rad).abs() / CHORD_RAD)
        .ceil()
        .clamp(1.0, 400.0);
    let at = |k: f64| from_rad + (to_rad - from_rad) * k / pieces;
    let (inner, outer) = (SECTOR.0 * dial.radius_mm, SECTOR.1 * dial.radius_mm);
    (0..crate::gui::units::whole(pieces))
        .map(|k| {
            let (a, b) = (at(k as f64), at(k as f64 + 1.0));
            [
                dial.at(a, inner),
                dial.at(a, outer),
                dial.at(b, outer),
                dial.at(b, inner),
            ]
        })
        .collect()
}

/// The scale's arrow: the deviation that it stands for, mm, such that it is drawn at most
/// `most_points` long where one mm takes `points_per_mm`.
pub(crate) fn scale_mm(magnification: f64, points_per_mm: f64, most_points: f64) -> f64 {
    round_down(most_points / (magnification * points_per_mm))
}

/// The sample nearest to the pointer, of those within `reach` points of it.
pub(crate) fn nearest(
    candidates: impl Iterator<Item = (usize, [f32; 2])>,
    pointer: [f32; 2],
    reach: f32,
) -> Option<usize> {
    let distance = |p: [f32; 2]| (p[0] - pointer[0]).hypot(p[1] - pointer[1]);
    candidates
        .map(|(sample, at)| (sample, distance(at)))
        .filter(|(_, d)| *d <= reach)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(sample, _)| sample)
}

/// So many vectors and points can be told apart where all of the workspace is in sight.
const APART: [f64; 2] = [1_500.0, 7_500.0];

/// How many points and how many vectors a layer draws: the nearer one looks the more. Points move
/// apart along both axes; vectors become longer as well, and so fewer of them fit.
pub(crate) fn counts(scene: &Scene, transform: &PlotTransform) -> [usize; 2] {
    let Canvas::Layers(most) = scene.canvas else {
        return [0; 2];
    };
    let [low, high] = scene.measured_mm;
    let side = |k: usize, points_per_mm: f64, frame: f32| {
        let drawn = (high[k] - low[k]) * points_per_mm.abs();
        (drawn / f64::from(frame.max(1.0))).max(1.0)
    };
    let frame = transform.frame();
    let wide = side(0, transform.dpos_dvalue_x(), frame.width());
    let tall = side(1, transform.dpos_dvalue_y(), frame.height());
    let most = scene.samples.min(most);
    let at_most = |apart: f64| {
        if apart < most as f64 {
            crate::gui::units::whole(apart)
        } else {
            most
        }
    };
    let [vectors, points] = APART;
    [points * wide * tall, vectors * (wide * tall).sqrt()].map(at_most)
}

/// What a layer says when it does not draw everything.
pub(crate) fn drawn(scene: &Scene, [points, vectors]: [usize; 2]) -> Vec<String> {
    let one_of = |count: usize| scene.samples.div_ceil(count.max(1));
    let note = |(count, what): (usize, &str)| {
        let why = if scene.canvas == Canvas::Layers(count) {
            "this computer draws in software"
        } else {
            "zoom in for more"
        };
        (count < scene.samples).then(|| format!("1 of {} {what}: {why}", one_of(count)))
    };
    let layers = [(points, "points"), (vectors, "vectors")];
    layers.into_iter().filter_map(note).collect()
}

/// The sample under the pointer, of those within `reach` points of it.
pub(crate) fn under(
    workbench: &Workbench,
    transform: &PlotTransform,
    pointer: Pos2,
    reach: f32,
) -> Option<usize> {
    let usable = &workbench.subject().overview.usable;
    if usable.len() > FEW {
        let at = transform.value_from_position(pointer);
        let reach_mm = f64::from(reach) / transform.dpos_dvalue_x().abs();
        return workbench.nearest()?.find([at.x, at.y], reach_mm);
    }
    let axes = workbench.view().plane.axes();
    let candidates = usable.iter().map(|sample| {
        let sample = *sample as usize;
        let measured = workbench.subject().measured(sample);
        let [x, y] = axes.map(|k| measured[k]);
        let at = transform.position_from_point(&PlotPoint::new(x, y));
        (sample, [at.x, at.y])
    });
    nearest(candidates, [pointer.x, pointer.y], reach)
}

/// One line of what is said about a sample: what, and how much.
pub(crate) type Line = (String, String);

/// What matters most of a sample.
pub(crate) fn brief(workbench: &Workbench, sample: usize) -> (String, Vec<Line>) {
    const MOST: usize = 3;
    let subject = &**workbench.subject();
    let (title, all) = about(workbench, sample);
    let joints = subject.session.robot.joints.len();
    let mut lines: Vec<Line> = Vec::new();
    if joints > MOST {
        let values = all.iter().take(joints).map(|(_, value)| value.as_str());
        let mut values: Vec<&str> = values.take(6).collect();
        if joints > values.len() {
            values.push("…");
        }
        lines.push(("joints".to_owned(), values.join(", ")));
    } else {
        lines.extend(all.iter().take(joints).cloned());
    }
    let colour = workbench.view().colouring;
    let component = workbench.view().component;
    let matters = |name: &str| {
        ["left out", "deviation", "before", "after", "tolerance"].contains(&name)
            || name == colour.name()
            || name == component.name()
    };
    let rest = all.into_iter().skip(joints);
    lines.extend(rest.filter(|(name, _)| matters(name)));
    // Before and after are one line where both are there.
    if let Some(k) = lines.iter().position(|(name, _)| name == "before")
        && lines.get(k + 1).is_some_and(|(name, _)| name == "after")
    {
        let after = lines.remove(k + 1).1;
        let before = lines[k].1.trim_end_matches(char::is_alphabetic).trim_end();
        lines[k] = ("before → after".to_owned(), format!("{before} → {after}"));
    }
    (title, lines)
}

/// What is said about a sample.
pub(crate) fn about(workbench: &Workbench, sample: usize) -> (String, Vec<Line>) {
    let subject = &**workbench.subject();
    let units = workbench.units();
    let title = format!("sample {}", sample + 1);
    let mut lines = Vec::new();
    let joints = &subject.session.robot.joints;
    for (joint, q) in joints.iter().zip(&subject.session.samples.q) {
        let value = match joint.kind {
            crate::kinematics::JointKind::Revolute => units.angle(q[sample]),
            crate::kinematics::JointKind::Prismatic => units.length(q[sample]),
        };
        lines.push((joint.name.clone(), value));
    }
    let came = match subject.side(sample) {
        s if s > 0.0 => "moving positive",
        s if s < 0.0 => "moving negative",
        _ => "not known",
    };
    lines.push(("approached".to_owned(), came.to_owned()));
    if !subject.usable[sample] {
        lines.push(("left out".to_owned(), "a value is missing".to_owned()));
        return (title, lines);
    }
    let before = subject.deviation_before(sample);
    let length = |e: [f64; 3]| units.length(subject.component(e, sample, Component::Length));
    let mut shown = before;
    match workbench.answer() {
        None => lines.push(("deviation".to_owned(), length(before))),
        Some(answer) => {
            shown = answer.deviation_after(sample);
            lines.push(("before".to_owned(), length(before)));
            lines.push(("after".to_owned(), length(shown)));
        }
    }
    for component in [Component::Tangential, Component::Radial, Component::Axial] {
        if component.out_of_plane() && subject.session.samples.z_mm.is_none() {
            continue;
        }
        let value = subject.component(shown, sample, component);
        lines.push((component.name().to_owned(), units.length(value)));
    }
    let samples = &subject.session.samples;
    let conditions = [
        ("load", &samples.load_kg, "kg"),
        ("temperature", &samples.temperature_c, "°C"),
        ("time", &samples.time_s, "s"),
    ];
    for (name, column, unit) in conditions {
        if let Some(value) = column.as_ref().map(|c| c[sample]).filter(|v| v.is_finite()) {
            lines.push((name.to_owned(), format!("{} {unit}", trimmed(value, 2))));
        }
    }
    let [right, up] = workbench.view().plane.axes();
    let direction = shown[up].atan2(shown[right]).to_degrees();
    lines.push((
        "direction".to_owned(),
        format!("{}°", trimmed(direction, 0)),
    ));
    if let Some(tolerance_mm) = workbench.document().tolerance_mm {
        let within = subject.component(shown, sample, Component::Length) <= tolerance_mm;
        let says = if within { "within" } else { "outside" };
        lines.push(("tolerance".to_owned(), says.to_owned()));
    }
    (title, lines)
}

#[cfg(test)]
mod tests {
    use egui_plot::PlotBounds;

    use super::*;
    use crate::gui::testing::workbench;

    #[test]
    fn everything_that_is_drawn_is_within_the_bounds() {
        let scene = Scene::of(&workbench());
        let [low, high] = bounds(&scene);
        let dial = scene.dial.expect("it turns");
        let handle = dial.at(0.0, HANDLE * dial.radius_mm);
        for p in scene.points.iter().map(|p| p.at_mm).chain([handle]) {
            assert!((0..2).all(|k| low[k] <= p[k] && p[k] <= high[k]), "{p:?}");
        }
    }

    #[test]
    fn the_scale_is_round_and_fits() {
        for magnification in [1.0, 20.0, 500.0] {
            let mm = scale_mm(magnification, 1.7, 80.0);
            let drawn = mm * magnification * 1.7;
            assert!(drawn <= 80.0 + 1e-9 && drawn > 80.0 / 2.6, "{drawn}");
        }
    }

    #[test]
    fn the_nearer_one_looks_the_more_vectors_are_drawn() {
        let mut scene = Scene::of(&workbench());
        scene.samples = 1_000_000;
        scene.canvas = Canvas::Layers(usize::MAX);
        let at = |scale: f64| {
            let frame = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(500.0, 400.0));
            let bounds = PlotBounds::from_min_max(
                [-300.0 * scale, -240.0 * scale],
                [300.0 * scale, 240.0 * scale],
            );
            counts(&scene, &PlotTransform::new(frame, bounds, false))
        };
        assert_eq!(at(1.5), [7_500, 1_500]);
        let [points, vectors] = at(0.1);
        assert!(points > 100_000 && vectors > 7_000, "{points} {vectors}");
        assert!(at(0.02) > at(0.1));
        assert_eq!(at(0.0001), [1_000_000, 1_000_000]);
        let says = drawn(&scene, at(1.5));
        assert_eq!(says[1], "1 of 667 vectors: zoom in for more");
        assert!(drawn(&scene, [1_000_000; 2]).is_empty());
    }

    #[test]
    fn the_nearest_sample_is_found_within_reach_only() {
        let at = [(7, [0.0, 0.0]), (8, [10.0, 0.0])];
        assert_eq!(nearest(at.into_iter(), [8.0, 1.0], 12.0), Some(8));
        assert_eq!(nearest(at.into_iter(), [50.0, 50.0], 12.0), None);
    }

    #[test]
    fn a_sector_is_cut_into_pieces_that_cover_it() {
        let scene = Scene::of(&workbench());
        let dial = scene.dial.expect("it turns");
        let pieces = sector(&dial, -0.4, 0.6);
        let first = pieces.first().expect("at least one");
        let last = pieces.last().expect("at least one");
        assert_eq!(first[1], dial.at(-0.4, SECTOR.1 * dial.radius_mm));
        let end = dial.at(0.6, SECTOR.1 * dial.radius_mm);
        assert!((last[2][0] - end[0]).abs() < 1e-9);
    }

    #[test]
    fn the_hover_names_the_sample_its_angle_and_its_deviation() {
        let workbench = workbench();
        let (title, lines) = about(&workbench, 0);
        assert_eq!(title, "sample 1");
        let says = |what: &str| lines.iter().any(|(name, _)| name == what);
        assert!(says("pan") && says("deviation") && says("direction") && says("tolerance"));
    }
}
