//! Orientations in another frame than the positions: all of them turned by one turn that the positions do not have.
//!
//! Measured are R = A P B and p = A (x + R t) + d: a turned tool B is a parameter of every calibration, a turned frame
//! A is one only where positions and orientations share it. The turns between samples determine A alone
//! ([`super::orientations`]); so do the positions, with a free shift of the tool t and of the frame d.

use nalgebra::{DMatrix, DVector, Point3, Rotation3, UnitQuaternion, Vector3};

use super::orientations::{Pairs, joint_values};
use super::thresholds::{CORRECTED_SHARE, FEWEST_SAMPLES, MOST_SAMPLES};
use crate::answers::diagnosis::DataProblem;
use crate::decompose::svd;
use crate::effects::JointValues;
use crate::fit::spread::places;
use crate::kinematics::quaternion::log;
use crate::kinematics::rigid_motion::rigid_motion;
use crate::sessions::{Session, SessionCorrection};
use crate::units::deg_from_rad;

/// No frame is turned by less on purpose, and zeros of joints that are off turn it by as much.
const SMALLEST_RAD: f64 = 5e-3;
/// A median residual of the turns moves their frame by less than this many times as much.
const TIMES_RESIDUAL: f64 = 3.0;
/// Alternations of frame and tool.
const ROUNDS: usize = 30;

/// Orientations in another frame than the positions: until they are stated in one only the positions are used.
pub(super) fn of_another_frame(session: &Session, values: JointValues) -> Vec<DataProblem> {
    turned(session, values).into_iter().collect()
}

fn turned(session: &Session, values: JointValues) -> Option<DataProblem> {
    let pairs = Pairs::of(session, values).filter(Pairs::are_of_one_frame)?;
    let fit = pairs.fit(&|q| vec![q])?;
    let points = Points::of(session, values)?;
    let (frame, own_mm) = points.best()?;
    let (_, in_that_mm) = points.in_frame(&fit.frame)?;
    let turn = frame * fit.frame.inverse();
    let least = SMALLEST_RAD.max(TIMES_RESIDUAL * fit.residual_rad);
    if turn.angle() < least || own_mm > CORRECTED_SHARE * in_that_mm {
        return None;
    }
    let degrees = |rad: f64| format!("{:.2}", deg_from_rad(rad));
    let by: Vec<String> = log(&turn).iter().map(|part| degrees(*part)).collect();
    Some(DataProblem::of_all(
        text!(
            "the orientations are turned by {angle}° against the positions",
            angle = degrees(turn.angle())
        ),
        text!(
            "in the measuring frame of the orientations positions are off by {before} mm in the median, in their own by {after} mm",
            before = format!("{in_that_mm:.3}"),
            after = format!("{own_mm:.3}")
        ),
        text!(
            "state both in one frame: turn each orientation from the left by the rotation vector ({by})°; until then only the positions are used",
            by = by.join(", ")
        ),
        SessionCorrection::LeaveOutOrientations,
    ))
}

/// Measured points, and where the robot puts them: the point and the orientation of the tool.
struct Points(Vec<(Vector3<f64>, Vector3<f64>, Rotation3<f64>)>);

impl Points {
    fn of(session: &Session, values: JointValues) -> Option<Self> {
        let samples = &session.samples;
        let targets = samples.target.as_ref();
        let row = |i: usize| {
            let measured = Vector3::from(samples.coordinates(i));
            let q = joint_values(session, values, i);
            let target = targets.map_or(0, |targets| targets[i] as usize);
            let target = session.targets.get(target);
            let target = target.map_or_else(Point3::origin, |target| target.position_mm);
            let pose = session.robot.base_from_tool(&q);
            let point = (pose * target).coords;
            let is_there = (measured + point).iter().all(|v| v.is_finite());
            let counts = is_there && measured != Vector3::zeros() && !samples.is_excluded(i);
            counts.then(|| (point, measured, pose.rotation.to_rotation_matrix()))
        };
        let rows: Vec<_> = places(samples.len(), MOST_SAMPLES)
            .filter_map(row)
            .collect();
        (rows.len() >= FEWEST_SAMPLES).then_some(Self(rows))
    }

    /// The shift of the tool with which this frame fits best, and the median residual, mm.
    fn in_frame(&self, frame: &UnitQuaternion<f64>) -> Option<(Vector3<f64>, f64)> {
        let frame = frame.to_rotation_matrix();
        let count = self.0.len();
        let mut columns = DMatrix::zeros(3 * count, 6);
        let mut lacking = DVector::zeros(3 * count);
        for (row, (point, measured, tool)) in self.0.iter().enumerate() {
            columns
                .fixed_view_mut::<3, 3>(3 * row, 0)
                .copy_from((frame * tool).matrix());
            columns
                .fixed_view_mut::<3, 3>(3 * row, 3)
                .fill_with_identity();
            lacking
                .fixed_rows_mut::<3>(3 * row)
                .copy_from(&(measured - frame * point));
        }
        let shifts = svd(columns.clone())?.solve(&lacking, 1e-9).ok()?;
        let residual = lacking - columns * &shifts;
        let off = (0..count).map(|row| residual.fixed_rows::<3>(3 * row).norm());
        let median = crate::numeric::median(off)?;
        Some((shifts.fixed_rows::<3>(0).into(), median))
    }

    /// The frame in which the positions are, and the median residual, mm.
    fn best(&self) -> Option<(UnitQuaternion<f64>, f64)> {
        let mut tool = Vector3::zeros();
        let mut best: Option<(UnitQuaternion<f64>, f64)> = None;
        for _ in 0..ROUNDS {
            let moved = |(point, measured, turn): &(Vector3<f64>, Vector3<f64>, Rotation3<f64>)| {
                (point + turn * tool, *measured)
            };
            let pairs: Vec<_> = self.0.iter().map(moved).collect();
            let frame = rigid_motion(&pairs)?.rotation;
            let (shift, residual) = self.in_frame(&frame)?;
            tool = shift;
            if best.is_none_or(|(_, least)| residual < least) {
                best = Some((frame, residual));
            }
        }
        best
    }
}
