//! Returns to the same command that lead to places far from each other: the columns of the joints do not say where
//! the robot was (a log that stood still, a column that was copied down). Such returns tell nothing of noise.

use std::collections::BTreeMap;

use super::problem::without_correction;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::Session;
use crate::text::length;

/// No robot that can be calibrated repeats worse than this share of its reach.
pub(crate) const WORST_REPEATABILITY: f64 = 0.01;
/// So many returns are no accident, and as large a share of the samples.
const FEWEST: usize = 8;
const LEAST_SHARE: f64 = 0.25;

pub(super) fn far_apart(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let samples = &session.samples;
    let mut groups: BTreeMap<Vec<u64>, Vec<usize>> = BTreeMap::new();
    for i in (0..samples.len()).filter(|i| samples.x_mm[*i].is_finite()) {
        groups
            .entry(command(session, values, i))
            .or_default()
            .push(i);
    }
    let mut distances: Vec<f64> = groups
        .values()
        .filter(|group| group.len() > 1)
        .flat_map(|group| from_the_middle(session, group))
        .collect();
    let returns = distances.len();
    if returns < FEWEST || (returns as f64) < LEAST_SHARE * samples.len() as f64 {
        return Vec::new();
    }
    distances.sort_by(f64::total_cmp);
    let median_mm = distances[returns / 2];
    if median_mm <= WORST_REPEATABILITY * session.robot.reach_mm() {
        return Vec::new();
    }
    vec![without_correction(
        text!("returns: the same command led to places that are far apart"),
        text!(
            "{returns} samples repeat a command and are {median} from the middle of their returns (median)",
            returns = returns,
            median = length(median_mm, 3)
        ),
        text!(
            "no robot repeats as badly: check that the columns of the joints changed while the robot moved"
        ),
    )]
}

/// What was told to the robot at a sample.
fn command(session: &Session, values: JointValues, i: usize) -> Vec<u64> {
    let samples = &session.samples;
    let q = samples.q.iter().zip(&samples.q_read);
    let q = q.map(|(own, read)| match (values, read) {
        (JointValues::Read, Some(read)) => read[i],
        _ => own[i],
    });
    let mut key: Vec<u64> = q.map(f64::to_bits).collect();
    let columns = [&samples.dir, &samples.speed].into_iter().flatten();
    key.extend(columns.flatten().map(|c| (c[i] + 0.0).to_bits()));
    key.extend(samples.load_kg.iter().map(|c| c[i].to_bits()));
    key.extend(samples.target.iter().map(|c| u64::from(c[i])));
    key.extend(samples.setups.iter().map(|s| u64::from(s.index[i])));
    key
}

/// Distances of samples from their middle, coordinate by coordinate, mm.
fn from_the_middle(session: &Session, group: &[usize]) -> Vec<f64> {
    let samples = &session.samples;
    let columns = [
        Some(&samples.x_mm),
        Some(&samples.y_mm),
        samples.z_mm.as_ref(),
    ];
    let mut squares = vec![0.0; group.len()];
    for column in columns.into_iter().flatten() {
        let mut own: Vec<f64> = group.iter().map(|i| column[*i]).collect();
        own.sort_by(f64::total_cmp);
        let middle = own[own.len() / 2];
        for (square, i) in squares.iter_mut().zip(group) {
            *square += (column[*i] - middle).powi(2);
        }
    }
    let distances = squares.into_iter().map(f64::sqrt);
    distances.filter(|mm| mm.is_finite()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row_checks::tests::axis;

    #[test]
    fn a_command_column_that_stood_still_is_said() {
        let mut session = axis(60);
        assert!(far_apart(&session, JointValues::Commanded).is_empty());
        session.samples.q[0].fill(0.3);
        session.samples.dir[0]
            .iter_mut()
            .for_each(|dir| dir.fill(1.0));
        assert_eq!(far_apart(&session, JointValues::Commanded).len(), 1);
    }

    #[test]
    fn returns_as_close_as_a_robot_repeats_are_none_of_that() {
        let mut session = axis(60);
        let half = session.samples.len() / 2;
        let rows: Vec<Option<usize>> = (0..half).chain(0..half).map(Some).collect();
        session.samples.select(&rows);
        session.samples.x_mm[half..]
            .iter_mut()
            .for_each(|x| *x += 0.3);
        assert!(far_apart(&session, JointValues::Commanded).is_empty());
    }
}
