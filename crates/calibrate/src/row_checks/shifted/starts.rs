//! Where the instrument stands, before the rows are known: from each quarter of the session with each
//! shift, by the best rigid motion of the nominal robot.

use nalgebra::{Isometry3, Vector3};

use crate::effects::Inputs;
use crate::fit::spread::places;
use crate::kinematics::rigid_motion::rigid_motion;
use crate::model::Model;
use crate::numeric::median;
use crate::sessions::Session;

use super::fitted::{LEAST_SIGMA_MM, MEDIAN_LENGTH};
use super::path::{MOST_SHIFT, Path, Points, along, cost_of_shifted};

/// Stretches that are tried.
const STRETCHES: usize = 4;
/// Fewer rows of a setup show no motion.
const FEWEST_ROWS: usize = 6;
/// Rows that a trial looks at; of a long session they are spread evenly.
const MOST_ROWS: usize = 2000;
/// What a robot that was never calibrated leaves, as a share of the size of the session.
const NOMINAL_SHARE: f64 = 0.002;
/// The rows are right where they leave less than this share of what the nearest shift leaves.
const CLEAR_SHARE: f64 = 0.3;

/// One way to see the session, and the likeliest path then.
pub(super) struct Start {
    pub(super) path: Path,
    pub(super) cost: f64,
    /// Whether no row is shifted, and that is beyond doubt.
    pub(super) rows_are_right: bool,
}

/// Every start; the first alone where it leaves no doubt.
pub(super) fn starts(session: &Session, inputs: &Inputs, points: &Points<'_>) -> Vec<Start> {
    let nominal = Nominal {
        robot: Model::nominal(session.robot.clone()),
        inputs,
    };
    let setups = Setups::of(session);
    let sigma = NOMINAL_SHARE * points.size_mm();
    let n = points.len();
    let rows: Vec<usize> = places(n, MOST_ROWS).collect();
    let nominal_places = nominal.places(&rows);
    let trial = |motions: &[Isometry3<f64>]| {
        let seen = |(row, place): (&usize, &Vector3<f64>)| {
            (motions[setups.of_row(*row)] * nalgebra::Point3::from(*place)).coords
        };
        let places: Vec<Vector3<f64>> = rows.iter().zip(&nominal_places).map(seen).collect();
        let at = |row: usize| rows.binary_search(&row).map_or(0, |k| k);
        let deviation = |row: usize, by: isize| {
            let point = points.get(row.checked_add_signed(by)?)?;
            Some((point - places[at(row)]).norm())
        };
        let likeliest = |sigma: f64| {
            along(rows.iter().copied(), n, |row, by| {
                cost_of_shifted(deviation(row, by), by, sigma)
            })
        };
        let (mut path, cost) = likeliest(sigma);
        let own = median(rows.iter().filter_map(|row| deviation(*row, 0)));
        let shifted = median(rows.iter().filter_map(|row| {
            let others = [-1, 1].into_iter().filter_map(|by| deviation(*row, by));
            others.reduce(f64::min)
        }));
        // Of the last rows alone a shift shows only beside what this robot leaves, not beside what any may leave.
        let left = own.unwrap_or(sigma) / MEDIAN_LENGTH;
        if path.is_none() && left < sigma {
            path = likeliest(left.max(LEAST_SIGMA_MM)).0;
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
    let still = vec![Isometry3::identity(); setups.count];
    let mut all: Vec<Start> = Vec::new();
    let whole = motions(&nominal, points, &setups, 0, 0..1, 1);
    for motions in [Some(still), whole].into_iter().flatten() {
        let start = trial(&motions);
        if start.rows_are_right {
            return vec![start];
        }
        all.push(start);
    }
    for stretch in 0..STRETCHES {
        for by in -MOST_SHIFT..=MOST_SHIFT {
            let part = stretch..stretch + 1;
            if let Some(motions) = motions(&nominal, points, &setups, by, part, STRETCHES) {
                all.push(trial(&motions));
            }
        }
    }
    all
}

/// Where the nominal robot is at the commands of rows; of a long session few are looked at.
struct Nominal<'i, 's> {
    robot: Model,
    inputs: &'i Inputs<'s>,
}

impl Nominal<'_, '_> {
    fn places(&self, rows: &[usize]) -> Vec<Vector3<f64>> {
        let places = self.robot.predict(&self.inputs.select(rows));
        (0..rows.len())
            .map(|k| Vector3::from(places.get(k)))
            .collect()
    }
}

/// The setup of every row.
struct Setups<'a> {
    index: Option<&'a [u32]>,
    /// The rows of each setup, where the session names any.
    rows: Vec<Vec<u32>>,
    count: usize,
}

impl<'a> Setups<'a> {
    fn of(session: &'a Session) -> Self {
        let setups = session.samples.setups.as_ref();
        let count = setups.map_or(1, |s| s.names.len().max(1));
        let mut rows = vec![Vec::new(); if setups.is_some() { count } else { 0 }];
        for (row, setup) in (0..).zip(setups.iter().flat_map(|s| &s.index)) {
            if let Some(own) = rows.get_mut(*setup as usize) {
                own.push(row);
            }
        }
        Self {
            index: setups.map(|s| &s.index[..]),
            rows,
            count,
        }
    }

    fn of_row(&self, row: usize) -> usize {
        self.index.map_or(0, |index| index[row] as usize)
    }

    /// How many rows a setup has, of so many in all.
    fn len(&self, setup: usize, rows: usize) -> usize {
        self.rows.get(setup).map_or(rows, Vec::len)
    }

    /// The k-th row of a setup.
    fn row(&self, setup: usize, k: usize) -> usize {
        self.rows.get(setup).map_or(k, |own| own[k] as usize)
    }
}

/// The motion of each setup that a stretch of its rows shows, which is one of so many, if its points are
/// shifted; `None` where one shows none.
fn motions(
    nominal: &Nominal,
    points: &Points<'_>,
    setups: &Setups,
    by: isize,
    part: std::ops::Range<usize>,
    of: usize,
) -> Option<Vec<Isometry3<f64>>> {
    let motion = |setup: usize| {
        let own = setups.len(setup, points.len());
        let (from, to) = (part.start * own / of, part.end * own / of);
        let (rows, measured): (Vec<usize>, Vec<Vector3<f64>>) = places(to - from, MOST_ROWS)
            .filter_map(|k| {
                let row = setups.row(setup, from + k);
                Some((row, points.get(row.checked_add_signed(by)?)?))
            })
            .unzip();
        let pairs: Vec<_> = nominal.places(&rows).into_iter().zip(measured).collect();
        (pairs.len() >= FEWEST_ROWS).then(|| rigid_motion(&pairs))?
    };
    (0..setups.count).map(motion).collect()
}
