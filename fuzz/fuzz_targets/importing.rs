//! Imports any bytes; a session that comes of it is written and read again.

use std::collections::BTreeMap;

use truepose::importers::{
    AngleUnit, Companion, Decimal, Importer, LengthUnit, Matching, Reading, Settings, TimeUnit, import, inspect,
};
use truepose::sessions::{parse, parse_robot, write_inline};

const ROBOT: &[u8] = br#"{"name":"r","joints":[
{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],
"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}"#;

/// Answers to what only one format asks.
const OPTIONS: [(&str, &str); 3] = [("camera", "on-tool"), ("nominal-length", "300"), ("anchor", "B")];

const COMMANDS: &[u8] = b"name,q1_deg,time_s\nA,0,0\nB,10,1\nA,20,2\nP1,30,3\n1,40,4\n2,50,5\n";

/// The first byte chooses what a person would have said; a zero byte in between starts a second
/// file, of commands or of reference points.
pub fn import_any(importer: &'static Importer, data: &[u8]) {
    let Some((&choice, bytes)) = data.split_first() else {
        return;
    };
    let robot = parse_robot(ROBOT).expect("a sound robot").robot;
    let said = choice & 1 != 0;
    let reading = Reading {
        kind: (choice & 128 == 0).then_some(importer),
        unit: said.then_some(LengthUnit::Millimetres),
        angle_unit: said.then_some(AngleUnit::Degrees),
        time_unit: said.then_some(TimeUnit::Seconds),
        decimal: (choice & 2 != 0).then_some(Decimal::Comma),
        z_up: choice & 4 != 0,
        options: if said { OPTIONS.map(|(name, value)| (name, value.to_owned())).into() } else { BTreeMap::new() },
        ..Reading::default()
    };
    let _ = inspect(bytes, &reading);
    let split = bytes.windows(4).position(|four| four == b"####");
    let (measured, beside) = match split {
        Some(at) => (&bytes[..at], Some(&bytes[at + 4..])),
        None => (bytes, None),
    };
    let companion = |bytes| Companion { bytes, file: None };
    let as_reference = choice & 8 != 0;
    let settings = Settings {
        commands: match beside {
            Some(bytes) if !as_reference => Some(companion(bytes)),
            _ if choice & 16 != 0 => Some(companion(COMMANDS)),
            _ => None,
        },
        reference: beside.filter(|_| as_reference).map(companion),
        matching: match choice >> 5 & 3 {
            0 => Some(Matching::Order),
            1 => Some(Matching::Name),
            2 => Some(Matching::Time),
            _ => None,
        },
        clock_offset_s: (choice & 96 == 64).then_some(0.0),
        scale: said,
        ..Settings::new(reading, &robot)
    };
    match import(measured, &settings) {
        Ok(imported) => {
            let mut document = Vec::new();
            write_inline(&imported.session, &mut document).expect("memory does not fail");
            let again = parse(&document).expect("what was imported can be written and read again");
            assert_eq!(again.session.samples.len(), imported.session.samples.len());
        }
        Err(rejected) => assert!(!rejected.to_string().is_empty()),
    }
}
