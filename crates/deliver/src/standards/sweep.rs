//! The samples in which one joint visits positions while all others stand, and how far a point is along its motion.

use nalgebra::{Point3, Unit, Vector3};

use super::points::Points;
use super::positioning::Position;
use crate::kinematics::JointKind;

/// Below this radius, mm, a point says nothing of an angle.
const LEAST_RADIUS_MM: f64 = 1e-3;
/// One radian in seconds of arc.
pub(super) const ARCSEC: f64 = 3600.0 * 180.0 / std::f64::consts::PI;

/// The samples of one series.
pub(super) struct Sweep<'p, 's> {
    pub(super) points: &'p Points<'s>,
    pub(super) joint: usize,
    axis: Unit<Vector3<f64>>,
    on_axis: Point3<f64>,
    pub(super) first: usize,
    /// Samples by position in ascending order: from below, from above.
    pub(super) positions: Vec<(f64, [Vec<usize>; 2])>,
}

impl<'p, 's> Sweep<'p, 's> {
    /// `None` with fewer than two positions.
    pub(super) fn new(points: &'p Points<'s>, joint: usize, samples: &[usize]) -> Option<Self> {
        let first = *samples.first()?;
        let q = &points.inputs.q[joint];
        let dir = points.inputs.dir[joint].as_ref()?;
        let mut order = samples.to_vec();
        order.sort_by(|a, b| q[*a].total_cmp(&q[*b]).then(a.cmp(b)));
        let positions: Vec<_> = order
            .chunk_by(|a, b| q[*a] == q[*b])
            .map(|at| {
                let from = |side: f64| at.iter().copied().filter(|i| dir[*i] == side).collect();
                (q[at[0]], [from(1.0), from(-1.0)])
            })
            .collect();
        if positions.len() < 2 {
            return None;
        }
        let pose: Vec<f64> = points.inputs.q.iter().map(|q| q[first]).collect();
        let motion = points.robot.motions_from_home(&pose)[joint];
        let axis = &points.robot.joints[joint].axis;
        Some(Self {
            points,
            joint,
            axis: motion.rotation * axis.direction,
            on_axis: motion * axis.point_mm,
            first,
            positions,
        })
    }

    /// Positions with few approaches do not take the figures from the others: the positions that
    /// give most stay, where there are two of them.
    pub(super) fn keep_the_most_useful(&mut self) {
        for wanted in [[2, 2], [1, 1], [2, 0], [0, 2], [1, 0], [0, 1]] {
            let serves =
                |p: &(f64, [Vec<usize>; 2])| p.1[0].len() >= wanted[0] && p.1[1].len() >= wanted[1];
            if self.positions.iter().filter(|p| serves(p)).count() >= 2 {
                self.positions.retain(serves);
                return;
            }
        }
    }

    /// `None` if a point is too near to the axis.
    pub(super) fn deviations(&self, compensated: bool) -> Option<Vec<Position>> {
        let outer = |q: f64| self.points.robot.joints[self.joint].kind.to_display(q);
        let position = |(q, sides): &(f64, [Vec<usize>; 2])| {
            let deviations = |side: &Vec<usize>| -> Option<Vec<f64>> {
                side.iter()
                    .map(|i| self.deviation(*i, compensated))
                    .collect()
            };
            Some(Position {
                commanded: outer(*q),
                up: deviations(&sides[0])?,
                down: deviations(&sides[1])?,
            })
        };
        self.positions.iter().map(position).collect()
    }

    fn deviation(&self, sample: usize, compensated: bool) -> Option<f64> {
        let commanded = self.points.commanded(sample);
        self.along(commanded, self.points.attained(sample, compensated))
    }

    /// From one point to another along the joint's motion, in the unit of the axis; `None` if one is too near to
    /// the axis.
    pub(super) fn along(&self, commanded: Point3<f64>, attained: Point3<f64>) -> Option<f64> {
        let axis = self.axis.into_inner();
        if self.points.robot.joints[self.joint].kind == JointKind::Prismatic {
            return Some(axis.dot(&(attained - commanded)));
        }
        let across = |point: Point3<f64>| {
            let lever = point - self.on_axis;
            lever - axis * axis.dot(&lever)
        };
        let (wanted, real) = (across(commanded), across(attained));
        let far = wanted.norm() > LEAST_RADIUS_MM && real.norm() > LEAST_RADIUS_MM;
        far.then(|| axis.dot(&wanted.cross(&real)).atan2(wanted.dot(&real)) * ARCSEC)
    }

    /// How a small displacement of a point counts along the joint's motion, in the unit of the axis per mm.
    pub(super) fn motion(&self, point: Point3<f64>) -> Vector3<f64> {
        let axis = self.axis.into_inner();
        if self.points.robot.joints[self.joint].kind == JointKind::Prismatic {
            return axis;
        }
        let lever = point - self.on_axis;
        let across = lever - axis * axis.dot(&lever);
        axis.cross(&across) * (ARCSEC / across.norm_squared().max(LEAST_RADIUS_MM.powi(2)))
    }
}
