//! Any text as a model; what is accepted is written, read again and makes a table.
#![no_main]

use libfuzzer_sys::fuzz_target;
use truepose::compensation::{Conditions, JointTable};
use truepose::model::{read_model, write_model};

fuzz_target!(|text: &str| {
    if let Ok(calibration) = read_model(text) {
        let written = write_model(&calibration);
        let again = read_model(&written).expect("what was written can be read");
        assert_eq!(write_model(&again), written);
        let _ = JointTable::new(&calibration, 0, 30.0, Conditions::default());
    }
});
