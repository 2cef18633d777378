//! What a chart shows: its axes, what is drawn in it, and its legend.

use crate::present::drawing::Anchor;
use crate::text::capital;

/// What something stands for; each back end has a colour for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourRole {
    /// The deviation as measured.
    Before,
    /// What the model leaves.
    After,
    /// What corrected commands leave.
    Corrected,
    /// A reference: zero, a boundary.
    Reference,
    /// The tolerance.
    Tolerance,
    /// What noise alone does.
    Noise,
    /// The curve that a model has.
    Curve,
}

/// The form of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// The side from which the joint came is not known.
    Disc,
    /// The joint moved in its positive direction.
    Forwards,
    /// The joint moved in its negative direction.
    Backwards,
    /// On samples that no fit has seen.
    Diamond,
}

impl Form {
    /// The form for a side: +1, −1, or 0 where it is not known.
    pub fn of_side(side: f64) -> Self {
        match side {
            s if s > 0.0 => Self::Forwards,
            s if s < 0.0 => Self::Backwards,
            _ => Self::Disc,
        }
    }
}

/// A mark at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    /// Where.
    pub at: [f64; 2],
    /// Its form.
    pub form: Form,
}

/// From corner to corner.
pub type Bar = [[f64; 2]; 2];

/// One thing on a chart.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// Between two heights, from side to side.
    Band([f64; 2], ColourRole),
    /// Bars, filled or outlined.
    Bars(Vec<Bar>, ColourRole, bool),
    /// Between two lines: places across, and from where to where upwards.
    Ribbon(Vec<[f64; 3]>, ColourRole),
    /// Through its points; width in points of the screen, dashed or whole.
    Line(Vec<[f64; 2]>, ColourRole, f32, bool),
    /// Marks, filled or outlined.
    Marks(Vec<Mark>, ColourRole, bool),
    /// A word beside a place.
    Word(ChartText),
}

impl Item {
    /// What it stands for; a word stands for nothing.
    pub fn colour_role(&self) -> Option<ColourRole> {
        match self {
            Self::Band(_, stands)
            | Self::Bars(_, stands, _)
            | Self::Ribbon(_, stands)
            | Self::Line(_, stands, ..)
            | Self::Marks(_, stands, _) => Some(*stands),
            Self::Word(_) => None,
        }
    }
}

/// A word that starts or ends at a place: in the middle of its height, or below.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartText {
    /// Where.
    pub at: [f64; 2],
    /// What it says; spaces keep it away from what stands there.
    pub text: String,
    /// Which part of it is there.
    pub anchor: Anchor,
    /// Whether its top is there.
    pub below: bool,
}

/// What stands before a name in the legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LegendSymbol {
    /// A mark.
    Mark(Form),
    /// A bar.
    Bar,
    /// A band.
    Band,
    /// A line.
    Line,
}

/// A name in the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Its name beside the chart.
    pub name: String,
    /// Its name on paper, which stands alone.
    pub on_paper: String,
    /// What stands before it.
    pub sign: LegendSymbol,
    /// What it stands for.
    pub role: ColourRole,
    /// Filled or whole; else outlined or dashed.
    pub filled: bool,
    /// Whether the reader may leave it out.
    pub may_go: bool,
}

impl Entry {
    /// A name that is the same everywhere.
    pub fn new(
        name: impl Into<String>,
        sign: LegendSymbol,
        role: ColourRole,
        filled: bool,
    ) -> Self {
        let name = name.into();
        Self {
            on_paper: name.clone(),
            name,
            sign,
            role,
            filled,
            may_go: false,
        }
    }

    /// The deviation as measured, which may be left out so that what is left can be seen.
    pub fn before(sign: LegendSymbol) -> Self {
        Self {
            may_go: true,
            ..Self::new(say!("before"), sign, ColourRole::Before, false)
                .on_paper(capital(say!("as measured")))
        }
    }

    /// What the model leaves.
    pub fn after(sign: LegendSymbol) -> Self {
        Self::new(say!("after"), sign, ColourRole::After, true).on_paper(say!("Model residuals"))
    }

    /// The same with another name on paper.
    #[must_use]
    pub fn on_paper(self, name: impl Into<String>) -> Self {
        Self {
            on_paper: name.into(),
            ..self
        }
    }
}

/// What stands at the ticks of an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Ticks {
    /// Round numbers.
    Numbers,
    /// Parts of a turn, in degrees.
    Degrees,
    /// Words, and where.
    Words(Vec<(f64, String)>),
    /// None: both axes lie in a plane, in one scale.
    Plane,
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What it shows, with the unit.
    pub label: String,
    /// What stands at its ticks.
    pub ticks: Ticks,
}

impl Axis {
    /// An axis with round numbers.
    pub fn numbers(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            ticks: Ticks::Numbers,
        }
    }

    /// An axis in degrees, or in something else.
    pub fn turning(label: impl Into<String>, degrees: bool) -> Self {
        let ticks = if degrees {
            Ticks::Degrees
        } else {
            Ticks::Numbers
        };
        Self {
            label: label.into(),
            ticks,
        }
    }
}

/// A chart: axes, lines, bars, marks and legend, in the units of its axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What it shows, in one line.
    pub title: String,
    /// The axis below.
    pub across: Axis,
    /// The axis beside it.
    pub upwards: Axis,
    /// Smallest and largest corner.
    pub bounds: Bar,
    /// Bottom first.
    pub items: Vec<Item>,
    /// What the marks are.
    pub legend: Vec<Entry>,
    /// What has to be said.
    pub note: String,
}

/// How lengths are written: the unit, a value in it, and a value with as many digits as can be read.
#[derive(Clone, Copy)]
pub struct Lengths<'a> {
    /// The unit.
    pub unit: &'a str,
    /// Units in a millimetre.
    pub per_mm: f64,
    /// A length in mm as a number.
    pub number: &'a dyn Fn(f64) -> String,
}

/// Whether a letter is as wide as it is high, as those of East Asian scripts with their marks are.
#[doc(hidden)]
pub fn is_wide(c: char) -> bool {
    matches!(c, '\u{2e80}'..='\u{9fff}' | '\u{ac00}'..='\u{d7a3}' | '\u{f900}'..='\u{faff}' | '\u{ff00}'..='\u{ff60}' | '\u{20000}'..='\u{3fffd}')
}

/// A name that leaves room for the rest of a label.
#[doc(hidden)]
pub fn shortened(name: &str, most: usize) -> String {
    if name.chars().count() <= most {
        return name.to_owned();
    }
    name.chars().take(most - 1).chain(['…']).collect()
}
