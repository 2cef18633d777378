//! The orientation of the tool: three rows, the rotation vector from the predicted to the measured
//! orientation in the measuring frame.
//!
//! ```text
//! r = log(R_measured Rᵀ),   ∂r/∂ω = −J_r⁻¹(r),   J_r⁻¹ = 1 + ½[r] + c [r]²
//! ```
//!
//! for a small turn ω of the tool about the measuring frame's axes (Barfoot, *State Estimation for
//! Robotics*, 2017, §7.1.5).

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion};

use crate::kinematics::quaternion::SMALL_RAD;
use crate::kinematics::quaternion::log_of_matrix;
use crate::observations::{AboutKind, Kind, Observable, Residual, Seen, Unit};
use crate::rounding;
use crate::sessions::{Instrument, Session};

pub(crate) struct Orientation;

static ABOUT: AboutKind = AboutKind {
    name: "orientation",
    title: phrase!("orientation"),
    looks: Observable::AtAttitude,
    unit: Unit::Radian,
    usual_sigma: 5e-4,
    shows_length: false,
    holds: false,
};

/// The measured orientation of a sample.
pub(crate) fn measured(session: &Session, sample: usize) -> Option<UnitQuaternion<f64>> {
    let [w, x, y, z] = session.samples.orientation_wxyz.as_ref()?;
    let q = Quaternion::new(w[sample], x[sample], y[sample], z[sample]);
    let norm = q.norm();
    (norm.is_finite() && norm > rounding::COMPUTED).then(|| UnitQuaternion::from_quaternion(q))
}

impl Kind for Orientation {
    fn about(&self) -> &'static AboutKind {
        &ABOUT
    }

    fn measured(&self, session: &Session, sample: usize) -> bool {
        measured(session, sample).is_some()
    }

    fn sigma(&self, instrument: &Instrument) -> Option<f64> {
        instrument.sigma_orientation
    }

    fn show(
        &self,
        session: &mut Session,
        sample: usize,
        _: Option<usize>,
        seen: &Seen,
        noise: [f64; 3],
    ) {
        let rows = seen.attitude;
        let exact = Rotation3::from_matrix_unchecked(Matrix3::from_fn(|r, c| rows[r][c]));
        let shown = UnitQuaternion::from_scaled_axis(noise.into())
            * UnitQuaternion::from_rotation_matrix(&exact);
        let count = session.samples.len();
        let parts = &mut session.samples.orientation_wxyz;
        let parts = parts.get_or_insert_with(|| std::array::from_fn(|_| vec![f64::NAN; count]));
        let sign = if shown.w < 0.0 { -1.0 } else { 1.0 };
        for (part, value) in parts.iter_mut().zip([shown.w, shown.i, shown.j, shown.k]) {
            part[sample] = sign * value;
        }
    }

    fn residual(&self, session: &Session, sample: usize, seen: &Seen) -> Residual {
        let mut residual = Residual::new(3);
        let rows = seen.attitude;
        let predicted = Matrix3::from_fn(|row, column| rows[row][column]);
        let predicted = Rotation3::from_matrix_unchecked(predicted);
        let measured = measured(session, sample).unwrap_or_default();
        let left = log_of_matrix(&(measured.to_rotation_matrix() * predicted.inverse()));
        let angle = left.norm();
        // (1/θ² − (1 + cos θ)/(2 θ sin θ)), by its series near zero; beyond a right angle nothing is
        // near, and a rough derivative is enough to get there.
        let factor = if angle < SMALL_RAD {
            1.0 / 12.0 + angle * angle / 720.0
        } else {
            let theta = angle.min(2.5);
            1.0 / (theta * theta) - (1.0 + theta.cos()) / (2.0 * theta * theta.sin())
        };
        let skew = left.cross_matrix();
        let inverse = Matrix3::identity() + skew * 0.5 + skew * skew * factor;
        for row in 0..3 {
            residual.left[row] = left[row];
            for k in 0..3 {
                residual.by_turn[row][k] = inverse[(row, k)];
            }
        }
        residual
    }
}
