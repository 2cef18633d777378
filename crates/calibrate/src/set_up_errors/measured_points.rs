//! The measured points, and how far from them a robot is that the best rigid motion puts there.

use nalgebra::{Point3, Vector3};

use crate::kinematics::rigid_motion::rigid_motion;
use crate::model::Positions;
use crate::sessions::Session;

/// The share of the samples, farthest off, that may be wrong in themselves.
const MOST_WRONG: f64 = 0.1;

/// Points with three coordinates, by setups.
pub(super) struct MeasuredPoints<'a> {
    points: Vec<Vector3<f64>>,
    /// Of each sample, where there are several setups.
    setups: Option<&'a [u32]>,
    setup_count: usize,
}

impl<'a> MeasuredPoints<'a> {
    /// `None` of a planar session.
    pub(super) fn of(session: &'a Session) -> Option<Self> {
        let samples = &session.samples;
        let z_mm = samples.z_mm.as_ref()?;
        let points = samples.x_mm.iter().zip(&samples.y_mm).zip(z_mm);
        let setups = samples.setups.as_ref();
        Some(Self {
            points: points.map(|((x, y), z)| Vector3::new(*x, *y, *z)).collect(),
            setups: setups.map(|setups| setups.index.as_slice()),
            setup_count: setups.map_or(1, |setups| setups.names.len()),
        })
    }

    /// Root mean square of what predictions leave, mm, without the samples that are farthest off; `mirrored`: of the
    /// points in a mirror.
    pub(super) fn left_mm(&self, predicted: &Positions, mirrored: bool) -> f64 {
        let mut squares = Vec::new();
        for setup in 0..self.setup_count {
            let here = |i: &usize| self.setups.is_none_or(|own| own[*i] as usize == setup);
            let pair = |i: usize| {
                let mut to = self.points[i];
                if mirrored {
                    to.swap_rows(0, 1);
                }
                (Vector3::from(predicted.get(i)), to)
            };
            let pairs = (0..self.points.len()).filter(here).map(pair);
            let finite =
                |p: &(Vector3<f64>, Vector3<f64>)| (p.0 + p.1).iter().all(|v| v.is_finite());
            let pairs: Vec<_> = pairs.filter(finite).collect();
            let Some(motion) = rigid_motion(&pairs) else {
                continue;
            };
            squares.extend(pairs.into_iter().map(|(from, to)| {
                let moved = motion * Point3::from(from);
                (moved.coords - to).norm_squared()
            }));
        }
        squares.sort_by(f64::total_cmp);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of a length"
        )]
        let kept = squares.len() - (MOST_WRONG * squares.len() as f64) as usize;
        if kept == 0 {
            return f64::INFINITY;
        }
        (squares[..kept].iter().sum::<f64>() / kept as f64).sqrt()
    }
}
