//! Identification of long sessions: the paper's method by regions, and the exact fit of nine
//! parameters; `benches/compare/identification.py` times the same work in numpy. And the exact fit of the
//! geometry of a six-joint arm, 27 parameters, to 5000 poses: `tests/reference/arms_beside_others.py`
//! times others with the same.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{Point3, Unit, Vector3};
use truepose::effects::{JointValues, Term, find};
use truepose::fit::{identify_exact, regions_of};
use truepose::inside::Problem;
use truepose::inside::solve;
use truepose::inside::{fit_base_model, start_of_base_model, sum_by_region};
use truepose::kinematics::{Axis, Joint, JointKind, Pose, Range, Robot};
use truepose::model::Model;
use truepose::sessions::RegionChoice;
use truepose::sessions::{Instrument, Samples, Session, Target};

/// A small generator (SplitMix64): the same numbers every time, on every machine.
struct Noise(u64);

impl Noise {
    /// From −½ to ½.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

/// Zero offset, scale, eccentricity, backlash, link length and base offset, seen with noise.
fn session(n: usize) -> Session {
    let mut noise = Noise(7);
    let (mut q, mut dir) = (Vec::with_capacity(n), Vec::with_capacity(n));
    let (mut x, mut y, mut z) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..n {
        let angle = std::f64::consts::PI * noise.next();
        let side = if noise.next() > 0.0 { 1.0 } else { -1.0 };
        let theta = angle * 1.0002 + 0.01 + 3e-4 * (angle - 0.7).sin() - side * 2e-4;
        q.push(angle);
        dir.push(side);
        x.push(249.0 * theta.cos() + 0.3 + 0.1 * noise.next());
        y.push(249.0 * theta.sin() - 0.2 + 0.1 * noise.next());
        z.push(300.1 + 0.1 * noise.next());
    }
    Session {
        name: "bench".to_owned(),
        note: String::new(),
        robot: Robot {
            name: "axis".to_owned(),
            joints: vec![Joint {
                name: "pan".to_owned(),
                kind: JointKind::Revolute,
                axis: Axis {
                    direction: Unit::new_normalize(Vector3::z()),
                    point_mm: Point3::origin(),
                },
                limits: Some(Range {
                    from: -std::f64::consts::FRAC_PI_2,
                    to: std::f64::consts::FRAC_PI_2,
                }),
                link: None,
                follows: None,
                gear_ratio: None,
            }],
            base_from_tool: Pose::translation(250.0, 0.0, 300.0),
            gravity_m_s2: None,
            source: truepose::kinematics::RobotSource::Axes,
        },
        targets: vec![Target {
            name: "tool".to_owned(),
            position_mm: Point3::origin(),
        }],
        instrument: Instrument::default(),
        tolerance_mm: None,
        regions: Vec::new(),
        compensated_by: None,
        samples: Samples {
            q: vec![q],
            q_read: vec![None],
            x_mm: x,
            y_mm: y,
            z_mm: Some(z),
            dir: vec![Some(dir)],
            speed: vec![None],
            ..Samples::default()
        },
        path: None,
    }
}

const NINE_PARAMETERS: [&str; 6] = [
    "joint-zero-offset",
    "joint-scale",
    "encoder-eccentricity",
    "backlash",
    "link-length",
    "base-offset",
];

fn regional(c: &mut Criterion) {
    let mut group = c.benchmark_group("regional identification");
    for n in [1_000, 100_000, 1_000_000] {
        let session = session(n);
        let regions =
            regions_of(&RegionChoice::Uniform(6), &session).expect("six regions over known limits");
        let problem = Problem::new(&session, JointValues::Commanded);
        group.bench_function(n.to_string(), |b| {
            b.iter(|| sum_by_region(black_box(&problem), &regions));
        });
    }
}

fn exact(c: &mut Criterion) {
    let mut group = c.benchmark_group("exact fit of nine parameters");
    group.sample_size(10);
    for n in [1_000, 100_000, 1_000_000] {
        let session = session(n);
        let problem = Problem::new(&session, JointValues::Commanded);
        let start =
            NINE_PARAMETERS
                .iter()
                .fold(Model::nominal(session.robot.clone()), |model, id| {
                    model.with_term(Term::absent(
                        find(id).expect("a name from the catalogue"),
                        0,
                        0.0,
                    ))
                });
        group.bench_function(format!("{n}, least squares"), |b| {
            b.iter(|| solve(black_box(&problem), &start));
        });
        let effects = NINE_PARAMETERS.map(str::to_owned);
        group.bench_function(format!("{n}, with outliers, gap and intervals"), |b| {
            b.iter(|| identify_exact(black_box(&session), &effects, JointValues::Commanded));
        });
    }
}

/// An arm with a spherical wrist: axes and points on them, mm, limits in degrees.
const ARM: [([f64; 3], [f64; 3], [f64; 2]); 6] = [
    ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [-165.0, 165.0]),
    ([0.0, 1.0, 0.0], [0.0, 0.0, 330.0], [-90.0, 110.0]),
    ([0.0, 1.0, 0.0], [0.0, 0.0, 640.0], [-110.0, 65.0]),
    ([1.0, 0.0, 0.0], [0.0, 0.0, 710.0], [-160.0, 160.0]),
    ([0.0, 1.0, 0.0], [340.0, 0.0, 710.0], [-115.0, 115.0]),
    ([1.0, 0.0, 0.0], [340.0, 0.0, 710.0], [-175.0, 175.0]),
];

/// Poses within the limits, every parameter of the geometry off by up to 0.5 mm or 0.5 mrad.
fn arm_session(n: usize) -> Session {
    let mut noise = Noise(11);
    let joint = |(direction, point, limits): ([f64; 3], [f64; 3], [f64; 2])| Joint {
        name: "joint".to_owned(),
        kind: JointKind::Revolute,
        axis: Axis {
            direction: Unit::new_normalize(direction.into()),
            point_mm: point.into(),
        },
        limits: Some(Range {
            from: limits[0].to_radians(),
            to: limits[1].to_radians(),
        }),
        link: None,
        follows: None,
        gear_ratio: None,
    };
    let mut session = session(n);
    session.robot.joints = ARM.map(joint).to_vec();
    session.robot.base_from_tool = Pose::translation(430.0, 5.0, 780.0);
    let within = |[from, to]: [f64; 2], noise: &mut Noise| {
        (from + (to - from) * (noise.next() + 0.5)).to_radians()
    };
    let values = ARM.map(|(_, _, limits)| (0..n).map(|_| within(limits, &mut noise)).collect());
    session.samples.q = values.to_vec();
    session.samples.q_read = vec![None; ARM.len()];
    session.samples.dir = vec![None; ARM.len()];
    session.samples.speed = vec![None; ARM.len()];
    let measured = {
        let problem = Problem::new(&session, JointValues::Commanded);
        let model = start_of_base_model(&session, &problem, |_| true);
        let off = |term: &Term, k: usize, noise: &mut Noise| {
            let turns = term.effect.about().form.turns(k, JointKind::Revolute);
            noise.next() * if turns { 1e-3 } else { 1.0 }
        };
        let mut errors = Vec::new();
        for term in model.terms() {
            errors.extend((0..term.coefficients.len()).map(|k| off(term, k, &mut noise)));
        }
        model.with_coefficients(&errors).predict(&problem.inputs)
    };
    let mut noisy = |all: Vec<f64>| all.into_iter().map(|v| v + 0.1 * noise.next()).collect();
    session.samples.x_mm = noisy(measured.x_mm);
    session.samples.y_mm = noisy(measured.y_mm);
    session.samples.z_mm = Some(noisy(measured.z_mm));
    session
}

fn arm(c: &mut Criterion) {
    let mut group = c.benchmark_group("arm_5000_poses");
    group.sample_size(20);
    let session = arm_session(5000);
    let problem = Problem::new(&session, JointValues::Commanded);
    let start = start_of_base_model(&session, &problem, |_| true);
    let whole = || fit_base_model(&mut problem.clone(), black_box(&start), true);
    // What the poses cannot show is held, as it is chosen once; the values are those of the start.
    let gauged = whole().solution.model;
    let same = |own: &Term, other: &Term| {
        let id = |t: &Term| (t.effect.about().id, t.joint, t.setting.to_bits());
        id(own) == id(other)
    };
    let values = gauged.terms().iter().flat_map(|own| {
        let of_start = start.terms().iter().find(|other| same(own, other));
        of_start.map_or_else(|| own.coefficients.clone(), |t| t.coefficients.clone())
    });
    let from = gauged.with_coefficients(&values.collect::<Vec<f64>>());
    group.bench_function("27 parameters, least squares", |b| {
        b.iter(|| solve(black_box(&problem), &from));
    });
    group.bench_function("with gauge, outliers, noise and priors", |b| b.iter(whole));
}

criterion_group!(benches, regional, exact, arm);
criterion_main!(benches);
