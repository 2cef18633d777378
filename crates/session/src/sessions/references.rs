//! What measurements other than points refer to: anchors of distances, stations of directions,
//! planes that are touched, sockets that a target is put into, the axis that points.
//!
//! All places are in the measuring frame, mm. What is not known is `None` and is fitted.

use nalgebra::{Point3, Unit, UnitQuaternion, Vector3};

use super::columns::Quantity;

/// A fixed point from which distances are measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Anchor {
    /// Its name in the file.
    pub name: String,
    /// Where it is, mm; `None`: unknown.
    pub position_mm: Option<Point3<f64>>,
    /// What the instrument shows beyond the distance, mm; `None`: unknown.
    pub offset_mm: Option<f64>,
}

named! {
    /// Which way azimuths count, seen from the station's +z.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Azimuth {
        /// From x towards y.
        #[default]
        Counterclockwise = "counterclockwise",
        /// From x away from y, as theodolites count.
        Clockwise = "clockwise",
    }
    /// The word in files.
    pub fn name;
}

impl Azimuth {
    /// +1 or −1: an azimuth in the counterclockwise sense is this times the one that is shown.
    pub fn sign(self) -> f64 {
        match self {
            Self::Counterclockwise => 1.0,
            Self::Clockwise => -1.0,
        }
    }
}

/// An instrument that measures directions: a theodolite, a camera, a telescope's mount.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// Its name in the file.
    pub name: String,
    /// Where it stands, mm; `None`: unknown.
    pub position_mm: Option<Point3<f64>>,
    /// Its attitude: turns the station's axes into the measuring frame's; `None`: unknown.
    pub attitude: Option<UnitQuaternion<f64>>,
    /// Which way azimuths count.
    pub azimuth: Azimuth,
}

/// A flat that is touched: all points p with n·p = d.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Its name in the file.
    pub name: String,
    /// Normal and distance from the origin along it, mm; `None`: unknown.
    pub stated: Option<(Unit<Vector3<f64>>, f64)>,
}

/// A cup that holds a target in one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Socket {
    /// Its name in the file.
    pub name: String,
    /// Where it is, mm; `None`: unknown.
    pub position_mm: Option<Point3<f64>>,
}

/// A known distance between two sockets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SocketDistance {
    /// Indices of the sockets.
    pub between: [usize; 2],
    /// The distance, mm.
    pub distance_mm: f64,
}

/// What points where the azimuths and elevations say, without regard to where it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Pointing {
    /// The direction in the tool frame, a unit vector.
    pub axis: Unit<Vector3<f64>>,
    /// Indices of the stations whose angles are those of the axis; `None`: of every row.
    pub stations: Option<Vec<usize>>,
}

/// Anchors, stations, planes and sockets of a session, in the measuring frame, mm.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct References {
    /// Anchors of distances.
    pub anchors: Vec<Anchor>,
    /// Stations of directions.
    pub stations: Vec<Station>,
    /// Planes that are touched.
    pub planes: Vec<Plane>,
    /// Sockets.
    pub sockets: Vec<Socket>,
    /// Known distances between sockets.
    pub socket_distances: Vec<SocketDistance>,
    /// What points, where something does.
    pub pointing: Option<Pointing>,
}

impl References {
    /// The names that are declared of what the cells of a column name.
    pub(crate) fn named(&self, quantity: Quantity) -> Vec<&str> {
        match quantity {
            Quantity::Anchor => names(&self.anchors, |a| &a.name),
            Quantity::Station => names(&self.stations, |s| &s.name),
            Quantity::Plane => names(&self.planes, |p| &p.name),
            Quantity::Socket => names(&self.sockets, |s| &s.name),
            _ => Vec::new(),
        }
    }
}

fn names<T>(all: &[T], name: fn(&T) -> &String) -> Vec<&str> {
    all.iter().map(|one| name(one).as_str()).collect()
}

/// The columns of measurements other than points, one value for each sample. A missing number is
/// NaN and a missing name `None`; a column that the file does not have is `None`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ObservedColumns {
    /// Measured distance, mm.
    pub distance_mm: Option<Vec<f64>>,
    /// Index into the anchors.
    pub anchor: Option<Vec<Option<u32>>>,
    /// Measured azimuth, rad.
    pub azimuth: Option<Vec<f64>>,
    /// Measured elevation, rad.
    pub elevation: Option<Vec<f64>>,
    /// Index into the stations.
    pub station: Option<Vec<Option<u32>>>,
    /// Index into the planes: the target touches it.
    pub plane: Option<Vec<Option<u32>>>,
    /// Index into the sockets: the target sits in it.
    pub socket: Option<Vec<Option<u32>>>,
}

/// One of these columns.
pub struct ObservedColumn<C> {
    /// What it holds.
    pub(crate) quantity: Quantity,
    /// What it is called in the hash of a session's samples.
    pub(crate) label: &'static str,
    pub values: C,
}

/// Columns from one list: what each holds, its label in the hash, its field.
macro_rules! columns {
    ($all:ident $all_mut:ident, $count:literal of $cell:ty: $($quantity:ident $label:literal $column:ident,)*) => {
        #[doc(hidden)]
        pub fn $all(&self) -> [ObservedColumn<&Option<Vec<$cell>>>; $count] {
            [$(ObservedColumn { quantity: Quantity::$quantity, label: $label, values: &self.$column }),*]
        }

        /// The same, to be changed.
        pub(crate) fn $all_mut(&mut self) -> [ObservedColumn<&mut Option<Vec<$cell>>>; $count] {
            [$(ObservedColumn { quantity: Quantity::$quantity, label: $label, values: &mut self.$column }),*]
        }
    };
}

/// Whatever is done to every column asks these lists; the compiler finds a column that is missing here only where rows
/// are picked (`rows.rs`).
impl ObservedColumns {
    columns!(numbers numbers_mut, 3 of f64:
        Distance "distance" distance_mm,
        Azimuth "azimuth" azimuth,
        Elevation "elevation" elevation,
    );
    columns!(names names_mut, 4 of Option<u32>:
        Anchor "anchor" anchor,
        Station "station" station,
        Plane "plane" plane,
        Socket "socket" socket,
    );

    /// Whether no sample has anything here.
    pub fn is_empty(&self) -> bool {
        let names = [&self.plane, &self.socket];
        let number =
            |c: ObservedColumn<&Option<Vec<f64>>>| c.values.iter().flatten().any(|v| !v.is_nan());
        let name = |c: &&Option<Vec<Option<u32>>>| c.iter().flatten().any(Option::is_some);
        !self.numbers().into_iter().any(number) && !names.iter().any(name)
    }

    /// The values that a column of numbers has.
    pub(crate) fn values(&self, quantity: Quantity) -> Option<&[f64]> {
        let mut columns = self.numbers().into_iter();
        let column = columns.find(|column| column.quantity == quantity)?;
        column.values.as_deref()
    }

    /// The indices that a column of names has.
    pub(crate) fn indices(&self, quantity: Quantity) -> Option<&Vec<Option<u32>>> {
        let mut columns = self.names().into_iter();
        let column = columns.find(|column| column.quantity == quantity)?;
        column.values.as_ref()
    }

    /// Whether a sample has something here that can be used.
    pub fn has(&self, sample: usize) -> bool {
        let number = |c: &Option<Vec<f64>>| {
            c.as_ref()
                .and_then(|v| v.get(sample))
                .is_some_and(|v| !v.is_nan())
        };
        let name = |c: &Option<Vec<Option<u32>>>| {
            let cell = c.as_ref().and_then(|v| v.get(sample));
            cell.is_some_and(Option::is_some)
        };
        let direction = number(&self.azimuth) && number(&self.elevation);
        // One angle alone is no direction.
        let alone =
            |c: &ObservedColumn<_>| !matches!(c.quantity, Quantity::Azimuth | Quantity::Elevation);
        let mut others = self.numbers().into_iter().filter(alone);
        direction
            || others.any(|column| number(column.values))
            || name(&self.plane)
            || name(&self.socket)
    }
}
