//! Which sample is under the pointer, of those that are drawn.

use crate::gui::cache::cloud::Cloud;
use crate::gui::view::Canvas;
use crate::gui::workbench::Workbench;

use super::super::model::Shown;

/// Marks that are less than this apart on the screen stand on one another, points.
const SAME: f64 = 3.0;

/// A mark: its sample, how far it is from the pointer, points, and how near to the viewer, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Candidate {
    sample: usize,
    distance: f64,
    nearness: f64,
}

/// The nearest to the pointer; of those that stand on one another there, the nearest to the viewer.
fn picked(candidates: &[Candidate]) -> Option<usize> {
    let least = candidates.iter().map(|c| c.distance);
    let least = least.fold(f64::INFINITY, f64::min);
    let there = candidates.iter().filter(|c| c.distance <= least + SAME);
    let first = |a: &&Candidate, b: &&Candidate| {
        let order = a.nearness.total_cmp(&b.nearness);
        order.then(b.sample.cmp(&a.sample))
    };
    there.max_by(first).map(|c| c.sample)
}

/// The sample at a point of the plot, mm to the right and up as the shown has it, within `reach`
/// points of it. Only what is drawn is there: the first `points` of the cloud, or the shown's points.
pub(super) fn under(
    workbench: &Workbench,
    shown: &Shown,
    at_mm: [f64; 2],
    points_per_mm: f64,
    (reach, points): (f64, usize),
) -> Option<usize> {
    let facing = &shown.look.facing;
    let reach_mm = reach / points_per_mm;
    let within = |p: [f64; 2]| {
        let distance = (p[0] - at_mm[0]).hypot(p[1] - at_mm[1]);
        (distance <= reach_mm).then_some(distance * points_per_mm)
    };
    let found: Vec<Candidate> = match shown.canvas {
        Canvas::Shapes => {
            let candidates = shown.each.iter().filter_map(|one| {
                Some(Candidate {
                    sample: one.sample,
                    distance: within(facing.flat(one.at_mm))?,
                    nearness: facing.nearness(one.at_mm),
                })
            });
            candidates.collect()
        }
        Canvas::Layers(_) => {
            let cloud = Cloud::of(workbench.loaded_session());
            let [x, y] = facing.flat(cloud.centre_mm);
            let drawn = cloud.places.iter().zip(&cloud.samples).take(points);
            let candidates = drawn.filter_map(|(place, sample)| {
                let p = [0, 1, 2].map(|k| f64::from(place[k]));
                let [right, up] = facing.flat(p);
                Some(Candidate {
                    sample: *sample as usize,
                    distance: within([x + right, y + up])?,
                    nearness: facing.nearness(p),
                })
            });
            candidates.collect()
        }
    };
    picked(&found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;
    use crate::gui::view::{Camera, Standard};
    use crate::gui::workbench::{Command, ViewChange};

    #[test]
    fn of_marks_on_one_another_the_nearest_to_the_viewer_is_picked() {
        let mark = |sample, distance, nearness| Candidate {
            sample,
            distance,
            nearness,
        };
        assert_eq!(picked(&[]), None);
        // Two on one another, and one beside them that is nearer to the viewer still.
        let marks = [
            mark(7, 1.0, -300.0),
            mark(8, 2.5, 200.0),
            mark(9, 9.0, 900.0),
        ];
        assert_eq!(picked(&marks), Some(8));
        assert_eq!(picked(&[mark(5, 1.0, 2.0), mark(4, 1.0, 2.0)]), Some(4));
    }

    #[test]
    fn every_sample_that_is_drawn_is_found_where_it_is_from_every_side_by_shapes_and_layers() {
        for canvas in [Canvas::Shapes, Canvas::Layers(usize::MAX)] {
            let mut workbench = workbench();
            workbench.execute(Command::View(ViewChange::Canvas(canvas)));
            let tilted = Camera::default().orbited([40.0, 25.0]);
            for camera in [Camera::from(Standard::Front), tilted] {
                workbench.execute(Command::View(ViewChange::LookFrom(None)));
                workbench.execute(Command::View(ViewChange::Turn(camera)));
                let shown = Shown::of(&workbench);
                let facing = workbench.facing();
                let loaded_session = workbench.loaded_session();
                for sample in loaded_session.overview.usable.iter().map(|s| *s as usize) {
                    let p = loaded_session.measured(sample);
                    let at = facing.flat(p);
                    let all = loaded_session.len();
                    let found = under(&workbench, &shown, at, 100.0, (14.0, all));
                    let found = found.expect("it is there");
                    let q = loaded_session.measured(found);
                    let apart = facing.flat([0, 1, 2].map(|k| q[k] - p[k]));
                    assert!(100.0 * apart[0].hypot(apart[1]) < SAME + 0.1);
                    assert!(facing.nearness(q) > facing.nearness(p) - 1e-3);
                }
                let nowhere = under(&workbench, &shown, [1e5, 1e5], 100.0, (14.0, 9));
                assert_eq!(nowhere, None);
            }
        }
    }
}
