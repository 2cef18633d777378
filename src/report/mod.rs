//! The calibration report that a customer signs: what was measured, what was found and how sure
//! that is, what it brings, what stays open.
//!
//! A [`Report`] is built once, from a session ([`Report::of_session`], which runs the diagnosis) or
//! from a model file ([`Report::of_model`]), and rendered by [`html`](fn@html) or [`pdf`](fn@pdf):
//! both say the same. The same input gives the same bytes; there is no clock, the date is a line to fill in.
//!
//! - [`document`]: sections and blocks. `session`, `findings`, `stages`,
//!   `calibration`, `accuracy`, `parts`: what goes in.
//! - [`plots`] are drawings ([`crate::present::drawing`]), [`svg`](mod@svg) writes them.
//! - [`html`](mod@html), [`pdf`](mod@pdf): the formats.
//! - [`exported`]: tables that were written for a controller, by their hashes.

pub mod document;
pub mod exported;
pub mod html;
pub mod pdf;
pub mod plots;
pub mod svg;

mod accuracy;
mod calibration;
mod findings;
mod numbers;
mod parts;
mod session;
mod stages;

pub use document::Report;
pub use exported::{ExportedTable, TableFileError};
pub use html::html;
pub use pdf::{PdfError, Written, pdf, pdf_with};
pub use stages::{as_measured, stages};

use crate::compensation::verification::VerifyError;
use crate::diagnosis::DiagnoseError;

/// What a report holds besides its session or model.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Extras {
    /// The date as it is to be printed; without it there is a line to fill in.
    pub date: Option<String>,
    /// Tables that were written for the controller.
    pub tables: Vec<ExportedTable>,
}

/// Why there is no report.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReportError {
    /// The session cannot be diagnosed.
    #[error(transparent)]
    Diagnose(#[from] DiagnoseError),
    /// The model cannot be held against the session.
    #[error(transparent)]
    Verify(#[from] VerifyError),
}
