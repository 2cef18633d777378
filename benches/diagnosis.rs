//! The whole search for missing effects, from a session in memory to the answer: backlash and
//! eccentricity in 30 to a million samples of two reflectors, three loads and three speeds.
//! `benches/compare/search.py` times a plain Gram-matrix search over the same names in numpy.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use truepose::diagnosis::Options;
use truepose::pipeline::diagnose;
use truepose::sessions::Session;
use truepose::simulation::{parse_scenario, simulate, unwatched};

/// Poses in random order from both sides, each reached ten times on two reflectors.
fn session(samples: usize) -> Session {
    let repeats = 10.min(samples / 10);
    // Steps × repeats × sides × reflectors.
    let steps = (samples / (4 * repeats)).max(2) - 1;
    let document = format!(
        r#"{{ "format": "truepose-scenario/1",
        "robot": {{ "name": "column", "joints": [ {{ "name": "pan", "kind": "revolute",
          "axis": [0,0,1], "point_mm": [0,0,0], "limits": [-180, 180] }} ],
          "tool": {{ "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] }},
          "gravity_m_s2": [0,0,-9.81] }},
        "targets": {{ "T1": [0,0,0], "T2": [120,0,40] }},
        "instrument": {{ "name": "tracker", "sigma_mm": 0.03 }},
        "poses": {{ "sweep": {{ "joint": 1, "from_deg": -170, "to_deg": 170,
          "step_deg": {}, "both_ways": true, "repeats": {repeats}, "order": "random" }} }},
        "conditions": {{ "speed_deg_s": [0, 5, 20], "load_kg": [0, 3, 6],
          "temperature_c": {{ "from": 20, "to": 26, "time_constant_s": 600 }},
          "seconds_per_pose": 6 }},
        "effects": [
          {{ "effect": "backlash", "joint": 1, "parameters": {{ "width_deg": 0.05 }} }},
          {{ "effect": "encoder-eccentricity", "joint": 1,
             "parameters": {{ "amplitude_deg": 0.06, "phase_deg": 40 }} }} ],
        "noise": {{ "sigma_mm": 0.03, "kind": "gauss" }}, "seed": 1 }}"#,
        340.0 / steps as f64
    );
    let loaded = parse_scenario(document.as_bytes()).expect("a good scenario");
    let (session, _) = simulate(&loaded.scenario, 1, unwatched).expect("a simulated session");
    session
}

fn search(c: &mut Criterion) {
    let mut group = c.benchmark_group("diagnosis");
    group.sample_size(10);
    for samples in [30, 100, 1_000, 100_000, 1_000_000] {
        let session = session(samples);
        let count = session.samples.len();
        let options = Options::default();
        group.bench_function(format!("{count} samples"), |b| {
            b.iter(|| diagnose(black_box(&session), &options, &|_| true));
        });
    }
}

criterion_group!(benches, search);
criterion_main!(benches);
