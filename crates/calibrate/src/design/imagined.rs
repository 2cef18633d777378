//! Imagined sessions: as they would be, had poses been measured already, and what they would show.
//!
//! A new sample is measured as an earlier one was: the same kinds of measurement, of the same places,
//! exactly as a model predicts them. Of a robot that was not measured all three coordinates of points
//! are.

use nalgebra::DMatrix;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::candidate::{Candidate, Writing};
use super::rows::{Rows, free};
use crate::diagnosis::NextPose;
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;
use crate::effects::place::MOST;
use crate::effects::places::stated;
use crate::effects::{Inputs, JointValues, Place, PlaceKind};
use crate::kinematics::Robot;
use crate::model::Model;
use crate::observations::streams::predictions;
use crate::observations::{KINDS, Layer, Seen};
use crate::sessions::{Instrument, Samples, Session, Sigma, Target};
use crate::text::Text;

/// New poses are measured so long after the last one, s, and one takes so long.
pub(crate) const LATER_S: f64 = 60.0;
pub(crate) const SECONDS_PER_POSE: f64 = 10.0;

/// A session of points without samples, in which every condition is written down.
pub(crate) fn unmeasured(robot: &Robot, targets: &[Target], sigma_mm: Option<f64>) -> Session {
    let joints = robot.joints.len();
    let empty = || Some(Vec::new());
    Session {
        name: robot.name.clone(),
        note: String::new(),
        robot: robot.clone(),
        targets: targets.to_vec(),
        instrument: Instrument {
            sigma_mm: sigma_mm.map(Sigma::Overall),
            ..Instrument::default()
        },
        tolerance_mm: None,
        regions: Vec::new(),
        compensated_by: None,
        samples: Samples {
            q: vec![Vec::new(); joints],
            q_read: vec![None; joints],
            dir: vec![empty(); joints],
            speed: vec![empty(); joints],
            z_mm: empty(),
            target: Some(Vec::new()),
            load_kg: empty(),
            temperature_c: empty(),
            time_s: empty(),
            ..Samples::default()
        },
        path: None,
    }
}

/// A session with these poses measured too, each as the last sample of its target was.
pub(crate) fn extended(
    session: &Session,
    model: &Model,
    poses: &[NextPose],
    targets: &[Target],
) -> Session {
    let usable = |i: &usize| KINDS.iter().any(|kind| kind.measured(session, *i));
    let samples: Vec<usize> = (0..session.samples.len()).filter(usable).collect();
    let of_sample = session.samples.target.as_ref();
    let like = |pose: &NextPose| {
        let target = target_of(targets, pose);
        let of = |i: &&usize| of_sample.is_some_and(|t| t[**i] == target);
        samples.iter().rev().find(of).or(samples.last()).copied()
    };
    let like: Vec<Option<usize>> = poses.iter().map(like).collect();
    let mut all = session.clone();
    all.targets = targets.to_vec();
    extend(&mut all, model, poses, &like);
    all
}

/// A session with these candidates measured too, each like the sample of its way and written down like this.
pub(crate) fn with_candidates(
    session: &Session,
    model: &Model,
    candidates: &[Candidate],
    like: impl Fn(usize) -> Option<usize>,
    writing: &Writing,
) -> Session {
    let poses = candidates.iter().map(|c| writing.pose(c, Text::default()));
    let like: Vec<_> = candidates.iter().map(|c| like(c.way)).collect();
    let mut all = session.clone();
    extend(&mut all, model, &poses.collect::<Vec<_>>(), &like);
    all
}

/// Index of the target that a pose names, else the first.
fn target_of(targets: &[Target], pose: &NextPose) -> u32 {
    let named = |t: &Target| Some(&t.name) == pose.target.as_ref();
    let index = targets.iter().position(named).unwrap_or(0);
    u32::try_from(index).unwrap_or(0)
}

/// Adds samples at these poses, each measured like that one; like none: a point.
fn extend(all: &mut Session, model: &Model, poses: &[NextPose], like: &[Option<usize>]) {
    let n = all.samples.len();
    let targets = &all.targets;
    let samples = &mut all.samples;
    let rows: Vec<_> = (0..n).map(Some).chain(like.iter().copied()).collect();
    samples.select(&rows);
    // The reading of a sensor is not known, and nothing is mounted anew.
    for column in samples.torque_nm.iter_mut().flatten() {
        column[n..].fill(f64::NAN);
    }
    if let Some(setups) = &mut samples.setups {
        let last = setups.index[..n].last().copied().unwrap_or(0);
        setups.index[n..].fill(last);
    }
    let marks = [&mut samples.held_out, &mut samples.excluded];
    for marks in marks.into_iter().flatten() {
        marks[n..].fill(false);
    }
    // What a pose does not state is as it was last.
    let fill =
        |column: &mut Option<Vec<f64>>, usual: f64, value: &dyn Fn(&NextPose) -> Option<f64>| {
            if column.is_none() && poses.iter().all(|p| value(p).is_none()) {
                return;
            }
            let column = column.get_or_insert_with(|| vec![f64::NAN; n + poses.len()]);
            let known = column[..n].iter().rev().copied().find(|v| v.is_finite());
            let last = known.unwrap_or(if n == 0 { usual } else { f64::NAN });
            for (to, pose) in column[n..].iter_mut().zip(poses) {
                *to = value(pose).unwrap_or(last);
            }
        };
    for j in 0..samples.q.len() {
        for (to, pose) in samples.q[j][n..].iter_mut().zip(poses) {
            *to = pose.q[j];
        }
        fill(&mut samples.q_read[j], f64::NAN, &|_| None);
        fill(&mut samples.dir[j], f64::NAN, &|p| p.dir.get(j).copied());
        let speed = |p: &NextPose| p.speed.as_ref().map(|s| s[j]);
        fill(&mut samples.speed[j], 0.0, &speed);
    }
    fill(&mut samples.load_kg, 0.0, &|p| p.load_kg);
    let temperature_c = |p: &NextPose| p.temperature_c;
    fill(
        &mut samples.temperature_c,
        REFERENCE_TEMPERATURE_C,
        &temperature_c,
    );
    if let Some(time_s) = &mut samples.time_s {
        let times = time_s[..n].iter().copied();
        let last = times.fold(f64::NEG_INFINITY, f64::max);
        let start = if last.is_finite() {
            last + LATER_S
        } else {
            0.0
        };
        for (k, to) in time_s[n..].iter_mut().enumerate() {
            *to = start + SECONDS_PER_POSE * k as f64;
        }
    }
    if targets.len() > 1 || samples.target.is_some() {
        let column = samples
            .target
            .get_or_insert_with(|| vec![0; n + poses.len()]);
        for (to, pose) in column[n..].iter_mut().zip(poses) {
            *to = target_of(targets, pose);
        }
    }
    show(all, model, n, like);
}

/// Writes down what is measured of the samples from `n` on.
fn show(all: &mut Session, model: &Model, n: usize, like: &[Option<usize>]) {
    let seen = predictions(all, JointValues::Commanded, model);
    for (i, like) in (n..).zip(like) {
        let missing = like.map_or([false; 3], |like| {
            all.samples.coordinates(like).map(f64::is_nan)
        });
        let measured = |k: usize| like.map_or(k == 0, |like| KINDS[k].measured(all, like));
        let kinds: Vec<usize> = (0..KINDS.len()).filter(|k| measured(*k)).collect();
        for kind in kinds.into_iter().map(|k| KINDS[k]) {
            let place = like.and_then(|like| kind.place(all, like));
            let at = place.map_or([0.0; MOST], |place| place_of(all, model, place));
            let seen = Seen {
                point: seen[i].0,
                attitude: seen[i].1,
                place: &at,
            };
            kind.show(all, i, place.map(|p| p.index), &seen, [0.0; 3]);
        }
        let samples = &mut all.samples;
        let columns = [&mut samples.x_mm, &mut samples.y_mm].into_iter();
        for (column, missing) in columns.chain(&mut samples.z_mm).zip(missing) {
            if missing {
                column[i] = f64::NAN;
            }
        }
    }
}

/// Where a place is as far as a model knows, in the coefficients of its kind.
pub(crate) fn place_of(session: &Session, model: &Model, place: Place) -> [f64; MOST] {
    let known = stated(&session.instrument.references, place);
    let mut at = known.map(|v| v.unwrap_or(0.0));
    let own = |t: &&crate::effects::Term| {
        PlaceKind::of(t) == Some(place.kind) && t.setting == place.index as f64
    };
    if let Some(term) = model.terms().iter().find(own) {
        at[..term.coefficients.len()].copy_from_slice(&term.coefficients);
    }
    at
}

/// The session with noise on its points.
pub(crate) fn with_noise(mut session: Session, sigma_mm: f64, seed: u64) -> Session {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let samples = &mut session.samples;
    for i in 0..samples.x_mm.len() {
        let columns = [&mut samples.x_mm, &mut samples.y_mm].into_iter();
        for column in columns.chain(&mut samples.z_mm) {
            let draw: f64 = StandardNormal.sample(&mut random);
            column[i] += sigma_mm * draw;
        }
    }
    session
}

/// The information of every sample to be fitted on the free coefficients of a model, and that of the priors.
pub(crate) fn shown(session: &Session, model: &Model) -> (Rows, DMatrix<f64>) {
    let own: Vec<usize> = free(model).map(|own| own.0).collect();
    let layer = Layer::at(session, &Inputs::new(session, JointValues::Commanded));
    let (rows, prior) = Rows::of_layer(&layer, model, [layer.unit_mm; 3]);
    let prior = prior.select_rows(&own).select_columns(&own);
    (rows.only(&own), prior)
}
