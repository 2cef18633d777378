//! What is worked out once, in the background, so that no frame looks at all samples.

pub(crate) mod charts;
pub(crate) mod cloud;
pub(crate) mod heat;
pub(crate) mod identified;
pub(crate) mod plot_cache;
pub(crate) mod projected;
pub(crate) mod uncertain;
