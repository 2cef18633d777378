//! Units as instruments write them, and what to ask where they do not.
//!
//! A unit is never guessed. Where neither the heading nor the person says it, the question comes
//! with what each answer would mean: how far the points would spread, and which of these suits the
//! robot.

use crate::sessions::columns::Unit;
use crate::text::Text;
use crate::units::rad_from_deg;

named! {
    /// A unit of length.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum LengthUnit {
        /// Metres.
        Metres = "m",
        /// Millimetres.
        Millimetres = "mm",
        /// Inches of 25.4 mm.
        Inches = "in",
    }
    /// As `--unit` takes it.
    pub fn symbol;
    /// All of them.
    pub const ALL;
}

impl LengthUnit {
    /// The one with this symbol.
    pub fn of(symbol: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.symbol() == symbol)
    }

    /// Millimetres in one.
    pub fn in_mm(self) -> f64 {
        match self {
            Self::Metres => 1000.0,
            Self::Millimetres => 1.0,
            Self::Inches => 25.4,
        }
    }

    pub(crate) fn unit(self) -> Unit {
        Unit::Length(self.in_mm())
    }
}

named! {
    /// A unit of angle.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum AngleUnit {
        /// Degrees.
        Degrees = "deg",
        /// Radians.
        Radians = "rad",
        /// Gradians, 400 for a turn.
        Gradians = "gon",
        /// Turns.
        Revolutions = "rev",
    }
    /// As `--angle-unit` takes it.
    pub fn symbol;
    /// All of them.
    pub const ALL;
}

impl AngleUnit {
    /// The one with this symbol.
    pub fn of(symbol: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.symbol() == symbol)
    }

    pub(crate) fn unit(self) -> Unit {
        Unit::Angle(match self {
            Self::Degrees => rad_from_deg(1.0),
            Self::Radians => 1.0,
            Self::Gradians => rad_from_deg(0.9),
            Self::Revolutions => rad_from_deg(360.0),
        })
    }
}

named! {
    /// A unit of time.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum TimeUnit {
        /// Seconds.
        Seconds = "s",
        /// Milliseconds.
        Milliseconds = "ms",
        /// Microseconds.
        Microseconds = "us",
        /// Nanoseconds.
        Nanoseconds = "ns",
        /// Minutes.
        Minutes = "min",
        /// Hours.
        Hours = "h",
        /// Days, as spreadsheets count them.
        Days = "d",
    }
    /// As `--time-unit` takes it.
    pub fn symbol;
    /// All of them.
    pub const ALL;
}

impl TimeUnit {
    /// The one with this symbol.
    pub fn of(symbol: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.symbol() == symbol)
    }

    /// Seconds in one.
    pub fn in_s(self) -> f64 {
        match self {
            Self::Seconds => 1.0,
            Self::Milliseconds => 1e-3,
            Self::Microseconds => 1e-6,
            Self::Nanoseconds => 1e-9,
            Self::Minutes => 60.0,
            Self::Hours => 3600.0,
            Self::Days => 86_400.0,
        }
    }
}

/// What a word says as a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Word {
    /// A length or an angle.
    Unit(Unit),
    /// Seconds in one.
    Time(f64),
    /// A unit that only one quantity has: kg, °C, 1/s of something.
    Other,
}

/// Reads a unit: `mm`, `µm`, `Inches`, `°`, `arcsec`, `deg/s`, …
pub fn word(text: &str) -> Option<Word> {
    let text = text.trim().to_lowercase();
    let text = text.trim_end_matches('.');
    if let Some(speed) = text.strip_suffix("/s").or_else(|| text.strip_suffix("_s")) {
        return match word(speed)? {
            Word::Unit(unit) => Some(Word::Unit(unit)),
            _ => None,
        };
    }
    let degree = rad_from_deg(1.0);
    Some(match text {
        "m" | "meter" | "meters" | "metre" | "metres" => Word::Unit(Unit::Length(1000.0)),
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => {
            Word::Unit(Unit::Length(10.0))
        }
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => {
            Word::Unit(Unit::Length(1.0))
        }
        // The micro sign, and the Greek letter that looks like it.
        "um" | "\u{b5}m" | "\u{3bc}m" | "micron" | "microns" | "micrometer" | "micrometers"
        | "micrometre" | "micrometres" => Word::Unit(Unit::Length(1e-3)),
        "in" | "inch" | "inches" | "zoll" | "\"" => Word::Unit(Unit::Length(25.4)),
        "thou" | "mil" => Word::Unit(Unit::Length(0.0254)),
        "ft" | "foot" | "feet" => Word::Unit(Unit::Length(304.8)),
        "deg" | "degs" | "degree" | "degrees" | "\u{b0}" | "grad (\u{b0})" => {
            Word::Unit(Unit::Angle(degree))
        }
        "mdeg" | "millidegree" | "millidegrees" => Word::Unit(Unit::Angle(degree / 1e3)),
        "rad" | "radian" | "radians" => Word::Unit(Unit::Angle(1.0)),
        "mrad" | "milliradian" | "milliradians" => Word::Unit(Unit::Angle(1e-3)),
        "urad" | "\u{b5}rad" | "\u{3bc}rad" => Word::Unit(Unit::Angle(1e-6)),
        "arcmin" | "arcminutes" | "arcminute" => Word::Unit(Unit::Angle(degree / 60.0)),
        "arcsec" | "arcseconds" | "arcsecond" | "\u{2033}" | "''" => {
            Word::Unit(Unit::Angle(degree / 3600.0))
        }
        "gon" | "gons" | "gradian" | "gradians" | "ngrad" => Word::Unit(AngleUnit::Gradians.unit()),
        "rev" | "revs" | "revolution" | "revolutions" | "turn" | "turns" | "umdrehung"
        | "umdrehungen" => Word::Unit(AngleUnit::Revolutions.unit()),
        "s" | "sec" | "secs" | "second" | "seconds" | "sek" | "sekunden" => Word::Time(1.0),
        "ms" | "msec" | "millis" | "millisecond" | "milliseconds" | "millisekunden" => {
            Word::Time(1e-3)
        }
        "us" | "\u{b5}s" | "\u{3bc}s" | "usec" | "microsecond" | "microseconds" => Word::Time(1e-6),
        "ns" | "nsec" | "nsecs" | "nanos" | "nanosec" | "nanosecs" | "nanosecond"
        | "nanoseconds" => Word::Time(1e-9),
        "min" | "mins" | "minute" | "minutes" | "minuten" => Word::Time(60.0),
        "h" | "hr" | "hrs" | "hour" | "hours" | "stunde" | "stunden" => Word::Time(3600.0),
        "d" | "day" | "days" | "tag" | "tage" => Word::Time(86_400.0),
        "kg" | "\u{b0}c" | "degc" | "deg c" | "celsius" => Word::Other,
        _ => return None,
    })
}

/// The unit of a kind that the lines before a table name; two different ones name none.
pub(crate) fn of_preamble(
    lines: &[&[String]],
    is_wanted: fn(Unit) -> bool,
) -> Option<(String, Unit)> {
    let mut named = lines
        .iter()
        .filter_map(|cells| named_in_preamble(cells, is_wanted));
    let first = named.next()?;
    named.all(|other| other.1 == first.1).then_some(first)
}

/// A unit that a line before the table names: `Units: Millimeters`, `Length Unit;mm`.
pub(crate) fn named_in_preamble(
    cells: &[impl AsRef<str>],
    is_wanted: fn(Unit) -> bool,
) -> Option<(String, Unit)> {
    let line: Vec<&str> = cells.iter().map(AsRef::as_ref).collect();
    let line = line.join(" ");
    let words: Vec<&str> = line
        .split([' ', ':', '=', '\t', ';', ',', '[', ']', '(', ')'])
        .filter(|word| !word.is_empty())
        .collect();
    let says = words.iter().position(|word| {
        matches!(
            word.to_lowercase().as_str(),
            "unit" | "units" | "einheit" | "einheiten"
        )
    })?;
    words[says + 1..]
        .iter()
        .take(3)
        .find_map(|text| match word(text) {
            Some(Word::Unit(unit)) if is_wanted(unit) => Some(((*text).to_owned(), unit)),
            _ => None,
        })
}

/// What the answers would mean: how far the points spread in each unit, and which suits the robot.
pub(crate) fn hint(spread: f64, reach_mm: Option<f64>) -> Text {
    let mm = |unit: LengthUnit| spread * unit.in_mm();
    let in_mm = |unit| format!("{:.4} mm", mm(unit));
    let would_be = text!(
        "the points spread over {spread}: as m that would be {metres}, as mm {millimetres}, as in {inches}",
        spread = format!("{spread:.4}"),
        metres = in_mm(LengthUnit::Metres),
        millimetres = in_mm(LengthUnit::Millimetres),
        inches = in_mm(LengthUnit::Inches)
    );
    if spread <= 0.0 {
        return would_be;
    }
    // Points of a robot spread over its reach, up to twice as far; most robots are about the size of a person.
    let reach = reach_mm.filter(|reach| *reach > 0.0);
    let wanted = reach.map_or(1000.0, |reach| 1.4 * reach);
    let off = |unit: &LengthUnit| (mm(*unit) / wanted).ln().abs();
    let likeliest = LengthUnit::ALL
        .into_iter()
        .min_by(|a, b| off(a).total_cmp(&off(b)))
        .unwrap_or(LengthUnit::Millimetres);
    let name = match likeliest {
        LengthUnit::Metres => phrase!("metres"),
        LengthUnit::Millimetres => phrase!("millimetres"),
        LengthUnit::Inches => phrase!("inches"),
    };
    text!("{would_be}; {unit} would suit", would_be, unit = name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read_as_people_write_them() {
        let length = |text| match word(text) {
            Some(Word::Unit(Unit::Length(mm))) => Some(mm),
            _ => None,
        };
        assert_eq!(length("Millimeters"), Some(1.0));
        assert_eq!(length("\u{b5}m"), Some(1e-3));
        assert_eq!(length("\u{3bc}m"), Some(1e-3));
        assert_eq!(length("inches"), Some(25.4));
        assert_eq!(
            word("deg/s"),
            Some(Word::Unit(Unit::Angle(rad_from_deg(1.0))))
        );
        assert_eq!(word("ms"), Some(Word::Time(1e-3)));
        assert_eq!(word("furlong"), None);
        assert_eq!(word("/s"), None);
    }

    #[test]
    fn a_preamble_may_name_the_unit() {
        let named = |line: &str| {
            named_in_preamble(&[line], |unit| matches!(unit, Unit::Length(_))).map(|(text, _)| text)
        };
        assert_eq!(named("Units: Millimeters"), Some("Millimeters".to_owned()));
        assert_eq!(named("Length Unit [in]"), Some("in".to_owned()));
        assert_eq!(named("measured in mm"), None);
        assert_eq!(named("Units: deg"), None);
    }

    #[test]
    fn the_hint_names_the_unit_that_suits_the_robot() {
        assert!(
            hint(0.25, Some(250.0))
                .to_string()
                .contains("metres would suit")
        );
        assert!(
            hint(250.0, Some(250.0))
                .to_string()
                .contains("millimetres would suit")
        );
        assert!(
            hint(12.0, Some(250.0))
                .to_string()
                .contains("inches would suit")
        );
        assert!(hint(0.25, None).to_string().contains("0.2500 mm"));
    }
}
