//! Returns to the same command that lead to places far from each other: the columns of the joints are not those of the
//! robot (a log that stood still, a column that was copied down). Such returns have no information on the noise.

use std::collections::BTreeMap;

use super::rows::listed;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fewest;
use crate::observations::outliers::MOST_SHARE;
use crate::sessions::Session;
use crate::text::length;
use crate::thresholds::{GROSS_SHARE, size_mm};

/// So many returns are no accident, and as large a share of the samples.
const LEAST_SHARE: f64 = 0.25;
/// No frame, target or load moves a point by this share of the reach: the command was another.
const ELSEWHERE: f64 = 0.1;

/// Samples that repeat a command, each with its distance from the middle of its returns, mm.
struct Return {
    sample: usize,
    from_middle_mm: f64,
    /// Whether most of the returns are elsewhere, or none agrees with another.
    is_contradicted: bool,
}

pub(super) fn far_apart(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let mut returns = returns(session, values);
    let mut contradicted: Vec<usize> = returns
        .iter()
        .filter(|one| one.is_contradicted)
        .map(|one| one.sample)
        .collect();
    let what = text!("returns: the same command led to places that are far apart");
    let samples = session.samples.len() as f64;
    if !contradicted.is_empty() && contradicted.len() as f64 <= MOST_SHARE * samples {
        contradicted.sort_unstable();
        return vec![DataProblem::of_rows(
            what,
            text!(
                one "{count} sample is far from others at the same command: {rows}",
                "{count} samples are far from others at the same command: {rows}",
                count = contradicted.len(),
                rows = listed(&contradicted)
            ),
            text!(
                "leave these samples out: no robot repeats as badly, and a joint value may be missing"
            ),
            contradicted,
        )];
    }
    if returns.len() < fewest::TO_JUDGE || (returns.len() as f64) < LEAST_SHARE * samples {
        return Vec::new();
    }
    returns.sort_by(|a, b| a.from_middle_mm.total_cmp(&b.from_middle_mm));
    let median_mm = returns[returns.len() / 2].from_middle_mm;
    if median_mm <= GROSS_SHARE * size_mm(session) {
        return Vec::new();
    }
    vec![DataProblem::of_all(
        what,
        text!(
            "{returns} samples repeat a command and are {median} from the middle of their returns (median)",
            returns = returns.len(),
            median = length(median_mm, 3)
        ),
        text!(
            "no robot repeats as badly: check that the columns of the joints changed while the robot moved"
        ),
        None,
    )]
}

/// Every sample whose command is repeated.
fn returns(session: &Session, values: JointValues) -> Vec<Return> {
    let samples = &session.samples;
    let mut groups: BTreeMap<Vec<u64>, Vec<usize>> = BTreeMap::new();
    let z = samples.z_mm.as_ref();
    let is_measured = |i: usize| {
        let coordinates = [Some(&samples.x_mm), Some(&samples.y_mm), z];
        let mut coordinates = coordinates.into_iter().flatten();
        coordinates.all(|column| column[i].is_finite()) && !samples.is_excluded(i)
    };
    for i in (0..samples.len()).filter(|i| is_measured(*i)) {
        groups
            .entry(command(session, values, i))
            .or_default()
            .push(i);
    }
    let elsewhere_mm = ELSEWHERE * size_mm(session);
    let groups = groups.into_values().filter(|group| group.len() > 1);
    let returns = groups.flat_map(|group| {
        let from_middle = from_the_middle(session, &group);
        let far = from_middle.iter().filter(|mm| **mm > elsewhere_mm).count();
        // Most of them show where the command leads; without a majority none does.
        let none_agree = far > 0 && 2 * far >= group.len();
        let one = move |(sample, from_middle_mm): (usize, f64)| Return {
            sample,
            from_middle_mm,
            is_contradicted: none_agree || from_middle_mm > elsewhere_mm,
        };
        group
            .into_iter()
            .zip(from_middle)
            .map(one)
            .collect::<Vec<_>>()
    });
    returns.collect()
}

/// The command of the robot at a sample.
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
    squares.into_iter().map(f64::sqrt).collect()
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
    fn samples_that_lost_their_joint_value_are_left_out() {
        let mut session = axis(60);
        for row in [4, 17, 40] {
            session.samples.q[0][row] = 0.0;
            session.samples.dir[0].as_mut().unwrap()[row] = 1.0;
            session.samples.target.as_mut().unwrap()[row] = 0;
        }
        let problems = far_apart(&session, JointValues::Commanded);
        assert_eq!(problems.len(), 1);
        assert_eq!(problems[0].samples, [4, 17, 40]);
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
