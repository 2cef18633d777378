//! What is charted below the workspace.

/// What is charted below the workspace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Chart {
    /// The deviation over the value of a joint.
    Angle,
    /// Over time.
    Time,
    /// Over the load.
    Load,
    /// Over the temperature.
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
    /// All of them, in the order in which they are offered.
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

    /// Its name where there is little room.
    pub(crate) fn short(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Time => "time",
            Self::Load => "load",
            Self::Temperature => "temperature",
            Self::Orders => "orders",
            Self::Histogram => "histogram",
            Self::Gap => "gap",
            Self::Effect => "effect",
            Self::Table => "table",
        }
    }

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Angle => "Deviation over angle",
            Self::Time => "Deviation over time",
            Self::Load => "Deviation over load",
            Self::Temperature => "Deviation over temperature",
            Self::Orders => "Order spectrum",
            Self::Histogram => "Histogram",
            Self::Gap => "Gap by step",
            Self::Effect => "Effect's own curve",
            Self::Table => "Correction table",
        }
    }

    /// Whether it shows one component of the deviation.
    pub(crate) fn has_components(self) -> bool {
        !matches!(self, Self::Gap | Self::Table)
    }
}
