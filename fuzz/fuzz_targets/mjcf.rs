//! Any text as an MJCF file.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use truepose::kinematics::robot_from_mjcf;

fuzz_target!(|text: &str| {
    let _ = robot_from_mjcf(text, Path::new("r.xml"), "world", "tip");
});
