//! The library as it was read, once.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::entry::{Library, LibraryRobot, Source};

const ASSET: &str = include_str!("../../assets/robots.json");

/// Read once, at the first use.
fn held() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let mut library: Library =
            serde_json::from_str(ASSET).expect("the bundled robots are a document");
        debug_assert_eq!(library.format, "truepose-robots/1");
        for own in &mut library.robots {
            for (joint, ratio) in own.robot.joints.iter_mut().zip(&own.gear_ratios) {
                joint.gear_ratio = Some(*ratio);
            }
        }
        library
    })
}

/// Every robot of the library, by maker.
///
/// # Panics
/// Never: the file is part of the program, and a test reads it.
pub fn library() -> &'static [LibraryRobot] {
    &held().robots
}

/// Every source that the library names, by its key.
pub fn sources() -> &'static BTreeMap<String, Source> {
    &held().sources
}

/// The source with this key.
pub fn source(key: &str) -> Option<&'static Source> {
    sources().get(key)
}
