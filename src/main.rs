//! The binary: arguments, then a command or the window.
fn main() {}
