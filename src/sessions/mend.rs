//! Mistakes of setting up, as changes of the session that take them back.
//!
//! Each is mechanical: applied to the samples it makes them read as if the mistake had not been
//! made. The diagnosis tries them as hypotheses, and the window offers the one that it believed.

use super::{Samples, Session, Setups};
use crate::kinematics::JointKind;

/// What was done to samples in memory since they were read.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrected {
    /// The corrections, in the order in which they were made.
    pub by: Vec<Mend>,
    /// Hash of the samples as they are in the file.
    pub raw_hash: String,
}

/// A change that takes a mistake back.
#[derive(Debug, Clone, PartialEq)]
pub enum Mend {
    /// The values of a joint (counted from 0) times this: −1 for a sign, π/180 for a unit.
    ScaleJoint {
        /// The joint, counted from 0.
        joint: usize,
        /// What its values are multiplied by.
        factor: f64,
    },
    /// The values of every joint that turns times this: π/180 for a unit.
    ScaleJoints {
        /// What their values are multiplied by.
        factor: f64,
    },
    /// Two joints (counted from 0) change places.
    ExchangeJoints {
        /// One.
        first: usize,
        /// The other.
        second: usize,
    },
    /// The value of a joint (counted from 0) and so many times that of another: a parallelogram.
    CoupleJoint {
        /// The joint, counted from 0.
        joint: usize,
        /// The other one, counted from 0.
        from: usize,
        /// How much of it is added.
        factor: f64,
    },
    /// The values read back become the commanded ones.
    TakeReadBack,
    /// The commanded and read-back values of a joint and this.
    TurnHome {
        /// The joint, counted from 0.
        joint: usize,
        /// What is added, rad.
        by_rad: f64,
    },
    /// The measured coordinates times this.
    ScaleLengths(f64),
    /// The measured column that now stands at place `order[k]` becomes the k-th of x, y, z.
    Reorder([usize; 3]),
    /// The measuring frame is free: all samples in one setup.
    FreeFrame,
    /// Without these samples, counted from 0 in ascending order.
    Remove(Vec<usize>),
}

impl Mend {
    /// What it does, as a button says it.
    pub fn says(&self) -> String {
        match self {
            Self::ScaleJoint { joint, factor } if *factor < 0.0 => {
                format!("Reverse joint {}", joint + 1)
            }
            Self::ScaleJoint { joint, factor } if *factor < 1.0 => {
                format!("Read joint {} as degrees", joint + 1)
            }
            Self::ScaleJoint { joint, .. } => format!("Read joint {} as radians", joint + 1),
            Self::ScaleJoints { factor } if *factor < 1.0 => {
                "Read all joints as degrees".to_owned()
            }
            Self::ScaleJoints { .. } => "Read all joints as radians".to_owned(),
            Self::ExchangeJoints { first, second } => {
                format!("Exchange joints {} and {}", first + 1, second + 1)
            }
            Self::CoupleJoint {
                joint,
                from,
                factor,
            } if *factor < 0.0 => {
                format!("Subtract joint {} from joint {}", from + 1, joint + 1)
            }
            Self::CoupleJoint { joint, from, .. } => {
                format!("Add joint {} to joint {}", from + 1, joint + 1)
            }
            Self::TakeReadBack => "Start from the values read back".to_owned(),
            Self::TurnHome { joint, by_rad } => {
                format!(
                    "Turn the home of joint {} by {:.0}°",
                    joint + 1,
                    by_rad.to_degrees()
                )
            }
            Self::ScaleLengths(factor) => match *factor {
                1000.0 => "Read the coordinates as metres".to_owned(),
                25.4 => "Read the coordinates as inches".to_owned(),
                0.001 => "Read the coordinates as micrometres".to_owned(),
                factor => format!("Multiply the coordinates by {factor:.6}"),
            },
            Self::Reorder(order) => {
                let axis = |k: usize| ["x", "y", "z"][k % 3];
                let [a, b, c] = order.map(axis);
                if *order == [1, 0, 2] {
                    "Exchange x and y".to_owned()
                } else {
                    format!("Read x, y, z from {a}, {b}, {c}")
                }
            }
            Self::FreeFrame => "Fit the measuring frame".to_owned(),
            Self::Remove(rows) if rows.len() == 1 => "Remove this sample".to_owned(),
            Self::Remove(rows) => format!("Remove these {} samples", rows.len()),
        }
    }

    /// Changes the session. What the session does not have (a joint, a sample) is passed over.
    pub fn apply(&self, session: &mut Session) {
        let turning = |j: usize| {
            session
                .robot
                .joints
                .get(j)
                .is_some_and(|j| j.kind == JointKind::Revolute)
        };
        let turning: Vec<usize> = (0..session.samples.q.len())
            .filter(|j| turning(*j))
            .collect();
        let samples = &mut session.samples;
        match self {
            Self::ScaleJoints { factor } => {
                for joint in turning {
                    scale_joint(samples, joint, *factor);
                }
            }
            Self::ExchangeJoints { first, second } => exchange(samples, *first, *second),
            Self::CoupleJoint {
                joint,
                from,
                factor,
            } => couple(samples, *joint, *from, *factor),
            Self::TakeReadBack => {
                for (q, read) in samples.q.iter_mut().zip(&samples.q_read) {
                    if let Some(read) = read {
                        q.clone_from(read);
                    }
                }
            }
            Self::ScaleJoint { joint, factor } => scale_joint(samples, *joint, *factor),
            Self::TurnHome { joint, by_rad } => {
                let turn = |column: &mut Vec<f64>| column.iter_mut().for_each(|q| *q += by_rad);
                samples.q.get_mut(*joint).into_iter().for_each(turn);
                let read = samples.q_read.get_mut(*joint);
                read.into_iter().flatten().for_each(turn);
            }
            Self::ScaleLengths(factor) => {
                let columns = [&mut samples.x_mm, &mut samples.y_mm];
                for column in columns.into_iter().chain(samples.z_mm.as_mut()) {
                    for value in column.iter_mut() {
                        *value *= factor;
                    }
                }
            }
            Self::Reorder(order) => reorder(samples, *order),
            Self::FreeFrame => {
                samples.setups = Some(Setups {
                    names: vec!["1".to_owned()],
                    index: vec![0; samples.len()],
                });
            }
            Self::Remove(rows) => samples.remove(rows),
        }
    }
}

fn scale_joint(samples: &mut Samples, joint: usize, factor: f64) {
    if joint >= samples.q.len() {
        return;
    }
    let scale = |column: &mut Vec<f64>| column.iter_mut().for_each(|v| *v *= factor);
    scale(&mut samples.q[joint]);
    samples.q_read[joint].iter_mut().for_each(scale);
    samples.speed[joint].iter_mut().for_each(scale);
    if factor < 0.0 {
        let turn = |column: &mut Vec<f64>| column.iter_mut().for_each(|v| *v = -*v);
        samples.dir[joint].iter_mut().for_each(scale);
        let torque = samples.torque_nm.get_mut(joint);
        torque.into_iter().flatten().for_each(turn);
    }
}

fn exchange(samples: &mut Samples, first: usize, second: usize) {
    if first.max(second) < samples.q.len() {
        samples.q.swap(first, second);
        samples.q_read.swap(first, second);
        samples.dir.swap(first, second);
        samples.speed.swap(first, second);
    }
}

fn couple(samples: &mut Samples, joint: usize, from: usize, factor: f64) {
    if joint == from || joint.max(from) >= samples.q.len() {
        return;
    }
    let add = |to: &mut Vec<f64>, other: &[f64]| {
        for (value, other) in to.iter_mut().zip(other) {
            *value += factor * other;
        }
    };
    let other = samples.q[from].clone();
    add(&mut samples.q[joint], &other);
    for columns in [&mut samples.q_read, &mut samples.speed] {
        if let Some(other) = columns[from].clone()
            && let Some(own) = &mut columns[joint]
        {
            add(own, &other);
        }
    }
}

fn reorder(samples: &mut Samples, order: [usize; 3]) {
    let Some(z) = samples.z_mm.take() else {
        // Two columns can only be exchanged.
        if order == [1, 0, 2] {
            std::mem::swap(&mut samples.x_mm, &mut samples.y_mm);
        }
        return;
    };
    let old = [
        std::mem::take(&mut samples.x_mm),
        std::mem::take(&mut samples.y_mm),
        z,
    ];
    samples.x_mm.clone_from(&old[order[0] % 3]);
    samples.y_mm.clone_from(&old[order[1] % 3]);
    samples.z_mm = Some(old[order[2] % 3].clone());
}
