//! How panes are called, and how they are changed.

use crate::gui::view::{ChartPane, Content, Key, Pane, Panes};
use crate::gui::workbench::{Command, ViewChange, Workbench};

/// What a pane is called.
pub(super) fn name_of(workbench: &Workbench, pane: &Pane) -> String {
    match &pane.shows {
        Content::Workspace => say!("Workspace").to_owned(),
        Content::Chart(chart) => workbench.kind(chart).about().name().to_owned(),
    }
}

/// The panes with this done to the chart in one of them.
pub(super) fn changed(
    workbench: &Workbench,
    key: Key,
    change: impl FnOnce(&mut ChartPane),
) -> Command {
    rearranged(workbench, |panes| {
        if let Some(pane) = panes.chart_mut(key) {
            change(pane);
        }
        panes.activate(key);
    })
}

/// The panes with this done to them.
pub(super) fn rearranged(workbench: &Workbench, change: impl FnOnce(&mut Panes)) -> Command {
    let mut panes = workbench.view().panes.clone();
    change(&mut panes);
    Command::View(ViewChange::Panes(Box::new(panes)))
}
