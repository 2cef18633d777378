//! What the workspace plot takes from the layers.

use std::sync::Arc;

use egui::Shape;
use egui_plot::PlotTransform;

use crate::gui::cache::cloud::Cloud;
use crate::gui::layers::{CloudLayer, Frame, HeatLayer, Layer, Look, mesh};
use crate::gui::style::tokens::Palette;
use crate::gui::view::{Canvas, Colouring};
use crate::gui::workbench::Workbench;

use super::layout;
use super::model::Scene;

/// The heat map, if it is shown.
pub(super) fn beneath(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    scene: &Scene,
    workbench: &Workbench,
    palette: &Palette,
    pixels: f32,
) {
    let Some(heat) = workbench.heat() else {
        return;
    };
    // The map is of lengths, whatever the colour of vectors says.
    let look = Look {
        colouring: Colouring::Deviation,
        ..scene.look
    };
    if workbench.view().canvas == Canvas::Shapes {
        shapes.push(Shape::mesh(mesh(heat, &look, palette, transform)));
        return;
    }
    let layer = HeatLayer {
        heat: Arc::clone(heat),
        frame: Frame::new(&look, palette, transform, Some(heat), pixels),
    };
    shapes.push(layer.shape(*transform.frame()));
}

/// Measured points and error vectors of all samples.
pub(super) fn cloud(
    shapes: &mut Vec<Shape>,
    transform: &PlotTransform,
    scene: &Scene,
    workbench: &Workbench,
    palette: &Palette,
    pixels: f32,
) {
    let cloud = &Cloud::of(workbench.subject());
    let layer = CloudLayer {
        cloud: Arc::clone(cloud),
        remainder: workbench.remainder(),
        frame: Frame::new(&scene.look, palette, transform, None, pixels),
        counts: layout::counts(scene, transform),
        ghosts: scene.look.ghosts(),
    };
    shapes.push(layer.shape(*transform.frame()));
}
