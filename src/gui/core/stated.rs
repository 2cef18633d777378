//! Report details as they stand in the window: the logo is a path until a report is written.

use std::path::Path;

use crate::report::{Details, Logo};
use crate::text::spoken;

#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Stated {
    /// The texts and the rule; the tolerance is the document's, and the one from last time here.
    pub(crate) details: Details,
    /// Path of the logo, as it is typed; may be empty.
    pub(crate) logo: String,
    /// Whether the report leaves out what became of the machine.
    pub(crate) without_history: bool,
}

impl Stated {
    /// What a report is written with.
    ///
    /// # Errors
    /// If the logo cannot be used.
    pub(crate) fn complete(&self) -> Result<Details, String> {
        let path = self.logo.trim();
        let logo = (!path.is_empty()).then(|| {
            let read = Logo::read(Path::new(path));
            read.map_err(|found| {
                say!(
                    "Logo {found}; expected {expected}",
                    found = crate::language::spoken(&found),
                    expected = spoken(Logo::EXPECTED)
                )
            })
        });
        Ok(Details {
            logo: logo.transpose()?,
            // The document's counts.
            tolerance_mm: None,
            ..self.details.clone()
        })
    }
}
