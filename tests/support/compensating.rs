//! The whole of `compensate` on programs that may be damaged: reading, frames and tools, joint values,
//! corrected commands, writing and reading back. The smoke test and the fuzzer share it.

#![allow(
    dead_code,
    unreachable_pub,
    reason = "included in a test and in the fuzzer alike"
)]

use truepose::compensation::VerifiedCalibration;
use truepose::diagnostic::Rejected;
use truepose::effects::{Term, find as effect};
use truepose::kinematics::{Pose, Range, pose_from_parts};
use truepose::model::{Calibration, Model};
use truepose::pipeline;
use truepose::programs::{
    Answer, CompensateError, Language, ModelTool, Precedence, ProgramFrames, Request, Text,
};
use truepose::sessions::parse_robot;

/// A program of every language for [`calibration`]'s arm, with frames and tools where the language has them.
pub const HELD: [(&str, &[u8]); 5] = [
    ("csv", b"x_mm,y_mm,z_mm,qw,qx,qy,qz,load_kg\n408.923,-79.439,110.747,0.6472811,0.441235,0.469225,-0.4076359,2\n162.222,61.71,586.163,0.2102361,-0.3256699,0.2949246,-0.8733609,\n"),
    ("rapid", b"MODULE m\nPERS tooldata tGun:=[TRUE,[[1,2,3],[1,0,0,0]],[1,[0,0,9],[1,0,0,0],0,0,0]];\nPERS tooldata tPen:=[TRUE,[[1,2,43],[1,0,0,0]],[1,[0,0,9],[1,0,0,0],0,0,0]];\nPERS wobjdata fix:=[FALSE,TRUE,\"\",[[100,40,-30],[1,0,0,0]],[[0,0,5],[0.7071068,0,0,0.7071068]]];\nPERS loaddata part:=[0.5,[0,0,9],[1,0,0,0],0,0,0];\nCONST robtarget p0:=[[-119.439,-308.923,135.747],[0.1694550,0.6437920,0.0197921,-0.7459396],[0,0,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]];\nCONST robtarget p1:=[[162.222,61.710,586.163],[0.2102361,-0.3256699,0.2949246,-0.8733609],[0,0,1,1],[9E9,9E9,9E9,9E9,9E9,9E9]];\nCONST jointtarget j:=[[106,65,-25,-63,-53,-18],[9E9,9E9,9E9,9E9,9E9,9E9]];\nGripLoad part;\nMoveJ p0,v9,fine,tGun\\WObj:=fix;\nMoveAbsJ j,v9,fine,tGun;\nMoveL p1,v9,fine,tPen;\nENDMODULE\n"),
    ("krl", b"DEF m()\nDECL FRAME FIX\nFIX={X 100,Y 40,Z -30,A 90,B 0,C 0}\nPEN={FRAME: X 1,Y 2,Z 43,A 0,B 0,C 0}\nXP0={X -119.439,Y -308.923,Z 140.747,A -116.5595,B 75.2773,C 47.9314,S 0,T 'B010000'}\nXP1={X 162.2216,Y 61.7095,Z 586.1627,A -141.3534,B -26.4136,C -46.7269,S 0,T 18}\n$TOOL={X 1,Y 2,Z 3,A 0,B 0,C 0}\n$LOAD={M 2.5,CM {X 0,Y 0,Z 9,A 0,B 0,C 0},J {X 0,Y 0,Z 0}}\n$BASE=FIX\nPTP XP0\nPTP {A1 106,A2 65,A3 -25,A4 -63,A5 -53,A6 -18}\n$BASE=$NULLFRAME\n$TOOL=PEN\nLIN XP1\nEND\n"),
    ("urscript", b"def m():\n set_payload(2.5,[0,0,.1])\n set_tcp(p[.001,.002,.003,0,0,0])\n movel(p[0.408923,-0.079439,0.110747,1.003489,1.067146,-0.927076])\n movej([2.21,.54,-.13,-.69,-.37,-2.74])\n set_tcp(p[.001,.002,.043,0,0,0])\n movej(get_inverse_kin(p[0.162222,0.06171,0.586163,-0.905393,0.819918,-2.428025],qnear=[2.2,.5,-.1,-.6,-.4,-2.7]))\nend\n"),
    ("fanuc-ls", b"/PROG M\n/MN\n 1:UFRAME_NUM=1 ;PAYLOAD[2] ;\n 2:J P[1] 9% FINE ;\n 3:L P[2] 9mm/sec FINE ;\n/POS\nP[1]{\n GP1:\n UF : 1, UT : 1, CONFIG : 'N U T, 0, 0, 0',\n X = 408.923 mm, Y = -79.439 mm, Z = -179.253 mm,\n W = 47.9314 deg, P = 75.2773 deg, R = -26.5595 deg\n};\nP[2]{\n GP1:\n UF : 1, UT : 2,\n J1= 106 deg, J2= 65 deg, J3= -25 deg,\n J4= -63 deg, J5= -53 deg, J6= -18 deg\n};\n/END\n"),
];

const ARM: &[u8] = br#"{"name":"arm","joints":[
{"name":"A1","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-165,165]},
{"name":"A2","kind":"revolute","axis":[0,1,0],"point_mm":[0,0,290],"limits":[-110,110]},
{"name":"A3","kind":"revolute","axis":[0,1,0],"point_mm":[0,0,560],"limits":[-110,70]},
{"name":"A4","kind":"revolute","axis":[1,0,0],"point_mm":[0,0,630],"limits":[-160,160]},
{"name":"A5","kind":"revolute","axis":[0,1,0],"point_mm":[302,0,630],"limits":[-120,120]},
{"name":"A6","kind":"revolute","axis":[1,0,0],"point_mm":[302,0,630],"limits":[-400,400]}],
"tool":{"position_mm":[414,12,655],"quaternion_wxyz":[0.7071067811865476,0,0.7071067811865475,0]},
"gravity_m_s2":[0,0,-9.81]}"#;

/// A small arm with errors in its zeros, a link, a compliant joint and backlash.
///
/// # Panics
/// If the program no longer knows the arm or its effects.
pub fn calibration() -> Calibration {
    let robot = parse_robot(ARM).expect("a sound robot").robot;
    let terms = [
        ("joint-zero-offset", 1, vec![-0.0025]),
        ("joint-zero-offset", 2, vec![-0.0034]),
        ("joint-compliance", 1, vec![9e-6]),
        ("backlash", 3, vec![4e-4]),
    ];
    let terms = terms.into_iter().map(|(id, joint, coefficients)| Term {
        coefficients,
        ..Term::absent(effect(id).expect("an effect"), joint, 0.0)
    });
    let limits = robot.joints.iter().filter_map(|j| j.limits);
    Calibration {
        session: "arm".to_owned(),
        measured: limits
            .map(|l| Range {
                from: l.from,
                to: l.to,
            })
            .collect(),
        model: Model::new(robot, terms.collect()),
        covariance: None,
        regions: Vec::new(),
        targets: Vec::new(),
        measured_targets: None,
        measured_steps: None,
        tolerance_mm: None,
        compensated_by: None,
        set_up: truepose::model::SetUp::default(),
        conditions: truepose::model::Conditions::default(),
        set_aside: None,
        history: Vec::new(),
        load_kg: None,
        samples_hash: String::new(),
        program_version: String::new(),
    }
}

fn placed(mm: [f64; 3]) -> Pose {
    pose_from_parts(mm, [1.0, 0.0, 0.0, 0.0]).expect("a unit quaternion")
}

/// What is wrong is said with its place and with what was expected; the last of many complaints says how many more
/// there are.
fn complaints_have_places(rejected: &Rejected) {
    let all = &rejected.diagnostics;
    assert!(!all.is_empty());
    for one in all {
        let place = &one.place;
        assert!(place.line.is_some() && place.column.is_some(), "{one}");
    }
    let silent = all.iter().position(|one| one.expected.is_empty());
    assert!(
        silent.is_none_or(|k| k >= 200 && k + 1 == all.len()),
        "{rejected}"
    );
}

/// Corrects what may be a program and checks what is promised of every answer; `None`: it was refused.
/// The bits of `choice` say what the caller states beside the file: frame, start, tool, and what holds where
/// the program differs from the model.
///
/// # Panics
/// If a promise is broken.
pub fn compensated(
    calibration: &VerifiedCalibration,
    language: &'static Language,
    bytes: &[u8],
    choice: u8,
) -> Option<Answer> {
    let robot = &calibration.model.robot;
    let tool = match choice >> 2 & 3 {
        0 => None,
        1 => Some(ModelTool::OnFlange(placed([1.0, 2.0, 3.0]))),
        2 => Some(ModelTool::Named("TGUN".to_owned())),
        _ => Some(ModelTool::Named("1".to_owned())),
    };
    let frames = match choice >> 4 & 7 {
        0 => ProgramFrames::as_declared(),
        1 => ProgramFrames::default(),
        2 => ProgramFrames::as_programmed(),
        3 => ProgramFrames::as_modelled(),
        4 => ProgramFrames {
            tool: Precedence::Given(placed([1.0, 2.0, 3.0])),
            frame: Precedence::Given(placed([10.0, -20.0, 30.0])),
            load: Precedence::Given(2.0),
            ..ProgramFrames::default()
        },
        _ => ProgramFrames {
            tool: Precedence::Given(placed([40.0, 0.0, 120.0])),
            ..ProgramFrames::as_programmed()
        },
    };
    let named = matches!(tool, Some(ModelTool::Named(_)));
    let request = Request {
        calibration,
        bytes,
        language,
        file: None,
        beside: Vec::new(),
        load_kg: 1.5,
        start: (choice & 2 != 0).then(|| vec![0.1; robot.joints.len()]),
        frame: (choice & 1 != 0).then(|| placed([10.0, -20.0, 30.0])),
        tool,
        frames,
        measured_frame: false,
    };
    let answer = match pipeline::compensate(&request) {
        Ok(answer) => answer,
        Err(CompensateError::Rejected(rejected)) => {
            complaints_have_places(&rejected);
            return None;
        }
        Err(CompensateError::Tool { .. }) if named => return None,
        Err(CompensateError::Differs(found)) => {
            assert!(!found.0.is_empty());
            assert!(
                found
                    .0
                    .iter()
                    .all(|d| d.place.0 > 0 && d.place.1 > 0 && !d.name.is_empty())
            );
            return None;
        }
        Err(CompensateError::Several { .. }) => return None,
        Err(other) => panic!("{}: {other}", String::from_utf8_lossy(bytes)),
    };
    // A carriage return alone ends a line too.
    let lines = Text::new(bytes).lines().count() as u64;
    for target in &answer.targets {
        let (line, column) = target.place;
        assert!(
            (1..=lines).contains(&line) && column > 0,
            "{:?}",
            target.place
        );
        match &target.result {
            Ok(written) => {
                let all = written.commanded.iter().chain(&written.corrected);
                for (q, joint) in all.zip(robot.joints.iter().cycle()) {
                    let limits = joint.limits.expect("all joints of the arm have limits");
                    let inside = limits.from - 1e-9..=limits.to + 1e-9;
                    assert!(inside.contains(q), "{q} of {}", joint.name);
                }
                let left = written.position_mm.iter().chain(&written.rotation_rad);
                assert!(left.into_iter().all(|v| v.is_finite()));
            }
            Err(left) => assert!(!left.explanation.is_empty()),
        }
    }
    if answer.left() == answer.targets.len() {
        assert_eq!(answer.bytes, bytes, "what is left stays as it is");
    }
    // Only numbers change: signs, digits, points, powers, and the quotes of a binary number.
    let rest = |bytes: &[u8]| -> Vec<u8> {
        let number = |b: &&u8| !b"0123456789+-.,eE'B".contains(b);
        bytes.iter().filter(number).copied().collect()
    };
    assert_eq!(rest(&answer.bytes), rest(bytes));
    Some(answer)
}
