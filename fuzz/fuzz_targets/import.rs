//! Any bytes as a file of any format that is imported: the first byte chooses which.
#![no_main]

mod importing;

use libfuzzer_sys::fuzz_target;
use truepose::importers::IMPORTERS;

fuzz_target!(|data: &[u8]| {
    if let Some((&choice, rest)) = data.split_first() {
        let importer = IMPORTERS[usize::from(choice) % IMPORTERS.len()];
        importing::import_any(importer, rest);
    }
});
