//! Complaints about the rows and cells of one file: the first ones in full, the others counted.

use crate::diagnostic::{Diagnostic, Place};
use crate::text::Text;

/// What is wrong so far.
#[derive(Debug)]
pub(crate) struct Complaints {
    pub(crate) findings: Vec<Diagnostic>,
    most: usize,
    more: usize,
}

impl Default for Complaints {
    /// As many as a person reads of an instrument's file.
    fn default() -> Self {
        Self::of_at_most(20)
    }
}

impl Complaints {
    pub(crate) fn of_at_most(most: usize) -> Self {
        Self {
            findings: Vec::new(),
            most,
            more: 0,
        }
    }

    pub(crate) fn add(&mut self, complaint: impl FnOnce() -> Diagnostic) {
        if self.findings.len() < self.most {
            self.findings.push(complaint());
        } else {
            self.more += 1;
        }
    }

    /// Passes them on, and says how many more there are.
    pub(crate) fn into(self, file: &Place, findings: &mut Vec<Diagnostic>) {
        findings.extend(self.findings);
        if self.more > 0 {
            let found = more_like_these(self.more);
            findings.push(Diagnostic::error(file.clone(), found, Text::default()));
        }
    }
}

/// How many more problems there are than those that were said.
pub(crate) fn more_like_these(more: usize) -> Text {
    text!(one "{count} more problem of this kind", "{count} more problems of this kind", count = more)
}
