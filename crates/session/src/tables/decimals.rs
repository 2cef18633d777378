//! Numbers with a decimal point or a decimal comma, and which of the two a file has.
//!
//! `1,5` can only have a decimal comma and `1.5` only a decimal point; `1.234,5` has groups of
//! thousands as well. `1,234` may be either, and a single cell cannot tell: all cells of all number
//! columns vote, and if none of them decides, the person is asked.

use crate::text::Template;
use std::fmt;

use crate::document::number::{NotANumber, any_decimal};

/// The sign between the whole part of a number and its fraction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decimal {
    /// 1.5
    Point,
    /// 1,5
    Comma,
}

impl Decimal {
    fn sign(self) -> u8 {
        match self {
            Self::Point => b'.',
            Self::Comma => b',',
        }
    }

    fn other(self) -> u8 {
        match self {
            Self::Point => b',',
            Self::Comma => b'.',
        }
    }

    /// What it is called.
    pub fn name(self) -> Template {
        match self {
            Self::Point => phrase!("decimal point"),
            Self::Comma => phrase!("decimal comma"),
        }
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.name(), f)
    }
}

/// What a cell says about the decimal sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// A whole number: nothing.
    Whole,
    /// A fraction behind this sign.
    Fraction(Decimal),
    /// A fraction behind this sign, or thousands: `1,234`.
    Either(Decimal),
    /// Thousands and perhaps a fraction, so that there is no doubt: `1.234,5`.
    Grouped(Decimal),
}

/// Splits off a sign; instruments write a minus sign as well as a hyphen.
fn unsigned(cell: &str) -> &str {
    cell.strip_prefix(['+', '-', '\u{2212}']).unwrap_or(cell)
}

/// Signs between thousands that are no decimal sign: spaces of all widths, apostrophes.
const BETWEEN_THOUSANDS: [char; 6] = [' ', '\u{a0}', '\u{2009}', '\u{202f}', '\'', '\u{2019}'];

/// The number without such signs, where they stand between thousands: `1'122,983`.
fn ungrouped(cell: &str) -> Option<String> {
    let sign = BETWEEN_THOUSANDS
        .into_iter()
        .find(|sign| cell.contains(*sign))?;
    let whole = unsigned(cell).split(['.', ',', 'e', 'E']).next()?;
    let inside = whole.matches(sign).count() == cell.matches(sign).count();
    let grouped = is_grouped(whole.replace(sign, ",").as_bytes(), b',');
    (inside && grouped).then(|| cell.replace(sign, ""))
}

/// What a cell looks like; `None` if it is no number.
pub(crate) fn shape(cell: &str) -> Option<Shape> {
    shape_of(cell).or_else(|| shape_of(&ungrouped(cell)?))
}

fn shape_of(cell: &str) -> Option<Shape> {
    let text = unsigned(cell);
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], Some(&text[at + 1..])),
        None => (text, None),
    };
    if let Some(exponent) = exponent {
        let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
        if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
    }
    let (mut points, mut commas, mut digits) = (0, 0, 0);
    for byte in mantissa.bytes() {
        match byte {
            b'0'..=b'9' => digits += 1,
            b'.' => points += 1,
            b',' => commas += 1,
            _ => return None,
        }
    }
    if digits == 0 {
        return None;
    }
    let grouped_by = |sign| exponent.is_none() && is_grouped(mantissa.as_bytes(), sign);
    Some(match (points, commas) {
        (0, 0) => Shape::Whole,
        (1, 0) if grouped_by(b'.') => Shape::Either(Decimal::Point),
        (1, 0) => Shape::Fraction(Decimal::Point),
        (0, 1) if grouped_by(b',') => Shape::Either(Decimal::Comma),
        (0, 1) => Shape::Fraction(Decimal::Comma),
        (0, _) if grouped_by(b',') => Shape::Grouped(Decimal::Point),
        (_, 0) if grouped_by(b'.') => Shape::Grouped(Decimal::Comma),
        _ => {
            let decimal = if mantissa.rfind('.') > mantissa.rfind(',') {
                Decimal::Point
            } else {
                Decimal::Comma
            };
            let (whole, fraction) = mantissa.split_at(mantissa.rfind(['.', ','])?);
            let clean = !fraction[1..].contains(['.', ',']);
            let grouped = clean && is_grouped(whole.as_bytes(), decimal.other());
            return grouped.then_some(Shape::Grouped(decimal));
        }
    })
}

/// Whether the digits stand in groups of thousands: `12,345,678`.
fn is_grouped(digits: &[u8], sign: u8) -> bool {
    let mut groups = digits.split(|byte| *byte == sign);
    let leads = groups
        .next()
        .is_some_and(|first| (1..=3).contains(&first.len()) && first[0] != b'0');
    let mut behind = 0;
    for group in groups {
        if group.len() != 3 || !group.iter().all(u8::is_ascii_digit) {
            return false;
        }
        behind += 1;
    }
    leads && behind > 0
}

pub(crate) fn value(cell: &str, decimal: Decimal) -> Result<f64, NotANumber> {
    value_of(cell, decimal).or_else(|why| match ungrouped(cell) {
        Some(plain) => value_of(&plain, decimal),
        None => Err(why),
    })
}

/// The number in a cell that is looked at alone: a comma is its decimal sign. NaN of what is none.
pub(crate) fn value_alone(cell: &str) -> f64 {
    let decimal = if cell.contains(',') {
        Decimal::Comma
    } else {
        Decimal::Point
    };
    value(cell, decimal).unwrap_or(f64::NAN)
}

fn value_of(cell: &str, decimal: Decimal) -> Result<f64, NotANumber> {
    let bytes = cell.as_bytes();
    let plain = bytes.is_ascii() && !bytes.contains(&b',');
    if plain && decimal == Decimal::Point {
        return any_decimal(cell);
    }
    let fits = match shape_of(cell) {
        // With the sign known, `1,234` is either a fraction or thousands.
        Some(Shape::Whole | Shape::Either(_)) => true,
        Some(Shape::Fraction(of) | Shape::Grouped(of)) => of == decimal,
        None => false,
    };
    if !fits {
        return match any_decimal(cell) {
            Ok(_) => Err(NotANumber::Garbage),
            Err(why) => Err(why),
        };
    }
    let plain: String = cell
        .chars()
        .filter(|c| *c != char::from(decimal.other()))
        .map(|c| match c {
            '\u{2212}' => '-',
            c if c == char::from(decimal.sign()) => '.',
            c => c,
        })
        .collect();
    any_decimal(&plain)
}

/// Where a cell stands and what is in it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Example {
    pub(crate) line: u64,
    pub(crate) column: usize,
    pub(crate) cell: String,
}

/// The first cell of each kind.
#[derive(Debug, Clone, Default)]
pub(crate) struct Votes {
    fraction: [Option<Example>; 2],
    either: [Option<Example>; 2],
    grouped: [Option<Example>; 2],
}

/// What the votes say.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Decision {
    Is(Decimal),
    /// Only a person can tell.
    Ask(Example),
    /// Both signs occur as decimal signs.
    Mixed(Example, Example),
}

impl Votes {
    /// Hears a cell.
    pub(crate) fn add(&mut self, cell: &str, line: u64, column: usize) {
        let (list, decimal) = match shape(cell) {
            Some(Shape::Fraction(decimal)) => (&mut self.fraction, decimal),
            Some(Shape::Either(decimal)) => (&mut self.either, decimal),
            Some(Shape::Grouped(decimal)) => (&mut self.grouped, decimal),
            Some(Shape::Whole) | None => return,
        };
        list[decimal as usize].get_or_insert_with(|| Example {
            line,
            column,
            cell: cell.to_owned(),
        });
    }

    /// Whether a comma stands for a decimal sign or for thousands somewhere.
    pub(crate) fn decide(&self) -> Decision {
        let sure = |decimal: Decimal| {
            let index = decimal as usize;
            self.fraction[index]
                .as_ref()
                .or(self.grouped[index].as_ref())
        };
        let either = |decimal: Decimal| self.either[decimal as usize].as_ref();
        let groups = |decimal: Decimal| self.grouped[decimal as usize].is_some();
        match (sure(Decimal::Point), sure(Decimal::Comma)) {
            (Some(point), Some(comma)) => Decision::Mixed(point.clone(), comma.clone()),
            // 12.5 beside 1,234: thousands only if thousands occur for certain somewhere.
            (Some(_), None) => match either(Decimal::Comma) {
                Some(doubtful) if !groups(Decimal::Point) => Decision::Ask(doubtful.clone()),
                _ => Decision::Is(Decimal::Point),
            },
            (None, Some(comma)) => match either(Decimal::Point) {
                Some(point) if !groups(Decimal::Comma) => {
                    Decision::Mixed(point.clone(), comma.clone())
                }
                _ => Decision::Is(Decimal::Comma),
            },
            (None, None) => match (either(Decimal::Point), either(Decimal::Comma)) {
                (Some(point), Some(comma)) => Decision::Mixed(point.clone(), comma.clone()),
                (None, Some(comma)) => Decision::Ask(comma.clone()),
                _ => Decision::Is(Decimal::Point),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn decide(cells: &[&str]) -> Decision {
        let mut votes = Votes::default();
        for (line, cell) in (1..).zip(cells) {
            votes.add(cell, line, 1);
        }
        votes.decide()
    }

    #[test]
    fn whole_columns_decide_what_a_single_cell_cannot() {
        let is = |cells, decimal| assert_eq!(decide(cells), Decision::Is(decimal), "{cells:?}");
        is(&["1,234", "0,5"], Decimal::Comma);
        is(&["1,234", "0,234"], Decimal::Comma);
        is(&["1,234", "1234,567"], Decimal::Comma);
        is(&["1.234", "1.234,5"], Decimal::Comma);
        is(&["1,234", "1,234.5"], Decimal::Point);
        is(&["1,234,567", "1.5", "1,234"], Decimal::Point);
        is(&["1.234", "12"], Decimal::Point);
        is(&["12", "name", ""], Decimal::Point);
    }

    #[test]
    fn what_stays_ambiguous_is_asked_and_what_contradicts_is_shown() {
        for cells in [&["1,234", "12"][..], &["-1,234"], &["12.5", "1,234"]] {
            assert!(matches!(decide(cells), Decision::Ask(_)), "{cells:?}");
        }
        for cells in [&["1.5", "1,5"][..], &["1.234", "1,5"], &["1.234", "1,234"]] {
            assert!(matches!(decide(cells), Decision::Mixed(..)), "{cells:?}");
        }
    }

    #[test]
    fn a_cell_is_read_as_its_file_is() {
        assert_eq!(value("1,234", Decimal::Comma), Ok(1.234));
        assert_eq!(value("1,234", Decimal::Point), Ok(1234.0));
        assert_eq!(value("1.234,5", Decimal::Comma), Ok(1234.5));
        assert_eq!(value("\u{2212}2,5e-3", Decimal::Comma), Ok(-2.5e-3));
        assert_eq!(value("\u{2212}2.5", Decimal::Point), Ok(-2.5));
        assert_eq!(value("1,5", Decimal::Point), Err(NotANumber::DecimalComma));
        assert_eq!(value("1.5", Decimal::Comma), Err(NotANumber::Garbage));
        for sign in BETWEEN_THOUSANDS {
            let cell = format!("-1{sign}122,983");
            assert_eq!(value(&cell, Decimal::Comma), Ok(-1122.983), "{sign:?}");
            assert_eq!(shape(&cell), Some(Shape::Fraction(Decimal::Comma)));
            assert_eq!(
                value(&format!("1{sign}12.5"), Decimal::Point),
                Err(NotANumber::Garbage)
            );
        }
        assert_eq!(value("1,2,3", Decimal::Comma), Err(NotANumber::Garbage));
        assert_eq!(value("nan", Decimal::Comma), Err(NotANumber::NotFinite));
    }

    proptest! {
        #[test]
        fn a_number_comes_back_from_a_decimal_comma_to_the_last_bit(number in -1e9..1e9f64) {
            let text = format!("{number:?}").replace('.', ",");
            prop_assert_eq!(value(&text, Decimal::Comma).map(f64::to_bits), Ok(number.to_bits()));
        }

        #[test]
        fn any_text_is_a_number_or_not(text in "[-+0-9.,eE−]{0,12}") {
            let _ = (shape(&text), value(&text, Decimal::Comma), value(&text, Decimal::Point));
        }
    }
}
