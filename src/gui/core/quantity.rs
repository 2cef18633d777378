//! What a scatter can have along an axis: any column of the session, where the point was measured,
//! a component of the deviation, the order of measuring.

use serde::{Deserialize, Serialize};

use super::answer::Answer;
use super::loaded_session::{Component, LoadedSession};
use super::over::{Over, Scale, Variable};
use crate::present::units::Units;

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
        let per = |factor: f64, unit: &str| Scale {
            factor,
            origin: 0.0,
            unit: unit.to_owned(),
            degrees: false,
        };
        match self {
            Self::Deviation(_) | Self::Measured(_) => {
                per(units.length_value(1.0), units.length_name())
            }
            Self::Column(over) => over.scale(loaded_session, units, span),
            Self::Order => per(1.0, ""),
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
