//! Identification of long sessions: the paper's method by regions, and the exact fit of nine
//! parameters. `benches/compare/identification.py` times the same work in numpy.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{Point3, Unit, Vector3};
use truepose::effects::{JointValues, Term, find};
use truepose::fit::problem::Problem;
use truepose::fit::solver::solve;
use truepose::fit::{identify_exact, sum_by_region};
use truepose::kinematics::{Axis, Joint, JointKind, Pose, Range, Robot};
use truepose::model::Model;
use truepose::sessions::division::RegionChoice;
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
        let regions = RegionChoice::Uniform(6)
            .resolve(&session)
            .expect("six regions over known limits");
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

criterion_group!(benches, regional, exact);
criterion_main!(benches);
