//! What the legend says of what is not drawn.

use egui::Ui;
use egui_plot::PlotTransform;

use crate::gui::view::Canvas;

use super::layout;
use super::model::Scene;

/// What the legend says of what is not drawn. It stands above the plot, and what is drawn follows
/// from the plot's size: the legend says what the frame before found.
pub(super) struct Notes {
    id: egui::Id,
    pub(super) said: Vec<String>,
}

impl Notes {
    pub(super) fn recall(ui: &Ui, scene: &Scene) -> Self {
        let id = ui.scope_id().with("what is not drawn");
        let said = if scene.canvas == Canvas::Shapes {
            scene.notes()
        } else {
            ui.data(|data| data.get_temp(id)).unwrap_or_default()
        };
        Self { id, said }
    }

    pub(super) fn keep(self, ui: &Ui, scene: &Scene, transform: &PlotTransform) {
        if scene.canvas == Canvas::Shapes {
            return;
        }
        let now = layout::drawn(scene, layout::counts(scene, transform));
        if now != self.said {
            ui.data_mut(|data| data.insert_temp(self.id, now));
            ui.ctx().request_repaint();
        }
    }
}
