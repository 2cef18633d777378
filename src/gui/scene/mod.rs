//! What is seen: lines, faces, vectors, marks and labels in mm, with sizes in points and tokens of the style as
//! colours. The model of a view decides what is in its scene; the [`Screen`](screen::Screen) draws it through a
//! [`Camera`](paint::Camera).

pub(crate) mod paint;
pub(crate) mod screen;

use std::sync::Arc;

use egui::{Align2, Color32};

use crate::gui::cache::cloud::{Cloud, Remainder};
use crate::gui::cache::heat::Heat;
use crate::gui::layers::{LayerOptions, scale_at};
use crate::gui::style::{Palette, size};
use crate::gui::view::Colouring;

/// A place: mm, and so many points from there to the right and down in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    pub(crate) at: [f64; 3],
    pub(crate) aside: [f32; 2],
}

impl From<[f64; 3]> for Place {
    fn from(at: [f64; 3]) -> Self {
        let aside = [0.0; 2];
        Self { at, aside }
    }
}

impl Place {
    /// So many points to the right and down from here.
    pub(crate) fn shifted(self, right: f32, down: f32) -> Self {
        let [x, y] = self.aside;
        Self {
            at: self.at,
            aside: [x + right, y + down],
        }
    }
}

/// The form of a mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Form {
    Disc,
    /// A square on its tip.
    Diamond,
    Square,
}

/// A sign as large at any zoom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Mark {
    pub(crate) at: Place,
    pub(crate) form: Form,
    /// Points.
    pub(crate) radius: f32,
    pub(crate) fill: Option<Tint>,
    pub(crate) edge: Option<Stroke>,
}

impl Mark {
    /// Filled.
    pub(crate) fn filled(
        at: impl Into<Place>,
        form: Form,
        radius: f32,
        fill: impl Into<Tint>,
    ) -> Self {
        Self {
            fill: Some(fill.into()),
            ..Self::bare(at, form, radius)
        }
    }

    /// An outline.
    pub(crate) fn ring(at: impl Into<Place>, form: Form, radius: f32, edge: Stroke) -> Self {
        Self::bare(at, form, radius).edged(edge)
    }

    fn bare(at: impl Into<Place>, form: Form, radius: f32) -> Self {
        Self {
            at: at.into(),
            form,
            radius,
            fill: None,
            edge: None,
        }
    }

    pub(crate) fn edged(self, edge: Stroke) -> Self {
        Self {
            edge: Some(edge),
            ..self
        }
    }
}

/// Words at a place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Label {
    pub(crate) at: Place,
    pub(crate) text: String,
    pub(crate) colour: Tint,
    pub(crate) anchor: Align2,
    /// Points.
    pub(crate) size: f32,
    pub(crate) bold: bool,
    /// What is longer is cut, points; whole where the pointer is on it.
    pub(crate) most: Option<f32>,
}

impl Label {
    pub(crate) fn new(at: impl Into<Place>, text: impl Into<String>, ink: impl Into<Tint>) -> Self {
        Self {
            at: at.into(),
            text: text.into(),
            colour: ink.into(),
            anchor: Align2::CENTER_CENTER,
            size: size::SMALL,
            bold: false,
            most: None,
        }
    }
}

/// A triangle, mm.
pub(crate) type Triangle = [[f32; 3]; 3];

/// One thing in a scene.
#[derive(Debug, Clone)]
pub(crate) enum Item {
    /// Through its places.
    Line(Vec<Place>, Stroke),
    /// The area that places enclose: convex, whatever their order.
    Area(Vec<Place>, Option<Tint>, Option<Stroke>),
    /// Without edges, so that neighbours leave no seams; the first is at the bottom.
    Triangles(Vec<(Triangle, Tint)>),
    /// A net of coloured corners, so many in a row.
    Net(Vec<(Place, Tint)>, usize),
    /// An arrow.
    Vector([Place; 2], Stroke),
    Mark(Mark),
    Label(Label),
    Layer(Layer),
}

/// What the graphics processor draws for any number of samples.
#[derive(Debug, Clone)]
pub(crate) enum Layer {
    Samples(Samples),
    /// The error between samples.
    Heat(Arc<Heat>, LayerOptions),
}

/// Measured points and error vectors.
#[derive(Debug, Clone)]
pub(crate) struct Samples {
    pub(crate) cloud: Arc<Cloud>,
    /// What an answer leaves.
    pub(crate) remainder: Option<Arc<Remainder>>,
    pub(crate) look: LayerOptions,
    /// So many of their points, and so many of their vectors.
    pub(crate) counts: [usize; 2],
}

/// What is seen, bottom first.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scene {
    pub(crate) items: Vec<Item>,
}

impl Scene {
    pub(crate) fn line(&mut self, ends: [[f64; 3]; 2], stroke: Stroke) {
        self.items
            .push(Item::Line(ends.map(Place::from).to_vec(), stroke));
    }

    pub(crate) fn mark(&mut self, mark: Mark) {
        self.items.push(Item::Mark(mark));
    }

    pub(crate) fn label(&mut self, label: Label) {
        self.items.push(Item::Label(label));
    }
}

/// A name in a legend, with its sign: points to the right and up of its middle.
#[derive(Debug, Clone)]
pub(crate) struct LegendEntry {
    pub(crate) name: String,
    pub(crate) sign: Vec<Item>,
    /// Points.
    pub(crate) wide: f32,
}

/// Width of the sign of a mark or a line, points.
pub(crate) const SIGN: f32 = 14.0;

impl LegendEntry {
    fn new(name: impl Into<String>, sign: Item) -> Self {
        Self {
            name: name.into(),
            sign: vec![sign],
            wide: SIGN,
        }
    }

    /// A piece of a line.
    pub(crate) fn line(name: impl Into<String>, stroke: Stroke) -> Self {
        Self::new(name, Item::Line(across(), stroke))
    }

    pub(crate) fn mark(name: impl Into<String>, mark: Mark) -> Self {
        Self::new(name, Item::Mark(mark))
    }
}

/// The ends of a line in a legend.
fn across() -> Vec<Place> {
    [-7.0, 7.0].map(|x| Place::from([x, 0.0, 0.0])).to_vec()
}

/// What a colour stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ColourToken {
    Before,
    After,
    Nominal,
    Within,
    Outside,
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

/// How a line is drawn: its width, points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) width: f32,
    pub(crate) colour: Tint,
}

impl Stroke {
    pub(crate) fn new(width: f32, ink: impl Into<Tint>) -> Self {
        Self {
            width,
            colour: ink.into(),
        }
    }
}
