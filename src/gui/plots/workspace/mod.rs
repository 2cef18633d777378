//! The workspace: sectors, nominal path, measured points, error vectors.

mod handles;
mod layout;
mod legend;
mod model;
mod paint;

pub(crate) use layout::nearest;
pub(crate) use model::{reach, readable};
pub(crate) use paint::{hover, show};
