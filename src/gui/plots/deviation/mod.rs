//! A component of the deviation over the angle of joint 1, before and after.

mod columns;
mod envelope;
mod layout;
mod model;
mod paint;

pub(crate) use envelope::Envelope;
pub(crate) use paint::show;
