//! The rigid motion that brings one set of points closest to another, in closed form
//! (Arun, Huang & Blostein 1987; Umeyama 1991).

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::Positions;
use crate::sessions::Session;

/// `measured ≈ motion · predicted` over the samples that `counts` picks; `None` with fewer than
/// three, or in a planar session.
pub(crate) fn best_rigid_motion(
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

/// `to ≈ motion · from` over pairs (from, to); `None` with fewer than three.
pub(crate) fn rigid_motion(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Option<Isometry3<f64>> {
    if pairs.len() < 3 {
        return None;
    }
    let n = pairs.len() as f64;
    let from_centre = pairs.iter().map(|p| p.0).sum::<Vector3<f64>>() / n;
    let to_centre = pairs.iter().map(|p| p.1).sum::<Vector3<f64>>() / n;
    let moment: Matrix3<f64> = pairs
        .iter()
        .map(|(from, to)| (to - to_centre) * (from - from_centre).transpose())
        .sum();
    let svd = crate::decompose::svd(moment)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    // A reflection would fit a flat set of points as well; it is no motion.
    let handedness = (u * v_t).determinant().signum();
    let mut u_proper = u;
    let smallest =
        (0..3).min_by(|a, b| svd.singular_values[*a].total_cmp(&svd.singular_values[*b]))?;
    if handedness < 0.0 {
        u_proper.column_mut(smallest).neg_mut();
    }
    let rotation =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(u_proper * v_t));
    let shift = to_centre - rotation * from_centre;
    Some(Isometry3::from_parts(Translation3::from(shift), rotation))
}
