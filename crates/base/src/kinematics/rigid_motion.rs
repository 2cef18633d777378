//! The rigid motion that brings one set of points closest to another, in closed form
//! (Arun, Huang & Blostein 1987; Umeyama 1991).

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::{fewest, rounding};

/// `to ≈ motion · from` over pairs (from, to); `None` with fewer than three.
pub fn rigid_motion(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Option<Isometry3<f64>> {
    if pairs.len() < fewest::OF_A_BODY {
        return None;
    }
    let n = pairs.len() as f64;
    let from_centre = pairs.iter().map(|p| p.0).sum::<Vector3<f64>>() / n;
    let to_centre = pairs.iter().map(|p| p.1).sum::<Vector3<f64>>() / n;
    let moment: Matrix3<f64> = pairs
        .iter()
        .map(|(from, to)| (to - to_centre) * (from - from_centre).transpose())
        .sum();
    let spread: f64 = pairs
        .iter()
        .map(|(from, to)| (to - to_centre).norm() * (from - from_centre).norm())
        .sum();
    // With a thousandth of a millimetre of each, where all are at one point.
    let not_shown = rounding::WRITTEN * (spread + n);
    let mut svd = crate::decompose::svd(moment)?;
    if svd.singular_values.sum() - svd.singular_values.max() < not_shown {
        svd = crate::decompose::svd(moment + Matrix3::identity() * not_shown)?;
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Two poses, again and again: the turn about the line through both is shown by none of them.
    #[test]
    fn what_the_points_do_not_show_is_not_turned() {
        let ends = [
            Vector3::new(900.0, 0.0, 800.0),
            Vector3::new(300.0, 700.0, 500.0),
        ];
        let noise = |i: usize| Vector3::from_fn(|k, _| 0.02 * ((7 * i + 3 * k) as f64).sin());
        let pairs: Vec<_> = (0..60)
            .map(|i| {
                (
                    ends[i % 2],
                    ends[i % 2] + Vector3::new(1.0, -0.5, 0.8) + noise(i),
                )
            })
            .collect();
        let motion = rigid_motion(&pairs).unwrap();
        assert!(motion.rotation.angle() < 1e-3, "{motion}");
        let standing: Vec<_> = (0..9).map(|i| (ends[0], ends[0] + noise(i))).collect();
        let motion = rigid_motion(&standing).unwrap();
        assert!(motion.rotation.angle() < 1e-6, "{motion}");
    }

    #[test]
    fn what_they_show_is() {
        let turn = UnitQuaternion::from_euler_angles(0.4, -1.1, 2.5);
        let at = |i: usize| Vector3::from_fn(|k, _| 400.0 * ((5 * i + 2 * k) as f64).sin());
        let pairs: Vec<_> = (0..9).map(|i| (at(i), turn * at(i))).collect();
        let motion = rigid_motion(&pairs).unwrap();
        assert!(motion.rotation.angle_to(&turn) < 1e-5, "{motion}");
    }
}
