//! Any bytes as a file of the format `tum`.
#![no_main]

mod importing;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| importing::import_any("tum", data));
