//! Instruments whose y points upwards.

use nalgebra::{Point3, Quaternion};

use crate::importers::columns::Columns;

/// Turns coordinates with y upwards by 90° about x, so that z points upwards:
/// (x, y, z) → (x, −z, y).
pub(crate) fn turn_up(columns: &mut Columns) {
    use std::f64::consts::FRAC_1_SQRT_2 as HALF;
    if let Some(points) = columns.places() {
        let turned = points.iter().map(|p| Point3::new(p.x, -p.z, p.y));
        columns.put_places(&turned.collect::<Vec<_>>());
    }
    if let Some(all) = columns.orientations() {
        // (cos 45°, sin 45°, 0, 0) times the quaternion.
        let turned = all.iter().map(|q| {
            let [w, x, y, z] = [q.w - q.i, q.i + q.w, q.j - q.k, q.k + q.j];
            Quaternion::new(HALF * w, HALF * x, HALF * y, HALF * z)
        });
        columns.put_orientations(&turned.collect::<Vec<_>>());
    }
}
