//! Any text as a model; what is accepted is written, read again and makes a table.
#![no_main]

use libfuzzer_sys::fuzz_target;
use truepose::compensation::{Conditions, JointTable, VerifiedCalibration};

fuzz_target!(|text: &str| {
    if let Ok(calibration) = VerifiedCalibration::read(text) {
        let written = calibration.document();
        let again = VerifiedCalibration::read(&written).expect("what was written can be read");
        assert_eq!(again.document(), written);
        let _ = JointTable::new(&calibration, 0, 30.0, Conditions::default());
    }
});
