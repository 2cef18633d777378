//! Why there is no PDF.

/// Why there is no PDF.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PdfError {
    /// A font is damaged.
    #[error("the font {0} cannot be used")]
    Font(String),
}
