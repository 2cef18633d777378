//! truepose: calibration of robots at commissioning.

pub mod diagnostic;
pub mod units;

pub mod kinematics;
pub mod sessions;
