//! Anything as a motor calibration of `LeRobot`.
#![no_main]

use libfuzzer_sys::fuzz_target;
use truepose::inside::lerobot_calibration;

fuzz_target!(|bytes: &[u8]| {
    let _ = lerobot_calibration(bytes, "motors.json");
});
