//! Lever arms: the derivatives of rows with respect to a small turn of each joint, mm for each rad. A prismatic joint
//! counts in units of the robot's reach, so that one number is comparable for all of them.

use nalgebra::DMatrix;

use crate::effects::{FixedMask, Inputs, Term, joint_zero};
use crate::kinematics::JointKind;
use crate::model::Model;

/// The model with one coefficient for each joint, which moves it, and no other.
pub(super) fn moving_joints(model: &Model) -> Model {
    let is_zero = |term: &Term| term.effect.about().id == joint_zero().about().id;
    let offset = |joint: usize| {
        let own = model
            .terms()
            .iter()
            .find(|t| is_zero(t) && t.joint == joint);
        let absent = || Term::absent(joint_zero(), joint, 0.0);
        Term {
            held: FixedMask::default(),
            ..own.cloned().unwrap_or_else(absent)
        }
    };
    let others = model
        .without(is_zero)
        .with_each(|_, term| term.held = FixedMask::ALL);
    let joints = (0..model.robot.joints.len()).map(offset);
    Model::new(
        model.robot.clone(),
        others.terms().iter().cloned().chain(joints).collect(),
    )
}

/// Of the columns of [`moving_joints`] those of the joints, in their order.
pub(super) fn levers(columns: &DMatrix<f64>, model: &Model) -> DMatrix<f64> {
    let mut own = columns.select_columns(&places(&moving_joints(model)));
    for (joint, mut column) in model.robot.joints.iter().zip(own.column_iter_mut()) {
        if joint.kind == JointKind::Prismatic {
            column.scale_mut(model.robot.reach_mm());
        }
    }
    own
}

/// The indices of the coefficients of moving joints in a model.
fn places(model: &Model) -> Vec<usize> {
    let columns = model.columns().enumerate();
    let own = columns.filter(|(_, (t, _))| t.effect.about().id == joint_zero().about().id);
    own.map(|(place, _)| place).collect()
}

/// The derivatives of rows with respect to the joints, one after the other, and the pose of each sample.
#[derive(Debug)]
pub(crate) struct Moves {
    pub(crate) poses: Vec<u32>,
    pub(crate) levers: DMatrix<f64>,
}

/// The same for every sample along x, y, z, joint by joint.
#[derive(Debug, Clone)]
pub(crate) struct Levers {
    joints: usize,
    of_samples: Vec<f64>,
}

impl Levers {
    pub(super) fn new(inputs: &Inputs, model: &Model) -> Self {
        let moving = moving_joints(model);
        let (joints, places) = (model.robot.joints.len(), places(&moving));
        let unit = |joint: usize| match model.robot.joints[joint].kind {
            JointKind::Prismatic => model.robot.reach_mm(),
            JointKind::Revolute => 1.0,
        };
        let units: Vec<f64> = (0..joints).map(unit).collect();
        let mut of_samples = Vec::with_capacity(3 * joints * inputs.len());
        moving.visit(inputs, true, |_, block| {
            for i in 0..block.len {
                for axis in 0..3 {
                    let own = places.iter().zip(&units);
                    of_samples.extend(own.map(|(k, unit)| unit * block.columns[*k][axis][i]));
                }
            }
        });
        Self { joints, of_samples }
    }

    /// Number of joints.
    pub(super) fn joints(&self) -> usize {
        self.joints
    }

    /// The move of a sample along an axis with each joint.
    pub(super) fn of(&self, sample: usize, axis: usize) -> &[f64] {
        let at = (3 * sample + axis) * self.joints;
        &self.of_samples[at..at + self.joints]
    }
}
