//! The workspace: sectors, nominal path, measured points, error vectors.

mod handles;
mod layers;
mod layout;
mod legend;
mod model;
mod paint;
mod scales;
mod toolbar;

pub(crate) use layout::nearest;
pub(crate) use paint::{hover, marked, show};
pub(crate) use toolbar::show as bar;
