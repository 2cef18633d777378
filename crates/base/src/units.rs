//! Conversions of units at the edges of the program.
//!
//! Inside, every quantity is in one fixed unit, which is part of its name: lengths in mm, angles in rad, times in s,
//! masses in kg, temperatures in °C, torques in N·m. Files and screens use the units of technicians; they convert here
//! and nowhere else.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

/// Degrees of half a turn: a phase that is known no better is not known.
#[doc(hidden)]
pub const HALF_TURN_DEG: f64 = 180.0;
/// Millimetres of a metre.
#[doc(hidden)]
pub const MM_PER_M: f64 = 1e3;
/// A longer length, mm, is none of a robot or of what measures it.
#[doc(hidden)]
pub const LARGEST_LENGTH_MM: f64 = 1e7;
/// A larger number of a robot, in its own unit, is none: a joint's value in degrees or mm, a mass, gravity, what a
/// description states in metres.
#[doc(hidden)]
pub const LARGEST_NUMBER: f64 = 1e6;
/// A larger time, s, is none: a clock that counts nanoseconds from 1970 stays below it.
#[doc(hidden)]
pub const LARGEST_TIME_S: f64 = 1e20;

/// Unit of lengths for a reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LengthUnit {
    /// 1 mm.
    #[default]
    Millimetre,
    /// 0.001 mm.
    Micrometre,
    /// 25.4 mm.
    Inch,
}

impl LengthUnit {
    /// A length in this unit.
    pub fn of_mm(self, mm: f64) -> f64 {
        match self {
            Self::Millimetre => mm,
            Self::Micrometre => mm * 1000.0,
            Self::Inch => mm / 25.4,
        }
    }

    /// Its sign.
    pub fn name(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Micrometre => "µm",
            Self::Inch => "in",
        }
    }

    /// The sign of a unit of lengths for a temperature, a load or a time, as in `mm/kg`; `None`: it is of something else.
    pub fn name_of_rate(self, unit: &str) -> Option<&'static str> {
        Some(match (unit, self) {
            ("mm", _) => self.name(),
            ("mm/kg", Self::Millimetre) => "mm/kg",
            ("mm/kg", Self::Micrometre) => "µm/kg",
            ("mm/kg", Self::Inch) => "in/kg",
            ("mm/h", Self::Millimetre) => "mm/h",
            ("mm/h", Self::Micrometre) => "µm/h",
            ("mm/h", Self::Inch) => "in/h",
            ("mm/°C", Self::Millimetre) => "mm/°C",
            ("mm/°C", Self::Micrometre) => "µm/°C",
            ("mm/°C", Self::Inch) => "in/°C",
            _ => return None,
        })
    }
}

/// Unit of angles for a reader.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AngleUnit {
    /// 1°.
    #[default]
    Degree,
    /// 1 rad.
    Radian,
    /// 0.001 rad.
    Milliradian,
    /// 1/3600°.
    ArcSecond,
}

impl AngleUnit {
    /// An angle in this unit.
    pub fn of_rad(self, rad: f64) -> f64 {
        match self {
            Self::Degree => deg_from_rad(rad),
            Self::Radian => rad,
            Self::Milliradian => rad * 1000.0,
            Self::ArcSecond => deg_from_rad(rad) * 3600.0,
        }
    }

    /// Its sign, as it is after a number.
    pub fn name(self) -> &'static str {
        match self {
            Self::Degree => "°",
            Self::Radian => " rad",
            Self::Milliradian => " mrad",
            Self::ArcSecond => " arcsec",
        }
    }
}

/// Degrees to radians.
#[inline]
pub fn rad_from_deg(deg: f64) -> f64 {
    deg * (PI / 180.0)
}

/// Radians to degrees.
#[inline]
pub fn deg_from_rad(rad: f64) -> f64 {
    rad * (180.0 / PI)
}

/// An angle brought into [0, 2π).
pub fn wrapped_positive(rad: f64) -> f64 {
    let turn = 2.0 * PI;
    let wrapped = rad.rem_euclid(turn);
    // rem_euclid rounds a tiny negative angle up to a whole turn.
    if wrapped >= turn { 0.0 } else { wrapped }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tiny_negative_angle_does_not_become_a_whole_turn() {
        assert_eq!(wrapped_positive(-1e-20), 0.0);
        assert!((wrapped_positive(-PI / 2.0) - 1.5 * PI).abs() < 1e-15);
    }
}
