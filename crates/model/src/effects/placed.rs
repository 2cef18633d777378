//! A term in its place in a model: what an effect gets to act with.

use super::curve::Curve;
use super::joint_frame::JointFrame;
use super::rest::Rest;
use std::sync::Arc;

/// A term in its place in a model: what an effect gets to act with.
#[derive(Debug, Clone)]
pub struct Placed {
    /// Joint, counted from 0.
    pub joint: usize,
    /// The scanned parameter.
    pub setting: f64,
    /// Coefficients in inner units.
    pub coefficients: Vec<f64>,
    /// The curve of an unexplained correction.
    pub curve: Option<Arc<Curve>>,
    /// What predicts without a name.
    pub rest: Option<Arc<Rest>>,
    /// Where its columns begin among the model's.
    pub first_column: usize,
    /// The joint's frame.
    pub frame: JointFrame,
    /// Direction of gravity, base frame; `None`: unknown.
    pub down: Option<[f64; 3]>,
    /// Time of the first sample, s.
    pub start_s: f64,
}
