//! The workspace: sectors, nominal path, measured points, error vectors.

mod handles;
mod layout;
mod model;
mod paint;

pub(crate) use paint::show;
