//! A recorded condition as the rival of a frame that wanders: what follows the temperature or the load, in
//! whatever way, is no slow noise, although a condition that changes slowly looks like one. Slopes, parabolas
//! and curves of a few pieces over every recorded condition, along the axes of the measuring frame and with
//! the moving body, are held against the slow part; what is likelier takes its place, as something that no
//! name explains.
//!
//! A condition mostly moves one axis. A shape pays for the directions that it needs and for the choice of
//! them, as a vector effect does ([`super::evidence`]).

use nalgebra::DMatrix;

use crate::fit::noise::Noise;
use crate::linear::Basis;
use crate::model::shapes::{Direction, Profile, Shape, Variable};

use super::evidence::{choices, price_of, subsets};
use super::placed::Placed;
use super::prepare::Prepared;
use super::regression::{Fit, Regression};
use super::search::Found;

/// So many conditions, or ways in which one acts, at most.
const MOST: usize = 4;
/// Pieces of a curve over a condition with so many different values at least.
const PIECES: usize = 3;
const FEWEST_VALUES: usize = 6;

/// What was found with recorded conditions in the place of the slow part of the noise; `None` where the slow
/// part is likelier.
pub(crate) fn instead_of_slow<'a>(
    prepared: &Prepared<'a>,
    found: &Found,
) -> Option<(Prepared<'a>, Found)> {
    let noise = &prepared.regression.noise;
    if noise.slow.is_none() || prepared.regression.rows.observed().is_some() {
        return None;
    }
    // What is white of it stays: a slow part along one axis only would widen that one.
    let white = prepared.with_noise(Noise {
        slow: None,
        alternatives: Vec::new(),
        ..noise.clone()
    });
    let shapes = shapes(&white);
    let mut fit = white.regression.fit(&found.fit.model, &[]);
    for _ in 0..MOST {
        let with = shapes
            .iter()
            .filter_map(|shape| with(&white.regression, &fit, *shape));
        let best = with.max_by(|a, b| a.ln_evidence.total_cmp(&b.ln_evidence));
        let Some(better) = best.filter(|b| b.ln_evidence > fit.ln_evidence) else {
            break;
        };
        fit = better;
    }
    if fit.shapes.is_empty() {
        return None;
    }
    let (settled, fit) = white.settled(&fit);
    (fit.ln_evidence > found.fit.ln_evidence).then(|| {
        let found = Found {
            names_only: settled.regression.fit(&found.fit.model, &[]),
            fit,
            base_misfit: false,
            other_ends: Vec::new(),
        };
        (settled, found)
    })
}

/// Everything that is tried over the recorded conditions.
fn shapes(prepared: &Prepared) -> Vec<Shape> {
    let space = &prepared.regression.table.space;
    let mut all = Vec::new();
    for (variable, values) in &space.variables {
        if !matches!(
            variable,
            Variable::Load | Variable::Warmth | Variable::Speed(_)
        ) {
            continue;
        }
        let mut distinct = values.clone();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        let mut profiles = Vec::new();
        if distinct.len() > 1 {
            profiles.push(Profile::Ramp);
        }
        if distinct.len() > 2 {
            profiles.push(Profile::Square);
        }
        if distinct.len() >= FEWEST_VALUES {
            profiles.push(Profile::Curve { pieces: PIECES });
        } else if distinct.len() > 3 {
            let pieces = distinct.len() - 2;
            profiles.push(Profile::Curve { pieces });
        }
        let mut directions = vec![Direction::Frame];
        if space.radial.is_some() || space.axial.is_some() {
            directions.push(Direction::Body);
        }
        let joints = 0..space.tangential.len();
        if joints.len() > 1 {
            directions.extend(joints.map(Direction::Tangential));
        }
        for profile in profiles {
            all.extend(directions.iter().map(|direction| Shape {
                variable: *variable,
                direction: *direction,
                profile,
                tried: 1.0,
            }));
        }
    }
    let tried = all.len() as f64;
    all.into_iter().map(|s| Shape { tried, ..s }).collect()
}

/// The fit with a shape more, along those of its directions that are worth it; `None` where none is.
fn with(regression: &Regression, fit: &Fit, shape: Shape) -> Option<Fit> {
    if fit.shapes.iter().any(|s| s.shape == shape) {
        return None;
    }
    let placed = regression.placed(shape);
    let along = fit.basis.q.tr_mul(&placed.white);
    let mut free = placed.white.clone();
    free.gemm(-1.0, &fit.basis.q, &along, 1.0);
    let directions = placed.white.ncols() / shape.profile.count();
    let m = regression.m();
    let price = price_of(&shape) + shape.tried.max(1.0).ln();
    let worth = |some: &Vec<usize>| {
        let of_these = |k: &usize| some.contains(&(k % directions));
        let own: Vec<usize> = (0..free.ncols()).filter(of_these).collect();
        let basis = Basis::new(&independent(&free.select_columns(&own)));
        let gain = basis.q.tr_mul(&fit.residual).norm_squared();
        let share = (gain / fit.rss.max(1e-300)).clamp(0.0, 1.0 - 1e-12);
        let fall = -0.5 * m * (-share).ln_1p();
        fall - 0.5 * basis.rank() as f64 * m.ln() - choices(directions, some.len()) - price
    };
    let best = subsets(directions)
        .map(|some| worth(&some))
        .max_by(f64::total_cmp)?;
    if best <= 0.0 {
        return None;
    }
    let mut shapes = fit.shapes.clone();
    shapes.push(placed);
    let mut next = regression.fit(&fit.model, &shapes);
    let wanted = fit.ln_evidence + best;
    let credit = wanted - next.ln_evidence;
    if let Some(Placed { credit: own, .. }) = next.shapes.last_mut() {
        *own = credit;
    }
    next.ln_evidence = wanted;
    Some(next)
}

/// Columns without those of which the fit leaves nothing.
fn independent(free: &DMatrix<f64>) -> DMatrix<f64> {
    let most = free.column_iter().map(|c| c.norm()).fold(0.0, f64::max);
    let kept = (0..free.ncols()).filter(|k| free.column(*k).norm() > 1e-6 * most);
    free.select_columns(&kept.collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::searched;
    use crate::sessions::Session;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// One axis at random angles, one sample every 8 s, the temperature rising to 4 K above the first.
    fn warming(moved_mm: impl Fn(f64, f64) -> f64) -> Session {
        let turn = |k: i32| 330.0 * (f64::from(k) * 0.754_877_666).fract() - 165.0;
        let stops: Vec<String> = (0..140)
            .map(|k| format!(r#"{{"q_deg":[{}]}}"#, turn(k)))
            .collect();
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"warm","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-170,170]}}],
            "tool":{{"position_mm":[320,0,210],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.02}},"poses":{{"list":[{}]}},
            "conditions":{{"temperature_c":{{"from":20,"to":24,"time_constant_s":900}},"seconds_per_pose":8}},
            "effects":[],"noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":3}}"#,
            stops.join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let (mut session, _) = simulate(&scenario, 1, unwatched).unwrap();
        let warm = session.samples.temperature_c.clone().unwrap();
        let time = session.samples.time_s.clone().unwrap();
        for (k, x) in session.samples.x_mm.iter_mut().enumerate() {
            *x += moved_mm(warm[k], time[k]);
        }
        session
    }

    #[test]
    fn what_follows_the_recorded_temperature_is_no_wander() {
        let session = warming(|warm, _| 0.02 * (warm - 20.0));
        let (prepared, found) = searched(&session, &Options::default(), &|_| true).unwrap();
        let over = found.fit.shapes.iter().map(|s| s.shape.variable);
        assert_eq!(over.collect::<Vec<_>>(), [Variable::Warmth]);
        assert!(prepared.regression.noise.slow.is_none());
    }

    #[test]
    fn a_frame_that_wanders_beside_a_recorded_temperature_stays_a_wander() {
        let session = warming(|_, time| 0.05 * (time / 90.0).sin() * (time / 37.0).cos());
        let (_, found) = searched(&session, &Options::default(), &|_| true).unwrap();
        assert!(found.fit.shapes.is_empty());
    }
}
