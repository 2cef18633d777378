//! What stands around the plots. Panels read the workbench and leave changes in it.

pub(crate) mod blocks;
mod coverage;
mod export;
mod gap;
pub(super) mod menu;
pub(super) mod panes;
mod regions;
pub(super) mod results;
mod samples;
pub(super) mod session;
pub(super) mod status;
pub(super) mod steps;
