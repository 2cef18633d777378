//! What stands around the plots. Panels read the workbench and send commands.

mod copies;
mod disk;
pub(super) mod dropped;
mod export;
mod findings;
mod gap;
mod identify;
mod import;
pub(super) mod menu;
mod model;
mod preferences;
mod recovery;
mod regions;
pub(super) mod results;
mod samples;
mod session;
mod setup;
pub(super) mod sheets;
pub(super) mod shortcuts;
mod simulation;
pub(super) mod stage;
mod standards;
pub(super) mod status;
pub(super) mod steps;
mod unexplained;
mod unsaved;
mod words;
