//! Mistakes of setting up, as changes of the session that take them back.
//!
//! Each is mechanical: applied to the samples it makes them read as if the mistake had not been
//! made. The diagnosis tries them as hypotheses, and the window offers the one that it believed.

use super::{Samples, Session, Setups};

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
        let samples = &mut session.samples;
        match self {
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
