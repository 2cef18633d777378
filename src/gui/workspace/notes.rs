//! What the legend says of what is not drawn.

use egui::Ui;
use egui_plot::PlotTransform;

use crate::gui::view::Canvas;

use super::decimation::longest_of_cells;
use super::layout;
use super::model::Shown;

/// What the legend says of what is not drawn. It stands above the plot, and what is drawn follows
/// from the plot's size: the legend says what the frame before found.
pub(super) struct Notes {
    id: egui::Id,
    before: Vec<String>,
    pub(super) lines: Vec<String>,
}

impl Notes {
    pub(super) fn recall(ui: &Ui, shown: &Shown) -> Self {
        let id = ui.scope_id().with("what is not drawn");
        let before: Vec<String> = ui.data(|data| data.get_temp(id)).unwrap_or_default();
        let mut said = if shown.canvas == Canvas::Shapes {
            shown.notes()
        } else {
            Vec::new()
        };
        said.extend_from_slice(&before);
        Self {
            id,
            before,
            lines: said,
        }
    }

    pub(super) fn keep(self, ui: &Ui, shown: &Shown, transform: &PlotTransform) {
        let counts = if shown.canvas == Canvas::Shapes {
            let kept = longest_of_cells(shown, transform);
            [shown.samples, kept.map_or(shown.samples, |kept| kept.len())]
        } else {
            layout::counts(shown, transform)
        };
        let now = layout::drawn(shown, counts);
        if now != self.before {
            ui.data_mut(|data| data.insert_temp(self.id, now));
            ui.ctx().request_repaint();
        }
    }
}
