//! Rows that were copied: a file pasted below itself, blocks, single rows. They are no returns to a pose and have no
//! information on the noise, so they are left out.
//!
//! A return to the same pose may read the same to the last digit where the digit is coarse: along one
//! axis with the chance
//!
//! ```text
//! p = d / (2 √π σ)
//! ```
//!
//! of two readings with noise σ and digit d. What agrees in all rows of a run is a copy where that is improbable by
//! chance in any session of so many rows.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::resolution::resolution_mm;
use crate::sessions::{Samples, Session, Sigma};
use crate::{odds, rounding};

use super::rows::listed;

/// Noise of a coordinate where nothing is stated, mm: rather too small, so that chance is not
/// underrated.
const LEAST_NOISE_MM: f64 = 0.005;

pub(super) fn copied(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let samples = &session.samples;
    let twins = exact_copies(samples);
    if twins.is_empty() {
        return Vec::new();
    }
    let per_row = -chance(session).ln();
    let least = odds::CLEAR.nats() + 2.0 * (samples.len() as f64).ln();
    let mut copies = Vec::new();
    let mut origins = Vec::new();
    for run in runs(&twins) {
        if per_row * run.len() as f64 > least {
            copies.extend(run.iter().map(|twin| twin.row));
            origins.extend(run.iter().map(|twin| twin.of));
        }
    }
    if copies.is_empty() {
        return Vec::new();
    }
    copies.sort_unstable();
    origins.sort_unstable();
    origins.dedup();
    let evidence = match copies.len() {
        1 => text!(
            "the row agrees with an earlier one in every recorded value to the last digit; that it is a copy is more than 1000 times likelier than chance"
        ),
        count => text!(
            "{count} rows agree with an earlier one in every recorded value to the last digit; that they are copies is more than 1000 times likelier than chance",
            count
        ),
    };
    vec![DataProblem::of_rows(
        text!(
            "copied rows: {copies} of {originals}",
            copies = listed(&copies),
            originals = listed(&origins)
        ),
        evidence,
        text!(
            "copies are excluded: they are not returns to a pose and carry no information about the noise; remove them from the file"
        ),
        copies,
    )]
}

/// A row that agrees with an earlier one in everything.
struct RowCopy {
    row: usize,
    of: usize,
}

/// Rows that agree with an earlier one, each with the last such, in the order of the file.
fn exact_copies(samples: &Samples) -> Vec<RowCopy> {
    let n = samples.len();
    let mut prints: Vec<(u64, usize)> = Vec::with_capacity(n);
    prints.extend(
        (0..n)
            .filter(|row| is_measured(samples, *row) && !samples.is_excluded(*row))
            .map(|row| (print_of(samples, row), row)),
    );
    prints.sort_unstable();
    let same = |a: usize, b: usize| {
        let (mut of_a, mut of_b) = (Vec::new(), Vec::new());
        each_bit(samples, a, &mut |bits| of_a.push(bits));
        each_bit(samples, b, &mut |bits| of_b.push(bits));
        of_a == of_b
    };
    let pairs = prints.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let pairs = pairs.map(|pair| (pair[0].1, pair[1].1));
    let mut twins: Vec<RowCopy> = pairs
        .filter(|(of, row)| same(*of, *row))
        .map(|(of, row)| RowCopy { row, of })
        .collect();
    twins.sort_unstable_by_key(|twin| twin.row);
    twins
}

/// Twins at the same distance, one row after the other.
fn runs(twins: &[RowCopy]) -> Vec<&[RowCopy]> {
    twins
        .chunk_by(|a, b| b.row == a.row + 1 && b.of == a.of + 1)
        .collect()
}

fn is_measured(samples: &Samples, row: usize) -> bool {
    let point = samples.coordinates(row);
    let seen = point.iter().any(|v| v.is_finite() && *v != 0.0);
    seen || samples.observed.has(row) || samples.is_turned(row)
}

/// Whether a column has few different values for so many rows.
fn recurs(column: &[f64]) -> bool {
    let mut bits: Vec<u64> = column.iter().map(|v| v.to_bits()).collect();
    bits.sort_unstable();
    bits.dedup();
    4 * bits.len() < column.len()
}

/// The chance that a return to the same pose reads the same along all axes.
fn chance(session: &Session) -> f64 {
    let samples = &session.samples;
    let noise = |axis: usize| match session.instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => sigma,
        Some(Sigma::PerAxis(sigma)) => sigma[axis],
        None => LEAST_NOISE_MM,
    };
    let columns = [
        Some(&samples.x_mm),
        Some(&samples.y_mm),
        samples.z_mm.as_ref(),
    ];
    let own = columns.iter().enumerate().map(|(axis, column)| {
        let Some(column) = column.filter(|c| c.iter().any(|v| v.is_finite())) else {
            return 1.0;
        };
        // Of few different values the digit cannot be determined: that they recur is no evidence.
        let digit = resolution_mm(column).unwrap_or_else(|| {
            if recurs(column) {
                f64::INFINITY
            } else {
                rounding::COMPUTED
            }
        });
        let width = 2.0 * std::f64::consts::PI.sqrt() * noise(axis).max(f64::EPSILON);
        (digit / width).min(1.0)
    });
    let clock = samples
        .time_s
        .as_deref()
        .is_some_and(|t| t.iter().any(|v| *v != t[0]));
    own.product::<f64>() * if clock { odds::CLEAR.chance() } else { 1.0 }
}

/// Everything that a row records, bit by bit.
fn each_bit(samples: &Samples, row: usize, take: &mut impl FnMut(u64)) {
    let mut number = |value: f64| take((value + 0.0).to_bits());
    samples.q.iter().for_each(|q| number(q[row]));
    for columns in [
        &samples.q_read,
        &samples.dir,
        &samples.speed,
        &samples.torque_nm,
        &samples.joint_temperature_c,
    ] {
        columns
            .iter()
            .flatten()
            .for_each(|column| number(column[row]));
    }
    number(samples.x_mm[row]);
    number(samples.y_mm[row]);
    let observed = &samples.observed;
    for column in [
        &samples.z_mm,
        &samples.load_kg,
        &samples.temperature_c,
        &samples.time_s,
    ]
    .into_iter()
    .chain(observed.numbers().map(|column| column.values))
    .flatten()
    {
        number(column[row]);
    }
    let turned = samples.orientation_wxyz.iter().flatten();
    turned.for_each(|part| number(part[row]));
    for column in observed.names() {
        let place = column.values.as_ref().and_then(|column| column[row]);
        take(place.map_or(u64::MAX, u64::from));
    }
    samples.target.iter().for_each(|t| take(u64::from(t[row])));
    samples
        .setups
        .iter()
        .for_each(|s| take(u64::from(s.index[row])));
    samples
        .held_out
        .iter()
        .for_each(|held| take(u64::from(held[row])));
}

/// A number that equal rows share (Fowler, Noll & Vo's sum over words, mixed at the end).
fn print_of(samples: &Samples, row: usize) -> u64 {
    let mut sum = 0xcbf2_9ce4_8422_2325_u64;
    each_bit(samples, row, &mut |bits| {
        sum = (sum ^ bits).wrapping_mul(0x0000_0100_0000_01b3);
        sum ^= sum >> 29;
    });
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row_checks::tests::axis;

    fn found(session: &Session) -> Vec<DataProblem> {
        copied(session, JointValues::Commanded)
    }

    #[test]
    fn a_file_pasted_below_itself_is_said_and_left_out() {
        let mut session = axis(80);
        assert!(found(&session).is_empty());
        let twice: Vec<Option<usize>> = (0..80).chain(0..80).map(Some).collect();
        session.samples.select(&twice);
        let problems = found(&session);
        assert_eq!(problems.len(), 1);
        assert!(problems[0].what.contains("copied rows"), "{problems:?}");
        assert_eq!(problems[0].samples, (80..160).collect::<Vec<_>>());
        let checked = crate::row_checks::check(&session, JointValues::Commanded);
        assert_eq!(checked.session.samples.len(), 160);
        assert_eq!(
            checked.session.samples.excluded_by_hand(),
            problems[0].samples
        );
        // The corrected session has no finding.
        assert!(found(&checked.session).is_empty());
    }

    #[test]
    fn a_single_row_with_its_time_is_a_copy() {
        let mut session = axis(80);
        let row = |k| Some(k);
        let rows: Vec<Option<usize>> = (0..40).chain([39]).chain(40..80).map(row).collect();
        session.samples.select(&rows);
        assert_eq!(found(&session)[0].samples, vec![40]);
    }

    #[test]
    fn returns_that_read_the_same_by_their_coarse_digit_are_no_copies() {
        let mut session = axis(80);
        session.samples.time_s = None;
        session.instrument.sigma_mm = Some(Sigma::Overall(0.02));
        let returns: Vec<Option<usize>> = (0..40).chain((0..40).rev()).map(Some).collect();
        session.samples.select(&returns);
        let samples = &mut session.samples;
        for column in [&mut samples.x_mm, &mut samples.y_mm] {
            for v in column.iter_mut() {
                *v = v.round();
            }
        }
        samples
            .z_mm
            .iter_mut()
            .flatten()
            .for_each(|v| *v = v.round());
        assert!(found(&session).is_empty());
    }
}
