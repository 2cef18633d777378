//! Why there is no simulated session.

use crate::diagnostic::Rejected;

/// Why there is no session.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SimulateError {
    /// The scenario makes no sense.
    #[error("{0}")]
    Rejected(#[from] Rejected),
    /// The watcher cancelled.
    #[error("the simulation was stopped")]
    Stopped,
}
