//! Instruments whose y points upwards.

use crate::importers::columns::{Column, Columns};
use crate::sessions::columns::{Quantity, Unit};

/// Turns coordinates with y upwards by 90° about x, so that z points upwards:
/// (x, y, z) → (x, −z, y).
pub(crate) fn turn_up(columns: &mut Columns) {
    use std::f64::consts::FRAC_1_SQRT_2 as HALF;
    let inner = |quantity| columns.numbers(quantity);
    let mut turned = Vec::new();
    if let (Some(y), Some(z)) = (inner(Quantity::Y), inner(Quantity::Z)) {
        turned.push((Quantity::Y, z.iter().map(|z| -z).collect()));
        turned.push((Quantity::Z, y));
    }
    let parts: Vec<Vec<f64>> = (0..4)
        .filter_map(|part| inner(Quantity::Orientation(part)))
        .collect();
    if let [w, x, y, z] = &parts[..] {
        // (cos 45°, sin 45°, 0, 0) times the quaternion.
        let both = |a: &[f64], b: &[f64], sign: f64| -> Vec<f64> {
            a.iter()
                .zip(b)
                .map(|(a, b)| HALF * (a + sign * b))
                .collect()
        };
        let products = [
            both(w, x, -1.0),
            both(x, w, 1.0),
            both(y, z, -1.0),
            both(z, y, 1.0),
        ];
        for (part, values) in products.into_iter().enumerate() {
            turned.push((Quantity::Orientation(part), values));
        }
    }
    for (quantity, values) in turned {
        let unit = match quantity {
            Quantity::Orientation(_) => Unit::Fixed,
            _ => Unit::Length(1.0),
        };
        columns.put(Column::made(quantity, unit, values));
    }
}
