//! Sessions that a program makes of its own numbers, checked as files are.
//!
//! [`Session::new`] takes what every session has, [`Session::builder`] everything else. Both refuse what a
//! file would be refused for, each problem with the name of its field, so that what they return can be
//! given to everything in this library. A [`Session`] that was filled in field by field goes through
//! [`Session::checked`].

use crate::text::Text;
use std::collections::BTreeMap;

use nalgebra::{Point3, UnitQuaternion};

use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::kinematics::Robot;
use crate::sessions::consistency::{self, error};
use crate::sessions::domain::{
    Instrument, Region, Samples, Session, Setups, Sigma, Target, default_targets,
};
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
    /// use truepose::sessions::Session;
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
        Self::builder(robot, q).points_mm(points_mm).build()
    }

    /// A session of these commanded joint values, to which what was measured is added.
    ///
    /// ```
    /// # use nalgebra::{Point3, Vector3};
    /// # use truepose::kinematics::{Axis, Joint, JointKind, Pose, Robot, RobotSource};
    /// use truepose::sessions::Session;
    /// # let axis = Axis::through(Vector3::z(), Point3::origin())?;
    /// # let robot = Robot { name: "r".to_owned(), joints: vec![Joint::new("pan", JointKind::Revolute, axis)],
    /// #     base_from_tool: Pose::translation(250.0, 0.0, 300.0), gravity_m_s2: None, source: RobotSource::Axes };
    /// let session = Session::builder(robot, &[[0.0], [0.1]])
    ///     .name("first try")
    ///     .target("T1", Point3::origin())
    ///     .target("T2", Point3::new(100.0, 0.0, 0.0))
    ///     .points_mm(&[Point3::new(250.0, 0.0, 300.0), Point3::new(348.0, 35.0, 300.0)])
    ///     .seen_target(&["T1", "T2"])
    ///     .directions(&[[1.0], [-1.0]])
    ///     .sigma_mm(0.03)
    ///     .build()?;
    /// assert_eq!(session.samples.len(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn builder<Q: AsRef<[f64]>>(robot: Robot, q: &[Q]) -> SessionBuilder {
        SessionBuilder::new(robot, q)
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

/// Gathers what a session is made of; see [`Session::builder`]. Every list has one entry for each sample.
#[derive(Debug, Clone)]
pub struct SessionBuilder {
    session: Session,
    rows: usize,
    wrong: Vec<Diagnostic>,
    seen: Vec<String>,
}

impl SessionBuilder {
    fn new<Q: AsRef<[f64]>>(robot: Robot, q: &[Q]) -> Self {
        let joints = robot.joints.len();
        let rows = q.len();
        let mut new = Self {
            session: Session {
                name: "session".to_owned(),
                note: String::new(),
                robot,
                targets: Vec::new(),
                instrument: Instrument::default(),
                tolerance_mm: None,
                regions: Vec::new(),
                compensated_by: None,
                samples: Samples {
                    x_mm: vec![f64::NAN; rows],
                    y_mm: vec![f64::NAN; rows],
                    z_mm: Some(vec![f64::NAN; rows]),
                    ..Samples::default()
                },
                path: None,
            },
            rows,
            wrong: Vec::new(),
            seen: Vec::new(),
        };
        let columns = new.by_joint("q", joints, q);
        new.session.samples.q = columns;
        new
    }

    /// Columns of rows, one value for each joint.
    fn by_joint<Q: AsRef<[f64]>>(
        &mut self,
        field: &str,
        joints: usize,
        rows: &[Q],
    ) -> Vec<Vec<f64>> {
        let found = text!(one "{count} row", "{count} rows", count = rows.len());
        self.count(field, rows.len(), found);
        let mut columns = vec![Vec::with_capacity(rows.len()); joints];
        for (sample, row) in rows.iter().enumerate() {
            let row = row.as_ref();
            if row.len() != joints {
                let found = text!(
                    "sample {sample}: {row} values",
                    sample = sample + 1,
                    row = row.len()
                );
                let expected = text!("{joints}, one for each joint", joints);
                self.wrong.push(error(field, found, expected));
                return vec![vec![f64::NAN; self.rows]; joints];
            }
            for (column, value) in columns.iter_mut().zip(row) {
                column.push(*value);
            }
        }
        columns
    }

    fn count(&mut self, field: &str, count: usize, found: Text) {
        if count != self.rows {
            let expected = text!("{rows}, as many as samples", rows = self.rows);
            self.wrong.push(error(field, found, expected));
        }
    }

    fn column(&mut self, field: &str, values: &[f64]) -> Vec<f64> {
        let found = text!(one "{count} value", "{count} values", count = values.len());
        self.count(field, values.len(), found);
        values.to_vec()
    }

    /// What it is called.
    #[must_use]
    pub fn name(mut self, name: &str) -> Self {
        name.clone_into(&mut self.session.name);
        self
    }

    /// Free text.
    #[must_use]
    pub fn note(mut self, note: &str) -> Self {
        note.clone_into(&mut self.session.note);
        self
    }

    /// Measured points in the measuring frame, mm; a coordinate that is missing is NaN.
    #[must_use]
    pub fn points_mm(mut self, points: &[Point3<f64>]) -> Self {
        let found = text!(one "{count} point", "{count} points", count = points.len());
        self.count("points_mm", points.len(), found);
        let samples = &mut self.session.samples;
        samples.x_mm = points.iter().map(|point| point.x).collect();
        samples.y_mm = points.iter().map(|point| point.y).collect();
        samples.z_mm = Some(points.iter().map(|point| point.z).collect());
        self
    }

    /// Measured orientations of the tool in the measuring frame.
    #[must_use]
    pub fn orientations(mut self, turns: &[UnitQuaternion<f64>]) -> Self {
        let found = text!(one "{count} orientation", "{count} orientations", count = turns.len());
        self.count("orientations", turns.len(), found);
        let part = |of: fn(&UnitQuaternion<f64>) -> f64| turns.iter().map(of).collect();
        let parts = [part(|q| q.w), part(|q| q.i), part(|q| q.j), part(|q| q.k)];
        self.session.samples.orientation_wxyz = Some(parts);
        self
    }

    /// Joint values that the controller read back, rad or mm.
    #[must_use]
    pub fn read_back<Q: AsRef<[f64]>>(mut self, q: &[Q]) -> Self {
        let columns = self.by_joint("read_back", self.session.robot.joints.len(), q);
        self.session.samples.q_read = columns.into_iter().map(Some).collect();
        self
    }

    /// From which side each joint came: 1 moving positive, −1, 0 unknown.
    #[must_use]
    pub fn directions<D: AsRef<[f64]>>(mut self, directions: &[D]) -> Self {
        let columns = self.by_joint("directions", self.session.robot.joints.len(), directions);
        let fits = |v: &f64| v.is_nan() || *v == 0.0 || v.abs() == 1.0;
        if !columns.iter().flatten().all(fits) {
            let found = text!("a direction other than 1, -1 and 0");
            let expected = text!("1, -1 or 0 (unknown)");
            self.wrong.push(error("directions", found, expected));
        }
        self.session.samples.dir = columns.into_iter().map(Some).collect();
        self
    }

    /// Signed joint speeds while measuring, rad/s or mm/s; 0 at standstill.
    #[must_use]
    pub fn speeds<S: AsRef<[f64]>>(mut self, speeds: &[S]) -> Self {
        let columns = self.by_joint("speeds", self.session.robot.joints.len(), speeds);
        self.session.samples.speed = columns.into_iter().map(Some).collect();
        self
    }

    /// Load at the tool's origin, kg.
    #[must_use]
    pub fn load_kg(mut self, values: &[f64]) -> Self {
        self.session.samples.load_kg = Some(self.column("load_kg", values));
        self
    }

    /// Temperature, °C.
    #[must_use]
    pub fn temperature_c(mut self, values: &[f64]) -> Self {
        self.session.samples.temperature_c = Some(self.column("temperature_c", values));
        self
    }

    /// When it was measured, s.
    #[must_use]
    pub fn time_s(mut self, values: &[f64]) -> Self {
        self.session.samples.time_s = Some(self.column("time_s", values));
        self
    }

    /// A reflector in the tool frame, mm. Without one there is one at the tool's origin.
    #[must_use]
    pub fn target(mut self, name: &str, position_mm: Point3<f64>) -> Self {
        if self
            .session
            .targets
            .iter()
            .any(|target| target.name == name)
        {
            let expected = text!("a unique name for each target");
            self.wrong.push(error(
                "target",
                text!("two targets called {name}", name),
                expected,
            ));
        }
        self.session.targets.push(Target {
            name: name.to_owned(),
            position_mm,
        });
        self
    }

    /// Which target each sample sees, by its name.
    #[must_use]
    pub fn seen_target(mut self, names: &[&str]) -> Self {
        let found = text!(one "{count} name", "{count} names", count = names.len());
        self.count("seen_target", names.len(), found);
        self.seen = names.iter().map(|&name| name.to_owned()).collect();
        self
    }

    /// In which free measuring frame each sample was taken, by its name.
    #[must_use]
    pub fn setups(mut self, names: &[&str]) -> Self {
        let found = text!(one "{count} name", "{count} names", count = names.len());
        self.count("setups", names.len(), found);
        let mut cells = crate::tables::Names::default();
        for name in names {
            cells.push(name);
        }
        self.session.samples.setups = Some(Setups {
            names: cells.list,
            index: cells.index,
        });
        self
    }

    /// Which samples no fit may touch: with them it is checked.
    #[must_use]
    pub fn held_out(mut self, held_out: &[bool]) -> Self {
        let found = text!(one "{count} value", "{count} values", count = held_out.len());
        self.count("held_out", held_out.len(), found);
        self.session.samples.held_out = Some(held_out.to_vec());
        self
    }

    /// Noise of the points, one standard deviation, mm.
    #[must_use]
    pub fn sigma_mm(mut self, sigma_mm: f64) -> Self {
        self.session.instrument.sigma_mm = Some(Sigma::Overall(sigma_mm));
        if !(1e-15..=1e7).contains(&sigma_mm) {
            let expected = text!("a length above 0 mm");
            self.wrong.push(error(
                "sigma_mm",
                Text::verbatim(sigma_mm.to_string()),
                expected,
            ));
        }
        self
    }

    /// The instrument, where more of it is known than the noise of its points.
    #[must_use]
    pub fn instrument(mut self, instrument: Instrument) -> Self {
        self.session.instrument = instrument;
        self
    }

    /// How far a measured position may be off, mm.
    #[must_use]
    pub fn tolerance_mm(mut self, tolerance_mm: f64) -> Self {
        self.session.tolerance_mm = Some(tolerance_mm);
        if !(tolerance_mm > 0.0 && tolerance_mm <= 1e7) {
            let expected = text!("a length above 0 mm");
            self.wrong.push(error(
                "tolerance_mm",
                Text::verbatim(tolerance_mm.to_string()),
                expected,
            ));
        }
        self
    }

    /// A range of a single joint's angle that gets a correction of its own, rad.
    #[must_use]
    pub fn region(mut self, name: &str, from_rad: f64, to_rad: f64) -> Self {
        if !(from_rad < to_rad && from_rad.abs() <= 2e4 && to_rad.abs() <= 2e4) {
            let found = text!("a region from {from_rad} to {to_rad} rad", from_rad, to_rad);
            let expected = text!("a region from the smaller to the larger value");
            self.wrong.push(error("region", found, expected));
        }
        self.session.regions.push(Region {
            name: name.to_owned(),
            from_rad,
            to_rad,
        });
        self
    }

    /// The session.
    ///
    /// # Errors
    /// [`Rejected`] with everything that is wrong.
    pub fn build(mut self) -> Result<Session, Rejected> {
        if !self.seen.is_empty() {
            if self.session.targets.is_empty() {
                self.session.targets = default_targets();
            }
            let targets = self
                .session
                .targets
                .iter()
                .map(|target| target.name.as_str());
            let places: BTreeMap<&str, u32> = targets.zip(0..).collect();
            let found = self
                .seen
                .iter()
                .map(|name| places.get(name.as_str()).copied());
            let index: Option<Vec<u32>> = found.collect();
            if index.is_none() {
                let unknown = self
                    .seen
                    .iter()
                    .find(|name| !places.contains_key(name.as_str()));
                let unknown = unknown.cloned().unwrap_or_default();
                let found = text!("target '{unknown}' is not declared", unknown);
                let expected = text!("the name of a target");
                self.wrong.push(error("seen_target", found, expected));
            }
            self.session.samples.target = index;
        }
        if !self.wrong.is_empty() {
            return Err(Rejected::of(self.wrong));
        }
        self.session.checked()
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
    fn a_builder_says_everything_that_is_wrong_at_once() {
        let (q, points) = points();
        let refused = Session::builder(column(), &q)
            .points_mm(&points[1..])
            .directions(&vec![[0.5]; q.len()])
            .sigma_mm(-1.0)
            .seen_target(&vec!["none"; q.len()])
            .build()
            .unwrap_err();
        assert_eq!(refused.diagnostics.len(), 4, "{refused}");
        let refused = Session::new(column(), &[[1e9]], &points[..1]).unwrap_err();
        assert!(refused.to_string().contains("1 000 000"), "{refused}");
        let refused = Session::new(column(), &[[0.0, 1.0]], &points[..1]).unwrap_err();
        assert!(refused.to_string().contains("2 values"), "{refused}");
        let none: [[f64; 1]; 0] = [];
        assert!(Session::new(column(), &none, &[]).is_err());
    }
}
