//! Which axis of a controller is which joint of the model.
//!
//! Controllers count six axes of the robot (A1 … A6, J1 … J6, `rax_1` …) and six external ones (E1 … E6,
//! `eax_a` … `eax_f`). A joint of the model that has the name of an external axis is that one; the others
//! are the robot's, in order.

use crate::kinematics::{Joint, JointKind, Robot};
use nalgebra::Vector3;

use super::number::Number;
use super::target::{Problem, Shape, Target};

/// An axis of a controller, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Slot {
    /// One of the robot's own.
    Own(usize),
    /// An external one.
    External(usize),
}

/// For each axis of a controller the joint of the model that it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Axes {
    /// The axis of each joint.
    slots: Vec<Slot>,
    kinds: Vec<JointKind>,
    shoulder_mm: Option<Vector3<f64>>,
}

/// Axes whose directions have a larger product than this do not pass at right angles: errors of a real robot are
/// thousandths, other shapes of arm are parallel.
const NOT_RIGHT_ANGLED: f64 = 0.1;

/// The point of the first axis that is nearest to the second.
fn shoulder([one, two]: [&Joint; 2]) -> Option<Vector3<f64>> {
    let turns = [one, two].iter().all(|j| j.kind == JointKind::Revolute);
    let (along, other) = (one.axis.direction, two.axis.direction);
    let product = along.dot(&other);
    let between = two.axis.point_mm - one.axis.point_mm;
    let t = (between.dot(&along) - product * between.dot(&other)) / (1.0 - product * product);
    let is_one = turns && product.abs() < NOT_RIGHT_ANGLED;
    is_one.then(|| one.axis.point_mm.coords + along.into_inner() * t)
}

/// Axes of one kind that a controller has.
pub(super) const MOST_OWN: usize = 6;

impl Axes {
    /// The axes of a robot.
    pub fn new(robot: &Robot) -> Self {
        let mut own = 0;
        let slots = robot.joints.iter().map(|joint| {
            if let Some(k) = external(&joint.name) {
                return Slot::External(k);
            }
            own += 1;
            Slot::Own(own - 1)
        });
        let slots: Vec<Slot> = slots.collect();
        let own = |k: usize| slots.iter().position(|slot| *slot == Slot::Own(k));
        let lines = own(0)
            .zip(own(1))
            .map(|(one, two)| [one, two].map(|k| &robot.joints[k]));
        Self {
            shoulder_mm: lines.and_then(shoulder),
            slots,
            kinds: robot.joints.iter().map(|joint| joint.kind).collect(),
        }
    }

    /// Where axis 1 passes axis 2 at the robot's zero, mm in the base frame; of axes that do not pass at right
    /// angles there is no such point.
    pub(super) fn shoulder_mm(&self) -> Option<Vector3<f64>> {
        self.shoulder_mm
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.slots.len()
    }

    /// Number of the robot's own axes.
    pub fn own(&self) -> usize {
        let own = self.slots.iter().filter(|s| matches!(s, Slot::Own(_)));
        own.count()
    }

    /// That the controller has no room for the model's own axes; `external`: how it calls the others.
    pub(super) fn check_own(&self, external: &str) -> Result<(), Vec<Problem>> {
        if self.own() <= MOST_OWN {
            return Ok(());
        }
        let found = text!("a model with {own} axes of its own", own = self.own());
        let expected = text!(
            "at most 6; external axes are called {external} in the model",
            external
        );
        Err(vec![Problem::new(0, found, expected)])
    }

    /// A target of joint values in degrees and mm, each taken from its axis.
    ///
    /// # Errors
    /// What `number` says of an axis.
    pub(super) fn joint_target<E>(
        &self,
        name: &str,
        at: usize,
        number: impl FnMut(Slot) -> Result<Number, E>,
    ) -> Result<Target, E> {
        let numbers: Result<Vec<Number>, E> = self.slots.iter().copied().map(number).collect();
        let shape = Shape::Joints {
            numbers: numbers?,
            scales: self.inner_of_degrees().into(),
            decimals: 5,
        };
        Ok(Target::new(name, at, shape))
    }

    /// The values of the external axes beside a pose, rad or mm, by joint.
    ///
    /// # Errors
    /// What `number` says of an axis.
    pub(super) fn external<E>(
        &self,
        mut number: impl FnMut(Slot) -> Result<Number, E>,
    ) -> Result<Vec<(usize, f64)>, E> {
        let external = (0..self.joints()).filter(|j| matches!(self.slot(*j), Slot::External(_)));
        external
            .map(|joint| {
                let value = number(self.slot(joint))?.value;
                Ok((joint, self.kind(joint).to_base_units(value)))
            })
            .collect()
    }

    /// The joint at an axis.
    pub fn joint(&self, slot: Slot) -> Option<usize> {
        self.slots.iter().position(|s| *s == slot)
    }

    /// The same in a byte: a robot has at most 100 joints.
    pub(super) fn numbered(&self, slot: Slot) -> Option<u8> {
        u8::try_from(self.joint(slot)?).ok()
    }

    /// The axis of a joint; of one that the robot has not, an axis of its own behind all others.
    pub fn slot(&self, joint: usize) -> Slot {
        let slot = self.slots.get(joint).copied();
        slot.unwrap_or(Slot::Own(joint))
    }

    /// What a joint does; one that the robot has not would turn.
    pub fn kind(&self, joint: usize) -> JointKind {
        let kind = self.kinds.get(joint).copied();
        kind.unwrap_or(JointKind::Revolute)
    }

    /// rad or mm in a degree or mm of each joint.
    pub fn inner_of_degrees(&self) -> Vec<f64> {
        self.kinds
            .iter()
            .map(|kind| kind.to_base_units(1.0))
            .collect()
    }

    /// Joints that a correction moves: external axes stay where the program puts them, unless there
    /// is nothing else to move.
    pub fn free(&self) -> Vec<usize> {
        let own = |j: &usize| matches!(self.slots[*j], Slot::Own(_));
        let free: Vec<usize> = (0..self.joints()).filter(own).collect();
        if free.is_empty() {
            (0..self.joints()).collect()
        } else {
            free
        }
    }
}

/// The external axis of this name.
fn external(name: &str) -> Option<usize> {
    match *name.to_lowercase().as_bytes() {
        [b'e', b'a', b'x', b'_', letter @ b'a'..=b'f'] => Some(usize::from(letter - b'a')),
        [b'e', digit @ b'1'..=b'6'] => Some(usize::from(digit - b'1')),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::column;

    #[test]
    fn external_axes_go_by_their_names() {
        let mut robot = column();
        let mut track = robot.joints[0].clone();
        track.name = "E1".to_owned();
        robot.joints.insert(0, track);
        let axes = Axes::new(&robot);
        assert_eq!(axes.slot(0), Slot::External(0));
        assert_eq!(axes.joint(Slot::Own(0)), Some(1));
        assert_eq!((axes.own(), axes.free()), (1, vec![1]));
        assert_eq!(external("eax_c"), Some(2));
        assert_eq!(external("elbow"), None);
    }
}
