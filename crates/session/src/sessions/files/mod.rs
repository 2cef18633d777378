//! How a session lies on the disk. What was measured ([`Session`](super::Session) and its parts) knows nothing of it.
//!
//! The way in: bytes → `document` (a tree that knows places) → `format_v1` (units, ranges, the robot) →
//! [`tables`](crate::tables) or inline columns → `assemble` (samples in inner units). The way out: `save`, whole or not at all, with the columns of
//! `saved_columns`.
//!
//! - `open`: files that a document names, and nothing else; `file_hash`: whether they are still the same.
//! - `hash`: the fingerprint of what was measured; `bundled`: sessions that are in the binary.

pub(crate) mod assemble;
#[doc(hidden)]
pub mod bundled;
mod file_hash;
#[doc(hidden)]
pub mod format_v1;
pub(crate) mod hash;
pub(crate) mod load;
pub(crate) mod load_robot;
#[doc(hidden)]
pub mod open;
pub(crate) mod save;
mod saved_columns;
#[cfg(test)]
mod watched;
