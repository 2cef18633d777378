//! Each effect of a single axis against its closed form, written here from the contract's table
//! and sharing no code with the model: a point at radius R, angle φ0 and height h about a vertical
//! axis is at
//!
//! ```text
//! p = c + Q (R cos(θ + φ0), R sin(θ + φ0), h)
//! ```

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use truepose::sessions::Session;
use truepose::simulation::{parse_scenario, simulate, unwatched};

const R: f64 = 250.0;
const H: f64 = 300.0;
/// The second reflector, in the tool frame.
const T2: [f64; 3] = [70.0, 40.0, -25.0];

/// A session with every condition in it.
fn session(effects: &str) -> Session {
    let text = format!(
        r#"{{"format":"truepose-scenario/1","robot":{{"name":"r","joints":[{{"name":"pan","kind":"revolute",
        "axis":[0,0,1],"point_mm":[0,0,0],"limits":[-170,170],"mass_kg":4,"centre_mm":[120,30,10]}}],
        "tool":{{"position_mm":[{R},0,{H}],"quaternion_wxyz":[1,0,0,0]}},"gravity_m_s2":[3,0,-9.3]}},
        "targets":{{"T1":[0,0,0],"T2":[{},{},{}]}},
        "poses":{{"sweep":{{"joint":1,"from_deg":-160,"to_deg":160,"step_deg":16,"both_ways":true,"order":"random"}}}},
        "conditions":{{"speed_deg_s":[0,5,20],"load_kg":[0,3,6],"temperature_c":[18,20,27],"seconds_per_pose":6}},
        "effects":[{effects}],"seed":5}}"#,
        T2[0], T2[1], T2[2],
    );
    let loaded = parse_scenario(text.as_bytes()).unwrap();
    simulate(&loaded.scenario, 5, unwatched).unwrap().0
}

/// What one sample brings with it.
struct At {
    q: f64,
    s: f64,
    speed: f64,
    kg: f64,
    warmth: f64,
    t: f64,
    /// Travel since the last reversal.
    travel: f64,
    /// Reflector at home.
    home: [f64; 3],
}

fn every(session: &Session, mut see: impl FnMut(&At, [f64; 3])) {
    let s = &session.samples;
    let (mut travel, mut last_q, mut last_s) = (f64::INFINITY, 0.0, 0.0);
    for i in 0..s.len() {
        let (q, side) = (s.q[0][i], s.dir[0].as_ref().unwrap()[i]);
        if i > 0 {
            let way = f64::abs(q - last_q);
            travel = if side == last_s { travel + way } else { way };
        }
        (last_q, last_s) = (q, side);
        let t2 = s.target.as_ref().unwrap()[i] == 1;
        let home = if t2 {
            [R + T2[0], T2[1], H + T2[2]]
        } else {
            [R, 0.0, H]
        };
        let at = At {
            q,
            s: side,
            speed: s.speed[0].as_ref().unwrap()[i],
            kg: s.load_kg.as_ref().unwrap()[i],
            warmth: s.temperature_c.as_ref().unwrap()[i] - 20.0,
            t: s.time_s.as_ref().unwrap()[i],
            travel,
            home,
        };
        see(&at, [s.x_mm[i], s.y_mm[i], s.z_mm.as_ref().unwrap()[i]]);
    }
}

fn turned(home: [f64; 3], theta: f64) -> [f64; 3] {
    let (radius, angle) = (home[0].hypot(home[1]), home[1].atan2(home[0]) + theta);
    [radius * angle.cos(), radius * angle.sin(), home[2]]
}

fn agrees(effect: &str, parameters: &str, expected: impl Fn(&At) -> [f64; 3]) {
    let joint = if [
        "base-offset",
        "instrument-scale",
        "frame-shift",
        "frame-drift",
        "link-droop",
    ]
    .contains(&effect)
    {
        ""
    } else {
        r#""joint":1,"#
    };
    let effect = format!(r#"{{"effect":"{effect}",{joint}"parameters":{{{parameters}}}}}"#);
    let mut largest = 0.0_f64;
    every(&session(&effect), |at, measured| {
        let expected = expected(at);
        for axis in 0..3 {
            let off = (measured[axis] - expected[axis]).abs();
            assert!(
                off < 1e-10,
                "{effect} at {}: {measured:?} {expected:?}",
                at.q
            );
        }
        let plain = turned(at.home, at.q);
        largest = largest.max(
            (0..3)
                .map(|k| (measured[k] - plain[k]).abs())
                .fold(0.0, f64::max),
        );
    });
    assert!(largest > 1e-3, "{effect} does nothing: {largest}");
}

fn deg(v: f64) -> f64 {
    v.to_radians()
}

#[test]
fn effects_of_the_joint_angle() {
    agrees("joint-scale", r#""scale_ppm":400"#, |a| {
        turned(a.home, a.q * 1.0004)
    });
    agrees("joint-zero-offset", r#""offset_deg":-3"#, |a| {
        turned(a.home, a.q - deg(3.0))
    });
    agrees(
        "encoder-two-cycle",
        r#""amplitude_deg":0.2,"phase_deg":70"#,
        |a| turned(a.home, a.q + deg(0.2) * (2.0 * a.q + deg(70.0)).sin()),
    );
    agrees(
        "gear-transmission-error",
        r#""order":51,"amplitude_deg":0.1,"phase_deg":300"#,
        |a| turned(a.home, a.q + deg(0.1) * (51.0 * a.q + deg(300.0)).sin()),
    );
    agrees("backlash", r#""width_deg":0.05"#, |a| {
        turned(a.home, a.q - a.s * deg(0.05) / 2.0)
    });
    agrees("lost-motion", r#""width_deg":0.05,"fade_deg":9"#, |a| {
        let built = 1.0 - 2.0 * (-a.travel / deg(9.0)).exp();
        turned(a.home, a.q - a.s * deg(0.05) / 2.0 * built)
    });
    agrees("tracking-lag", r#""delay_s":0.02"#, |a| {
        turned(a.home, a.q - a.speed * 0.02)
    });
    agrees("thermal-zero-drift", r#""deg_per_degc":0.004"#, |a| {
        turned(a.home, a.q + deg(0.004) * a.warmth)
    });
}

#[test]
fn an_eccentric_encoder_reads_the_command() {
    // The equation gives q for θ; bisection inverts it without the model's closed form.
    let (epsilon, phi) = (deg(2.0), deg(40.0));
    let reads = |theta: f64| {
        let y: f64 = theta.sin() + epsilon * phi.sin();
        let x: f64 = theta.cos() + epsilon * phi.cos();
        theta
            + (y.atan2(x) - theta + 3.0 * std::f64::consts::PI)
                .rem_euclid(2.0 * std::f64::consts::PI)
            - std::f64::consts::PI
    };
    agrees(
        "encoder-eccentricity",
        r#""amplitude_deg":2,"phase_deg":40"#,
        |a| {
            let (mut low, mut high) = (a.q - 0.1, a.q + 0.1);
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if reads(middle) < a.q {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            turned(a.home, low)
        },
    );
}

#[test]
fn a_compliant_joint_winds_up_under_load_and_link() {
    agrees("joint-compliance", r#""compliance_urad_per_nm":800"#, |a| {
        // τ about z of m g at (x, y): x m g_y − y m g_x, with gravity (3, 0, −9.3).
        let torque = |theta: f64| {
            let load = turned([R, 0.0, H], theta);
            let link = turned([120.0, 30.0, 10.0], theta);
            -(load[1] * a.kg + link[1] * 4.0) * 1e-3 * 3.0
        };
        let mut theta = a.q;
        for _ in 0..200 {
            theta = a.q + 800e-6 * torque(theta);
        }
        turned(a.home, theta)
    });
}

#[test]
fn effects_of_the_moving_body() {
    agrees("link-length", r#""delta_mm":-5"#, |a| {
        turned([a.home[0] - 5.0, a.home[1], a.home[2]], a.q)
    });
    agrees("tool-lateral-offset", r#""delta_mm":0.7"#, |a| {
        turned([a.home[0], a.home[1] + 0.7, a.home[2]], a.q)
    });
    agrees("thermal-growth", r#""ppm_per_degc":23"#, |a| {
        let k = 1.0 + 23e-6 * a.warmth;
        turned([a.home[0] * k, a.home[1] * k, a.home[2]], a.q)
    });
    agrees(
        "bearing-runout",
        r#""order":3,"amplitude_mm":0.05,"phase_deg":20"#,
        |a| {
            let p = turned(a.home, a.q);
            let angle = 3.0 * a.q + deg(20.0);
            [p[0] + 0.05 * angle.cos(), p[1] + 0.05 * angle.sin(), p[2]]
        },
    );
    agrees(
        "axis-wobble",
        r#""order":2,"amplitude_mrad":0.2,"phase_deg":200"#,
        |a| {
            let p = turned(a.home, a.q);
            let radius = a.home[0].hypot(a.home[1]);
            [
                p[0],
                p[1],
                p[2] + radius * 0.2e-3 * (2.0 * a.q + deg(200.0)).cos(),
            ]
        },
    );
}

#[test]
fn effects_of_base_and_instrument() {
    agrees("link-droop", r#""mm_per_kg":0.02"#, |a| {
        let p = turned(a.home, a.q);
        let g = 3.0_f64.hypot(9.3);
        [
            p[0] + 0.02 * a.kg * 3.0 / g,
            p[1],
            p[2] - 0.02 * a.kg * 9.3 / g,
        ]
    });
    agrees("axis-tilt", r#""about_x_mrad":2,"about_y_mrad":-3"#, |a| {
        let [x, y, z] = turned(a.home, a.q);
        let z = z - H;
        // R_x(α) first, then R_y(β).
        let (sa, ca) = 2e-3_f64.sin_cos();
        let (y, z) = (y * ca - z * sa, y * sa + z * ca);
        let (sb, cb) = (-3e-3_f64).sin_cos();
        [x * cb + z * sb, y, -x * sb + z * cb + H]
    });
    agrees("base-offset", r#""x_mm":0.4,"y_mm":-0.3,"z_mm":0.1"#, |a| {
        let p = turned(a.home, a.q);
        [p[0] + 0.4, p[1] - 0.3, p[2] + 0.1]
    });
    agrees("instrument-scale", r#""scale_ppm":150"#, |a| {
        turned(a.home, a.q).map(|v| v * 1.00015)
    });
    agrees(
        "frame-shift",
        r#""time_s":100,"x_mm":0.2,"y_mm":0,"z_mm":-0.1"#,
        |a| {
            let p = turned(a.home, a.q);
            if a.t >= 100.0 {
                [p[0] + 0.2, p[1], p[2] - 0.1]
            } else {
                p
            }
        },
    );
    agrees(
        "frame-drift",
        r#""x_mm_per_h":0.5,"y_mm_per_h":-0.2,"z_mm_per_h":0"#,
        |a| {
            let p = turned(a.home, a.q);
            [p[0] + 0.5 * a.t / 3600.0, p[1] - 0.2 * a.t / 3600.0, p[2]]
        },
    );
}

#[test]
fn joint_effects_act_in_the_order_of_the_table() {
    let effects = r#"{"effect":"backlash","joint":1,"parameters":{"width_deg":0.2}},
        {"effect":"joint-zero-offset","joint":1,"parameters":{"offset_deg":30}},
        {"effect":"joint-scale","joint":1,"parameters":{"scale_ppm":5000}},
        {"effect":"encoder-two-cycle","joint":1,"parameters":{"amplitude_deg":1,"phase_deg":0}}"#;
    every(&session(effects), |a, measured| {
        // The sine takes the command, not the angle that scale and offset have made of it.
        let theta = 1.005 * a.q + deg(30.0) + deg(1.0) * (2.0 * a.q).sin() - a.s * deg(0.1);
        let expected = turned(a.home, theta);
        for axis in 0..3 {
            assert!((measured[axis] - expected[axis]).abs() < 1e-10);
        }
    });
}
