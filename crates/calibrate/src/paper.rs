//! The errors of the paper's regional model that the exact model explains.
//!
//! The paper drops the rotation between the lamp's frame and the base frame (its equation (5)),
//! and corrects each region by a constant. Whether that rotation is what is missing shows in two
//! ways:
//!
//! ```text
//! turn = Σ (θ − θ̄)(k × ē)·e / (|ē|² Σ (θ − θ̄)²),   over each region, weighted by its |ē|²
//! Δρ_i = (Nᵀ N)⁻¹ Nᵀ ΔQ_i of the points of the model with its two constants alone              (7)
//! ```
//!
//! e is the deviation in the plane of motion, k the axis. An error that is constant in the frame
//! that turns with the joint has turn = 1, one that is constant in the base frame 0. And the
//! regional corrections of one constant error, found by the same equation (7) on its exact points,
//! are those of the session if nothing else is in them.

use crate::effects::{Inputs, JointFrame, JointValues, called};
use crate::fit::gap::deviations;
use crate::fit::problem::Problem;
use crate::fit::{DEFAULT_EFFECTS, Identification, IdentifyError, identify_regional};
use crate::lanes::{cross, dot};
use crate::model::Model;
use crate::sessions::division::RegionChoice;
use crate::sessions::regions::Assignment;
use crate::sessions::{Region, Session};
use crate::text::{Text, angle, length};

use crate::diagnosis::Diagnosis;

/// A turn this near to 1 is one.
const TURNS: f64 = 0.1;

/// The paper's regional model of a session, compared with the exact one.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionalStart {
    /// The paper's identification of the session.
    pub regional: Identification,
    /// By how many degrees the deviation turns, within a region, for each degree of the joint; `None` where the
    /// regions are too small to determine it.
    pub turn: Option<f64>,
    /// The constant error of the final model as a correction: Δθ in rad and Δl1 in mm.
    pub one_correction: (f64, f64),
    /// What the regions' corrections would be, were that one error the only one: Δθ in rad, Δl1
    /// in mm.
    pub of_one_error: Vec<(f64, f64)>,
    /// The largest distance between those and the identified ones, mm.
    pub apart_mm: f64,
    /// In words.
    pub summary: Text,
}

/// Holds the regional model of a session against the answer of its diagnosis.
///
/// # Errors
/// Another robot than one with a single revolute joint, or no sample to fit.
pub fn regional_start(
    session: &Session,
    diagnosis: &Diagnosis,
    values: JointValues,
) -> Result<RegionalStart, IdentifyError> {
    let session = &*session.whole()?;
    let of_another = diagnosis.model.robot.joints.len() != session.robot.joints.len();
    if of_another {
        let summary = text!("the diagnosis is of a robot with another number of joints");
        return Err(IdentifyError::NotASingleRevoluteJoint(summary));
    }
    let regional = identify_regional(session, &RegionChoice::FromSession, values)?;
    let constants = |id: &str| DEFAULT_EFFECTS.contains(&id);
    let one = diagnosis.model.without(|t| !constants(t.effect.about().id));
    let value = |id: &str| {
        let mut terms = one.terms().iter().filter(|t| t.effect.about().id == id);
        terms.next().map_or(0.0, |t| t.coefficients[0])
    };
    let [theta, l1] = DEFAULT_EFFECTS.map(|id| -value(id));
    let seen = as_seen(session, &one, values);
    let of_one = identify_regional(&seen, &RegionChoice::FromSession, values)?;
    let radius_mm = JointFrame::new(&session.robot, 0).radius_mm;
    let pairs = regional.regions.iter().zip(&of_one.regions);
    let pairs = pairs.map(|(a, b)| (&a.correction, &b.correction));
    let apart = pairs.map(|(a, b)| {
        let along = radius_mm * (a.theta_rad - b.theta_rad);
        along.hypot(a.l1_mm - b.l1_mm)
    });
    let apart_mm = apart.fold(0.0, f64::max);
    let turn = turn(session, &regional, values);
    let summary = describe(&regional, turn, (theta, l1), apart_mm, diagnosis);
    let both = of_one.regions.iter().map(|r| &r.correction);
    Ok(RegionalStart {
        of_one_error: both.map(|c| (c.theta_rad, c.l1_mm)).collect(),
        one_correction: (theta, l1),
        turn,
        apart_mm,
        summary,
        regional,
    })
}

/// The session as it would be measured, without noise, on the robot of a model.
fn as_seen(session: &Session, model: &Model, values: JointValues) -> Session {
    let points = model.predict(&Inputs::new(session, values));
    let usable = Problem::new(session, values).usable;
    let mut seen = session.clone();
    let put = |to: &mut [f64], from: &[f64]| {
        for (i, to) in to.iter_mut().enumerate() {
            *to = if usable[i] { from[i] } else { f64::NAN };
        }
    };
    put(&mut seen.samples.x_mm, &points.x_mm);
    put(&mut seen.samples.y_mm, &points.y_mm);
    if let Some(z) = &mut seen.samples.z_mm {
        put(z, &points.z_mm);
    }
    seen
}

fn turn(session: &Session, regional: &Identification, values: JointValues) -> Option<f64> {
    let problem = Problem::new(session, values);
    let e = deviations(&problem, &Model::nominal(session.robot.clone())).axes_mm;
    let axis = JointFrame::new(&session.robot, 0).along;
    let corrections = regional.regions.iter().map(|r| &r.correction);
    let regions: Vec<Region> = corrections
        .map(crate::model::RegionalCorrection::region)
        .collect();
    let assignment = Assignment::new(&regions);
    let mut inside: Vec<Vec<usize>> = vec![Vec::new(); regions.len()];
    for i in (0..problem.fit.len()).filter(|i| problem.fit[*i]) {
        if let Some(region) = assignment.region_of(problem.inputs.q[0][i]) {
            inside[region].push(i);
        }
    }
    let (mut turned, mut by) = (0.0, 0.0);
    for samples in inside.iter().filter(|s| !s.is_empty()) {
        let n = samples.len() as f64;
        let q = |i: usize| problem.inputs.q[0][i];
        let middle = samples.iter().map(|i| q(*i)).sum::<f64>() / n;
        let flat = |i: usize| {
            let e = [e[0][i], e[1][i], e[2][i]];
            let along = dot(e, axis);
            std::array::from_fn::<f64, 3, _>(|k| e[k] - along * axis[k])
        };
        let mean: [f64; 3] =
            std::array::from_fn(|k| samples.iter().map(|i| flat(*i)[k]).sum::<f64>() / n);
        let across = cross(axis, mean);
        for i in samples {
            turned += (q(*i) - middle) * dot(across, flat(*i));
            by += (q(*i) - middle).powi(2) * dot(mean, mean);
        }
    }
    (by > 0.0).then(|| turned / by)
}

fn describe(
    regional: &Identification,
    turn: Option<f64>,
    (theta, l1): (f64, f64),
    apart_mm: f64,
    diagnosis: &Diagnosis,
) -> Text {
    let regions = regional.regions.len();
    let [before, after] = [regional.gap.before, regional.gap.after].map(|s| s.rms_mm);
    let (after, before) = (length(after, 4), length(before, 4));
    let (theta, l1) = (angle(theta, 4), length(l1, 4));
    let (apart, end) = (length(apart_mm, 4), length(diagnosis.gap.end_mm, 4));
    let one = if diagnosis.found.is_empty() {
        text!(
            "one constant correction ({theta} and {l1}), turned into the base frame, gives the {regions} corrections to within {apart} and leaves {end}",
            theta,
            l1,
            regions,
            apart,
            end
        )
    } else {
        let names = diagnosis.found.iter().map(|f| called(f.effect));
        text!(
            "one constant correction ({theta} and {l1}), turned into the base frame, gives the {regions} corrections to within {apart}; with {effects} it leaves {end}",
            theta,
            l1,
            regions,
            apart,
            effects = Text::listed(names, ", "),
            end
        )
    };
    match turn {
        None => text!(
            "{regions} regions leave {after} of {before}; {one}",
            regions,
            after,
            before,
            one
        ),
        Some(turn) if (turn - 1.0).abs() < TURNS => text!(
            "{regions} regions leave {after} of {before}; within a region the error turns by {turn} for each degree of the joint: it is constant in the frame that turns with the joint, and the regional model drops that rotation; {one}",
            regions,
            after,
            before,
            turn = format!("{turn:.2}°"),
            one
        ),
        Some(turn) => text!(
            "{regions} regions leave {after} of {before}; within a region the error turns by {turn} for each degree of the joint; {one}",
            regions,
            after,
            before,
            turn = format!("{turn:.2}°"),
            one
        ),
    }
}
