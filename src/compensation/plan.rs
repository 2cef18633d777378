//! One face for both kinds of model: the joint corrections, and where the reflectors then are.

use std::borrow::Cow;

use nalgebra::Point3;

use crate::effects::{Inputs, Owner, Role, Setting, Term};
use crate::lanes::minus;
use crate::model::{Calibration, Model, Positions};
use crate::sessions::Target;

use super::inverse::{closest_commands, places};
use super::regional::Regional;

/// Whether a term is none of the robot's: the instrument's, the own error of a target that only the measurement knows,
/// or how the measured body is turned. A probe that is mounted turned by 20° does not turn what the robot works with.
pub(crate) fn is_of_the_measurement(term: &Term) -> bool {
    let about = term.effect.about();
    let own_target = about.setting == Setting::Target && term.setting > 0.0;
    own_target || about.owner != Owner::Robot || about.role == Role::ToolTurn
}

/// So many poses go through the inversion at once: enough to fill blocks, little enough to stay
/// in the cache.
const AT_ONCE: usize = 1024;

/// How a calibration is turned into joint commands.
#[derive(Debug, Clone)]
pub struct Compensation {
    /// The robot as its controller believes it to be.
    pub nominal: Model,
    /// The model without what is the instrument's.
    pub robot: Model,
    /// The paper's corrections; they replace the model where there are any.
    pub regional: Option<Regional>,
    /// Reflectors at home, base frame, mm: what the correction brings into place.
    pub reflectors_at_home: Vec<[f64; 3]>,
}

impl Compensation {
    /// The compensation that a calibration asks for. The reflectors that were measured stand for
    /// the tool: with one at the tool's origin it is the origin that is brought into place, with
    /// several all of them together.
    pub fn new(calibration: &Calibration) -> Self {
        let robot = &calibration.model.robot;
        let of_the_robot = calibration.model.without(is_of_the_measurement);
        let place = |t: &Target| (robot.base_from_tool * t.position_mm).coords.into();
        let mut reflectors_at_home: Vec<[f64; 3]> = calibration.targets.iter().map(place).collect();
        if reflectors_at_home.is_empty() {
            let origin = robot.base_from_tool * Point3::origin();
            reflectors_at_home.push(origin.coords.into());
        }
        let regional = !calibration.regions.is_empty() && robot.joints.len() == 1;
        Self {
            nominal: Model::nominal(robot.clone()),
            robot: of_the_robot,
            regional: regional.then(|| Regional::new(robot, &calibration.regions)),
            reflectors_at_home,
        }
    }

    /// What to add to the commands of `inputs`, joint by joint, rad or mm. The reflectors are
    /// those of the compensation, whatever `inputs` says.
    pub fn joint_corrections(&self, inputs: &Inputs) -> Vec<Vec<f64>> {
        let inputs = &*inputs.fitted_to(self.nominal.robot.joints.len());
        let all: Vec<usize> = (0..inputs.q.len()).collect();
        let mut corrections = vec![Vec::with_capacity(inputs.len()); inputs.q.len()];
        for start in (0..inputs.len()).step_by(AT_ONCE) {
            let mut part = part_of(inputs, start, AT_ONCE);
            part.reflectors_at_home.clone_from(&self.reflectors_at_home);
            if let Some(regional) = &self.regional {
                corrections[0].extend(regional.joint_corrections(&part));
                continue;
            }
            let wanted = places(&self.nominal, &part);
            let commands = closest_commands(&self.robot, &part, &wanted, &all);
            for ((corrections, commands), q) in corrections.iter_mut().zip(commands).zip(&part.q) {
                corrections.extend(commands.iter().zip(q.iter()).map(|(u, q)| u - q));
            }
        }
        corrections
    }

    /// Where the real robot puts the reflectors of `inputs` when it is told to go to their
    /// commands plus `corrections`, as far as the model knows.
    pub fn reached(&self, inputs: &Inputs, corrections: &[Vec<f64>]) -> Positions {
        let inputs = &*inputs.fitted_to(self.nominal.robot.joints.len());
        let mut corrected = inputs.clone();
        for (q, by) in corrected.q.iter_mut().zip(corrections) {
            for (q, by) in q.to_mut().iter_mut().zip(by) {
                *q += by;
            }
        }
        let Some(regional) = &self.regional else {
            return self.robot.predict(&corrected);
        };
        // (8) read backwards: the real robot stands at its nominal position − M Δρ.
        let mut reached = self.nominal.predict(&corrected);
        let first = inputs.q.first().map_or(&[][..], AsRef::as_ref);
        let of_region = regional.corrections_at(first);
        for (i, correction) in of_region.iter().enumerate() {
            let Some(correction) = correction else {
                continue;
            };
            let target = inputs.target.as_ref().map_or(0, |t| t[i] as usize);
            let home = inputs.reflectors_at_home[target];
            let off = regional.position_correction(correction, home);
            let [x, y, z] = minus(reached.get(i), off);
            (reached.x_mm[i], reached.y_mm[i], reached.z_mm[i]) = (x, y, z);
        }
        reached
    }

    /// `to − from` of one sample, mm; in the plane of motion for the paper's method, which leaves
    /// the rest alone.
    pub fn deviation(&self, to: [f64; 3], from: [f64; 3]) -> [f64; 3] {
        let deviation = minus(to, from);
        match &self.regional {
            Some(regional) => regional.in_plane(deviation),
            None => deviation,
        }
    }
}

/// Some poses of `inputs` by their indices.
pub(super) fn selected(inputs: &Inputs, indices: &[usize]) -> Inputs<'static> {
    let pick = |column: &[f64]| -> Vec<f64> { indices.iter().map(|i| column[*i]).collect() };
    let picks = |columns: &[Option<Cow<[f64]>>]| {
        let picked = columns
            .iter()
            .map(|c| c.as_ref().map(|c| Cow::Owned(pick(c))));
        picked.collect()
    };
    let q = inputs.q.iter().map(|q| pick(q)).collect();
    let mut some = Inputs::at_poses(q, inputs.reflectors_at_home.clone());
    some.dir = picks(&inputs.dir);
    some.speed = picks(&inputs.speed);
    let travel = inputs.travel.iter();
    some.travel = travel.map(|t| t.as_ref().map(|t| pick(t))).collect();
    some.load_kg = inputs.load_kg.as_ref().map(|c| Cow::Owned(pick(c)));
    let warm = inputs.joint_above_20_c.iter();
    some.joint_above_20_c = warm.map(|w| w.as_ref().map(|w| pick(w))).collect();
    some.torque_nm = picks(&inputs.torque_nm);
    some.above_20_c = inputs.above_20_c.as_ref().map(|w| pick(w));
    let targets = inputs.target.as_ref();
    some.target = targets.map(|t| Cow::Owned(indices.iter().map(|i| t[*i]).collect()));
    some
}

/// Some consecutive poses of `inputs`.
pub(super) fn part_of(inputs: &Inputs, start: usize, most: usize) -> Inputs<'static> {
    let end = (start + most).min(inputs.len());
    let cut =
        |column: &Cow<[f64]>| -> Cow<'static, [f64]> { Cow::Owned(column[start..end].to_vec()) };
    let cuts =
        |columns: &[Option<Cow<[f64]>>]| columns.iter().map(|c| c.as_ref().map(cut)).collect();
    let q = inputs.q.iter().map(|q| q[start..end].to_vec()).collect();
    let mut part = Inputs::at_poses(q, inputs.reflectors_at_home.clone());
    part.dir = cuts(&inputs.dir);
    part.speed = cuts(&inputs.speed);
    let travel = inputs.travel.iter();
    part.travel = travel
        .map(|t| t.as_ref().map(|t| t[start..end].to_vec()))
        .collect();
    part.load_kg = inputs.load_kg.as_ref().map(cut);
    part.joint_above_20_c = inputs
        .joint_above_20_c
        .iter()
        .map(|w| w.as_ref().map(|w| w[start..end].to_vec()))
        .collect();
    part.torque_nm = cuts(&inputs.torque_nm);
    part.above_20_c = inputs.above_20_c.as_ref().map(|w| w[start..end].to_vec());
    part
}
