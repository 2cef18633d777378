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
    /// use nalgebra::{Point3, Vector3};
    /// use truepose::diagnosis::Options;
    /// use truepose::effects::JointValues;
    /// use truepose::kinematics::{Axis, Joint, JointKind, Pose, Robot, RobotSource};
    /// use truepose::pipeline::{Method, diagnose, identify};
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
    /// let (found, _) = identify(&session, &Method::default(), JointValues::Commanded)?;
    /// assert!((found.parameters[0].value - 0.5).abs() < 1e-9);
    /// let answer = diagnose(&session, &Options::default(), &|_| true)?;
    /// assert_eq!(answer.verdict.name(), "noise");
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
            let found = text!("sample {sample}: {row} values", sample = sample + 1, row);
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
    use crate::diagnosis::Options;
    use crate::effects::JointValues;
    use crate::kinematics::testing::column;
    use crate::pipeline::{self, Method};

    type Spoil = fn(&mut Session);

    fn points() -> (Vec<[f64; 1]>, Vec<Point3<f64>>) {
        let q: Vec<[f64; 1]> = (-20..=20).map(|k| [0.07 * f64::from(k)]).collect();
        let point = |[q]: &[f64; 1]| Point3::new(250.0 * q.cos(), 250.0 * q.sin(), 300.0);
        let seen = q.iter().map(point).collect();
        (q, seen)
    }

    #[test]
    fn what_a_stranger_fills_in_by_hand_is_completed_and_never_panics() {
        let (q, points) = points();
        // No `dir`, no targets: what the types allow.
        let session = Session {
            samples: Samples {
                q: vec![q.iter().map(|[q]| *q).collect()],
                x_mm: points.iter().map(|p| p.x).collect(),
                y_mm: points.iter().map(|p| p.y).collect(),
                z_mm: Some(points.iter().map(|p| p.z).collect()),
                ..Samples::default()
            },
            targets: Vec::new(),
            ..Session::new(column(), &q, &points).unwrap()
        };
        let identify = |session: &Session| {
            pipeline::identify_checked(session, &Method::default(), JointValues::Commanded)
        };
        assert!(identify(&session).unwrap().identification.gap.after.rms_mm < 1e-9);
        assert!(pipeline::diagnose(&session, &Options::default(), &|_| true).is_ok());
        // Anything else is refused in words.
        let spoils: &[Spoil] = &[
            |s| s.samples.q.clear(),
            |s| s.samples.q[0].truncate(3),
            |s| s.samples.y_mm.clear(),
            |s| s.samples.z_mm = Some(Vec::new()),
            |s| s.samples.target = Some(vec![7; s.samples.x_mm.len()]),
            |s| s.samples.dir = vec![None; 4],
            |s| s.samples.held_out = Some(Vec::new()),
            |s| s.samples.time_s = Some(vec![1.0]),
            |s| s.robot.joints.clear(),
            |s| s.robot.joints = vec![s.robot.joints[0].clone(); 101],
            |s| s.robot.base_from_tool.translation.vector.x = 1e160,
        ];
        for (k, spoil) in spoils.iter().enumerate() {
            let mut wrong = session.clone();
            spoil(&mut wrong);
            assert!(identify(&wrong).is_err(), "{k}");
            assert!(
                pipeline::diagnose(&wrong, &Options::default(), &|_| true).is_err(),
                "{k}"
            );
            assert!(wrong.checked().is_err(), "{k}");
        }
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
