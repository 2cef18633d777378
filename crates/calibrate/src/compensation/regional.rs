//! The source paper's compensation: within a region the corrected position is
//!
//! ```text
//! q_c = q + M Δρ,   M = [[0, 1], [l1, 0]],   Δρ = (Δθ, Δl1)                        (8)
//! ```
//!
//! so x gets Δl1 and y gets l1·Δθ, in the base frame, the same for every pose of the region. x is
//! along the radius at home, y a quarter turn further in the joint's positive sense; z is not used.
//!
//! A joint cannot move to any position, only turn. The command that comes closest to `q_c` is its direction as seen
//! from the axis, and the residual is the distance of `q_c` from the circle. (Adding Δθ itself to the command would
//! not do: M Δρ leaves out the rotation, so Δθ is the turn at home and Δl1 contains a part of it elsewhere.) For
//! several reflectors the angle is the best for all of them together (least squares, in closed form).

use crate::effects::{Inputs, JointFrame};
use crate::kinematics::Robot;
use crate::lanes::{add_scaled, dot, minus};
use crate::model::RegionalCorrection;
use crate::sessions::Region;
use crate::sessions::regions::Assignment;

/// The paper's compensation: a constant correction of angle and radius for each region of the joint.
#[derive(Debug, Clone)]
pub struct Regional {
    corrections: Vec<RegionalCorrection>,
    regions: Vec<Region>,
    plane: Plane,
}

/// The plane in which the axis moves the reflectors.
#[derive(Debug, Clone)]
struct Plane {
    origin: [f64; 3],
    x: [f64; 3],
    y: [f64; 3],
}

impl Plane {
    /// In-plane coordinates of a reflector at home.
    fn home(&self, reflector_at_home: [f64; 3]) -> [f64; 2] {
        let arm = minus(reflector_at_home, self.origin);
        [dot(arm, self.x), dot(arm, self.y)]
    }
}

impl Regional {
    /// For a robot with a single revolute joint.
    pub fn new(robot: &Robot, corrections: &[RegionalCorrection]) -> Self {
        let frame = JointFrame::new(robot, 0);
        let [x, y] = frame.plane_of_motion();
        Self {
            corrections: corrections.to_vec(),
            regions: corrections.iter().map(RegionalCorrection::region).collect(),
            plane: Plane {
                origin: frame.origin_mm,
                x,
                y,
            },
        }
    }

    /// The correction of the region that owns each angle; `None` outside all regions.
    pub fn corrections_at(&self, q: &[f64]) -> Vec<Option<&RegionalCorrection>> {
        let assignment = Assignment::new(&self.regions);
        let at = |q: &f64| assignment.region_of(*q).map(|k| &self.corrections[k]);
        q.iter().map(at).collect()
    }

    /// Equation (8) as what to add to the position of a reflector, base frame, mm.
    pub fn position_correction(
        &self,
        correction: &RegionalCorrection,
        reflector_at_home: [f64; 3],
    ) -> [f64; 3] {
        let [a, b] = self.plane.home(reflector_at_home);
        let l1_mm = a.hypot(b);
        let along_x = self.plane.x.map(|v| v * correction.l1_mm);
        add_scaled(along_x, self.plane.y, l1_mm * correction.theta_rad)
    }

    /// What to add to each joint command, rad; 0 outside all regions.
    pub fn joint_corrections(&self, inputs: &Inputs) -> Vec<f64> {
        let Some(q) = inputs.q.first() else {
            return vec![0.0; inputs.len()];
        };
        let corrections = self.corrections_at(q);
        let corrections = corrections.iter().zip(q.iter());
        corrections
            .map(|(correction, q)| match correction {
                Some(correction) => self.turn_towards(correction, *q, &inputs.reflectors_at_home),
                None => 0.0,
            })
            .collect()
    }

    /// The turn that brings reflectors closest to their corrected positions: of all turns φ it
    /// makes Σ R(φ) n · (n + M Δρ) largest, n the nominal positions about the axis.
    fn turn_towards(
        &self,
        correction: &RegionalCorrection,
        q: f64,
        reflectors_at_home: &[[f64; 3]],
    ) -> f64 {
        let (sin, cos) = q.sin_cos();
        let (mut across, mut along) = (0.0, 0.0);
        for reflector in reflectors_at_home {
            let [a, b] = self.plane.home(*reflector);
            let l1_mm = a.hypot(b);
            let nominal = [a * cos - b * sin, a * sin + b * cos];
            let to_x = nominal[0] + correction.l1_mm;
            let to_y = nominal[1] + l1_mm * correction.theta_rad;
            across += nominal[0] * to_y - nominal[1] * to_x;
            along += nominal[0] * to_x + nominal[1] * to_y;
        }
        across.atan2(along)
    }

    /// A vector without its part along the axis.
    pub fn in_plane(&self, vector: [f64; 3]) -> [f64; 3] {
        let along_x = self.plane.x.map(|v| v * dot(vector, self.plane.x));
        add_scaled(along_x, self.plane.y, dot(vector, self.plane.y))
    }
}
