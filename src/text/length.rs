//! Lengths in sentences: said in the unit that the reader chose for this thread, and in millimetres by default,
//! as in files, in the terminal and on paper.

use std::cell::Cell;

use crate::units::LengthUnit;

thread_local! {
    static UNIT: Cell<LengthUnit> = const { Cell::new(LengthUnit::Millimetre) };
}

/// While this lives, lengths in sentences of this thread have this unit.
pub(crate) struct InUnit(LengthUnit);

impl InUnit {
    pub(crate) fn begin(unit: LengthUnit) -> Self {
        Self(UNIT.replace(unit))
    }
}

impl Drop for InUnit {
    fn drop(&mut self) {
        UNIT.set(self.0);
    }
}

/// The unit of lengths on this thread.
pub(crate) fn current_unit() -> LengthUnit {
    UNIT.get()
}

/// One length, or how it changes from one to the next. Texts are compared and ordered, so that it holds bits.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Lengths {
    mm: Vec<u64>,
    /// Digits behind the point in millimetres.
    decimals: usize,
}

impl Lengths {
    pub(super) fn new(mm: &[f64], decimals: usize) -> Self {
        let mm = mm.iter().map(|mm| mm.to_bits()).collect();
        Self { mm, decimals }
    }

    /// In this unit: in mm with its decimals, in another one with three digits.
    pub(super) fn said(&self, unit: LengthUnit) -> String {
        let number = |bits: &u64| {
            let value = unit.of_mm(f64::from_bits(*bits));
            match unit {
                LengthUnit::Millimetre => format!("{value:.*}", self.decimals),
                _ => three_digits(value),
            }
        };
        let numbers: Vec<String> = self.mm.iter().map(number).collect();
        format!("{} {}", numbers.join(" → "), unit.name())
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
    use crate::text::{Language, current, length, lengths};

    #[test]
    fn a_sentence_has_the_unit_that_the_reader_chose_and_a_file_has_millimetres() {
        let says = text!("their RMS error is {error}", error = length(0.0254, 4));
        let here = || says.said(current(), false);
        assert_eq!(here(), "their RMS error is 0.0254 mm");
        {
            let _inches = InUnit::begin(LengthUnit::Inch);
            assert_eq!(here(), "their RMS error is 0.00100 in");
            let _again = InUnit::begin(LengthUnit::Micrometre);
            assert_eq!(here(), "their RMS error is 25.4 µm");
            assert_eq!(says.to_string(), "their RMS error is 0.0254 mm");
            assert_eq!(
                says.spoken_in(Language::English),
                "their RMS error is 25.4 µm"
            );
        }
        assert_eq!(here(), "their RMS error is 0.0254 mm");
        assert_eq!(lengths([0.135, 0.054], 3).to_string(), "0.135 → 0.054 mm");
    }
}
