//! What a table corrects along an axis: the deviation that it takes away, over the whole measured range and not
//! only where samples are, with a band of 95 %.
//!
//! ```text
//! curve(q, s) = model − reached    along the motion, from side s
//! var         = j Σ jᵀ + σ_r(q)²    j: derivatives of the prediction along the motion by the coefficients
//! ```
//!
//! Σ is the covariance of the model's coefficients, `σ_r` that of a curve without a name. A sample's deviation with
//! the table is its deviation without, less this curve.

use nalgebra::{Point3, Vector3};

use crate::compensation::with_table::moved_at;
use crate::effects::Inputs;
use crate::fit::uncertainty::normal_95;
use crate::kinematics::JointKind;
use crate::model::{Calibration, Model};
use crate::numeric::whole;

use super::sweep::{ARCSEC, Sweep};

/// Points from one position to the next: enough for a curve to look like one.
const BETWEEN: f64 = 8.0;
/// No screen shows more points of a curve.
const MOST: f64 = 600.0;

/// A place on the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// The commanded position, degrees or mm.
    pub commanded: f64,
    /// The deviation that the table takes away, in the unit of the axis.
    pub deviation: f64,
    /// Half of the interval of 95 %; `None` where the model does not say how sure it is.
    pub half_width: Option<f64>,
}

/// The deviation that a table takes away, from below and from above; empty for a side that was not measured.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TableCurve {
    /// From below, and from above.
    pub sides: [Vec<CurvePoint>; 2],
}

impl TableCurve {
    /// The curve over the positions of a series; `None` without corrected commands.
    pub(super) fn of(sweep: &Sweep<'_, '_>) -> Option<Self> {
        let calibration = sweep.points.correcting()?;
        let [from, to] = [sweep.positions.first()?, sweep.positions.last()?].map(|p| p.0);
        let steps = (BETWEEN * sweep.positions.len() as f64).min(MOST);
        let q: Vec<f64> = (0..=whole(steps))
            .map(|k| from + (to - from) * k as f64 / steps)
            .collect();
        let mut sides = [Vec::new(), Vec::new()];
        for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
            if sweep.positions.iter().any(|p| !p.1[side].is_empty()) {
                sides[side] = side_of(sweep, calibration, &q, sign)?;
            }
        }
        Some(Self { sides })
    }
}

/// `None` where a point is too near to the axis.
fn side_of(
    sweep: &Sweep<'_, '_>,
    calibration: &Calibration,
    q: &[f64],
    sign: f64,
) -> Option<Vec<CurvePoint>> {
    let inputs = poses(sweep, q, sign);
    let nominal = Model::nominal(calibration.model.robot.clone()).predict(&inputs);
    let moved = moved_at(calibration, &inputs);
    let kind = sweep.points.robot.joints[sweep.joint].kind;
    let without = |k: usize| {
        let commanded = Point3::from(nominal.get(k));
        sweep.along(commanded, commanded - Vector3::from(moved.get(k)))
    };
    let sure = standard_deviations(sweep, calibration, &inputs);
    let point = |k: usize| {
        Some(CurvePoint {
            commanded: kind.to_display(q[k]),
            deviation: without(k)?,
            half_width: sure.as_ref().map(|sigma| normal_95() * sigma[k]),
        })
    };
    (0..q.len()).map(point).collect()
}

/// The first sample's pose and conditions at other positions of the joint.
fn poses(sweep: &Sweep<'_, '_>, q: &[f64], sign: f64) -> Inputs<'static> {
    let mut poses = sweep.points.inputs.select(&vec![sweep.first; q.len()]);
    poses.q[sweep.joint] = q.to_vec().into();
    poses.dir[sweep.joint] = Some(vec![sign; q.len()].into());
    poses
}

/// Of the prediction along the motion, in the unit of the axis.
fn standard_deviations(
    sweep: &Sweep<'_, '_>,
    calibration: &Calibration,
    inputs: &Inputs,
) -> Option<Vec<f64>> {
    let (model, covariance) = (&calibration.model, calibration.covariance.as_ref()?);
    let count = model.coefficient_count();
    if covariance.nrows() < count {
        return None;
    }
    let curves = model.terms().iter().filter(|t| t.joint == sweep.joint);
    let curves: Vec<_> = curves.filter_map(|term| term.curve()).collect();
    let per_inner = match sweep.points.robot.joints[sweep.joint].kind {
        JointKind::Revolute => ARCSEC,
        JointKind::Prismatic => 1.0,
    };
    let mut all = Vec::with_capacity(inputs.len());
    model.visit(inputs, true, |start, block| {
        for lane in 0..block.len {
            let point = Point3::from(block.point.map(|axis| axis[lane]));
            let motion = sweep.motion(point);
            let along: Vec<f64> = (0..count)
                .map(|c| motion.dot(&Vector3::from(block.columns[c].map(|axis| axis[lane]))))
                .collect();
            let named: f64 = (0..count)
                .flat_map(|a| (0..count).map(move |b| (a, b)))
                .map(|(a, b)| along[a] * covariance[(a, b)] * along[b])
                .sum();
            let q = inputs.q[sweep.joint][start + lane];
            let dir = inputs.dir[sweep.joint].as_ref();
            let dir = dir.map_or(0.0, |dir| dir[start + lane]);
            let unnamed = curves.iter().filter_map(|curve| curve.sigma_at(q, dir));
            let unnamed: f64 = unnamed.map(|[sigma, ..]| (per_inner * sigma).powi(2)).sum();
            all.push((named.max(0.0) + unnamed).sqrt());
        }
    });
    Some(all)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::{AxisTest, axis_test};
    use super::*;
    use crate::effects::curve::{Curve, Knots, Parts};
    use crate::effects::{Inputs, JointValues, Term};
    use crate::fit::identify_exact;
    use crate::sessions::Session;

    /// Half of the reversal that the session hides, mm.
    const HALF_REVERSAL: f64 = 0.001_75;
    const SIGMA: f64 = 0.000_2;

    fn slide() -> Session {
        let sessions = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../sessions");
        let loaded = crate::sessions::load(sessions.join("slide-lead-error.json"));
        loaded.expect("it is there").session
    }

    /// Offset and backlash as identified, and the means of the runs as a curve without a name.
    fn tested(session: &Session) -> AxisTest {
        let before = axis_test(session, None, 0).expect("it has points");
        let effects = ["joint-zero-offset", "backlash"].map(str::to_owned);
        let found = identify_exact(session, &effects, JointValues::default()).expect("it fits");
        let inputs = Inputs::new(session, JointValues::Commanded);
        let mut calibration = found.calibration(session, &inputs);
        let at = &before.series[0].before.positions;
        let offset = found.parameters[0].value;
        let knots = Knots {
            from: 0.0,
            to: 600.0,
            count: 25,
            period: None,
        };
        let mean = |q: &f64| {
            let near = at
                .iter()
                .min_by(|a, b| (a.commanded - q).abs().total_cmp(&(b.commanded - q).abs()));
            near.and_then(|p| p.mean_of_both).expect("both sides") - offset
        };
        let values: Vec<f64> = knots.places().iter().map(mean).collect();
        let sigma = vec![SIGMA; values.len()];
        let along = |own: Vec<f64>| {
            let mut parts = Parts::default();
            parts[0] = own;
            parts
        };
        let curve = Curve::new(knots, along(values), along(sigma));
        let term = Term::unexplained(0, curve.expect("it is sound"));
        calibration.model = calibration.model.with_term(term);
        axis_test(session, Some(&calibration), 0).expect("it has points")
    }

    #[test]
    fn what_is_left_is_what_was_measured_less_the_curve() {
        let axis = tested(&slide());
        let series = &axis.series[0];
        let (curve, after) = (series.curve.as_ref(), series.corrected.as_ref());
        let (curve, after) = (curve.expect("a curve"), after.expect("a prediction"));
        let between = |side: &[CurvePoint], at: f64| {
            let k = side
                .partition_point(|p| p.commanded < at)
                .clamp(1, side.len() - 1);
            let (a, b) = (side[k - 1], side[k]);
            let t = (at - a.commanded) / (b.commanded - a.commanded);
            a.deviation + t * (b.deviation - a.deviation)
        };
        for (before, after) in series.deviations.iter().zip(after) {
            let at = before.commanded;
            let sides = [(&before.up, &after.up), (&before.down, &after.down)];
            for (side, (before, after)) in curve.sides.iter().zip(sides) {
                assert_eq!((before.len(), after.len()), (5, 5));
                for (before, after) in before.iter().zip(after) {
                    let corrected = between(side, at);
                    assert!((before - after - corrected).abs() < 2e-5);
                }
            }
        }
    }

    #[test]
    fn the_sides_are_the_reversal_apart_and_the_band_holds_both_what_is_named_and_what_is_not() {
        let axis = tested(&slide());
        let curve = axis.series[0].curve.as_ref().expect("a curve");
        let [up, down] = &curve.sides;
        assert_eq!(up.len(), down.len());
        for (up, down) in up.iter().zip(down) {
            let apart = down.deviation - up.deviation;
            assert!((apart - 2.0 * HALF_REVERSAL).abs() < 3e-4, "{apart}");
            let half = up.half_width.expect("the model says how sure it is");
            assert!(half > normal_95() * SIGMA && half < 20.0 * SIGMA, "{half}");
        }
    }

    #[test]
    fn without_a_model_there_is_neither_curve_nor_prediction() {
        let axis = axis_test(&slide(), None, 0).expect("it has points");
        let series = &axis.series[0];
        assert!(series.curve.is_none() && series.corrected.is_none());
        assert_eq!(series.deviations.len(), 25);
    }
}
