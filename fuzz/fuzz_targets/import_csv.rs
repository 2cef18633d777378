//! Any bytes as a file of the format `csv`.
#![no_main]

mod importing;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| importing::import_any("csv", data));
