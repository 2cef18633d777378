//! Lengths and angles in sentences: in the units that the reader chose for this thread, and in millimetres and the
//! sentence's own unit of angles by default, as in files, in the terminal and on paper.

use std::cell::Cell;

use crate::units::{AngleUnit, LengthUnit};

thread_local! {
    static UNITS: Cell<(LengthUnit, AngleUnit)> =
        const { Cell::new((LengthUnit::Millimetre, AngleUnit::Degree)) };
}

/// While this lives, quantities in sentences of this thread have these units.
#[doc(hidden)]
pub struct InUnits((LengthUnit, AngleUnit));

impl InUnits {
    pub fn begin(units: (LengthUnit, AngleUnit)) -> Self {
        Self(UNITS.replace(units))
    }

    /// As documents have them.
    pub fn of_documents() -> Self {
        Self::begin(Default::default())
    }
}

impl Drop for InUnits {
    fn drop(&mut self) {
        UNITS.set(self.0);
    }
}

/// The units of lengths and angles on this thread.
#[doc(hidden)]
pub fn current_units() -> (LengthUnit, AngleUnit) {
    UNITS.get()
}

/// What a quantity measures, and its unit in documents.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Dimension {
    /// mm.
    Length,
    /// An angle of a joint, in degrees.
    Angle,
    /// An error of an orientation, in mrad.
    SmallAngle,
}

/// What several values are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Several {
    /// Before and after.
    Change,
    /// Components of a vector.
    Components,
}

impl Several {
    fn between(self) -> &'static str {
        match self {
            Self::Change => " → ",
            Self::Components => ", ",
        }
    }
}

/// One quantity, several, or how it changes from one to the next. Texts are compared and ordered, so that it holds bits.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Quantity {
    dimension: Dimension,
    /// mm or rad.
    values: Vec<u64>,
    several: Several,
    /// Digits behind the point in the unit of documents.
    decimals: usize,
    /// Whether it is entered in a machine: as fine in every unit.
    entered: bool,
}

impl Quantity {
    pub(super) fn new(
        dimension: Dimension,
        (values, several): (&[f64], Several),
        decimals: usize,
    ) -> Self {
        Self {
            dimension,
            several,
            values: values.iter().map(|value| value.to_bits()).collect(),
            decimals,
            entered: false,
        }
    }

    /// The same as it is entered in a machine.
    pub(super) fn entered(self) -> Self {
        Self {
            entered: true,
            ..self
        }
    }

    /// Digits behind the point with which a length in this unit is as fine as in that of documents.
    fn as_fine_in(&self, unit: LengthUnit) -> usize {
        match unit {
            LengthUnit::Millimetre => self.decimals,
            LengthUnit::Micrometre => self.decimals.saturating_sub(3),
            LengthUnit::Inch => self.decimals + 2,
        }
    }

    /// In these units: in that of documents with its decimals, in another one with three digits, or as fine.
    pub(super) fn spoken(&self, (length, angle): (LengthUnit, AngleUnit)) -> String {
        let of_documents = match self.dimension {
            Dimension::Length => length == LengthUnit::default(),
            Dimension::Angle | Dimension::SmallAngle => angle == AngleUnit::default(),
        };
        let angle = match self.dimension {
            Dimension::SmallAngle if of_documents => AngleUnit::Milliradian,
            _ => angle,
        };
        let number = |bits: &u64| {
            let value = f64::from_bits(*bits);
            let value = match self.dimension {
                Dimension::Length => length.of_mm(value),
                Dimension::Angle | Dimension::SmallAngle => angle.of_rad(value),
            };
            if of_documents {
                format!("{value:.*}", self.decimals)
            } else if self.entered {
                format!("{value:.*}", self.as_fine_in(length))
            } else {
                three_digits(value)
            }
        };
        let numbers: Vec<String> = self.values.iter().map(number).collect();
        let (numbers, name) = (numbers.join(self.several.between()), angle.name());
        match self.dimension {
            Dimension::Length => format!("{numbers} {}", length.name()),
            Dimension::Angle | Dimension::SmallAngle => format!("{numbers}{name}"),
        }
    }
}

fn three_digits(value: f64) -> String {
    const MOST: usize = 9;
    let size = value.abs();
    let mut powers = std::iter::successors(Some(1.0), |power| Some(power * 10.0)).take(MOST);
    // Behind the point so many that three digits are before it once it is moved by them.
    let decimals = powers.position(|power| size * power >= 100.0);
    let decimals = if size > 0.0 {
        decimals.unwrap_or(MOST)
    } else {
        2
    };
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::{Language, angle, current, entered, length, lengths, small_angle};

    #[test]
    fn a_sentence_has_the_unit_that_the_reader_chose_and_a_file_has_millimetres() {
        let says = text!("their RMS error is {error}", error = length(0.0254, 4));
        let here = || says.spoken_with(current(), false);
        assert_eq!(here(), "their RMS error is 0.0254 mm");
        {
            let _inches = InUnits::begin((LengthUnit::Inch, AngleUnit::default()));
            assert_eq!(here(), "their RMS error is 0.00100 in");
            let _again = InUnits::begin((LengthUnit::Micrometre, AngleUnit::default()));
            assert_eq!(here(), "their RMS error is 25.4 µm");
            assert_eq!(says.to_string(), "their RMS error is 0.0254 mm");
            assert_eq!(
                says.spoken_in(Language::English),
                "their RMS error is 25.4 µm"
            );
        }
        let place = entered([250.0, 2.5]);
        assert_eq!(place.to_string(), "250.0000, 2.5000 mm");
        {
            let _inches = InUnits::begin((LengthUnit::Inch, AngleUnit::default()));
            assert_eq!(place.spoken_with(current(), false), "9.842520, 0.098425 in");
        }
        assert_eq!(here(), "their RMS error is 0.0254 mm");
        assert_eq!(lengths([0.135, 0.054], 3).to_string(), "0.135 → 0.054 mm");
    }

    #[test]
    fn angles_have_the_unit_that_the_reader_chose_too() {
        let (turn, left) = (angle(0.5, 1), small_angle(0.00123, 2));
        assert_eq!(turn.to_string(), "28.6°");
        assert_eq!(left.to_string(), "1.23 mrad");
        let _radians = InUnits::begin((LengthUnit::default(), AngleUnit::Radian));
        assert_eq!(turn.spoken_with(current(), false), "0.500 rad");
        assert_eq!(left.spoken_with(current(), false), "0.00123 rad");
        assert_eq!(left.to_string(), "1.23 mrad");
    }
}
