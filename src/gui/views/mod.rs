//! What stands around the plots. Panels read the workbench and send commands.

pub(crate) mod blocks;
mod compensate;
pub(crate) mod copies;
mod coverage;
mod disk;
pub(super) mod dropped;
mod export;
mod findings;
mod gap;
pub(super) mod grips;
mod identify;
pub(super) mod menu;
mod model;
mod names;
pub(super) mod notices;
pub(super) mod panes;
pub(super) mod pictures;
mod regions;
pub(super) mod results;
mod samples;
pub(super) mod session;
mod setup;
mod standards;
pub(super) mod status;
mod step;
pub(super) mod steps;
mod unexplained;
