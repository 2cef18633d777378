//! Any bytes as a table of targets or a robot program; the first byte chooses the language.
#![no_main]

use libfuzzer_sys::fuzz_target;
use truepose::programs::{Axes, LANGUAGES};
use truepose::sessions::parse_robot;

const ROBOT: &[u8] = br#"{"name":"r","dh":[
{"a_mm":100,"alpha_deg":90,"d_mm":0,"theta_deg":0,"convention":"standard"},
{"a_mm":0,"alpha_deg":-45.5,"d_mm":20,"theta_deg":10,"convention":"modified"}]}"#;

fuzz_target!(|data: &[u8]| {
    let Some((&choice, bytes)) = data.split_first() else {
        return;
    };
    let robot = parse_robot(ROBOT).expect("a sound robot").robot;
    let language = &LANGUAGES[usize::from(choice) % LANGUAGES.len()];
    match language.read(bytes, &Axes::new(&robot), None) {
        Ok(program) => {
            for target in &program.targets {
                assert!(target.at <= bytes.len());
                assert!(target.shape.values().iter().all(|v| v.is_finite()));
            }
        }
        Err(rejected) => assert!(!rejected.to_string().is_empty()),
    }
});
