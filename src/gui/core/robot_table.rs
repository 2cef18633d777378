//! A robot as a table that is typed: its axes at home, or Denavit–Hartenberg rows, with the pose of the tool.
//!
//! ```text
//! axes:  for each joint its direction and a point on it, in the base frame at home
//! rows:  base_from_tool = base · row_1 · … · row_n · tool      (`kinematics::dh`)
//! ```
//!
//! Base and tool are x, y, z in mm and turns about z, the new y and the new x in degrees. A robot of either form is
//! made into the other: masses of links and couplings of joints, which the table does not show, go along.

use nalgebra::{Point3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use crate::export::nominal_rows;
use crate::kinematics::{
    Axis, DhConvention, DhRow, Follows, Joint, JointKind, KinematicsError, LinkMass, Pose, Range,
    Robot, RobotSource, robot_from_dh,
};
use crate::sessions::{parse_robot, robot_document};
use crate::text::Text;
use crate::units::{deg_from_rad, rad_from_deg};

/// In which terms the joints are typed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum TableForm {
    /// Direction and point of each axis at home.
    Axes,
    /// Denavit–Hartenberg rows, the joint before the link.
    Standard,
    /// Denavit–Hartenberg rows, the link before the joint.
    Modified,
}

impl TableForm {
    fn convention(self) -> Option<DhConvention> {
        match self {
            Self::Axes => None,
            Self::Standard => Some(DhConvention::Standard),
            Self::Modified => Some(DhConvention::Modified),
        }
    }

    /// Headings of the numbers of a joint, with their units.
    pub(crate) fn numbers(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Axes => &[
                ("axis x", ""),
                ("axis y", ""),
                ("axis z", ""),
                ("point x", "mm"),
                ("point y", "mm"),
                ("point z", "mm"),
            ],
            Self::Standard | Self::Modified => &[("a", "mm"), ("α", "°"), ("d", "mm"), ("θ", "°")],
        }
    }
}

/// One joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Row {
    pub(crate) name: String,
    /// Whether it slides; else it turns.
    pub(crate) slides: bool,
    /// As many as [`TableForm::numbers`] has, in its order; the others are not used.
    pub(crate) numbers: [f64; 6],
    /// Travel, deg or mm, where it is known.
    pub(crate) travel: Option<[f64; 2]>,
    /// Mass of the link behind it, kg, and its centre at home, mm.
    pub(crate) link: Option<(f64, [f64; 3])>,
    /// The joint that it follows, counted from 0, with ratio and offset (rad or mm).
    follows: Option<(usize, f64, f64)>,
    /// Turns of the motor for one of the joint.
    #[serde(default)]
    gear_ratio: Option<f64>,
}

/// A robot as it is typed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct RobotTable {
    pub(crate) name: String,
    pub(crate) form: TableForm,
    pub(crate) rows: Vec<Row>,
    /// The frame before the first row in the base frame: mm and degrees; of axes it is not used.
    pub(crate) base: [f64; 6],
    /// The tool at home, in the base frame, or behind the last row: mm and degrees.
    pub(crate) tool: [f64; 6],
    /// In the base frame, m/s²; `None`: unknown.
    pub(crate) gravity: Option<[f64; 3]>,
}

fn pose([x, y, z, about_z, about_y, about_x]: [f64; 6]) -> Pose {
    let turned = UnitQuaternion::from_euler_angles(
        rad_from_deg(about_x),
        rad_from_deg(about_y),
        rad_from_deg(about_z),
    );
    Pose::from_parts(Vector3::new(x, y, z).into(), turned)
}

fn numbers_of(pose: &Pose) -> [f64; 6] {
    let at = pose.translation.vector;
    let turned = pose.rotation.to_rotation_matrix();
    let about_y = -turned[(2, 0)].clamp(-1.0, 1.0).asin();
    // Turned by a right angle about y, the other two are about one axis: it is all about z.
    let (about_z, about_x) = if turned[(0, 0)].hypot(turned[(1, 0)]) > 1e-9 {
        (
            turned[(1, 0)].atan2(turned[(0, 0)]),
            turned[(2, 1)].atan2(turned[(2, 2)]),
        )
    } else {
        ((-turned[(0, 1)]).atan2(turned[(1, 1)]), 0.0)
    };
    let [about_z, about_y, about_x] =
        [about_z, about_y, about_x].map(|angle| rounded(deg_from_rad(angle)));
    let [x, y, z] = [at.x, at.y, at.z].map(rounded);
    [x, y, z, about_z, about_y, about_x]
}

/// Without the last digits of a conversion: to 10⁻⁹ mm or degrees.
fn rounded(value: f64) -> f64 {
    let rounded = (value * 1e9).round() / 1e9;
    // No −0.
    if rounded == 0.0 { 0.0 } else { rounded }
}

impl RobotTable {
    /// Most joints that the table takes.
    pub(crate) const MOST_JOINTS: usize = 12;

    /// The table of a robot, in the terms in which it came.
    pub(crate) fn of(robot: &Robot) -> Self {
        let form = match &robot.source {
            RobotSource::Dh { rows, .. }
                if rows.iter().all(|r| r.convention == DhConvention::Modified) =>
            {
                TableForm::Modified
            }
            RobotSource::Dh { .. } => TableForm::Standard,
            RobotSource::Axes | RobotSource::Links(_) => TableForm::Axes,
        };
        Self::in_form(robot, form)
    }

    /// One axis that turns, about z of the base.
    pub(crate) fn one_axis() -> Self {
        let mut table = Self {
            name: "robot".to_owned(),
            form: TableForm::Axes,
            rows: Vec::new(),
            base: [0.0; 6],
            tool: [0.0; 6],
            gravity: None,
        };
        table.add();
        table
    }

    /// A lamp on one axis that turns.
    pub(crate) fn lamp() -> Self {
        let mut table = Self::one_axis();
        "lamp".clone_into(&mut table.name);
        table.tool = [250.0, 0.0, 300.0, 0.0, 0.0, 0.0];
        table.gravity = Some([0.0, 0.0, -9.81]);
        table.rows[0].travel = Some([-90.0, 90.0]);
        table.rows[0].link = Some((4.0, [125.0, 0.0, 0.0]));
        table
    }

    fn in_form(robot: &Robot, form: TableForm) -> Self {
        let mut base = Pose::identity();
        let mut tool = robot.base_from_tool;
        let mut dh = Vec::new();
        if let Some(convention) = form.convention() {
            (base, dh) = nominal_rows(robot, convention);
            let behind = robot_from_dh("", &dh).map(|rows| rows.base_from_tool);
            tool = (base * behind.unwrap_or_default()).inverse() * tool;
        }
        let row = |(index, joint): (usize, &Joint)| {
            let mut row = Row::of(joint);
            if let Some(dh) = dh.get(index) {
                let [alpha, theta] = [dh.alpha_rad, dh.theta_rad].map(deg_from_rad);
                row.numbers = [dh.a_mm, alpha, dh.d_mm, theta, 0.0, 0.0].map(rounded);
            }
            row
        };
        Self {
            name: robot.name.clone(),
            form,
            rows: robot.joints.iter().enumerate().map(row).collect(),
            base: numbers_of(&base),
            tool: numbers_of(&tool),
            gravity: robot.gravity_m_s2.map(Into::into),
        }
    }

    /// The same robot in other terms; `None` while it is no robot.
    #[must_use]
    pub(crate) fn turned_into(&self, form: TableForm) -> Option<Self> {
        Some(Self::in_form(&self.robot().ok()?, form))
    }

    /// Adds a joint like the last, where the tool is.
    pub(crate) fn add(&mut self) {
        if self.rows.len() >= Self::MOST_JOINTS {
            return;
        }
        let last = self.rows.last();
        let numbers = match self.form {
            TableForm::Axes => {
                let [x, y, z, ..] = self.tool;
                let [a, b, c, ..] = last.map_or([0.0, 0.0, 1.0, 0.0, 0.0, 0.0], |row| row.numbers);
                [a, b, c, x, y, z]
            }
            TableForm::Standard | TableForm::Modified => [0.0; 6],
        };
        self.rows.push(Row {
            name: format!("joint {}", self.rows.len() + 1),
            slides: false,
            numbers,
            travel: Some([-180.0, 180.0]),
            link: None,
            follows: None,
            gear_ratio: None,
        });
    }

    /// Takes a joint out, and what followed it follows nothing.
    pub(crate) fn remove(&mut self, index: usize) {
        if self.rows.len() < 2 || index >= self.rows.len() {
            return;
        }
        self.rows.remove(index);
        for row in &mut self.rows {
            row.follows = row.follows.filter(|(of, ..)| *of != index);
            if let Some((of, ..)) = row.follows.as_mut().filter(|(of, ..)| *of > index) {
                *of -= 1;
            }
        }
    }

    /// The robot.
    ///
    /// # Errors
    /// What is wrong with the table.
    pub(crate) fn robot(&self) -> Result<Robot, Text> {
        if self.name.trim().is_empty() {
            return Err(text!("a robot needs a name"));
        }
        for (index, row) in self.rows.iter().enumerate() {
            let used = self.form.numbers().len();
            let mut all = row.numbers[..used]
                .iter()
                .chain(row.travel.iter().flatten());
            if !all.all(|number| number.is_finite()) {
                return Err(text!(
                    "joint {joint}: every field needs a number",
                    joint = index + 1
                ));
            }
            if row.name.trim().is_empty() {
                return Err(text!("a joint needs a name"));
            }
            if row
                .link
                .is_some_and(|(mass, _)| mass.is_nan() || mass < 0.0)
            {
                return Err(text!("a mass is 0 kg or more"));
            }
            if row.travel.is_some_and(|[from, to]| from >= to) {
                return Err(text!(
                    "joint {joint}: the travel runs from the smaller to the larger value",
                    joint = index + 1
                ));
            }
        }
        let robot = self.assembled()?;
        // What a robot of a file has to keep to, this one has as well.
        match parse_robot(robot_document(&robot).as_bytes()) {
            Ok(_) => Ok(robot),
            Err(rejected) => Err(rejected
                .diagnostics
                .first()
                .map_or_else(Text::default, |first| first.found.clone())),
        }
    }

    /// A robot with what was changed of its table: what was not stays as it was to the last bit, be it finer than the
    /// table shows.
    ///
    /// # Errors
    /// What is wrong with the table.
    pub(crate) fn changed(&self, robot: &Robot) -> Result<Robot, Text> {
        let opened = Self::of(robot);
        let mut next = self.robot()?;
        let moves = |row: &Row| (row.slides, row.numbers);
        let geometry = |table: &Self| {
            let rows: Vec<_> = table.rows.iter().map(moves).collect();
            (table.form, table.base, table.tool, rows)
        };
        if geometry(self) == geometry(&opened) {
            next.base_from_tool = robot.base_from_tool;
            next.source = robot.source.clone();
            for (joint, was) in next.joints.iter_mut().zip(&robot.joints) {
                joint.axis = was.axis;
            }
        }
        let rows = self.rows.iter().zip(&opened.rows);
        let joints = next.joints.iter_mut().zip(&robot.joints);
        for ((joint, was), (row, before)) in joints.zip(rows) {
            if (row.slides, row.travel) == (before.slides, before.travel) {
                joint.limits = was.limits;
            }
        }
        Ok(next)
    }

    fn assembled(&self) -> Result<Robot, Text> {
        let refused = |error: KinematicsError| Text::verbatim(error.to_string());
        let mut robot = if let Some(convention) = self.form.convention() {
            let rows: Vec<DhRow> = self.rows.iter().map(|row| row.dh(convention)).collect();
            let base = pose(self.base);
            let mut robot = robot_from_dh(self.name.trim(), &rows).map_err(refused)?;
            for joint in &mut robot.joints {
                joint.axis = joint.axis.moved_by(&base);
            }
            robot.base_from_tool = base * robot.base_from_tool * pose(self.tool);
            robot.source = RobotSource::Dh {
                base_from_first: base,
                rows,
            };
            robot
        } else {
            let joint = |row: &Row| Ok(Joint::new(row.name.clone(), row.kind(), row.axis()?));
            let joints: Result<Vec<Joint>, _> = self.rows.iter().map(joint).collect();
            Robot {
                name: self.name.trim().to_owned(),
                joints: joints.map_err(refused)?,
                base_from_tool: pose(self.tool),
                gravity_m_s2: None,
                source: RobotSource::Axes,
            }
        };
        robot.gravity_m_s2 = self.gravity.map(Vector3::from);
        for (joint, row) in robot.joints.iter_mut().zip(&self.rows) {
            joint.name.clone_from(&row.name);
            joint.limits = row.travel.map(|ends| {
                let [from, to] = ends.map(|value| row.kind().to_base_units(value));
                Range { from, to }
            });
            joint.link = row.link.map(|(mass_kg, centre)| LinkMass {
                mass_kg,
                centre_mm: Point3::from(centre),
            });
            let follows = row.follows;
            joint.follows = follows.map(|(of, ratio, offset)| Follows { of, ratio, offset });
            joint.gear_ratio = row.gear_ratio;
        }
        Ok(robot)
    }
}

impl Row {
    /// A joint by its axis at home.
    pub(crate) fn of(joint: &Joint) -> Self {
        let (axis, point) = (&joint.axis.direction, joint.axis.point_mm);
        let shown = |value| rounded(joint.kind.to_display(value));
        Self {
            name: joint.name.clone(),
            slides: joint.kind == JointKind::Prismatic,
            numbers: [axis.x, axis.y, axis.z, point.x, point.y, point.z].map(rounded),
            travel: joint.limits.map(|own| [own.from, own.to].map(shown)),
            link: joint.link.map(|l| (l.mass_kg, l.centre_mm.coords.into())),
            follows: joint.follows.map(|f| (f.of, f.ratio, f.offset)),
            gear_ratio: joint.gear_ratio,
        }
    }

    /// Its axis at home, of a table of axes.
    pub(crate) fn axis(&self) -> Result<Axis, KinematicsError> {
        let [a, b, c, x, y, z] = self.numbers;
        Axis::through(Vector3::new(a, b, c), Point3::new(x, y, z))
    }

    pub(crate) fn kind(&self) -> JointKind {
        if self.slides {
            JointKind::Prismatic
        } else {
            JointKind::Revolute
        }
    }

    /// Unit of its travel.
    pub(crate) fn unit(&self) -> &'static str {
        if self.slides { "mm" } else { "°" }
    }

    fn dh(&self, convention: DhConvention) -> DhRow {
        let [a_mm, alpha, d_mm, theta, ..] = self.numbers;
        DhRow {
            a_mm,
            alpha_rad: rad_from_deg(alpha),
            d_mm,
            theta_rad: rad_from_deg(theta),
            convention,
            kind: self.kind(),
        }
    }
}

/// Robots that were typed, newest first.
pub(crate) fn remember(robots: &mut Vec<RobotTable>, one: RobotTable) {
    /// Robots that are kept.
    const MOST: usize = 50;
    robots.retain(|other| other.name != one.name);
    robots.insert(0, one);
    robots.truncate(MOST);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robots::library;

    /// Where the tool is at some joint values, mm.
    fn tools(robot: &Robot) -> Vec<Point3<f64>> {
        let q = |k: usize| -> Vec<f64> {
            let joints = robot.joints.iter().enumerate();
            let value = |(i, joint): (usize, &Joint)| match joint.kind {
                JointKind::Revolute => 0.3 * ((k * 7 + i * 3) as f64).sin(),
                JointKind::Prismatic => 20.0 * ((k + i) as f64).cos(),
            };
            joints.map(value).collect()
        };
        (0..5)
            .map(|k| robot.point_in_base(&q(k), &Point3::new(10.0, -20.0, 30.0)))
            .collect()
    }

    fn off_mm(a: &Robot, b: &Robot) -> f64 {
        let pairs = tools(a).into_iter().zip(tools(b));
        pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    }

    #[test]
    fn every_robot_of_the_library_is_the_same_in_every_form() {
        for one in library() {
            let table = RobotTable::of(&one.robot);
            for form in [TableForm::Axes, TableForm::Standard, TableForm::Modified] {
                let turned = table.turned_into(form).expect("it is a robot");
                let robot = turned.robot().expect("it is a robot");
                let off = off_mm(&one.robot, &robot);
                assert!(off < 1e-5, "{} as {form:?}: {off} mm", one.id);
                let limits = |robot: &Robot| -> Vec<_> {
                    let joints = robot.joints.iter();
                    joints.map(|joint| joint.limits.is_some()).collect()
                };
                assert_eq!(limits(&one.robot), limits(&robot), "{}", one.id);
                let document = robot_document(&robot);
                let read = parse_robot(document.as_bytes()).expect("it is read").robot;
                assert!(off_mm(&read, &robot) < 1e-6, "{}", one.id);
            }
        }
    }

    #[test]
    fn what_is_no_robot_says_what_is_wrong() {
        let sound = RobotTable::of(&library()[0].robot);
        let wrong = |change: fn(&mut RobotTable)| {
            let mut table = sound.clone();
            change(&mut table);
            table.robot().expect_err("it is no robot").to_string()
        };
        assert_eq!(wrong(|t| t.name = "  ".into()), "a robot needs a name");
        let says = wrong(|t| t.rows[1].travel = Some([10.0, -10.0]));
        assert!(says.starts_with("joint 2: the travel"), "{says}");
        let says = wrong(|t| t.rows[0].numbers[0] = f64::NAN);
        assert!(says.starts_with("joint 1: every field"), "{says}");
        assert!(!wrong(|t| t.tool[0] = 1e12).is_empty());
        let axes = |t: &mut RobotTable| {
            *t = t.turned_into(TableForm::Axes).expect("it is a robot");
            t.rows[0].numbers[..3].copy_from_slice(&[0.0; 3]);
        };
        assert!(!wrong(axes).is_empty());
    }

    #[test]
    fn joints_come_and_go_and_what_follows_them_stays_with_its_own() {
        let mut table = RobotTable::of(&library()[0].robot);
        let before = table.rows.len();
        table.add();
        assert_eq!(table.rows.len(), before + 1);
        table.rows[before].follows = Some((2, 1.0, 0.0));
        table.remove(0);
        assert_eq!(table.rows[before - 1].follows, Some((1, 1.0, 0.0)));
        table.remove(1);
        assert_eq!(table.rows[before - 2].follows, None);
        while table.rows.len() > 1 {
            table.remove(0);
        }
        table.remove(0);
        assert_eq!(table.rows.len(), 1);
        assert!(table.robot().is_ok());
    }

    #[test]
    fn one_robot_of_a_name_is_remembered_the_last() {
        let mut own = Vec::new();
        let mut table = RobotTable::of(&library()[0].robot);
        remember(&mut own, table.clone());
        table.tool[0] += 5.0;
        remember(&mut own, table.clone());
        assert_eq!(own, [table]);
    }
}
