//! Any text as a URDF file.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use truepose::kinematics::robot_from_urdf;

fuzz_target!(|text: &str| {
    let _ = robot_from_urdf(text, Path::new("r.urdf"), "base", "tip");
});
