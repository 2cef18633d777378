//! Regions of the joint angle: where they come from. Which sample belongs to which is said in
//! [`crate::sessions::regions`].

use crate::kinematics::Range;
use crate::numeric::extent;
use crate::refusal::Refusal;
use crate::sessions::{Region, Session};
use crate::units::{deg_from_rad, rad_from_deg};

/// How the joint's range is divided.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum RegionChoice {
    /// As the session says; six uniform ones where it says nothing.
    #[default]
    FromSession,
    /// So many equal ones over the joint's limits, else over the data's range.
    Uniform(usize),
    /// Between neighbouring boundaries, rad, ascending.
    Boundaries(Vec<f64>),
    /// Exactly these.
    Given(Vec<Region>),
    /// Where the samples ask for them.
    Adaptive,
}

/// More regions than this are a slip of the keyboard.
pub const MOST_REGIONS: usize = 100_000;
/// Regions where neither session nor operator says otherwise: the paper's number.
pub const DEFAULT_REGIONS: usize = 6;

/// Equal regions over the joint's limits, else over the data's range, named 1…N upwards.
pub fn uniform(session: &Session, number: usize) -> Result<Vec<Region>, Refusal> {
    if !(1..=MOST_REGIONS).contains(&number) {
        return Err(Refusal(text!(
            "{regions} regions; expected a number from 1 to {most}",
            regions = number,
            most = MOST_REGIONS
        )));
    }
    let range = range_to_divide(session)?;
    // Divided in degrees, so that boundaries at whole degrees come out whole.
    let (from, to) = (deg_from_rad(range.from), deg_from_rad(range.to));
    let boundary = |k: usize| rad_from_deg(from + (to - from) * k as f64 / number as f64);
    between(&(0..=number).map(boundary).collect::<Vec<_>>())
}

/// Limits of the first joint, else the range of its commands.
pub fn range_to_divide(session: &Session) -> Result<Range, Refusal> {
    if let Some(limits) = session.robot.joints.first().and_then(|joint| joint.limits) {
        return Ok(limits);
    }
    let [from, to] = extent(session.samples.q.first().into_iter().flatten());
    let range = (from < to).then_some(Range { from, to });
    range.ok_or_else(|| {
        Refusal(text!(
            "all samples are at the same angle and the joint has no limits: there is no range to divide"
        ))
    })
}

/// Regions between neighbouring boundaries, named 1…N upwards.
pub fn between(boundaries: &[f64]) -> Result<Vec<Region>, Refusal> {
    if boundaries.len() < 2 {
        return Err(Refusal(text!(
            one "{count} region boundary; expected at least two", "{count} region boundary; expected at least two",
            count = boundaries.len()
        )));
    }
    let degrees = |rad: f64| format!("{:.6}", deg_from_rad(rad));
    let pairs = boundaries.windows(2).enumerate();
    pairs
        .map(|(k, pair)| {
            if pair[0] < pair[1] {
                Ok(Region {
                    name: (k + 1).to_string(),
                    from_rad: pair[0],
                    to_rad: pair[1],
                })
            } else {
                Err(Refusal(text!(
                    "region boundaries {first}° and {next}°; expected ascending numbers",
                    first = degrees(pair[0]),
                    next = degrees(pair[1])
                )))
            }
        })
        .collect()
}
