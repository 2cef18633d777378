//! A refusal of which nobody asks for more than its words.

use crate::diagnostic::Rejected;
use crate::text::Text;

/// Why something was refused.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal(pub Text);

impl Refusal {
    /// In words.
    pub fn describe(&self) -> Text {
        self.0.clone()
    }
}

displays_what_it_says!(Refusal);

impl std::error::Error for Refusal {}

impl From<Rejected> for Refusal {
    fn from(rejected: Rejected) -> Self {
        Self(rejected.describe())
    }
}
