//! What stands over a plot of samples in a plane or in space: the scale of the vectors above it, and
//! the robot's values beside its tool, away from the crowd.

use egui::{Pos2, Rect, Ui};

use crate::gui::cache::cloud::Cloud;
use crate::gui::scene::Camera;
use crate::gui::style::tokens::Palette;
use crate::gui::workbench::Workbench;

use super::legend;
use super::model::{Shown, shown};
use super::notes::Notes;
use super::robot::{self, Drawn};

/// Samples that are looked at: the cloud's order shows the whole in every beginning.
const SOME: usize = 500;

/// Shows it; `scale` is where there is room for the scale.
pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    (all, robot): (&Shown, Option<&Drawn>),
    camera: &Camera,
    (notes, scale): (Notes, Option<Rect>),
) {
    notes.keep(ui, all, camera.transform());
    if let Some(room) = scale {
        // The legend stands above the plot.
        let mut above = ui.new_child(egui::UiBuilder::new().max_rect(room));
        above.set_clip_rect(room.expand(40.0));
        legend::scale_in(&above, room, workbench, all, camera);
    }
    let Some(robot) = robot else {
        return;
    };
    let view = workbench.view();
    // Only needed where something is written.
    let crowd = if view.selected.is_some() && view.hovered.is_none() {
        vector_points(workbench, all, camera)
    } else {
        Vec::new()
    };
    let written = robot.asked_for && view.hovered.is_none();
    robot::values(ui, camera, robot, written, &crowd, &Palette::of(ui));
}

/// Points on the vectors of some samples, so many that a crowd is seen.
fn vector_points(workbench: &Workbench, all: &Shown, camera: &Camera) -> Vec<Pos2> {
    let loaded_session = workbench.loaded_session();
    let cloud = Cloud::of(loaded_session);
    let samples = cloud.samples.iter().take(SOME);
    let points = samples.flat_map(|sample| {
        let sample = *sample as usize;
        let (at, e) = (loaded_session.measured(sample), shown(workbench, sample));
        [0.0, 0.5, 1.0].map(|part| {
            let more = part * (all.magnification - 1.0);
            camera.at([0, 1, 2].map(|k| at[k] + more * e[k]))
        })
    });
    points
        .filter(|p| p.x.is_finite() && p.y.is_finite())
        .collect()
}
