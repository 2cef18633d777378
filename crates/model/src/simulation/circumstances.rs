//! The conditions of the stops: speeds, loads, temperatures and times, still without a measured point.
//!
//! - Speed, load and temperature values are dealt from a shuffled deck that holds every combination
//!   once; an empty deck is shuffled anew. One combination is simply always used.
//! - The speed of a joint has the sign of its side; where the side is unknown, of the way from the
//!   stop before; a joint that does not move has none.
//! - Stop k begins at k times `seconds_per_pose`; its targets share that time equally.

use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use super::motion::side;
use super::scenario::{Circumstances, Scenario, Stop, Temperature};
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::sessions::{Lines, ObservedColumns, Samples};

/// The samples of these stops, their points still at zero.
pub(crate) fn samples(scenario: &Scenario, stops: &[Stop], random: &mut ChaCha8Rng) -> Samples {
    let c = &scenario.circumstances;
    let joints = scenario.robot.joints.len();
    let targets = scenario.targets.len();
    let n = stops.len() * targets;
    let hands = deal(c, stops.len(), random);
    let column = || Vec::with_capacity(n);
    let (mut q, mut dir, mut speed) = (
        vec![column(); joints],
        vec![column(); joints],
        vec![column(); joints],
    );
    let (mut target, mut load, mut temperature, mut time) =
        (Vec::with_capacity(n), column(), column(), column());
    let mut before: Vec<f64> = vec![0.0; joints];
    for (k, (stop, hand)) in stops.iter().zip(&hands).enumerate() {
        for (index, t) in (0..targets).zip(0_u32..) {
            let now =
                (k as f64 + index as f64 / targets as f64) * c.seconds_per_pose.unwrap_or(0.0);
            for joint in 0..joints {
                let from = stop.dir.as_ref().map_or(0.0, |dir| dir[joint]);
                let moving = if from == 0.0 {
                    side(before[joint], stop.q[joint])
                } else {
                    from
                };
                q[joint].push(stop.q[joint]);
                dir[joint].push(from);
                // Adding zero makes a speed of −0 a plain 0.
                speed[joint].push(moving * hand.speed + 0.0);
            }
            target.push(t);
            load.push(hand.load_kg);
            temperature.push(hand.temperature_c.unwrap_or_else(|| {
                c.temperature
                    .as_ref()
                    .map_or(REFERENCE_TEMPERATURE_C, |t| warmed_up(t, now))
            }));
            time.push(now);
        }
        before.clone_from(&stop.q);
    }
    let from_a_side = stops.iter().any(|stop| stop.dir.is_some());
    let given = |column: Vec<Vec<f64>>, is: bool| -> Vec<Option<Vec<f64>>> {
        column
            .into_iter()
            .map(|values| is.then_some(values))
            .collect()
    };
    let torque_nm = if c.torques {
        torques(scenario, &q, &load)
    } else {
        vec![None; joints]
    };
    let warmed = |t: &Temperature| time.iter().map(|now| warmed_up(t, *now)).collect();
    let of_joints = c.joint_temperatures.iter();
    let mut joint_temperature_c: Vec<_> = of_joints.map(|t| t.as_ref().map(warmed)).collect();
    joint_temperature_c.resize(joints, None);
    Samples {
        q,
        q_read: vec![None; joints],
        x_mm: vec![0.0; n],
        y_mm: vec![0.0; n],
        z_mm: None,
        orientation_wxyz: None,
        observed: ObservedColumns::default(),
        target: (targets > 1).then_some(target),
        dir: given(dir, from_a_side),
        speed: given(speed, !c.speeds.is_empty()),
        load_kg: (!c.loads_kg.is_empty()).then_some(load),
        temperature_c: c.temperature.is_some().then_some(temperature),
        torque_nm,
        joint_temperature_c,
        time_s: c.seconds_per_pose.is_some().then_some(time),
        setups: None,
        held_out: None,
        excluded: None,
        corrected: None,
        unknown: Vec::new(),
        line: Lines::default(),
    }
}

/// What one stop is dealt.
#[derive(Debug, Clone, Copy)]
struct StopConditions {
    speed: f64,
    load_kg: f64,
    /// `None`: the machine warms up.
    temperature_c: Option<f64>,
}

fn deal(c: &Circumstances, stops: usize, random: &mut ChaCha8Rng) -> Vec<StopConditions> {
    let or_zero = |values: &[f64]| {
        if values.is_empty() {
            vec![0.0]
        } else {
            values.to_vec()
        }
    };
    let temperatures: Vec<Option<f64>> = match &c.temperature {
        Some(Temperature::Values(values)) if !values.is_empty() => {
            values.iter().copied().map(Some).collect()
        }
        _ => vec![None],
    };
    let mut deck = Vec::new();
    for speed in or_zero(&c.speeds) {
        for load_kg in or_zero(&c.loads_kg) {
            deck.extend(temperatures.iter().map(|temperature_c| StopConditions {
                speed,
                load_kg,
                temperature_c: *temperature_c,
            }));
        }
    }
    let mut hands = Vec::with_capacity(stops);
    while hands.len() < stops {
        if deck.len() > 1 {
            deck.shuffle(random);
        }
        hands.extend(deck.iter().take(stops - hands.len()));
    }
    hands
}

/// Gravity's torque about each joint, as a sensor without errors shows it, N·m.
fn torques(scenario: &Scenario, q: &[Vec<f64>], load_kg: &[f64]) -> Vec<Option<Vec<f64>>> {
    let of_joint = |joint: usize| {
        let at = |sample: usize| {
            let pose: Vec<f64> = q.iter().map(|q| q[sample]).collect();
            let robot = &scenario.robot;
            robot.gravity_torque_nm(&pose, load_kg[sample], joint)
        };
        (0..load_kg.len()).map(at).collect()
    };
    (0..q.len()).map(of_joint).collect()
}

fn warmed_up(temperature: &Temperature, time_s: f64) -> f64 {
    match *temperature {
        Temperature::WarmUp {
            from_c,
            to_c,
            time_constant_s,
        } => {
            let exact = to_c + (from_c - to_c) * (-time_s / time_constant_s).exp();
            // What the thermometer shows is what the machine has: hundredths of a degree.
            (exact * 100.0).round() / 100.0
        }
        Temperature::Values(_) => REFERENCE_TEMPERATURE_C,
    }
}
