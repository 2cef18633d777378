//! Any bytes as a session document, and as a robot.
#![no_main]

use libfuzzer_sys::fuzz_target;
use truepose::sessions::{parse, parse_robot, write_inline};

fuzz_target!(|bytes: &[u8]| {
    if let Ok(loaded) = parse(bytes) {
        let mut document = Vec::new();
        write_inline(&loaded.session, &mut document).expect("memory does not fail");
        let again = parse(&document).expect("what was accepted can be written and read again");
        assert_eq!(again.session.samples.len(), loaded.session.samples.len());
    }
    let _ = parse_robot(bytes);
});
