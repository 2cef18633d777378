//! Any bytes as a file of the format `iso230`.
#![no_main]

mod importing;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| importing::import_any("iso230", data));
