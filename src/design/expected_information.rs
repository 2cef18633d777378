//! What a measurement will be able to tell, before anybody has measured: the session is imagined
//! with the nominal robot and the instrument's noise, and asked what could be seen in it.
//!
//! Detection limits are those of a diagnosis (`limits`). Two effects look alike
//! where their columns, without what the base model explains, have a canonical correlation r near
//! one: the part √(1 − r²) of an effect is all that tells it from the other.

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::effects::Term;
use crate::kinematics::Robot;
use crate::model::Model;
use crate::sessions::{Instrument, Samples, Session, Sigma, Target};

use super::candidate_poses::CandidatePose;
use super::first_measurement::SECONDS_PER_POSE;
use super::next_poses::LATER_S;
use crate::diagnosis::NextPose;
use crate::diagnosis::candidates::NotTestable;
use crate::diagnosis::limits::{self, Limit};
use crate::diagnosis::prepare::Prepared;
use crate::diagnosis::regression::{Fit, Regression};
use crate::diagnosis::testable::not_testable;
use crate::diagnosis::{DiagnoseError, Options};
use crate::fit::linear::Basis;
use crate::fit::noise::Noise;

/// Two effects that are more alike than this are worth a word.
const ALIKE: f64 = 0.95;
/// Pairs that are named at most.
const MOST_ALIKE: usize = 12;

/// Two effects that look alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Alike {
    /// One, and its joint counted from 0.
    pub one: (&'static str, Option<usize>),
    /// The other.
    pub other: (&'static str, Option<usize>),
    /// Largest canonical correlation beside the base model.
    pub correlation: f64,
}

/// See the module.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExpectedInformation {
    /// What will be seen above which size, with a chance of 95 %.
    pub limits: Vec<Limit>,
    /// What will not be seen.
    pub not_testable: Vec<NotTestable>,
    /// What will be hard to tell apart, the most alike first.
    pub alike: Vec<Alike>,
}

/// A session as it would be measured with nothing hidden in it; with noise where a seed is given.
pub(crate) fn imagined(
    robot: &Robot,
    targets: &[Target],
    choices: &[CandidatePose],
    noise: Option<(f64, u64)>,
) -> Session {
    let joints = robot.joints.len();
    let column = |f: &dyn Fn(&CandidatePose) -> f64| choices.iter().map(f).collect::<Vec<f64>>();
    let zeros = vec![0.0; choices.len()];
    let warmth = crate::effects::inputs::REFERENCE_TEMPERATURE_C;
    let samples = Samples {
        q: (0..joints).map(|j| column(&|c| c.q[j])).collect(),
        q_read: vec![None; joints],
        dir: (0..joints).map(|j| Some(column(&|c| c.dir[j]))).collect(),
        speed: (0..joints).map(|j| Some(column(&|c| c.speed[j]))).collect(),
        x_mm: zeros.clone(),
        y_mm: zeros.clone(),
        z_mm: Some(zeros),
        target: Some(choices.iter().map(|c| c.target).collect()),
        load_kg: Some(column(&|c| c.load_kg)),
        temperature_c: Some(column(&|c| c.warmth_c + warmth)),
        time_s: Some(column(&|c| c.time_s)),
        ..Samples::default()
    };
    let mut session = Session {
        name: robot.name.clone(),
        note: String::new(),
        robot: robot.clone(),
        targets: targets.to_vec(),
        instrument: Instrument {
            name: String::new(),
            sigma_mm: noise.map(|n| Sigma::Overall(n.0)),
            ..Instrument::default()
        },
        tolerance_mm: None,
        regions: Vec::new(),
        compensated_by: None,
        samples,
        path: None,
    };
    let inputs = crate::effects::Inputs::new(&session, crate::effects::JointValues::Commanded);
    let at = Model::nominal(robot.clone()).predict(&inputs);
    let samples = &mut session.samples;
    (samples.x_mm, samples.y_mm, samples.z_mm) = (at.x_mm, at.y_mm, Some(at.z_mm));
    if let Some((sigma_mm, seed)) = noise {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut draw = || -> f64 { StandardNormal.sample(&mut random) };
        for i in 0..samples.x_mm.len() {
            samples.x_mm[i] += sigma_mm * draw();
            samples.y_mm[i] += sigma_mm * draw();
            if let Some(z) = &mut samples.z_mm {
                z[i] += sigma_mm * draw();
            }
        }
    }
    session
}

/// A session with these poses measured too, exactly as a model predicts them.
pub(crate) fn extended(
    session: &Session,
    model: &Model,
    poses: &[NextPose],
    targets: &[Target],
) -> Session {
    let mut all = session.clone();
    all.targets = targets.to_vec();
    let n = session.samples.len();
    let more = poses.len();
    let samples = &mut all.samples;
    // What a pose leaves open is written down as it is then: as it was last.
    let optional = |column: &mut Option<Vec<f64>>, value: &dyn Fn(&NextPose) -> Option<f64>| {
        if column.is_some() || poses.iter().any(|p| value(p).is_some()) {
            let column = column.get_or_insert_with(|| vec![f64::NAN; n]);
            let known = column.iter().rev().copied().find(|v| v.is_finite());
            let last = known.unwrap_or(f64::NAN);
            column.extend(poses.iter().map(|p| value(p).unwrap_or(last)));
        }
    };
    for j in 0..samples.q.len() {
        samples.q[j].extend(poses.iter().map(|p| p.q[j]));
        optional(&mut samples.q_read[j], &|_| None);
        optional(&mut samples.dir[j], &|p| p.dir.get(j).copied());
        optional(&mut samples.speed[j], &|p| p.speed.as_ref().map(|s| s[j]));
    }
    optional(&mut samples.load_kg, &|p| p.load_kg);
    optional(&mut samples.temperature_c, &|p| p.temperature_c);
    let last = samples
        .time_s
        .as_ref()
        .map_or(0.0, |t| t.iter().copied().fold(0.0, f64::max));
    if let Some(time_s) = &mut samples.time_s {
        let later = |k: usize| last + LATER_S + SECONDS_PER_POSE * k as f64;
        time_s.extend((0..more).map(later));
    }
    if targets.len() > 1 || samples.target.is_some() {
        let place = |p: &NextPose| {
            targets
                .iter()
                .position(|t| Some(&t.name) == p.target.as_ref())
        };
        let of = |p: &NextPose| u32::try_from(place(p).unwrap_or(0)).unwrap_or(0);
        let column = samples.target.get_or_insert_with(|| vec![0; n]);
        column.extend(poses.iter().map(of));
    }
    if let Some(setups) = &mut samples.setups {
        let last = setups.index.last().copied().unwrap_or(0);
        setups.index.extend(vec![last; more]);
    }
    if let Some(held_out) = &mut samples.held_out {
        held_out.extend(vec![false; more]);
    }
    for column in samples.orientation_wxyz.iter_mut().flatten() {
        column.extend(vec![f64::NAN; more]);
    }
    samples.unknown.clear();
    samples.line = crate::sessions::Lines::default();
    samples.x_mm.extend(vec![0.0; more]);
    samples.y_mm.extend(vec![0.0; more]);
    if let Some(z) = &mut samples.z_mm {
        z.extend(vec![0.0; more]);
    }
    let inputs = crate::effects::Inputs::new(&all, crate::effects::JointValues::Commanded);
    let at = model.predict(&inputs);
    let samples = &mut all.samples;
    for i in n..n + more {
        (samples.x_mm[i], samples.y_mm[i]) = (at.x_mm[i], at.y_mm[i]);
        if let Some(z) = &mut samples.z_mm {
            z[i] = at.z_mm[i];
        }
    }
    all
}

/// What an imagined session with this noise could tell.
pub(crate) fn expected(
    session: &Session,
    sigma_mm: f64,
    options: &Options,
) -> Result<ExpectedInformation, DiagnoseError> {
    let prepared = Prepared::new(session, options)?;
    let regression = with_noise(&prepared, sigma_mm, options.seed);
    let mut fit = regression.fit(&regression.base, Vec::new());
    // The residual is that of noise of exactly the stated size.
    let freedom = regression.m() - fit.basis.rank() as f64;
    if freedom > 0.0 && fit.rss > 0.0 {
        fit.residual *= (freedom / fit.rss).sqrt();
        fit.rss = freedom;
    }
    let mut not_testable = not_testable(&regression, &fit);
    // Names that belong to every calibration are in the base, not among the candidates.
    not_testable.retain(|n| !crate::fit::DEFAULT_EFFECTS.contains(&n.effect));
    Ok(ExpectedInformation {
        limits: limits::limits(&regression, &fit),
        alike: alike(&regression, &fit),
        not_testable,
    })
}

fn with_noise<'a>(prepared: &Prepared<'a>, sigma_mm: f64, seed: u64) -> Regression<'a> {
    let mut regression = prepared.regression.with_noise(Noise::white(sigma_mm));
    regression.seed = seed;
    regression
}

/// Columns of one name at one setting, orthonormal, beside the base.
struct Span<'t> {
    term: &'t Term,
    unit: DMatrix<f64>,
}

/// Pairs of names that look alike at some of their settings.
fn alike(regression: &Regression, fit: &Fit) -> Vec<Alike> {
    let projected = regression.projected(&fit.basis);
    let mut spans: Vec<Span> = Vec::new();
    for candidate in &regression.table.candidates {
        let Some(term) = candidate.what.term() else {
            continue;
        };
        let (_, rank) = projected.factor(candidate);
        let setting = term.effect.about().setting;
        let high_order = setting.takes_fractions() && term.setting > 12.0;
        if rank == candidate.size && !high_order {
            spans.push(Span {
                term,
                unit: Basis::new(&projected.columns(candidate)).q,
            });
        }
    }
    // Of the many times of a step a few stand for all.
    let times = |s: &Span| s.term.effect.about().setting == crate::effects::Setting::Time;
    let steps = spans.iter().filter(|s| times(s)).count();
    let (mut count, stride) = (0, steps.div_ceil(8).max(1));
    spans.retain(|s| {
        count += usize::from(times(s));
        !times(s) || count % stride == 0
    });
    let name = |s: &Span| {
        let about = s.term.effect.about();
        (about.id, about.per_joint.then_some(s.term.joint))
    };
    let mut pairs: Vec<Alike> = Vec::new();
    for (i, a) in spans.iter().enumerate() {
        for b in &spans[i + 1..] {
            let (one, other) = (name(a), name(b));
            if one == other {
                continue;
            }
            let correlation = largest_singular_value(&a.unit.tr_mul(&b.unit));
            if correlation < ALIKE {
                continue;
            }
            let same = |p: &&mut Alike| (p.one, p.other) == (one, other);
            match pairs.iter_mut().find(same) {
                Some(known) => known.correlation = known.correlation.max(correlation),
                None => pairs.push(Alike {
                    one,
                    other,
                    correlation,
                }),
            }
        }
    }
    pairs.sort_by(|a, b| b.correlation.total_cmp(&a.correlation));
    pairs.truncate(MOST_ALIKE);
    pairs
}

fn largest_singular_value(cross: &DMatrix<f64>) -> f64 {
    let values: DVector<f64> = cross.clone().singular_values();
    values.iter().copied().fold(0.0, f64::max).min(1.0)
}
