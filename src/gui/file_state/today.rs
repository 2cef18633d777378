//! The date that a report is proposed: that of the machine's clock at UTC, as ISO 8601 writes it.

use std::time::SystemTime;

const SECONDS_OF_A_DAY: u64 = 86_400;

/// Today; `None` where the clock stands before 1970.
#[allow(
    clippy::disallowed_methods,
    reason = "the window may read the clock, the core may not"
)]
pub(crate) fn today() -> Option<String> {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    Some(date_of(since.ok()?.as_secs() / SECONDS_OF_A_DAY))
}

/// The date so many days after 1 January 1970, in the Gregorian calendar.
fn date_of(mut day: u64) -> String {
    let is_leap = |year: u64| {
        year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
    };
    let mut year = 1970;
    loop {
        let days = if is_leap(year) { 366 } else { 365 };
        if day < days {
            break;
        }
        day -= days;
        year += 1;
    }
    let february = if is_leap(year) { 29 } else { 28 };
    let months = [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut month = 1;
    for days in months {
        if day < days {
            break;
        }
        day -= days;
        month += 1;
    }
    format!("{year}-{month:02}-{:02}", day + 1)
}

#[cfg(test)]
#[test]
fn days_are_counted_over_leap_years_and_centuries() {
    // `date -u -d @$((86400 * DAY)) +%F`
    for (day, date) in [
        (0, "1970-01-01"),
        (58, "1970-02-28"),
        (59, "1970-03-01"),
        (789, "1972-02-29"),
        (11_016, "2000-02-29"),
        (11_322, "2000-12-31"),
        (11_323, "2001-01-01"),
        (20_780, "2026-11-23"),
        (47_540, "2100-02-28"),
        (47_541, "2100-03-01"),
    ] {
        assert_eq!(date_of(day), date, "{day}");
    }
    assert!(today().is_some_and(|date| date.as_str() > "2026-01-01"));
}
