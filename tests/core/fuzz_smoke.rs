//! What the fuzzers do, in small: valid files that are cut, flipped and spliced. No reader may
//! panic or hang, and whatever is accepted keeps its promises. The fuzzers themselves are in
//! `fuzz/`.

#![allow(
    clippy::unwrap_used,
    reason = "a test that cannot prepare its files has failed"
)]

use std::collections::BTreeMap;
use std::path::Path;

use crate::compensating::{self, HELD};
use proptest::prelude::*;
use truepose::importers::{
    AngleUnit, Companion, IMPORTERS, LengthUnit, Matching, Reading, Settings, TimeUnit, find,
    import, inspect,
};
use truepose::inside::lerobot_calibration;
use truepose::kinematics::Robot;
use truepose::kinematics::{robot_from_mjcf, robot_from_urdf};
use truepose::programs::{Axes, LANGUAGES, Shape};
use truepose::sessions::{Loaded, parse, parse_robot, parse_with_csv, write_inline};

const DOCUMENT: &[u8] = br#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":[
{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-90,90]}],
"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]},"gravity_m_s2":[0,0,-9.81]},
"targets":{"T1":[0,0,0],"T2":[1e1,-2.5,0]},"instrument":{"name":"tracker","sigma_mm":[0.03,0.03,0.05]},
"tolerance_mm":0.2,"regions":[{"name":"1","from_deg":0,"to_deg":30}],"compensated_by":null,
"samples":{"columns":{"q1_deg":[-9.25,0,null,90],"x_mm":[1,2,3,4],"y_mm":[1.5,2,3,1e-3],"target":["T1","T2","T1","T1"],
"dir1":[1,-1,0,null],"use":["fit","held-out",null,"fit"],"setup":["a","a","b","b"],"remark":["x",1,null,true]}}}"#;

const ROBOT: &[u8] = br#"{"name":"r","dh":[{"a_mm":100,"alpha_deg":90,"d_mm":0,"theta_deg":0,"convention":"standard"},
{"a_mm":0,"alpha_deg":-45.5,"d_mm":20,"theta_deg":10,"convention":"modified","kind":"prismatic"}],
"base":{"position_mm":[0,0,1],"quaternion_wxyz":[1,0,0,0]},"tool":{"position_mm":[1,2,3],"quaternion_wxyz":[0,1,0,0]},
"limits":[[-90,90],null],"masses":[null,{"mass_kg":2,"centre_mm":[1,2,3]}]}"#;

const MJCF: &[u8] = br#"<mujoco model="m"><compiler angle="radian" eulerseq="ZyX" autolimits="true"/>
<default><joint axis="0 1 0"/><default class="c"><joint type="slide" range="-1 1"/><site euler="1 2 3"/></default></default>
<worldbody><body name="a" pos="0 0 .4" xyaxes="1 0 0 0 1 0" childclass="c"><inertial pos="0 0 0" mass="1"/>
<joint name="j" ref="0.1" pos="0 0 .1"/><frame zaxis="0 1 0"><body name="b" axisangle="0 0 1 2"><joint class="main"/>
<site name="tip" quat="1 0 0 1"/></body></frame></body></worldbody><equality><joint joint1="x"/></equality></mujoco>"#;

const URDF: &[u8] = br#"<robot name="r"><link name="a"/><link name="b"><inertial><mass value="2"/></inertial></link>
<joint name="j" type="revolute"><origin xyz="1 2 3" rpy=".1 .2 .3"/><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1"/></joint><link name="tip"/><joint name="f" type="fixed"><parent link="b"/><child link="tip"/></joint></robot>"#;

const MOTORS: &[u8] = br#"{"pan": {"id": 1, "drive_mode": 0, "homing_offset": -14, "range_min": 1015, "range_max": 3128}}"#;

const CSV: &[u8] = b"\xef\xbb\xbfq1_deg,x_mm,y_mm,z_m,target,dir1,speed1_rad_s,load_kg,use,setup,remark\r\n\
-9.25,249.895665,-0.38,0.3,T1,1,0.5,,fit,a,\"quoted, \"\"twice\"\"\"\n\
0,1e2,+5, 7 ,T2,-1,-0,3,held-out,b,\n\n90,,2,0.123456789012345678901234567890,T1,0,.5,6.,,b,\"two\nlines\"\n";

/// Every kind of measurement and what it refers to.
const OBSERVED: &[u8] = br#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":[
{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],
"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},
"instrument":{"name":"i","sigma_range_mm":0.01,"sigma_angle_urad":5,"position_mm":[1e3,0,0],"sigma_mrad":0.1,
"sigma_distance_mm":0.02,"sigma_direction_urad":10,"sigma_touch_mm":0.01},
"anchors":{"A":{"position_mm":[1,2,3],"offset_mm":null},"B":null},
"stations":{"S":{"position_mm":null,"quaternion_wxyz":[1,0,0,0],"azimuth":"clockwise"},"T":null},
"planes":{"P":{"normal":[0,0,1],"distance_mm":5},"Q":null},"sockets":{"K":null,"L":{"position_mm":[1,2,3]}},
"socket_distances_mm":[["K","L",400.5]],"pointing":{"axis":[0,0,2],"stations":["T"]},
"samples":{"columns":{"q1_deg":[0,1,2,3,4,5,6],"x_mm":[1,null,null,null,null,null,null],"y_mm":[1,2,null,null,null,null,null],
"z_mm":[null,3,null,null,null,null,null],"qw":[1,null,null,null,null,null,null],"qx":[0,null,null,null,null,null,null],
"qy":[0,null,null,null,null,null,null],"qz":[0,null,null,null,null,null,null],
"distance_mm":[null,null,7,null,null,null,null],"anchor":[null,null,"A",null,null,null,null],
"azimuth_deg":[null,null,null,8,9,null,null],"elevation_deg":[null,null,null,-8,9,null,null],
"station":[null,null,null,"S","T",null,null],"plane":[null,null,null,null,null,"Q",null],
"socket":[null,null,null,null,null,null,"K"]}}}"#;

/// One change to a file.
#[derive(Debug, Clone)]
enum Change {
    Truncate(prop::sample::Index),
    Flip(prop::sample::Index, u8),
    Insert(prop::sample::Index, Vec<u8>),
    Copy(prop::sample::Index, prop::sample::Index, usize),
    Remove(prop::sample::Index, usize),
}

fn any_change() -> impl Strategy<Value = Change> {
    let at = any::<prop::sample::Index>;
    let word = prop::sample::select(vec![
        "\"",
        "{",
        "[",
        ",",
        "\n",
        "\r",
        "\0",
        "-",
        "1e400",
        "nan",
        "\\u",
        "\"\"",
        "9999999999",
        ".",
        ";",
        "é",
    ]);
    prop_oneof![
        1 => at().prop_map(Change::Truncate),
        4 => (at(), any::<u8>()).prop_map(|(at, mask)| Change::Flip(at, mask)),
        4 => (at(), word).prop_map(|(at, word)| Change::Insert(at, word.as_bytes().to_vec())),
        2 => (at(), at(), 1..40usize).prop_map(|(from, to, length)| Change::Copy(from, to, length)),
        2 => (at(), 1..40usize).prop_map(|(at, length)| Change::Remove(at, length)),
    ]
}

fn changed(bytes: &[u8], changes: &[Change]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for change in changes {
        if bytes.is_empty() {
            break;
        }
        let length = bytes.len();
        match change {
            Change::Truncate(at) => bytes.truncate(at.index(length)),
            Change::Flip(at, mask) => bytes[at.index(length)] ^= mask,
            Change::Insert(at, word) => {
                let at = at.index(length);
                bytes.splice(at..at, word.iter().copied());
            }
            Change::Copy(from, to, count) => {
                let from = from.index(length);
                let part = bytes[from..(from + count).min(length)].to_vec();
                let to = to.index(length);
                bytes.splice(to..to, part);
            }
            Change::Remove(at, count) => {
                let at = at.index(length);
                bytes.drain(at..(at + count).min(length));
            }
        }
    }
    bytes
}

/// What the domain types promise of every session that was accepted.
fn assert_promises(loaded: &Loaded) {
    let session = &loaded.session;
    let samples = &session.samples;
    let rows = samples.len();
    assert!(rows > 0 && !session.targets.is_empty() && !session.robot.joints.is_empty());
    assert_eq!(samples.q.len(), session.robot.joints.len());
    let optional = [
        &samples.z_mm,
        &samples.load_kg,
        &samples.temperature_c,
        &samples.time_s,
    ];
    let columns = samples
        .q
        .iter()
        .chain([&samples.x_mm, &samples.y_mm])
        .chain(optional.into_iter().flatten())
        .chain(
            samples
                .q_read
                .iter()
                .chain(&samples.dir)
                .chain(&samples.speed)
                .flatten(),
        );
    for column in columns {
        assert_eq!(column.len(), rows);
        assert!(column.iter().all(|value| !value.is_infinite()));
    }
    let (observed, all) = (&samples.observed, &session.instrument.references);
    for (column, declared) in [
        (&observed.anchor, all.anchors.len()),
        (&observed.station, all.stations.len()),
        (&observed.plane, all.planes.len()),
        (&observed.socket, all.sockets.len()),
    ] {
        let column = column.iter().flatten();
        assert!(column.flatten().all(|index| (*index as usize) < declared));
    }
    for target in samples.target.iter().flatten() {
        assert!((*target as usize) < session.targets.len());
    }
    for joint in &session.robot.joints {
        assert!((joint.axis.direction.norm() - 1.0).abs() < 1e-12);
        assert!(joint.limits.is_none_or(|limits| limits.from <= limits.to));
    }
    let mut document = Vec::new();
    write_inline(session, &mut document).unwrap();
    let again = parse(&document)
        .unwrap_or_else(|rejected| panic!("{rejected}"))
        .session;
    assert_eq!(
        again.samples.x_mm.len(),
        rows,
        "what was accepted can be written and read again"
    );
}

#[test]
fn the_seeds_are_accepted() {
    assert_promises(&parse(DOCUMENT).unwrap());
    assert_promises(&parse(OBSERVED).unwrap());
    let with_file = String::from_utf8_lossy(DOCUMENT).into_owned();
    let (head, _) = with_file.split_once("\"samples\"").unwrap();
    let document = format!("{head}\"samples\":{{\"file\":\"s.csv\"}}}}");
    let loaded = parse_with_csv(document.as_bytes(), CSV).unwrap();
    assert_eq!(loaded.session.samples.len(), 3);
    assert_promises(&loaded);
    assert!(parse_robot(ROBOT).is_ok());
}

const TURNING: &[u8] =
    br#"{"name":"r","joints":[{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],
"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}"#;

const COMMANDS: &[u8] =
    b"name;q1_deg;time_s;dir1\nR1;0;0,5;+\nR2;10;1,5;-\nR1;20;2,5;+\nR3;30;3,5;+\n";

const REFERENCE: &[u8] = b"R1 0 0 0\nR2 100.5 0 0\nR3 0 90.5 3\nR4 5 5 70\n";

/// Answers to what only one format asks.
const OPTIONS: [(&str, &str); 3] = [
    ("camera", "on-tool"),
    ("nominal-length", "300"),
    ("anchor", "B"),
];

/// A small file of every language that targets are written in, for a robot with two joints.
const PROGRAMS: [(&str, &[u8]); 7] = [
    ("csv", b"name;q1_deg;q2_deg;load_kg;dir1\r\nA;1,5;\"2\";3;-1\r\n\r\nB;-1;.5;;\r\n"),
    ("csv", b"x_mm,y_mm,z_mm,qw,qx,qy,qz,temperature_c\n1,2,3,1,0,0,0,21\n"),
    ("rapid", b"MODULE m\n! [[\nCONST jointtarget j{2}:=[[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]],[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]]];\nPERS robtarget p:=[[1,2,3],[1,0,0,0],[0,-1,0,1],[9E+09,9E9,9E9,9E9,9E9,9E9]];\nPERS tooldata t:=[TRUE,[[1,2,3],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nPERS wobjdata w:=[FALSE,TRUE,\"\",[[1,2,3],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\nMoveL p\\ID:=1,v1,z1,t\\WObj:=w;MoveC [[1,2],[3]],Offs(p,1,2,3),v1;\np.trans.x:=1;TPWrite \"a\"\"b\";\n"),
    ("krl", b"&ACCESS R\nDECL E6POS XP={X 1,Y 2.5,Z -3,A 0,B 1E-3,C 0,S 'B010',T 2,E1 0}\nPTP {E6AXIS: A1 1,A2 2} C_PTP\nCIRC XP,{X 1,Y 2,Z 3,A 0,B 0,C 0}\n$BASE={X 1,Y 2,Z 3,A 0,B 0,C 0}\n$TOOL=TOOL_DATA[1]\nIF A==1 THEN\n$BASE=XP\nBAS(#TOOL,2)\nENDIF\nFDAT_ACT=F1\nLIN XP:Q\nP[1].X=2;{\n"),
    ("urscript", b"def m():\n q=[1,-2e-1]\n set_tcp(p[0,0,.1,0,0,0])\n if q:\n set_tcp(q)\n end\n movej(q,a=1)\n movel(p[1,2,3,.1,0,0]) # [\n movec(p[1,2,3,0,0,0],p[1,2,3,0,0,0])\n movej(get_inverse_kin(p[1,2,3,0,0,0],qnear=q))\n movej([d2r(9),1])\nend"),
    ("fanuc-ls", b"/PROG M\n/MN\n 1:J P[1] 100% FINE ;\n 2:L P[2:a] 1mm/sec INC Offset,PR[1] ;\n 3:  P[1]=LPOS ;\n/POS\nP[1:\"x\"]{\n GP1:\n UF : 0, UT : 1,\n J1= -.5 deg, J2= 2. deg\n GP2:\n J1= 1 mm\n};\nP[2]{\n GP1:\n UF : 0, UT : -1, CONFIG : 'N U T, 0, -1, 0',\n X = 1 mm, Y = 2 mm, Z = 3 mm,\n W = 1 deg, P = 2 deg, R = 3 deg\n};\nP[3]{ J1= ******** deg, J2= 1 deg };\n/END\n"),
    ("rapid", b""),
];

const TWO_JOINTS: &[u8] = br#"{"name":"r","dh":[
{"a_mm":100,"alpha_deg":90,"d_mm":0,"theta_deg":0,"convention":"standard"},
{"a_mm":0,"alpha_deg":-45.5,"d_mm":20,"theta_deg":10,"convention":"modified"}]}"#;

fn two_joints() -> Robot {
    parse_robot(TWO_JOINTS).unwrap().robot
}

/// What is accepted says where its numbers are, and nothing overlaps.
fn read_program(language: &str, bytes: &[u8]) -> Option<usize> {
    let axes = Axes::new(&two_joints());
    let language = LANGUAGES.iter().find(|l| l.id == language).unwrap();
    let program = match language.read(bytes, &axes, None) {
        Ok(program) => program,
        Err(rejected) => {
            assert!(!rejected.diagnostics.is_empty());
            return None;
        }
    };
    let mut ranges = Vec::new();
    for target in &program.targets {
        assert!(target.shape.values().iter().all(|v| v.is_finite()));
        match &target.shape {
            Shape::Joints { numbers, .. } => {
                assert_eq!(numbers.len(), 2);
                ranges.extend(numbers.iter().map(truepose::programs::Number::range));
            }
            Shape::Pose(frame) => {
                let all = frame.position.iter().chain(&frame.turn);
                ranges.extend(all.map(truepose::programs::Number::range));
            }
        }
    }
    ranges.sort_by_key(|range| range.start);
    for pair in ranges.windows(2) {
        assert!(pair[0].end <= pair[1].start, "{pair:?}");
    }
    assert!(
        ranges
            .iter()
            .all(|r| r.start < r.end && r.end <= bytes.len())
    );
    assert!(program.visits.iter().all(|k| *k < program.targets.len()));
    Some(program.targets.len())
}

#[test]
fn the_seeds_of_programs_are_accepted() {
    let targets = PROGRAMS.map(|(language, bytes)| read_program(language, bytes));
    // The list that is no target in the second RAPID move keeps that file from being read.
    assert_eq!(
        targets,
        [Some(2), Some(1), None, Some(3), Some(5), Some(2), Some(0)]
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn programs_that_are_damaged_do_no_harm(
        which in 0..PROGRAMS.len(),
        as_another in prop::option::weighted(0.1, 0..LANGUAGES.len()),
        changes in prop::collection::vec(any_change(), 0..5),
    ) {
        let (language, bytes) = PROGRAMS[which];
        let language = as_another.map_or(language, |k| LANGUAGES[k].id);
        read_program(language, &changed(bytes, &changes));
    }
}

#[test]
fn the_programs_that_are_to_be_damaged_are_corrected() {
    let calibration = crate::exporting::admitted(&compensating::calibration());
    // What the caller states so that everything can be corrected: frame and start, or tool, or all of it.
    let choices = [0b011, 0b100, 0b100, 0b110, 0b001];
    for ((language, bytes), choice) in HELD.into_iter().zip(choices) {
        let language = truepose::programs::find(language).unwrap();
        let answer = compensating::compensated(&calibration, language, bytes, choice).unwrap();
        let left: Vec<_> = answer
            .targets
            .iter()
            .map(|t| t.result.as_ref().err())
            .collect();
        assert!(left.iter().all(Option::is_none), "{language:?}: {left:?}");
    }
}

/// Found by fuzzing `compensate`: the promise counted lines by line feeds alone.
#[test]
fn a_carriage_return_alone_ends_a_line_of_a_program() {
    let calibration = crate::exporting::admitted(&compensating::calibration());
    let language = truepose::programs::find("urscript").unwrap();
    let program = b"def m():\n x = [1,\r\r\r 2]\n movej([2.21,.54,-.13,-.69,-.37,-2.74])\nend\n";
    let answer = compensating::compensated(&calibration, language, program, 2).unwrap();
    assert_eq!(answer.targets[0].place.0, 6);
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: proptest::test_runner::RngSeed::Fixed(12),
        ..ProptestConfig::with_cases(1500)
    })]

    #[test]
    fn damaged_programs_are_corrected_as_promised_or_refused(
        which in 0..HELD.len(),
        choice in any::<u8>(),
        changes in prop::collection::vec(any_change(), 0..4),
    ) {
        let (language, bytes) = HELD[which];
        let language = truepose::programs::find(language).unwrap();
        let calibration = crate::exporting::admitted(&compensating::calibration());
        compensating::compensated(&calibration, language, &changed(bytes, &changes), choice);
    }
}

/// A small file of every foreign format.
const FOREIGN: [(&str, &[u8]); 15] = [
    ("csv", b"Report\nPoint Name;Theta [deg];X [mm];Y [mm];Z [mm];t;Direction\nP1;0;1,5;2,5;\"3\";0:00:01,5;+\nP2;90;-1,5;2;3;2;-\n"),
    ("csv", b"\xff\xfeq\x001\0_\0d\0e\0g\0,\0x\0_\0m\0,\0y\0_\0m\0\n\x001\0,\x002\0,\x003\0\n\0"),
    ("tracker", b"// export\nA, R1, 1.5, 2.5, 3.5, 1\nA, R2, 101.5, 2.5, 3.5, 1\nA, R3, 1.5, 93, 6.5, 1\nA, P, 9, 8, 7, 1\n"),
    ("iso230", b"Target [deg],Run 1 +,Run 1 -,Run 2 +,Run 2 -\n0,0.1,-0.1,0.2,\n90,90.1,89.9,90.2,89.8\n"),
    ("iso230", b"Run;Direction;Target [deg];Deviation [arcsec]\n1;+;0;3,5\n1;-;90;-2\n"),
    ("optitrack", b"Format Version,1.23,Length Units,Meters,Rotation Type,Quaternion\n\n,Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body\n,Name,A,A,A,A,A,A,A\n,,Rotation,Rotation,Rotation,Rotation,Position,Position,Position\nFrame,Time (Seconds),X,Y,Z,W,X,Y,Z\n0,0.5,0,0,0,1,0.1,0.2,0.3\n1,1.5,,,,,,,\n2,2.5,0,0,1,0,0.2,0.1,0.3\n3,3.5,0,0,1,0,0.4,0.1,0.3\n4,3.6,0,0,1,0,0.5,0.1,0.3\n"),
    ("tum", b"# t x y z\n1 0.1 0.2 0.3 0 0 0 1\n2 0.2 0.2 0.3 0 0 0 1\n3 0.2 0.4 0.3 0 0 0 1\n3.5 0.1 0.5 0.3 0 0 0 1\n"),
    ("board", b"image,rvec_x,rvec_y,rvec_z,tvec_x [mm],tvec_y,tvec_z_m,q1_deg\nA,0,0.5,0,1,2,3,0\nB,3,,0.1,1.5,2,3,10\n"),
    ("ballbar", b"Zeit;Distance [mm];Kugel;q1_deg\n0,5;300,25;A;0\n1,5;301;B;10\n2;;A;20\n"),
    ("ballbar", b"time_s,Deviation [um]\n0,1.5\n1,2\n2,-3\n3,4\n"),
    ("csv", b"poses:\n- - 0.1\n  - [2, 3]\n- name: [a, b]\n  position: {x: 1, y: [2, 3]}\n---\nq: 'x'\n"),
    ("csv", b"q = np.array([[0.1, -2, 3]; [4 5 6]\n(7, 8, \"9\")], dtype=f)\n"),
    ("csv", b"j1;rx [deg];ry;rz;cam_x_mm;cam_y_mm;cam_z_mm;socket\n0;1;2;3;4;5;6;S\n1;2;3;4;5;6;7;S\n"),
    ("mcap", include_bytes!("../data/imports/tiny.mcap")),
    ("mcap", include_bytes!("../data/imports/tiny-zstd.mcap")),
];

#[test]
fn every_format_has_a_small_file_here() {
    for importer in IMPORTERS {
        let mut kinds = FOREIGN.iter().map(|(kind, _)| *kind);
        assert!(kinds.any(|kind| kind == importer.id), "{}", importer.id);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn foreign_files_that_are_damaged_do_no_harm(
        which in 0..FOREIGN.len(),
        changes in prop::collection::vec(any_change(), 0..5),
        beside in prop::collection::vec(any_change(), 0..3),
        matching in prop::sample::select(vec![Matching::Order, Matching::Name, Matching::Time]),
        with_commands in any::<bool>(),
        with_reference in any::<bool>(),
        said in any::<bool>(),
    ) {
        let robot = parse_robot(TURNING).unwrap().robot;
        let (kind, bytes) = FOREIGN[which];
        let bytes = changed(bytes, &changes);
        let _ = inspect(&bytes, &Reading::default());
        let reading = Reading {
            kind: find(kind),
            unit: said.then_some(LengthUnit::Millimetres),
            angle_unit: said.then_some(AngleUnit::Degrees),
            time_unit: said.then_some(TimeUnit::Seconds),
            options: if said { OPTIONS.map(|(name, value)| (name, value.to_owned())).into() } else { BTreeMap::new() },
            ..Reading::default()
        };
        let (commands, reference) = (changed(COMMANDS, &beside), changed(REFERENCE, &beside));
        let mut settings = Settings::new(reading, &robot);
        settings.matching = Some(matching);
        settings.clock_offset_s = said.then_some(0.0);
        settings.commands = with_commands.then_some(Companion { bytes: &commands, file: None });
        settings.reference = with_reference.then_some(Companion { bytes: &reference, file: None });
        if let Ok(imported) = import(&bytes, &settings) {
            assert_promises(&Loaded { session: imported.session, findings: Vec::new(), files: Vec::new() });
        }
    }

    #[test]
    fn documents_that_are_damaged_do_no_harm(changes in prop::collection::vec(any_change(), 1..5)) {
        if let Ok(loaded) = parse(&changed(DOCUMENT, &changes)) {
            assert_promises(&loaded);
        }
        let _ = parse_robot(&changed(ROBOT, &changes));
    }

    #[test]
    fn measurements_of_any_kind_that_are_damaged_do_no_harm(
        changes in prop::collection::vec(any_change(), 1..5),
    ) {
        if let Ok(loaded) = parse(&changed(OBSERVED, &changes)) {
            assert_promises(&loaded);
            let effects = truepose::fit::DEFAULT_EFFECTS.map(str::to_owned);
            let values = truepose::effects::JointValues::Commanded;
            // Whatever can be read can be fitted, or is refused in words.
            let _ = truepose::fit::identify_exact(&loaded.session, &effects, values);
        }
    }

    #[test]
    fn descriptions_of_robots_that_are_damaged_do_no_harm(changes in prop::collection::vec(any_change(), 1..5)) {
        let file = Path::new("r.xml");
        let finite = |robot: truepose::kinematics::Robot| {
            let tool = robot.base_from_tool.translation.vector;
            tool.iter().all(|x| x.is_finite()) && !robot.link_frames().is_empty()
        };
        for read in [robot_from_mjcf, robot_from_urdf] {
            for (sound, base) in [(MJCF, "world"), (URDF, "a")] {
                let text = String::from_utf8_lossy(&changed(sound, &changes)).into_owned();
                prop_assert!(read(&text, file, base, "tip").map_or(true, finite));
            }
        }
        let _ = lerobot_calibration(&changed(MOTORS, &changes), "m.json");
    }

    #[test]
    fn tables_that_are_damaged_do_no_harm(changes in prop::collection::vec(any_change(), 1..5)) {
        let text = String::from_utf8_lossy(DOCUMENT).into_owned();
        let (head, _) = text.split_once("\"samples\"").unwrap();
        let document = format!("{head}\"samples\":{{\"file\":\"s.csv\"}}}}");
        if let Ok(loaded) = parse_with_csv(document.as_bytes(), &changed(CSV, &changes)) {
            assert_promises(&loaded);
        }
    }
}
