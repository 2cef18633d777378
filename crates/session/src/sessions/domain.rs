//! A measurement session: the robot, how it was measured, and every sample.
//!
//! These are the types that the program thinks in, in inner units (mm, rad, s, kg, °C); files on
//! disk have types of their own in `format_v1`.

use crate::kinematics::Robot;
use crate::sessions::correction::Corrected;
use crate::sessions::references::{ObservedColumns, References};
use crate::tables::Lines;
use nalgebra::Point3;
use std::path::PathBuf;

/// A reflector that the instrument sees, fixed in the tool frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// Its name in the file.
    pub name: String,
    /// Where it sits in the tool frame, mm.
    pub position_mm: Point3<f64>,
}

/// What the instrument's maker or the technician says about its noise, one standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sigma {
    /// Root mean square over the axes; the ratio between the axes is not known.
    Overall(f64),
    /// One number for each of x, y, z.
    PerAxis([f64; 3]),
}

impl Sigma {
    /// The same with more noise along each of so many axes, mm, none of which says anything of the other.
    /// A number for all axes stays one: the ratio between them is estimated.
    #[must_use]
    pub(crate) fn widened(self, by_mm: [f64; 3], axes: usize) -> Self {
        match self {
            Self::Overall(sigma) => {
                let squares: f64 = by_mm[..axes].iter().map(|by| by * by).sum();
                Self::Overall(sigma.hypot((squares / axes as f64).sqrt()))
            }
            Self::PerAxis(sigma) => {
                Self::PerAxis(std::array::from_fn(|axis| sigma[axis].hypot(by_mm[axis])))
            }
        }
    }
}

/// The measuring instrument.
#[derive(Debug, Clone, PartialEq)]
pub struct Instrument {
    /// What it is called.
    pub name: String,
    /// Its noise in mm, where it is known.
    pub sigma_mm: Option<Sigma>,
    /// How well the targets' own places in the tool frame are known, mm; `None`: not at all.
    pub targets_sigma_mm: Option<f64>,
    /// Names of the targets of which the place is not known, however well those of the others are.
    pub free_targets: Vec<String>,
    /// What a tracker's points come from, where it is known: then it replaces `sigma_mm`.
    pub tracker: Option<Tracker>,
    /// Noise of a measured orientation about each axis, rad.
    pub sigma_orientation: Option<f64>,
    /// Noise of a measured distance, mm.
    pub sigma_distance_mm: Option<f64>,
    /// Noise of a measured direction, rad.
    pub sigma_direction: Option<f64>,
    /// Noise of a touch, mm.
    pub sigma_touch_mm: Option<f64>,
    /// What measurements other than points refer to.
    pub references: References,
}

/// A laser tracker: its noise is a length along the beam and an angle across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tracker {
    /// Noise of the range, mm.
    pub sigma_range_mm: f64,
    /// Noise of each angle, rad.
    pub sigma_angle: f64,
    /// Where the tracker stands in the measuring frame, mm.
    pub position_mm: Point3<f64>,
}

/// How well the targets' own places are known by default, mm.
pub(crate) const TARGETS_SIGMA_MM: f64 = 0.05;

impl Default for Instrument {
    fn default() -> Self {
        Self {
            name: String::new(),
            sigma_mm: None,
            targets_sigma_mm: Some(TARGETS_SIGMA_MM),
            free_targets: Vec::new(),
            tracker: None,
            sigma_orientation: None,
            sigma_distance_mm: None,
            sigma_direction: None,
            sigma_touch_mm: None,
            references: References::default(),
        }
    }
}

/// A range of the joint angle that gets a correction of its own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Region {
    /// Its name in tables.
    pub name: String,
    /// Lower end, rad.
    pub from_rad: f64,
    /// Upper end, rad; larger than the lower.
    pub to_rad: f64,
}

/// A column that the program does not know: kept, reported and ignored.
#[derive(Debug, Clone, PartialEq)]
pub struct UnknownColumn {
    /// Its heading.
    pub name: String,
    /// Its cells as they stand in the file, one per sample.
    pub cells: Vec<String>,
}

/// Which free measuring frame each sample was taken in.
#[derive(Debug, Clone, PartialEq)]
pub struct Setups {
    /// Names, in the order in which they first occur.
    pub names: Vec<String>,
    /// Index into `names` for each sample.
    pub index: Vec<u32>,
}

impl Setups {
    /// Which setups have one of these samples.
    #[doc(hidden)]
    pub fn seen_in(&self, samples: impl Iterator<Item = usize>) -> Vec<bool> {
        let mut seen = vec![false; self.names.len()];
        for setup in samples.filter_map(|sample| self.index.get(sample)) {
            if let Some(seen) = seen.get_mut(*setup as usize) {
                *seen = true;
            }
        }
        seen
    }

    /// Whether the setup of a sample is among those that [`seen_in`](Self::seen_in) has found.
    #[doc(hidden)]
    pub fn is_seen(&self, seen: &[bool], sample: usize) -> bool {
        let setup = self.index.get(sample);
        setup.is_some_and(|setup| seen.get(*setup as usize) == Some(&true))
    }
}

/// The measured samples as columns, in measuring order. Every column has [`Samples::len`] values.
/// A missing cell is NaN (`None` for a column that is not there at all); nothing else is NaN and
/// nothing is infinite.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Samples {
    /// Commanded joint values, one column per joint; rad or mm.
    pub q: Vec<Vec<f64>>,
    /// Joint values read back from the controller, rad or mm, where the file has them.
    pub q_read: Vec<Option<Vec<f64>>>,
    /// Measured x in the measuring frame, mm.
    pub x_mm: Vec<f64>,
    /// Measured y, mm.
    pub y_mm: Vec<f64>,
    /// Measured z, mm; `None` in a planar session.
    pub z_mm: Option<Vec<f64>>,
    /// Measured orientation of the tool in the measuring frame as w, x, y, z columns of unit
    /// quaternions.
    pub orientation_wxyz: Option<[Vec<f64>; 4]>,
    /// Measurements other than points: distances, directions, touches, sockets.
    pub observed: ObservedColumns,
    /// Index into the session's targets; `None`: all samples see the first.
    pub target: Option<Vec<u32>>,
    /// Side from which each joint came: +1 moving positive, −1, 0 unknown.
    pub dir: Vec<Option<Vec<f64>>>,
    /// Signed joint speed while measuring, rad/s or mm/s; 0 at standstill.
    pub speed: Vec<Option<Vec<f64>>>,
    /// Measured torque about each joint (along it, where it slides), N·m (N): positive where it
    /// pushes the joint to larger values. Fewer columns than joints: the others were not measured.
    pub torque_nm: Vec<Option<Vec<f64>>>,
    /// Temperature of each joint, °C. Fewer columns than joints: as `torque_nm`.
    pub joint_temperature_c: Vec<Option<Vec<f64>>>,
    /// Load at the tool's origin, kg.
    pub load_kg: Option<Vec<f64>>,
    /// Temperature, °C.
    pub temperature_c: Option<Vec<f64>>,
    /// Time of the sample, s.
    pub time_s: Option<Vec<f64>>,
    /// Free measuring frames.
    pub setups: Option<Setups>,
    /// True where the file says `held-out`; `None` without a `use` column.
    pub held_out: Option<Vec<bool>>,
    /// True where the file says `excluded`: a person took the sample out, and it counts in no fit and
    /// no figure; `None` where none is.
    pub excluded: Option<Vec<bool>>,
    /// Set-up corrections that were made in memory; `None` where the samples are as they were read.
    pub corrected: Option<Corrected>,
    /// Columns that are kept but not understood.
    pub unknown: Vec<UnknownColumn>,
    /// Line in the samples file of each sample, so that a finding can name its place;
    /// empty for inline or simulated samples, where a sample is named by its number.
    pub line: Lines,
}

impl Samples {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.x_mm.len()
    }

    /// Number of coordinates that a point of this session has: two in a planar one.
    pub fn axes(&self) -> usize {
        if self.z_mm.is_some() { 3 } else { 2 }
    }

    /// Whether there is no sample at all (a valid session has one).
    pub fn is_empty(&self) -> bool {
        self.x_mm.is_empty()
    }

    /// Samples where the instrument says exactly (0, 0, 0): it had lost the reflector.
    pub fn lost_reflector(&self) -> Vec<usize> {
        let z_is_zero = |i: usize| self.z_mm.as_ref().is_none_or(|z| cell(z, i) == 0.0);
        (0..self.len())
            .filter(|&i| self.x_mm[i] == 0.0 && cell(&self.y_mm, i) == 0.0 && z_is_zero(i))
            .collect()
    }

    /// Whether a person took this sample out.
    pub fn is_excluded(&self, sample: usize) -> bool {
        let out = self.excluded.as_ref().and_then(|all| all.get(sample));
        out.copied().unwrap_or(false)
    }

    /// Samples that a person took out, in ascending order.
    pub fn excluded_by_hand(&self) -> Vec<usize> {
        let all = self.excluded.iter().flatten().enumerate();
        all.filter_map(|(sample, out)| out.then_some(sample))
            .collect()
    }

    /// Samples without a commanded value, or with nothing measured: they are kept, but no fit can
    /// use them.
    pub fn incomplete(&self) -> Vec<usize> {
        let mut columns = self.q.iter().chain([&self.x_mm, &self.y_mm]);
        if !columns.any(|column| has_missing(column)) {
            return Vec::new();
        }
        (0..self.len())
            .filter(|&i| {
                let point = self.coordinates(i).iter().any(|v| !v.is_nan());
                let measured = point || self.observed.has(i) || self.is_turned(i);
                self.q.iter().any(|q| cell(q, i).is_nan()) || !measured
            })
            .collect()
    }

    /// Samples of whose point some coordinates were measured and others not.
    pub fn partly_measured(&self) -> Vec<usize> {
        let axes = self.axes();
        (0..self.len())
            .filter(|&i| {
                let own = &self.coordinates(i)[..axes];
                own.iter().any(|v| v.is_nan()) && own.iter().any(|v| !v.is_nan())
            })
            .collect()
    }

    /// Spread of the measured points about their mean, root mean square length, mm; 0 without points.
    #[doc(hidden)]
    pub fn spread_mm(&self) -> f64 {
        let columns = [&self.x_mm, &self.y_mm].into_iter().chain(&self.z_mm);
        let variance = columns.map(|column| {
            let known = || column.iter().copied().filter(|v| v.is_finite());
            let count = known().count().max(1) as f64;
            let mean = known().sum::<f64>() / count;
            known().map(|v| (v - mean).powi(2)).sum::<f64>() / count
        });
        variance.sum::<f64>().sqrt()
    }

    /// The coordinates of a sample; NaN where one is missing.
    #[doc(hidden)]
    pub fn coordinates(&self, sample: usize) -> [f64; 3] {
        let z = self.z_mm.as_ref().map_or(f64::NAN, |z| cell(z, sample));
        [cell(&self.x_mm, sample), cell(&self.y_mm, sample), z]
    }

    /// Whether a sample has a measured orientation.
    #[doc(hidden)]
    pub fn is_turned(&self, sample: usize) -> bool {
        let parts = self.orientation_wxyz.as_ref();
        parts.is_some_and(|parts| parts.iter().all(|part| !cell(part, sample).is_nan()))
    }
}

/// A cell; one that the column does not reach is missing.
fn cell(column: &[f64], sample: usize) -> f64 {
    column.get(sample).copied().unwrap_or(f64::NAN)
}

/// Whether a column has a missing value: quicker than to ask which.
pub(crate) fn has_missing(column: &[f64]) -> bool {
    let found = |missing: bool, value: &f64| missing | value.is_nan();
    column.iter().fold(false, found)
}

/// Everything that one file of measurements says.
#[derive(Debug, Clone, PartialEq)]
pub struct Session {
    /// Its name.
    pub name: String,
    /// Free text.
    pub note: String,
    /// The robot as its controller believes it to be.
    pub robot: Robot,
    /// Reflectors; at least one.
    pub targets: Vec<Target>,
    /// The instrument.
    pub instrument: Instrument,
    /// How far a measured position may be off, mm.
    pub tolerance_mm: Option<f64>,
    /// Regions that the session brings along.
    pub regions: Vec<Region>,
    /// Hash of the model whose table was active while measuring; `None`: uncompensated.
    pub compensated_by: Option<String>,
    /// The samples.
    pub samples: Samples,
    /// The file it was read from, if any.
    pub path: Option<PathBuf>,
}

/// The one target of a session that names none: the tool's origin.
pub(crate) const DEFAULT_TARGET: &str = "tool";

/// A session without `targets` has one, at the tool's origin.
#[doc(hidden)]
pub fn default_targets() -> Vec<Target> {
    vec![Target {
        name: DEFAULT_TARGET.to_owned(),
        position_mm: Point3::origin(),
    }]
}
