//! What is charted below the workspace.

/// What is charted below the workspace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Chart {
    /// The deviation over the value of a joint.
    Angle,
    Time,
    Load,
    Temperature,
    /// How large the deviation is at each whole number of cycles per turn.
    Orders,
    /// How many samples deviate by how much.
    Histogram,
    /// The gap, step by step.
    Gap,
    /// What a found effect does, through what is left without it.
    Effect,
    /// The table that is exported.
    Table,
}

impl Chart {
    #[cfg(test)]
    pub(crate) const ALL: [Self; 9] = [
        Self::Angle,
        Self::Time,
        Self::Load,
        Self::Temperature,
        Self::Orders,
        Self::Histogram,
        Self::Gap,
        Self::Effect,
        Self::Table,
    ];
}
