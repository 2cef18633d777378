//! The residual of every observation, and its derivatives with respect to what samples share: the place of their
//! target in the tool, the frame of their setup, the place that they refer to.

use nalgebra::{Matrix3, Vector3};

use crate::effects::JointValues;
use crate::effects::place::MOST;
use crate::model::Model;
use crate::sessions::{Group, Session, SessionCorrection};

use super::{Layer, Residual};

/// One observation compared with a model, in units of its noise.
#[derive(Debug, Clone)]
pub struct ComparedObservation {
    /// The sample.
    pub sample: usize,
    /// Measured − predicted, and its derivatives.
    pub residual: Residual,
    /// Where its target is, mm.
    point: Vector3<f64>,
    /// The tool's axes in the measuring frame.
    turn: Matrix3<f64>,
}

impl ComparedObservation {
    /// The derivative of the prediction with respect to the numbers of a group, row by row: mm along x, y, z of the
    /// tool of a target; a rotation vector and mm of a setup, rad; the coefficients of a place.
    pub fn by(&self, group: Group) -> [[f64; MOST]; 3] {
        std::array::from_fn(|row| match group {
            Group::Target => {
                let along = self
                    .turn
                    .tr_mul(&Vector3::from(self.residual.by_point[row]));
                [along.x, along.y, along.z, 0.0, 0.0, 0.0]
            }
            Group::Setup => {
                let along = Vector3::from(self.residual.by_point[row]);
                let about = self.point.cross(&along);
                [about.x, about.y, about.z, along.x, along.y, along.z]
            }
            _ => self.residual.by_place[row],
        })
    }
}

/// Every observation to be fitted, compared with a model, sample by sample.
pub fn compared_with(
    session: &Session,
    values: JointValues,
    model: &Model,
) -> Vec<ComparedObservation> {
    let layer = Layer::new(session, values);
    let here = layer.seen(model);
    let turned: Vec<Vec<[f64; 3]>> = (0..3)
        .map(|along| {
            let mut moved = session.clone();
            let mut by_mm = [0.0; 3];
            by_mm[along] = 1.0;
            for target in 0..moved.targets.len() {
                SessionCorrection::MoveTarget { target, by_mm }.apply(&mut moved);
            }
            let there = Layer::new(&moved, values).seen(model);
            there.into_iter().map(|seen| seen.0).collect()
        })
        .collect();
    let rows = layer.weighed(model);
    let mut all = Vec::with_capacity(rows.len());
    for (item, residual) in rows.into_iter().enumerate() {
        if !layer.fit[item] {
            continue;
        }
        let point = Vector3::from(here[item].0);
        let axis = |along: usize| Vector3::from(turned[along][item]) - point;
        all.push(ComparedObservation {
            sample: layer.items[item].sample,
            residual,
            point,
            turn: Matrix3::from_columns(&[axis(0), axis(1), axis(2)]),
        });
    }
    all
}
