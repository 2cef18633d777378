//! A robot whose errors are known, by plain matrices: forward kinematics that share no code with the
//! program. Written from `tests/reference/programs.py`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use serde_json::Value;

pub(crate) type Matrix = [[f64; 4]; 4];

const G: f64 = 9.81;

/// Everything that `hidden.json` says of a robot.
pub(crate) struct Hidden {
    joints: Vec<(bool, [f64; 3], [f64; 3])>,
    links: Vec<Matrix>,
    zeros: Vec<f64>,
    compliance: Vec<f64>,
    tool: Matrix,
    nominal_tool: Matrix,
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_f64().unwrap())
        .collect()
}

fn matrix(value: &Value) -> Matrix {
    let flat = numbers(value);
    std::array::from_fn(|i| std::array::from_fn(|j| flat[4 * i + j]))
}

pub(crate) fn times(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

fn rotated(axis: [f64; 3], angle: f64, v: [f64; 3]) -> [f64; 3] {
    let (s, c) = angle.sin_cos();
    let cross = cross(axis, v);
    let along: f64 = (0..3).map(|k| axis[k] * v[k]).sum();
    std::array::from_fn(|k| v[k] * c + cross[k] * s + axis[k] * along * (1.0 - c))
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn motion((turns, axis, point): (bool, [f64; 3], [f64; 3]), value: f64) -> Matrix {
    let mut out = [[0.0; 4]; 4];
    out[3][3] = 1.0;
    for k in 0..3 {
        let mut unit = [0.0; 3];
        unit[k] = 1.0;
        let column = if turns {
            rotated(axis, value, unit)
        } else {
            unit
        };
        for i in 0..3 {
            out[i][k] = column[i];
        }
    }
    let moved = rotated(axis, value, point);
    for i in 0..3 {
        out[i][3] = if turns {
            point[i] - moved[i]
        } else {
            axis[i] * value
        };
    }
    out
}

impl Hidden {
    pub(crate) fn new(value: &Value) -> Self {
        let triple = |v: &Value| -> [f64; 3] { numbers(v).try_into().unwrap() };
        let joint = |j: &Value| {
            (
                j["kind"] == "revolute",
                triple(&j["axis"]),
                triple(&j["point"]),
            )
        };
        Self {
            joints: value["joints"]
                .as_array()
                .unwrap()
                .iter()
                .map(joint)
                .collect(),
            links: value["links"]
                .as_array()
                .unwrap()
                .iter()
                .map(matrix)
                .collect(),
            zeros: numbers(&value["zeros"]),
            compliance: numbers(&value["compliance"]),
            tool: matrix(&value["tool"]),
            nominal_tool: matrix(&value["nominal_tool"]),
        }
    }

    /// Where the drawing has the tool.
    pub(crate) fn nominal(&self, q: &[f64]) -> Matrix {
        let mut out = motion(self.joints[0], q[0]);
        for (joint, value) in self.joints.iter().zip(q).skip(1) {
            out = times(&out, &motion(*joint, *value));
        }
        times(&out, &self.nominal_tool)
    }

    /// Where the real tool goes.
    pub(crate) fn real(&self, q: &[f64], load_kg: f64) -> Matrix {
        let mut out: Matrix =
            std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
        for i in 0..q.len() {
            let start = q[i] + self.zeros[i];
            let mut angle = start;
            if self.compliance[i] != 0.0 {
                for _ in 0..20 {
                    angle = start + self.compliance[i] * self.torque(i, angle, q, load_kg);
                }
            }
            out = times(&times(&out, &self.links[i]), &motion(self.joints[i], angle));
        }
        times(&out, &self.tool)
    }

    fn torque(&self, i: usize, angle: f64, q: &[f64], load_kg: f64) -> f64 {
        let mut at = [
            self.nominal_tool[0][3],
            self.nominal_tool[1][3],
            self.nominal_tool[2][3],
        ];
        for k in (i + 1..q.len()).rev() {
            let m = motion(self.joints[k], q[k]);
            at = std::array::from_fn(|r| {
                m[r][0] * at[0] + m[r][1] * at[1] + m[r][2] * at[2] + m[r][3]
            });
        }
        let mut gravity = [0.0, 0.0, -G];
        for k in 0..i {
            if self.joints[k].0 {
                gravity = rotated(self.joints[k].1, -q[k], gravity);
            }
        }
        let (_, axis, point) = self.joints[i];
        let arm = rotated(
            axis,
            angle,
            std::array::from_fn(|k| (at[k] - point[k]) * 1e-3),
        );
        let turning = cross(arm, gravity);
        load_kg * (0..3).map(|k| axis[k] * turning[k]).sum::<f64>()
    }

    /// Joint values near `start` at which the drawing has the tool at this pose: Newton's method on
    /// difference quotients.
    pub(crate) fn nominal_inverse(&self, pose: &Matrix, start: &[f64]) -> Vec<f64> {
        let n = start.len();
        let mut q = start.to_vec();
        for _ in 0..30 {
            let left = difference(&self.nominal(&q), pose);
            let mut rows = vec![vec![0.0; n + 1]; 6];
            for j in 0..n {
                let (mut above, mut below) = (q.clone(), q.clone());
                above[j] += 1e-5;
                below[j] -= 1e-5;
                let slope = difference(&self.nominal(&below), &self.nominal(&above));
                for i in 0..6 {
                    rows[i][j] = slope[i] / 2e-5;
                }
            }
            for i in 0..6 {
                rows[i][n] = left[i];
            }
            for (q, by) in q.iter_mut().zip(solved(rows)) {
                *q += by;
            }
        }
        q
    }
}

/// From one pose to another: mm, and a rotation vector times 300 (mm at 300 mm), near enough for Newton.
fn difference(from: &Matrix, to: &Matrix) -> [f64; 6] {
    let mut turn = [0.0; 3];
    for k in 0..3 {
        let column = |m: &Matrix| [m[0][k], m[1][k], m[2][k]];
        let by = cross(column(from), column(to));
        for i in 0..3 {
            turn[i] += 0.5 * by[i];
        }
    }
    [
        to[0][3] - from[0][3],
        to[1][3] - from[1][3],
        to[2][3] - from[2][3],
        300.0 * turn[0],
        300.0 * turn[1],
        300.0 * turn[2],
    ]
}

/// Gauss with pivots; rows with the right side last.
fn solved(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n)
            .max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs()))
            .unwrap();
        rows.swap(k, pivot);
        for i in 0..n {
            if i != k {
                let factor = rows[i][k] / rows[k][k];
                for j in k..=n {
                    rows[i][j] -= factor * rows[k][j];
                }
            }
        }
    }
    (0..n).map(|k| rows[k][n] / rows[k][k]).collect()
}

/// Distance of two tools, mm, and the angle between them, rad.
pub(crate) fn apart(a: &Matrix, b: &Matrix) -> (f64, f64) {
    let d = difference(a, b);
    let length = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>().sqrt();
    (length(&d[..3]), length(&d[3..]) / 300.0)
}
