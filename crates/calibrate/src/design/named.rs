//! An effect by its name, on a joint or on any.

use crate::effects::find;

/// One of the two: a name and a joint counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Named {
    /// The effect's name.
    pub id: &'static str,
    /// Its joint.
    pub joint: usize,
}

impl Named {
    /// Whether the joint matters.
    pub fn per_joint(&self) -> bool {
        find(self.id).is_some_and(|e| e.about().per_joint)
    }
}
