//! The needs of an effect before a session can show it: its obstacles are asked for with one condition after the other
//! met, until there are none.

use super::candidate::usual_speed;
use crate::effects::{Effect, Survey};
use crate::text::{Template, Text};

/// Load for a test where the session does not state loads, kg.
const TEST_LOAD_KG: f64 = 3.0;
/// A load for a test: as asked for, else the heaviest of the session, where it has any.
pub(crate) fn test_load_kg(asked: Option<f64>, heaviest: f64) -> f64 {
    let heaviest = Some(heaviest).filter(|kg| *kg > 0.0);
    asked.or(heaviest).unwrap_or(TEST_LOAD_KG)
}

/// How much warmer a warm machine is, K.
pub(crate) const WARMING_C: f64 = 6.0;

named! {
    /// A condition that is missing.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Need {
        /// Poses approached from both sides.
        BothSides = phrase!("approach the same places from both sides"),
        /// Poses measured while the joint moves, at two speeds.
        Speeds = phrase!("measure in motion at two speeds as well"),
        /// Two loads.
        Loads = phrase!("measure without and with a load"),
        /// A cold and a warm machine.
        Temperatures = phrase!("measure with the machine cold and warm, and again while it cools down"),
        /// More values of the joint.
        Travel = phrase!("spread the poses over the whole travel"),
        /// A second reflector at another radius.
        Reflector = phrase!("mount a second reflector at another radius"),
        /// The time of every sample.
        Times = phrase!("write down the time of every sample (time_s)"),
        /// All three coordinates.
        Height = phrase!("measure z as well"),
        /// The direction of gravity in the robot's file.
        Gravity = phrase!("give the direction of gravity in the robot's file (gravity_m_s2)"),
    }
    /// What the technician does.
    pub fn describe -> Template;
    /// Every condition, in the order in which they are tried.
    const ALL;
}

impl Need {
    /// Whether poses and their conditions are enough; otherwise something has to be written down.
    pub fn by_poses(self) -> bool {
        !matches!(self, Self::Times | Self::Height | Self::Gravity)
    }

    /// The survey as it would be.
    pub(crate) fn met(self, survey: &Survey) -> Survey {
        let mut survey = survey.clone();
        for joint in &mut survey.joints {
            match self {
                Self::BothSides => joint.from_sides = [8, 8],
                Self::Speeds => {
                    joint.speeds = joint.speeds.max(3);
                    joint.largest_speed = joint.largest_speed.max(usual_speed(joint.kind));
                }
                Self::Travel => {
                    joint.values = crate::effects::survey::ENOUGH;
                    joint.span = joint.span.max(1.0);
                }
                Self::Temperatures => joint.warming_c = joint.warming_c.map(|_| WARMING_C),
                // Where gravity is unknown it may well be across the axis.
                Self::Gravity if !survey.gravity => joint.gravity_lever = true,
                _ => {}
            }
        }
        match self {
            Self::Loads => {
                survey.loads = survey.loads.max(2);
                survey.largest_load_kg = survey.largest_load_kg.max(TEST_LOAD_KG);
            }
            Self::Temperatures => survey.warming_c = Some(WARMING_C),
            Self::Reflector => survey.targets = survey.targets.max(2),
            Self::Times => survey.duration_s = Some(survey.duration_s.unwrap_or(0.0).max(600.0)),
            Self::Height => survey.spatial = true,
            Self::Gravity => survey.gravity = true,
            _ => {}
        }
        survey
    }
}

/// An effect that cannot be seen, and what would change that.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Untestable {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 0; `None` where it belongs to none.
    pub joint: Option<usize>,
    /// Why it cannot be seen.
    pub because: Text,
    /// What is needed; empty where nothing helps.
    pub needs: Vec<Need>,
}

/// A survey in which every condition that poses can meet is met.
pub(crate) fn all_met(survey: &Survey) -> Survey {
    let by_poses = Need::ALL.into_iter().filter(|n| n.by_poses());
    by_poses
        .chain([Need::Times])
        .fold(survey.clone(), |survey, need| need.met(&survey))
}

/// What an effect lacks; empty where nothing helps, or nothing is lacking.
pub(crate) fn lacks(effect: &Effect, survey: &Survey, joint: usize) -> Vec<Need> {
    let mut now = survey.clone();
    let mut needs: Vec<Need> = Vec::new();
    while let Some(reason) = effect.obstacle(&now, joint) {
        let helps = |need: &Need| {
            !needs.contains(need)
                && effect.obstacle(&need.met(&now), joint).as_ref() != Some(&reason)
        };
        let Some(need) = Need::ALL.into_iter().find(|n| helps(n)) else {
            return Vec::new();
        };
        now = need.met(&now);
        needs.push(need);
    }
    needs
}
