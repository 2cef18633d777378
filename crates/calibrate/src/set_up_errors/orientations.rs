//! Orientations that are read in another convention than they were written in: the parts of a quaternion in another
//! order, three angles about other axes, a rotation vector for angles, the inverse.
//!
//! Measured are R = A P B: P is what the robot predicts, A the measuring frame and B the tool's own orientation, both
//! unknown. Between two samples `R₁R₂ᵀ = A P₁P₂ᵀ Aᵀ`, so that the rotation vectors of both sides differ by A alone,
//! whatever B is, and one turn brings all of them together in the right convention only.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::thresholds::{CORRECTED_SHARE, FEW_SAMPLES, FEWEST_SAMPLES, GROSS_TURN_RAD};
use crate::answers::diagnosis::DataProblem;
use crate::decompose::{eigen, svd};
use crate::effects::JointValues;
use crate::fit::spread::spread;
use crate::kinematics::quaternion::log;
use crate::numeric::median;
use crate::sessions::{Session, SessionCorrection};
use crate::text::Text;

/// Beyond this a turn may be one the other way round.
const LARGEST_TURN_RAD: f64 = 2.6;
/// Orientations that fit in no convention are wrong from here on: no robot's zeros are so far off. (Derived: the sum
/// of six zeros that are off by 5° each, half a radian.)
const WRONG_RAD: f64 = 0.5;
/// Conventions that fit alike are named up to here.
const MOST_NAMED: usize = 3;

/// The turning axes of three angles, in their order; the axes move along.
const ORDERS: [[usize; 3]; 8] = [
    [2, 1, 0],
    [0, 1, 2],
    [2, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 0, 2],
];

/// How three numbers make an orientation; `None`: they are a rotation vector.
type Order = Option<[usize; 3]>;

/// A residual of at most so many times the best counts as equivalent in these samples.
const ALIKE: f64 = 1.5;
/// What fits within a milliradian fits.
const EQUAL_RAD: f64 = 1e-3;
/// A measuring frame and a tool that are turned by less than this together are those of the description.
const NEAR_RAD: f64 = 0.3;
/// Turns about a second axis have this share of those about the first, squared.
const SECOND_AXIS: f64 = 0.01;
/// Pairs from which the measuring frame is guessed, each with the next one.
const DRAWS: usize = 8;

/// Orientations of another convention: until they are imported so only the positions are used.
pub(super) fn of_another_convention(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let pairs = Pairs::of(session, values);
    pairs
        .and_then(|pairs| pairs.problem())
        .into_iter()
        .collect()
}

/// The orientations that one as it is read may have been.
type Convention = Box<dyn Fn(UnitQuaternion<f64>) -> Vec<UnitQuaternion<f64>>>;

/// Alternative conventions of measured orientations, each with the option of the import.
fn conventions() -> Vec<(Convention, Text)> {
    let parts = |order: [usize; 4]| {
        move |q: UnitQuaternion<f64>| {
            let old = [q.w, q.i, q.j, q.k];
            let [w, x, y, z] = order.map(|part| old[part]);
            UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
        }
    };
    let (real_first, real_last) = (parts([1, 2, 3, 0]), parts([3, 0, 1, 2]));
    let mut all: Vec<(Convention, Text)> = vec![
        (
            Box::new(move |q| vec![real_first(q)]),
            text!(
                "a quaternion written w, x, y, z: --columns …,qw,qx,qy,qz in the place of qx,qy,qz,qw"
            ),
        ),
        (
            Box::new(move |q| vec![real_last(q)]),
            text!(
                "a quaternion written x, y, z, w: --columns …,qx,qy,qz,qw in the place of qw,qx,qy,qz"
            ),
        ),
        (
            Box::new(|q: UnitQuaternion<f64>| vec![q.inverse()]),
            text!(
                "the inverse of each pose: of a board --camera the other way (fixed, on-tool), else the pose of the tool in the measuring frame"
            ),
        ),
        (
            Box::new(move |q| vec![real_first(q).inverse()]),
            text!("the inverse of a quaternion written w, x, y, z where x, y, z, w is said"),
        ),
        (
            Box::new(move |q| vec![real_last(q).inverse()]),
            text!("the inverse of a quaternion written x, y, z, w where w, x, y, z is said"),
        ),
    ];
    // KUKA's A, B, C are about z, y, x.
    for order in ORDERS.into_iter().filter(|order| order[0] != order[2]) {
        let from = Some(order);
        all.push((
            Box::new(move |q| {
                numbers(from, &q)
                    .map(|[x, y, z]| orientation(from, [z, y, x]))
                    .to_vec()
            }),
            text!("angles written about z, y, x: --columns …,rz,ry,rx in the place of rx,ry,rz"),
        ));
    }
    let orders = || std::iter::once(None).chain(ORDERS.map(Some));
    for to in orders() {
        let name = match to {
            None => "--euler rotvec".to_owned(),
            Some(order) => {
                format!(
                    "--euler {}-moving",
                    order.map(|axis| ["x", "y", "z"][axis]).concat()
                )
            }
        };
        for from in orders().filter(|from| *from != to) {
            all.push((
                Box::new(move |q| numbers(from, &q).map(|own| orientation(to, own)).to_vec()),
                Text::verbatim(name.clone()),
            ));
        }
    }
    all
}

/// The orientation of three numbers: about x, y, z by their axes, or in the order of the turns where an axis recurs.
fn orientation(order: Order, numbers: [f64; 3]) -> UnitQuaternion<f64> {
    let Some(order) = order else {
        return UnitQuaternion::from_scaled_axis(Vector3::from(numbers));
    };
    let recurs = order[0] == order[2];
    let turns = (0..3).map(|turn| {
        let angle = numbers[if recurs { turn } else { order[turn] }];
        UnitQuaternion::from_scaled_axis(Vector3::ith(order[turn], angle))
    });
    turns.fold(UnitQuaternion::identity(), |all, turn| all * turn)
}

/// The three numbers of an orientation, the inverse of [`orientation`]: two answers, of which either may have been
/// written.
fn numbers(order: Order, q: &UnitQuaternion<f64>) -> [[f64; 3]; 2] {
    let Some([i, j, last]) = order else {
        let vector = log(q);
        let around = vector * (1.0 - TAU / vector.norm().max(f64::MIN_POSITIVE));
        return [vector.into(), around.into()];
    };
    let r: Rotation3<f64> = q.to_rotation_matrix();
    let k = 3 - i - j;
    let sign = if (j + 3 - i) % 3 == 1 { 1.0 } else { -1.0 };
    let other = |angle: f64| if angle > 0.0 { angle - PI } else { angle + PI };
    if last == i {
        let a = r[(j, i)].atan2(-sign * r[(k, i)]);
        let b = r[(i, i)].clamp(-1.0, 1.0).acos();
        let c = r[(i, j)].atan2(sign * r[(i, k)]);
        return [[a, b, c], [other(a), -b, other(c)]];
    }
    let mut both = [[0.0; 3]; 2];
    both[0][i] = (-sign * r[(j, k)]).atan2(r[(k, k)]);
    both[0][j] = (sign * r[(i, k)]).clamp(-1.0, 1.0).asin();
    both[0][k] = (-sign * r[(i, j)]).atan2(r[(i, i)]);
    both[1] = both[0].map(other);
    both[1][j] = PI - both[0][j];
    both
}

/// The values of all joints in a sample.
pub(super) fn joint_values(session: &Session, values: JointValues, sample: usize) -> Vec<f64> {
    let samples = &session.samples;
    let value = |joint: usize| {
        let read = samples.q_read.get(joint).and_then(Option::as_ref);
        match (values, read) {
            (JointValues::Read, Some(read)) => read[sample],
            _ => samples.q[joint][sample],
        }
    };
    (0..session.robot.joint_count()).map(value).collect()
}

/// Measured and predicted orientations of pairs of samples.
pub(super) struct Pairs {
    measured: Vec<UnitQuaternion<f64>>,
    predicted: Vec<UnitQuaternion<f64>>,
    pairs: Vec<(usize, usize)>,
    setups: usize,
}

impl Pairs {
    pub(super) fn of(session: &Session, values: JointValues) -> Option<Self> {
        let samples = &session.samples;
        let [w, x, y, z] = samples.orientation_wxyz.as_ref()?;
        let left_out = |i: usize| {
            let of = |list: &Option<Vec<bool>>| list.as_ref().is_some_and(|list| list[i]);
            of(&samples.held_out) || of(&samples.excluded)
        };
        let measured = |i: usize| {
            let q = Quaternion::new(w[i], x[i], y[i], z[i]);
            (q.norm() > 1e-9 && q.norm().is_finite()).then(|| UnitQuaternion::from_quaternion(q))
        };
        let counts = (0..samples.len()).map(|i| !left_out(i) && measured(i).is_some());
        let rows = spread(&counts.collect::<Vec<_>>(), FEW_SAMPLES);
        if rows.len() < FEWEST_SAMPLES {
            return None;
        }
        let predicted = rows.iter().map(|&i| {
            let q = joint_values(session, values, i);
            session.robot.base_from_tool(&q).rotation
        });
        let predicted: Vec<UnitQuaternion<f64>> = predicted.collect();
        let setup = |row: usize| {
            samples
                .setups
                .as_ref()
                .map(|setups| setups.index[rows[row]])
        };
        let count = rows.len();
        let steps = [1, count / 2].into_iter().filter(|step| *step > 0);
        let pairs = steps.flat_map(|step| (0..count).map(move |row| (row, (row + step) % count)));
        let is_sure = |(a, b): &(usize, usize)| {
            let turn = (predicted[*a] * predicted[*b].inverse()).angle();
            setup(*a) == setup(*b) && (GROSS_TURN_RAD..LARGEST_TURN_RAD).contains(&turn)
        };
        let pairs: Vec<(usize, usize)> = pairs.filter(is_sure).collect();
        (pairs.len() >= FEWEST_SAMPLES).then(|| Self {
            measured: rows.iter().filter_map(|&i| measured(i)).collect(),
            predicted,
            pairs,
            setups: samples
                .setups
                .as_ref()
                .map_or(1, |setups| setups.names.len()),
        })
    }

    fn problem(&self) -> Option<DataProblem> {
        let as_stated = self.fit(&|q| vec![q])?.residual_rad;
        if as_stated < GROSS_TURN_RAD {
            return None;
        }
        let fits = conventions().into_iter().filter_map(|(convention, name)| {
            let fit = self.fit(&*convention)?;
            (fit.residual_rad < (CORRECTED_SHARE * as_stated).min(GROSS_TURN_RAD))
                .then_some((fit, name))
        });
        let mut fits: Vec<(Fit, Text)> = fits.collect();
        let least = fits
            .iter()
            .map(|(fit, _)| fit.residual_rad)
            .fold(f64::INFINITY, f64::min);
        // The inverse and an exchange of parts are the same but for two turns: of those that fit alike the one whose frame
        // and tool are turned least is meant, and where they are turned anyway any of them may be.
        fits.retain(|(fit, _)| fit.residual_rad <= (ALIKE * least).max(EQUAL_RAD));
        // Where an angle stays zero, several orders are equivalent: the usual one is first.
        let turned = |fit: &Fit| (fit.turned / GROSS_TURN_RAD).round();
        fits.sort_by(|a, b| turned(&a.0).total_cmp(&turned(&b.0)));
        if fits.first().is_some_and(|(fit, _)| fit.turned < NEAR_RAD) {
            fits.truncate(1);
        }
        let mut names: Vec<Text> = Vec::new();
        for (_, name) in fits {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let mrad = |rad: f64| format!("{:.1} mrad", 1e3 * rad);
        let (what, evidence, proposal) = if !names.is_empty() {
            names.truncate(MOST_NAMED);
            let convention = Text::listed(names, " / ");
            (
                text!(
                    "the orientations are in another convention: {convention}",
                    convention = convention.clone()
                ),
                text!(
                    "turns between samples are off by {before} in the median as they stand, by {after} in that one",
                    before = mrad(as_stated),
                    after = mrad(least)
                ),
                text!(
                    "import them so ({convention}); until then only the positions are used",
                    convention
                ),
            )
        } else if as_stated > WRONG_RAD {
            (
                text!("the orientations are not those of this robot in any convention"),
                text!(
                    "turns between samples are off by {before} in the median, and no order of a quaternion's parts, of angles or of the pose brings them near",
                    before = mrad(as_stated)
                ),
                text!(
                    "check which frames the poses are between, and the joint values; until then only the positions are used"
                ),
            )
        } else {
            return None;
        };
        let correction = SessionCorrection::LeaveOutOrientations;
        Some(DataProblem::of_all(what, evidence, proposal, correction))
    }

    /// Whether the turns between samples determine one measuring frame: they are about several axes.
    pub(super) fn are_of_one_frame(&self) -> bool {
        let turns = self.pairs.iter().map(|(a, b)| {
            let turn = log(&(self.predicted[*a] * self.predicted[*b].inverse()));
            turn * turn.transpose()
        });
        let spread: Matrix3<f64> = turns.sum();
        let mut along: Vec<f64> = eigen(spread).eigenvalues.iter().copied().collect();
        along.sort_by(f64::total_cmp);
        self.setups == 1 && along[1] > SECOND_AXIS * along[2]
    }

    /// How well the measured orientations fit in this convention; `None` where it is not determined.
    pub(super) fn fit(
        &self,
        convention: &dyn Fn(UnitQuaternion<f64>) -> Vec<UnitQuaternion<f64>>,
    ) -> Option<Fit> {
        let measured: Vec<_> = self.measured.iter().map(|q| convention(*q)).collect();
        // Each turn with each of its alternatives.
        let turns = |(a, b): &(usize, usize)| {
            let between = measured[*a]
                .iter()
                .flat_map(|a| measured[*b].iter().map(move |b| log(&(a * b.inverse()))));
            let predicted = log(&(self.predicted[*a] * self.predicted[*b].inverse()));
            (between.collect::<Vec<Vector3<f64>>>(), predicted)
        };
        let turns: Vec<(Vec<Vector3<f64>>, Vector3<f64>)> = self.pairs.iter().map(turns).collect();
        let nearest = |frame: &Matrix3<f64>,
                       (any, predicted): &(Vec<Vector3<f64>>, Vector3<f64>)| {
            let expected = frame * predicted;
            let mut any = any.iter().map(|turn| ((turn - expected).norm(), *turn));
            let first = any.next().unwrap_or((f64::INFINITY, expected));
            any.fold(
                first,
                |best, next| if next.0 < best.0 { next } else { best },
            )
        };
        let residual_rad =
            |frame: &Matrix3<f64>| median(turns.iter().map(|turn| nearest(frame, turn).0));
        let best_of = |frames: Vec<Matrix3<f64>>| {
            let fits = frames
                .into_iter()
                .filter_map(|frame| Some((residual_rad(&frame)?, frame)));
            fits.min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let first = turns.iter().map(|(any, predicted)| (any[0], *predicted));
        let mut frames: Vec<Matrix3<f64>> = frame_of(first).into_iter().collect();
        for draw in 0..DRAWS {
            let at = |step: usize| &turns[(draw * turns.len() / DRAWS + step) % turns.len()];
            let (one, other) = (at(0), at(1));
            for a in &one.0 {
                let both = other.0.iter().map(|b| [(*a, one.1), (*b, other.1)]);
                frames.extend(both.filter_map(|both| frame_of(both.into_iter())));
            }
        }
        let (_, frame) = best_of(frames)?;
        let near = turns.iter().filter_map(|turn| {
            let (off, own) = nearest(&frame, turn);
            (off < WRONG_RAD).then_some((own, turn.1))
        });
        let refined = frame_of(near);
        let (residual_rad, frame) = best_of(refined.into_iter().chain([frame]).collect())?;
        let frame = UnitQuaternion::from_matrix(&frame);
        // The turn of the tool in addition, by the sample with the smallest.
        let tool = measured
            .iter()
            .zip(&self.predicted)
            .map(|(any, predicted)| {
                let mounted = any
                    .iter()
                    .map(|one| ((frame * predicted).inverse() * one).angle());
                mounted.fold(f64::INFINITY, f64::min)
            });
        Some(Fit {
            residual_rad,
            frame,
            turned: frame.angle() + median(tool)?,
        })
    }
}

/// How well a convention fits: the median difference of the turns, and by how much measuring frame and tool are turned
/// against the description; rad.
pub(super) struct Fit {
    pub(super) residual_rad: f64,
    /// The measuring frame of the orientations.
    pub(super) frame: UnitQuaternion<f64>,
    turned: f64,
}

/// The turn that brings the second vectors nearest to the first ones.
fn frame_of(turns: impl Iterator<Item = (Vector3<f64>, Vector3<f64>)>) -> Option<Matrix3<f64>> {
    let moment: Matrix3<f64> = turns.map(|(m, p)| m * p.transpose()).sum();
    let svd = svd(moment)?;
    let (mut u, v_t) = (svd.u?, svd.v_t?);
    // A reflection would fit vectors of one plane as well; it is no turn.
    let value = |k: &usize| svd.singular_values[*k];
    let smallest = (0..3).min_by(|a, b| value(a).total_cmp(&value(b)))?;
    if (u * v_t).determinant() < 0.0 {
        u.column_mut(smallest).neg_mut();
    }
    Some(u * v_t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_numbers_come_back_from_their_orientation() {
        let q = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -0.9, 1.3));
        for order in std::iter::once(None).chain(ORDERS.map(Some)) {
            for numbers in numbers(order, &q) {
                let back = orientation(order, numbers);
                assert!(back.angle_to(&q) < 1e-12, "{order:?}");
            }
        }
    }
}
