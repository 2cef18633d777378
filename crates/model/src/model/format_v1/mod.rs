//! `truepose-model/1` on disk.
//!
//! A model is written twice over: in the units that people read (degrees, ppm, amplitude and phase), and, under the
//! keys `exact` and `robot_exact`, in the very numbers that the program computes with. Reading takes the exact ones
//! and converts or normalises nothing, so a model that is read back predicts the same to the last bit. Where only one
//! of the two was edited by hand they disagree, and the reader reports it. A model that was written by hand needs no
//! exact numbers.
//!
//! The order of effects, keys and digits is fixed: the same model is the same file, byte for byte, and [`model_hash`]
//! is its `sha256sum`.

mod curve;
mod exact;
mod of_samples;
pub(crate) mod read;
mod rest;
mod set_up;
mod term;

pub(crate) use term::term;

pub use read::{is_model, load_model, model_hash, read_model};

#[cfg(test)]
mod tests;
