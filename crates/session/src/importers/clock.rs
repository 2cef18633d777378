//! The instrument's clock and the controller's: how far they are apart.
//!
//! `t_command = t_measured + τ`. For every τ that lets the two recordings overlap by half, the
//! commanded path is compared with the measured one after the best rigid motion, because the
//! instrument need not stand in the base frame yet (Umeyama 1991, eq. 31–33, without scale):
//!
//! ```text
//! E(τ) = Σ|a|² + Σ|b|² − 2 (σ1 + σ2 ± σ3),   a, b about their means, σ of Σ b aᵀ
//! ```
//!
//! Points that fall outside the commands count with their whole variance, so that a τ that explains
//! few points well is no better than one that explains all. The best places of a coarse search are
//! refined. The uncertainty of τ is that of a least-squares fit of τ and the six parameters of the
//! motion, from the residual that is left: a motion that a shift in time imitates (one axis at a
//! constant speed) leaves τ undetermined, and that is said.

use nalgebra::{Matrix3, Matrix6, Point3, Vector3, Vector6};

use crate::importers::path::Path;
use crate::kinematics::Robot;
use crate::kinematics::rigid_motion::rigid_motion;
use crate::numeric::extent;
use crate::refusal::Refusal;

/// Steps of the coarse search.
const STEPS: usize = 4000;
/// Measured points that the coarse search looks at, and the fine one.
const COARSE_POINTS: usize = 500;
const FINE_POINTS: usize = 5000;
/// Where more than this part of the measured variance is left at the best offset, nothing was
/// recognised.
const UNRELATED: f64 = 0.5;
/// A path on which no point moves farther, mm, tells nothing.
const SMALLEST_PATH_MM: f64 = 1e-3;
/// Entries of the table of positions over time.
const TABLE: usize = 16_384;
/// Minima that are refined.
const REFINED: usize = 6;

/// Nothing that is measured is farther away; the squares of larger numbers overflow.
pub(crate) const FARTHEST_MM: f64 = 1e12;

/// A measured point with its time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Timed {
    pub(crate) time_s: f64,
    /// mm, in the instrument's frame.
    pub(crate) position: Vector3<f64>,
    /// Index into the targets.
    pub(crate) target: usize,
}

/// How far the clocks are apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClockOffset {
    /// What to add to a measured time to get the time of the commands, s.
    pub offset_s: f64,
    /// One standard deviation of it, s; `None` where the offset was given.
    pub sigma_s: Option<f64>,
    /// What is left between the commanded and the measured path, root mean square, mm.
    pub rms_mm: f64,
}

impl ClockOffset {
    /// The 95 % confidence interval of the offset, s; `None` where it was given.
    pub fn ci95_s(&self) -> Option<[f64; 2]> {
        let half = 1.96 * self.sigma_s?;
        Some([self.offset_s - half, self.offset_s + half])
    }
}

fn nothing_moves() -> Refusal {
    Refusal(text!(
        "nothing moves, or too few points were measured at different places: the offset of the clocks cannot be found"
    ))
}

/// Finds the offset.
pub(crate) fn find(
    path: &Path,
    robot: &Robot,
    targets: &[Point3<f64>],
    points: &[Timed],
) -> Result<ClockOffset, Refusal> {
    let coarse = Search::new(path, robot, targets, every(points, COARSE_POINTS))?;
    let step = (coarse.to - coarse.from) / STEPS as f64;
    let costs: Vec<f64> = (0..=STEPS)
        .map(|i| coarse.cost(coarse.from + i as f64 * step))
        .collect();
    let fine = Search::new(path, robot, targets, every(points, FINE_POINTS))?;
    let mut best: Vec<(f64, f64)> = minima(&costs)
        .into_iter()
        .take(REFINED)
        .map(|i| fine.refine(coarse.from + i as f64 * step, step))
        .collect();
    best.sort_by(|a, b| a.1.total_cmp(&b.1));
    let Some(&(offset_s, cost)) = best.first() else {
        return Err(nothing_moves());
    };
    if cost.is_nan() || cost > UNRELATED * fine.variance {
        return Err(Refusal(text!(
            "the measured points follow the commanded path at no offset of the clocks: the robot never moved while it was measured, or the files do not belong together"
        )));
    }
    // A rival is another valley, not another place in this one.
    let rival = best.iter().skip(1).find(|other| {
        (other.0 - offset_s).abs() > 3.0 * step && fine.is_ridge_between(offset_s, other.0, cost)
    });
    if let Some(rival) = rival
        && rival.1 <= 1.2 * cost + 1e-9 * fine.variance
    {
        return Err(Refusal(text!(
            "the clocks may be {a} s or {b} s apart: the motion repeats, and both fit alike",
            a = format!("{offset_s:.3}"),
            b = format!("{:.3}", rival.0)
        )));
    }
    fine.judged(offset_s, true)
}

/// Judges an offset that was given.
pub(crate) fn offset_from(
    path: &Path,
    robot: &Robot,
    targets: &[Point3<f64>],
    points: &[Timed],
    offset_s: f64,
) -> ClockOffset {
    let judged = Search::new(path, robot, targets, every(points, FINE_POINTS))
        .and_then(|search| search.judged(offset_s, false));
    ClockOffset {
        offset_s,
        sigma_s: None,
        rms_mm: judged.map_or(0.0, |clock| clock.rms_mm),
    }
}

/// At most so many points, evenly.
fn every(points: &[Timed], most: usize) -> Vec<Timed> {
    let step = points.len().div_ceil(most).max(1);
    points.iter().step_by(step).copied().collect()
}

/// Local minima, the deepest first.
fn minima(costs: &[f64]) -> Vec<usize> {
    let below = |i: usize, other: Option<usize>| {
        other
            .and_then(|other| costs.get(other))
            .is_none_or(|cost| costs[i] <= *cost)
    };
    let mut found: Vec<usize> = (0..costs.len())
        .filter(|&i| below(i, i.checked_sub(1)) && below(i, Some(i + 1)))
        .collect();
    found.sort_by(|&a, &b| costs[a].total_cmp(&costs[b]));
    found
}

/// The path as positions over time, and the points to compare it with.
struct Search<'a> {
    path: &'a Path,
    robot: &'a Robot,
    targets: &'a [Point3<f64>],
    points: Vec<Timed>,
    /// For each target, the position at equally spaced times.
    table: Vec<Vec<Vector3<f64>>>,
    centre: Vector3<f64>,
    /// Of the measured points, per point, mm².
    variance: f64,
    /// Offsets that let the recordings overlap by half.
    from: f64,
    to: f64,
}

impl<'a> Search<'a> {
    fn new(
        path: &'a Path,
        robot: &'a Robot,
        targets: &'a [Point3<f64>],
        points: Vec<Timed>,
    ) -> Result<Self, Refusal> {
        if points.len() < 4 || path.time_s.len() < 2 {
            return Err(nothing_moves());
        }
        let count = points.len() as f64;
        let centre = points
            .iter()
            .map(|point| point.position)
            .sum::<Vector3<f64>>()
            / count;
        let squares = points
            .iter()
            .map(|point| (point.position - centre).norm_squared());
        let variance = squares.sum::<f64>() / count;
        let [earliest, latest] = extent(points.iter().map(|point| point.time_s));
        let overlap = 0.5 * (latest - earliest).min(path.end() - path.start());
        let (from, to) = (
            path.start() - latest + overlap,
            path.end() - earliest - overlap,
        );
        // Written so that what is not a number is refused too.
        let sound =
            variance > 1e-12 && variance.is_finite() && to > from && (to - from).is_finite();
        if !sound {
            return Err(nothing_moves());
        }
        let mut q = vec![0.0; robot.joint_count()];
        let table: Vec<Vec<Vector3<f64>>> = targets
            .iter()
            .map(|target| {
                let time = |i: usize| {
                    let share = i as f64 / (TABLE - 1) as f64;
                    (path.start() + share * (path.end() - path.start())).min(path.end())
                };
                let mut position = |i: usize| {
                    path.at(time(i), &mut q);
                    robot.point_in_base(&q, target).coords
                };
                (0..TABLE).map(&mut position).collect()
            })
            .collect();
        let moves =
            |way: &Vec<Vector3<f64>>| way.iter().any(|at| (at - way[0]).norm() > SMALLEST_PATH_MM);
        if !table.iter().any(moves) {
            return Err(nothing_moves());
        }
        Ok(Self {
            path,
            robot,
            targets,
            points,
            table,
            centre,
            variance,
            from,
            to,
        })
    }

    /// The commanded position of a point at an offset, from the table.
    fn commanded(&self, point: &Timed, offset_s: f64) -> Option<Vector3<f64>> {
        let length = self.path.end() - self.path.start();
        let at = (point.time_s + offset_s - self.path.start()) / length * (TABLE - 1) as f64;
        if !(at >= 0.0 && at <= (TABLE - 1) as f64) {
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and the table's length"
        )]
        let entry = (at as usize).min(TABLE - 2);
        let table = &self.table[point.target];
        let share = at - entry as f64;
        Some(table[entry] + (table[entry + 1] - table[entry]) * share)
    }

    /// E(τ) of the module, per point.
    fn cost(&self, offset_s: f64) -> f64 {
        let mut inside = 0.0;
        let mut outside = 0.0;
        let (mut a_sum, mut b_sum) = (Vector3::zeros(), Vector3::zeros());
        let (mut squares, mut moment) = (0.0, Matrix3::zeros());
        for point in &self.points {
            let b = point.position - self.centre;
            match self.commanded(point, offset_s) {
                Some(a) => {
                    inside += 1.0;
                    a_sum += a;
                    b_sum += b;
                    squares += a.norm_squared() + b.norm_squared();
                    moment += b * a.transpose();
                }
                None => outside += b.norm_squared(),
            }
        }
        let count = self.points.len() as f64;
        if inside < 0.5 * count.min(6.0) {
            return self.variance;
        }
        // What overflows fits nothing (and would never let the decomposition end).
        if !squares.is_finite() {
            return self.variance;
        }
        squares -= (a_sum.norm_squared() + b_sum.norm_squared()) / inside;
        moment -= b_sum * a_sum.transpose() / inside;
        let Some(svd) = crate::decompose::svd(moment) else {
            return self.variance;
        };
        let singular = svd.singular_values;
        let smallest = singular.min();
        let sign = if moment.determinant() < 0.0 {
            -1.0
        } else {
            1.0
        };
        let fitted = singular.sum() - smallest + sign * smallest;
        ((squares - 2.0 * fitted).max(0.0) + outside) / count
    }

    /// The lowest place within a step of `near`, and its cost.
    fn refine(&self, near: f64, step: f64) -> (f64, f64) {
        const PARTS: i32 = 16;
        let mut best = (near, self.cost(near));
        let mut width = step;
        // Each round divides the step by eight; ten make it a billionth.
        for _ in 0..10 {
            let centre = best.0;
            for part in -PARTS..=PARTS {
                let at = centre + width * f64::from(part) / f64::from(PARTS);
                if at >= self.from && at <= self.to {
                    let cost = self.cost(at);
                    if cost < best.1 {
                        best = (at, cost);
                    }
                }
            }
            width /= 8.0;
        }
        best
    }

    /// Whether the cost rises clearly between two offsets.
    fn is_ridge_between(&self, a: f64, b: f64, cost: f64) -> bool {
        let between = (1..32).map(|i| self.cost(a + (b - a) * f64::from(i) / 32.0));
        between.fold(0.0, f64::max) > 1.5 * cost + 1e-9 * self.variance
    }

    /// The uncertainty of an offset from what is left; `strictly`: an undetermined one is refused.
    fn judged(&self, offset_s: f64, strictly: bool) -> Result<ClockOffset, Refusal> {
        let mut q = vec![0.0; self.robot.joint_count()];
        let mut position = |point: &Timed, offset_s: f64| {
            let inside = self.path.at(point.time_s + offset_s, &mut q);
            inside.then(|| {
                self.robot
                    .point_in_base(&q, &self.targets[point.target])
                    .coords
            })
        };
        let pairs: Vec<(Vector3<f64>, Vector3<f64>)> = self
            .points
            .iter()
            .filter_map(|point| Some((position(point, offset_s)?, point.position)))
            .collect();
        let near = |v: &Vector3<f64>| v.amax() < FARTHEST_MM;
        if !pairs.iter().all(|(a, b)| near(a) && near(b)) {
            return Err(nothing_moves());
        }
        let Some(motion) = rigid_motion(&pairs).filter(|_| pairs.len() >= 4) else {
            return Err(nothing_moves());
        };
        let error = |(a, b): &(Vector3<f64>, Vector3<f64>)| {
            (motion.transform_point(&Point3::from(*a)).coords - b).norm_squared()
        };
        let sum: f64 = pairs.iter().map(error).sum();
        let rms_mm = (sum / pairs.len() as f64).sqrt();
        // The information on τ that the six parameters of the motion cannot take over.
        let h = 1e-4 * (self.to - self.from) / STEPS as f64 + 1e-6;
        let mut own = 0.0;
        let mut shared = Vector6::zeros();
        let mut frame = Matrix6::zeros();
        for point in &self.points {
            let (Some(before), Some(after)) =
                (position(point, offset_s - h), position(point, offset_s + h))
            else {
                continue;
            };
            let speed = motion.rotation * (after - before) / (2.0 * h);
            let arm = motion
                .transform_point(&Point3::from((before + after) / 2.0))
                .coords
                - self.centre;
            let cross = arm.cross_matrix();
            for axis in 0..3 {
                let turn = cross.row(axis);
                let mut row = Vector6::zeros();
                row[axis] = 1.0;
                row.fixed_rows_mut::<3>(3).copy_from(&-turn.transpose());
                own += speed[axis] * speed[axis];
                shared += row * speed[axis];
                frame += row * row.transpose();
            }
        }
        let explained = crate::decompose::svd(frame).and_then(|svd| {
            let tiny = 1e-9 * svd.singular_values.max();
            svd.solve(&shared, tiny).ok().map(|x| shared.dot(&x))
        });
        let explained = explained.unwrap_or(0.0);
        let left = own - explained;
        let determined = left > 1e-6 * own && own > 0.0;
        if strictly && !determined {
            return Err(Refusal(text!(
                "a shift in time looks like another place of the instrument: the offset of the clocks cannot be found"
            )));
        }
        let freedom = (3.0 * pairs.len() as f64 - 7.0).max(1.0);
        Ok(ClockOffset {
            offset_s,
            sigma_s: determined.then(|| (sum / freedom / left).sqrt()),
            rms_mm,
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::kinematics::{Axis, Joint, JointKind, Pose};

    fn robot() -> Robot {
        let axis = |direction: Vector3<f64>, point: [f64; 3]| {
            Axis::through(direction, Point3::from(point)).expect("a direction")
        };
        Robot {
            name: "r".to_owned(),
            joints: vec![
                Joint::new("pan", JointKind::Revolute, axis(Vector3::z(), [0.0; 3])),
                Joint::new(
                    "tilt",
                    JointKind::Revolute,
                    axis(Vector3::y(), [0.0, 0.0, 300.0]),
                ),
            ],
            base_from_tool: Pose::translation(400.0, 0.0, 300.0),
            gravity_m_s2: None,
            source: crate::kinematics::RobotSource::Axes,
        }
    }

    /// A path that never repeats.
    fn path(seconds: f64, joint: impl Fn(f64) -> [f64; 2]) -> Path {
        let mut path = Path {
            time_s: Vec::new(),
            q: vec![Vec::new(), Vec::new()],
            row: Vec::new(),
        };
        let rows = 2000;
        for row in 0..rows {
            let time = 100.0 + seconds * f64::from(row) / f64::from(rows - 1);
            let q = joint(time - 100.0);
            path.time_s.push(time);
            path.q[0].push(q[0]);
            path.q[1].push(q[1]);
            path.row.push(path.row.len());
        }
        path
    }

    fn measured(path: &Path, offset_s: f64, noise_mm: f64) -> Vec<Timed> {
        let frame = Isometry3::new(
            Vector3::new(900.0, -40.0, 7.0),
            Vector3::new(0.3, -1.0, 2.0),
        );
        let robot = robot();
        let mut q = vec![0.0; 2];
        let mut points = Vec::new();
        for i in 0..225 {
            let time = path.start() + 3.0 + 0.2 * f64::from(i) + 0.012 * f64::from(i % 7);
            if path.at(time, &mut q) {
                let point = frame * robot.point_in_base(&q, &Point3::origin());
                // A noise without chance: three incommensurable sines.
                let wave = |k: f64| noise_mm * (k * f64::from(i)).sin();
                points.push(Timed {
                    time_s: time - offset_s,
                    position: point.coords + Vector3::new(wave(1.7), wave(2.9), wave(0.77)),
                    target: 0,
                });
            }
        }
        points
    }

    #[test]
    fn the_offset_of_the_clocks_is_found_from_the_motion_alone() {
        let path = path(60.0, |t| {
            [
                (0.4 * t).sin() + 0.3 * (0.13 * t).cos(),
                0.5 * (0.27 * t + 0.01 * t * t).sin(),
            ]
        });
        for (offset, noise) in [(0.0, 0.1), (-87.654, 0.1), (12.345, 2.0)] {
            let points = measured(&path, offset, noise);
            let found =
                find(&path, &robot(), &[Point3::origin()], &points).expect("it is determined");
            let sigma = found.sigma_s.expect("it was fitted");
            let off = (found.offset_s - offset).abs();
            assert!(off < 5.0 * sigma + 1e-4, "{offset}: {found:?}");
            assert!(sigma < 1e-3 * noise.max(1.0) && sigma > 1e-6, "{found:?}");
        }
    }

    #[test]
    fn a_motion_that_repeats_is_not_decided() {
        let path = path(60.0, |t| {
            [
                (t * std::f64::consts::TAU / 10.0).sin(),
                0.3 * (t * std::f64::consts::TAU / 5.0).sin(),
            ]
        });
        let points: Vec<Timed> = measured(&path, 0.0, 0.01)
            .into_iter()
            .filter(|point| (115.0..140.0).contains(&point.time_s))
            .collect();
        let found = find(&path, &robot(), &[Point3::origin()], &points);
        assert!(found.unwrap_err().to_string().contains("repeats"));
    }

    #[test]
    fn an_axis_at_constant_speed_does_not_tell_the_time() {
        let path = path(60.0, |t| [0.02 * t, 0.0]);
        let points = measured(&path, 0.0, 0.01);
        let found = find(&path, &robot(), &[Point3::origin()], &points);
        assert!(found.is_err(), "{found:?}");
    }

    #[test]
    fn a_robot_that_stands_does_not_tell_the_time() {
        let path = path(60.0, |_| [0.5, 0.1]);
        let points = measured(&path, 0.0, 0.0);
        assert_eq!(
            find(&path, &robot(), &[Point3::origin()], &points),
            Err(nothing_moves())
        );
    }
}
