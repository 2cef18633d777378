//! Measurement sessions: reading, checking and saving them.
//!
//! [`load`] takes a file and gives a [`Session`] with everything worth knowing about it, or refuses
//! it with every problem that it found, each with its place, what stands there and what should.
//! [`save`] writes it back, whole or not at all, so that loading gives the same session to the last
//! bit.
//!
//! What was measured is here: `domain` has the types that the program thinks in, `built` and `consistency` make and
//! check them, `group`, `regions` and `cells` look at parts of them. How it lies on the disk is in `files`, of which
//! nothing here knows.

mod built;
#[doc(hidden)]
pub mod cells;
#[doc(hidden)]
pub mod columns;
mod consistency;
#[doc(hidden)]
pub mod correct;
#[doc(hidden)]
pub mod correction;
#[doc(hidden)]
pub mod division;
mod domain;
#[doc(hidden)]
pub mod files;
mod group;
mod group_samples;
#[doc(hidden)]
pub mod in_rows;
pub(crate) mod layout;
#[doc(hidden)]
pub mod measuring_order;
mod observed;
#[doc(hidden)]
pub mod poses;
mod references;
#[doc(hidden)]
pub mod regions;
#[doc(hidden)]
pub mod resolution;
mod rows;
pub(crate) mod table;
#[doc(hidden)]
pub mod validation;

pub use crate::atomic::WriteError;
pub use crate::tables::Lines;
pub use correction::DAY_S;
pub use correction::{Corrected, SessionCorrection};
pub use division::{MOST_REGIONS, RegionChoice, range_to_divide};
pub use domain::default_targets;
pub use domain::{
    Instrument, Region, Samples, Session, Setups, Sigma, Target, Tracker, UnknownColumn,
};
pub use files::hash::hash_of_samples;
pub use files::load::{Loaded, load, load_watched, parse, parse_with_csv};
pub use files::load_robot::{LoadedRobot, load_robot, parse_robot};
pub use files::open::read_document as read_whole;
pub use files::save::{
    Replacing, robot_document, samples_path, save, save_watched, save_with_samples, write_csv,
    write_inline,
};
pub use group::Group;
pub use references::{
    Anchor, Azimuth, ObservedColumns, Plane, Pointing, References, Socket, SocketDistance, Station,
};
