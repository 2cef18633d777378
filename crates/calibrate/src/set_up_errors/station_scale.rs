//! Stations of an instrument whose distances have different scales: air that is warmer at one of them, another
//! instrument, a robot that grew between them.
//!
//! The residuals of the fitted robot are regressed on the points of a station in its own frame, zero elsewhere,
//! together with the base model with a frame for each station and waves over the joints. One scale is common to all
//! stations (the robot's size is measured with it): the first one's.

use nalgebra::Vector3;

use super::examined::{Examined, Unstated};
use super::residuals::Projected;
use super::rows::Part;
use super::thresholds::LIKELIER;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::{Group, Session, SessionCorrection};

/// More is no scale of a station: air changes it by a millionth a degree, and the steel of a robot grows by twelve.
const LARGEST: f64 = 2e-3;

/// The station whose scale differs most clearly.
pub(super) fn differs(session: &Session, _: JointValues, examined: &Examined) -> Option<Unstated> {
    let Examined {
        rows, residuals, ..
    } = examined;
    let names = &session.samples.setups.as_ref()?.names;
    let projected = Projected::of(residuals, &examined.waves())?;
    let scale = |station: usize| {
        let part = Part::Group(Group::Setup, station);
        let is_own = rows.mask(session, part);
        let of_row =
            |i: usize| Vector3::from(residuals.expected[i]) * f64::from(u8::from(is_own[i]));
        let (by, nats) = projected.with(&[residuals.column(of_row)]);
        (
            nats - LIKELIER - (names.len() as f64).ln(),
            part,
            station,
            by[0],
        )
    };
    let scales = (1..names.len())
        .map(scale)
        .filter(|scale| scale.3.abs() <= LARGEST);
    let (more, part, station, by) = scales.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let problem = DataProblem::of_all(
        text!(
            "the scale of {station} is {ppm} ppm off that of the first setup",
            station = Group::Setup.called(names[station].clone()),
            ppm = format!("{:.0}", 1e6 * by)
        ),
        text!("beside the base model the points of the setup are more than 1000 times likelier so"),
        text!(
            "its points are brought to the scale of the first; compare air temperature and pressure of both, and the robot's own temperature"
        ),
        SessionCorrection::InRows {
            rows: rows.ranges(session, part),
            by: Box::new(SessionCorrection::ScaleLengths(1.0 / (1.0 + by))),
        },
    );
    (more >= 0.0).then_some((more, problem))
}
