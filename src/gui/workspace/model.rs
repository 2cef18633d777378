//! What the workspace plot shows, in mm of the measuring frame, projected on a plane or along the
//! camera's line of sight.

use nalgebra::{Isometry3, Point3};

use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::core::overview::{FEW, long_mm};
use crate::gui::layers::LayerOptions;
use crate::gui::view::{Ball, Plane};
use crate::gui::workbench::Workbench;

/// How angles of joint 1 lie in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dial {
    /// The axis, mm.
    pub(crate) centre_mm: [f64; 2],
    /// Direction of the tool at home.
    pub(crate) radial: [f64; 2],
    /// A quarter turn further.
    pub(crate) tangential: [f64; 2],
    /// The distance of the farthest reflector from the axis, mm.
    pub(crate) radius_mm: f64,
}

impl Dial {
    /// The point at this angle and this distance from the axis, mm.
    pub(crate) fn at(&self, q_rad: f64, radius_mm: f64) -> [f64; 2] {
        let (sin, cos) = q_rad.sin_cos();
        std::array::from_fn(|k| {
            self.centre_mm[k] + radius_mm * (cos * self.radial[k] + sin * self.tangential[k])
        })
    }

    /// The angle of a point, rad, the turn nearest to `near_rad`.
    pub(crate) fn angle_of(&self, point_mm: [f64; 2], near_rad: f64) -> f64 {
        let arm: [f64; 2] = std::array::from_fn(|k| point_mm[k] - self.centre_mm[k]);
        let along = |d: [f64; 2]| arm[0] * d[0] + arm[1] * d[1];
        let angle = along(self.tangential).atan2(along(self.radial));
        let turn = 2.0 * std::f64::consts::PI;
        angle + turn * ((near_rad - angle) / turn).round()
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shown {
    /// The places of the cloud that have vectors, where not all of few have them.
    pub(crate) vectors: Option<Vec<u32>>,
    /// The way of each reflector on the nominal robot, mm; for a single joint that turns.
    pub(crate) paths_mm: Vec<Vec<[f64; 3]>>,
    /// Where joint 1 turns in this plane.
    pub(crate) dial: Option<Dial>,
    /// Size of the workspace, mm.
    pub(crate) reach_mm: f64,
    /// Smallest and largest corner of what was measured, mm.
    pub(crate) measured_mm: [[f64; 2]; 2],
    /// Smallest and largest corner of the robot at some of the poses, mm.
    pub(crate) robot_mm: [[f64; 2]; 2],
    /// What is shown of each sample, and how.
    pub(crate) look: LayerOptions,
    /// How many samples can be used.
    pub(crate) samples: usize,
    /// Whether the points lie along a path, as those of a single joint do, and not all over the plot.
    pub(crate) along_a_path: bool,
}

impl Shown {
    /// The workspace as the workbench has it.
    pub(crate) fn of(workbench: &Workbench) -> Self {
        let loaded_session = &**workbench.loaded_session();
        let view = &workbench.view;
        let facing = workbench.facing();
        Self {
            vectors: is_sparse(workbench).then(|| most_telling(workbench)),
            paths_mm: paths(loaded_session, &workbench.base()),
            dial: (!view.in_space)
                .then(|| dial(loaded_session, view.plane))
                .flatten(),
            reach_mm: loaded_session.overview.reach_mm,
            measured_mm: facing.flat_box(loaded_session.overview.measured_mm),
            robot_mm: facing.flat_box(loaded_session.overview.robot_mm),
            look: look(workbench),
            samples: loaded_session.overview.usable.len(),
            along_a_path: loaded_session.session.robot.joint_count() == 1,
        }
    }

    /// What it says when not every sample has a vector.
    pub(crate) fn note(&self) -> Option<String> {
        let vectors = self.vectors.as_ref()?;
        Some(say!(
            "{drawn} of {samples} vectors: largest, others evenly",
            drawn = vectors.len(),
            samples = self.samples
        ))
    }
}

/// What a mark says of the tolerance: it is the model that is held against it, which is said where the robot with
/// corrected commands does worse.
pub(crate) fn judged(workbench: &Workbench, within: bool) -> &'static str {
    match (workbench.model_promises_more(), within) {
        (true, true) => say!("model within"),
        (true, false) => say!("model outside"),
        (false, true) => say!("within"),
        (false, false) => say!("outside"),
    }
}

/// The magnification that is chosen, or at which deviations can be read.
pub(crate) fn magnification(workbench: &Workbench) -> f64 {
    let chosen = workbench.view.magnification;
    chosen.unwrap_or_else(|| readable(workbench))
}

/// The magnification at which deviations can be read: those before; where they are mostly those of
/// the instrument's frame, those that are left.
pub(crate) fn readable(workbench: &Workbench) -> f64 {
    let left = workbench
        .answer()
        .filter(|_| workbench.found_base().is_some());
    let readable = left.map_or(workbench.loaded_session().overview.readable, |after| {
        after.readable
    });
    readable.magnification(room(workbench))
}

/// The deviation that is shown of a sample, mm: e = before + t (after − before).
pub(crate) fn shown(workbench: &Workbench, sample: usize) -> [f64; 3] {
    let before = workbench.loaded_session().deviation_before(sample);
    let Some(answer) = workbench.answer() else {
        return before;
    };
    let after = answer.deviation_after(sample);
    let blend = f64::from(workbench.view.blend);
    std::array::from_fn(|k| before[k] + blend * (after[k] - before[k]))
}

/// A ball around samples, robot and the origin of the base, mm of the base frame: around some of the
/// samples, whose order shows the whole in every beginning, and the middles of the faces of the box
/// that the robot fills.
pub(crate) fn ball(workbench: &Workbench) -> Ball {
    const SOME: usize = 1_000;
    let loaded_session = workbench.loaded_session();
    let to_base = workbench.base().inverse();
    let cloud = loaded_session.cloud();
    let measured = cloud.samples.iter().take(SOME).map(|sample| {
        let p = loaded_session.measured(*sample as usize);
        (to_base * Point3::from(p)).into()
    });
    let [low, high] = loaded_session.overview.robot_mm;
    let faces = (0..6).map(|face| {
        let mut p = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        p[face / 2] = [low, high][face % 2][face / 2];
        p
    });
    Ball::around(&measured.chain(faces).chain([[0.0; 3]]).collect::<Vec<_>>())
}

fn look(workbench: &Workbench) -> LayerOptions {
    let (view, loaded_session) = (&workbench.view, workbench.loaded_session());
    let answered = workbench.answer().is_some();
    let magnification = magnification(workbench);

    LayerOptions {
        facing: workbench.facing(),
        deep_mm: view.in_space.then(|| 2.0 * ball(workbench).radius_mm),
        centre_mm: loaded_session.cloud().centre_mm,
        framed: view.in_space && workbench.found_base().is_some(),
        blend: if answered { view.blend } else { 0.0 },
        answered,
        magnification,
        long_mm: colour_end_mm(workbench, magnification),
        tolerance_mm: workbench.document().tolerance_mm,
        // Many points stand close together, and small ones apart.
        mark: match loaded_session.overview.usable.len() {
            0..=80 => 1.0,
            81..=5_000 => 0.75,
            _ => 0.5,
        },
    }
}

/// The upper end of colour scales, mm: colour and length say the same. With the heat map, and while
/// no scale is chosen, it goes from what suits the deviations before to what suits those after.
fn colour_end_mm(workbench: &Workbench, magnification: f64) -> f64 {
    let view = &workbench.view;
    let radius_mm = workbench.loaded_session().overview.radius_mm;
    let before = long_mm(radius_mm, magnification);
    match workbench.answer() {
        Some(after) if view.heat && view.magnification.is_none() => {
            let t = f64::from(view.blend);
            before
                + t * (long_mm(radius_mm, after.readable.magnification(room(workbench))) - before)
        }
        _ => before,
    }
}

pub(crate) fn dial(loaded_session: &LoadedSession, plane: Plane) -> Option<Dial> {
    let joint = &loaded_session.joint;
    let facing = joint.along[plane.normal()].abs() > 0.999;
    (loaded_session.turns() && facing && joint.radius_mm > 0.0).then(|| {
        let [right, up] = plane.axes();
        let flat = |p: [f64; 3]| [p[right], p[up]];
        Dial {
            centre_mm: flat(joint.foot_mm),
            radial: flat(joint.radial),
            tangential: flat(joint.tangential),
            radius_mm: loaded_session.arm_mm,
        }
    })
}

/// Points on the way of the nominal robot: an arc of each reflector for a single joint that turns.
fn paths(loaded_session: &LoadedSession, base: &Isometry3<f64>) -> Vec<Vec<[f64; 3]>> {
    let values = loaded_session.over_travel();
    if values.is_empty() {
        return Vec::new();
    }
    let robot = &loaded_session.session.robot;
    let arcs = loaded_session.session.targets.iter().map(|target| {
        let at = |q: &f64| (base * robot.point_in_base(&[*q], &target.position_mm)).into();
        values.iter().map(at).collect()
    });
    arcs.collect()
}

/// Vectors of a robot with several joints at once: those that are largest, and others spread evenly over the session.
const LARGEST: usize = 16;
const EVENLY: usize = 48;
/// They are drawn so much longer than those of a crowd.
const LONGER: f64 = 1.6;

/// Whether only some vectors are drawn: those of one joint stand in a row, and of thousands the layout chooses.
fn is_sparse(workbench: &Workbench) -> bool {
    let loaded_session = workbench.loaded_session();
    let several = loaded_session.session.robot.joints.len() > 1;
    let samples = loaded_session.overview.usable.len();
    several && (LARGEST + EVENLY + 1..=FEW).contains(&samples)
}

/// The places in the cloud of the largest deviations of those that are shown, and of some of the others.
fn most_telling(workbench: &Workbench) -> Vec<u32> {
    let loaded_session = workbench.loaded_session();
    let after = workbench.answer().filter(|_| workbench.view.blend > 0.0);
    let lengths = after.map_or(&loaded_session.before.length_mm, |a| &a.after.length_mm);
    let samples = &loaded_session.cloud().samples;
    let length = |place: &u32| lengths[samples[*place as usize] as usize];
    let mut telling: Vec<u32> = (0..).take(samples.len()).collect();
    telling.retain(|place| length(place).is_finite());
    telling.sort_by(|a, b| length(b).total_cmp(&length(a)));
    let mut others = telling.split_off(LARGEST.min(telling.len()));
    // Every beginning of the cloud is spread evenly.
    others.sort_unstable();
    telling.extend(others.into_iter().take(EVENLY));
    telling
}

/// Over how many points vectors are made for, see [`Readable::magnification`]: fewer make them longer.
///
/// [`Readable::magnification`]: crate::gui::core::overview::Readable::magnification
pub(super) fn room(workbench: &Workbench) -> f64 {
    let longer = if is_sparse(workbench) { LONGER } else { 1.0 };
    workbench.view.plot_size / longer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;

    #[test]
    fn blending_takes_the_vectors_from_before_to_after() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.identify(None));
        workbench.receive();
        let longest = |workbench: &Workbench| {
            let lengths = (0..workbench.loaded_session().len()).map(|sample| {
                let e = shown(workbench, sample);
                e[0].hypot(e[1])
            });
            lengths.fold(0.0, f64::max)
        };
        workbench.execute(|bench| bench.view.blend = 0.0);
        let before = longest(&workbench);
        workbench.execute(|bench| bench.view.blend = 0.5);
        let between = longest(&workbench);
        workbench.execute(|bench| bench.view.blend = 1.0);
        let after = longest(&workbench);
        assert!(
            before > between && between > after,
            "{before} {between} {after}"
        );
        assert!(after < 1.0);
    }

    #[test]
    fn an_angle_on_the_dial_is_found_again_on_any_turn() {
        let shown = Shown::of(&workbench());
        let dial = shown.dial.expect("the joint turns in this plane");
        for q in [-3.5, -1.0, 0.0, 0.5, 4.0] {
            let found = dial.angle_of(dial.at(q, 100.0), q + 0.3);
            assert!((found - q).abs() < 1e-12, "{q} {found}");
        }
    }

    #[test]
    fn there_is_no_dial_where_the_joint_is_seen_from_the_side() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.view.look_in(Plane::Xz));
        assert_eq!(Shown::of(&workbench).dial, None);
    }
}
