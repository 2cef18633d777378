//! Where the samples' points are and where they should be, as the standards compare them: measured
//! before compensation, and where the same commands, corrected, would have put them.
//!
//! A point after compensation is measured + (reached − model): noise and everything that the model
//! does not know stay in it, as they do in [`verify`](crate::compensation::verify). What the model
//! says of the instrument (its scale, a frame that drifts) is taken out with it.

use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

use crate::compensation::verification::VerifyError;
use crate::compensation::with_table::moved_by_correction;
use crate::effects::{Inputs, JointValues};
use crate::fit::problem::Problem;
use crate::kinematics::{JointKind, Robot, quaternion};
use crate::model::{Calibration, Model, Positions};
use crate::sessions::Session;

/// Across an axis, but for rounding.
const ACROSS: f64 = 1e-6;

#[derive(Debug)]
pub(super) struct Points<'a> {
    pub(super) session: &'a Session,
    pub(super) robot: &'a Robot,
    pub(super) inputs: Inputs<'a>,
    pub(super) usable: Vec<bool>,
    nominal: Positions,
    moved: Option<Positions>,
    calibration: Option<&'a Calibration>,
}

impl<'a> Points<'a> {
    pub(super) fn new(
        session: &'a Session,
        calibration: Option<&'a Calibration>,
    ) -> Result<Self, VerifyError> {
        let moved = calibration
            .map(|c| moved_by_correction(c, session))
            .transpose()?;
        let robot = calibration.map_or(&session.robot, |c| &c.model.robot);
        let problem = Problem::new(session, JointValues::Commanded);
        let nominal = Model::nominal(robot.clone()).predict(&problem.inputs);
        if problem.usable.is_empty() {
            return Err(VerifyError::NothingToVerify);
        }
        Ok(Self {
            session,
            robot,
            usable: problem.usable,
            inputs: problem.inputs,
            nominal,
            moved: moved.flatten(),
            calibration,
        })
    }

    /// Along a sliding joint, coordinates across it that nothing measured say nothing: the session with them as
    /// commanded, where there are such.
    pub(super) fn along(&self, joint: usize) -> Option<Session> {
        let axis = &self.robot.joints[joint];
        let mut whole = self.session.clone();
        let samples = &mut whole.samples;
        let columns = [
            Some(&mut samples.x_mm),
            Some(&mut samples.y_mm),
            samples.z_mm.as_mut(),
        ];
        let mut fills = false;
        for (k, column) in columns.into_iter().enumerate() {
            let Some(column) = column.filter(|column| column.iter().all(|v| v.is_nan())) else {
                continue;
            };
            if axis.kind != JointKind::Prismatic || axis.axis.direction[k].abs() > ACROSS {
                return None;
            }
            fills = true;
            for (i, value) in column.iter_mut().enumerate() {
                *value = self.commanded(i)[k];
            }
        }
        fills.then_some(whole)
    }

    /// The calibration whose commands are compared, where there is anything to say of compensation.
    pub(super) fn correcting(&self) -> Option<&'a Calibration> {
        self.calibration.filter(|_| self.compensated())
    }

    /// Whether there is anything to say of compensation.
    pub(super) fn compensated(&self) -> bool {
        self.moved.is_some()
    }

    /// Where the nominal robot puts a sample, mm.
    pub(super) fn commanded(&self, sample: usize) -> Point3<f64> {
        Point3::from(self.nominal.get(sample))
    }

    /// The orientation that the nominal robot gives the tool at a sample, base frame.
    pub(super) fn orientation(&self, sample: usize) -> UnitQuaternion<f64> {
        let q: Vec<f64> = self.inputs.q.iter().map(|q| q[sample]).collect();
        self.robot.base_from_tool(&q).rotation
    }

    /// The orientation that was measured at a sample; `None` where none was.
    pub(super) fn turned(&self, sample: usize) -> Option<UnitQuaternion<f64>> {
        let columns = self.session.samples.orientation_wxyz.as_ref()?;
        let [w, x, y, z] = [0, 1, 2, 3].map(|k| columns[k][sample]);
        UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9)
    }

    /// The turn from the orientation commanded at a sample to an attained one; `None` where that is no number.
    pub(super) fn turn(
        &self,
        attained: &UnitQuaternion<f64>,
        sample: usize,
    ) -> Option<Vector3<f64>> {
        let turn = quaternion::log(&(attained * self.orientation(sample).inverse()));
        turn.iter().all(|v| v.is_finite()).then_some(turn)
    }

    /// Where it was measured, or would have been with corrected commands, mm. In a planar session
    /// z is where it should be.
    pub(super) fn attained(&self, sample: usize, compensated: bool) -> Point3<f64> {
        let samples = &self.session.samples;
        let commanded = self.commanded(sample);
        let z = samples.z_mm.as_ref();
        let mut point = Point3::new(
            samples.x_mm[sample],
            samples.y_mm[sample],
            z.map_or(commanded.z, |z| z[sample]),
        );
        if let Some(moved) = self.moved.as_ref().filter(|_| compensated) {
            let [x, y, dz] = moved.get(sample);
            point.x += x;
            point.y += y;
            point.z += if z.is_some() { dz } else { 0.0 };
        }
        point
    }
}
