//! What planned poses are worth for robots with several joints, measured with kinematics of this file's own
//! (Rodrigues' formula, differences for derivatives), which share nothing with the program's.
//!
//! Measured in November 2026, planned poses against random ones of the same number, 1000 random sets:
//!
//! | arm | poses | RMS, planned / random | 95 %, planned / random | over the best of 1000 |
//! | --- | --- | --- | --- | --- |
//! | six | 30 | 0.0298 / 0.0386 mm = 0.77 | 0.0310 / 0.0519 mm = 0.60 | 0.90 |
//! | six | 60 | 0.0209 / 0.0237 mm = 0.88 | 0.0216 / 0.0301 mm = 0.72 | 0.92 |
//! | parallel | 30 | 0.0299 / 0.0389 mm = 0.77 | 0.0313 / 0.0522 mm = 0.60 | 0.90 |
//! | parallel | 60 | 0.0209 / 0.0238 mm = 0.88 | 0.0215 / 0.0302 mm = 0.71 | 0.91 |
//! | seven | 30 | 0.0324 / 0.0419 mm = 0.77 | 0.0341 / 0.0542 mm = 0.63 | 0.91 |
//! | seven | 60 | 0.0225 / 0.0253 mm = 0.89 | 0.0230 / 0.0311 mm = 0.74 | 0.92 |
//! | scara | 30 | 0.0236 / 0.0281 mm = 0.84 | 0.0245 / 0.0364 mm = 0.67 | 0.93 |
//! | scara | 60 | 0.0166 / 0.0184 mm = 0.90 | 0.0172 / 0.0229 mm = 0.75 | 0.94 |
//! | positioner | 30 | 0.0200 / 0.0226 mm = 0.89 | 0.0206 / 0.0305 mm = 0.68 | 0.95 |
//! | positioner | 60 | 0.0141 / 0.0153 mm = 0.93 | 0.0145 / 0.0200 mm = 0.72 | 0.95 |

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(
    clippy::print_stdout,
    reason = "the table above is what one test prints"
)]

use std::path::PathBuf;

use crate::cases::cases;
use nalgebra::{DMatrix, Matrix3, Vector3};
use serde_json::Value;
use truepose::design::{Plan, PlanOptions, plan_robot, plan_session};
use truepose::diagnosis::NextPose;
use truepose::kinematics::Robot;
use truepose::programs::measuring_program;
use truepose::programs::{Axes, Shape, find};
use truepose::sessions::{Session, load, parse_robot};

const KINDS: [&str; 5] = ["six", "parallel", "seven", "scara", "positioner"];
const SIGMA_MM: f64 = 0.03;

fn data(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name)
}

/// The robot of a session file, as its JSON says it.
fn described(file: &str) -> Value {
    let text = std::fs::read_to_string(data(file)).unwrap();
    let mut all: Value = serde_json::from_str(&text).unwrap();
    all["robot"].take()
}

fn robot(kind: &str) -> (Robot, Bare) {
    let value = described(&format!("arms/{kind}-60.json"));
    let robot = parse_robot(value.to_string().as_bytes()).unwrap().robot;
    (robot, Bare::new(&value))
}

/// An arm by the letter of its file, with a small rigid motion before every joint.
struct Bare {
    /// Whether it turns, direction, point.
    joints: Vec<(bool, Vector3<f64>, Vector3<f64>)>,
    limits: Vec<[f64; 2]>,
    tool: Vector3<f64>,
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::from_fn(|k, _| value[k].as_f64().unwrap())
}

fn turn(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let k = axis.cross_matrix();
    Matrix3::identity() + k * angle.sin() + k * k * (1.0 - angle.cos())
}

impl Bare {
    fn new(robot: &Value) -> Self {
        let joints = robot["joints"].as_array().unwrap();
        let one = |j: &Value| {
            let turns = j["kind"] == "revolute";
            (
                turns,
                vector(&j["axis"]).normalize(),
                vector(&j["point_mm"]),
            )
        };
        let limit = |j: &Value| {
            let inner = if j["kind"] == "revolute" {
                1f64.to_radians()
            } else {
                1.0
            };
            [0, 1].map(|k| j["limits"][k].as_f64().unwrap() * inner)
        };
        Self {
            joints: joints.iter().map(one).collect(),
            limits: joints.iter().map(limit).collect(),
            tool: vector(&robot["tool"]["position_mm"]),
        }
    }

    /// Three turns and three moves before each joint, the same of the whole, shifts of the targets.
    fn size(&self, targets: usize) -> usize {
        6 * self.joints.len() + 6 + 3 * targets
    }

    fn moved(&self, joint: usize, q: f64, p: Vector3<f64>) -> Vector3<f64> {
        let (turns, axis, point) = &self.joints[joint];
        if *turns {
            turn(axis, q) * (p - point) + point
        } else {
            p + axis * q
        }
    }

    /// Where a target is; `x` are errors.
    fn point(&self, q: &[f64], target: &Vector3<f64>, of: usize, x: &[f64]) -> Vector3<f64> {
        let n = self.joints.len();
        let part = |k: usize| Vector3::from_column_slice(&x[k..k + 3]);
        let small = |first: usize, about: &Vector3<f64>, p: Vector3<f64>| {
            let by = part(first);
            let turned = if by.norm() > 0.0 {
                turn(&by.normalize(), by.norm()) * (p - about) + about
            } else {
                p
            };
            turned + part(first + 3)
        };
        let mut p = self.tool + target + part(6 * n + 6 + 3 * of);
        for joint in (0..n).rev() {
            p = self.moved(joint, q[joint], p);
            p = small(6 * joint, &self.joints[joint].2, p);
        }
        small(6 * n, &Vector3::zeros(), p)
    }

    /// Differences of the place by every error, mm.
    fn slopes(&self, q: &[f64], targets: &[Vector3<f64>], of: usize) -> DMatrix<f64> {
        let size = self.size(targets.len());
        let mut all = DMatrix::zeros(3, size);
        for k in 0..size {
            let turns = k < 6 * self.joints.len() + 6 && k % 6 < 3;
            let step = if turns { 1e-5 } else { 1e-3 };
            let at = |by: f64| {
                let mut x = vec![0.0; size];
                x[k] = by;
                self.point(q, &targets[of], of, &x)
            };
            all.set_column(k, &((at(step) - at(-step)) / (2.0 * step)));
        }
        all
    }

    /// What nobody would be surprised by: 1 mm and 2 mrad of a link, 50 mrad of a zero, anything of the
    /// frame; targets within 0.05 mm of one another.
    fn known(&self, targets: usize) -> DMatrix<f64> {
        let n = self.joints.len();
        let mut known = DMatrix::zeros(self.size(targets), self.size(targets));
        for joint in 0..n {
            let (turns, axis, _) = &self.joints[joint];
            let wide = if *turns { 0.05_f64 } else { 10.0 };
            let [tight_turn, tight_move] = [0.002_f64.powi(-2), 1.0];
            for (first, tight, along) in [(0, tight_turn, *turns), (3, tight_move, !*turns)] {
                let of_axis = if along { wide.powi(-2) - tight } else { 0.0 };
                let block = Matrix3::identity() * tight + axis * axis.transpose() * of_axis;
                known
                    .view_mut((6 * joint + first, 6 * joint + first), (3, 3))
                    .copy_from(&block);
            }
        }
        for k in 0..6 {
            known[(6 * n + k, 6 * n + k)] = if k < 3 { 1.0 } else { 1e-6 };
        }
        // Common shift within 50 mm, each within 0.05 mm of the mean.
        let (apart, common) = (0.05_f64.powi(-2), 50_f64.powi(-2));
        for a in 0..targets {
            for b in 0..targets {
                let mean = 1.0 / targets as f64;
                let own = f64::from(u8::from(a == b)) - mean;
                for k in 0..3 {
                    let at = |t: usize| 6 * n + 6 + 3 * t + k;
                    known[(at(a), at(b))] = apart * own + common * mean;
                }
            }
        }
        known
    }

    fn anywhere(&self, random: &mut Lehmer) -> Vec<f64> {
        let limits = self.limits.iter();
        limits
            .map(|[low, high]| low + (high - low) * random.unit())
            .collect()
    }
}

/// A generator of random numbers of this file's own.
struct Lehmer(u128);

impl Lehmer {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(0xda94_2042_e4dd_58b5);
        ((self.0 >> 75) as u64) as f64 / (1_u64 << 53) as f64
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an index below the count"
    )]
    fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count - 1)
    }
}

/// JᵀJ/σ² of poses, whose Jᵀ these are, beside what is known.
fn informed(known: &DMatrix<f64>, slopes: &[&DMatrix<f64>]) -> DMatrix<f64> {
    let all: Vec<f64> = slopes
        .iter()
        .flat_map(|s| s.as_slice().iter().copied())
        .collect();
    let columns = DMatrix::from_vec(known.nrows(), 3 * slopes.len(), all);
    let mut sum = known.clone();
    sum.gemm(SIGMA_MM.powi(-2), &columns, &columns.transpose(), 1.0);
    sum
}

/// What is left of uncertainty over the workspace, mm: root mean square and 95th percentile.
fn uncertainty(information: &DMatrix<f64>, workspace: &[DMatrix<f64>]) -> [f64; 2] {
    let covariance = information.clone().cholesky().unwrap().inverse();
    let of = |j: &DMatrix<f64>| (j * &covariance * j.transpose()).trace().sqrt();
    let mut all: Vec<f64> = workspace.iter().map(of).collect();
    all.sort_by(f64::total_cmp);
    let square: f64 = all.iter().map(|e| e * e).sum();
    [
        (square / all.len() as f64).sqrt(),
        all[all.len() * 95 / 100],
    ]
}

fn ln_determinant(information: &DMatrix<f64>) -> f64 {
    let factor = information.clone().cholesky().unwrap();
    2.0 * factor.l().diagonal().iter().map(|d| d.ln()).sum::<f64>()
}

fn targets(plan: &Plan) -> Vec<Vector3<f64>> {
    plan.targets.iter().map(|t| t.position_mm.coords).collect()
}

fn of_target(plan: &Plan, pose: &NextPose) -> usize {
    let named = |t: &truepose::sessions::Target| Some(&t.name) == pose.target.as_ref();
    plan.targets.iter().position(named).unwrap_or(0)
}

/// The information of a plan, with what is known beforehand.
fn information(bare: &Bare, plan: &Plan) -> DMatrix<f64> {
    let targets = targets(plan);
    let own = |pose: &NextPose| {
        let slopes = bare.slopes(&pose.q, &targets, of_target(plan, pose));
        slopes.transpose()
    };
    let slopes: Vec<DMatrix<f64>> = plan.poses.iter().map(own).collect();
    informed(
        &bare.known(targets.len()),
        &slopes.iter().collect::<Vec<_>>(),
    )
}

fn workspace(bare: &Bare, targets: &[Vector3<f64>], random: &mut Lehmer) -> Vec<DMatrix<f64>> {
    let one = |k: usize, random: &mut Lehmer| {
        bare.slopes(&bare.anywhere(random), targets, k % targets.len())
    };
    (0..200).map(|k| one(k, random)).collect()
}

fn with_poses(poses: usize) -> PlanOptions {
    PlanOptions {
        poses: Some(poses),
        sigma_mm: Some(SIGMA_MM),
        ..PlanOptions::default()
    }
}

#[test]
fn planned_poses_leave_less_uncertainty_than_random_ones_on_every_arm() {
    println!(
        "| arm | poses | RMS, planned / random | 95 %, planned / random | over the best of 1000 |"
    );
    for kind in cases(&KINDS, 1) {
        let (robot, bare) = robot(kind);
        let mut random = Lehmer(0x1234_5678_9abc_def1);
        let mut made: Option<[Vec<DMatrix<f64>>; 2]> = None;
        for poses in cases(&[30, 60], 1).iter().copied() {
            let plan = plan_robot(&robot, &with_poses(poses)).unwrap();
            assert_eq!(plan.poses.len(), poses);
            let targets = targets(&plan);
            let [workspace, pool] = made.get_or_insert_with(|| {
                let anywhere = |k: usize, random: &mut Lehmer| {
                    let q = bare.anywhere(random);
                    bare.slopes(&q, &targets, k % targets.len()).transpose()
                };
                let pool = (0..600).map(|k| anywhere(k, &mut random)).collect();
                [workspace(&bare, &targets, &mut random), pool]
            });
            let planned = information(&bare, &plan);
            let own = uncertainty(&planned, workspace);
            let known = bare.known(targets.len());
            let mut random = Lehmer(9_876_543_211);
            let mut best = f64::NEG_INFINITY;
            let (mut mean, mut sets) = ([0.0; 2], 0);
            for design in 0..1000 {
                let drawn: Vec<&DMatrix<f64>> = (0..poses)
                    .map(|_| &pool[random.below(pool.len())])
                    .collect();
                let sum = informed(&known, &drawn);
                best = best.max(ln_determinant(&sum));
                if design < 40 {
                    let left = uncertainty(&sum, workspace);
                    mean = [mean[0] + left[0], mean[1] + left[1]];
                    sets += 1;
                }
            }
            let ratio = [0, 1].map(|k| own[k] * f64::from(sets) / mean[k]);
            // Per parameter: the volume of the ellipsoid that is left, as a length.
            let parameters = plan.geometry.as_ref().unwrap().parameters as f64;
            let volume = (0.5 * (best - ln_determinant(&planned)) / parameters).exp();
            println!(
                "| {kind} | {poses} | {:.4} / {:.4} mm = {:.2} | {:.4} / {:.4} mm = {:.2} | {volume:.2} |",
                own[0],
                mean[0] / f64::from(sets),
                ratio[0],
                own[1],
                mean[1] / f64::from(sets),
                ratio[1],
            );
            assert!(
                ratio[0] < 0.97 && ratio[1] < 0.85,
                "{kind}, {poses}: {ratio:?}"
            );
            assert!(volume < 0.97, "{kind}, {poses}: {volume}");
            // What the plan says of itself is what is found here.
            let said = plan.geometry.as_ref().unwrap().after.error;
            let apart = [said.rms_mm / own[0], said.p95_mm / own[1]];
            assert!(
                apart.iter().all(|a| (0.85..1.18).contains(a)),
                "{kind}: {apart:?}"
            );
        }
    }
}

#[test]
fn so_many_poses_are_enough_as_are_said_and_fewer_are_not() {
    for (kind, wanted) in cases(&[("scara", 0.02), ("six", 0.03)], 1).iter().copied() {
        let (robot, bare) = robot(kind);
        let options = PlanOptions {
            accuracy_mm: Some(wanted),
            sigma_mm: Some(SIGMA_MM),
            ..PlanOptions::default()
        };
        let plan = plan_robot(&robot, &options).unwrap();
        let poses = plan.poses.len();
        assert_eq!(
            plan.geometry.as_ref().unwrap().enough,
            Some((wanted, poses))
        );
        let workspace = workspace(&bare, &targets(&plan), &mut Lehmer(77));
        let reached = uncertainty(&information(&bare, &plan), &workspace)[1];
        assert!(reached < 1.1 * wanted, "{kind}, {poses}: {reached}");
        let fewer = plan_robot(&robot, &with_poses(poses * 3 / 4)).unwrap();
        let left = uncertainty(&information(&bare, &fewer), &workspace)[1];
        assert!(left > wanted, "{kind}, {poses}: {left}");
        // Twice the noise takes about four times as many.
        let noisy = PlanOptions {
            sigma_mm: Some(1.4 * SIGMA_MM),
            ..options.clone()
        };
        let more = plan_robot(&robot, &noisy).unwrap().poses.len();
        assert!(
            (1.5..2.6).contains(&(more as f64 / poses as f64)),
            "{kind}: {poses} {more}"
        );
    }
    let (robot, _) = robot("six");
    let impossible = PlanOptions {
        accuracy_mm: Some(1e-4),
        ..PlanOptions::default()
    };
    let refused = plan_robot(&robot, &impossible).unwrap_err();
    let says = refused.describe();
    assert!(says.contains("poses are expected to leave"), "{says}");
}

#[test]
fn limits_hold_both_sides_are_tried_and_the_way_is_short() {
    for kind in cases(&KINDS, 2) {
        let (robot, bare) = robot(kind);
        let plan = plan_robot(&robot, &with_poses(60)).unwrap();
        for (joint, [low, high]) in bare.limits.iter().enumerate() {
            let sides = |side: f64| plan.poses.iter().filter(|p| p.dir[joint] == side).count();
            assert_eq!(sides(1.0) + sides(-1.0), 60, "{kind}");
            assert!(sides(1.0).min(sides(-1.0)) >= 12, "{kind}, joint {joint}");
            for pose in &plan.poses {
                assert!((*low..=*high).contains(&pose.q[joint]), "{kind}: {pose:?}");
            }
        }
        // Against the mean of random orders, the joint that takes longest counting.
        let time = |a: &[f64], b: &[f64]| {
            let each = a.iter().zip(b).zip(&bare.joints);
            let each = each.map(|((a, b), joint)| {
                (a - b).abs() / if joint.0 { 10f64.to_radians() } else { 50.0 }
            });
            each.fold(0.0, f64::max)
        };
        let way = |order: &[usize]| -> f64 {
            let pairs = order.windows(2);
            pairs
                .map(|w| time(&plan.poses[w[0]].q, &plan.poses[w[1]].q))
                .sum()
        };
        let order: Vec<usize> = (0..60).collect();
        let mut random = Lehmer(5);
        let mut shuffled = order.clone();
        let mut mean = 0.0;
        for _ in 0..20 {
            for k in (1..60).rev() {
                shuffled.swap(k, random.below(k + 1));
            }
            mean += way(&shuffled) / 20.0;
        }
        println!(
            "{kind}: way {:.0} s, in random order {mean:.0} s",
            way(&order)
        );
        assert!(way(&order) < 0.85 * mean, "{kind}: {} {mean}", way(&order));
        assert_eq!(
            plan,
            plan_robot(&robot, &with_poses(60)).unwrap(),
            "the same every time"
        );
    }
}

/// The smallest distance of a line of sight from the robot's rods, by brute force, mm; the end at the
/// target does not count.
fn clear(bare: &Bare, q: &[f64], target: &Vector3<f64>, from: &Vector3<f64>) -> f64 {
    let n = q.len();
    let none = vec![0.0; bare.size(1)];
    let end = bare.point(q, target, 0, &none);
    let joint = |k: usize| {
        (0..k)
            .rev()
            .fold(bare.joints[k].2, |p, j| bare.moved(j, q[j], p))
    };
    let far = (end - from).norm();
    let mut least = f64::INFINITY;
    for k in 0..n - 1 {
        let (a, b) = (joint(k), joint(k + 1));
        for i in 0..=60 {
            let rod = a + (b - a) * (f64::from(i) / 60.0);
            for j in 0..=300 {
                let along = (far - 150.0) * f64::from(j) / 300.0;
                let at = from + (end - from) * (along / far);
                least = least.min((at - rod).norm());
            }
        }
    }
    least
}

#[test]
fn targets_in_the_shadow_of_the_robot_or_facing_away_are_left_out() {
    let (robot, bare) = robot("six");
    let from = Vector3::new(1500.0, 200.0, 900.0);
    let options = |instrument: bool, cone: Option<f64>| PlanOptions {
        instrument_mm: instrument.then(|| from.into()),
        cone_rad: cone,
        ..with_poses(40)
    };
    let hidden = |plan: &Plan| {
        let targets = targets(plan);
        let of = |p: &&NextPose| clear(&bare, &p.q, &targets[of_target(plan, p)], &from) < 78.0;
        plan.poses.iter().filter(of).count()
    };
    assert_eq!(
        hidden(&plan_robot(&robot, &options(true, None)).unwrap()),
        0
    );
    let anywhere = hidden(&plan_robot(&robot, &options(false, None)).unwrap());
    assert!(anywhere >= 5, "the rule has nothing to do: {anywhere}");
    // The target faces away from the tool's origin; differences of places show where.
    let cone = 60f64.to_radians();
    let plan = plan_robot(&robot, &options(true, Some(cone))).unwrap();
    let none = vec![0.0; bare.size(1)];
    for pose in &plan.poses {
        let target = targets(&plan)[of_target(&plan, pose)];
        let out = if target.norm() > 1.0 {
            target
        } else {
            Vector3::z()
        };
        let at = |p: &Vector3<f64>| bare.point(&pose.q, p, 0, &none);
        let faces = at(&out) - at(&Vector3::zeros());
        let angle = faces.angle(&(from - at(&target)));
        assert!(angle <= cone + 1e-6, "{}", angle.to_degrees());
    }
    let blind = plan_robot(&robot, &options(true, Some(1e-6))).unwrap_err();
    let says = blind.describe();
    assert!(says.contains("none is seen from where"), "{says}");
}

fn observed(name: &str) -> Session {
    load(data(&format!("observations/{name}.json")))
        .unwrap()
        .session
}

#[test]
fn every_kind_of_measurement_is_planned_for() {
    for name in [
        "six-distance",
        "six-distance-unknown",
        "six-bearing",
        "six-bearing-unknown",
        "six-pose",
        "six-pointing",
        "six-socket",
        "six-socket-length",
        "six-touch",
        "six-touch-unknown",
        "six-mix",
        "six-tracker",
        "six-partial",
        "scara-mix",
    ] {
        let session = observed(name);
        let plan = plan_session(&session, &PlanOptions::default(), &|_| true).unwrap();
        let geometry = plan.geometry.as_ref().unwrap();
        assert_eq!(plan.poses.len(), 20, "{name}");
        let (before, after) = (geometry.before, geometry.after);
        assert!(
            after.error.rms_mm < before.error.rms_mm,
            "{name}: {before:?} {after:?}"
        );
        assert!(
            after.error.p95_mm > 0.0 && after.observability.is_finite(),
            "{name}"
        );
        assert!(before.observability > 0.0, "{name}: {before:?}");
        for pose in &plan.poses {
            for (q, joint) in pose.q.iter().zip(&session.robot.joints) {
                let limits = joint.limits.unwrap();
                assert!((limits.from..=limits.to).contains(q), "{name}");
            }
        }
    }
}

/// A ball has to be in its cup, and a probe on its flat: the nominal robot of this file brings it within
/// what the simulated errors of the arm are, which are some mm.
#[test]
fn a_target_that_is_held_is_brought_to_where_it_is_held() {
    for (name, places) in [("six-socket", "sockets"), ("six-touch", "planes")] {
        let text = std::fs::read_to_string(data(&format!("observations/{name}.json"))).unwrap();
        let all: Value = serde_json::from_str(&text).unwrap();
        let bare = Bare::new(&all["robot"]);
        let target = vector(&all["targets"]["T1"]);
        let plan = plan_session(&observed(name), &PlanOptions::default(), &|_| true).unwrap();
        let none = vec![0.0; bare.size(1)];
        for pose in &plan.poses {
            let at = bare.point(&pose.q, &target, 0, &none);
            let off = all[places].as_object().unwrap().values().map(|place| {
                if places == "sockets" {
                    return (vector(&place["position_mm"]) - at).norm();
                }
                let distance = place["distance_mm"].as_f64().unwrap();
                (vector(&place["normal"]).dot(&at) - distance).abs()
            });
            let nearest = off.fold(f64::INFINITY, f64::min);
            assert!(nearest < 25.0, "{name}: {nearest} mm");
        }
    }
}

#[test]
fn a_program_of_joint_moves_reads_back_as_what_was_planned() {
    for (kind, languages) in [
        ("six", &["rapid", "krl", "urscript"][..]),
        ("scara", &["rapid", "krl"]),
        ("positioner", &["rapid", "krl", "urscript"]),
    ] {
        let (robot, bare) = robot(kind);
        let plan = plan_robot(&robot, &with_poses(24)).unwrap();
        for language in languages {
            let text = measuring_program(&plan.poses, &robot, language).unwrap();
            let program = find(language).unwrap();
            let axes = Axes::new(&robot);
            let read = program.read(text.as_bytes(), &axes, None).unwrap();
            assert!(
                read.at_run_time.is_empty(),
                "{language}: {:?}",
                read.at_run_time.len()
            );
            let values: Vec<Vec<f64>> = read
                .targets
                .iter()
                .map(|target| {
                    let Shape::Joints {
                        numbers,
                        scales: inner,
                        ..
                    } = &target.shape
                    else {
                        panic!("{language}: no joint values");
                    };
                    numbers
                        .iter()
                        .zip(inner.iter())
                        .map(|(n, inner)| n.value * inner)
                        .collect()
                })
                .collect();
            assert_eq!(
                values.len(),
                48,
                "{kind}, {language}: an approach and a stop each"
            );
            for (pair, pose) in values.chunks(2).zip(&plan.poses) {
                for joint in 0..pose.q.len() {
                    assert!((pair[1][joint] - pose.q[joint]).abs() < 1e-5, "{language}");
                    // The approach comes from the side that is asked for, within the limits.
                    let way = (pair[1][joint] - pair[0][joint]) * pose.dir[joint];
                    assert!(way > 0.01, "{kind}, {language}, joint {joint}: {way}");
                    let [low, high] = bare.limits[joint];
                    assert!(pair[0][joint] > low - 1e-5 && pair[0][joint] < high + 1e-5);
                }
            }
        }
    }
    let (seven, _) = robot("seven");
    let plan = plan_robot(&seven, &with_poses(10)).unwrap();
    assert!(measuring_program(&plan.poses, &seven, "krl").is_err());
    let (scara, _) = robot("scara");
    let plan = plan_robot(&scara, &with_poses(10)).unwrap();
    assert!(measuring_program(&plan.poses, &scara, "urscript").is_err());
}

fn truepose(arguments: &[&str]) -> (i32, String, String) {
    let done = crate::program::truepose().args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        done.status.code().unwrap(),
        text(done.stdout),
        text(done.stderr),
    )
}

#[test]
fn the_command_writes_what_compensate_reads() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(at("six.json"), described("arms/six-60.json").to_string()).unwrap();
    let session = data("arms/six-60.json");
    let (code, _, errors) = truepose(&[
        "identify",
        session.to_str().unwrap(),
        "--out",
        &at("model.json"),
    ]);
    assert_eq!(code, 0, "{errors}");
    for (name, language) in [
        ("list.csv", None),
        ("list.mod", None),
        ("list.src", None),
        ("x.txt", Some("urscript")),
    ] {
        let (robot, out) = (at("six.json"), at(name));
        let mut arguments = vec!["plan", &robot, "--poses", "12", "--out", &out];
        arguments.extend(language.iter().flat_map(|l| ["--as", *l]));
        let (code, said, errors) = truepose(&arguments);
        assert_eq!(code, 0, "{errors}");
        assert!(said.contains("Observability index"), "{said}");
        let corrected = at(&format!("corrected {name}"));
        let model = at("model.json");
        let mut arguments = vec!["compensate", &model, &out, "--out", &corrected, "--json"];
        arguments.extend(language.iter().flat_map(|l| ["--as", *l]));
        let (code, answer, errors) = truepose(&arguments);
        // A target at the very end of a joint may not be left any room: that is said, and no failure to read.
        assert!(code == 0 || code == 1, "{name}: {errors}");
        let answer: Value = serde_json::from_str(&answer).unwrap();
        let count = if name == "list.csv" { 12 } else { 24 };
        assert_eq!(
            answer["summary"]["targets"], count,
            "{name}: {}",
            answer["summary"]
        );
    }
    let (code, _, errors) = truepose(&[
        "plan",
        &at("six.json"),
        "--poses",
        "5",
        "--out",
        &at("x.ls"),
    ]);
    assert_eq!(code, 2);
    assert!(
        errors.contains("fanuc-ls") && errors.contains("krl"),
        "{errors}"
    );
    assert!(!folder.path().join("x.ls").exists());
    let wrong: [&[&str]; 5] = [
        &["--accuracy", "0"],
        &["--accuracy", "0.1", "--poses", "5"],
        &["--instrument", "1,2"],
        &["--cone", "400"],
        &["--accuracy", "0.1", "--separate", "backlash,tracking-lag"],
    ];
    let six = at("six.json");
    for wrong in wrong {
        let all = [&["plan", &six], wrong].concat();
        assert_eq!(truepose(&all).0, 2, "{wrong:?}");
    }
    let (code, answer, errors) =
        truepose(&["plan", &at("six.json"), "--accuracy", "0.04", "--json"]);
    assert_eq!(code, 0, "{errors}");
    let answer: Value = serde_json::from_str(&answer).unwrap();
    let geometry = &answer["geometry"];
    assert_eq!(geometry["before_is"], "random poses");
    assert_eq!(
        geometry["enough"]["poses"],
        answer["poses"].as_array().unwrap().len()
    );
    assert_eq!(geometry["curve"][2]["poses"], 50);
    for key in ["before", "after"] {
        assert!(geometry["observability_mm"][key].as_f64().unwrap() > 0.0);
        assert!(geometry["expected_error"][key]["p95_mm"].as_f64().unwrap() > 0.0);
    }
}
