//! truepose: calibration of robots at commissioning.

pub mod atomic;
pub mod diagnostic;
pub mod lanes;
pub mod units;

pub mod kinematics;
pub mod sessions;

pub mod effects;
pub mod identification;
pub mod model;

pub mod diagnosis;
