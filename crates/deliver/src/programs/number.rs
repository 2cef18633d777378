//! Numbers as they stand in a file, and as they are written back.

use std::num::NonZero;
use std::ops::Range;

use crate::text::Template;

/// A place in a file of at most 4 GiB.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Span {
    start: u32,
    end: u32,
}

impl Span {
    /// `None` beyond 4 GiB.
    pub(super) fn of(range: &Range<usize>) -> Option<Self> {
        Some(Self {
            start: u32::try_from(range.start).ok()?,
            end: u32::try_from(range.end).ok()?,
        })
    }

    pub(super) fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A number in a file; a long program has millions of them, so that it is small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    /// Its value, in the file's unit.
    pub value: f64,
    span: Span,
    detached_digits: Option<NonZero<u32>>,
    decimals: u8,
    comma: bool,
}

/// What was expected of bytes that do not look like a number.
const A_NUMBER: Template = phrase!("a number");
/// What was expected of one that overflows.
const SMALLER: Template = phrase!("a number that is not larger than any machine");

/// Digits that a pose carries at most; more are rounding.
const MOST_DECIMALS: usize = 15;

impl Number {
    /// Reads `[+-]digits[.digits][e±digits]`; with `comma` the decimal sign is a comma.
    pub(super) fn read(bytes: &[u8], range: Range<usize>, comma: bool) -> Result<Self, Template> {
        let text = &bytes[range.clone()];
        let signed = matches!(text.first(), Some(b'+' | b'-'));
        // A sign may stand off its digits.
        let behind = &text[usize::from(signed)..];
        let digits = behind.trim_ascii_start();
        let apart = (digits.len() < behind.len()).then(|| range.end - digits.len());
        let sign = if comma { b',' } else { b'.' };
        let begins = (digits.first()).is_some_and(|b| b.is_ascii_digit() || *b == sign);
        let belongs = |b: &u8| b.is_ascii_digit() || *b == sign || b"eE+-".contains(b);
        if !begins || !digits.iter().all(belongs) {
            return Err(A_NUMBER);
        }
        let plain = digits
            .iter()
            .map(|b| if *b == sign { '.' } else { char::from(*b) });
        let value: f64 = (plain.collect::<String>().parse()).map_err(|_| A_NUMBER)?;
        if !value.is_finite() {
            return Err(SMALLER);
        }
        let power = digits.iter().any(|b| matches!(b, b'e' | b'E'));
        let decimals = digits.iter().rev().position(|b| *b == sign);
        Ok(Self {
            value: if text.first() == Some(&b'-') {
                -value
            } else {
                value
            },
            span: Span::of(&range).ok_or(SMALLER)?,
            // It is before the end, which has a place.
            detached_digits: apart.and_then(|at| NonZero::new(u32::try_from(at).ok()?)),
            decimals: u8::try_from(decimals.filter(|_| !power).unwrap_or(0)).unwrap_or(u8::MAX),
            comma,
        })
    }

    /// Its bytes, sign included.
    pub fn range(&self) -> Range<usize> {
        self.span.range()
    }

    pub(super) fn span(&self) -> Span {
        self.span
    }

    /// Where its digits begin, if they stand off its sign.
    pub fn detached_digits(&self) -> Option<usize> {
        self.detached_digits.map(|at| at.get() as usize)
    }

    /// How another value is written in its place: with the digits that it had, at least `least`
    /// behind the point. The same value stays as it was, byte for byte.
    pub(super) fn written(&self, value: f64, least: usize) -> Option<String> {
        let decimals = usize::from(self.decimals).max(least).min(MOST_DECIMALS);
        let half = 0.5 * 10.0_f64.powi(-i32::try_from(decimals).unwrap_or(0));
        if (value - self.value).abs() < half {
            return None;
        }
        let mut text = format!("{value:.decimals$}");
        // Rounded to nothing it has no sign.
        if text.starts_with('-') && text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.')) {
            text.remove(0);
        }
        Some(if self.comma {
            text.replace('.', ",")
        } else {
            text
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, comma: bool) -> Result<(f64, usize), Template> {
        let number = Number::read(text.as_bytes(), 0..text.len(), comma)?;
        Ok((number.value, usize::from(number.decimals)))
    }

    #[test]
    fn numbers_of_every_maker_are_read_and_nothing_else() {
        assert_eq!(read("-.384", false), Ok((-0.384, 3)));
        assert_eq!(read("9E+09", false), Ok((9e9, 0)));
        assert_eq!(read("+1.", false), Ok((1.0, 0)));
        assert_eq!(read("- 5", false), Ok((-5.0, 0)));
        assert_eq!(read("1,25", true), Ok((1.25, 2)));
        for bad in [
            "", "-", ".", "1.2.3", "nan", "inf", "0x10", "1e", "1,2", "--1", "1e+-2",
        ] {
            assert_eq!(read(bad, false), Err(A_NUMBER), "{bad}");
        }
        assert_eq!(read("1e999", false), Err(SMALLER));
    }

    #[test]
    fn digits_that_stand_off_their_sign_say_where_they_begin() {
        let text = b"x - \r5.25";
        let number = Number::read(text, 2..9, false).unwrap();
        assert_eq!((number.value, number.detached_digits()), (-5.25, Some(5)));
        assert_eq!(
            Number::read(b"-5", 0..2, false).unwrap().detached_digits(),
            None
        );
    }

    #[test]
    fn a_value_is_written_with_the_files_digits_or_more() {
        let number = |text: &str| Number::read(text.as_bytes(), 0..text.len(), false).unwrap();
        assert_eq!(
            number("10.00").written(10.123_456_78, 5).unwrap(),
            "10.12346"
        );
        assert_eq!(number("1.12345678").written(2.0, 5).unwrap(), "2.00000000");
        assert_eq!(number("10.0").written(10.000_000_1, 5), None);
        assert_eq!(number("0.5").written(-1e-9, 5).unwrap(), "0.00000");
        let comma = Number::read(b"1,5", 0..3, true).unwrap();
        assert_eq!(comma.written(-1.25, 3).unwrap(), "-1,250");
    }
}
