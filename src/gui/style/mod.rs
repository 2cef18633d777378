//! How the window looks: colour, spacing and type, letters of the machine's fonts, how it is divided.

pub(crate) mod font_fallback;
pub(crate) mod layout;
pub(crate) mod tokens;
#[cfg(test)]
pub(crate) mod vision;
