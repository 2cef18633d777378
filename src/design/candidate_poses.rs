//! What may be measured next: places within the limits, sides of approach, speeds, loads,
//! temperatures and reflectors, as every combination of them.
//!
//! Joint values stay inside the limits (where there are none, inside what was measured). An
//! approach is long, so that lost motion has built up, or it begins with a reversal a stated way
//! before the pose. A new reflector may stand on a bar of at most [`REACH_MM`].

use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::effects::Inputs;
use crate::effects::term::JointFrame;
use crate::kinematics::{JointKind, Range, Robot};
use crate::sessions::Target;

/// How far from the first reflector a second one can be held, mm: a light bar on the flange.
pub(crate) const REACH_MM: f64 = 300.0;
/// Travel of a joint whose limits nobody gave and that has no samples: a full turn, or ± half a
/// metre.
const FREE_TURN: Range = Range {
    from: -std::f64::consts::PI,
    to: std::f64::consts::PI,
};
const FREE_SLIDE: Range = Range {
    from: -500.0,
    to: 500.0,
};
/// Angles that are tried over the range of a joint.
const ANGLES: usize = 24;
/// Joint vectors of an arm that are drawn at random beside the sweeps of single joints.
const VECTORS: usize = 60;

/// What may be measured.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CandidatePose {
    pub(crate) q: Vec<f64>,
    pub(crate) dir: Vec<f64>,
    pub(crate) speed: Vec<f64>,
    /// Travel since the joints reversed, as a share of each one's range; `None`: a long one.
    pub(crate) approach: Option<f64>,
    pub(crate) load_kg: f64,
    pub(crate) warmth_c: f64,
    pub(crate) target: u32,
    pub(crate) time_s: f64,
}

/// Conditions that are offered; every combination of them is a choice.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Conditions {
    /// Multiples of each joint's unit of speed.
    pub(crate) speeds: Vec<f64>,
    /// rad/s or mm/s, one for each joint.
    pub(crate) unit_of_speed: Vec<f64>,
    pub(crate) loads_kg: Vec<f64>,
    pub(crate) warmths_c: Vec<f64>,
    pub(crate) approaches: Vec<Option<f64>>,
    pub(crate) targets: Vec<u32>,
    pub(crate) time_s: f64,
}

impl Conditions {
    /// Standstill, no load, 20 °C, long approaches, the first reflector.
    pub(crate) fn plain(robot: &Robot) -> Self {
        Self {
            speeds: vec![0.0],
            unit_of_speed: robot.joints.iter().map(|j| usual_speed(j.kind)).collect(),
            loads_kg: vec![0.0],
            warmths_c: vec![0.0],
            approaches: vec![None],
            targets: vec![0],
            time_s: 0.0,
        }
    }
}

/// A modest speed: 10°/s, or 50 mm/s.
pub(crate) fn usual_speed(kind: JointKind) -> f64 {
    match kind {
        JointKind::Revolute => 10.0_f64.to_radians(),
        JointKind::Prismatic => 50.0,
    }
}

/// Where each joint may be sent: its limits, else what was measured, else a full turn.
pub(crate) fn ranges(robot: &Robot, measured: Option<&Inputs>) -> Vec<Range> {
    let of = |(index, joint): (usize, &crate::kinematics::Joint)| {
        let free = match joint.kind {
            JointKind::Revolute => FREE_TURN,
            JointKind::Prismatic => FREE_SLIDE,
        };
        let q = measured.map_or(&[][..], |inputs| &inputs.q[index]);
        let travel = crate::effects::term::travel_of(robot, index, q);
        if travel.from < travel.to {
            travel
        } else {
            free
        }
    };
    robot.joints.iter().enumerate().map(of).collect()
}

/// All combinations of places, sides and conditions.
pub(crate) fn combinations(
    ranges: &[Range],
    conditions: &Conditions,
    seed: u64,
) -> Vec<CandidatePose> {
    let mut all = Vec::new();
    for q in &places(ranges, seed) {
        for side in [-1.0, 1.0] {
            for speed in &conditions.speeds {
                let units = conditions.unit_of_speed.iter();
                let speed: Vec<f64> = units.map(|unit| side * speed * unit + 0.0).collect();
                for approach in &conditions.approaches {
                    for load_kg in &conditions.loads_kg {
                        for warmth_c in &conditions.warmths_c {
                            for target in &conditions.targets {
                                all.push(CandidatePose {
                                    q: q.clone(),
                                    dir: vec![side; ranges.len()],
                                    speed: speed.clone(),
                                    approach: *approach,
                                    load_kg: *load_kg,
                                    warmth_c: *warmth_c,
                                    target: *target,
                                    time_s: conditions.time_s,
                                });
                            }
                        }
                    }
                }
            }
        }
    }
    all
}

/// Each joint over its range with the others in the middle, and for an arm some at random.
fn places(ranges: &[Range], seed: u64) -> Vec<Vec<f64>> {
    let middle: Vec<f64> = ranges.iter().map(|r| 0.5 * (r.from + r.to)).collect();
    let mut places = Vec::new();
    let angles = (2 * ANGLES / (1 + ranges.len())).max(6);
    for (joint, range) in ranges.iter().enumerate() {
        for k in 0..angles {
            let mut q = middle.clone();
            q[joint] = at(range, (k as f64 + 0.5) / angles as f64);
            places.push(q);
        }
    }
    if ranges.len() > 1 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        places.extend((0..VECTORS).map(|_| anywhere(ranges, &mut random)));
    }
    places
}

/// The point of a range at this share of it, rounded to what a technician types.
pub(crate) fn at(range: &Range, share: f64) -> f64 {
    let exact = range.from + (range.to - range.from) * share;
    exact.clamp(range.from, range.to)
}

/// Rounded to what a technician types: a tenth of a degree or of a millimetre.
pub(crate) fn typed(value: f64, kind: JointKind) -> f64 {
    let step = kind.inner(0.1);
    (value / step).round() * step
}

/// Joint values anywhere within the ranges.
pub(crate) fn anywhere(ranges: &[Range], random: &mut impl Rng) -> Vec<f64> {
    use rand::RngExt as _;
    let one = |range: &Range| at(range, random.random::<f64>());
    ranges.iter().map(one).collect()
}

/// The choices as the effects take them. Times are those of the choices where `timed`.
pub(crate) fn inputs(
    robot: &Robot,
    targets: &[Target],
    ranges: &[Range],
    choices: &[CandidatePose],
    start_s: Option<f64>,
) -> Inputs<'static> {
    let column = |f: &dyn Fn(&CandidatePose) -> f64| choices.iter().map(f).collect::<Vec<f64>>();
    let joints = 0..ranges.len();
    let q = joints.clone().map(|j| column(&|c| c.q[j])).collect();
    let mut inputs = Inputs::at_poses(q, reflectors_of(robot, targets));
    for (j, range) in ranges.iter().enumerate() {
        let span = range.to - range.from;
        inputs.dir[j] = Some(column(&|c| c.dir[j]).into());
        inputs.speed[j] = Some(column(&|c| c.speed[j]).into());
        let travel = |c: &CandidatePose| c.approach.map_or(f64::INFINITY, |share| share * span);
        inputs.travel[j] = Some(column(&travel));
    }
    inputs.load_kg = Some(column(&|c| c.load_kg).into());
    inputs.warmth_c = Some(column(&|c| c.warmth_c));
    inputs.target = Some(
        choices
            .iter()
            .map(|c| c.target)
            .collect::<Vec<u32>>()
            .into(),
    );
    inputs.time_s = Some(column(&|c| c.time_s).into());
    inputs.start_s = start_s;
    inputs
}

fn reflectors_of(robot: &Robot, targets: &[Target]) -> Vec<[f64; 3]> {
    let home = |t: &Target| (robot.base_from_tool * t.position_mm).coords.into();
    targets.iter().map(home).collect()
}

/// Places for a second reflector within reach of the first, the likeliest to help first: further
/// out and higher, across the first axis, and in towards it.
pub(crate) fn other_reflectors(robot: &Robot, targets: &[Target]) -> Vec<Target> {
    let joint = robot
        .joints
        .iter()
        .position(|j| j.kind == JointKind::Revolute);
    let frame = JointFrame::new(robot, joint.unwrap_or(0));
    let outward = if frame.radius_mm > 0.0 {
        frame.radial
    } else {
        frame.across_1
    };
    let (outward, along) = (Vector3::from(outward), Vector3::from(frame.along));
    let across = along.cross(&outward);
    let shifts = [
        outward * 0.9 + along * 0.4,
        outward * 0.3 + across * 0.85 + along * 0.4,
        outward * -0.9 + along * 0.4,
    ];
    let first = targets
        .first()
        .map_or_else(Vector3::zeros, |t| t.position_mm.coords);
    let mut name = format!("T{}", targets.len() + 1);
    while targets.iter().any(|t| t.name == name) {
        name.push('n');
    }
    let at = |shift: Vector3<f64>| {
        let in_tool = robot.base_from_tool.rotation.inverse() * (shift * REACH_MM);
        Target {
            name: name.clone(),
            position_mm: (first + in_tool).map(|v| (v / 5.0).round() * 5.0).into(),
        }
    };
    shifts.into_iter().map(at).collect()
}
