//! What makes a step of the work: its controls, what to do next, and how far it is.

use egui::Ui;

use crate::gui::view::Step;
use crate::gui::widgets::Progress;
use crate::gui::workbench::{Command, Workbench};

/// A step of the work, as a panel. Each step's file has one; `steps` lists them.
pub(super) struct StepView {
    pub(super) step: Step,
    pub(super) show: fn(&mut Ui, &Workbench, &mut Vec<Command>),
    /// The button at the foot.
    pub(super) next: fn(&mut Ui, &Workbench, &mut Vec<Command>),
    /// What it has to show for itself.
    pub(super) state: fn(&Workbench) -> (String, Progress),
}
