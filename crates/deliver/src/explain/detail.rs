//! How much of an answer is shown, by where.

use crate::present::numbers::{grouped, mm, plain};
use crate::present::units::Units;
use crate::text::{ByTitles, InUnits};

use super::section::{Block, Fact, fact};

/// How much of an answer is asked for.
#[derive(Debug, Clone, Copy)]
#[doc(hidden)]
pub struct Detail {
    /// Units of lengths as the reader chose them, with three digits; `None`: mm with the four decimals of a report.
    pub(crate) units: Option<Units>,
    /// Most points of a list; how many more there are is said.
    pub(crate) most: usize,
    /// On one page: a sentence in place of facts, the poses and combinations counted.
    pub(crate) brief: bool,
}

impl Detail {
    /// While the answer lives, sentences on this thread have titles for names and this detail's units.
    pub(super) fn speaking(self) -> (ByTitles, InUnits) {
        let units = self.units.unwrap_or_default();
        let units = InUnits::begin((units.length, units.angle));
        (ByTitles::begin(), units)
    }

    /// In the terminal: on one page.
    pub const TERMINAL: Self = Self {
        units: None,
        most: 6,
        brief: true,
    };
    /// In a report: everything, on paper.
    pub(crate) const REPORT: Self = Self {
        units: None,
        most: 20,
        brief: false,
    };

    /// In the window.
    pub fn window(units: Units) -> Self {
        Self {
            units: Some(units),
            most: 8,
            brief: false,
        }
    }

    /// A length.
    pub(super) fn length(self, length_mm: f64) -> String {
        self.units
            .map_or_else(|| mm(length_mm), |units| units.length(length_mm))
    }

    /// A length before and after.
    pub(super) fn lengths(self, [before, after]: [f64; 2]) -> String {
        match self.units {
            None => format!("{} → {} mm", plain(before), plain(after)),
            Some(units) => format!("{} → {}", units.length_number(before), units.length(after)),
        }
    }

    /// The first points, and how many more there are.
    pub(super) fn first(self, mut points: Vec<String>) -> Vec<String> {
        let more = points.len().saturating_sub(self.most);
        points.truncate(self.most);
        if more > 0 {
            points.push(say!("and {more} more", more));
        }
        points
    }

    /// The same of facts; the count of the others stands behind the last name.
    pub(super) fn first_facts(self, mut facts: Vec<Fact>) -> Vec<Block> {
        let more = facts.len().saturating_sub(self.most);
        facts.truncate(self.most);
        let mut blocks = vec![Block::Facts(facts)];
        if more > 0 {
            blocks.push(Block::Text(say!("and {more} more", more)));
        }
        blocks
    }
}

/// A length to the nanometre: a model has to give the same figure wherever it is checked.
pub(super) fn to_the_nanometre(length_mm: f64, detail: Detail) -> String {
    match detail.units {
        None => format!("{length_mm:.6} mm"),
        Some(units) => units.length(length_mm),
    }
}

/// A root mean square with the largest, to the nanometre.
pub(super) fn with_largest(rms_mm: f64, largest_mm: f64, detail: Detail) -> String {
    say!(
        "{rms} (largest {largest})",
        rms = to_the_nanometre(rms_mm, detail),
        largest = to_the_nanometre(largest_mm, detail)
    )
}

/// What a model leaves on samples that no fit has seen.
pub(super) fn held_out(nominal_mm: f64, model_mm: f64, samples: usize, detail: Detail) -> Fact {
    let says = say!(
        "{nominal} nominal, {model} with the model, of {samples} samples apart",
        nominal = to_the_nanometre(nominal_mm, detail),
        model = to_the_nanometre(model_mm, detail),
        samples = grouped(samples)
    );
    fact(say!("held-out samples"), says)
}
