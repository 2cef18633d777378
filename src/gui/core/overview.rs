//! What follows from a session and is worked out once, when it is opened or changed: what its samples
//! cover, and what every frame needs to know of them. No frame may look at all samples.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

use crate::effects::term::travel_of;
use crate::effects::{CATALOGUE, Inputs, Role, Survey};
use crate::gui::core::skeleton::Skeleton;
use crate::model::{Model, Positions};
use crate::numeric::Ascending;
use crate::present::chart::{among, decade};
use crate::sessions::{Session, Sigma};
use crate::text::{Template, Text, filled};

/// What is known of the samples before anything is identified: under which conditions they are, what can be seen in them, and the noise that the instrument's maker admits.
#[derive(Debug, Clone)]
pub(crate) struct Coverage {
    /// The gap that the instrument's own noise makes, mm.
    pub(crate) floor_mm: Option<f64>,
    /// Effects that the session can show.
    pub(crate) testable: Vec<&'static str>,
    /// Effects that it cannot show, each with the reason.
    pub(crate) not_testable: Vec<(&'static str, Text)>,
}

impl Coverage {
    /// Looks at every sample.
    pub(crate) fn new(session: &Session, inputs: &Inputs) -> Self {
        let survey = Survey::new(session, inputs);
        let (mut testable, mut not_testable) = (Vec::new(), Vec::new());
        for effect in CATALOGUE {
            let about = effect.about();
            let joints = if about.per_joint {
                session.robot.joints.len()
            } else {
                1
            };
            let mut obstacles = (0..joints)
                .filter(|joint| (effect.exists_on)(*joint, survey.joints[*joint].kind))
                .map(|joint| effect.obstacle(&survey, joint));
            match obstacles.next() {
                None => {}
                Some(Some(because)) if obstacles.all(|o| o.is_some()) => {
                    not_testable.push((about.id, because));
                }
                Some(_) => testable.push(about.id),
            }
        }
        Self {
            testable,
            not_testable,
            floor_mm: floor_mm(session),
        }
    }
}

/// As the diagnosis reckons it where no pose was reached again.
fn floor_mm(session: &Session) -> Option<f64> {
    let spatial = session.samples.z_mm.is_some();
    let axes: usize = if spatial { 3 } else { 2 };
    match session.instrument.sigma_mm? {
        Sigma::Overall(sigma) => Some(sigma * (axes as f64).sqrt()),
        Sigma::PerAxis(sigma) => {
            let squares = sigma.iter().take(axes).map(|s| s * s);
            Some(squares.sum::<f64>().sqrt())
        }
    }
}

/// What every frame needs to know of a session.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Overview {
    /// Samples that can be used, in the order of the session.
    pub(crate) usable: Vec<u32>,
    /// How many measurements of which kind there are, where whole points are not all.
    pub(crate) kinds: Option<Text>,
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
    pub(crate) readable: Readable,
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
            corners(
                usable
                    .iter()
                    .map(|i| [x, y, z].map(|column| column[*i as usize])),
            )
        };
        let nominal_mm = of(&nominal.x_mm, &nominal.y_mm, &nominal.z_mm);
        let z_mm = samples.z_mm.as_ref().unwrap_or(&nominal.z_mm);
        let measured_mm = of(&samples.x_mm, &samples.y_mm, z_mm);
        let sides = (0..3).map(|k| (nominal_mm[1][k] - nominal_mm[0][k]).max(0.0));
        let reach_mm = arm_mm.unwrap_or_else(|| sides.fold(1.0, f64::max));
        let radius_mm = arm_mm.unwrap_or(0.5 * reach_mm);
        let held_out = samples.held_out.as_deref().unwrap_or(&[]);
        let skeleton = Skeleton::new(&session.robot, &Point3::origin());
        let robot = some_poses(session, &usable).filter_map(|q| skeleton.at(&q));
        let robot = robot.flatten();
        let range = travel_of(&session.robot, 0, &samples.q[0]);
        Self {
            kinds: session.kinds_in_words(),
            excluded: samples.excluded.iter().flatten().filter(|e| **e).count(),
            held_out: held_out.iter().filter(|h| **h).count(),
            travel: (range.from, range.to),
            nominal_mm,
            measured_mm,
            robot_mm: corners(robot.map(Into::into)),
            lengths: Ascending::new(lengths_mm),
            readable: Readable::new(radius_mm, lengths_mm),
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

/// The pose of the base in the measuring frame (of the first setup) after a model, where the instrument was
/// never brought into the base frame: turned by more than 0.02 rad or moved by more than `far_mm`.
/// Points of the base frame become points of the measuring frame.
pub(crate) fn measuring_from_base(model: &Model, far_mm: f64) -> Option<Isometry3<f64>> {
    const TURNED: f64 = 0.02;
    let mut terms = model.terms().iter();
    let frame = terms.find(|t| t.effect.about().role == Role::FreeFrame && t.setting == 0.0)?;
    let [a, b, c, x, y, z] = frame.coefficients[..] else {
        return None;
    };
    let turn = Vector3::new(a, b, c);
    let shift = Vector3::new(x, y, z);
    let far = turn.norm() > TURNED || shift.norm() > far_mm;
    let rotation = UnitQuaternion::from_scaled_axis(turn);
    far.then(|| Isometry3::from_parts(Translation3::from(shift), rotation))
}

/// Smallest and largest corner of these points, of what is finite; of none +∞ and −∞.
pub(crate) fn corners<const N: usize>(points: impl IntoIterator<Item = [f64; N]>) -> [[f64; N]; 2] {
    let mut ends = [[f64::INFINITY; N], [f64::NEG_INFINITY; N]];
    for p in points {
        for k in (0..N).filter(|k| p[*k].is_finite()) {
            ends[0][k] = ends[0][k].min(p[k]);
            ends[1][k] = ends[1][k].max(p[k]);
        }
    }
    ends
}

// How much of something a plot shows, and round numbers for its scales.

/// Up to here samples are few.
pub(crate) const FEW: usize = 1_000;

/// Arrows in one plot; beyond it they are thinned evenly, and the plot says so.
const MOST_ARROWS: usize = 10_000;
/// Points in one plot.
pub(crate) const MOST_POINTS: usize = 100_000;

/// Every how many of `count` things one is shown, so that there are at most `most`.
pub(crate) fn stride(count: usize, most: usize) -> usize {
    count.div_ceil(most).max(1)
}

/// What a plot says when it shows one thing in so many: a sentence with the argument `stride`.
pub(crate) fn thinned(stride: usize, says: Template) -> Option<String> {
    (stride > 1).then(|| filled(says, &[("stride", &stride)]))
}

/// The nearest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 × 10ⁿ, by ratio; for what is a factor and no scale.
fn round(value: f64) -> f64 {
    const LEADS: [f64; 11] = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = decade(value);
    let off = |lead: f64| (value / decade / lead).ln().abs();
    let nearest = LEADS.into_iter().min_by(|a, b| off(*a).total_cmp(&off(*b)));
    nearest.unwrap_or(1.0) * decade
}

/// The largest of 1, 2, 5 × 10ⁿ that is not above `value`.
pub(crate) fn round_down(value: f64) -> f64 {
    among(value, &[5.0, 2.0])
}

/// The part of the workspace's radius that a long deviation is drawn over.
const LONG: f64 = 0.32;

/// The median one is drawn so long, points …
const USUAL_POINTS: f64 = 25.0;
/// … in a large plot longer, so that it is no less than this part of the radius: it would be lost there.
const LEAST: f64 = 0.1;
/// The part of the radius over which the longer ones are drawn at most.
const LONGEST: f64 = 0.4;

/// The workspace is drawn over so many points where nothing is known of the plot: in a window of 1280 × 800.
pub(crate) const ROOM: f64 = 310.0;

/// What decides at which magnification deviations can be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Readable {
    radius_mm: f64,
    median_mm: f64,
    /// Nine of ten are shorter.
    long_mm: f64,
}

impl Readable {
    /// Of these deviations in a workspace of this radius.
    pub(crate) fn new(radius_mm: f64, lengths_mm: &[f64]) -> Self {
        let step = stride(lengths_mm.len(), MOST_ARROWS);
        let some = lengths_mm.iter().copied().step_by(step);
        let mut some: Vec<f64> = some.filter(|l| l.is_finite()).collect();
        // One sample that is far off must not shrink all others.
        let mut of_rank = |tenths: usize| {
            let place = some.len().checked_sub(1).map(|last| last * tenths / 10);
            place.map_or(0.0, |place| {
                *some.select_nth_unstable_by(place, f64::total_cmp).1
            })
        };
        Self {
            radius_mm,
            median_mm: of_rank(5),
            long_mm: of_rank(9),
        }
    }

    /// The magnification at which the median one is some 25 points long where the workspace is drawn over
    /// `room` points, and nine of ten stay within it.
    pub(crate) fn magnification(&self, room: f64) -> f64 {
        if self.long_mm < 1e-9 {
            return 1.0;
        }
        let part = f64::max(2.0 * USUAL_POINTS / room, LEAST);
        let usual = part / self.median_mm.max(1e-12);
        round(f64::min(usual, LONGEST / self.long_mm) * self.radius_mm)
    }
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
    fn no_plot_shows_more_than_it_can_draw() {
        for count in [0, 1, 9_999, 10_000, 10_001, 1_000_000] {
            let stride = stride(count, MOST_ARROWS);
            assert!(count.div_ceil(stride) <= MOST_ARROWS);
        }
    }

    #[test]
    fn a_thinned_plot_says_so() {
        let one = phrase!("one point in {stride} shown"; stride);
        assert_eq!(thinned(1, one), None);
        let says = |n| thinned(n, one).expect("thinned");
        assert_eq!(says(100), "one point in 100 shown");
    }

    #[test]
    fn scales_are_round_numbers() {
        assert_eq!(round_down(2.3), 2.0);
        assert_eq!(round_down(0.7), 0.5);
        assert_eq!(round_down(1000.0), 1000.0);
        assert_eq!(round_down(f64::NAN), 1.0);
    }

    #[test]
    fn vectors_are_magnified_by_a_round_number_that_shows_the_longer_ones() {
        let at = |lengths: &[f64], room| Readable::new(250.0, lengths).magnification(room);
        assert_eq!(at(&[13.8; 30], ROOM), 3.0);
        assert_eq!(at(&[0.05; 30], ROOM), 800.0);
        // A part of them that is long stays within the workspace.
        let mixed: Vec<f64> = (0..30)
            .map(|k| if k % 5 == 0 { 5.0 } else { 0.1 })
            .collect();
        assert_eq!(at(&mixed, ROOM), 20.0);
        let exact: Vec<f64> = (0..30)
            .map(|k| if k % 5 == 0 { 5.0 } else { 0.0 })
            .collect();
        assert_eq!(at(&exact, ROOM), 20.0);
        assert_eq!(at(&[f64::NAN, 0.0], ROOM), 1.0);
        assert_eq!(at(&[], ROOM), 1.0);
        // Half the room: twice as much, as far as the longer ones allow.
        assert_eq!(at(&[0.05; 30], 0.5 * ROOM), 1500.0);
        assert_eq!(at(&mixed, 0.5 * ROOM), 20.0);
        // In a large plot a tenth of the radius.
        assert_eq!(at(&[0.05; 30], 5.0 * ROOM), 500.0);
    }
}
