//! What every frame needs to know of a session, worked out once: no frame may look at all samples.

use crate::effects::term::travel_of;
use crate::gui::core::scale::{MOST_ARROWS, round, stride};
use crate::gui::core::skeleton::robot_extent;
use crate::model::Positions;
use crate::numeric::Ascending;
use crate::sessions::Session;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Overview {
    /// Samples that can be used, in the order of the session.
    pub(crate) usable: Vec<u32>,
    /// How many measurements of which kind there are, where whole points are not all.
    pub(crate) kinds: Option<String>,
    /// How many samples are held out.
    pub(crate) held_out: usize,
    /// How many a person took out.
    pub(crate) excluded: usize,
    /// Smallest and largest value of joint 1 that can be reached or was measured, rad or mm.
    pub(crate) travel: (f64, f64),
    /// Smallest and largest corner of the nominal robot's points, mm.
    pub(crate) nominal_mm: [[f64; 3]; 2],
    /// The same of what was measured; of the nominal robot along axes that were not.
    pub(crate) measured_mm: [[f64; 3]; 2],
    /// Smallest and largest corner of the nominal robot at some of the poses, mm.
    pub(crate) robot_mm: [[f64; 3]; 2],
    /// Ascending of the deviations before.
    pub(crate) lengths: Ascending,
    /// The magnification at which the deviations before can be read.
    pub(crate) readable: f64,
    /// Size of the workspace, mm.
    pub(crate) reach_mm: f64,
    /// From its middle to its edge, mm.
    pub(crate) radius_mm: f64,
}

impl Overview {
    /// Looks at every sample. `arm_mm` is the size of the workspace of a joint that turns.
    pub(crate) fn new(
        session: &Session,
        nominal: &Positions,
        usable: &[bool],
        lengths_mm: &[f64],
        arm_mm: Option<f64>,
    ) -> Self {
        let numbered = (0_u32..).zip(usable);
        let usable: Vec<u32> = numbered.filter(|(_, u)| **u).map(|(i, _)| i).collect();
        let samples = &session.samples;
        let of = |x: &[f64], y: &[f64], z: &[f64]| {
            let axes = [x, y, z].map(|column| extent(column, &usable));
            [axes.map(|[low, _]| low), axes.map(|[_, high]| high)]
        };
        let nominal_mm = of(&nominal.x_mm, &nominal.y_mm, &nominal.z_mm);
        let z_mm = samples.z_mm.as_ref().unwrap_or(&nominal.z_mm);
        let measured_mm = of(&samples.x_mm, &samples.y_mm, z_mm);
        let sides = (0..3).map(|k| (nominal_mm[1][k] - nominal_mm[0][k]).max(0.0));
        let reach_mm = arm_mm.unwrap_or_else(|| sides.fold(1.0, f64::max));
        let radius_mm = arm_mm.unwrap_or(0.5 * reach_mm);
        let held_out = samples.held_out.as_deref().unwrap_or(&[]);
        let range = travel_of(&session.robot, 0, &samples.q[0]);
        Self {
            kinds: session.kinds_in_words(),
            excluded: samples.excluded.iter().flatten().filter(|e| **e).count(),
            held_out: held_out.iter().filter(|h| **h).count(),
            travel: (range.from, range.to),
            nominal_mm,
            measured_mm,
            robot_mm: robot_extent(&session.robot, some_poses(session, &usable)),
            lengths: Ascending::new(lengths_mm),
            readable: readable(radius_mm, lengths_mm),
            reach_mm,
            radius_mm,
            usable,
        }
    }
}

/// Some of the poses; home where there is none.
fn some_poses(session: &Session, usable: &[u32]) -> impl Iterator<Item = Vec<f64>> {
    const SOME: usize = 128;
    let q = &session.samples.q;
    let home = usable.is_empty().then(|| vec![0.0; q.len()]);
    let some = usable.iter().step_by(stride(usable.len(), SOME));
    let poses = some.map(|sample| q.iter().map(|q| q[*sample as usize]).collect());
    home.into_iter().chain(poses)
}

/// Smallest and largest of the finite values at these samples.
fn extent(column: &[f64], usable: &[u32]) -> [f64; 2] {
    crate::numeric::extent(usable.iter().map(|i| column[*i as usize]))
}

/// The part of the workspace's radius that a long deviation is drawn over.
const LONG: f64 = 0.32;

/// The part that the median one is drawn over: 25 points where the whole workspace is drawn on 310, as in a
/// window of 1280 × 800.
const USUAL: f64 = 0.16;
/// The part over which the longer ones are drawn at most.
const LONGEST: f64 = 0.4;

/// The magnification at which these deviations can be read: the median one is 20 to 30 points long where
/// the whole workspace is in sight, and nine of ten stay within it.
pub(crate) fn readable(radius_mm: f64, lengths_mm: &[f64]) -> f64 {
    let step = stride(lengths_mm.len(), MOST_ARROWS);
    let some = lengths_mm.iter().copied().step_by(step);
    let mut some: Vec<f64> = some.filter(|l| l.is_finite()).collect();
    if some.is_empty() {
        return 1.0;
    }
    // One sample that is far off must not shrink all others.
    let mut of_rank = |tenths: usize| {
        let place = (some.len() - 1) * tenths / 10;
        *some.select_nth_unstable_by(place, f64::total_cmp).1
    };
    let (median, long) = (of_rank(5), of_rank(9));
    if long < 1e-9 {
        return 1.0;
    }
    round(f64::min(USUAL / median.max(1e-12), LONGEST / long) * radius_mm)
}

/// The deviation that is drawn long at this magnification, mm: the upper end of colour scales, so
/// that colour and length say the same.
pub(crate) fn long_mm(radius_mm: f64, magnification: f64) -> f64 {
    LONG * radius_mm / magnification
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_are_magnified_by_a_round_number_that_shows_the_longer_ones() {
        assert_eq!(readable(250.0, &[13.8; 30]), 3.0);
        assert_eq!(readable(250.0, &[0.05; 30]), 800.0);
        // A part of them that is long stays within the workspace.
        let mixed: Vec<f64> = (0..30)
            .map(|k| if k % 5 == 0 { 5.0 } else { 0.1 })
            .collect();
        assert_eq!(readable(250.0, &mixed), 20.0);
        let exact: Vec<f64> = (0..30)
            .map(|k| if k % 5 == 0 { 5.0 } else { 0.0 })
            .collect();
        assert_eq!(readable(250.0, &exact), 20.0);
        assert_eq!(readable(250.0, &[f64::NAN, 0.0]), 1.0);
        assert_eq!(readable(250.0, &[]), 1.0);
    }
}
