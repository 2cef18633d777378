//! What things are drawn in: tokens of the style, which each theme and paper turn into colours.

use egui::Color32;

use crate::gui::layers::scale_at;
use crate::gui::style::tokens::Palette;
use crate::gui::view::Colouring;

/// What a colour stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ColourToken {
    Before,
    After,
    Nominal,
    Within,
    Outside,
    Warning,
    Accent,
    Text,
    Muted,
    /// A hairline.
    Line,
    /// A line of the ground through the origin.
    Axis,
    Surface,
    /// One of the two greys of sectors.
    Sector(usize),
    /// What colour says, from 0 to 1.
    Scale(Colouring, f32),
    /// A body, by how much it is turned to the light, from 0 to 1.
    Lit(f32),
}

/// How much of the robot's colour a face has that is turned to the light, and one that is not, on a
/// surface that is lighter than that colour, and on one that is darker.
const ON_LIGHT: [f32; 2] = [0.16, 0.78];
const ON_DARK: [f32; 2] = [0.95, 0.28];

impl ColourToken {
    fn color(self, palette: &Palette) -> Color32 {
        match self {
            Self::Before => palette.before,
            Self::After => palette.after,
            Self::Nominal => palette.nominal,
            Self::Within => palette.within,
            Self::Outside => palette.outside,
            Self::Warning => palette.warning,
            Self::Accent => palette.accent,
            Self::Text => palette.text,
            Self::Muted => palette.muted,
            Self::Line => palette.line,
            Self::Axis => palette.line.lerp_to_gamma(palette.nominal, 0.4),
            Self::Surface => palette.surface,
            Self::Sector(k) => palette.sectors[k % 2],
            Self::Scale(colouring, part) => scale_at(colouring, palette, part),
            Self::Lit(turned) => {
                let bright = |c: Color32| u16::from(c.r()) + u16::from(c.g()) + u16::from(c.b());
                let on_light = bright(palette.surface) > bright(palette.nominal);
                let [lit, dark] = if on_light { ON_LIGHT } else { ON_DARK };
                let shade = dark + (lit - dark) * turned;
                palette.surface.lerp_to_gamma(palette.nominal, shade)
            }
        }
    }

    /// So much of it, and what is beneath shows through.
    pub(crate) fn clear(self, part: f32) -> Tint {
        let through = true;
        Tint {
            token: self,
            part,
            through,
        }
    }

    /// So much of it, and the rest is the surface.
    pub(crate) fn pale(self, part: f32) -> Tint {
        let through = false;
        Tint {
            token: self,
            part,
            through,
        }
    }
}

/// A token, whole or in part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tint {
    token: ColourToken,
    part: f32,
    through: bool,
}

impl From<ColourToken> for Tint {
    fn from(token: ColourToken) -> Self {
        token.clear(1.0)
    }
}

impl Tint {
    /// Its colour in a theme.
    pub(crate) fn color(self, palette: &Palette) -> Color32 {
        let color = self.token.color(palette);
        if self.part == 1.0 {
            color
        } else if self.through {
            color.gamma_multiply(self.part)
        } else {
            palette.surface.lerp_to_gamma(color, self.part)
        }
    }
}

/// How a line is drawn: its width, and of dashes their length and the gap between them, points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) width: f32,
    pub(crate) colour: Tint,
    pub(crate) dash: Option<[f32; 2]>,
}

impl Stroke {
    pub(crate) fn new(width: f32, ink: impl Into<Tint>) -> Self {
        Self {
            width,
            colour: ink.into(),
            dash: None,
        }
    }

    pub(crate) fn dashed(self, dash: f32, gap: f32) -> Self {
        Self {
            dash: Some([dash, gap]),
            ..self
        }
    }
}
