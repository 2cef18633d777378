//! Writes the files of the walk through a calibration (`docs/walk-through.md`) again from their
//! scenario: `cargo run --no-default-features --example walk_through_files`.
#![allow(clippy::print_stdout, reason = "it is run by hand")]
#![allow(unreachable_pub, reason = "a test uses the same module")]

#[path = "walk_through_files/files.rs"]
mod files;

use std::path::Path;

fn main() -> anyhow::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/walk-through");
    for (name, text) in files::from_scenario(&folder)?.list {
        std::fs::write(folder.join(name), &text)?;
        println!("{name}: {} bytes", text.len());
    }
    Ok(())
}
