//! What a chart of samples has along its axes: the value of a joint, time, load, temperature; for an effect
//! also the joint's speed and its travel since the last reversal; in a scatter also where the point was
//! measured, a component of the deviation, the order of measuring.

use serde::{Deserialize, Serialize};

use crate::kinematics::JointKind;
use crate::present::chart::Axis;
use crate::present::numbers::trimmed;
use crate::present::units::{AngleUnit, Units};

use super::answer::Answer;
use super::loaded_session::{Component, LoadedSession};

/// What a chart of samples stands over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Variable {
    /// Commanded value of the joint, rad or mm.
    Joint,
    /// Time, s.
    Time,
    /// Load, kg.
    Load,
    /// Temperature, °C.
    Temperature,
    /// Signed speed of the joint, rad/s or mm/s.
    Speed,
    /// How far the joint has moved since it last reversed, rad or mm.
    Travel,
}

/// A variable, and the joint that it is about; its side is what the marks point to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Over {
    pub(crate) variable: Variable,
    /// The joint, counted from 0.
    pub(crate) joint: usize,
}

impl Over {
    /// The variable at a sample; NaN where it is not known. Travel is not a column.
    pub(crate) fn of(self, loaded_session: &LoadedSession, sample: usize) -> f64 {
        self.column(loaded_session)
            .map_or(f64::NAN, |column| column[sample])
    }

    /// The column, where the session has it.
    pub(crate) fn column(self, loaded_session: &LoadedSession) -> Option<&[f64]> {
        let samples = &loaded_session.session.samples;
        match self.variable {
            Variable::Joint => samples.q.get(self.joint).map(Vec::as_slice),
            Variable::Time => samples.time_s.as_deref(),
            Variable::Load => samples.load_kg.as_deref(),
            Variable::Temperature => samples.temperature_c.as_deref(),
            Variable::Speed => samples.speed.get(self.joint)?.as_deref(),
            Variable::Travel => None,
        }
    }

    /// Side from which the joint came; 0 where it is not known.
    pub(crate) fn side(self, loaded_session: &LoadedSession, sample: usize) -> f64 {
        let dir = loaded_session.session.samples.dir.get(self.joint);
        let side = dir.and_then(Option::as_ref).map_or(0.0, |dir| dir[sample]);
        if side.is_nan() { 0.0 } else { side }
    }

    /// Whether no sample has a value. Looks at all of them, at worst.
    pub(crate) fn is_missing(self, loaded_session: &LoadedSession) -> bool {
        let column = self.column(loaded_session);
        !column.is_some_and(|column| column.iter().any(|v| v.is_finite()))
    }

    /// What the session would need to be shown over it: in one line, and what to log for what.
    pub(crate) fn needs(self) -> [&'static str; 2] {
        match self.variable {
            Variable::Joint => [
                say!("No sample has a joint value"),
                say!("Every sample needs its q1 cell"),
            ],
            Variable::Time => [
                say!("No time was logged"),
                say!(
                    "A column time_s would show whether the deviation drifts while you measure, and when the tripod was touched"
                ),
            ],
            Variable::Load => [
                say!("No load was logged"),
                say!(
                    "A column load_kg would show whether the arm gives way under what it carries: measure some poses empty and the same ones loaded"
                ),
            ],
            Variable::Temperature => [
                say!("No temperature was logged"),
                say!(
                    "A column temperature_c would show whether the deviation follows the machine's warmth"
                ),
            ],
            Variable::Speed | Variable::Travel => [
                say!("The joint's motion was not logged"),
                say!(
                    "Columns speed1_deg_s and dir1 would show how the deviation follows the motion"
                ),
            ],
        }
    }

    fn turns(self, loaded_session: &LoadedSession) -> bool {
        loaded_session.joint_turns(self.joint)
    }

    /// How the variable is shown: its scale to the screen's unit, and that unit. `span` is how far
    /// it reaches, inner units.
    pub(crate) fn scale(self, loaded_session: &LoadedSession, units: Units, span: f64) -> Scale {
        let turns = self.turns(loaded_session);
        let per = Scale::per;
        let since = |factor: f64, unit: &str| Scale {
            origin: self.first(loaded_session),
            ..per(factor, unit)
        };
        match self.variable {
            Variable::Joint | Variable::Travel if turns => Scale {
                degrees: units.angle == AngleUnit::Degree,
                ..per(units.angle_value(1.0), units.angle_name().trim())
            },
            Variable::Joint | Variable::Travel => per(units.length_value(1.0), units.length_name()),
            Variable::Speed if turns => per(
                units.angle_value(1.0),
                &format!("{}/s", units.angle_name().trim()),
            ),
            Variable::Speed => per(
                units.length_value(1.0),
                &format!("{}/s", units.length_name()),
            ),
            Variable::Time if span > 3.0 * 3600.0 => since(1.0 / 3600.0, "h"),
            Variable::Time if span > 600.0 => since(1.0 / 60.0, "min"),
            Variable::Time => since(1.0, "s"),
            Variable::Load => per(1.0, "kg"),
            Variable::Temperature => per(1.0, "°C"),
        }
    }

    /// The first value that is known.
    fn first(self, loaded_session: &LoadedSession) -> f64 {
        let known = |column: &[f64]| column.iter().copied().find(|v| v.is_finite());
        self.column(loaded_session).and_then(known).unwrap_or(0.0)
    }

    /// What stands below the axis, without the unit.
    pub(crate) fn label(self, loaded_session: &LoadedSession) -> String {
        let joint = &loaded_session.session.robot.joints[self.joint].name;
        match self.variable {
            Variable::Joint => joint.clone(),
            Variable::Time if self.first(loaded_session) == 0.0 => say!("time").to_owned(),
            Variable::Time => say!("time since the first sample").to_owned(),
            Variable::Load => say!("load").to_owned(),
            Variable::Temperature => say!("temperature").to_owned(),
            Variable::Speed => say!("speed of {joint}", joint),
            Variable::Travel => say!("travel of {joint} since it reversed", joint),
        }
    }

    /// The heading of its column in a table, inner units except that a joint's angle is in degrees.
    pub(crate) fn heading(self, loaded_session: &LoadedSession) -> String {
        let turns = self.turns(loaded_session);
        let number = self.joint + 1;
        match (self.variable, turns) {
            (Variable::Joint, true) => format!("q{number}, deg"),
            (Variable::Joint, false) => format!("q{number}, mm"),
            (Variable::Time, _) => "time, s".to_owned(),
            (Variable::Load, _) => "load, kg".to_owned(),
            (Variable::Temperature, _) => "temperature, °C".to_owned(),
            (Variable::Speed, true) => format!("speed {number}, deg/s"),
            (Variable::Speed, false) => format!("speed {number}, mm/s"),
            (Variable::Travel, true) => format!("travel {number}, deg"),
            (Variable::Travel, false) => format!("travel {number}, mm"),
        }
    }

    /// A value as that table has it.
    pub(crate) fn cell(self, loaded_session: &LoadedSession, value: f64) -> f64 {
        match self.variable {
            Variable::Joint | Variable::Speed | Variable::Travel if self.turns(loaded_session) => {
                crate::units::deg_from_rad(value)
            }
            _ => value,
        }
    }
}

/// How a variable becomes a number on the screen.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// Screen units in one inner unit.
    pub(crate) factor: f64,
    /// What is zero on the screen, inner units.
    pub(crate) origin: f64,
    pub(crate) unit: String,
    /// Whether the axis is divided into parts of a turn.
    pub(crate) degrees: bool,
}

impl Scale {
    fn per(factor: f64, unit: &str) -> Self {
        Self {
            factor,
            origin: 0.0,
            unit: unit.to_owned(),
            degrees: false,
        }
    }

    /// An axis with this label, and the unit behind it.
    pub(crate) fn axis(&self, label: String) -> Axis {
        let label = match self.unit.as_str() {
            "" => label,
            unit => format!("{label}, {unit}"),
        };
        Axis::turning(label, self.degrees)
    }

    /// A value as it stands on the screen.
    pub(crate) fn shown(&self, value: f64) -> f64 {
        (value - self.origin) * self.factor
    }

    /// The value at a place of the screen.
    pub(crate) fn value_at(&self, shown: f64) -> f64 {
        shown / self.factor + self.origin
    }

    /// `36 °C`, `−90°`.
    pub(crate) fn describe(&self, value: f64) -> String {
        let number = trimmed(self.shown(value), 2);
        if self.unit == "°" {
            format!("{number}°")
        } else {
            format!("{number} {}", self.unit)
        }
    }
}

/// One quantity of the samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Quantity {
    /// What is left of a component of the deviation, or as measured: both where both are known.
    Deviation(Component),
    /// A column of the session.
    Column(Over),
    /// Where the point was measured: x, y or z, counted from 0.
    Measured(usize),
    /// The order in which the samples were measured.
    Order,
}

/// Before and after; the same where it does not change.
pub(crate) type BeforeAndAfter = (f64, Option<f64>);

impl Quantity {
    /// What a session has, in the order in which it is offered.
    pub(crate) fn offered(loaded_session: &LoadedSession) -> Vec<Self> {
        let planar = loaded_session.session.samples.z_mm.is_none();
        let components = Component::ALL.into_iter();
        let components = components.filter(|c| !(planar && c.out_of_plane()));
        let joints = 0..loaded_session.session.robot.joints.len();
        let of_joints = [Variable::Joint, Variable::Speed].into_iter();
        let of_joints = of_joints.flat_map(|variable| {
            let column = move |joint| Over { variable, joint };
            joints.clone().map(column)
        });
        let conditions = [Variable::Time, Variable::Load, Variable::Temperature];
        let conditions = conditions.map(|variable| Over { variable, joint: 0 });
        let columns = of_joints.chain(conditions);
        let columns = columns.filter(|over| !over.is_missing(loaded_session));
        let axes = if planar { 0..2 } else { 0..3 };
        components
            .map(Self::Deviation)
            .chain(columns.map(Self::Column))
            .chain(axes.map(Self::Measured))
            .chain([Self::Order])
            .collect()
    }

    /// The same of a session that has fewer joints.
    pub(crate) fn within(self, joints: usize) -> Self {
        match self {
            Self::Column(over) => Self::Column(Over {
                joint: over.joint.min(joints.saturating_sub(1)),
                ..over
            }),
            Self::Measured(axis) => Self::Measured(axis.min(2)),
            same => same,
        }
    }

    /// Whether it has another value after the identification.
    pub(crate) fn changes(self) -> bool {
        matches!(self, Self::Deviation(_))
    }

    /// Its value at a sample, inner units; NaN where it is not known.
    pub(crate) fn of(
        self,
        loaded_session: &LoadedSession,
        answer: Option<&Answer>,
        i: usize,
    ) -> BeforeAndAfter {
        let same = |value: f64| (value, Some(value));
        match self {
            Self::Deviation(component) => {
                let of = |e: [f64; 3]| loaded_session.component(e, i, component);
                let after = answer.map(|answer| of(answer.deviation_after(i)));
                (of(loaded_session.deviation_before(i)), after)
            }
            Self::Column(over) => same(over.of(loaded_session, i)),
            Self::Measured(axis) => same(loaded_session.measured(i)[axis]),
            Self::Order => same(i as f64 + 1.0),
        }
    }

    /// What it is called, without its unit.
    pub(crate) fn name(self, loaded_session: &LoadedSession) -> String {
        const AXES: [&str; 3] = ["x", "y", "z"];
        match self {
            Self::Deviation(component) => {
                say!("{component} deviation", component = component.name())
            }
            Self::Column(over) => over.label(loaded_session),
            Self::Measured(axis) => say!("measured {axis}", axis = AXES[axis]),
            Self::Order => say!("order of measuring").to_owned(),
        }
    }

    /// How it becomes a number on the screen; `span` is how far it reaches, inner units.
    pub(crate) fn scale(self, loaded_session: &LoadedSession, units: Units, span: f64) -> Scale {
        match self {
            Self::Deviation(_) | Self::Measured(_) => {
                Scale::per(units.length_value(1.0), units.length_name())
            }
            Self::Column(over) => over.scale(loaded_session, units, span),
            Self::Order => Scale::per(1.0, ""),
        }
    }

    /// The heading of its column in a table, in English.
    pub(crate) fn heading(self, loaded_session: &LoadedSession) -> String {
        match self {
            Self::Deviation(component) => format!("{} deviation, mm", component.name()),
            Self::Column(over) => over.heading(loaded_session),
            Self::Measured(axis) => format!("measured {}, mm", ["x", "y", "z"][axis]),
            Self::Order => "order".to_owned(),
        }
    }

    /// A value as that table has it.
    pub(crate) fn cell(self, loaded_session: &LoadedSession, value: f64) -> f64 {
        match self {
            Self::Column(over) => over.cell(loaded_session, value),
            _ => value,
        }
    }
}

/// The value of a joint of this kind as it is written: an angle of one that turns, a length of one that slides.
pub(crate) fn joint_value(units: Units, kind: JointKind, q: f64) -> String {
    match kind {
        JointKind::Revolute => units.angle(q),
        JointKind::Prismatic => units.length(q),
    }
}

#[cfg(test)]
mod tests {
    use crate::gui::testing::workbench;

    use super::*;

    #[test]
    fn what_was_not_logged_is_named_with_its_column_and_what_it_is_for() {
        let workbench = workbench();
        let mut session = workbench.loaded_session().session.clone();
        session.samples.load_kg = None;
        session.samples.temperature_c = Some(vec![f64::NAN; session.samples.len()]);
        let loaded_session = LoadedSession::new(
            session,
            Vec::new(),
            workbench.loaded_session().origin.clone(),
        );
        let over = |variable| Over { variable, joint: 0 };
        for (variable, column) in [
            (Variable::Load, "load_kg"),
            (Variable::Temperature, "temperature_c"),
        ] {
            assert!(over(variable).is_missing(&loaded_session));
            let [_, why] = over(variable).needs();
            assert!(why.contains(column), "{why}");
            assert!(over(variable).of(&loaded_session, 0).is_nan());
        }
        assert!(!over(Variable::Joint).is_missing(&loaded_session));
    }

    #[test]
    fn time_is_shown_in_a_unit_that_can_be_read() {
        let workbench = workbench();
        let over = Over {
            variable: Variable::Time,
            joint: 0,
        };
        let unit = |span: f64| {
            let scale = over.scale(workbench.loaded_session(), Units::default(), span);
            (scale.unit.clone(), scale.describe(scale.origin + span))
        };
        assert_eq!(unit(90.0), ("s".to_owned(), "90 s".to_owned()));
        assert_eq!(unit(3600.0), ("min".to_owned(), "60 min".to_owned()));
        assert_eq!(unit(36_000.0), ("h".to_owned(), "10 h".to_owned()));
    }
}
