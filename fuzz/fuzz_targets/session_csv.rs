//! Any bytes as the samples of a sound session.
#![no_main]

use libfuzzer_sys::fuzz_target;
use truepose::inside::write_csv;
use truepose::sessions::parse_with_csv;

const DOCUMENT: &[u8] =
    br#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":[
{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],
"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},
"targets":{"T1":[0,0,0],"T2":[1,2,3]},"samples":{"file":"s.csv"}}"#;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(loaded) = parse_with_csv(DOCUMENT, bytes) {
        let mut csv = Vec::new();
        write_csv(&loaded.session, &mut csv).expect("memory does not fail");
        let again = parse_with_csv(DOCUMENT, &csv).expect("what was accepted can be read again");
        assert_eq!(again.session.samples.len(), loaded.session.samples.len());
    }
});
