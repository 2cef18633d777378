//! One interface for both kinds of model: the joint corrections, and where the reflectors then are.

use nalgebra::{Point3, Vector3};

use crate::budget;
use crate::effects::{Inputs, Owner, Role, Setting, TOOL_POSITION, Term};
use crate::lanes::minus;
use crate::model::{Calibration, Model, Positions};
use crate::sessions::Target;

use super::inverse::{closest_commands, places};
use super::regional::Regional;

/// Whether a term is none of the robot's: the instrument's, the own error of a target that only the measurement uses,
/// or the turn of the measured body.
fn is_of_the_measurement(term: &Term) -> bool {
    let about = term.effect.about();
    is_of_one_target(term) || about.owner != Owner::Robot || about.role == Role::ToolTurn
}

fn is_of_one_target(term: &Term) -> bool {
    term.effect.about().setting == Setting::Target && term.setting > 0.0
}

/// A model without the terms of the measurement. A probe that is mounted turned by 20° does not turn what the robot
/// works with: the mean of the `measured` points (at home, base frame, mm) is kept.
pub fn of_the_robot(model: &Model, mut measured: Vec<[f64; 3]>) -> Model {
    let robot = model.without(is_of_the_measurement);
    let role = |term: &Term| term.effect.about().role;
    let is_place = |term: &Term| role(term) == Role::ToolPlace && !is_of_one_target(term);
    let turned = model.without(|term| role(term) != Role::ToolTurn && !is_place(term));
    if !turned
        .terms()
        .iter()
        .any(|term| role(term) == Role::ToolTurn)
    {
        return robot;
    }
    let tool = model.robot.base_from_tool;
    if measured.is_empty() {
        measured.push(tool.translation.vector.into());
    }
    let count = measured.len();
    let mut at_home = Inputs::at_poses(vec![vec![0.0; count]; model.robot.joints.len()], measured);
    at_home.target = Some((0..).take(count).collect());
    let (with, without) = (
        turned.predict(&at_home),
        turned.without(|term| !is_place(term)).predict(&at_home),
    );
    let moved = |k: usize| Vector3::from(minus(with.get(k), without.get(k)));
    let by = (0..count).map(moved).sum::<Vector3<f64>>() / count as f64;
    let by = tool.rotation.inverse() * by;
    let robot = if robot.terms().iter().any(is_place) {
        robot
    } else {
        robot.with_term(Term::absent(&TOOL_POSITION, 0, 0.0))
    };
    robot.with_each(|_, term| {
        if is_place(term) {
            let shift = term.coefficients.iter_mut().zip(by.iter());
            shift.for_each(|(coefficient, by)| *coefficient += by);
        }
    })
}

/// How a calibration is turned into joint commands.
#[derive(Debug, Clone)]
pub struct Compensation {
    /// The robot as its controller believes it to be.
    pub nominal: Model,
    /// The model without the terms of the instrument.
    pub robot: Model,
    /// The paper's corrections; they replace the model where there are any.
    pub regional: Option<Regional>,
    /// Reflectors at home, base frame, mm: what the correction brings into place.
    pub reflectors_at_home: Vec<[f64; 3]>,
}

impl Compensation {
    /// The compensation for a calibration. The reflectors that were measured represent the tool: with one at the
    /// tool's origin it is the origin that is brought into place, with several all of them together.
    pub fn new(calibration: &Calibration) -> Self {
        let robot = &calibration.model.robot;
        let place = |t: &Target| (robot.base_from_tool * t.position_mm).coords.into();
        let mut reflectors_at_home: Vec<[f64; 3]> = calibration.targets.iter().map(place).collect();
        if reflectors_at_home.is_empty() {
            let origin = robot.base_from_tool * Point3::origin();
            reflectors_at_home.push(origin.coords.into());
        }
        let regional = !calibration.regions.is_empty() && robot.joints.len() == 1;
        Self {
            nominal: Model::nominal(robot.clone()),
            robot: of_the_robot(&calibration.model, calibration.measured_places()),
            regional: regional.then(|| Regional::new(robot, &calibration.regions)),
            reflectors_at_home,
        }
    }

    /// What to add to the commands of `inputs`, joint by joint, rad or mm. The reflectors are those of the
    /// compensation, not those of `inputs`.
    pub fn joint_corrections(&self, inputs: &Inputs) -> Vec<Vec<f64>> {
        let inputs = &*inputs.fitted_to(self.nominal.robot.joints.len());
        let all: Vec<usize> = (0..inputs.q.len()).collect();
        let mut corrections = vec![Vec::with_capacity(inputs.len()); inputs.q.len()];
        for block in blocks(inputs, budget::AT_ONCE) {
            let mut part = some_of(inputs, &block);
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

    /// Where the real robot puts the reflectors of `inputs` when it is commanded with `corrections` added, according
    /// to the model.
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
        // (8) solved for the place: the real robot is at its nominal position − M Δρ.
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

    /// `to − from` of one sample, mm; in the plane of motion for the paper's method, which does not change the rest.
    pub fn deviation(&self, to: [f64; 3], from: [f64; 3]) -> [f64; 3] {
        let deviation = minus(to, from);
        match &self.regional {
            Some(regional) => regional.in_plane(deviation),
            None => deviation,
        }
    }
}

/// Some poses of `inputs`, without the instrument's times and setups.
pub(super) fn some_of(inputs: &Inputs, poses: &[usize]) -> Inputs<'static> {
    let mut some = inputs.select(poses);
    (some.time_s, some.setup) = (None, None);
    some
}

/// Poses of `inputs` in blocks of so many.
pub(super) fn blocks(inputs: &Inputs, most: usize) -> impl Iterator<Item = Vec<usize>> {
    let count = inputs.len();
    let starts = (0..count).step_by(most);
    starts.map(move |start| (start..(start + most).min(count)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sessions::parse_robot;

    /// A probe that is turned by 20° on the tool, and a tool that is 3 mm longer: the point that was measured stays
    /// where it is in every pose, and the turn has no effect.
    #[test]
    fn how_a_probe_is_turned_is_none_of_the_robots() {
        let bytes = include_bytes!("../../../../sessions/arm/robot.json");
        let robot = parse_robot(bytes).expect("a robot").robot;
        let term = |id: &str, values: &[(&str, f64)]| {
            Term::from_parameters(id, 1, values, robot.joints.len()).expect("a term")
        };
        let turn = [
            ("about_x_mrad", -230.0),
            ("about_y_mrad", -22.0),
            ("about_z_mrad", -264.0),
        ];
        let shift = [("x_mm", 0.5), ("y_mm", -14.0), ("z_mm", 3.0)];
        let terms = vec![
            term("tool-position", &shift),
            term("tool-orientation", &turn),
        ];
        let point: [f64; 3] = (robot.base_from_tool * Point3::new(0.0, 0.0, 70.0))
            .coords
            .into();
        let model = Model::new(robot.clone(), terms);
        let own = of_the_robot(&model, vec![point]);
        let q: Vec<Vec<f64>> = (0..robot.joints.len())
            .map(|joint| (0..5).map(|k| ((joint + 3 * k) as f64).sin()).collect())
            .collect();
        let inputs = Inputs::at_poses(q, vec![point]);
        let (with, without) = (model.predict(&inputs), own.predict(&inputs));
        for k in 0..5 {
            let off = Vector3::from(minus(with.get(k), without.get(k)));
            assert!(off.norm() < 1e-9, "{off}");
        }
        assert!(
            own.terms()
                .iter()
                .all(|term| term.effect.about().role == Role::ToolPlace)
        );
    }
}
