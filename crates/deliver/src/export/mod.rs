//! Files that a controller, or a program around it, reads.
//!
//! # To add a format
//! Write one file like its neighbours and add one line to the register; the terminal, the window
//! and the report find it there. `docs/extending.md` goes through an example. A table says what it is in a [`Rules`] (sign, digits, grid, limits,
//! directions, ends, turns) and brings a function that writes and one that reads; choosing the
//! entries, checking, and saying what the controller leaves is the same for all. A description of
//! the corrected robot writes a `chain` and reads it back (`description`), as the URDF does.
//!
//! # Signs
//! The trap of every compensation table is its sign. Here everything starts from the correction:
//! what to add to the command. [`Rules::meaning`] turns it into the file's numbers and back, and
//! nothing else does. Each format says in its sidecar what its numbers mean, with one worked line.
//! And each reads its own bytes back: [`Export::reads_as`] is what the controller will make of them,
//! [`gap_left`] the RMS error that it leaves on a session, [`ResidualError`] what it leaves over the measured range.

use crate::fit::gap::Spread;
use crate::kinematics::Robot;
use crate::model::Calibration;
use crate::sessions::Session;
use crate::text::Text;
use exporter::several_joints;

mod chain;
mod corrected;
mod description;
mod dh_rows;
mod euler;
mod exporter;
mod grid;
mod job;
mod knots;
mod names;
mod options;
#[doc(hidden)]
pub mod poses;
mod read_back;
mod residual_error;
mod rules;
mod sheet;
pub(crate) mod sidecar;
mod steps;
mod table_file;

pub use dh_rows::nominal_rows;
pub use exporter::{Document, Export, Exporter, Format};
pub use job::{ExportError, Job};
pub use lerobot::lerobot_calibration;
pub use options::{Asked, Motors, Options, Reference, Zeros};
pub use read_back::{ReadBack, gap_left, gap_to, gap_without};
pub use residual_error::{Allowance, ResidualError};
pub use rules::{Directions, EntryMeaning, Rules, Spacing};
pub use sheet::Sheet;

/// Makes the modules and the list of the names given, so that a format is registered in one line.
macro_rules! register {
    ($($name:ident),* $(,)?) => {
        $(mod $name;)*
        /// Every format, in the order in which lists show them.
        pub const EXPORTERS: &[Format] = &[$($name::FORMAT),*];
    };
}

// rustfmt does not see through the macro: scripts/check names the files to it.
register! {
    csv,
    c_header,
    linuxcnc,
    twincat_nc,
    twincat_cnc,
    sinumerik,
    urdf,
    mjcf,
    dh,
    ur_kinematics,
    frames,
    lerobot,
}

/// The format of this name.
pub fn find(id: &str) -> Option<&'static Format> {
    EXPORTERS.iter().find(|format| format.id == id)
}

/// The format that is offered first: a table over the joint of a robot with one, and of several what
/// every controller takes, as a table over one of their joints leaves most of their geometry.
pub fn usual(robot: &Robot) -> &'static Format {
    let of_several = several_joints(robot).then(|| find(frames::FORMAT.id));
    of_several.flatten().unwrap_or(&EXPORTERS[0])
}

/// The RMS errors of a session as it stands and under an export, mm, where both can be said.
pub fn gaps_of_export(
    calibration: &Calibration,
    session: &Session,
    export: &Export,
) -> Option<[Spread; 2]> {
    let after = gap_after_export(calibration, session, export)?;
    let before = match (&export.reads_as, &export.robot) {
        (None, Some(_)) => gap_to(calibration, session, &calibration.model.robot),
        _ => gap_without(calibration, session),
    };
    Some([before?, after])
}

/// The gap of a session under an export: with its table (see [`gap_left`]), or to its robot.
pub fn gap_after_export(
    calibration: &Calibration,
    session: &Session,
    export: &Export,
) -> Option<Spread> {
    match (&export.reads_as, &export.robot) {
        (Some(table), _) => gap_left(calibration, session, table),
        (None, Some(robot)) => gap_to(calibration, session, robot),
        (None, None) => None,
    }
}

impl Rules {
    /// What the format is called among people.
    pub fn title(&self) -> Text {
        let format = find(self.format);
        format.map_or_else(|| Text::verbatim(self.format), |format| format.title.into())
    }
}

#[cfg(test)]
mod tests;
