//! How observations flow through the model: in the first stream each lane is the target of an item; in
//! the second four lanes are the tool's origin and a point along each of its axes, from which its
//! orientation and their derivatives follow:
//!
//! ```text
//! R = [x y z],   ω_k = ½ Σ_j e_j × ∂e_j/∂c_k
//! ```

use nalgebra::Point3;

use crate::effects::base_offset::AXES;
use crate::effects::block::Block;
use crate::effects::{Inputs, JointValues};
use crate::lanes::{Lanes3, cross, dot, minus, scaled};
use crate::model::Model;
use crate::sessions::Session;

use super::{KINDS, Observable};

/// One observation of one sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Item {
    /// Its kind, an index into [`KINDS`].
    pub kind: usize,
    /// The sample.
    pub sample: usize,
    /// Number of rows.
    pub rows: usize,
}

/// Items that flow through the model together.
#[derive(Debug, Clone)]
pub(super) struct Stream {
    /// Indices of the items, in the order of the lanes.
    pub(super) items: Vec<usize>,
    pub(super) inputs: Inputs<'static>,
}

/// Distance of the points that show the tool's orientation from its origin, mm.
pub const ARM_MM: f64 = 100.0;
/// Lanes of one orientation.
pub(super) const POINTS: usize = 4;

impl Stream {
    /// Some of its items only, which `place` has at new places; each is so many lanes.
    pub(super) fn only(&self, kept: &[bool], place: &[usize], lanes: usize) -> Self {
        let own = (0..self.items.len()).filter(|k| kept[self.items[*k]]);
        let own: Vec<usize> = own.collect();
        let inputs = own.iter().flat_map(|k| k * lanes..(k + 1) * lanes);
        Self {
            items: own.iter().map(|k| place[self.items[*k]]).collect(),
            inputs: self.inputs.select(&inputs.collect::<Vec<_>>()),
        }
    }
}

/// Where a model has the target of every sample, and how it turns the tool.
pub fn predictions(
    session: &Session,
    values: JointValues,
    model: &Model,
) -> Vec<([f64; 3], [[f64; 3]; 3])> {
    let inputs = Inputs::new(session, values);
    let of = |looks: Observable| {
        let kind = KINDS.iter().position(|kind| kind.about().looks == looks);
        let kind = kind.unwrap_or(0);
        let samples = 0..session.samples.len();
        let items: Vec<Item> = samples
            .map(|sample| Item {
                kind,
                sample,
                rows: 0,
            })
            .collect();
        stream(session, &inputs, &items, looks)
    };
    let mut seen = Vec::with_capacity(session.samples.len());
    model.visit(&of(Observable::AtPoint).inputs, false, |_, block| {
        for lane in 0..block.len {
            seen.push(([0, 1, 2].map(|axis| block.point[axis][lane]), AXES));
        }
    });
    model.visit(&of(Observable::AtAttitude).inputs, false, |start, block| {
        for own in 0..block.len / POINTS {
            seen[start / POINTS + own].1 = attitude(block, own * POINTS).0;
        }
    });
    seen
}

/// The inputs of the items that look at one thing.
pub(super) fn stream(
    session: &Session,
    inputs: &Inputs,
    items: &[Item],
    looks: Observable,
) -> Stream {
    let own: Vec<usize> = (0..items.len())
        .filter(|i| KINDS[items[*i].kind].about().looks == looks)
        .collect();
    let samples = own.iter().map(|i| items[*i].sample);
    if looks == Observable::AtPoint {
        let samples: Vec<usize> = samples.collect();
        return Stream {
            items: own,
            inputs: inputs.select(&samples),
        };
    }
    let samples: Vec<usize> = samples
        .flat_map(|sample| std::iter::repeat_n(sample, POINTS))
        .collect();
    let mut inputs = inputs.select(&samples);
    // Points of the tool's own: no target's error is theirs.
    let targets = u32::try_from(inputs.reflectors_at_home.len()).unwrap_or(u32::MAX);
    let tool = &session.robot.base_from_tool;
    let along = [
        [0.0; 3],
        [ARM_MM, 0.0, 0.0],
        [0.0, ARM_MM, 0.0],
        [0.0, 0.0, ARM_MM],
    ];
    let at_home = along.map(|p| <[f64; 3]>::from((tool * Point3::from(p)).coords));
    inputs.reflectors_at_home.extend(at_home);
    let of_tool = (0..POINTS).zip(targets..).map(|(_, index)| index);
    let of_tool: Vec<u32> = of_tool.collect();
    inputs.target = Some(of_tool.repeat(own.len()).into());
    Stream { items: own, inputs }
}

/// The tool's orientation by rows, and the edges from its origin to the points along its axes, of
/// unit length at home.
pub(super) fn attitude(block: &Block, first: usize) -> ([[f64; 3]; 3], [[f64; 3]; 3]) {
    let point = |lane: usize| [0, 1, 2].map(|axis| block.point[axis][first + lane]);
    let origin = point(0);
    let edges = [1, 2, 3].map(|lane| scaled(minus(point(lane), origin), 1.0 / ARM_MM));
    // A warm or mis-scaled machine changes lengths as well: only the turn counts.
    let unit = |v: [f64; 3]| scaled(v, 1.0 / dot(v, v).sqrt().max(f64::MIN_POSITIVE));
    let x = unit(edges[0]);
    let y = unit(minus(edges[1], scaled(x, dot(x, edges[1]))));
    let z = cross(x, y);
    let rows = std::array::from_fn(|k| [x[k], y[k], z[k]]);
    (rows, edges)
}

/// The turn of the tool with one coefficient.
pub(super) fn turn(column: &Lanes3, first: usize, edges: &[[f64; 3]; 3]) -> [f64; 3] {
    let moved = |lane: usize| [0, 1, 2].map(|axis| column[axis][first + lane]);
    let origin = moved(0);
    let mut turn = [0.0; 3];
    for (lane, edge) in edges.iter().enumerate() {
        let change = scaled(minus(moved(lane + 1), origin), 0.5 / ARM_MM);
        let part = cross(*edge, change);
        for k in 0..3 {
            turn[k] += part[k];
        }
    }
    turn
}
