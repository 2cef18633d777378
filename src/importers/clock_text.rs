//! Times that are written as on a clock: `12:34:56.789`, `2024-05-01T12:34:56`.
//!
//! With a date they are seconds since 1970, without one since midnight.

use crate::tables::decimals::{Decimal, value};

/// The seconds that a text says.
pub(crate) fn seconds(text: &str, decimal: Decimal) -> Option<f64> {
    let text = text.trim().trim_end_matches('Z');
    let (date, time) = match text.split_once(['T', ' ']) {
        Some((date, time)) => (Some(date), time.trim()),
        None => (None, text),
    };
    let mut parts = time.split(':');
    let (hours, minutes, rest) = (parts.next()?, parts.next()?, parts.next());
    if parts.next().is_some() {
        return None;
    }
    let whole = |text: &str, below: u32| {
        let digits = (1..=2).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
        let number: u32 = digits.then(|| text.parse().ok())??;
        (number < below).then_some(f64::from(number))
    };
    let seconds = match rest {
        None => 0.0,
        Some(text) => value(text, decimal)
            .or_else(|_| value(text, Decimal::Point))
            .ok()
            .filter(|seconds| (0.0..61.0).contains(seconds))?,
    };
    let days = match date {
        None => 0.0,
        Some(date) => days_since_1970(date)?,
    };
    Some(86_400.0 * days + 3600.0 * whole(hours, 24)? + 60.0 * whole(minutes, 60)? + seconds)
}

/// Days from 1970-01-01 to a date in the Gregorian calendar, `2024-05-01` or `2024/05/01`.
fn days_since_1970(date: &str) -> Option<f64> {
    let mut parts = date.split(['-', '/']);
    let number = |text: Option<&str>| -> Option<i64> {
        let text = text?;
        let digits = (1..=4).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| text.parse().ok())?
    };
    let (year, month, day) = (
        number(parts.next())?,
        number(parts.next())?,
        number(parts.next())?,
    );
    if parts.next().is_some()
        || year < 1000
        || !(1..=12).contains(&month)
        || !(1..=31).contains(&day)
    {
        return None;
    }
    // Years that start in March have their leap day last; eras of 400 years are all alike.
    let year = if month <= 2 { year - 1 } else { year };
    let of_era = year.rem_euclid(400);
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    let days = year.div_euclid(400) * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year;
    Some((days - 719_468) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clocks_are_read() {
        let at = |text| seconds(text, Decimal::Point);
        assert_eq!(at("00:00:01.5"), Some(1.5));
        assert_eq!(at("12:34"), Some(45_240.0));
        assert_eq!(at("1970-01-02 00:00:00"), Some(86_400.0));
        assert_eq!(at("2024-02-29T12:00:00Z"), Some(1_709_208_000.0));
        assert_eq!(at("2000/03/01 00:00"), Some(951_868_800.0));
        assert_eq!(seconds("00:00:01,5", Decimal::Comma), Some(1.5));
        for wrong in [
            "",
            "12",
            "25:00",
            "12:60:00",
            "1:2:3:4",
            "2024-13-01 1:00",
            "a:b",
            "x 1:00",
        ] {
            assert_eq!(at(wrong), None, "{wrong}");
        }
    }
}
