//! The rigid motion that brings what a model predicts closest to what was measured.

use nalgebra::{Isometry3, Vector3};

use super::Positions;
use crate::kinematics::rigid_motion::rigid_motion;
use crate::sessions::Session;

/// `measured ≈ motion · predicted` over the samples that `counts` picks; `None` with fewer than
/// three, or in a planar session.
pub fn best_rigid_motion(
    session: &Session,
    predicted: &Positions,
    counts: impl Fn(usize) -> bool,
) -> Option<Isometry3<f64>> {
    let samples = &session.samples;
    let z_mm = samples.z_mm.as_ref()?;
    let pairs: Vec<(Vector3<f64>, Vector3<f64>)> = (0..samples.len())
        .filter(|i| counts(*i))
        .filter(|i| {
            ![samples.x_mm[*i], samples.y_mm[*i], z_mm[*i]]
                .iter()
                .any(|v| v.is_nan())
        })
        .map(|i| {
            let measured = Vector3::new(samples.x_mm[i], samples.y_mm[i], z_mm[i]);
            (Vector3::from(predicted.get(i)), measured)
        })
        .collect();
    rigid_motion(&pairs)
}
