//! The recursive fit against the batch fit, on sessions that grow.

use crate::effects::{JointValues, Term, find};
use crate::fit::problem::Problem;
use crate::fit::solver::solve;
use crate::model::Model;
use crate::sessions::{Samples, Session};
use crate::simulation::format_v1::parse_scenario;
use crate::simulation::{simulate, unwatched};

use super::Recursive;

/// A lamp with backlash, a zero offset and a short link, measured with noise.
fn session() -> Session {
    let scenario = parse_scenario(
        br#"{ "format": "truepose-scenario/1", "name": "grows",
  "robot": { "name": "lamp",
    "joints": [ { "name": "pan", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0], "limits": [-90, 90] } ],
    "tool": { "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] } },
  "targets": { "T1": [0,0,0] },
  "instrument": { "name": "tracker", "sigma_mm": 0.03 },
  "poses": { "sweep": { "joint": 1, "from_deg": -90, "to_deg": 90, "step_deg": 0.75, "both_ways": true, "repeats": 1, "order": "sweep" } },
  "conditions": { "seconds_per_pose": 6 },
  "effects": [ { "effect": "joint-zero-offset", "joint": 1, "parameters": { "offset_deg": -3 } },
    { "effect": "link-length", "joint": 1, "parameters": { "delta_mm": -5 } },
    { "effect": "encoder-eccentricity", "joint": 1, "parameters": { "amplitude_deg": 0.4, "phase_deg": 70 } },
    { "effect": "backlash", "joint": 1, "parameters": { "width_deg": 0.05 } } ],
  "noise": { "sigma_mm": 0.03, "kind": "gauss" }, "seed": 5 }"#,
    )
    .unwrap()
    .scenario;
    simulate(&scenario, scenario.seed, unwatched).unwrap().0
}

/// The first so many samples.
fn first(session: &Session, n: usize) -> Session {
    let old = &session.samples;
    let cut = |c: &Vec<f64>| c[..n].to_vec();
    let each = |c: &[Option<Vec<f64>>]| c.iter().map(|c| c.as_ref().map(cut)).collect();
    Session {
        samples: Samples {
            q: old.q.iter().map(cut).collect(),
            q_read: each(&old.q_read),
            x_mm: cut(&old.x_mm),
            y_mm: cut(&old.y_mm),
            z_mm: old.z_mm.as_ref().map(cut),
            dir: each(&old.dir),
            speed: each(&old.speed),
            time_s: old.time_s.as_ref().map(cut),
            ..Samples::default()
        },
        ..session.clone()
    }
}

fn start(session: &Session) -> Model {
    let ids = [
        "joint-zero-offset",
        "link-length",
        "encoder-eccentricity",
        "backlash",
    ];
    let term = |id: &str| Term::absent(find(id).unwrap(), 0, 0.0);
    Model::new(session.robot.clone(), ids.map(term).to_vec())
}

/// Largest difference of two models' coefficients, relative to the larger of the two sizes.
fn apart(a: &Model, b: &Model) -> f64 {
    let (a, b) = (a.coefficients(), b.coefficients());
    let one = |(a, b): (&f64, &f64)| (a - b).abs() / a.abs().max(b.abs()).max(1e-6);
    a.iter().zip(&b).map(one).fold(0.0, f64::max)
}

fn batch(session: &Session, start: &Model) -> crate::fit::solver::Solution {
    solve(&Problem::new(session, JointValues::Commanded), start)
}

#[test]
fn however_the_samples_come_the_answer_is_that_of_the_batch() {
    let whole = session();
    let n = whole.samples.len();
    let expected = batch(&whole, &start(&whole));
    for portion in [1, 7, 64, 100] {
        let begun = first(&whole, 20);
        let model = batch(&begun, &start(&whole)).model;
        let problem = Problem::new(&begun, JointValues::Commanded);
        let mut recursive = Recursive::at(&problem, &model);
        let mut k = 20;
        while k < n {
            k = (k + portion).min(n);
            let grown = first(&whole, k);
            let mut problem = Problem::new(&grown, JointValues::Commanded);
            recursive.take(&mut problem);
            if recursive.is_stale() {
                recursive.relinearise(&mut problem);
            }
        }
        let online = recursive.solution();
        let off = apart(&online.model, &expected.model);
        assert!(
            off < 2e-3,
            "portions of {portion}: {off:e} before the last pass"
        );

        let mut problem = Problem::new(&whole, JointValues::Commanded);
        recursive.relinearise(&mut problem);
        let online = recursive.solution();
        let off = apart(&online.model, &expected.model);
        assert!(off < 1e-9, "portions of {portion}: {off:e}");
        assert!((online.cost / expected.cost - 1.0).abs() < 1e-9);
        let inverse = (online.spectrum.inverse() - expected.spectrum.inverse()).amax();
        assert!(inverse <= 1e-6 * expected.spectrum.inverse().amax());
    }
}

#[test]
fn a_linear_model_needs_no_second_look_at_any_sample() {
    let whole = session();
    let slid = |id: &str| Term::absent(find(id).unwrap(), 0, 0.0);
    let start = Model::new(whole.robot.clone(), vec![slid("base-offset")]);
    let begun = first(&whole, 3);
    let mut recursive = Recursive::at(&Problem::new(&begun, JointValues::Commanded), &start);
    for k in 4..=whole.samples.len() {
        let grown = first(&whole, k);
        recursive.take(&mut Problem::new(&grown, JointValues::Commanded));
    }
    let expected = batch(&whole, &start);
    assert!(apart(&recursive.solution().model, &expected.model) < 1e-11);
}

#[test]
fn a_new_sample_costs_the_same_however_many_came_before() {
    // Samples that were seen are not looked at again: changing them changes nothing.
    let whole = session();
    let begun = first(&whole, 200);
    let model = batch(&begun, &start(&whole)).model;
    let first_look = Recursive::at(&Problem::new(&begun, JointValues::Commanded), &model);
    let answer = |session: &Session| {
        let mut recursive = first_look.clone();
        let mut problem = Problem::new(session, JointValues::Commanded);
        let new = recursive.take(&mut problem);
        assert_eq!(new, session.samples.len() - 200);
        recursive.solution().model.coefficients()
    };
    let mut changed = whole.clone();
    changed.samples.x_mm[..200].fill(1e6);
    assert_eq!(answer(&whole), answer(&changed));
}

#[test]
fn the_answer_gets_surer_with_every_sample() {
    // From where the joint has come back on: until then backlash and zero offset look alike.
    let whole = session();
    let begun = first(&whole, 260);
    let model = batch(&begun, &start(&whole)).model;
    let mut last = f64::INFINITY;
    let mut recursive = Recursive::at(&Problem::new(&begun, JointValues::Commanded), &model);
    for k in (280..=whole.samples.len()).step_by(20) {
        let grown = first(&whole, k);
        recursive.take(&mut Problem::new(&grown, JointValues::Commanded));
        let variance = recursive.solution().spectrum.inverse()[(0, 0)];
        assert!(variance < last, "{k} samples");
        last = variance;
    }
}

#[test]
fn one_sample_determines_what_one_sample_can_and_no_more() {
    let whole = session();
    let one = first(&whole, 1);
    let recursive = Recursive::at(&Problem::new(&one, JointValues::Commanded), &start(&whole));
    let solution = recursive.solution();
    assert!(solution.spectrum.rank() < solution.model.coefficient_count());
    assert!(solution.model.coefficients().iter().all(|c| c.is_finite()));
}
