//! Stations of an instrument whose distances have different scales: air that is warmer at one of them, another
//! instrument, a robot that grew between them.
//!
//! What the fitted robot leaves is regressed on the points of a station in its own frame, zero elsewhere, beside
//! the base model with a frame for each station and waves over the joints. One scale is all stations' own (the robot's
//! size is measured with it): the first one's.

use nalgebra::Vector3;

use super::left::Beside;
use super::looked::Looked;
use super::parts::Part;
use super::thresholds::LIKELIER;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::{Group, Session, SessionCorrection};

/// More is no scale of a station: air changes it by a millionth a degree, and the steel of a robot grows by twelve.
const LARGEST: f64 = 2e-3;
/// Waves over the joints that are no scale: cycles a turn.
const ORDERS: [f64; 2] = [1.0, 2.0];

/// The session with the points of every station in the scale of the first; `None` where they have one.
pub(super) fn corrected(
    session: &Session,
    _: JointValues,
    Looked {
        rows, few, left, ..
    }: &Looked,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    let names = &session.samples.setups.as_ref()?.names;
    let stations = names.len();
    if stations < 2 {
        return None;
    }
    let mut others: Vec<_> = ORDERS.iter().flat_map(|n| left.waves(few, *n)).collect();
    let mut better: Option<Session> = None;
    for station in 1..stations {
        let part = Part::Group(Group::Setup, station);
        let is_own = rows.mask(session, part);
        let of_row = |i: usize| Vector3::from(left.expected[i]) * f64::from(u8::from(is_own[i]));
        let column = [left.column(of_row)];
        let (by, nats) = Beside::of(left, &others)?.with(&column);
        let by = by[0];
        if nats < LIKELIER + (stations as f64).ln() || by.abs() > LARGEST {
            continue;
        }
        others.extend(column);
        let mend = SessionCorrection::InRows {
            rows: rows.ranges(session, part),
            by: Box::new(SessionCorrection::ScaleLengths(1.0 / (1.0 + by))),
        };
        mend.apply(better.get_or_insert_with(|| session.clone()));
        problems.push(DataProblem {
            what: text!(
                "the scale of {station} is {ppm} ppm off that of the first setup",
                station = Group::Setup.called(names[station].clone()),
                ppm = format!("{:.0}", 1e6 * by)
            ),
            evidence: text!(
                "beside the base model the points of the setup are more than 1000 times likelier so"
            ),
            proposal: text!(
                "its points are brought to the scale of the first; compare air temperature and pressure of both, and the robot's own temperature"
            ),
            mend: Some(mend),
            samples: Vec::new(),
        });
    }
    better
}
