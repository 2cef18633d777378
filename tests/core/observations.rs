//! Every kind of measurement: sessions that `tests/reference/observations.py` simulated with numpy,
//! which shares no code with the program, and how far from the truth its own least squares ends on
//! poses that nobody measured, up to what the kind leaves open.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::PathBuf;

use crate::cases::cases;
use nalgebra::{Matrix3, Vector3};
use truepose::effects::{Inputs, JointValues};
use truepose::fit::{
    DEFAULT_EFFECTS, Identification, UnusableReason, identify_exact, identify_watched,
};
use truepose::model::Model;
use truepose::model::read_model;
use truepose::pipeline::hand_out;
use truepose::sessions::{Session, Setups, Sigma, load, parse_with_csv, save};

const CASES: [&str; 18] = [
    "six-partial",
    "six-tracker",
    "six-pose",
    "six-distance",
    "six-distance-unknown",
    "six-bearing",
    "six-bearing-unknown",
    "six-pointing",
    "six-socket",
    "six-socket-unknown",
    "six-socket-length",
    "six-touch",
    "six-touch-unknown",
    "six-mix",
    "scara-partial",
    "scara-distance-unknown",
    "scara-bearing-unknown",
    "scara-mix",
];

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/observations")
}

fn session(name: &str) -> Session {
    load(folder().join(format!("{name}.json"))).unwrap().session
}

fn effects() -> Vec<String> {
    DEFAULT_EFFECTS.map(str::to_owned).to_vec()
}

fn identified(session: &Session) -> Identification {
    identify_exact(session, &effects(), JointValues::Commanded).unwrap()
}

/// What numpy knows of a case.
struct Expected {
    free: u64,
    q: Vec<Vec<f64>>,
    points_mm: Vec<Vector3<f64>>,
    axes: Vec<Vector3<f64>>,
    from_truth: f64,
}

fn expected(name: &str) -> Expected {
    let text = std::fs::read_to_string(folder().join("expected.json")).unwrap();
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    let rows =
        |key: &str| -> Vec<Vec<f64>> { serde_json::from_value(all[name][key].clone()).unwrap() };
    let vectors = |key: &str| -> Vec<Vector3<f64>> {
        rows(key)
            .iter()
            .map(|v| Vector3::from_column_slice(v))
            .collect()
    };
    Expected {
        free: all[name]["free"].as_u64().unwrap(),
        q: rows("q"),
        points_mm: vectors("points_mm"),
        axes: vectors("axes"),
        from_truth: all[name]["from_truth"].as_f64().unwrap(),
    }
}

/// Where a model has a point of the tool in the poses of a case.
fn predicted(session: &Session, model: &Model, e: &Expected, point: [f64; 3]) -> Vec<Vector3<f64>> {
    let joints = session.robot.joints.len();
    let column = |j: usize| -> Vec<f64> {
        let inner = match session.robot.joints[j].kind {
            truepose::kinematics::JointKind::Revolute => f64::to_radians,
            truepose::kinematics::JointKind::Prismatic => |mm| mm,
        };
        e.q.iter().map(|q| inner(q[j])).collect()
    };
    let home = session.robot.base_from_tool * nalgebra::Point3::from(point);
    let inputs = Inputs::at_poses((0..joints).map(column).collect(), vec![home.coords.into()]);
    let there = model.predict(&inputs);
    (0..e.q.len()).map(|i| there.get(i).into()).collect()
}

/// Root mean square distance once one is laid upon the other by a motion, and by a scale.
fn apart(mut a: Vec<Vector3<f64>>, b: &[Vector3<f64>], free: u64) -> f64 {
    let n = a.len() as f64;
    if free > 0 {
        let ca = a.iter().sum::<Vector3<f64>>() / n;
        let cb = b.iter().sum::<Vector3<f64>>() / n;
        let moment: Matrix3<f64> = a
            .iter()
            .zip(b)
            .map(|(a, b)| (b - cb) * (a - ca).transpose())
            .sum();
        let svd = moment.svd(true, true);
        let (u, vt) = (svd.u.unwrap(), svd.v_t.unwrap());
        let turn = u * vt;
        assert!(turn.determinant() > 0.0);
        let size: f64 = a.iter().map(|a| (a - ca).norm_squared()).sum();
        let scale = if free == 7 {
            svd.singular_values.sum() / size
        } else {
            1.0
        };
        assert!((scale - 1.0).abs() < 0.01, "{scale}");
        a = a.iter().map(|a| turn * (a - ca) * scale + cb).collect();
    }
    let sum: f64 = a.iter().zip(b).map(|(a, b)| (a - b).norm_squared()).sum();
    (sum / n).sqrt()
}

/// How far the model of an answer is from the real robot: mm, of a robot that points mrad.
fn from_truth(name: &str, answer: &Identification) -> (f64, f64) {
    let (session, e) = (session(name), expected(name));
    if let Some(pointing) = &session.instrument.references.pointing {
        let along = pointing.axis.into_inner() * 100.0;
        let tip = predicted(&session, &answer.model, &e, along.into());
        let foot = predicted(&session, &answer.model, &e, [0.0; 3]);
        let axes = tip.iter().zip(&foot).map(|(t, f)| (t - f).normalize());
        return (apart(axes.collect(), &e.axes, 0) * 1e3, e.from_truth);
    }
    let target: [f64; 3] = session.targets[0].position_mm.coords.into();
    let points = predicted(&session, &answer.model, &e, target);
    (apart(points, &e.points_mm, e.free), e.from_truth)
}

/// The worst a fit may be beside numpy's, which expects other sizes of what is hardly seen.
const WORSE: f64 = 1.25;

#[test]
fn every_kind_finds_the_same_robot_as_a_least_squares_of_everything() {
    for name in CASES {
        let session = session(name);
        let answer = identified(&session);
        assert!(answer.quality.converged, "{name}: {:?}", answer.quality);
        let (own, numpy) = from_truth(name, &answer);
        assert!(own <= WORSE * numpy, "{name}: {own} beside {numpy}");
        for kind in &answer.kinds {
            let (fitted, held_out) = (kind.fitted.unwrap(), kind.held_out.unwrap());
            assert!(
                fitted.after_rms < 0.2 * fitted.before_rms,
                "{name}: {kind:?}"
            );
            let wider = held_out.after_rms / fitted.after_rms;
            assert!(wider < 2.5, "{name}: {kind:?}");
            if let (Some(stated), Some(found)) = (kind.stated_sigma, kind.found_sigma) {
                assert!((0.55..1.25).contains(&(found / stated)), "{name}: {kind:?}");
            }
        }
    }
}

#[test]
fn what_is_open_is_counted_and_said() {
    for name in CASES {
        let answer = identified(&session(name));
        let said: Vec<String> = answer
            .not_identifiable
            .iter()
            .map(|n| n.combination.to_string())
            .collect();
        let frame = said
            .iter()
            .filter(|s| s.starts_with("measuring-frame"))
            .count();
        let size = said
            .iter()
            .filter(|s| s.starts_with("overall size"))
            .count();
        let free = expected(name).free;
        if name == "six-pointing" {
            // Where it stands makes no difference to what points at infinity.
            assert_eq!((frame, size), (3, 0), "{said:?}");
        } else {
            assert_eq!((frame + size) as u64, free, "{name}: {said:?}");
            assert_eq!(size == 1, free == 7, "{name}: {said:?}");
        }
        // What has an interval is not among what is open.
        for p in answer.parameters.iter().filter(|p| p.ci95.is_none()) {
            let [a, b] = [p.name, p.effect];
            assert!(p.place.is_some() || said.iter().any(|s| s.contains(a) && s.contains(b)));
        }
    }
}

#[test]
fn identifiable_parameters_are_as_many_as_the_theory_counts() {
    // Four for each joint that turns, two for one that slides; three for a target, six for a pose; the
    // places that nobody knows, less what is open.
    for (name, robot, places) in [
        ("six-partial", 27, 0),
        ("six-tracker", 27, 0),
        ("six-pose", 30, 0),
        ("six-distance", 27, 0),
        ("six-distance-unknown", 27 - 6, 16),
        ("six-bearing", 27, 0),
        ("six-bearing-unknown", 27 - 6, 12),
        ("six-socket-unknown", 27 - 6, 12),
        ("six-touch-unknown", 27 - 6, 12),
        ("six-mix", 27, 0),
    ] {
        let answer = identified(&session(name));
        assert_eq!(answer.quality.rank, robot + places, "{name}");
    }
}

#[test]
fn places_are_found_where_they_are_and_intervals_hold_them() {
    // Beside points that say where the base stands an anchor that nobody knows is found.
    let text = std::fs::read_to_string(folder().join("six-mix.json")).unwrap();
    let mut document: serde_json::Value = serde_json::from_str(&text).unwrap();
    let known = document["anchors"]["A2"].clone();
    document["anchors"]["A2"] = serde_json::json!({ "position_mm": null, "offset_mm": null });
    let csv = std::fs::read(folder().join("six-mix.csv")).unwrap();
    let loaded = parse_with_csv(document.to_string().as_bytes(), &csv).unwrap();
    let answer = identified(&loaded.session);
    let mut inside = 0;
    for (k, name) in ["x_mm", "y_mm", "z_mm", "offset_mm"]
        .into_iter()
        .enumerate()
    {
        let own = answer
            .parameters
            .iter()
            .find(|p| p.place.is_some() && p.name == name);
        let own = own.unwrap();
        assert_eq!(
            (own.effect, own.place.as_deref()),
            ("unknown-anchor", Some("A2"))
        );
        let true_value = match k {
            3 => known["offset_mm"].as_f64().unwrap(),
            _ => known["position_mm"][k].as_f64().unwrap(),
        };
        let [low, high] = own.ci95.unwrap();
        assert!(high - low < 1.0, "{own:?}");
        inside += usize::from((low..=high).contains(&true_value));
    }
    assert!(inside >= 3, "{inside} of 4");
}

#[test]
fn an_instrument_that_was_never_aligned_is_brought_near_by_every_kind() {
    // The robot stands elsewhere than the session's places say: turned by 100° and metres away.
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.2, 1.75);
    let shift = Vector3::new(4000.0, -2500.0, 700.0);
    let moved = |v: &serde_json::Value| {
        let v: [f64; 3] = serde_json::from_value(v.clone()).unwrap();
        let v = turn * Vector3::from(v) + shift;
        serde_json::json!([v.x, v.y, v.z])
    };
    for (name, key) in [
        ("six-distance", "anchors"),
        ("six-socket", "sockets"),
        ("six-bearing", "stations"),
    ] {
        let text = std::fs::read_to_string(folder().join(format!("{name}.json"))).unwrap();
        let mut document: serde_json::Value = serde_json::from_str(&text).unwrap();
        for (_, place) in document[key].as_object_mut().unwrap() {
            place["position_mm"] = moved(&place["position_mm"]);
            if let Some([w, x, y, z]) = place.get("quaternion_wxyz").map(|q| {
                let q: [f64; 4] = serde_json::from_value(q.clone()).unwrap();
                q
            }) {
                let q = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(
                    w, x, y, z,
                ));
                let q = nalgebra::UnitQuaternion::from_rotation_matrix(&turn) * q;
                place["quaternion_wxyz"] = serde_json::json!([q.w, q.i, q.j, q.k]);
            }
        }
        let csv = std::fs::read(folder().join(format!("{name}.csv"))).unwrap();
        let loaded = parse_with_csv(document.to_string().as_bytes(), &csv).unwrap();
        let answer = identified(&loaded.session);
        assert!(answer.quality.converged, "{name}: {:?}", answer.quality);
        let never = answer.notes.iter().any(|n| n.contains("never aligned"));
        assert!(never, "{name}: {:?}", answer.notes);
        let (session, e) = (session(name), expected(name));
        let target: [f64; 3] = session.targets[0].position_mm.coords.into();
        let points = predicted(&session, &answer.model, &e, target);
        let own = apart(points, &e.points_mm, 6);
        assert!(
            own <= WORSE * e.from_truth,
            "{name}: {own} beside {}",
            e.from_truth
        );
    }
}

/// Of one pose the frame comes from its orientation, and what is left of the tool's turn is nothing but rounding: its
/// vector has to be a number, which the arc cosine of a trace is not (12 of these 20 then leave millimetres).
#[test]
fn one_pose_brings_an_instrument_near_whatever_rounding_leaves() {
    let mut session = session("six-pose");
    let count = session.samples.x_mm.len();
    for fitted in 0..20 {
        session.samples.held_out = Some((0..count).map(|row| row != fitted).collect());
        let left_mm = identified(&session).gap.after.rms_mm;
        assert!(left_mm < 0.01, "pose {fitted}: {left_mm} mm");
    }
}

/// Nothing says where a socket is that only held-out samples were put into, not even its known distance from another.
#[test]
fn samples_at_a_place_that_is_not_fitted_are_no_errors_and_its_distance_moves_nothing() {
    let mut session = session("six-socket-length");
    let known = session.instrument.references.socket_distances[0];
    let socket = session.samples.observed.socket.clone().unwrap();
    let elsewhere: Vec<bool> = socket
        .iter()
        .map(|own| *own == u32::try_from(known.between[0]).ok())
        .collect();
    assert!(elsewhere.contains(&true) && elsewhere.contains(&false));
    session.samples.held_out = Some(elsewhere.clone());
    let answer = identified(&session);
    let sockets = answer
        .kinds
        .iter()
        .find(|kind| kind.kind == "socket")
        .unwrap();
    assert!(
        sockets.found_sigma.is_some_and(|sigma| sigma < 0.05),
        "{:?}",
        sockets.found_sigma
    );
    assert!(sockets.held_out.is_none() && answer.held_out.is_none());
    let unplaced = answer
        .left_out
        .iter()
        .filter(|one| one.because == UnusableReason::Unplaced);
    let unplaced: Vec<usize> = unplaced.map(|one| one.sample).collect();
    assert_eq!(
        unplaced,
        (0..elsewhere.len())
            .filter(|i| elsewhere[*i])
            .collect::<Vec<_>>()
    );
}

/// The same of a setup: where the instrument stood, nothing that is fitted says.
#[test]
fn samples_of_a_setup_that_is_held_out_as_a_whole_are_no_errors() {
    for name in ["six-tracker", "six-pose"] {
        let mut session = session(name);
        let count = session.samples.x_mm.len();
        let index: Vec<u32> = (0..count).map(|i| u32::from(i % 3 == 0)).collect();
        let names = vec!["first".to_owned(), "second".to_owned()];
        session.samples.held_out = Some(index.iter().map(|setup| *setup == 1).collect());
        session.samples.setups = Some(Setups { names, index });
        let answer = identified(&session);
        assert!(answer.gap.after.rms_mm < 0.2, "{name}: {:?}", answer.gap);
        assert!(answer.held_out.is_none(), "{name}: {:?}", answer.held_out);
        let unplaced = answer
            .left_out
            .iter()
            .filter(|one| one.because == UnusableReason::Unplaced);
        assert_eq!(unplaced.count(), count.div_ceil(3), "{name}");
    }
}

#[test]
fn a_wild_measurement_is_left_out_whatever_its_kind() {
    for (name, sample) in [
        ("six-distance", 5),
        ("six-bearing-unknown", 6),
        ("six-touch", 7),
        ("six-pose", 8),
    ] {
        let mut session = session(name);
        let samples = &mut session.samples;
        if let Some(distance) = samples.observed.distance_mm.as_mut() {
            distance[sample] += 1.0;
        } else if let Some(elevation) = samples.observed.elevation.as_mut() {
            elevation[sample] += 1e-3;
        } else if samples.observed.plane.is_some() {
            samples.q[1][sample] += 2e-2;
        } else {
            let q = samples.orientation_wxyz.as_mut().unwrap();
            q[1][sample] += 0.02;
        }
        let answer = identified(&session);
        let found: Vec<usize> = answer.outliers.iter().map(|o| o.sample).collect();
        assert!(found.contains(&sample), "{name}: {found:?}");
        let (own, numpy) = from_truth(name, &answer);
        assert!(own <= 1.5 * numpy, "{name}: {own} beside {numpy}");
    }
}

#[test]
fn a_noise_that_nobody_states_is_found() {
    let mut session = session("six-mix");
    let instrument = &mut session.instrument;
    (
        instrument.sigma_mm,
        instrument.sigma_distance_mm,
        instrument.sigma_direction,
    ) = (None, None, None);
    let answer = identified(&session);
    for kind in &answer.kinds {
        let stated = match kind.kind {
            "point" => 0.03,
            "distance" => 0.005,
            _ => 0.01,
        };
        let ratio = kind.found_sigma.unwrap() / stated;
        assert!((0.55..1.4).contains(&ratio), "{kind:?}");
    }
    let (own, numpy) = from_truth("six-mix", &answer);
    assert!(own <= 1.6 * numpy, "{own} beside {numpy}");
}

#[test]
fn a_noise_that_is_stated_too_large_leaves_the_robot_to_no_other_kind() {
    for (name, times) in [("six-pose", 20.0), ("six-mix", 20.0)] {
        let right = session(name);
        let mut careful = right.clone();
        let stated = 0.03 * times;
        careful.instrument.sigma_mm = Some(Sigma::Overall(stated));
        let (right, careful) = (identified(&right), identified(&careful));
        let point = careful.kinds.iter().find(|k| k.kind == "point").unwrap();
        assert_eq!(point.stated_sigma, Some(stated));
        let found = point.found_sigma.unwrap();
        assert!((0.02..0.04).contains(&found), "{name}: {found}");
        let (own, _) = from_truth(name, &right);
        let (with_it, _) = from_truth(name, &careful);
        assert!(with_it <= 1.1 * own, "{name}: {with_it} beside {own}");
    }
}

#[test]
fn priors_are_not_needed_where_the_poses_show_everything() {
    for name in [
        "six-pose",
        "six-distance-unknown",
        "six-bearing-unknown",
        "six-mix",
    ] {
        let session = session(name);
        let answer = identify_watched(
            &session,
            &effects(),
            &[],
            false,
            JointValues::Commanded,
            &|| true,
        )
        .unwrap();
        assert!(answer.quality.converged, "{name}: {:?}", answer.quality);
        let (own, numpy) = from_truth(name, &answer);
        assert!(own <= 1.6 * numpy, "{name}: {own} beside {numpy}");
    }
}

#[test]
fn sessions_and_models_come_back_as_they_were() {
    let folder = tempfile::tempdir().unwrap();
    for name in CASES {
        let session = session(name);
        let path = folder.path().join(format!("{name}.json"));
        save(&session, &path, truepose::sessions::Replacing::default()).unwrap();
        let again = load(&path).unwrap().session;
        let plain = |s: &Session| {
            let mut s = s.clone();
            s.path = None;
            s.samples.line = truepose::sessions::Lines::default();
            format!("{s:?}")
        };
        assert_eq!(plain(&session), plain(&again), "{name}");
        let answer = identified(&session);
        let inputs = Inputs::new(&session, JointValues::Commanded);
        let calibration = answer.calibration(&session, &inputs);
        let read = read_model(&hand_out(&calibration, &session).unwrap().document()).unwrap();
        assert_eq!(
            read.model.predict(&inputs),
            answer.model.predict(&inputs),
            "{name}"
        );
        let labels = |model: &Model| -> Vec<Option<String>> {
            model
                .terms()
                .iter()
                .map(|t| t.label.as_deref().map(str::to_owned))
                .collect()
        };
        assert_eq!(labels(&read.model), labels(&answer.model), "{name}");
    }
}

fn refused(keys: &str, csv: &str) -> String {
    let document = format!(
        r#"{{"format":"truepose-session/1","name":"s","robot":{{"name":"r","joints":[
        {{"name":"a","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}},
        {{"name":"b","kind":"revolute","axis":[0,1,0],"point_mm":[0,0,300]}}],
        "tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}}},
        {keys},"samples":{{"file":"s.csv"}}}}"#
    );
    match parse_with_csv(document.as_bytes(), csv.as_bytes()) {
        Ok(loaded) => format!("read: {:?}", loaded.findings),
        Err(rejected) => rejected.to_string(),
    }
}

#[test]
#[allow(clippy::too_many_lines, reason = "a list of bad files")]
fn bad_input_is_answered_with_its_place() {
    let anchors = r#""anchors":{"A":{"position_mm":[1,2,3]},"B":null}"#;
    let stations = r#""stations":{"S":null,"T":null}"#;
    for (keys, csv, place, words) in [
        (
            anchors,
            "q1_deg,q2_deg,distance_mm,anchor\n0,0,5,C\n",
            "s.csv, line 2, column 4",
            "'C' is not declared",
        ),
        (
            anchors,
            "q1_deg,q2_deg,distance_mm,anchor\n0,0,5,A\n0,0,5,\n",
            "s.csv, line 3, column 3",
            "without its anchor",
        ),
        (
            anchors,
            "q1_deg,q2_deg,distance_mm,anchor\n0,0,-5,A\n",
            "s.csv, line 2, column 3",
            "negative distance",
        ),
        (
            anchors,
            "q1_deg,q2_deg,distance_deg,anchor\n0,0,5,A\n",
            "s.csv",
            "x_mm",
        ),
        (
            stations,
            "q1_deg,q2_deg,azimuth_deg,station\n0,0,5,S\n",
            "s.csv",
            "both azimuth_deg and elevation_deg",
        ),
        (
            stations,
            "q1_deg,q2_deg,azimuth_deg,elevation_deg,station\n0,0,5,,S\n",
            "s.csv, line 2, column 3",
            "one angle of two",
        ),
        (
            stations,
            "q1_deg,q2_deg,azimuth_deg,elevation_deg,station\n0,0,5,91,S\n",
            "s.csv, line 2, column 4",
            "zenith",
        ),
        (
            stations,
            "q1_deg,q2_deg,azimuth_deg,elevation_deg,station\n0,0,5,1,\n",
            "s.csv, line 2, column 3",
            "without its station",
        ),
        (
            r#""planes":{"P":{"normal":[0,0,0],"distance_mm":1}}"#,
            "q1_deg,q2_deg,plane\n0,0,P\n",
            "planes.P.normal",
            "zero length",
        ),
        (
            r#""planes":{"P":{"normal":[0,0,1]}}"#,
            "q1_deg,q2_deg,plane\n0,0,P\n",
            "planes.P",
            "distance_mm",
        ),
        (
            r#""sockets":{"K":null},"socket_distances_mm":[["K","K",4]]"#,
            "q1_deg,q2_deg,socket\n0,0,K\n",
            "socket_distances_mm[0]",
            "two different sockets",
        ),
        (
            r#""sockets":{"K":{"position_mm":[1,2]}}"#,
            "q1_deg,q2_deg,socket\n0,0,K\n",
            "sockets.K.position_mm",
            "3 numbers",
        ),
        (
            r#""stations":{"S":{"azimuth":"left"}}"#,
            "q1_deg,q2_deg,azimuth_deg,elevation_deg\n0,0,1,1\n",
            "stations.S.azimuth",
            "clockwise",
        ),
        (
            r#""stations":{"S":{"quaternion_wxyz":[0,0,0,0]}}"#,
            "q1_deg,q2_deg,azimuth_deg,elevation_deg\n0,0,1,1\n",
            "stations.S.quaternion_wxyz",
            "zero length",
        ),
        (
            r#""pointing":{"axis":[0,0,0]}"#,
            "q1_deg,q2_deg,azimuth_deg,elevation_deg\n0,0,1,1\n",
            "pointing.axis",
            "zero length",
        ),
        (
            r#""instrument":{"name":"i","sigma_range_mm":0.01}"#,
            "q1_deg,q2_deg,x_mm,y_mm\n0,0,1,1\n",
            "instrument",
            "sigma_angle_urad",
        ),
        (
            r#""instrument":{"name":"i","sigma_mrad":-1}"#,
            "q1_deg,q2_deg,x_mm,y_mm\n0,0,1,1\n",
            "instrument.sigma_mrad",
            "above 0",
        ),
    ] {
        let answer = refused(keys, csv);
        assert!(
            answer.contains(place) && answer.contains(words),
            "{keys} {csv}: {answer}"
        );
    }
}

#[test]
fn few_measurements_of_any_kind_do_not_explode() {
    for name in CASES {
        for count in [1, 2, 5, 12, 30] {
            let mut few = session(name);
            let rows: Vec<usize> = (count..few.samples.len()).filter(|i| *i < 120).collect();
            few.samples.remove(&rows);
            let answer = identified(&few);
            for p in &answer.parameters {
                assert!(p.value.is_finite(), "{name}, {count}: {p:?}");
                if p.effect == "joint-zero-offset" {
                    assert!(p.value.abs() < 20.0, "{name}, {count}: {p:?}");
                }
            }
        }
    }
}

/// A scenario of the six-joint arm that is measured in these ways.
fn scenario(measure: &str, unknown: &str, sigma_mm: f64) -> String {
    let text = std::fs::read_to_string(folder().join("six-mix.json")).unwrap();
    let mix: serde_json::Value = serde_json::from_str(&text).unwrap();
    let (robot, anchors) = (&mix["robot"], &mix["anchors"]);
    let stations = &mix["stations"];
    format!(
        r#"{{"format":"truepose-scenario/1","robot":{robot},"targets":{{"T":[10,5,70]}},
        "instrument":{{"name":"i","sigma_mm":0.03,"sigma_mrad":0.2,"sigma_distance_mm":0.005,
        "sigma_direction_urad":10,"sigma_touch_mm":0.01}},
        "anchors":{anchors},"stations":{stations},
        "planes":{{"F1":{{"normal":[0,0.1,1],"distance_mm":260}},"F2":{{"normal":[1,0,0],"distance_mm":380}},
        "F3":{{"normal":[0,1,0.2],"distance_mm":300}}}},
        "sockets":{{"K1":{{"position_mm":[380,150,260]}},"K2":{{"position_mm":[350,-260,420]}},"K3":{{"position_mm":[150,420,330]}}}},
        "pointing":{{"axis":[0.2,0.1,1],"stations":[]}},
        "measure":{measure},"unknown":{unknown},"poses":{{"random":{{"count":150}}}},"noise":{{"sigma_mm":{sigma_mm}}},
        "effects":[{{"effect":"link-geometry","joint":3,"parameters":{{"x_mm":0.4,"about_x_mrad":0.7}}}},
        {{"effect":"joint-zero-offset","joint":2,"parameters":{{"offset_deg":0.1}}}}],"seed":7}}"#
    )
}

#[test]
fn every_kind_is_simulated_as_it_is_measured() {
    for (measure, unknown, kinds) in [
        (r#"["pose"]"#, "[]", vec!["point", "orientation"]),
        (r#"["distance"]"#, r#"["anchors"]"#, vec!["distance"]),
        (r#"["bearing"]"#, r#"["stations"]"#, vec!["bearing"]),
        (r#"["socket"]"#, r#"["sockets"]"#, vec!["socket"]),
        (r#"["touch"]"#, "[]", vec!["touch"]),
        (r#"["pointing"]"#, "[]", vec!["pointing"]),
        (
            r#"["point","distance","bearing","touch"]"#,
            "[]",
            vec!["point", "distance", "bearing", "touch"],
        ),
    ] {
        let text = scenario(measure, unknown, 0.03);
        let loaded = truepose::simulation::parse_scenario(text.as_bytes()).unwrap();
        let play = |seed| {
            truepose::simulation::simulate(&loaded.scenario, seed, truepose::simulation::unwatched)
                .unwrap()
                .0
        };
        let session = play(7);
        assert_eq!(
            format!("{session:?}"),
            format!("{:?}", play(7)),
            "{measure}"
        );
        let answer = identified(&session);
        assert!(answer.quality.converged, "{measure}: {:?}", answer.quality);
        let own: Vec<&str> = answer.kinds.iter().map(|k| k.kind).collect();
        assert_eq!(own, kinds, "{measure}");
        for kind in &answer.kinds {
            let ratio = kind.found_sigma.unwrap() / kind.stated_sigma.unwrap();
            assert!((0.4..1.2).contains(&ratio), "{measure}: {kind:?}");
        }
    }
}

#[test]
fn a_scenario_that_reaches_nowhere_is_refused_in_words() {
    let text = scenario(r#"["socket"]"#, "[]", 0.03).replace("[380,150,260]", "[3800,150,260]");
    let loaded = truepose::simulation::parse_scenario(text.as_bytes()).unwrap();
    let unwatched = truepose::simulation::unwatched;
    let refused = truepose::simulation::simulate(&loaded.scenario, 1, unwatched).unwrap_err();
    assert!(
        refused.to_string().contains("'K1' is not reached"),
        "{refused}"
    );
    let wrong = scenario(r#"["sextant"]"#, "[]", 0.03);
    let refused = truepose::simulation::parse_scenario(wrong.as_bytes()).unwrap_err();
    assert!(refused.to_string().contains("measure[0]"), "{refused}");
}

/// What `tests/reference/observation_rates.py` hid in a session: effect, joint and size.
fn hidden() -> Vec<(String, String, u64, f64)> {
    let text = std::fs::read_to_string(folder().join("hidden/hidden.json")).unwrap();
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    let of = |(kind, own): (&String, &serde_json::Value)| {
        (
            kind.clone(),
            own["effect"].as_str().unwrap().to_owned(),
            own["joint"].as_u64().unwrap(),
            own["size"].as_f64().unwrap(),
        )
    };
    all.as_object().unwrap().iter().map(of).collect()
}

fn diagnosed(session: &Session) -> truepose::diagnosis::Diagnosis {
    let options = truepose::diagnosis::Options::default();
    truepose::pipeline::diagnose(session, &options, &|_| true).unwrap()
}

#[test]
fn what_is_hidden_is_named_with_its_joint_whatever_was_measured() {
    use truepose::diagnosis::Verdict;
    for (kind, effect, joint, size) in hidden() {
        let session = session(&format!("hidden/{kind}"));
        let answer = diagnosed(&session);
        let found: Vec<_> = answer.found.iter().map(|f| (f.effect, f.joint)).collect();
        let wanted = Some(usize::try_from(joint).unwrap());
        assert_eq!(found, [(effect.as_str(), wanted)], "{kind}");
        assert_eq!(answer.verdict, Verdict::Explained, "{kind}");
        // Its size lies in its interval: degrees, or a ratio.
        let mut parameters = answer.found[0].parameters.iter();
        let first = parameters.find(|own| own.ci95.is_some()).unwrap();
        let wanted = if first.name == "ratio" {
            size
        } else {
            size.to_degrees()
        };
        let [low, high] = first.ci95.unwrap();
        let room = 0.5 * (high - low);
        assert!(
            wanted > low - room && wanted < high + room,
            "{kind}: {wanted} in {low} … {high}"
        );
        // It predicts what no fit has seen, of every kind.
        let gaps = answer.held_out.gaps.unwrap();
        assert!(gaps.end_mm < 0.95 * gaps.identified_mm, "{kind}: {gaps:?}");
        assert!(gaps.end_mm < 1.6 * answer.floor.mm, "{kind}: {gaps:?}");
        for own in &answer.identification.kinds {
            let (unseen, after) = (own.unseen_rms.unwrap(), own.fitted.unwrap().after_rms);
            assert!(
                unseen > 0.8 * after && unseen < 3.0 * after,
                "{kind}: {own:?}"
            );
        }
    }
}

#[test]
fn nothing_is_named_where_nothing_is_hidden() {
    use truepose::diagnosis::Verdict;
    for name in cases(&CASES, CASES.len() / 2) {
        let answer = diagnosed(&session(name));
        assert!(answer.found.is_empty(), "{name}: {:?}", answer.found);
        assert_eq!(answer.verdict, Verdict::Noise, "{name}");
        assert!(!answer.not_found.is_empty(), "{name}");
    }
}

#[test]
fn what_has_no_name_is_flagged_in_every_kind() {
    use truepose::diagnosis::Verdict;
    for name in ["six-bearing-unknown", "six-distance", "six-touch"] {
        let mut session = session(name);
        // A joint that swings from pose to pose is no noise, whatever it is called.
        for (k, q) in session.samples.q[1].iter_mut().enumerate() {
            *q += 2e-4 * f64::sin(k as f64);
        }
        let answer = diagnosed(&session);
        assert_eq!(answer.verdict, Verdict::Unexplained, "{name}");
        assert!(answer.unexplained.present && answer.unexplained.p < 1e-3);
    }
}

#[test]
fn a_wild_measurement_is_no_effect_and_hides_none() {
    let mut session = session("hidden/distance-unknown");
    let distances = session.samples.observed.distance_mm.as_mut().unwrap();
    for k in [11, 47, 83] {
        distances[k] += 1.5;
    }
    let answer = diagnosed(&session);
    let outliers: Vec<usize> = answer.outliers.iter().map(|o| o.sample).collect();
    assert_eq!(outliers, [11, 47, 83]);
    assert_eq!(answer.found.len(), 1, "{:?}", answer.found);
    assert_eq!(answer.identification.kinds[0].outliers, 3);
}

#[test]
fn levels_of_correction_are_those_of_every_kind() {
    for name in ["six-pose", "six-distance", "six-socket-unknown", "six-mix"] {
        let session = session(name);
        let answer = identified(&session);
        assert!(answer.levels.len() >= 4, "{name}");
        let unseen = |k: usize| answer.levels[k].cross_validated.unwrap().rms_mm;
        assert!(unseen(3) < 0.3 * unseen(2), "{name}");
        // The last is the identification, held out as cells of what each reference shows.
        let after = answer.gap.after.rms_mm;
        assert!(
            (answer.levels[3].rms_mm / after - 1.0).abs() < 0.02,
            "{name}"
        );
        assert!(unseen(3) > after && unseen(3) < 1.6 * after, "{name}");
    }
}

#[test]
fn a_model_is_verified_on_other_measurements() {
    for name in [
        "six-distance",
        "six-bearing-unknown",
        "six-touch",
        "six-mix",
    ] {
        let session = session(name);
        let answer = identified(&session);
        let inputs = Inputs::new(&session, JointValues::Commanded);
        let calibration = answer.calibration(&session, &inputs);
        let read = read_model(&hand_out(&calibration, &session).unwrap().document()).unwrap();
        let verified = truepose::compensation::verify(&read, &session).unwrap();
        assert_eq!(verified.samples, 150, "{name}");
        let after = answer.gap.after.rms_mm;
        assert!(verified.model.rms_mm < 1.5 * after, "{name}: {verified:?}");
        assert!(
            verified.nominal.rms_mm > 5.0 * after,
            "{name}: {verified:?}"
        );
    }
}

#[test]
fn figures_in_mm_are_of_lengths_or_of_directions_and_never_of_both() {
    use truepose::simulation::{parse_scenario, simulate, unwatched};
    let of_rows = |has: &dyn Fn(usize) -> bool, n: usize| (0..n).filter(|i| has(*i)).count();
    for (measure, is_of_directions) in [
        (r#"["bearing","distance","bearing"]"#, true),
        (r#"["distance","bearing"]"#, false),
    ] {
        let text = scenario(measure, r#"["stations"]"#, 0.03);
        let loaded = parse_scenario(text.as_bytes()).unwrap();
        let session = simulate(&loaded.scenario, 7, unwatched).unwrap().0;
        let own = &session.samples.observed;
        let number = |column: &Option<Vec<f64>>, i: usize| !column.as_ref().unwrap()[i].is_nan();
        let n = session.samples.len();
        let directions = of_rows(&|i| number(&own.azimuth, i), n);
        let lengths = of_rows(&|i| number(&own.distance_mm, i), n);
        assert_eq!(directions + lengths, n, "{measure}: a row has one of them");
        let answer = diagnosed(&session);
        let (samples, rows) = if is_of_directions {
            (directions, 2.0)
        } else {
            (lengths, 1.0)
        };
        assert_eq!(answer.held_out.samples, samples, "{measure}");
        // The noise that is said is that of a coordinate of what the figures are of.
        let ratio = answer.noise.sigma_mm[0] * f64::sqrt(rows) / answer.gap.end_mm;
        assert!(
            (0.95..1.4).contains(&ratio),
            "{measure}: {ratio}, {:?}",
            answer.noise
        );
    }
}

#[test]
fn one_place_that_is_elsewhere_is_named_and_can_be_taken_back() {
    use truepose::sessions::{Group, SessionCorrection};
    let half_of = |session: &Session, group: Group, index: usize| -> Vec<usize> {
        let rows = 0..session.samples.len();
        let own: Vec<usize> = rows
            .filter(|row| group.of(session, *row) == Some(index))
            .collect();
        own[own.len() / 2..].to_vec()
    };
    // An anchor, a station and a plane that are not where the session says.
    let mut anchor = session("six-distance");
    let at = &mut anchor.instrument.references.anchors[1].position_mm;
    at.as_mut().unwrap().x += 0.8;
    // A station that somebody turned by 0.3 mrad, and a ball in another socket, halfway.
    let mut station = session("six-bearing-unknown");
    let late = half_of(&station, Group::Station, 0);
    let first = late[0];
    for row in late {
        station.samples.observed.azimuth.as_mut().unwrap()[row] += 3e-4;
    }
    for (session, group, index, from) in [
        (anchor, Group::Anchor, 1, None),
        (station, Group::Station, 0, Some(first)),
    ] {
        let mended = truepose::set_up_errors::corrected_session(&session, JointValues::Commanded);
        let said = mended.problems.iter().map(|p| p.what.to_string());
        let said: Vec<String> = said.collect();
        let where_it_is = match from {
            None => "not where the session states",
            Some(_) => "elsewhere",
        };
        let name = format!(
            "{} {} is {where_it_is}",
            group.name(),
            group.name_of(&session, index)
        );
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(said[0].starts_with(&name), "{said:?}");
        let mend = mended.problems[0].mend.clone().unwrap();
        match (from, &mend) {
            (None, SessionCorrection::Free { .. }) => {}
            (Some(first), SessionCorrection::Split { from, .. }) => {
                assert!(from.abs_diff(first) <= 3, "{mend:?}");
            }
            _ => panic!("{mend:?}"),
        }
        // With it the rest is noise, and a model of it comes back.
        let answer = diagnosed(&session);
        assert!(
            answer.found.is_empty() && !answer.unexplained.present,
            "{name}: {answer:?}"
        );
        assert!(
            answer.gap.end_mm < 1.15 * answer.floor.mm,
            "{name}: {:?}",
            answer.gap
        );
    }
}
