//! A session of a gantry of closed form: three slides, and a tool off the axes. Its first guide is not straight.

use std::f64::consts::PI;

use crate::rig::Random;

pub(crate) const TRAVEL_MM: f64 = 1500.0;
/// Noise along each axis, mm.
pub(crate) const NOISE_MM: f64 = 0.012;

/// The instrument stands in the base's origin, and the gantry so far from it: what bends lines of sight grows with the
/// square of the distance.
const TOOL_MM: [f64; 3] = [2180.0, 260.0, 300.0];
/// From the first carriage to the tool at home.
const ARM_MM: [f64; 3] = [180.0, -40.0, 400.0];

/// What the first guide does at a part of its travel: moves of its carriage, mm, and turns about x, y and z, rad.
pub(crate) type Guide = fn(f64) -> [[f64; 3]; 2];

pub(crate) fn turns(u: f64) -> [[f64; 3]; 2] {
    let [roll, pitch, yaw] = [(2.0 * PI * u).sin(), (3.0 * PI * u).cos(), (PI * u).sin()];
    let bow = 0.08 * (PI * u).sin();
    [[0.0, bow, 0.0], [1.5e-4 * roll, 5e-5 * pitch, 2e-4 * yaw]]
}

/// How a guide moves what its carriage carries there. Turns are small, and their squares below a thousandth of the noise.
pub(crate) fn moved(guide: Guide, x: f64, arm: [f64; 3]) -> [f64; 3] {
    let [shift, turn] = guide(x / TRAVEL_MM);
    [
        shift[0] + turn[1] * arm[2] - turn[2] * arm[1],
        shift[1] + turn[2] * arm[0] - turn[0] * arm[2],
        shift[2] + turn[0] * arm[1] - turn[1] * arm[0],
    ]
}

/// So many samples all over its travels; `scale` is that of the first slide.
pub(crate) fn gantry(seed: u64, count: usize, scale: f64, guide: Guide) -> String {
    let mut random = Random(seed);
    let mut columns = vec![Vec::new(); 6];
    for _ in 0..count {
        let [x, y, z] = [
            random.between(0.0, TRAVEL_MM),
            random.between(0.0, 800.0),
            random.between(-300.0, 0.0),
        ];
        // The tool as the carriage sees it.
        let arm = [ARM_MM[0], ARM_MM[1] + y, ARM_MM[2] + z];
        let moved = moved(guide, x, arm);
        let slid = [x * (1.0 + scale), y, z];
        let point = (0..3).map(|k| TOOL_MM[k] + slid[k] + moved[k] + NOISE_MM * random.normal());
        let row = [x, y, z].into_iter().chain(point);
        for (column, value) in columns.iter_mut().zip(row) {
            column.push(value);
        }
    }
    let slide = |name: &str, axis: [f64; 3], limits: [f64; 2]| serde_json::json!({ "name": name, "kind": "prismatic", "axis": axis, "point_mm": [0, 0, 0], "limits": limits });
    let names = ["q1_mm", "q2_mm", "q3_mm", "x_mm", "y_mm", "z_mm"];
    let mut columns: serde_json::Map<String, serde_json::Value> = names
        .iter()
        .zip(columns)
        .map(|(name, column)| ((*name).to_owned(), column.into()))
        .collect();
    // Its frame is fitted.
    columns.insert("setup".to_owned(), vec!["station"; count].into());
    let document = serde_json::json!({
        "format": "truepose-session/1", "name": "gantry",
        "robot": { "name": "gantry", "joints": [
            slide("X", [1.0, 0.0, 0.0], [0.0, TRAVEL_MM]), slide("Y", [0.0, 1.0, 0.0], [0.0, 800.0]),
            slide("Z", [0.0, 0.0, 1.0], [-300.0, 0.0]) ],
            "tool": { "position_mm": TOOL_MM, "quaternion_wxyz": [1, 0, 0, 0] } },
        "instrument": { "name": "tracker", "sigma_mm": NOISE_MM },
        "samples": { "columns": columns } });
    document.to_string()
}
