//! JSON documents: a tree that knows where everything stands, and the fields of an object, declared
//! once ([`mod@object`]), which reads and writes them.
//!
//! A calibration session is written by hand as often as by a program, and a complaint such as
//! "robot.joints\[0\].axis: 2 numbers; expected 3" is only worth something with its line. So every
//! value keeps the byte at which it starts, numbers keep being correctly rounded doubles, and an
//! array of numbers goes straight into a `Vec<f64>`: 10⁶ inline samples are no trees of nodes.
//!
//! RFC 8259 as `serde_json` reads it; besides, a key may occur only once in an object, and nesting ends
//! at 64 levels. A number that overflows is infinite here and refused where it is used.

mod at;
#[doc(hidden)]
pub mod degrees;
mod fields;
#[doc(hidden)]
pub mod kinds;
mod layout;
mod node;
#[doc(hidden)]
pub mod number;
#[doc(hidden)]
pub mod object;
mod parser;
#[doc(hidden)]
pub mod ranges;
mod source;
mod value;

pub use crate::object;
pub use degrees::degrees;
pub use fields::{Fields, Path, optional};
pub use layout::text_of;
pub(crate) use layout::{write_document, write_number};
pub use node::Value;
pub use node::{Member, Node};
pub(crate) use parser::{element_offset, parse};
pub(crate) use source::Source;

#[cfg(test)]
mod tests;
