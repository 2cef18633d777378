//! What the user wants to see: units, digits, light or dark, size of text. Kept from one day to the
//! next by `file_state`.

use egui::{Context, ThemePreference, Vec2};
use serde::{Deserialize, Serialize};

use crate::present::numbers::Notation;
use crate::present::units::{AngleUnit, LengthUnit};
use crate::text::{Language, current};

/// Light, dark, or as the system has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Theme {
    #[default]
    System,
    /// For a bright hall.
    Light,
    /// For a dim one.
    Dark,
}

impl Theme {
    /// What egui calls it.
    pub(crate) fn preference(self) -> ThemePreference {
        match self {
            Self::System => ThemePreference::System,
            Self::Light => ThemePreference::Light,
            Self::Dark => ThemePreference::Dark,
        }
    }
}

/// Smallest and largest size of text, in parts of the usual one.
pub(crate) const ZOOM: std::ops::RangeInclusive<f32> = 0.6..=3.0;
/// The smallest window in which everything fits, points (1280 × 800 with text of 200 %, see `tests/window/sizes.rs`):
/// larger text would overlap.
const LEAST_ROOM: Vec2 = Vec2::new(640.0, 400.0);

/// The largest size of text that this window has room for.
pub(crate) fn largest_zoom(ctx: &Context) -> f32 {
    let usual = ctx.zoom_factor() * ctx.content_rect().size();
    let fits = (usual / LEAST_ROOM).min_elem();
    fits.clamp(1.0, *ZOOM.end())
}

/// Most decimals of a length.
const MOST_DECIMALS: u8 = 6;

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct Preferences {
    /// `None`: that of the system, where it is offered.
    pub(crate) language: Option<Language>,
    pub(crate) length: LengthUnit,
    pub(crate) angle: AngleUnit,
    /// Decimals of lengths; `None`: as many as can be read.
    pub(crate) decimals: Option<u8>,
    /// Whether decimals follow a comma; `None`: as the language has it.
    pub(crate) comma: Option<bool>,
    /// Light or dark.
    pub(crate) theme: Theme,
    /// Size of text, in parts of the usual one.
    pub(crate) zoom: f32,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            language: None,
            length: LengthUnit::default(),
            angle: AngleUnit::default(),
            decimals: None,
            comma: None,
            theme: Theme::default(),
            zoom: 1.0,
        }
    }
}

impl Preferences {
    /// How numbers are written in the language that is spoken.
    pub(crate) fn notation(&self) -> Notation {
        Notation {
            decimals: self.decimals,
            comma: self.comma.unwrap_or(current() == Language::German),
        }
    }

    /// The unit of lengths behind this one, and how it is offered.
    pub(crate) fn next_length(&self) -> (LengthUnit, &'static str) {
        match self.length {
            LengthUnit::Millimetre => (LengthUnit::Micrometre, say!("Lengths in µm")),
            LengthUnit::Micrometre => (LengthUnit::Inch, say!("Lengths in inches")),
            LengthUnit::Inch => (LengthUnit::Millimetre, say!("Lengths in mm")),
        }
    }

    /// The unit of angles behind this one, and how it is offered.
    pub(crate) fn next_angle(&self) -> (AngleUnit, &'static str) {
        match self.angle {
            AngleUnit::Degree => (AngleUnit::Radian, say!("Angles in radians")),
            AngleUnit::Radian => (AngleUnit::Milliradian, say!("Angles in mrad")),
            AngleUnit::Milliradian => (AngleUnit::ArcSecond, say!("Angles in arcsec")),
            AngleUnit::ArcSecond => (AngleUnit::Degree, say!("Angles in degrees")),
        }
    }

    /// The same, with every number in the range that it can have.
    #[must_use]
    pub(crate) fn sound(mut self) -> Self {
        self.decimals = self.decimals.map(|d| d.min(MOST_DECIMALS));
        self.zoom = if self.zoom.is_finite() {
            self.zoom.clamp(*ZOOM.start(), *ZOOM.end())
        } else {
            1.0
        };
        self
    }
}
