//! A smooth correction over a joint's commanded value, for errors that no name explains.
//!
//! ```text
//! p = exp([ξ] s_t(q, dir)) (p + s_r(q, dir) r + s_a(q, dir) a),   s a [`Curve`], r and a turning with the joint
//! ```
//!
//! Of a prismatic joint r leads away from its axis and a is perpendicular to both, so that the three directions are
//! orthogonal.
//!
//! Not an effect of the catalogue: it has no cause, so no search may name it. It has no coefficients either. Its curve
//! comes from a diagnosis, where it was fitted together with the base and the names, and every later fit holds it.

use std::sync::Arc;

use super::about::{About, Form, Quantity, Role, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::curve::{Curve, DIRECTIONS};
use super::joint_frame::JointFrame;
use super::needs::Need;
use super::rest::MOVES;
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::JointKind;
use crate::lanes::{LANES, add_scaled, cross, dot, minus, turned};

/// Its name in models.
pub const UNEXPLAINED: &str = "unexplained";

const ABOUT: About = About {
    id: UNEXPLAINED,
    title: phrase!("Unexplained"),
    stage: Stage::Link,
    form: Form::Plain(&[]),
    equation: "p = exp([ξ] s_t(q)) (p + s_r(q) r + s_a(q) a)",
    source: "penalised regression: Wood, Generalized Additive Models, 2017; cubic weights: Catmull & Rom 1974",
    cause: phrase!("unknown: no effect of the catalogue explains it"),
    usual_size: phrase!("any"),
    confused_with: phrase!(
        "whatever was not measured: it holds for the measured range and the conditions of the session"
    ),
    check: phrase!(
        "look at the machine where the joint stands in that range: scale, bearing, cables, cover"
    ),
    needs: &[NO_NAME],
    role: Role::Unexplained,
    ..About::PLAIN
};

/// It has no name by which it could be fitted.
const NO_NAME: Need = Need::of_samples(phrase!("a smooth correction"), |_, _| {
    Some(text!(
        "it is not an effect that can be fitted by its name: `truepose diagnose` finds what repeats"
    ))
});

/// The effect `unexplained`: what repeats over one joint and has no name.
pub static SMOOTH: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let Some(curve) = &me.curve else { return };
    let q = |lane: usize| block.command(me.joint, lane);
    let dir = |lane: usize| block.side(me.joint, lane);
    let straight =
        |[motion, radial, axial]: [f64; DIRECTIONS]| [motion, radial, axial, 0.0, 0.0, 0.0];
    let values = std::array::from_fn(|lane| straight(curve.at(q(lane), dir(lane))));
    let slope = |lane| straight(curve.slope(q(lane), dir(lane)));
    let slopes = if block.by_command() {
        vec![(me.joint, std::array::from_fn(slope))]
    } else {
        Vec::new()
    };
    displaced(me, block, &values, &slopes);
}

/// Moves the points of a joint's link by each of the [`MOVES`], the turns first, and the derivatives with it; `slopes` are
/// the derivatives of the moves by the commands of some joints, taken to the first order of the turns (their squares are
/// some 10⁻⁸).
pub(super) fn displaced(
    me: &Placed,
    block: &mut Block,
    values: &[[f64; MOVES]; LANES],
    slopes: &[(usize, [[f64; MOVES]; LANES])],
) {
    let (out, along) = across(&me.frame);
    let origin = me.frame.origin_mm;
    let kind = block.robot.joints[me.joint].kind;
    let aside = cross(along, out);
    let third = match kind {
        JointKind::Revolute => along,
        JointKind::Prismatic => aside,
    };
    let shifted = |x, radial, axial| add_scaled(add_scaled(x, out, radial), third, axial);
    let vector =
        |[a, b, c]: [f64; 3]| add_scaled(add_scaled(along.map(|v| v * a), out, b), aside, c);
    block.transform(me, |x, at| {
        let [motion, radial, axial, by @ ..] = values[at.lane];
        let by = vector(by);
        let angle = dot(by, by).sqrt();
        let (sin, cos) = angle.sin_cos();
        let axis = by.map(|v| v / angle.max(f64::MIN_POSITIVE));
        let tilted = |v: [f64; 3]| turned(v, axis, sin, cos);
        // What is not turned stays as it is to the last bit.
        let x = if angle > 0.0 {
            add_scaled(tilted(minus(x, origin)), origin, 1.0)
        } else {
            x
        };
        let moved = shifted(x, radial, axial);
        match kind {
            JointKind::Revolute => {
                let (sin, cos) = motion.sin_cos();
                let about = |v: [f64; 3]| turned(v, along, sin, cos);
                let to = add_scaled(about(minus(moved, origin)), origin, 1.0);
                (to, jacobian(|v| about(tilted(v))), [])
            }
            JointKind::Prismatic => (add_scaled(moved, along, motion), jacobian(tilted), []),
        }
    });
    for (of, slope) in slopes {
        block.shift_by_command_of(me, *of, |x, at| {
            let [motion, radial, axial, ..] = values[at.lane];
            let [motion_slope, radial_slope, axial_slope, by @ ..] = slope[at.lane];
            let (sin, cos) = motion.sin_cos();
            let arm = minus(x, origin);
            let unmoved = match kind {
                JointKind::Revolute => turned(arm, along, -sin, cos),
                JointKind::Prismatic => add_scaled(arm, along, -motion),
            };
            let turn = cross(vector(by), shifted(unmoved, -radial, -axial));
            let shift = shifted(turn, radial_slope, axial_slope);
            match kind {
                JointKind::Revolute => add_scaled(
                    turned(shift, along, sin, cos),
                    cross(along, arm),
                    motion_slope,
                ),
                JointKind::Prismatic => add_scaled(shift, along, motion_slope),
            }
        });
    }
}

/// The derivatives of where a point is turned by where it was.
fn jacobian(about: impl Fn([f64; 3]) -> [f64; 3]) -> [[f64; 3]; 3] {
    let columns = AXES.map(about);
    std::array::from_fn(|row| columns.map(|column| column[row]))
}

const ABOUT_DIRECTIONS: About = About {
    id: "unexplained-directions",
    title: phrase!("Directions of what is unexplained"),
    form: Form::Plain(&[
        Quantity::new("motion_rad", Unit::RADIAN),
        Quantity::new("radial_mm", Unit::MM),
        Quantity::new("axial_mm", Unit::MM),
        Quantity::new("about_motion_rad", Unit::RADIAN),
        Quantity::new("about_radial_rad", Unit::RADIAN),
        Quantity::new("about_axial_rad", Unit::RADIAN),
    ]),
    needs: &[],
    ..ABOUT
};

/// The derivatives of the points with respect to a constant in each of the [`MOVES`]: what a fit of a correction starts
/// from. It moves nothing.
pub static EACH_DIRECTION: Effect = Effect::new(ABOUT_DIRECTIONS, differentiate);

fn differentiate(me: &Placed, block: &mut Block) {
    let (out, along) = across(&me.frame);
    let kind = block.robot.joints[me.joint].kind;
    block.transform(me, |x, _| {
        let arm = minus(x, me.frame.origin_mm);
        let [motion, radial, axial] = match kind {
            JointKind::Revolute => [cross(along, arm), out, along],
            JointKind::Prismatic => [along, out, cross(along, out)],
        };
        let [about_motion, about_radial, about_axial] =
            [along, out, cross(along, out)].map(|axis| cross(axis, arm));
        let columns = [
            motion,
            radial,
            axial,
            about_motion,
            about_radial,
            about_axial,
        ];
        (x, AXES, columns)
    });
}

/// Away from the axis, and along it.
fn across(frame: &JointFrame) -> ([f64; 3], [f64; 3]) {
    (frame.plane_of_motion()[0], frame.along)
}

impl Term {
    /// The smooth correction of a joint (counted from 0) under the name `unexplained`.
    pub fn unexplained(joint: usize, curve: Curve) -> Self {
        Self {
            curve: Some(Arc::new(curve)),
            ..Self::absent(&SMOOTH, joint, 0.0)
        }
    }

    /// The curve of an unexplained correction.
    pub fn curve(&self) -> Option<&Curve> {
        self.curve.as_deref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Inputs;
    use crate::effects::curve::{Knots, Parts};
    use crate::model::Model;
    use crate::testing::column;

    fn curve() -> Curve {
        let knots = Knots {
            from: -1.0,
            to: 1.0,
            period: None,
            count: 9,
        };
        let wave = |a: f64, k: f64| -> Vec<f64> {
            let places = knots.places();
            places.iter().map(|q| a * (k * q).cos()).collect()
        };
        let values = [
            (1e-3, 2.0),
            (0.2, 3.0),
            (-0.1, 1.0),
            (2e-4, 1.0),
            (0.03, 2.0),
            (0.01, 3.0),
        ];
        let values = values.map(|(a, k)| wave(a, k));
        let sigma = values.clone().map(|v| vec![0.0; v.len()]);
        Curve::new(knots, values, sigma).unwrap()
    }

    fn inputs() -> Inputs<'static> {
        let q = vec![vec![-1.4, -0.83, 0.1, 0.4, 1.9]];
        Inputs::at_poses(q, vec![[250.0, 0.0, 300.0]])
    }

    #[test]
    fn the_point_stands_where_angle_radius_and_height_say() {
        let model = Model::nominal(column()).with_term(Term::unexplained(0, curve()));
        let inputs = inputs();
        let predicted = model.predict(&inputs);
        for (i, q) in inputs.q[0].iter().enumerate() {
            let [t, r, a] = curve().at(*q, 0.0);
            let (sin, cos) = (q + t).sin_cos();
            let expected = [(250.0 + r) * cos, (250.0 + r) * sin, 300.0 + a];
            let left = minus(predicted.get(i), expected);
            assert!(left.iter().all(|v| v.abs() < 1e-10), "{q}: {left:?}");
        }
    }

    #[test]
    fn names_beside_it_keep_exact_derivatives() {
        let names = [
            ("link-length", "delta_mm", 0.7),
            ("joint-zero-offset", "offset_deg", 0.3),
        ];
        let names = names.map(|(id, name, v)| Term::from_parameters(id, 1, &[(name, v)], 1));
        let terms = names.into_iter().map(Result::unwrap);
        let terms: Vec<Term> = terms.chain([Term::unexplained(0, curve())]).collect();
        let model = Model::new(column(), terms);
        assert_eq!(model.coefficient_count(), 2);
        let inputs = inputs();
        let mut columns = Vec::new();
        model.visit(&inputs, true, |_, block| columns.clone_from(&block.columns));
        for (k, column) in columns.iter().enumerate() {
            let [below, above] = [-1e-5, 1e-5].map(|by| {
                let mut coefficients = model.coefficients();
                coefficients[k] += by;
                model.with_coefficients(&coefficients).predict(&inputs)
            });
            for i in 0..inputs.len() {
                let by_difference = minus(above.get(i), below.get(i)).map(|d| d / 2e-5);
                for axis in 0..3 {
                    let off = by_difference[axis] - column[axis][i];
                    assert!(off.abs() < 1e-5, "{k} {i} {axis}: {off:e}");
                }
            }
        }
    }

    #[test]
    fn the_directions_are_the_derivatives_of_the_curve() {
        let model = Model::nominal(column());
        let inputs = inputs();
        let probe = model.with_term(Term::absent(&EACH_DIRECTION, 0, 0.0));
        let mut columns = Vec::new();
        probe.visit(&inputs, true, |_, block| columns.clone_from(&block.columns));
        for d in 0..3 {
            let moved = |by: f64| {
                let knots = *curve().knots();
                let mut values = Parts::default();
                values[d] = vec![by; knots.count];
                let sigma = values.clone().map(|v| vec![0.0; v.len()]);
                let constant = Curve::new(knots, values, sigma).unwrap();
                model
                    .with_term(Term::unexplained(0, constant))
                    .predict(&inputs)
            };
            let (below, above) = (moved(-1e-5), moved(1e-5));
            for i in 0..inputs.len() {
                let by_difference = minus(above.get(i), below.get(i)).map(|v| v / 2e-5);
                for axis in 0..3 {
                    let off = by_difference[axis] - columns[d][axis][i];
                    assert!(off.abs() < 1e-5, "{d} {i} {axis}: {off:e}");
                }
            }
        }
    }
}
