//! A candidate: a place and the conditions there, as the effects take it and as a pose that is written down.
//!
//! Joint values stay inside the limits (where there are none, inside what was measured). An
//! approach is long, so that lost motion has built up, or it begins with a reversal a stated way
//! before the pose.

use rand::Rng;

use crate::diagnosis::NextPose;
use crate::effects::Inputs;
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::effects::term::travel_of;
use crate::kinematics::{Joint, JointKind, Range, Robot};
use crate::sessions::Target;
use crate::text::Text;

/// Travel of a joint without stated limits and without samples: a full turn, or ± half a
/// metre.
const FREE: [f64; 2] = [std::f64::consts::PI, 500.0];
/// How a pose is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Arrival {
    /// From far.
    Long,
    /// After a reversal so many of each joint's ranges before.
    Short(f64),
    /// The same pose as that one of the list (counted from 0).
    Return(usize),
}

/// What may be measured: a place and the conditions there.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Candidate {
    /// rad or mm.
    pub(crate) q: Vec<f64>,
    /// Sides from which the joints come.
    pub(crate) dir: Vec<f64>,
    /// Signed, rad/s or mm/s.
    pub(crate) speed: Vec<f64>,
    pub(crate) arrival: Arrival,
    pub(crate) load_kg: f64,
    /// Above 20 °C, K.
    pub(crate) above_20_c: f64,
    pub(crate) target: u32,
    pub(crate) time_s: f64,
    /// Which of several ways of measuring ([`super::arm`]).
    pub(crate) way: usize,
}

impl Candidate {
    /// At standstill, without load, at 20 °C, of the first reflector, from no stated side.
    pub(crate) fn at(q: Vec<f64>) -> Self {
        Self {
            dir: vec![0.0; q.len()],
            speed: vec![0.0; q.len()],
            q,
            arrival: Arrival::Long,
            load_kg: 0.0,
            above_20_c: 0.0,
            target: 0,
            time_s: 0.0,
            way: 0,
        }
    }

    /// Whether it is measured while a joint moves.
    pub(crate) fn moves(&self) -> bool {
        self.speed.iter().any(|s| *s != 0.0)
    }
}

/// How candidates are written down as poses: which conditions are stated although nothing changes them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Writing<'t> {
    pub(crate) targets: &'t [Target],
    /// So many of the targets are there already; a pose of another states where it has to be mounted.
    pub(crate) mounted: usize,
    pub(crate) speeds: bool,
    pub(crate) loads: bool,
    pub(crate) temperatures: bool,
}

impl Writing<'_> {
    /// The pose of a candidate, and why it is measured.
    pub(crate) fn pose(&self, candidate: &Candidate, why: Text) -> NextPose {
        let index = candidate.target as usize;
        let target = self.targets.get(index);
        let (load_kg, above_20_c) = (candidate.load_kg, candidate.above_20_c);
        let speed = || candidate.speed.clone();
        NextPose {
            q: candidate.q.clone(),
            dir: candidate.dir.clone(),
            target: target
                .filter(|_| self.targets.len() > 1)
                .map(|t| t.name.clone()),
            target_mm: target
                .filter(|_| index >= self.mounted)
                .map(|t| t.position_mm.coords.into()),
            speed: (self.speeds || candidate.moves()).then(speed),
            load_kg: (self.loads || load_kg != 0.0).then_some(load_kg),
            temperature_c: (self.temperatures || above_20_c != 0.0)
                .then_some(above_20_c + REFERENCE_TEMPERATURE_C),
            why,
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
    let of = |(index, joint): (usize, &Joint)| {
        let free = FREE[usize::from(joint.kind == JointKind::Prismatic)];
        let q = measured.map_or(&[][..], |inputs| &inputs.q[index]);
        let travel = travel_of(robot, index, q);
        if travel.from < travel.to {
            travel
        } else {
            Range {
                from: -free,
                to: free,
            }
        }
    };
    robot.joints.iter().enumerate().map(of).collect()
}

/// A value of a joint as a technician types it: a tenth of a degree or of a millimetre.
pub(crate) fn typed(value: f64, kind: JointKind) -> f64 {
    let step = kind.to_base_units(0.1);
    (value / step).round() * step
}

/// The point of a range at this share of it.
pub(super) fn at(range: &Range, share: f64) -> f64 {
    let exact = range.from + (range.to - range.from) * share;
    exact.clamp(range.from, range.to)
}

/// Joint values anywhere within the ranges.
pub(crate) fn anywhere(ranges: &[Range], random: &mut impl Rng) -> Vec<f64> {
    use rand::RngExt as _;
    let one = |range: &Range| at(range, random.random::<f64>());
    ranges.iter().map(one).collect()
}

/// Candidates as the effects take them, `start_s` being the time from which drifts count.
pub(crate) fn inputs(
    robot: &Robot,
    targets: &[Target],
    ranges: &[Range],
    candidates: &[Candidate],
    start_s: Option<f64>,
) -> Inputs<'static> {
    let column = |f: &dyn Fn(&Candidate) -> f64| candidates.iter().map(f).collect::<Vec<f64>>();
    let home = |t: &Target| (robot.base_from_tool * t.position_mm).coords.into();
    let q = (0..ranges.len()).map(|j| column(&|c| c.q[j])).collect();
    let mut inputs = Inputs::at_poses(q, targets.iter().map(home).collect());
    for (j, range) in ranges.iter().enumerate() {
        let span = range.to - range.from;
        inputs.dir[j] = Some(column(&|c| c.dir[j]).into());
        inputs.speed[j] = Some(column(&|c| c.speed[j]).into());
        let travel = |c: &Candidate| match c.arrival {
            Arrival::Short(share) => share * span,
            _ => f64::INFINITY,
        };
        inputs.travel[j] = Some(column(&travel));
    }
    inputs.load_kg = Some(column(&|c| c.load_kg).into());
    inputs.above_20_c = Some(column(&|c| c.above_20_c));
    inputs.target = Some(candidates.iter().map(|c| c.target).collect());
    inputs.time_s = Some(column(&|c| c.time_s).into());
    inputs.start_s = start_s;
    inputs
}
