//! Times: what unit they are in where nothing says it, and whether a measurement can last as long.
//!
//! Numbers are never taken for seconds: the unit is asked for, with what each answer would mean. Only of counts since
//! 1970, and of a spreadsheet's days, does the size tell the unit; that is proposed.

use super::clock_text::{self, Clock};
use super::columns::below;
use super::role::Role;
use super::settings::{About, ReadContext};
use super::units::TimeUnit;
use crate::diagnostic::Diagnostic;
use crate::document::number::quoted;
use crate::numeric;
use crate::tables::Cells;
use crate::tables::decimals::{Decimal, value};
use crate::text::{Template, Text};

/// No measurement of poses lasts less than a second or longer than a year.
const SHORTEST_S: f64 = 1.0;
const LONGEST_S: f64 = 366.0 * 86_400.0;
/// The years 2000 to 2100, as seconds since 1970 and as days since 1900.
const SINCE_1970_S: [f64; 2] = [946_684_800.0, 4_102_444_800.0];
const SINCE_1900_D: [f64; 2] = [36_526.0, 73_051.0];

/// How the cells of a column say their time.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Kinds {
    numbers: bool,
    clocks: bool,
    two_parts: bool,
}

impl Kinds {
    /// Reads a cell of a column of times, in s where its unit is stated or it is written as on a clock.
    pub(crate) fn read(
        &mut self,
        cell: &str,
        unit: Option<f64>,
        decimal: Decimal,
    ) -> Result<f64, Template> {
        let clock = if clock_text::is_like(cell) {
            clock_text::read(cell)
        } else {
            None
        };
        let in_unit = unit.unwrap_or(1.0);
        match clock {
            Some(Clock::Seconds(seconds)) => {
                self.clocks = true;
                Ok(seconds)
            }
            // Hours and minutes, or minutes and seconds.
            Some(Clock::TwoParts(parts))
                if unit.is_none_or(|unit| unit == 60.0 || unit == 3600.0) =>
            {
                self.two_parts = true;
                Ok(parts * in_unit)
            }
            _ => {
                self.numbers = true;
                let time = value(cell, decimal).map(|value| value * in_unit);
                time.map_err(|_| {
                    if clock_text::is_ambiguous(cell) {
                        return phrase!("a date of which it is certain what is the day: 2024-05-01 or 1.5.2024; --columns with - leaves the column out");
                    }
                    phrase!(
                        "a time: a number, 12:34:56.7, 3:04:05 PM or 2024-05-01T12:34:56+02:00; --columns with - leaves the column out"
                    )
                })
            }
        }
    }
}

impl ReadContext<'_> {
    /// Gives every time its unit, or asks for it, and refuses what no measurement lasts.
    pub(crate) fn settle_times(
        &mut self,
        roles: &mut [Role],
        cells: &mut [Option<Cells>],
        kinds: &[Kinds],
        headings: &[String],
    ) {
        // Of two the person says which is the time, or that neither is.
        let are_times = roles.iter().filter(|role| matches!(role, Role::Time(_)));
        if are_times.count() > 1 {
            return;
        }
        for (index, (role, cells)) in roles.iter_mut().zip(cells).enumerate() {
            let (Role::Time(unit), Some(Cells::Numbers(values))) = (&mut *role, cells) else {
                continue;
            };
            // What is wrong with cells is said of them.
            if !values.iter().any(|value| value.is_finite()) {
                continue;
            }
            let heading = headings.get(index).map_or("", String::as_str);
            if unit.is_none() {
                let kinds = kinds[index];
                let forms = [kinds.numbers, kinds.clocks, kinds.two_parts];
                if forms.into_iter().filter(|is| *is).count() > 1 {
                    self.refuse_times(heading, text!("times in several forms"));
                    continue;
                }
                *unit = if kinds.clocks {
                    Some(1.0)
                } else {
                    self.unit_of_times(heading, values, kinds.two_parts)
                };
                let Some(unit) = *unit else { continue };
                for value in values.iter_mut() {
                    *value *= unit;
                }
            }
            let span = extent(values);
            let [earliest, _] = numeric::extent(&*values);
            if earliest > SINCE_1970_S[1] {
                let found = text!("times that begin at {first}", first = duration(earliest));
                self.refuse_times(heading, found);
            } else if values.iter().filter(|value| value.is_finite()).count() > 1
                && !is_possible(span)
            {
                let found = text!("the times span {span}", span = duration(span));
                self.refuse_times(heading, found);
            }
        }
    }

    fn refuse_times(&mut self, heading: &str, found: Text) {
        let place = below(self.place.clone(), heading);
        let expected = text!(
            "between a second and a year in one form: the right unit in the heading, in --columns (time_ms) or as --time-unit; --columns with - leaves the column out"
        );
        self.found
            .findings
            .push(Diagnostic::error(place, found, expected));
    }

    /// The unit of times that do not state it: as a person said, else it is asked for.
    fn unit_of_times(&mut self, heading: &str, values: &[f64], two_parts: bool) -> Option<f64> {
        let given = self.reading.time_unit;
        if let Some(unit) = given
            && (!two_parts || matches!(unit, TimeUnit::Minutes | TimeUnit::Hours))
        {
            return Some(unit.in_s());
        }
        let span = extent(values);
        let known = values.iter().copied().filter(|value| value.is_finite());
        let all_within = |[from, to]: [f64; 2], in_s: f64| {
            let mut known = known.clone();
            known.clone().next().is_some() && known.all(|v| (from..to).contains(&(v * in_s)))
        };
        let since_1970 = |unit: &TimeUnit| {
            !matches!(unit, TimeUnit::Minutes | TimeUnit::Hours | TimeUnit::Days)
                && all_within(SINCE_1970_S, unit.in_s())
        };
        let epoch = TimeUnit::ALL.into_iter().find(since_1970);
        let spreadsheet = all_within(SINCE_1900_D, 1.0) && is_possible(86_400.0 * span);
        let year =
            |day_since_1970: f64| format!("{:.0}", (1970.0 + day_since_1970 / 365.2425).floor());
        let first = known.clone().next().unwrap_or(0.0);
        let (hint, answers) = if let Some(unit) = epoch {
            let since = text!(
                "as {unit} since {start} they are of {year}",
                unit = unit.symbol(),
                start = "1970",
                year = year(first * unit.in_s() / 86_400.0)
            );
            (since, vec![unit])
        } else if spreadsheet && !two_parts {
            let since = text!(
                "as {unit} since {start} they are of {year}",
                unit = TimeUnit::Days.symbol(),
                start = "1900",
                year = year(first - 25_569.0)
            );
            (since, vec![TimeUnit::Days])
        } else {
            let possible = |unit: &TimeUnit| {
                (!two_parts || matches!(unit, TimeUnit::Minutes | TimeUnit::Hours))
                    && (is_possible(span * unit.in_s()) || values.len() < 2)
            };
            let units: Vec<TimeUnit> = TimeUnit::ALL.into_iter().filter(possible).collect();
            let each = units
                .iter()
                .map(|unit| format!("{}: {}", unit.symbol(), duration(span * unit.in_s())));
            let each: Vec<String> = each.collect();
            (
                text!("they would span, in {each}", each = each.join(", ")),
                units,
            )
        };
        if answers.is_empty() {
            let span = span.to_string();
            self.refuse_times(heading, text!("the times span {span}", span));
            return None;
        }
        let answers: Vec<&str> = answers.into_iter().map(TimeUnit::symbol).collect();
        let says = text!(
            "the unit of the times {heading} is not stated: {hint}",
            heading = quoted(heading),
            hint
        );
        self.ask(About::TimeUnit, says, &answers);
        None
    }

    /// A column that is called a time and is none that is understood would be left out unseen.
    pub(crate) fn ask_about_lost_times(&mut self, roles: &[Role], headings: &[String]) {
        if roles.iter().any(|role| matches!(role, Role::Time(_))) {
            return;
        }
        let row = self.found.first_rows.first();
        let is_lost = |(index, (role, heading)): &(usize, (&Role, &String))| {
            let cell = row
                .and_then(|row| row.get(*index))
                .map_or("", String::as_str);
            let has_digits = cell.contains(|c: char| c.is_ascii_digit());
            let is_called = super::headings::names_a_time(heading) && !clock_text::is_date(cell);
            let is_clock = matches!(clock_text::read(cell), Some(Clock::Seconds(_)));
            **role == Role::Kept && has_digits && (is_called || is_clock)
        };
        if let Some((index, (_, heading))) = roles.iter().zip(headings).enumerate().find(is_lost) {
            let says = text!(
                "column {index} {heading} is a time, in a way that is not understood",
                index = index + 1,
                heading = quoted(heading)
            );
            self.ask(About::Columns, says, &[]);
        }
    }
}

/// Largest less smallest value; of none nothing.
pub(crate) fn extent(values: &[f64]) -> f64 {
    let [smallest, largest] = numeric::extent(values);
    (largest - smallest).max(0.0)
}

fn is_possible(span_s: f64) -> bool {
    (SHORTEST_S..=LONGEST_S).contains(&span_s)
}

/// A length of time in its usual unit.
fn duration(seconds: f64) -> String {
    let (in_s, unit) = match seconds {
        s if s < 120.0 => (1.0, "s"),
        s if s < 7200.0 => (60.0, "min"),
        s if s < 2.0 * 86_400.0 => (3600.0, "h"),
        _ => (86_400.0, "d"),
    };
    let value = seconds / in_s;
    if value >= 1e6 || value < 0.01 && value > 0.0 {
        format!("{value:.1e} {unit}")
    } else {
        format!("{} {unit}", (value * 100.0).round() / 100.0)
    }
}
