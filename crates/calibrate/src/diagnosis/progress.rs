//! The progress of a diagnosis, and its cancellation.

/// The progress of the diagnosis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Progress {
    /// Looking for set-up errors.
    Checking,
    /// Fitting the base, preparing the candidates.
    Preparing,
    /// Searching; what was found so far may still be exchanged for something likelier.
    Searching {
        /// Names of the effects so far, in the order in which they act, of several joints each with
        /// its joint.
        found: Vec<String>,
        /// Share of the most that a search may cost, percent; it may end at any.
        percent: u8,
    },
    /// Comparing with other explanations.
    Comparing,
    /// Looking for poses to measure next.
    Planning,
}

/// Receives the progress; returns whether to go on.
pub type Watch<'a> = &'a dyn Fn(&Progress) -> bool;

/// The watcher asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cancelled;
