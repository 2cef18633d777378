//! What is worked out once, in the background, so that no frame looks at all samples.

pub(crate) mod backdrop;
pub(crate) mod charts;
pub(crate) mod cloud;
pub(crate) mod figures;
pub(crate) mod heat;
pub(crate) mod nearest;
pub(crate) mod outcome;
pub(crate) mod preview;
pub(crate) mod thinning;
