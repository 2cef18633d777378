//! What an export of a corrected robot may be asked for beside its format.

use crate::kinematics::DhConvention;

named! {
    /// Who takes the zero offsets of the joints. Never both: they would be corrected twice.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Zeros {
        /// The geometry of the file. The controller's own zeros stay as they are.
        #[default]
        Origins = "origins",
        /// The controller (mastering, homing). The geometry of the file is without them.
        Controller = "controller",
    }
    /// Its name.
    pub fn name;
}

impl Zeros {
    /// Every one, by its name on the command line.
    pub const ALL: [(&'static str, Self); 2] =
        [("origins", Self::Origins), ("controller", Self::Controller)];
}

/// The servos of a hobby arm: their homing offsets have opposite signs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Motors {
    /// Feetech: present = actual − `homing_offset`.
    #[default]
    Feetech,
    /// Dynamixel: present = actual + `homing_offset`.
    Dynamixel,
}

impl Motors {
    /// Every one, by its name on the command line.
    pub const ALL: [(&'static str, Self); 2] =
        [("feetech", Self::Feetech), ("dynamixel", Self::Dynamixel)];
}

/// A file that an export starts from: what the controller has now.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference<'a> {
    /// Its name, for messages.
    pub name: &'a str,
    /// Its content.
    pub bytes: &'a [u8],
}

/// What a format asks for, each with what it takes where nothing is said.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Asked {
    /// Who takes the zero offsets.
    pub zeros: Option<Zeros>,
    /// Convention of Denavit–Hartenberg rows.
    pub convention: Option<DhConvention>,
    /// The servos.
    pub motors: bool,
    /// A file that it starts from.
    pub reference: bool,
}

/// Options of an export of a robot's description.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Options<'a> {
    /// What takes the zero offsets; `None`: what the format is for.
    pub zeros: Option<Zeros>,
    /// The servos, for their calibration.
    pub motors: Motors,
    /// Convention of Denavit–Hartenberg rows; `None`: the one that came in, else standard.
    pub convention: Option<DhConvention>,
    /// What the controller has now.
    pub reference: Option<Reference<'a>>,
}
