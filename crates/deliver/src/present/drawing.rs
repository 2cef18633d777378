//! Lines, shapes and text on a sheet: what plots and pages are made of before they become SVG or
//! PDF. Lengths in points (1/72 inch), x to the right, y down.

/// A colour, red, green, blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

/// Text and lines that carry the message.
pub const INK: Colour = Colour(0x1b, 0x1f, 0x27);
/// Text and lines beside it.
pub const MUTED: Colour = Colour(0x5b, 0x64, 0x72);
/// Grid lines and rules.
pub const RULE: Colour = Colour(0xd9, 0xdd, 0xe3);
/// Ground of table heads and boxes.
pub const GROUND: Colour = Colour(0xf4, 0xf6, 0xf9);
/// What was measured.
pub const BEFORE: Colour = Colour(0xb4, 0x53, 0x09);
/// What corrected commands leave.
pub const CORRECTED: Colour = Colour(0x0f, 0x76, 0x6e);
/// What the model leaves.
pub const AFTER: Colour = Colour(0x1d, 0x5f, 0xa8);
/// The tolerance.
pub const TOLERANCE: Colour = Colour(0x2e, 0x7d, 0x32);
/// Paper.
pub const WHITE: Colour = Colour(0xff, 0xff, 0xff);

/// Width of the line around an area in its own colour, points.
pub const OVERLAP: f64 = 0.3;

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Width, points.
    pub width: f64,
    /// Colour.
    pub colour: Colour,
    /// Lengths of dash and gap; zero: a whole line.
    pub dash: [f64; 2],
}

impl Stroke {
    /// A whole line.
    pub fn new(width: f64, colour: Colour) -> Self {
        let dash = [0.0; 2];
        Self {
            width,
            colour,
            dash,
        }
    }

    /// The same, dashed.
    #[must_use]
    pub fn dashed(self, dash: f64, gap: f64) -> Self {
        Self {
            dash: [dash, gap],
            ..self
        }
    }
}

/// Where a text stands beside its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// It starts there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// A line of text; its point is on the base line.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// Where.
    pub at: [f64; 2],
    /// What.
    pub text: String,
    /// Size, points.
    pub size: f64,
    /// Colour.
    pub colour: Colour,
    /// Heavier.
    pub bold: bool,
    /// Side.
    pub anchor: Anchor,
    /// Turned to read upwards.
    pub upwards: bool,
}

impl Label {
    /// A text that starts at a point.
    pub fn new(at: [f64; 2], text: impl Into<String>, size: f64, colour: Colour) -> Self {
        Self {
            at,
            text: text.into(),
            size,
            colour,
            bold: false,
            anchor: Anchor::Start,
            upwards: false,
        }
    }

    /// The same on another side of its point.
    #[must_use]
    pub fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The same in semi-bold.
    #[must_use]
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }
}

/// The form of a mark: forms differ as well as colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Triangle, tip up.
    Up,
    /// Triangle, tip down.
    Down,
    /// Square.
    Square,
    /// Square on its tip.
    Diamond,
}

impl Shape {
    /// Its corners about the origin, for a half width of 1.
    pub fn corners(self) -> &'static [[f64; 2]] {
        match self {
            Self::Up => &[[0.0, -1.15], [1.0, 0.75], [-1.0, 0.75]],
            Self::Down => &[[0.0, 1.15], [1.0, -0.75], [-1.0, -0.75]],
            Self::Square => &[[-0.8, -0.8], [0.8, -0.8], [0.8, 0.8], [-0.8, 0.8]],
            Self::Diamond => &[[0.0, -1.15], [1.15, 0.0], [0.0, 1.15], [-1.15, 0.0]],
        }
    }
}

/// One thing on the sheet.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// Separate lines of one stroke, each through its points.
    Lines(Vec<Vec<[f64; 2]>>, Stroke),
    /// A filled rectangle: corner, width, height.
    Box([f64; 2], [f64; 2], Colour),
    /// Filled convex polygons, the first at the bottom. Each reaches [`OVERLAP`] over its edges, so that
    /// no paper shows between neighbours.
    Areas(Vec<(Vec<[f64; 2]>, Colour)>),
    /// Marks of one kind: centres, half width; filled, or an outline on white.
    Marks {
        /// Form.
        shape: Shape,
        /// Centres.
        at: Vec<[f64; 2]>,
        /// Half width, points.
        half: f64,
        /// Colour of the filling or the outline.
        colour: Colour,
        /// Filled.
        filled: bool,
    },
    /// Text.
    Text(Label),
}

/// A sheet.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// Width, points.
    pub width: f64,
    /// Height, points.
    pub height: f64,
    /// Bottom first.
    pub items: Vec<Item>,
}

impl Drawing {
    /// An empty sheet.
    pub fn new(width: f64, height: f64) -> Self {
        let items = Vec::new();
        Self {
            width,
            height,
            items,
        }
    }

    /// Adds a straight line.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: Stroke) {
        self.items.push(Item::Lines(vec![vec![from, to]], stroke));
    }

    /// Adds text.
    pub fn text(&mut self, label: Label) {
        self.items.push(Item::Text(label));
    }

    /// Puts another sheet on this one with its corner at `at`.
    pub fn place(&mut self, other: &Drawing, at: [f64; 2]) {
        let move_point = |p: &mut [f64; 2]| {
            p[0] += at[0];
            p[1] += at[1];
        };
        for item in &other.items {
            let mut item = item.clone();
            match &mut item {
                Item::Lines(lines, _) => lines.iter_mut().flatten().for_each(move_point),
                Item::Box(corner, _, _) => move_point(corner),
                Item::Areas(areas) => areas.iter_mut().flat_map(|a| &mut a.0).for_each(move_point),
                Item::Marks { at, .. } => at.iter_mut().for_each(move_point),
                Item::Text(label) => move_point(&mut label.at),
            }
            self.items.push(item);
        }
    }
}
