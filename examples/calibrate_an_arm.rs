//! Calibrates an arm with the library: reads a session, identifies its geometry, names what is missing
//! beyond it, and writes the corrected robot.
//!
//!     cargo run --example calibrate_an_arm

#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use truepose::diagnosis::Options;
use truepose::effects::JointValues;
use truepose::export::Job;
use truepose::pipeline::{Method, diagnose, export, hand_out, identify, load, verify};
use truepose::sessions::Session;

/// The calibration of one arm; an error names the file, the line and what was expected.
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let session: Session = load("sessions/arm/arm.json")?.session;
    let (fit, calibration) = identify(&session, &Method::default(), JointValues::Commanded)?;
    println!("RMS error {:.3} mm nominal", fit.gap.before.rms_mm);
    println!(
        "{} parameters leave {:.3} mm",
        fit.parameters.len(),
        fit.gap.after.rms_mm
    );
    for found in diagnose(&session, &Options::default(), &|_| true)?.found {
        println!("joint {:?}: {}: {}", found.joint, found.effect, found.check);
    }
    let checked = verify(&calibration, &session)?;
    println!("with corrected commands {:.3} mm", checked.model.rms_mm);
    let verified = hand_out(&calibration, &session)?;
    let urdf = export("urdf", &Job::new(&verified, "arm.urdf"))?;
    println!(
        "{} of {} bytes",
        urdf.documents[0].name,
        urdf.documents[0].bytes.len()
    );
    Ok(())
}
