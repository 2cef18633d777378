//! What the one who hands a report out adds to it.

use super::details::Details;
use super::exported::ExportedTable;

/// What a report holds besides its session or model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Extras {
    /// What the certificate states besides its measurements.
    pub details: Details,
    /// Tables that were written for the controller.
    pub tables: Vec<ExportedTable>,
}
