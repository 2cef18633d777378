//! Accuracy and repeatability of what was attained: places and turns.

use crate::units::deg_from_rad;
use nalgebra::{Point3, Vector3};

use super::positioning::{mean, sample_deviation};

/// What the attained positions of one pose from one direction give, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attained {
    /// `AP_x`, `AP_y`, `AP_z`; z is 0 in a planar session.
    pub accuracy_axes: [f64; 3],
    /// `AP_p`, the distance of the mean from the command.
    pub accuracy: f64,
    /// l̄, the mean distance of the attained positions from their mean.
    pub mean_distance: f64,
    /// `S_l`, the standard deviation of those distances.
    pub deviation: f64,
    /// `RP_l` = l̄ + 3 `S_l`.
    pub repeatability: f64,
}

/// What the attained orientations give, degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turned {
    /// `AP_a`, `AP_b`, `AP_c`.
    pub accuracy: [f64; 3],
    /// `RP_a`, `RP_b`, `RP_c`, as the number after ±.
    pub repeatability: [f64; 3],
}

/// The barycentre and its figures.
pub(super) fn attained(
    points: &[Point3<f64>],
    commanded: &Point3<f64>,
) -> Option<(Point3<f64>, Attained)> {
    if points.len() < 2 {
        return None;
    }
    let sum: Vector3<f64> = points.iter().map(|p| p - commanded).sum();
    let off = sum / points.len() as f64;
    let centre = commanded + off;
    let distances: Vec<f64> = points.iter().map(|p| (p - centre).norm()).collect();
    let (mean_distance, deviation) = (mean(&distances)?, sample_deviation(&distances)?);
    let figures = Attained {
        accuracy_axes: off.into(),
        accuracy: off.norm(),
        mean_distance,
        deviation,
        repeatability: mean_distance + 3.0 * deviation,
    };
    Some((centre, figures))
}

/// Accuracy and repeatability of some turns (rotation vectors, rad); `None` of fewer than two.
pub(super) fn of_turns(turns: &[Vector3<f64>]) -> Option<Turned> {
    let about = |k: usize| -> Vec<f64> { turns.iter().map(|t| deg_from_rad(t[k])).collect() };
    let each = |f: fn(&[f64]) -> Option<f64>| -> Option<[f64; 3]> {
        Some([f(&about(0))?, f(&about(1))?, f(&about(2))?])
    };
    Some(Turned {
        accuracy: each(mean)?,
        repeatability: each(sample_deviation)?.map(|s| 3.0 * s),
    })
}
