//! The library as it was read, once.

use std::sync::OnceLock;

use super::asset;
use super::entry::{Library, LibraryRobot, Source};

/// Read once, at the first use.
fn held() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(asset::read)
}

/// Every robot of the library, by maker.
///
/// # Panics
/// Never: the file is part of the program, and a test reads it.
pub fn library() -> &'static [LibraryRobot] {
    &held().robots
}

/// Every source that the library names, with its key.
pub fn sources() -> &'static [(String, Source)] {
    &held().sources
}

/// The source with this key.
pub fn source(key: &str) -> Option<&'static Source> {
    let found = sources().iter().find(|(name, _)| name == key);
    found.map(|(_, source)| source)
}
