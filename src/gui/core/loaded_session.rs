//! A session with everything that follows from it alone: worked out once, when it is opened.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

use nalgebra::Isometry3;
use serde::{Deserialize, Serialize};

use crate::diagnostic::Diagnostic;
use crate::effects::inputs::reflectors_at_home;
use crate::effects::{JointFrame, JointValues, Term};
use crate::fit::base_model;
use crate::fit::gap::{Deviations, Spread, deviations};
use crate::fit::problem::Problem;
use crate::kinematics::{JointKind, Range};
use crate::lanes::{add_scaled, cross, dot, minus};
use crate::model::Positions;
use crate::numeric::single;
use crate::progress::{Cancelled, Progress, ProgressSpan, unwatched};
use crate::sessions::regions::Assignment;
use crate::sessions::{Region, Session};

use super::overview::{Coverage, Overview, measuring_from_base};
use crate::gui::core::disk::Fingerprint;
use crate::gui::core::regions::{Count, Counts};

/// Where a session came from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Origin {
    /// It comes with the program.
    Bundled,
    /// It was read from a file.
    File(PathBuf),
    /// It was made by simulation.
    Simulated,
    /// There is none: a model was read from this file, and nothing was measured.
    Model(PathBuf),
    /// It was made of a file that an instrument wrote, and is in none of its own.
    Imported(PathBuf),
    /// It was kept when a window ended without warning; opened from this file, if from any.
    Recovered(Option<PathBuf>),
}

named! {
    /// A component of a deviation.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub(crate) enum Component {
        /// In the direction of motion of joint 1.
        #[default]
        Tangential = say!("tangential"),
        /// Away from the axis of joint 1.
        Radial = say!("radial"),
        /// Along the axis of joint 1.
        Axial = say!("axial"),
        /// Along x of the measuring frame.
        X = "x",
        /// Along y.
        Y = "y",
        /// Along z.
        Z = "z",
        Length = say!("length"),
    }
    pub(crate) fn name;
    /// All of them, in the order in which they are offered.
    pub(crate) const ALL;
}

impl Component {
    /// Whether it needs a measured z (for a joint that turns about z).
    pub(crate) fn out_of_plane(self) -> bool {
        matches!(self, Self::Axial | Self::Z)
    }
}

static OPENINGS: AtomicU64 = AtomicU64::new(1);

#[derive(Debug, Clone)]
pub(crate) struct LoadedSession {
    pub(crate) session: Session,
    /// What was found while it was read.
    pub(crate) findings: Vec<Diagnostic>,
    /// Where it came from.
    pub(crate) origin: Origin,
    /// The base in the measuring frame of the first setup, where the session has setups: as the nominal
    /// robot lies best in what was measured.
    pub(crate) base: Option<Isometry3<f64>>,
    /// Where the nominal robot would be, measuring frame.
    pub(crate) nominal: Positions,
    /// Measured − nominal.
    pub(crate) before: Deviations,
    /// The gap of the nominal robot; `None` where no sample can be used.
    pub(crate) gap_before: Option<Spread>,
    /// Which samples can be used.
    pub(crate) usable: Vec<bool>,
    /// What every frame needs to know of it.
    pub(crate) overview: Overview,
    /// What its samples cover.
    pub(crate) coverage: Coverage,
    /// Its samples as they are drawn, once they were asked for.
    cloud: OnceLock<Arc<Cloud>>,
    /// Axis and directions of joint 1 at home.
    pub(crate) joint: JointFrame,
    /// The distance of the farthest reflector from the axis of joint 1 at home, mm.
    pub(crate) arm_mm: f64,
    /// The same for everything that came from one opening, however it was changed since.
    pub(crate) lineage: u64,
    /// The files that it was read from, as they looked then: the document first.
    pub(crate) files: Vec<Fingerprint>,
    /// What was hidden in it, where it was simulated here.
    pub(crate) hidden: Option<Arc<[Term]>>,
    /// The range of joint 1 that a model was measured in, where there are no samples, rad or mm.
    pub(crate) measured_range: Option<Range>,
    /// The session from which this one differs in nothing but what is excluded by hand: from that it can be made
    /// again.
    whole: Option<Arc<Self>>,
}

only_itself!(LoadedSession);

impl LoadedSession {
    /// Looks through a session.
    pub(crate) fn new(session: Session, findings: Vec<Diagnostic>, origin: Origin) -> Self {
        let progress = Progress::new(&unwatched);
        let looked = Self::watched(session, findings, origin, progress.whole());
        looked.expect("nobody cancels it")
    }

    /// Looks through a session, told as this part of something.
    ///
    /// # Errors
    /// Cancelled.
    pub(crate) fn watched(
        session: Session,
        findings: Vec<Diagnostic>,
        origin: Origin,
        part: ProgressSpan<'_>,
    ) -> Result<Self, Cancelled> {
        let problem = Problem::new(&session, JointValues::Commanded);
        let model = base_model::nominal(&session.robot, &session, &problem);
        let base = measuring_from_base(&model, 0.0);
        let nominal = model.predict(&problem.inputs);
        part.reached(0.2)?;
        let before = deviations(&problem, &model);
        part.reached(0.4)?;
        let usable = problem.usable.clone();
        let gap_before = Spread::of(&before.length_mm, |i| problem.fit[i], |_| false);

        let joint = JointFrame::new(&session.robot, 0);
        let arm_mm = arm_mm(&session, &joint);
        let single = is_single_revolute(&session);
        let overview = Overview::new(
            &session,
            &nominal,
            &usable,
            &before.length_mm,
            (single && arm_mm > 0.0).then_some(arm_mm),
        );
        let coverage = Coverage::new(&session, &problem.inputs);
        part.reached(0.8)?;
        let loaded_session = Self {
            joint,
            arm_mm,
            overview,
            coverage,
            cloud: OnceLock::new(),
            base,
            nominal,
            before,
            gap_before,
            usable,
            session,
            findings,
            origin,
            lineage: OPENINGS.fetch_add(1, Ordering::Relaxed),
            files: Vec::new(),
            hidden: None,
            measured_range: None,
            whole: None,
        };
        part.reached(1.0)?;
        Ok(loaded_session)
    }

    /// The same opening with another session: what was found while it was read stays.
    pub(crate) fn with(&self, session: Session) -> Self {
        Self {
            lineage: self.lineage,
            files: self.files.clone(),
            ..Self::new(session, self.findings.clone(), self.origin.clone())
        }
    }

    /// The same session with exactly these samples excluded by hand.
    pub(crate) fn excluding(whole: &Arc<Self>, excluded: &[usize]) -> Self {
        let mut session = whole.session.clone();
        let mut marks = vec![false; session.samples.len()];
        for sample in excluded {
            marks[*sample] = true;
        }
        session.samples.excluded = Some(marks).filter(|_| !excluded.is_empty());
        Self {
            hidden: whole.hidden.clone(),
            whole: Some(Arc::clone(whole)),
            ..whole.with(session)
        }
    }

    /// What it is made of, where that is less than itself: another session, and what is excluded of it.
    pub(crate) fn made_of(&self) -> Option<(&Arc<Self>, Vec<usize>)> {
        let whole = self.whole.as_ref()?;
        Some((whole, self.session.samples.excluded_by_hand()))
    }

    /// Its samples as they are drawn: made when they are first wanted, in the background if possible.
    pub(crate) fn cloud(&self) -> &Arc<Cloud> {
        self.cloud.get_or_init(|| Arc::new(Cloud::of(self)))
    }

    /// Number of samples.
    pub(crate) fn len(&self) -> usize {
        self.session.samples.len()
    }

    /// The samples of each region along joint 1, and those in none.
    pub(crate) fn counted(&self, regions: &[Region]) -> Counts {
        let samples = &self.session.samples;
        let held_out = samples.held_out.as_deref();
        let assignment = Assignment::new(regions);
        let mut counts = vec![Count::default(); regions.len()];
        let mut outside = 0;
        for (i, q) in samples.q[0].iter().enumerate() {
            if let Some(region) = assignment.region_of(*q) {
                let is_fitted = self.usable[i] && !held_out.is_some_and(|h| h[i]);
                counts[region].all += 1;
                counts[region].fitted += usize::from(is_fitted);
            } else {
                outside += usize::from(q.is_finite());
            }
        }
        (counts, outside)
    }

    /// Whether nothing was measured: a model stands by itself.
    pub(crate) fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Lengths of the nominal robot's deviations in the plane in which joint 1 turns, mm.
    pub(crate) fn in_plane_before(&self) -> Vec<f64> {
        let length = |i: usize| {
            let e = self.deviation_before(i);
            let along = |c: Component| self.component(e, i, c);
            along(Component::Radial).hypot(along(Component::Tangential))
        };
        (0..self.len()).map(length).collect()
    }

    /// Where a sample was measured, mm; z of a planar session is that of the nominal robot.
    pub(crate) fn measured(&self, sample: usize) -> [f64; 3] {
        let samples = &self.session.samples;
        let z = samples.z_mm.as_ref();
        [
            samples.x_mm[sample],
            samples.y_mm[sample],
            z.map_or(self.nominal.z_mm[sample], |z| z[sample]),
        ]
    }

    /// Commanded value of joint 1, rad or mm.
    pub(crate) fn q(&self, sample: usize) -> f64 {
        self.session.samples.q[0][sample]
    }

    /// Side from which a joint, counted from 0, came; 0 where it is not known.
    pub(crate) fn side(&self, joint: usize, sample: usize) -> f64 {
        let dir = self.session.samples.dir.get(joint);
        let side = dir.and_then(Option::as_ref).map_or(0.0, |dir| dir[sample]);
        if side.is_nan() { 0.0 } else { side }
    }

    /// Deviation of the nominal robot at a sample, mm.
    pub(crate) fn deviation_before(&self, sample: usize) -> [f64; 3] {
        std::array::from_fn(|axis| self.before.axes_mm[axis][sample])
    }

    /// One component of a deviation at a sample, mm.
    pub(crate) fn component(&self, e: [f64; 3], sample: usize, component: Component) -> f64 {
        self.component_at(e, self.nominal.get(sample), component)
    }

    /// One component of a deviation where the nominal robot is at `p`, mm.
    pub(crate) fn component_at(&self, e: [f64; 3], p: [f64; 3], component: Component) -> f64 {
        let [radial, tangential] = self.directions(p);
        match component {
            Component::Length => dot(e, e).sqrt(),
            Component::Tangential => dot(e, tangential),
            Component::Radial => dot(e, radial),
            Component::Axial => dot(e, self.joint.along),
            Component::X => e[0],
            Component::Y => e[1],
            Component::Z => e[2],
        }
    }

    /// Radial and tangential direction of joint 1 where the nominal robot is at `p`.
    fn directions(&self, p: [f64; 3]) -> [[f64; 3]; 2] {
        let along = self.joint.along;
        let arm = minus(p, self.joint.origin_mm);
        let across = add_scaled(arm, along, -dot(arm, along));
        let length = dot(across, across).sqrt();
        if length < 1e-9 {
            return [self.joint.across_1, self.joint.across_2];
        }
        let radial = across.map(|v| v / length);
        let tangential = cross(along, radial);
        [radial, tangential]
    }

    /// Whether the paper's method by regions applies.
    pub(crate) fn single_revolute(&self) -> bool {
        is_single_revolute(&self.session)
    }

    /// Whether joint 1 turns.
    pub(crate) fn turns(&self) -> bool {
        self.joint_turns(0)
    }

    /// Whether this joint, counted from 0, turns.
    pub(crate) fn joint_turns(&self, joint: usize) -> bool {
        self.session.robot.joints[joint].kind == JointKind::Revolute
    }

    /// Values of a single joint that turns over its travel, rad, so close that the way of a reflector is
    /// drawn through them; none of other robots.
    pub(crate) fn over_travel(&self) -> Vec<f64> {
        const POINTS: usize = 181;
        if !self.single_revolute() {
            // Poses of an arm may stand in any order: a line through them would be no way.
            return Vec::new();
        }
        let (from, to) = self.travel();
        let at = |k: usize| from + (to - from) * k as f64 / (POINTS - 1) as f64;
        (0..POINTS).map(at).collect()
    }

    /// Smallest and largest value of joint 1 that can be reached or was measured, rad or mm.
    pub(crate) fn travel(&self) -> (f64, f64) {
        let (from, to) = self.overview.travel;
        if from <= to {
            (from, to)
        } else if let Some(measured) = self.measured_range {
            (measured.from, measured.to)
        } else {
            (0.0, 0.0)
        }
    }
}

fn is_single_revolute(session: &Session) -> bool {
    matches!(session.robot.joints.as_slice(), [joint] if joint.kind == JointKind::Revolute)
}

fn arm_mm(session: &Session, joint: &JointFrame) -> f64 {
    let homes = reflectors_at_home(session).into_iter();
    let distances = homes.map(|home| {
        let arm = minus(home, joint.origin_mm);
        dot(arm, joint.across_1).hypot(dot(arm, joint.across_2))
    });
    distances.fold(0.0, f64::max)
}

// The samples as they are uploaded: where each was measured and how far off it was; and with
// an answer what it leaves.
//
// Lengths are mm of the measuring frame, in single precision from the middle of the workspace:
// 0.03 µm at half a metre. Samples stand in an order whose every beginning is spread evenly over
// the session (steps of the golden ratio), so that the first of them show the whole. Every nth
// sample would not: where reflectors or directions alternate it is always the same of them.

/// Measured point, and deviation before.
pub(crate) type Place = [f32; 6];

/// A row of the [`Remainder`].
pub(crate) type RemainderRow = [f32; 4];

#[derive(Debug, Clone, Default)]
pub(crate) struct Cloud {
    /// What is known of each sample that can be used.
    pub(crate) places: Vec<Place>,
    pub(crate) samples: Vec<u32>,
    /// The middle of the workspace, mm of the measuring frame.
    pub(crate) centre_mm: [f64; 3],
}

/// What an answer leaves of the deviations, mm, and 1 where the sample is suspected: a row for each sample of the
/// [`Cloud`].
pub(crate) type Remainder = Vec<RemainderRow>;

impl Cloud {
    /// The usable samples of a session.
    fn of(loaded_session: &LoadedSession) -> Self {
        let usable = &loaded_session.overview.usable;
        let samples: Vec<u32> = spread(usable.len()).map(|k| usable[k]).collect();
        let [low, high] = loaded_session.overview.measured_mm;
        let centre_mm = std::array::from_fn(|k| {
            let middle = 0.5 * (low[k] + high[k]);
            if middle.is_finite() { middle } else { 0.0 }
        });
        let place = |sample: &u32| {
            let sample = *sample as usize;
            let at = loaded_session.measured(sample);
            let before = loaded_session.deviation_before(sample);
            let mut place = [0.0; 6];
            for k in 0..3 {
                place[k] = single(at[k] - centre_mm[k]);
                place[3 + k] = single(before[k]);
            }
            place
        };
        Self {
            places: samples.iter().map(place).collect(),
            samples,
            centre_mm,
        }
    }

    /// What an answer leaves, of each sample here.
    pub(crate) fn remainder(&self, after_mm: &[Vec<f64>; 3], suspected: &[bool]) -> Remainder {
        let row = |sample: &u32| {
            let sample = *sample as usize;
            let mark = if suspected[sample] { 1.0 } else { 0.0 };
            let [x, y, z] = [0, 1, 2].map(|k| single(after_mm[k][sample]));
            [x, y, z, mark]
        };
        self.samples.iter().map(row).collect()
    }
}

/// 0 … count in an order whose every beginning is spread evenly: multiples, modulo the count, of
/// a step that has no divisor with it and is nearly its golden section.
fn spread(count: usize) -> impl Iterator<Item = usize> {
    let common = |mut a: usize, mut b: usize| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    // 0.618034 of any count that memory holds, without rounding.
    let mut step = (count / 1_000_000 * 618_034 + count % 1_000_000 * 618_034 / 1_000_000).max(1);
    while common(step, count) > 1 {
        step += 1;
    }
    let next = move |k: &usize| Some((k + step) % count);
    std::iter::successors((count > 0).then_some(0), next).take(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;

    #[test]
    fn every_beginning_of_the_order_is_spread_evenly() {
        for count in [0_usize, 1, 2, 3, 100, 1000, 4097] {
            let order: Vec<usize> = spread(count).collect();
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.iter().copied().eq(0..count), "{count}");
        }
        // No gap is much wider than the mean one; the step is whole, the golden section is not.
        for (count, first) in [(100_000, 500), (1_000_008, 6_000), (36_000, 1_000)] {
            let mut some: Vec<usize> = spread(count).take(first).collect();
            some.sort_unstable();
            let widest = some.windows(2).map(|pair| pair[1] - pair[0]).max();
            assert!(widest <= Some(4 * count / first), "{count} {widest:?}");
        }
        // Whatever alternates is met in all its forms.
        for period in [2, 3, 4, 16] {
            let mut met: Vec<usize> = spread(1_000_000).take(64).map(|k| k % period).collect();
            met.sort_unstable();
            met.dedup();
            assert_eq!(met.len(), period);
        }
    }

    #[test]
    fn the_cloud_holds_what_the_session_holds() {
        let workbench = workbench();
        let loaded_session = workbench.loaded_session();
        let cloud = loaded_session.cloud();
        assert_eq!(cloud.places.len(), loaded_session.overview.usable.len());
        for (place, sample) in cloud.places.iter().zip(&cloud.samples) {
            let measured = loaded_session.measured(*sample as usize);
            let before = loaded_session.deviation_before(*sample as usize);
            for k in 0..3 {
                let at = f64::from(place[k]) + cloud.centre_mm[k];
                assert!((at - measured[k]).abs() < 1e-4);
                assert!((f64::from(place[3 + k]) - before[k]).abs() < 1e-5);
            }
        }
    }
}
