//! Which conditions a plan varies.

/// What a technician can vary.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Varied {
    /// The test load, kg; none: the load stays as it is.
    pub(crate) load_kg: Option<f64>,
    /// Whether the machine is measured cold and warm.
    pub(crate) heats: bool,
    /// Whether speeds are written down.
    pub(crate) speeds: bool,
}
