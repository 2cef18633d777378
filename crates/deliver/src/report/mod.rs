//! The calibration report that a customer signs: what was measured, what was found and how sure
//! that is, what it brings, what stays open.
//!
//! A [`Report`] is built once, from what is known of a session ([`Report::of_session`]) or from a
//! model file ([`Report::of_model`]), and rendered by [`html`](fn@html) or [`pdf`](fn@pdf):
//! both say the same. The same input gives the same bytes; there is no clock, the date is typed or a line to fill in.
//!
//! - [`document`]: sections and blocks. `session`, `findings`, `stages`,
//!   `calibration`, `accuracy`, `parts`: what goes in.
//! - [`plots`] are drawings ([`crate::present::drawing`]), [`svg`](mod@svg) writes them.
//! - [`html`](mod@html), [`pdf`](mod@pdf): the formats.
//! - [`details`]: customer, serial numbers, tolerance and decision rule.
//! - [`exported`]: tables that were written for a controller, by their hashes.

pub mod details;
pub mod document;
pub mod exported;
pub mod html;
pub mod pdf;
pub mod plots;
pub mod svg;

mod accuracy;
mod calibration;
mod error;
mod escape;
mod extras;
mod findings;
mod fonts;
mod logo;
mod parts;
mod pdf_error;
mod session;
mod stages;

pub use details::Details;
pub use document::Report;
pub use error::ReportError;
pub use exported::ExportedTable;
pub use extras::Extras;
pub use html::html;
pub use logo::Logo;
pub use pdf::{PdfError, Written, pdf};
pub use session::Evidence;
pub use stages::{as_measured, stages};

use std::collections::BTreeSet;
use std::path::Path;

use crate::text::Template;

/// What a report is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// One HTML file that needs nothing else.
    Html,
    /// PDF on A4.
    Pdf,
}

impl Kind {
    /// What a file of this name is.
    ///
    /// # Errors
    /// What was expected, where its ending is another.
    pub fn of(path: &Path) -> Result<Self, Template> {
        let ending = path.extension().and_then(|ending| ending.to_str());
        match ending.map(str::to_ascii_lowercase).as_deref() {
            Some("html" | "htm") => Ok(Self::Html),
            Some("pdf") => Ok(Self::Pdf),
            _ => Err(phrase!("expected a file name that ends in .html or .pdf")),
        }
    }
}

impl Report {
    /// The bytes of a file of this kind.
    ///
    /// # Errors
    /// If a font cannot be used.
    pub fn written(&self, kind: Kind) -> Result<Written, PdfError> {
        match kind {
            Kind::Html => Ok(Written {
                bytes: html(self).into_bytes(),
                unshown: BTreeSet::new(),
            }),
            Kind::Pdf => pdf(self),
        }
    }
}
