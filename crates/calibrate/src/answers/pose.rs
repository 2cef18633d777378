//! A pose that is worth measuring next, with its conditions.

use crate::kinematics::Robot;
use crate::model::SetUp;
use crate::text::Text;

/// Brings poses from the convention of a model into that of the controller.
pub(crate) fn to_raw(poses: &mut [NextPose], set_up: &SetUp, robot: &Robot) {
    for pose in poses {
        set_up.to_raw(robot, &mut pose.q);
        set_up.signs_to_raw(&mut pose.dir);
        if let Some(speed) = &mut pose.speed {
            set_up.signs_to_raw(speed);
        }
    }
}

/// A pose to measure and its conditions.
#[derive(Debug, Clone, PartialEq)]
pub struct NextPose {
    /// Joint values, rad or mm.
    pub q: Vec<f64>,
    /// Side from which each joint comes: +1 while its value grows, −1 while it shrinks.
    pub dir: Vec<f64>,
    /// Name of a reflector of the session, or of a new one; `None` where there is only one.
    pub target: Option<String>,
    /// Where a new reflector goes, tool frame, mm.
    pub target_mm: Option<[f64; 3]>,
    /// Signed speeds, rad/s or mm/s.
    pub speed: Option<Vec<f64>>,
    /// Load, kg.
    pub load_kg: Option<f64>,
    /// Temperature, °C.
    pub temperature_c: Option<f64>,
    /// Why.
    pub why: Text,
}

impl NextPose {
    /// Whether it is measured under the same conditions as another.
    pub fn repeats(&self, other: &Self) -> bool {
        let but_why = Self {
            why: Text::default(),
            ..self.clone()
        };
        let other = Self {
            why: Text::default(),
            ..other.clone()
        };
        but_why == other
    }
}
