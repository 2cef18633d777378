//! Decimal text to the nearest double, exactly as `str::parse::<f64>`, but faster.
//!
//! Measured values are short decimals: a sign, a few digits, a point, a few digits. Such a number
//! is `m / 10^k` with a whole `m < 2^53` and `k <= 22`; both are exact doubles, so that a single
//! division rounds correctly (Clinger, *How to read floating point numbers accurately*, PLDI 1990).
//! Everything else goes to the standard library. Eight digits are read at a time from one machine
//! word (Lemire, *Quickly parsing eight digits*, 2018).
//!
//! Not a number here: `nan`, `inf`, and anything that overflows. A missing value is an empty cell
//! and nothing else.

/// A double holds every whole number up to here.
const EXACT: u64 = 1 << 53;

/// Powers of ten as whole numbers and as (exact) doubles.
const TEN_U64: [u64; 17] = {
    let mut table = [1; 17];
    let mut i = 1;
    while i < 17 {
        table[i] = table[i - 1] * 10;
        i += 1;
    }
    table
};
const TEN_F64: [f64; 17] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
];

/// How many bytes beyond the last number a buffer has to reach for the fast path to be taken.
pub(crate) const PADDING: usize = 24;

const ZEROS: u64 = 0x3030_3030_3030_3030;
const HIGH_BITS: u64 = 0x8080_8080_8080_8080;

/// The eight bytes from `at`, the first one lowest.
#[inline]
pub(crate) fn word_at(bytes: &[u8], at: usize) -> Option<u64> {
    let eight = bytes.get(at..)?.first_chunk::<8>()?;
    Some(u64::from_le_bytes(*eight))
}

/// How many bytes at the start of a word (already less the digit zero) are digits.
#[inline]
fn leading_digits(values: u64) -> usize {
    (not_digits(values).trailing_zeros() / 8) as usize
}

/// Marks the bytes that are no digit values; behind the first one, others may be marked too.
#[inline]
fn not_digits(values: u64) -> u64 {
    // A carry out of a byte that is no digit only spoils the bytes after it.
    (values.wrapping_add(0x7676_7676_7676_7676) | values) & HIGH_BITS
}

/// The whole number that eight digit values spell, the first one lowest in the word.
#[inline]
fn eight_digits(values: u64) -> u64 {
    let pairs = (values.wrapping_mul(2561) >> 8) & 0x00ff_00ff_00ff_00ff;
    let fours = (pairs.wrapping_mul(6_553_601) >> 16) & 0x0000_ffff_0000_ffff;
    fours.wrapping_mul(42_949_672_960_001) >> 32
}

/// The number that the first `count` (1 to 8) digit values of a word spell.
#[inline]
fn first_digits(values: u64, count: usize) -> u64 {
    eight_digits(values << (64 - 8 * count))
}

/// Reads `[-]digits[.digits]` from `at`, where the digits are few enough to be exact, and returns
/// the value and where it ends. `None` is no verdict: the general way has to be taken.
#[inline]
pub(crate) fn plain_decimal(bytes: &[u8], at: usize) -> Option<(f64, usize)> {
    let first = word_at(bytes, at)?;
    let negative = u64::from(first & 0xff == u64::from(b'-'));
    let start = at + usize::from(negative == 1);
    let values = word_at(bytes, start)? ^ ZEROS;
    let whole_digits = leading_digits(values);
    if whole_digits == 0 || whole_digits == 8 {
        return None;
    }
    let whole = first_digits(values, whole_digits);
    let point = start + whole_digits;
    if bytes.get(point) != Some(&b'.') {
        return Some((signed(whole, negative), point));
    }
    let values = word_at(bytes, point + 1)? ^ ZEROS;
    let digits = leading_digits(values);
    if digits == 0 {
        return None;
    }
    let first_part = first_digits(values, digits);
    if digits < 8 {
        // At most 7 + 7 digits: always exact.
        let mantissa = whole * TEN_U64[digits] + first_part;
        return Some((
            signed(mantissa, negative) / TEN_F64[digits],
            point + 1 + digits,
        ));
    }
    let values = word_at(bytes, point + 9)? ^ ZEROS;
    let more = leading_digits(values);
    let second_part = if more == 0 {
        0
    } else {
        first_digits(values, more)
    };
    let digits = 8 + more;
    let mantissa = (whole * TEN_U64[8] + first_part)
        .checked_mul(TEN_U64[more])?
        .checked_add(second_part)?;
    if more == 8 || mantissa > EXACT {
        return None;
    }
    Some((
        signed(mantissa, negative) / TEN_F64[digits],
        point + 1 + digits,
    ))
}

/// Powers of ten to divide by, and the same with a minus: m / −10^k is −(m / 10^k), and 0 becomes −0.
const SIGNED_TEN: [[f64; 16]; 2] = {
    let mut table = [[0.0; 16]; 2];
    let mut i = 0;
    while i < 16 {
        table[0][i] = TEN_F64[i];
        table[1][i] = -TEN_F64[i];
        i += 1;
    }
    table
};

/// Length of the cell that starts at `at`, if it is shorter than sixteen bytes: the distance to the
/// first byte below '-', which is what ends a cell (comma, line feed, carriage return) or makes it
/// a case for the general way (quotes, spaces, plus signs). That is quickly found, and it is all
/// that the next cell has to wait for.
#[inline]
pub(crate) fn short_cell(bytes: &[u8], at: usize) -> Option<usize> {
    const FIRST_CONTENT: u64 = 0x2d2d_2d2d_2d2d_2d2d;
    // A borrow only spoils the bytes after the first that is below.
    let below = |word: u64| word.wrapping_sub(FIRST_CONTENT) & !word & HIGH_BITS;
    let [low, high] = two_words(bytes, at)?;
    let (low, high) = (below(low), below(high));
    let length = if low == 0 {
        8 + high.trailing_zeros() / 8
    } else {
        low.trailing_zeros() / 8
    };
    (length < 16).then_some(length as usize)
}

/// The sixteen bytes from `at`, the first one lowest in the first word.
#[inline]
fn two_words(bytes: &[u8], at: usize) -> Option<[u64; 2]> {
    let (low, high) = bytes.get(at..)?.first_chunk::<16>()?.split_at(8);
    Some([
        u64::from_le_bytes(*low.first_chunk()?),
        u64::from_le_bytes(*high.first_chunk()?),
    ])
}

/// The value of the cell `bytes[at..at + length]`, if it is `[-]digits[.digits]` with one to seven
/// digits before the point and one to eight behind it. `None` is no verdict.
#[inline]
pub(crate) fn short_decimal(bytes: &[u8], at: usize, length: usize) -> Option<f64> {
    let negative = usize::from(*bytes.get(at)? == b'-');
    let [low, high] = two_words(bytes, at + negative)?;
    let bits = 8 * (length - negative);
    let values = low ^ ZEROS;
    let whole_bits = (not_digits(values).trailing_zeros() & !7) as usize;
    if whole_bits == 0 || whole_bits == 64 {
        return None;
    }
    let whole = eight_digits(values << (64 - whole_bits));
    if bits == whole_bits {
        return Some(ratio(whole, negative, 0));
    }
    // At most seven bytes before the point: nothing of what stands behind is shifted out.
    let from_point = low >> whole_bits;
    let behind = (from_point >> 8) | (high << (56 - whole_bits));
    let digit_bits = bits.wrapping_sub(whole_bits + 8);
    if from_point & 0xff != u64::from(b'.') || digit_bits.wrapping_sub(1) > 63 {
        return None;
    }
    let values = (behind ^ ZEROS) << (64 - digit_bits);
    if not_digits(values) != 0 {
        return None;
    }
    // At most 7 + 8 digits: below 2^53.
    let digits = (digit_bits / 8) & 15;
    let mantissa = whole * TEN_U64[digits] + eight_digits(values);
    Some(ratio(mantissa, negative, digits))
}

/// `±mantissa / 10^decimals` for a mantissa up to 2^53 and up to 15 decimals; −0 stays −0.
#[inline]
pub(crate) fn ratio(mantissa: u64, negative: usize, decimals: usize) -> f64 {
    exact(mantissa) / SIGNED_TEN[negative & 1][decimals & 15]
}

/// The double of a whole number up to 2^53.
#[inline]
#[expect(
    clippy::cast_possible_wrap,
    reason = "below 2^53; the signed conversion is one instruction"
)]
fn exact(mantissa: u64) -> f64 {
    (mantissa as i64) as f64
}

/// The double of a whole number up to 2^53 with this sign; −0 stays −0.
#[inline]
fn signed(mantissa: u64, negative: u64) -> f64 {
    f64::from_bits(exact(mantissa).to_bits() | (negative << 63))
}

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
    use proptest::prelude::*;

    use super::*;

    fn fast(text: &str) -> Option<(f64, usize)> {
        let mut padded = text.as_bytes().to_vec();
        padded.push(b',');
        padded.resize(padded.len() + PADDING, 0);
        plain_decimal(&padded, 0)
    }

    fn short(text: &str) -> Option<f64> {
        let mut padded = text.as_bytes().to_vec();
        padded.push(b',');
        padded.resize(padded.len() + PADDING, 0);
        let length = short_cell(&padded, 0)?;
        (length == text.len()).then(|| short_decimal(&padded, 0, length))?
    }

    fn assert_same_bits(text: &str) {
        let expected: f64 = text.parse().expect("the test writes numbers");
        if let Some(value) = short(text) {
            assert_eq!(value.to_bits(), expected.to_bits(), "{text}");
        }
        if let Some((value, end)) = fast(text)
            && end == text.len()
        {
            assert_eq!(value.to_bits(), expected.to_bits(), "{text}");
        }
        assert_eq!(any_decimal(text).map(f64::to_bits), Ok(expected.to_bits()));
    }

    #[test]
    fn measured_values_take_the_fast_path() {
        for text in [
            "0",
            "-0",
            "20",
            "-249.895665",
            "0.05",
            "18.9718316",
            "123.4567890123456",
        ] {
            let (value, end) = fast(text).expect(text);
            assert_eq!(value.to_bits(), text.parse::<f64>().unwrap().to_bits());
            assert_eq!(end, text.len());
            let is_short = text.len() < 15;
            assert!(!is_short || short(text).is_some(), "{text}");
        }
    }

    #[test]
    fn the_fast_path_gives_way_where_it_would_not_be_exact() {
        for text in ["9007.19925474099312", "12345678.5", ".5", "1.", "+1", "1e5"] {
            assert!(fast(text).is_none_or(|(_, end)| end < text.len()), "{text}");
        }
    }

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

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn short_cells_are_read_right_or_not_at_all(text in "[-0-9.eE]{0,15}") {
            if let Some(value) = short(&text) {
                prop_assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()), "{}", text);
            }
        }

        #[test]
        fn decimals_equal_the_standard_library_to_the_last_bit(
            text in "-?[0-9]{1,10}(\\.[0-9]{1,18})?",
        ) {
            assert_same_bits(&text);
        }

        #[test]
        fn doubles_come_back_from_their_own_digits(bits in any::<u64>()) {
            let value = f64::from_bits(bits);
            if value.is_finite() {
                assert_same_bits(&format!("{value:?}"));
                assert_same_bits(&format!("{value:e}"));
            }
        }
    }
}
