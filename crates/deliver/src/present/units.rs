//! The units in which the window shows lengths and angles, as the user chose them.

use super::numbers::{
    NOTHING, decimals_of, fixed, notation, significant, trimmed, typed, with_interval,
};
use crate::fit::Estimate;
use crate::importers::units::{Word, word};
use crate::sessions::columns::Unit;
use crate::text::current_units;
pub use crate::units::{AngleUnit, LengthUnit};
use crate::units::{deg_from_rad, rad_from_deg};

/// Both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Units {
    /// Of lengths.
    pub length: LengthUnit,
    /// Of angles.
    pub angle: AngleUnit,
}

impl Units {
    /// A length in the chosen unit.
    pub fn length_value(self, mm: f64) -> f64 {
        self.length.of_mm(mm)
    }

    /// The unit of lengths.
    pub fn length_name(self) -> &'static str {
        self.length.name()
    }

    /// An angle in the chosen unit.
    pub fn angle_value(self, rad: f64) -> f64 {
        self.angle.of_rad(rad)
    }

    /// The unit of angles, as it stands after a number.
    pub fn angle_name(self) -> &'static str {
        self.angle.name()
    }

    /// A length with its unit.
    pub fn length(self, mm: f64) -> String {
        format!("{} {}", self.length_number(mm), self.length_name())
    }

    /// The same without the unit.
    pub fn length_number(self, mm: f64) -> String {
        let value = self.length_value(mm);
        match notation().decimals {
            Some(decimals) if value.is_finite() => fixed(value, usize::from(decimals)),
            _ => significant(value, 3),
        }
    }

    /// The same with as many decimals as a number like this one has: for a column of a table.
    pub fn length_like(self, mm: f64, like_mm: f64) -> String {
        if notation().decimals.is_some() || !mm.is_finite() {
            return self.length_number(mm);
        }
        let like = self.length_value(like_mm).abs();
        let like = if like > NOTHING { like } else { 0.0 };
        fixed(self.length_value(mm), decimals_of(like, 3))
    }

    /// What a value in `unit` is multiplied by, and the unit that it has then: the chosen one where `unit` is one of
    /// lengths or angles.
    pub(crate) fn of_unit(self, unit: &'static str) -> (f64, &'static str) {
        if let Some(name) = self.length.name_of_rate(unit) {
            return (self.length_value(1.0), name);
        }
        match unit {
            "°" => (
                self.angle_value(rad_from_deg(1.0)),
                self.angle_name().trim(),
            ),
            other => (1.0, other),
        }
    }

    /// Those in which sentences of this thread speak.
    pub(crate) fn spoken() -> Self {
        let (length, angle) = current_units();
        Self { length, angle }
    }

    /// A value in `unit` with its interval, in the chosen unit where `unit` is one of lengths or angles.
    pub fn with_interval(
        self,
        value: f64,
        interval: Option<[f64; 2]>,
        unit: &'static str,
    ) -> (String, String, &'static str) {
        // "not determined" is no number, and has no unit.
        let named = interval.is_some();
        let (factor, unit) = self.of_unit(unit);
        let interval = interval.map(|ends| ends.map(|end| factor * end));
        let [value, half, _] = with_interval(factor * value, interval);
        (value, half, if named { unit } else { "" })
    }

    /// A parameter with half of its interval, and the name of its unit; what was chosen of a list has no interval.
    pub fn estimate(self, one: &Estimate, unit: &'static str) -> (String, String, &'static str) {
        if one.is_chosen() {
            let (factor, unit) = self.of_unit(unit);
            return (trimmed(factor * one.value, 4), String::new(), unit);
        }
        self.with_interval(one.value, one.ci95, unit)
    }

    /// An angle with its unit.
    pub fn angle(self, rad: f64) -> String {
        match self.angle {
            AngleUnit::Degree => format!("{}°", trimmed(deg_from_rad(rad), 2)),
            AngleUnit::Radian => format!("{} rad", trimmed(rad, 4)),
            AngleUnit::Milliradian => format!("{} mrad", trimmed(rad * 1000.0, 2)),
            AngleUnit::ArcSecond => format!("{} arcsec", trimmed(deg_from_rad(rad) * 3600.0, 1)),
        }
    }
}

/// How many of the unit `into` one of this unit is; `None` where either is unknown, or they measure
/// different things.
fn factor(unit: &str, into: &str) -> Option<f64> {
    let mass = |unit: &str| match unit {
        "kg" => Some(1.0),
        "g" => Some(1e-3),
        "lb" => Some(0.453_592_37),
        _ => None,
    };
    if let (Some(own), Some(wanted)) = (mass(unit), mass(into)) {
        return Some(own / wanted);
    }
    match (word(unit)?, word(into)?) {
        (Word::Unit(Unit::Length(own)), Word::Unit(Unit::Length(wanted)))
        | (Word::Unit(Unit::Angle(own)), Word::Unit(Unit::Angle(wanted)))
        | (Word::Time(own), Word::Time(wanted)) => Some(own / wanted),
        _ => None,
    }
}

/// A number as it was typed, in the unit `into`; its unit is `usual` unless another of the same
/// quantity stands behind it. What is wrong with it otherwise.
///
/// # Errors
/// It is no number, or its unit is unknown or of another quantity.
pub fn typed_in(text: &str, usual: &str, into: &str) -> Result<f64, String> {
    let text = text.trim();
    if let Some(value) = typed(text) {
        return Ok(value * factor(usual, into).filter(|_| usual != into).unwrap_or(1.0));
    }
    let number = text.trim_end_matches(|c: char| !c.is_ascii_digit());
    let value = typed(number).ok_or_else(|| say!("'{text}' is not a number", text))?;
    let unit = text[number.len()..].trim();
    let known = [
        "mm, µm, m, in, thou",
        "°, rad, mrad, arcsec",
        "kg, g, lb",
        "s, ms, min",
    ];
    let known = known
        .iter()
        .find(|all| factor(all.split(", ").next().unwrap_or(""), into).is_some());
    match (factor(unit, into), known) {
        (Some(factor), _) => Ok(value * factor),
        (None, Some(known)) => Err(say!(
            "'{unit}' is not a unit here; known are {known}",
            unit,
            known
        )),
        (None, None) => Err(say!(
            "'{unit}' after the number: this number has no unit",
            unit
        )),
    }
}

/// A quantity with its unit, at the head of a column or beside an axis.
#[doc(hidden)]
pub fn in_unit(quantity: &str, unit: &str) -> String {
    say!("{quantity}, {unit}", quantity, unit)
}

#[cfg(test)]
mod tests {
    use super::super::numbers::{Notation, write_numbers};
    use super::*;

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
    fn what_was_chosen_of_a_list_is_no_value_that_is_not_determined() {
        let shown = |effect, name, value, unit, length| {
            let units = Units {
                length,
                ..Units::default()
            };
            let one = Estimate {
                effect,
                joint: Some(0),
                setup: None,
                target: None,
                place: None,
                name,
                value,
                ci95: None,
            };
            let (value, half, unit) = units.estimate(&one, unit);
            format!("{value} {half}{unit}")
        };
        let millimetres = LengthUnit::Millimetre;
        let pitch = |value, length| shown("screw-pitch", "lead_mm", value, "mm", length);
        assert_eq!(pitch(40.0, millimetres), "40 mm");
        assert_eq!(pitch(25.4, LengthUnit::Inch), "1 in");
        let order = |value| shown("gear-transmission-error", "order", value, "", millimetres);
        assert_eq!(order(100.0), "100 ");
        assert_eq!(order(100.6), "100.600 not determined");
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
    fn a_typed_unit_is_converted_and_an_unknown_one_refused() {
        let mm = |text| typed_in(text, "mm", "mm");
        assert_eq!(mm(" 0,2 "), Ok(0.2));
        assert_eq!(mm("8 thou"), Ok(8.0 * 1e-3 * 25.4));
        assert_eq!(mm("30 µm"), Ok(0.03));
        assert_eq!(mm("0.03 m"), Ok(30.0));
        assert_eq!(typed_in("62", "°", "rad"), Ok(rad_from_deg(62.0)));
        assert_eq!(typed_in("7 rad", "°", "rad"), Ok(7.0));
        assert_eq!(typed_in("3600 arcsec", "°", "°").map(f64::round), Ok(1.0));
        for (text, says) in [
            ("abc", "'abc' is not a number"),
            ("", "'' is not a number"),
            ("8 furlongs", "'furlongs' is not a unit here"),
            ("8 deg", "'deg' is not a unit here"),
            ("1e999", "is not a number"),
        ] {
            assert!(mm(text).is_err_and(|e| e.contains(says)), "{text}");
        }
        assert!(typed_in("8 mm", "", "").is_err_and(|e| e.contains("no unit")));
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
