//! Numbers as the screen shows them: in the units that the user chose, with a real minus sign,
//! and with no more digits than can be read.

use std::cell::Cell;

use crate::fit::Estimate;
use crate::units::{deg_from_rad, rad_from_deg};

use serde::{Deserialize, Serialize};

/// Unit of lengths on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum LengthUnit {
    #[default]
    Millimetre,
    Micrometre,
    Inch,
}

/// Unit of angles on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum AngleUnit {
    #[default]
    Degree,
    Radian,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Units {
    pub(crate) length: LengthUnit,
    pub(crate) angle: AngleUnit,
}

/// How numbers are written everywhere on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Notation {
    /// Decimals of lengths; `None`: as many as can be read.
    pub(crate) decimals: Option<u8>,
    /// Whether decimals follow a comma.
    pub(crate) comma: bool,
}

thread_local! {
    /// The window is drawn by one thread; it sets this once a frame and nobody else does.
    static NOTATION: Cell<Notation> = const { Cell::new(Notation { decimals: None, comma: false }) };
}

/// Writes numbers like this from now on, on this thread.
pub(crate) fn write_numbers(notation: Notation) {
    NOTATION.set(notation);
}

/// A number as it was typed: with a point or a comma, and any minus sign.
pub(crate) fn typed(text: &str) -> Option<f64> {
    let text: String = text
        .chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| match c {
            '−' => '-',
            ',' => '.',
            other => other,
        })
        .collect();
    text.parse().ok().filter(|value: &f64| value.is_finite())
}

/// What is left of rounding.
const NOTHING: f64 = 1e-9;
const MM_PER_INCH: f64 = 25.4;

impl Units {
    /// A length in the chosen unit.
    pub(crate) fn length_value(self, mm: f64) -> f64 {
        match self.length {
            LengthUnit::Millimetre => mm,
            LengthUnit::Micrometre => mm * 1000.0,
            LengthUnit::Inch => mm / MM_PER_INCH,
        }
    }

    /// The unit of lengths.
    pub(crate) fn length_name(self) -> &'static str {
        match self.length {
            LengthUnit::Millimetre => "mm",
            LengthUnit::Micrometre => "µm",
            LengthUnit::Inch => "in",
        }
    }

    /// An angle in the chosen unit.
    pub(crate) fn angle_value(self, rad: f64) -> f64 {
        match self.angle {
            AngleUnit::Degree => deg_from_rad(rad),
            AngleUnit::Radian => rad,
        }
    }

    /// The unit of angles, as it stands after a number.
    pub(crate) fn angle_name(self) -> &'static str {
        match self.angle {
            AngleUnit::Degree => "°",
            AngleUnit::Radian => " rad",
        }
    }

    pub(crate) fn length(self, mm: f64) -> String {
        format!("{} {}", self.length_number(mm), self.length_name())
    }

    /// The same without the unit.
    pub(crate) fn length_number(self, mm: f64) -> String {
        let value = self.length_value(mm);
        match NOTATION.get().decimals {
            Some(decimals) if value.is_finite() => {
                with_minus(&format!("{value:.*}", usize::from(decimals)))
            }
            _ => significant(value, 3),
        }
    }

    /// The same with as many decimals as a number like this one has: for a column of a table.
    pub(crate) fn length_like(self, mm: f64, like_mm: f64) -> String {
        if NOTATION.get().decimals.is_some() || !mm.is_finite() {
            return self.length_number(mm);
        }
        let like = self.length_value(like_mm).abs();
        let magnitude = if like > NOTHING {
            like.log10().floor()
        } else {
            0.0
        };
        let decimals = whole(2.0 - magnitude).min(9);
        with_minus(&format!("{:.decimals$}", self.length_value(mm)))
    }

    /// A value in `unit` with its interval, in the chosen unit where `unit` is one of lengths or angles.
    pub(crate) fn with_interval(
        self,
        value: f64,
        interval: Option<[f64; 2]>,
        unit: &'static str,
    ) -> (String, String, &'static str) {
        let (factor, unit) = match unit {
            "mm" => (self.length_value(1.0), self.length_name()),
            "°" => (
                self.angle_value(rad_from_deg(1.0)),
                self.angle_name().trim(),
            ),
            other => (1.0, other),
        };
        let interval = interval.map(|ends| ends.map(|end| factor * end));
        let (value, half) = with_interval(factor * value, interval);
        (value, half, unit)
    }

    /// A parameter with half of its interval, and the name of its unit; a whole number has no
    /// interval.
    pub(crate) fn estimate(
        self,
        one: &Estimate,
        unit: &'static str,
    ) -> (String, String, &'static str) {
        if one.is_whole_number() {
            return (trimmed(one.value, 0), String::new(), unit);
        }
        self.with_interval(one.value, one.ci95, unit)
    }

    pub(crate) fn angle(self, rad: f64) -> String {
        match self.angle {
            AngleUnit::Degree => format!("{}°", trimmed(deg_from_rad(rad), 2)),
            AngleUnit::Radian => format!("{} rad", trimmed(rad, 4)),
        }
    }
}

/// So many significant digits, in plain notation where that is short; a real minus sign.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value.abs() < NOTHING {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-5.0..9.0).contains(&magnitude) {
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        let (lead, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}·10{}", with_minus(lead), raised(exponent));
    }
    let decimals = whole(digits as f64 - 1.0 - magnitude);
    with_minus(&format!("{value:.decimals$}"))
}

/// At most so many decimals, without zeros at the end.
pub(crate) fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    with_minus(if text == "-0" { "0" } else { text })
}

/// A value with its half width, rounded to two digits of it: `−3.012 ± 0.014`.
fn with_interval(value: f64, interval: Option<[f64; 2]>) -> (String, String) {
    let half = interval.map(|[from, to]| 0.5 * (to - from));
    match half {
        Some(half) if half.is_finite() && half > 1e-9 * value.abs().max(1e-3) => {
            let decimals = whole((1.0 - half.log10().floor()).min(9.0));
            (
                with_minus(&format!("{value:.decimals$}")),
                format!("± {}", with_minus(&format!("{half:.decimals$}"))),
            )
        }
        Some(_) => (significant(value, 6), "± 0".to_owned()),
        None => (significant(value, 6), "not determined".to_owned()),
    }
}

/// A count, from 10 000 on in groups of three digits with a narrow space between them.
pub(crate) fn grouped(count: usize) -> String {
    let digits = count.to_string();
    if digits.len() < 5 {
        return digits;
    }
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push('\u{202F}');
        }
        text.push(digit);
    }
    text
}

/// `1 sample`, `2 samples`.
pub(crate) fn number_of(count: usize, what: &str) -> String {
    let s = if count == 1 { "" } else { "s" };
    format!("{} {what}{s}", grouped(count))
}

/// A text that goes into files as well, with real minus signs before its numbers.
pub(crate) fn with_minus_signs(text: &str) -> String {
    let mut before = ' ';
    let mut letters = text.chars().peekable();
    let mut out = String::with_capacity(text.len());
    while let Some(letter) = letters.next() {
        let number = letters
            .peek()
            .is_some_and(|c| c.is_ascii_digit() || *c == '.');
        let begins = !(before.is_alphanumeric() || before == '-' || before == '_');
        out.push(if letter == '-' && begins && number {
            '−'
        } else {
            letter
        });
        before = letter;
    }
    out
}

/// A small number that is whole already, or zero where it is below.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to what a count of digits or of pieces can be"
)]
pub(crate) fn whole(value: f64) -> usize {
    value.clamp(0.0, 1e6) as usize
}

/// Digits and sign as an exponent.
fn raised(exponent: &str) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |c: char| match c.to_digit(10) {
        Some(digit) => DIGITS[digit as usize],
        None => '⁻',
    };
    exponent.chars().map(raise).collect()
}

/// A number for a spreadsheet: every digit, an ASCII minus sign, the decimal sign that the user
/// chose; nothing where it is not finite.
pub(crate) fn plain_number(value: f64) -> String {
    if !value.is_finite() {
        return String::new();
    }
    let text = format!("{value}");
    if NOTATION.get().comma {
        text.replace('.', ",")
    } else {
        text
    }
}

/// A user's text as one cell of a table with tabs; a spreadsheet must not take it for a formula.
pub(crate) fn cell(text: &str) -> String {
    let text: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if text.starts_with(['=', '+', '-', '@']) {
        format!("'{text}")
    } else {
        text
    }
}

fn with_minus(text: &str) -> String {
    let text = text.replace('-', "−");
    if NOTATION.get().comma {
        text.replace('.', ",")
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_can_be_read() {
        assert_eq!(significant(13.8436, 3), "13.8");
        assert_eq!(significant(-0.05234, 3), "−0.0523");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(significant(f64::NAN, 3), "–");
        assert_eq!(significant(2.5e-7, 3), "2.50·10⁻⁷");
        assert_eq!(significant(2.5e-13, 3), "0");
        assert_eq!(trimmed(-0.0001, 2), "0");
        assert_eq!(trimmed(36.50, 2), "36.5");
    }

    #[test]
    fn a_value_and_its_interval_follow_the_chosen_units_and_the_decimal_sign() {
        let units = Units {
            length: LengthUnit::Micrometre,
            angle: AngleUnit::Radian,
        };
        let shown = |value, half: f64, unit| {
            let (value, half, unit) =
                units.with_interval(value, Some([value - half, value + half]), unit);
            format!("{value} {half} {unit}")
        };
        assert_eq!(shown(-1.3964, 0.0042, "mm"), "−1396.4 ± 4.2 µm");
        assert_eq!(shown(180.0, 18.0, "°"), "3.14 ± 0.31 rad");
        assert_eq!(
            shown(47.9, 1.2, "ppm"),
            "47.9 ± 1.2 ppm",
            "no length, no angle"
        );
        write_numbers(Notation {
            comma: true,
            ..Notation::default()
        });
        assert_eq!(shown(0.0501, 0.0012, "s"), "0,0501 ± 0,0012 s");
        write_numbers(Notation::default());
    }

    #[test]
    fn counts_are_grouped_and_agree_with_what_is_counted() {
        assert_eq!(number_of(1, "region"), "1 region");
        assert_eq!(number_of(0, "sample"), "0 samples");
        assert_eq!(number_of(9999, "sample"), "9999 samples");
        assert_eq!(grouped(36_002), "36\u{202F}002");
        assert_eq!(grouped(1_000_008), "1\u{202F}000\u{202F}008");
    }

    #[test]
    fn a_sentence_has_minus_signs_before_numbers_and_hyphens_in_words() {
        let says = "at -90.0° (no-load, 2026-01-02, ISO 230-2) add -.5, J-1: x_-3";
        let shown = "at −90.0° (no-load, 2026-01-02, ISO 230-2) add −.5, J-1: x_-3";
        assert_eq!(with_minus_signs(says), shown);
    }

    #[test]
    fn an_interval_decides_how_many_digits_a_value_has() {
        let (value, half) = with_interval(-3.01234567, Some([-3.026, -2.998]));
        assert_eq!((value.as_str(), half.as_str()), ("−3.012", "± 0.014"));
        assert_eq!(with_interval(1.5, None).1, "not determined");
    }

    #[test]
    fn numbers_are_written_as_the_user_wants_them() {
        let units = Units::default();
        write_numbers(Notation {
            decimals: Some(4),
            comma: true,
        });
        assert_eq!(units.length(-0.05234), "−0,0523 mm");
        assert_eq!(units.length(13.0), "13,0000 mm");
        assert_eq!(significant(13.8436, 3), "13,8");
        write_numbers(Notation::default());
        assert_eq!(units.length(-0.05234), "−0.0523 mm");
    }

    #[test]
    fn numbers_of_a_column_have_the_same_decimals() {
        let units = Units::default();
        let column = [0.0195, 0.00958, 0.1].map(|mm| units.length_like(mm, 0.0533));
        assert_eq!(column, ["0.0195", "0.0096", "0.1000"]);
        assert_eq!(units.length_like(-2.5, 0.0), "−2.50");
        assert_eq!(units.length_like(f64::NAN, 1.0), "–");
    }

    #[test]
    fn a_number_may_be_typed_with_a_point_or_a_comma() {
        assert_eq!(typed(" −1,5 "), Some(-1.5));
        assert_eq!(typed("2.25"), Some(2.25));
        for no in ["", "1.2.3", "nan", "inf", "1e999", "a"] {
            assert_eq!(typed(no), None, "{no}");
        }
    }

    #[test]
    fn an_inch_is_twenty_five_point_four_millimetres() {
        let units = Units {
            length: LengthUnit::Inch,
            angle: AngleUnit::Degree,
        };
        assert_eq!(units.length(25.4), "1.00 in");
    }
}
