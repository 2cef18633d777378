//! What makes a chart: how it is called, and what shows it, draws it for a file and writes it as a
//! table.

use egui::Ui;

use crate::gui::help::Word;
use crate::gui::plots::chart_spec::Sketch;
use crate::gui::view::Chart;
use crate::gui::workbench::{Command, Workbench};

/// See the module. Each chart's file has one; [`super::CHARTS`] lists them.
pub(super) struct View {
    pub(super) chart: Chart,
    /// Its name where there is little room.
    pub(super) short: &'static str,
    pub(super) name: &'static str,
    /// What its question mark explains.
    pub(super) word: Word,
    /// Whether it shows one component of the deviation.
    pub(super) of_component: bool,
    /// Whether it is about one joint.
    pub(super) of_joint: bool,
    /// Shows it in the space that is left.
    pub(super) show: fn(&mut Ui, &Workbench, &mut Vec<Command>),
    /// As it is shown, to be saved; `None` where there is nothing to show.
    pub(super) sketch: fn(&Workbench, Chart) -> Option<Sketch>,
    /// As a table for a spreadsheet.
    pub(super) numbers: fn(&Workbench) -> String,
    /// Whether a picture of it can be saved.
    pub(super) has_picture: fn(&Workbench) -> bool,
}

/// Whether anything was measured.
pub(super) fn is_measured(workbench: &Workbench) -> bool {
    !workbench.subject().is_empty()
}
