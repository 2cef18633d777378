//! Times that are written as on a clock: `12:34:56.789`, `3:04:05 PM`, `2024-05-01T12:34:56+02:00`.
//!
//! With a date they are seconds since 1970, without one since midnight; a zone that is stated is taken off. A date
//! whose day and month could change places, or that is none, is not read.

/// What a text says as a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Clock {
    /// So many seconds.
    Seconds(f64),
    /// `12:34`: hours and minutes, or minutes and seconds; so many of the larger.
    TwoParts(f64),
}

/// Whether a text may be such a time, and is no plain number: a colon, or a date and time in 14 digits.
pub(crate) fn is_like(text: &str) -> bool {
    text.contains(':') || compact(text).is_some()
}

/// Whether a text is a date and no time of it.
pub(crate) fn is_date(text: &str) -> bool {
    days_since_1970(text.trim()).is_some()
}

/// Whether it begins with a date whose day and month could change places.
pub(crate) fn is_ambiguous(text: &str) -> bool {
    let date = text.split([' ', 't', 'T']).next().unwrap_or_default();
    let parts: Vec<u32> = date
        .split(['-', '/'])
        .filter_map(|part| part.parse().ok())
        .collect();
    matches!(parts[..], [1..=12, 1..=12, 1000..=9999])
}

/// `20240501123456.7` and `20240501T123456.7` as a date, its time and what is behind the 14 digits.
fn compact(text: &str) -> Option<String> {
    let joined = match text.split_once('T') {
        Some((date, time)) if date.len() == 8 => format!("{date}{time}"),
        _ => text.to_owned(),
    };
    let (digits, fraction) = joined.split_at_checked(14)?;
    let is_one = digits.bytes().all(|b| b.is_ascii_digit())
        && (fraction.is_empty() || fraction.starts_with(['.', ',']))
        && (digits.starts_with("19") || digits.starts_with("20"));
    let part = |from: usize, to: usize| &digits[from..to];
    is_one.then(|| {
        let (date, time) = (
            [part(0, 4), part(4, 6), part(6, 8)],
            [part(8, 10), part(10, 12)],
        );
        format!(
            "{} {}:{}{fraction}",
            date.join("-"),
            time.join(":"),
            part(12, 14)
        )
    })
}

/// Reads a time.
pub(crate) fn read(text: &str) -> Option<Clock> {
    let lower = compact(text).unwrap_or_else(|| text.trim().to_lowercase());
    let (text, afternoon) = half_of_day(&lower);
    let (date, time) = match text.split_once(['t', ' ']) {
        Some((date, time)) if !date.contains(':') => (Some(days_since_1970(date)?), time.trim()),
        _ => (None, text.as_str()),
    };
    let (time, ahead_s) = without_zone(time)?;
    let parts: Vec<&str> = time.split(':').collect();
    // Seconds have at most two whole digits: whichever sign follows them is the decimal one.
    let number = |text: &str, whole: bool| -> Option<f64> {
        let digits = text.split(['.', ',']).next()?.len();
        let plain = text
            .bytes()
            .all(|b| b.is_ascii_digit() || !whole && matches!(b, b'.' | b','));
        let value: f64 = text.replace(',', ".").parse().ok()?;
        (plain && (1..=2).contains(&digits)).then_some(value)
    };
    let below = |value: f64, limit: f64| (value < limit).then_some(value);
    if let ([first, second], None, None) = (&parts[..], date, afternoon) {
        let parts = number(first, true)? + below(number(second, false)?, 60.0)? / 60.0;
        return Some(Clock::TwoParts(parts));
    }
    let (hours, minutes, seconds) = match parts[..] {
        [hours, minutes, seconds] => (hours, minutes, number(seconds, false)?),
        [hours, minutes] => (hours, minutes, 0.0),
        _ => return None,
    };
    let hours = number(hours, true)?;
    let hours = match afternoon {
        None => below(hours, 24.0)?,
        Some(after) if (1.0..=12.0).contains(&hours) => {
            hours % 12.0 + if after { 12.0 } else { 0.0 }
        }
        Some(_) => return None,
    };
    let minutes = below(number(minutes, true)?, 60.0)?;
    let of_day = 3600.0 * hours + 60.0 * minutes + below(seconds, 61.0)?;
    Some(Clock::Seconds(
        86_400.0 * date.unwrap_or(0.0) + of_day - ahead_s,
    ))
}

/// The text without `a.m.` or `p.m.`, and whether it said the latter.
fn half_of_day(text: &str) -> (String, Option<bool>) {
    let signs = [
        (["am", "a.m.", "a.m", "上午"], false),
        (["pm", "p.m.", "p.m", "下午"], true),
    ];
    for (signs, after) in signs {
        if let Some(sign) = signs.into_iter().find(|sign| text.contains(sign)) {
            let words = text.replacen(sign, " ", 1);
            let words: Vec<&str> = words.split_whitespace().collect();
            return (words.join(" "), Some(after));
        }
    }
    (text.to_owned(), None)
}

/// The time without its zone, and how many seconds that is ahead of UTC.
fn without_zone(time: &str) -> Option<(&str, f64)> {
    for sign in ["z", "utc", "gmt"] {
        if let Some(time) = time.strip_suffix(sign) {
            return Some((time.trim_end(), 0.0));
        }
    }
    let Some(at) = time.rfind(['+', '-', '\u{2212}']) else {
        return Some((time, 0.0));
    };
    let (clock, zone) = time.split_at(at);
    let ahead = if zone.starts_with('+') { 1.0 } else { -1.0 };
    let digits: String = zone.chars().skip(1).filter(|c| *c != ':').collect();
    let number = |text: &str| text.parse::<u8>().ok().map(f64::from);
    let (hours, minutes) = match digits.len() {
        2 => (number(&digits)?, 0.0),
        4 if digits.is_ascii() => (number(&digits[..2])?, number(&digits[2..])?),
        _ => return None,
    };
    let is_zone = hours <= 14.0 && minutes < 60.0;
    let clock = clock
        .trim_end()
        .trim_end_matches("utc")
        .trim_end_matches("gmt");
    is_zone.then_some((clock.trim_end(), ahead * (3600.0 * hours + 60.0 * minutes)))
}

/// Days from 1970-01-01 to a date in the Gregorian calendar: `2024-05-01`, `2024/05/01`, `1.5.2024`, and `5/13/2024`
/// or `13/5/2024`, where only one of the two can be a month.
fn days_since_1970(date: &str) -> Option<f64> {
    let parts: Vec<&str> = date.split(['-', '/', '.']).collect();
    let number = |text: &str| -> Option<i64> {
        let digits = (1..=4).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| text.parse().ok())?
    };
    let [first, second, third] = parts[..] else {
        return None;
    };
    let [first, second, third] = [number(first)?, number(second)?, number(third)?];
    let (year, month, day) = if first >= 1000 {
        (first, second, third)
    } else if date.contains('.') || first > 12 || first == second {
        (third, second, first)
    } else if second > 12 {
        (third, first, second)
    } else {
        return None;
    };
    let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let of_month = match month {
        2 if is_leap => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        1..=12 => 31,
        _ => return None,
    };
    if year < 1000 || !(1..=of_month).contains(&day) {
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
        for (text, seconds) in [
            ("00:00:01.5", 1.5),
            ("00:00:01,5", 1.5),
            ("1970-01-02 00:00:00", 86_400.0),
            ("2024-02-29T12:00:00Z", 1_709_208_000.0),
            ("2024-02-29T14:00:00+02:00", 1_709_208_000.0),
            ("2024-02-29 04:30:00 -0730", 1_709_208_000.0),
            ("2024-02-29T12:00:00,0 UTC", 1_709_208_000.0),
            ("2000/03/01 00:00", 951_868_800.0),
            ("1.3.2000 00:00", 951_868_800.0),
            ("3/13/2000 12:00 AM", 952_905_600.0),
            ("13/3/2000 0:00:00", 952_905_600.0),
            ("12:00:01 PM", 43_201.0),
            ("3:04:05 p.m.", 54_245.0),
            ("下午 3:04:05", 54_245.0),
            ("12:34 am", 2_040.0),
            ("20000301000000.5", 951_868_800.5),
            ("20000301T000000", 951_868_800.0),
        ] {
            assert_eq!(read(text), Some(Clock::Seconds(seconds)), "{text}");
        }
        assert_eq!(read("12:30"), Some(Clock::TwoParts(12.5)));
        assert_eq!(read("75:15.0"), Some(Clock::TwoParts(75.25)));
        for wrong in [
            "",
            "12",
            "25:00:00",
            "12:60",
            "1:2:3:4",
            "2024-13-01 1:00",
            "2024-02-31 1:00:00",
            "2023-02-29T1:00:00",
            "5/1/2024 1:00:00",
            "13:00:00 PM",
            "12:00:00+25:00",
            "12:00:00 MEZ",
            "a:b",
            "x 1:00",
        ] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
