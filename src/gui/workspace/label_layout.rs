//! Where marks and the tips of vectors are on the screen, of so many samples that a crowd is seen:
//! what is written on the plot goes elsewhere.

use egui::Pos2;
use egui_plot::{PlotPoint, PlotTransform};

use crate::gui::cache::cloud::Cloud;
use crate::gui::workbench::Workbench;

use super::model::{Scene, shown};

/// Samples that are looked at: the cloud's order shows the whole in every beginning.
const SOME: usize = 500;

/// Points on the vectors of some samples.
pub(super) fn crowd(workbench: &Workbench, scene: &Scene, transform: &PlotTransform) -> Vec<Pos2> {
    let subject = workbench.subject();
    let facing = workbench.facing();
    let cloud = Cloud::of(subject);
    let samples = cloud.samples.iter().take(SOME);
    let points = samples.flat_map(|sample| {
        let sample = *sample as usize;
        let (at, e) = (subject.measured(sample), shown(workbench, sample));
        [0.0, 0.5, 1.0].map(|part| {
            let more = part * (scene.magnification - 1.0);
            let [x, y] = facing.flat([0, 1, 2].map(|k| at[k] + more * e[k]));
            transform.position_from_point(&PlotPoint::new(x, y))
        })
    });
    points
        .filter(|p| p.x.is_finite() && p.y.is_finite())
        .collect()
}
