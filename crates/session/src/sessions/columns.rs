//! What a heading says: a quantity and, in its last part, the unit.
//!
//! `q1_deg` is the commanded value of the first joint in degrees, `speed1_deg_s` its speed. The
//! units `_m`, `_mm`, `_um`, `_in`, `_deg` and `_rad` are understood; inside they become mm and
//! rad. A revolute joint takes angles only and a prismatic one lengths only.

use crate::kinematics::{Joint, JointKind};
use crate::tables::CellKind;
use crate::text::Text;
use crate::units::{LARGEST_LENGTH_MM, LARGEST_NUMBER, LARGEST_TIME_S, rad_from_deg};

/// What a column holds. Joints count from 0 here and from 1 in headings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    Commanded(usize),
    ReadBack(usize),
    X,
    Y,
    Z,
    /// Component of the measured orientation: w, x, y, z.
    Orientation(usize),
    Distance,
    Azimuth,
    Elevation,
    Anchor,
    Station,
    Plane,
    Socket,
    Target,
    Direction(usize),
    Speed(usize),
    /// Measured torque of a joint.
    Torque(usize),
    /// Temperature of a joint.
    JointTemperature(usize),
    Load,
    Temperature,
    Time,
    Setup,
    Use,
}

/// What a row may have in the place of a point.
pub(crate) const BESIDE_POINTS: [Quantity; 5] = [
    Quantity::Distance,
    Quantity::Azimuth,
    Quantity::Plane,
    Quantity::Socket,
    Quantity::Orientation(0),
];

/// A column of a session: what is read, written and kept as it stands here, in the order in which
/// files have them.
struct ColumnDeclaration {
    /// Its heading: `#` stands for the number of a joint, `~` for a unit.
    heading: &'static str,
    takes: AcceptedUnits,
    cells: CellKind,
    /// What it holds, for a joint where it is one's.
    of: fn(usize) -> Quantity,
}

/// The units that a heading may end in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum AcceptedUnits {
    Length,
    Angle,
    /// A length or an angle, as the joint slides or turns.
    OfJoint,
    /// Only the one that is in its name.
    Fixed,
}

const COLUMNS: &[ColumnDeclaration] = &{
    use AcceptedUnits::{Angle, Fixed, Length, OfJoint};
    use CellKind::{Name, Number};
    const fn column(
        heading: &'static str,
        takes: AcceptedUnits,
        cells: CellKind,
        of: fn(usize) -> Quantity,
    ) -> ColumnDeclaration {
        ColumnDeclaration {
            heading,
            takes,
            cells,
            of,
        }
    }
    [
        column("q#_~", OfJoint, Number, Quantity::Commanded),
        column("q#_read_~", OfJoint, Number, Quantity::ReadBack),
        column("x_~", Length, Number, |_| Quantity::X),
        column("y_~", Length, Number, |_| Quantity::Y),
        column("z_~", Length, Number, |_| Quantity::Z),
        column("qw", Fixed, Number, |_| Quantity::Orientation(0)),
        column("qx", Fixed, Number, |_| Quantity::Orientation(1)),
        column("qy", Fixed, Number, |_| Quantity::Orientation(2)),
        column("qz", Fixed, Number, |_| Quantity::Orientation(3)),
        column("distance_~", Length, Number, |_| Quantity::Distance),
        column("azimuth_~", Angle, Number, |_| Quantity::Azimuth),
        column("elevation_~", Angle, Number, |_| Quantity::Elevation),
        column("anchor", Fixed, Name, |_| Quantity::Anchor),
        column("station", Fixed, Name, |_| Quantity::Station),
        column("plane", Fixed, Name, |_| Quantity::Plane),
        column("socket", Fixed, Name, |_| Quantity::Socket),
        column("target", Fixed, Name, |_| Quantity::Target),
        column("dir#", Fixed, Number, Quantity::Direction),
        column("speed#_~_s", OfJoint, Number, Quantity::Speed),
        column("torque#_nm", Fixed, Number, Quantity::Torque),
        column("temperature#_c", Fixed, Number, Quantity::JointTemperature),
        column("load_kg", Fixed, Number, |_| Quantity::Load),
        column("temperature_c", Fixed, Number, |_| Quantity::Temperature),
        column("time_s", Fixed, Number, |_| Quantity::Time),
        column("setup", Fixed, Name, |_| Quantity::Setup),
        column("use", Fixed, Name, |_| Quantity::Use),
    ]
};

impl ColumnDeclaration {
    /// The quantity and the unit of a heading that is this column's.
    fn read(&self, heading: &str) -> Option<(Quantity, Unit)> {
        let (name, own, unit) = match self.heading.split_once("_~") {
            None => (heading, self.heading, Unit::Fixed),
            Some((own, after)) => {
                let (name, unit) = heading.strip_suffix(after)?.rsplit_once('_')?;
                (name, own, Unit::from_suffix(unit)?)
            }
        };
        let joint = match own.split_once('#') {
            Some((before, after)) => joint_index(name.strip_prefix(before)?.strip_suffix(after)?)?,
            None => (name == own).then_some(0)?,
        };
        let fits = match self.takes {
            AcceptedUnits::Length => matches!(unit, Unit::Length(_)),
            AcceptedUnits::Angle => matches!(unit, Unit::Angle(_)),
            AcceptedUnits::OfJoint | AcceptedUnits::Fixed => true,
        };
        fits.then(|| ((self.of)(joint), unit))
    }
}

/// The largest size of a quantity's numbers, and how a person says it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ValueRange {
    pub(crate) largest: f64,
    said: &'static str,
}

impl ValueRange {
    /// What to expect instead of a larger one.
    pub(crate) fn expected(self) -> Text {
        text!("a number of at most {most}", most = self.said)
    }
}

impl Quantity {
    /// Every column that a session of so many joints can have, in the order of files.
    pub(crate) fn all(joints: usize) -> impl Iterator<Item = Self> {
        COLUMNS.iter().flat_map(move |column| {
            let joints = if column.heading.contains('#') {
                joints
            } else {
                1
            };
            (0..joints).map(column.of)
        })
    }

    fn declared(self) -> &'static ColumnDeclaration {
        let of = |column: &&ColumnDeclaration| (column.of)(self.joint().unwrap_or(0)) == self;
        COLUMNS.iter().find(of).expect("a column for each quantity")
    }

    /// The range of its numbers, in inner units: what is beyond it is no measurement.
    pub(crate) fn range(self, unit: Unit) -> ValueRange {
        let angle = matches!(unit, Unit::Angle(_));
        let (largest, said) = match self {
            Self::Commanded(_) | Self::ReadBack(_) if !angle => (LARGEST_NUMBER, "1 000 000 mm"),
            Self::Commanded(_) | Self::ReadBack(_) | Self::Azimuth | Self::Elevation => {
                (rad_from_deg(LARGEST_NUMBER), "1 000 000°")
            }
            Self::X | Self::Y | Self::Z | Self::Distance => (LARGEST_LENGTH_MM, "10 000 000 mm"),
            Self::Load => (LARGEST_NUMBER, "1 000 000 kg"),
            Self::Temperature | Self::JointTemperature(_) => (1e6, "1 000 000 °C"),
            Self::Time => (LARGEST_TIME_S, "1e20 s"),
            Self::Orientation(_) => (1e6, "1 000 000"),
            Self::Speed(_) | Self::Torque(_) => (1e9, "1 000 000 000"),
            _ => (f64::MAX, "1.8e308"),
        };
        ValueRange { largest, said }
    }

    /// Whether its cells are names.
    pub(crate) fn is_named(self) -> bool {
        self.declared().cells == CellKind::Name
    }

    /// The joint that it belongs to.
    pub(crate) fn joint(self) -> Option<usize> {
        match self {
            Self::Commanded(joint)
            | Self::ReadBack(joint)
            | Self::Speed(joint)
            | Self::Torque(joint)
            | Self::JointTemperature(joint)
            | Self::Direction(joint) => Some(joint),
            _ => None,
        }
    }

    /// Its heading; without a unit where that is not known or not one of a session's.
    pub fn heading(self, unit: Option<Unit>) -> String {
        let heading = self.declared().heading;
        let heading = match (heading.split_once("_~"), unit.and_then(Unit::suffix)) {
            (None, _) => heading.to_owned(),
            (Some((name, after)), Some(unit)) => format!("{name}_{unit}{after}"),
            (Some((name, _)), None) => name.to_owned(),
        };
        let number = self.joint().map_or(0, |joint| joint + 1);
        heading.replace('#', &number.to_string())
    }

    /// The unit in which files are written: degrees for angles, mm for lengths.
    pub fn written_in(self, joints: &[Joint]) -> Unit {
        let turns = match self.declared().takes {
            AcceptedUnits::Length => false,
            AcceptedUnits::Angle => true,
            AcceptedUnits::OfJoint => self
                .joint()
                .is_some_and(|k| joints[k].kind == JointKind::Revolute),
            AcceptedUnits::Fixed => return Unit::Fixed,
        };
        if turns {
            Unit::Angle(rad_from_deg(1.0))
        } else {
            Unit::Length(1.0)
        }
    }

    /// Whether it means something only beside what a session declares: an anchor, a station …
    pub(crate) fn needs_a_reference(self) -> bool {
        use Quantity::{Anchor, Azimuth, Distance, Elevation, Plane, Socket, Station};
        matches!(
            self,
            Distance | Azimuth | Elevation | Anchor | Station | Plane | Socket
        )
    }
}

/// A unit in a heading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unit {
    Length(f64),
    Angle(f64),
    /// The only unit that the quantity has.
    Fixed,
}

impl Unit {
    /// The inner unit of a joint's values.
    pub(crate) fn inner(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Self::Angle(1.0),
            JointKind::Prismatic => Self::Length(1.0),
        }
    }

    /// The units that headings end in.
    fn all() -> [(&'static str, Self); 6] {
        [
            ("m", Self::Length(1000.0)),
            ("mm", Self::Length(1.0)),
            ("um", Self::Length(1e-3)),
            ("in", Self::Length(25.4)),
            ("deg", Self::Angle(rad_from_deg(1.0))),
            ("rad", Self::Angle(1.0)),
        ]
    }

    pub(crate) fn from_suffix(suffix: &str) -> Option<Self> {
        let found = Self::all().into_iter().find(|(own, _)| *own == suffix);
        found.map(|(_, unit)| unit)
    }

    pub(crate) fn suffix(self) -> Option<&'static str> {
        let found = Self::all().into_iter().find(|(_, unit)| *unit == self);
        found.map(|(suffix, _)| suffix)
    }

    /// How many inner units (mm, rad) one of these is.
    pub fn factor(self) -> f64 {
        match self {
            Self::Length(factor) | Self::Angle(factor) => factor,
            Self::Fixed => 1.0,
        }
    }
}

/// A heading that is understood, or not.
#[derive(Debug, Clone, PartialEq)]
pub enum Heading {
    Known(Quantity, Unit),
    /// Kept and ignored; the hint says what it might have been meant to be.
    Unknown {
        hint: Option<String>,
    },
}

impl Heading {
    pub(crate) fn cells(&self) -> CellKind {
        match self {
            Self::Unknown { .. } => CellKind::Text,
            Self::Known(quantity, _) => quantity.declared().cells,
        }
    }

    /// Reads a heading by itself, without knowing the robot.
    pub fn read(heading: &str) -> Self {
        recognized(heading).map_or_else(
            || Self::Unknown {
                hint: hint(heading),
            },
            |(quantity, unit)| Self::Known(quantity, unit),
        )
    }
}

fn recognized(heading: &str) -> Option<(Quantity, Unit)> {
    COLUMNS.iter().find_map(|column| column.read(heading))
}

/// The joint's index from its number in a heading: `1` is the first; `01` and `0` are no numbers.
fn joint_index(number: &str) -> Option<usize> {
    let plain = number.len() <= 4
        && !number.starts_with('0')
        && number.bytes().all(|byte| byte.is_ascii_digit());
    if plain {
        number.parse::<usize>().ok()?.checked_sub(1)
    } else {
        None
    }
}

/// What an unknown heading may have been meant to be.
fn hint(heading: &str) -> Option<String> {
    let plain = heading.trim().to_ascii_lowercase().replace(' ', "_");
    if plain != heading && recognized(&plain).is_some() {
        return Some(format!("'{plain}'"));
    }
    let name = match plain.split(['_', '[', '(']).next().unwrap_or_default() {
        "temp" => "temperature",
        "t" => "time",
        name => name,
    };
    COLUMNS.iter().find_map(|column| {
        let (own, unit) = column.heading.split_once('_')?;
        match own.strip_suffix('#') {
            Some(own) => joint_index(name.strip_prefix(own)?).map(|_| ())?,
            None => (name == own).then_some(())?,
        }
        let units: &[&str] = match column.takes {
            AcceptedUnits::Length => &["mm", "m", "um", "in"],
            AcceptedUnits::Angle => &["deg", "rad"],
            AcceptedUnits::OfJoint => &["deg", "rad", "mm"],
            AcceptedUnits::Fixed => &[""],
        };
        let meant = units.iter();
        let meant = meant.map(|one| format!("{name}_{}", unit.replace('~', one)));
        Some(meant.collect::<Vec<_>>().join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_carry_quantity_and_unit() {
        let unit = |heading| match Heading::read(heading) {
            Heading::Known(quantity, unit) => Some((quantity, unit.factor())),
            Heading::Unknown { .. } => None,
        };
        assert_eq!(unit("q1_rad"), Some((Quantity::Commanded(0), 1.0)));
        assert_eq!(
            unit("q12_read_deg"),
            Some((Quantity::ReadBack(11), rad_from_deg(1.0)))
        );
        assert_eq!(unit("x_in"), Some((Quantity::X, 25.4)));
        assert_eq!(unit("speed2_mm_s"), Some((Quantity::Speed(1), 1.0)));
        assert_eq!(unit("dir3"), Some((Quantity::Direction(2), 1.0)));
        assert_eq!(unit("torque2_nm"), Some((Quantity::Torque(1), 1.0)));
        assert_eq!(
            unit("temperature4_c"),
            Some((Quantity::JointTemperature(3), 1.0))
        );
        assert_eq!(unit("temperature_c"), Some((Quantity::Temperature, 1.0)));
        for stranger in [
            "x",
            "x_deg",
            "q0_deg",
            "q01_deg",
            "qx_mm",
            "speed1_deg",
            "torque1",
            "torque_nm",
            "temperature0_c",
            "dir",
            "",
            "_mm",
        ] {
            assert_eq!(unit(stranger), None, "{stranger}");
        }
    }
}
