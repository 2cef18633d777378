//! The derivatives that every effect gives are those of the positions that it gives: checked by
//! differences at values that are not zero, on a single axis and on an arm, alone and all together.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::{Point3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use truepose::effects::Knots;
use truepose::effects::{
    BESIDE_THE_CATALOGUE, CATALOGUE, Curve, Effect, Inputs, Setting, Term, UNEXPLAINED,
};
use truepose::kinematics::{Axis, Joint, JointKind, LinkMass, Pose, Robot};
use truepose::model::Model;

fn joint(kind: JointKind, direction: [f64; 3], point: [f64; 3]) -> Joint {
    let axis = Axis::through(direction.into(), point.into()).unwrap();
    let mut joint = Joint::new("j", kind, axis);
    joint.link = Some(LinkMass {
        mass_kg: 6.0,
        centre_mm: Point3::new(point[0] + 60.0, 20.0, point[2] + 10.0),
    });
    joint
}

fn robot(joints: Vec<Joint>) -> Robot {
    let turn = UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9);
    Robot {
        name: "test".to_owned(),
        joints,
        base_from_tool: Pose::from_parts(Vector3::new(410.0, 35.0, 280.0).into(), turn),
        gravity_m_s2: Some(Vector3::new(2.0, -1.0, -9.5)),
        source: truepose::kinematics::RobotSource::Axes,
    }
}

fn column() -> Robot {
    robot(vec![joint(
        JointKind::Revolute,
        [0.1, -0.2, 1.0],
        [15.0, 5.0, 0.0],
    )])
}

fn arm() -> Robot {
    robot(vec![
        joint(JointKind::Revolute, [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
        joint(JointKind::Revolute, [0.0, 1.0, 0.1], [50.0, 0.0, 300.0]),
        joint(JointKind::Prismatic, [1.0, 0.0, 0.2], [200.0, 0.0, 300.0]),
        joint(JointKind::Revolute, [1.0, 0.0, 0.0], [300.0, 0.0, 310.0]),
    ])
}

const SAMPLES: usize = 70;

/// Poses with every condition; more than a block of them.
fn inputs(robot: &Robot) -> Inputs<'static> {
    let wave = |scale: f64, size: f64| -> Vec<f64> {
        (0..SAMPLES)
            .map(|i| size * (i as f64 * scale + scale).sin())
            .collect()
    };
    let q = robot
        .joints
        .iter()
        .enumerate()
        .map(|(j, joint)| match joint.kind {
            JointKind::Revolute => wave(0.7 + 0.31 * j as f64, 2.5),
            JointKind::Prismatic => wave(0.9, 80.0),
        });
    let homes = vec![[420.0, 30.0, 290.0], [300.0, -80.0, 350.0]];
    let mut inputs = Inputs::at_poses(q.collect(), homes);
    inputs
        .dir
        .fill(Some(wave(3.1, 1.0).iter().map(|v| v.signum()).collect()));
    inputs.speed.fill(Some(wave(2.3, 0.4).into()));
    inputs
        .travel
        .fill(Some(wave(1.1, 0.5).iter().map(|v| v.abs()).collect()));
    inputs.load_kg = Some(wave(0.77, 3.0).iter().map(|v| v + 3.0).collect());
    inputs.above_20_c = Some(wave(0.5, 8.0));
    inputs.time_s = Some((0..SAMPLES).map(|i| 10.0 + 6.0 * i as f64).collect());
    inputs.setup = Some(
        (0..SAMPLES)
            .map(|i| f64::from(u8::from(i % 3 == 0)))
            .collect(),
    );
    inputs.target = Some((0..SAMPLES).map(|i| u32::from(i % 2 == 0)).collect());
    inputs
}

fn term(effect: &'static Effect, joint: usize, share: f64, sizes: &[f64]) -> Term {
    let about = effect.about();
    let setting = match about.setting {
        Setting::Order { from, to } => {
            f64::from(from) + (share * f64::from(to.min(60) - from)).floor()
        }
        Setting::Time => 100.0 + 300.0 * share,
        Setting::Fade => 0.05 + 0.3 * share,
        Setting::Setup | Setting::Target | Setting::Place => 1.0,
        Setting::Listed(listed) => {
            let mut whole = (1..60).map(f64::from);
            whole.find(|v| (listed.takes)(*v, joint, 2)).unwrap()
        }
        Setting::None => 0.0,
    };
    let mut term = Term::absent(effect, if about.per_joint { joint } else { 0 }, setting);
    // A joint that winds up by a rad per N·m would be none.
    let scale = if ["joint-compliance", "foundation-compliance"].contains(&about.id) {
        0.02
    } else {
        1.0
    };
    for (coefficient, size) in term.coefficients.iter_mut().zip(sizes) {
        *coefficient = *size * scale;
    }
    term
}

/// The largest difference between the model's columns and difference quotients, relative to the
/// column's size.
fn worst_column(model: &Model, inputs: &Inputs) -> (f64, usize) {
    let coefficients = model.coefficients();
    let mut columns = vec![Vec::new(); coefficients.len()];
    let mut blocks = 0;
    model.visit(inputs, true, |_, block| {
        blocks += 1;
        for (all, column) in columns.iter_mut().zip(&block.columns) {
            for i in 0..block.len {
                all.push([column[0][i], column[1][i], column[2][i]]);
            }
        }
    });
    assert_eq!(blocks, 2);
    let mut worst = (0.0, 0);
    for (k, column) in columns.iter().enumerate() {
        let h = 1e-4;
        let moved = |by: f64| {
            let mut moved = coefficients.clone();
            moved[k] += by;
            model.with_coefficients(&moved).predict(inputs)
        };
        // Fourth order: what is left is rounding.
        let (far_below, below, above, far_above) =
            (moved(-2.0 * h), moved(-h), moved(h), moved(2.0 * h));
        let size = column.iter().flatten().fold(1.0_f64, |m, v| m.max(v.abs()));
        for (i, exact) in column.iter().enumerate() {
            for axis in 0..3 {
                let of = |p: &truepose::model::Positions| p.get(i)[axis];
                let quotient = (8.0 * (of(&above) - of(&below))
                    - (of(&far_above) - of(&far_below)))
                    / (12.0 * h);
                let off = (exact[axis] - quotient).abs() / size;
                if off > worst.0 {
                    worst = (off, k);
                }
            }
        }
    }
    worst
}

fn all_effects() -> impl Iterator<Item = &'static Effect> {
    let beside = BESIDE_THE_CATALOGUE.iter().copied();
    let all = CATALOGUE.iter().copied().chain(beside);
    let all =
        all.flat_map(|effect| std::iter::once(effect).chain(effect.other_forms.iter().copied()));
    all.filter(|effect| effect.about().id != UNEXPLAINED)
}

#[test]
fn every_effect_alone_differentiates_as_it_moves() {
    let sizes = [0.013, -0.021, 0.008, 0.4, -0.2, 0.3];
    for robot in [column(), arm()] {
        let inputs = inputs(&robot);
        for effect in all_effects() {
            for joint in 0..robot.joints.len() {
                for sizes in [[0.0; 6], sizes] {
                    let term = term(effect, joint, 0.4, &sizes);
                    let model = Model::new(robot.clone(), vec![term]);
                    let (off, k) = worst_column(&model, &inputs);
                    let id = effect.about().id;
                    assert!(off < 1e-8, "{id} of joint {joint}, column {k}: {off:e}");
                }
            }
        }
    }
}

/// The largest difference between the derivatives by the commands and difference quotients,
/// relative to the derivative's size. Sides, speeds and travels stay what they are.
fn worst_by_command(model: &Model, inputs: &Inputs) -> (f64, usize) {
    let joints = model.robot.joints.len();
    let mut columns = vec![Vec::new(); joints];
    model.visit_by_commands(inputs, |_, block| {
        for (all, column) in columns.iter_mut().zip(&block.columns) {
            for i in 0..block.len {
                all.push([column[0][i], column[1][i], column[2][i]]);
            }
        }
    });
    let mut worst = (0.0, 0);
    for (joint, column) in columns.iter().enumerate() {
        let h = 2e-4;
        let moved = |by: f64| {
            let mut moved = inputs.clone();
            for q in moved.q[joint].to_mut() {
                *q += by;
            }
            model.predict(&moved)
        };
        let (far_below, below, above, far_above) =
            (moved(-2.0 * h), moved(-h), moved(h), moved(2.0 * h));
        let size = column.iter().flatten().fold(1.0_f64, |m, v| m.max(v.abs()));
        for (i, exact) in column.iter().enumerate() {
            for axis in 0..3 {
                let of = |p: &truepose::model::Positions| p.get(i)[axis];
                let quotient = (8.0 * (of(&above) - of(&below))
                    - (of(&far_above) - of(&far_below)))
                    / (12.0 * h);
                let off = (exact[axis] - quotient).abs() / size;
                if off > worst.0 {
                    worst = (off, joint);
                }
            }
        }
    }
    worst
}

#[test]
fn every_effect_differentiates_by_the_commands_too() {
    let sizes = [0.013, -0.021, 0.008, 0.4, -0.2, 0.3];
    for robot in [column(), arm()] {
        let inputs = inputs(&robot);
        for effect in all_effects() {
            for joint in 0..robot.joints.len() {
                let term = term(effect, joint, 0.1, &sizes);
                let model = Model::new(robot.clone(), vec![term]);
                let (off, by) = worst_by_command(&model, &inputs);
                let id = effect.about().id;
                assert!(off < 1e-8, "{id} of joint {joint} by {by}: {off:e}");
            }
        }
    }
}

#[test]
fn what_has_no_name_differentiates_by_the_commands_too() {
    let knots = Knots {
        from: -2.0,
        to: 2.0,
        period: None,
        count: 9,
    };
    for (robot, joint) in [(column(), 0), (arm(), 1), (arm(), 2)] {
        let inputs = inputs(&robot);
        let wave = |a: f64, k: f64| -> Vec<f64> {
            knots.places().iter().map(|q| a * (k * q).cos()).collect()
        };
        let values = [
            (1e-2, 2.0),
            (0.2, 3.0),
            (-0.1, 1.0),
            (3e-3, 1.0),
            (0.05, 2.0),
            (0.02, 3.0),
        ];
        let values = values.map(|(a, k)| wave(a, k));
        let sigma = values.clone().map(|v| vec![0.0; v.len()]);
        let curve = Curve::new(knots, values, sigma).unwrap();
        let model = Model::nominal(robot).with_term(Term::unexplained(joint, curve));
        // The curve bends at its knots, where a quotient is worse than the derivative.
        let (off, by) = worst_by_command(&model, &inputs);
        assert!(off < 1e-5, "joint {joint} by {by}: {off:e}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn all_effects_together_do_too(
        share in 0.0..1.0f64,
        sizes in prop::collection::vec(-0.02..0.02f64, 240),
        on_an_arm in any::<bool>(),
    ) {
        let robot = if on_an_arm { arm() } else { column() };
        let inputs = inputs(&robot);
        let joints = robot.joints.len();
        let terms = all_effects().enumerate().map(|(k, effect)| {
            term(effect, k % joints, share, &sizes[6 * k..6 * k + 6])
        });
        let model = Model::new(robot, terms.collect());
        let (off, by) = worst_by_command(&model, &inputs);
        prop_assert!(off < 1e-6, "by command {by}: {off:e}");
        let (off, k) = worst_column(&model, &inputs);
        prop_assert!(off < 1e-7, "column {k}: {off:e}");
    }
}

#[test]
fn an_effect_of_size_zero_moves_nothing() {
    let robot = arm();
    let inputs = inputs(&robot);
    let nominal = Model::nominal(robot.clone()).predict(&inputs);
    for effect in all_effects() {
        let absent = Model::new(robot.clone(), vec![term(effect, 1, 0.4, &[0.0; 6])]);
        let absent = absent.predict(&inputs);
        for i in 0..SAMPLES {
            for (a, b) in absent.get(i).into_iter().zip(nominal.get(i)) {
                assert!((a - b).abs() < 1e-12, "{}: {a} {b}", effect.about().id);
            }
        }
    }
}
