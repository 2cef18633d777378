//! How fast samples are read: a CSV file of ten columns, and the same samples inside a JSON
//! document beside `serde_json::Value`. `benches/compare/reading.py` times the alternatives on the
//! same files, which `TRUEPOSE_BENCH_FILES=FOLDER` keeps.

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::{Path, PathBuf};

use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const HEAD: &str = r#"{ "format": "truepose-session/1", "name": "bench", "robot": { "name": "axis",
 "joints": [ { "name": "pan", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0] } ],
 "tool": { "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] } },
 "instrument": { "name": "tracker", "sigma_mm": 0.03 }, "#;

const NAMES: [&str; 10] = [
    "q1_deg",
    "x_mm",
    "y_mm",
    "z_mm",
    "dir1",
    "speed1_deg_s",
    "load_kg",
    "temperature_c",
    "time_s",
    "q1_read_deg",
];

/// Values as a tracker writes them: micrometres, a tenth of that for angles.
fn row(i: usize) -> [f64; 10] {
    let round = |value: f64, digits: f64| (value * digits).round() / digits;
    let t = i as f64;
    let q = (t * 0.618_033_988_75).fract() * 360.0 - 180.0;
    let (sin, cos) = q.to_radians().sin_cos();
    [
        round(q, 1e5),
        round(250.0 * cos + 0.03 * (t * 0.7).sin(), 1e6),
        round(250.0 * sin + 0.03 * (t * 1.3).sin(), 1e6),
        round(300.0 + 0.03 * (t * 1.9).sin(), 1e6),
        if i.is_multiple_of(2) { 1.0 } else { -1.0 },
        [0.0, 5.0, 20.0][i % 3],
        [0.0, 3.0, 6.0][i / 3 % 3],
        round(20.0 + 3.0 * (t * 0.01).sin(), 1e4),
        6.0 * t,
        round(q + 0.001 * (t * 0.3).sin(), 1e5),
    ]
}

fn write_csv_session(folder: &Path, rows: usize) -> PathBuf {
    let mut csv = NAMES.join(",") + "\n";
    for i in 0..rows {
        let cells: Vec<String> = row(i).iter().map(ToString::to_string).collect();
        csv.push_str(&cells.join(","));
        csv.push('\n');
    }
    let path = folder.join(format!("rows-{rows}.json"));
    let document = format!("{HEAD}\"samples\": {{ \"file\": \"rows-{rows}.csv\" }} }}");
    std::fs::write(&path, document).expect("the folder can be written to");
    std::fs::write(path.with_extension("csv"), csv).expect("the folder can be written to");
    path
}

fn inline_document(rows: usize) -> String {
    let mut document = format!("{HEAD}\"samples\": {{ \"columns\": {{ ");
    for (column, name) in NAMES.iter().enumerate() {
        let cells: Vec<String> = (0..rows).map(|i| row(i)[column].to_string()).collect();
        let comma = if column == 0 { "" } else { ", " };
        write!(document, "{comma}\"{name}\": [{}]", cells.join(",")).expect("memory suffices");
    }
    document.push_str(" } } }");
    document
}

fn reading(criterion: &mut Criterion) {
    let own = tempfile::tempdir().expect("there is a folder for temporary files");
    let kept = std::env::var_os("TRUEPOSE_BENCH_FILES").map(PathBuf::from);
    let folder = kept.as_deref().unwrap_or(own.path());
    for rows in [1_000, 100_000, 1_000_000] {
        let path = write_csv_session(folder, rows);
        let mut group = criterion.benchmark_group(format!("read {rows} rows of 10 columns"));
        group
            .sample_size(10)
            .throughput(Throughput::Elements(rows as u64));
        group.bench_function("csv", |bencher| {
            bencher.iter(|| truepose::sessions::load(black_box(&path)).expect("it is a session"));
        });
        let document = inline_document(rows);
        if kept.is_some() {
            std::fs::write(folder.join(format!("inline-{rows}.json")), &document)
                .expect("the folder can be written to");
        }
        group.bench_function("json inline", |bencher| {
            bencher.iter(|| {
                truepose::sessions::parse(black_box(document.as_bytes())).expect("it is one")
            });
        });
        group.bench_function("json, serde_json::Value", |bencher| {
            bencher.iter(|| {
                serde_json::from_slice::<serde_json::Value>(black_box(document.as_bytes()))
                    .expect("it is JSON")
            });
        });
        group.finish();
    }
}

criterion_group!(benches, reading);
criterion_main!(benches);
