//! The inverse of a model: which commands bring the reflectors closest to given places.
//!
//! ```text
//! least Σ_t | p_t(u) − w_t |²  over u,   t over the reflectors
//! ```
//!
//! One joint: Newton's method on the derivative, with the second derivative of p, because a
//! remainder along the radius makes Gauss–Newton slow there. Several joints: Gauss–Newton with the
//! pseudo-inverse (Nakamura 1991), so that of all commands that do equally well the nearest is
//! taken. Directions in which the tool hardly moves (below a hundredth of the best) are not
//! corrected at all: near a singular pose a tiny gain would cost a large move.
//!
//! Derivatives with respect to the command are the exact ones of the model ([`Model::visit_by_commands`]); the
//! curvature that one joint needs is their difference over 10⁻⁴ rad or 0.1 mm, and only affects the speed of
//! convergence.
//!
//! Several poses go through at once, because the model takes them in blocks.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector};

use crate::decompose;
use crate::effects::Inputs;
use crate::kinematics::JointKind;
use crate::lanes::{dot, minus};
use crate::model::{Model, Positions};
use crate::numeric::LONGEST_TURN;
use crate::{budget, rounding};

/// Directions in which the tool moves less than this part of the most are not corrected.
pub(super) const FLATTEST: f64 = 1e-2;

/// Where some model puts every reflector: one set of positions for each reflector.
pub(crate) type Places = Vec<Positions>;

/// Where a model puts every reflector at each pose of `inputs`.
pub fn places(model: &Model, inputs: &Inputs) -> Places {
    let mut one = inputs.clone();
    one.target = None;
    let homes = inputs.reflectors_at_home.iter();
    homes
        .map(|home| {
            one.reflectors_at_home = vec![*home];
            model.predict(&one)
        })
        .collect()
}

/// The commands, joint by joint, that bring the reflectors of `inputs` closest to `wanted`,
/// starting from the commands of `inputs`. Only the joints in `free` (counted from 0) move.
pub fn closest_commands(
    model: &Model,
    inputs: &Inputs,
    wanted: &Places,
    free: &[usize],
) -> Vec<Vec<f64>> {
    let free = &model.robot.leading(free)[..];
    let mut trial = inputs.clone();
    let mut moving: Vec<bool> = vec![true; inputs.len()];
    for _ in 0..budget::STEPS {
        let here = sensed(model, &trial);
        // One joint alone needs the curvature.
        let displaced = match free {
            [joint] => sensed(model, &nudged(model, &trial, *joint)),
            _ => Vec::new(),
        };
        let mut any = false;
        for i in 0..inputs.len() {
            if !moving[i] {
                continue;
            }
            let step = Local::new(model, i, free, [&here, &displaced], wanted).step();
            moving[i] = false;
            for (joint, by) in free.iter().copied().zip(step) {
                let unit = unit_of(model, joint);
                let by = by.clamp(-LONGEST_TURN, LONGEST_TURN) * unit;
                trial.q[joint].to_mut()[i] += by;
                for (follower, ratio) in model.robot.followers(joint) {
                    trial.q[follower].to_mut()[i] += ratio * by;
                }
                moving[i] |= by.abs() > rounding::LAST_BITS * unit;
            }
            any |= moving[i];
        }
        if !any {
            break;
        }
    }
    trial.q.into_iter().map(Cow::into_owned).collect()
}

/// A length of joint travel that moves the tool about as far as one rad: 1 rad, or 1000 mm.
fn unit_of(model: &Model, joint: usize) -> f64 {
    match model.robot.joints[joint].kind {
        JointKind::Revolute => 1.0,
        JointKind::Prismatic => 1000.0,
    }
}

fn nudged<'a>(model: &Model, inputs: &Inputs<'a>, joint: usize) -> Inputs<'a> {
    let mut nudged = inputs.clone();
    let by = rounding::DIFFERENCE * unit_of(model, joint);
    for q in nudged.q[joint].to_mut() {
        *q += by;
    }
    for (follower, ratio) in model.robot.followers(joint) {
        for q in nudged.q[follower].to_mut() {
            *q += ratio * by;
        }
    }
    nudged
}

/// One reflector at every pose, and how it moves with the commands.
struct Sensed {
    /// Where it is, mm.
    at: Vec<[f64; 3]>,
    /// Derivatives by each joint's command, joint by joint, mm per rad or mm.
    by: Vec<Vec<[f64; 3]>>,
}

fn sensed(model: &Model, inputs: &Inputs) -> Vec<Sensed> {
    let mut one = inputs.clone();
    one.target = None;
    let homes = inputs.reflectors_at_home.iter();
    homes
        .map(|home| {
            one.reflectors_at_home = vec![*home];
            let mut sensed = Sensed {
                at: Vec::with_capacity(inputs.len()),
                by: vec![Vec::with_capacity(inputs.len()); inputs.q.len()],
            };
            model.visit_by_commands(&one, |_, block| {
                let [x, y, z] = &block.point;
                for i in 0..block.len {
                    sensed.at.push([x[i], y[i], z[i]]);
                }
                for (by, [x, y, z]) in sensed.by.iter_mut().zip(&block.columns) {
                    by.extend((0..block.len).map(|i| [x[i], y[i], z[i]]));
                }
            });
            sensed
        })
        .collect()
}

/// One pose: the remaining error, and how the reflectors move with the joints. Everything is per [`unit_of`] a joint,
/// so that revolute and prismatic joints can be weighed against each other.
struct Local {
    /// Missing way of each reflector, mm.
    missing: Vec<[f64; 3]>,
    /// First derivatives, joint by joint, reflector by reflector.
    first: Vec<Vec<[f64; 3]>>,
    /// Second derivatives by the same joint, reflector by reflector; for one joint alone.
    second: Vec<[f64; 3]>,
}

impl Local {
    /// `sensed` is every reflector at the commands, and a step of one joint further.
    fn new(
        model: &Model,
        pose: usize,
        free: &[usize],
        [here, displaced]: [&[Sensed]; 2],
        wanted: &Places,
    ) -> Self {
        let first = |sensed: &[Sensed], joint: usize| -> Vec<[f64; 3]> {
            let unit = unit_of(model, joint);
            let all = sensed.iter();
            let moved = |s: &Sensed| {
                let mut by = s.by[joint][pose];
                for (follower, ratio) in model.robot.followers(joint) {
                    for (sum, more) in by.iter_mut().zip(s.by[follower][pose]) {
                        *sum += ratio * more;
                    }
                }
                by.map(|d| d * unit)
            };
            all.map(moved).collect()
        };
        let missing = here.iter().zip(wanted);
        let all_first: Vec<_> = free.iter().map(|joint| first(here, *joint)).collect();
        let second = free.first().filter(|_| !displaced.is_empty());
        let second = second.map_or_else(Vec::new, |joint| {
            let pairs = first(displaced, *joint).into_iter().zip(&all_first[0]);
            let slopes = pairs
                .map(|(further, here)| minus(further, *here).map(|d| d / rounding::DIFFERENCE));
            slopes.collect()
        });
        Self {
            missing: missing
                .map(|(here, wanted)| minus(wanted.get(pose), here.at[pose]))
                .collect(),
            first: all_first,
            second,
        }
    }

    /// The way to go, joint by joint.
    fn step(&self) -> Vec<f64> {
        if self.first.len() == 1 {
            vec![self.newton()]
        } else {
            self.gauss_newton().as_slice().to_vec()
        }
    }

    /// f′/f″ of half the sum of squares. Where f″ is not positive (far away) Gauss–Newton's is.
    fn newton(&self) -> f64 {
        let (mut downhill, mut gauss, mut curved) = (0.0, 0.0, 0.0);
        for ((missing, first), second) in self.missing.iter().zip(&self.first[0]).zip(&self.second)
        {
            downhill += dot(*first, *missing);
            gauss += dot(*first, *first);
            curved -= dot(*second, *missing);
        }
        if gauss <= rounding::COMPUTED * rounding::COMPUTED {
            return 0.0;
        }
        let full = gauss + curved;
        downhill / if full > 0.1 * gauss { full } else { gauss }
    }

    fn gauss_newton(&self) -> DVector<f64> {
        let joints = self.first.len();
        // Column-major: all reflectors of one joint follow each other, which is one column.
        let columns: Vec<f64> = self.first.iter().flatten().flatten().copied().collect();
        let missing: Vec<f64> = self.missing.iter().flatten().copied().collect();
        let jacobian = DMatrix::from_vec(missing.len(), joints, columns);
        let Some(svd) = decompose::svd(jacobian) else {
            return DVector::zeros(joints);
        };
        let flattest = FLATTEST * svd.singular_values.max();
        let step = svd.solve(
            &DVector::from_vec(missing),
            flattest.max(rounding::COMPUTED),
        );
        step.unwrap_or_else(|_| DVector::zeros(joints))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compensation::Conditions;
    use crate::compensation::conditions::Side;
    use crate::effects::Term;
    use crate::kinematics::{Axis, Joint, Pose, Robot};
    use crate::testing::column;
    use nalgebra::{Point3, Vector3};

    fn arm() -> Robot {
        let joint = |name: &str, direction: Vector3<f64>, x: f64, z: f64| {
            let axis = Axis::through(direction, Point3::new(x, 0.0, z)).unwrap();
            Joint::new(name, JointKind::Revolute, axis)
        };
        Robot {
            name: "arm".to_owned(),
            joints: vec![
                joint("a", Vector3::z(), 0.0, 0.0),
                joint("b", Vector3::y(), 0.0, 400.0),
                joint("c", Vector3::y(), 300.0, 400.0),
            ],
            base_from_tool: Pose::translation(550.0, 0.0, 400.0),
            gravity_m_s2: None,
            source: crate::kinematics::RobotSource::Axes,
        }
    }

    const ALL: [usize; 3] = [0, 1, 2];

    fn term(id: &str, joint: usize, name: &str, value: f64) -> Term {
        Term::from_parameters(id, joint, &[(name, value)], 3).unwrap()
    }

    #[test]
    fn one_joint_turns_to_the_angle_and_leaves_the_radius() {
        let terms = vec![
            term("joint-zero-offset", 1, "offset_deg", -30.0),
            term("link-length", 1, "delta_mm", 50.0),
        ];
        let model = Model::new(column(), terms);
        let q: Vec<f64> = (-90..=90).map(|deg| f64::from(deg).to_radians()).collect();
        let home = vec![[250.0, 0.0, 300.0]];
        let inputs = Conditions::default().inputs(vec![q.clone()], Side::Forward, home);
        let wanted = places(&Model::nominal(column()), &inputs);
        let commands = closest_commands(&model, &inputs, &wanted, &[0]);
        for (command, q) in commands[0].iter().zip(&q) {
            let correction = command - q - 30.0_f64.to_radians();
            assert!(correction.abs() < 1e-12, "{correction:e}");
        }
    }

    #[test]
    fn three_joints_reach_the_point_although_links_are_off() {
        let terms = vec![
            term("joint-zero-offset", 1, "offset_deg", 1.0),
            term("joint-zero-offset", 2, "offset_deg", -0.5),
            term("base-offset", 1, "x_mm", 2.0),
        ];
        let model = Model::new(arm(), terms);
        let q = vec![vec![0.3], vec![0.4], vec![0.9]];
        let home = vec![[550.0, 0.0, 400.0]];
        let mut inputs = Conditions::default().inputs(q, Side::Forward, home);
        let wanted = places(&Model::nominal(arm()), &inputs);
        let commands = closest_commands(&model, &inputs, &wanted, &ALL);
        inputs.q = commands.into_iter().map(Cow::Owned).collect();
        let residual = minus(places(&model, &inputs)[0].get(0), wanted[0].get(0));
        assert!(dot(residual, residual).sqrt() < 1e-10, "{residual:?}");
    }

    #[test]
    fn an_arm_at_full_stretch_is_not_bent_to_gain_a_trifle() {
        let model = Model::new(arm(), vec![term("base-offset", 1, "x_mm", 0.01)]);
        let q = vec![vec![0.0], vec![0.0], vec![0.0]];
        let home = vec![[550.0, 0.0, 400.0]];
        let inputs = Conditions::default().inputs(q, Side::Forward, home);
        let wanted = places(&Model::nominal(arm()), &inputs);
        let commands = closest_commands(&model, &inputs, &wanted, &ALL);
        // Pulling the tool back by 0.01 mm would take 0.7° of the outer joints.
        for command in commands {
            assert!(command[0].abs() < 1e-9, "{}", command[0]);
        }
    }
}
