//! Writes the files of the walk through a calibration (`docs/walk-through.md`) and of an arm
//! (`docs/first-arm.md`) again from their scenario and session: `cargo run --no-default-features --example walk_through_files`.
#![allow(clippy::print_stdout, reason = "it is run by hand")]
#![allow(unreachable_pub, reason = "a test uses the same module")]

#[path = "walk_through_files/arm_files.rs"]
mod arm_files;
#[path = "walk_through_files/files.rs"]
mod files;

use std::path::Path;

fn main() -> anyhow::Result<()> {
    let sessions = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions");
    let (walk, arm) = (sessions.join("walk-through"), sessions.join("arm"));
    let (of_walk, of_arm) = (
        files::from_scenario(&walk)?.list,
        arm_files::from_session(&arm)?,
    );
    for (folder, list) in [(walk, of_walk), (arm, of_arm)] {
        for (name, text) in list {
            std::fs::write(folder.join(name), &text)?;
            println!("{name}: {} bytes", text.len());
        }
    }
    Ok(())
}
