//! What stands around the plots. Panels read the workbench and leave changes in it.

pub(crate) mod blocks;
pub(super) mod chart;
mod coverage;
mod export;
mod gap;
pub(super) mod menu;
mod regions;
pub(super) mod results;
mod samples;
pub(super) mod session;
pub(super) mod status;
pub(super) mod steps;
