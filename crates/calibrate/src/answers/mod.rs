//! The types of an identification and a diagnosis, with their meaning, and nothing that is computed from samples.
//! Terminal, window, report and exports read these; [`crate::fit`] and [`crate::diagnosis`] fill them.

#[doc(hidden)]
pub mod diagnosis;
pub(crate) mod errors;
pub(crate) mod far_tool;
#[doc(hidden)]
pub mod identification;
pub(crate) mod limits;
mod many_set_aside;
#[doc(hidden)]
pub mod noise;
pub(crate) mod pose;
pub(crate) mod rms_error;
