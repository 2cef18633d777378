//! Where the parts of the workspace plot go: bounds, sectors, the scale, what is under the pointer, and which of
//! many vectors are drawn. Rectangles and points only, so that it is tested without pixels.

use egui::Pos2;
use egui_plot::PlotTransform;

use super::model::{Dial, Shown};
use crate::gui::core::overview::{FEW, corners, round_down};
use crate::gui::layers::gpu::MOST;

/// Sectors reach so far beyond the path, in parts of the radius.
pub(crate) const SECTOR: f64 = 1.10;
/// Boundaries' handles and region names stand outside it.
pub(crate) const HANDLE: f64 = 1.17;
/// Room for the handles.
const ROOM: f64 = 1.22;
/// Chords of a sector are no longer than this, rad.
const CHORD_RAD: f64 = 0.05;

/// Smallest and largest corner of everything, mm, with room for handles.
pub(crate) fn bounds(shown: &Shown) -> [[f64; 2]; 2] {
    let path = shown.paths_mm.iter().flatten();
    let path = path.map(|p| shown.look.facing.flat(*p));
    let ends = shown.measured_mm.into_iter().chain(shown.robot_mm);
    let mut all: Vec<[f64; 2]> = ends.chain(path.clone()).collect();
    if let Some(dial) = &shown.dial {
        let centre = dial.centre_mm;
        all.push(centre);
        all.extend(path.map(|p| {
            let arm = [p[0] - centre[0], p[1] - centre[1]];
            let out = ROOM * dial.radius_mm / arm[0].hypot(arm[1]).max(1e-9);
            [centre[0] + out * arm[0], centre[1] + out * arm[1]]
        }));
    }
    let [low, high] = corners(all);
    if !low[0].is_finite() || !low[1].is_finite() {
        return [[-1.0, -1.0], [1.0, 1.0]];
    }
    let margin = 0.03 * shown.reach_mm;
    [low.map(|v| v - margin), high.map(|v| v + margin)]
}

/// Points for each mm where a plot of this size shows all of it.
pub(crate) fn fitted([low, high]: [[f64; 2]; 2], size: [f64; 2]) -> f64 {
    let side = |k: usize| size[k] / (high[k] - low[k]).max(1e-9);
    f64::min(side(0), side(1))
}

/// Points along the outer edge of a sector, mm.
pub(crate) fn edge(dial: &Dial, from_rad: f64, to_rad: f64) -> impl Iterator<Item = [f64; 2]> {
    let pieces = ((to_rad - from_rad).abs() / CHORD_RAD)
        .ceil()
        .clamp(1.0, 400.0);
    let at = move |k: usize| from_rad + (to_rad - from_rad) * k as f64 / pieces;
    let outer = SECTOR * dial.radius_mm;
    (0..=crate::numeric::whole(pieces)).map(move |k| dial.at(at(k), outer))
}

/// The scale's arrow: the deviation that it stands for, mm, such that it is drawn at most
/// `most_points` long where one mm takes `points_per_mm`.
pub(crate) fn scale_mm(magnification: f64, points_per_mm: f64, most_points: f64) -> f64 {
    round_down(most_points / (magnification * points_per_mm))
}

/// The sample nearest to the pointer, of those within `reach` points of it.
pub(crate) fn nearest(
    candidates: impl Iterator<Item = (usize, Pos2)>,
    pointer: Pos2,
    reach: f32,
) -> Option<usize> {
    candidates
        .map(|(sample, at)| (sample, pointer.distance(at)))
        .filter(|(_, d)| *d <= reach)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(sample, _)| sample)
}

/// So many vectors and points can be told apart where all of the workspace is in sight.
const APART: [f64; 2] = [1_500.0, 7_500.0];

/// Many vectors, one to so many points of the screen, so that each can be read: as many as there are cells of a grid
/// with samples in them, in the order of the cloud, which is spread evenly.
const CELL: f64 = 14.0;

/// How many points and how many vectors a layer draws: the nearer one looks the more. Points move
/// apart along both axes; vectors become longer as well, and so fewer of them fit.
pub(crate) fn counts(shown: &Shown, transform: &PlotTransform) -> [usize; 2] {
    let [low, high] = shown.measured_mm;
    let side = |k: usize, points_per_mm: f64, frame: f32| {
        let drawn = (high[k] - low[k]) * points_per_mm.abs();
        (drawn / f64::from(frame.max(1.0))).max(1.0)
    };
    let frame = transform.frame();
    let wide = side(0, transform.dpos_dvalue_x(), frame.width());
    let tall = side(1, transform.dpos_dvalue_y(), frame.height());
    let [vectors, points] = APART;
    let vectors = if shown.samples <= FEW {
        vectors * (wide * tall).sqrt()
    } else {
        let side_mm = CELL / transform.dpos_dvalue_x().abs();
        let cells = [0, 1].map(|k| (high[k] - low[k]) / side_mm);
        let over = if shown.along_a_path {
            cells[0] + cells[1]
        } else {
            cells[0] * cells[1]
        };
        over.max(1.0)
    };
    let most = shown.samples.min(MOST);
    [points * wide * tall, vectors].map(|apart| crate::numeric::whole(apart.min(most as f64)))
}

/// What a layer says when it does not draw everything.
pub(crate) fn drawn(shown: &Shown, counts: [usize; 2]) -> Vec<String> {
    let why = say!("zoom in for more");
    let [points, vectors] = counts.map(|count| {
        let one_of = shown.samples.div_ceil(count.max(1));
        (one_of > 1).then_some(one_of)
    });
    let points = points.map(|one_of| say!("showing 1 in {one_of} points; {why}", one_of, why));
    // Of some that are chosen the legend says it.
    let vectors = vectors.filter(|_| shown.vectors.is_none());
    let vectors = vectors.map(|one_of| say!("showing 1 in {one_of} vectors; {why}", one_of, why));
    points.into_iter().chain(vectors).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::{lamp, workbench, workbench_on};
    use egui::pos2;
    use egui_plot::PlotBounds;

    #[test]
    fn everything_that_is_drawn_is_within_the_bounds() {
        let workbench = workbench();
        let shown = Shown::of(&workbench);
        let [low, high] = bounds(&shown);
        let dial = shown.dial.expect("it turns");
        let handle = dial.at(0.0, HANDLE * dial.radius_mm);
        let loaded_session = workbench.loaded_session();
        let flat = |sample: usize| shown.look.facing.flat(loaded_session.measured(sample));
        for p in (0..loaded_session.len()).map(flat).chain([handle]) {
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
        let mut shown = Shown::of(&workbench());
        shown.samples = 1_000_000;
        let at = |scale: f64| {
            let frame = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(500.0, 400.0));
            let bounds = PlotBounds::from_min_max(
                [-300.0 * scale, -240.0 * scale],
                [300.0 * scale, 240.0 * scale],
            );
            counts(&shown, &PlotTransform::new(frame, bounds, false))
        };
        let [points, vectors] = at(1.5);
        assert!(points == 7_500 && vectors < 100, "{points} {vectors}");
        let [points, closer] = at(0.1);
        assert!(
            points > 100_000 && closer > 10 * vectors,
            "{points} {closer}"
        );
        assert!(at(0.02) > at(0.1));
        assert_eq!(at(0.000_01), [1_000_000, 1_000_000]);
        let says = drawn(&shown, at(1.5));
        assert!(says[1].ends_with(" vectors; zoom in for more"), "{says:?}");
        assert!(drawn(&shown, [1_000_000; 2]).is_empty());
    }

    #[test]
    fn the_nearest_sample_is_found_within_reach_only() {
        let at = [(7, pos2(0.0, 0.0)), (8, pos2(10.0, 0.0))];
        assert_eq!(nearest(at.into_iter(), pos2(8.0, 1.0), 12.0), Some(8));
        assert_eq!(nearest(at.into_iter(), pos2(50.0, 50.0), 12.0), None);
    }

    #[test]
    fn the_edge_of_a_sector_goes_from_end_to_end() {
        let shown = Shown::of(&workbench());
        let dial = shown.dial.expect("it turns");
        let points: Vec<_> = edge(&dial, -0.4, 0.6).collect();
        assert_eq!(points[0], dial.at(-0.4, SECTOR * dial.radius_mm));
        let end = dial.at(0.6, SECTOR * dial.radius_mm);
        let last = points.last().expect("at least two");
        assert!((last[0] - end[0]).abs() < 1e-9);
    }

    fn transform(scale: f64) -> PlotTransform {
        let frame = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(500.0, 400.0));
        let (x, y) = (300.0 * scale, 240.0 * scale);
        PlotTransform::new(frame, PlotBounds::from_min_max([-x, -y], [x, y]), false)
    }

    #[test]
    fn of_many_vectors_one_is_drawn_for_every_cell() {
        let workbench = workbench_on(lamp(0.05, &[]));
        let shown = Shown::of(&workbench);
        let [points, vectors] = super::counts(&shown, &transform(1.0));
        assert!(
            points > 2_000 && (30..250).contains(&vectors),
            "{points} {vectors}"
        );
        let [_, closer] = super::counts(&shown, &transform(0.1));
        assert!(closer > 3 * vectors, "{closer}");
    }
}
