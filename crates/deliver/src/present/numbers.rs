//! Numbers as people read them: with no more digits than can be read or than their uncertainty
//! supports, a real minus sign, and the decimal sign that the reader chose. Terminal tables write an
//! ASCII minus sign, as other programs read them.

use crate::numeric::whole;
use std::cell::Cell;

/// How numbers are written for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Notation {
    /// Decimals of lengths; `None`: as many as can be read.
    pub decimals: Option<u8>,
    /// Whether decimals follow a comma.
    pub comma: bool,
}

thread_local! {
    /// The window is drawn by one thread; it alone sets this, once a frame. Every other
    /// thread writes with a point: reports and files are the same on every machine.
    static NOTATION: Cell<Notation> = const { Cell::new(Notation { decimals: None, comma: false }) };
}

/// Writes numbers like this from now on, on this thread.
pub fn write_numbers(notation: Notation) {
    NOTATION.set(notation);
}

/// The notation of this thread.
pub fn notation() -> Notation {
    NOTATION.get()
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
pub(super) const NOTHING: f64 = 1e-9;

/// So many significant digits, in plain notation where that is short; a real minus sign.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    if value.abs() < NOTHING {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-5.0..9.0).contains(&magnitude) {
        return scientific(value, digits);
    }
    fixed(value, whole(digits as f64 - 1.0 - magnitude))
}

fn scientific(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    let (lead, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}·10{}", with_minus(lead), raised(exponent))
}

/// At most so many decimals, without zeros at the end.
pub fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    with_minus(text)
}

/// So many decimals, whatever the size: for columns whose numbers are compared.
pub fn fixed(value: f64, decimals: usize) -> String {
    with_minus(&format!("{value:.decimals$}"))
}

/// What is left of rounding to so many decimals is 0, without a sign.
pub(crate) fn rounded(value: f64, decimals: usize) -> f64 {
    let places = i32::try_from(decimals).unwrap_or(i32::MAX);
    if value.abs() < 0.5 * 0.1_f64.powi(places) {
        0.0
    } else {
        value
    }
}

/// A length in mm as a report states it: four decimals, or three digits where those would show
/// nothing or more than can be read. What is left of rounding is 0.
pub(crate) fn plain(value: f64) -> String {
    let shows_nothing = value.abs() > NOTHING && value.abs() < 5e-5;
    if shows_nothing || value.abs() >= 1e7 {
        return scientific(value, 3);
    }
    fixed(value, 4)
}

/// The same with its unit.
pub(crate) fn mm(value: f64) -> String {
    format!("{} mm", plain(value))
}

/// The same without zeros at its end.
pub(crate) fn short(value: f64) -> String {
    let text = plain(value);
    if text.contains('·') {
        return text;
    }
    trimmed(value, 4)
}

/// Decimals at which `size` shows so many significant digits, at most nine.
pub(crate) fn decimals_of(size: f64, digits: usize) -> usize {
    let magnitude = if size == 0.0 || !size.is_finite() {
        0.0
    } else {
        size.abs().log10().floor()
    };
    whole(digits as f64 - 1.0 - magnitude).min(9)
}

/// A value with as many digits as its 95 % interval supports (two of half its width), half of that
/// interval, and the interval itself: `−3.012`, `± 0.014`, `−3.026 … −2.998`.
pub(crate) fn with_interval(value: f64, interval: Option<[f64; 2]>) -> [String; 3] {
    let Some([from, to]) = interval else {
        let open = || say!("not determined").to_owned();
        return [significant(value, 6), open(), open()];
    };
    let half = 0.5 * (to - from);
    if !(half.is_finite() && half > 1e-9 * value.abs().max(1e-3)) {
        let value = significant(value, 6);
        let interval = format!("{value} … {value}");
        return [value, "± 0".to_owned(), interval];
    }
    let decimals = decimals_of(half, 2);
    let [value, half, from, to] = [value, half, from, to].map(|v| fixed(v, decimals));
    [value, format!("± {half}"), format!("{from} … {to}")]
}

/// A count, from 10 000 on in groups of three digits with a narrow space between them.
pub fn grouped(count: usize) -> String {
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

/// A text that goes into files as well, with real minus signs before its numbers.
pub fn with_minus_signs(text: &str) -> String {
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

/// With a real minus sign, but not before zeros alone, and the decimal sign of the notation.
fn with_minus(text: &str) -> String {
    let is_zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    let text = text.replace('-', if is_zero { "" } else { "−" });
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
    fn counts_are_grouped_and_agree_with_what_is_counted() {
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
        let shown = with_interval(-3.01234567, Some([-3.026, -2.998]));
        assert_eq!(shown, ["−3.012", "± 0.014", "−3.026 … −2.998"]);
        let shown = with_interval(-0.350486, Some([-0.351278, -0.349695]));
        assert_eq!(shown, ["−0.35049", "± 0.00079", "−0.35128 … −0.34969"]);
        assert_eq!(with_interval(1.5, None)[1], "not determined");
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
    fn a_report_has_four_decimals_and_says_small_things_all_the_same() {
        assert_eq!(plain(-0.0), "0.0000");
        assert_eq!(plain(3e-9), "3.00·10⁻⁹");
        assert_eq!(short(250.0), "250");
        assert_eq!(short(-1.5), "−1.5");
        assert_eq!(significant(0.00376, 3), "0.00376");
    }
}
