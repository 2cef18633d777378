//! What the workspace plot shows, in mm of the measuring frame, projected on a plane.

use crate::gui::commands::Workbench;
use crate::gui::plots::{MOST_ARROWS, MOST_POINTS, round_down, stride};
use crate::gui::subject::Subject;
use crate::gui::view::Plane;

/// An error vector of a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Arrow {
    /// The sample.
    pub(crate) sample: usize,
    /// Where the simulation is, mm.
    pub(crate) from_mm: [f64; 2],
    /// The deviation that is shown, mm, as long as it really is.
    pub(crate) vector_mm: [f64; 2],
    /// The deviation before, where another is shown.
    pub(crate) before_mm: Option<[f64; 2]>,
}

/// A measured point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    /// The sample.
    pub(crate) sample: usize,
    /// Where it was measured, mm.
    pub(crate) at_mm: [f64; 2],
    /// Whether the deviation that is shown is within the tolerance; `None` without one.
    pub(crate) within: Option<bool>,
    /// Whether it is a suspected outlier.
    pub(crate) suspected: bool,
}

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

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scene {
    /// Error vectors, perhaps thinned.
    pub(crate) arrows: Vec<Arrow>,
    /// One arrow for so many samples.
    pub(crate) arrow_stride: usize,
    /// Measured points, perhaps thinned.
    pub(crate) points: Vec<Point>,
    /// One point for so many samples.
    pub(crate) point_stride: usize,
    /// The way of the nominal robot, mm; for a single joint that turns one of each reflector.
    pub(crate) paths_mm: Vec<Vec<[f64; 2]>>,
    /// Where joint 1 turns in this plane.
    pub(crate) dial: Option<Dial>,
    /// How much longer than real the vectors are drawn.
    pub(crate) magnification: f64,
    /// Size of the workspace, mm.
    pub(crate) reach_mm: f64,
}

impl Scene {
    /// The workspace as the workbench has it.
    pub(crate) fn of(workbench: &Workbench) -> Self {
        let subject = &**workbench.subject();
        let view = workbench.view();
        let [right, up] = view.plane.axes();
        let flat = |p: [f64; 3]| [p[right], p[up]];
        let answer = workbench.answer();
        let blend = f64::from(view.blend);
        // What is shown: e = before + t (after − before), and the simulation that it belongs to.
        let shown = |sample: usize| {
            let before = subject.deviation_before(sample);
            let Some(answer) = answer else {
                return before;
            };
            let after = answer.deviation_after(sample);
            std::array::from_fn(|k| before[k] + blend * (after[k] - before[k]))
        };
        let length = |e: [f64; 3]| (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]).sqrt();
        let tolerance_mm = workbench.document().tolerance_mm;
        let usable: usize = subject.usable.iter().filter(|u| **u).count();
        let (arrow_stride, point_stride) =
            (stride(usable, MOST_ARROWS), stride(usable, MOST_POINTS));
        let samples = || (0..subject.len()).filter(|i| subject.usable[*i]);

        let arrows = samples().step_by(arrow_stride).map(|sample| {
            let e = shown(sample);
            let measured = subject.measured(sample);
            Arrow {
                sample,
                from_mm: flat(std::array::from_fn(|k| measured[k] - e[k])),
                vector_mm: flat(e),
                before_mm: (answer.is_some() && blend > 0.0)
                    .then(|| flat(subject.deviation_before(sample))),
            }
        });
        let points = samples().step_by(point_stride).map(|sample| Point {
            sample,
            at_mm: flat(subject.measured(sample)),
            within: tolerance_mm.map(|t| length(shown(sample)) <= t),
            suspected: answer.is_some_and(|a| a.suspected[sample]),
        });
        let reach_mm = reach(subject);
        Self {
            arrows: arrows.collect(),
            arrow_stride,
            points: points.collect(),
            point_stride,
            paths_mm: paths(subject, view.plane),
            dial: dial(subject, view.plane),
            magnification: view
                .magnification
                .unwrap_or_else(|| readable(reach_mm, &subject.before.length_mm)),
            reach_mm,
        }
    }
}

/// The magnification at which the longer ones of these deviations can be read.
pub(crate) fn readable(reach_mm: f64, lengths_mm: &[f64]) -> f64 {
    let step = stride(lengths_mm.len(), MOST_ARROWS);
    let mut some: Vec<f64> = lengths_mm
        .iter()
        .copied()
        .step_by(step)
        .filter(|l| l.is_finite())
        .collect();
    if some.is_empty() {
        return 1.0;
    }
    // One sample that is far off must not shrink all others.
    let place = (some.len() - 1) * 9 / 10;
    let (_, long, _) = some.select_nth_unstable_by(place, f64::total_cmp);
    if *long < 1e-9 {
        return 1.0;
    }
    round_down(0.2 * reach_mm / *long)
}

/// Size of the workspace, mm.
pub(crate) fn reach(subject: &Subject) -> f64 {
    let radius_mm = subject.reach_mm();
    if subject.single_revolute() && radius_mm > 0.0 {
        return radius_mm;
    }
    let nominal = &subject.nominal;
    let extent = |column: &[f64]| {
        let finite = column.iter().copied().filter(|v| v.is_finite());
        let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(v), b.max(v))
        });
        (high - low).max(0.0)
    };
    let sides = [
        extent(&nominal.x_mm),
        extent(&nominal.y_mm),
        extent(&nominal.z_mm),
    ];
    sides.into_iter().fold(1.0, f64::max)
}

fn dial(subject: &Subject, plane: Plane) -> Option<Dial> {
    let joint = &subject.joint;
    let facing = joint.along[plane.normal()].abs() > 0.999;
    (subject.turns() && facing && joint.radius_mm > 0.0).then(|| {
        let [right, up] = plane.axes();
        let flat = |p: [f64; 3]| [p[right], p[up]];
        Dial {
            centre_mm: flat(joint.foot_mm),
            radial: flat(joint.radial),
            tangential: flat(joint.tangential),
            radius_mm: subject.reach_mm(),
        }
    })
}

/// Points on the way of the nominal robot: an arc of each reflector for a single joint that turns,
/// else from sample to sample.
fn paths(subject: &Subject, plane: Plane) -> Vec<Vec<[f64; 2]>> {
    const POINTS: usize = 181;
    let [right, up] = plane.axes();
    if subject.single_revolute() {
        let (from, to) = subject.travel();
        let at = |k: usize| from + (to - from) * k as f64 / (POINTS - 1) as f64;
        let robot = &subject.session.robot;
        let arcs = subject.session.targets.iter().map(|target| {
            let points = (0..POINTS).map(|k| {
                let p = robot.point_in_base(&[at(k)], &target.position_mm);
                [p[right], p[up]]
            });
            points.collect()
        });
        return arcs.collect();
    }
    let step = stride(subject.len(), MOST_ARROWS);
    let all = (0..subject.len()).step_by(step);
    let way = all
        .map(|i| subject.nominal.get(i))
        .map(|p| [p[right], p[up]]);
    vec![way.collect()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::commands::Command;
    use crate::gui::edit::Edit;
    use crate::gui::testing::workbench;

    #[test]
    fn an_error_vector_runs_from_the_simulation_to_the_measurement() {
        let workbench = workbench();
        let scene = Scene::of(&workbench);
        let subject = workbench.subject();
        for arrow in &scene.arrows {
            let measured = subject.measured(arrow.sample);
            for (k, axis) in [0, 1].into_iter().enumerate() {
                let tip = arrow.from_mm[k] + arrow.vector_mm[k];
                assert!((tip - measured[axis]).abs() < 1e-9);
            }
        }
        assert_eq!(scene.arrows.len(), subject.len());
    }

    #[test]
    fn blending_takes_the_vectors_from_before_to_after() {
        let mut workbench = workbench();
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        let longest = |workbench: &Workbench| {
            let lengths = Scene::of(workbench).arrows;
            let lengths = lengths.iter().map(|a| a.vector_mm[0].hypot(a.vector_mm[1]));
            lengths.fold(0.0, f64::max)
        };
        workbench.execute(Command::Blend(0.0));
        let before = longest(&workbench);
        workbench.execute(Command::Blend(0.5));
        let between = longest(&workbench);
        workbench.execute(Command::Blend(1.0));
        let after = longest(&workbench);
        assert!(
            before > between && between > after,
            "{before} {between} {after}"
        );
        assert!(after < 1.0);
    }

    #[test]
    fn an_angle_on_the_dial_is_found_again_on_any_turn() {
        let scene = Scene::of(&workbench());
        let dial = scene.dial.expect("the joint turns in this plane");
        for q in [-3.5, -1.0, 0.0, 0.5, 4.0] {
            let found = dial.angle_of(dial.at(q, 100.0), q + 0.3);
            assert!((found - q).abs() < 1e-12, "{q} {found}");
        }
    }

    #[test]
    fn there_is_no_dial_where_the_joint_is_seen_from_the_side() {
        let mut workbench = workbench();
        workbench.execute(Command::Look(Plane::Xz));
        assert_eq!(Scene::of(&workbench).dial, None);
    }

    #[test]
    fn vectors_are_magnified_by_a_round_number_that_shows_the_longer_ones() {
        assert_eq!(readable(250.0, &[13.8; 30]), 2.0);
        assert_eq!(readable(250.0, &[0.05; 30]), 1000.0);
        assert_eq!(readable(250.0, &[f64::NAN, 0.0]), 1.0);
    }
}
