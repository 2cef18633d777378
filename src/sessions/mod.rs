//! Measurement sessions: reading, checking and saving them.
//!
//! [`load`] takes a file and gives a [`Session`] with everything worth knowing about it, or refuses
//! it with every problem that it found, each with its place, what stands there and what should.
//! [`save`] writes it back, whole or not at all, so that loading gives the same session to the last
//! bit.
//!
//! The way in: bytes → `document` (a tree that knows places) → `format_v1` (units, ranges, the
//! robot) → `csv` or inline columns → `columns` (what headings mean) → `assemble` (samples in
//! inner units) → `validation` (what spans fields). The types that the program thinks in are in
//! `domain`; they know nothing of files.

mod apply_mend;
pub(crate) mod assemble;
mod built;
pub(crate) mod bundled;
pub(crate) mod cells;
pub(crate) mod columns;
mod consistency;
mod csv;
pub(crate) mod division;
mod domain;
mod file_hash;
pub(crate) mod files;
pub(crate) mod format_v1;
mod group;
mod group_samples;
mod growing;
mod hash;
mod lines;
mod load;
pub(crate) mod measuring_order;
mod mend;
mod observed;
mod references;
pub(crate) mod regions;
pub(crate) mod resolution;
mod rows;
mod save;
mod saved_columns;
pub(crate) mod table;
pub(crate) mod validation;
#[cfg(test)]
mod watched;

pub use crate::atomic::WriteError;
pub use built::SessionBuilder;
pub use division::{MOST_REGIONS, RegionChoice, RegionError, range_to_divide};
pub use domain::{
    Instrument, Region, Samples, Session, Setups, Sigma, Target, Tracker, UnknownColumn,
};
pub use files::read_document as read_whole;
pub use group::Group;
pub use growing::{Growing, Growth};
pub use hash::hash_of_samples;
pub use lines::Lines;
pub use load::{
    Loaded, LoadedRobot, load, load_robot, load_watched, parse, parse_robot, parse_with_csv,
};
pub use mend::{Corrected, Mend};
pub use references::{
    Anchor, Azimuth, ObservedColumns, Plane, Pointing, References, Socket, SocketDistance, Station,
};
#[cfg(feature = "gui")]
pub(crate) use save::save_document;
pub use save::{
    Replacing, robot_document, samples_path, save, save_watched, save_with_samples, write_csv,
    write_inline,
};
