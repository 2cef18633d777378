//! The mean of what was measured during a stop.

use crate::importers::columns::{Column, Columns};
use crate::importers::path::Stop;
use crate::numeric::median;
use crate::sessions::columns::{Quantity, Unit};
use nalgebra::Quaternion;

/// A point in a stop that is this many median deviations from the median strays.
const STRAY: f64 = 6.0;

/// Measurements that are averaged.
pub(crate) struct Group {
    pub(crate) stop: Stop,
    /// Rows of the measurements; never empty.
    pub(crate) rows: Vec<usize>,
}

/// The rows without those that stray.
pub(crate) fn without_strays(rows: Vec<usize>, coordinates: &[&Vec<f64>]) -> Vec<usize> {
    if rows.len() < 4 {
        return rows;
    }
    let of = |values: &Vec<f64>| median(rows.iter().map(|&row| values[row])).unwrap_or(0.0);
    let middle: Vec<f64> = coordinates.iter().map(|values| of(values)).collect();
    let distance = |row: usize| {
        let parts = coordinates.iter().zip(&middle);
        parts
            .map(|(values, middle)| (values[row] - middle).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    let usual = median(rows.iter().map(|&row| distance(row))).unwrap_or(0.0);
    let kept: Vec<usize> = rows
        .iter()
        .copied()
        .filter(|&row| distance(row) <= STRAY * usual)
        .collect();
    if kept.is_empty() { rows } else { kept }
}

/// The lengths whose readings are averaged.
pub(super) const AVERAGED: [Quantity; 4] =
    [Quantity::X, Quantity::Y, Quantity::Z, Quantity::Distance];

/// Means of what was measured, one for each group.
pub(crate) fn means(measured: &Columns, groups: &[Group]) -> Columns {
    let mut means = Columns::default();
    let mean = |values: &[f64], group: &Group| {
        let sum: f64 = group.rows.iter().map(|&row| values[row]).sum();
        sum / group.rows.len() as f64
    };
    for quantity in AVERAGED.into_iter().chain([Quantity::Time]) {
        if let Some(values) = measured.numbers(quantity) {
            let values = groups.iter().map(|group| mean(&values, group)).collect();
            let unit = if quantity == Quantity::Time {
                Unit::Fixed
            } else {
                Unit::Length(1.0)
            };
            means.put(Column::made(quantity, unit, values));
        }
    }
    if let Some(all) = measured.orientations() {
        let turns = groups.iter().map(|group| mean_orientation(&all, group));
        means.put_orientations(&turns.collect::<Vec<_>>());
    }
    means
}

/// The normalised mean of quaternions, which may have either sign.
fn mean_orientation(all: &[Quaternion<f64>], group: &Group) -> Quaternion<f64> {
    let first = all[group.rows[0]];
    let sum = group.rows.iter().fold(Quaternion::default(), |sum, &row| {
        let q = all[row];
        sum + q * if q.dot(&first) < 0.0 { -1.0 } else { 1.0 }
    });
    let norm = sum.norm();
    if norm > 0.0 { sum / norm } else { first }
}
