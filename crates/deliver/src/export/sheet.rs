//! A table in the user's unit, on the grid that a format will get, before it is written.

use super::rules::{Directions, Rules};
use crate::compensation::{Conditions, JointTable};
use crate::kinematics::{JointKind, Range};
use crate::text::Text;

/// Corrections, always: what is to be added to a command, in degrees or mm. A format's `write` gives them its own sign and
/// unit; its `read` takes the unit off again, and `TableFile` the sign.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Joint, counted from 0.
    pub joint: usize,
    /// Its name.
    pub name: String,
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// Where the entries stand, ascending.
    pub places: Vec<f64>,
    /// The step, where all are equal.
    pub step: Option<f64>,
    /// Correction while moving to larger values.
    pub forward: Vec<f64>,
    /// Correction while moving to smaller values.
    pub reverse: Vec<f64>,
    /// Whether it repeats after a turn.
    pub repeats: bool,
    /// Range of the samples, rad or mm.
    pub measured: Range,
    /// The conditions that it is made for.
    pub conditions: Conditions,
    /// What else there is to know.
    pub notes: Vec<Text>,
}

/// One turn, degrees.
pub(super) const TURN: f64 = 360.0;
/// A travel is a full turn up to this, degrees.
const NEARLY: f64 = 1e-6;

impl Sheet {
    /// The joint's name in small letters, digits and underscores; `None` where it has no other.
    pub(super) fn word(&self) -> Option<String> {
        let kept = |c: char| {
            if c.is_ascii_alphanumeric() {
                c.to_ascii_lowercase()
            } else {
                '_'
            }
        };
        let name: String = self.name.chars().map(kept).collect();
        name.chars().any(|c| c != '_').then_some(name)
    }

    /// The whole of a table, as the format rounds it.
    pub(super) fn new(table: &JointTable, rules: &Rules) -> Self {
        let outer = |values: &[f64]| -> Vec<f64> {
            let values = values
                .iter()
                .map(|v| rules.rounded(table.to_display(*v)) + 0.0);
            values.collect()
        };
        let (mut forward, mut reverse) = (outer(&table.forward), outer(&table.reverse));
        if let Directions::One { .. } = rules.directions {
            let both = table.forward.iter().zip(&table.reverse);
            let mean: Vec<f64> = both.map(|(f, r)| 0.5 * (f + r)).collect();
            forward = outer(&mean);
            reverse.clone_from(&forward);
        }
        let places: Vec<f64> = table
            .commanded_outer
            .iter()
            .map(|q| rules.rounded(*q))
            .collect();
        let mut sheet = Self {
            joint: table.joint,
            name: table.name.clone(),
            kind: table.kind,
            places,
            step: Some(table.step_outer),
            forward,
            reverse,
            repeats: false,
            measured: table.measured,
            conditions: table.conditions,
            notes: table.notes.clone(),
        };
        sheet.repeats = rules.repeats && sheet.closes(rules);
        sheet
    }

    /// Some of the entries.
    pub(super) fn at(&self, entries: &[usize]) -> Self {
        let pick = |column: &[f64]| entries.iter().map(|k| column[*k]).collect();
        Self {
            places: pick(&self.places),
            forward: pick(&self.forward),
            reverse: pick(&self.reverse),
            step: None,
            ..self.clone()
        }
    }

    /// Whether it is a full turn at whose ends the same is said.
    fn closes(&self, rules: &Rules) -> bool {
        let ends = self.places.first().zip(self.places.last());
        let turn = ends.is_some_and(|(a, b)| (b - a - TURN).abs() <= NEARLY);
        let resolution = rules.resolution.unwrap_or(0.0).max(NEARLY);
        let same = |column: &[f64]| {
            let ends = column.first().zip(column.last());
            ends.is_some_and(|(a, b)| (a - b).abs() <= resolution)
        };
        self.kind == JointKind::Revolute && turn && same(&self.forward) && same(&self.reverse)
    }

    /// Unit of the joint as names and texts carry it.
    pub fn unit(&self) -> &'static str {
        self.kind.unit()
    }

    /// A value of the joint in the user's unit.
    pub fn to_display(&self, inner: f64) -> f64 {
        self.kind.to_display(inner)
    }

    /// A value of the joint in inner units.
    pub fn to_base_units(&self, outer: f64) -> f64 {
        self.kind.to_base_units(outer)
    }

    /// First and last place.
    pub fn ends(&self) -> [f64; 2] {
        let ends = self.places.first().zip(self.places.last());
        ends.map_or([0.0, 0.0], |(a, b)| [*a, *b])
    }
}
