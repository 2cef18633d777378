//! Pose accuracy and repeatability after ISO 9283:1998, clauses 7.2 and 7.3, per commanded pose that
//! was reached n times from the same direction.
//!
//! ```text
//! AP_p  = |p̄ − p_c|,  AP_x = x̄ − x_c, …             p̄: barycentre of the attained positions
//! l_j   = |p_j − p̄|,  RP_l = l̄ + 3 S_l,  S_l = √( Σ (l_j − l̄)² / (n − 1) )
//! vAP_p = max |p̄_h − p̄_k|                            over the directions h, k of one pose
//! AP_a  = ā,  RP_a = 3 S_a, …                        a, b, c: the turn from the commanded to the
//!                                                    attained orientation, about x, y, z
//! ```
//!
//! The turn is a rotation vector in the measuring frame; for the small turns of a robot it is the
//! standard's three angles. A direction is the combination of the sides from which the joints came.

use nalgebra::Point3;

use super::path::{PATH_CYCLES, PathFigures, paths};

use crate::text::{Template, Text};

use super::attained::{Attained, Turned, attained, of_turns};
use super::grouping::{Keys, gathered, once_per_stay, stays};
use super::points::Points;

/// Cycles that ISO 9283 asks for.
pub(crate) const STANDARD_CYCLES: usize = 30;

/// One commanded pose, reached from one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseFigures {
    /// Commanded joint values, degrees or mm.
    pub q: Vec<f64>,
    /// Side from which each joint came; 0 where it is not known.
    pub dir: Vec<f64>,
    /// The reflector, where the session has several.
    pub target: Option<String>,
    /// Load, kg.
    pub load_kg: Option<f64>,
    /// n.
    pub cycles: usize,
    /// As measured.
    pub before: Attained,
    /// As it would be with corrected commands, mm.
    pub after: Option<Attained>,
    /// Orientations as measured.
    pub orientation: Option<Turned>,
}

/// One commanded pose, reached from several directions.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    /// Commanded joint values, degrees or mm.
    pub q: Vec<f64>,
    /// The reflector, where the session has several.
    pub target: Option<String>,
    /// Number of directions.
    pub directions: usize,
    /// `vAP_p` as measured, mm.
    pub before: f64,
    /// As it would be with corrected commands, mm.
    pub after: Option<f64>,
}

/// All poses of a session.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PoseTest {
    /// Poses with at least two cycles, in measuring order.
    pub poses: Vec<PoseFigures>,
    /// Poses from several directions, in measuring order.
    pub variations: Vec<Variation>,
    /// Paths that were followed several times, in measuring order.
    pub paths: Vec<PathFigures>,
    /// What the standard asks for and the session does not have.
    pub missing: Vec<Text>,
}

/// The largest figures over all poses, mm; `None` where there is none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Largest {
    /// `AP_p`.
    pub accuracy: Option<f64>,
    /// `RP_l`.
    pub repeatability: Option<f64>,
    /// `vAP_p`.
    pub variation: Option<f64>,
    /// `AT_p`.
    pub path_accuracy: Option<f64>,
    /// `RT_p`.
    pub path_repeatability: Option<f64>,
}

impl Largest {
    /// Symbol, name and figure of each.
    pub fn rows(&self) -> [(&'static str, Template, Option<f64>); 5] {
        [
            ("AP", phrase!("pose accuracy"), self.accuracy),
            ("RP", phrase!("pose repeatability"), self.repeatability),
            (
                "vAP",
                phrase!("variation between directions"),
                self.variation,
            ),
            ("AT", phrase!("path accuracy"), self.path_accuracy),
            ("RT", phrase!("path repeatability"), self.path_repeatability),
        ]
    }
}

impl PoseTest {
    pub(super) fn new(points: &Points<'_>) -> Self {
        let inputs = &points.inputs;
        let mut keys = Keys::of_conditions(points);
        for q in &inputs.q {
            keys = keys.and(q);
        }
        let stays = stays(points);
        let (paths, on_paths) = paths(points);
        let mut test = Self {
            paths,
            ..Self::default()
        };
        for group in keys.groups(inputs.len(), |i| points.usable[i] && !on_paths[i]) {
            test.add(points, &once_per_stay(&group, &stays));
        }
        let cycles = test.paths.iter().map(|p| p.starts.len());
        if let Some(fewest) = cycles.min().filter(|n| *n < PATH_CYCLES) {
            test.missing.push(text!(
                "paths with as few as {fewest} cycles; the standard asks for {standard}",
                fewest,
                standard = PATH_CYCLES
            ));
        }
        if test.poses.is_empty() && !test.paths.is_empty() {
            test.missing
                .push(text!("no pose apart from the paths was reached twice"));
        } else if test.poses.is_empty() {
            test.missing.push(text!(
                "no pose was reached twice from the same direction, after another pose"
            ));
        } else {
            let fewest = test.poses.iter().map(|p| p.cycles).min().unwrap_or(0);
            if fewest < STANDARD_CYCLES {
                test.missing.push(text!(
                    "poses with as few as {fewest} cycles; the standard asks for {standard}",
                    fewest,
                    standard = STANDARD_CYCLES
                ));
            }
        }
        if inputs.dir.iter().any(Option::is_none) {
            test.missing.push(text!(
                "the side from which a joint came is not known: its directions are taken to be one"
            ));
        }
        if test.variations.is_empty() && !test.poses.is_empty() {
            test.missing
                .push(text!("no pose was repeated from several directions"));
        }
        if points.session.samples.z_mm.is_none() {
            test.missing
                .push(text!("z was not measured: figures are in the plane"));
        }
        test
    }

    /// The largest figures, as measured or with corrected commands.
    pub fn largest(&self, compensated: bool) -> Largest {
        let pose = |p: &PoseFigures| if compensated { p.after } else { Some(p.before) };
        let path = |p: &PathFigures| if compensated { p.after } else { Some(p.before) };
        let variation = |v: &Variation| if compensated { v.after } else { Some(v.before) };
        Largest {
            accuracy: most(&self.poses, |p| Some(pose(p)?.accuracy)),
            repeatability: most(&self.poses, |p| Some(pose(p)?.repeatability)),
            variation: most(&self.variations, variation),
            path_accuracy: most(&self.paths, |p| Some(path(p)?.accuracy)),
            path_repeatability: most(&self.paths, |p| Some(path(p)?.repeatability)),
        }
    }

    /// One commanded pose with all its directions.
    fn add(&mut self, points: &Points<'_>, samples: &[usize]) {
        let inputs = &points.inputs;
        let side = |i: usize| -> Vec<f64> {
            inputs
                .dir
                .iter()
                .map(|d| d.as_ref().map_or(0.0, |d| d[i] + 0.0))
                .collect()
        };
        let directions = gathered(samples.iter().map(|&i| (side(i), i)));
        let mut centres: Vec<[Option<Point3<f64>>; 2]> = Vec::new();
        for (dir, of_it) in &directions {
            let at = |compensated: bool| -> Option<(Point3<f64>, Attained)> {
                let all: Vec<_> = of_it
                    .iter()
                    .map(|i| points.attained(*i, compensated))
                    .collect();
                attained(&all, &points.commanded(of_it[0]))
            };
            let Some((centre, before)) = at(false) else {
                continue;
            };
            let after = if points.compensated() { at(true) } else { None };
            centres.push([Some(centre), after.map(|a| a.0)]);
            self.poses.push(PoseFigures {
                q: outer_pose(points, of_it[0]),
                dir: dir.clone(),
                target: target(points, of_it[0]),
                load_kg: inputs.load_kg.as_ref().map(|l| l[of_it[0]]),
                cycles: of_it.len(),
                before,
                after: after.map(|a| a.1),
                orientation: turned(points, of_it),
            });
        }
        let apart = |k: usize| -> Option<f64> {
            let centres: Option<Vec<_>> = centres.iter().map(|c| c[k]).collect();
            let centres = centres?;
            let pairs = centres.iter().enumerate();
            pairs
                .flat_map(|(h, a)| centres[h + 1..].iter().map(move |b| (b - a).norm()))
                .reduce(f64::max)
        };
        if let Some(before) = apart(0) {
            self.variations.push(Variation {
                q: outer_pose(points, samples[0]),
                target: target(points, samples[0]),
                directions: centres.len(),
                before,
                after: apart(1),
            });
        }
    }
}

fn most<T>(all: &[T], of: impl Fn(&T) -> Option<f64>) -> Option<f64> {
    all.iter().filter_map(of).reduce(f64::max)
}

fn outer_pose(points: &Points<'_>, sample: usize) -> Vec<f64> {
    let joints = points.robot.joints.iter().zip(&points.inputs.q);
    joints
        .map(|(joint, q)| joint.kind.to_display(q[sample]))
        .collect()
}

fn target(points: &Points<'_>, sample: usize) -> Option<String> {
    let index = points.inputs.target.as_ref()?[sample] as usize;
    points.session.targets.get(index).map(|t| t.name.clone())
}

/// `None` with fewer than two orientations.
fn turned(points: &Points<'_>, samples: &[usize]) -> Option<Turned> {
    let turn = |i: &usize| points.turn(&points.turned(*i)?, *i);
    of_turns(&samples.iter().filter_map(turn).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cross_of_four_points_by_hand() {
        // Distances 3, 3, 1, 1 from the centre (1, 2, 2): l̄ = 2, S = √(4/3).
        let commanded = Point3::origin();
        let points = [[4.0, 2.0], [-2.0, 2.0], [1.0, 3.0], [1.0, 1.0]];
        let points = points.map(|[x, y]| Point3::new(x, y, 2.0));
        let (centre, figures) = attained(&points, &commanded).expect("four points");
        assert_eq!(centre, Point3::new(1.0, 2.0, 2.0));
        assert_eq!(figures.accuracy, 3.0);
        assert_eq!(figures.accuracy_axes, [1.0, 2.0, 2.0]);
        assert!((figures.repeatability - (2.0 + 3.0 * (4.0_f64 / 3.0).sqrt())).abs() < 1e-14);
        assert_eq!(attained(&points[..1], &commanded), None);
    }
}
