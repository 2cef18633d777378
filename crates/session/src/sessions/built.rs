//! Sessions that a program makes of its own numbers, checked as files are.
//!
//! [`Session::new`] takes what every session has; what else was measured is filled in field by field, and
//! [`Session::checked`] looks at it. Both refuse what a file would be refused for, each problem with the name
//! of its field, so that what they return can be given to everything in this library.

use nalgebra::Point3;

use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::kinematics::Robot;
use crate::sessions::consistency::{self, error};
use crate::sessions::domain::{Instrument, Samples, Session};
use crate::sessions::validation;

impl Session {
    /// A session of measured points. `q` has the commanded joint values of each sample, rad or mm, one a
    /// joint; `points_mm` where the tool's origin was measured, in the base frame, mm.
    ///
    /// ```
    /// # mod truepose {
    /// #     pub use truepose_base::kinematics;
    /// #     pub use truepose_session::sessions;
    /// # }
    /// use nalgebra::{Point3, Vector3};
    /// use truepose::kinematics::{Axis, Joint, JointKind, Pose, Robot, RobotSource};
    /// use truepose::sessions::{Session, Sigma};
    ///
    /// // The robot as its controller believes it to be: one axis, the tool 250 mm away from it.
    /// let axis = Axis::through(Vector3::z(), Point3::origin())?;
    /// let robot = Robot {
    ///     name: "turntable".to_owned(),
    ///     joints: vec![Joint::new("pan", JointKind::Revolute, axis)],
    ///     base_from_tool: Pose::translation(250.0, 0.0, 300.0),
    ///     gravity_m_s2: None,
    ///     source: RobotSource::Axes,
    /// };
    /// // Where it was sent, and where it was seen: half a degree farther.
    /// let q: Vec<[f64; 1]> = (-40..=40).map(|k| [0.03 * f64::from(k)]).collect();
    /// let off = 0.5_f64.to_radians();
    /// let seen = q.iter().map(|[q]| Point3::new(250.0 * (q + off).cos(), 250.0 * (q + off).sin(), 300.0));
    /// let points: Vec<Point3<f64>> = seen.collect();
    ///
    /// let session = Session::new(robot, &q, &points)?;
    ///
    /// // What is wrong is said as of a file: a point fewer than joint values.
    /// let refused = Session::new(session.robot.clone(), &q, &points[1..]).unwrap_err();
    /// assert!(refused.to_string().contains("80 points"), "{refused}");
    ///
    /// // What else was measured is filled in, and looked at.
    /// let mut session = session;
    /// session.samples.dir = vec![Some(vec![1.0; q.len()])];
    /// session.instrument.sigma_mm = Some(Sigma::Overall(0.03));
    /// let session = session.checked()?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Rejected`] with every problem.
    pub fn new<Q: AsRef<[f64]>>(
        robot: Robot,
        q: &[Q],
        points_mm: &[Point3<f64>],
    ) -> Result<Self, Rejected> {
        let (joints, rows) = (robot.joints.len(), q.len());
        let mut wrong = Vec::new();
        if let Some(sample) = q.iter().position(|row| row.as_ref().len() != joints) {
            let row = q[sample].as_ref().len();
            let found = text!(
                "sample {row}: {value}",
                row = sample + 1,
                value = text!(one "{count} value", "{count} values", count = row)
            );
            let expected = text!("{joints}, one for each joint", joints);
            wrong.push(error("q", found, expected));
        }
        if points_mm.len() != rows {
            let found = text!(one "{count} point", "{count} points", count = points_mm.len());
            let expected = text!("{rows}, as many as samples", rows);
            wrong.push(error("points_mm", found, expected));
        }
        if !wrong.is_empty() {
            return Err(Rejected::of(wrong));
        }
        let column = |joint: usize| q.iter().map(|row| row.as_ref()[joint]).collect();
        let coordinate = |axis: usize| points_mm.iter().map(|point| point[axis]).collect();
        let session = Self {
            name: "session".to_owned(),
            note: String::new(),
            robot,
            targets: Vec::new(),
            instrument: Instrument::default(),
            tolerance_mm: None,
            regions: Vec::new(),
            compensated_by: None,
            samples: Samples {
                q: (0..joints).map(column).collect(),
                x_mm: coordinate(0),
                y_mm: coordinate(1),
                z_mm: Some(coordinate(2)),
                ..Samples::default()
            },
            path: None,
        };
        session.checked()
    }

    /// The session, completed by what may be left out (a target, columns that were not recorded).
    ///
    /// # Errors
    /// [`Rejected`] with everything for which a file would be refused.
    pub fn checked(mut self) -> Result<Self, Rejected> {
        consistency::complete(&mut self);
        let mut findings = consistency::findings(&self);
        if findings.is_empty() {
            findings = validation::findings(&self, &Place::default());
        }
        let is_error = |finding: &Diagnostic| finding.severity == Severity::Error;
        if findings.iter().any(is_error) {
            findings.retain(is_error);
            return Err(Rejected::of(findings));
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::column;

    fn points() -> (Vec<[f64; 1]>, Vec<Point3<f64>>) {
        let q: Vec<[f64; 1]> = (-20..=20).map(|k| [0.07 * f64::from(k)]).collect();
        let point = |[q]: &[f64; 1]| Point3::new(250.0 * q.cos(), 250.0 * q.sin(), 300.0);
        let seen = q.iter().map(point).collect();
        (q, seen)
    }

    #[test]
    fn everything_that_is_wrong_is_said_at_once() {
        let (mut q, points) = points();
        q[7][0] = 1e9;
        let mut wide: Vec<Vec<f64>> = q.iter().map(|q| q.to_vec()).collect();
        wide[3].push(1.0);
        let refused = Session::new(column(), &wide, &points[1..]).unwrap_err();
        assert_eq!(refused.diagnostics.len(), 2, "{refused}");
        assert!(
            refused.to_string().contains("sample 4: 2 values"),
            "{refused}"
        );
        assert!(refused.to_string().contains("40 points"), "{refused}");
        let refused = Session::new(column(), &q, &points).unwrap_err();
        assert!(refused.to_string().contains("1 000 000"), "{refused}");
        let none: [[f64; 1]; 0] = [];
        assert!(Session::new(column(), &none, &[]).is_err());
    }
}
