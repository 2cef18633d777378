//! The library of robots: nominal geometry, ranges and figures of common robots, each number with its source.
//!
//! The robots are data (`assets/robots.json`): joints and tool in the form of a session's robot, the source of
//! the geometry, of the figures and of what they were checked against, and what could not be checked. Forward
//! positions of a second source are held in `tests/data/robots/library.json`.
//!
//! - `search`: robots by typed text, whatever its case, spaces and signs.

mod entry;
pub(crate) mod library;
mod search;

pub use entry::{LibraryRobot, Reference, RobotKind, Source, Sources};
pub use library::{library, source, sources};
pub use search::{find, named};
