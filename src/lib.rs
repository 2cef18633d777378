//! truepose: calibration of robots at commissioning.

pub mod atomic;
pub mod diagnostic;
pub mod units;

pub mod kinematics;
pub mod sessions;
