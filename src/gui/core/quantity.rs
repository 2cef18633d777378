//! What a chart of samples has along its axes: the value of a joint, time, load, temperature; for an effect
//! also the joint's speed and its travel since the last reversal.

use crate::kinematics::JointKind;
use crate::present::chart::Axis;
use crate::present::units::{AngleUnit, Units};

use super::loaded_session::LoadedSession;

/// What a chart of samples stands over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

    /// What the session would need to be shown over it: in one line, and what to log.
    pub(crate) fn needs(self) -> [String; 2] {
        let column = match self.variable {
            Variable::Joint => "q1_deg",
            Variable::Time => "time_s",
            Variable::Load => "load_kg",
            Variable::Temperature => "temperature_c",
            Variable::Speed => "speed1_deg_s",
            Variable::Travel => "dir1",
        };
        [
            say!("It was not logged").to_owned(),
            say!(
                "A column {column} would show whether the deviation follows it",
                column
            ),
        ]
    }

    /// How the variable is shown: its scale to the screen's unit, and that unit. `span` is how far
    /// it reaches, inner units.
    pub(crate) fn scale(self, loaded_session: &LoadedSession, units: Units, span: f64) -> Scale {
        let per = Scale::per;
        let joint = Scale::of_joint(units, loaded_session.joint_turns(self.joint));
        let since = |factor: f64, unit: &str| Scale {
            origin: self.first(loaded_session),
            ..per(factor, unit)
        };
        match self.variable {
            Variable::Joint | Variable::Travel => joint,
            Variable::Speed => per(joint.factor, &format!("{}/s", joint.unit)),
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
        let number = self.joint + 1;
        let unit = loaded_session.session.robot.joints[self.joint].kind.unit();
        match self.variable {
            Variable::Joint => format!("q{number}, {unit}"),
            Variable::Time => "time, s".to_owned(),
            Variable::Load => "load, kg".to_owned(),
            Variable::Temperature => "temperature, °C".to_owned(),
            Variable::Speed => format!("speed {number}, {unit}/s"),
            Variable::Travel => format!("travel {number}, {unit}"),
        }
    }

    /// A value as that table has it.
    pub(crate) fn cell(self, loaded_session: &LoadedSession, value: f64) -> f64 {
        match self.variable {
            Variable::Joint | Variable::Speed | Variable::Travel => {
                loaded_session.session.robot.joints[self.joint]
                    .kind
                    .to_display(value)
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

    /// That of the values of a joint.
    pub(crate) fn of_joint(units: Units, turns: bool) -> Self {
        if !turns {
            return Self::length(units);
        }
        Self {
            degrees: units.angle == AngleUnit::Degree,
            ..Self::per(units.angle_value(1.0), units.angle_name().trim())
        }
    }

    /// That of lengths.
    pub(crate) fn length(units: Units) -> Self {
        Self::per(units.length_value(1.0), units.length_name())
    }

    /// An axis with this label, and the unit behind it.
    pub(crate) fn axis(&self, label: &str) -> Axis {
        Axis::turning(format!("{label}, {}", self.unit), self.degrees)
    }

    /// A value as it stands on the screen.
    pub(crate) fn shown(&self, value: f64) -> f64 {
        (value - self.origin) * self.factor
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
            let [_, why] = over(variable).needs();
            assert!(why.contains(column), "{why}");
            assert!(over(variable).of(&loaded_session, 0).is_nan());
        }
        assert!(over(Variable::Joint).of(&loaded_session, 0).is_finite());
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
            (scale.unit.clone(), scale.shown(scale.origin + span).round())
        };
        assert_eq!(unit(90.0), ("s".to_owned(), 90.0));
        assert_eq!(unit(3600.0), ("min".to_owned(), 60.0));
        assert_eq!(unit(36_000.0), ("h".to_owned(), 10.0));
    }
}
