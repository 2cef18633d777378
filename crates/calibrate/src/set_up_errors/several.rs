//! More mistakes of setting up an arm than are tried one by one and in pairs: conventions that differ in many joints
//! at once, as those of a maker and of a description do.
//!
//! ```text
//! q_k = s_k (c_π(k) + d_k c_π(k−1)) + h_k,   s_k = ±1,   h_k a multiple of 90°,
//! d_k = ±1 or 0, along parallel axes (a parallelogram),   π: which column is whose
//! ```
//!
//! with the measured points as they are or as in a mirror. The error of a choice is that of the nominal robot with the
//! best rigid motion; a descent over two joints at a time, from several starts, finds the choice. What is as good with
//! fewer mistakes is taken. It is accepted by the same trial as every other mistake.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

use crate::effects::JointValues;
use crate::kinematics::{JointKind, Robot};
use crate::sessions::Session;

use super::changes::{
    Change, axes_exchanged, exchange, home, is_parallel_to_the_one_before, parallelogram, sign,
};
use super::fits::thinned;
use super::nearest::Nominal;
use super::thresholds::{EQUAL, FEW_SAMPLES};

/// Descents from random choices, in addition to those from the columns as they are and reversed.
const RANDOM_STARTS: usize = 48;

/// The assumed mistakes of one joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct JointChoice {
    reversed: bool,
    /// Of its home.
    quarter_turns: u8,
    /// How often the joint before is in its value.
    coupled: i8,
}

impl JointChoice {
    /// What may be wrong with each joint of a robot, nothing first.
    fn of_each(robot: &Robot) -> Vec<Vec<Self>> {
        let choices = |joint: usize| {
            let turns = robot.joints[joint].kind == JointKind::Revolute;
            // The home of the first joint is the frame.
            let homes = if joint > 0 && turns { 0..4 } else { 0..1 };
            let couplings: &[i8] = if is_parallel_to_the_one_before(robot, joint) {
                &[0, 1, -1]
            } else {
                &[0]
            };
            let of = |reversed: bool, quarter_turns: u8| {
                couplings.iter().map(move |&coupled| Self {
                    reversed,
                    quarter_turns,
                    coupled,
                })
            };
            let of = homes
                .flat_map(|home| [(false, home), (true, home)])
                .flat_map(|c| of(c.0, c.1));
            of.collect()
        };
        (0..robot.joints.len()).map(choices).collect()
    }

    fn mistakes(self) -> usize {
        usize::from(self.reversed)
            + usize::from(self.quarter_turns != 0)
            + usize::from(self.coupled != 0)
    }
}

/// The assumed mistakes of a session.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Choice {
    joints: Vec<JointChoice>,
    /// Of each joint.
    columns: Vec<usize>,
    mirrored: bool,
}

impl Choice {
    fn mistakes(&self) -> usize {
        let joints: usize = self.joints.iter().map(|joint| joint.mistakes()).sum();
        joints + self.exchanges().len() + usize::from(self.mirrored)
    }

    /// Joints that are exchanged, two at a time, so that each has its own column.
    fn exchanges(&self) -> Vec<(usize, usize)> {
        let mut here: Vec<usize> = (0..self.columns.len()).collect();
        let mut all = Vec::new();
        for (joint, column) in self.columns.iter().enumerate() {
            let at = here.iter().position(|own| own == column);
            if let Some(at) = at.filter(|at| *at != joint) {
                here.swap(joint, at);
                all.push((joint, at));
            }
        }
        all
    }

    /// The changes of the samples that take it back, in the order in which they are made.
    fn changes(&self, session: &Session) -> Vec<Change> {
        let pairs = self.exchanges().into_iter();
        let mut all: Vec<Change> = pairs
            .map(|(first, second)| exchange(first, second))
            .collect();
        // Values are taken apart before any of them is turned.
        let joints = || self.joints.iter().enumerate();
        for (joint, choice) in joints().rev().filter(|(_, choice)| choice.coupled != 0) {
            let factor = f64::from(choice.coupled);
            all.push(parallelogram(&session.robot, joint, factor));
        }
        for (joint, choice) in joints() {
            all.extend(choice.reversed.then(|| sign(joint)));
            let turn = [0.0, 90.0, 180.0, -90.0][usize::from(choice.quarter_turns)];
            all.extend((turn != 0.0).then(|| home(joint, turn)));
        }
        all.extend(self.mirrored.then(|| axes_exchanged(session)));
        all
    }
}

/// The nominal robot and the samples of a session.
struct Judge<'a> {
    nominal: Nominal<'a>,
    choices: Vec<Vec<JointChoice>>,
    kinds: Vec<JointKind>,
}

impl Judge<'_> {
    /// RMS residual of a choice, mm, without the samples that are farthest off.
    fn residual_mm(&self, choice: &Choice) -> f64 {
        let mut inputs = self.nominal.inputs.clone();
        let raw = |joint: usize| &self.nominal.inputs.q[choice.columns[joint]];
        for (joint, own) in choice.joints.iter().enumerate() {
            let factor = if own.reversed { -1.0 } else { 1.0 };
            let turn = f64::from(own.quarter_turns) * FRAC_PI_2;
            let share = f64::from(own.coupled);
            let before = raw(joint.saturating_sub(1)).iter();
            let values = raw(joint).iter().zip(before);
            let values = values.map(|(q, before)| factor * (q + share * before) + turn);
            inputs.q[joint] = Cow::Owned(values.collect());
        }
        self.nominal.residual_mm(&inputs, choice.mirrored)
    }

    /// What is chosen with every choice of these joints.
    fn every(&self, start: &Choice, joints: &[usize]) -> Vec<Choice> {
        let mut all = vec![start.clone()];
        for &joint in joints {
            let each = |choice: &Choice| {
                let of = choice.clone();
                self.choices[joint].iter().map(move |own| {
                    let mut choice = of.clone();
                    choice.joints[joint] = *own;
                    choice
                })
            };
            all = all.iter().flat_map(each).collect();
        }
        all
    }

    /// What is chosen with the columns of two joints exchanged, either way round.
    fn exchanged(&self, start: &Choice, first: usize, second: usize) -> Vec<Choice> {
        if self.kinds[first] != self.kinds[second] {
            return Vec::new();
        }
        let mut swapped = start.clone();
        swapped.columns.swap(first, second);
        let signs = [(false, false), (true, false), (false, true), (true, true)];
        let with = |(of_first, of_second)| {
            let mut choice = swapped.clone();
            choice.joints[first].reversed ^= of_first;
            choice.joints[second].reversed ^= of_second;
            choice
        };
        signs.map(with).into()
    }

    /// The choice in which no two joints can be changed for the better.
    fn descended(&self, start: Choice) -> (Choice, f64) {
        let n = start.joints.len();
        let mut best = (self.residual_mm(&start), start);
        loop {
            let before = best.0;
            for first in 0..n {
                for second in first + 1..n {
                    let mut tried = self.every(&best.1, &[first, second]);
                    tried.extend(self.exchanged(&best.1, first, second));
                    for choice in tried {
                        let residual_mm = self.residual_mm(&choice);
                        if residual_mm < best.0 {
                            best = (residual_mm, choice);
                        }
                    }
                }
            }
            // Steps that gain next to nothing lead nowhere.
            if best.0 * EQUAL >= before {
                return (best.1, best.0);
            }
        }
    }

    /// The same with as few mistakes as explain the samples as well: a wrist's middle joint that counts the other
    /// way round is both neighbours' homes by 180°.
    fn simplest(&self, choice: Choice, residual_mm: f64) -> Choice {
        let n = choice.joints.len();
        let mut now = choice;
        for first in 0..n.saturating_sub(2) {
            for other in self.every(&now, &[first, first + 1, first + 2]) {
                if other.mistakes() < now.mistakes()
                    && self.residual_mm(&other) <= EQUAL * residual_mm
                {
                    now = other;
                }
            }
        }
        now
    }
}

/// The changes of an arm's samples that together explain them; none where no choice has a residual below `most_mm`.
pub(super) fn several(part: &Session, values: JointValues, most_mm: f64) -> Vec<Change> {
    let few = thinned(part, FEW_SAMPLES);
    let judge = Judge {
        nominal: Nominal::of(&few, values),
        choices: JointChoice::of_each(&few.robot),
        kinds: few.robot.joints.iter().map(|joint| joint.kind).collect(),
    };
    let n = judge.kinds.len();
    let plain = vec![JointChoice::default(); n];
    let mut orders: Vec<Vec<usize>> = vec![(0..n).collect()];
    if judge.kinds.iter().eq(judge.kinds.iter().rev()) {
        orders.push((0..n).rev().collect());
    }
    let with = |columns: &Vec<usize>, mirrored: bool| Choice {
        joints: plain.clone(),
        columns: columns.clone(),
        mirrored,
    };
    let of_order = |columns| [with(columns, false), with(columns, true)];
    let mut starts: Vec<Choice> = orders.iter().flat_map(of_order).collect();
    let mut chance: u32 = 1;
    for k in 0..RANDOM_STARTS {
        let mut start = with(&orders[k % orders.len()], k / 2 % 2 == 1);
        for (own, choices) in start.joints.iter_mut().zip(&judge.choices) {
            // The constants of Numerical Recipes' generator.
            chance = chance.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *own = choices[(chance >> 16) as usize % choices.len()];
        }
        starts.push(start);
    }
    for start in starts {
        let (choice, residual_mm) = judge.descended(start);
        if residual_mm < most_mm {
            return judge.simplest(choice, residual_mm).changes(part);
        }
    }
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_get_to_their_joints_two_at_a_time() {
        for columns in [
            vec![0, 1, 2],
            vec![2, 1, 0],
            vec![1, 2, 0],
            vec![3, 2, 0, 1, 4],
        ] {
            let mut here: Vec<usize> = (0..columns.len()).collect();
            let choice = Choice {
                joints: vec![JointChoice::default(); columns.len()],
                columns,
                mirrored: false,
            };
            for (first, second) in choice.exchanges() {
                here.swap(first, second);
            }
            assert_eq!(here, choice.columns);
        }
    }
}
