//! The paper's identification: constant corrections of angle and radius, region by region.
//!
//! ```text
//! ΔP = P_nominal − P_actual = M Δρ,   M = [[0, 1], [l1, 0]],   Δρ = (Δθ, Δl1)        (5), (6)
//! Δρ_i = (Nᵀ N)⁻¹ Nᵀ ΔQ_i,   N the rows M of the region's samples                    (7)
//! ```
//!
//! so Δl1 is the mean of ΔPx and Δθ that of ΔPy over l1. x is the radial direction at home, y a
//! quarter turn further; l1 is the reflector's distance from the axis.
//!
//! (5) drops the rotation between the lamp's frame and the base frame, so that one constant error
//! looks different in every region. The method is kept because reports compare against it;
//! [`identify_exact`](super::identify_exact) is the one to use.

use crate::effects::JointValues;
use crate::kinematics::JointKind;
use crate::lanes::dot;
use crate::model::{Model, RegionalCorrection};
use crate::sessions::{Region, Session};
use crate::text::Text;
use crate::text::length;

use super::IdentifyError;
use super::adaptive::regions_of;
use super::answer::{left_out, outliers};
use super::gap::suspects;
use super::gap::{Deviations, Spread};
use super::plane::{Plane, RegionSums, sum_by_region};
use super::problem::Problem;
use super::uncertainty::half_width_factor;
use crate::answers::identification::{Gap, Identification, Quality, RegionResult};
use crate::sessions::division::RegionChoice;
use crate::sessions::regions::Assignment;

/// The paper's identification of a session with a single revolute joint.
///
/// # Errors
/// Another robot, regions that make no sense, or no sample to fit.
pub fn identify_regional(
    session: &Session,
    choice: &RegionChoice,
    values: JointValues,
) -> Result<Identification, IdentifyError> {
    let session = &*session.whole()?;
    single_revolute_joint(session)?;
    let regions = regions_of(choice, session)?;
    let mut problem = Problem::new(session, values);
    problem.axis_weights = [1.0, 1.0, 0.0];
    if problem.samples() == 0 {
        return Err(IdentifyError::NothingToFit);
    }
    let (sums, outside) = sum_by_region(&problem, &regions);
    let corrections: Vec<(f64, f64)> = sums.iter().map(RegionSums::correction).collect();

    let assignment = Assignment::new(&regions);
    let plane = Plane::new(&problem);
    let blank = || Deviations {
        axes_mm: std::array::from_fn(|_| vec![f64::NAN; session.samples.len()]),
        length_mm: vec![f64::NAN; session.samples.len()],
    };
    let (mut before, mut after) = (blank(), blank());
    plane.each_sample(&problem.usable, |i, dx, dy, l1| {
        if let Some(region) = assignment.region_of(problem.inputs.q[0][i]) {
            // (8): the corrected position is q + M Δρ.
            let (theta, l1_mm) = corrections[region];
            put(&mut before, i, plane.deviation(dx, dy));
            put(&mut after, i, plane.deviation(dx - l1_mm, dy - l1 * theta));
        }
    });
    let suspected = suspects(&problem, &after);
    let results = regions
        .iter()
        .zip(&sums)
        .enumerate()
        .filter(|(_, (_, s))| s.samples > 0);
    let results = results.map(|(k, (region, sums))| {
        let inside =
            |i: usize| problem.fit[i] && assignment.region_of(problem.inputs.q[0][i]) == Some(k);
        region_result(region, sums, &before, &after, &inside, &suspected)
    });
    let results: Vec<RegionResult> = results.collect();
    let gap_over = |counts: &dyn Fn(usize) -> bool| {
        let outlier = |i: usize| suspected[i];
        Some(Gap {
            before: Spread::of(&before.length_mm, counts, outlier)?,
            after: Spread::of(&after.length_mm, counts, outlier)?,
            samples: (0..suspected.len())
                .filter(|i| counts(*i) && !after.length_mm[*i].is_nan())
                .count(),
        })
    };
    let gap = gap_over(&|i| problem.fit[i]).ok_or(IdentifyError::NothingToFit)?;
    let held_out = session.samples.held_out.as_deref();
    let mut notes = notes(session, &regions, &sums, outside);
    if *choice == RegionChoice::Adaptive {
        notes.push(compared_with_uniform(
            session,
            regions.len(),
            gap.after.rms_mm,
            values,
        )?);
    }
    Ok(Identification {
        session: session.name.clone(),
        method: "regional",
        samples: session.samples.len(),
        model: Model::nominal(session.robot.clone()),
        covariance: None,
        parameters: Vec::new(),
        not_identifiable: Vec::new(),
        gap,
        held_out: held_out.and_then(|h| gap_over(&|i| problem.usable[i] && h[i])),
        levels: Vec::new(),
        expected: None,
        outliers: outliers(&after.length_mm, suspected.iter().copied()),
        left_out: left_out(&problem),
        noise_mm: None,
        noise: None,
        kinds: Vec::new(),
        quality: Quality {
            stopped: phrase!("solved directly"),
            converged: true,
            passes: 1,
            coefficients: 2 * results.len(),
            rank: 2 * results.len(),
            condition: 1.0,
        },
        notes,
        regions: results,
    })
}

fn single_revolute_joint(session: &Session) -> Result<(), IdentifyError> {
    let refuse = |why: Text| Err(IdentifyError::NotASingleRevoluteJoint(why));
    let joints = &session.robot.joints;
    if joints.len() != 1 {
        return refuse(text!(
            "this robot has {joints} joints",
            joints = joints.len()
        ));
    }
    if joints[0].kind != JointKind::Revolute {
        return refuse(text!("this robot's joint slides"));
    }
    let along = joints[0].axis.direction.into_inner();
    if session.samples.z_mm.is_none() && along.z.abs() < 1.0 - 1e-6 {
        return refuse(text!(
            "z was not measured, and the joint does not turn about z"
        ));
    }
    Ok(())
}

fn put(deviations: &mut Deviations, sample: usize, e: [f64; 3]) {
    for (column, value) in deviations.axes_mm.iter_mut().zip(e) {
        column[sample] = value;
    }
    deviations.length_mm[sample] = dot(e, e).sqrt();
}

fn region_result(
    region: &Region,
    sums: &RegionSums,
    before: &Deviations,
    after: &Deviations,
    inside: &dyn Fn(usize) -> bool,
    suspected: &[bool],
) -> RegionResult {
    let (theta_rad, l1_mm) = sums.correction();
    let n = sums.samples as f64;
    let rss = sums.square - n * l1_mm * l1_mm - sums.l1_l1 * theta_rad * theta_rad;
    let freedom = (2 * sums.samples).saturating_sub(2);
    let half = |scale: f64| {
        (freedom > 0).then(|| {
            let variance = rss.max(0.0) / freedom as f64 / scale;
            half_width_factor(freedom) * variance.sqrt()
        })
    };
    let interval = |value: f64, half: Option<f64>| half.map(|h| [value - h, value + h]);
    let outlier = |i: usize| suspected[i];
    let rms = |d: &Deviations| Spread::of(&d.length_mm, inside, outlier).map_or(0.0, |s| s.rms_mm);
    RegionResult {
        correction: RegionalCorrection {
            name: region.name.clone(),
            from_rad: region.from_rad,
            to_rad: region.to_rad,
            samples: sums.samples,
            theta_rad,
            l1_mm,
        },
        theta_ci95: if sums.l1_l1 > 0.0 {
            interval(theta_rad, half(sums.l1_l1))
        } else {
            None
        },
        l1_ci95: interval(l1_mm, half(n)),
        rms_before_mm: rms(before),
        rms_after_mm: rms(after),
    }
}

/// The residual of as many uniform regions, in words.
fn compared_with_uniform(
    session: &Session,
    number: usize,
    adaptive_mm: f64,
    values: JointValues,
) -> Result<Text, IdentifyError> {
    let uniform = identify_regional(session, &RegionChoice::Uniform(number), values)?;
    Ok(text!(
        "{number} adaptive regions leave {adaptive}, {number} uniform ones {uniform}; an effect that explains the whole range is the better answer: try the full model first",
        number,
        adaptive = length(adaptive_mm, 4),
        uniform = length(uniform.gap.after.rms_mm, 4)
    ))
}

fn notes(session: &Session, regions: &[Region], sums: &[RegionSums], outside: usize) -> Vec<Text> {
    let mut notes = Vec::new();
    if session.samples.z_mm.is_some() {
        notes.push(text!(
            "z is not used: the method works in the plane in which the axis moves the tool"
        ));
    }
    notes.push(text!("corrections are constant in the base frame within a region: one constant error of the joint looks different in every region, and a part of it stays; the full model has neither limit"));
    let empty: Vec<&str> = regions
        .iter()
        .zip(sums)
        .filter(|(_, s)| s.samples == 0)
        .map(|(r, _)| r.name.as_str())
        .collect();
    if !empty.is_empty() {
        notes.push(text!(
            "no sample in region {regions}: no correction there",
            regions = empty.join(", ")
        ));
    }
    if outside > 0 {
        notes.push(text!(
            one "{count} sample lies in no region and was not used", "{count} samples lie in no region and were not used",
            count = outside
        ));
    }
    notes
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector, Rotation3, Unit, Vector3};
    use statrs::distribution::{ContinuousCDF, StudentsT};

    use super::*;
    use crate::fit::example::{AXIS_POINT_MM, TOOL_MM, sweep};

    /// ΔPx, ΔPy and l1 of a sample, with rotations of nalgebra.
    fn in_the_plane(session: &Session, axis: [f64; 3], i: usize) -> [f64; 3] {
        let axis = Unit::new_normalize(Vector3::from(axis));
        let across = |v: Vector3<f64>| v - axis.into_inner() * axis.dot(&v);
        let arm = |target: usize| {
            let target = session.targets[target].position_mm.coords;
            Vector3::from(TOOL_MM) + target - Vector3::from(AXIS_POINT_MM)
        };
        let x = across(arm(0)).normalize();
        let y = axis.cross(&x);
        let samples = &session.samples;
        let home = arm(samples.target.as_ref().map_or(0, |t| t[i] as usize));
        let nominal = Rotation3::from_axis_angle(&axis, samples.q[0][i]) * home;
        let z = samples.z_mm.as_ref().unwrap()[i];
        let actual =
            Vector3::new(samples.x_mm[i], samples.y_mm[i], z) - Vector3::from(AXIS_POINT_MM);
        let off = nominal - actual;
        [off.dot(&x), off.dot(&y), across(home).norm()]
    }

    #[test]
    fn corrections_intervals_and_gaps_are_those_of_least_squares_in_each_region() {
        for axis in [[0.0, 0.0, 1.0], [0.36, -0.48, 0.8]] {
            let mut session = sweep(axis);
            let held_out = (0..session.samples.len()).map(|i| i % 5 == 3);
            session.samples.held_out = Some(held_out.collect());
            // Three, so that no sample lies where two of them meet.
            let choice = RegionChoice::Uniform(3);
            let found = identify_regional(&session, &choice, JointValues::Commanded).unwrap();
            assert!(found.outliers.is_empty());
            let held_out = session.samples.held_out.as_ref().unwrap();
            let (mut unseen, mut seen) = ((0.0, 0), (0.0, 0));
            for region in &found.regions {
                let range = region.correction.from_rad..region.correction.to_rad;
                let inside = |i: &usize| range.contains(&session.samples.q[0][*i]);
                let all = (0..session.samples.len()).filter(inside);
                let (left_out, own): (Vec<usize>, Vec<usize>) = all.partition(|i| held_out[*i]);
                let off = |i: &usize| in_the_plane(&session, axis, *i);
                let rows: Vec<[f64; 3]> = own.iter().map(off).collect();
                let n = rows.len();
                let a = DMatrix::from_fn(2 * n, 2, |k, column| match (k % 2, column) {
                    (0, 1) => 1.0,
                    (1, 0) => rows[k / 2][2],
                    _ => 0.0,
                });
                let b = DVector::from_fn(2 * n, |k, _| rows[k / 2][k % 2]);
                let inverse = (a.transpose() * &a).try_inverse().unwrap();
                let expected = &inverse * a.transpose() * &b;
                let residual = &b - &a * &expected;
                let freedom = 2.0 * n as f64 - 2.0;
                let t = StudentsT::new(0.0, 1.0, freedom)
                    .unwrap()
                    .inverse_cdf(0.975);
                let values = [region.correction.theta_rad, region.correction.l1_mm];
                for (k, found) in [region.theta_ci95, region.l1_ci95].into_iter().enumerate() {
                    let half = t * (inverse[(k, k)] * residual.norm_squared() / freedom).sqrt();
                    let [low, high] = found.unwrap();
                    assert!(
                        (values[k] - expected[k]).abs() < 1e-9 * expected[k].abs().max(1e-3),
                        "{values:?} {expected:?} {axis:?}"
                    );
                    assert!(
                        (high - values[k] - half).abs() < 1e-4 * half,
                        "{axis:?} {k}"
                    );
                    assert!((values[k] - low - half).abs() < 1e-4 * half, "{axis:?} {k}");
                }
                assert_eq!(region.correction.samples, n);
                let rms = |v: &DVector<f64>| (v.norm_squared() / n as f64).sqrt();
                assert!((region.rms_before_mm - rms(&b)).abs() < 1e-9);
                assert!((region.rms_after_mm - rms(&residual)).abs() < 1e-9);
                seen = (seen.0 + residual.norm_squared(), seen.1 + n);
                for [dx, dy, l1] in left_out.iter().map(off) {
                    unseen.0 += (dx - expected[1]).powi(2) + (dy - l1 * expected[0]).powi(2);
                    unseen.1 += 1;
                }
            }
            let after = |(square, count): (f64, usize)| (square / count as f64).sqrt();
            assert_eq!(found.gap.samples, seen.1);
            assert!((found.gap.after.rms_mm - after(seen)).abs() < 1e-9);
            let of_unseen = found.held_out.unwrap();
            assert_eq!(of_unseen.samples, unseen.1);
            assert!((of_unseen.after.rms_mm - after(unseen)).abs() < 1e-9);
        }
    }
}
