//! Motions of all points and columns of a block at once, by loops for wide vectors: of a joint, of a
//! rigid body, and of points by the derivative of each.

use super::{Block, JointTangent, Placed};
use crate::kinematics::JointKind;
use crate::lanes::{LANES, add_scaled, cross, minus, times, turned};
use crate::sincos::sin_cos_small as sin_cos;
use crate::wide::{Loop, wide};

impl Block<'_> {
    /// Like [`Block::transform`] for a motion that is one and the same for all samples.
    pub(in crate::effects) fn move_rigidly<const N: usize>(
        &mut self,
        me: &Placed,
        by: &RigidMotion<N>,
    ) {
        wide(MovingRigidly {
            asked: self.asks_for::<N>(me),
            block: self,
            first_column: me.first_column,
            by,
        });
        self.mark_live::<N>(me);
    }

    /// Lets a joint move everything behind it, and turns its tangents into columns:
    /// ∂x/∂θ = ω × (x − c) for a revolute joint, ω for a prismatic one.
    pub fn move_joint(&mut self, index: usize) {
        wide(Moving { block: self, index });
    }

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a part of a wide loop")]
    fn move_behind(&mut self, index: usize) {
        let joint = &self.robot.joints[index];
        let axis: [f64; 3] = joint.axis.direction.into_inner().into();
        let origin: [f64; 3] = joint.axis.point_mm.coords.into();
        match joint.kind {
            JointKind::Revolute => self.rotate(index, axis, origin),
            JointKind::Prismatic => {
                for i in 0..LANES {
                    for k in 0..3 {
                        self.point[k][i] += axis[k] * self.theta[index][i];
                    }
                }
            }
        }
        let held = &self.held;
        let moves = |t: &&JointTangent| t.joint == index && !held[t.column];
        if !self.tangents.iter().any(|t| moves(&t)) {
            return;
        }
        let mut direction = [[0.0; LANES]; 3];
        for i in 0..LANES {
            let along = match joint.kind {
                JointKind::Revolute => {
                    let x = [self.point[0][i], self.point[1][i], self.point[2][i]];
                    cross(axis, minus(x, origin))
                }
                JointKind::Prismatic => axis,
            };
            for k in 0..3 {
                direction[k][i] = along[k];
            }
        }
        if let Some(first) = self.by_joints_from {
            self.columns[first + index] = direction;
            self.live[first + index] = true;
            return;
        }
        for tangent in self.tangents.iter().filter(moves) {
            let column = &mut self.columns[tangent.column];
            if !self.live[tangent.column] {
                *column = [[0.0; LANES]; 3];
                self.live[tangent.column] = true;
            }
            for (axis, direction) in column.iter_mut().zip(&direction) {
                for i in 0..LANES {
                    axis[i] += direction[i] * tangent.lanes[i];
                }
            }
        }
    }

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a part of a wide loop")]
    fn rotate(&mut self, index: usize, axis: [f64; 3], origin: [f64; 3]) {
        let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            (sin[i], cos[i]) = sin_cos(self.theta[index][i]);
        }
        let [px, py, pz] = &mut self.point;
        for i in 0..LANES {
            let arm = minus([px[i], py[i], pz[i]], origin);
            [px[i], py[i], pz[i]] = add_scaled(turned(arm, axis, sin[i], cos[i]), origin, 1.0);
        }
        for (column, _) in self.columns.iter_mut().zip(&self.live).filter(|c| *c.1) {
            let [cx, cy, cz] = column;
            for i in 0..LANES {
                [cx[i], cy[i], cz[i]] = turned([cx[i], cy[i], cz[i]], axis, sin[i], cos[i]);
            }
        }
    }
}

/// A rigid motion about a point, mm and rad, with the screws (turn and shift) by which each coefficient
/// moves what it has moved.
pub(in crate::effects) struct RigidMotion<const N: usize> {
    pub(in crate::effects) origin_mm: [f64; 3],
    /// By rows.
    pub(in crate::effects) rotation: [[f64; 3]; 3],
    pub(in crate::effects) shift_mm: [f64; 3],
    pub(in crate::effects) by: [([f64; 3], [f64; 3]); N],
}

/// The loop of [`Block::move_rigidly`].
struct MovingRigidly<'b, 'a, const N: usize> {
    block: &'b mut Block<'a>,
    first_column: usize,
    /// Whether its own columns are.
    asked: bool,
    by: &'b RigidMotion<N>,
}

impl<const N: usize> Loop for MovingRigidly<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let RigidMotion {
            origin_mm,
            rotation,
            shift_mm,
            by,
        } = *self.by;
        let Block {
            point,
            columns,
            live,
            ..
        } = self.block;
        let [px, py, pz] = point;
        let mut arm = [[0.0; LANES]; 3];
        for i in 0..LANES {
            let from = minus([px[i], py[i], pz[i]], origin_mm);
            let own = add_scaled(times(rotation, from), shift_mm, 1.0);
            [arm[0][i], arm[1][i], arm[2][i]] = own;
            [px[i], py[i], pz[i]] = add_scaled(own, origin_mm, 1.0);
        }
        for (column, _) in columns.iter_mut().zip(live.iter()).filter(|c| *c.1) {
            let [cx, cy, cz] = column;
            for i in 0..LANES {
                [cx[i], cy[i], cz[i]] = times(rotation, [cx[i], cy[i], cz[i]]);
            }
        }
        if !self.asked {
            return;
        }
        for (k, (turn, shift)) in by.into_iter().enumerate() {
            let [cx, cy, cz] = &mut columns[self.first_column + k];
            for i in 0..LANES {
                let own = cross(turn, [arm[0][i], arm[1][i], arm[2][i]]);
                [cx[i], cy[i], cz[i]] = add_scaled(own, shift, 1.0);
            }
        }
    }
}

/// The loop of [`Block::move_joint`].
struct Moving<'b, 'a> {
    block: &'b mut Block<'a>,
    index: usize,
}

impl Loop for Moving<'_, '_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        self.block.move_behind(self.index);
    }
}
