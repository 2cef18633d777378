//! What it costs to correct one command: the table with equal steps against one that is searched by
//! halving, and a whole compensated pose of one axis (look the correction up, add it, where does it
//! lead) against the sine and cosine alone.
//!
//! Each measurement goes through [`POSES`] angles in an order that no branch predictor knows.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use truepose::inside::sin_cos;
use truepose::inside::{SortedTable, UniformTable};

const POSES: usize = 4096;
/// One entry for each degree of a full turn.
const ENTRIES: usize = 361;

/// Angles from −π to π, as a small generator (`SplitMix64`) scatters them.
fn angles() -> Vec<f64> {
    let mut state = 7_u64;
    let mut angle = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        ((z >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * std::f64::consts::TAU
    };
    (0..POSES).map(|_| angle()).collect()
}

fn tables() -> (UniformTable, SortedTable) {
    let step = std::f64::consts::TAU / (ENTRIES - 1) as f64;
    let places: Vec<f64> = (0..ENTRIES)
        .map(|k| -std::f64::consts::PI + step * k as f64)
        .collect();
    let values: Vec<f64> = places
        .iter()
        .map(|q| 0.05 + 1e-3 * (q - 0.7).sin())
        .collect();
    let uniform = UniformTable::new(places[0], step, &values);
    let sorted = SortedTable::new(places, values).expect("the places ascend");
    (uniform, sorted)
}

fn compensation(criterion: &mut Criterion) {
    let angles = angles();
    let (uniform, sorted) = tables();
    let mut group = criterion.benchmark_group("one axis");
    group.throughput(Throughput::Elements(POSES as u64));
    let mut each = |name: &str, f: &dyn Fn(f64) -> f64| {
        group.bench_function(name, |bencher| {
            bencher.iter(|| angles.iter().map(|q| f(black_box(*q))).sum::<f64>());
        });
    };
    each("table, equal steps", &|q| uniform.at(q));
    each("table, searched by halving", &|q| sorted.at(q));
    each("sine and cosine of the standard library", &|q| {
        let (s, c) = q.sin_cos();
        s + c
    });
    each("sine and cosine", &|q| {
        let (s, c) = sin_cos(q);
        s + c
    });
    each("compensated pose", &|q| {
        let (s, c) = sin_cos(q + uniform.at(q));
        250.0 * c + 250.0 * s
    });
    group.finish();
}

criterion_group!(benches, compensation);
criterion_main!(benches);
