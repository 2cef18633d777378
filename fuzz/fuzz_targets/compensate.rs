//! Any bytes as a program, through the whole of `compensate` with a small arm: frames, tools, corrected
//! commands, writing, reading back. The first byte chooses the language, the second what the caller states.
#![no_main]

#[path = "../../tests/support/compensating.rs"]
mod compensating;

#[path = "../../tests/support/exporting.rs"]
mod exporting;

use std::sync::OnceLock;

use libfuzzer_sys::fuzz_target;
use truepose::compensation::VerifiedCalibration;
use truepose::programs::LANGUAGES;

fuzz_target!(|data: &[u8]| {
    static ARM: OnceLock<VerifiedCalibration> = OnceLock::new();
    if let [language, choice, bytes @ ..] = data {
        let language = &LANGUAGES[usize::from(*language) % LANGUAGES.len()];
        let arm = ARM.get_or_init(|| exporting::admitted(&compensating::calibration()));
        compensating::compensated(arm, language, bytes, *choice);
    }
});
