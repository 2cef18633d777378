//! A session for the tests of the fit.

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
