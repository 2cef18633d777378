//! Sessions for the tests of the fit.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::sessions::Session;
use crate::simulation::{parse_scenario, simulate, unwatched};

pub(super) const AXIS_POINT_MM: [f64; 3] = [12.0, -7.0, 30.0];
pub(super) const TOOL_MM: [f64; 3] = [400.0, 50.0, 300.0];

/// One axis in this direction with a zero offset of 0.2°, two targets, every 8°, noise of 0.03 mm, 7 s a pose.
pub(super) fn sweep(axis: [f64; 3]) -> Session {
    let scenario = format!(
        r#"{{"format":"truepose-scenario/1","name":"r","robot":{{"name":"r","joints":[
        {{"name":"pan","kind":"revolute","axis":{axis:?},"point_mm":{AXIS_POINT_MM:?},"limits":[-170,170]}}],
        "tool":{{"position_mm":{TOOL_MM:?},"quaternion_wxyz":[1,0,0,0]}}}},
        "targets":{{"A":[0,0,0],"B":[30,-150,10]}},"instrument":{{"name":"t","sigma_mm":0.03}},
        "poses":{{"sweep":{{"joint":1,"from_deg":-160,"to_deg":160,"step_deg":8}}}},
        "conditions":{{"seconds_per_pose":7}},
        "effects":[{{"effect":"joint-zero-offset","joint":1,"parameters":{{"offset_deg":0.2}}}}],
        "noise":{{"sigma_mm":0.03,"kind":"gauss"}},"seed":4}}"#
    );
    let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
    simulate(&scenario, 1, unwatched).unwrap().0
}

/// A turntable on a tilting axis, 60 poses each measured with three reflectors, noise of 0.02 mm; at every pose each
/// joint is off by an error of its own with this standard deviation, rad.
pub(crate) fn unrepeated(joints_rad: f64, seed: u64) -> Session {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let commands: [Vec<f64>; 2] = [0.754_877_666, 0.569_840_291].map(|by: f64| {
        let turn = |k: u32| 120.0 * (f64::from(k) * by).fract() - 60.0;
        (0..60).map(turn).collect()
    });
    let off = joints_rad.to_degrees();
    let reached = commands
        .each_ref()
        .map(|joint| -> Vec<f64> { joint.iter().map(|q| q + off * normal()).collect() });
    let stops: Vec<String> = (0..60)
        .map(|k| format!(r#"{{"q_deg":[{},{}]}}"#, reached[0][k], reached[1][k]))
        .collect();
    let scenario = format!(
        r#"{{"format":"truepose-scenario/1","name":"p","robot":{{"name":"p","joints":[
        {{"name":"tilt","kind":"revolute","axis":[0,-1,0],"point_mm":[0,0,300]}},
        {{"name":"turn","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,300]}}],
        "tool":{{"position_mm":[500,50,200],"quaternion_wxyz":[1,0,0,0]}}}},
        "targets":{{"A":[0,0,0],"B":[60,-50,10],"C":[-30,40,80]}},"instrument":{{"name":"t","sigma_mm":0.02}},
        "poses":{{"list":[{}]}},"effects":[],"noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":1}}"#,
        stops.join(",")
    );
    let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
    let mut session = simulate(&scenario, seed, unwatched).unwrap().0;
    for (own, commands) in session.samples.q.iter_mut().zip(&commands) {
        let each = commands.iter().flat_map(|q| [q.to_radians(); 3]);
        *own = each.collect();
    }
    session
}
