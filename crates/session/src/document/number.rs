//! Decimal text to the nearest double, and text in messages.
//!
//! Not a number here: `nan`, `inf`, and anything that overflows. A missing value is an empty cell
//! and nothing else.

use crate::text::Template;

/// Why a text is not a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NotANumber {
    /// `nan`, `inf` and their relatives.
    NotFinite,
    /// Larger than the largest double.
    Overflow,
    /// Digits with a decimal comma.
    DecimalComma,
    /// Anything else.
    Garbage,
}

impl NotANumber {
    /// What should stand there.
    pub(crate) fn expected(self) -> Template {
        match self {
            Self::NotFinite => phrase!("a finite number, or an empty cell where it is missing"),
            Self::Overflow => phrase!("a number that a double can hold"),
            Self::DecimalComma => phrase!("a number with a decimal point"),
            Self::Garbage => phrase!("a number"),
        }
    }
}

/// The general way: any decimal number that fills the whole text, correctly rounded.
pub(crate) fn any_decimal(text: &str) -> Result<f64, NotANumber> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let numeric = unsigned.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) if numeric => Err(NotANumber::Overflow),
        Ok(_) => Err(NotANumber::NotFinite),
        Err(_) if numeric && is_decimal_comma(text) => Err(NotANumber::DecimalComma),
        Err(_) => Err(NotANumber::Garbage),
    }
}

fn is_decimal_comma(text: &str) -> bool {
    text.matches(',').count() == 1 && text.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// What is expected in place of a second one.
pub(crate) const ONCE: Template = phrase!("each once");

/// Bytes such as a hash's: two digits each.
pub fn hexadecimal(bytes: &[u8]) -> String {
    let digit = |half: u8| char::from(b"0123456789abcdef"[usize::from(half)]);
    let digits = bytes.iter().flat_map(|byte| [byte >> 4, byte & 15]);
    digits.map(digit).collect()
}

/// Text in a message: in quotes, without control characters, signs that cannot be seen by their number, and no longer
/// than a line can bear.
pub fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    let shown: String = text
        .chars()
        .take(LONGEST)
        .map(|c| match c {
            c if c.is_control() => "\u{fffd}".to_owned(),
            '\u{a0}'
            | '\u{ad}'
            | '\u{2000}'..='\u{200f}'
            | '\u{2028}'..='\u{202f}'
            | '\u{205f}'..='\u{206f}'
            | '\u{3000}'
            | '\u{feff}' => format!("<U+{:04X}>", u32::from(c)),
            c => c.to_string(),
        })
        .collect();
    let rest = if text.chars().nth(LONGEST).is_some() {
        "…"
    } else {
        ""
    };
    format!("'{shown}{rest}'")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_told_apart() {
        assert_eq!(any_decimal("nan"), Err(NotANumber::NotFinite));
        assert_eq!(any_decimal("-inf"), Err(NotANumber::NotFinite));
        assert_eq!(any_decimal("1e999"), Err(NotANumber::Overflow));
        assert_eq!(any_decimal("1,5"), Err(NotANumber::DecimalComma));
        assert_eq!(any_decimal("1.5mm"), Err(NotANumber::Garbage));
        assert_eq!(any_decimal(""), Err(NotANumber::Garbage));
        assert_eq!(any_decimal("1e-999"), Ok(0.0));
    }
}
