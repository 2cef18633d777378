//! What an identification and a diagnosis answer: types with their meaning, and nothing that is
//! computed from samples. Terminal, window, report and exports read these; [`crate::fit`] and
//! [`crate::diagnosis`] fill them.

pub mod diagnosis;
pub mod errors;
pub mod identification;
pub mod limits;
pub mod noise;
pub mod pose;
