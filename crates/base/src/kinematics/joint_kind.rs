//! The kinds of joints: revolute and prismatic.

use crate::units::{deg_from_rad, rad_from_deg};

named! {
    /// What a joint does with its value.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum JointKind {
        /// Turns about its axis; the value is an angle in rad.
        Revolute = "revolute",
        /// Slides along its axis; the value is a length in mm.
        Prismatic = "prismatic",
    }
    /// Its word in files.
    pub fn name;
}

impl JointKind {
    /// The user's unit of its values, as in names in files: `deg` or `mm`.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Revolute => "deg",
            Self::Prismatic => "mm",
        }
    }

    /// The same unit, as written behind a number.
    pub fn sign(self) -> &'static str {
        match self {
            Self::Revolute => "°",
            Self::Prismatic => " mm",
        }
    }

    /// A value (rad or mm) in the user's unit.
    pub fn to_display(self, inner: f64) -> f64 {
        match self {
            Self::Revolute => deg_from_rad(inner),
            Self::Prismatic => inner,
        }
    }

    /// A value in the user's unit in rad or mm.
    pub fn to_base_units(self, outer: f64) -> f64 {
        match self {
            Self::Revolute => rad_from_deg(outer),
            Self::Prismatic => outer,
        }
    }
}
