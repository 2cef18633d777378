//! What stands around the plots. Panels read the workbench and leave changes in it.

pub(crate) mod blocks;
pub(crate) mod copies;
mod coverage;
mod export;
mod findings;
mod gap;
pub(super) mod menu;
mod model;
pub(super) mod panes;
mod regions;
pub(super) mod results;
mod samples;
pub(super) mod session;
mod setup;
pub(super) mod status;
pub(super) mod steps;

use egui::Ui;

use crate::gui::view::Step;
use crate::gui::workbench::Workbench;

/// A step of the work, as a panel. Each step's file has one; `steps` lists them.
pub(super) struct StepView {
    pub(super) step: Step,
    pub(super) show: fn(&mut Ui, &Workbench),
    /// The button at the foot.
    pub(super) next: fn(&mut Ui, &Workbench),
    /// What it has to show for itself.
    pub(super) state: fn(&Workbench) -> (String, Progress),
}

/// How far a step has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Progress {
    /// Nothing to show for it yet.
    Open,
    Done,
}

impl Progress {
    pub(super) fn of(done: bool) -> Self {
        if done { Self::Done } else { Self::Open }
    }
}
