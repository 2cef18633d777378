//! Any text as a scenario; short ones are played, and the session is written and read again.
#![no_main]

use libfuzzer_sys::fuzz_target;
use truepose::sessions::{parse, write_inline};
use truepose::simulation::{parse_scenario, simulate, unwatched};

const MOST_STOPS: f64 = 1000.0;

fuzz_target!(|bytes: &[u8]| {
    let Ok(loaded) = parse_scenario(bytes) else {
        return;
    };
    if loaded.scenario.poses.stops() > MOST_STOPS {
        return;
    }
    if let Ok((session, _)) = simulate(&loaded.scenario, 1, unwatched) {
        let mut document = Vec::new();
        write_inline(&session, &mut document).expect("memory does not fail");
        let again = parse(&document).map(|loaded| loaded.session.samples.len());
        assert!(again.is_ok_and(|samples| samples == session.samples.len()));
    }
});
