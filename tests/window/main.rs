//! The window, driven without a display as a person drives it. One binary, so that the library is
//! linked once; a file per subject.

#![cfg(feature = "gui")]

#[path = "../support/cases.rs"]
mod cases;
#[path = "../support/gantry.rs"]
mod gantry;
#[path = "../support/rig.rs"]
mod rig;
#[path = "../support/touring.rs"]
mod touring;
#[path = "../support/window.rs"]
mod window;

mod accessible;
mod charts;
mod compensate;
mod data;
mod degenerate;
mod disk;
mod dropped;
mod export;
mod files;
mod frame;
mod friction;
mod gap;
mod identify;
mod import;
mod keyboard;
mod languages;
mod look;
mod many;
mod models;
mod notices;
mod one_voice;
mod panes;
mod pictures;
mod preferences;
mod record;
mod regions;
mod report;
mod robots;
mod session;
mod setup;
mod sizes;
mod space;
mod trial;
#[cfg(debug_assertions)]
mod walk;
mod walk_through;
mod workspace;
