//! The place of the instrument before the rows are known: from each quarter of the session with each shift, by the
//! best rigid motion of the nominal robot.

use nalgebra::{Isometry3, Vector3};

use crate::effects::Inputs;
use crate::fit::spread::places;
use crate::kinematics::rigid_motion::rigid_motion;
use crate::model::Model;
use crate::numeric::median;
use crate::sessions::{Group, Session};
use crate::set_up_errors::nearest::{LEAST_SIGMA_MM, moved};

use super::path::{MEDIAN_LENGTH, MOST_SHIFT, Path, Points, along, cost_of_shifted};

/// Stretches that are tried.
const STRETCHES: usize = 4;
/// Fewer rows of a setup show no motion.
const FEWEST_ROWS: usize = 6;
/// Rows that a trial looks at; of a long session they are spread evenly.
const MOST_ROWS: usize = 2000;
/// The residual of a robot that was never calibrated, as a share of the size of the session.
const NOMINAL_SHARE: f64 = 0.002;
/// The rows are right where their residual is less than this share of that of the nearest shift.
const CLEAR_SHARE: f64 = 0.3;

/// One way to see the session, and the likeliest path then.
pub(super) struct Start {
    pub(super) path: Path,
    pub(super) cost: f64,
    /// Whether clearly no row is shifted.
    pub(super) rows_are_right: bool,
}

/// Every start; the first alone where it is clear.
pub(super) fn starts(session: &Session, inputs: &Inputs, points: &Points<'_>) -> Vec<Start> {
    let robot = Model::nominal(session.robot.clone());
    // Of a long session few rows are looked at.
    let nominal = |rows: &[usize]| -> Vec<Vector3<f64>> {
        let at = robot.predict(&inputs.select(rows));
        (0..rows.len()).map(|k| Vector3::from(at.get(k))).collect()
    };
    let sigma = NOMINAL_SHARE * points.size_mm();
    let n = points.len();
    let setup = |row: usize| Group::Setup.of(session, row).unwrap_or(0);
    let mut of_setups = vec![Vec::new(); Group::Setup.count(session).max(1)];
    (0..n).for_each(|row| of_setups[setup(row)].push(row));
    // The motion of each setup that a stretch of its rows shows, which is one of so many, if its points are shifted;
    // `None` where one shows none.
    let motions = |by: isize, part: usize, of: usize| -> Option<Vec<Isometry3<f64>>> {
        let motion = |own: &Vec<usize>| {
            let (from, to) = (part * own.len() / of, (part + 1) * own.len() / of);
            let pairs = places(to - from, MOST_ROWS).filter_map(|k| {
                let row = own[from + k];
                Some((row, points.get(row.checked_add_signed(by)?)?))
            });
            let (rows, measured): (Vec<usize>, Vec<Vector3<f64>>) = pairs.unzip();
            let pairs: Vec<_> = nominal(&rows).into_iter().zip(measured).collect();
            (pairs.len() >= FEWEST_ROWS).then(|| rigid_motion(&pairs))?
        };
        of_setups.iter().map(motion).collect()
    };
    let rows: Vec<usize> = places(n, MOST_ROWS).collect();
    let nominal_places = nominal(&rows);
    let trial = |motions: &[Isometry3<f64>]| {
        let seen = rows.iter().zip(&nominal_places);
        let places: Vec<Vector3<f64>> = seen
            .map(|(row, place)| moved(&motions[setup(*row)], place))
            .collect();
        let deviation = |k: usize, by: isize| {
            let point = points.get(rows[k].checked_add_signed(by)?)?;
            Some((point - places[k]).norm())
        };
        let likeliest = |sigma: f64| {
            along(rows.iter().copied(), n, |row, by| {
                let k = rows.binary_search(&row).unwrap_or(0);
                cost_of_shifted(deviation(k, by), by, sigma)
            })
        };
        let (mut path, cost) = likeliest(sigma);
        let own = median((0..rows.len()).filter_map(|k| deviation(k, 0)));
        let shifted = median((0..rows.len()).filter_map(|k| {
            let others = [-1, 1].into_iter().filter_map(|by| deviation(k, by));
            others.reduce(f64::min)
        }));
        // A shift of the last rows alone is only visible compared with the residuals of this robot, not with those of
        // any.
        let own_mm = own.unwrap_or(sigma) / MEDIAN_LENGTH;
        if path.is_none() && own_mm < sigma {
            path = likeliest(own_mm.max(LEAST_SIGMA_MM)).0;
        }
        let clear = own
            .zip(shifted)
            .is_some_and(|(own, other)| own < CLEAR_SHARE * other);
        Start {
            rows_are_right: path.is_none() && clear,
            path,
            cost,
        }
    };
    let still = vec![Isometry3::identity(); of_setups.len()];
    let mut all: Vec<Start> = Vec::new();
    for motions in [Some(still), motions(0, 0, 1)].into_iter().flatten() {
        let start = trial(&motions);
        if start.rows_are_right {
            return vec![start];
        }
        all.push(start);
    }
    for part in 0..STRETCHES {
        let shifts = -MOST_SHIFT..=MOST_SHIFT;
        all.extend(shifts.filter_map(|by| Some(trial(&motions(by, part, STRETCHES)?))));
    }
    all
}
