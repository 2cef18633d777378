//! What a forward position costs: Denavit–Hartenberg matrices, dual quaternions, the point alone.
//!
//! The source paper claims that screws and quaternions beat Denavit–Hartenberg matrices. Here the
//! three stand side by side, on the same robots, with the same answer (asserted before timing).
//! The alternatives are written as one would write them for use: constants precomputed, no
//! allocation, rows of zeros not multiplied. They live here only.
//!
//!     cargo bench --bench forward_position
//!
//! As measured on two shared cores of an AMD EPYC, six joints, ns per position: DH matrices 135, dual
//! quaternions 196. So the claim holds only where nothing but the point is moved (`point only`; `the
//! model` is what every fit runs through: many poses, block by block); full dual quaternions are the
//! slowest of all.
//!
//! `library sines alone` is what the standard library needs for the sines and cosines of the joints;
//! `own sines` gives the matrices the sines of the model's path, so that what is owed to the sines and
//! what to moving only a point can be told apart.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};
use truepose::effects::Inputs;
use truepose::inside::sin_cos_all;
use truepose::kinematics::{DhConvention, DhRow, JointKind, Robot, robot_from_dh};
use truepose::model::Model;

/// So many that the processor learns no pattern, few enough to stay in its first cache; a power of
/// two.
const POSES: usize = 256;

/// A rigid motion as the upper three rows of a homogeneous matrix; the fourth is never multiplied.
type Rows = [[f64; 4]; 3];

struct DhMatrices {
    links: Vec<DhLink>,
}

struct DhLink {
    theta: f64,
    a: f64,
    d: f64,
    cos_alpha: f64,
    sin_alpha: f64,
}

impl DhMatrices {
    fn new(rows: &[DhRow]) -> Self {
        let link = |row: &DhRow| DhLink {
            theta: row.theta_rad,
            a: row.a_mm,
            d: row.d_mm,
            cos_alpha: row.alpha_rad.cos(),
            sin_alpha: row.alpha_rad.sin(),
        };
        Self {
            links: rows.iter().map(link).collect(),
        }
    }

    fn position(&self, q: &[f64]) -> [f64; 3] {
        let sines = |link: &DhLink, value: f64| (link.theta + value).sin_cos();
        let mut links = self.links.iter().zip(q);
        let Some((first, value)) = links.next() else {
            return [0.0; 3];
        };
        let first = matrix(first, sines(first, *value));
        let pose = links.fold(first, |pose, (link, value)| {
            product(&pose, &matrix(link, sines(link, *value)))
        });
        [pose[0][3], pose[1][3], pose[2][3]]
    }

    fn position_with_own_sines(&self, q: &[f64]) -> [f64; 3] {
        let (mut angles, mut sines, mut cosines) = ([0.0; 8], [0.0; 8], [0.0; 8]);
        let n = q.len();
        for ((angle, link), value) in angles.iter_mut().zip(&self.links).zip(q) {
            *angle = link.theta + value;
        }
        sin_cos_all(&angles[..n], &mut sines[..n], &mut cosines[..n]);
        let mut pose = matrix(&self.links[0], (sines[0], cosines[0]));
        for i in 1..n {
            pose = product(&pose, &matrix(&self.links[i], (sines[i], cosines[i])));
        }
        [pose[0][3], pose[1][3], pose[2][3]]
    }
}

#[inline]
fn matrix(link: &DhLink, (sine, cosine): (f64, f64)) -> Rows {
    let (ca, sa) = (link.cos_alpha, link.sin_alpha);
    [
        [cosine, -sine * ca, sine * sa, link.a * cosine],
        [sine, cosine * ca, -cosine * sa, link.a * sine],
        [0.0, sa, ca, link.d],
    ]
}

#[inline]
fn product(a: &Rows, b: &Rows) -> Rows {
    let mut product = [[0.0; 4]; 3];
    for (row, left) in product.iter_mut().zip(a) {
        for (column, entry) in row.iter_mut().enumerate() {
            *entry = left[0] * b[0][column] + left[1] * b[1][column] + left[2] * b[2][column];
        }
        row[3] += left[3];
    }
    product
}

/// r + ε d, of unit length: d = ½ t r for a translation t.
#[derive(Clone, Copy)]
struct DualQuaternion {
    real: Quaternion<f64>,
    dual: Quaternion<f64>,
}

impl DualQuaternion {
    fn times(self, other: Self) -> Self {
        Self {
            real: self.real * other.real,
            dual: self.real * other.dual + self.dual * other.real,
        }
    }

    /// 2 d r̄, whose vector part is the translation.
    fn translation(self) -> [f64; 3] {
        let t = self.dual * self.real.conjugate() * 2.0;
        [t.i, t.j, t.k]
    }
}

/// The product of exponentials with dual quaternions: each joint is cos θ/2 + sin θ/2 (n + ε m).
struct DualQuaternions {
    axes: Vec<(Vector3<f64>, Vector3<f64>)>,
    home: DualQuaternion,
}

impl DualQuaternions {
    fn new(robot: &Robot) -> Self {
        let axis = |joint: &truepose::kinematics::Joint| {
            let n = joint.axis.direction.into_inner();
            (n, joint.axis.point_mm.coords.cross(&n))
        };
        let rotation: UnitQuaternion<f64> = robot.base_from_tool.rotation;
        let t = Quaternion::from_imag(robot.base_from_tool.translation.vector * 0.5);
        Self {
            axes: robot.joints.iter().map(axis).collect(),
            home: DualQuaternion {
                real: rotation.into_inner(),
                dual: t * rotation.into_inner(),
            },
        }
    }

    fn position(&self, q: &[f64]) -> [f64; 3] {
        let motion = |(n, m): &(Vector3<f64>, Vector3<f64>), value: f64| {
            let (sine, cosine) = (0.5 * value).sin_cos();
            DualQuaternion {
                real: Quaternion::from_parts(cosine, n * sine),
                dual: Quaternion::from_imag(m * sine),
            }
        };
        let mut axes = self.axes.iter().zip(q);
        let Some((first, value)) = axes.next() else {
            return self.home.translation();
        };
        axes.fold(motion(first, *value), |before, (axis, value)| {
            before.times(motion(axis, *value))
        })
        .times(self.home)
        .translation()
    }
}

fn row(a_mm: f64, alpha_rad: f64, d_mm: f64) -> DhRow {
    DhRow {
        a_mm,
        alpha_rad,
        d_mm,
        theta_rad: 0.0,
        convention: DhConvention::Standard,
        kind: JointKind::Revolute,
    }
}

fn forward_position(criterion: &mut Criterion) {
    let column = [row(250.0, 0.0, 300.0)];
    let arm = [
        row(0.0, FRAC_PI_2, 89.2),
        row(-425.0, 0.0, 0.0),
        row(-392.3, 0.0, 0.0),
        row(0.0, FRAC_PI_2, 109.2),
        row(0.0, -FRAC_PI_2, 94.7),
        row(0.0, 0.0, 82.3),
    ];
    for (name, rows) in [("1 joint", &column[..]), ("6 joints", &arm[..])] {
        let robot = robot_from_dh(name, rows).expect("the tables above are finite");
        let matrices = DhMatrices::new(rows);
        let duals = DualQuaternions::new(&robot);
        let poses = poses(rows.len());
        let n = rows.len();
        for q in poses.chunks_exact(n) {
            let exact = robot.point_in_base(q, &Point3::origin());
            for other in [
                matrices.position(q),
                matrices.position_with_own_sines(q),
                duals.position(q),
            ] {
                assert!((Point3::from(other) - exact).norm() < 1e-10, "{name}");
            }
        }

        let mut group = criterion.benchmark_group(format!("forward position, {name}"));
        macro_rules! row {
            ($what:literal, $position:expr) => {
                group.bench_function($what, |bencher| {
                    let mut next = 0;
                    bencher.iter(|| {
                        next = (next + 1) % POSES;
                        $position(black_box(&poses[next * n..(next + 1) * n]))
                    });
                });
            };
        }
        row!("DH 4x4 matrices", |q| matrices.position(q));
        row!("dual quaternions", |q| duals.position(q));
        row!("point only", |q| robot.point_in_base(q, &Point3::origin()));
        // What every fit runs through: blocks of samples, one joint after another.
        let model = Model::nominal(robot.clone());
        let column = |joint: usize| poses.iter().skip(joint).step_by(n).copied().collect();
        let home = robot.base_from_tool.translation.vector.into();
        let inputs = Inputs::at_poses((0..n).map(column).collect(), vec![home]);
        group.bench_function("the model, many poses (per 256)", |bencher| {
            bencher.iter(|| model.predict(black_box(&inputs)));
        });
        row!("DH 4x4 matrices, own sines", |q| matrices
            .position_with_own_sines(q));
        row!("library sines alone", |q: &[f64]| q
            .iter()
            .map(|value| value.sin_cos())
            .fold(0.0, |sum, (sine, cosine)| sum + sine + cosine));
        group.finish();
    }
}

/// Joint values of [`POSES`] poses one after another, spread over the circle without a pattern.
fn poses(joints: usize) -> Vec<f64> {
    (0..POSES * joints)
        .map(|i| (i as f64 * 2.399_963_229_728_653) % TAU - PI)
        .collect()
}

criterion_group!(benches, forward_position);
criterion_main!(benches);
