//! The noise floor: the smallest RMS error that noise allows, from returns to the same pose, else from the
//! instrument's maker, else from the residuals of the final model.

use std::collections::BTreeSet;

use crate::effects::Inputs;
use crate::fewest;
use crate::sessions::Sigma;
use crate::sessions::poses::ByPose;
use crate::thresholds::{GROSS_SHARE, size_mm};

use super::prepare::PreparedSearch;
use crate::answers::diagnosis::{Floor, FloorFrom};
use crate::diagnosis::evidence::{Fit, Regression};

/// From returns to the same pose, else the instrument, else the residuals of the final fit; never below the rounding
/// to the digit of the coordinates.
pub(crate) fn floor(prepared: &PreparedSearch, fit: &Fit) -> Floor {
    let rows = &prepared.regression.rows;
    let squares = rows
        .axes
        .iter()
        .filter_map(|axis| rows.digits_mm.get(*axis));
    let digits_mm = squares.map(|mm| mm * mm).sum::<f64>().sqrt();
    let floor = as_shown(prepared, fit);
    Floor {
        mm: floor.mm.max(digits_mm),
        ..floor
    }
}

fn as_shown(prepared: &PreparedSearch, fit: &Fit) -> Floor {
    let regression = &prepared.regression;
    if let Some(noise_mm) = regression.rows.noise_mm(&regression.noise) {
        return of_observations(prepared, fit, noise_mm);
    }
    if let Some(mm) = pure_error(prepared).and_then(|pure| pure.mm) {
        return Floor {
            mm,
            from: FloorFrom::Repeats,
        };
    }
    match prepared.problem.session.instrument.sigma_mm {
        Some(Sigma::Overall(sigma)) => Floor {
            mm: sigma * (regression.rows.axes.len() as f64).sqrt(),
            from: FloorFrom::Instrument,
        },
        Some(Sigma::PerAxis(sigma)) => Floor {
            mm: regression
                .rows
                .axes
                .iter()
                .map(|a| sigma[*a].powi(2))
                .sum::<f64>()
                .sqrt(),
            from: FloorFrom::Instrument,
        },
        None => Floor {
            mm: estimated_mm(regression) * regression.scale(fit),
            from: FloorFrom::Estimated,
        },
    }
}

/// Root mean square length of all layers of the noise, mm.
fn estimated_mm(regression: &Regression) -> f64 {
    let (rows, noise) = (&regression.rows, &regression.noise);
    let of_rows = noise.total_mm(&rows.axes) * (rows.axes.len() as f64).sqrt();
    match rows.unrepeated_mm(noise) {
        Some(robot_mm) => of_rows.hypot(robot_mm),
        None => of_rows,
    }
}

/// The same where other things than plain points were measured; `noise_mm` is that of the regression.
fn of_observations(prepared: &PreparedSearch, fit: &Fit, noise_mm: f64) -> Floor {
    let regression = &prepared.regression;
    let stated = prepared.problem.observed.as_ref();
    let stated = stated.filter(|layer| layer.is_stated());
    match (pure_error(prepared), stated) {
        (Some(pure), _) => Floor {
            // In mm of lengths alone, where repeats show any.
            mm: pure.mm.unwrap_or(noise_mm * pure.variance.sqrt()),
            from: FloorFrom::Repeats,
        },
        (None, Some(layer)) => Floor {
            mm: noise_mm * layer.unit_mm / regression.noise.sigma_mm[0],
            from: FloorFrom::Instrument,
        },
        (None, None) => Floor {
            mm: noise_mm * regression.scale(fit),
            from: FloorFrom::Estimated,
        },
    }
}

/// The pure error: the noise as returns to the same pose show it.
pub(crate) struct PureError {
    /// Root mean square length, mm; `None` where no length was measured again.
    pub(crate) mm: Option<f64>,
    /// Mean square of a coordinate, in units of the white noise of its axis.
    pub(crate) variance: f64,
    /// Degrees of freedom of that, over all axes.
    pub(crate) freedom: f64,
}

/// Spread between samples of the same pose, side, target, speed and load, reached again after another pose. Two shots
/// in one pose show the noise of the instrument alone.
pub(crate) fn pure_error(prepared: &PreparedSearch) -> Option<PureError> {
    let rows = &prepared.regression.rows;
    let inputs = &rows.inputs;
    let key = |i: usize| {
        let mut key: Vec<u64> = inputs.q.iter().map(|q| q[i].to_bits()).collect();
        for columns in [&inputs.dir, &inputs.speed] {
            key.extend(columns.iter().flatten().map(|c| (c[i] + 0.0).to_bits()));
        }
        key.extend(inputs.load_kg.iter().map(|c| c[i].to_bits()));
        key.extend(inputs.target.iter().map(|t| u64::from(t[i])));
        key.extend(inputs.setup.iter().map(|s| s[i].to_bits()));
        key
    };
    let mut keys: Vec<Vec<u64>> = (0..rows.samples.len()).map(key).collect();
    if let Some(observed) = rows.observed() {
        for (key, reference) in keys.iter_mut().zip(observed.layer().references()) {
            key.push(reference as u64);
        }
    }
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by(|a, b| keys[*a].cmp(&keys[*b]).then(a.cmp(b)));
    let (raw, _) = rows.extract(&prepared.regression.base);
    let n = rows.samples.len();
    let sigma = prepared.regression.noise.sigma_mm;
    let (mut sum, mut weighted, mut freedom, mut all) = (0.0, 0.0, 0_usize, 0_usize);
    let mut of_lengths = 0_usize;
    let mut start = 0;
    while start < n {
        let end = (start..n)
            .find(|k| keys[order[*k]] != keys[order[start]])
            .unwrap_or(n);
        let group: Vec<usize> = (start..end)
            .filter(|k| *k == start || is_reached_again(inputs, order[*k - 1], order[*k]))
            .map(|k| order[k])
            .collect();
        if group.len() > 1 {
            freedom += group.len() - 1;
            let mut has_length = false;
            for axis in (0..rows.axes.len()).filter(|a| rows.has(a * n + group[0])) {
                all += group.len() - 1;
                let values = group.iter().map(|i| raw[axis * n + i]);
                let mean = values.clone().sum::<f64>() / group.len() as f64;
                let square = values.map(|v| (v - mean).powi(2)).sum::<f64>();
                // Angles measured with lengths count nothing.
                let mm = rows.mm(axis * n + group[0]);
                has_length |= mm > 0.0;
                sum += mm * mm * square;
                weighted += square / sigma[rows.axes[axis]].powi(2);
            }
            of_lengths += if has_length { group.len() - 1 } else { 0 };
        }
        start = end;
    }
    let all = all as f64;
    let mm = (of_lengths >= fewest::TO_JUDGE).then(|| (sum / of_lengths as f64).sqrt());
    // If they are farther apart they are no returns: the commands are not the robot's.
    let worst_mm = GROSS_SHARE * size_mm(prepared.problem.session);
    let are_returns = mm.is_none_or(|mm| mm <= worst_mm);
    let of_poses = returned_poses(inputs).map(|count| (rows.axes.len() * count) as f64);
    (freedom >= fewest::TO_JUDGE && are_returns).then(|| PureError {
        mm,
        variance: weighted / all,
        freedom: of_poses.map_or(all, |of_poses| all.min(of_poses)),
    })
}

/// Whether a sample was reached again after one before it: something else was measured in between, in another pose.
fn is_reached_again(inputs: &Inputs, before: usize, now: usize) -> bool {
    match &inputs.pose {
        Some(pose) => pose[before] != pose[now],
        None => now > before + 1,
    }
}

/// How often a pose was reached again, where several samples share one: all that is measured in it counts once.
fn returned_poses(inputs: &Inputs) -> Option<usize> {
    let pose = inputs.pose.as_deref()?;
    let commands = |i: usize| -> Vec<u64> { inputs.q.iter().map(|q| q[i].to_bits()).collect() };
    let first = ByPose::of(Some(pose), pose.len()).first;
    let different: BTreeSet<Vec<u64>> = first.iter().map(|i| commands(*i)).collect();
    Some(first.len() - different.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::fit::example::unrepeated;

    /// Two rounds of shots in each pose are no returns; the same poses once more, behind the others, are.
    #[test]
    fn shots_in_one_pose_tell_nothing_of_returns() {
        let once = unrepeated(2e-4, 1);
        let again = |rows: &[usize]| {
            let mut session = once.clone();
            let pick =
                |column: &mut Vec<f64>| *column = rows.iter().map(|row| column[*row]).collect();
            let samples = &mut session.samples;
            samples.q.iter_mut().for_each(pick);
            [&mut samples.x_mm, &mut samples.y_mm]
                .into_iter()
                .for_each(pick);
            samples.z_mm.iter_mut().for_each(pick);
            let target = samples.target.iter_mut();
            target.for_each(|t| *t = rows.iter().map(|row| t[*row]).collect());
            session
        };
        let shots: Vec<usize> = (0..20)
            .flat_map(|k| [0, 1, 2, 0, 1, 2].map(|t| 3 * k + t))
            .collect();
        let twice: Vec<usize> = (0..60).chain(0..60).collect();
        for (rows, returns) in [(shots, None), (twice, Some(60.0))] {
            let session = again(&rows);
            let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
            // Of three reflectors a return counts once.
            assert_eq!(pure_error(&prepared).map(|pure| pure.freedom), returns);
        }
    }
}
